//! Filling a closed surface with balls.

use crate::{Ball, Deviation, Medial, MedialError, MedialOptions, medial_balls};
use pompeiu_core::request::{Limit, Report, Request};
use pompeiu_core::run::{RunContext, StopReason};
use pompeiu_surface::EmbeddedSurface;
use std::num::NonZeroUsize;
use std::time::Duration;

/// Fill a closed surface with few balls, and bound how far they are from it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MedialRequest {
    /// Number of balls; fewer are left if so many cannot be told apart.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub balls: NonZeroUsize,
    /// Points of the surface from which balls are shrunk.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub samples: NonZeroUsize,
    /// Width of the interval of the distance from the surface to the balls, over the diagonal of the box around the surface.
    #[cfg_attr(feature = "clap", arg(long, value_name = "SHARE"))]
    pub tolerance: f64,
}

impl Default for MedialRequest {
    fn default() -> Self {
        let MedialOptions { balls, samples, tolerance, .. } = MedialOptions::default();
        Self { balls, samples, tolerance }
    }
}

impl Request for MedialRequest {
    const NAME: &'static str = "medial";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time];
    type Report = MedialReport;
}

/// Balls in a surface, and how far they are from it. Lengths are in the unit of the mesh.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MedialReport {
    /// The balls.
    pub balls: Vec<Ball>,
    /// Pairs of balls that lie beside each other along the medial axis, counted from 0.
    pub edges: Vec<[u32; 2]>,
    /// Pairs of balls that overlap.
    pub overlaps: Vec<[u32; 2]>,
    /// Balls that were shrunk from points of the surface, before they were replaced by fewer ones.
    pub shrunk: usize,
    /// The distance between balls and surface.
    pub deviation: Deviation,
    /// The reason for which it stopped.
    pub stop: StopReason,
    /// Time spent, in milliseconds.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: MedialTiming,
}

/// Time by the clock; milliseconds in JSON.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MedialTiming {
    /// Finding and measuring the balls.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub medial: Duration,
}

impl Report for MedialReport {
    fn stop(&self) -> StopReason {
        self.stop
    }
}

impl From<&Medial> for MedialReport {
    fn from(found: &Medial) -> Self {
        Self {
            balls: found.balls.clone(),
            edges: found.edges.clone(),
            overlaps: found.overlaps(),
            shrunk: found.shrunk,
            deviation: found.deviation,
            stop: found.stop,
            timing: MedialTiming { medial: found.time },
        }
    }
}

impl MedialRequest {
    /// Fills a surface.
    ///
    /// # Errors
    /// [`MedialError`].
    pub fn run(&self, surface: &EmbeddedSurface, context: &RunContext<'_>) -> Result<Medial, MedialError> {
        let &Self { balls, samples, tolerance } = self;
        medial_balls(surface, &MedialOptions { balls, samples, tolerance, limits: context.limits() })
    }
}
