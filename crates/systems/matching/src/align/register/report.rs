//! The result of a registration, with measures of its reliability.

use super::super::{Matrix, affine};
use super::settings::TransformSettings;
use pompeiu_core::mesh::Affine;
use pompeiu_core::run::StopReason;
use serde::Serialize;

/// The pose of a mesh on another. Nothing is proven about it; the distance of the mesh as moved can be certified.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Registration {
    /// The map as four rows that act on columns `(x, y, z, 1)`.
    pub matrix: Matrix,
    /// The scale; 1 unless it was requested.
    pub scale: f64,
    /// One standard deviation of the scale, if it was requested: its scatter if the distances of the samples were independent
    /// errors. If they are not independent, it may scatter more.
    pub scale_deviation: Option<f64>,
    /// The angle of its rotation, in degrees.
    pub turn_degrees: f64,
    /// The length up to which points count as matched.
    pub reach: f64,
    /// The share of the area of the moved mesh that is matched.
    pub matched: f64,
    /// Root mean square distance of the matched points, relative to `reach`: at most about 0.3 for surfaces that coincide up to
    /// noise, about 0.45 for surfaces that merely intersect.
    pub spread: f64,
    /// Whether the surfaces coincide where they are matched, and enough of the area is matched: at least a fifth, with a spread of
    /// at most 0.4 and a reach of at most 5 % of the diagonal of the smaller mesh. If false, the shapes differ, or their common
    /// part is too small to be found.
    pub fits: bool,
    /// Root mean square distance of the points that determine the fit: the requested share, or those within four standard
    /// deviations.
    pub rms: f64,
    /// Other poses that fit nearly as well, best first; symmetric shapes have them.
    pub alternatives: Vec<Alternative>,
    /// Motions that leave the fit unchanged.
    pub free_motions: Vec<FreeMotion>,
    /// The reason for which it ended.
    pub stop: StopReason,
}

/// Another pose.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Alternative {
    /// The map as four rows.
    pub matrix: Matrix,
    /// The angle between its rotation and that of the best map, in degrees.
    pub apart_degrees: f64,
    /// The axis of the rotation from the best pose to this one, of length 1; zero if there is no rotation.
    pub axis: [f64; 3],
    /// A point of that axis.
    pub point: [f64; 3],
    /// The translation along the axis; if there is no rotation, the length of the translation.
    pub slide: f64,
    /// The share of the area that is matched, with the same reach.
    pub matched: f64,
    /// Root mean square distance of the points that determine the fit.
    pub rms: f64,
}

/// A motion after the map that leaves the fit unchanged up to second order: a rotation about an axis and a translation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FreeMotion {
    /// A point of the axis.
    pub point: [f64; 3],
    /// The rotation vector: its direction is the axis, its length the angle in radians.
    pub turn: [f64; 3],
    /// The translation.
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

    /// Whether the mesh fits, the pose is clearly better than all others tried, and there are no free motions.
    pub fn is_unique(&self) -> bool {
        self.fits && self.alternatives.is_empty() && self.free_motions.is_empty()
    }
}
