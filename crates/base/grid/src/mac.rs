//! A MAC grid: velocity components on the sides of cells, divergence-free to rounding.
//!
//! # Source
//! `harlow_numerical_1965` for the staggered grid; semi-Lagrangian advection with `MacCormack`'s correction as on surfaces.

use crate::Lattice;
use pompeiu_core::mesh::UnionFind;
use pompeiu_solve::{Cholesky, LinearSolver, SemidefiniteCholesky, SolveError, SparseMatrix};

/// A rectangle of square cells, numbered row by row from below.
///
/// # Shapes and units
/// Component 0 of the velocity is stored on the sides across x, component 1 on those across y, row by row from below: `nx + 1` sides
/// in a row across x, `nx` where x is periodic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MacGrid {
    /// Cells along x and y.
    pub cells: [usize; 2],
    /// Cells in a unit of length.
    pub per_length: f64,
    /// Whether the rectangle is periodic along x and y.
    pub periodic: [bool; 2],
}

impl MacGrid {
    /// Number of cells.
    pub fn count(&self) -> usize {
        self.cells[0] * self.cells[1]
    }

    /// The lattice of a component.
    pub fn lattice(&self, axis: usize) -> Lattice {
        let mut points = self.cells;
        points[axis] += usize::from(!self.periodic[axis]);
        let mut origin = [0.5; 2];
        origin[axis] = 0.0;
        Lattice { points, origin, per_length: self.per_length, periodic: self.periodic }
    }

    /// The centre of a cell.
    pub fn centre(&self, cell: usize) -> [f64; 2] {
        let h = 1.0 / self.per_length;
        [h * ((cell % self.cells[0]) as f64 + 0.5), h * ((cell / self.cells[0]) as f64 + 0.5)]
    }

    /// The cells before and after each side of a component; none beyond the edges.
    fn beside(&self, axis: usize) -> Vec<[Option<u32>; 2]> {
        let [nx, _] = self.cells;
        let [columns, rows] = self.lattice(axis).points;
        (0..columns * rows)
            .map(|side| {
                let at = [side % columns, side / columns];
                let cell = |along: usize| {
                    let (i, j) = if axis == 0 { (along, at[1]) } else { (at[0], along) };
                    (j * nx + i) as u32
                };
                let n = self.cells[axis];
                let before = if at[axis] > 0 {
                    Some(cell(at[axis] - 1))
                } else {
                    self.periodic[axis].then(|| cell(n - 1))
                };
                [before, (at[axis] < n).then(|| cell(at[axis]))]
            })
            .collect()
    }
}

/// How the velocity on a side is determined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Side {
    /// By the projection. On the boundary of the rectangle the pressure is zero half a cell outside.
    Free,
    /// A fixed velocity.
    Fixed(f64),
    /// Set by the caller before each projection.
    Given,
}

impl Side {
    fn fixed(self) -> Option<f64> {
        match self {
            Self::Free | Self::Given => None,
            Self::Fixed(velocity) => Some(velocity),
        }
    }
}

/// One component of the velocity on its sides.
#[derive(Debug)]
struct Component {
    lattice: Lattice,
    sides: Vec<Side>,
    /// The cells before and after each side; `None` outside the rectangle.
    cells: Vec<[Option<u32>; 2]>,
    diffusion: Option<Diffusion>,
}

/// Backward Euler for the viscosity of a component.
#[derive(Debug)]
struct Diffusion {
    factor: Cholesky,
    free: Vec<usize>,
    /// Contribution of prescribed sides and moving walls.
    driven: Vec<f64>,
}

/// The grid with its linear systems.
#[derive(Debug)]
pub struct Mac {
    grid: MacGrid,
    components: [Component; 2],
    pressure: SemidefiniteCholesky,
    closed: usize,
    /// The cells on both sides of each side with flow; the outside is the cell after the last.
    ends: Vec<[u32; 2]>,
    /// The component and side of each.
    crossed: Vec<(usize, usize)>,
}

impl Mac {
    /// A grid with these sides; sides of solid cells stay at rest.
    ///
    /// # Shapes and units
    /// `side` is called with the component, the number of the side and the cells before and after it; `solid` has one entry per cell.
    ///
    /// # Errors
    /// [`SolveError::Length`] if `solid` does not have one entry per cell; those of the factorisation for the pressure.
    pub fn new(
        grid: MacGrid,
        solid: &[bool],
        side: impl Fn(usize, usize, [Option<u32>; 2]) -> Side,
    ) -> Result<Self, SolveError> {
        let count = grid.count();
        if solid.len() != count {
            let (what, found, expected) = ("list of solid cells", solid.len(), count);
            return Err(SolveError::Length { what, found, expected });
        }
        let is_solid = |cell: u32| solid[cell as usize];
        let components = [0, 1].map(|axis| {
            let cells = grid.beside(axis);
            let of = |(index, &pair): (usize, &[Option<u32>; 2])| {
                if pair.into_iter().flatten().any(is_solid) {
                    Side::Fixed(0.0)
                } else {
                    side(axis, index, pair)
                }
            };
            let sides = cells.iter().enumerate().map(of).collect();
            Component { lattice: grid.lattice(axis), sides, cells, diffusion: None }
        });
        let (mut links, mut outflow) = (Vec::new(), vec![0.0; count]);
        let (mut ends, mut crossed) = (Vec::new(), Vec::new());
        let mut groups = UnionFind::new(count + 1);
        for (axis, component) in components.iter().enumerate() {
            for (side, &[before, after]) in component.cells.iter().enumerate() {
                let beyond = count as u32;
                let pair = [before.unwrap_or(beyond), after.unwrap_or(beyond)];
                if component.sides[side] != Side::Fixed(0.0) {
                    ends.push(pair);
                    crossed.push((axis, side));
                }
                if component.sides[side] != Side::Free {
                    continue;
                }
                groups.union(pair[0] as usize, pair[1] as usize);
                match (before, after) {
                    (Some(a), Some(b)) => links.push((a, b, 1.0)),
                    (Some(a), None) | (None, Some(a)) => outflow[a as usize] += 1.0,
                    (None, None) => {}
                }
            }
        }
        let matrix = SparseMatrix::from_links(count, &links)?;
        let matrix = matrix.combined(1.0, &SparseMatrix::diagonal(&outflow)?, 1.0)?;
        // Groups are numbered in the order of their first cells; a group connected to the outside has no constants in its kernel.
        let outside = groups.find(count);
        let mut names = std::collections::BTreeMap::new();
        let group: Vec<Option<u32>> = (0..count)
            .map(|cell| {
                let root = groups.find(cell);
                let next = names.len() as u32;
                let closed = root != outside && !solid[cell];
                closed.then(|| *names.entry(root).or_insert(next))
            })
            .collect();
        let pressure = SemidefiniteCholesky::new(matrix, solid, &group)?;
        Ok(Self { grid, components, pressure, closed: names.len(), ends, crossed })
    }

    /// Adds viscosity: a step of backward Euler with `number` = viscosity · step / h².
    ///
    /// `along` is the velocity of the wall along each component at the low and at the high edge across it; none for a slip wall.
    ///
    /// # Errors
    /// Those of the factorisation.
    pub fn with_viscosity(mut self, number: f64, along: [[Option<f64>; 2]; 2]) -> Result<Self, SolveError> {
        for (axis, component) in self.components.iter_mut().enumerate() {
            component.diffusion = Some(component.diffusion(number, axis, along[axis])?);
        }
        Ok(self)
    }

    /// The rectangle.
    pub fn grid(&self) -> MacGrid {
        self.grid
    }

    /// The number of connected regions without a side where the pressure is given. Their pressure is determined up to a constant,
    /// and their net inflow must be zero.
    pub fn closed_regions(&self) -> usize {
        self.closed
    }

    /// The cells on both sides of each side with flow, in the order of [`flows`](Self::flows); the outside is the cell after the
    /// last.
    pub fn ends(&self) -> &[[u32; 2]] {
        &self.ends
    }

    /// How the sides of each component are determined.
    pub fn sides(&self) -> [&[Side]; 2] {
        self.components.each_ref().map(|component| component.sides.as_slice())
    }

    /// Components at rest, except for prescribed sides.
    pub fn at_rest(&self) -> [Vec<f64>; 2] {
        [0, 1]
            .map(|axis| self.components[axis].sides.iter().map(|side| side.fixed().unwrap_or(0.0)).collect())
    }

    /// Sets prescribed sides to their velocity.
    pub fn reset_fixed(&self, velocity: &mut [Vec<f64>; 2]) {
        for (component, values) in self.components.iter().zip(velocity) {
            for (u, side) in values.iter_mut().zip(&component.sides) {
                if let Side::Fixed(fixed) = side {
                    *u = *fixed;
                }
            }
        }
    }

    /// Components from vectors in cells: means of the adjacent cells.
    pub fn means_of_cells(&self, vectors: &[[f64; 2]]) -> [Vec<f64>; 2] {
        [0, 1].map(|axis| {
            let component = &self.components[axis];
            let mean = |(side, cells): (usize, &[Option<u32>; 2])| {
                let of = |cell: &Option<u32>| cell.map(|cell| vectors[cell as usize][axis]);
                component.sides[side].fixed().unwrap_or(match (of(&cells[0]), of(&cells[1])) {
                    (Some(a), Some(b)) => 0.5 * (a + b),
                    (Some(a), None) | (None, Some(a)) => a,
                    (None, None) => 0.0,
                })
            };
            component.cells.iter().enumerate().map(mean).collect()
        })
    }

    /// Vectors in cells: means of their sides.
    pub fn to_cells(&self, velocity: &[Vec<f64>; 2]) -> Vec<[f64; 2]> {
        (0..self.grid.count()).map(|cell| self.at(velocity, self.grid.centre(cell))).collect()
    }

    /// The velocity at a point.
    pub fn at(&self, velocity: &[Vec<f64>; 2], place: [f64; 2]) -> [f64; 2] {
        let [across, up] = &self.components;
        [across.lattice.sample(&velocity[0], place), up.lattice.sample(&velocity[1], place)]
    }

    /// The flow across each of `ends`.
    pub fn flows(&self, velocity: &[Vec<f64>; 2]) -> Vec<f64> {
        let h = 1.0 / self.grid.per_length;
        self.crossed.iter().map(|&(axis, side)| h * velocity[axis][side]).collect()
    }

    /// The net outflow of each cell.
    pub fn outflow(&self, velocity: &[Vec<f64>; 2]) -> Vec<f64> {
        let mut sums = vec![0.0; self.grid.count() + 1];
        for (&[a, b], flow) in self.ends.iter().zip(self.flows(velocity)) {
            sums[a as usize] += flow;
            sums[b as usize] -= flow;
        }
        sums.pop();
        sums
    }

    /// Subtracts the gradient of a pressure, so that the net outflow of every cell is zero.
    ///
    /// Returns that pressure in cells, times step over density and cells in a unit of length: a velocity. Its mean is zero in each
    /// closed region. If the net inflow of such a region is not zero, it is spread evenly over its cells.
    ///
    /// # Errors
    /// [`SolveError`] where velocities are not finite.
    pub fn project(&self, velocity: &mut [Vec<f64>; 2]) -> Result<Vec<f64>, SolveError> {
        let mut pressure = self.missing(velocity);
        self.pressure.solve_refined_in_place(&mut pressure)?;
        self.subtract_gradient(velocity, &pressure);
        Ok(pressure)
    }

    /// The same from a pressure that is nearly right, with one solution of the linear system instead of two: of what is left.
    ///
    /// # Errors
    /// [`SolveError::Length`] if the pressure does not have one entry per cell; [`SolveError`] where velocities are not finite.
    pub fn project_from(
        &self,
        velocity: &mut [Vec<f64>; 2],
        mut pressure: Vec<f64>,
    ) -> Result<Vec<f64>, SolveError> {
        let (found, expected) = (pressure.len(), self.grid.count());
        if found != expected {
            return Err(SolveError::Length { what: "pressure", found, expected });
        }
        self.subtract_gradient(velocity, &pressure);
        let mut change = self.missing(velocity);
        self.pressure.solve_in_place(&mut change)?;
        self.subtract_gradient(velocity, &change);
        for (p, change) in pressure.iter_mut().zip(change) {
            *p += change;
        }
        Ok(pressure)
    }

    /// The net inflow that each cell is short of, as the right side for a pressure.
    fn missing(&self, velocity: &[Vec<f64>; 2]) -> Vec<f64> {
        let n = self.grid.per_length;
        self.outflow(velocity).into_iter().map(|flow| -flow * n).collect()
    }

    fn subtract_gradient(&self, velocity: &mut [Vec<f64>; 2], pressure: &[f64]) {
        let at = |cell: Option<u32>| cell.map_or(0.0, |cell| pressure[cell as usize]);
        for (component, values) in self.components.iter().zip(velocity) {
            for (side, &[before, after]) in component.cells.iter().enumerate() {
                if component.sides[side] == Side::Free {
                    values[side] -= at(after) - at(before);
                }
            }
        }
    }

    /// A viscous step.
    ///
    /// # Errors
    /// [`SolveError`] where velocities are not finite.
    pub fn diffuse(&self, velocity: &mut [Vec<f64>; 2]) -> Result<(), SolveError> {
        for (component, values) in self.components.iter().zip(velocity) {
            let Some(diffusion) = &component.diffusion else { continue };
            let mut free: Vec<f64> =
                diffusion.free.iter().zip(&diffusion.driven).map(|(&i, driven)| values[i] + driven).collect();
            diffusion.factor.solve_in_place(&mut free)?;
            for (&i, value) in diffusion.free.iter().zip(free) {
                values[i] = value;
            }
        }
        Ok(())
    }

    /// Advects the velocity with itself for some time.
    pub fn advect(&self, velocity: &[Vec<f64>; 2], time: f64) -> [Vec<f64>; 2] {
        [0, 1].map(|axis| {
            let component = &self.components[axis];
            let values = &velocity[axis];
            let places = [-time, time].map(|time| self.follow(velocity, &component.lattice, time));
            let sample = |places: &[[f64; 2]], values: &[f64]| -> Vec<f64> {
                places.iter().map(|&place| component.lattice.sample(values, place)).collect()
            };
            let carried = sample(&places[0], values);
            let returned = sample(&places[1], &carried);
            (0..values.len())
                .map(|side| {
                    let [least, most] = component.lattice.range(values, places[0][side]);
                    let corrected = carried[side] + 0.5 * (values[side] - returned[side]);
                    let kept = if corrected < least {
                        least
                    } else if corrected > most {
                        most
                    } else {
                        corrected
                    };
                    component.sides[side].fixed().unwrap_or(kept)
                })
                .collect()
        })
    }

    /// The positions of lattice points after some time, by the midpoint rule.
    fn follow(&self, velocity: &[Vec<f64>; 2], lattice: &Lattice, time: f64) -> Vec<[f64; 2]> {
        let count = lattice.points[0] * lattice.points[1];
        let moved = |from: [f64; 2], u: [f64; 2], time: f64| [from[0] + time * u[0], from[1] + time * u[1]];
        (0..count)
            .map(|index| {
                let start = lattice.position(index);
                let halfway = moved(start, self.at(velocity, start), 0.5 * time);
                moved(start, self.at(velocity, halfway), time)
            })
            .collect()
    }
}

impl Component {
    /// Backward Euler for viscosity with the five-point stencil; walls are half a spacing away from sides parallel to them.
    fn diffusion(&self, number: f64, axis: usize, along: [Option<f64>; 2]) -> Result<Diffusion, SolveError> {
        let [columns, rows] = self.lattice.points;
        let count = columns * rows;
        let mut links = Vec::with_capacity(2 * count);
        let (mut diagonal, mut driven) = (vec![1.0; count], vec![0.0; count]);
        for side in 0..count {
            let (i, j) = (side % columns, side / columns);
            for (k, (at, last, next)) in [(i, columns, 1), (j, rows, columns)].into_iter().enumerate() {
                if at + 1 < last {
                    links.push((side as u32, (side + next) as u32, number));
                } else if self.lattice.periodic[k] {
                    links.push((side as u32, (side + next - last * next) as u32, number));
                }
            }
            // Walls parallel to the component; those perpendicular to it are prescribed sides.
            let (across, last) = if axis == 0 { (j, rows - 1) } else { (i, columns - 1) };
            for (edge, speed) in [0, last].into_iter().zip(along) {
                let Some(speed) = speed else { continue };
                if across == edge {
                    diagonal[side] += 2.0 * number;
                    driven[side] += 2.0 * number * speed;
                }
            }
        }
        let matrix = SparseMatrix::from_links(count, &links)?;
        let matrix = matrix.combined(1.0, &SparseMatrix::diagonal(&diagonal)?, 1.0)?;
        let given: Vec<f64> = self.sides.iter().map(|side| side.fixed().unwrap_or(0.0)).collect();
        for (driven, product) in driven.iter_mut().zip(matrix.multiply(&given)) {
            *driven -= product;
        }
        let free: Vec<usize> = (0..count).filter(|&side| self.sides[side] == Side::Free).collect();
        let factor = Cholesky::new(&matrix.principal(&free)?)?;
        let driven = free.iter().map(|&side| driven[side]).collect();
        Ok(Diffusion { factor, free, driven })
    }
}
