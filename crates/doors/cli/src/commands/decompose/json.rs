//! What the splitting found, as one JSON object.

use super::text::Report;
use crate::json::{line, milliseconds};
use pompeiu::fields::{DegreesOfFreedom, Quality};
use serde::Serialize;

impl Report {
    /// The report on one line.
    pub(super) fn json(&self) -> serde_json::Result<String> {
        line(&Json {
            path: &self.path,
            faces: self.faces,
            genus: self.genus,
            boundary_loops: self.boundary_loops,
            components: self.components,
            degrees_of_freedom: self.degrees_of_freedom,
            quality: self.split.as_ref().map(|split| split.quality),
            timing_ms: self.split.as_ref().map(|split| Timing {
                factor: milliseconds(split.factor),
                solve: milliseconds(split.solve),
                basis: milliseconds(split.basis),
                total: milliseconds(split.total),
            }),
        })
    }
}

/// The answer of `pompeiu decompose --json`. What is measured of a splitting is absent where no field was given.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Decompose"))]
pub(crate) struct Json<'r> {
    /// The path as it was given.
    path: &'r str,
    /// Number of faces.
    faces: usize,
    /// Number of handles.
    genus: usize,
    /// Number of boundary loops.
    boundary_loops: usize,
    /// Number of components.
    components: usize,
    #[serde(flatten)]
    degrees_of_freedom: DegreesOfFreedom,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    quality: Option<Quality>,
    #[serde(skip_serializing_if = "Option::is_none")]
    timing_ms: Option<Timing>,
}

/// Milliseconds spent on each part.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Timing {
    /// Factoring both Laplacians.
    factor: f64,
    /// Splitting the field.
    solve: f64,
    /// Finding the harmonic fields.
    basis: f64,
    total: f64,
}
