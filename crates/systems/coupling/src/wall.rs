//! An elastic wall along a flow: a string on springs.
//!
//! # Definition
//! `m η_tt + c η_t + k η − T η_xx = p`, with the displacement η across the wall and the pressure p below it.

use crate::piston::TimeRule;
use crate::{CouplingError, Refusal, Subproblem};
use pompeiu_solve::{Cholesky, LinearSolver, SparseMatrix};

/// Boundary condition at the ends of a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Ends {
    /// They are fixed.
    #[default]
    Held,
    /// They move freely across the wall.
    Free,
    /// They coincide.
    Periodic,
}

impl Ends {
    /// The one of a name: `held`, `free`, `periodic`.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "held" => Some(Self::Held),
            "free" => Some(Self::Free),
            "periodic" => Some(Self::Periodic),
            _ => None,
        }
    }
}

/// A wall; quantities per area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallOptions {
    /// Mass, m.
    pub mass: f64,
    /// Stiffness of the springs, k.
    pub stiffness: f64,
    /// Tension along the wall, T.
    pub tension: f64,
    /// Damping, c.
    pub damping: f64,
    /// Boundary condition at its ends.
    pub ends: Ends,
}

impl Default for WallOptions {
    fn default() -> Self {
        Self { mass: 0.1, stiffness: 10.0, tension: 5.0, damping: 0.0, ends: Ends::default() }
    }
}

impl WallOptions {
    pub(crate) fn check(&self) -> Result<(), CouplingError> {
        for (what, value) in [
            ("mass of the wall", self.mass),
            ("stiffness of the wall", self.stiffness),
            ("tension of the wall", self.tension),
            ("damping of the wall", self.damping),
        ] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(CouplingError::Parameter { what, value, expected: "not negative" });
            }
        }
        if self.mass == 0.0 && self.stiffness == 0.0 && self.damping == 0.0 {
            let (what, expected) = ("mass of the wall", "above 0 where neither springs nor damping hold it");
            return Err(CouplingError::Parameter { what, value: 0.0, expected });
        }
        Ok(())
    }
}

/// The wall as a solver from pressures to displacements, one for each cell of the adjacent grid.
#[derive(Debug)]
pub struct ElasticWall {
    options: WallOptions,
    time_step: f64,
    rule: TimeRule,
    /// Springs and tension.
    stiffness: SparseMatrix,
    factor: Cholesky,
    accepted: Motion,
    solved: Motion,
}

/// Displacements and velocities of a wall.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Motion {
    pub(crate) displacement: Vec<f64>,
    pub(crate) velocity: Vec<f64>,
}

impl Motion {
    /// The velocity for a displacement at the end of a step.
    pub(crate) fn velocity_to(&self, to: &[f64], time_step: f64, rule: TimeRule) -> Vec<f64> {
        let mean = to.iter().zip(&self.displacement).map(|(to, from)| (to - from) / time_step);
        match rule {
            TimeRule::BackwardEuler => mean.collect(),
            TimeRule::Trapezoidal => mean.zip(&self.velocity).map(|(mean, v)| 2.0 * mean - v).collect(),
        }
    }
}

impl ElasticWall {
    /// A wall with this displacement, at rest; `spacing` is the width of a cell.
    ///
    /// # Errors
    /// [`CouplingError`] if parameters are invalid.
    pub fn new(
        options: WallOptions,
        displacement: &[f64],
        spacing: f64,
        time_step: f64,
        rule: TimeRule,
    ) -> Result<Self, CouplingError> {
        options.check()?;
        let count = displacement.len();
        let tension = options.tension / (spacing * spacing);
        let mut links = Vec::with_capacity(count);
        links.extend((1..count as u32).map(|i| (i - 1, i, tension)));
        if options.ends == Ends::Periodic && count > 2 {
            links.push((count as u32 - 1, 0, tension));
        }
        let mut springs = vec![options.stiffness; count];
        if options.ends == Ends::Held {
            // Held half a cell beyond the centres of the first and the last one.
            for end in [0, count - 1] {
                springs[end] += 2.0 * tension;
            }
        }
        let stiffness = SparseMatrix::from_links(count, &links)?;
        let stiffness = stiffness.combined(1.0, &SparseMatrix::diagonal(&springs)?, 1.0)?;
        let (dt, WallOptions { mass, damping, .. }) = (time_step, options);
        let (inertia, share) = match rule {
            TimeRule::BackwardEuler => (mass / (dt * dt) + damping / dt, 1.0),
            TimeRule::Trapezoidal => (2.0 * mass / (dt * dt) + damping / dt, 0.5),
        };
        let matrix = stiffness.combined(share, &SparseMatrix::diagonal(&vec![inertia; count])?, 1.0)?;
        let factor = Cholesky::new(&matrix)?;
        let accepted = Motion { displacement: displacement.to_vec(), velocity: vec![0.0; count] };
        Ok(Self { options, time_step, rule, stiffness, factor, solved: accepted.clone(), accepted })
    }

    /// Its displacement.
    pub fn displacement(&self) -> &[f64] {
        &self.accepted.displacement
    }

    /// Its velocity.
    pub fn velocity(&self) -> &[f64] {
        &self.accepted.velocity
    }
}

impl Subproblem for ElasticWall {
    fn inputs(&self) -> usize {
        self.accepted.displacement.len()
    }

    fn outputs(&self) -> usize {
        self.inputs()
    }

    fn solve(&mut self, input: &[f64], output: &mut [f64]) -> Result<(), Refusal> {
        let Motion { displacement, velocity } = &self.accepted;
        let (dt, WallOptions { mass, damping, .. }) = (self.time_step, self.options);
        output.copy_from_slice(input);
        match self.rule {
            TimeRule::BackwardEuler => {
                for ((out, x), v) in output.iter_mut().zip(displacement).zip(velocity) {
                    *out += mass * (x + dt * v) / (dt * dt) + damping * x / dt;
                }
            }
            TimeRule::Trapezoidal => {
                let held = self.stiffness.multiply(displacement);
                for (((out, x), v), held) in output.iter_mut().zip(displacement).zip(velocity).zip(held) {
                    *out += 2.0 * mass * (x + dt * v) / (dt * dt) + damping * x / dt - 0.5 * held;
                }
            }
        }
        self.factor.solve_in_place(output).map_err(|error| Refusal::new(error.to_string()))?;
        self.solved = Motion {
            velocity: self.accepted.velocity_to(output, dt, self.rule),
            displacement: output.to_vec(),
        };
        Ok(())
    }

    fn accept(&mut self) {
        self.accepted.clone_from(&self.solved);
    }
}
