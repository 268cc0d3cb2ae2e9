//! What can be asked: the options of [`DecomposeRequest`], as every door offers them.

use crate::{Decomposition, DecompositionOptions, DegreesOfFreedom, HodgeSolver, Quality};
use pompeiu_core::request::{Limit, Report, Request};
use pompeiu_core::run::Instant;
use pompeiu_core::run::StopReason;
use pompeiu_operators::{Boundary, FieldSource, FieldSourceError, OperatorError, SourcedField, Splitting};
use pompeiu_surface::EmbeddedSurface;
use std::time::Duration;

/// Split a tangent field into a gradient, a rotated gradient and a harmonic part.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DecomposeRequest {
    /// The field to split: a file of vectors on faces, rotation:AXIS, gradient:WHAT, random:SEED or harmonic:K; without one only the
    /// degrees of freedom are counted.
    #[cfg_attr(feature = "clap", arg(long, value_name = "FIELD", allow_hyphen_values = true))]
    pub field: Option<FieldSource>,
    /// The name of the vectors in the file, if it has several.
    #[cfg_attr(feature = "clap", arg(long, value_name = "NAME"))]
    pub name: Option<String>,
    /// The kind of function whose gradients are one part.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub splitting: Splitting,
    /// The boundary condition of the harmonic part.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub boundary: Boundary,
}

impl Request for DecomposeRequest {
    const NAME: &'static str = "decompose";
    // Factorizations cannot be interrupted.
    const LIMITS: &'static [Limit] = &[];
    type Report = DecomposeReport;
}

/// Degrees of freedom of a surface, and what was measured of a decomposition on it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DecomposeReport {
    /// Number of faces.
    pub faces: usize,
    /// Number of handles.
    pub genus: usize,
    /// Number of boundary loops.
    pub boundary_loops: usize,
    /// Number of components.
    pub components: usize,
    /// How dimensions add up.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub degrees_of_freedom: DegreesOfFreedom,
    /// The decomposition; null where no field was given.
    pub decomposition: Option<DecompositionReport>,
}

/// The measures of a decomposition.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DecompositionReport {
    /// Errors and norms.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub quality: Quality,
    /// Length of the longest part of the given vectors along the normal, which was left out.
    pub normal_part: f64,
    /// Time spent.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: DecompositionTiming,
}

/// Time by the clock; milliseconds in JSON.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DecompositionTiming {
    /// Factoring both Laplacians.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub factor: Duration,
    /// Finding the harmonic fields.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub basis: Duration,
    /// Splitting the field.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub solve: Duration,
}

impl Report for DecomposeReport {
    fn stop(&self) -> StopReason {
        StopReason::Tolerance
    }
}

/// A surface whose degrees of freedom were counted, and the parts of the field, if there was one.
#[derive(Clone, Debug)]
pub struct DecomposeAnswer {
    /// The field and its parts.
    pub split: Option<(SourcedField, Decomposition)>,
    /// What is said of them.
    pub report: DecomposeReport,
}

/// Why a field cannot be decomposed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DecomposeError {
    /// Vectors of a file are named, but no file.
    #[error("`name` chooses vectors of a file, but no field is given")]
    NoField,
    /// The surface cannot be prepared.
    #[error(transparent)]
    Surface(OperatorError),
    /// The field cannot be made.
    #[error(transparent)]
    Source(#[from] FieldSourceError),
    /// The field cannot be split.
    #[error(transparent)]
    Field(OperatorError),
}

impl DecomposeRequest {
    /// Counts the degrees of freedom of a surface, and splits the field, if there is one; `read` are the vectors of its file.
    ///
    /// # Errors
    /// [`DecomposeError`].
    pub fn run(
        &self,
        surface: &EmbeddedSurface,
        read: Option<&[[f64; 3]]>,
    ) -> Result<DecomposeAnswer, DecomposeError> {
        if self.name.is_some() && self.field.is_none() {
            return Err(DecomposeError::NoField);
        }
        let mesh = surface.mesh();
        let mut report = DecomposeReport {
            faces: mesh.faces(),
            genus: mesh.genus(),
            boundary_loops: mesh.boundary_loops().len(),
            components: mesh.components(),
            degrees_of_freedom: DegreesOfFreedom::of(mesh, self.boundary),
            decomposition: None,
        };
        let Some(source) = &self.field else { return Ok(DecomposeAnswer { split: None, report }) };
        let options = DecompositionOptions { splitting: self.splitting, boundary: self.boundary };
        let solver = HodgeSolver::new(surface.surface(), &options).map_err(DecomposeError::Surface)?;
        let found = source.field(surface, solver.basis().fields(), read)?;
        let before = Instant::now();
        let parts = solver.decompose(&found.field).map_err(DecomposeError::Field)?;
        let times = solver.setup_times();
        report.decomposition = Some(DecompositionReport {
            quality: parts.quality,
            normal_part: found.normal_part,
            timing: DecompositionTiming { factor: times.factor, basis: times.basis, solve: before.elapsed() },
        });
        Ok(DecomposeAnswer { split: Some((found, parts)), report })
    }
}
