//! Turning angles and curvature of an outline.

use super::sampling::{Samples, closed_length, distance};
use pompeiu_planar::Point;
use std::f64::consts::{PI, TAU};

/// Bins of a histogram.
const BINS: usize = 10;

/// Relative curvature above which a point counts as sharp; 1 is the curvature of the circle of the same length.
const SHARP: f64 = 5.0;

/// Smallest prominence of a peak in relative curvature.
const PROMINENCE: f64 = 1.0;

/// Turning angles at 500 points at equal arc lengths, after smoothing by a Gaussian (`smoothing`).
///
/// The turn at a point is the angle between the chords before and after it, in (−π, π], positive where the shape is convex. The
/// curvature κ is the turn over the mean length of the two chords. Relative curvature κL/2π, with L the length of the polygon, is 1
/// on a circle.
///
/// # Source
/// `chambers_exploring_2018` ranks by the first bin of a histogram without stating its range. `t18`, `neg5` and `per_shape` are
/// interpretations close to the values published since.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Curvature {
    /// Share of points in the first bin of `histogram`: where the outline turns by less than π/10.
    pub first_bin: f64,
    /// The share of all other points, `t18`: greater for shapes with more corners.
    pub one_minus_first_bin: f64,
    /// Shares of points by absolute turn, in ten equal bins from 0 to π.
    pub histogram: Vec<f64>,
    /// Share of points with κL/2π < −5: sharp concave points.
    pub neg5: f64,
    /// Share of points with |κ|L/2π > 5.
    pub sharp: f64,
    /// Shares of points by absolute curvature, in ten equal bins from 0 to the maximum of this shape.
    pub per_shape_histogram: Vec<f64>,
    /// Share of points outside the first bin of that histogram.
    pub per_shape: f64,
    /// Number of maxima of |κ|L/2π along the outline with a prominence of at least 1.
    pub peaks: usize,
    /// The sum of all absolute turns, over 2π: 1 for convex shapes.
    pub total: f64,
    /// The standard deviation of the Gaussian that smooths the points, as a share of the length.
    pub smoothing: f64,
}

impl Curvature {
    pub(super) fn of(samples: &Samples, smoothing: f64) -> Self {
        let points = samples.smoothed(smoothing);
        let turns = turns(&points);
        let relative = relative_curvature(&points, &turns);
        let n = turns.len() as f64;
        let share = |is: &dyn Fn(f64) -> bool| relative.iter().filter(|k| is(**k)).count() as f64 / n;
        let sizes: Vec<f64> = relative.iter().map(|k| k.abs()).collect();
        let most = sizes.iter().copied().fold(0.0, f64::max);
        let histogram = bins(turns.iter().map(|t| t.abs()), PI);
        let per_shape_histogram = bins(sizes.iter().copied(), most);
        Self {
            first_bin: histogram[0],
            one_minus_first_bin: histogram[1..].iter().sum(),
            neg5: share(&|k| k < -SHARP),
            sharp: share(&|k| k.abs() > SHARP),
            per_shape: per_shape_histogram[1..].iter().sum(),
            histogram,
            per_shape_histogram,
            peaks: peaks(&sizes, PROMINENCE),
            total: turns.iter().map(|t| t.abs()).sum::<f64>() / TAU,
            smoothing,
        }
    }
}

/// The angle between the chords before and after each point.
fn turns(points: &[Point]) -> Vec<f64> {
    let n = points.len();
    (0..n)
        .map(|i| {
            let [a, b, c] = [points[(i + n - 1) % n], points[i], points[(i + 1) % n]];
            let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]);
            libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])
        })
        .collect()
}

/// κL/2π at each point.
fn relative_curvature(points: &[Point], turns: &[f64]) -> Vec<f64> {
    let n = points.len();
    let length = closed_length(points);
    (0..n)
        .map(|i| {
            let [a, b, c] = [points[(i + n - 1) % n], points[i], points[(i + 1) % n]];
            let around = 0.5 * (distance(a, b) + distance(b, c));
            if around > 0.0 { turns[i] / around * length / TAU } else { 0.0 }
        })
        .collect()
}

/// Shares in equal bins from 0 to a maximum, which belongs to the last bin. If it is 0, all values are in the first bin.
fn bins(values: impl Iterator<Item = f64>, most: f64) -> Vec<f64> {
    let mut counts = [0_usize; BINS];
    let mut all = 0;
    for value in values {
        let bin = if most > 0.0 { (value / most * BINS as f64) as usize } else { 0 };
        counts[bin.min(BINS - 1)] += 1;
        all += 1;
    }
    counts.iter().map(|count| *count as f64 / f64::from(all)).collect()
}

/// The number of maxima of a cyclic sequence with at least this prominence: the sequence rises to them and falls from them by that
/// much.
fn peaks(values: &[f64], prominence: f64) -> usize {
    let n = values.len();
    let lowest = (0..n).min_by(|i, j| values[*i].total_cmp(&values[*j])).unwrap_or(0);
    let (mut low, mut high, mut is_rising, mut count) = (values[lowest], values[lowest], false, 0);
    for k in 1..=n {
        let value = values[(lowest + k) % n];
        if is_rising {
            high = high.max(value);
            if value <= high - prominence {
                count += 1;
                is_rising = false;
                low = value;
            }
        } else {
            low = low.min(value);
            if value >= low + prominence {
                is_rising = true;
                high = value;
            }
        }
    }
    count
}
