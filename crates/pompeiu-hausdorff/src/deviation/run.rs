//! One direction, from meshes to report.

use super::distribution::{Distribution, Entry, area_of};
use super::envelope::Piece;
use super::faces;
use super::linear::{greater, lesser};
use super::query::DeviationQuery;
use super::regions::Landscape;
use super::report::{DeviationWork, DirectedDeviation, Field, Sides};
use super::rounds::{Goal, Made, Workshop};
use super::statistics::{Summary, Wanted};
use crate::engine::{self, Question};
use crate::observer::{Observer, Progress};
use crate::report::{Direction, StopReason};
use crate::rounding::Rounding;
use crate::search::{Control, Halt};
use crate::target::Target;
use crate::tolerance::Tolerance;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::spatial::{Bvh, Workspace, morton_order};
use pompeiu_core::{FaceId, TriMesh};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Two meshes, and the frame of both.
pub(super) struct Pair<'p> {
    pub(super) from: &'p TriMesh,
    pub(super) to: &'p TriMesh,
    pub(super) target: &'p Target,
    pub(super) direction: Direction,
    pub(super) deadline: Option<Instant>,
}

/// A report, and what it takes to put two together.
pub(super) struct Outcome {
    pub(super) report: DirectedDeviation,
    pub(super) distribution: Distribution,
    pub(super) summary: Option<Summary>,
}

/// Faces whose distance is looked at to know about how far all are.
const SAMPLES: usize = 2048;
/// Pieces of one root in the first round, and in later ones.
const FIRST_PIECES: usize = 1024;
const LATER_PIECES: usize = 256;
/// The width of pieces at first, as a part of what the mean is allowed: most pieces come out much better.
const FIRST_PART: f64 = 2.0;
/// How much finer each round is.
const FINER: f64 = 0.5;
/// Part of the allowed width of the mean that pieces which are not cut for being negligible may use up, one for each face.
const NEGLIGIBLE: f64 = 0.05;
/// Rounds that make only statistics of parts of the distribution narrower.
const FOCUSED_ROUNDS: u32 = 12;
/// A focused round must narrow what is not yet narrow enough by this factor, or it was the last.
const LEAST_PROGRESS: f64 = 0.95;

pub(super) fn run(query: &DeviationQuery, pair: &Pair<'_>, observer: &mut dyn Observer) -> Outcome {
    let started = Instant::now();
    let Pair { from, to, target, direction, deadline } = *pair;
    let a_box = Aabb::of_faces(from);
    let frame = *target.frame();
    let bvh = target.bvh();
    let rounding = Rounding::new(target.max_coordinate_with(&a_box));
    let diagonal = frame.length_in(a_box.union(target.aabb()).diagonal());

    // At most half of the time for the largest distance.
    let half = deadline.map(|end| started + end.saturating_duration_since(started) / 2);
    let question = Question {
        direction,
        tolerance: Tolerance::default(),
        threshold: None,
        deadline: half,
        memory_limit: query.memory_limit,
        stages: &[],
    };
    let mut watched = Watched { observer, cancelled: false };
    let distance = engine::search(&question, from, target, Some(to), &mut watched);
    let search = started.elapsed();
    let largest = frame.length_in(distance.distance.upper()).next_up();

    let refining = Instant::now();
    let order = morton_order(from, &a_box);
    let areas = faces::areas(from, &frame);
    let rounded: Vec<f64> = areas.iter().map(|(low, high)| 0.5 * (low + high)).collect();
    let total: f64 = rounded.iter().sum();
    let control =
        Control::new(deadline, query.memory_limit.map(|most| most.saturating_sub(held(from, target))));
    if watched.cancelled {
        control.halt(Halt::Cancelled);
    }
    let shop = Workshop { bvh, rounding, control: &control, areas: &rounded };
    let floor = query.floor * diagonal + 4.0 * rounding.bound(0);
    let wanted = Wanted {
        percentiles: &query.percentiles,
        threshold: query.threshold.map(|t| frame.length_in(t)),
        bins: query.bins,
    };

    let mut refinery = Refinery {
        query,
        shop: &shop,
        areas: &areas,
        wanted: &wanted,
        floor,
        largest,
        total,
        made: Made::default(),
        rounds: 0,
        watch: &mut |made: &Made, left: usize| {
            control.mind_memory(made.pieces.len() * PIECE_BYTES);
            if made.pieces.len() + left >= query.most_pieces {
                control.halt(Halt::Memory);
            }
            let progress = Progress {
                direction,
                lower: distance.distance.lower(),
                upper: distance.distance.upper(),
                examined: made.looks,
                left: left as u64,
            };
            if watched.observer.progress(&progress) == ControlFlow::Break(()) {
                control.halt(Halt::Cancelled);
            }
        },
    };
    let roots: Vec<Piece> = order
        .iter()
        .map(|f| Piece::whole(*f, from.corners(FaceId(*f)).map(|p| frame.map(p)), bvh.any_slot(), largest))
        .collect();
    let scale = mean_of_samples(&roots, &rounded, bvh);
    let (distribution, summary, tight) = refinery.run(roots, scale);
    let (made, rounds) = (refinery.made, refinery.rounds);

    let stop = match control.why() {
        Some(Halt::Time) => StopReason::Time,
        Some(Halt::Memory) => StopReason::Memory,
        Some(Halt::Cancelled) => StopReason::Cancelled,
        _ if tight => StopReason::Tolerance,
        _ => StopReason::Rounding,
    };
    let mut work = DeviationWork {
        pieces: made.pieces.len() as u64,
        looks: made.looks,
        distances: made.distances,
        rounds,
        build: Duration::ZERO,
        search,
        refine: Duration::ZERO,
    };
    let field = Field::new(frame, &made.pieces, from.faces().len(), largest, areas);
    let landscape = (query.regions > 0).then(|| Landscape::new(from, &field, bvh));
    let regions = landscape.as_ref().map(|l| l.peaks(query.regions)).unwrap_or_default();
    let beyond_threshold = match (&landscape, wanted.threshold) {
        (Some(landscape), Some(t)) => landscape.above(t, query.regions),
        _ => Vec::new(),
    };
    let vertices = faces::vertices(from, &frame, bvh, &order);
    let sides = query.signed.then(|| Sides::of(from, to));
    work.refine = refining.elapsed();
    let report = DirectedDeviation {
        direction,
        distance,
        statistics: summary
            .as_ref()
            .map(|s| s.publish(&distribution, &wanted, query.threshold, largest, &frame)),
        faces: faces::faces(&field),
        vertices,
        vertex_error: frame.length_out(rounding.lower()),
        sides,
        regions,
        beyond_threshold,
        stop,
        work,
        field,
    };
    Outcome { report, distribution, summary }
}

/// Bytes for each piece: itself and its copy in order, and what statistics make of it.
const PIECE_BYTES: usize = 2 * size_of::<Piece>() + size_of::<Entry>();

fn held(from: &TriMesh, target: &Target) -> usize {
    const PER_FACE: usize = 64;
    size_of_val(from.positions()) + size_of_val(from.faces()) + target.bytes() + from.faces().len() * PER_FACE
}

/// The mean distance of the centres of some faces, by area.
fn mean_of_samples(roots: &[Piece], areas: &[f64], bvh: &Bvh) -> f64 {
    let mut workspace = Workspace::default();
    let mut hint = bvh.any_slot();
    let (mut area, mut sum) = (0.0, 0.0);
    for root in roots.iter().step_by(roots.len().div_ceil(SAMPLES)) {
        let [p, q, r] = root.corners;
        let centre = [0, 1, 2].map(|k| (p[k] + q[k] + r[k]) * (1.0 / 3.0));
        let nearest = bvh.nearest(centre, hint, &mut workspace);
        hint = nearest.slot;
        area += areas[root.face as usize];
        sum += areas[root.face as usize] * nearest.distance_sq.sqrt();
    }
    if area > 0.0 { sum / area } else { 0.0 }
}

/// Hears of a search being cancelled.
struct Watched<'o> {
    observer: &'o mut dyn Observer,
    cancelled: bool,
}

impl Observer for Watched<'_> {
    fn progress(&mut self, progress: &Progress) -> ControlFlow<()> {
        let flow = self.observer.progress(progress);
        self.cancelled |= flow.is_break();
        flow
    }
}

struct Refinery<'r, 'w> {
    query: &'r DeviationQuery,
    shop: &'r Workshop<'w>,
    areas: &'r [(f64, f64)],
    wanted: &'r Wanted<'r>,
    floor: f64,
    largest: f64,
    total: f64,
    made: Made,
    rounds: u32,
    watch: &'r mut dyn FnMut(&Made, usize),
}

impl Refinery<'_, '_> {
    /// Returns the distribution, what it says, and whether that is as narrow as asked.
    fn run(&mut self, roots: Vec<Piece>, scale: f64) -> (Distribution, Option<Summary>, bool) {
        let accuracy = self.query.accuracy;
        let mut goal = Goal {
            relative: FIRST_PART * accuracy,
            scale,
            floor: self.floor,
            negligible: 0.0,
            focus: Vec::new(),
            focus_relative: f64::INFINITY,
        };
        let faces = roots.len() as f64;
        goal.negligible = NEGLIGIBLE * goal.allowed(goal.scale) * self.total / faces;
        self.refine(&roots, &goal, FIRST_PIECES);
        drop(roots);
        let mut focused_rounds = 0;
        let mut doubt_before = f64::INFINITY;
        loop {
            let distribution = self.distribution();
            let Some(summary) = Summary::of(&distribution, self.wanted, self.largest) else {
                return (distribution, None, true);
            };
            let within = |(low, high): (f64, f64)| high - low <= accuracy * low + self.floor;
            let means_are_tight = within(summary.mean) && within(summary.rms);
            let doubt = self.doubt(&summary);
            let focus = self.focus(&summary);
            if self.shop.control.halted() || means_are_tight && focus.is_empty() {
                let tight = means_are_tight && focus.is_empty();
                return (distribution, Some(summary), tight);
            }
            goal.scale = 0.5 * (summary.mean.0 + summary.mean.1);
            if means_are_tight {
                let stuck = doubt > LEAST_PROGRESS * doubt_before;
                if focused_rounds == FOCUSED_ROUNDS || stuck {
                    return (distribution, Some(summary), false);
                }
                doubt_before = doubt;
                let before = if focused_rounds == 0 { accuracy } else { goal.focus_relative };
                goal.focus_relative = FINER * before;
                goal.focus = focus;
                focused_rounds += 1;
            } else {
                goal.relative *= FINER;
                goal.negligible = NEGLIGIBLE * goal.allowed(goal.scale) * self.total / faces;
            }
            drop(distribution);
            let (open, good): (Vec<Piece>, Vec<Piece>) = std::mem::take(&mut self.made.pieces)
                .into_iter()
                .partition(|piece| goal.wanted(piece, self.shop.areas[piece.face as usize]).is_some());
            self.made.pieces = good;
            if open.is_empty() && goal.relative < f64::EPSILON {
                let distribution = self.distribution();
                let summary = Summary::of(&distribution, self.wanted, self.largest);
                return (distribution, summary, false);
            }
            self.refine(&open, &goal, LATER_PIECES);
        }
    }

    fn refine(&mut self, roots: &[Piece], goal: &Goal, most: usize) {
        self.rounds += 1;
        self.shop.refine(roots, goal, most, &mut self.made, &mut *self.watch);
    }

    fn distribution(&self) -> Distribution {
        let entry = |piece: &Piece| Entry {
            lower: piece.lower,
            upper: piece.upper,
            area: area_of(piece, self.areas[piece.face as usize]),
        };
        Distribution { entries: self.made.pieces.iter().map(entry).collect() }
    }

    /// Ranges of distances in which pieces keep a statistic from being as narrow as asked.
    fn focus(&self, summary: &Summary) -> Vec<(f64, f64)> {
        let accuracy = self.query.accuracy;
        let mut focus: Vec<(f64, f64)> = summary
            .percentiles
            .iter()
            .copied()
            .filter(|(low, high)| high - low > accuracy * low + self.floor)
            .collect();
        if let Some(((low, high), threshold)) = summary.above.zip(self.wanted.threshold)
            && high - low > accuracy
        {
            focus.push((threshold, threshold));
        }
        focus
    }

    /// Sum of the widths that are too great, each relative to what is allowed.
    fn doubt(&self, summary: &Summary) -> f64 {
        let accuracy = self.query.accuracy;
        let excess = |width: f64, allowed: f64| greater(width / allowed - 1.0, 0.0);
        let percentiles = summary.percentiles.iter();
        let of_percentiles: f64 =
            percentiles.map(|(low, high)| excess(high - low, accuracy * low + self.floor)).sum();
        of_percentiles + summary.above.map_or(0.0, |(low, high)| excess(high - low, accuracy))
    }
}

/// The frame of both meshes.
pub(super) fn joint_frame(a: &TriMesh, b: &TriMesh) -> Frame {
    Frame::of(&Aabb::of_faces(a).union(Aabb::of_faces(b)))
}

/// The greater of two enclosed percentiles.
pub(super) fn greater_of(x: (f64, f64), y: (f64, f64)) -> (f64, f64) {
    (greater(x.0, y.0), lesser(greater(x.1, y.1), f64::MAX))
}
