//! An elastic tube in one dimension: incompressible flow whose cross-section follows the pressure.
//!
//! # Definition
//! Conservation of volume and momentum, `a_t + (a v)_x = 0` and `(a v)_t + (a v²)_x + a p_x = 0` at density 1, and the wall
//! `a = a₀ (2c² / (2c² − p))²`, `c² = E / (2 r₀)`, with `a₀ = 1`. Finite volumes, backward Euler; the velocity at the inlet is given,
//! the outlet does not reflect pressure waves. With the wall at rest, waves travel at `v ± c`.
//!
//! # Source
//! The equations and numbers are those of the tutorial `elastic-tube-1d` of preCICE, which publishes logs of its runs;
//! `degroote_stability_2008`.

use crate::{CouplingError, Refusal, Subproblem};
use pompeiu_solve::Banded;

/// Velocity at the inlet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inlet {
    /// `mean + amplitude · sin(π · frequency · t)`.
    Periodic {
        /// The mean velocity.
        mean: f64,
        /// The amplitude.
        amplitude: f64,
        /// Half-periods in a unit of time.
        frequency: f64,
    },
    /// `mean + amplitude · sin²(π t / duration)` until it ends.
    Pulse {
        /// The velocity before and after.
        mean: f64,
        /// How far it goes beyond.
        amplitude: f64,
        /// How long it takes.
        duration: f64,
    },
}

impl Inlet {
    fn at(self, time: f64) -> f64 {
        use std::f64::consts::PI;
        match self {
            Self::Periodic { mean, amplitude, frequency } => {
                mean + amplitude * libm::sin(PI * frequency * time)
            }
            Self::Pulse { mean, amplitude, duration } if time < duration => {
                let wave = libm::sin(PI * time / duration);
                mean + amplitude * wave * wave
            }
            Self::Pulse { mean, .. } => mean,
        }
    }
}

/// A tube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TubeOptions {
    /// Its length.
    pub length: f64,
    /// Segments along it; values are stored at their ends.
    pub segments: usize,
    /// The modulus of the wall, E.
    pub modulus: f64,
    /// Length of a step.
    pub time_step: f64,
    /// Velocity at the inlet.
    pub inlet: Inlet,
}

impl Default for TubeOptions {
    fn default() -> Self {
        let inlet = Inlet::Periodic { mean: 10.0, amplitude: 3.0, frequency: 10.0 };
        Self { length: 10.0, segments: 100, modulus: 1e4, time_step: 0.01, inlet }
    }
}

/// Largest number of segments.
const MOST_SEGMENTS: usize = 1_000_000;

/// A tube with valid parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    options: TubeOptions,
    /// The square of the speed of waves, c².
    speed_sq: f64,
}

/// The flow at one time.
#[derive(Clone, Debug, PartialEq)]
struct Flow {
    time: f64,
    velocity: Vec<f64>,
    pressure: Vec<f64>,
    section: Vec<f64>,
}

/// Largest number of steps of Newton's method.
const MOST_STEPS: usize = 50;

/// The norm of the residual relative to that of velocities and pressures at which Newton's method ends.
const RESIDUAL: f64 = 1e-12;

impl Tube {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`CouplingError::Parameter`].
    pub fn new(options: TubeOptions) -> Result<Self, CouplingError> {
        let expected = "above 0";
        let (length, modulus, step) = (options.length, options.modulus, options.time_step);
        for (what, value) in
            [("length of the tube", length), ("modulus of the wall", modulus), ("time step", step)]
        {
            if !(value > 0.0 && value.is_finite()) {
                return Err(CouplingError::Parameter { what, value, expected });
            }
        }
        if !(3..=MOST_SEGMENTS).contains(&options.segments) {
            let (what, value, expected) =
                ("number of segments", options.segments as f64, "from 3 to a million");
            return Err(CouplingError::Parameter { what, value, expected });
        }
        if !options.inlet.at(0.0).is_finite() {
            let (what, value, expected) = ("velocity at the inlet", options.inlet.at(0.0), "a number");
            return Err(CouplingError::Parameter { what, value, expected });
        }
        // The radius of a section of area 1.
        let radius = 1.0 / std::f64::consts::PI.sqrt();
        Ok(Self { options, speed_sq: options.modulus / (2.0 * radius) })
    }

    /// The speed of waves in the fluid at rest, c.
    pub fn wave_speed(&self) -> f64 {
        self.speed_sq.sqrt()
    }

    /// The cross-sections at rest, from which a coupling starts.
    pub fn start(&self) -> Vec<f64> {
        vec![1.0; self.options.segments + 1]
    }

    /// The solver from cross-sections to pressures.
    pub fn fluid(&self) -> TubeFluid {
        TubeFluid { tube: *self, accepted: self.first(), solved: self.first() }
    }

    /// The solver from pressures to cross-sections.
    pub fn solid(&self) -> TubeWall {
        TubeWall { tube: *self }
    }

    /// The monolithic solver of the tube.
    pub fn monolithic(&self) -> MonolithicTube {
        MonolithicTube { tube: *self, flow: self.first(), windows: 0 }
    }

    fn first(&self) -> Flow {
        let count = self.options.segments + 1;
        let velocity = vec![self.options.inlet.at(0.0); count];
        Flow { time: 0.0, velocity, pressure: vec![0.0; count], section: vec![1.0; count] }
    }

    /// The cross-section for a pressure, and its derivative; none from the pressure `2c²` on.
    fn section(&self, pressure: f64) -> Option<[f64; 2]> {
        let most = 2.0 * self.speed_sq;
        let left = most - pressure;
        let ratio = most / left;
        (left > 0.0 && ratio.is_finite()).then(|| [ratio * ratio, 2.0 * ratio * ratio / left])
    }

    /// Newton's method for a step. Cross-sections are prescribed or depend on the pressure.
    fn step(&self, from: &Flow, given: Option<&[f64]>) -> Result<Flow, Refusal> {
        let count = from.velocity.len();
        let mut to = Flow { time: from.time + self.options.time_step, ..from.clone() };
        if let Some(given) = given {
            if let Some(at) = given.iter().position(|a| !(*a > 0.0 && a.is_finite())) {
                let place = at as f64 * self.options.length / self.options.segments as f64;
                return Err(Refusal::new(format!(
                    "the cross-section of the tube is {:e} at {place}",
                    given[at]
                )));
            }
            to.section.copy_from_slice(given);
        }
        for _ in 0..MOST_STEPS {
            let mut slope = vec![0.0; count];
            if given.is_none() {
                for i in 0..count {
                    let pressure = to.pressure[i];
                    let wall = self.section(pressure);
                    [to.section[i], slope[i]] = wall.ok_or_else(|| {
                        Refusal::new(format!("the wall gives way at pressure {pressure:e}"))
                    })?;
                }
            }
            let (mut residual, matrix) = self.system(from, &to, &slope)?;
            let squares = |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>();
            let size = (squares(&to.velocity) + squares(&to.pressure)).sqrt();
            if squares(&residual).sqrt() <= RESIDUAL * size {
                return Ok(to);
            }
            let failed = |_| Refusal::new("the equations of the flow in the tube are singular");
            matrix.solve_in_place(&mut residual).map_err(failed)?;
            let step = squares(&residual).sqrt();
            for i in 0..count {
                to.velocity[i] -= residual[2 * i];
                to.pressure[i] -= residual[2 * i + 1];
            }
            // Rounding of the residual may be more than asked for; the step tells when there is nothing left to gain.
            if step <= RESIDUAL * size {
                if given.is_none() {
                    for i in 0..count {
                        let wall = self.section(to.pressure[i]);
                        to.section[i] = wall.ok_or_else(|| Refusal::new("the wall gives way"))?[0];
                    }
                }
                return Ok(to);
            }
        }
        Err(Refusal::new("Newton's method for the flow in the tube did not converge"))
    }

    /// The residual and its derivative; unknowns are velocity and pressure alternately. `slope` is the derivative of cross-sections by pressure.
    fn system(&self, from: &Flow, to: &Flow, slope: &[f64]) -> Result<(Vec<f64>, Banded), Refusal> {
        let n = self.options.segments;
        let rate = self.options.length / n as f64 / self.options.time_step;
        let mut residual = vec![0.0; 2 * (n + 1)];
        let mut matrix = Banded::zeros(2 * (n + 1), 4, 4);
        let (a, v, p) = (&to.section, &to.velocity, &to.pressure);
        for i in 1..n {
            let areas = [0.5 * (a[i - 1] + a[i]), 0.5 * (a[i] + a[i + 1])];
            // What flows in over the first side and out over the second, by area: momentum with the pressure, and volume.
            let momentum = [
                0.5 * (v[i - 1] * (v[i - 1] + v[i]) + p[i - 1] - p[i]),
                0.5 * (-v[i] * (v[i] + v[i + 1]) + p[i] - p[i + 1]),
            ];
            let volume = [0.5 * (v[i - 1] + v[i]), -0.5 * (v[i] + v[i + 1])];
            let (row, next) = (2 * i, 2 * i + 1);
            residual[row] = (from.velocity[i] * from.section[i] - v[i] * a[i]) * rate
                + areas[0] * momentum[0]
                + areas[1] * momentum[1];
            residual[next] = (from.section[i] - a[i]) * rate + areas[0] * volume[0] + areas[1] * volume[1];
            let by_velocity = [
                areas[0] * (v[i - 1] + 0.5 * v[i]),
                -a[i] * rate + 0.5 * areas[0] * v[i - 1] - areas[1] * (v[i] + 0.5 * v[i + 1]),
                -0.5 * areas[1] * v[i],
            ];
            let by_pressure = [0.5 * areas[0], 0.5 * (areas[1] - areas[0]), -0.5 * areas[1]];
            let momentum_by_section =
                [0.5 * momentum[0], -v[i] * rate + 0.5 * (momentum[0] + momentum[1]), 0.5 * momentum[1]];
            let volume_by_section = [0.5 * volume[0], -rate + 0.5 * (volume[0] + volume[1]), 0.5 * volume[1]];
            for k in 0..3 {
                let node = i + k - 1;
                matrix.add(row, 2 * node, by_velocity[k]);
                matrix.add(row, 2 * node + 1, by_pressure[k] + momentum_by_section[k] * slope[node]);
                matrix.add(next, 2 * node, by_pressure[k]);
                matrix.add(next, 2 * node + 1, volume_by_section[k] * slope[node]);
            }
        }
        // Velocity given, pressure on a straight line.
        residual[0] = v[0] - self.options.inlet.at(to.time);
        matrix.add(0, 0, 1.0);
        residual[1] = p[0] - 2.0 * p[1] + p[2];
        for (k, weight) in [1.0, -2.0, 1.0].into_iter().enumerate() {
            matrix.add(1, 2 * k + 1, weight);
            matrix.add(2 * n, 2 * (n - k), weight);
        }
        // Velocity on a straight line, waves of pressure leave.
        residual[2 * n] = v[n] - 2.0 * v[n - 1] + v[n - 2];
        let left = self.speed_sq - 0.5 * from.pressure[n];
        if left <= 0.0 || left.is_nan() {
            let message =
                format!("the pressure at the outlet is {:e}, more than the wall holds", from.pressure[n]);
            return Err(Refusal::new(message));
        }
        let root = left.sqrt() - 0.25 * (v[n] - from.velocity[n]);
        residual[2 * n + 1] = p[n] - 2.0 * (self.speed_sq - root * root);
        matrix.add(2 * n + 1, 2 * n + 1, 1.0);
        matrix.add(2 * n + 1, 2 * n, -root);
        Ok((residual, matrix))
    }
}

/// The flow in a tube for given cross-sections.
#[derive(Clone, Debug)]
pub struct TubeFluid {
    tube: Tube,
    accepted: Flow,
    solved: Flow,
}

impl TubeFluid {
    /// The velocities at the ends of segments.
    pub fn velocity(&self) -> &[f64] {
        &self.accepted.velocity
    }
}

impl Subproblem for TubeFluid {
    fn inputs(&self) -> usize {
        self.tube.options.segments + 1
    }

    fn outputs(&self) -> usize {
        self.inputs()
    }

    fn solve(&mut self, input: &[f64], output: &mut [f64]) -> Result<(), Refusal> {
        self.solved = self.tube.step(&self.accepted, Some(input))?;
        output.copy_from_slice(&self.solved.pressure);
        Ok(())
    }

    fn accept(&mut self) {
        self.accepted.clone_from(&self.solved);
    }
}

/// The massless wall of a tube.
#[derive(Clone, Debug)]
pub struct TubeWall {
    tube: Tube,
}

impl Subproblem for TubeWall {
    fn inputs(&self) -> usize {
        self.tube.options.segments + 1
    }

    fn outputs(&self) -> usize {
        self.inputs()
    }

    fn solve(&mut self, input: &[f64], output: &mut [f64]) -> Result<(), Refusal> {
        for (section, &pressure) in output.iter_mut().zip(input) {
            let wall = self.tube.section(pressure);
            let refuse = || Refusal::new(format!("the wall of the tube gives way at pressure {pressure:e}"));
            [*section, _] = wall.ok_or_else(refuse)?;
        }
        Ok(())
    }

    fn accept(&mut self) {}
}

/// Monolithic solver of flow and wall of a tube.
#[derive(Clone, Debug)]
pub struct MonolithicTube {
    tube: Tube,
    flow: Flow,
    windows: usize,
}

impl MonolithicTube {
    /// Solves the next window.
    ///
    /// # Errors
    /// [`CouplingError::Monolithic`] if Newton's method does not converge.
    pub fn advance(&mut self) -> Result<(), CouplingError> {
        self.windows += 1;
        let failed = |_| CouplingError::Monolithic { window: self.windows };
        self.flow = self.tube.step(&self.flow, None).map_err(failed)?;
        Ok(())
    }

    /// The pressures at the ends of segments.
    pub fn pressure(&self) -> &[f64] {
        &self.flow.pressure
    }

    /// The cross-sections.
    pub fn section(&self) -> &[f64] {
        &self.flow.section
    }
}
