//! Fluids on surfaces.

use crate::arrays::{array_of_rows, values, vectors};
use crate::errors::{Raise, unknown};
use crate::json::written;
use crate::mesh::Mesh;
use crate::wait;
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pompeiu::core::mesh::{FaceData, VertexData};
use pompeiu::fluid::{
    Correction, Density, Diffusion, FluidError, FluidOptions, Integrator, Scheme,
    Simulation as FluidSimulation, State, TimeStep, Transport, ViscosityModel, Wall, coriolis, tangential,
};
use pompeiu::operators::{FaceField, OperatorError, tangent_field};
use pompeiu::surface::{EdgeData, EmbeddedSurface};
use pyo3::prelude::*;
use self_cell::self_cell;

self_cell!(
    /// A surface, and the fluid on it.
    struct Flowing {
        owner: EmbeddedSurface,
        #[covariant]
        dependent: FluidSimulation,
    }
);

/// Options, as the Python half hands them over.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options {
    scheme: String,
    integrator: String,
    correction: String,
    diffusion: String,
    time_step: f64,
    cfl: Option<f64>,
    viscosity: f64,
    viscosity_model: String,
    wall: String,
    transport: String,
    gravity: Option<[f64; 3]>,
    rotation: Option<[f64; 3]>,
    acceleration: Option<[f64; 3]>,
    confinement: f64,
    inflow: Option<Vec<(u32, u32, f64)>>,
    densities: Vec<DensityOptions>,
}

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

/// The choice of a name.
pub(crate) fn choice<T>(
    option: &'static str,
    name: &str,
    parse: impl Fn(&str) -> Option<T>,
    expected: &'static str,
) -> PyResult<T> {
    parse(name).ok_or_else(|| unknown(option, name, expected))
}

fn at_vertices(surface: &EmbeddedSurface, what: &'static str, values: Vec<f64>) -> PyResult<VertexData<f64>> {
    VertexData::new(surface.mesh().vertices(), values).map_err(|error| {
        let (element, found, expected) = ("vertex", error.found, error.expected);
        FluidError::Length { what, element, found, expected }.raise()
    })
}

fn on_faces(surface: &EmbeddedSurface, values: Vec<f64>) -> PyResult<FaceData<f64>> {
    FaceData::new(surface.mesh().faces(), values).map_err(|error| {
        let (what, element, found, expected) = ("density on faces", "face", error.found, error.expected);
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

/// Velocities at midpoints of edges, and densities on faces.
type Stored<'py> = (Bound<'py, PyArray2<f64>>, Vec<Bound<'py, PyArray1<f64>>>);

impl Options {
    fn options(self, surface: &EmbeddedSurface) -> PyResult<FluidOptions> {
        let densities = self.densities.into_iter().map(|density| {
            let source = density.source.map(|source| at_vertices(surface, "source of a density", source));
            Ok(Density {
                name: density.name,
                initial: at_vertices(surface, "density", density.initial)?,
                diffusivity: density.diffusivity,
                weight: density.weight,
                source: source.transpose()?,
            })
        });
        let dt = self.time_step;
        let schemes = "\"vorticity\", \"any-step\", \"faces\" or \"crouzeix-raviart\"";
        let corrections = "\"linear\", \"mac-cormack\" or \"bfecc\"";
        let integrators = "\"runge-kutta\" or \"implicit-midpoint\"";
        let models = "\"hodge\", \"bochner\" or \"physical\"";
        let transports =
            "\"flux-corrected\", \"semi-lagrangian\", \"semi-lagrangian-corrected\" or \"faces\"";
        Ok(FluidOptions {
            scheme: choice("scheme", &self.scheme, Scheme::named, schemes)?,
            correction: choice("correction", &self.correction, Correction::named, corrections)?,
            diffusion: choice(
                "diffusion",
                &self.diffusion,
                Diffusion::named,
                "\"laplacian\" or \"edge-length\"",
            )?,
            integrator: choice("integrator", &self.integrator, Integrator::named, integrators)?,
            time_step: self.cfl.map_or(TimeStep::Fixed(dt), |number| TimeStep::Cfl { number, longest: dt }),
            viscosity: self.viscosity,
            viscosity_model: choice("viscosity_model", &self.viscosity_model, ViscosityModel::named, models)?,
            wall: choice("wall", &self.wall, Wall::named, "\"no-slip\" or \"free-slip\"")?,
            transport: choice("transport", &self.transport, Transport::named, transports)?,
            inflow: self.inflow.map(|inflow| through_edges(surface, &inflow)).transpose()?,
            gravity: self.gravity.map(|gravity| tangential(surface, gravity)),
            coriolis: self.rotation.map(|rotation| coriolis(surface, rotation)),
            force: self.acceleration.map(|acceleration| tangential(surface, acceleration)),
            confinement: self.confinement,
            densities: densities.collect::<PyResult<_>>()?,
            ..FluidOptions::new(dt)
        })
    }
}

/// A fluid on a surface that is stepped.
#[pyclass(module = "pompeiu._native")]
pub(crate) struct Simulation(Flowing);

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
    fn new(py: Python<'_>, mesh: &Bound<'_, Mesh>, options: Options) -> PyResult<Self> {
        let mesh = mesh.clone().unbind();
        wait::abandonable(py, move || {
            let surface = EmbeddedSurface::new(mesh.get().inner()).map_err(Raise::raise)?;
            let options = options.options(&surface)?;
            Flowing::try_new(surface, |surface| FluidSimulation::new(surface.surface(), options))
                .map(Self)
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

    /// Goes to a state that was saved.
    fn restore(
        &mut self,
        at: (usize, f64),
        vorticity: &Bound<'_, PyAny>,
        harmonic: Vec<f64>,
        densities: Vec<Bound<'_, PyAny>>,
        edge_velocity: Vec<[f64; 2]>,
        face_densities: Vec<Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let surface = self.0.borrow_owner();
        let vorticity = at_vertices(surface, "vorticity", values(vorticity, "vorticity")?)?;
        let densities = densities
            .into_iter()
            .map(|density| at_vertices(surface, "density", values(&density, "density")?))
            .collect::<PyResult<_>>()?;
        let (step, time) = at;
        let now = self.state();
        let edge_velocity = EdgeData::new(now.edge_velocity.len(), edge_velocity).map_err(|error| {
            let (what, element) = ("velocity at edges", "edge");
            FluidError::Length { what, element, found: error.found, expected: error.expected }.raise()
        })?;
        let face_densities = face_densities
            .into_iter()
            .map(|density| on_faces(surface, values(&density, "density on faces")?))
            .collect::<PyResult<_>>()?;
        let state = State {
            step,
            time,
            vorticity,
            harmonic,
            densities,
            edge_velocity,
            face_densities,
            ..now.clone()
        };
        self.0.with_dependent_mut(|_, fluid| fluid.set_state(&state)).map_err(Raise::raise)
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

    fn vorticity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.state().vorticity.to_vec().into_pyarray(py)
    }

    fn stream_function<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.state().stream.to_vec().into_pyarray(py)
    }

    fn harmonic<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.state().harmonic.clone().into_pyarray(py)
    }

    fn density<'py>(&self, py: Python<'py>, index: usize) -> Option<Bound<'py, PyArray1<f64>>> {
        self.state().densities.get(index).map(|values| values.to_vec().into_pyarray(py))
    }

    /// What a saved state needs beside the arrays above: velocities at midpoints of edges, densities on faces.
    fn stored<'py>(&self, py: Python<'py>) -> PyResult<Stored<'py>> {
        let state = self.state();
        let edges = array_of_rows(py, state.edge_velocity.to_vec())?;
        let faces = state.face_densities.iter().map(|values| values.to_vec().into_pyarray(py));
        Ok((edges, faces.collect()))
    }

    /// The harmonic fields, orthonormal, in space.
    fn harmonic_fields<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
        self.0.borrow_dependent().harmonic_fields().iter().map(|field| self.in_space(py, field)).collect()
    }
}
