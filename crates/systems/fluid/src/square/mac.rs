//! A MAC grid: velocity components on the sides of cells, divergence-free to rounding.
//!
//! # Source
//! `harlow_numerical_1965` for the staggered grid; semi-Lagrangian advection with `MacCormack`'s correction as on surfaces.

use super::options::{Edges, SquareOptions};
use super::sample::Lattice;
use crate::{FluidError, Wall};
use pompeiu_core::mesh::UnionFind;
use pompeiu_solve::{Cholesky, LinearSolver, SemidefiniteCholesky, SolveError, SparseMatrix};

/// One component of the velocity on its sides.
#[derive(Debug)]
struct Component {
    lattice: Lattice,
    /// The prescribed velocity of sides.
    fixed: Vec<Option<f64>>,
    /// The cells before and after each side; `None` outside the square.
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
pub(super) struct Mac {
    n: usize,
    components: [Component; 2],
    pressure: SemidefiniteCholesky,
    /// The cells on both sides of each side; the outside is cell n².
    pub(super) ends: Vec<[u32; 2]>,
    /// The component and side of each.
    sides: Vec<(usize, usize)>,
    pub(super) areas: Vec<f64>,
}

/// The area of the outside: so large that nothing changes there.
const BEYOND: f64 = 1e300;

impl Mac {
    pub(super) fn new(options: &SquareOptions) -> Result<Self, FluidError> {
        let n = options.cells;
        let solid = |cell: u32| options.solid.as_ref().is_some_and(|solid| solid[cell as usize]);
        let mut components = [0, 1].map(|axis| Component::new(options, axis, &solid));
        if options.viscosity > 0.0 {
            for (axis, component) in components.iter_mut().enumerate() {
                component.diffusion = Some(component.diffusion(options, axis)?);
            }
        }
        let count = n * n;
        let (mut links, mut outflow) = (Vec::new(), vec![0.0; count]);
        let (mut ends, mut sides) = (Vec::new(), Vec::new());
        let mut groups = UnionFind::new(count + 1);
        for (axis, component) in components.iter().enumerate() {
            for (side, &[before, after]) in component.cells.iter().enumerate() {
                let beyond = count as u32;
                let pair = [before.unwrap_or(beyond), after.unwrap_or(beyond)];
                if component.fixed[side] != Some(0.0) {
                    ends.push(pair);
                    sides.push((axis, side));
                }
                if component.fixed[side].is_some() {
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
        let fixed: Vec<bool> = (0..count as u32).map(solid).collect();
        // Groups are numbered in the order of their first cells; a group connected to the outside has no constants in its kernel.
        let outside = groups.find(count);
        let mut names = std::collections::BTreeMap::new();
        let group: Vec<Option<u32>> = (0..count)
            .map(|cell| {
                let root = groups.find(cell);
                let next = names.len() as u32;
                let closed = root != outside && !fixed[cell];
                closed.then(|| *names.entry(root).or_insert(next))
            })
            .collect();
        let pressure = SemidefiniteCholesky::new(matrix, &fixed, &group)?;
        let mut areas = vec![1.0 / count as f64; count];
        areas.push(BEYOND);
        Ok(Self { n, components, pressure, ends, sides, areas })
    }

    /// Components at rest, except for prescribed sides.
    pub(super) fn at_rest(&self) -> [Vec<f64>; 2] {
        [0, 1].map(|axis| self.components[axis].fixed.iter().map(|fixed| fixed.unwrap_or(0.0)).collect())
    }

    /// The prescribed velocity of sides.
    pub(super) fn fixed(&self) -> [&[Option<f64>]; 2] {
        self.components.each_ref().map(|component| component.fixed.as_slice())
    }

    /// Components from vectors in cells: means of the adjacent cells.
    pub(super) fn means_of_cells(&self, vectors: &[[f64; 2]]) -> [Vec<f64>; 2] {
        [0, 1].map(|axis| {
            let component = &self.components[axis];
            let mean = |(side, cells): (usize, &[Option<u32>; 2])| {
                let of = |cell: &Option<u32>| cell.map(|cell| vectors[cell as usize][axis]);
                component.fixed[side].unwrap_or(match (of(&cells[0]), of(&cells[1])) {
                    (Some(a), Some(b)) => 0.5 * (a + b),
                    (Some(a), None) | (None, Some(a)) => a,
                    (None, None) => 0.0,
                })
            };
            component.cells.iter().enumerate().map(mean).collect()
        })
    }

    /// Vectors in cells: means of their sides.
    pub(super) fn to_cells(&self, velocity: &[Vec<f64>; 2]) -> Vec<[f64; 2]> {
        let h = 1.0 / self.n as f64;
        let centre = |cell: usize| [h * ((cell % self.n) as f64 + 0.5), h * ((cell / self.n) as f64 + 0.5)];
        (0..self.n * self.n).map(|cell| self.at(velocity, centre(cell))).collect()
    }

    /// The velocity at a point.
    pub(super) fn at(&self, velocity: &[Vec<f64>; 2], place: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| self.components[axis].lattice.sample(&velocity[axis], place))
    }

    /// The flow across each of `ends`.
    pub(super) fn flows(&self, velocity: &[Vec<f64>; 2]) -> Vec<f64> {
        let h = 1.0 / self.n as f64;
        self.sides.iter().map(|&(axis, side)| h * velocity[axis][side]).collect()
    }

    /// The net outflow of each cell.
    pub(super) fn outflow(&self, velocity: &[Vec<f64>; 2]) -> Vec<f64> {
        let mut sums = vec![0.0; self.n * self.n + 1];
        for (&[a, b], flow) in self.ends.iter().zip(self.flows(velocity)) {
            sums[a as usize] += flow;
            sums[b as usize] -= flow;
        }
        sums.pop();
        sums
    }

    /// Subtracts the gradient of a pressure, so that the net outflow of every cell is zero.
    pub(super) fn project(&self, velocity: &mut [Vec<f64>; 2]) -> Result<(), FluidError> {
        let n = self.n as f64;
        let mut pressure: Vec<f64> = self.outflow(velocity).into_iter().map(|flow| -flow * n).collect();
        self.pressure.solve_refined_in_place(&mut pressure)?;
        let at = |cell: Option<u32>| cell.map_or(0.0, |cell| pressure[cell as usize]);
        for (component, values) in self.components.iter().zip(velocity) {
            for (side, &[before, after]) in component.cells.iter().enumerate() {
                if component.fixed[side].is_none() {
                    values[side] -= at(after) - at(before);
                }
            }
        }
        Ok(())
    }

    /// A viscous step.
    pub(super) fn diffuse(&self, velocity: &mut [Vec<f64>; 2]) -> Result<(), FluidError> {
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
    pub(super) fn advect(&self, velocity: &[Vec<f64>; 2], time: f64) -> [Vec<f64>; 2] {
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
                    component.fixed[side].unwrap_or(kept)
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
    fn new(options: &SquareOptions, axis: usize, solid: &impl Fn(u32) -> bool) -> Self {
        let n = options.cells;
        let periodic = options.is_periodic();
        let mut points = [n; 2];
        points[axis] = if periodic { n } else { n + 1 };
        let mut origin = [0.5; 2];
        origin[axis] = 0.0;
        let lattice = Lattice { points, origin, per_length: n as f64, periodic };
        let count = points[0] * points[1];
        let cells = (0..count)
            .map(|side| {
                let at = [side % points[0], side / points[0]];
                let cell = |along: usize| {
                    let (i, j) = if axis == 0 { (along, at[1]) } else { (at[0], along) };
                    (j * n + i) as u32
                };
                let before =
                    if at[axis] > 0 { Some(cell(at[axis] - 1)) } else { periodic.then(|| cell(n - 1)) };
                [before, (at[axis] < n).then(|| cell(at[axis]))]
            })
            .collect::<Vec<_>>();
        let fixed = cells
            .iter()
            .map(|&[before, after]| {
                if before.into_iter().chain(after).any(solid) {
                    return Some(0.0);
                }
                match (before, after, options.edges) {
                    (Some(_), Some(_), _) => None,
                    (None, _, Edges::Channel { speed }) if axis == 0 => Some(speed),
                    (_, None, Edges::Channel { .. }) if axis == 0 => None,
                    _ => Some(0.0),
                }
            })
            .collect();
        Self { lattice, fixed, cells, diffusion: None }
    }

    /// Backward Euler for viscosity with the five-point stencil; walls are half a spacing away from sides parallel to them.
    fn diffusion(&self, options: &SquareOptions, axis: usize) -> Result<Diffusion, SolveError> {
        let n = options.cells;
        let number = options.viscosity * options.time_step * (n * n) as f64;
        let [columns, rows] = self.lattice.points;
        let count = columns * rows;
        let mut links = Vec::with_capacity(2 * count);
        let (mut diagonal, mut driven) = (vec![1.0; count], vec![0.0; count]);
        let held = options.wall == Wall::NoSlip && options.edges == Edges::Walls;
        for side in 0..count {
            let (i, j) = (side % columns, side / columns);
            for (at, last, next) in [(i, columns, 1), (j, rows, columns)] {
                if at + 1 < last {
                    links.push((side as u32, (side + next) as u32, number));
                } else if self.lattice.periodic {
                    links.push((side as u32, (side + next - last * next) as u32, number));
                }
            }
            // Walls parallel to the component; those perpendicular to it are prescribed sides.
            let across = if axis == 0 { j } else { i };
            for (edge, speed) in [(0, 0.0), (n - 1, if axis == 0 { options.lid } else { 0.0 })] {
                if held && across == edge {
                    diagonal[side] += 2.0 * number;
                    driven[side] += 2.0 * number * speed;
                }
            }
        }
        let matrix = SparseMatrix::from_links(count, &links)?;
        let matrix = matrix.combined(1.0, &SparseMatrix::diagonal(&diagonal)?, 1.0)?;
        let given: Vec<f64> = self.fixed.iter().map(|fixed| fixed.unwrap_or(0.0)).collect();
        for (driven, product) in driven.iter_mut().zip(matrix.multiply(&given)) {
            *driven -= product;
        }
        let free: Vec<usize> = (0..count).filter(|&side| self.fixed[side].is_none()).collect();
        let factor = Cholesky::new(&matrix.principal(&free)?)?;
        let driven = free.iter().map(|&side| driven[side]).collect();
        Ok(Diffusion { factor, free, driven })
    }
}
