//! Counts, measures, connectivity and defects of a mesh.

mod connectivity;
#[cfg(feature = "serde")]
mod data;
mod degenerate;
mod measure;
mod seams;
pub(super) mod union_find;

pub use connectivity::Connectivity;
pub use degenerate::is_degenerate;
pub use measure::area;
pub use union_find::UnionFind;

use super::TriMesh;
use super::edges::EdgeTable;
use crate::geom::Aabb;
use rayon::prelude::*;

/// Counts, measures and connectivity of a mesh. Every mesh has one.
///
/// # Cost
/// O(n + m log m) time, O(m) at bounded valence; at most about 60 bytes per face and 20 per vertex while it works. The
/// same for any number of threads.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(into = "data::Summary"))]
pub struct MeshSummary {
    /// Number of vertices, unreferenced ones included.
    pub vertices: usize,
    /// Number of vertices that no face names.
    pub unreferenced_vertices: usize,
    /// Number of faces.
    pub faces: usize,
    /// Number of faces of area zero, decided exactly; see [`is_degenerate`].
    pub degenerate_faces: usize,
    /// Number of faces that name the same three different vertices as an earlier face, in whatever order.
    pub duplicate_faces: usize,
    /// Number of boundary edges whose ends are at the positions of those of another boundary edge: where a surface was cut open or
    /// never welded.
    pub seam_edges: usize,
    /// The box of the faces; unreferenced vertices do not count.
    pub bounding_box: Aabb,
    /// Sum of the areas of all faces, in squared length; rounded, infinite beyond the range of `f64`.
    pub area: f64,
    /// Enclosed volume, in cubed length, if the faces enclose one ([`Connectivity::encloses_volume`]); rounded, infinite
    /// beyond the range of `f64`. Negative if the faces point inwards.
    pub volume: Option<f64>,
    /// Edges, boundaries, components, orientability and genus.
    pub connectivity: Connectivity,
}

impl MeshSummary {
    /// The summary of a mesh.
    pub fn of(mesh: &TriMesh) -> Self {
        let edges = EdgeTable::new(mesh);
        let unreferenced_vertices = unreferenced_vertices(mesh);
        let connectivity = Connectivity::of(mesh, &edges, mesh.positions().len() - unreferenced_vertices);
        let bounding_box = Aabb::of_faces(mesh);
        Self {
            vertices: mesh.positions().len(),
            unreferenced_vertices,
            faces: mesh.faces().len(),
            degenerate_faces: mesh
                .faces()
                .par_iter()
                .filter(|face| is_degenerate(face.map(|v| mesh.positions()[v as usize])))
                .count(),
            duplicate_faces: duplicates(mesh, &edges),
            seam_edges: seams::seam_edges(mesh, &edges),
            area: measure::area_in(mesh, &bounding_box),
            volume: connectivity.encloses_volume.then(|| measure::volume(mesh, &bounding_box)),
            bounding_box,
            connectivity,
        }
    }
}

/// Number of vertices that no face names. They are not part of the surface.
pub fn unreferenced_vertices(mesh: &TriMesh) -> usize {
    let mut referenced = vec![false; mesh.positions().len()];
    for &v in mesh.faces().iter().flatten() {
        referenced[v as usize] = true;
    }
    referenced.into_iter().filter(|&r| !r).count()
}

/// Number of faces with the vertices of an earlier one. Such faces share the edge of their two least vertices.
fn duplicates(mesh: &TriMesh, edges: &EdgeTable) -> usize {
    let mut greatest = Vec::new();
    let mut count = 0;
    for edge in edges.iter().filter(|e| e.faces().len() > 1) {
        let third = |f: usize| mesh.faces()[f].into_iter().fold(0, u32::max);
        greatest.clear();
        greatest.extend(edge.faces().map(third).filter(|&v| v > edge.ends[1]));
        greatest.sort_unstable();
        count += greatest.windows(2).filter(|pair| pair[0] == pair[1]).count();
    }
    count
}

#[cfg(test)]
mod tests;
