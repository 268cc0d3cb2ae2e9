//! Incompressible flow in a channel or a box, below an elastic wall.
//!
//! # Definition
//! The Euler equations in a rectangle of square cells, velocities on their sides; the wall above moves with small displacements, so
//! that the grid is fixed. In each window the velocity is advected once, and each solve projects it with the
//! velocity of the wall. The pressure at the wall is that of the cell below and the gradient over half a cell,
//! `p = p_cell − ρ (v_wall − v*) h / (2 Δt)`, with v* the previous velocity of the wall.
//!
//! # Accuracy
//! Second order in the size of cells for linear waves; first order in the step with backward Euler, second with the trapezoidal rule.
//! # Limits
//! Large displacements require a moving grid. Walls are slip walls.

use crate::piston::TimeRule;
use crate::wall::{ElasticWall, Ends, Motion, WallOptions};
use crate::{CouplingError, Imbalance, Refusal, Subproblem};
use pompeiu_grid::{Mac, MacGrid, Side};

/// What drives the flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drive {
    /// Both ends are open; the pressure at the left one is `pressure · sin²(π t / duration)` until it ends.
    Pulse {
        /// The maximum pressure.
        pressure: f64,
        /// How long it takes.
        duration: f64,
    },
    /// The channel is periodic; driven only by the initial displacement `amplitude · sin(2π waves x / length)`.
    Periodic {
        /// The initial amplitude.
        amplitude: f64,
        /// Waves along the channel.
        waves: usize,
    },
    /// A box: `volume` flows in at the left until `duration` at a constant rate, nothing flows out.
    Injection {
        /// The total inflow, an area in the plane.
        volume: f64,
        /// How long it takes.
        duration: f64,
    },
}

/// A channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChannelOptions {
    /// Its height.
    pub height: f64,
    /// Cells along it and across it; they are squares.
    pub cells: [usize; 2],
    /// Density of the fluid, ρ.
    pub density: f64,
    /// Length of a step.
    pub time_step: f64,
    /// Time integration.
    pub rule: TimeRule,
    /// Whether the velocity is advected; otherwise the flow is linear.
    pub advect: bool,
    /// What drives the flow.
    pub drive: Drive,
    /// The wall above.
    pub wall: WallOptions,
}

impl Default for ChannelOptions {
    fn default() -> Self {
        Self {
            height: 1.0,
            cells: [192, 32],
            density: 1.0,
            time_step: 0.02,
            rule: TimeRule::default(),
            advect: true,
            drive: Drive::Pulse { pressure: 1.0, duration: 0.4 },
            wall: WallOptions::default(),
        }
    }
}

/// Largest number of cells.
const MOST_CELLS: usize = 1 << 22;

/// A channel with valid parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Channel {
    options: ChannelOptions,
}

impl Channel {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`CouplingError::Parameter`].
    pub fn new(options: ChannelOptions) -> Result<Self, CouplingError> {
        let mut positive = vec![
            ("height of the channel", options.height),
            ("density", options.density),
            ("time step", options.time_step),
        ];
        let mut finite = Vec::new();
        match options.drive {
            Drive::Pulse { pressure, duration } => {
                finite.push(("pressure of the pulse", pressure));
                positive.push(("duration of the pulse", duration));
            }
            Drive::Periodic { amplitude, waves } => {
                finite.push(("first amplitude", amplitude));
                if waves == 0 || waves > options.cells[0] / 2 {
                    let (what, expected) = ("number of waves", "from 1 to half of the cells");
                    return Err(CouplingError::Parameter { what, value: waves as f64, expected });
                }
            }
            Drive::Injection { volume, duration } => {
                finite.push(("volume that flows in", volume));
                positive.push(("duration of the inflow", duration));
            }
        }
        for (what, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(CouplingError::Parameter { what, value, expected: "above 0" });
            }
        }
        for (what, value) in finite {
            if !value.is_finite() {
                return Err(CouplingError::Parameter { what, value, expected: "a number" });
            }
        }
        let [nx, ny] = options.cells;
        let count = nx.saturating_mul(ny);
        if nx < 2 || ny < 2 || count > MOST_CELLS {
            let (what, expected) = ("number of cells", "at least 2 each way and at most 4 194 304 in all");
            return Err(CouplingError::Parameter { what, value: count as f64, expected });
        }
        if (options.wall.ends == Ends::Periodic) != matches!(options.drive, Drive::Periodic { .. }) {
            let (what, expected) = ("ends of the wall", "periodic just where the channel is");
            return Err(CouplingError::Parameter { what, value: f64::NAN, expected });
        }
        options.wall.check()?;
        Ok(Self { options })
    }

    /// The options.
    pub fn options(&self) -> &ChannelOptions {
        &self.options
    }

    /// Its length.
    pub fn length(&self) -> f64 {
        self.options.height * self.options.cells[0] as f64 / self.options.cells[1] as f64
    }

    fn spacing(&self) -> f64 {
        self.options.height / self.options.cells[1] as f64
    }

    /// The initial displacement of the wall in each cell, from which a coupling starts.
    pub fn start(&self) -> Vec<f64> {
        let n = self.options.cells[0];
        match self.options.drive {
            Drive::Periodic { amplitude, waves } => (0..n)
                .map(|i| {
                    let turn = (i as f64 + 0.5) * waves as f64 / n as f64;
                    amplitude * libm::sin(std::f64::consts::TAU * turn)
                })
                .collect(),
            _ => vec![0.0; n],
        }
    }

    /// The wall: pressures in, displacements out.
    ///
    /// # Errors
    /// [`CouplingError::Solve`] if it cannot be factored.
    pub fn solid(&self) -> Result<ElasticWall, CouplingError> {
        let ChannelOptions { wall, time_step, rule, .. } = self.options;
        ElasticWall::new(wall, &self.start(), self.spacing(), time_step, rule)
    }

    /// The fluid: displacements in, pressures at the wall out.
    ///
    /// # Errors
    /// [`CouplingError::Solve`] if the pressure cannot be factored.
    pub fn fluid(&self) -> Result<ChannelFluid, CouplingError> {
        let ChannelOptions { cells, drive, .. } = self.options;
        let periodic = [matches!(drive, Drive::Periodic { .. }), false];
        let grid = MacGrid { cells, per_length: 1.0 / self.spacing(), periodic };
        let mac = Mac::new(grid, &vec![false; grid.count()], |axis, _, pair| match (axis, pair) {
            (_, [Some(_), Some(_)]) => Side::Free,
            (0, [beyond, _]) => match drive {
                Drive::Injection { .. } if beyond.is_none() => Side::Given,
                Drive::Injection { .. } => Side::Fixed(0.0),
                _ => Side::Free,
            },
            (_, [_, None]) => Side::Given,
            _ => Side::Fixed(0.0),
        })?;
        let velocity = mac.at_rest();
        let wall = Motion { displacement: self.start(), velocity: vec![0.0; cells[0]] };
        Ok(ChannelFluid {
            options: self.options,
            carried: velocity.clone(),
            solved: (velocity.clone(), wall.clone(), vec![0.0; grid.count()]),
            velocity,
            pressure: vec![0.0; grid.count()],
            wall,
            mac,
            steps: 0,
        })
    }
}

/// The flow for given displacements of the wall.
#[derive(Debug)]
pub struct ChannelFluid {
    options: ChannelOptions,
    mac: Mac,
    velocity: [Vec<f64>; 2],
    pressure: Vec<f64>,
    /// The velocity after advection.
    carried: [Vec<f64>; 2],
    wall: Motion,
    /// Velocity, wall and pressure of the last solve.
    solved: ([Vec<f64>; 2], Motion, Vec<f64>),
    steps: usize,
}

impl ChannelFluid {
    /// The velocity in cells, row by row from below.
    pub fn velocity(&self) -> Vec<[f64; 2]> {
        self.mac.to_cells(&self.velocity)
    }

    /// The pressure in cells.
    pub fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    /// The largest net flow rate out of a cell or into it.
    pub fn divergence(&self) -> f64 {
        self.mac.outflow(&self.velocity).into_iter().map(f64::abs).fold(0.0, f64::max)
    }

    /// Time at the end of the window that is being solved.
    fn time(&self) -> f64 {
        (self.steps + 1) as f64 * self.options.time_step
    }

    /// The velocity at the left end of a box.
    fn inflow(&self) -> f64 {
        match self.options.drive {
            // Half a step earlier, so that the end of the inflow falls between two windows.
            Drive::Injection { volume, duration }
                if self.time() - 0.5 * self.options.time_step < duration =>
            {
                volume / (duration * self.options.height)
            }
            _ => 0.0,
        }
    }

    /// The pressure at the left end of a channel.
    fn inlet(&self) -> f64 {
        match self.options.drive {
            Drive::Pulse { pressure, duration } if self.time() < duration => {
                let wave = libm::sin(std::f64::consts::PI * self.time() / duration);
                pressure * wave * wave
            }
            _ => 0.0,
        }
    }
}

impl Subproblem for ChannelFluid {
    fn inputs(&self) -> usize {
        self.options.cells[0]
    }

    fn outputs(&self) -> usize {
        self.options.cells[0]
    }

    fn solve(&mut self, input: &[f64], output: &mut [f64]) -> Result<(), Refusal> {
        let ChannelOptions { cells: [nx, ny], density, time_step, rule, .. } = self.options;
        let per_length = self.mac.grid().per_length;
        let mut moved = self.wall.velocity_to(input, time_step, rule);
        if let Some(Imbalance { net, .. }) = self.imbalance(input) {
            let share = net * per_length / nx as f64;
            for v in &mut moved {
                *v += share;
            }
        }
        let mut velocity = self.carried.clone();
        let top = nx * ny;
        velocity[1][top..].copy_from_slice(&moved);
        if !self.mac.grid().periodic[0] {
            let (inflow, push) = (self.inflow(), self.inlet() * time_step * per_length / density);
            let is_open = matches!(self.options.drive, Drive::Pulse { .. });
            for side in (0..ny).map(|j| j * (nx + 1)) {
                if is_open {
                    velocity[0][side] += push;
                } else {
                    velocity[0][side] = inflow;
                }
            }
        }
        // The pressure of the solve before is near, the nearer the more solves there were.
        let unit = density / (time_step * per_length);
        let near = self.solved.2.iter().map(|p| p / unit).collect();
        let projected = self.mac.project_from(&mut velocity, near);
        let mut pressure = projected.map_err(|error| Refusal::new(error.to_string()))?;
        for p in &mut pressure {
            *p *= unit;
        }
        for (i, out) in output.iter_mut().enumerate() {
            *out = pressure[top - nx + i] - 0.5 * unit * (moved[i] - self.wall.velocity[i]);
        }
        self.solved = (velocity, Motion { displacement: input.to_vec(), velocity: moved }, pressure);
        Ok(())
    }

    fn accept(&mut self) {
        let (velocity, wall, pressure) = self.solved.clone();
        self.carried = if self.options.advect {
            self.mac.advect(&velocity, self.options.time_step)
        } else {
            velocity.clone()
        };
        (self.velocity, self.wall, self.pressure) = (velocity, wall, pressure);
        self.steps += 1;
    }

    fn reject(&mut self) {
        // Pressures of an attempt that failed may be far from any solution.
        self.solved.2.clone_from(&self.pressure);
    }

    fn imbalance(&self, input: &[f64]) -> Option<Imbalance> {
        if self.mac.closed_regions() == 0 {
            return None;
        }
        let ChannelOptions { height, time_step, rule, .. } = self.options;
        let h = 1.0 / self.mac.grid().per_length;
        let moved = self.wall.velocity_to(input, time_step, rule);
        let into = self.inflow() * height;
        let net = into - h * moved.iter().sum::<f64>();
        let gross = into.abs() + h * moved.iter().map(|v| v.abs()).sum::<f64>();
        Some(Imbalance { net, gross })
    }
}
