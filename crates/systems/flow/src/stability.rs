//! Whether a stationary surface is a local minimum of the area.

use super::gradient::Derivatives;
use super::moving::MovingSurface;
use super::systems::Systems;
use pompeiu_solve::{LinearSolver, SolveError};

/// The least eigenvalue of the second derivative of the area for motions along vertex normals, per area.
///
/// # Definition
/// The least λ of `H u = λ M u`, with `h_ij = n_iᵀ H_ij n_j` and M the diagonal matrix of vertex areas; in inverse squared lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Stability {
    /// The eigenvalue: above zero for a local minimum, below for a saddle.
    pub least_eigenvalue: f64,
    /// An eigenvalue lies within this of it: `|(H − λM) u|` in the norm of M⁻¹, over that of u in the norm of M.
    pub residual: f64,
}

impl Stability {
    /// Whether the surface is a local minimum for motions along normals; none where the residual does not decide.
    pub fn is_minimum(&self) -> Option<bool> {
        (self.least_eigenvalue.abs() > self.residual).then_some(self.least_eigenvalue > 0.0)
    }
}

/// Residual, as a part of the eigenvalue's own size and that of the shift, at which iteration ends.
const ACCURACY: f64 = 1e-9;
const MOST_STEPS: usize = 300;

/// The least eigenvalue, by inverse iteration from a shift at which the matrix is positive definite.
pub(crate) fn least_eigenvalue(
    surface: &MovingSurface,
    derivatives: &Derivatives,
    systems: &mut Systems,
) -> Result<Option<Stability>, SolveError> {
    let numbered = &mut systems.moving;
    let Derivatives { triangles, directions, masses, area, .. } = derivatives;
    let element = |f: usize| triangles[f].hessian_along(surface.faces()[f].map(|v| directions[v as usize]));
    let hessian = numbered.assemble(|_| 0.0, element)?;
    let mass = numbered.gather(|v| masses[v]);
    if mass.is_empty() || mass.iter().any(|m| m.is_nan() || *m <= 0.0) {
        return Ok(None);
    }
    // Below the least eigenvalue, as near as doubling finds it.
    let mut shift = 0.0;
    let factor = loop {
        let shifted = numbered.assemble(|v| shift * masses[v], element)?;
        match numbered.factor(&shifted) {
            Ok(factor) => break factor,
            Err(SolveError::NotPositiveDefinite { .. }) if shift * area < 1e12 => {
                shift = if shift == 0.0 { 1.0 / area } else { 2.0 * shift };
            }
            Err(SolveError::NotPositiveDefinite { .. }) => return Ok(None),
            Err(error) => return Err(error),
        }
    };
    // Deterministic, and orthogonal to nothing in particular.
    let mut u: Vec<f64> =
        (0..mass.len()).map(|i| 1.0 + 0.5 * ((i as f64) * 0.618_033_988_75).fract()).collect();
    let mut found = Stability { least_eigenvalue: f64::NAN, residual: f64::INFINITY };
    for _ in 0..MOST_STEPS {
        let size = u.iter().zip(&mass).map(|(u, m)| u * u * m).sum::<f64>().sqrt();
        for u in &mut u {
            *u /= size;
        }
        let image = hessian.multiply(&u);
        let value = image.iter().zip(&u).map(|(h, u)| h * u).sum::<f64>();
        let rest = image.iter().zip(&u).zip(&mass).map(|((h, u), m)| (h - value * m * u).powi(2) / m);
        found = Stability { least_eigenvalue: value, residual: rest.sum::<f64>().sqrt() };
        if found.residual <= ACCURACY * (value.abs() + shift) {
            break;
        }
        let mut next: Vec<f64> = u.iter().zip(&mass).map(|(u, m)| u * m).collect();
        factor.solve_in_place(&mut next)?;
        u = next;
    }
    Ok(found.least_eigenvalue.is_finite().then_some(found))
}
