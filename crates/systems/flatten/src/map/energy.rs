//! The symmetric Dirichlet energy of triangles, its gradient, and its Hessian projected to be positive semi-definite.

use pompeiu_surface::Surface;
use pompeiu_surface::plane::{Vec2, add, cross, scale, sub};
use rayon::prelude::*;

/// Triangles per task.
const CHUNK: usize = 2048;

/// Triangles with their target shapes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Elements {
    pub(crate) corners: Vec<[u32; 3]>,
    /// Gradients of the hat functions, in the frame of the target shape.
    gradients: Vec<[Vec2; 3]>,
    /// Share of each triangle in the energy.
    weights: Vec<f64>,
}

/// Gradient and Hessian of one triangle; the coordinates of its corners are interleaved.
pub(crate) struct Local {
    pub(crate) gradient: [f64; 6],
    pub(crate) hessian: [[f64; 6]; 6],
}

impl Elements {
    /// The faces of a surface, weighted by area; the weights sum to one.
    pub(crate) fn of_surface(surface: &Surface) -> Self {
        let mesh = surface.mesh();
        let area = surface.area();
        let mut elements = Self::default();
        for face in mesh.face_ids() {
            elements.push(
                mesh.face(face).map(|v| v.0),
                surface.corners(face),
                surface.face_area(face) / area,
            );
        }
        elements
    }

    /// Triangles with their current shape as target and equal weights, even if they are thin, so that they resist compression; the
    /// weights sum to `weight`.
    pub(crate) fn of_triangles(corners: &[[u32; 3]], places: &[Vec2], weight: f64) -> Self {
        let mut elements = Self::default();
        for &t in corners {
            elements.push(t, t.map(|v| places[v as usize]), weight / corners.len() as f64);
        }
        elements
    }

    fn push(&mut self, corners: [u32; 3], places: [Vec2; 3], weight: f64) {
        self.corners.push(corners);
        self.gradients.push(gradients(places));
        self.weights.push(weight);
    }

    fn derivative(&self, m: usize, x: &[Vec2]) -> [Vec2; 2] {
        let mut j = [[0.0; 2]; 2];
        for (v, g) in self.corners[m].iter().zip(&self.gradients[m]) {
            let p = x[*v as usize];
            for r in 0..2 {
                for c in 0..2 {
                    j[r][c] += p[r] * g[c];
                }
            }
        }
        j
    }

    /// The energy; infinite unless every triangle keeps its orientation.
    pub(crate) fn value(&self, x: &[Vec2]) -> f64 {
        let one = |m: usize| {
            let [[a, b], [c, d]] = self.derivative(m, x);
            let determinant = a * d - b * c;
            if determinant > 0.0 {
                let squares = a * a + b * b + c * c + d * d;
                self.weights[m] * squares * (1.0 + 1.0 / (determinant * determinant))
            } else {
                f64::INFINITY
            }
        };
        self.sum(one)
    }

    /// A sum over all triangles, the same for any number of threads.
    fn sum(&self, one: impl Fn(usize) -> f64 + Sync) -> f64 {
        let n = self.corners.len();
        let chunks: Vec<f64> = (0..n.div_ceil(CHUNK))
            .into_par_iter()
            .map(|k| (k * CHUNK..n.min((k + 1) * CHUNK)).map(&one).sum())
            .collect();
        chunks.into_iter().sum()
    }

    /// Gradient and Hessian of each triangle, the Hessian projected to be positive semi-definite.
    ///
    /// # Source
    /// `smith_analytic_2019`: the eigenvalues and eigenmatrices of an energy of the singular values.
    pub(crate) fn derivatives(&self, x: &[Vec2]) -> Vec<Local> {
        (0..self.corners.len()).into_par_iter().with_min_len(CHUNK / 8).map(|m| self.local(m, x)).collect()
    }

    fn local(&self, m: usize, x: &[Vec2]) -> Local {
        let [[a, b], [c, d]] = self.derivative(m, x);
        // The derivative is a rotation scaled by q plus a reflection scaled by r.
        let (e, h) = (0.5 * (a + d), 0.5 * (c - b));
        let (f, g) = (0.5 * (a - d), 0.5 * (c + b));
        let (q, r) = (e.hypot(h), f.hypot(g));
        let (turn, flip) = ([e / q, h / q], if r > 0.0 { [f / r, g / r] } else { [1.0, 0.0] });
        let s = q + r;
        let t = (a * d - b * c) / s;
        let rotation = [[turn[0], -turn[1]], [turn[1], turn[0]]];
        let reflection = [[flip[0], flip[1]], [flip[1], -flip[0]]];
        let combine = |p: f64, one: [Vec2; 2], q: f64, other: [Vec2; 2]| {
            [0, 1].map(|i| [0, 1].map(|j| p * one[i][j] + q * other[i][j]))
        };
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let modes = [
            combine(0.5, rotation, 0.5, reflection),
            combine(0.5, rotation, -0.5, reflection),
            [[-half * turn[1], -half * turn[0]], [half * turn[0], -half * turn[1]]],
            [[-half * flip[1], half * flip[0]], [half * flip[0], half * flip[1]]],
        ];
        let (s3, t3) = (1.0 / (s * s * s), 1.0 / (t * t * t));
        let twist = 2.0 - 2.0 * (s3 + t3) / (s + t);
        let values = [
            2.0 + 6.0 * s3 / s,
            2.0 + 6.0 * t3 / t,
            if twist > 0.0 { twist } else { 0.0 },
            2.0 + 2.0 * (s * s + s * t + t * t) * s3 * t3,
        ];
        let stress = combine(2.0 * (s - s3), modes[0], 2.0 * (t - t3), modes[1]);
        let weight = self.weights[m];
        let spread = |matrix: &[Vec2; 2]| {
            let mut vector = [0.0; 6];
            for (i, g) in self.gradients[m].iter().enumerate() {
                for k in 0..2 {
                    vector[2 * i + k] = matrix[k][0] * g[0] + matrix[k][1] * g[1];
                }
            }
            vector
        };
        let mut hessian = [[0.0; 6]; 6];
        for (mode, value) in modes.iter().zip(values) {
            let vector = spread(mode);
            for i in 0..6 {
                let factor = weight * value * vector[i];
                for j in 0..6 {
                    hessian[i][j] += factor * vector[j];
                }
            }
        }
        Local { gradient: spread(&stress).map(|x| weight * x), hessian }
    }

    /// The step along a direction at which the first triangle degenerates; infinite if none does.
    pub(crate) fn longest_step(&self, x: &[Vec2], direction: &[Vec2]) -> f64 {
        let one = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|v| x[v as usize]);
            let [da, db, dc] = corners.map(|v| direction[v as usize]);
            let (p, q, dp, dq) = (sub(b, a), sub(c, a), sub(db, da), sub(dc, da));
            first_root(cross(p, q), cross(p, dq) + cross(dp, q), cross(dp, dq))
        };
        self.corners
            .par_iter()
            .with_min_len(CHUNK)
            .map(one)
            .reduce(|| f64::INFINITY, |s, t| if t < s { t } else { s })
    }
}

/// The least positive root of `a + b t + c t²`, for positive `a`; infinite if there is none.
fn first_root(a: f64, b: f64, c: f64) -> f64 {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return f64::INFINITY;
    }
    let root = discriminant.sqrt();
    let half = -0.5 * (b + if b < 0.0 { -root } else { root });
    let roots = [half / c, a / half];
    roots.into_iter().filter(|t| *t > 0.0).fold(f64::INFINITY, f64::min)
}

/// The gradients of the hat functions of a triangle.
pub(super) fn gradients([a, b, c]: [Vec2; 3]) -> [Vec2; 3] {
    let twice = cross(sub(b, a), sub(c, a));
    let across = |from: Vec2, to: Vec2| [-(to[1] - from[1]) / twice, (to[0] - from[0]) / twice];
    [across(b, c), across(c, a), across(a, b)]
}

/// A point moved along a direction.
pub(crate) fn moved(x: &[Vec2], t: f64, direction: &[Vec2]) -> Vec<Vec2> {
    x.iter().zip(direction).map(|(&p, &d)| add(p, scale(t, d))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::Random;

    fn one(random: &mut Random) -> (Elements, Vec<Vec2>) {
        loop {
            let mut triangle =
                || -> [Vec2; 3] { [0; 3].map(|_| [random.signed_unit(), random.signed_unit()]) };
            let (rest, now) = (triangle(), triangle());
            let area = |[a, b, c]: [Vec2; 3]| cross(sub(b, a), sub(c, a));
            if area(rest) > 0.2 && area(now) > 0.2 {
                let mut elements = Elements::default();
                elements.push([0, 1, 2], rest, 0.7);
                return (elements, now.to_vec());
            }
        }
    }

    #[test]
    fn gradients_are_those_of_differences() {
        let mut random = Random::new(1);
        for _ in 0..50 {
            let (elements, x) = one(&mut random);
            let local = elements.local(0, &x);
            for i in 0..6 {
                let value = |step: f64| {
                    let mut y = x.clone();
                    y[i / 2][i % 2] += step;
                    elements.value(&y)
                };
                let step = 1e-5;
                let expected = (value(step) - value(-step)) / (2.0 * step);
                let scale = 1.0 + local.gradient[i].abs();
                assert!(
                    (local.gradient[i] - expected).abs() < 1e-4 * scale,
                    "{} {expected}",
                    local.gradient[i]
                );
            }
        }
    }

    #[test]
    fn hessians_are_those_of_differences_where_nothing_is_projected() {
        let mut random = Random::new(2);
        let mut exact = 0;
        for _ in 0..200 {
            let (elements, x) = one(&mut random);
            let [[a, b], [c, d]] = elements.derivative(0, &x);
            let determinant = a * d - b * c;
            let (s, t) = {
                let (q, r) = (0.5 * (a + d).hypot(c - b), 0.5 * (a - d).hypot(c + b));
                (q + r, determinant / (q + r))
            };
            let twist = 2.0 - 2.0 * (s.powi(-3) + t.powi(-3)) / (s + t);
            let local = elements.local(0, &x);
            let along: [f64; 6] = [0; 6].map(|_| random.signed_unit());
            let projected: f64 =
                (0..36).map(|k| along[k / 6] * local.hessian[k / 6][k % 6] * along[k % 6]).sum();
            assert!(projected >= 0.0);
            if twist <= 0.0 {
                continue;
            }
            exact += 1;
            let step = 1e-5;
            let gradient = |sign: f64| {
                let d: Vec<Vec2> = along.chunks(2).map(|p| [p[0], p[1]]).collect();
                elements.local(0, &moved(&x, sign * step, &d)).gradient
            };
            let (above, below) = (gradient(1.0), gradient(-1.0));
            for i in 0..6 {
                let expected = (above[i] - below[i]) / (2.0 * step);
                let found: f64 = (0..6).map(|j| local.hessian[i][j] * along[j]).sum();
                assert!((found - expected).abs() < 1e-3 * (1.0 + found.abs()), "{found} {expected}");
            }
        }
        assert!(exact > 20, "{exact}");
    }

    #[test]
    fn the_longest_step_ends_where_the_area_does() {
        let mut random = Random::new(3);
        for _ in 0..100 {
            let (elements, x) = one(&mut random);
            let d: Vec<Vec2> = (0..3).map(|_| [random.signed_unit(), random.signed_unit()]).collect();
            let t = elements.longest_step(&x, &d);
            let last = if t.is_finite() { t * (1.0 - 1e-9) } else { 1e3 };
            for k in 0..=20 {
                assert!(elements.value(&moved(&x, last * f64::from(k) / 20.0, &d)).is_finite());
            }
            if t.is_finite() {
                assert!(elements.value(&moved(&x, t * (1.0 + 1e-6), &d)).is_infinite());
            }
        }
    }
}
