//! A flow that moves on step by step.

use crate::advection::{self, AdvectionError, Unknowns};
use crate::options::{FluidOptions, Integrator, Scheme, TimeStep, Transport};
use crate::report::{FluidStep, FluidTiming, SchemeReport};
use crate::space::{Parts, Space};
use crate::transport::{Backtrace, restore_mass};
use crate::viscosity::{Viscosity, ViscousPower};
use crate::{FluidError, Wall, force};
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_operators::{FaceField, add_scaled, check_field};
use pompeiu_solve::{Cholesky, LinearSolver, SparseMatrix};
use pompeiu_surface::Surface;
use pompeiu_surface::plane::norm;
use std::time::Instant;

/// Substeps of a step at most.
const MOST_SUBSTEPS: usize = 100_000;

/// How often the longest step is halved at most where steps are chosen.
const MOST_HALVINGS: i32 = 40;

/// A fluid on a surface: its velocity, and densities that it carries.
///
/// # Definition
/// Each step adds forces, diffuses, advects and projects the velocity, and adds sources to the densities, diffuses and carries them.
/// See the [crate documentation](crate) for what each of these is.
///
/// # Accuracy
/// First order in the step where there are forces or viscosity (splitting, backward Euler), fourth where there are none, second in
/// the length of edges.
/// # Cost
/// Factoring O(V^1.5) once; each substep eight solves with V unknowns.
#[derive(Debug)]
pub struct Simulation<'s> {
    space: Space<'s>,
    options: FluidOptions,
    backtrace: Option<Backtrace<'s>>,
    power: Option<ViscousPower>,
    viscosity: Option<Viscosity>,
    /// One for each density: diffusivity times step, and the factor.
    heat: Vec<Option<(f64, Cholesky)>>,
    /// Integrals of the velocity of the boundary against hat functions.
    circulation: VertexData<f64>,
    state: State,
    timing: FluidTiming,
}

/// A flow at a time.
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
}

impl<'s> Simulation<'s> {
    /// A fluid at rest.
    ///
    /// # Errors
    /// [`FluidError`]: options that make no sense, or a system that cannot be factored.
    pub fn new(surface: &'s Surface, options: FluidOptions) -> Result<Self, FluidError> {
        let start = Instant::now();
        options.check(surface.mesh())?;
        let space = Space::new(surface)?;
        let vertices = surface.mesh().vertices();
        let circulation = match &options.wall_velocity {
            Some(velocity) => space.along_boundary(|h| {
                let side = surface.vector(h);
                velocity[surface.mesh().edge(h)] * norm(side)
            }),
            None => VertexData::filled(vertices, 0.0),
        };
        let power = (options.viscosity > 0.0)
            .then(|| ViscousPower::new(&space, options.viscosity_model, options.wall, &circulation))
            .transpose()?;
        let traced = options.scheme == Scheme::AnyStep
            || (options.transport != Transport::FluxCorrected && !options.densities.is_empty());
        let state = State {
            step: 0,
            time: 0.0,
            velocity: FaceField::filled(surface.mesh().faces(), [0.0; 2]),
            vorticity: VertexData::filled(vertices, 0.0),
            stream: VertexData::filled(vertices, 0.0),
            harmonic: vec![0.0; space.basis.dimension()],
            densities: options.densities.iter().map(|density| density.initial.clone()).collect(),
        };
        let mut simulation = Self {
            backtrace: traced.then(|| Backtrace::new(surface)),
            heat: options.densities.iter().map(|_| None).collect(),
            space,
            options,
            power,
            viscosity: None,
            circulation,
            state,
            timing: FluidTiming::default(),
        };
        if let TimeStep::Fixed(step) = simulation.options.time_step {
            simulation.factor(step)?;
        }
        simulation.timing.factor = start.elapsed();
        Ok(simulation)
    }

    /// The flow as it is.
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

    /// How long the parts of all steps took.
    pub fn timing(&self) -> FluidTiming {
        self.timing
    }

    /// How the flow is computed.
    pub fn scheme(&self) -> SchemeReport {
        SchemeReport::of(&self.options, self.space.basis.dimension())
    }

    /// Makes the velocity the one without divergence that is nearest to a field.
    ///
    /// # Errors
    /// [`FluidError::Operator`] where there is no finite vector for each face.
    pub fn set_velocity(&mut self, field: &FaceField) -> Result<(), FluidError> {
        check_field(self.space.mesh(), field)?;
        let parts = self.space.project(field)?;
        // What slips along the boundary before viscosity has acted on it is no vorticity.
        let along = self.space.boundary_circulation(&self.space.velocity(&parts.stream, &parts.harmonic));
        self.set_parts(parts, &along)
    }

    /// Makes the velocity that of a vorticity at vertices and of harmonic coefficients.
    ///
    /// On closed surfaces the mean of the vorticity does not count.
    ///
    /// # Errors
    /// [`FluidError`] where there is no finite value for each vertex or harmonic field.
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
        let mut unknowns = Unknowns { vorticity: vorticity.clone(), harmonic: harmonic.to_vec() };
        self.without_mean(&mut unknowns.vorticity);
        self.state.stream = self.space.stream(&unknowns.vorticity)?;
        self.adopt(unknowns)
    }

    /// Replaces a density.
    ///
    /// # Errors
    /// [`FluidError`] where there is no finite value for each vertex, or no such density.
    pub fn set_density(&mut self, index: usize, values: VertexData<f64>) -> Result<(), FluidError> {
        let (what, element, expected) = ("density", "vertex", self.space.mesh().vertices());
        if values.len() != expected {
            return Err(FluidError::Length { what, element, found: values.len(), expected });
        }
        if let Some(at) = values.iter().position(|x| !x.is_finite()) {
            return Err(FluidError::NonFinite { what, element, index: at, value: values.as_slice()[at] });
        }
        let found = self.state.densities.len();
        let Some(place) = self.state.densities.get_mut(index) else {
            return Err(FluidError::Length {
                what: "list of densities",
                element: "density",
                found,
                expected: index + 1,
            });
        };
        *place = values;
        Ok(())
    }

    /// Goes back, or on, to a state of the same surface and options.
    ///
    /// # Errors
    /// [`FluidError`] where its arrays do not fit or are not finite.
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
        Ok(())
    }

    /// Moves on by one step.
    ///
    /// # Errors
    /// [`FluidError`]; the state is then what it was.
    pub fn step(&mut self) -> Result<FluidStep, FluidError> {
        self.step_with(None)
    }

    /// Moves on by one step with an acceleration on faces beside those of the options.
    ///
    /// # Errors
    /// [`FluidError`]; the state is then what it was.
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
        let energy_guarded = self.diffuse(step)?;
        let diffused = Instant::now();
        self.timing.diffuse += diffused - start;
        let cells = self.space.cells(&self.state.velocity);
        let cfl = cells.cfl(step);
        let (unknowns, substeps) = self.advect(step, cfl)?;
        let advected = Instant::now();
        self.timing.advect += advected - diffused;
        self.adopt(unknowns)?;
        self.check_finite(&before)?;
        let projected = Instant::now();
        self.timing.project += projected - advected;
        self.move_densities(&before, step)?;
        let carried = Instant::now();
        self.timing.advect += carried - projected;
        self.state.step += 1;
        self.state.time += step;
        let measured = FluidStep { cfl, substeps, energy_guarded, ..self.measure()? };
        self.timing.project += carried.elapsed();
        Ok(measured)
    }

    /// What is measured of the flow as it is.
    ///
    /// # Errors
    /// None for a simulation that has been made.
    pub fn measure(&self) -> Result<FluidStep, FluidError> {
        let state = &self.state;
        let sum = |values: &VertexData<f64>| values.iter().zip(&self.space.areas).map(|(x, a)| x * a).sum();
        let range = |values: &VertexData<f64>| {
            values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], &x| {
                [if x < least { x } else { least }, if x > most { x } else { most }]
            })
        };
        Ok(FluidStep {
            time: state.time,
            energy: self.space.energy(&state.velocity),
            enstrophy: self.space.enstrophy(&state.vorticity),
            total_vorticity: self.space.integrated(&state.vorticity).iter().sum(),
            divergence: self.space.divergence(&state.velocity)?,
            mass: state.densities.iter().map(sum).collect(),
            range: state.densities.iter().map(range).collect(),
            harmonic: state.harmonic.clone(),
            max_speed: greatest(&state.velocity),
            cfl: 0.0,
            substeps: 0,
            energy_guarded: false,
        })
    }

    /// The length of the next step.
    fn choose_step(&self) -> Result<f64, FluidError> {
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

    /// Makes factors ready for a step of this length.
    fn factor(&mut self, step: f64) -> Result<(), FluidError> {
        if let Some(power) = &self.power {
            let product = self.options.viscosity * step;
            if self.viscosity.as_ref().is_none_or(|ready| ready.product() != product) {
                self.viscosity = Some(Viscosity::new(&self.space, power, product)?);
            }
        }
        for (density, heat) in self.options.densities.iter().zip(&mut self.heat) {
            let product = density.diffusivity * step;
            if product > 0.0 && heat.as_ref().is_none_or(|(ready, _)| *ready != product) {
                let mass = SparseMatrix::diagonal(&self.space.areas)?;
                let matrix = mass.combined(1.0, self.space.poisson.matrix(), product)?;
                *heat = Some((product, Cholesky::new(&matrix)?));
            }
        }
        Ok(())
    }

    /// Adds forces to the velocity.
    fn push(&mut self, pushed: Option<&FaceField>, step: f64) -> Result<(), FluidError> {
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
        let mut unknowns =
            Unknowns { vorticity: self.state.vorticity.clone(), harmonic: self.state.harmonic.clone() };
        for (w, rate) in unknowns.vorticity.iter_mut().zip(&vorticity) {
            *w += step * rate;
        }
        for (c, rate) in unknowns.harmonic.iter_mut().zip(&harmonic) {
            *c += step * rate;
        }
        self.adopt(unknowns)
    }

    /// Viscosity; whether energy would have risen.
    fn diffuse(&mut self, _step: f64) -> Result<bool, FluidError> {
        let Some(viscosity) = &self.viscosity else { return Ok(false) };
        let before = Parts { stream: self.state.stream.clone(), harmonic: self.state.harmonic.clone() };
        let mut parts = viscosity.step(&self.space, &before)?;
        let energy = |parts: &Parts| self.space.energy(&self.space.velocity(&parts.stream, &parts.harmonic));
        let [old, new] = [&before, &parts].map(energy);
        let driven = self.options.wall_velocity.is_some();
        let guarded = new > old && !driven;
        if guarded {
            let factor = (old / new).sqrt();
            parts.stream.iter_mut().chain(&mut parts.harmonic).for_each(|x| *x *= factor);
        }
        let circulation = match self.options.wall {
            Wall::NoSlip => self.circulation.clone(),
            Wall::FreeSlip => {
                self.space.boundary_circulation(&self.space.velocity(&parts.stream, &parts.harmonic))
            }
        };
        self.set_parts(parts, &circulation)?;
        Ok(guarded)
    }

    /// Advection of the velocity.
    fn advect(&self, step: f64, cfl: f64) -> Result<(Unknowns, usize), FluidError> {
        let state = &self.state;
        let unknowns = Unknowns { vorticity: state.vorticity.clone(), harmonic: state.harmonic.clone() };
        let coriolis = self.options.coriolis.as_ref();
        if let (Scheme::AnyStep, Some(backtrace)) = (self.options.scheme, &self.backtrace) {
            return Ok((self.advect_back(backtrace, &unknowns, coriolis, step)?, 1));
        }
        let integrator = self.options.integrator;
        let substeps = self.substeps(integrator, step, cfl)?;
        let advected = advection::advect(&self.space, unknowns, coriolis, integrator, step, substeps);
        let advected = advected.map_err(|error| match error {
            AdvectionError::Midpoint(residual) => FluidError::Midpoint { step: state.step + 1, residual },
            AdvectionError::Other(error) => self.or_blew_up(error),
        })?;
        Ok((advected, substeps))
    }

    fn substeps(&self, integrator: Integrator, step: f64, cfl: f64) -> Result<usize, FluidError> {
        let substeps = (cfl / advection::substep_cfl(integrator)).ceil().max(1.0);
        if substeps <= MOST_SUBSTEPS as f64 {
            return Ok(substeps as usize);
        }
        let (number, most) = (self.state.step + 1, MOST_SUBSTEPS);
        Err(FluidError::StepTooLong { step: number, length: step, cfl, substeps, most })
    }

    /// Semi-Lagrangian advection: once with the velocity as it is, then with the mean of that and what came out.
    fn advect_back(
        &self,
        backtrace: &Backtrace<'_>,
        before: &Unknowns,
        coriolis: Option<&FaceData<f64>>,
        step: f64,
    ) -> Result<Unknowns, FluidError> {
        let rotation = coriolis.map(|f| vertex_means(&self.space, f));
        let absolute = VertexData::from_fn(before.vorticity.len(), |v| {
            before.vorticity[v] + rotation.as_ref().map_or(0.0, |f| f[v])
        });
        let mut velocity = self.state.velocity.clone();
        let mut vorticity = before.vorticity.clone();
        let mut after = before.clone();
        for _ in 0..2 {
            let at_vertices = backtrace.at_vertices(&velocity);
            let places = [-step, step].map(|time| backtrace.follow(&at_vertices, time));
            after.vorticity = backtrace.carry([&places[0], &places[1]], &absolute);
            if let Some(rotation) = &rotation {
                after.vorticity.iter_mut().zip(rotation).for_each(|(w, f)| *w -= f);
            }
            self.without_mean(&mut after.vorticity);
            let rates = advection::rates_at(&self.space, &vorticity, &velocity, coriolis)?;
            for ((c, start), rate) in after.harmonic.iter_mut().zip(&before.harmonic).zip(&rates.harmonic) {
                *c = start + step * rate;
            }
            let stream = self.space.stream(&after.vorticity)?;
            let next = self.space.velocity(&stream, &after.harmonic);
            velocity = mean(&self.state.velocity, &next);
            vorticity =
                VertexData::from_fn(vorticity.len(), |v| 0.5 * (before.vorticity[v] + after.vorticity[v]));
        }
        Ok(after)
    }

    /// Takes the mean off on closed components, where the vorticity of a velocity has none.
    fn without_mean(&self, vorticity: &mut VertexData<f64>) {
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

    /// Sources, diffusion and transport of what the flow carries, with the mean of two velocities.
    fn move_densities(&mut self, before: &FaceField, step: f64) -> Result<(), FluidError> {
        if self.state.densities.is_empty() {
            return Ok(());
        }
        let velocity = mean(before, &self.state.velocity);
        let space = &self.space;
        let cells = space.cells(&velocity);
        let cfl = cells.cfl(step);
        if self.options.transport == Transport::FluxCorrected && cfl > MOST_SUBSTEPS as f64 {
            let (number, most) = (self.state.step + 1, MOST_SUBSTEPS);
            return Err(FluidError::StepTooLong { step: number, length: step, cfl, substeps: cfl, most });
        }
        let traced = self.backtrace.as_ref().filter(|_| self.options.transport != Transport::FluxCorrected);
        let places = traced.map(|backtrace| {
            let at_vertices = backtrace.at_vertices(&velocity);
            (backtrace, [-step, step].map(|time| backtrace.follow(&at_vertices, time)))
        });
        let options = self.options.densities.iter().zip(&self.heat);
        for (values, (density, heat)) in self.state.densities.iter_mut().zip(options) {
            if let Some(source) = &density.source {
                add_source(values, source, step);
            }
            if let Some((_, factor)) = heat {
                values.iter_mut().zip(&space.areas).for_each(|(x, area)| *x *= area);
                factor.solve_in_place(values)?;
            }
            match &places {
                None => cells.carry(values, step),
                Some((backtrace, [from, to])) => {
                    let mut carried = backtrace.carry([from, to], values);
                    if self.options.transport == Transport::SemiLagrangianCorrected {
                        let mass = values.iter().zip(&space.areas).map(|(x, a)| x * a).sum();
                        restore_mass(&space.areas, &mut carried, mass, |v| backtrace.range(from, values, v));
                    }
                    *values = carried;
                }
            }
        }
        Ok(())
    }

    /// Takes over a velocity by its parts.
    fn set_parts(&mut self, parts: Parts, circulation: &VertexData<f64>) -> Result<(), FluidError> {
        self.state.vorticity = self.space.vorticity(&parts, circulation)?;
        self.state.velocity = self.space.velocity(&parts.stream, &parts.harmonic);
        (self.state.stream, self.state.harmonic) = (parts.stream, parts.harmonic);
        Ok(())
    }

    /// Takes over a vorticity with its velocity.
    fn adopt(&mut self, unknowns: Unknowns) -> Result<(), FluidError> {
        self.state.stream = self.space.stream(&unknowns.vorticity).map_err(|error| self.or_blew_up(error))?;
        self.state.velocity = self.space.velocity(&self.state.stream, &unknowns.harmonic);
        (self.state.vorticity, self.state.harmonic) = (unknowns.vorticity, unknowns.harmonic);
        Ok(())
    }

    /// Right-hand sides that are not finite come from velocities that are not.
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

/// What a source adds to values in a step.
pub(crate) fn add_source(values: &mut [f64], source: &[f64], step: f64) {
    for (x, rate) in values.iter_mut().zip(source) {
        let added = *x + step * rate;
        // A sink takes what there is, and no more.
        *x = if *rate < 0.0 && added < 0.0 { if *x < 0.0 { *x } else { 0.0 } } else { added };
    }
}

/// The greatest speed; not a number where one is none.
fn greatest(velocity: &FaceField) -> f64 {
    velocity.iter().map(|&u| norm(u)).fold(0.0, |m, x| if x > m || x.is_nan() { x } else { m })
}

fn mean(a: &FaceField, b: &FaceField) -> FaceField {
    FaceField::from_fn(a.len(), |f| [0, 1].map(|i| 0.5 * (a[f][i] + b[f][i])))
}

/// Values on faces as means around vertices, by area.
fn vertex_means(space: &Space<'_>, values: &FaceData<f64>) -> VertexData<f64> {
    let mut sums = VertexData::filled(space.mesh().vertices(), 0.0);
    for (face, value) in values.entries() {
        let third = space.surface.face_area(face) / 3.0;
        for v in space.mesh().face(face) {
            sums[v] += third * value;
        }
    }
    for (sum, area) in sums.iter_mut().zip(&space.areas) {
        *sum /= area;
    }
    sums
}
