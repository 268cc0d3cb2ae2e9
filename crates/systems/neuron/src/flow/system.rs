//! The steady Navier–Stokes equations on a tricubic mesh, solved by Newton's method.

use super::element::{Cell, PRESSURES, Tables, UNKNOWNS};
use super::error::FlowError;
use glam::DVec3;
use pompeiu_core::run::{Control, StopReason};
use pompeiu_solve::{FIXED, FrontalPlan, LinearSolver};
use pompeiu_volume::BezierMesh;
use rayon::prelude::*;

/// The equations `−Δu + κ (u·∇) u + ∇π = f`, `∇·u = 0`, with u prescribed at some control points.
///
/// # Definition
/// Velocity: continuous, tricubic in each cell. Pressure: in each cell a quadratic polynomial in space coordinates, discontinuous
/// between cells. The pair is stable, and the volume balance holds for each cell to the accuracy of the solve.
pub struct FlowSystem<'s> {
    /// The cells.
    pub mesh: &'s BezierMesh,
    /// The prescribed velocity at control points.
    pub given: Vec<Option<DVec3>>,
    /// Faces with a given pressure: cell, face, pressure.
    pub tractions: Vec<(u32, u8, f64)>,
    /// The force f; zero if absent.
    pub force: Option<&'s (dyn Fn(DVec3) -> DVec3 + Sync)>,
    /// κ, the inverse of the kinematic viscosity.
    pub inverse_viscosity: f64,
    /// The group of each cell, in elimination order.
    pub groups: Vec<u32>,
    /// The parent of each group, which is eliminated after it.
    pub parents: Vec<Option<u32>>,
    /// The cell whose mean pressure is fixed at zero: needed if the velocity is prescribed on the whole boundary.
    pub pinned: Option<u32>,
}

/// A solution.
#[derive(Clone, Debug)]
pub struct FlowSolution {
    /// The velocity at control points: its Bézier coefficients.
    pub velocity: Vec<DVec3>,
    /// The pressure of each cell, as coefficients of its polynomials.
    pub pressure: Vec<[f64; PRESSURES]>,
    /// The norm of the residual before each step and after the last, relative to the first.
    pub newton: Vec<f64>,
}

/// Newton's method ends at this residual, relative to the first.
pub const NEWTON_TOLERANCE: f64 = 1e-8;

/// Largest number of Newton steps.
const MOST_STEPS: usize = 25;

impl FlowSystem<'_> {
    /// Solves the equations: first without convection, then by Newton's method.
    ///
    /// # Errors
    /// [`FlowError::Memory`], [`FlowError::Solve`], [`FlowError::NoConvergence`], [`FlowError::Stopped`].
    pub fn solve(
        &self,
        memory: usize,
        control: &Control,
        step: &mut dyn FnMut(usize),
    ) -> Result<FlowSolution, FlowError> {
        let numbers = self.numbers();
        let velocities = numbers.iter().filter(|n| **n != FIXED).count();
        let cells = self.mesh.cells().len();
        let unknowns = 3 * velocities + PRESSURES * cells - usize::from(self.pinned.is_some());
        let pressure = |cell: usize, k: usize| -> u32 {
            match self.pinned.map(|p| p as usize) {
                Some(pinned) if cell == pinned && k == 0 => FIXED,
                Some(pinned) if cell >= pinned => (3 * velocities + PRESSURES * cell + k - 1) as u32,
                _ => (3 * velocities + PRESSURES * cell + k) as u32,
            }
        };
        let lists: Vec<Vec<u32>> = (0..cells)
            .map(|cell| {
                let of =
                    |&v: &u32| [0, 1, 2].map(|a| numbers[v as usize].checked_mul(3).map_or(FIXED, |n| n + a));
                let velocity = self.mesh.cells()[cell].iter().flat_map(of);
                velocity.chain((0..PRESSURES).map(|k| pressure(cell, k))).collect()
            })
            .collect();
        let mut stay = Vec::with_capacity(cells);
        let mut has_delayed = vec![false; self.parents.len()];
        for (cell, &group) in self.groups.iter().enumerate() {
            let constant = pressure(cell, 0);
            if constant != FIXED {
                let first = !std::mem::replace(&mut has_delayed[group as usize], true);
                let until = self.parents[group as usize].filter(|_| first);
                stay.push((constant, until.unwrap_or(group)));
            }
        }
        let plan = FrontalPlan::new(unknowns, &lists, &self.groups, self.parents.len(), &stay)?;
        // Estimates the Schur complements between groups, and element matrices in progress.
        let needed = plan.bytes() + plan.bytes() / 4;
        if needed > memory {
            return Err(FlowError::Memory {
                unknowns,
                needed: needed.div_ceil(1 << 20),
                limit: memory >> 20,
            });
        }
        let tables = Tables::new();
        let mut velocity: Vec<DVec3> = self.given.iter().map(|given| given.unwrap_or_default()).collect();
        let mut pressures = vec![[0.0; PRESSURES]; cells];
        let mut newton = Vec::new();
        let mut first = 0.0;
        for round in 0..=MOST_STEPS {
            let residual = self.residual(&tables, &velocity, &pressures, &lists, unknowns);
            let norm = residual.iter().map(|r| r * r).sum::<f64>().sqrt();
            if round == 0 {
                first = norm;
            }
            newton.push(if first > 0.0 { norm / first } else { 0.0 });
            let ratio = newton[round];
            if !ratio.is_finite() || (round > 3 && ratio > 1e4) {
                return Err(FlowError::NoConvergence { steps: round, ratio });
            }
            if ratio <= NEWTON_TOLERANCE && round > 0 || first == 0.0 {
                return Ok(FlowSolution { velocity, pressure: pressures, newton });
            }
            let stopped = || FlowError::Stopped(control.reason().unwrap_or(StopReason::Cancelled));
            if control.is_stopped() {
                return Err(stopped());
            }
            let (current, factor) = (&velocity, if round == 0 { 0.0 } else { self.inverse_viscosity });
            let fill = |cell: usize, matrix: &mut [f64]| {
                // Zeros are singular, which ends the factorization.
                if control.is_stopped() {
                    return;
                }
                let element = Cell::new(&tables, &self.mesh.control(cell));
                element.add_linear(matrix);
                if factor != 0.0 {
                    let field = self.mesh.cells()[cell].map(|v| current[v as usize]);
                    element.add_convection(&field, factor, matrix);
                }
            };
            let change = plan.factor(fill).and_then(|factors| factors.solve(&residual));
            let change =
                change.map_err(|error| if control.is_stopped() { stopped() } else { error.into() })?;
            for (v, &number) in numbers.iter().enumerate().filter(|(_, n)| **n != FIXED) {
                let at = 3 * number as usize;
                velocity[v] -= DVec3::new(change[at], change[at + 1], change[at + 2]);
            }
            for (list, pressure) in lists.iter().zip(&mut pressures) {
                for (value, &number) in pressure.iter_mut().zip(&list[192..]).filter(|(_, n)| **n != FIXED) {
                    *value -= change[number as usize];
                }
            }
            step(round + 1);
        }
        Err(FlowError::NoConvergence { steps: MOST_STEPS, ratio: newton[MOST_STEPS] })
    }

    /// Indices of the unknown velocities of control points.
    fn numbers(&self) -> Vec<u32> {
        let mut is_used = vec![false; self.given.len()];
        self.mesh.cells().iter().flatten().for_each(|&v| is_used[v as usize] = true);
        let mut next = 0;
        let number = |(given, used): (&Option<DVec3>, bool)| {
            if given.is_some() || !used {
                return FIXED;
            }
            next += 1;
            next - 1
        };
        self.given.iter().zip(is_used).map(number).collect()
    }

    fn residual(
        &self,
        tables: &Tables,
        velocity: &[DVec3],
        pressures: &[[f64; PRESSURES]],
        lists: &[Vec<u32>],
        unknowns: usize,
    ) -> Vec<f64> {
        let parts: Vec<[f64; UNKNOWNS]> = (0..lists.len())
            .into_par_iter()
            .map(|cell| {
                let field = self.mesh.cells()[cell].map(|v| velocity[v as usize]);
                let element = Cell::new(tables, &self.mesh.control(cell));
                element.residual(&field, &pressures[cell], self.inverse_viscosity, self.force)
            })
            .collect();
        let mut result = vec![0.0; unknowns];
        let mut add = |list: &[u32], part: &[f64; UNKNOWNS]| {
            for (&u, value) in list.iter().zip(part).filter(|(u, _)| **u != FIXED) {
                result[u as usize] += value;
            }
        };
        for (list, part) in lists.iter().zip(&parts) {
            add(list, part);
        }
        for &(cell, face, pressure) in self.tractions.iter().filter(|(_, _, pressure)| *pressure != 0.0) {
            let mut part = [0.0; UNKNOWNS];
            let element = Cell::new(tables, &self.mesh.control(cell as usize));
            element.add_traction(face.into(), pressure, &mut part);
            add(&lists[cell as usize], &part);
        }
        result
    }
}
