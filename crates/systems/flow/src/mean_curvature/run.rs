//! A flow from its start to its end.

use super::existence::{Cone, separating_cone};
use super::gradient::Derivatives;
use super::moving::{Motion, MovingSurface, mean_edge};
use super::observer::FlowStep;
use super::options::{BoundaryCondition, FlowOptions, Scheme, Until};
use super::pinch::{Neck, neck};
use super::report::{Change, Flow, FlowRecord, FlowStop, FlowTiming, StepReason};
use super::step::{self, FirstMetric, FullSystem, MOST_HALVINGS};
use super::systems::Systems;
use super::time::TimeStep;
use super::{FlowError, discs, stability};
use crate::remesh::DynamicMesh;
use glam::{DMat3, DVec3};
use pompeiu_core::TriMesh;
use pompeiu_core::run::{Control, on_threads};
use std::ops::ControlFlow;
use std::time::Instant;

/// Steps to a stationary surface at most.
const MOST_STEPS: usize = 20_000;
/// Implicit steps that may smooth the surface before Newton's method is blended.
const SMOOTHINGS: usize = 3;
/// Newton steps between two improvements of the triangles, and how often that is done.
const NEWTON_STEPS: usize = 3;
const IMPROVEMENTS: usize = 2;
/// Moves of vertices within the surface at each improvement.
const RELAXATIONS: usize = 3;
/// Triangles are improved on the way to a stationary surface if the least angle is below this one, in degrees.
const GOOD_ANGLE: f64 = 25.0;
/// Least volume that can be kept, as a part of the area to the power 3/2.
const LEAST_VOLUME: f64 = 1e-9;
/// Necks are looked for whenever vertices may have moved by this many mean edges.
const EDGES_BETWEEN_CHECKS: f64 = 0.1;
/// A surface whose area is below this part of the area at first has vanished.
const VANISHED: f64 = 1e-6;
/// Blended Newton steps before the surface flows in time, where no minimal surface is known to exist.
const BLENDED_STEPS: usize = 3;
/// A step that moves no vertex by more than this part of the square root of the area is none.
const LEAST_MOVE: f64 = 1e-15;

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

/// A flow on its way.
struct Runner<'r> {
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
    time: Option<f64>,
    time_step: TimeStep,
    history: Vec<FlowRecord>,
    cone: Option<Cone>,
    /// Whether necks are looked for: not if the mesh was too coarse for that at the start.
    watch_necks: bool,
    /// How far vertices may have moved since then.
    way: f64,
    smoothings: usize,
    improvements: usize,
    newton_steps: usize,
    blended: usize,
    timing: FlowTiming,
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

impl<'r> Runner<'r> {
    fn new(mesh: &TriMesh, options: &'r FlowOptions<'r>) -> Result<Self, FlowError> {
        let turn = match options.boundary {
            BoundaryCondition::Fixed => DMat3::IDENTITY,
            BoundaryCondition::Planes(normal) => {
                let z = DVec3::from_array(normal).normalize();
                let (x, y) = z.any_orthonormal_pair();
                DMat3::from_cols(x, y, z).transpose()
            }
        };
        let mut dynamic = DynamicMesh::new(mesh.positions(), mesh.faces())?;
        for p in &mut dynamic.positions {
            *p = turn * *p;
        }
        let surface = with_motion(dynamic, options.boundary);
        let triangles = surface.triangles();
        let flat = |t: &&super::triangle::Triangle| t.normal == DVec3::ZERO;
        if let Some(face) = triangles.iter().position(|t| flat(&t)) {
            let count = triangles.iter().filter(flat).count();
            return Err(FlowError::NoArea { face: face as u32, count });
        }
        if surface.motion.iter().all(|motion| *motion == Motion::Fixed) {
            return Err(FlowError::NothingMoves);
        }
        let masses = surface.masses(&triangles);
        let (area, volume) = (surface.area(), surface.volume());
        if options.keep_volume && volume.abs() <= LEAST_VOLUME * area.powf(1.5) {
            return Err(FlowError::NoVolume { volume });
        }
        let cone = match &boundary_loops(&surface)[..] {
            [first, second] if options.boundary == BoundaryCondition::Fixed => {
                separating_cone([first, second])
            }
            _ => None,
        };
        let watch_necks = neck(&surface, mean_edge(&triangles)).is_none();
        Ok(Self {
            options,
            scheme: options.scheme(),
            control: Control::start(&options.limits),
            turn,
            systems: None,
            full: None,
            first: FirstMetric { triangles, masses },
            initial: (area, volume),
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
            let outcome = self.step(&derivatives)?;
            let Outcome::Moved(Done { to, time, scheme, reason }) = outcome else {
                stop = Some(FlowStop::Stalled);
                break;
            };
            let way = self.surface.positions().iter().zip(&to).map(|(p, q)| p.distance(*q));
            self.way += way.fold(0.0, f64::max);
            self.surface.mesh.positions = to;
            self.time = self.time.zip(time).map(|(from, by)| from + by);
            steps += 1;
            self.timing.steps += started.elapsed();
            derivatives = Derivatives::of(&self.surface, self.options.keep_volume);
            stop = self.record(&derivatives, scheme, reason).err();
            if let Some(reason) = self.remesh(&derivatives, steps, scheme, reason)? {
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
                    (steps >= MOST_STEPS).then_some(FlowStop::Stalled)
                }
            }
            Until::Time(time) => self.time.is_some_and(|t| t >= time).then_some(FlowStop::Time),
            Until::Steps(count) => (steps >= count).then_some(FlowStop::Steps),
        };
        if stop.is_some() {
            return stop;
        }
        if self.control.is_stopped() {
            return Some(FlowStop::Limit);
        }
        if derivatives.area <= VANISHED * self.initial.0 {
            return Some(FlowStop::Pinched);
        }
        // Conformalized flow keeps necks from pinching: its triangles stay alike.
        let may_pinch =
            self.watch_necks && !matches!(self.scheme, Scheme::Conformalized | Scheme::FixedLaplacian);
        let edge = mean_edge(&derivatives.triangles);
        if may_pinch && self.way > EDGES_BETWEEN_CHECKS * edge {
            let started = Instant::now();
            self.way = 0.0;
            *found = neck(&self.surface, edge);
            self.timing.verdict += started.elapsed();
        }
        found.map(|_| FlowStop::Pinched)
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
        let positions = self.turned_back();
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

    fn turned_back(&self) -> Vec<[f64; 3]> {
        let back = self.turn.transpose();
        let still = self.turn == DMat3::IDENTITY;
        self.surface.positions().iter().map(|p| (if still { *p } else { back * *p }).to_array()).collect()
    }

    fn systems(&mut self) -> Result<Systems, FlowError> {
        match self.systems.take() {
            Some(systems) => Ok(systems),
            None => Ok(Systems::new(&self.surface)?),
        }
    }

    fn step(&mut self, derivatives: &Derivatives) -> Result<Outcome, FlowError> {
        let no_minimal_surface = self.cone.is_some() && self.blended >= BLENDED_STEPS;
        match self.scheme {
            Scheme::NormalNewton if no_minimal_surface => {
                self.in_time(derivatives, Scheme::Implicit, StepReason::NoMinimalSurface)
            }
            Scheme::NormalNewton => self.normal_newton(derivatives),
            Scheme::Newton | Scheme::NewtonOrGradient => self.newton(derivatives),
            scheme => self.in_time(derivatives, scheme, StepReason::Scheme),
        }
    }

    /// A step with a length in time.
    fn in_time(
        &mut self,
        derivatives: &Derivatives,
        scheme: Scheme,
        reason: StepReason,
    ) -> Result<Outcome, FlowError> {
        if scheme == Scheme::Explicit {
            return Ok(self.explicit(derivatives, reason));
        }
        let mut systems = self.systems()?;
        let first = match scheme {
            Scheme::FixedLaplacian => Some((&self.first, true)),
            Scheme::Conformalized => Some((&self.first, false)),
            _ => None,
        };
        let left = match self.options.until {
            Until::Time(end) => self.time.map_or(f64::INFINITY, |t| end - t),
            _ => f64::INFINITY,
        };
        let made = self.time_step.advance(&self.surface, derivatives, &mut systems, first, left);
        self.systems = Some(systems);
        let Some((to, by)) = made? else { return Ok(Outcome::Stalled) };
        Ok(self.unless_still(
            derivatives,
            Done { to, time: Some(by).filter(|by| by.is_finite()), scheme, reason },
        ))
    }

    /// Nothing more is to be expected of a scheme that moves no vertex.
    fn unless_still(&self, derivatives: &Derivatives, done: Done) -> Outcome {
        let way = self.surface.positions().iter().zip(&done.to).map(|(p, q)| p.distance_squared(*q));
        let longest = way.fold(0.0, |x, y| if y > x { y } else { x });
        if longest <= LEAST_MOVE * LEAST_MOVE * derivatives.area {
            Outcome::Stalled
        } else {
            Outcome::Moved(done)
        }
    }

    fn explicit(&mut self, derivatives: &Derivatives, reason: StepReason) -> Outcome {
        let down = step::steepest_descent(derivatives);
        let left = match self.options.until {
            Until::Time(end) => self.time.map_or(f64::INFINITY, |t| end - t),
            _ => f64::INFINITY,
        };
        let longest = self.time_step.explicit(left);
        match step::line_search(&self.surface, derivatives, &down, longest, MOST_HALVINGS) {
            Some((by, to)) => {
                self.time_step.accept_explicit(by);
                self.unless_still(derivatives, Done { to, time: Some(by), scheme: Scheme::Explicit, reason })
            }
            None => Outcome::Stalled,
        }
    }

    fn normal_newton(&mut self, derivatives: &Derivatives) -> Result<Outcome, FlowError> {
        let mut systems = self.systems()?;
        // With a boundary a few implicit steps without mass bring a rough surface near a minimal one.
        let may_smooth = self.smoothings < SMOOTHINGS && self.surface.motion.contains(&Motion::Fixed);
        let found = step::normal_newton(&self.surface, derivatives, &mut systems, !may_smooth)?;
        let searched = found.and_then(|(step, blended)| {
            let (by, to) = step::line_search(&self.surface, derivatives, &step, 1.0, MOST_HALVINGS)?;
            Some((by, to, blended))
        });
        let outcome = match searched {
            Some((by, to, blended)) if !may_smooth || by == 1.0 => {
                self.blended += usize::from(blended);
                self.newton_steps += 1;
                let reason = if blended { StepReason::NotDefinite } else { StepReason::Scheme };
                Outcome::Moved(Done { to, time: None, scheme: Scheme::NormalNewton, reason })
            }
            _ if may_smooth => {
                self.smoothings += 1;
                let to = step::implicit(&self.surface, derivatives, &mut systems, 0.0, None)?;
                let to = step::moved(&self.surface, &to, 1.0);
                Outcome::Moved(Done {
                    to,
                    time: None,
                    scheme: Scheme::Implicit,
                    reason: StepReason::Smoothing,
                })
            }
            _ => {
                self.systems = Some(systems);
                let done = self.explicit(derivatives, StepReason::AreaWouldRise);
                return Ok(done);
            }
        };
        self.systems = Some(systems);
        Ok(outcome)
    }

    fn newton(&mut self, derivatives: &Derivatives) -> Result<Outcome, FlowError> {
        let mut full = match self.full.take() {
            Some(full) => full,
            None => FullSystem::new(&self.surface)?,
        };
        let clamp = self.scheme == Scheme::Newton;
        let step = full.newton(derivatives, clamp)?;
        self.full = Some(full);
        let Some(step) = step else { return Ok(self.explicit(derivatives, StepReason::NotFactored)) };
        // The source's rule takes a whole step or none.
        let halvings = if clamp { MOST_HALVINGS } else { 0 };
        match step::line_search(&self.surface, derivatives, &step, 1.0, halvings) {
            Some((_, to)) => {
                let done = Done { to, time: None, scheme: self.scheme, reason: StepReason::Scheme };
                Ok(self.unless_still(derivatives, done))
            }
            None => Ok(self.explicit(derivatives, StepReason::AreaWouldRise)),
        }
    }

    /// Remeshes or improves the triangles where it is time to.
    fn remesh(
        &mut self,
        derivatives: &Derivatives,
        steps: usize,
        scheme: Scheme,
        reason: StepReason,
    ) -> Result<Option<StepReason>, FlowError> {
        let started = Instant::now();
        let asked = self.options.remesh.filter(|r| steps.is_multiple_of(r.every.get()));
        let improves = self.options.improve
            && (reason == StepReason::Smoothing
                || scheme == Scheme::NormalNewton
                    && self.improvements < IMPROVEMENTS
                    && self.newton_steps.is_multiple_of(NEWTON_STEPS)
                    && least_angle(derivatives) < GOOD_ANGLE)
            || self.options.keep_volume && self.options.improve && least_angle(derivatives) < GOOD_ANGLE;
        let fixed = self.options.boundary == BoundaryCondition::Fixed;
        let mesh = if let Some(remeshing) = asked {
            self.surface.mesh.remeshed(remeshing.edge_length, fixed)?
        } else if improves {
            self.improvements += usize::from(reason != StepReason::Smoothing);
            self.surface.mesh.improved(RELAXATIONS, fixed)
        } else {
            return Ok(None);
        };
        self.surface = with_motion(mesh, self.options.boundary);
        (self.systems, self.full) = (None, None);
        self.timing.remesh += started.elapsed();
        Ok(Some(if asked.is_some() { StepReason::Remeshed } else { StepReason::Improved }))
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
            let mut systems = self.systems()?;
            stability::least_eigenvalue(&self.surface, derivatives, &mut systems)?
        } else {
            None
        };
        let loops = boundary_loops(&self.surface);
        let discs = match &loops[..] {
            [first, second] if self.options.boundary == BoundaryCondition::Fixed => {
                Some(discs::compare([first, second], derivatives.area))
            }
            _ => None,
        };
        let mut mesh = self.surface.mesh.clone();
        for (p, back) in mesh.positions.iter_mut().zip(self.turned_back()) {
            *p = DVec3::from_array(back);
        }
        let back = |p: [f64; 3]| (self.turn.transpose() * DVec3::from_array(p)).to_array();
        let slides = self.options.boundary != BoundaryCondition::Fixed && !loops.is_empty();
        self.timing.verdict += started.elapsed();
        Ok(Flow {
            mesh: mesh.to_mesh()?,
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
            neck: neck.map(|neck| Neck { position: back(neck.position), ..neck }),
            timing: self.timing,
        })
    }
}

/// The surface with what its vertices may do.
fn with_motion(mesh: DynamicMesh, boundary: BoundaryCondition) -> MovingSurface {
    let at_boundary = match boundary {
        BoundaryCondition::Fixed => Motion::Fixed,
        BoundaryCondition::Planes(_) => Motion::InPlane,
    };
    let of = |v: u32| if mesh.is_boundary(v) { at_boundary } else { Motion::Free };
    let motion = (0..mesh.positions.len() as u32).map(of).collect();
    MovingSurface { mesh, motion }
}

/// The boundary loops, as polygons.
fn boundary_loops(surface: &MovingSurface) -> Vec<Vec<DVec3>> {
    let mesh = &surface.mesh;
    let mut seen = vec![false; mesh.positions.len()];
    let mut loops = Vec::new();
    for v in 0..seen.len() as u32 {
        let mut at = v;
        let mut polygon = Vec::new();
        while !seen[at as usize] && mesh.is_boundary(at) && mesh.outgoing[at as usize] != crate::remesh::NONE
        {
            seen[at as usize] = true;
            polygon.push(mesh.positions[at as usize]);
            at = mesh.to(mesh.outgoing[at as usize]);
        }
        if !polygon.is_empty() {
            loops.push(polygon);
        }
    }
    loops
}

/// The least angle of all triangles, in degrees.
fn least_angle(derivatives: &Derivatives) -> f64 {
    let of = |t: &super::triangle::Triangle| {
        let [a, b, c] = t.edges;
        let angle = |x: DVec3, y: DVec3| x.angle_between(-y);
        angle(a, b).min(angle(b, c)).min(angle(c, a))
    };
    derivatives.triangles.iter().map(of).fold(f64::INFINITY, f64::min).to_degrees()
}
