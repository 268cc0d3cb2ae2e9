//! The measures of one outline.

mod boundary;
mod coverage;
mod curvature;
mod moments;
pub(crate) mod names;
mod sampling;
mod skeleton;

pub use boundary::Boundary;
pub use coverage::{Coverage, Global};
pub use curvature::Curvature;
pub use moments::Moments;
pub use names::{Direction, Measure};
pub use skeleton::Skeleton;

use crate::ComplexityError;
use pompeiu_planar::Outline;
use sampling::Samples;

/// How an outline is measured.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasureOptions {
    /// Standard deviation of the Gaussian that smooths the points which curvature is taken from, as a share of the length of the outline;
    /// 0 for none. The default is wide enough that the pixels of a picture some 200 across do not count as corners.
    pub smoothing: f64,
}

impl Default for MeasureOptions {
    fn default() -> Self {
        Self { smoothing: 0.004 }
    }
}

/// The greatest share of the length over which curvature may be smoothed.
const MOST_SMOOTHING: f64 = 0.25;

/// All measures of an outline.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Measures {
    /// Lengths of coarser polygons over the length of the outline.
    pub boundary: Boundary,
    /// How the outline turns.
    pub curvature: Curvature,
    /// The medial axis.
    pub skeleton: Skeleton,
    /// Moments of the area.
    pub moments: Moments,
    /// How much of simple shapes around it the outline fills.
    pub coverage: Coverage,
    /// The shape as a whole.
    pub global: Global,
}

impl Measures {
    /// Measures an outline.
    ///
    /// # Errors
    /// [`ComplexityError::Option`] for a smoothing that is negative, or more than a quarter of the length.
    ///
    /// # Cost
    /// n for an outline of n corners, n log n for its hull, and a Delaunay triangulation of 500 points.
    pub fn of(outline: &Outline, options: &MeasureOptions) -> Result<Self, ComplexityError> {
        let smoothing = options.smoothing;
        if !(0.0..=MOST_SMOOTHING).contains(&smoothing) {
            return Err(ComplexityError::Option {
                what: "smoothing",
                value: smoothing,
                expected: "it must be a share of the length from 0 to 0.25",
            });
        }
        let samples = Samples::of(outline);
        Ok(Self {
            boundary: Boundary::of(outline, &samples),
            curvature: Curvature::of(&samples, smoothing),
            skeleton: Skeleton::of(outline, &samples),
            moments: Moments::of(outline),
            coverage: Coverage::of(outline),
            global: Global::of(outline),
        })
    }
}
