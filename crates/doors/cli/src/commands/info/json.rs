//! The summary as one JSON object.

use pompeiu::core::MeshSummary;
use pompeiu::io::ReadMesh;
use serde::Serialize;

/// The summary on one line.
pub(super) fn json(path: String, read: &ReadMesh, summary: &MeshSummary) -> serde_json::Result<String> {
    Ok(serde_json::to_string(&Report::new(path, read, summary))? + "\n")
}

/// The summary as JSON. Lengths are in the unit of the file; what does not apply, or overflows, is null.
#[derive(Serialize)]
struct Report {
    path: String,
    format: String,
    compressed: bool,
    vertices: usize,
    faces: usize,
    edges: usize,
    bounding_box: BoundingBox,
    area: f64,
    volume: Option<f64>,
    components: usize,
    boundary_loops: usize,
    euler_characteristic: isize,
    genus: Option<usize>,
    orientable: bool,
    degenerate_faces: usize,
    duplicate_faces: usize,
    unreferenced_vertices: usize,
    boundary_edges: usize,
    non_manifold_edges: usize,
    non_manifold_vertices: usize,
    inconsistent_edges: usize,
    polygons_triangulated: u64,
    faces_dropped: u64,
}

#[derive(Serialize)]
struct BoundingBox {
    lower: [f64; 3],
    upper: [f64; 3],
    diagonal: f64,
}

impl Report {
    fn new(path: String, read: &ReadMesh, summary: &MeshSummary) -> Self {
        let (bounds, topology) = (summary.bounding_box, summary.connectivity);
        Self {
            path,
            format: read.format.to_string(),
            compressed: read.compressed,
            vertices: summary.vertices,
            faces: summary.faces,
            edges: topology.edges,
            bounding_box: BoundingBox {
                lower: bounds.lower,
                upper: bounds.upper,
                diagonal: bounds.diagonal(),
            },
            area: summary.area,
            volume: summary.volume,
            components: topology.components,
            boundary_loops: topology.boundary_loops,
            euler_characteristic: topology.euler_characteristic,
            genus: topology.genus,
            orientable: topology.orientable,
            degenerate_faces: summary.degenerate_faces,
            duplicate_faces: summary.duplicate_faces,
            unreferenced_vertices: summary.unreferenced_vertices,
            boundary_edges: topology.boundary_edges,
            non_manifold_edges: topology.non_manifold_edges,
            non_manifold_vertices: topology.non_manifold_vertices,
            inconsistent_edges: topology.inconsistent_edges,
            polygons_triangulated: read.polygons_triangulated,
            faces_dropped: read.faces_dropped,
        }
    }
}
