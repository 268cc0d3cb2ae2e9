//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::{line, milliseconds};
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    let mesh = outcome.opened.mesh();
    line(&Json {
        path: &outcome.path,
        vertices: mesh.vertices(),
        faces: mesh.faces(),
        components: mesh.components(),
        cut: Cut { edges: outcome.edges, length: outcome.length, strategy: outcome.strategy },
        euler_characteristic: mesh.euler_characteristic(),
        boundary_loops: mesh.boundary_loops().len(),
        vertex_map: outcome.opened.vertex_map().iter().map(|v| v.0).collect(),
        timing_ms: Timing { total: milliseconds(outcome.total) },
    })
}

/// The answer of `pompeiu cut --json`: the surface after the cut. Lengths are in the unit of the file.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "CutAnswer"))]
pub(crate) struct Json<'o> {
    /// The path as it was given.
    path: &'o str,
    /// Number of vertices.
    vertices: usize,
    /// Number of faces.
    faces: usize,
    /// Number of connected parts, each of them a disk.
    components: usize,
    cut: Cut,
    /// Vertices minus edges plus faces: 1 for each disk.
    euler_characteristic: isize,
    /// Number of boundary loops: 1 for each disk.
    boundary_loops: usize,
    /// For each vertex the vertex of the input that it is a copy of, vertices without faces not counted; those that a straightened cut
    /// made follow behind.
    vertex_map: Vec<u32>,
    timing_ms: Timing,
}

/// What was cut.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Cut {
    /// Number of edges.
    edges: usize,
    /// Their length.
    length: f64,
    /// How they were chosen.
    strategy: &'static str,
}

/// Milliseconds.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Timing {
    /// From reading to the result.
    total: f64,
}
