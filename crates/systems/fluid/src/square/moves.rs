//! The parts of a step in the square.

use super::simulation::{Grid, Square};
use super::stam::Ghosts;
use crate::FluidError;
use crate::transport::Cells;
use pompeiu_core::run::Instant;
use pompeiu_solve::{Cholesky, LinearSolver, SparseMatrix};
use std::time::Duration;

/// Largest number of substeps of a step.
const MOST_SUBSTEPS: f64 = 100_000.0;

/// Measures the times of the parts.
struct Clock(Instant);

impl Clock {
    fn start() -> Self {
        Self(Instant::now())
    }

    /// Adds the time since the last part.
    fn add(&mut self, part: &mut Duration) {
        let now = Instant::now();
        *part += now - self.0;
        self.0 = now;
    }
}

impl Square {
    /// The acceleration in each cell.
    pub(super) fn force(&self, pushed: Option<&[[f64; 2]]>) -> Option<Vec<[f64; 2]>> {
        let options = &self.options;
        let weighs = options.gravity != [0.0; 2] && options.densities.iter().any(|d| d.weight != 0.0);
        if options.force.is_none() && pushed.is_none() && !weighs {
            return None;
        }
        let count = options.cells * options.cells;
        let mut sum = options.force.clone().unwrap_or_else(|| vec![[0.0; 2]; count]);
        for (f, pushed) in sum.iter_mut().zip(pushed.into_iter().flatten()) {
            *f = [f[0] + pushed[0], f[1] + pushed[1]];
        }
        for (density, values) in options.densities.iter().zip(&self.densities) {
            for (f, x) in sum.iter_mut().zip(values) {
                for k in 0..2 {
                    f[k] += density.weight * x * options.gravity[k];
                }
            }
        }
        Some(sum)
    }

    /// Forces, viscosity, projection, advection, projection.
    pub(super) fn move_velocity(&mut self, force: Option<&[[f64; 2]]>) -> Result<(), FluidError> {
        let (options, dt) = (&self.options, self.options.time_step);
        let mut clock = Clock::start();
        let timing = &mut self.timing;
        match &mut self.grid {
            Grid::Mac { mac, velocity, .. } => {
                if let Some(force) = force {
                    let pushed: Vec<[f64; 2]> = force.iter().map(|f| f.map(|x| dt * x)).collect();
                    for (values, push) in velocity.iter_mut().zip(mac.means_of_cells(&pushed)) {
                        values.iter_mut().zip(push).for_each(|(u, push)| *u += push);
                    }
                    mac.reset_fixed(velocity);
                }
                mac.diffuse(velocity)?;
                clock.add(&mut timing.diffuse);
                mac.project(velocity)?;
                clock.add(&mut timing.project);
                *velocity = mac.advect(velocity, dt);
                clock.add(&mut timing.advect);
                mac.project(velocity)?;
                clock.add(&mut timing.project);
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
                clock.add(&mut timing.diffuse);
                stam.project(&mut u, &mut v)?;
                clock.add(&mut timing.project);
                let mut next = [
                    stam.advect(Ghosts::OddAlongX, &u, [&u, &v], dt),
                    stam.advect(Ghosts::OddAlongY, &v, [&u, &v], dt),
                ];
                clock.add(&mut timing.advect);
                let [u, v] = &mut next;
                stam.project(u, v)?;
                clock.add(&mut timing.project);
                *velocity = next;
            }
        }
        Ok(())
    }

    /// Sources, diffusion and transport of densities; returns the Courant number.
    pub(super) fn move_densities(&mut self) -> Result<f64, FluidError> {
        let dt = self.options.time_step;
        let options = &self.options;
        let mut clock = Clock::start();
        let timing = &mut self.timing;
        match &mut self.grid {
            Grid::Mac { mac, velocity, areas } => {
                let cells = Cells::new(mac.ends(), areas, &mac.flows(velocity));
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
                    clock.add(&mut timing.diffuse);
                    // Inflow carries no density.
                    values.push(0.0);
                    cells.carry(values, dt);
                    values.pop();
                    clock.add(&mut timing.advect);
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
                    clock.add(&mut timing.diffuse);
                    *values = stam.inner(&stam.advect(Ghosts::Even, &spread, [u, v], dt));
                    clock.add(&mut timing.advect);
                }
                let fastest =
                    u.iter().chain(v.iter()).fold(0.0, |m: f64, x| if x.abs() > m { x.abs() } else { m });
                Ok(fastest * dt * options.cells as f64)
            }
        }
    }

    /// Factored diffusion operators of densities, without flux into obstacles and walls.
    pub(super) fn heat_factors(&self) -> Result<Vec<Option<Cholesky>>, FluidError> {
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
