//! Fluids on surfaces and in the square: the request, and simulations that are stepped.

use crate::arrays::{array_of, array_of_rows, values, vectors};
use crate::ask::{Asked, Asking, Beside, Outcome, failure, request};
use crate::errors::{Raise, unknown};
use crate::json::written;
use crate::mesh::Mesh;
use crate::wait::{self, Share};
use numpy::{PyArray1, PyArray2};
use pompeiu::core::mesh::{FaceData, VertexData};
use pompeiu::fluid::request::{Checkpoint, FluidRequest, Place, Stage};
use pompeiu::fluid::{Density, FluidError, FluidOptions, Simulation as FluidSimulation, State};
use pompeiu::io::read_face_vectors;
use pompeiu::operators::{FaceField, OperatorError, tangent_field};
use pompeiu::surface::{EdgeData, EmbeddedSurface};
use pyo3::prelude::*;
use self_cell::self_cell;
use std::ops::ControlFlow;

impl Asked for FluidRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        let cells = self.cells().map_err(failure)?;
        let (mesh, surface) = match &cells {
            Some(cells) => (cells, None),
            None => (asking.mesh()?, Some(asking.surface()?)),
        };
        let file = self.velocity.as_ref().filter(|_| surface.is_some()).and_then(|source| source.file());
        let read = file.map(|path| read_face_vectors(path, None)).transpose().map_err(failure)?;
        let place = Place { mesh, surface: surface.as_ref(), velocity: read.as_deref() };
        let mut watch = |_: &Stage<'_>, _: &[_]| ControlFlow::Continue(());
        let run = self.run(place, None, &asking.watched(), &mut watch).map_err(failure)?;
        if let Some(error) = run.failure {
            return Err(failure(error));
        }
        let mut beside = match &run.stage {
            Stage::Surface(fluid, surface) => {
                let state = fluid.state();
                let velocity = state.velocity.entries().map(|(face, &u)| surface.to_space(face, u));
                vec![
                    ("velocity", Beside::Points(velocity.collect())),
                    ("vorticity", Beside::Numbers(state.vorticity.to_vec())),
                ]
            }
            Stage::Square(square) => vec![
                ("velocity", Beside::Plane(square.velocity())),
                ("vorticity", Beside::Numbers(square.vorticity())),
            ],
        };
        let densities = match &run.stage {
            Stage::Surface(fluid, _) => fluid.state().densities.iter().map(|d| d.to_vec()).collect(),
            Stage::Square(square) => square.densities().to_vec(),
        };
        let each = densities.into_iter().map(|values| vec![("values", Beside::Numbers(values))]);
        beside.push(("densities", Beside::Each(each.collect())));
        Ok((run.report, beside))
    }
}

self_cell!(
    /// A surface, and the fluid on it.
    struct Flowing {
        owner: EmbeddedSurface,
        #[covariant]
        dependent: FluidSimulation,
    }
);

/// Something the flow carries.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct DensityOptions {
    pub(crate) name: String,
    pub(crate) initial: Vec<f64>,
    pub(crate) diffusivity: f64,
    pub(crate) weight: f64,
    pub(crate) source: Option<Vec<f64>>,
}

fn at_vertices(surface: &EmbeddedSurface, what: &'static str, values: Vec<f64>) -> PyResult<VertexData<f64>> {
    VertexData::new(surface.mesh().vertices(), values).map_err(|error| {
        let (element, found, expected) = ("vertex", error.found, error.expected);
        FluidError::Length { what, element, found, expected }.raise()
    })
}

/// Speeds of edges that are named by their ends.
fn through_edges(surface: &EmbeddedSurface, inflow: &[(u32, u32, f64)]) -> PyResult<EdgeData<f64>> {
    let mesh = surface.mesh();
    let mut number = std::collections::HashMap::new();
    for edge in mesh.edge_ids().filter(|&edge| mesh.is_boundary_edge(edge)) {
        let [v, w] = mesh.ends(edge).map(|v| v.0);
        number.insert([v.min(w), v.max(w)], edge);
    }
    let mut speeds = EdgeData::filled(mesh.edges(), 0.0);
    for &(v, w, speed) in inflow {
        let edge = number.get(&[v.min(w), v.max(w)]);
        let edge = edge.ok_or_else(|| unknown("inflow", format!("({v}, {w})"), "ends of a boundary edge"))?;
        speeds[*edge] = speed;
    }
    Ok(speeds)
}

/// The options of a request, with arrays of densities and the inflow through edges.
fn options(
    request: &FluidRequest,
    mesh: &Mesh,
    surface: &EmbeddedSurface,
    inflow: Option<Vec<(u32, u32, f64)>>,
    densities: Vec<DensityOptions>,
) -> PyResult<FluidOptions> {
    let densities = densities.into_iter().map(|density| {
        let source = density.source.map(|source| at_vertices(surface, "source of a density", source));
        Ok(Density {
            name: density.name,
            initial: at_vertices(surface, "density", density.initial)?,
            diffusivity: density.diffusivity,
            weight: density.weight,
            source: source.transpose()?,
        })
    });
    Ok(FluidOptions {
        inflow: inflow.map(|inflow| through_edges(surface, &inflow)).transpose()?,
        densities: densities.collect::<PyResult<_>>()?,
        ..request.options(mesh.inner(), surface).map_err(Raise::raise)?
    })
}

/// A fluid on a surface that is stepped.
#[pyclass(module = "pompeiu._native")]
pub(crate) struct Simulation(Flowing, Py<Mesh>);

impl Simulation {
    fn state(&self) -> &State {
        self.0.borrow_dependent().state()
    }

    fn field(&self, field: &Bound<'_, PyAny>, what: &'static str) -> PyResult<FaceField> {
        let surface = self.0.borrow_owner();
        let vectors = vectors::<3>(field, what, "(m, 3)")?;
        let vectors = FaceData::new(surface.mesh().faces(), vectors).map_err(|error| {
            OperatorError::FieldLength { found: error.found, expected: error.expected }.raise()
        })?;
        Ok(tangent_field(surface, &vectors).0)
    }

    fn in_space<'py>(&self, py: Python<'py>, field: &FaceField) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let surface = self.0.borrow_owner();
        array_of_rows(py, field.entries().map(|(face, &vector)| surface.to_space(face, vector)).collect())
    }
}

#[pymethods]
impl Simulation {
    #[new]
    fn new(
        py: Python<'_>,
        mesh: &Bound<'_, Mesh>,
        options: &str,
        inflow: Option<Vec<(u32, u32, f64)>>,
        densities: Vec<DensityOptions>,
    ) -> PyResult<Self> {
        let request: FluidRequest = request(options)?;
        let mesh = mesh.clone().unbind();
        wait::abandonable(py, move || {
            let surface = EmbeddedSurface::new(mesh.get().inner()).map_err(Raise::raise)?;
            let options = self::options(&request, mesh.get(), &surface, inflow, densities)?;
            Flowing::try_new(surface, |surface| FluidSimulation::new(surface.surface(), options))
                .map(|flowing| Self(flowing, mesh))
                .map_err(Raise::raise)
        })?
    }

    /// Moves on by a step; what is measured, as JSON.
    fn step(&mut self, py: Python<'_>, force: Option<&Bound<'_, PyAny>>) -> PyResult<String> {
        let force = force.map(|force| self.field(force, "vectors of the force")).transpose()?;
        let stepped = self.0.with_dependent_mut(|_, fluid| py.detach(|| fluid.step_with(force.as_ref())));
        written(&stepped.map_err(Raise::raise)?)
    }

    /// What is measured of the flow as it is, as JSON.
    fn measure(&self) -> PyResult<String> {
        written(&self.0.borrow_dependent().measure().map_err(Raise::raise)?)
    }

    /// How the flow is computed, as JSON.
    fn scheme(&self) -> PyResult<String> {
        written(&self.0.borrow_dependent().scheme())
    }

    fn set_velocity(&mut self, field: &Bound<'_, PyAny>) -> PyResult<()> {
        let field = self.field(field, "vectors of the velocity")?;
        self.0.with_dependent_mut(|_, fluid| fluid.set_velocity(&field)).map_err(Raise::raise)
    }

    fn set_vorticity(&mut self, vorticity: &Bound<'_, PyAny>, harmonic: Option<Vec<f64>>) -> PyResult<()> {
        let vorticity = values(vorticity, "vorticity")?;
        let vorticity = at_vertices(self.0.borrow_owner(), "vorticity", vorticity)?;
        let harmonic = harmonic.unwrap_or_else(|| vec![0.0; self.state().harmonic.len()]);
        let set = self.0.with_dependent_mut(|_, fluid| fluid.set_vorticity(&vorticity, &harmonic));
        set.map_err(Raise::raise)
    }

    fn set_density(&mut self, index: usize, density: &Bound<'_, PyAny>) -> PyResult<()> {
        let density = at_vertices(self.0.borrow_owner(), "density", values(density, "density")?)?;
        self.0.with_dependent_mut(|_, fluid| fluid.set_density(index, density)).map_err(Raise::raise)
    }

    /// The state as a checkpoint.
    fn save(&self) -> PyResult<Vec<u8>> {
        let (fluid, mesh) = (self.0.borrow_dependent(), self.1.get().inner());
        let checkpoint = Checkpoint::new(mesh, &fluid.scheme(), fluid.store(), &[]);
        checkpoint.and_then(|checkpoint| checkpoint.to_bytes()).map_err(Raise::raise)
    }

    /// Goes to a state that was saved.
    fn load(&mut self, bytes: &[u8]) -> PyResult<()> {
        let mesh = self.1.get().inner();
        let loaded = self.0.with_dependent_mut(|_, fluid| {
            let checkpoint = Checkpoint::from_bytes(bytes, mesh, &fluid.scheme())?;
            fluid.restore(checkpoint.stored())
        });
        loaded.map_err(Raise::raise)
    }

    #[getter]
    fn steps(&self) -> usize {
        self.state().step
    }

    #[getter]
    fn time(&self) -> f64 {
        self.state().time
    }

    fn velocity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.in_space(py, &self.state().velocity)
    }

    fn vorticity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        array_of(py, self.state().vorticity.to_vec())
    }

    fn stream_function<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        array_of(py, self.state().stream.to_vec())
    }

    fn harmonic<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        array_of(py, self.state().harmonic.clone())
    }

    fn density<'py>(&self, py: Python<'py>, index: usize) -> PyResult<Option<Bound<'py, PyArray1<f64>>>> {
        self.state().densities.get(index).map(|values| array_of(py, values.to_vec())).transpose()
    }

    /// The harmonic fields, orthonormal, in space.
    fn harmonic_fields<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
        self.0.borrow_dependent().harmonic_fields().iter().map(|field| self.in_space(py, field)).collect()
    }
}
