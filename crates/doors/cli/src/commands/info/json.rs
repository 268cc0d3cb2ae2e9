//! The summary as one JSON object.

use crate::json::line;
use pompeiu::core::MeshSummary;
use pompeiu::io::ReadMesh;
use serde::Serialize;

/// The summary on one line.
pub(super) fn json(path: &str, read: &ReadMesh, summary: &MeshSummary) -> serde_json::Result<String> {
    line(&Json {
        path,
        format: read.format.to_string(),
        compressed: read.compressed,
        summary,
        polygons_triangulated: read.polygons_triangulated,
        faces_dropped: read.faces_dropped,
    })
}

/// The answer of `pompeiu info --json`. Lengths are in the unit of the file.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Info"))]
pub(crate) struct Json<'r> {
    /// The path as it was given.
    path: &'r str,
    /// The format by content.
    format: String,
    /// Whether the file is compressed.
    compressed: bool,
    #[serde(flatten)]
    summary: &'r MeshSummary,
    /// Number of faces with more than three corners, which were cut into triangles.
    polygons_triangulated: u64,
    /// Number of faces with fewer than three corners, which were left out.
    faces_dropped: u64,
}
