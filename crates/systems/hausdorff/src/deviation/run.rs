//! One direction, from meshes to report.

use super::distribution::{Distribution, Entry};
use super::envelope::Piece;
use super::faces;
use super::linear::{greater, lesser};
use super::maxima::{self, Care, Maxima, Maximum};
use super::options::DeviationOptions;
use super::refinery::Refinery;
use super::regions::Landscape;
use super::report::{DeviationWork, DirectedDeviation, Field, Sides};
use super::rounds::{Made, Workshop};
use super::statistics::{Summary, Wanted};
use crate::engine::{self, Question};
use crate::observer::{Observer, Progress};
use crate::options::HausdorffOptions;
use crate::report::{DirectedReport, Direction, StopReason};
use crate::rounding::Rounding;
use crate::search::Scene;
use crate::target::Target;
use pompeiu_core::geom::Aabb;
use pompeiu_core::run::{Control, Limits};
use pompeiu_core::spatial::{Bvh, Workspace, morton_order};
use pompeiu_core::{FaceId, TriMesh};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
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
pub(super) fn run(query: &DeviationOptions<'_>, pair: &Pair<'_>) -> Outcome {
    let started = Instant::now();
    let Pair { from, to, target, direction, deadline } = *pair;
    let a_box = Aabb::of_faces(from);
    let frame = *target.frame();
    let bvh = target.bvh();
    let rounding = Rounding::new(target.max_coordinate_with(&a_box));
    let diagonal = frame.length_in(a_box.union(target.aabb()).diagonal());

    // At most half of the time for the largest distance.
    let half = deadline.map(|end| started + end.saturating_duration_since(started) / 2);
    let observer: &dyn Observer = query.observer.unwrap_or(&());
    let watched = Watched { observer, cancelled: AtomicBool::new(false) };
    let options = HausdorffOptions {
        limits: Limits { memory: query.limits.memory, ..Limits::default() },
        observer: Some(&watched),
        ..HausdorffOptions::default()
    };
    let question = Question { options: &options, direction, deadline: half };
    let distance = engine::search(&question, from, target, Some(to));
    let search = started.elapsed();
    let largest = frame.length_in(distance.distance.upper()).next_up();

    let refining = Instant::now();
    let order = morton_order(from, &a_box);
    let areas = faces::areas(from, &frame);
    let rounded: Vec<f64> = areas.iter().map(|(low, high)| 0.5 * (low + high)).collect();
    let total: f64 = rounded.iter().sum();
    let control = Control::start(&query.limits).until(deadline).holding(held(from, target));
    if watched.cancelled.into_inner() {
        control.stop(StopReason::Cancelled);
    }
    let shop = Workshop { bvh, rounding, control: &control, areas: &rounded };
    let floor = DeviationOptions::FLOOR * diagonal + 4.0 * rounding.bound(0);
    let wanted = Wanted {
        percentiles: &query.percentiles,
        threshold: query.threshold.map(|t| frame.length_in(t)),
        bins: query.bins,
    };

    let most_pieces = query.limits.pieces.unwrap_or(DeviationOptions::DEFAULT_PIECES);
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
            control.check_memory(made.pieces.len() * PIECE_BYTES);
            if made.pieces.len() + left >= most_pieces {
                control.stop(StopReason::Pieces);
            }
            let progress = Progress {
                direction,
                lower: distance.distance.lower(),
                upper: distance.distance.upper(),
                examined: made.looks,
                left: left as u64,
            };
            if observer.progress(&progress) == ControlFlow::Break(()) {
                control.stop(StopReason::Cancelled);
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
    // A limit on pieces or memory does not keep maxima from being narrowed: that takes neither.
    let control_of_maxima = Control::default().until(deadline);
    if control.reason() == Some(StopReason::Cancelled) {
        control_of_maxima.stop(StopReason::Cancelled);
    }
    let scene = Scene {
        a: from,
        order: &order,
        frame: &frame,
        bvh,
        b: Some(to),
        neighbours: target.neighbours(),
        overlays: true,
        control: &control_of_maxima,
    };
    let mut maxima =
        Maxima { scene: &scene, rounding, floor, largest, of_faces: maxima::of_pieces(&field), searched: 0 };
    know_farthest(&mut maxima, &distance);
    let mut tell = |searched: u64, left: usize| {
        let progress = Progress {
            direction,
            lower: distance.distance.lower(),
            upper: distance.distance.upper(),
            examined: made.looks + searched,
            left: left as u64,
        };
        if observer.progress(&progress) == ControlFlow::Break(()) {
            control_of_maxima.stop(StopReason::Cancelled);
        }
    };
    let wide: Vec<u32> = order.iter().copied().filter(|face| maxima.is_wide(*face, Care::Map)).collect();
    maxima.narrow(&wide, Care::Map, &mut tell);
    let (regions, beyond_threshold, maxima) = if query.regions > 0 {
        let mut landscape = Landscape::new(from, &field, maxima);
        landscape.settle(query.regions, wanted.threshold, &mut tell);
        let (regions, beyond_threshold) = landscape.regions(query.regions, wanted.threshold);
        (regions, beyond_threshold, landscape.into_maxima())
    } else {
        (Vec::new(), Vec::new(), maxima.of_faces)
    };
    let stop = match control.reason().or(control_of_maxima.reason()) {
        Some(reason) => reason,
        _ if tight => StopReason::Tolerance,
        _ => StopReason::Rounding,
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
        faces: faces::faces(&field, &maxima),
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

/// The largest distance of all is that of a face, too, and its witness is on it.
fn know_farthest(maxima: &mut Maxima<'_>, distance: &DirectedReport) {
    let frame = maxima.scene.frame;
    let witness = &distance.witness.from;
    let lower = frame.length_in(distance.distance.lower());
    let maximum: &mut Maximum = &mut maxima.of_faces[witness.face.index()];
    if lower > maximum.lower {
        maximum.lower = lesser(lower, maximum.upper);
        maximum.point = frame.map(witness.position);
    }
}

/// Bytes for each piece: itself and its copy in order, and what statistics make of it.
const PIECE_BYTES: usize = 2 * size_of::<Piece>() + size_of::<Entry>();

fn held(from: &TriMesh, target: &Target) -> usize {
    const PER_FACE: usize = 64 + size_of::<Maximum>();
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
    observer: &'o dyn Observer,
    cancelled: AtomicBool,
}

impl Observer for Watched<'_> {
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        let flow = self.observer.progress(progress);
        if flow.is_break() {
            self.cancelled.store(true, Ordering::Relaxed);
        }
        flow
    }
}

/// The greater of two enclosed percentiles.
pub(super) fn greater_of(x: (f64, f64), y: (f64, f64)) -> (f64, f64) {
    (greater(x.0, y.0), lesser(greater(x.1, y.1), f64::MAX))
}
