//! Boundary ratios: lengths of inscribed polygons relative to the outline.

use super::sampling::{Samples, closed_length};
use pompeiu_planar::Outline;

/// `B_m`: the length of the closed polygon through m points at equal arc lengths along the outline, divided by the length of the
/// outline. At most 1, and less where detail is lost, so small values are complex.
///
/// The points begin at the corner farthest from the mean of the curve. A circle has `(m/π) sin(π/m)`.
///
/// # Source
/// `chambers_exploring_2018`, which does not state where the points begin.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Boundary {
    /// With 500 points.
    #[cfg_attr(feature = "serde", serde(rename = "500"))]
    pub m500: f64,
    /// With 100 points.
    #[cfg_attr(feature = "serde", serde(rename = "100"))]
    pub m100: f64,
    /// With 50 points.
    #[cfg_attr(feature = "serde", serde(rename = "50"))]
    pub m50: f64,
    /// With 25 points.
    #[cfg_attr(feature = "serde", serde(rename = "25"))]
    pub m25: f64,
    /// With 8 points.
    #[cfg_attr(feature = "serde", serde(rename = "8"))]
    pub m8: f64,
    /// The mean of the five.
    pub mean: f64,
}

impl Boundary {
    pub(super) fn of(outline: &Outline, samples: &Samples) -> Self {
        let length = outline.length();
        let ratio = |count: usize| closed_length(&samples.again(outline, count)) / length;
        let [m500, m100, m50, m25, m8] = [500, 100, 50, 25, 8].map(ratio);
        Self { m500, m100, m50, m25, m8, mean: (m500 + m100 + m50 + m25 + m8) / 5.0 }
    }
}
