//! Inserting paths across faces as edges of the mesh.

use super::walk::Way;
use pompeiu_core::{FaceId, VertexId};
use pompeiu_surface::{EdgeData, EmbeddedSurface, SurfaceMesh};

/// A corner of a part of a face, and the sides of the face that contain it, as bits.
type Node = (u32, u8);

/// The mesh with paths as edges.
pub(super) struct Inserted {
    /// The vertices of the input, then those inserted on its edges.
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) faces: Vec<[u32; 3]>,
    /// The face of the input that each face is a part of.
    pub(super) parents: Vec<FaceId>,
    /// The edges of the paths, by their ends.
    pub(super) paths: Vec<[u32; 2]>,
}

/// Inserts lines between vertices that do not cross each other. `None` if rounding makes them cross.
pub(super) fn insert(surface: &EmbeddedSurface, lines: &[(VertexId, Way, VertexId)]) -> Option<Inserted> {
    let mesh = surface.mesh();
    let mut positions = surface.positions().as_slice().to_vec();
    let mut on_edges: EdgeData<Vec<(f64, u32)>> = EdgeData::filled(mesh.edges(), Vec::new());
    let mut chords: Vec<Vec<[u32; 2]>> = vec![Vec::new(); mesh.faces()];
    let mut paths = Vec::new();
    for (from, way, to) in lines {
        let mut last = from.0;
        match way {
            Way::Edge => paths.push([from.0, to.0]),
            Way::Crossings(crossings, end) => {
                for &(h, share) in crossings {
                    let share = if mesh.is_along(h) { share } else { 1.0 - share };
                    let [p, q] = mesh.ends(mesh.edge(h)).map(|v| surface.positions()[v]);
                    let point = positions.len() as u32;
                    positions.push([0, 1, 2].map(|k| p[k] + share * (q[k] - p[k])));
                    on_edges[mesh.edge(h)].push((share, point));
                    chords[h.face().index()].push([last, point]);
                    paths.push([last, point]);
                    last = point;
                }
                chords[end.index()].push([last, to.0]);
                paths.push([last, to.0]);
            }
        }
    }
    let (faces, parents) = divide(mesh, &positions, on_edges, &chords)?;
    Some(Inserted { positions, faces, parents, paths })
}

/// Divides faces at points on their edges, given by their shares of the edge and their numbers, and along chords between corners and such
/// points. Returns the parts, and the face that each is a part of; `None` if chords cross.
pub(crate) fn divide(
    mesh: &SurfaceMesh,
    positions: &[[f64; 3]],
    mut on_edges: EdgeData<Vec<(f64, u32)>>,
    chords: &[Vec<[u32; 2]>],
) -> Option<(Vec<[u32; 3]>, Vec<FaceId>)> {
    for edge in mesh.edge_ids() {
        on_edges[edge].sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    let (mut faces, mut parents) = (Vec::new(), Vec::new());
    for face in mesh.face_ids() {
        let mut around: Vec<Node> = Vec::new();
        for (i, h) in SurfaceMesh::face_halfedges(face).into_iter().enumerate() {
            let (side, before) = (1 << i, 1 << ((i + 2) % 3));
            around.push((mesh.tail(h).0, side | before));
            let points = on_edges[mesh.edge(h)].iter().map(|&(_, point)| (point, side));
            if mesh.is_along(h) { around.extend(points) } else { around.extend(points.rev()) }
        }
        for part in split(around, &chords[face.index()])? {
            let first = faces.len();
            triangulate(part, positions, &mut faces)?;
            parents.resize(parents.len() + faces.len() - first, face);
        }
    }
    Some((faces, parents))
}

/// The parts into which chords divide a face.
fn split(around: Vec<Node>, chords: &[[u32; 2]]) -> Option<Vec<Vec<Node>>> {
    let mut parts = vec![around];
    for chord in chords {
        let place = |part: &[Node], v: u32| part.iter().position(|node| node.0 == v);
        let found = parts.iter().enumerate().find_map(|(k, part)| {
            let (i, j) = (place(part, chord[0])?, place(part, chord[1])?);
            Some((k, i.min(j), i.max(j)))
        });
        let (k, i, j) = found?;
        let part = parts.swap_remove(k);
        let rest = part[j..].iter().chain(&part[..=i]).copied().collect();
        parts.extend([part[i..=j].to_vec(), rest]);
    }
    Some(parts)
}

/// Triangulates a convex polygon, best corner first, without triangles whose corners are all on one side of the face.
fn triangulate(mut part: Vec<Node>, positions: &[[f64; 3]], faces: &mut Vec<[u32; 3]>) -> Option<()> {
    let is_flat = |nodes: &mut dyn Iterator<Item = &Node>| nodes.fold(u8::MAX, |all, node| all & node.1) != 0;
    while part.len() >= 3 {
        let n = part.len();
        let corners = |i: usize| [part[(i + n - 1) % n], part[i], part[(i + 1) % n]];
        let is_ear = |i: &usize| {
            let mut rest = (0..n).filter(|k| k != i).map(|k| &part[k]);
            !is_flat(&mut corners(*i).iter()) && (n == 3 || !is_flat(&mut rest))
        };
        let quality = |i: usize| {
            let [a, b, c] = corners(i).map(|node| glam::DVec3::from_array(positions[node.0 as usize]));
            let longest =
                (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
            (b - a).cross(c - a).length() / longest
        };
        let ear = (0..n).filter(is_ear).max_by(|&i, &j| quality(i).total_cmp(&quality(j)))?;
        faces.push(corners(ear).map(|node| node.0));
        part.remove(ear);
    }
    Some(())
}

/// Marks edges by their ends.
pub(crate) fn marked(mesh: &SurfaceMesh, paths: &[[u32; 2]]) -> Option<EdgeData<bool>> {
    let mut marked = EdgeData::filled(mesh.edges(), false);
    for ends in paths {
        marked[crate::cut::edge_between(mesh, ends.map(VertexId))?] = true;
    }
    Some(marked)
}
