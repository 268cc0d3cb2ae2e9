//! What an alignment found, and how sure it is.

use super::super::{Matrix, affine};
use super::settings::TransformSettings;
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
    /// One standard deviation of that factor, if it was asked for: by how much it would scatter if the distances of the samples that the
    /// fit rests on were errors that do not depend on each other. What is not known to be independent may scatter more.
    pub scale_deviation: Option<f64>,
    /// The angle of its rotation, in degrees.
    pub turn_degrees: f64,
    /// The length up to which points count as matched.
    pub reach: f64,
    /// The share of the area of the moved mesh that is matched.
    pub matched: f64,
    /// Root mean square distance of what is matched, as a share of `reach`: at most about 0.3 where surfaces lie on each other but for
    /// noise, about 0.45 where they merely cross.
    pub spread: f64,
    /// Whether the surfaces lie on each other where they are matched, and enough of the area is: a fifth is matched at least, the spread
    /// is at most 0.4, and the reach at most 5 % of the diagonal of the smaller mesh. Where it is false, the shapes are different ones,
    /// or have less in common than can be found.
    pub fits: bool,
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
    /// The turn that leads from the best place to this one: the direction of its axis, of length 1; zero where there is no turn.
    pub axis: [f64; 3],
    /// A point of that axis.
    pub point: [f64; 3],
    /// How far it slides along the axis meanwhile; where there is no turn, how far it slides.
    pub slide: f64,
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
    /// The map.
    pub fn map(&self) -> Affine {
        affine(&self.matrix)
    }

    /// The map for `ParaView`'s filter "Transform".
    pub fn transform_settings(&self) -> TransformSettings {
        TransformSettings::of(&self.matrix, self.scale)
    }

    /// Whether it fits, one place fits better than all others that were tried, and no motion is free.
    pub fn is_unique(&self) -> bool {
        self.fits && self.alternatives.is_empty() && self.free_motions.is_empty()
    }
}
