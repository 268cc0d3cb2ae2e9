//! Measured quantities of a step.

use std::time::Instant;

/// A step that was accepted.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ContactStep {
    /// Time since the start.
    pub time: f64,
    /// Newton iterations.
    pub iterations: usize,
    /// Pairs that continuous collision detection looked at, in all iterations.
    pub moving_pairs: usize,
    /// Pairs that push at the end.
    pub pairs: usize,
    /// The least distance of two surfaces closer than the distance of contact; none where there is none.
    pub least_gap: Option<f64>,
    /// The stiffness κ of barriers.
    pub stiffness: f64,
    /// The least part of a Newton step that continuous collision detection let through.
    pub least_part: f64,
    /// The sum of the forces of barriers of fixed obstacles on what moves.
    pub support: [f64; 3],
    /// The momentum.
    pub momentum: [f64; 3],
    /// The angular momentum about the origin.
    pub angular_momentum: [f64; 3],
    /// The kinetic energy.
    pub kinetic_energy: f64,
    /// The elastic energy.
    pub elastic_energy: f64,
    /// The energy of gravity, 0 at the start.
    pub potential_energy: f64,
    /// Pairs of faces that the exact test finds intersecting: 0, or none where it did not run.
    pub intersections: Option<usize>,
}

/// Milliseconds by the clock that parts of all steps took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ContactTiming {
    /// Pairs of surfaces that may meet, by a tree over moving boxes.
    pub search: f64,
    /// Continuous collision detection of these pairs.
    pub collision_detection: f64,
    /// Derivatives, and the solution of linear systems.
    pub newton: f64,
    /// Energies in line searches.
    pub line_search: f64,
    /// The exact test for intersections.
    pub exact_test: f64,
}

/// Milliseconds since then.
pub(crate) fn since(started: Instant) -> f64 {
    started.elapsed().as_nanos() as f64 / 1e6
}
