//! What an alignment found, and how sure it is.

use super::super::{Matrix, affine};
use pompeiu_core::mesh::Affine;
use pompeiu_core::run::StopReason;
use serde::Serialize;

/// Where a mesh belongs on another. Nothing of it is proven: the distance of the mesh as moved can be.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Registration {
    /// The map as four rows that act on columns `(x, y, z, 1)`.
    pub matrix: Matrix,
    /// The factor by which it scales; 1 unless a scale was asked for.
    pub scale: f64,
    /// The angle of its rotation, in degrees.
    pub turn_degrees: f64,
    /// The length up to which points count as matched.
    pub reach: f64,
    /// The share of the area of the moved mesh that is matched.
    pub matched: f64,
    /// Root mean square distance of the points that the fit rests on: the share asked for, or those within four standard deviations.
    pub rms: f64,
    /// Other places that fit nearly as well, the best first: a symmetric shape has them.
    pub alternatives: Vec<Alternative>,
    /// Motions that leave the fit as it is.
    pub free_motions: Vec<FreeMotion>,
    /// Why it ended.
    pub stop: StopReason,
}

/// Another place.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Alternative {
    /// The map as four rows.
    pub matrix: Matrix,
    /// The angle between its rotation and that of the best map, in degrees.
    pub apart_degrees: f64,
    /// The share of the area that is matched, up to the same length.
    pub matched: f64,
    /// Root mean square distance of the points that the fit rests on.
    pub rms: f64,
}

/// A motion after the map that leaves the fit as it is, up to second order: a turn about an axis and a shift.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FreeMotion {
    /// A point of the axis.
    pub point: [f64; 3],
    /// The turn: its direction is the axis, its length the angle in radians.
    pub turn: [f64; 3],
    /// The shift.
    pub shift: [f64; 3],
}

impl Registration {
    /// Least share of the area that must be matched for a place to be trusted.
    pub const LEAST_MATCHED: f64 = 0.2;

    /// The map.
    pub fn map(&self) -> Affine {
        affine(&self.matrix)
    }

    /// Whether one place fits better than all others that were tried, and no motion is free.
    pub fn is_unique(&self) -> bool {
        self.matched >= Self::LEAST_MATCHED && self.alternatives.is_empty() && self.free_motions.is_empty()
    }
}
