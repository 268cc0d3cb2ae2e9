//! Fluids in the unit square.

use crate::arrays::{array_of, array_of_rows, values, vectors};
use crate::ask::request;
use crate::errors::Raise;
use crate::fluid::DensityOptions;
use crate::json::written;
use crate::wait;
use numpy::{PyArray1, PyArray2};
use pompeiu::core::TriMesh;
use pompeiu::fluid::request::{Checkpoint, FluidRequest, FluidRequestError};
use pompeiu::fluid::square::{Square, SquareDensity, SquareOptions};
use pyo3::prelude::*;

/// The options of a request, with arrays of obstacles and densities. Cells are numbered row by row from below.
fn options(
    request: &FluidRequest,
    solid: Option<Vec<bool>>,
    densities: Vec<DensityOptions>,
) -> Result<SquareOptions, FluidRequestError> {
    let cells = request.square.unwrap_or_default();
    // A number of cells that is far too large is refused before anything of its size is made.
    Square::check_cells(cells)?;
    let densities = densities.into_iter().map(|density| SquareDensity {
        name: density.name,
        initial: density.initial,
        diffusivity: density.diffusivity,
        weight: density.weight,
        source: density.source,
    });
    Ok(SquareOptions {
        scheme: request.grid,
        edges: request.edges,
        viscosity: request.viscosity,
        wall: request.wall,
        lid: request.lid,
        gravity: request.gravity.map_or([0.0; 2], |[x, y, _]| [x, y]),
        force: request.acceleration.map(|[x, y, _]| vec![[x, y]; cells * cells]),
        solid,
        densities: densities.collect(),
        ..SquareOptions::new(cells, request.dt.unwrap_or_default())
    })
}

/// A fluid in the unit square that is stepped.
#[pyclass(module = "pompeiu._native")]
pub(crate) struct SquareSimulation(Square, FluidRequest);

impl SquareSimulation {
    fn cells(&self) -> Result<TriMesh, FluidRequestError> {
        self.1.cells()?.ok_or(FluidRequestError::Place)
    }
}

#[pymethods]
impl SquareSimulation {
    #[new]
    fn new(
        py: Python<'_>,
        options: &str,
        obstacles: Option<Vec<bool>>,
        densities: Vec<DensityOptions>,
    ) -> PyResult<Self> {
        let request: FluidRequest = request(options)?;
        let options = self::options(&request, obstacles, densities).map_err(Raise::raise)?;
        let square = wait::abandonable(py, move || Square::new(options))?.map_err(Raise::raise)?;
        Ok(Self(square, request))
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

    /// The state as a checkpoint.
    fn save(&self) -> PyResult<Vec<u8>> {
        let saved = self.cells().and_then(|cells| {
            Ok(Checkpoint::new(&cells, &self.0.scheme(), self.0.store(), &[])?.to_bytes()?)
        });
        saved.map_err(Raise::raise)
    }

    /// Goes to a state that was saved.
    fn load(&mut self, bytes: &[u8]) -> PyResult<()> {
        let loaded = self.cells().and_then(|cells| {
            let checkpoint = Checkpoint::from_bytes(bytes, &cells, &self.0.scheme())?;
            Ok(self.0.restore(checkpoint.stored())?)
        });
        loaded.map_err(Raise::raise)
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

    fn vorticity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        array_of(py, self.0.vorticity())
    }

    fn density<'py>(&self, py: Python<'py>, index: usize) -> PyResult<Option<Bound<'py, PyArray1<f64>>>> {
        self.0.densities().get(index).map(|values| array_of(py, values.clone())).transpose()
    }
}
