//! Lattices on which copies of a shape leave as little of the plane uncovered as possible.

use super::descend::{descend, hinge};
use super::map::Map;
use super::pose::Pose;
use pompeiu_core::mesh::edit::Random;
use pompeiu_core::run::Control;
use pompeiu_planar::Point;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Copies of a shape of area 1, and the two periods of the lattice.
#[derive(Clone, Debug)]
pub(super) struct Lattice {
    pub(super) basis: [Point; 2],
    pub(super) copies: Vec<Pose>,
}

/// The initial symmetry of the copies of a cell; all of them move freely afterwards.
#[derive(Clone, Copy)]
enum Group {
    One,
    HalfTurn,
    Two,
    Mirror,
    QuarterTurns,
    MirroredHalfTurns,
}

const GROUPS: [Group; 6] =
    [Group::One, Group::HalfTurn, Group::Two, Group::Mirror, Group::QuarterTurns, Group::MirroredHalfTurns];

/// Random starts for each group, and how many of them are continued.
const POOL: usize = 80;
const KEPT: usize = 4;

/// Lattices with equal numbers of copies whose energies differ by less than this share count as equal.
const SAME: f64 = 1e-3;

/// Sample points per copy along each side of the cell: for the pool and for the starts kept.
const COARSE: usize = 9;
const FINE: usize = 16;

/// Widths of the hinge.
const POOL_WIDTH: f64 = 0.2;
const WIDTHS: [f64; 3] = [0.15, 0.08, 0.04];

/// The best lattices of a shape, best first; at least one, and those found by then if the control stops the search.
pub(super) fn lattices(map: &Map, count: usize, mirrors: bool, seed: u64, control: &Control) -> Vec<Lattice> {
    let groups: Vec<(usize, Group)> = GROUPS
        .into_iter()
        .enumerate()
        .filter(|(_, group)| mirrors || !matches!(group, Group::Mirror | Group::MirroredHalfTurns))
        .collect();
    let starts: Vec<(usize, usize)> =
        (0..groups.len()).flat_map(|g| (0..POOL).map(move |i| (g, i))).collect();
    let rough: Vec<(usize, Cell)> = starts
        .into_par_iter()
        // The first start is always there, so that there is a lattice.
        .filter(|&start| start == (0, 0) || !control.is_stopped())
        .map(|(g, i)| {
            let (name, group) = groups[g];
            let mut random = Random::new(seed ^ ((name * POOL + i) as u64).wrapping_mul(0x9e37_79b9));
            let mut cell = Cell::random(group, &mut random);
            cell.settle(map, COARSE, POOL_WIDTH, 40, control);
            (g, cell)
        })
        .collect();
    let mut kept: Vec<Cell> = Vec::new();
    for g in 0..groups.len() {
        let mut of_group: Vec<&Cell> =
            rough.iter().filter(|(of, _)| *of == g).map(|(_, cell)| cell).collect();
        of_group.sort_by(|a, b| a.energy.total_cmp(&b.energy));
        kept.extend(of_group.into_iter().take(KEPT).cloned());
    }
    let mut fine: Vec<Cell> = kept
        .into_par_iter()
        .map(|mut cell| {
            for width in WIDTHS {
                if control.is_stopped() {
                    break;
                }
                cell.reduce();
                cell.settle(map, FINE, width, 60, control);
            }
            cell
        })
        .collect();
    fine.sort_by(|a, b| a.energy.total_cmp(&b.energy));
    fine.dedup_by(|b, a| {
        a.mirrored.len() == b.mirrored.len() && (b.energy - a.energy).abs() <= SAME * a.energy
    });
    fine.truncate(count);
    fine.iter().map(Cell::lattice).collect()
}

#[derive(Clone)]
struct Cell {
    /// The two basis vectors, then the position of each copy in that basis and its angle.
    numbers: Vec<f64>,
    mirrored: Vec<bool>,
    energy: f64,
}

impl Cell {
    fn random(group: Group, random: &mut Random) -> Self {
        let mut unit = || 0.5 + 0.5 * random.signed_unit();
        let angle = TAU * unit();
        let other = TAU * unit();
        let copies: Vec<(f64, bool)> = match group {
            Group::One => vec![(angle, false)],
            Group::HalfTurn => vec![(angle, false), (angle + PI, false)],
            Group::Two => vec![(angle, false), (other, false)],
            Group::Mirror => vec![(angle, false), (other, true)],
            Group::QuarterTurns => (0..4).map(|i| (angle + FRAC_PI_2 * f64::from(i), false)).collect(),
            Group::MirroredHalfTurns => {
                vec![(angle, false), (angle + PI, false), (other, true), (other + PI, true)]
            }
        };
        let area = copies.len() as f64;
        // A reduced basis: the projection of the second vector on the first is at most half of the first.
        let lean = unit() - 0.5;
        let rise = 0.7 * libm::exp(1.4 * unit());
        let length = (area / rise).sqrt();
        let mut numbers = vec![length, 0.0, lean * length, rise * length];
        for (angle, _) in &copies {
            numbers.extend([unit(), unit(), *angle]);
        }
        let mirrored = copies.into_iter().map(|(_, is_mirrored)| is_mirrored).collect();
        Self { numbers, mirrored, energy: f64::INFINITY }
    }

    fn settle(&mut self, map: &Map, per_side: usize, width: f64, steps: usize, control: &Control) {
        let mirrored = self.mirrored.clone();
        let energy =
            |x: &[f64], gradient: &mut [f64]| uncovered(map, x, &mirrored, per_side, width, gradient);
        self.energy = descend(&mut self.numbers, 0.3, steps, energy, |_| !control.is_stopped());
    }

    /// The reduced basis of the same lattice.
    fn reduce(&mut self) {
        for _ in 0..50 {
            let x = &self.numbers;
            let (u, v) = ([x[0], x[1]], [x[2], x[3]]);
            let dot = |a: Point, b: Point| a[0] * b[0] + a[1] * b[1];
            let k = (dot(u, v) / dot(u, u)).round();
            // f u + g v = (f + k g) u + g (v − k u).
            let lean = [v[0] - k * u[0], v[1] - k * u[1]];
            let swap = dot(lean, lean) < dot(u, u);
            let (first, second) = if swap { (lean, [-u[0], -u[1]]) } else { (u, lean) };
            self.numbers[..4].copy_from_slice(&[first[0], first[1], second[0], second[1]]);
            for copy in self.numbers[4..].chunks_exact_mut(3) {
                let (f, g) = (copy[0] + k * copy[1], copy[1]);
                (copy[0], copy[1]) = if swap { (g, -f) } else { (f, g) };
            }
            if !swap {
                return;
            }
        }
    }

    fn lattice(&self) -> Lattice {
        let x = &self.numbers;
        let scale = (self.mirrored.len() as f64 / (x[0] * x[3] - x[1] * x[2])).sqrt();
        let basis = [[scale * x[0], scale * x[1]], [scale * x[2], scale * x[3]]];
        let copies = x[4..].chunks_exact(3).zip(&self.mirrored).map(|(copy, is_mirrored)| Pose {
            place: [0, 1].map(|k| copy[0] * basis[0][k] + copy[1] * basis[1][k]),
            angle: copy[2],
            is_mirrored: *is_mirrored,
        });
        Lattice { basis, copies: copies.collect() }
    }
}

/// The uncovered share of a cell, and its gradient; the basis is scaled so that the cell has the area of its copies.
fn uncovered(
    map: &Map,
    x: &[f64],
    mirrored: &[bool],
    per_side: usize,
    width: f64,
    gradient: &mut [f64],
) -> f64 {
    gradient.fill(0.0);
    let copies = mirrored.len();
    let determinant = x[0] * x[3] - x[1] * x[2];
    if determinant < 1e-3 {
        return f64::INFINITY;
    }
    let scale = (copies as f64 / determinant).sqrt();
    let basis = [x[0], x[1], x[2], x[3]].map(|v| scale * v);
    let poses: Vec<_> = (0..copies)
        .map(|j| Pose { place: [0.0; 2], angle: x[6 + 3 * j], is_mirrored: mirrored[j] }.turn())
        .collect();
    let count = (per_side as f64 * (copies as f64).sqrt()) as usize;
    let radius = map.radius();
    let mut total = 0.0;
    let mut by_basis = [0.0; 4];
    for i in 0..count * count {
        let (column, row) = (i % count, i / count);
        let f = [(column as f64 + 0.5) / count as f64, (row as f64 + 0.5) / count as f64];
        let mut best = (f64::INFINITY, 0, [0.0; 2], [0.0; 2]);
        for j in 0..copies {
            let near = [f[0] - x[4 + 3 * j], f[1] - x[5 + 3 * j]];
            let near = [near[0] - near[0].round(), near[1] - near[1].round()];
            for z in 0..9_i32 {
                let g = [near[0] + f64::from(z % 3 - 1), near[1] + f64::from(z / 3 - 1)];
                let q = [g[0] * basis[0] + g[1] * basis[2], g[0] * basis[1] + g[1] * basis[3]];
                let reach = best.0.max(-radius) + radius;
                if q[0] * q[0] + q[1] * q[1] >= reach * reach {
                    continue;
                }
                let value = map.value(poses[j].to_shape(q));
                if value < best.0 {
                    best = (value, j, g, q);
                }
            }
        }
        let (value, j, g, q) = best;
        let (rise, slope) = hinge(value, width);
        total += rise;
        if slope > 0.0 {
            let (_, [dx, dy, turn]) = poses[j].with_gradient(map, q);
            // The derivatives are those for moving the copy; moving the point has the opposite sign.
            let along = [-slope * dx, -slope * dy];
            for k in 0..2 {
                by_basis[k] += along[k] * g[0];
                by_basis[2 + k] += along[k] * g[1];
                gradient[4 + 3 * j + k] -= along[0] * basis[2 * k] + along[1] * basis[2 * k + 1];
            }
            gradient[6 + 3 * j] += slope * turn;
        }
    }
    let norm = 1.0 / (count * count) as f64;
    // Through the scale, which depends on the determinant.
    let trace: f64 = (0..4).map(|k| by_basis[k] * x[k]).sum();
    let inverse = [x[3], -x[2], -x[1], x[0]].map(|v| v / determinant);
    for k in 0..4 {
        gradient[k] = scale * (by_basis[k] - 0.5 * trace * inverse[k]);
    }
    for g in gradient {
        *g *= norm;
    }
    total * norm
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::gauge::{Answer, Variant};
    use crate::shape::target::Target;
    use crate::{PieceName, PieceShape};

    #[test]
    fn the_gradient_is_that_of_the_energy() {
        let target = Target::new(&PieceShape::Built(PieceName::Fish).outline().unwrap());
        let map = Map::new(&target.outline, Answer::SignedDistance, Variant::Edges, 256);
        let mut random = Random::new(5);
        let cell = Cell::random(Group::MirroredHalfTurns, &mut random);
        let mut gradient = vec![0.0; cell.numbers.len()];
        let mut unused = gradient.clone();
        uncovered(&map, &cell.numbers, &cell.mirrored, 30, 0.3, &mut gradient);
        for k in 0..cell.numbers.len() {
            let mut at = |h: f64| {
                let mut x = cell.numbers.clone();
                x[k] += h;
                uncovered(&map, &x, &cell.mirrored, 30, 0.3, &mut unused)
            };
            let slope = (at(1e-4) - at(-1e-4)) / 2e-4;
            assert!((slope - gradient[k]).abs() < 3e-3, "{k}: {slope} {}", gradient[k]);
        }
    }
}
