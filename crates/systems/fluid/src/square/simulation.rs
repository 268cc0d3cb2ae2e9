//! Time stepping of a flow in the square.

use super::options::{Edges, MOST_CELLS, SquareOptions, SquareScheme};
use super::stam::{Ghosts, Stam};
use crate::report::range;
use crate::{FluidError, FluidStep, FluidTiming, SchemeReport, Wall};
use pompeiu_core::run::Instant;
use pompeiu_grid::{Lattice, Mac, MacGrid, Side};
use pompeiu_solve::Cholesky;

/// A fluid in the unit square: its velocity and transported densities.
///
/// Each step adds forces, diffuses, projects, advects and projects the velocity, then adds sources to the densities, diffuses and
/// transports them: Stam's order.
///
/// # Shapes and units
/// Cells are numbered row by row from below. Lengths are in sides of the square.
/// # Accuracy
/// First order in the step; second order in the cell size, except for Stam's linear interpolation, which is of first order.
/// # Source
/// `stam_realtime_2003`.
///
/// # Example
/// ```
/// use pompeiu_fluid::square::{Square, SquareOptions};
///
/// let mut square = Square::new(SquareOptions { viscosity: 0.01, lid: 1.0, ..SquareOptions::new(16, 0.1) })?;
/// let step = square.step()?;
/// assert!(step.energy > 0.0 && step.divergence < 1e-12);
/// # Ok::<(), pompeiu_fluid::FluidError>(())
/// ```
#[derive(Debug)]
pub struct Square {
    pub(super) options: SquareOptions,
    pub(super) grid: Grid,
    pub(super) densities: Vec<Vec<f64>>,
    /// For each density the factored diffusion operator, for the MAC grid.
    pub(super) heat: Vec<Option<Cholesky>>,
    pub(super) step: usize,
    time: f64,
    pub(super) timing: FluidTiming,
}

/// The state of a flow in the square, from which another simulation with the same options continues bit for bit.
#[derive(Clone, Debug, PartialEq)]
pub struct SquareState {
    /// Number of steps so far.
    pub step: usize,
    /// Time so far.
    pub time: f64,
    /// The components of the velocity at the points where the scheme stores them.
    pub velocity: [Vec<f64>; 2],
    /// The densities in cells.
    pub densities: Vec<Vec<f64>>,
}

#[derive(Debug)]
pub(super) enum Grid {
    Mac { mac: Box<Mac>, velocity: [Vec<f64>; 2], areas: Vec<f64> },
    Stam { stam: Box<Stam>, velocity: [Vec<f64>; 2] },
}

/// The area of what lies beyond the square: so large that nothing changes there.
const BEYOND: f64 = 1e300;

/// The grid of options that have been checked.
fn mac(options: &SquareOptions) -> Result<Mac, FluidError> {
    let n = options.cells;
    let grid =
        MacGrid { cells: [n; 2], per_length: n as f64, periodic: [options.edges == Edges::Periodic; 2] };
    let solid = options.solid.clone().unwrap_or_else(|| vec![false; n * n]);
    let mac = Mac::new(grid, &solid, |axis, _, cells| match (cells, options.edges) {
        ([Some(_), Some(_)], _) => Side::Free,
        ([None, _], Edges::Channel { speed }) if axis == 0 => Side::Fixed(speed),
        ([_, None], Edges::Channel { .. }) if axis == 0 => Side::Free,
        _ => Side::Fixed(0.0),
    })?;
    if options.viscosity <= 0.0 {
        return Ok(mac);
    }
    let held = options.wall == Wall::NoSlip && options.edges == Edges::Walls;
    let number = options.viscosity * options.time_step * (n * n) as f64;
    let along = [[0.0, options.lid], [0.0, 0.0]];
    Ok(mac.with_viscosity(number, along.map(|speeds| speeds.map(|speed| held.then_some(speed))))?)
}

impl Square {
    /// A fluid at rest, except for inflow.
    ///
    /// # Errors
    /// [`FluidError`]: invalid options, or a system that cannot be factored.
    pub fn new(options: SquareOptions) -> Result<Self, FluidError> {
        let start = Instant::now();
        options.check()?;
        let (n, periodic) = (options.cells, options.is_periodic());
        let grid = match options.scheme {
            SquareScheme::Mac => {
                let mac = Box::new(mac(&options)?);
                let mut velocity = mac.at_rest();
                mac.project(&mut velocity)?;
                let mut areas = vec![1.0 / (n * n) as f64; n * n];
                areas.push(BEYOND);
                Grid::Mac { mac, velocity, areas }
            }
            SquareScheme::Stam { sweeps } => {
                let count = (n + 2) * (n + 2);
                let stam = Box::new(Stam::new(n, periodic, sweeps)?);
                Grid::Stam { stam, velocity: [vec![0.0; count], vec![0.0; count]] }
            }
        };
        let mut square = Self {
            densities: options.densities.iter().map(|density| density.initial.clone()).collect(),
            heat: Vec::new(),
            grid,
            options,
            step: 0,
            time: 0.0,
            timing: FluidTiming::default(),
        };
        square.heat = square.heat_factors()?;
        square.timing.factor = start.elapsed();
        Ok(square)
    }

    /// Checks the number of cells on a side.
    ///
    /// # Errors
    /// [`FluidError::Cells`].
    pub fn check_cells(cells: usize) -> Result<(), FluidError> {
        let ok = (2..=MOST_CELLS).contains(&cells);
        if ok { Ok(()) } else { Err(FluidError::Cells { found: cells, most: MOST_CELLS }) }
    }

    /// The options.
    pub fn options(&self) -> &SquareOptions {
        &self.options
    }

    /// The scheme.
    pub fn scheme(&self) -> SchemeReport {
        SchemeReport::of_square(&self.options)
    }

    /// Number of steps so far.
    pub fn steps(&self) -> usize {
        self.step
    }

    /// Time so far.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Wall-clock times of the parts of all steps.
    pub fn timing(&self) -> FluidTiming {
        self.timing
    }

    /// The densities in cells.
    pub fn densities(&self) -> &[Vec<f64>] {
        &self.densities
    }

    /// The velocity in cells.
    pub fn velocity(&self) -> Vec<[f64; 2]> {
        match &self.grid {
            Grid::Mac { mac, velocity, .. } => mac.to_cells(velocity),
            Grid::Stam { stam, velocity } => {
                let [u, v] = velocity.each_ref().map(|values| stam.inner(values));
                u.into_iter().zip(v).map(|(u, v)| [u, v]).collect()
            }
        }
    }

    /// The vorticity in cells, by central differences.
    pub fn vorticity(&self) -> Vec<f64> {
        let (n, velocity) = (self.options.cells, self.velocity());
        let beside = |k: usize, forth: bool| match (forth, self.options.is_periodic()) {
            (true, true) => (k + 1) % n,
            (false, true) => (k + n - 1) % n,
            (true, false) => (k + 1).min(n - 1),
            (false, false) => k.saturating_sub(1),
        };
        let slope = |k: usize, value: &dyn Fn(usize) -> f64| {
            let (last, next) = (beside(k, false), beside(k, true));
            let width = if self.options.is_periodic() { 2 } else { next - last };
            (value(next) - value(last)) * n as f64 / width as f64
        };
        (0..n * n)
            .map(|cell| {
                let (i, j) = (cell % n, cell / n);
                slope(i, &|i| velocity[j * n + i][1]) - slope(j, &|j| velocity[j * n + i][0])
            })
            .collect()
    }

    /// The velocity at a point of the square.
    pub fn velocity_at(&self, place: [f64; 2]) -> [f64; 2] {
        match &self.grid {
            Grid::Mac { mac, velocity, .. } => mac.at(velocity, place),
            Grid::Stam { stam, velocity } => {
                let lattice = Lattice {
                    points: [stam.n + 2; 2],
                    origin: [-0.5; 2],
                    per_length: stam.n as f64,
                    periodic: [false; 2],
                };
                velocity.each_ref().map(|values| lattice.sample(values, place))
            }
        }
    }

    /// Sets the velocity to the divergence-free one nearest to vectors in cells.
    ///
    /// # Errors
    /// [`FluidError`] if there is no finite vector for each cell.
    pub fn set_velocity(&mut self, vectors: &[[f64; 2]]) -> Result<(), FluidError> {
        self.check_vectors("velocity", vectors)?;
        match &mut self.grid {
            Grid::Mac { mac, velocity, .. } => {
                *velocity = mac.means_of_cells(vectors);
                mac.project(velocity)?;
            }
            Grid::Stam { stam, velocity } => {
                let of = |axis: usize| vectors.iter().map(|u| u[axis]).collect::<Vec<_>>();
                let [mut u, mut v] =
                    [stam.framed(&of(0), Ghosts::OddAlongX), stam.framed(&of(1), Ghosts::OddAlongY)];
                stam.project(&mut u, &mut v)?;
                *velocity = [u, v];
            }
        }
        Ok(())
    }

    fn check_vectors(&self, what: &'static str, vectors: &[[f64; 2]]) -> Result<(), FluidError> {
        let (element, expected) = ("cell", self.options.cells * self.options.cells);
        if vectors.len() != expected {
            return Err(FluidError::Length { what, element, found: vectors.len(), expected });
        }
        match vectors.iter().position(|u| !u.iter().all(|x| x.is_finite())) {
            Some(index) => Err(FluidError::NonFinite { what, element, index, value: vectors[index][0] }),
            None => Ok(()),
        }
    }

    /// The current state.
    pub fn state(&self) -> SquareState {
        let (Grid::Mac { velocity, .. } | Grid::Stam { velocity, .. }) = &self.grid;
        let (velocity, densities) = (velocity.clone(), self.densities.clone());
        SquareState { step: self.step, time: self.time, velocity, densities }
    }

    /// Restores a state of the same options.
    ///
    /// # Errors
    /// [`FluidError`] if its arrays do not fit or are not finite.
    pub fn set_state(&mut self, state: &SquareState) -> Result<(), FluidError> {
        let element = "cell";
        let fits = |what: &'static str, now: &[Vec<f64>], then: &[Vec<f64>]| {
            if now.len() != then.len() {
                let (found, expected) = (then.len(), now.len());
                return Err(FluidError::Length { what, element: "density", found, expected });
            }
            for (now, then) in now.iter().zip(then) {
                if now.len() != then.len() {
                    let (found, expected) = (then.len(), now.len());
                    return Err(FluidError::Length { what, element, found, expected });
                }
                if let Some(index) = then.iter().position(|x| !x.is_finite()) {
                    return Err(FluidError::NonFinite { what, element, index, value: then[index] });
                }
            }
            Ok(())
        };
        let (Grid::Mac { velocity, .. } | Grid::Stam { velocity, .. }) = &mut self.grid;
        fits("velocity", velocity.as_slice(), &state.velocity)?;
        fits("density", &self.densities, &state.densities)?;
        velocity.clone_from(&state.velocity);
        self.densities.clone_from(&state.densities);
        (self.step, self.time) = (state.step, state.time);
        Ok(())
    }

    /// Replaces a density.
    ///
    /// # Errors
    /// [`FluidError`] if there is no finite value for each cell, or no such density.
    pub fn set_density(&mut self, index: usize, values: Vec<f64>) -> Result<(), FluidError> {
        let mut state = self.state();
        let found = state.densities.len();
        let Some(place) = state.densities.get_mut(index) else {
            let (what, element, expected) = ("list of densities", "density", index + 1);
            return Err(FluidError::Length { what, element, found, expected });
        };
        *place = values;
        self.set_state(&state)
    }

    /// Advances by one step.
    ///
    /// # Errors
    /// [`FluidError`] if velocities are no longer finite.
    pub fn step(&mut self) -> Result<FluidStep, FluidError> {
        self.step_with(None)
    }

    /// Advances by one step with an acceleration in cells in addition to those of the options.
    ///
    /// # Errors
    /// [`FluidError`] if there is no finite vector for each cell, or velocities are no longer finite.
    pub fn step_with(&mut self, force: Option<&[[f64; 2]]>) -> Result<FluidStep, FluidError> {
        if let Some(force) = force {
            self.check_vectors("force", force)?;
        }
        let force = self.force(force);
        let speed = self.measure()?.max_speed;
        self.move_velocity(force.as_deref())?;
        if !self.measure()?.max_speed.is_finite() {
            return Err(FluidError::BlewUp { step: self.step + 1, speed });
        }
        let cfl = self.move_densities()?;
        let measuring = Instant::now();
        self.step += 1;
        self.time += self.options.time_step;
        let step = FluidStep { cfl, substeps: 1, ..self.measure()? };
        self.timing.project += measuring.elapsed();
        Ok(step)
    }

    /// The measured quantities of the current state. The divergence of Stam's grid is that of differences across two cells.
    ///
    /// # Errors
    /// None for a valid simulation.
    pub fn measure(&self) -> Result<FluidStep, FluidError> {
        let h = 1.0 / self.options.cells as f64;
        let velocity = self.velocity();
        let energy = 0.5 * h * h * velocity.iter().map(|[u, v]| u * u + v * v).sum::<f64>();
        let outflow: f64 = match &self.grid {
            Grid::Mac { mac, velocity, .. } => mac.outflow(velocity).iter().map(|flow| flow * flow).sum(),
            Grid::Stam { stam, velocity: [u, v] } => {
                // Half of the differences over n: a flow out of a cell over its side is twice as large, times the side.
                stam.inner(&stam.divergence([u, v])).iter().map(|d| d * d).sum()
            }
        };
        let vorticity = self.vorticity();
        let norm = (2.0 * energy).sqrt();
        let greatest = velocity
            .iter()
            .map(|[u, v]| u.hypot(*v))
            .fold(0.0, |m, x| if x > m || x.is_nan() { x } else { m });
        Ok(FluidStep {
            time: self.time,
            energy,
            enstrophy: 0.5 * h * h * vorticity.iter().map(|w| w * w).sum::<f64>(),
            total_vorticity: h * h * vorticity.iter().sum::<f64>(),
            divergence: if norm > 0.0 { outflow.sqrt() / norm } else { 0.0 },
            mass: self.densities.iter().map(|values| h * h * values.iter().sum::<f64>()).collect(),
            range: self.densities.iter().map(|values| range(values.iter().copied())).collect(),
            max_speed: greatest,
            ..FluidStep::default()
        })
    }
}
