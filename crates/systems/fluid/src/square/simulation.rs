//! A flow in the square that moves on step by step.

use super::mac::Mac;
use super::options::{SquareOptions, SquareScheme};
use super::stam::{Ghosts, Stam};
use crate::transport::Cells;
use crate::{FluidError, FluidStep, FluidTiming, SchemeReport};
use pompeiu_solve::{Cholesky, LinearSolver, SparseMatrix};
use std::time::Instant;

/// A fluid in the unit square: its velocity, and densities that it carries.
///
/// Each step adds forces, diffuses, projects, advects and projects the velocity, then adds sources to the densities, diffuses and
/// carries them: Stam's order.
///
/// # Shapes and units
/// Cells are numbered row by row from below. Lengths are in sides of the square.
/// # Accuracy
/// First order in the step, second in the size of cells but for Stam's linear interpolation, which is of first order.
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
    options: SquareOptions,
    grid: Grid,
    densities: Vec<Vec<f64>>,
    /// For each density the factor of its diffusion, with MAC.
    heat: Vec<Option<Cholesky>>,
    step: usize,
    time: f64,
    timing: FluidTiming,
}

#[derive(Debug)]
enum Grid {
    Mac { mac: Box<Mac>, velocity: [Vec<f64>; 2] },
    Stam { stam: Box<Stam>, velocity: [Vec<f64>; 2] },
}

/// Substeps of a step at most.
const MOST_SUBSTEPS: f64 = 100_000.0;

impl Square {
    /// A fluid at rest, but for what flows in.
    ///
    /// # Errors
    /// [`FluidError`]: options that make no sense, or a system that cannot be factored.
    pub fn new(options: SquareOptions) -> Result<Self, FluidError> {
        let start = Instant::now();
        options.check()?;
        let (n, periodic) = (options.cells, options.is_periodic());
        let grid = match options.scheme {
            SquareScheme::Mac => {
                let mac = Box::new(Mac::new(&options)?);
                let mut velocity = mac.at_rest();
                mac.project(&mut velocity)?;
                Grid::Mac { mac, velocity }
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

    /// The options.
    pub fn options(&self) -> &SquareOptions {
        &self.options
    }

    /// How the flow is computed.
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

    /// How long the parts of all steps took.
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
            Grid::Mac { mac, velocity } => mac.to_cells(velocity),
            Grid::Stam { stam, velocity } => {
                let [u, v] = velocity.each_ref().map(|values| stam.inner(values));
                u.into_iter().zip(v).map(|(u, v)| [u, v]).collect()
            }
        }
    }

    /// The vorticity in cells, by differences of neighbours.
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

    /// The velocity at a place of the square.
    pub fn velocity_at(&self, place: [f64; 2]) -> [f64; 2] {
        match &self.grid {
            Grid::Mac { mac, velocity } => mac.at(velocity, place),
            Grid::Stam { stam, velocity } => {
                let lattice = super::sample::Lattice {
                    points: [stam.n + 2; 2],
                    origin: [-0.5; 2],
                    per_length: stam.n as f64,
                    periodic: false,
                };
                velocity.each_ref().map(|values| lattice.sample(values, place))
            }
        }
    }

    /// Makes the velocity the one without divergence that is nearest to vectors in cells.
    ///
    /// # Errors
    /// [`FluidError`] where there is no finite vector for each cell.
    pub fn set_velocity(&mut self, vectors: &[[f64; 2]]) -> Result<(), FluidError> {
        let expected = self.options.cells * self.options.cells;
        let (what, element) = ("velocity", "cell");
        if vectors.len() != expected {
            return Err(FluidError::Length { what, element, found: vectors.len(), expected });
        }
        if let Some(index) = vectors.iter().position(|u| !u.iter().all(|x| x.is_finite())) {
            return Err(FluidError::NonFinite { what, element, index, value: vectors[index][0] });
        }
        match &mut self.grid {
            Grid::Mac { mac, velocity } => {
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

    /// Moves on by one step.
    ///
    /// # Errors
    /// [`FluidError`] where velocities are no longer finite.
    pub fn step(&mut self) -> Result<FluidStep, FluidError> {
        let start = Instant::now();
        let force = self.force();
        let speed = self.measure()?.max_speed;
        self.move_velocity(force.as_deref())?;
        let moved = Instant::now();
        self.timing.advect += moved - start;
        if !self.measure()?.max_speed.is_finite() {
            return Err(FluidError::BlewUp { step: self.step + 1, speed });
        }
        let cfl = self.move_densities()?;
        self.timing.diffuse += moved.elapsed();
        let measuring = Instant::now();
        self.step += 1;
        self.time += self.options.time_step;
        let step = FluidStep { cfl, substeps: 1, ..self.measure()? };
        self.timing.project += measuring.elapsed();
        Ok(step)
    }

    /// What is measured of the flow as it is. The divergence of Stam's grid is that of differences across two cells.
    ///
    /// # Errors
    /// None for a simulation that has been made.
    pub fn measure(&self) -> Result<FluidStep, FluidError> {
        let h = 1.0 / self.options.cells as f64;
        let velocity = self.velocity();
        let energy = 0.5 * h * h * velocity.iter().map(|[u, v]| u * u + v * v).sum::<f64>();
        let outflow: f64 = match &self.grid {
            Grid::Mac { mac, velocity } => mac.outflow(velocity).iter().map(|flow| flow * flow).sum(),
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
        let range = |values: &Vec<f64>| {
            values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], &x| {
                [if x < least { x } else { least }, if x > most { x } else { most }]
            })
        };
        Ok(FluidStep {
            time: self.time,
            energy,
            enstrophy: 0.5 * h * h * vorticity.iter().map(|w| w * w).sum::<f64>(),
            total_vorticity: h * h * vorticity.iter().sum::<f64>(),
            divergence: if norm > 0.0 { outflow.sqrt() / norm } else { 0.0 },
            mass: self.densities.iter().map(|values| h * h * values.iter().sum::<f64>()).collect(),
            range: self.densities.iter().map(range).collect(),
            max_speed: greatest,
            ..FluidStep::default()
        })
    }

    /// The acceleration in each cell.
    fn force(&self) -> Option<Vec<[f64; 2]>> {
        let options = &self.options;
        let weighs = options.gravity != [0.0; 2] && options.densities.iter().any(|d| d.weight != 0.0);
        if options.force.is_none() && !weighs {
            return None;
        }
        let count = options.cells * options.cells;
        let mut sum = options.force.clone().unwrap_or_else(|| vec![[0.0; 2]; count]);
        for (density, values) in options.densities.iter().zip(&self.densities) {
            for (f, x) in sum.iter_mut().zip(values) {
                for k in 0..2 {
                    f[k] += density.weight * x * options.gravity[k];
                }
            }
        }
        Some(sum)
    }

    fn move_velocity(&mut self, force: Option<&[[f64; 2]]>) -> Result<(), FluidError> {
        let (options, dt) = (&self.options, self.options.time_step);
        match &mut self.grid {
            Grid::Mac { mac, velocity } => {
                if let Some(force) = force {
                    let pushed: Vec<[f64; 2]> = force.iter().map(|f| f.map(|x| dt * x)).collect();
                    for (values, push) in velocity.iter_mut().zip(mac.means_of_cells(&pushed)) {
                        values.iter_mut().zip(push).for_each(|(u, push)| *u += push);
                    }
                    reset_fixed(mac, velocity);
                }
                mac.diffuse(velocity)?;
                mac.project(velocity)?;
                *velocity = mac.advect(velocity, dt);
                mac.project(velocity)?;
            }
            Grid::Stam { stam, velocity } => {
                let number = options.viscosity * dt * (options.cells * options.cells) as f64;
                let size = velocity[0].len();
                let mut pushed = [vec![0.0; size], vec![0.0; size]];
                if let Some(force) = force {
                    for (index, f) in force.iter().enumerate() {
                        let n = options.cells;
                        let at = (index % n + 1) + (n + 2) * (index / n + 1);
                        for axis in 0..2 {
                            pushed[axis][at] = f[axis];
                        }
                    }
                }
                for axis in 0..2 {
                    for (u, f) in velocity[axis].iter_mut().zip(&pushed[axis]) {
                        *u += dt * f;
                    }
                }
                let [u, v] = &*velocity;
                let mut u = stam.diffuse(Ghosts::OddAlongX, u, &pushed[0], number)?;
                let mut v = stam.diffuse(Ghosts::OddAlongY, v, &pushed[1], number)?;
                stam.project(&mut u, &mut v)?;
                let mut next = [
                    stam.advect(Ghosts::OddAlongX, &u, [&u, &v], dt),
                    stam.advect(Ghosts::OddAlongY, &v, [&u, &v], dt),
                ];
                let [u, v] = &mut next;
                stam.project(u, v)?;
                *velocity = next;
            }
        }
        Ok(())
    }

    /// Sources, diffusion and transport of what the flow carries; the Courant number.
    fn move_densities(&mut self) -> Result<f64, FluidError> {
        let dt = self.options.time_step;
        let options = &self.options;
        match &mut self.grid {
            Grid::Mac { mac, velocity } => {
                let cells = Cells::new(&mac.ends, &mac.areas, mac.flows(velocity));
                let cfl = cells.cfl(dt);
                if cfl > MOST_SUBSTEPS && !self.densities.is_empty() {
                    return Err(FluidError::StepTooLong {
                        step: self.step + 1,
                        length: dt,
                        cfl,
                        substeps: cfl,
                        most: MOST_SUBSTEPS as usize,
                    });
                }
                for ((values, density), heat) in
                    self.densities.iter_mut().zip(&options.densities).zip(&self.heat)
                {
                    if let Some(source) = &density.source {
                        crate::simulation::add_source(values, source, dt);
                    }
                    if let Some(heat) = heat {
                        heat.solve_in_place(values)?;
                    }
                    // What flows in from beyond the square brings nothing along.
                    values.push(0.0);
                    cells.carry(values, dt);
                    values.pop();
                }
                Ok(cfl)
            }
            Grid::Stam { stam, velocity: [u, v] } => {
                for (values, density) in self.densities.iter_mut().zip(&options.densities) {
                    let source = density.source.clone().unwrap_or_else(|| vec![0.0; values.len()]);
                    crate::simulation::add_source(values, &source, dt);
                    let number = density.diffusivity * dt * (options.cells * options.cells) as f64;
                    let mut guess = vec![0.0; u.len()];
                    for (index, rate) in source.iter().enumerate() {
                        let n = options.cells;
                        guess[(index % n + 1) + (n + 2) * (index / n + 1)] = *rate;
                    }
                    let framed = stam.framed(values, Ghosts::Even);
                    let spread = stam.diffuse(Ghosts::Even, &framed, &guess, number)?;
                    *values = stam.inner(&stam.advect(Ghosts::Even, &spread, [u, v], dt));
                }
                let fastest =
                    u.iter().chain(v.iter()).fold(0.0, |m: f64, x| if x.abs() > m { x.abs() } else { m });
                Ok(fastest * dt * options.cells as f64)
            }
        }
    }

    /// Factors of the diffusion of densities: none flows into obstacles and walls.
    fn heat_factors(&self) -> Result<Vec<Option<Cholesky>>, FluidError> {
        let options = &self.options;
        let n = options.cells;
        let solid = |cell: usize| options.solid.as_ref().is_some_and(|solid| solid[cell]);
        let factor = |number: f64| {
            let mut links = Vec::with_capacity(2 * n * n);
            for cell in (0..n * n).filter(|&cell| !solid(cell)) {
                let (i, j) = (cell % n, cell / n);
                for (at, other) in [(i, j * n + (i + 1) % n), (j, (j + 1) % n * n + i)] {
                    if (at + 1 < n || options.is_periodic()) && !solid(other) {
                        links.push((cell as u32, other as u32, number));
                    }
                }
            }
            let matrix = SparseMatrix::from_links(n * n, &links)?;
            Cholesky::new(&matrix.combined(1.0, &SparseMatrix::diagonal(&vec![1.0; n * n])?, 1.0)?)
        };
        let is_mac = matches!(self.grid, Grid::Mac { .. });
        options
            .densities
            .iter()
            .map(|density| {
                let number = density.diffusivity * options.time_step * (n * n) as f64;
                Ok((is_mac && number > 0.0).then(|| factor(number)).transpose()?)
            })
            .collect()
    }
}

/// Gives sides that are fixed their velocity.
fn reset_fixed(mac: &Mac, velocity: &mut [Vec<f64>; 2]) {
    for (values, fixed) in velocity.iter_mut().zip(mac.fixed()) {
        for (u, fixed) in values.iter_mut().zip(fixed) {
            if let Some(fixed) = fixed {
                *u = *fixed;
            }
        }
    }
}
