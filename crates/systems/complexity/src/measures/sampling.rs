//! Points at equal arc lengths along an outline, starting at a point that does not depend on the outline's first corner.

use pompeiu_planar::{Outline, Point, resample};

/// Number of points for curvature and skeleton.
pub(super) const SAMPLES: usize = 500;

/// An outline as points at equal arc lengths, normalised: the mean of the curve at the origin, length 1.
pub(super) struct Samples {
    start: usize,
    pub(super) points: Vec<Point>,
}

impl Samples {
    pub(super) fn of(outline: &Outline) -> Self {
        let start = start(outline);
        Self { start, points: resample(outline, SAMPLES, start) }
    }

    /// Another number of points from the same start.
    pub(super) fn again(&self, outline: &Outline, count: usize) -> Vec<Point> {
        resample(outline, count, self.start)
    }

    /// The points smoothed by a Gaussian along the curve; its standard deviation is a share of the length.
    pub(super) fn smoothed(&self, share: f64) -> Vec<Point> {
        let n = self.points.len();
        let deviation = share * n as f64;
        let reach = (4.0 * deviation).ceil() as usize;
        if reach == 0 {
            return self.points.clone();
        }
        let weight = |k: usize| libm::exp(-0.5 * (k as f64 / deviation).powi(2));
        let weights: Vec<f64> = (0..=reach).map(weight).collect();
        let total = weights[0] + 2.0 * weights[1..].iter().sum::<f64>();
        (0..n)
            .map(|i| {
                let mut sum = self.points[i].map(|x| x * weights[0]);
                for (k, w) in weights.iter().enumerate().skip(1) {
                    let (a, b) = (self.points[(i + k) % n], self.points[(i + n * (k / n + 1) - k) % n]);
                    for axis in 0..2 {
                        sum[axis] += w * (a[axis] + b[axis]);
                    }
                }
                sum.map(|x| x / total)
            })
            .collect()
    }
}

/// The corner farthest from the mean of the curve.
///
/// If several corners are farthest because the shape is symmetric, the measures are the same for each of them: equal arc lengths
/// from a corner give the same points in both directions.
fn start(outline: &Outline) -> usize {
    let (mut length, mut sum) = (0.0, [0.0; 2]);
    let origin = outline.points()[0];
    for [a, b] in outline.sides() {
        let side = distance(a, b);
        length += side;
        for k in 0..2 {
            sum[k] += side * (0.5 * (a[k] + b[k]) - origin[k]);
        }
    }
    let mean = [0, 1].map(|k| origin[k] + sum[k] / length);
    let far = |i: &usize| distance(outline.points()[*i], mean);
    (0..outline.points().len()).max_by(|i, j| far(i).total_cmp(&far(j)).then(j.cmp(i))).unwrap_or(0)
}

pub(super) fn distance(a: Point, b: Point) -> f64 {
    let (x, y) = (a[0] - b[0], a[1] - b[1]);
    (x * x + y * y).sqrt()
}

/// The length of a closed polygon.
pub(super) fn closed_length(points: &[Point]) -> f64 {
    points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| distance(*a, *b)).sum()
}
