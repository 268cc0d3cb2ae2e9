//! What is said about an area as a whole.

use super::bands::Extreme;
use super::distribution::Measured;
use super::distribution::level;
use super::entry::{Moments, Sum};
use super::linear::{greater, lesser};
use super::options::DeviationOptions;
use crate::report::Enclosure;
use pompeiu_core::exact::Interval;
use pompeiu_core::geom::Frame;

/// Statistics of the distance over an area, each with an enclosure of its exact value.
///
/// # Definition
/// With `F(t)` the share of the area whose distance from the other mesh is at most `t`: the mean is that over the area, `rms` the
/// root of the mean of the square, the percentile of a share `q` is `inf { t : F(t) >= q }`, and the area above a threshold
/// `t` has the share `1 - F(t)`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Statistics {
    /// The area, rounded, in the square of the unit of the meshes; infinite where that is too large for a double.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub area: f64,
    /// Mean distance.
    pub mean: Enclosure,
    /// Root of the mean squared distance.
    pub rms: Enclosure,
    /// In the order asked for.
    pub percentiles: Vec<Percentile>,
    /// The share of the area farther than the threshold, if one was given.
    #[cfg_attr(
        feature = "serde",
        serde(
            rename = "share_above_threshold",
            serialize_with = "share_alone",
            skip_serializing_if = "Option::is_none"
        )
    )]
    #[cfg_attr(feature = "schema", schemars(with = "Option<Enclosure>"))]
    pub above: Option<ShareAbove>,
    /// The share of the area in each range of distances.
    pub histogram: Histogram,
}

/// Serialises the share alone: the threshold stands beside what was asked.
#[cfg(feature = "serde")]
#[allow(clippy::ref_option, reason = "serde hands a reference to the field")]
fn share_alone<S: serde::Serializer>(above: &Option<ShareAbove>, serializer: S) -> Result<S::Ok, S::Error> {
    serde::Serialize::serialize(&above.map(|above| above.share), serializer)
}

/// Statistics of the signed distance over an area: negative inside the other mesh, positive outside. All points of all faces count.
///
/// # Definition
/// Inside is where the magnitude of the winding number of the other mesh, which is closed and oriented, is above one half. The standard deviation
/// is the root of the mean squared distance from the mean.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SignedStatistics {
    /// Encloses the mean.
    pub mean: Extreme,
    /// Encloses the standard deviation.
    pub standard_deviation: Enclosure,
    /// Encloses the least signed distance: the most inside.
    pub lowest: Extreme,
    /// Encloses the greatest signed distance: the most outside.
    pub highest: Extreme,
}

/// The distance that a share of the area does not exceed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Percentile {
    /// The share, between 0 and 1.
    pub share: f64,
    /// Encloses the distance.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub distance: Enclosure,
}

/// How much of an area is farther than a threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShareAbove {
    /// The threshold, a length.
    pub threshold: f64,
    /// Encloses the share of the area, between 0 and 1.
    pub share: Enclosure,
}

/// Shares of an area by distance: bins of one width from zero to about the largest distance.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Histogram {
    /// Ends of the bins: one more than there are bins.
    pub edges: Vec<f64>,
    /// The share of the area with a distance above the lower end of the bin and up to its upper end; zero counts into the first
    /// bin.
    pub bins: Vec<Enclosure>,
    /// The share of the area up to each of the ends.
    pub cumulative: Vec<Enclosure>,
}

impl Histogram {
    /// Number of bins.
    pub fn len(&self) -> usize {
        self.bins.len()
    }

    /// Whether there are no bins, which only happens when none were asked for.
    pub fn is_empty(&self) -> bool {
        self.bins.is_empty()
    }
}

/// What to compute.
#[derive(Clone, Debug)]
pub(super) struct StatisticsQuery<'w> {
    pub(super) percentiles: &'w [f64],
    /// In the frame.
    pub(super) threshold: Option<f64>,
    /// Part of a percentile up to which it is looked for: far less than its enclosure is wide.
    pub(super) fine: f64,
}

impl<'w> StatisticsQuery<'w> {
    pub(super) fn of(query: &'w DeviationOptions<'_>, frame: &Frame) -> Self {
        Self {
            percentiles: &query.percentiles,
            threshold: query.threshold.map(|t| frame.length_in(t)),
            fine: Self::FINE * query.accuracy,
        }
    }

    /// See [`StatisticsQuery::fine`], as a part of the accuracy.
    const FINE: f64 = 0.1;
}

/// The same in the frame, for deciding what to refine.
#[derive(Clone, Debug)]
pub(super) struct Summary {
    pub(super) sums: Moments,
    pub(super) area: Interval,
    pub(super) mean: (f64, f64),
    pub(super) rms: (f64, f64),
    pub(super) percentiles: Vec<(f64, f64)>,
    pub(super) above: Option<(f64, f64)>,
}

impl Summary {
    /// None where the area may be zero.
    pub(super) fn of(pieces: &dyn Measured, asked: &StatisticsQuery<'_>, largest: f64) -> Option<Self> {
        Self::with(pieces.moments(), pieces, asked, largest, None)
    }

    /// The same of pieces whose moments are known, and its percentiles perhaps.
    pub(super) fn with(
        sums: Moments,
        pieces: &dyn Measured,
        asked: &StatisticsQuery<'_>,
        largest: f64,
        percentiles: Option<Vec<(f64, f64)>>,
    ) -> Option<Self> {
        let area = sums.area.enclosure();
        if area.lower() <= 0.0 {
            return None;
        }
        let quotient = |sum: Interval| sum.divide_by_positive(area);
        let mean = quotient(sums.first.enclosure());
        let rms = quotient(sums.second.enclosure()).sqrt();
        let mean = (greater(mean.lower(), 0.0), lesser(mean.upper(), largest));
        // The root of a mean of squares is at least the mean.
        let rms = (greater(rms.lower(), mean.0), lesser(rms.upper(), largest));
        let percentiles =
            percentiles.unwrap_or_else(|| pieces.percentiles(asked.percentiles, area, largest, asked.fine));
        let above = asked.threshold.map(|t| share_above(pieces, t, area, largest));
        Some(Self { sums, area, mean, rms, percentiles, above })
    }

    /// For users. `areas` are those up to the ends of the bins ([`Measured::cumulative`]).
    pub(super) fn publish(
        &self,
        areas: &[Sum],
        asked: &StatisticsQuery<'_>,
        threshold: Option<f64>,
        largest: f64,
        frame: &Frame,
    ) -> Statistics {
        let length = |(low, high)| length_out(frame, low, high);
        let percentiles = asked.percentiles.iter().zip(&self.percentiles);
        Statistics {
            area: frame.length_out(frame.length_out(0.5 * (self.area.lower() + self.area.upper()))),
            mean: length(self.mean),
            rms: length(self.rms),
            percentiles: percentiles
                .map(|(share, ends)| Percentile { share: *share, distance: length(*ends) })
                .collect(),
            above: threshold
                .zip(self.above)
                .map(|(threshold, ends)| ShareAbove { threshold, share: share_of(ends) }),
            histogram: histogram(areas, self.area, largest, frame),
        }
    }
}

/// Whether an enclosure is as narrow as asked, or as widths that always suffice.
pub(super) fn is_narrow((low, high): (f64, f64), accuracy: f64, floor: f64) -> bool {
    high - low <= accuracy * low + floor
}

fn share_above(pieces: &dyn Measured, threshold: f64, area: Interval, largest: f64) -> (f64, f64) {
    if threshold >= largest {
        return (0.0, 0.0);
    }
    let up_to = share_up_to(pieces.area_up_to(threshold), area);
    (greater((1.0 - up_to.1).next_down(), 0.0), lesser((1.0 - up_to.0).next_up(), 1.0))
}

fn share_up_to(part: Interval, area: Interval) -> (f64, f64) {
    let share = part.divide_by_positive(area);
    (lesser(greater(share.lower(), 0.0), 1.0), lesser(share.upper(), 1.0))
}

fn histogram(areas: &[Sum], area: Interval, largest: f64, frame: &Frame) -> Histogram {
    let Some(bins) = areas.len().checked_sub(1) else {
        return Histogram { edges: Vec::new(), bins: Vec::new(), cumulative: Vec::new() };
    };
    let mut cumulative: Vec<_> = areas.iter().map(|part| share_up_to(part.enclosure(), area)).collect();
    // Nothing is farther than the largest distance.
    cumulative[bins] = (1.0, 1.0);
    let between = |k: usize| {
        let (from, to) = (cumulative[k], cumulative[k + 1]);
        if k == 0 {
            return to;
        }
        (greater((to.0 - from.1).next_down(), 0.0), greater((to.1 - from.0).next_up(), 0.0))
    };
    Histogram {
        edges: (0..=bins).map(|k| frame.length_out(level(largest, k, bins))).collect(),
        bins: (0..bins).map(|k| share_of(between(k))).collect(),
        cumulative: cumulative.iter().map(|ends| share_of(*ends)).collect(),
    }
}

pub(super) fn share_of((low, high): (f64, f64)) -> Enclosure {
    ordered(greater(low, 0.0), lesser(high, 1.0))
}

/// A length of the frame in the unit of the meshes: scaling rounds only among subnormal numbers, and a step covers that.
pub(super) fn length_out(frame: &Frame, low: f64, high: f64) -> Enclosure {
    let (low, high) = (frame.length_out(low), frame.length_out(high));
    let low = if low < f64::MIN_POSITIVE && low > 0.0 { low.next_down() } else { low };
    let high = if high < f64::MIN_POSITIVE && high > 0.0 { high.next_up() } else { high };
    ordered(low, high)
}

fn ordered(low: f64, high: f64) -> Enclosure {
    debug_assert!(low <= high, "proven bounds cross: {low} > {high}");
    Enclosure::new(lesser(low, high), high).expect("lengths and shares are finite and not negative")
}
