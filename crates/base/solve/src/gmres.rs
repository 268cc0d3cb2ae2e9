//! Iterative solution of systems close to one that has been factored.

use crate::{LinearSolver, SolveError};

/// Solves `A x = b` by the generalized minimal residual method, with a solver for a similar matrix as right preconditioner.
///
/// Stops when the residual is at most `tolerance` times the norm of `b`, when rounding prevents further progress, or after `most`
/// steps. After every `restart` steps it restarts from the current solution, with the residual computed afresh.
///
/// # Accuracy
/// The best solution found is returned even if it misses the tolerance: check the residual where it matters.
/// # Errors
/// Those of the preconditioner; [`SolveError::Singular`] if the solution is not finite.
/// # Cost
/// One product and one solve for each step; `restart` vectors of memory.
/// # Source
/// `saad_gmres_1986`.
pub fn gmres(
    apply: impl Fn(&[f64]) -> Vec<f64>,
    preconditioner: &dyn LinearSolver,
    b: &[f64],
    tolerance: f64,
    restart: usize,
    most: usize,
) -> Result<Vec<f64>, SolveError> {
    let target = tolerance * norm(b);
    let mut x = preconditioner.solve(b)?;
    let mut last = f64::INFINITY;
    let mut steps = 0;
    loop {
        let residual: Vec<f64> = b.iter().zip(apply(&x)).map(|(b, y)| b - y).collect();
        let size = norm(&residual);
        // Another round must reduce the residual at least by half.
        if size <= target || size > 0.5 * last || steps >= most {
            return Ok(x);
        }
        last = size;
        let mut basis = vec![residual.iter().map(|r| r / size).collect::<Vec<f64>>()];
        let mut rows: Vec<Vec<f64>> = Vec::new();
        let mut rotations: Vec<[f64; 2]> = Vec::new();
        let mut rest = vec![size];
        while rows.len() < restart && steps < most {
            steps += 1;
            let k = rows.len();
            let mut w = apply(&preconditioner.solve(&basis[k])?);
            let mut column = Vec::with_capacity(k + 2);
            for v in &basis {
                let along = dot(v, &w);
                w.iter_mut().zip(v).for_each(|(w, v)| *w -= along * v);
                column.push(along);
            }
            let beyond = norm(&w);
            for (i, [c, s]) in rotations.iter().enumerate() {
                let (p, q) = (column[i], column[i + 1]);
                (column[i], column[i + 1]) = (c * p + s * q, c * q - s * p);
            }
            let radius = column[k].hypot(beyond);
            let rotation = if radius > 0.0 { [column[k] / radius, beyond / radius] } else { [1.0, 0.0] };
            column[k] = radius;
            let here = rest[k];
            rest[k] = rotation[0] * here;
            rest.push(-rotation[1] * here);
            rotations.push(rotation);
            rows.push(column);
            if radius == 0.0 || rest[k + 1].abs() <= 0.5 * target || beyond <= f64::EPSILON * radius {
                break;
            }
            basis.push(w.iter().map(|w| w / beyond).collect());
        }
        let mut y = vec![0.0; rows.len()];
        for k in (0..rows.len()).rev() {
            let known: f64 = (k + 1..rows.len()).map(|j| rows[j][k] * y[j]).sum();
            y[k] = if rows[k][k] > 0.0 { (rest[k] - known) / rows[k][k] } else { 0.0 };
        }
        let mut correction = vec![0.0; b.len()];
        for (y, v) in y.iter().zip(&basis) {
            correction.iter_mut().zip(v).for_each(|(sum, v)| *sum += y * v);
        }
        preconditioner.solve_in_place(&mut correction)?;
        x.iter_mut().zip(&correction).for_each(|(x, d)| *x += d);
        if let Some(index) = x.iter().position(|x| !x.is_finite()) {
            return Err(SolveError::Singular { index });
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}
