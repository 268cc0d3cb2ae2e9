//! Edges, boundaries, components, orientation, genus.

use super::union_find::UnionFind;
use crate::mesh::TriMesh;
use crate::mesh::edges::{Edge, EdgeTable, has_three_vertices};

/// Counts of edges, boundaries and components of a mesh, and whether it is orientable; from vertex indices alone.
///
/// Faces that name a vertex twice have no edges: they count in [`components`](Self::components) and nowhere else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Connectivity {
    /// Number of undirected edges.
    pub edges: usize,
    /// Number of edges with a single face.
    pub boundary_edges: usize,
    /// Number of closed chains of boundary edges, followed around the fan of faces from one boundary edge to the next. (At
    /// a non-manifold edge a chain may end, and is counted too.)
    pub boundary_loops: usize,
    /// Number of edges with more than two faces.
    pub non_manifold_edges: usize,
    /// Number of vertices whose faces form more than one fan, open or closed, when separated at non-manifold edges: the ends of
    /// these edges, and vertices where fans only touch.
    pub non_manifold_vertices: usize,
    /// Number of edges whose two faces both run along them in the same direction.
    pub inconsistent_edges: usize,
    /// Number of parts that have no vertex in common.
    pub components: usize,
    /// Vertices minus edges plus faces.
    pub euler_characteristic: isize,
    /// Whether some faces can be reversed so that no edge with two faces is inconsistent.
    pub orientable: bool,
    /// Whether every edge is traversed equally often in both directions (and there is an edge), so that the faces enclose a signed
    /// volume.
    pub encloses_volume: bool,
    /// Number of handles, all components together: half of `2·components − Euler characteristic − boundary loops`. `None`
    /// unless the mesh is manifold and orientable (and some face has three different vertices).
    pub genus: Option<usize>,
}

/// Which corner of a face is at one of its vertices.
fn corner(mesh: &TriMesh, face: usize, vertex: u32) -> usize {
    let at = mesh.faces()[face].iter().position(|&v| v == vertex);
    3 * face + at.unwrap_or(0)
}

/// Whether a face runs along the edge from its lesser to its greater end.
fn runs_upwards(mesh: &TriMesh, edge: &Edge, face: usize) -> bool {
    let [a, b, c] = mesh.faces()[face];
    [[a, b], [b, c], [c, a]].contains(&edge.ends)
}

impl Connectivity {
    /// `referenced`: the number of vertices that some face names.
    pub(super) fn of(mesh: &TriMesh, table: &EdgeTable, referenced: usize) -> Self {
        let mut edges = 0_usize;
        let mut non_manifold_edges = 0;
        let mut inconsistent_edges = 0;
        let mut balanced = true;
        let mut boundary: Vec<[usize; 2]> = Vec::new();
        // The corners at a vertex, joined across the edges with two faces: one set for every fan.
        let mut fans = UnionFind::new(3 * mesh.faces().len());
        let mut fan_counts = vec![0_u32; mesh.positions().len()];
        for &v in mesh.faces().iter().filter(|f| has_three_vertices(**f)).flatten() {
            fan_counts[v as usize] += 1;
        }
        for edge in table.iter() {
            edges += 1;
            let mut faces = edge.faces();
            let upwards = edge.faces().filter(|&f| runs_upwards(mesh, &edge, f)).count();
            balanced &= 2 * upwards == faces.len();
            match (faces.next(), faces.next(), faces.next()) {
                (Some(f), None, _) => boundary.push(edge.ends.map(|v| corner(mesh, f, v))),
                (Some(f), Some(g), None) => {
                    inconsistent_edges += usize::from(upwards != 1);
                    for v in edge.ends {
                        if fans.union(corner(mesh, f, v), corner(mesh, g, v)) {
                            fan_counts[v as usize] -= 1;
                        }
                    }
                }
                _ => non_manifold_edges += 1,
            }
        }
        let boundary_edges = boundary.len();
        let boundary_loops = loops(&boundary, &mut fans);
        drop(fans);
        // Fans end at a non-manifold edge, so there is more than one around its ends.
        let non_manifold_vertices = fan_counts.iter().filter(|&&fans| fans > 1).count();
        let proper_faces = mesh.faces().iter().filter(|f| has_three_vertices(**f)).count();
        let proper_vertices = fan_counts.iter().filter(|&&fans| fans > 0).count();
        let [v, e, f] = [proper_vertices, edges, proper_faces].map(usize::cast_signed);
        let euler_characteristic = v - e + f;
        let [proper_components, components] = components(mesh, proper_vertices, referenced);
        let orientable = inconsistent_edges == 0 || can_be_oriented(mesh, table);
        let manifold = non_manifold_edges == 0 && non_manifold_vertices == 0;
        let [c, b] = [proper_components, boundary_loops].map(usize::cast_signed);
        let handles = (2 * c - euler_characteristic - b) / 2;
        Self {
            edges,
            boundary_edges,
            boundary_loops,
            non_manifold_edges,
            non_manifold_vertices,
            inconsistent_edges,
            components,
            euler_characteristic,
            orientable,
            encloses_volume: balanced && edges > 0,
            genus: if manifold && orientable && edges > 0 { usize::try_from(handles).ok() } else { None },
        }
    }
}

/// Number of chains of boundary edges, each given by the corners at its ends.
fn loops(boundary: &[[usize; 2]], fans: &mut UnionFind) -> usize {
    let mut ends: Vec<(usize, usize)> = boundary
        .iter()
        .enumerate()
        .flat_map(|(e, corners)| corners.map(|c| (c, e)))
        .map(|(c, e)| (fans.find(c), e))
        .collect();
    ends.sort_unstable();
    let mut chains = UnionFind::new(boundary.len());
    let joined = ends.chunk_by(|a, b| a.0 == b.0).flat_map(|fan| fan.windows(2));
    boundary.len() - joined.filter(|pair| chains.union(pair[0].1, pair[1].1)).count()
}

/// Number of parts without a common vertex: among the faces with three different vertices, and among all.
fn components(mesh: &TriMesh, proper_vertices: usize, referenced: usize) -> [usize; 2] {
    let mut sets = UnionFind::new(mesh.positions().len());
    let mut join = |faces: &mut dyn Iterator<Item = &[u32; 3]>| {
        let pairs = faces.flat_map(|&[a, b, c]| [[a, b], [b, c]]);
        pairs.filter(|&[a, b]| sets.union(a as usize, b as usize)).count()
    };
    let proper = join(&mut mesh.faces().iter().filter(|f| has_three_vertices(**f)));
    let improper = join(&mut mesh.faces().iter().filter(|f| !has_three_vertices(**f)));
    [proper_vertices - proper, referenced - proper - improper]
}

/// Whether the faces can be oriented consistently across every edge with two faces: no side of a face is joined to its other side.
fn can_be_oriented(mesh: &TriMesh, table: &EdgeTable) -> bool {
    let mut sides = UnionFind::new(2 * mesh.faces().len());
    for edge in table.iter() {
        let mut faces = edge.faces();
        if let (Some(f), Some(g), None) = (faces.next(), faces.next(), faces.next()) {
            let turned = usize::from(runs_upwards(mesh, &edge, f) == runs_upwards(mesh, &edge, g));
            sides.union(2 * f, 2 * g + turned);
            sides.union(2 * f + 1, 2 * g + 1 - turned);
        }
    }
    (0..mesh.faces().len()).all(|f| sides.find(2 * f) != sides.find(2 * f + 1))
}
