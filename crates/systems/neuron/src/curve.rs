//! Smooth axes of tubes: cubic B-splines with the samples, including their radii, as control points.

use glam::{DVec3, DVec4, Vec4Swizzles};

/// A clamped uniform B-spline of degree at most three, in space and radius.
///
/// It interpolates the first and the last control point, and stays in the convex hull of any four consecutive ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    points: Vec<DVec4>,
    degree: usize,
    knots: Vec<f64>,
}

impl Curve {
    /// The curve of these positions and radii.
    ///
    /// # Panics
    /// With fewer than two points.
    pub fn new(points: impl IntoIterator<Item = (DVec3, f64)>) -> Self {
        let points: Vec<DVec4> = points.into_iter().map(|(p, r)| p.extend(r)).collect();
        assert!(points.len() > 1, "a curve has two ends");
        let degree = 3.min(points.len() - 1);
        let spans = points.len() - degree;
        let knots = (0..=points.len() + degree).map(|i| i.saturating_sub(degree).min(spans) as f64).collect();
        Self { points, degree, knots }
    }

    /// The greatest parameter; the least is 0.
    pub fn end(&self) -> f64 {
        (self.points.len() - self.degree) as f64
    }

    /// Position and radius at a parameter.
    pub fn at(&self, t: f64) -> (DVec3, f64) {
        let value = self.blossom(t, self.degree, &self.points, &self.knots);
        (value.xyz(), value.w)
    }

    /// Derivative of the position by the parameter.
    pub fn derivative(&self, t: f64) -> DVec3 {
        let p = self.degree;
        let differences: Vec<DVec4> = (0..self.points.len() - 1)
            .map(|i| {
                let width = self.knots[i + p + 1] - self.knots[i + 1];
                (self.points[i + 1] - self.points[i]) * (p as f64 / width)
            })
            .collect();
        let inner = &self.knots[1..self.knots.len() - 1];
        self.blossom(t, p - 1, &differences, inner).xyz()
    }

    /// De Boor's algorithm.
    fn blossom(&self, t: f64, degree: usize, points: &[DVec4], knots: &[f64]) -> DVec4 {
        let t = t.clamp(0.0, self.end());
        let span = degree + (t as usize).min(points.len() - degree - 1);
        let mut d = [DVec4::ZERO; 4];
        d[..=degree].copy_from_slice(&points[span - degree..=span]);
        for level in 1..=degree {
            for j in (level..=degree).rev() {
                let i = span - degree + j;
                let (low, high) = (knots[i], knots[i + 1 + degree - level]);
                let weight = if high > low { (t - low) / (high - low) } else { 0.0 };
                d[j] = d[j - 1].lerp(d[j], weight);
            }
        }
        d[degree]
    }

    /// The arc length of the curve and its inverse, from a table of `per_span` chords per span.
    pub fn arc_length(&self, per_span: usize) -> ArcLength {
        let steps = (self.end() as usize) * per_span.max(1);
        let mut lengths = Vec::with_capacity(steps + 1);
        let mut total = 0.0;
        let mut last = self.at(0.0).0;
        lengths.push(0.0);
        for k in 1..=steps {
            let next = self.at(self.end() * k as f64 / steps as f64).0;
            total += last.distance(next);
            lengths.push(total);
            last = next;
        }
        ArcLength { lengths, end: self.end() }
    }
}

/// Arc lengths of a curve at uniform parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct ArcLength {
    lengths: Vec<f64>,
    end: f64,
}

impl ArcLength {
    /// The length of the curve.
    pub fn total(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// The parameter at a length along the curve.
    pub fn parameter(&self, length: f64) -> f64 {
        let last = self.lengths.len() - 1;
        let k = self.lengths.partition_point(|&l| l < length).clamp(1, last);
        let (low, high) = (self.lengths[k - 1], self.lengths[k]);
        let within = if high > low { ((length - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
        self.end * ((k - 1) as f64 + within) / last as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_lines_stay_and_derivatives_are_differences() {
        let line = Curve::new((0..6).map(|i| (DVec3::new(2.0 * f64::from(i), 1.0, 0.0), 0.5)));
        let (p, r) = line.at(1.3);
        assert!((p.y - 1.0).abs() < 1e-15 && (r - 0.5).abs() < 1e-15);
        assert!((line.arc_length(20).total() - 10.0).abs() < 1e-12);
        assert_eq!(line.at(0.0).0, DVec3::new(0.0, 1.0, 0.0));
        assert_eq!(line.at(3.0).0, DVec3::new(10.0, 1.0, 0.0));
        let bent = [[0.0, 0.0, 0.0], [1.0, 2.0, 0.5], [3.0, 1.0, 0.0], [4.0, 0.0, 2.0], [5.0, 3.0, 1.0]];
        for count in 2..=5 {
            let curve = Curve::new(bent[..count].iter().map(|&p| (p.into(), 1.0)));
            for t in [0.1, 0.45, 0.9] {
                let t = t * curve.end();
                let difference = (curve.at(t + 1e-6).0 - curve.at(t - 1e-6).0) / 2e-6;
                assert!(difference.distance(curve.derivative(t)) < 1e-7, "{count} {t}");
            }
        }
    }
}
