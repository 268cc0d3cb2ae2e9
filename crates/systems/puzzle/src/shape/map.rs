//! Tables of a metric around a site, computed once for all sites and points.

use super::gauge::{Answer, Variant, gauge};
use pompeiu_planar::{Outline, Point, distance_sq_to_segment};
use rayon::prelude::*;

/// A function around a site, tabulated on a square, with interpolation.
///
/// Beyond the square, it is extrapolated as a distance or as a factor.
#[derive(Clone, Debug)]
pub struct Map {
    half: f64,
    /// Cells per unit of length.
    scale: f64,
    side: usize,
    values: Vec<f32>,
    answer: Answer,
    radius: f64,
}

/// Extent of a map, relative to the greatest distance of the shape from the site.
const REACH: f64 = 1.35;

impl Map {
    /// The map of a shape around the origin, with `side` values in each row and column, at least 8.
    ///
    /// # Accuracy
    /// Linear interpolation: distances differ from the true ones by at most a cell's side, less where they are smooth.
    ///
    /// # Cost
    /// Number of values times number of sides of the shape.
    pub fn new(shape: &Outline, answer: Answer, variant: Variant, side: usize) -> Self {
        let side = side.max(8);
        let radius = shape.points().iter().map(|p| libm::hypot(p[0], p[1])).fold(0.0, f64::max);
        let half = REACH * radius;
        let sides: Vec<[Point; 2]> = shape.sides().collect();
        let at = |i: usize| half * (2.0 * i as f64 / (side - 1) as f64 - 1.0);
        let value = |q: Point| match answer {
            Answer::SignedDistance => {
                let distance_sq =
                    sides.iter().map(|s| distance_sq_to_segment(q, *s)).fold(f64::INFINITY, f64::min);
                if shape.contains(q) { -distance_sq.sqrt() } else { distance_sq.sqrt() }
            }
            Answer::Least => gauge(shape, q, variant, true),
            Answer::Greatest => gauge(shape, q, variant, false),
        };
        let values = (0..side * side).into_par_iter().map(|i| value([at(i % side), at(i / side)]) as f32);
        Self { half, scale: (side - 1) as f64 / (2.0 * half), side, values: values.collect(), answer, radius }
    }

    /// The greatest distance of the shape from the site.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The position of the least value in the table: for distances, the deepest point of the shape.
    pub(super) fn deepest(&self) -> Point {
        let least =
            (0..self.values.len()).min_by(|i, j| self.values[*i].total_cmp(&self.values[*j])).unwrap_or(0);
        [least % self.side, least / self.side].map(|i| i as f64 / self.scale - self.half)
    }

    /// Whether values are distances, which are 1-Lipschitz.
    pub(super) fn is_distance(&self) -> bool {
        self.answer == Answer::SignedDistance
    }

    // The arithmetic is written out: closures over arrays are several times slower in a profile that does not inline them.

    /// The value at a point.
    #[inline]
    pub fn value(&self, q: Point) -> f64 {
        if q[0].abs() <= self.half && q[1].abs() <= self.half {
            let (a, b, c, d, s, t) = self.cell(q);
            let (lower, upper) = (a + s * (b - a), c + s * (d - c));
            return lower + t * (upper - lower);
        }
        self.beyond(q).0
    }

    /// The value at a point, and its gradient.
    #[inline]
    pub fn with_gradient(&self, q: Point) -> (f64, Point) {
        if q[0].abs() <= self.half && q[1].abs() <= self.half { self.inside(q) } else { self.beyond(q) }
    }

    fn beyond(&self, q: Point) -> (f64, Point) {
        if self.answer == Answer::SignedDistance {
            let near = [q[0].clamp(-self.half, self.half), q[1].clamp(-self.half, self.half)];
            let (value, gradient) = self.inside(near);
            let away = [q[0] - near[0], q[1] - near[1]];
            let distance = (away[0] * away[0] + away[1] * away[1]).sqrt();
            let along = |k: usize| if away[k] == 0.0 { gradient[k] } else { away[k] / distance };
            (value + distance, [along(0), along(1)])
        } else {
            // Homogeneous of degree 1.
            let factor = self.half / q[0].abs().max(q[1].abs());
            let (value, gradient) = self.inside([q[0] * factor, q[1] * factor]);
            (value / factor, gradient)
        }
    }

    #[inline]
    fn inside(&self, q: Point) -> (f64, Point) {
        let (a, b, c, d, s, t) = self.cell(q);
        let (lower, upper) = (a + s * (b - a), c + s * (d - c));
        let gradient = [self.scale * ((b - a) + t * ((d - c) - (b - a))), self.scale * (upper - lower)];
        (lower + t * (upper - lower), gradient)
    }

    /// The four values around a point, and its position between them.
    #[inline]
    fn cell(&self, q: Point) -> (f64, f64, f64, f64, f64, f64) {
        let (x, y) = ((q[0] + self.half) * self.scale, (q[1] + self.half) * self.scale);
        let (column, row) = ((x as usize).min(self.side - 2), (y as usize).min(self.side - 2));
        let at = row * self.side + column;
        let (low, high) = (&self.values[at..at + 2], &self.values[at + self.side..at + self.side + 2]);
        let (a, b) = (f64::from(low[0]), f64::from(low[1]));
        let (c, d) = (f64::from(high[0]), f64::from(high[1]));
        (a, b, c, d, x - column as f64, y - row as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_agree_with_what_they_tabulate_and_go_on_beyond() {
        let square = Outline::new(vec![[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]).unwrap();
        let distance = Map::new(&square, Answer::SignedDistance, Variant::Edges, 129);
        for (q, truth) in [([0.0, 0.1], -0.4), ([0.8, 0.2], 0.3), ([3.0, 0.0], 2.5), ([0.2, -5.0], 4.5)] {
            let (value, gradient) = distance.with_gradient(q);
            assert!((value - truth).abs() < 1e-2, "{q:?}: {value}");
            assert!((libm::hypot(gradient[0], gradient[1]) - 1.0).abs() < 1e-2);
        }
        let factor = Map::new(&square, Answer::Least, Variant::Edges, 129);
        for q in [[0.3, 0.1], [-0.2, 0.7], [5.0, -2.0]] {
            assert!((factor.value(q) / (2.0 * f64::max(q[0].abs(), q[1].abs())) - 1.0).abs() < 1e-2);
        }
    }
}
