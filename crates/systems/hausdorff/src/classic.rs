//! The textbook branch and bound, kept as a baseline and as an independent oracle.
//!
//! Level by level: the lower bound is the largest distance of a vertex so far; the upper bound of a triangle follows from
//! the triangle inequality; triangles that cannot hold the maximum are dropped and the others split into four at the
//! midpoints of their edges. Distances to B are found by asking every face, with a sphere around its centroid as the only
//! shortcut. It shares with [the search](crate) the change of frame, the rounding model and the final certificate of the
//! lower bound, but neither tree, kernel nor bound.
//!
//! It needs pieces as small as the tolerance wherever the two surfaces coincide: do not use it for those.
//!
//! # Source
//! The frame is that of `guthe_fast_2005` and `tang_interactive_2009`, as described in `sacht_cascading_2024`.

use crate::certify;
use crate::engine::{Farthest, Question, conclude, joint_frame};
use crate::observer::{Observer, Progress, RemainingPiece, Stage};
use crate::report::{DirectedReport, Timing, WorkCount};
use glam::DVec3;
use pompeiu_core::geom::Frame;
use pompeiu_core::run::Instant;
use pompeiu_core::run::{Control, StopReason};
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

/// Which corner a triangle's upper bound is taken from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CornerBound {
    /// `max_j (longest edge at v_j + d(v_j, B))`, as first published.
    Greatest,
    /// `min_j (longest edge at v_j + d(v_j, B))`: each corner alone gives a bound, so the least one holds.
    #[default]
    Least,
}

impl CornerBound {
    /// The bound for a triangle with these corners and their distances from B.
    pub fn of(self, corners: &[[f64; 3]; 3], distances: &[f64; 3]) -> f64 {
        let [a, b, c] = corners.map(DVec3::from_array);
        let (ab, bc, ca) = (a.distance(b), b.distance(c), c.distance(a));
        let each = [
            f64::max(ab, ca) + distances[0],
            f64::max(ab, bc) + distances[1],
            f64::max(bc, ca) + distances[2],
        ];
        match self {
            Self::Greatest => each.into_iter().fold(0.0, f64::max),
            Self::Least => each.into_iter().fold(f64::INFINITY, f64::min),
        }
    }
}

/// A face of B with the sphere around it.
struct Ball {
    corners: [DVec3; 3],
    centre: DVec3,
    radius: f64,
}

impl Ball {
    fn around(corners: [[f64; 3]; 3]) -> Self {
        let corners = corners.map(DVec3::from_array);
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let radius = corners.iter().map(|c| c.distance(centre)).fold(0.0, f64::max);
        Self { corners, centre, radius }
    }
}

#[derive(Clone, Copy)]
struct Piece {
    corners: [[f64; 3]; 3],
    distances: [f64; 3],
    face: u32,
    bound: f64,
}

/// Pieces beyond which the search gives up, whatever the memory limit: some 2 GiB.
const MOST_PIECES: usize = 1 << 24;

pub(crate) fn search(question: &Question<'_>, a: &TriMesh, b: &TriMesh) -> DirectedReport {
    let started = Instant::now();
    let observer = question.options.observer();
    let (frame, joint, rounding) = joint_frame(a, b);
    let limits = question.limits(&joint, &frame, rounding);
    let mut stages = question.stages(&limits).into_iter().peekable();
    let control = question.control();
    let corners = |mesh: &TriMesh, f: usize| mesh.corners(FaceId(f as u32)).map(|p| frame.map(p));

    let balls: Vec<Ball> = (0..b.faces().len()).map(|f| Ball::around(corners(b, f))).collect();
    let evaluated = AtomicU64::new(0);
    let distance = |p: [f64; 3]| {
        let (distance, nearest, count) = distance_to_all(DVec3::from_array(p), &balls);
        evaluated.fetch_add(count, Ordering::Relaxed);
        (distance, nearest)
    };
    let build = started.elapsed();

    let mut work = WorkCount::default();
    let mut pieces: Vec<Piece> = (0..a.faces().len())
        .into_par_iter()
        .map(|f| {
            let corners = corners(a, f);
            let distances =
                if control.is_stopped() { [f64::INFINITY; 3] } else { corners.map(|p| distance(p).0) };
            Piece { corners, distances, face: f as u32, bound: 0.0 }
        })
        .collect();
    if pieces.iter().any(|p| p.distances[0] == f64::INFINITY) {
        // Out of time before the first level: coarse bounds take its place.
        return crate::coarse::bound(question, a, b, control.reason().unwrap_or(StopReason::Time));
    }
    work.queries += 3 * pieces.len() as u64;

    let mut best = (f64::NEG_INFINITY, pieces[0].corners[0], 0);
    let mut settled = 0.0;
    loop {
        for piece in &mut pieces {
            for (corner, d) in piece.corners.iter().zip(piece.distances) {
                if d > best.0 {
                    best = (d, *corner, piece.face);
                }
            }
            piece.bound =
                CornerBound::default().of(&piece.corners, &piece.distances) + rounding.bound(work.depth);
        }
        work.pieces += pieces.len() as u64;
        work.distances = evaluated.load(Ordering::Relaxed);
        let lower = best.0;
        let largest = |pieces: &[Piece]| pieces.iter().map(|p| p.bound).fold(settled, f64::max);
        let upper = largest(&pieces);
        while stages.next_if(|stage| upper - lower <= *stage).is_some_and(|stage| {
            report_stage(
                observer,
                question,
                &frame,
                stage,
                limits.diagonal,
                lower,
                upper,
                &pieces,
                &work,
                started,
            );
            true
        }) {}
        let bounds = [lower, upper].map(|length| frame.length_out(length));
        let progress = Progress::new(question.direction, bounds, work.pieces, pieces.len() as u64);
        if observer.progress(&progress) == ControlFlow::Break(()) {
            control.stop(StopReason::Cancelled);
        }
        if limits.threshold.is_some_and(|t| lower - rounding.lower() > t) {
            control.stop(StopReason::Threshold);
        }
        let enough = limits.at(lower, work.depth) + rounding.bound(work.depth);
        pieces.retain(|piece| {
            let keep = piece.bound > enough;
            if !keep {
                settled = f64::max(settled, piece.bound);
            }
            keep
        });
        if 4 * pieces.len() > MOST_PIECES {
            control.stop(StopReason::Memory);
        }
        control.check_memory(5 * pieces.len() * size_of::<Piece>());
        control.check_pieces(4 * pieces.len());
        if pieces.is_empty() || control.is_stopped() {
            break;
        }
        work.cuts += pieces.len() as u64;
        work.queries += 3 * pieces.len() as u64;
        work.depth += 1;
        let parts: Vec<[Piece; 4]> =
            pieces.par_iter().map(|p| quarter(p, |x| distance(x).0, &control)).collect();
        if control.is_stopped() {
            // The parts may be unmeasured; the pieces are not.
            work.depth -= 1;
            break;
        }
        pieces = parts.into_iter().flatten().collect();
    }
    work.distances = evaluated.load(Ordering::Relaxed);

    let (nearest_distance, nearest) = distance(best.1);
    let farthest = Farthest {
        face: FaceId(best.2),
        point: best.1,
        distance: nearest_distance,
        nearest: (FaceId(nearest as u32), corners(b, nearest)),
    };
    let (witness, x) = farthest.witness(a, &frame);
    let lower = certify::distance_lower_bound(x, (0..b.faces().len()).map(|g| corners(b, g)));
    let upper = pieces.iter().map(|p| p.bound).fold(settled, f64::max);
    let (distance, stop, tolerance) = conclude(question, &limits, &frame, lower, upper, control.reason());
    let timing = Timing { build, search: started.elapsed().saturating_sub(build) };
    DirectedReport { distance, witness, stop, tolerance, work, timing }
}

/// Splits at the midpoints of the edges.
fn quarter(piece: &Piece, distance: impl Fn([f64; 3]) -> f64, control: &Control) -> [Piece; 4] {
    let [a, b, c] = piece.corners.map(DVec3::from_array);
    let middles = [a + 0.5 * (b - a), b + 0.5 * (c - b), c + 0.5 * (a - c)].map(|p| p.to_array());
    let far = if control.is_stopped() { [f64::INFINITY; 3] } else { middles.map(distance) };
    let [a, b, c] = piece.corners;
    let [da, db, dc] = piece.distances;
    let part = |corners, distances| Piece { corners, distances, ..*piece };
    [
        part([a, middles[0], middles[2]], [da, far[0], far[2]]),
        part([middles[0], b, middles[1]], [far[0], db, far[1]]),
        part([middles[2], middles[1], c], [far[2], far[1], dc]),
        part(middles, far),
    ]
}

/// Distance from all faces, the nearest, and how many were evaluated.
fn distance_to_all(p: DVec3, balls: &[Ball]) -> (f64, usize, u64) {
    let (mut best, mut nearest, mut evaluated) = (f64::INFINITY, 0, 0);
    for (i, ball) in balls.iter().enumerate() {
        if p.distance(ball.centre) - ball.radius < best {
            evaluated += 1;
            let d = p.distance(closest_point(p, ball.corners));
            if d < best {
                (best, nearest) = (d, i);
            }
        }
    }
    (best, nearest, evaluated)
}

/// The point of a triangle closest to `p`, by the Voronoi region that `p` lies in; see `ericson_collision_2005`,
/// section 5.1.5. Edges are compared by distance instead of by region.
fn closest_point(p: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let normal = ab.cross(ac);
    // For each edge: is p outside it, seen along the normal? Then an edge or a corner is closest.
    let outside = |from: DVec3, to: DVec3| normal.cross(to - from).dot(p - from) < 0.0;
    let area_sq = normal.length_squared();
    if area_sq > 0.0 && !outside(a, b) && !outside(b, c) && !outside(c, a) {
        let v = ap.cross(ac).dot(normal) / area_sq;
        let w = ab.cross(ap).dot(normal) / area_sq;
        let (v, w) = (v.clamp(0.0, 1.0), w.clamp(0.0, 1.0));
        let total = f64::max(v + w, 1.0);
        return a + (v / total) * ab + (w / total) * ac;
    }
    let on = |from: DVec3, to: DVec3| {
        let edge = to - from;
        let t = (p - from).dot(edge) / edge.length_squared();
        if t > 0.0 { if t < 1.0 { from + t * edge } else { to } } else { from }
    };
    let mut best = on(a, b);
    for q in [on(b, c), on(c, a)] {
        if p.distance_squared(q) < p.distance_squared(best) {
            best = q;
        }
    }
    best
}

#[allow(clippy::too_many_arguments, reason = "one call, nothing to group")]
fn report_stage(
    observer: &dyn Observer,
    question: &Question<'_>,
    frame: &Frame,
    tolerance: f64,
    diagonal: f64,
    lower: f64,
    upper: f64,
    pieces: &[Piece],
    work: &WorkCount,
    started: Instant,
) {
    let remaining = pieces.iter().filter(|p| p.bound > lower).map(|p| RemainingPiece {
        face: FaceId(p.face),
        corners: p.corners.map(|x| frame.unmap(x)),
        bound: frame.length_out(p.bound),
    });
    observer.stage(&Stage {
        direction: question.direction,
        tolerance: frame.length_out(tolerance),
        fraction: tolerance / diagonal,
        lower: frame.length_out(lower),
        upper: frame.length_out(upper),
        remaining: remaining.collect(),
        distances: work.distances,
        elapsed: started.elapsed(),
    });
}
