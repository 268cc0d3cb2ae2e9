//! The undirected edges of a mesh and the faces around each of them.

use super::TriMesh;

/// Edges grouped by their lesser end. No hashing, so that the order is the same on every machine.
///
/// Only faces with three different vertices have edges. Takes O(m log m) time at worst (O(m) at bounded valence) and
/// 8 bytes per face corner.
pub(super) struct EdgeTable {
    /// Where the edge uses with lesser end `v` begin, for every vertex; one more entry for the end of the last.
    starts: Vec<usize>,
    uses: Vec<EdgeUse>,
}

/// A face at the edge from the lesser end of the group to this greater end.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct EdgeUse {
    greater_end: u32,
    face: u32,
}

/// An undirected edge with at least one face.
pub(super) struct Edge<'t> {
    /// Its ends, the lesser first.
    pub(super) ends: [u32; 2],
    uses: &'t [EdgeUse],
}

impl Edge<'_> {
    /// The faces that have this edge, in index order.
    pub(super) fn faces(&self) -> impl ExactSizeIterator<Item = usize> + Clone {
        self.uses.iter().map(|u| u.face as usize)
    }
}

/// Whether the three indices differ, so that the face has three edges.
pub(crate) fn has_three_vertices(face: [u32; 3]) -> bool {
    face[0] != face[1] && face[1] != face[2] && face[2] != face[0]
}

impl EdgeTable {
    pub(super) fn new(mesh: &TriMesh) -> Self {
        Self::of_faces(mesh.positions().len(), mesh.faces())
    }

    /// The edges of faces whose indices are below the number of vertices.
    pub(super) fn of_faces(vertices: usize, faces: &[[u32; 3]]) -> Self {
        let edges = |face: [u32; 3]| {
            let count = if has_three_vertices(face) { 3 } else { 0 };
            (0..count).map(move |i| {
                let (a, b) = (face[i], face[(i + 1) % 3]);
                (a.min(b), a.max(b))
            })
        };
        let mut starts = vec![0_usize; vertices + 1];
        for &face in faces {
            for (lesser, _) in edges(face) {
                starts[lesser as usize + 1] += 1;
            }
        }
        for v in 1..starts.len() {
            starts[v] += starts[v - 1];
        }
        let mut uses = vec![EdgeUse { greater_end: 0, face: 0 }; starts.last().copied().unwrap_or(0)];
        // While a group fills, `starts[v]` moves to its end; the shift below restores it.
        for (f, &face) in faces.iter().enumerate() {
            for (lesser, greater_end) in edges(face) {
                let next = &mut starts[lesser as usize];
                uses[*next] = EdgeUse { greater_end, face: f as u32 };
                *next += 1;
            }
        }
        starts.rotate_right(1);
        starts[0] = 0;
        for group in starts.windows(2) {
            uses[group[0]..group[1]].sort_unstable();
        }
        Self { starts, uses }
    }

    /// All edges, ordered by their lesser, then their greater end.
    pub(super) fn iter(&self) -> impl Iterator<Item = Edge<'_>> {
        self.starts.windows(2).enumerate().flat_map(|(v, group)| {
            self.uses[group[0]..group[1]]
                .chunk_by(|a, b| a.greater_end == b.greater_end)
                .map(move |uses| Edge { ends: [v as u32, uses[0].greater_end], uses })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_come_in_order_with_their_faces() {
        let faces = vec![[0, 1, 2], [2, 1, 3], [3, 3, 0], [1, 2, 0]];
        let mesh = TriMesh::new(vec![[0.0; 3]; 5], faces).unwrap();
        let table = EdgeTable::new(&mesh);
        let edges: Vec<_> = table.iter().map(|e| (e.ends, e.faces().collect::<Vec<_>>())).collect();
        let expected = [
            ([0, 1], vec![0, 3]),
            ([0, 2], vec![0, 3]),
            ([1, 2], vec![0, 1, 3]),
            ([1, 3], vec![1]),
            ([2, 3], vec![1]),
        ];
        assert_eq!(edges, expected);
    }
}
