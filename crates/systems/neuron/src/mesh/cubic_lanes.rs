//! The shape energy of eight tricubic cells at a time.
//!
//! Sums over the four basis functions of each axis are nested, so that a point costs little more than its shape, and derivatives are summed on
//! the way back. As for trilinear cells, functions go over all cells one operation at a time, without closures, and each
//! cell's operations are in the order of [`pompeiu_volume::slopes_at`], so the bits are the same on all instruction sets.

#![allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]

use super::energy_lanes::{LANES, Lanes, Point, Vectors, ZERO};
use super::shape::Shape;
use multiversion::multiversion;

/// Values and derivatives of the four basis functions along an axis at a parameter.
pub(super) type Row = ([f64; 4], [f64; 4]);

/// A vector for each of the 64 coefficients of the cells, the first axis fastest.
pub(super) type Coefficients = [Vectors; 64];

/// Regularisation of determinants in mean ratios beside another shape, which keeps them positive.
const EPSILON: f64 = 1e-9;

/// The energy densities of cells at all combinations of the parameters of the table, the first axis fastest, with a weight of mean ratios beside the
/// shape; and the derivatives of the sum over these with respect to the coefficients.
#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
pub(super) fn cubic_costs(
    coefficients: &Coefficients,
    table: &[Row],
    shape: (Shape, f64),
    values: &mut Vec<Lanes>,
    by_coefficient: &mut Coefficients,
) {
    let count = table.len();
    values.clear();
    values.resize(count * count * count, ZERO[0]);
    *by_coefficient = [ZERO; 64];
    for a in 0..count {
        let (value, slope) = &table[a];
        // The cells on a plane across the first axis, and their derivatives along it.
        let mut plane = [[ZERO; 16]; 2];
        for n in 0..16 {
            for i in 0..4 {
                add_multiple(&mut plane[0][n], &coefficients[i + 4 * n], value[i]);
                add_multiple(&mut plane[1][n], &coefficients[i + 4 * n], slope[i]);
            }
        }
        let mut by_plane = [[ZERO; 16]; 2];
        for b in 0..count {
            cost_of_row(&plane, [a, b], table, shape, values, &mut by_plane);
        }
        for n in 0..16 {
            for i in 0..4 {
                let by = [&by_plane[0][n], &by_plane[1][n]];
                add_both(&mut by_coefficient[i + 4 * n], by, [value[i], slope[i]]);
            }
        }
    }
}

/// The energy densities along a row of a plane.
#[inline(always)]
fn cost_of_row(
    plane: &[[Vectors; 16]; 2],
    [a, b]: [usize; 2],
    table: &[Row],
    (shape, even): (Shape, f64),
    values: &mut [Lanes],
    by_plane: &mut [[Vectors; 16]; 2],
) {
    let count = table.len();
    let (value, slope) = &table[b];
    // What is interpolated along the row to the derivatives along each axis.
    let mut rows = [[ZERO; 4]; 3];
    for k in 0..4 {
        for j in 0..4 {
            add_multiple(&mut rows[0][k], &plane[1][j + 4 * k], value[j]);
            add_multiple(&mut rows[1][k], &plane[0][j + 4 * k], slope[j]);
            add_multiple(&mut rows[2][k], &plane[0][j + 4 * k], value[j]);
        }
    }
    let mut by_rows = [[ZERO; 4]; 3];
    for c in 0..count {
        let weights = [&table[c].0, &table[c].0, &table[c].1];
        let mut columns = [ZERO; 3];
        for axis in 0..3 {
            for k in 0..4 {
                add_multiple(&mut columns[axis], &rows[axis][k], weights[axis][k]);
            }
        }
        let point = Point::of_columns(&columns);
        let (mut cost, mut by_column) = point.cost(shape);
        if even > 0.0 {
            let (more, by_more) = point.cost(Shape::MeanRatio { epsilon: EPSILON });
            for l in 0..LANES {
                cost[l] += even * more[l];
            }
            for axis in 0..3 {
                add_multiple(&mut by_column[axis], &by_more[axis], even);
            }
        }
        values[a + count * (b + count * c)] = cost;
        for axis in 0..3 {
            for k in 0..4 {
                add_multiple(&mut by_rows[axis][k], &by_column[axis], weights[axis][k]);
            }
        }
    }
    for k in 0..4 {
        for j in 0..4 {
            let by = [&by_rows[2][k], &by_rows[1][k]];
            add_both(&mut by_plane[0][j + 4 * k], by, [value[j], slope[j]]);
            add_multiple(&mut by_plane[1][j + 4 * k], &by_rows[0][k], value[j]);
        }
    }
}

/// Adds a sum of two multiples of vectors.
#[inline(always)]
fn add_both(to: &mut Vectors, more: [&Vectors; 2], factors: [f64; 2]) {
    for k in 0..3 {
        for l in 0..LANES {
            to[k][l] += more[0][k][l] * factors[0] + more[1][k][l] * factors[1];
        }
    }
}

/// Adds a multiple of vectors.
#[inline(always)]
fn add_multiple(to: &mut Vectors, more: &Vectors, factor: f64) {
    for k in 0..3 {
        for l in 0..LANES {
            to[k][l] += more[k][l] * factor;
        }
    }
}
