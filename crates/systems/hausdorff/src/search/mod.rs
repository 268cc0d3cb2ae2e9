//! The search: good lower bounds first, then a sweep over all faces by single faces of B, in parts and by overlays, then cover,
//! generate and cut on what is left.
//!
//! Work is dealt out in rounds of tasks whose sizes are counted, never timed. A task sees the lower bound as it was when the
//! round began and what it found itself; results are merged in task order. So the answer does not depend on the number of
//! threads, unless a limit ends the search.

mod bisectors;
mod feet;
mod game;
mod local;
mod overlay;
mod parts;
pub(crate) mod piece;
mod refine;
mod rows;
mod scene;
mod sweep;
mod worker;

pub(crate) use local::{Local, Start, search_each};
pub(crate) use scene::{Limits, Scene};

use crate::observer::{Discard, Observer, Progress, Proof, RemainingPiece, Stage};
use crate::report::{Direction, WorkCount};
use piece::{Piece, longest_edge};
use pompeiu_core::FaceId;
use pompeiu_core::run::Instant;
use pompeiu_core::run::StopReason;
use pompeiu_core::spatial::{Neighbours, Slot, Workspace};
use rayon::prelude::*;
use std::ops::ControlFlow;
use worker::{Discarded, Keep, Outcome, SlotProof, Worker};

pub(crate) use worker::Found;

/// Points of A asked for before the sweep, at most, and for how many faces one of them: a good lower bound makes the sweep
/// discard more.
const SAMPLES: usize = 1024;
const FACES_PER_SAMPLE: usize = 16;
/// One in so many of them comes first where a threshold is given: the others are of use only near it.
const FIRST_SAMPLES: usize = 8;
/// A threshold is far above the distance if samples reach less than this part of it.
const FAR_BELOW: f64 = 0.5;
/// Faces of a sweep task.
const SWEEP_TASK: usize = 256;
/// Samples of a task.
const SAMPLE_TASK: usize = 64;
/// Tasks between two merges.
const TASKS_PER_ROUND: usize = 64;
/// Faces whose sizes are looked at.
const SIZES: usize = 64;
/// Beyond this many edges of both meshes, a distance hides which face of B is over which of A.
const LARGE_DISTANCE: f64 = 2.0;
/// Pieces that are searched at the tolerance asked for at once, and parts of each that was open, on average; what is still open
/// then is searched level by level.
const DIRECT_PIECES: u64 = 2048;
const DIRECT_PARTS: u64 = 4;
/// How much nearer the upper bound comes to the lower one from level to level.
const LEVEL_STEP: f64 = 0.25;
/// Pieces that a task of the search examines at most.
const REFINE_BUDGET: usize = 1024;

/// What a search knows at its end, in units of the frame.
pub(crate) struct Ended {
    /// The farthest point found.
    pub(crate) found: Found,
    /// Proven upper bound.
    pub(crate) upper: f64,
    pub(crate) work: WorkCount,
}

/// A search over all faces: [`Search::sample`] finds a lower bound and so whether overlays are tried, then [`Search::run`] does the rest.
pub(crate) struct Search<'s, 'o> {
    scene: Scene<'s>,
    limits: Limits,
    observer: &'o dyn Observer,
    direction: Direction,
    keep: Keep,
    started: Instant,
    found: Found,
    upper: f64,
    open: Vec<Piece>,
    kept: Vec<Piece>,
    /// Discards that the observer is not told of before it is known that they are final.
    pending: Option<Vec<Discarded>>,
    work: WorkCount,
}

impl<'s, 'o> Search<'s, 'o> {
    pub(crate) fn new(
        scene: Scene<'s>,
        limits: Limits,
        observer: &'o dyn Observer,
        direction: Direction,
    ) -> Self {
        let face = scene.order[0];
        let point = scene.corners(face)[0];
        let nearest = scene.bvh.nearest(point, scene.bvh.any_slot(), &mut Workspace::default());
        let found = Found { distance: nearest.distance_sq.sqrt(), point, face, nearest: nearest.slot };
        let keep = Keep { discards: observer.wants_discards(), pieces: false };
        Self {
            scene,
            limits,
            observer,
            direction,
            keep,
            started: Instant::now(),
            found,
            upper: 0.0,
            open: Vec::new(),
            kept: Vec::new(),
            pending: None,
            work: WorkCount { queries: 1, ..WorkCount::default() },
        }
    }

    /// Searches at each tolerance in turn, and last at that of the limits. Overlays are tried where neighbours are given.
    pub(crate) fn run(mut self, neighbours: Option<&'s Neighbours>, stages: &[f64]) -> Ended {
        let last = self.limits.tolerance;
        self.scene.neighbours = neighbours;
        self.keep.pieces = !stages.is_empty();
        self.limits.tolerance = stages.first().copied().unwrap_or(last);
        self.sweep();
        self.ask_corners();
        for tolerance in stages.iter().copied().chain([last]) {
            self.limits.tolerance = tolerance;
            self.reopen();
            self.refine();
            if self.scene.stopped() {
                break;
            }
            if self.keep.pieces {
                self.tighten();
                self.report_stage(tolerance);
            }
        }
        Ended { found: self.found, upper: self.upper_of_all(), work: self.work }
    }

    /// Opens the pieces that were discarded at a coarser tolerance and cannot be at the present one.
    fn reopen(&mut self) {
        let (limits, lower) = (self.limits, self.found.distance);
        let is_open =
            |piece: &Piece| piece.bound - limits.rounding.bound(piece.depth) > limits.at(lower, piece.depth);
        self.open.extend(self.kept.extract_if(.., |piece| is_open(piece)));
        if let Some(pending) = &mut self.pending {
            pending.retain(|discarded| !is_open(&discarded.piece));
        }
    }

    /// The largest bound of any piece, open or discarded.
    fn upper_of_all(&self) -> f64 {
        let bounds = self.open.iter().chain(&self.kept).map(|piece| piece.bound);
        bounds.fold(self.upper, |upper, bound| if bound > upper { bound } else { upper })
    }

    /// Asks for the distances of a few points: the first lower bound.
    pub(crate) fn sample(&mut self) {
        let order = self.scene.order;
        let stride = order.len().div_ceil(SAMPLES).max(FACES_PER_SAMPLE);
        let samples: Vec<u32> = order.iter().copied().step_by(stride).collect();
        let Some(threshold) = self.limits.threshold else { return self.sample_at(&samples) };
        let (first, others): (Vec<_>, Vec<_>) =
            samples.iter().enumerate().partition(|(i, _)| i % FIRST_SAMPLES == 0);
        for samples in [first, others] {
            self.sample_at(&samples.into_iter().map(|(_, face)| *face).collect::<Vec<_>>());
            if self.scene.stopped() || self.found.distance < FAR_BELOW * threshold {
                break;
            }
        }
    }

    /// Asks for the distances of a corner of each of some faces.
    fn sample_at(&mut self, faces: &[u32]) {
        let outcomes = self.round(faces.chunks(SAMPLE_TASK), |worker, faces| {
            let scene = worker.scene();
            // One corner each, and not always the first: samples then also differ inside fans.
            let points = faces.iter().map(|&f| (f, scene.corners(f)[f as usize % 3]));
            worker.sample(points, scene.bvh.any_slot());
        });
        self.merge(outcomes);
        self.report_progress(self.scene.order.len() as u64);
    }

    /// Whether overlays are worth the neighbours of B's triangles: not where faces are so small for the distance, or for the threshold,
    /// that one of B mostly covers one of A.
    pub(crate) fn tries_overlays(&self) -> bool {
        // Steps come before corners: only those of the faces that are looked at are read.
        let stride = |count: usize| count.div_ceil(SIZES);
        let mean = |count: usize, corners: &mut dyn Iterator<Item = [[f64; 3]; 3]>| {
            corners.map(|corners| longest_edge(&corners)).sum::<f64>() / count.div_ceil(stride(count)) as f64
        };
        let Scene { order, bvh, .. } = self.scene;
        let some_of_a = order.iter().step_by(stride(order.len()));
        let size_a = mean(order.len(), &mut some_of_a.map(|face| self.scene.corners(*face)));
        let some_of_b = bvh.slots().step_by(stride(bvh.len()));
        let size_b = mean(bvh.len(), &mut some_of_b.map(|slot| bvh.corners(slot)));
        let distance = match self.limits.threshold {
            Some(threshold) if threshold > self.found.distance => threshold,
            _ => self.found.distance,
        };
        distance < LARGE_DISTANCE * (size_a + size_b)
    }

    fn sweep(&mut self) {
        let order = self.scene.order;
        for (i, faces) in order.chunks(SWEEP_TASK * TASKS_PER_ROUND).enumerate() {
            #[allow(
                clippy::redundant_closure_for_method_calls,
                reason = "the method alone is not general enough"
            )]
            let outcomes = self.round(faces.chunks(SWEEP_TASK), |worker, faces| worker.sweep(faces));
            self.merge(outcomes);
            let done = i * SWEEP_TASK * TASKS_PER_ROUND + faces.len();
            self.report_progress((order.len() - done) as u64);
        }
    }

    /// Exact distances at the corners of the faces that are left: cheap, and the maximum is often there. Faces of B that are nearest to
    /// corners are what pieces start from.
    fn ask_corners(&mut self) {
        if self.open.iter().all(|piece| piece.depth > 0) {
            return;
        }
        let lower = self.found.distance;
        let mut nearest = vec![None; self.scene.a.positions().len()];
        let mut corners = Vec::new();
        for piece in self.open.iter().filter(|p| p.depth == 0) {
            for (vertex, corner) in self.scene.a.faces()[piece.face as usize].into_iter().zip(piece.corners) {
                let nearest = &mut nearest[vertex as usize];
                if nearest.is_none() {
                    *nearest = Some(piece.near[0]);
                    if self.scene.bvh.distance_sq(corner, piece.near[0]) > lower * lower {
                        corners.push((piece.face, vertex, corner, piece.near[0]));
                    }
                }
            }
        }
        for corners in corners.chunks(SAMPLE_TASK * TASKS_PER_ROUND) {
            let mut outcomes = self.round(corners.chunks(SAMPLE_TASK), |worker, corners| {
                for &(face, _, corner, hint) in corners {
                    worker.sample(std::iter::once((face, corner)), hint);
                }
            });
            let found = outcomes.iter_mut().flat_map(|outcome| std::mem::take(&mut outcome.nearest));
            for ((_, vertex, ..), slot) in corners.iter().zip(found) {
                nearest[*vertex as usize] = Some(slot);
            }
            self.merge(outcomes);
        }
        for piece in self.open.iter_mut().filter(|p| p.depth == 0) {
            for vertex in self.scene.a.faces()[piece.face as usize] {
                piece.also_near(nearest[vertex as usize]);
            }
        }
    }

    fn refine(&mut self) {
        // The most promising first: they raise the lower bound for the others. The order of equal bounds follows from that
        // before, which does not depend on threads; keeping it would take a copy of the pieces.
        self.open.sort_unstable_by(|p, q| q.bound.total_cmp(&p.bound));
        let direct = DIRECT_PIECES + DIRECT_PARTS * self.open.len() as u64;
        self.refine_open(self.work.pieces + direct);
        if !self.open.is_empty() && !self.scene.stopped() {
            self.refine_by_levels();
        }
    }

    /// Works on the open pieces until there are none, or until so many pieces were examined since the start.
    fn refine_open(&mut self, most: u64) {
        while !self.open.is_empty() && !self.scene.stopped() && self.work.pieces < most {
            let open = std::mem::take(&mut self.open);
            let task = open.len().div_ceil(TASKS_PER_ROUND);
            let outcomes =
                self.round(open.chunks(task), |worker, pieces| worker.refine(pieces, REFINE_BUDGET));
            drop(open);
            self.merge(outcomes);
            self.report_progress(0);
        }
    }

    /// Lowers the bounds of all open pieces step by step: a search that takes this long may be ended by a limit, and what was left
    /// aside while another piece was searched to the last digit would then decide the upper bound.
    fn refine_by_levels(&mut self) {
        let (asked, keep) = (self.limits.tolerance, self.keep.pieces);
        self.keep.pieces = true;
        self.pending = Some(Vec::new());
        let mut level = f64::INFINITY;
        loop {
            let lower = self.found.distance;
            // Pieces too small to cut keep bounds above any level: levels descend in any case.
            let gap = self.upper_of_all() - lower;
            level = LEVEL_STEP * if gap < level { gap } else { level };
            let last = level <= self.limits.reach(lower);
            self.limits.tolerance = if last { asked } else { level };
            self.reopen();
            self.refine_open(u64::MAX);
            self.limits.tolerance = asked;
            if last || self.scene.stopped() {
                break;
            }
        }
        for discarded in self.pending.take().into_iter().flatten() {
            self.observer.discard(&self.describe(&discarded));
        }
        self.keep.pieces = keep;
        if !keep {
            for piece in self.kept.drain(..) {
                self.upper = if piece.bound > self.upper { piece.bound } else { self.upper };
            }
        }
    }

    /// Bounds what was kept as well as one query each allows, and lets go of what cannot hold the maximum any more: the
    /// sweep was content with any bound within the tolerance.
    fn tighten(&mut self) {
        let kept = std::mem::take(&mut self.kept);
        for kept in kept.chunks(SWEEP_TASK * TASKS_PER_ROUND) {
            #[allow(
                clippy::redundant_closure_for_method_calls,
                reason = "the method alone is not general enough"
            )]
            let outcomes = self.round(kept.chunks(SWEEP_TASK), |worker, pieces| worker.tighten(pieces));
            self.merge(outcomes);
        }
        let lower = self.found.distance;
        for settled in self.kept.extract_if(.., |piece| piece.bound <= lower) {
            self.upper = if settled.bound > self.upper { settled.bound } else { self.upper };
        }
    }

    /// Runs one task per part on the threads of the current pool.
    fn round<'p, T: Sync + 'p>(
        &self,
        parts: impl Iterator<Item = &'p [T]>,
        task: impl Fn(&mut Worker<'_>, &'p [T]) + Sync,
    ) -> Vec<Outcome> {
        let parts: Vec<&[T]> = parts.collect();
        let (scene, limits, keep, lower) = (&self.scene, self.limits, self.keep, self.found.distance);
        parts
            .into_par_iter()
            .with_max_len(1)
            .map(|part| {
                let mut worker = Worker::new(scene, limits, keep, lower);
                task(&mut worker, part);
                worker.finish()
            })
            .collect()
    }

    fn merge(&mut self, outcomes: Vec<Outcome>) {
        for mut outcome in outcomes {
            if let Some(found) = outcome.found.filter(|f| f.distance > self.found.distance) {
                self.found = found;
            }
            self.upper = if outcome.upper > self.upper { outcome.upper } else { self.upper };
            self.open.append(&mut outcome.open);
            self.kept.append(&mut outcome.kept);
            self.work.add(&outcome.work);
            match &mut self.pending {
                Some(pending) => pending.append(&mut outcome.discarded),
                None => {
                    for discarded in &outcome.discarded {
                        self.observer.discard(&self.describe(discarded));
                    }
                }
            }
        }
    }

    /// Between rounds: reports progress, and checks the limits.
    fn report_progress(&mut self, faces_left: u64) {
        let pieces = self.open.len() + self.kept.len();
        self.scene.control.check_memory(pieces * size_of::<Piece>());
        self.scene.control.check_pieces(pieces);
        let out = |length| self.scene.frame.length_out(length);
        let lower = self.found.distance;
        let mut upper = if self.upper > lower { self.upper } else { lower };
        for piece in &self.open {
            upper = if piece.bound > upper { piece.bound } else { upper };
        }
        let left = faces_left + self.open.len() as u64;
        let progress = Progress::new(self.direction, [out(lower), out(upper)], self.work.pieces, left);
        if self.observer.progress(&progress) == ControlFlow::Break(()) {
            self.scene.control.stop(StopReason::Cancelled);
        }
        let decided = self.limits.threshold.is_some_and(|t| lower - self.limits.rounding.lower() > t);
        if decided {
            self.scene.control.stop(StopReason::Threshold);
        }
    }

    fn report_stage(&mut self, tolerance: f64) {
        let lower = self.found.distance;
        let mut upper = self.upper;
        let mut remaining = Vec::new();
        for piece in self.kept.iter().chain(&self.open) {
            upper = if piece.bound > upper { piece.bound } else { upper };
            remaining.push(RemainingPiece {
                face: FaceId(piece.face),
                corners: piece.corners.map(|p| self.scene.frame.unmap(p)),
                bound: self.scene.frame.length_out(piece.bound),
            });
        }
        let out = |length| self.scene.frame.length_out(length);
        let stage = Stage {
            direction: self.direction,
            tolerance: out(tolerance),
            fraction: tolerance / self.limits.diagonal,
            lower: out(lower),
            upper: out(upper),
            remaining,
            distances: self.work.distances,
            elapsed: self.started.elapsed(),
        };
        self.observer.stage(&stage);
    }

    fn describe(&self, discarded: &Discarded) -> Discard {
        let face = |slot: Slot| self.scene.bvh.face(slot);
        Discard {
            face: FaceId(discarded.piece.face),
            corners: discarded.piece.corners.map(|p| self.scene.frame.unmap(p)),
            proof: match &discarded.proof {
                SlotProof::Face(slot) => Proof::Face(face(*slot)),
                SlotProof::Mixture(mixture) => {
                    Proof::Mixture(mixture.iter().map(|(slot, weight)| (face(*slot), *weight)).collect())
                }
            },
            bound: self.scene.frame.length_out(discarded.piece.bound),
        }
    }
}
