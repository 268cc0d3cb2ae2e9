//! Boundary edges that coincide with another one because vertices at one position were not welded.

use crate::mesh::TriMesh;
use crate::mesh::edges::EdgeTable;

/// Number of boundary edges whose ends are at the positions of those of another boundary edge.
pub(super) fn seam_edges(mesh: &TriMesh, edges: &EdgeTable) -> usize {
    // Adding zero makes −0 equal to +0.
    let place = |v: u32| mesh.positions()[v as usize].map(|x| (x + 0.0).to_bits());
    let mut places: Vec<[[u64; 3]; 2]> = edges
        .iter()
        .filter(|edge| edge.faces().len() == 1)
        .map(|edge| {
            let mut ends = edge.ends.map(place);
            ends.sort_unstable();
            ends
        })
        .filter(|[one, other]| one != other)
        .collect();
    places.sort_unstable();
    places.chunk_by(|a, b| a == b).map(<[_]>::len).filter(|count| *count > 1).sum()
}
