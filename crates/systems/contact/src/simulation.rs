//! Steps in time: projected Newton with a line search that no pair of surfaces can cross.
//!
//! # Definition
//! A step minimises `½ |x − x̃|²_M + β² (Ψ(x) + κ Σ w m b(d²) + D(x))` from where it starts, with elastic energies Ψ, barriers and
//! friction D lagged; implicit Euler has `β = h`, `x̃ = x + h v + h² g`.

use crate::ccd::time_of_impact_before;
use crate::contact::{Contact, Slide, Support, active};
use crate::distance::distance_sq;
use crate::objective::{Objective, elastic_energy};
use crate::report::since;
use crate::surface::{Candidates, Surface};
use crate::{
    Bodies, Check, ContactError, ContactOptions, ContactStep, ContactTiming, Integrator, Obstacle, PairSet,
};
use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::FaceId;
use pompeiu_core::spatial::self_intersections;
use pompeiu_solve::SymmetricBlocks;
use rayon::prelude::*;
use std::sync::atomic::AtomicU64;
use std::sync::atomic::Ordering::Relaxed;
use std::time::Instant;

/// Pairs that are named when a start intersects.
const NAMED: usize = 100;

/// The part of the distance of contact below which barriers are made stiffer.
const TOO_CLOSE: f64 = 0.1;

/// The least gap at the start, in distances of contact. The second derivative of the barrier grows with the inverse square of the gap: below,
/// less than five bits are left of masses and elastic forces beside it, and Newton's method does not converge.
const LEAST_START: f64 = 1.0 / 16_777_216.0;

/// How much stiffer than at the start barriers may become.
const MOST_STIFFENING: f64 = 1000.0;

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
    pub(crate) bodies: Bodies,
    surface: Surface,
    pub(crate) options: ContactOptions,
    rest: Vec<DVec3>,
    x: Vec<DVec3>,
    v: Vec<DVec3>,
    /// Positions and velocities a step earlier, for BDF2.
    before: Option<(Vec<DVec3>, Vec<DVec3>)>,
    /// The unknown of each vertex; none where it is fixed.
    pub(crate) unknowns: Vec<Option<u32>>,
    /// How much edges count in this step; none where all pairs count.
    edge_weights: Option<Vec<f64>>,
    stiffness: f64,
    first_stiffness: f64,
    time: f64,
    steps: usize,
    timing: ContactTiming,
}

/// The state between two steps, from which another simulation of the same bodies goes on bit for bit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
            timing: ContactTiming::default(),
            surface,
            bodies,
            options,
        };
        simulation.weigh_edges();
        simulation.check_start()?;
        simulation.check_gap()?;
        Ok(simulation)
    }

    /// Edges count as much as they are bent when a step begins.
    fn weigh_edges(&mut self) {
        let weighs = self.options.pairs == PairSet::Exclusive;
        self.edge_weights = weighs.then(|| self.surface.edge_weights(&self.x));
    }

    /// A resumed state may be nearer: it came from a step that converged.
    fn check_gap(&self) -> Result<(), ContactError> {
        let least = LEAST_START * self.options.distance;
        match Self::least_gap(&self.x, &self.contacts(&self.x, &self.candidates(&self.x, None))) {
            Some(gap) if gap < least => Err(ContactError::StartTooClose { gap, least }),
            _ => Ok(()),
        }
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

    /// The bodies as they were given.
    pub fn bodies(&self) -> &Bodies {
        &self.bodies
    }

    /// Time by the clock that the steps of this simulation took.
    pub fn timing(&self) -> ContactTiming {
        self.timing
    }

    /// The sum of the momenta of what moves.
    fn momentum(&self) -> DVec3 {
        self.moving().map(|i| self.v[i] * self.bodies.mass[i]).sum()
    }

    /// The sum of the forces of gravity on what moves.
    pub fn weight(&self) -> DVec3 {
        self.options.gravity * self.moving().map(|i| self.bodies.mass[i]).sum::<f64>()
    }

    /// Vertices that can move.
    fn moving(&self) -> impl Iterator<Item = usize> {
        (0..self.x.len()).filter(|&i| self.unknowns[i].is_some())
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

    pub(crate) fn candidates(&self, x: &[DVec3], p: Option<&[DVec3]>) -> Candidates {
        self.surface.candidates(x, p, self.options.distance)
    }

    /// Pairs and supports closer than the distance of contact.
    pub(crate) fn contacts(&self, x: &[DVec3], candidates: &Candidates) -> (Vec<Contact>, Vec<Support>) {
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
    /// [`ContactError::NotConverged`]; [`ContactError::ObstaclesMeet`]; [`ContactError::Intersects`] if the exact test finds what may not be.
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
        let driven =
            self.bodies.driven.iter().map(|(v, motion)| (*v, motion.at(self.rest[*v as usize], time)));
        let mut objective = Objective {
            simulation: self,
            driven: driven.collect(),
            drag: self.moving().map(|i| self.bodies.mass[i]).sum(),
            predicted,
            step,
            start: &self.x,
            slides,
            targets,
            stiffness: self.stiffness,
        };
        let mut x = self.x.clone();
        let mut timing = self.timing;
        let mut report = ContactStep { least_part: 1.0, ..ContactStep::default() };
        let mut converged = None;
        // Its pattern is kept within the step only, so that a run that is resumed has the same bits.
        let mut matrix = SymmetricBlocks::default();
        for iteration in 0..self.options.most_iterations {
            let active = self.contacts(&x, &candidates);
            let started = Instant::now();
            let (p, slope) = objective.newton(&x, &active, &mut matrix)?;
            timing.newton += since(started);
            let speed = p.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max) / step;
            if speed <= self.options.tolerance && !self.widens(&x, &p, &active.0, step) {
                report.iterations = iteration + 1;
                converged = Some((x.clone(), active));
                break;
            }
            let started = Instant::now();
            candidates = self.candidates(&x, Some(&p));
            timing.search += since(started);
            let started = Instant::now();
            let free = self.free_part_of(&x, &p, &candidates);
            timing.collision_detection += since(started);
            report.moving_pairs += candidates.point_face.len() + candidates.edge_edge.len();
            if free < report.least_part {
                report.least_part = free;
            }
            let started = Instant::now();
            let found = objective.line_search(&x, &p, slope, free, &candidates);
            timing.line_search += since(started);
            let Some(next) = found else {
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
        self.timing = timing;
        self.accept(x, step, stiffness, report)
    }

    /// Whether a Newton step changes by more than a half a gap that is shorter than what the tolerance lets through. Steps away from a barrier
    /// are as short as the gap, however great its force.
    fn widens(&self, x: &[DVec3], p: &[DVec3], contacts: &[Contact], step: f64) -> bool {
        let short = self.options.tolerance * step;
        contacts.par_iter().any(|contact| {
            let at = |part: f64| contact.vertices.map(|v| x[v as usize] + p[v as usize] * part);
            let gap = distance_sq(contact.kind, &at(0.0)).sqrt();
            gap < short && (distance_sq(contact.kind, &at(1.0)).sqrt() - gap).abs() > 0.5 * gap
        })
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
            let started = Instant::now();
            let found = self_intersections(&self.mesh()?, NAMED);
            self.timing.exact_test += since(started);
            if let Some(pair) = found.pairs.first() {
                let (pair, step) = (*pair, self.steps + 1);
                (self.x, self.v) = old;
                let of_obstacle = |face: FaceId| {
                    self.surface.faces[face.index()].iter().all(|v| self.unknowns[*v as usize].is_none())
                };
                return Err(if pair.faces.iter().all(|face| of_obstacle(*face)) {
                    ContactError::ObstaclesMeet { step, pair }
                } else {
                    ContactError::Intersects { step, pair }
                });
            }
            report.intersections = Some(0);
        }
        self.before = Some(old);
        self.stiffness = stiffness;
        self.steps += 1;
        self.time += self.options.time_step;
        self.measure_into(&mut report);
        Ok(report)
    }

    /// What can be measured of the bodies as they are.
    pub fn measure(&self) -> ContactStep {
        let active = self.contacts(&self.x, &self.candidates(&self.x, None));
        let mut report = ContactStep {
            pairs: active.0.len() + active.1.len(),
            least_gap: Self::least_gap(&self.x, &active),
            stiffness: self.stiffness,
            least_part: 1.0,
            ..ContactStep::default()
        };
        self.measure_into(&mut report);
        report
    }

    /// Time, momenta and energies.
    fn measure_into(&self, report: &mut ContactStep) {
        let mass = &self.bodies.mass;
        report.time = self.time;
        report.momentum = self.momentum().to_array();
        report.angular_momentum =
            self.moving().map(|i| self.x[i].cross(self.v[i]) * mass[i]).sum::<DVec3>().to_array();
        report.kinetic_energy = self.moving().map(|i| 0.5 * mass[i] * self.v[i].length_squared()).sum();
        report.elastic_energy = elastic_energy(&self.bodies, &self.x).iter().sum();
        let fallen = self.moving().map(|i| mass[i] * (self.x[i] - self.rest[i]).dot(self.options.gravity));
        report.potential_energy = -fallen.sum::<f64>();
    }

    /// The least distance of pairs that push.
    fn least_gap(x: &[DVec3], (contacts, supports): &(Vec<Contact>, Vec<Support>)) -> Option<f64> {
        let of_pairs = contacts.iter().map(|contact| contact.distance(x));
        let of_supports = supports.iter().map(|s| s.obstacle.distance(x[s.vertex as usize]).0);
        of_pairs.chain(of_supports).reduce(f64::min)
    }

    /// The part of a displacement during which nothing touches.
    pub(crate) fn free_part_of(&self, x: &[DVec3], p: &[DVec3], candidates: &Candidates) -> f64 {
        let surface = &self.surface;
        // Times are positive, so that the order of their bits is theirs.
        let first = AtomicU64::new(f64::INFINITY.to_bits());
        let lower = |(kind, vertices): (crate::Kind, [u32; 4])| {
            let of = |values: &[DVec3]| vertices.map(|v| values[v as usize]);
            let limit = || f64::from_bits(first.load(Relaxed));
            if let Some(time) = time_of_impact_before(kind, &of(x), &of(p), limit) {
                first.fetch_min(time.to_bits(), Relaxed);
            }
        };
        candidates.point_face.par_iter().for_each(|&pair| lower(surface.point_face(pair)));
        candidates.edge_edge.par_iter().for_each(|&pair| lower(surface.edge_edge(pair)));
        let mut first = f64::from_bits(first.into_inner());
        let least = |a: f64, b: f64| if b < a { b } else { a };
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
