//! Measured quantities of a step.

/// A step that was accepted.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ContactStep {
    /// Time since the start.
    pub time: f64,
    /// Newton iterations.
    pub iterations: usize,
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
    /// Pairs of faces that the exact test finds intersecting: 0, or none where it did not run.
    pub intersections: Option<usize>,
}
