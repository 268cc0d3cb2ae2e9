//! The shape energy of eight cells at a time.
//!
//! Functions go over all cells one operation at a time, without closures: so they are compiled for the instruction set of their caller. No
//! operation is fused, and each cell's are in the order of [`Shape::cost`], so the bits are the same on all instruction sets.

#![allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]

use super::shape::Shape;
use multiversion::multiversion;

/// Cells whose energy is computed at a time.
pub(super) const LANES: usize = 8;

/// A number for each cell, and a vector.
pub(super) type Lanes = [f64; LANES];
pub(super) type Vectors = [Lanes; 3];

/// A vector for each of the corners of the cells.
pub(super) type Corners = [Vectors; 8];

pub(super) const ZERO: Vectors = [[0.0; LANES]; 3];

/// The edges along each axis: their corners, in the order of the weights of [`weights`].
const EDGES: [[[usize; 2]; 4]; 3] =
    [[[0, 1], [3, 2], [4, 5], [7, 6]], [[0, 3], [1, 2], [4, 7], [5, 6]], [[0, 4], [1, 5], [2, 6], [3, 7]]];

/// The weights of the edges in the derivatives along each axis.
#[inline(always)]
fn weights([u, v, w]: [f64; 3]) -> [[f64; 4]; 3] {
    let (s, t, r) = (1.0 - u, 1.0 - v, 1.0 - w);
    [[t * r, v * r, t * w, v * w], [s * r, u * r, s * w, u * w], [s * t, u * t, u * v, s * v]]
}

/// The energy densities of cells at all combinations of the parameters, the last axis fastest, and the derivatives of the sum over these with
/// respect to the corners.
#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
pub(super) fn costs(
    corners: &Corners,
    places: &[f64],
    shape: Shape,
    values: &mut Vec<Lanes>,
    by_corner: &mut Corners,
) {
    values.clear();
    *by_corner = [ZERO; 8];
    let mut edges = [[ZERO; 4]; 3];
    for (edges, ends) in edges.iter_mut().zip(EDGES) {
        for (edge, [from, to]) in edges.iter_mut().zip(ends) {
            for k in 0..3 {
                for l in 0..LANES {
                    edge[k][l] = corners[to][k][l] - corners[from][k][l];
                }
            }
        }
    }
    for &u in places {
        for &v in places {
            for &w in places {
                let weights = weights([u, v, w]);
                let (cost, slopes) = Point::new(&edges, &weights).cost(shape);
                values.push(cost);
                spread(&slopes, &weights, by_corner);
            }
        }
    }
}

/// Jacobian matrices at a point of the cells.
pub(super) struct Point {
    columns: [Vectors; 3],
    cofactors: [Vectors; 3],
    determinants: Lanes,
    /// The squared lengths of the columns.
    squares: [Lanes; 3],
}

impl Point {
    #[inline(always)]
    fn new(edges: &[[Vectors; 4]; 3], weights: &[[f64; 4]; 3]) -> Self {
        let mut point = Self::empty();
        for l in 0..LANES {
            let a = column(&edges[0], &weights[0], l);
            let b = column(&edges[1], &weights[1], l);
            let c = column(&edges[2], &weights[2], l);
            point.fill(l, [a, b, c]);
        }
        point
    }

    /// Those with these columns.
    #[inline(always)]
    pub(super) fn of_columns([a, b, c]: &[Vectors; 3]) -> Self {
        let mut point = Self::empty();
        for l in 0..LANES {
            let a = [a[0][l], a[1][l], a[2][l]];
            let b = [b[0][l], b[1][l], b[2][l]];
            let c = [c[0][l], c[1][l], c[2][l]];
            point.fill(l, [a, b, c]);
        }
        point
    }

    #[inline(always)]
    fn empty() -> Self {
        Self { columns: [ZERO; 3], cofactors: [ZERO; 3], determinants: ZERO[0], squares: ZERO }
    }

    #[inline(always)]
    fn fill(&mut self, l: usize, [a, b, c]: [[f64; 3]; 3]) {
        let (u, v, w) = (cross(b, c), cross(c, a), cross(a, b));
        set(&mut self.columns, l, [a, b, c]);
        set(&mut self.cofactors, l, [u, v, w]);
        self.determinants[l] = dot(a, u);
        self.squares[0][l] = dot(a, a);
        self.squares[1][l] = dot(b, b);
        self.squares[2][l] = dot(c, c);
    }

    /// The energy densities, and their derivatives with respect to the columns.
    #[inline(always)]
    pub(super) fn cost(&self, shape: Shape) -> (Lanes, [Vectors; 3]) {
        match shape {
            Shape::MeanRatio { epsilon } => mean_ratio(self, epsilon),
            Shape::Scaled { power } => scaled(self, power),
        }
    }
}

#[inline(always)]
fn column(edges: &[Vectors; 4], [p, q, r, s]: &[f64; 4], l: usize) -> [f64; 3] {
    let [a, b, c, d] = edges;
    [
        a[0][l] * p + b[0][l] * q + c[0][l] * r + d[0][l] * s,
        a[1][l] * p + b[1][l] * q + c[1][l] * r + d[1][l] * s,
        a[2][l] * p + b[2][l] * q + c[2][l] * r + d[2][l] * s,
    ]
}

#[inline(always)]
fn set(to: &mut [Vectors; 3], l: usize, [a, b, c]: [[f64; 3]; 3]) {
    (to[0][0][l], to[0][1][l], to[0][2][l]) = (a[0], a[1], a[2]);
    (to[1][0][l], to[1][1][l], to[1][2][l]) = (b[0], b[1], b[2]);
    (to[2][0][l], to[2][1][l], to[2][2][l]) = (c[0], c[1], c[2]);
}

#[inline(always)]
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1]]
}

#[inline(always)]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// That of [`Shape::MeanRatio`].
#[inline(always)]
fn mean_ratio(point: &Point, epsilon: f64) -> (Lanes, [Vectors; 3]) {
    let [squares_a, squares_b, squares_c] = &point.squares;
    let (mut cost, mut slopes) = ([0.0; LANES], [ZERO; 3]);
    for l in 0..LANES {
        let det = point.determinants[l];
        let root = (det * det + epsilon * epsilon).sqrt();
        // Avoids cancellation if the determinant is negative.
        let below = 0.5 * epsilon * epsilon / at_least(root - det, 1e-300);
        let above = 0.5 * (det + root);
        let chi = if det > 0.0 { above } else { below };
        let slope = chi / at_least(root, 1e-300);
        let norm = squares_a[l] + squares_b[l] + squares_c[l];
        let power = (norm / 3.0).sqrt();
        let value = power * norm / 3.0 / chi;
        cost[l] = value;
        let by_norm = 2.0 * (0.5 * power / chi);
        let by_det = -value / chi * slope;
        let (x, y) = (&point.columns, &point.cofactors);
        set(
            &mut slopes,
            l,
            [
                [
                    x[0][0][l] * by_norm + y[0][0][l] * by_det,
                    x[0][1][l] * by_norm + y[0][1][l] * by_det,
                    x[0][2][l] * by_norm + y[0][2][l] * by_det,
                ],
                [
                    x[1][0][l] * by_norm + y[1][0][l] * by_det,
                    x[1][1][l] * by_norm + y[1][1][l] * by_det,
                    x[1][2][l] * by_norm + y[1][2][l] * by_det,
                ],
                [
                    x[2][0][l] * by_norm + y[2][0][l] * by_det,
                    x[2][1][l] * by_norm + y[2][1][l] * by_det,
                    x[2][2][l] * by_norm + y[2][2][l] * by_det,
                ],
            ],
        );
    }
    (cost, slopes)
}

/// That of [`Shape::Scaled`].
#[inline(always)]
fn scaled(point: &Point, power: i32) -> (Lanes, [Vectors; 3]) {
    let [squares_a, squares_b, squares_c] = &point.squares;
    let (mut cost, mut slopes) = ([0.0; LANES], [ZERO; 3]);
    let exponent = f64::from(power);
    for l in 0..LANES {
        let det = point.determinants[l];
        let size = squares_a[l].sqrt() * squares_b[l].sqrt() * squares_c[l].sqrt();
        let value = raised(size / det, power);
        let factor = value * exponent;
        let (x, y) = (&point.columns, &point.cofactors);
        let (p, q, r) = (squares_a[l], squares_b[l], squares_c[l]);
        set(
            &mut slopes,
            l,
            [
                [
                    (x[0][0][l] / p - y[0][0][l] / det) * factor,
                    (x[0][1][l] / p - y[0][1][l] / det) * factor,
                    (x[0][2][l] / p - y[0][2][l] / det) * factor,
                ],
                [
                    (x[1][0][l] / q - y[1][0][l] / det) * factor,
                    (x[1][1][l] / q - y[1][1][l] / det) * factor,
                    (x[1][2][l] / q - y[1][2][l] / det) * factor,
                ],
                [
                    (x[2][0][l] / r - y[2][0][l] / det) * factor,
                    (x[2][1][l] / r - y[2][1][l] / det) * factor,
                    (x[2][2][l] / r - y[2][2][l] / det) * factor,
                ],
            ],
        );
        let is_folded = det <= 1e-9 * size || det <= 0.0;
        cost[l] = if is_folded { f64::INFINITY } else { value };
    }
    (cost, slopes)
}

/// A power with an exponent from 1 to 15, by squarings: without a loop over them, which would go over the cells one by one.
#[inline(always)]
fn raised(base: f64, power: i32) -> f64 {
    let second = base * base;
    let fourth = second * second;
    let one = if power & 1 == 1 { base } else { 1.0 };
    let two = if power & 2 == 2 { second } else { 1.0 };
    let four = if power & 4 == 4 { fourth } else { 1.0 };
    let eight = if power & 8 == 8 { fourth * fourth } else { 1.0 };
    one * two * four * eight
}

#[inline(always)]
fn at_least(x: f64, least: f64) -> f64 {
    if x > least { x } else { least }
}

/// Adds the derivatives with respect to the columns at a point to those with respect to the corners.
#[inline(always)]
fn spread(slopes: &[Vectors; 3], weights: &[[f64; 4]; 3], by_corner: &mut Corners) {
    for (k, _) in ZERO.iter().enumerate() {
        for l in 0..LANES {
            let mut sums = [0.0; 8];
            for corner in 0..8 {
                sums[corner] = by_corner[corner][k][l];
            }
            for axis in 0..3 {
                for edge in 0..4 {
                    let [from, to] = EDGES[axis][edge];
                    let slope = slopes[axis][k][l] * weights[axis][edge];
                    sums[to] += slope;
                    sums[from] -= slope;
                }
            }
            for corner in 0..8 {
                by_corner[corner][k][l] = sums[corner];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn all_cells_cost_what_one_does() {
        let corner = |k: usize, l: usize| {
            let [x, y, z] = pompeiu_volume::CORNER_PLACES[k].map(|side| side as f64);
            let shift = |seed: f64| 0.1 * l as f64 * libm::sin(seed * (8 * l + k + 1) as f64);
            DVec3::new(x + shift(7.1), y + shift(3.3), 1.3 * z + shift(5.7))
        };
        let mut corners = [ZERO; 8];
        for (k, l) in (0..64).map(|n| (n % 8, n / 8)) {
            let p = corner(k, l);
            (corners[k][0][l], corners[k][1][l], corners[k][2][l]) = (p.x, p.y, p.z);
        }
        let places = [0.0, 0.3, 1.0];
        let mut folded = 0;
        for shape in
            [Shape::MeanRatio { epsilon: 0.1 }, Shape::Scaled { power: 3 }, Shape::Scaled { power: 8 }]
        {
            let (mut values, mut by_corner) = (Vec::new(), [ZERO; 8]);
            costs(&corners, &places, shape, &mut values, &mut by_corner);
            for l in 0..LANES {
                let edge = |[from, to]: [usize; 2]| corner(to, l) - corner(from, l);
                let mut slopes = [DVec3::ZERO; 8];
                for (n, value) in values.iter().enumerate() {
                    let weights = weights([places[n / 9], places[n / 3 % 3], places[n % 3]]);
                    let column = |axis: usize| {
                        let [first, others @ ..] = EDGES[axis];
                        let pairs = others.into_iter().zip(&weights[axis][1..]);
                        pairs.fold(edge(first) * weights[axis][0], |sum, (e, w)| sum + edge(e) * *w)
                    };
                    let (cost, by) = shape.cost([0, 1, 2].map(column));
                    assert_eq!(cost.to_bits(), value[l].to_bits(), "{shape:?} {l} {n}");
                    folded += usize::from(cost.is_infinite());
                    for (axis, k) in (0..12).map(|e| (e / 4, e % 4)) {
                        let slope = by[axis] * weights[axis][k];
                        slopes[EDGES[axis][k][1]] += slope;
                        slopes[EDGES[axis][k][0]] -= slope;
                    }
                }
                let is_finite = values.iter().all(|value| value[l].is_finite());
                for (k, axis) in (0..24).map(|n| (n / 3, n % 3)).filter(|_| is_finite) {
                    assert_eq!(
                        slopes[k][axis].to_bits(),
                        by_corner[k][axis][l].to_bits(),
                        "{shape:?} {l} {k}"
                    );
                }
            }
        }
        assert!(folded > 0);
    }
}
