//! The equations on one tricubic cell.

use glam::{DMat3, DVec3};
use pompeiu_volume::bernstein::{GAUSS_4, GAUSS_5, bernstein, bernstein_slopes, value};
use pompeiu_volume::{bezier_volume, face_points, slopes_at};

/// Coefficients of the pressure in each cell: polynomials of degree two.
pub(super) const PRESSURES: usize = 10;

/// Unknowns of a cell: 64 coefficients of three components, then the pressure.
pub(super) const UNKNOWNS: usize = 3 * 64 + PRESSURES;

/// The basis functions at the points of a quadrature rule.
struct Rule {
    lines: Vec<([f64; 4], [f64; 4])>,
    weights: Vec<f64>,
    places: Vec<[f64; 3]>,
    values: Vec<[f64; 64]>,
    slopes: Vec<[DVec3; 64]>,
}

impl Rule {
    fn new(points: &[(f64, f64)]) -> Self {
        let lines: Vec<_> = points.iter().map(|&(t, _)| (bernstein(t), bernstein_slopes(t))).collect();
        let n = points.len();
        let (mut weights, mut places) = (Vec::new(), Vec::new());
        let (mut values, mut slopes) = (Vec::new(), Vec::new());
        for q in 0..n * n * n {
            let at = [q % n, q / n % n, q / n / n];
            let [a, b, c] = at.map(|k| lines[k]);
            weights.push(at.iter().map(|&k| points[k].1).product());
            places.push(at.map(|k| points[k].0));
            values.push(std::array::from_fn(|l| a.0[l % 4] * b.0[l / 4 % 4] * c.0[l / 16]));
            slopes.push(std::array::from_fn(|l| {
                let [i, j, k] = [l % 4, l / 4 % 4, l / 16];
                DVec3::new(a.1[i] * b.0[j] * c.0[k], a.0[i] * b.1[j] * c.0[k], a.0[i] * b.0[j] * c.1[k])
            }));
        }
        Self { lines, weights, places, values, slopes }
    }

    /// For each point the weight times the determinant, and the gradients of all basis functions.
    fn gradients(&self, points: &[DVec3; 64]) -> Vec<(f64, [DVec3; 64])> {
        let of = |(q, [du, dv, dw]): (usize, [DVec3; 3])| {
            let jacobian = DMat3::from_cols(du, dv, dw);
            let inverse = jacobian.inverse().transpose();
            (self.weights[q] * jacobian.determinant(), self.slopes[q].map(|slope| inverse * slope))
        };
        slopes_at(points, &self.lines).into_iter().enumerate().map(of).collect()
    }
}

/// Quadrature rules: four points per axis for momentum, five for mass, which is then exact.
pub(super) struct Tables {
    momentum: Rule,
    mass: Rule,
}

impl Tables {
    pub(super) fn new() -> Self {
        Self { momentum: Rule::new(&GAUSS_4), mass: Rule::new(&GAUSS_5) }
    }
}

/// A cell with its pressure polynomials, in coordinates relative to its centre and in units of its size.
pub(super) struct Cell<'c> {
    tables: &'c Tables,
    points: [DVec3; 64],
    middle: DVec3,
    size: f64,
}

impl<'c> Cell<'c> {
    pub(super) fn new(tables: &'c Tables, points: &[DVec3; 64]) -> Self {
        let middle = value(points, [0.5; 3]);
        let size = bezier_volume(points).abs().cbrt().max(f64::MIN_POSITIVE);
        Self { tables, points: *points, middle, size }
    }

    /// The pressure polynomials at a position.
    pub(super) fn pressures(&self, position: DVec3) -> [f64; PRESSURES] {
        let [x, y, z] = ((position - self.middle) / self.size).to_array();
        [1.0, x, y, z, x * x, x * y, x * z, y * y, y * z, z * z]
    }

    /// Adds the matrix of the linear terms, row by row: unit viscosity, pressure, and mass.
    pub(super) fn add_linear(&self, matrix: &mut [f64]) {
        let mut stiffness = vec![0.0; 64 * 64];
        for (weight, gradients) in self.tables.momentum.gradients(&self.points) {
            let columns: [[f64; 64]; 3] = [0, 1, 2].map(|axis| gradients.map(|g| g[axis]));
            for i in 0..64 {
                let row = &mut stiffness[64 * i..64 * (i + 1)];
                let [a, b, c] = [0, 1, 2].map(|axis| weight * columns[axis][i]);
                for j in 0..64 {
                    row[j] += a * columns[0][j] + b * columns[1][j] + c * columns[2][j];
                }
            }
        }
        for i in 0..64 {
            for j in 0..64 {
                for axis in 0..3 {
                    matrix[UNKNOWNS * (3 * i + axis) + 3 * j + axis] += stiffness[64 * i + j];
                }
            }
        }
        let rule = &self.tables.mass;
        for (q, (weight, gradients)) in rule.gradients(&self.points).into_iter().enumerate() {
            let pressures = self.pressures(value(&self.points, rule.places[q]));
            for (k, pressure) in pressures.into_iter().enumerate() {
                for (i, gradient) in gradients.iter().enumerate() {
                    for axis in 0..3 {
                        let entry = -weight * pressure * gradient[axis];
                        matrix[UNKNOWNS * (3 * i + axis) + 192 + k] += entry;
                        matrix[UNKNOWNS * (192 + k) + 3 * i + axis] += entry;
                    }
                }
            }
        }
    }

    /// Adds the derivative of the convection term at a velocity, times a factor.
    pub(super) fn add_convection(&self, velocity: &[DVec3; 64], factor: f64, matrix: &mut [f64]) {
        let rule = &self.tables.momentum;
        let mut carried = vec![0.0; 64 * 64];
        let mut carrying = vec![0.0; 9 * 64 * 64];
        for (q, (weight, gradients)) in rule.gradients(&self.points).into_iter().enumerate() {
            let values = &rule.values[q];
            let (u, slopes) = field_at(velocity, values, &gradients);
            let along = gradients.map(|g| g.dot(u));
            let weight = weight * factor;
            for i in 0..64 {
                let share = weight * values[i];
                let row = &mut carried[64 * i..64 * (i + 1)];
                for j in 0..64 {
                    row[j] += share * along[j];
                }
            }
            // Row: the velocity component; column: the direction of convection.
            for component in 0..3 {
                for direction in 0..3 {
                    let slope = weight * slopes[component][direction];
                    let block = &mut carrying[4096 * (3 * component + direction)..][..4096];
                    for i in 0..64 {
                        let share = slope * values[i];
                        for (entry, value) in block[64 * i..64 * (i + 1)].iter_mut().zip(values) {
                            *entry += share * value;
                        }
                    }
                }
            }
        }
        for i in 0..64 {
            for j in 0..64 {
                for a in 0..3 {
                    let row = &mut matrix[UNKNOWNS * (3 * i + a) + 3 * j..][..3];
                    row[a] += carried[64 * i + j];
                    for (b, entry) in row.iter_mut().enumerate() {
                        *entry += carrying[4096 * (3 * a + b) + 64 * i + j];
                    }
                }
            }
        }
    }

    /// The residual: momentum without tractions for each function and component, then mass.
    pub(super) fn residual(
        &self,
        velocity: &[DVec3; 64],
        pressure: &[f64; PRESSURES],
        factor: f64,
        force: Option<&(dyn Fn(DVec3) -> DVec3 + Sync)>,
    ) -> [f64; UNKNOWNS] {
        let mut result = [0.0; UNKNOWNS];
        let rule = &self.tables.momentum;
        for (q, (weight, gradients)) in rule.gradients(&self.points).into_iter().enumerate() {
            let values = &rule.values[q];
            let (u, slopes) = field_at(velocity, values, &gradients);
            let mut body = DVec3::from_array(slopes.map(|slope| slope.dot(u))) * factor;
            if let Some(force) = force {
                body -= force(value(&self.points, rule.places[q]));
            }
            for i in 0..64 {
                for axis in 0..3 {
                    result[3 * i + axis] +=
                        weight * (slopes[axis].dot(gradients[i]) + values[i] * body[axis]);
                }
            }
        }
        let rule = &self.tables.mass;
        for (q, (weight, gradients)) in rule.gradients(&self.points).into_iter().enumerate() {
            let pressures = self.pressures(value(&self.points, rule.places[q]));
            let p: f64 = pressures.iter().zip(pressure).map(|(a, b)| a * b).sum();
            let divergence: f64 = gradients.iter().zip(velocity).map(|(g, u)| g.dot(*u)).sum();
            for (i, gradient) in gradients.iter().enumerate() {
                for axis in 0..3 {
                    result[3 * i + axis] -= weight * p * gradient[axis];
                }
            }
            for (k, q) in pressures.into_iter().enumerate() {
                result[192 + k] -= weight * divergence * q;
            }
        }
        result
    }

    /// Adds the traction of a pressure on a face.
    pub(super) fn add_traction(&self, face: usize, pressure: f64, result: &mut [f64; UNKNOWNS]) {
        for (place, area) in face_points(&self.points, face) {
            let [a, b, c] = place.map(bernstein);
            for i in 0..64 {
                let weight = a[i % 4] * b[i / 4 % 4] * c[i / 16] * pressure;
                for axis in 0..3 {
                    result[3 * i + axis] += weight * area[axis];
                }
            }
        }
    }

    /// The integrals over a face of the pressure and of the constant one.
    pub(super) fn face_pressure(&self, face: usize, pressure: &[f64; PRESSURES]) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for (place, area) in face_points(&self.points, face) {
            let pressures = self.pressures(value(&self.points, place));
            let p: f64 = pressures.iter().zip(pressure).map(|(a, b)| a * b).sum();
            sums[0] += area.length() * p;
            sums[1] += area.length();
        }
        sums
    }

    /// The pressure at a parameter of the cell.
    pub(super) fn pressure_at(&self, place: [f64; 3], pressure: &[f64; PRESSURES]) -> f64 {
        self.pressures(value(&self.points, place)).iter().zip(pressure).map(|(a, b)| a * b).sum()
    }
}

/// A velocity and the gradients of its components.
fn field_at(velocity: &[DVec3; 64], values: &[f64; 64], gradients: &[DVec3; 64]) -> (DVec3, [DVec3; 3]) {
    let mut u = DVec3::ZERO;
    let mut slopes = [DVec3::ZERO; 3];
    for i in 0..64 {
        u += velocity[i] * values[i];
        for (axis, slope) in slopes.iter_mut().enumerate() {
            *slope += gradients[i] * velocity[i][axis];
        }
    }
    (u, slopes)
}
