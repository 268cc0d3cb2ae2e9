//! Stam's grid: velocities at cell centres, with a ring of ghost cells.
//!
//! # Source
//! `stam_realtime_2003`, in double precision, with direct solves as an option.

use crate::FluidError;
use pompeiu_solve::{Cholesky, LinearSolver, SemidefiniteCholesky, SolveError, SparseMatrix};

/// The boundary condition of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ghosts {
    /// Even: densities, pressure.
    Even,
    /// Odd at the left and right edges: velocities along x.
    OddAlongX,
    /// Odd at the lower and upper edges: velocities along y.
    OddAlongY,
}

/// Number of Gauss–Seidel sweeps that run at once: enough that additions of one sweep do not wait for those of another.
const TOGETHER: usize = 4;

/// The grid with its linear systems.
#[derive(Debug)]
pub(super) struct Stam {
    pub(super) n: usize,
    pub(super) periodic: bool,
    sweeps: Option<usize>,
    pressure: Option<SemidefiniteCholesky>,
    /// Factored diffusion operators by cell number and boundary condition.
    diffusion: Vec<(f64, Ghosts, Cholesky)>,
}

impl Stam {
    pub(super) fn new(n: usize, periodic: bool, sweeps: Option<usize>) -> Result<Self, FluidError> {
        let mut grid = Self { n, periodic, sweeps, pressure: None, diffusion: Vec::new() };
        if sweeps.is_none() {
            let matrix = SparseMatrix::from_links(n * n, &grid.links(1.0))?;
            let all = vec![Some(0); n * n];
            grid.pressure = Some(SemidefiniteCholesky::new(matrix, &vec![false; n * n], &all)?);
        }
        Ok(grid)
    }

    /// The index of a cell; ghosts are at 0 and n + 1.
    fn at(&self, i: usize, j: usize) -> usize {
        i + (self.n + 2) * j
    }

    /// The inner cells, row by row.
    pub(super) fn inner(&self, values: &[f64]) -> Vec<f64> {
        let rows = (1..=self.n).flat_map(|j| (1..=self.n).map(move |i| (i, j)));
        rows.map(|(i, j)| values[self.at(i, j)]).collect()
    }

    /// The values with ghost cells around.
    pub(super) fn framed(&self, inner: &[f64], ghosts: Ghosts) -> Vec<f64> {
        let mut values = vec![0.0; (self.n + 2) * (self.n + 2)];
        for (index, value) in inner.iter().enumerate() {
            values[self.at(index % self.n + 1, index / self.n + 1)] = *value;
        }
        self.set_edges(ghosts, &mut values);
        values
    }

    /// Sets ghost cells.
    pub(super) fn set_edges(&self, ghosts: Ghosts, x: &mut [f64]) {
        let n = self.n;
        for j in 1..=n {
            self.set_ends(ghosts, j, x);
        }
        for j in [0, n + 1] {
            self.set_row_beyond(ghosts, j, x);
            for i in [0, n + 1] {
                let (beside, above) = (if i == 0 { 1 } else { n }, if j == 0 { 1 } else { n });
                x[self.at(i, j)] = 0.5 * (x[self.at(beside, j)] + x[self.at(i, above)]);
            }
        }
    }

    /// Sets the ghost cells at both ends of a row.
    fn set_ends(&self, ghosts: Ghosts, j: usize, x: &mut [f64]) {
        let n = self.n;
        let sign = if !self.periodic && ghosts == Ghosts::OddAlongX { -1.0 } else { 1.0 };
        let (first, last) = if self.periodic { (n, 1) } else { (1, n) };
        x[self.at(0, j)] = sign * x[self.at(first, j)];
        x[self.at(n + 1, j)] = sign * x[self.at(last, j)];
    }

    /// Sets the ghost cells of the row below or above all others, but for its ends.
    fn set_row_beyond(&self, ghosts: Ghosts, j: usize, x: &mut [f64]) {
        let n = self.n;
        let sign = if !self.periodic && ghosts == Ghosts::OddAlongY { -1.0 } else { 1.0 };
        let from = if (j == 0) == self.periodic { n } else { 1 };
        for i in 1..=n {
            x[self.at(i, j)] = sign * x[self.at(i, from)];
        }
    }

    /// Links between neighbouring cells, for the Laplacian.
    fn links(&self, weight: f64) -> Vec<(u32, u32, f64)> {
        let n = self.n;
        let cell = |i: usize, j: usize| (j * n + i) as u32;
        let mut links = Vec::with_capacity(2 * n * n);
        for j in 0..n {
            for i in 0..n {
                if i + 1 < n || self.periodic {
                    links.push((cell(i, j), cell((i + 1) % n, j), weight));
                }
                if j + 1 < n || self.periodic {
                    links.push((cell(i, j), cell(i, (j + 1) % n), weight));
                }
            }
        }
        links
    }

    /// Gauss–Seidel sweeps for `(1 + 4a) x − a Σ x = x0`; ghost cells are set after each.
    ///
    /// Each cell waits for the one before it in its row. Therefore several sweeps run at once, each two rows behind the one before:
    /// their rows do not touch, and the values are those of one sweep after the other. With periodic edges a sweep starts from the
    /// last row of the one before.
    fn sweep(&self, ghosts: Ghosts, x: &mut [f64], x0: &[f64], [a, c]: [f64; 2], sweeps: usize) {
        let n = self.n;
        let together = if self.periodic { 1 } else { TOGETHER };
        for first in (0..sweeps).step_by(together) {
            let count = together.min(sweeps - first);
            for ahead in 1..=n + 2 * (count - 1) {
                let row = |sweep: usize| ahead.checked_sub(2 * sweep).filter(|row| (1..=n).contains(row));
                if let [Some(p), Some(q), Some(r), Some(s)] = [0, 1, 2, 3].map(row)
                    && count == TOGETHER
                {
                    self.sweep_rows(ghosts, [p, q, r, s], x, x0, [a, c]);
                } else {
                    (0..count).filter_map(row).for_each(|row| self.sweep_rows(ghosts, [row], x, x0, [a, c]));
                }
            }
            self.set_edges(ghosts, x);
        }
    }

    /// A Gauss–Seidel sweep over rows that do not touch, and their ghost cells where edges are not periodic.
    fn sweep_rows<const K: usize>(
        &self,
        ghosts: Ghosts,
        rows: [usize; K],
        x: &mut [f64],
        x0: &[f64],
        [a, c]: [f64; 2],
    ) {
        let width = self.n + 2;
        let starts = rows.map(|row| width * row);
        let mut left = starts.map(|start| x[start]);
        for i in 1..=self.n {
            for (start, left) in starts.iter().zip(&mut left) {
                let at = start + i;
                let around = *left + x[at + 1] + x[at - width] + x[at + width];
                *left = (x0[at] + a * around) / c;
                x[at] = *left;
            }
        }
        if self.periodic {
            return;
        }
        for row in rows {
            self.set_ends(ghosts, row, x);
            if row == 1 {
                self.set_row_beyond(ghosts, 0, x);
            }
            if row == self.n {
                self.set_row_beyond(ghosts, self.n + 1, x);
            }
        }
    }

    /// A backward Euler step for diffusion; `number` is diffusivity times step over the area of a cell. Sweeps start from an
    /// initial guess.
    pub(super) fn diffuse(
        &mut self,
        ghosts: Ghosts,
        values: &[f64],
        guess: &[f64],
        number: f64,
    ) -> Result<Vec<f64>, FluidError> {
        if let Some(sweeps) = self.sweeps {
            let mut x = guess.to_vec();
            self.sweep(ghosts, &mut x, values, [number, 1.0 + 4.0 * number], sweeps);
            return Ok(x);
        }
        if number == 0.0 {
            return Ok(values.to_vec());
        }
        let ready = self.diffusion.iter().position(|(a, g, _)| *a == number && *g == ghosts);
        let index = if let Some(index) = ready {
            index
        } else {
            self.diffusion.push((number, ghosts, Cholesky::new(&self.diffusion_matrix(ghosts, number)?)?));
            self.diffusion.len() - 1
        };
        let mut x = self.inner(values);
        self.diffusion[index].2.solve_in_place(&mut x)?;
        Ok(self.framed(&x, ghosts))
    }

    fn diffusion_matrix(&self, ghosts: Ghosts, number: f64) -> Result<SparseMatrix, SolveError> {
        let n = self.n;
        let links = SparseMatrix::from_links(n * n, &self.links(number))?;
        // An odd ghost has twice the effect of a neighbour at rest.
        let diagonal: Vec<f64> = (0..n * n)
            .map(|cell| {
                let (i, j) = (cell % n, cell / n);
                let at_edge = |k: usize| f64::from(u8::from(k == 0)) + f64::from(u8::from(k + 1 == n));
                let odd = match ghosts {
                    _ if self.periodic => 0.0,
                    Ghosts::Even => 0.0,
                    Ghosts::OddAlongX => at_edge(i),
                    Ghosts::OddAlongY => at_edge(j),
                };
                1.0 + 2.0 * number * odd
            })
            .collect();
        SparseMatrix::diagonal(&diagonal)?.combined(1.0, &links, 1.0)
    }

    /// Semi-Lagrangian advection of values along a velocity.
    pub(super) fn advect(&self, ghosts: Ghosts, values: &[f64], [u, v]: [&[f64]; 2], time: f64) -> Vec<f64> {
        let n = self.n;
        let mut carried = vec![0.0; values.len()];
        let scaled = time * n as f64;
        let within = |x: f64| -> f64 {
            if self.periodic {
                // Clamped between the first cell and the ghost after the last.
                1.0 + (x - 1.0).rem_euclid(n as f64)
            } else {
                x.clamp(0.5, n as f64 + 0.5)
            }
        };
        for j in 1..=n {
            for i in 1..=n {
                let x = within(i as f64 - scaled * u[self.at(i, j)]);
                let y = within(j as f64 - scaled * v[self.at(i, j)]);
                let (i0, j0) = ((x as usize).min(n), (y as usize).min(n));
                let (s1, t1) = (x - i0 as f64, y - j0 as f64);
                let (s0, t0) = (1.0 - s1, 1.0 - t1);
                carried[self.at(i, j)] = s0
                    * (t0 * values[self.at(i0, j0)] + t1 * values[self.at(i0, j0 + 1)])
                    + s1 * (t0 * values[self.at(i0 + 1, j0)] + t1 * values[self.at(i0 + 1, j0 + 1)]);
            }
        }
        self.set_edges(ghosts, &mut carried);
        carried
    }

    /// The divergence of each cell times `−½ / n`, with ghost cells set.
    pub(super) fn divergence(&self, [u, v]: [&[f64]; 2]) -> Vec<f64> {
        let n = self.n;
        let mut divergence = vec![0.0; u.len()];
        let h = 1.0 / n as f64;
        for j in 1..=n {
            for i in 1..=n {
                divergence[self.at(i, j)] = -0.5
                    * h
                    * (u[self.at(i + 1, j)] - u[self.at(i - 1, j)] + v[self.at(i, j + 1)]
                        - v[self.at(i, j - 1)]);
            }
        }
        self.set_edges(Ghosts::Even, &mut divergence);
        divergence
    }

    /// Subtracts the gradient of a pressure; the result is approximately divergence-free.
    pub(super) fn project(&self, u: &mut [f64], v: &mut [f64]) -> Result<(), FluidError> {
        let n = self.n;
        let divergence = self.divergence([u, v]);
        let pressure = match (&self.pressure, self.sweeps) {
            (Some(system), _) => {
                let mut p = self.inner(&divergence);
                system.solve_in_place(&mut p)?;
                self.framed(&p, Ghosts::Even)
            }
            (None, sweeps) => {
                let mut p = vec![0.0; u.len()];
                self.sweep(Ghosts::Even, &mut p, &divergence, [1.0, 4.0], sweeps.unwrap_or(0));
                p
            }
        };
        let h = 1.0 / n as f64;
        for j in 1..=n {
            for i in 1..=n {
                u[self.at(i, j)] -= 0.5 * (pressure[self.at(i + 1, j)] - pressure[self.at(i - 1, j)]) / h;
                v[self.at(i, j)] -= 0.5 * (pressure[self.at(i, j + 1)] - pressure[self.at(i, j - 1)]) / h;
            }
        }
        self.set_edges(Ghosts::OddAlongX, u);
        self.set_edges(Ghosts::OddAlongY, v);
        Ok(())
    }
}
