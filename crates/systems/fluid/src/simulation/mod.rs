//! Time stepping of a flow.

mod densities;
mod diffusion;
mod velocity;

pub(crate) use densities::add_source;

use crate::FluidError;
use crate::advection::{Advected, Fields};
use crate::curvature::CurvatureLimit;
use crate::edges::EdgeField;
use crate::options::{FluidOptions, Scheme, TimeStep, Transport};
use crate::report::{FluidStep, FluidTiming, SchemeReport, range};
use crate::space::{Parts, Space};
use crate::transport::Backtrace;
use diffusion::{Heat, Power, Viscous};
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_core::run::Instant;
use pompeiu_operators::{FaceField, check_field};
use pompeiu_surface::Surface;
use pompeiu_surface::plane::norm;

/// Largest number of substeps of a step.
const MOST_SUBSTEPS: usize = 100_000;

/// Largest number of halvings for adaptive steps.
const MOST_HALVINGS: i32 = 40;

/// A fluid on a surface: its velocity and transported densities.
///
/// # Definition
/// Each step adds forces, diffuses, advects and projects the velocity, then adds sources to the densities, diffuses and transports
/// them. The [crate documentation](crate) describes each part.
///
/// # Accuracy
/// First order in the step with forces or viscosity (splitting, backward Euler), fourth order without; second order in the edge
/// length.
/// # Cost
/// One factorization of O(V^1.5); eight solves with V unknowns per substep.
#[derive(Debug)]
pub struct Simulation<'s> {
    space: Space<'s>,
    options: FluidOptions,
    backtrace: Option<Backtrace<'s>>,
    power: Power,
    viscosity: Option<Viscous>,
    /// One for each density.
    heat: Vec<Option<Heat>>,
    /// Integrals of the boundary's velocity against hat functions.
    circulation: VertexData<f64>,
    state: State,
    timing: FluidTiming,
}

/// The state of a flow.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Number of steps so far.
    pub step: usize,
    /// Time so far.
    pub time: f64,
    /// The velocity on faces, in their frames.
    pub velocity: FaceField,
    /// The vorticity at vertices.
    pub vorticity: VertexData<f64>,
    /// The stream function at vertices.
    pub stream: VertexData<f64>,
    /// The coefficients of the harmonic fields.
    pub harmonic: Vec<f64>,
    /// The densities at vertices.
    pub densities: Vec<VertexData<f64>>,
    /// The velocity at midpoints of edges, along the first half-edge and to the left of it, for a viscous flow with
    /// [`Scheme::CrouzeixRaviart`]; otherwise empty.
    pub edge_velocity: EdgeField,
    /// The densities on faces for [`Transport::Faces`]; those at vertices are their means. Otherwise empty.
    pub face_densities: Vec<FaceData<f64>>,
}

impl<'s> Simulation<'s> {
    /// A fluid at rest.
    ///
    /// # Errors
    /// [`FluidError`]: invalid options, or a system that cannot be factored.
    pub fn new(surface: &'s Surface, options: FluidOptions) -> Result<Self, FluidError> {
        let start = Instant::now();
        options.check(surface.mesh())?;
        let space = Space::new(surface, options.inflow.as_ref())?;
        let vertices = surface.mesh().vertices();
        let circulation = match &options.wall_velocity {
            Some(velocity) => space.along_boundary(|h| {
                let side = surface.vector(h);
                velocity[surface.mesh().edge(h)] * norm(side)
            }),
            None => VertexData::filled(vertices, 0.0),
        };
        let power = Power::new(&space, &options, &circulation)?;
        let on_edges = options.viscosity > 0.0 && options.scheme == Scheme::CrouzeixRaviart;
        let edges = if on_edges { surface.mesh().edges() } else { 0 };
        let state = State {
            step: 0,
            time: 0.0,
            velocity: FaceField::filled(surface.mesh().faces(), [0.0; 2]),
            vorticity: VertexData::filled(vertices, 0.0),
            stream: VertexData::filled(vertices, 0.0),
            harmonic: vec![0.0; space.basis.dimension()],
            densities: options.densities.iter().map(|density| density.initial.clone()).collect(),
            edge_velocity: EdgeField::filled(edges, [0.0; 2]),
            face_densities: match options.transport {
                Transport::Faces => options.densities.iter().map(|_| FaceData::filled(0, 0.0)).collect(),
                _ => Vec::new(),
            },
        };
        let mut simulation = Self {
            backtrace: options.traces_back().then(|| Backtrace::new(surface)),
            heat: options.densities.iter().map(|_| None).collect(),
            space,
            options,
            power,
            viscosity: None,
            circulation,
            state,
            timing: FluidTiming::default(),
        };
        for index in 0..simulation.state.densities.len() {
            simulation.take_density(index, simulation.state.densities[index].clone());
        }
        if let TimeStep::Fixed(step) = simulation.options.time_step {
            simulation.factor(step)?;
        }
        simulation.timing.factor = start.elapsed();
        Ok(simulation)
    }

    /// The current state.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The surface.
    pub fn surface(&self) -> &'s Surface {
        self.space.surface
    }

    /// The harmonic fields, orthonormal and tangential at the boundary.
    pub fn harmonic_fields(&self) -> &[FaceField] {
        self.space.basis.fields()
    }

    /// Wall-clock times of the parts of all steps.
    pub fn timing(&self) -> FluidTiming {
        self.timing
    }

    /// The scheme.
    pub fn scheme(&self) -> SchemeReport {
        let limit = self.power.limit();
        let mut report = SchemeReport::of(&self.options, self.space.basis.dimension());
        if limit != CurvatureLimit::NONE {
            report.curvature_limit = Some(limit.defect);
            report.limited_vertices = limit.limited(&self.space);
        }
        report
    }

    /// Sets the velocity to the divergence-free one nearest to a field.
    ///
    /// # Errors
    /// [`FluidError::Operator`] if there is no finite vector for each face.
    pub fn set_velocity(&mut self, field: &FaceField) -> Result<(), FluidError> {
        check_field(self.space.mesh(), field)?;
        let parts = self.space.project(field)?;
        // Slip along the boundary before the first viscous step is not vorticity.
        let velocity = self.space.velocity(&parts.stream, &parts.harmonic);
        let along = self.space.boundary_circulation(&velocity);
        self.set_parts(parts, velocity, &along)?;
        self.take_edges();
        Ok(())
    }

    /// Sets the velocity to that of a vorticity at vertices and harmonic coefficients.
    ///
    /// On closed surfaces the mean of the vorticity is ignored.
    ///
    /// # Errors
    /// [`FluidError`] if there is no finite value for each vertex or harmonic field.
    pub fn set_vorticity(&mut self, vorticity: &VertexData<f64>, harmonic: &[f64]) -> Result<(), FluidError> {
        let expected = self.space.mesh().vertices();
        let (what, element) = ("vorticity", "vertex");
        if vorticity.len() != expected {
            return Err(FluidError::Length { what, element, found: vorticity.len(), expected });
        }
        if let Some(index) = vorticity.iter().position(|x| !x.is_finite()) {
            return Err(FluidError::NonFinite {
                what,
                element,
                index,
                value: vorticity[pompeiu_core::VertexId(index as u32)],
            });
        }
        let expected = self.space.basis.dimension();
        if harmonic.len() != expected {
            return Err(FluidError::Harmonic { found: harmonic.len(), expected });
        }
        let mut vorticity = vorticity.clone();
        self.without_mean(&mut vorticity);
        self.take_vorticity(vorticity, harmonic.to_vec())?;
        self.take_edges();
        Ok(())
    }

    /// Replaces a density.
    ///
    /// # Errors
    /// [`FluidError`] if there is no finite value for each vertex, or no such density.
    pub fn set_density(&mut self, index: usize, values: VertexData<f64>) -> Result<(), FluidError> {
        let (what, element, expected) = ("density", "vertex", self.space.mesh().vertices());
        if values.len() != expected {
            return Err(FluidError::Length { what, element, found: values.len(), expected });
        }
        if let Some(at) = values.iter().position(|x| !x.is_finite()) {
            return Err(FluidError::NonFinite { what, element, index: at, value: values.as_slice()[at] });
        }
        let found = self.state.densities.len();
        if index >= found {
            let (what, element, expected) = ("list of densities", "density", index + 1);
            return Err(FluidError::Length { what, element, found, expected });
        }
        self.take_density(index, values);
        Ok(())
    }

    /// Restores a state of the same surface and options.
    ///
    /// # Errors
    /// [`FluidError`] if its arrays do not fit or are not finite.
    pub fn set_state(&mut self, state: &State) -> Result<(), FluidError> {
        if state.densities.len() != self.options.densities.len() {
            let (found, expected) = (state.densities.len(), self.options.densities.len());
            return Err(FluidError::Length { what: "state", element: "density", found, expected });
        }
        self.set_vorticity(&state.vorticity, &state.harmonic)?;
        for (index, values) in state.densities.iter().enumerate() {
            self.set_density(index, values.clone())?;
        }
        self.state.vorticity.clone_from(&state.vorticity);
        self.state.stream = self.space.stream(&state.vorticity)?;
        self.state.velocity = self.space.velocity(&self.state.stream, &self.state.harmonic);
        (self.state.step, self.state.time) = (state.step, state.time);
        if state.edge_velocity.len() == self.state.edge_velocity.len() {
            self.state.edge_velocity.clone_from(&state.edge_velocity);
        }
        let faces = self.space.mesh().faces();
        if state.face_densities.len() == self.state.face_densities.len()
            && state.face_densities.iter().all(|values| values.len() == faces)
        {
            self.state.face_densities.clone_from(&state.face_densities);
        }
        Ok(())
    }

    /// Advances by one step.
    ///
    /// # Errors
    /// [`FluidError`]; the state is then unchanged.
    pub fn step(&mut self) -> Result<FluidStep, FluidError> {
        self.step_with(None)
    }

    /// Advances by one step with an acceleration on faces in addition to those of the options.
    ///
    /// # Errors
    /// [`FluidError`]; the state is then unchanged.
    pub fn step_with(&mut self, force: Option<&FaceField>) -> Result<FluidStep, FluidError> {
        let before = self.state.clone();
        let stepped = self.try_step(force);
        if stepped.is_err() {
            self.state = before;
        }
        stepped
    }

    fn try_step(&mut self, pushed: Option<&FaceField>) -> Result<FluidStep, FluidError> {
        let start = Instant::now();
        if let Some(field) = pushed {
            check_field(self.space.mesh(), field)?;
        }
        let step = self.choose_step()?;
        self.factor(step)?;
        let before = self.state.velocity.clone();
        self.push(pushed, step)?;
        if self.moves_edges() {
            self.move_edges(&before);
        }
        let energy_guarded = self.diffuse()?;
        let diffused = Instant::now();
        self.timing.diffuse += diffused - start;
        let cells = self.space.cells(&self.state.velocity);
        let cfl = cells.cfl(step);
        let diffused_velocity = self.moves_edges().then(|| self.state.velocity.clone());
        let Advected { harmonic, fields, substeps, passage } = self.advect(step, cfl)?;
        let advected = Instant::now();
        self.timing.advect += advected - diffused;
        self.adopt(harmonic, fields);
        self.check_finite(&before)?;
        if let Some(diffused) = diffused_velocity {
            self.move_edges(&diffused);
        }
        let projected = Instant::now();
        self.timing.project += projected - advected;
        self.move_densities(&before, passage, step)?;
        let carried = Instant::now();
        self.timing.advect += carried - projected;
        self.state.step += 1;
        self.state.time += step;
        let measured = FluidStep { cfl, substeps, energy_guarded, ..self.measure()? };
        self.timing.project += carried.elapsed();
        Ok(measured)
    }

    /// The measured quantities of the current state.
    ///
    /// # Errors
    /// None for a valid simulation.
    pub fn measure(&self) -> Result<FluidStep, FluidError> {
        let state = &self.state;
        let sum = |values: &VertexData<f64>| values.iter().zip(&self.space.areas).map(|(x, a)| x * a).sum();
        Ok(FluidStep {
            time: state.time,
            energy: self.space.energy(&state.velocity),
            enstrophy: self.space.enstrophy(&state.vorticity),
            total_vorticity: self.space.integrated(&state.vorticity).iter().sum(),
            divergence: self.space.divergence(&state.velocity)?,
            mass: state.densities.iter().map(sum).collect(),
            range: state.densities.iter().map(|values| range(values.iter().copied())).collect(),
            harmonic: state.harmonic.clone(),
            max_speed: greatest(&state.velocity),
            cfl: 0.0,
            substeps: 0,
            energy_guarded: false,
        })
    }

    /// Sets the velocity, which has these parts.
    fn set_parts(
        &mut self,
        parts: Parts,
        velocity: FaceField,
        circulation: &VertexData<f64>,
    ) -> Result<(), FluidError> {
        let vorticity = self.space.vorticity(&parts, circulation)?;
        self.adopt(parts.harmonic, Fields { vorticity, stream: parts.stream, velocity });
        Ok(())
    }

    /// Sets the vorticity, and the velocity from it.
    fn take_vorticity(&mut self, vorticity: VertexData<f64>, harmonic: Vec<f64>) -> Result<(), FluidError> {
        let fields = Fields::of_vorticity(&self.space, vorticity, &harmonic);
        self.adopt(harmonic, fields.map_err(|error| self.or_blew_up(error))?);
        Ok(())
    }

    fn adopt(&mut self, harmonic: Vec<f64>, Fields { vorticity, stream, velocity }: Fields) {
        let state = &mut self.state;
        (state.harmonic, state.vorticity, state.stream, state.velocity) =
            (harmonic, vorticity, stream, velocity);
    }

    /// Replaces errors about right-hand sides that are not finite: velocities were the cause.
    fn or_blew_up(&self, error: FluidError) -> FluidError {
        use pompeiu_solve::SolveError::NonFiniteRightHandSide;
        match error {
            FluidError::Solve(NonFiniteRightHandSide { .. }) => {
                FluidError::BlewUp { step: self.state.step + 1, speed: greatest(&self.state.velocity) }
            }
            other => other,
        }
    }

    fn check_finite(&self, before: &FaceField) -> Result<(), FluidError> {
        if greatest(&self.state.velocity).is_finite() {
            Ok(())
        } else {
            Err(FluidError::BlewUp { step: self.state.step + 1, speed: greatest(before) })
        }
    }
}

/// The greatest speed; NaN if one is NaN.
fn greatest(velocity: &FaceField) -> f64 {
    velocity.iter().map(|&u| norm(u)).fold(0.0, |m, x| if x > m || x.is_nan() { x } else { m })
}
