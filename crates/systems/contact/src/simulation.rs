//! Steps in time: projected Newton with a line search that no pair of surfaces can cross.
//!
//! # Definition
//! A step minimises `½ |x − x̃|²_M + β² (Ψ(x) + κ Σ w m b(d²) + D(x))` from where it starts, with elastic energies Ψ, barriers and
//! friction D lagged; implicit Euler has `β = h`, `x̃ = x + h v + h² g`.

use crate::ccd::time_of_impact;
use crate::contact::{Contact, Curvature, Slide, Support, active};
use crate::surface::{Candidates, Surface};
use crate::{
    Bodies, Check, ContactError, ContactOptions, ContactStep, Handle, Integrator, Obstacle, PairSet,
};
use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::spatial::self_intersections;
use pompeiu_solve::{Cholesky, LinearSolver, SparseMatrix};
use rayon::prelude::*;

/// Pairs that are named when a start intersects.
const NAMED: usize = 100;

/// The part of the distance of contact below which barriers are made stiffer.
const TOO_CLOSE: f64 = 0.1;

/// How much stiffer than at the start barriers may become.
const MOST_STIFFENING: f64 = 1000.0;

/// The part of the decrease that the gradient promises, and a step must keep (Armijo).
const KEPT: f64 = 1e-4;

/// Halvings of a step at most.
const MOST_HALVINGS: usize = 60;

/// `−2 d b'(d²)` at half the distance of contact, in units of its cube.
const FORCE_AT_HALF: f64 = 4.33;

/// Bodies that move on step by step without ever intersecting.
///
/// # Accuracy
/// After each step an exact test, independent of what is computed here, finds no pair of faces that intersects ([`Check`]). Implicit Euler
/// conserves momentum to rounding, and damps angular momentum and energy.
/// # Cost
/// A sparse factorization for each Newton iteration. Surfaces are looked at in parallel, with the same bits at any number of threads.
/// # Source
/// `li_incremental_2020`.
#[derive(Debug)]
pub struct Simulation {
    bodies: Bodies,
    surface: Surface,
    options: ContactOptions,
    rest: Vec<DVec3>,
    x: Vec<DVec3>,
    v: Vec<DVec3>,
    /// Positions and velocities a step earlier, for BDF2.
    before: Option<(Vec<DVec3>, Vec<DVec3>)>,
    /// The unknown of each vertex; none where it is fixed.
    unknowns: Vec<Option<u32>>,
    /// How much edges count in this step; none where all pairs count.
    edge_weights: Option<Vec<f64>>,
    stiffness: f64,
    first_stiffness: f64,
    time: f64,
    steps: usize,
}

/// The state between two steps, from which another simulation of the same bodies goes on bit for bit.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactState {
    /// Steps so far.
    pub steps: usize,
    /// Time so far.
    pub time: f64,
    /// Positions.
    pub positions: Vec<[f64; 3]>,
    /// Velocities.
    pub velocities: Vec<[f64; 3]>,
    /// Positions and velocities a step earlier.
    pub before: Option<[Vec<[f64; 3]>; 2]>,
    /// The stiffness of barriers.
    pub stiffness: f64,
}

/// What a step minimises.
struct Objective<'a> {
    simulation: &'a Simulation,
    predicted: Vec<DVec3>,
    /// β.
    step: f64,
    start: &'a [DVec3],
    slides: Vec<Slide>,
    targets: Vec<DVec3>,
    stiffness: f64,
}

impl Simulation {
    /// Bodies that are about to move.
    ///
    /// # Errors
    /// [`ContactError::StartIntersects`] with the pairs named; the others for numbers that make no sense.
    pub fn new(bodies: Bodies, options: ContactOptions) -> Result<Self, ContactError> {
        options.check()?;
        let mut unknowns = vec![None; bodies.positions.len()];
        let mut count = 0;
        for (v, unknown) in unknowns.iter_mut().enumerate() {
            if !bodies.is_fixed[v] && bodies.mass[v] > 0.0 {
                *unknown = Some(count);
                count += 1;
            }
        }
        if count == 0 {
            return Err(ContactError::NothingMoves);
        }
        let is_still: Vec<bool> = unknowns.iter().map(Option::is_none).collect();
        let surface = Surface::new(&bodies.faces, &is_still);
        let weight: f64 = bodies.mass.iter().sum::<f64>() * options.gravity.length();
        let d = options.distance;
        // Without weight: the force that stops a body that moves by the distance of contact in a step.
        let push = bodies.mass.iter().sum::<f64>() * d / (options.time_step * options.time_step);
        let weight = if weight > 0.0 { weight } else { 0.1 * push };
        let chosen = weight / (4.0 * FORCE_AT_HALF * d * d * d);
        let stiffness = options.stiffness.unwrap_or(chosen);
        let mut simulation = Self {
            rest: bodies.positions.clone(),
            x: bodies.positions.clone(),
            v: bodies.velocities.clone(),
            before: None,
            unknowns,
            edge_weights: None,
            stiffness,
            first_stiffness: stiffness,
            time: 0.0,
            steps: 0,
            surface,
            bodies,
            options,
        };
        simulation.weigh_edges();
        simulation.check_start()?;
        Ok(simulation)
    }

    /// Edges count as much as they are bent when a step begins.
    fn weigh_edges(&mut self) {
        let weighs = self.options.pairs == PairSet::Exclusive;
        self.edge_weights = weighs.then(|| self.surface.edge_weights(&self.x));
    }

    fn check_start(&self) -> Result<(), ContactError> {
        let found = self_intersections(&self.mesh()?, NAMED);
        if !found.pairs.is_empty() {
            return Err(ContactError::StartIntersects { pairs: found.pairs });
        }
        let (contacts, supports) = self.contacts(&self.x, &self.candidates(&self.x, None));
        if contacts.iter().any(|contact| contact.distance(&self.x) <= 0.0) || found.touching > 0 {
            return Err(ContactError::StartTouches);
        }
        for support in supports {
            let (depth, _) = support.obstacle.distance(self.x[support.vertex as usize]);
            if depth <= 0.0 {
                let obstacle =
                    self.bodies.obstacles.iter().position(|o| *o == support.obstacle).unwrap_or_default();
                let vertex = support.vertex as usize;
                return Err(ContactError::StartInside { vertex, obstacle, depth: -depth });
            }
        }
        Ok(())
    }

    /// The options.
    pub fn options(&self) -> &ContactOptions {
        &self.options
    }

    /// The positions of all vertices.
    pub fn positions(&self) -> &[DVec3] {
        &self.x
    }

    /// The velocities of all vertices.
    pub fn velocities(&self) -> &[DVec3] {
        &self.v
    }

    /// The faces of all surfaces.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.surface.faces
    }

    /// Steps so far.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Time so far.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The surfaces as a mesh.
    ///
    /// # Errors
    /// [`ContactError::Mesh`] if there are too many vertices.
    pub fn mesh(&self) -> Result<TriMesh, ContactError> {
        let positions = self.x.iter().map(DVec3::to_array).collect();
        Ok(TriMesh::new(positions, self.surface.faces.clone())?)
    }

    /// The number of pairs of faces that intersect, by an exact test, up to a hundred.
    ///
    /// # Errors
    /// [`ContactError::Mesh`].
    pub fn certify(&self) -> Result<usize, ContactError> {
        Ok(self_intersections(&self.mesh()?, NAMED).pairs.len())
    }

    /// Barriers at the current positions.
    pub fn contact_pairs(&self) -> Vec<Contact> {
        self.contacts(&self.x, &self.candidates(&self.x, None)).0
    }

    /// The state, to go on from later.
    pub fn state(&self) -> ContactState {
        let arrays = |v: &[DVec3]| v.iter().map(DVec3::to_array).collect::<Vec<_>>();
        ContactState {
            steps: self.steps,
            time: self.time,
            positions: arrays(&self.x),
            velocities: arrays(&self.v),
            before: self.before.as_ref().map(|(x, v)| [arrays(x), arrays(v)]),
            stiffness: self.stiffness,
        }
    }

    /// Goes to a state of the same bodies.
    ///
    /// # Errors
    /// [`ContactError`] if it has another number of vertices, positions that are not finite, or surfaces that intersect.
    pub fn set_state(&mut self, state: &ContactState) -> Result<(), ContactError> {
        let (found, expected) = (state.positions.len(), self.x.len());
        let earlier = state.before.iter().flatten();
        if found != expected || earlier.chain([&state.velocities]).any(|v| v.len() != expected) {
            let (what, expected) = ("number of vertices of the state", "that of the bodies");
            return Err(ContactError::Parameter { what, value: found as f64, expected });
        }
        let vectors = |v: &[[f64; 3]]| v.iter().map(|p| DVec3::from_array(*p)).collect::<Vec<_>>();
        let (x, v) = (vectors(&state.positions), vectors(&state.velocities));
        if let Some(index) = x.iter().zip(&v).position(|(x, v)| !(x.is_finite() && v.is_finite())) {
            return Err(ContactError::NonFinite { index });
        }
        let old = (std::mem::replace(&mut self.x, x), std::mem::replace(&mut self.v, v));
        if let Err(error) = self.check_start() {
            (self.x, self.v) = old;
            return Err(error);
        }
        self.before = state.before.as_ref().map(|[x, v]| (vectors(x), vectors(v)));
        (self.steps, self.time, self.stiffness) = (state.steps, state.time, state.stiffness);
        Ok(())
    }

    fn candidates(&self, x: &[DVec3], p: Option<&[DVec3]>) -> Candidates {
        self.surface.candidates(x, p, self.options.distance)
    }

    /// Pairs and supports closer than the distance of contact.
    fn contacts(&self, x: &[DVec3], candidates: &Candidates) -> (Vec<Contact>, Vec<Support>) {
        let d = self.options.distance;
        let contacts = active(&self.surface, candidates, x, &self.rest, d, self.edge_weights.as_deref());
        let mut supports = Vec::new();
        for &vertex in &self.surface.points {
            if self.unknowns[vertex as usize].is_some() {
                for &obstacle in &self.bodies.obstacles {
                    if obstacle.distance(x[vertex as usize]).0 < d {
                        supports.push(Support { vertex, obstacle });
                    }
                }
            }
        }
        (contacts, supports)
    }

    /// The length of a step in the objective, and where bodies would go without forces between vertices.
    fn prediction(&self) -> (f64, Vec<DVec3>) {
        let (h, g) = (self.options.time_step, self.options.gravity);
        if let (Some((x0, v0)), Integrator::Bdf2) = (&self.before, self.options.integrator) {
            let beta = 2.0 * h / 3.0;
            let predict = |i: usize| {
                let x = (self.x[i] * 4.0 - x0[i]) / 3.0;
                let v = (self.v[i] * 4.0 - v0[i]) / 3.0;
                x + v * beta + g * (beta * beta)
            };
            return (beta, (0..self.x.len()).map(predict).collect());
        }
        let predict = |(x, v): (&DVec3, &DVec3)| *x + *v * h + g * (h * h);
        (h, self.x.iter().zip(&self.v).map(predict).collect())
    }

    /// Moves on by one step. A step that fails leaves the state unchanged.
    ///
    /// # Errors
    /// [`ContactError::NotConverged`]; [`ContactError::Intersects`] if the exact test finds what may not be.
    pub fn step(&mut self) -> Result<ContactStep, ContactError> {
        self.weigh_edges();
        let (step, predicted) = self.prediction();
        let d = self.options.distance;
        let time = self.time + self.options.time_step;
        let targets =
            self.bodies.handles.iter().map(|h| h.motion.at(self.rest[h.vertex as usize], time)).collect();
        let mut candidates = self.candidates(&self.x, None);
        let (contacts, supports) = self.contacts(&self.x, &candidates);
        let coefficient = self.options.friction;
        let mut slides = Vec::new();
        if coefficient > 0.0 {
            let of_contact = |c: &Contact| Slide::of_contact(c, &self.x, d, self.stiffness, coefficient);
            slides.extend(contacts.iter().filter_map(of_contact));
            let of_support = |s: &Support| Slide::of_support(s, &self.x, d, self.stiffness, coefficient);
            slides.extend(supports.iter().filter_map(of_support));
        }
        let mut objective = Objective {
            simulation: self,
            predicted,
            step,
            start: &self.x,
            slides,
            targets,
            stiffness: self.stiffness,
        };
        let mut x = self.x.clone();
        let mut report = ContactStep { least_part: 1.0, ..ContactStep::default() };
        let mut converged = None;
        for iteration in 0..self.options.most_iterations {
            let active = self.contacts(&x, &candidates);
            let (p, slope) = objective.newton(&x, &active)?;
            let speed = p.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max) / step;
            if speed <= self.options.tolerance {
                report.iterations = iteration + 1;
                converged = Some((x.clone(), active));
                break;
            }
            candidates = self.candidates(&x, Some(&p));
            let free = self.free_part(&x, &p, &candidates);
            if free < report.least_part {
                report.least_part = free;
            }
            let Some(next) = objective.line_search(&x, &p, slope, free, &candidates) else {
                // Rounding of the energy is all that is left of the decrease.
                let limit = 10.0 * self.options.tolerance;
                if speed <= limit {
                    report.iterations = iteration + 1;
                    converged = Some((x.clone(), active));
                    break;
                }
                let (step, iterations, tolerance) = (self.steps + 1, iteration + 1, self.options.tolerance);
                return Err(ContactError::NotConverged { step, iterations, speed, tolerance });
            };
            x = next;
            let close = self.contacts(&x, &candidates);
            if Self::least_gap(&x, &close).is_some_and(|gap| gap < TOO_CLOSE * d)
                && self.options.stiffness.is_none()
                && objective.stiffness < MOST_STIFFENING * self.first_stiffness
            {
                objective.stiffness *= 2.0;
            }
            report.least_gap = Some(speed);
        }
        let Some((x, active)) = converged else {
            let (step, iterations, tolerance) =
                (self.steps + 1, self.options.most_iterations, self.options.tolerance);
            let speed = report.least_gap.unwrap_or(f64::NAN);
            return Err(ContactError::NotConverged { step, iterations, speed, tolerance });
        };
        report.stiffness = objective.stiffness;
        report.support = objective.support(&x, &active).to_array();
        report.least_gap = Self::least_gap(&x, &active);
        report.pairs = active.0.len() + active.1.len();
        let stiffness = objective.stiffness;
        self.accept(x, step, stiffness, report)
    }

    /// Takes over the positions of a step, and measures.
    fn accept(
        &mut self,
        x: Vec<DVec3>,
        step: f64,
        stiffness: f64,
        mut report: ContactStep,
    ) -> Result<ContactStep, ContactError> {
        let base = |i: usize| match (&self.before, self.options.integrator) {
            (Some((x0, _)), Integrator::Bdf2) => (self.x[i] * 4.0 - x0[i]) / 3.0,
            _ => self.x[i],
        };
        let v: Vec<DVec3> = (0..x.len()).map(|i| (x[i] - base(i)) / step).collect();
        let old = (std::mem::replace(&mut self.x, x), std::mem::replace(&mut self.v, v));
        if self.options.check == Check::Every {
            let found = self_intersections(&self.mesh()?, NAMED);
            if let Some(pair) = found.pairs.first() {
                let pair = *pair;
                (self.x, self.v) = old;
                return Err(ContactError::Intersects { step: self.steps + 1, pair });
            }
            report.intersections = Some(0);
        }
        self.before = Some(old);
        self.stiffness = stiffness;
        self.steps += 1;
        self.time += self.options.time_step;
        report.time = self.time;
        let mass = &self.bodies.mass;
        let moving = || (0..self.x.len()).filter(|&i| self.unknowns[i].is_some());
        report.momentum = moving().map(|i| self.v[i] * mass[i]).sum::<DVec3>().to_array();
        report.angular_momentum =
            moving().map(|i| self.x[i].cross(self.v[i]) * mass[i]).sum::<DVec3>().to_array();
        report.kinetic_energy = moving().map(|i| 0.5 * mass[i] * self.v[i].length_squared()).sum();
        Ok(report)
    }

    /// The least distance of pairs that push.
    fn least_gap(x: &[DVec3], (contacts, supports): &(Vec<Contact>, Vec<Support>)) -> Option<f64> {
        let of_pairs = contacts.iter().map(|contact| contact.distance(x));
        let of_supports = supports.iter().map(|s| s.obstacle.distance(x[s.vertex as usize]).0);
        of_pairs.chain(of_supports).reduce(f64::min)
    }

    /// The part of a displacement during which nothing touches.
    fn free_part(&self, x: &[DVec3], p: &[DVec3], candidates: &Candidates) -> f64 {
        let surface = &self.surface;
        let time = |(kind, vertices): (crate::Kind, [u32; 4])| {
            let of = |values: &[DVec3]| vertices.map(|v| values[v as usize]);
            time_of_impact(kind, &of(x), &of(p)).unwrap_or(f64::INFINITY)
        };
        let least = |a: f64, b: f64| if b < a { b } else { a };
        let faces = candidates.point_face.par_iter().map(|&pair| time(surface.point_face(pair)));
        let edges = candidates.edge_edge.par_iter().map(|&pair| time(surface.edge_edge(pair)));
        let first = faces.chain(edges).reduce(|| f64::INFINITY, least);
        let mut first = first;
        for &vertex in &surface.points {
            let v = vertex as usize;
            if self.unknowns[v].is_none() {
                continue;
            }
            for obstacle in &self.bodies.obstacles {
                first = least(first, free_time(obstacle, x[v], p[v]));
            }
        }
        if first.is_finite() { least(1.0, 0.9 * first) } else { 1.0 }
    }
}

/// A time until which a point on a straight line stays out of an obstacle; infinite where that is the whole line.
fn free_time(obstacle: &Obstacle, x: DVec3, p: DVec3) -> f64 {
    let (distance, normal) = obstacle.distance(x);
    match obstacle {
        Obstacle::HalfSpace { .. } => {
            let approach = -normal.dot(p);
            if approach > distance { distance / approach } else { f64::INFINITY }
        }
        Obstacle::Ball { .. } => {
            let (length, mut time) = (p.length(), 0.0);
            if distance > length {
                return f64::INFINITY;
            }
            // The ball is not reached before the distance is covered; a tenth of it is left.
            let mut left = distance;
            while left > 0.1 * distance {
                time += 0.9 * left / length;
                if time >= 1.0 {
                    return f64::INFINITY;
                }
                left = obstacle.distance(x + p * time).0;
            }
            time
        }
    }
}

/// The matrix of an element with its vertices.
struct Element {
    vertices: [u32; 4],
    count: usize,
    gradient: [DVec3; 4],
    curvature: Curvature,
}

impl Objective<'_> {
    fn energy(&self, x: &[DVec3], (contacts, supports): &(Vec<Contact>, Vec<Support>)) -> f64 {
        let Simulation { bodies, options, unknowns, .. } = self.simulation;
        let (d, squared) = (options.distance, self.step * self.step);
        let add = |a: f64, b: f64| a + b;
        let inertia: f64 = (0..x.len())
            .filter(|&i| unknowns[i].is_some())
            .map(|i| 0.5 * bodies.mass[i] * (x[i] - self.predicted[i]).length_squared())
            .sum();
        let springs: f64 = bodies
            .handles
            .iter()
            .zip(&self.targets)
            .map(|(handle, target)| {
                let v = handle.vertex as usize;
                0.5 * Handle::STIFFNESS * bodies.mass[v] * (x[v] - *target).length_squared()
            })
            .sum();
        // Terms are computed in parallel and added in order.
        let sum = |terms: Vec<f64>| terms.into_iter().fold(0.0, add);
        let solid =
            sum(bodies.tetrahedra.par_iter().map(|t| t.energy(&t.vertices.map(|v| x[v as usize]))).collect());
        let cloth =
            sum(bodies.membranes.par_iter().map(|t| t.energy(&t.vertices.map(|v| x[v as usize]))).collect());
        let bend =
            sum(bodies.hinges.par_iter().map(|t| t.energy(&t.vertices.map(|v| x[v as usize]))).collect());
        let pairs = sum(contacts.par_iter().map(|contact| contact.energy(x, d)).collect());
        let support: f64 = supports.iter().map(|support| support.energy(x, d)).sum();
        let moved = self.moved(x);
        let epsilon = self.epsilon();
        let slides = sum(self.slides.par_iter().map(|slide| slide.energy(&moved, epsilon)).collect());
        inertia + squared * (springs + solid + cloth + bend + self.stiffness * (pairs + support) + slides)
    }

    /// The distance below which surfaces stick.
    fn epsilon(&self) -> f64 {
        self.simulation.options.sticking_speed * self.simulation.options.time_step
    }

    fn moved(&self, x: &[DVec3]) -> Vec<DVec3> {
        if self.slides.is_empty() {
            return Vec::new();
        }
        x.iter().zip(self.start).map(|(x, start)| *x - *start).collect()
    }

    /// The force of barriers of what is fixed on what moves.
    fn support(&self, x: &[DVec3], (contacts, supports): &(Vec<Contact>, Vec<Support>)) -> DVec3 {
        let Simulation { options, unknowns, .. } = self.simulation;
        let is_free = |v: u32| unknowns[v as usize].is_some();
        let mut force = DVec3::ZERO;
        for contact in contacts.iter().filter(|c| !c.vertices.iter().all(|&v| is_free(v))) {
            let (gradient, _) = contact.derivatives(x, options.distance, crate::Projection::Normal);
            for (v, g) in contact.vertices.iter().zip(gradient) {
                if is_free(*v) {
                    force -= g * self.stiffness;
                }
            }
        }
        for support in supports {
            force -= support.derivatives(x, options.distance).0 * self.stiffness;
        }
        force
    }

    /// Elements with gradients and positive semi-definite second derivatives, in order.
    fn elements(&self, x: &[DVec3], (contacts, supports): &(Vec<Contact>, Vec<Support>)) -> Vec<Element> {
        let Simulation { bodies, options, .. } = self.simulation;
        let squared = self.step * self.step;
        let kappa = squared * self.stiffness;
        let mut elements = Vec::new();
        let full = |block: &dyn Fn(usize, usize) -> f64, scale: f64| {
            Curvature::Full(Box::new(std::array::from_fn(|i| std::array::from_fn(|j| scale * block(i, j)))))
        };
        elements.par_extend(bodies.tetrahedra.par_iter().map(|t| {
            let (gradient, hessian) = t.derivatives(&t.vertices.map(|v| x[v as usize]));
            let curvature = full(&|i, j| hessian[i][j], squared);
            Element { vertices: t.vertices, count: 4, gradient: gradient.map(|g| g * squared), curvature }
        }));
        elements.par_extend(bodies.membranes.par_iter().map(|t| {
            let (gradient, hessian) = t.derivatives(&t.vertices.map(|v| x[v as usize]));
            let [a, b, c] = t.vertices;
            let curvature = full(&|i, j| if i < 9 && j < 9 { hessian[i][j] } else { 0.0 }, squared);
            let [p, q, r] = gradient.map(|g| g * squared);
            Element { vertices: [a, b, c, a], count: 3, gradient: [p, q, r, DVec3::ZERO], curvature }
        }));
        elements.par_extend(bodies.hinges.par_iter().map(|t| {
            let (gradient, angle, factor) = t.derivatives(&t.vertices.map(|v| x[v as usize]));
            let curvature = Curvature::Rank1(factor * squared, angle);
            Element { vertices: t.vertices, count: 4, gradient: gradient.map(|g| g * squared), curvature }
        }));
        elements.par_extend(contacts.par_iter().map(|contact| {
            let (gradient, curvature) = contact.derivatives(x, options.distance, options.projection);
            let curvature = match curvature {
                Curvature::Rank1(factor, vector) => Curvature::Rank1(factor * kappa, vector),
                Curvature::Full(entries) => full(&|i, j| entries[i][j], kappa),
            };
            let count = match contact.kind {
                crate::Kind::PointTriangle | crate::Kind::EdgeEdge => 4,
                crate::Kind::PointEdge => 3,
                crate::Kind::PointPoint => 2,
            };
            Element { vertices: contact.vertices, count, gradient: gradient.map(|g| g * kappa), curvature }
        }));
        elements.extend(supports.iter().map(|support| {
            let (gradient, normal, along) = support.derivatives(x, options.distance);
            let mut vector = [0.0; 12];
            vector[..3].copy_from_slice(&normal.to_array());
            let z = DVec3::ZERO;
            let gradient = [gradient * kappa, z, z, z];
            let vertices = [support.vertex; 4];
            Element { vertices, count: 1, gradient, curvature: Curvature::Rank1(along * kappa, vector) }
        }));
        let (moved, epsilon) = (self.moved(x), self.epsilon());
        elements.par_extend(self.slides.par_iter().map(|slide| {
            let (gradient, hessian) = slide.derivatives(&moved, epsilon);
            let curvature = full(&|i, j| hessian[i][j], squared);
            let gradient = gradient.map(|g| g * squared);
            Element { vertices: slide.vertices(), count: 4, gradient, curvature }
        }));
        elements
    }

    /// A Newton step for all vertices, and the slope of the objective along it.
    fn newton(
        &self,
        x: &[DVec3],
        active: &(Vec<Contact>, Vec<Support>),
    ) -> Result<(Vec<DVec3>, f64), ContactError> {
        let Simulation { bodies, unknowns, .. } = self.simulation;
        let count = 3 * unknowns.iter().flatten().count();
        let (mut gradient, mut diagonal) = (vec![0.0; count], vec![0.0; count]);
        let mut add = |v: usize, g: DVec3, stiffness: f64| {
            if let Some(unknown) = unknowns[v] {
                for k in 0..3 {
                    gradient[3 * unknown as usize + k] += g[k];
                    diagonal[3 * unknown as usize + k] += stiffness;
                }
            }
        };
        for v in 0..x.len() {
            add(v, (x[v] - self.predicted[v]) * bodies.mass[v], bodies.mass[v]);
        }
        let squared = self.step * self.step;
        for (handle, target) in bodies.handles.iter().zip(&self.targets) {
            let v = handle.vertex as usize;
            let stiffness = squared * Handle::STIFFNESS * bodies.mass[v];
            add(v, (x[v] - *target) * stiffness, stiffness);
        }
        let elements = self.elements(x, active);
        for element in &elements {
            for k in 0..element.count {
                add(element.vertices[k] as usize, element.gradient[k], 0.0);
            }
        }
        let mut triplets: Vec<(usize, usize, f64)> =
            diagonal.iter().enumerate().map(|(i, value)| (i, i, *value)).collect();
        for element in &elements {
            element.append(unknowns, &mut triplets);
        }
        let matrix = SparseMatrix::from_triplets(count, count, &triplets)?;
        let mut step: Vec<f64> = gradient.iter().map(|g| -g).collect();
        Cholesky::new(&matrix)?.solve_in_place(&mut step)?;
        let slope = step.iter().zip(&gradient).map(|(p, g)| p * g).sum();
        let of = |unknown: &Option<u32>| {
            unknown.map_or(DVec3::ZERO, |u| DVec3::from_slice(&step[3 * u as usize..3 * u as usize + 3]))
        };
        Ok((unknowns.iter().map(of).collect(), slope))
    }

    /// The first of a step and its halves that lowers the objective enough.
    fn line_search(
        &self,
        x: &[DVec3],
        p: &[DVec3],
        slope: f64,
        free: f64,
        candidates: &Candidates,
    ) -> Option<Vec<DVec3>> {
        let simulation = self.simulation;
        let start = self.energy(x, &simulation.contacts(x, candidates));
        let mut part = free;
        for _ in 0..MOST_HALVINGS {
            let next: Vec<DVec3> = x.iter().zip(p).map(|(x, p)| *x + *p * part).collect();
            let energy = self.energy(&next, &simulation.contacts(&next, candidates));
            if energy <= start + KEPT * part * slope {
                return Some(next);
            }
            part *= 0.5;
        }
        None
    }
}

impl Element {
    /// Adds the lower triangle of its entries.
    fn append(&self, unknowns: &[Option<u32>], triplets: &mut Vec<(usize, usize, f64)>) {
        for i in 0..self.count {
            let Some(row) = unknowns[self.vertices[i] as usize] else { continue };
            for j in 0..self.count {
                let Some(column) = unknowns[self.vertices[j] as usize] else { continue };
                for a in 0..3 {
                    for b in 0..3 {
                        let (r, c) = (3 * row as usize + a, 3 * column as usize + b);
                        if r < c {
                            continue;
                        }
                        let value = match &self.curvature {
                            Curvature::Rank1(factor, v) => factor * v[3 * i + a] * v[3 * j + b],
                            Curvature::Full(entries) => entries[3 * i + a][3 * j + b],
                        };
                        triplets.push((r, c, value));
                    }
                }
            }
        }
    }
}
