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

/// Options of the measures.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasureOptions {
    /// Standard deviation of the Gaussian that smooths the points before curvature is computed, as a share of the length of the
    /// outline; 0 for none. With the default, the steps of a staircase of about 200 × 200 pixels do not count as corners.
    pub smoothing: f64,
}

impl Default for MeasureOptions {
    fn default() -> Self {
        Self { smoothing: 0.004 }
    }
}

/// Largest standard deviation of the smoothing, as a share of the length.
const MOST_SMOOTHING: f64 = 0.25;

/// All measures of an outline.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Measures {
    /// Lengths of inscribed polygons relative to the outline.
    pub boundary: Boundary,
    /// Turning angles and curvature.
    pub curvature: Curvature,
    /// The medial axis.
    pub skeleton: Skeleton,
    /// Moments of the area.
    pub moments: Moments,
    /// The area relative to that of simple enclosing shapes.
    pub coverage: Coverage,
    /// Measures of the whole shape.
    pub global: Global,
}

impl Measures {
    /// Computes all measures of an outline.
    ///
    /// # Errors
    /// [`ComplexityError::Option`] for a smoothing that is negative, or more than a quarter of the length.
    ///
    /// # Cost
    /// Linear in the number n of corners, n log n for the convex hull, and a Delaunay triangulation of 500 points.
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
