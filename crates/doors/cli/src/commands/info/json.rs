//! The summary as one JSON object.

use crate::json::line;
use pompeiu::core::MeshSummary;
use pompeiu::core::spatial::{IntersectingPair, SelfIntersections};
use pompeiu::io::ReadMesh;
use serde::Serialize;

/// The summary on one line.
pub(super) fn json(
    path: &str,
    read: &ReadMesh,
    summary: &MeshSummary,
    intersections: Option<&SelfIntersections>,
) -> serde_json::Result<String> {
    line(&Json {
        path,
        format: read.format.to_string(),
        compressed: read.compressed,
        summary,
        polygons_triangulated: read.polygons_triangulated,
        faces_dropped: read.faces_dropped,
        self_intersections: intersections.map(|found| Intersections {
            count: found.pairs.len(),
            touching: found.touching,
            complete: found.complete,
            first: found.pairs.iter().take(MOST_SHOWN).map(Pair::new).collect(),
        }),
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
    /// Pairs of faces that intersect; absent unless asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    self_intersections: Option<Intersections>,
}

/// Pairs of intersecting faces that are listed.
const MOST_SHOWN: usize = 1000;

/// Pairs of faces with a common point beside the corners and edges that neighbours share.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Intersections {
    /// Number of pairs.
    count: usize,
    /// Number of further pairs that only touch, where different vertices are at one position.
    touching: usize,
    /// Whether these are all; otherwise counting ended at ten million.
    complete: bool,
    /// The first thousand pairs in the order of their faces.
    first: Vec<Pair>,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Pair {
    /// Both faces.
    faces: [u32; 2],
    /// A point of both, rounded.
    place: [f64; 3],
}

impl Pair {
    fn new(pair: &IntersectingPair) -> Self {
        Self { faces: pair.faces.map(|f| f.0), place: pair.place }
    }
}
