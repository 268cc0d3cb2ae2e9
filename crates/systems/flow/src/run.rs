//! A flow from its start to its end.

mod steps;

use super::existence::{Cone, separating_cone};
use super::gradient::Derivatives;
use super::moving::{Motion, MovingSurface, mean_edge};
use super::observer::FlowStep;
use super::options::{BoundaryCondition, FlowOptions, Until};
use super::pinch::{Neck, neck, would_show};
use super::report::{Change, Flow, FlowRecord, FlowStop, FlowTiming, StepReason};
use super::scheme::Scheme;
use super::step::{FirstMetric, FullSystem};
use super::systems::{Systems, prepared};
use super::time::TimeStep;
use super::{FlowError, discs, stability};
use glam::{DMat3, DVec3};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::run::Instant;
use pompeiu_core::run::{Control, StopReason, on_threads};
use pompeiu_remesh::DynamicMesh;
use pompeiu_solve::SolveError;
use std::ops::ControlFlow;

/// Steps to a stationary surface at most.
const MOST_STEPS: usize = 20_000;
/// Newton steps between two improvements of the triangles, and how often that is done.
const NEWTON_STEPS: usize = 3;
const IMPROVEMENTS: usize = 2;
/// Moves of vertices within the surface at each improvement.
const RELAXATIONS: usize = 3;
/// Triangles are improved on the way to a stationary surface if the least angle is below this one, in degrees.
const GOOD_ANGLE: f64 = 25.0;
/// Least volume that can be kept, as a part of the area to the power 3/2.
const LEAST_VOLUME: f64 = 1e-9;
/// Angles have decayed where the least is below this one, in degrees, and below half of that of the surface given.
const DECAYED_ANGLE: f64 = 5.0;
/// Steps between two remeshings because angles decayed.
const STEPS_BETWEEN: usize = 5;
/// A surface whose least angle is below this one, in degrees, and below half of that of the surface given, is degenerate.
const DEGENERATE_ANGLE: f64 = 0.1;
/// Over so many steps the area falls by this part, or the gradient below this part of what it was, or the flow has stalled.
const STALLED_STEPS: usize = 100;
const STALLED_AREA: f64 = 1e-5;
const STALLED_GRADIENT: f64 = 0.9;
/// Necks are looked for whenever vertices may have moved by this many mean edges.
const EDGES_BETWEEN_CHECKS: f64 = 0.1;
/// A surface whose area is below this part of the area at first has vanished.
const VANISHED: f64 = 1e-6;

/// Moves a surface so that its area falls.
///
/// # Definition
/// The area A of the triangles is a function of the vertex positions X, with gradient `g = L X`. Mean curvature flow is `M X' = −g`, with M
/// the areas of vertices. A stationary surface has `g · n = 0` at each vertex that may move: it is minimal.
/// # Errors
/// [`FlowError`]: the mesh must be an oriented manifold whose faces have an area.
/// # Cost
/// A factorization of a sparse matrix at each step of most schemes.
/// # Source
/// `pinkall_computing_1993`, `desbrun_implicit_1999`, `kazhdan_can_2012`; Hessian and normal Newton steps: [`Scheme::NormalNewton`].
/// # Limits
/// Stationarity is that of the discrete area along vertex normals; a discrete area has no minimum in tangential directions that
/// could be used: they are reported, not made zero.
pub fn mean_curvature_flow(mesh: &TriMesh, options: &FlowOptions<'_>) -> Result<Flow, FlowError> {
    options.check()?;
    on_threads(options.limits.threads, || Runner::new(mesh, options)?.run())
}

/// What a step did.
struct Done {
    to: Vec<DVec3>,
    time: Option<f64>,
    scheme: Scheme,
    reason: StepReason,
}

/// What may happen instead of a step.
enum Outcome {
    Moved(Done),
    Stalled,
}

/// A flow on its way.
struct Runner<'r> {
    input: &'r TriMesh,
    options: &'r FlowOptions<'r>,
    scheme: Scheme,
    control: Control,
    /// Turns the input so that the planes of the boundary are orthogonal to z.
    turn: DMat3,
    surface: MovingSurface,
    systems: Option<Systems>,
    full: Option<FullSystem>,
    first: FirstMetric,
    initial: (f64, f64),
    initial_angle: f64,
    /// The step after which the surface was remeshed last because angles had decayed, and whether that helped.
    remeshed: (usize, bool),
    time: Option<f64>,
    time_step: TimeStep,
    history: Vec<FlowRecord>,
    cone: Option<Cone>,
    /// Whether necks are looked for: not if the scheme has none, or the mesh was too coarse or too uneven for that at the start.
    watch_necks: bool,
    /// How far vertices may have moved since then.
    way: f64,
    smoothings: usize,
    improvements: usize,
    newton_steps: usize,
    blended: usize,
    timing: FlowTiming,
}

impl<'r> Runner<'r> {
    fn new(mesh: &'r TriMesh, options: &'r FlowOptions<'r>) -> Result<Self, FlowError> {
        let turn = match options.boundary {
            BoundaryCondition::Fixed => DMat3::IDENTITY,
            BoundaryCondition::Planes(normal) => {
                let z = DVec3::from_array(normal).normalize();
                let (x, y) = z.any_orthonormal_pair();
                DMat3::from_cols(x, y, z).transpose()
            }
        };
        let mut dynamic = DynamicMesh::new(mesh.positions(), mesh.faces())?;
        dynamic.map_positions(|p| (turn * DVec3::from_array(p)).to_array());
        let surface = MovingSurface::new(dynamic, options.boundary);
        let triangles = surface.triangles();
        let flat = |t: &&super::triangle::Triangle| t.normal == DVec3::ZERO;
        if let Some(face) = triangles.iter().position(|t| flat(&t)) {
            let count = triangles.iter().filter(flat).count();
            return Err(FlowError::NoArea { face: face as u32, count });
        }
        if surface.motion.iter().all(|motion| *motion == Motion::Fixed) {
            return Err(FlowError::NothingMoves);
        }
        if matches!(options.until, Until::Stationary(_))
            && !options.keep_volume
            && let Some(vertex) = surface.mesh.closed_component()
        {
            return Err(FlowError::NeverStationary { vertex });
        }
        let masses = surface.masses(&triangles);
        let (area, volume) = (surface.area(), surface.volume());
        if options.keep_volume && volume.abs() <= LEAST_VOLUME * area.powf(1.5) {
            return Err(FlowError::NoVolume { volume });
        }
        let cone = match &surface.boundary_loops()[..] {
            [first, second] if options.boundary == BoundaryCondition::Fixed => {
                separating_cone([first, second])
            }
            _ => None,
        };
        let scheme = options.scheme();
        // With the stiffness of the first surface triangles stay alike, and necks do not pinch.
        let watch_necks = !scheme.keeps_first_metric() && would_show(&surface, mean_edge(&triangles));
        Ok(Self {
            input: mesh,
            options,
            scheme,
            control: Control::start(&options.limits),
            turn,
            systems: None,
            full: None,
            first: FirstMetric { triangles, masses },
            initial: (area, volume),
            initial_angle: surface.least_angle(),
            remeshed: (0, options.keep_angles && options.remesh.is_none() && !scheme.keeps_first_metric()),
            time: Some(0.0),
            time_step: TimeStep::new(options, &surface, area),
            history: Vec::new(),
            cone,
            watch_necks,
            way: 0.0,
            smoothings: 0,
            improvements: 0,
            newton_steps: 0,
            blended: 0,
            timing: FlowTiming::default(),
            surface,
        })
    }

    fn run(mut self) -> Result<Flow, FlowError> {
        let mut derivatives = Derivatives::of(&self.surface, self.options.keep_volume);
        let mut stop = self.record(&derivatives, self.scheme, StepReason::Start).err();
        let mut steps = 0;
        let mut found_neck = None;
        while stop.is_none() {
            stop = self.end(&derivatives, steps, &mut found_neck);
            if stop.is_some() {
                break;
            }
            let started = Instant::now();
            let Done { to, time, scheme, reason } = match self.step(&derivatives) {
                Ok(Outcome::Moved(done)) => done,
                Ok(Outcome::Stalled) => {
                    stop = Some(FlowStop::Stalled);
                    break;
                }
                // The cotangents of triangles that are too thin leave no digit of the masses.
                Err(FlowError::Solve(SolveError::NotPositiveDefinite { .. })) => {
                    stop = Some(FlowStop::Degenerate);
                    break;
                }
                Err(error) => return Err(error),
            };
            self.way += self.longest_move(&to);
            self.surface.mesh.positions_mut().copy_from_slice(&to);
            self.time = self.time.zip(time).map(|(from, by)| from + by);
            steps += 1;
            self.timing.steps += started.elapsed();
            derivatives = Derivatives::of(&self.surface, self.options.keep_volume);
            stop = self.record(&derivatives, scheme, reason).err();
            if let Some(reason) = self.remesh(steps, scheme, reason)? {
                derivatives = Derivatives::of(&self.surface, self.options.keep_volume);
                stop = stop.or(self.record(&derivatives, scheme, reason).err());
            }
        }
        self.finish(&derivatives, stop.unwrap_or(FlowStop::Stalled), steps, found_neck)
    }

    /// Whether the flow ends here.
    fn end(&mut self, derivatives: &Derivatives, steps: usize, found: &mut Option<Neck>) -> Option<FlowStop> {
        let stop = match self.options.until {
            Until::Stationary(tolerance) => {
                let small = derivatives.norm.normal <= tolerance * derivatives.area.sqrt();
                if small {
                    Some(FlowStop::Stationary)
                } else {
                    (steps >= MOST_STEPS || self.hardly_falls()).then_some(FlowStop::Stalled)
                }
            }
            Until::Time(time) => self.time.is_some_and(|t| t >= time).then_some(FlowStop::Time),
            Until::Steps(count) => (steps >= count).then_some(FlowStop::Steps),
        };
        if stop.is_some() {
            return stop;
        }
        if self.control.is_stopped() {
            let cancelled = self.control.reason() == Some(StopReason::Cancelled);
            return Some(if cancelled { FlowStop::Cancelled } else { FlowStop::Limit });
        }
        if derivatives.area <= VANISHED * self.initial.0 {
            return Some(FlowStop::Pinched);
        }
        if !self.scheme.keeps_first_metric() && self.has_decayed(DEGENERATE_ANGLE) {
            return Some(FlowStop::Degenerate);
        }
        let edge = mean_edge(&derivatives.triangles);
        if self.watch_necks && self.way > EDGES_BETWEEN_CHECKS * edge {
            let started = Instant::now();
            self.way = 0.0;
            *found = neck(&self.surface, edge);
            self.timing.verdict += started.elapsed();
        }
        found.map(|_| FlowStop::Pinched)
    }

    /// Whether the least angle is below this one, and half of what it was at first.
    fn has_decayed(&self, below: f64) -> bool {
        let least = self.surface.least_angle();
        least < below && least < 0.5 * self.initial_angle
    }

    /// Whether many steps to a stationary surface led nowhere.
    fn hardly_falls(&self) -> bool {
        let Some(last) = self.history.last() else { return false };
        let Some(before) = self.history.len().checked_sub(1 + STALLED_STEPS) else { return false };
        let least = |records: &[FlowRecord]| {
            records
                .iter()
                .fold(f64::INFINITY, |m, r| if r.gradient.normal < m { r.gradient.normal } else { m })
        };
        let (early, late) = self.history.split_at(before + 1);
        early[before].area - last.area < STALLED_AREA * last.area
            && least(late) > STALLED_GRADIENT * least(early)
    }

    /// The place that keeps a flow from its end.
    fn place(&self, derivatives: &Derivatives, stop: FlowStop) -> Option<[f64; 3]> {
        let position = match stop {
            FlowStop::Stalled => {
                let along = |v: usize| derivatives.gradient[v].dot(derivatives.directions[v]).abs();
                let worst = (0..derivatives.gradient.len()).max_by(|v, w| along(*v).total_cmp(&along(*w)))?;
                self.surface.positions()[worst]
            }
            FlowStop::Degenerate => self.surface.thinnest()?,
            _ => return None,
        };
        Some(self.turn_back(position))
    }

    /// Notes the surface, and shows it to the observer.
    fn record(
        &mut self,
        derivatives: &Derivatives,
        scheme: Scheme,
        reason: StepReason,
    ) -> Result<(), FlowStop> {
        let record = FlowRecord {
            time: self.time,
            area: derivatives.area,
            gradient: derivatives.norm,
            scheme,
            reason,
        };
        self.history.push(record);
        let Some(observer) = self.options.observer else { return Ok(()) };
        let positions: Vec<[f64; 3]> = self.surface.positions().iter().map(|p| self.turn_back(*p)).collect();
        let share = match self.options.until {
            Until::Time(time) => self.time.map(|t| t / time),
            Until::Steps(count) => Some((self.history.len() - 1) as f64 / count as f64),
            Until::Stationary(_) => None,
        };
        let step = FlowStep {
            step: self.history.len() - 1,
            record: &record,
            positions: &positions,
            faces: self.surface.faces(),
            share,
        };
        match observer.step(&step) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(FlowStop::Cancelled),
        }
    }

    /// A position in the frame of the input, with the same bits where nothing was turned.
    fn turn_back(&self, p: DVec3) -> [f64; 3] {
        let back = if self.turn == DMat3::IDENTITY { p } else { self.turn.transpose() * p };
        back.to_array()
    }

    /// The time that is left, where the flow ends at a time.
    fn time_left(&self) -> f64 {
        match self.options.until {
            Until::Time(end) => self.time.map_or(f64::INFINITY, |t| end - t),
            _ => f64::INFINITY,
        }
    }

    /// How far the vertex moves that moves farthest.
    fn longest_move(&self, to: &[DVec3]) -> f64 {
        let way = self.surface.positions().iter().zip(to).map(|(p, q)| p.distance_squared(*q));
        way.fold(0.0, |x, y| if y > x { y } else { x }).sqrt()
    }

    /// Remeshes or improves the triangles where it is time to.
    fn remesh(
        &mut self,
        steps: usize,
        scheme: Scheme,
        reason: StepReason,
    ) -> Result<Option<StepReason>, FlowError> {
        let started = Instant::now();
        let asked = self.options.remesh.filter(|r| steps.is_multiple_of(r.every.get()));
        let may_improve = scheme == Scheme::NormalNewton
            && self.improvements < IMPROVEMENTS
            && self.newton_steps.is_multiple_of(NEWTON_STEPS)
            || self.options.keep_volume;
        let improves = self.options.improve
            && (reason == StepReason::Smoothing || may_improve && self.surface.least_angle() < GOOD_ANGLE);
        let fixed = self.options.boundary == BoundaryCondition::Fixed;
        let decayed =
            self.remeshed.1 && steps >= self.remeshed.0 + STEPS_BETWEEN && self.has_decayed(DECAYED_ANGLE);
        if decayed {
            let before = self.surface.least_angle();
            let mesh = self.surface.mesh.remeshed(mean_edge(&self.surface.triangles()), fixed)?;
            self.replace(mesh, started);
            self.remeshed = (steps, self.surface.least_angle() > before);
            return Ok(Some(StepReason::Remeshed));
        }
        let mesh = if let Some(remeshing) = asked {
            self.surface.mesh.remeshed(remeshing.edge_length, fixed)?
        } else if improves {
            self.improvements += usize::from(reason != StepReason::Smoothing);
            self.surface.mesh.improved(RELAXATIONS, fixed)
        } else {
            return Ok(None);
        };
        self.replace(mesh, started);
        Ok(Some(if asked.is_some() { StepReason::Remeshed } else { StepReason::Improved }))
    }

    /// Goes on with other triangles.
    fn replace(&mut self, mesh: DynamicMesh, started: Instant) {
        self.surface = MovingSurface::new(mesh, self.options.boundary);
        (self.systems, self.full) = (None, None);
        self.timing.remesh += started.elapsed();
    }

    fn finish(
        mut self,
        derivatives: &Derivatives,
        stop: FlowStop,
        steps: usize,
        neck: Option<Neck>,
    ) -> Result<Flow, FlowError> {
        let started = Instant::now();
        let stability = if self.options.stability && stop == FlowStop::Stationary && !self.options.keep_volume
        {
            let systems = prepared(&mut self.systems, || Systems::new(&self.surface))?;
            stability::least_eigenvalue(&self.surface, derivatives, systems)?
        } else {
            None
        };
        let loops = self.surface.boundary_loops();
        let discs = match &loops[..] {
            [first, second] if self.options.boundary == BoundaryCondition::Fixed => {
                Some(discs::compare([first, second], derivatives.area))
            }
            _ => None,
        };
        let place = self.place(derivatives, stop);
        let back = |p: [f64; 3]| self.turn_back(DVec3::from_array(p));
        let neck = neck.map(|neck| Neck { position: back(neck.position), ..neck });
        let mut mesh = self.surface.mesh.clone();
        mesh.map_positions(back);
        let mut mesh = mesh.to_mesh()?;
        let grid = self.options.coordinates.within(&Aabb::of_faces(&mesh));
        let rounding = grid.rounding(&mesh);
        if !grid.holds_all() {
            mesh = grid.round_mesh(&mesh)?;
        }
        let intersections = self.options.intersections.of(&mesh, self.input)?;
        let slides = self.options.boundary != BoundaryCondition::Fixed && !loops.is_empty();
        self.timing.verdict += started.elapsed();
        Ok(Flow {
            mesh,
            stop,
            steps,
            area: Change { initial: self.initial.0, r#final: derivatives.area },
            volume: (!slides).then(|| Change { initial: self.initial.1, r#final: self.surface.volume() }),
            gradient: derivatives.norm,
            pressure: derivatives.pressure,
            history: self.history,
            stability,
            discs,
            cone: self.cone,
            place,
            neck,
            rounding,
            intersections,
            timing: self.timing,
        })
    }
}
