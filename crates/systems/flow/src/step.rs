//! Single steps of the schemes.

use super::gradient::Derivatives;
use super::moving::{Motion, MovingSurface};
use super::systems::{Systems, prepared};
use super::triangle::Triangle;
use glam::DVec3;
use pompeiu_solve::{
    Analysis, Cholesky, ElementPattern, FIXED, Ldlt, LinearSolver, Ordering, SolveError, SparseMatrix,
};

/// Shares of the stiffness matrix that the Hessian is blended with until the sum is positive definite.
const BLENDS: [f64; 4] = [0.0, 0.25, 0.5, 1.0];
/// Armijo's condition: this part of the fall that the gradient promises.
const ARMIJO: f64 = 1e-4;
/// Promised falls below this part of the area are not tested: they drown in the rounding of the area.
const UNTESTED: f64 = 1e-11;
/// Halvings of a step before it is given up.
const HALVINGS: usize = 24;
/// Newton iterations for the pressure that keeps a volume.
const PRESSURE_STEPS: usize = 30;

/// What the area was at first, for schemes that keep it.
pub(crate) struct FirstMetric {
    pub(crate) triangles: Vec<Triangle>,
    pub(crate) masses: Vec<f64>,
}

/// The displacement of an implicit step of length δ, `inverse_step` being 1/δ; with the stiffness of the first metric if one is given,
/// and its masses, too, if `first_masses`.
pub(crate) fn implicit(
    surface: &MovingSurface,
    derivatives: &Derivatives,
    systems: &mut Systems,
    inverse_step: f64,
    first: Option<(&FirstMetric, bool)>,
) -> Result<Vec<DVec3>, SolveError> {
    let stiffness = first.map_or(&derivatives.triangles, |(metric, _)| &metric.triangles);
    let masses = match first {
        Some((metric, true)) => &metric.masses,
        _ => &derivatives.masses,
    };
    let gradient: Vec<DVec3> = match first {
        // L₀ X, which is no gradient of the area.
        Some(_) => {
            let mut product = vec![DVec3::ZERO; surface.positions().len()];
            for (face, triangle) in surface.faces().iter().zip(stiffness) {
                let weights = triangle.stiffness();
                let corners = face.map(|v| surface.positions()[v as usize]);
                for (i, v) in face.iter().enumerate() {
                    product[*v as usize] += (0..3).map(|j| weights[i][j] * corners[j]).sum::<DVec3>();
                }
            }
            product
        }
        None => derivatives.gradient.clone(),
    };
    let downhill: Vec<DVec3> =
        gradient.iter().zip(&surface.motion).map(|(g, motion)| -motion.project(*g)).collect();
    if derivatives.pressure.is_none() {
        let mut solved = systems.solve_implicit(masses, inverse_step, stiffness, &[&downhill])?;
        return Ok(solved.swap_remove(0));
    }
    let outwards = surface.volume_gradient_at(surface.positions());
    let solved = systems.solve_implicit(masses, inverse_step, stiffness, &[&downhill, &outwards])?;
    Ok(with_volume_kept(surface, &solved[0], &solved[1]))
}

/// `Y + λ Z` with the λ that gives the surface the volume it has.
fn with_volume_kept(surface: &MovingSurface, y: &[DVec3], z: &[DVec3]) -> Vec<DVec3> {
    let at = |lambda: f64| -> Vec<DVec3> {
        let moved = surface.positions().iter().zip(y.iter().zip(z));
        moved.map(|(x, (y, z))| *x + *y + lambda * *z).collect()
    };
    let target = surface.volume();
    let mut lambda = 0.0;
    for _ in 0..PRESSURE_STEPS {
        let moved = at(lambda);
        let miss = surface.volume_at(&moved) - target;
        let gradient = surface.volume_gradient_at(&moved);
        let slope = gradient.iter().zip(z).map(|(v, z)| v.dot(*z)).sum::<f64>();
        let change = miss / slope;
        if !change.is_finite() {
            break;
        }
        lambda -= change;
        if miss.abs() <= 4.0 * f64::EPSILON * target.abs() {
            break;
        }
    }
    y.iter().zip(z).map(|(y, z)| *y + lambda * *z).collect()
}

/// Newton's step for motions along normals, and whether the Hessian had to be blended.
pub(crate) fn normal_newton(
    surface: &MovingSurface,
    derivatives: &Derivatives,
    systems: &mut Systems,
    blends: bool,
) -> Result<Option<(Vec<DVec3>, bool)>, SolveError> {
    let Derivatives { triangles, directions, gradient, .. } = derivatives;
    let numbered = &mut systems.moving;
    let mut step = numbered.gather(|v| -gradient[v].dot(directions[v]));
    for blend in &BLENDS[..if blends { BLENDS.len() } else { 1 }] {
        let element = |f: usize| {
            let d = surface.faces()[f].map(|v| directions[v as usize]);
            let hessian = triangles[f].hessian_along(d);
            if *blend == 0.0 {
                return hessian;
            }
            let stiffness = triangles[f].stiffness();
            [0, 1, 2].map(|i| {
                [0, 1, 2].map(|j| (1.0 - blend) * hessian[i][j] + blend * stiffness[i][j] * d[i].dot(d[j]))
            })
        };
        // A vertex without a direction stays.
        let still = |v: usize| if directions[v] == DVec3::ZERO { 1.0 } else { 0.0 };
        let matrix = numbered.assemble(still, element)?;
        match numbered.factor(&matrix) {
            Ok(factor) => {
                factor.solve_in_place(&mut step)?;
                let along = |(v, d): (usize, &DVec3)| numbered.value(&step, v) * *d;
                return Ok(Some((directions.iter().enumerate().map(along).collect(), *blend > 0.0)));
            }
            Err(SolveError::NotPositiveDefinite { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(None)
}

/// The system of all coordinates that may change.
pub(crate) struct FullSystem {
    /// By vertex and coordinate.
    unknown: Vec<[u32; 3]>,
    pattern: ElementPattern<9>,
    analysis: Option<Analysis>,
}

impl FullSystem {
    pub(crate) fn new(surface: &MovingSurface) -> Result<Self, SolveError> {
        let mut count = 0;
        let mut number = |motion: &Motion| {
            [0, 1, 2].map(|k| {
                if !motion.allows(k) {
                    return FIXED;
                }
                count += 1;
                count - 1
            })
        };
        let unknown: Vec<[u32; 3]> = surface.motion.iter().map(&mut number).collect();
        let element = |face: &[u32; 3]| std::array::from_fn(|i| unknown[face[i / 3] as usize][i % 3]);
        let elements: Vec<[u32; 9]> = surface.faces().iter().map(element).collect();
        let pattern = ElementPattern::new(count as usize, &elements)?;
        Ok(Self { unknown, pattern, analysis: None })
    }

    /// Newton's step for all coordinates; none if the matrix cannot be factored.
    pub(crate) fn newton(
        &mut self,
        derivatives: &Derivatives,
        clamp: bool,
    ) -> Result<Option<Vec<DVec3>>, SolveError> {
        let Derivatives { triangles, gradient, .. } = derivatives;
        let n = self.pattern.unknowns();
        let matrix: SparseMatrix = self.pattern.assemble(&vec![0.0; n], |f| triangles[f].hessian(clamp))?;
        let analysis = prepared(&mut self.analysis, || Analysis::new(&matrix, &Ordering::MinimumDegree))?;
        let mut step = vec![0.0; n];
        for (unknown, g) in self.unknown.iter().zip(gradient) {
            for k in (0..3).filter(|&k| unknown[k] != FIXED) {
                step[unknown[k] as usize] = -g[k];
            }
        }
        let solved = if clamp {
            Cholesky::with(analysis, &matrix).and_then(|factor| factor.solve_in_place(&mut step))
        } else {
            Ldlt::with(analysis, &matrix).and_then(|factor| factor.solve_in_place(&mut step))
        };
        match solved {
            Ok(()) => {}
            Err(SolveError::NoMemory { unknowns, nonzeros }) => {
                return Err(SolveError::NoMemory { unknowns, nonzeros });
            }
            Err(_) => return Ok(None),
        }
        let of = |u: &[u32; 3]| DVec3::from_array(u.map(|u| if u == FIXED { 0.0 } else { step[u as usize] }));
        Ok(Some(self.unknown.iter().map(of).collect()))
    }
}

/// The direction of steepest descent, `−M⁻¹ g`.
pub(crate) fn steepest_descent(derivatives: &Derivatives) -> Vec<DVec3> {
    let down = derivatives.gradient.iter().zip(&derivatives.masses);
    down.map(|(g, m)| if *m > 0.0 { -*g / *m } else { DVec3::ZERO }).collect()
}

/// Positions after a step.
pub(crate) fn moved(surface: &MovingSurface, step: &[DVec3], by: f64) -> Vec<DVec3> {
    surface.positions().iter().zip(step).map(|(x, step)| *x + by * *step).collect()
}

/// The longest part of a step, halved from `longest`, with which the area falls as the gradient promises and no face turns over.
pub(crate) fn line_search(
    surface: &MovingSurface,
    derivatives: &Derivatives,
    step: &[DVec3],
    longest: f64,
    halvings: usize,
) -> Option<(f64, Vec<DVec3>)> {
    let slope = derivatives.gradient.iter().zip(step).map(|(g, s)| g.dot(*s)).sum::<f64>();
    if slope.is_nan() || slope >= 0.0 {
        return None;
    }
    let mut by = longest;
    for _ in 0..=halvings {
        let to = moved(surface, step, by);
        let tested = -slope * by > UNTESTED * derivatives.area;
        let falls = !tested || surface.area_at(&to) <= derivatives.area + ARMIJO * by * slope;
        if falls && keeps_faces(surface, derivatives, &to) {
            return Some((by, to));
        }
        by *= 0.5;
    }
    None
}

/// The number of halvings after which a line search gives up.
pub(crate) const MOST_HALVINGS: usize = HALVINGS;

/// Whether no face turns over.
pub(crate) fn keeps_faces(surface: &MovingSurface, derivatives: &Derivatives, to: &[DVec3]) -> bool {
    let stays = |(f, old): (usize, &Triangle)| surface.triangle(f, to).normal.dot(old.normal) > 0.0;
    derivatives.triangles.iter().enumerate().all(stays)
}
