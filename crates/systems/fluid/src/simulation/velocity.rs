//! Advancing the velocity: forces, viscosity, advection.

use super::diffusion::{Power, Viscous};
use super::{MOST_HALVINGS, MOST_SUBSTEPS, Simulation, State};
use crate::advection::{self, Advected, AdvectionError, Fields};
use crate::edges::{self, EdgeViscosity};
use crate::faces::FaceDiffusion;
use crate::space::Parts;
use crate::transport::Backtrace;
use crate::viscosity::Viscosity;
use crate::{Correction, FluidError, Integrator, Scheme, TimeStep, Wall, force};
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_operators::{FaceField, add_scaled};
use pompeiu_surface::plane::{add, rotate, scale, sub};

impl Simulation<'_> {
    /// The length of the next step.
    pub(super) fn choose_step(&self) -> Result<f64, FluidError> {
        let (number, longest) = match self.options.time_step {
            TimeStep::Fixed(step) => return Ok(step),
            TimeStep::Cfl { number, longest } => (number, longest),
        };
        let rate = self.space.cells(&self.state.velocity).cfl(1.0);
        // Powers of two, so that few steps need new factors.
        (0..=MOST_HALVINGS).map(|k| longest * 0.5_f64.powi(k)).find(|step| step * rate <= number).ok_or(
            FluidError::StepTooShort {
                step: self.state.step + 1,
                shortest: longest * 0.5_f64.powi(MOST_HALVINGS),
            },
        )
    }

    /// Prepares factors for a step of this length.
    pub(super) fn factor(&mut self, step: f64) -> Result<(), FluidError> {
        let (options, space) = (&self.options, &self.space);
        let product = options.viscosity * step;
        if product > 0.0 && self.viscosity.as_ref().is_none_or(|ready| ready.product() != product) {
            let pressure = match self.viscosity.take() {
                Some(Viscous::Edges(edges)) => Some(edges.into_pressure()),
                _ => None,
            };
            self.viscosity = Some(match &self.power {
                Power::Stream(power) => Viscous::Stream(Viscosity::new(space, power, product)?),
                Power::Edges(terms) => {
                    let wall = options.wall_velocity.as_ref();
                    Viscous::Edges(EdgeViscosity::new(space, *terms, wall, product, pressure)?)
                }
                Power::Faces => {
                    Viscous::Faces(FaceDiffusion::of_vectors(space.surface, options.diffusion, product)?)
                }
            });
        }
        self.factor_densities(step)
    }

    /// Adds forces to the velocity.
    pub(super) fn push(&mut self, pushed: Option<&FaceField>, step: f64) -> Result<(), FluidError> {
        let options = &self.options;
        let weighs = options.gravity.is_some() && options.densities.iter().any(|d| d.weight != 0.0);
        if pushed.is_none() && options.force.is_none() && !weighs && options.confinement == 0.0 {
            return Ok(());
        }
        let mut force = FaceField::filled(self.space.mesh().faces(), [0.0; 2]);
        for field in [pushed, options.force.as_ref()].into_iter().flatten() {
            add_scaled(&mut force, 1.0, field);
        }
        if let Some(gravity) = &options.gravity {
            let densities = options.densities.iter().map(|d| d.weight).zip(&self.state.densities);
            force::weight(&self.space, gravity, densities, &mut force);
        }
        if options.confinement > 0.0 {
            force::confine(&self.space, options.confinement, &self.state.vorticity, &mut force);
        }
        let (mut vorticity, harmonic) = self.space.curl_of_force(&force)?;
        self.space.solve_mass(&mut vorticity)?;
        for (w, before) in vorticity.iter_mut().zip(&self.state.vorticity) {
            *w = before + step * *w;
        }
        let harmonic = self.state.harmonic.iter().zip(&harmonic).map(|(c, rate)| c + step * rate).collect();
        self.take_vorticity(vorticity, harmonic)
    }

    /// Applies viscosity; returns whether the energy had to be limited.
    pub(super) fn diffuse(&mut self) -> Result<bool, FluidError> {
        let Some(viscosity) = &self.viscosity else { return Ok(false) };
        let before = Parts { stream: self.state.stream.clone(), harmonic: self.state.harmonic.clone() };
        let mut edges = None;
        let mut parts = match viscosity {
            Viscous::Stream(viscosity) => viscosity.step(&self.space, &before)?,
            Viscous::Edges(viscosity) => {
                let after = viscosity.step(&self.space, &self.state.edge_velocity)?;
                let parts = self.space.project(&edges::on_faces(&self.space, &after))?;
                edges = Some(after);
                parts
            }
            Viscous::Faces(viscosity) => {
                self.space.project(&viscosity.vectors(self.space.surface, &self.state.velocity)?)?
            }
        };
        let driven = self.options.wall_velocity.is_some() || self.options.inflow.is_some();
        let old = self.space.energy(&self.state.velocity);
        let mut velocity = self.space.velocity(&parts.stream, &parts.harmonic);
        let new = self.space.energy(&velocity);
        let guarded = new > old && !driven;
        if guarded {
            let factor = (old / new).sqrt();
            parts.stream.iter_mut().chain(&mut parts.harmonic).for_each(|x| *x *= factor);
            velocity = self.space.velocity(&parts.stream, &parts.harmonic);
            edges.iter_mut().flatten().for_each(|u| *u = scale(factor, *u));
        }
        let circulation = match self.options.wall {
            Wall::NoSlip => self.circulation.clone(),
            Wall::FreeSlip => self.space.boundary_circulation(&velocity),
        };
        self.set_parts(parts, velocity, &circulation)?;
        if let Some(edges) = edges {
            self.state.edge_velocity = edges;
        }
        Ok(guarded)
    }

    /// Adds the change of the velocity on faces to the velocity at midpoints of edges.
    pub(super) fn move_edges(&mut self, before: &FaceField) {
        let change = pompeiu_operators::difference(&self.state.velocity, before);
        let change = edges::at_edges(&self.space, &change);
        for (u, change) in self.state.edge_velocity.iter_mut().zip(&change) {
            *u = add(*u, *change);
        }
    }

    /// Whether velocities at midpoints of edges are stored.
    pub(super) fn moves_edges(&self) -> bool {
        !self.state.edge_velocity.is_empty()
    }

    /// Sets the velocity at midpoints of edges from that on faces.
    pub(super) fn take_edges(&mut self) {
        if self.moves_edges() {
            self.state.edge_velocity = edges::at_edges(&self.space, &self.state.velocity);
        }
    }

    /// Advection of the velocity.
    pub(super) fn advect(&self, step: f64, cfl: f64) -> Result<Advected, FluidError> {
        let state = &self.state;
        let coriolis = self.options.coriolis.as_ref();
        match (self.options.scheme, &self.backtrace) {
            (Scheme::AnyStep, Some(back)) => return self.advect_back(back, coriolis, step),
            (Scheme::Faces, Some(back)) => return self.advect_faces(back, coriolis, step),
            _ => {}
        }
        let fields = Fields {
            vorticity: state.vorticity.clone(),
            stream: state.stream.clone(),
            velocity: state.velocity.clone(),
        };
        let integrator = self.options.integrator;
        let substeps = self.substeps(integrator, step, cfl)?;
        let start = (state.harmonic.clone(), fields);
        let advected = advection::advect(&self.space, start, coriolis, integrator, step, substeps);
        let (harmonic, fields) = advected.map_err(|error| match error {
            AdvectionError::Midpoint(residual) => FluidError::Midpoint { step: state.step + 1, residual },
            AdvectionError::Other(error) => self.or_blew_up(error),
        })?;
        Ok(Advected { harmonic, fields, substeps, passage: None })
    }

    fn substeps(&self, integrator: Integrator, step: f64, cfl: f64) -> Result<usize, FluidError> {
        let substeps = (cfl / advection::substep_cfl(integrator)).ceil().max(1.0);
        if substeps <= MOST_SUBSTEPS as f64 {
            return Ok(substeps as usize);
        }
        let (number, most) = (self.state.step + 1, MOST_SUBSTEPS);
        Err(FluidError::StepTooLong { step: number, length: step, cfl, substeps, most })
    }

    /// Semi-Lagrangian advection of the vorticity: once with the current velocity, then with the mean of that and the result.
    fn advect_back(
        &self,
        backtrace: &Backtrace<'_>,
        coriolis: Option<&FaceData<f64>>,
        step: f64,
    ) -> Result<Advected, FluidError> {
        let State { vorticity: before, harmonic: start, velocity, .. } = &self.state;
        let rotation = coriolis.map(|f| backtrace.vertex_means(f));
        let absolute =
            VertexData::from_fn(before.len(), |v| before[v] + rotation.as_ref().map_or(0.0, |f| f[v]));
        // Where the vorticity goes with a velocity, and the harmonic coefficients at the rates of a vorticity and a velocity.
        let moved = |at: &VertexData<f64>, along: &FaceField, correction| {
            let passage = backtrace.passage(&backtrace.at_vertices(along), step, correction);
            let mut vorticity = backtrace.carry(&passage, &absolute);
            if let Some(rotation) = &rotation {
                vorticity.iter_mut().zip(rotation).for_each(|(w, f)| *w -= f);
            }
            self.without_mean(&mut vorticity);
            let rates = advection::harmonic_rates(&self.space, at, along, coriolis);
            let harmonic: Vec<f64> = start.iter().zip(rates).map(|(c, rate)| c + step * rate).collect();
            let fields = Fields::of_vorticity(&self.space, vorticity, &harmonic);
            let fields = fields.map_err(|error| self.or_blew_up(error))?;
            Ok::<_, FluidError>(Advected { harmonic, fields, substeps: 1, passage: Some(passage) })
        };
        // The first result only gives the velocity halfway, which the second one starts from.
        let guess = moved(before, velocity, Correction::Linear)?.fields;
        let middle = VertexData::from_fn(before.len(), |v| 0.5 * (before[v] + guess.vorticity[v]));
        moved(&middle, &mean(velocity, &guess.velocity), self.options.correction)
    }

    /// Semi-Lagrangian advection of the velocity on faces, and the subsequent projection.
    ///
    /// A projection at the end of a step loses energy in proportion to the step. With a correction, the velocity is also projected
    /// halfway, and the part removed there is subtracted once more before the second half (advection–reflection).
    fn advect_faces(
        &self,
        backtrace: &Backtrace<'_>,
        coriolis: Option<&FaceData<f64>>,
        step: f64,
    ) -> Result<Advected, FluidError> {
        let project = |field: &FaceField| self.space.project(field).map_err(|error| self.or_blew_up(error));
        let velocity = &self.state.velocity;
        let parts = if self.options.correction == Correction::Linear {
            project(&self.carry(backtrace, velocity, velocity, coriolis, step))?
        } else {
            let half = self.carry(backtrace, velocity, velocity, coriolis, 0.5 * step);
            let parts = project(&half)?;
            let middle = self.space.velocity(&parts.stream, &parts.harmonic);
            let reflected = FaceField::from_fn(half.len(), |f| sub(scale(2.0, middle[f]), half[f]));
            project(&self.carry(backtrace, &middle, &reflected, coriolis, 0.5 * step))?
        };
        let velocity = self.space.velocity(&parts.stream, &parts.harmonic);
        let vorticity = self.space.vorticity(&parts, &self.space.boundary_circulation(&velocity))?;
        let fields = Fields::of_vorticity(&self.space, vorticity, &parts.harmonic);
        let fields = fields.map_err(|error| self.or_blew_up(error))?;
        Ok(Advected { harmonic: parts.harmonic, fields, substeps: 1, passage: None })
    }

    /// A field on faces transported with a velocity, and rotated by the rotation of the surface.
    fn carry(
        &self,
        backtrace: &Backtrace<'_>,
        velocity: &FaceField,
        field: &FaceField,
        coriolis: Option<&FaceData<f64>>,
        time: f64,
    ) -> FaceField {
        let passage = backtrace.passage_of_centroids(velocity, time, self.options.correction);
        let mut carried = backtrace.carry_vectors(&passage, field);
        for (u, f) in carried.iter_mut().zip(coriolis.into_iter().flatten()) {
            *u = rotate([libm::cos(time * f), -libm::sin(time * f)], *u);
        }
        carried
    }

    /// Subtracts the mean on closed components, where the vorticity of a velocity has mean zero.
    pub(super) fn without_mean(&self, vorticity: &mut VertexData<f64>) {
        let mesh = self.space.mesh();
        let open = mesh.boundary_loops_of_components();
        let mut sums = vec![(0.0, 0.0); mesh.components()];
        for v in mesh.vertex_ids() {
            let (sum, area) = &mut sums[mesh.component(v)];
            *sum += self.space.areas[v] * vorticity[v];
            *area += self.space.areas[v];
        }
        for v in mesh.vertex_ids() {
            let component = mesh.component(v);
            if open[component] == 0 {
                vorticity[v] -= sums[component].0 / sums[component].1;
            }
        }
    }
}

pub(super) fn mean(a: &FaceField, b: &FaceField) -> FaceField {
    FaceField::from_fn(a.len(), |f| [0, 1].map(|i| 0.5 * (a[f][i] + b[f][i])))
}
