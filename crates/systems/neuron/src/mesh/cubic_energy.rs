//! The shape energy of tricubic cells.

use super::cubic_lanes::{Coefficients, Row, cubic_costs};
use super::energy::minimise;
use super::energy_lanes::{LANES, Lanes, ZERO};
use super::shape::Shape;
use super::skin::Skin;
use super::wall::{NearWalls, Wall};
use glam::DVec3;
use pompeiu_core::run::Control;
use pompeiu_volume::bernstein::{bernstein, bernstein_slopes, interpolate};
use pompeiu_volume::slopes_at;

/// The objective over the positions at thirds of tricubic cells.
pub(super) struct CubicEnergy<'e> {
    pub(super) cells: &'e [[u32; 64]],
    /// Positions that may move.
    pub(super) free: &'e [u32],
    pub(super) shape: Shape,
    /// The weight of mean ratios beside the shape: scaled Jacobians alone permit derivatives that vanish at a point, next to which they are small.
    pub(super) even: f64,
    /// The wall, the positions on it, and the weight of leaving it.
    pub(super) wall: Option<(&'e Wall, &'e [u32], f64)>,
    /// Faces on the wall whose distance from it counts, not only that of positions.
    pub(super) skin: Option<&'e Skin<16>>,
    /// The size of the node, which makes steps and distances dimensionless.
    pub(super) scale: f64,
    /// The size of each cell, which makes its energy dimensionless: regularisation is relative to it.
    pub(super) sizes: &'e [f64],
    pub(super) table: &'e [Row],
    /// May end the minimisation early.
    pub(super) control: &'e Control,
}

/// Parameters along each axis of a cell at which its shape is measured: denser at the ends, where a cubic curves most.
pub(super) const PLACES: [f64; 7] = [0.0, 0.08, 0.25, 0.5, 0.75, 0.92, 1.0];

/// Parameters for cells that fold between the others.
pub(super) const MANY_PLACES: [f64; 13] =
    [0.0, 0.04, 0.1, 0.18, 0.28, 0.39, 0.5, 0.61, 0.72, 0.82, 0.9, 0.96, 1.0];

/// The cubic Lagrange polynomials of the thirds, at the parameters where shape is measured.
pub(super) fn lagrange_table(places: &[f64]) -> Vec<Row> {
    let unit = |k: usize| interpolate(std::array::from_fn(|r| if r == k { 1.0 } else { 0.0 }));
    let columns = [0, 1, 2, 3].map(unit);
    let row = |weights: [f64; 4]| columns.map(|c: [f64; 4]| (0..4).map(|r| weights[r] * c[r]).sum());
    places.iter().map(|&t| (row(bernstein(t)), row(bernstein_slopes(t)))).collect()
}

/// What an energy keeps from one evaluation to the next.
struct Scratch {
    /// The gradient with respect to all positions.
    at: Vec<DVec3>,
    /// The parts of the wall near the positions on it, and near the points of faces.
    near: [NearWalls; 2],
    /// Some cells, their costs at points, and the derivatives of their sum.
    coefficients: Box<Coefficients>,
    values: Vec<Lanes>,
    by_coefficient: Box<Coefficients>,
}

impl CubicEnergy<'_> {
    /// For evaluations with this many positions.
    fn scratch(&self, positions: usize) -> Scratch {
        let on_wall = self.wall.map_or(0, |(_, on_wall, _)| on_wall.len());
        Scratch {
            at: vec![DVec3::ZERO; positions],
            near: [on_wall, self.skin.map_or(0, Skin::points)].map(NearWalls::new),
            coefficients: Box::new([ZERO; 64]),
            values: Vec::new(),
            by_coefficient: Box::new([ZERO; 64]),
        }
    }

    /// The energy; writes its gradient with respect to the free positions to `gradient`.
    fn value(&self, positions: &[DVec3], gradient: &mut [DVec3], scratch: &mut Scratch) -> f64 {
        scratch.at.fill(DVec3::ZERO);
        let mut total = 0.0;
        for (cells, sizes) in self.cells.chunks(LANES).zip(self.sizes.chunks(LANES)) {
            self.add_cells((cells, sizes), positions, scratch, &mut total);
            if !total.is_finite() {
                return f64::INFINITY;
            }
        }
        let Scratch { at, near: [near, near_points], .. } = scratch;
        if let Some((wall, places, weight)) = self.wall {
            wall.add_cost((places, weight), self.scale, (positions, near), &mut total, at);
        }
        if let Some(skin) = self.skin {
            skin.add_cost((positions, near_points), &mut total, at);
        }
        for (g, &v) in gradient.iter_mut().zip(self.free) {
            *g = at[v as usize];
        }
        total
    }

    /// Adds the shape energy of up to [`LANES`] cells, and its gradient with respect to all positions.
    fn add_cells(
        &self,
        (cells, sizes): (&[[u32; 64]], &[f64]),
        positions: &[DVec3],
        scratch: &mut Scratch,
        total: &mut f64,
    ) {
        let Scratch { at, coefficients, values, by_coefficient, .. } = scratch;
        for lane in 0..LANES {
            // Places without a cell repeat the last one.
            let (cell, size) = (cells[lane.min(cells.len() - 1)], sizes[lane.min(cells.len() - 1)]);
            for (coefficient, v) in coefficients.iter_mut().zip(cell) {
                let p = positions[v as usize] / size;
                (coefficient[0][lane], coefficient[1][lane], coefficient[2][lane]) = (p.x, p.y, p.z);
            }
        }
        cubic_costs(coefficients, self.table, (self.shape, self.even), values, by_coefficient);
        let per_point = 1.0 / self.table.len().pow(3) as f64;
        for (lane, (cell, size)) in cells.iter().zip(sizes).enumerate() {
            for costs in values.iter() {
                *total += costs[lane] * per_point;
            }
            for (&v, slopes) in cell.iter().zip(by_coefficient.iter()) {
                let slope = DVec3::new(slopes[0][lane], slopes[1][lane], slopes[2][lane]);
                at[v as usize] += slope * (per_point / size);
            }
        }
    }

    /// The least scaled Jacobian at the parameters where shape is measured.
    pub(super) fn quality(&self, positions: &[DVec3]) -> f64 {
        let mut least = f64::INFINITY;
        for cell in self.cells {
            for [a, b, c] in slopes_at(&cell.map(|v| positions[v as usize]), self.table) {
                let scaled = a.dot(b.cross(c)) / (a.length() * b.length() * c.length());
                least = if scaled >= least { least } else { scaled };
            }
        }
        if least.is_nan() { 0.0 } else { least }
    }

    /// Minimises the energy over the free positions.
    pub(super) fn minimise(&self, positions: &mut [DVec3], steps: usize) -> f64 {
        let mut scratch = self.scratch(positions.len());
        minimise((self.free, self.scale), positions, (steps, self.control), |positions, gradient| {
            self.value(positions, gradient, &mut scratch)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energies_are_sums_over_cells_and_points() {
        let count = 11;
        let place = |(cell, k): (u32, u32)| {
            let [x, y, z] = [k % 4, k / 4 % 4, k / 16].map(|i| f64::from(i) / 3.0);
            let shift = |seed: f64| 0.02 * libm::sin(seed * f64::from(64 * cell + k + 1));
            DVec3::new(x + shift(7.1), y + shift(3.3), 1.3 * z + shift(5.7))
        };
        let numbers = (0..count).flat_map(|cell| (0..64).map(move |k| (cell, k)));
        let positions: Vec<DVec3> = numbers.map(place).collect();
        let cells: Vec<[u32; 64]> =
            (0..count).map(|cell| std::array::from_fn(|k| 64 * cell + k as u32)).collect();
        let sizes: Vec<f64> = (0..count).map(|cell| 0.7 + 0.1 * f64::from(cell)).collect();
        let table = lagrange_table(&PLACES);
        for (shape, even) in [(Shape::MeanRatio { epsilon: 0.3 }, 0.0), (Shape::Scaled { power: 2 }, 0.5)] {
            let energy = CubicEnergy {
                cells: &cells,
                free: &[],
                shape,
                even,
                wall: None,
                skin: None,
                scale: 1.0,
                sizes: &sizes,
                table: &table,
                control: &Control::default(),
            };
            let cost = |columns: [DVec3; 3]| {
                let more = Shape::MeanRatio { epsilon: 1e-9 }.cost(columns).0;
                shape.cost(columns).0 + if even > 0.0 { even * more } else { 0.0 }
            };
            let of_cell = |(cell, size): (&[u32; 64], &f64)| -> f64 {
                let points = cell.map(|v| positions[v as usize] / *size);
                slopes_at(&points, &table).into_iter().map(cost).sum::<f64>() / 343.0
            };
            let expected: f64 = cells.iter().zip(&sizes).map(of_cell).sum();
            let found = energy.value(&positions, &mut [], &mut energy.scratch(positions.len()));
            assert!((found - expected).abs() < 1e-11 * expected, "{found} {expected}");
        }
    }

    #[test]
    fn gradients_are_differences() {
        let place = |k: u32| {
            let [x, y, z] = [k % 4, k / 4 % 4, k / 16].map(|i| f64::from(i) / 3.0);
            let shift = |seed: f64| 0.04 * libm::sin(seed * f64::from(k + 1));
            DVec3::new(x + shift(7.1), y + shift(3.3), 1.3 * z + shift(5.7))
        };
        let mut positions: Vec<DVec3> = (0..64).map(place).collect();
        let cells = [std::array::from_fn(|k| k as u32)];
        let free = [0, 21, 63, 42];
        let table = lagrange_table(&PLACES);
        for (shape, even) in [(Shape::MeanRatio { epsilon: 0.3 }, 0.0), (Shape::Scaled { power: 2 }, 0.5)] {
            let control = &Control::default();
            let (wall, scale, table) = (None, 0.8, table.as_slice());
            let sizes = &[0.7];
            let energy = CubicEnergy {
                cells: &cells,
                free: &free,
                shape,
                even,
                wall,
                skin: None,
                scale,
                sizes,
                table,
                control,
            };
            let (mut gradient, mut other) = (vec![DVec3::ZERO; 4], vec![DVec3::ZERO; 4]);
            let mut scratch = energy.scratch(64);
            assert!(energy.value(&positions, &mut gradient, &mut scratch).is_finite());
            for (k, &v) in free.iter().enumerate() {
                for axis in 0..3 {
                    let mut at = |shift: f64| {
                        positions[v as usize][axis] += shift;
                        let value = energy.value(&positions, &mut other, &mut scratch);
                        positions[v as usize][axis] -= shift;
                        value
                    };
                    let difference = (at(1e-6) - at(-1e-6)) / 2e-6;
                    assert!(
                        (difference - gradient[k][axis]).abs() < 1e-6 * (1.0 + difference.abs()),
                        "{difference} {:?}",
                        gradient[k]
                    );
                }
            }
        }
    }
}
