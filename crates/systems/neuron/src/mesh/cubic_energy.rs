//! The shape energy of tricubic cells.

use super::energy::minimise;
use super::shape::Shape;
use super::skin::Skin;
use super::wall::{NearWalls, Wall};
use glam::DVec3;
use pompeiu_core::run::Control;
use pompeiu_volume::bernstein::{bernstein, bernstein_slopes, interpolate};
use pompeiu_volume::slopes_at;

/// Values and derivatives of the four basis functions along an axis at a parameter.
type Row = ([f64; 4], [f64; 4]);

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

/// Regularisation of determinants in mean ratios beside another shape, which keeps them positive.
const EPSILON: f64 = 1e-9;

impl CubicEnergy<'_> {
    /// The energy; writes its gradient with respect to the free positions to `gradient`, and to all of them to `at`.
    fn value(
        &self,
        (positions, [near, near_points]): (&[DVec3], &mut [NearWalls; 2]),
        gradient: &mut [DVec3],
        at: &mut [DVec3],
    ) -> f64 {
        at.fill(DVec3::ZERO);
        let mut total = 0.0;
        let per_point = 1.0 / self.table.len().pow(3) as f64;
        for (cell, &size) in self.cells.iter().zip(self.sizes) {
            let points = cell.map(|v| positions[v as usize] / size);
            let mut slopes = slopes_at(&points, self.table);
            for columns in &mut slopes {
                let (mut cost, mut by) = self.shape.cost(*columns);
                if self.even > 0.0 {
                    let (more, by_more) = Shape::MeanRatio { epsilon: EPSILON }.cost(*columns);
                    cost += self.even * more;
                    by.iter_mut().zip(by_more).for_each(|(by, more)| *by += more * self.even);
                }
                if !cost.is_finite() {
                    return f64::INFINITY;
                }
                total += cost * per_point;
                *columns = by;
            }
            let by_point = gather(&slopes, self.table);
            for (&v, slope) in cell.iter().zip(by_point) {
                at[v as usize] += slope * (per_point / size);
            }
        }
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
        let mut scratch = vec![DVec3::ZERO; positions.len()];
        let on_wall = self.wall.map_or(0, |(_, on_wall, _)| on_wall.len());
        let mut near = [on_wall, self.skin.map_or(0, Skin::points)].map(NearWalls::new);
        minimise((self.free, self.scale), positions, (steps, self.control), |positions, gradient| {
            self.value((positions, &mut near), gradient, &mut scratch)
        })
    }
}

/// The transpose of [`slopes_at`]: from derivatives with respect to the slopes at all points to derivatives with respect to the 64
/// coefficients.
fn gather(by_slope: &[[DVec3; 3]], table: &[Row]) -> [DVec3; 64] {
    let q = table.len();
    let mut along_v = vec![[DVec3::ZERO; 3]; 4 * q * q];
    for (c, (value, slope)) in table.iter().enumerate() {
        for ab in 0..q * q {
            let [du, dv, dw] = by_slope[ab + q * q * c];
            for k in 0..4 {
                let sums = &mut along_v[ab + q * q * k];
                sums[0] += dw * slope[k];
                sums[1] += du * value[k];
                sums[2] += dv * value[k];
            }
        }
    }
    let mut result = [DVec3::ZERO; 64];
    let mut along_u = vec![[DVec3::ZERO; 2]; 16 * q];
    for k in 0..4 {
        for (b, (value, slope)) in table.iter().enumerate() {
            for a in 0..q {
                let [plain, du, dv] = along_v[a + q * (b + q * k)];
                for j in 0..4 {
                    let sums = &mut along_u[a + q * (j + 4 * k)];
                    sums[0] += plain * value[j] + dv * slope[j];
                    sums[1] += du * value[j];
                }
            }
        }
    }
    for jk in 0..16 {
        for (a, (value, slope)) in table.iter().enumerate() {
            let [plain, du] = along_u[a + q * jk];
            for i in 0..4 {
                result[i + 4 * jk] += plain * value[i] + du * slope[i];
            }
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let (mut scratch, mut near) = (vec![DVec3::ZERO; 64], [0, 0].map(NearWalls::new));
            assert!(energy.value((&positions, &mut near), &mut gradient, &mut scratch).is_finite());
            for (k, &v) in free.iter().enumerate() {
                for axis in 0..3 {
                    let mut at = |shift: f64| {
                        positions[v as usize][axis] += shift;
                        let value = energy.value((&positions, &mut near), &mut other, &mut scratch);
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
