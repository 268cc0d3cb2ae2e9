//! The section of a tube as five bicubic patches.

use super::node::CORE;
use pompeiu_volume::bernstein::{bernstein, bernstein_slopes};
use std::f64::consts::{FRAC_PI_4, PI};

/// Bulge of the sides of the core square, relative to their length: it makes the angles at its corners 120°, as in the adjacent
/// patches.
const BULGE: f64 = 0.0893;

/// The patches of a unit disc: the core, with corners at 45°, 135°, …, and four around it.
///
/// The rim consists of four cubic arcs with a distance below 3e-4 of the radius from the circle. In the core patch u and v go from
/// corner 0 to corners 1 and 3; in the others u goes outwards, v to the next corner. The section is symmetric under quarter turns
/// and reflections.
pub(super) struct Section {
    /// Control points, u fastest.
    patches: [[[f64; 2]; 16]; 5],
}

type Point = [f64; 2];

fn mix(list: &[(Point, f64)]) -> Point {
    [0, 1].map(|axis| list.iter().map(|(p, weight)| p[axis] * weight).sum())
}

fn at_angle(k: usize, radius: f64) -> Point {
    let angle = FRAC_PI_4 * (2 * k + 1) as f64;
    [radius * libm::cos(angle), radius * libm::sin(angle)]
}

impl Section {
    pub(super) fn new() -> Self {
        let core = |k: usize| at_angle(k % 4, CORE);
        let rim = |k: usize| at_angle(k % 4, 1.0);
        let length = CORE * std::f64::consts::SQRT_2;
        // The side of the core from corner k, and the arc of the rim.
        let side = |k: usize| -> [Point; 4] {
            let (a, b) = (core(k), core(k + 1));
            let angle = FRAC_PI_4 * (2 * k + 2) as f64;
            let out = [BULGE * length * libm::cos(angle), BULGE * length * libm::sin(angle)];
            let inner = |share: f64| mix(&[(a, 1.0 - share), (b, share), (out, 1.0)]);
            [a, inner(1.0 / 3.0), inner(2.0 / 3.0), b]
        };
        let arc = |k: usize| -> [Point; 4] {
            let reach = 4.0 / 3.0 * libm::tan(PI / 8.0);
            let (a, b) = (rim(k), rim(k + 1));
            [a, mix(&[(a, 1.0), ([-a[1], a[0]], reach)]), mix(&[(b, 1.0), ([b[1], -b[0]], reach)]), b]
        };
        let [bottom, right, top, left] = [0, 1, 2, 3].map(side);
        let mut patches = [[[0.0; 2]; 16]; 5];
        for j in 0..4 {
            for i in 0..4 {
                let (u, v) = (i as f64 / 3.0, j as f64 / 3.0);
                // A Coons patch: sides 2 and 3 run in the opposite direction.
                patches[0][i + 4 * j] = mix(&[
                    (bottom[i], 1.0 - v),
                    (top[3 - i], v),
                    (left[3 - j], 1.0 - u),
                    (right[j], u),
                    (core(0), -(1.0 - u) * (1.0 - v)),
                    (core(1), -u * (1.0 - v)),
                    (core(2), -u * v),
                    (core(3), -(1.0 - u) * v),
                ]);
                for k in 0..4 {
                    patches[k + 1][i + 4 * j] = mix(&[(side(k)[j], 1.0 - u), (arc(k)[j], u)]);
                }
            }
        }
        Self { patches }
    }

    /// The factor for radii at which the section has the area of its disc.
    pub(super) fn area_factor(&self) -> f64 {
        // By Green's formula along the rim; the quadrature rule is exact for degree 5.
        let places = [0.5 - 0.15_f64.sqrt(), 0.5, 0.5 + 0.15_f64.sqrt()];
        let weights = [5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0];
        let mut area = 0.0;
        for patch in &self.patches[1..] {
            let rim = [3, 7, 11, 15].map(|n| patch[n]);
            for (t, weight) in places.into_iter().zip(weights) {
                let [p, d] = [bernstein(t), bernstein_slopes(t)]
                    .map(|w| mix(&[(rim[0], w[0]), (rim[1], w[1]), (rim[2], w[2]), (rim[3], w[3])]));
                area += 0.5 * weight * (p[0] * d[1] - p[1] * d[0]);
            }
        }
        (PI / area).sqrt()
    }

    /// The patch, and the position in it, of a combination of corners in the core and on the rim.
    fn place(inner: [f64; 4], outer: [f64; 4]) -> (usize, [f64; 2]) {
        let radial: f64 = outer.iter().sum();
        if radial == 0.0 {
            return (0, [inner[1] + inner[2], inner[2] + inner[3]]);
        }
        let total: [f64; 4] = std::array::from_fn(|k| inner[k] + outer[k]);
        let k = (0..4).find(|&k| total[k] > 0.0 && total[(k + 3) % 4] == 0.0).unwrap_or(0);
        (k + 1, [radial, total[(k + 1) % 4]])
    }

    /// The control point at a position in thirds.
    pub(super) fn control(&self, inner: [f64; 4], outer: [f64; 4]) -> Point {
        let (patch, place) = Self::place(inner, outer);
        let [i, j] = place.map(|t| (3.0 * t).round() as usize);
        self.patches[patch][i.min(3) + 4 * j.min(3)]
    }

    /// The point of the section at a position.
    pub(super) fn value(&self, inner: [f64; 4], outer: [f64; 4]) -> Point {
        let (patch, [u, v]) = Self::place(inner, outer);
        let (a, b) = (bernstein(u), bernstein(v));
        let mut sum = [0.0; 2];
        for (n, point) in self.patches[patch].iter().enumerate() {
            let weight = a[n % 4] * b[n / 4];
            sum = [sum[0] + weight * point[0], sum[1] + weight * point[1]];
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rim_is_a_circle_but_for_a_little_and_has_its_area() {
        let section = Section::new();
        for t in [0.0, 0.1, 0.25, 0.5, 0.8] {
            let mut outer = [0.0; 4];
            (outer[2], outer[3]) = (1.0 - t, t);
            let [x, y] = section.value([0.0; 4], outer);
            assert!((x.hypot(y) - 1.0).abs() < 3e-4, "{t} {}", x.hypot(y));
        }
        let factor = section.area_factor();
        assert!((factor - 1.0).abs() < 3e-4 && factor != 1.0, "{factor}");
        // Adjacent patches agree on the core's sides.
        let [a, b] = [[0.3, 0.7, 0.0, 0.0], [0.0, 0.0, 0.3, 0.7]].map(|inner| section.value(inner, [0.0; 4]));
        assert!((a[0] + b[0]).abs() < 1e-15 && (a[1] + b[1]).abs() < 1e-15);
        let inner = section.value([0.3, 0.7, 0.0, 0.0], [1e-300, 0.0, 0.0, 0.0]);
        assert!((inner[0] - a[0]).abs() < 1e-15 && (inner[1] - a[1]).abs() < 1e-15);
    }
}
