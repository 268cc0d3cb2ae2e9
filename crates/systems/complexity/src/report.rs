//! What is said of many shapes.

use crate::{Agreement, Clusters, Measures};
use pompeiu_core::run::StopReason;
use std::time::Duration;

/// What is said of many shapes.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComplexityReport {
    /// The shapes, in the order they were given.
    pub shapes: Vec<ShapeReport>,
    /// The measure that ranks them.
    pub ranked_by: String,
    /// The shapes from the simplest to the most complex.
    pub ranking: Vec<RankedShape>,
    /// How far the ranking agrees with the one it is compared with.
    pub agreement: Option<Agreement>,
    /// Clusters of like shapes, if asked for.
    pub clusters: Option<Clusters>,
    /// Why the computation ended.
    pub stop: StopReason,
    /// Time spent on each part.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: Timing,
}

/// A shape and its measures.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ShapeReport {
    /// Its file, or whatever else it is called.
    pub file: String,
    /// Corners of its outline.
    pub outline_points: usize,
    /// The length of its outline, in its own unit.
    pub length: f64,
    /// Its area without holes taken out, in its own unit squared.
    pub area: f64,
    /// Its measures.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub measures: Measures,
}

/// A shape in a ranking.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RankedShape {
    /// Its file.
    pub file: String,
    /// Its place; 1 is the simplest. Shapes with the same value, to ten digits, share the mean of their places.
    pub rank: f64,
    /// The value of the measure.
    pub value: f64,
    /// Its place in the ranking that this one is compared with.
    pub against: Option<f64>,
}

/// Time spent on each part; milliseconds in JSON.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Timing {
    /// Measuring.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub measures: Duration,
    /// Ranking and comparing.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub ranking: Duration,
    /// Clustering.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub clusters: Duration,
}
