//! A summary as data for other programs.

use super::MeshSummary;
use serde::Serialize;

/// Counts, measures and connectivity of a mesh. Lengths are in the unit of the mesh.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "MeshSummary"))]
pub(super) struct Summary {
    /// Number of vertices, unreferenced ones included.
    vertices: usize,
    /// Number of faces.
    faces: usize,
    /// Number of undirected edges.
    edges: usize,
    /// The box of the faces; unreferenced vertices do not count.
    bounding_box: BoundingBox,
    /// Sum of the areas of all faces, in squared length; null beyond the range of double precision.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    area: f64,
    /// Enclosed volume, in cubed length, negative if the faces point inwards; null if the faces enclose none, and beyond the range
    /// of double precision.
    volume: Option<f64>,
    /// Number of parts that have no vertex in common.
    components: usize,
    /// Number of closed chains of boundary edges.
    boundary_loops: usize,
    /// Vertices minus edges plus faces.
    euler_characteristic: isize,
    /// Number of handles; null unless the mesh is manifold and orientable.
    genus: Option<usize>,
    /// Whether the faces could be turned so that neighbours agree.
    orientable: bool,
    /// Number of faces of area zero.
    degenerate_faces: usize,
    /// Number of faces with the vertices of an earlier face.
    duplicate_faces: usize,
    /// Number of vertices that no face names.
    unreferenced_vertices: usize,
    /// Number of edges with a single face.
    boundary_edges: usize,
    /// Number of boundary edges whose ends are at the positions of those of another boundary edge: where welding would close the surface.
    seam_edges: usize,
    /// Number of edges with more than two faces.
    non_manifold_edges: usize,
    /// Number of vertices whose faces form more than one fan.
    non_manifold_vertices: usize,
    /// Number of edges between two faces of opposite orientation.
    inconsistent_edges: usize,
}

/// A box with sides along the axes.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct BoundingBox {
    /// Least coordinates.
    lower: [f64; 3],
    /// Greatest coordinates.
    upper: [f64; 3],
    /// Distance of the two corners.
    diagonal: f64,
}

impl From<MeshSummary> for Summary {
    fn from(summary: MeshSummary) -> Self {
        let (bounds, connectivity) = (summary.bounding_box, summary.connectivity);
        Self {
            vertices: summary.vertices,
            faces: summary.faces,
            edges: connectivity.edges,
            bounding_box: BoundingBox {
                lower: bounds.lower,
                upper: bounds.upper,
                diagonal: bounds.diagonal(),
            },
            area: summary.area,
            volume: summary.volume,
            components: connectivity.components,
            boundary_loops: connectivity.boundary_loops,
            euler_characteristic: connectivity.euler_characteristic,
            genus: connectivity.genus,
            orientable: connectivity.orientable,
            degenerate_faces: summary.degenerate_faces,
            duplicate_faces: summary.duplicate_faces,
            unreferenced_vertices: summary.unreferenced_vertices,
            boundary_edges: connectivity.boundary_edges,
            seam_edges: summary.seam_edges,
            non_manifold_edges: connectivity.non_manifold_edges,
            non_manifold_vertices: connectivity.non_manifold_vertices,
            inconsistent_edges: connectivity.inconsistent_edges,
        }
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for MeshSummary {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        Summary::schema_name()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        Summary::json_schema(generator)
    }
}
