//! Fluids in the unit square.

use crate::arrays::{array_of_rows, values, vectors};
use crate::errors::Raise;
use crate::fluid::{DensityOptions, choice};
use crate::json::written;
use crate::wait;
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pompeiu::fluid::square::{Edges, Square, SquareDensity, SquareOptions, SquareScheme, SquareState};
use pompeiu::fluid::{FluidError, Wall};
use pyo3::prelude::*;

/// Options, as the Python half hands them over. Cells are numbered row by row from below.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options {
    cells: usize,
    grid: String,
    edges: String,
    time_step: f64,
    viscosity: f64,
    wall: String,
    lid: f64,
    gravity: [f64; 2],
    acceleration: Option<[f64; 2]>,
    obstacles: Option<Vec<bool>>,
    densities: Vec<DensityOptions>,
}

impl Options {
    fn options(self) -> PyResult<SquareOptions> {
        let grids = "\"mac\", \"stam\" or \"stam:SWEEPS\"";
        let edges = "\"walls\", \"periodic\" or \"channel:SPEED\"";
        let new = SquareOptions::new(self.cells, self.time_step);
        // A number of cells that is far too large is refused before anything of its size is made.
        Square::check_cells(self.cells).map_err(Raise::raise)?;
        let densities = self.densities.into_iter().map(|density| SquareDensity {
            name: density.name,
            initial: density.initial,
            diffusivity: density.diffusivity,
            weight: density.weight,
            source: density.source,
        });
        Ok(SquareOptions {
            scheme: choice("grid", &self.grid, SquareScheme::named, grids)?,
            edges: choice("edges", &self.edges, Edges::named, edges)?,
            viscosity: self.viscosity,
            wall: choice("wall", &self.wall, Wall::named, "\"no-slip\" or \"free-slip\"")?,
            lid: self.lid,
            gravity: self.gravity,
            force: self.acceleration.map(|acceleration| vec![acceleration; self.cells * self.cells]),
            solid: self.obstacles,
            densities: densities.collect(),
            ..new
        })
    }
}

/// A fluid in the unit square that is stepped.
#[pyclass(module = "pompeiu._native")]
pub(crate) struct SquareSimulation(Square);

#[pymethods]
impl SquareSimulation {
    #[new]
    fn new(py: Python<'_>, options: Options) -> PyResult<Self> {
        let options = options.options()?;
        wait::abandonable(py, move || Square::new(options))?.map(Self).map_err(Raise::raise)
    }

    /// Moves on by a step; what is measured, as JSON.
    fn step(&mut self, py: Python<'_>, force: Option<&Bound<'_, PyAny>>) -> PyResult<String> {
        let force = force.map(|force| vectors::<2>(force, "vectors of the force", "(n, 2)")).transpose()?;
        let stepped = py.detach(|| self.0.step_with(force.as_deref()));
        written(&stepped.map_err(Raise::raise)?)
    }

    /// What is measured of the flow as it is, as JSON.
    fn measure(&self) -> PyResult<String> {
        written(&self.0.measure().map_err(Raise::raise)?)
    }

    /// How the flow is computed, as JSON.
    fn scheme(&self) -> PyResult<String> {
        written(&self.0.scheme())
    }

    fn set_velocity(&mut self, field: &Bound<'_, PyAny>) -> PyResult<()> {
        let field = vectors::<2>(field, "vectors of the velocity", "(n, 2)")?;
        self.0.set_velocity(&field).map_err(Raise::raise)
    }

    fn set_density(&mut self, index: usize, density: &Bound<'_, PyAny>) -> PyResult<()> {
        self.0.set_density(index, values(density, "density")?).map_err(Raise::raise)
    }

    /// The components of the velocity where the scheme stores them.
    fn stored<'py>(&self, py: Python<'py>) -> [Bound<'py, PyArray1<f64>>; 2] {
        self.0.state().velocity.map(|values| values.into_pyarray(py))
    }

    /// Goes to a state that was saved.
    fn restore(
        &mut self,
        at: (usize, f64),
        velocity: [Bound<'_, PyAny>; 2],
        densities: Vec<Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let [u, v] = velocity;
        let velocity = [values(&u, "velocity")?, values(&v, "velocity")?];
        let densities =
            densities.into_iter().map(|density| values(&density, "density")).collect::<PyResult<_>>()?;
        let state = SquareState { step: at.0, time: at.1, velocity, densities };
        self.0.set_state(&state).map_err(|error: FluidError| error.raise())
    }

    #[getter]
    fn steps(&self) -> usize {
        self.0.steps()
    }

    #[getter]
    fn time(&self) -> f64 {
        self.0.time()
    }

    fn velocity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        array_of_rows(py, self.0.velocity())
    }

    fn vorticity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.0.vorticity().into_pyarray(py)
    }

    fn density<'py>(&self, py: Python<'py>, index: usize) -> Option<Bound<'py, PyArray1<f64>>> {
        self.0.densities().get(index).map(|values| values.clone().into_pyarray(py))
    }
}
