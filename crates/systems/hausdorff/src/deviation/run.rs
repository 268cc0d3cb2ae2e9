//! One direction, from meshes to report.

use super::bounds::{Maximum, Precision};
use super::clusters::Clusters;
use super::faces;
use super::inside::Inside;
use super::linear::{greater, lesser};
use super::maxima::Maxima;
use super::measure;
use super::options::DeviationOptions;
use super::outcome::Outcome;
use super::packed::{Entries, are_packed};
use super::pieces::are_summed;
use super::refine::{Refined, Refinement, RefinementOptions};
use super::regions::Peaks;
use super::report::{DeviationWork, DirectedDeviation, Sides};
use super::signed::{self, Signs};
use super::statistics::{StatisticsQuery, length_out};
use super::task::Faces;
use super::unknown::{Known, unknown};
use crate::engine::{self, Ordered, Question};
use crate::observer::{MeanSoFar, Observer, Progress};
use crate::options::HausdorffOptions;
use crate::prepared::PreparedPair;
use crate::report::{DirectedReport, Direction, StopReason};
use crate::search::Scene;
use crate::target::Target;
use pompeiu_core::TriMesh;
use pompeiu_core::run::Control;
use pompeiu_core::run::Instant;
use std::borrow::Cow;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Two meshes, and what they may take.
pub(super) struct Pair<'p> {
    pub(super) from: &'p TriMesh,
    pub(super) to: &'p TriMesh,
    pub(super) target: &'p Target,
    pub(super) direction: Direction,
    /// From which share of the call to which this direction takes it.
    pub(super) share: [f64; 2],
    pub(super) prepared: &'p PreparedPair<'p>,
    pub(super) deadline: Option<Instant>,
    /// Bytes that entries may take.
    pub(super) room: Option<usize>,
    /// Neighbours across the edges of the other mesh, which is closed and oriented, if inside is to be told from outside.
    pub(super) neighbours: &'p dyn Fn() -> Option<Cow<'p, [[u32; 2]]>>,
}

/// The part of the vertices that must be no farther than what distances are compared with: a few that are far away do not matter.
const MOST_VERTICES: f64 = 0.75;

/// From which share of a direction to which its stages take it, about: as they were measured of a torus of a million faces and a noisy copy.
mod stages {
    pub(super) const SEARCH: [f64; 2] = [0.0, 0.2];
    pub(super) const CUT: [f64; 2] = [0.2, 0.75];
    pub(super) const MAXIMA: [f64; 2] = [0.75, 0.8];
    pub(super) const REGIONS: [f64; 2] = [0.8, 1.0];
}

/// What is left to do when cutting ends takes less than this many times what was done before it began.
const FINISHING: u32 = 2;

pub(super) fn run(query: &DeviationOptions<'_>, pair: &Pair<'_>) -> Outcome {
    let started = Instant::now();
    let Pair { from, to, target, direction, share, prepared, deadline, room, neighbours: across } = *pair;
    let ordered = Ordered::new(from);
    let a_box = ordered.aabb;
    let frame = *target.frame();
    let bvh = target.bvh();
    let rounding = target.rounding_with(&a_box);

    // At most half of the time for the largest distance.
    let half = deadline.map(|end| started + end.saturating_duration_since(started) / 2);
    let observer: &dyn Observer = query.observer.unwrap_or(&());
    let watched = Watched { observer, share, cancelled: AtomicBool::new(false) };
    // What a search takes is counted before (see `memory`).
    let options = HausdorffOptions { observer: Some(&watched), ..HausdorffOptions::default() };
    let question = Question { options: &options, direction, deadline: half };
    let distance =
        engine::search(&question, &ordered, target, Some(to)).at_most(prepared.farthest(direction));
    let search = started.elapsed();
    let largest = frame.length_in(distance.distance.upper()).next_up();

    let refining = Instant::now();
    let floor = DeviationOptions::floor(&frame, &a_box.union(target.aabb()), rounding);
    // Where that does not do, a few points say something of each face.
    let early = Control::default().until(deadline.map(|end| {
        let spare = Clusters::TIME_OF_FACE * from.faces().len() as u32;
        end.checked_sub(spare).unwrap_or(end)
    }));
    if watched.cancelled.load(Ordering::Relaxed) {
        early.stop(StopReason::Cancelled);
    }
    let order = ordered.order;
    let ends = [distance.distance.lower(), distance.distance.upper()];
    let progress = |examined: u64, [done, left]: [u64; 2], stage: [f64; 2]| {
        let of_stage = Progress::new(direction, ends, done, left).as_stage(stage).as_stage(share);
        observer.progress(&Progress { examined, ..of_stage })
    };
    let wants_mean = observer.wants_mean();
    // Before the distances of all vertices, which take longer than the search.
    if wants_mean && let Some(mean) = measure::sampled_mean(from, &frame, bvh, &order) {
        observer.mean(direction, MeanSoFar::Sampled(frame.length_out(mean)));
        if progress(distance.work.queries, [0, order.len() as u64], stages::CUT).is_break() {
            early.stop(StopReason::Cancelled);
        }
    }
    let vertices =
        if early.is_stopped() { None } else { prepared.vertices(direction, &order, target, &early) };
    let Some(vertices) = vertices else {
        let stop = early.reason().unwrap_or(StopReason::Time);
        let is_late = stop == StopReason::Time;
        let clusters = is_late.then(|| Clusters::new(from, &frame, (bvh, rounding), &order, largest));
        let known = Known { distance, clusters, stop };
        let mut outcome = unknown(query, from, &frame, direction, floor, known);
        outcome.report.work.search = search;
        outcome.report.work.refine = refining.elapsed();
        return outcome;
    };
    let neighbours = target.neighbours_in(to);
    let (total, moment) = measure::area_and_moment(from, &frame, &vertices);
    let asked = StatisticsQuery::of(query, &frame);
    let cells = from.faces().len() + to.faces().len();
    let by_default = DeviationOptions::DEFAULT_PIECES.max(DeviationOptions::PIECES_PER_FACE * cells);
    let most_pieces = query.limits.pieces.unwrap_or(by_default);
    let packed = are_packed(query.accuracy, from.faces().len());
    let summed = are_summed(query.accuracy, cells);
    let in_room = room.filter(|_| !summed).map_or(usize::MAX, |room| room / Entries::size(packed));
    let (most_pieces, stop_of_pieces) =
        if in_room < most_pieces { (in_room, StopReason::Memory) } else { (most_pieces, StopReason::Pieces) };
    // Time is left for what follows.
    let finishing = FINISHING * refining.elapsed();
    let control = Control::default().until(deadline.map(|end| end.checked_sub(finishing).unwrap_or(end)));
    let mean = measure::mean_distance(from, &frame, &vertices, bvh, &order, (total, moment));
    let wants_mean = wants_mean && total > 0.0;
    let usual = vertices.quantile(MOST_VERTICES);
    let across = if control.is_stopped() { None } else { across() };
    let inside = across.and_then(|across| Inside::new(to, &across, (bvh, &frame), rounding, &control));
    let inside = inside.filter(|inside| query.signed || inside.is_by_faces());
    let signs = inside.and_then(|inside| Signs::new(inside, (from, to), &frame, &vertices, &control));
    let scene = Faces {
        mesh: from,
        frame: &frame,
        vertices: &vertices,
        bvh,
        neighbours: Some(neighbours),
        rounding,
        control: &control,
        largest,
        scale: if usual > 0.0 { lesser(usual, mean) } else { mean },
        packed,
        signs: signs.as_ref(),
        idle: Mutex::default(),
    };
    let refinement = RefinementOptions {
        asked: &asked,
        accuracy: query.accuracy,
        mean,
        floor,
        total,
        cells,
        most_pieces,
        summed,
    };
    let mut watch = |looks: u64, pieces: usize, left: usize| {
        if pieces + left >= most_pieces {
            control.stop(stop_of_pieces);
        }
        let done = order.len().saturating_sub(left);
        if progress(looks, [done as u64, left as u64], stages::CUT) == ControlFlow::Break(()) {
            control.stop(StopReason::Cancelled);
        }
    };
    let mut tell_mean = |(low, high): (f64, f64)| {
        observer.mean(direction, MeanSoFar::Enclosed(length_out(&frame, low, high)));
    };
    let tell_mean: Option<&mut dyn FnMut((f64, f64))> = if wants_mean { Some(&mut tell_mean) } else { None };
    let refined = Refinement {
        faces: &scene,
        order: &order,
        options: &refinement,
        watch: &mut watch,
        tell_mean,
        known_mean: None,
    }
    .run();
    let Refined { pieces, bounds, summary, tight, looks, distances, rounds } = refined;

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
        neighbours: Some(neighbours),
        control: &control_of_maxima,
    };
    let mut maxima = Maxima {
        scene: &scene,
        vertices: &vertices,
        rounding,
        floor,
        largest,
        of_faces: bounds,
        searched: 0,
    };
    know_farthest(&mut maxima, &distance);
    let tell = |searched: u64, left: usize, stage: [f64; 2]| {
        if progress(looks + searched, [searched, left as u64], stage) == ControlFlow::Break(()) {
            control_of_maxima.stop(StopReason::Cancelled);
        }
    };
    let wide: Vec<u32> = order.iter().copied().filter(|face| maxima.is_wide(*face, Precision::Map)).collect();
    maxima.narrow(&wide, Precision::Map, &mut |searched, left| tell(searched, left, stages::MAXIMA));
    let (regions, beyond_threshold, bounds) = if query.regions > 0 && !control_of_maxima.is_stopped() {
        let mut peaks = Peaks::new(from, target, maxima);
        let mut tell_of_regions = |searched: u64, left: usize| tell(searched, left, stages::REGIONS);
        peaks.settle(query.regions, asked.threshold, &mut tell_of_regions);
        let (regions, beyond_threshold) = peaks.regions(query.regions, asked.threshold);
        (regions, beyond_threshold, peaks.into_bounds())
    } else {
        (Vec::new(), Vec::new(), maxima.of_faces)
    };
    let of_search = Some(distance.stop).filter(|stop| stop.is_early());
    // Of a search that was ended faces may say more.
    let farthest = of_search.map(|_| bounds.iter().fold(0.0, |far, face| greater(far, face.max.upper)));
    let distance = distance.at_most(farthest.map(|far| frame.length_out(far).next_up()));
    let stop = match control.reason().or(control_of_maxima.reason()).or(of_search) {
        Some(reason) => reason,
        _ if tight => StopReason::Tolerance,
        _ => StopReason::Stalled,
    };
    let sides = match &signs {
        _ if control_of_maxima.is_stopped() => None,
        Some(signs) => Some(signs.sides(from, &frame, &vertices, |face| bounds[face].min.0)),
        None => query.signed.then(|| Sides::of((from, to), (bvh, &frame), &vertices, rounding, &control)),
    };
    let areas =
        if summary.is_some() { pieces.measured().cumulative(largest, query.bins) } else { Vec::new() };
    let of_vertices = vertices.distances.iter().map(|distance| frame.length_out(*distance)).collect();
    let statistics = summary.as_ref().map(|s| s.publish(&areas, &asked, query.threshold, largest, &frame));
    let signed = summary.as_ref().zip(statistics.as_ref()).and_then(|(summary, statistics)| {
        let faces = bounds.iter().map(|face| face.signed);
        signed::statistics(faces, summary.area, statistics, largest, &frame)
    });
    let report = DirectedDeviation {
        direction,
        distance,
        statistics,
        signed,
        faces: faces::faces(&frame, &bounds),
        vertices: of_vertices,
        vertex_error: frame.length_out(rounding.lower()),
        sides,
        regions,
        beyond_threshold,
        floor: frame.length_out(floor),
        stop,
        work: DeviationWork {
            pieces: pieces.len(),
            looks,
            distances,
            rounds,
            build: Duration::ZERO,
            search,
            refine: refining.elapsed(),
        },
    };
    Outcome { report, pieces, summary, areas, largest }
}

/// The largest distance of all is that of a face, too, and its witness is on it.
fn know_farthest(maxima: &mut Maxima<'_>, distance: &DirectedReport) {
    let frame = maxima.scene.frame;
    let witness = &distance.witness.from;
    let lower = frame.length_in(distance.distance.lower());
    let maximum: &mut Maximum = &mut maxima.of_faces[witness.face.index()].max;
    if lower > maximum.lower {
        maximum.lower = lesser(lower, maximum.upper);
        maximum.point = frame.map(witness.position);
    }
}

/// Passes on how far the search has come, and hears of its being cancelled.
struct Watched<'o> {
    observer: &'o dyn Observer,
    share: [f64; 2],
    cancelled: AtomicBool,
}

impl Observer for Watched<'_> {
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        let flow = self.observer.progress(&progress.as_stage(stages::SEARCH).as_stage(self.share));
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
