//! The squared distance of a ball from tangent planes.

use crate::ball::Ball;
use std::ops::AddAssign;

/// The weighted sum of the squared distances of a ball from planes that it should touch from inside, as a function of its centre
/// and radius.
///
/// # Definition
/// With s = (c, r) and n̄ = (n, 1): the sum of w (n̄·s − n·p)², for planes through p with unit normals n.
///
/// # Source
/// `thiery_sphere_2013`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Quadric {
    /// The sums of w n̄ n̄ᵀ, of w (n·p) n̄, and of w (n·p)².
    matrix: [[f64; 4]; 4],
    vector: [f64; 4],
    constant: f64,
}

/// Smallest pivot, relative to the trace, of a quadric with a unique minimum.
const REGULAR: f64 = 1e-6;

impl Quadric {
    /// The quadric of a plane through `point` with the unit normal `normal`.
    pub(super) fn of_plane(point: [f64; 3], normal: [f64; 3], weight: f64) -> Self {
        let [x, y, z] = normal;
        let extended = [x, y, z, 1.0];
        let offset = x * point[0] + y * point[1] + z * point[2];
        Self {
            matrix: extended.map(|a| extended.map(|b| weight * a * b)),
            vector: extended.map(|a| weight * offset * a),
            constant: weight * offset * offset,
        }
    }

    /// The value for a ball; rounding may make it slightly negative.
    pub(super) fn at(&self, ball: &Ball) -> f64 {
        let [x, y, z] = ball.centre;
        let s = [x, y, z, ball.radius];
        let square: f64 = (0..4).map(|i| s[i] * (0..4).map(|j| self.matrix[i][j] * s[j]).sum::<f64>()).sum();
        let linear: f64 = (0..4).map(|i| self.vector[i] * s[i]).sum();
        square - 2.0 * linear + self.constant
    }

    /// The minimising ball, if it is unique and its radius is not negative.
    pub(super) fn least(&self) -> Option<Ball> {
        let trace: f64 = (0..4).map(|i| self.matrix[i][i]).sum();
        let mut a = self.matrix;
        let mut x = self.vector;
        // Without pivoting: the matrix is positive semi-definite.
        for k in 0..4 {
            if a[k][k].is_nan() || a[k][k] <= REGULAR * trace {
                return None;
            }
            for i in k + 1..4 {
                let factor = a[i][k] / a[k][k];
                for j in k..4 {
                    a[i][j] -= factor * a[k][j];
                }
                x[i] -= factor * x[k];
            }
        }
        for k in (0..4).rev() {
            let known: f64 = (k + 1..4).map(|j| a[k][j] * x[j]).sum();
            x[k] = (x[k] - known) / a[k][k];
        }
        let ball = Ball { centre: [x[0], x[1], x[2]], radius: x[3] };
        (x.iter().all(|x| x.is_finite()) && ball.radius >= 0.0).then_some(ball)
    }
}

impl AddAssign for Quadric {
    fn add_assign(&mut self, other: Self) {
        for i in 0..4 {
            for j in 0..4 {
                self.matrix[i][j] += other.matrix[i][j];
            }
            self.vector[i] += other.vector[i];
        }
        self.constant += other.constant;
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests may panic")]
mod tests {
    use super::*;
    use pompeiu_core::mesh::Random;

    #[test]
    fn the_value_is_the_sum_of_squared_distances_and_the_ball_is_found() {
        let mut random = Random::new(3);
        let mut number = || random.signed_unit();
        let ball = Ball { centre: [0.3, -0.2, 0.5], radius: 0.7 };
        let other = Ball { centre: [number(), number(), number()], radius: 0.4 };
        let (mut sum, mut expected) = (Quadric::default(), 0.0);
        for _ in 0..12 {
            let n = [number(), number(), number()];
            let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
            let n = n.map(|x| x / length);
            let p = [0, 1, 2].map(|k| ball.centre[k] + ball.radius * n[k]);
            sum += Quadric::of_plane(p, n, 2.0);
            let height: f64 = (0..3).map(|k| n[k] * (p[k] - other.centre[k])).sum::<f64>() - other.radius;
            expected += 2.0 * height * height;
        }
        assert!((sum.at(&other) - expected).abs() < 1e-12 * expected);
        let found = sum.least().unwrap();
        assert!(
            crate::ball::distance(found.centre, ball.centre) + (found.radius - ball.radius).abs() < 1e-12
        );
        // Parallel planes do not determine a ball.
        assert!(Quadric::of_plane([0.0; 3], [1.0, 0.0, 0.0], 1.0).least().is_none());
    }
}
