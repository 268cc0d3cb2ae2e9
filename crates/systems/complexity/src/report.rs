//! The report of an analysis.

use crate::{Agreement, Clusters, Measures};
use pompeiu_core::run::StopReason;
use std::fmt;
use std::time::Duration;

/// The report of an analysis.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComplexityReport {
    /// The shapes, in the order they were given.
    pub shapes: Vec<ShapeReport>,
    /// The measure used for ranking.
    pub ranked_by: String,
    /// The shapes from the simplest to the most complex.
    pub ranking: Vec<RankedShape>,
    /// The agreement with the other ranking.
    pub agreement: Option<Agreement>,
    /// Clusters of similar shapes, if requested and all shapes were measured.
    pub clusters: Option<Clusters>,
    /// Files that cannot be used.
    pub failed: Vec<FailedShape>,
    /// Parts of pictures beside the largest one, which are not measured: a sentence for each picture.
    pub left_out: Vec<String>,
    /// The reason for which the computation ended.
    pub stop: StopReason,
    /// Time spent on each part.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: Timing,
}

impl ComplexityReport {
    /// A report without shapes.
    pub(crate) fn empty(ranked_by: &str, stop: StopReason) -> Self {
        Self {
            shapes: Vec::new(),
            ranked_by: ranked_by.to_owned(),
            ranking: Vec::new(),
            agreement: None,
            clusters: None,
            failed: Vec::new(),
            left_out: Vec::new(),
            stop,
            timing: Timing::default(),
        }
    }
}

/// A file that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FailedShape {
    /// The file or folder.
    pub path: String,
    /// The defect, in one sentence.
    pub message: String,
}

impl fmt::Display for FailedShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path, self.message)
    }
}

/// A shape and its measures.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ShapeReport {
    /// Its file or another name; for one of several shapes in a drawing followed by `#` and its id, or its place from 1.
    pub file: String,
    /// Number of corners of its outline.
    pub outline_points: usize,
    /// The length of its outline, in the unit of the outline.
    pub length: f64,
    /// Its area, holes included, in that unit squared.
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
    /// Its rank; 1 is the simplest. Shapes whose values agree to ten digits share the mean of their ranks.
    pub rank: f64,
    /// The value of the measure.
    pub value: f64,
    /// Its rank in the other ranking.
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
