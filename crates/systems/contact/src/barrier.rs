//! The barrier, the mollifier of nearly parallel edges, and smooth friction.
//!
//! # Source
//! `li_incremental_2020`; the barrier of squared distances is that of the IPC toolkit.

use glam::DVec3;

/// The barrier `b(s) = −(s − ŝ)² ln(s / ŝ)` of a squared distance s below `ŝ`, with its first and second derivative; zero beyond.
pub fn barrier(s: f64, s_hat: f64) -> [f64; 3] {
    if s >= s_hat {
        return [0.0; 3];
    }
    let (gap, log) = (s - s_hat, libm::log(s / s_hat));
    [-gap * gap * log, -gap * (2.0 * log + gap / s), -2.0 * log - 4.0 * gap / s + gap * gap / (s * s)]
}

/// Below this part of `|e₁|² |e₂|²` of the rest edges, `|e₁ × e₂|²` is mollified.
pub const MOLLIFIED: f64 = 1e-3;

/// The mollifier `m(c) = c/ε (2 − c/ε)` for `c < ε`, one beyond, with its first and second derivative.
pub fn mollifier(c: f64, epsilon: f64) -> [f64; 3] {
    let ratio = c / epsilon;
    if ratio < 1.0 {
        [ratio * (2.0 - ratio), 2.0 * (1.0 - ratio) / epsilon, -2.0 / (epsilon * epsilon)]
    } else {
        [1.0, 0.0, 0.0]
    }
}

/// `|u × v|²` of the edges of points 0, 1 and 2, 3, and its gradient.
pub fn cross_squared(x: &[DVec3; 4]) -> (f64, [DVec3; 4]) {
    let (u, v) = (x[1] - x[0], x[3] - x[2]);
    let n = u.cross(v);
    let (by_u, by_v) = (v.cross(n) * 2.0, n.cross(u) * 2.0);
    (n.length_squared(), [-by_u, by_u, -by_v, by_v])
}

/// The second derivatives of `|u × v|² = |u|² |v|² − (u·v)²`, three rows for each point.
pub fn cross_squared_hessian(x: &[DVec3; 4]) -> [[f64; 12]; 12] {
    let (u, v) = (x[1] - x[0], x[3] - x[2]);
    let (uu, uv, vv) = (u.length_squared(), u.dot(v), v.length_squared());
    let entry = |p: usize, q: usize, i: usize, j: usize| {
        let same = if i == j { 1.0 } else { 0.0 };
        match (p, q) {
            (0, 0) => 2.0 * (vv * same - v[i] * v[j]),
            (1, 1) => 2.0 * (uu * same - u[i] * u[j]),
            (0, 1) => 2.0 * (2.0 * u[i] * v[j] - v[i] * u[j] - uv * same),
            _ => 2.0 * (2.0 * v[i] * u[j] - u[i] * v[j] - uv * same),
        }
    };
    // Points 0 and 2 are the ends that edges begin at.
    let sign = |point: usize| if point.is_multiple_of(2) { -1.0 } else { 1.0 };
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let (p, q) = (i / 3, j / 3);
            sign(p) * sign(q) * entry(p / 2, q / 2, i % 3, j % 3)
        })
    })
}

/// Smooth friction: the potential `f₀` of a sliding distance y, `f₀' / y` and `f₀''`, with `ε` the distance at which it slides.
pub fn friction(y: f64, epsilon: f64) -> [f64; 3] {
    if y >= epsilon {
        return [y, 1.0 / y, 0.0];
    }
    let ratio = y / epsilon;
    [y * ratio * (1.0 - ratio / 3.0) + epsilon / 3.0, (2.0 - ratio) / epsilon, 2.0 * (1.0 - ratio) / epsilon]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_barrier_is_that_of_the_ipc_toolkit() {
        // ipctk 1.6.1: barrier(0.25e-6, 1e-6).
        assert!((barrier(0.25e-6, 1e-6)[0] / 7.797_905_781_299_385e-13 - 1.0).abs() < 1e-15);
        assert_eq!(barrier(1e-6, 1e-6), [0.0; 3]);
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        let h = 1e-6;
        for s in [0.01, 0.3, 0.9] {
            let [_, first, second] = barrier(s, 1.0);
            let (low, high) = (barrier(s - h, 1.0), barrier(s + h, 1.0));
            assert!(((high[0] - low[0]) / (2.0 * h) / first - 1.0).abs() < 1e-6);
            assert!(((high[1] - low[1]) / (2.0 * h) / second - 1.0).abs() < 1e-6);
            let slope = (mollifier(s + h, 1.0)[0] - mollifier(s - h, 1.0)[0]) / (2.0 * h);
            assert!((slope - mollifier(s, 1.0)[1]).abs() < 1e-8);
            let bend = (mollifier(s + h, 1.0)[1] - mollifier(s - h, 1.0)[1]) / (2.0 * h);
            assert!((bend - mollifier(s, 1.0)[2]).abs() < 1e-8);
            let (low, high) = (friction(s - h, 1.0), friction(s + h, 1.0));
            assert!(((high[0] - low[0]) / (2.0 * h) - s * friction(s, 1.0)[1]).abs() < 1e-8);
            assert!((((s + h) * high[1] - (s - h) * low[1]) / (2.0 * h) - friction(s, 1.0)[2]).abs() < 1e-8);
        }
    }
}
