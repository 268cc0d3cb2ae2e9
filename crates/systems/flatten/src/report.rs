//! The report of a map.

use crate::Distortion;
use pompeiu_core::run::StopReason;
use std::time::Duration;

/// The report of a map: whether it is one-to-one, decided exactly on the coordinates as stored, and its distortion.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FlattenReport {
    /// Number of charts: connected components of the map.
    pub charts: usize,
    /// Number of faces that are flipped or degenerate in the map.
    pub flipped: usize,
    /// Number of faces that overlap another face. If no face is flipped or overlaps, the map is one-to-one.
    pub overlapping: usize,
    /// Number of pairs of boundary edges of the map that cross or touch.
    pub outline_crossings: usize,
    /// Number of boundary loops of the opened surface.
    pub boundary_loops: usize,
    /// The cut.
    pub cut: CutReport,
    /// The kind of map: `"free"` or `"convex"`.
    pub method: &'static str,
    /// The weights of the convex combination map, which is the result or the initial map.
    pub weights: &'static str,
    /// Number of changes of weights against nearly degenerate faces, over all charts.
    pub reweightings: usize,
    /// Number of Newton steps, over all charts.
    pub steps: usize,
    /// The reason for which the computation ended.
    pub stop: StopReason,
    /// The distortion of the map.
    pub distortion: Distortion,
    /// The report of each chart, in the order of their first faces.
    pub parts: Vec<PartReport>,
    /// Time spent on each part.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: Timing,
}

impl FlattenReport {
    /// Whether the map is one-to-one.
    pub fn is_one_to_one(&self) -> bool {
        self.flipped == 0 && self.overlapping == 0
    }
}

/// The report of one chart.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PartReport {
    /// The first of its faces, which identifies it.
    pub first_face: u32,
    /// Number of its faces.
    pub faces: usize,
    /// Number of faces that are flipped or degenerate in the map.
    pub flipped: usize,
    /// Number of faces that overlap another face.
    pub overlapping: usize,
    /// Number of cut edges on its outline.
    pub cut_edges: usize,
    /// Their length, in the unit of the mesh; an edge with the chart on both sides counts once.
    pub cut_length: f64,
    /// The weights of the convex combination map, which is the result or the initial map.
    pub weights: &'static str,
    /// Number of changes of weights against nearly degenerate faces.
    pub reweightings: usize,
    /// Number of Newton steps.
    pub steps: usize,
    /// The distortion of the map, at the best scale for this chart.
    pub distortion: Distortion,
}

/// The cut.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CutReport {
    /// Number of edges.
    pub edges: usize,
    /// Their length, in the unit of the mesh.
    pub length: f64,
    /// Their length over the square root of the area.
    pub relative_length: f64,
    /// The strategy.
    pub strategy: &'static str,
}

/// Time spent on each part, summed over charts; milliseconds in JSON.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Timing {
    /// Choosing edges and opening the surface.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub cut: Duration,
    /// Assembling and factoring linear systems.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub factor: Duration,
    /// Solving them, and line searches.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub solve: Duration,
    /// Checking and measuring.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub check: Duration,
    /// Wall-clock time of the whole computation.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub total: Duration,
}

impl Timing {
    pub(crate) fn add(&mut self, other: &Self) {
        self.cut += other.cut;
        self.factor += other.factor;
        self.solve += other.solve;
        self.check += other.check;
    }
}
