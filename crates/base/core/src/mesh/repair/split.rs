//! One vertex for every fan of faces.

use super::Change;
use super::parts::Parts;
use crate::mesh::edges::Edge;
use crate::mesh::topology::union_find::UnionFind;

/// Gives every fan of faces around a vertex a vertex of its own; fans end at edges with one face or more than two. Returns the
/// edges that had more than two faces, and the vertices with more than one fan.
///
/// Afterwards no edge has more than two faces. Fans that end at one edge are open chains of faces around their vertex. A chain has
/// two ends, so at most two faces of an edge share a vertex at each end of it.
pub(super) fn split(parts: &mut Parts) -> (Change, Change) {
    split_at(parts, |_, edge| edge.faces().len() > 2)
}

/// Cuts a surface with one side only open, along the edges whose two faces run along them in the same direction. Returns these edges.
///
/// Around a vertex inside of the surface their number is even, so each of them ends up with two boundary edges in its place.
pub(super) fn open_one_sided(parts: &mut Parts) -> Change {
    let (opened, _) = split_at(parts, |parts, edge| {
        let mut faces = edge.faces();
        matches!((faces.next(), faces.next()), (Some(f), Some(g)) if parts.run_alike(edge.ends, f, g))
    });
    opened
}

/// Gives every fan of faces a vertex of its own, where fans end at edges with one face and those that are to be cut. Returns the edges
/// that were cut, and the vertices with more than one fan.
fn split_at(parts: &mut Parts, is_cut: impl Fn(&Parts, &Edge<'_>) -> bool) -> (Change, Change) {
    let corner = |face: usize, vertex: u32| {
        let place = parts.faces[face].iter().position(|&v| v == vertex);
        3 * face + place.unwrap_or(0)
    };
    let mut fans = UnionFind::new(3 * parts.faces.len());
    let mut edges = Change::default();
    for edge in parts.edges().iter() {
        if is_cut(parts, &edge) {
            edges.add(parts.positions[edge.ends[0] as usize]);
            continue;
        }
        let mut faces = edge.faces();
        if let (Some(f), Some(g)) = (faces.next(), faces.next()) {
            for v in edge.ends {
                fans.union(corner(f, v), corner(g, v));
            }
        }
    }
    // The least corner of a fan comes first and gives the fan its vertex, so the first fan keeps the original one.
    let mut fan_counts = vec![0_u32; parts.positions.len()];
    let mut vertices = Change::default();
    let mut numbers = vec![0; 3 * parts.faces.len()];
    for face in 0..parts.faces.len() {
        // In an order that reversing the face does not change.
        let mut corners = [0, 1, 2].map(|i| (parts.faces[face][i], 3 * face + i));
        corners.sort_unstable();
        for (vertex, corner) in corners {
            let first = fans.find(corner);
            numbers[corner] = if first < corner {
                numbers[first]
            } else {
                let count = &mut fan_counts[vertex as usize];
                *count += 1;
                let position = parts.positions[vertex as usize];
                if *count == 2 {
                    vertices.add(position);
                }
                if *count == 1 {
                    vertex
                } else {
                    parts.positions.push(position);
                    parts.positions.len() as u32 - 1
                }
            };
        }
    }
    parts.faces.as_flattened_mut().copy_from_slice(&numbers);
    (edges, vertices)
}
