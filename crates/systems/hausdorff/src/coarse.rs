//! A valid enclosure in linear time and almost no memory, where a search is not possible or not needed.

use crate::certify;
use crate::engine::{Farthest, Question, conclude, joint_frame};
use crate::report::{DirectedReport, StopReason, Timing, WorkCount};
use pompeiu_core::geom::point_triangle::{distance_sq, four_points_distances_sq};
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::run::Instant;
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;

/// Faces of B that bound all of A from above.
const FACES: usize = 16;
/// Faces of A that are bounded together, by the box about them.
const TOGETHER: usize = 16;
/// Points of A that are measured against all of B.
const POINTS: usize = 4;
/// Faces of B that one task measures.
const TASK: usize = 1 << 12;

/// Bounds `h(A, B)` without a tree: from above by the best of a few faces of B for each box about a few faces of A, from below by
/// the farthest of a few corners of A. Linear time, no allocation that grows with the meshes.
///
/// `instead` is why there is no search.
pub(crate) fn bound(
    question: &Question<'_>,
    a: &TriMesh,
    b: &TriMesh,
    instead: StopReason,
) -> DirectedReport {
    bound_by([FACES, POINTS], question, a, b, instead)
}

/// The same by the least work, where there is no time left: nothing is proven from below.
pub(crate) fn bound_quickly(
    question: &Question<'_>,
    a: &TriMesh,
    b: &TriMesh,
    instead: StopReason,
) -> DirectedReport {
    bound_by([1; 2], question, a, b, instead)
}

fn bound_by(
    [faces, points]: [usize; 2],
    question: &Question<'_>,
    a: &TriMesh,
    b: &TriMesh,
    instead: StopReason,
) -> DirectedReport {
    let started = Instant::now();
    let (frame, joint, rounding) = joint_frame(a, b);
    let limits = question.limits(&joint, &frame, rounding);
    let (upper, bounded) = upper(faces, a, b, &frame);
    let farthest = farthest(points, a, b, &frame);
    let (witness, x) = farthest.witness(a, &frame);
    let lower = if points > 1 {
        // Triangles that are farther than this from the middle are farther than what is claimed from x.
        let (middle, reach) = (certify::middle(&x), farthest.distance + 8.0 * rounding.lower());
        let near = (0..b.faces().len()).map(|g| corners(b, &frame, g));
        let near = near.filter(|c| distance(middle, *c) <= reach);
        f64::min(certify::distance_lower_bound(x, near), farthest.distance)
    } else {
        0.0
    };
    let stopped = Some(instead).filter(|reason| matches!(reason, StopReason::Time | StopReason::Cancelled));
    let (distance, stop, tolerance) =
        conclude(question, &limits, &frame, lower, upper + rounding.bound(0), stopped);
    // A bound that is as good as asked needs no search.
    let stop = if stop == StopReason::Rounding { instead } else { stop };
    let work = WorkCount {
        distances: bounded + (points * b.faces().len()) as u64,
        pieces: a.faces().len() as u64,
        ..WorkCount::default()
    };
    let timing = Timing { search: started.elapsed(), ..Timing::default() };
    DirectedReport { distance, witness, stop, tolerance, work, timing }
}

fn corners(mesh: &TriMesh, frame: &Frame, f: usize) -> [[f64; 3]; 3] {
    mesh.corners(FaceId(f as u32)).map(|p| frame.map(p))
}

fn distance(p: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> f64 {
    distance_sq(p, a, b, c).sqrt()
}

/// The faces of B that all of A is bounded by.
pub(crate) fn few_of(b: &TriMesh) -> impl Iterator<Item = usize> {
    some_of(b, FACES)
}

fn some_of(b: &TriMesh, count: usize) -> impl Iterator<Item = usize> {
    let m_b = b.faces().len();
    (0..m_b).step_by(m_b.div_ceil(count))
}

/// The least bound that a few faces of B give on all of A, but for rounding, and how many distances that took. The distance from a
/// triangle is convex, so its maximum over a box, which holds a few faces of A, is at a corner.
fn upper(faces: usize, a: &TriMesh, b: &TriMesh, frame: &Frame) -> (f64, u64) {
    let m_a = a.faces().len();
    let few: Vec<_> = some_of(b, faces).map(|g| corners(b, frame, g)).collect();
    let greater = |x: f64, y: f64| if x > y { x } else { y };
    let over = |points: &[[f64; 4]; 3], face: [[f64; 3]; 3]| {
        four_points_distances_sq(points, face).into_iter().fold(0.0, greater)
    };
    let bounds = |first: usize| {
        let mut aabb = Aabb::EMPTY;
        for f in first..m_a.min(first + TOGETHER) {
            for p in corners(a, frame, f) {
                aabb.add(p);
            }
        }
        let (low, high) = (aabb.lower, aabb.upper);
        let [x, y] = [[low[0], high[0], low[0], high[0]], [low[1], low[1], high[1], high[1]]];
        let halves = [[x, y, [low[2]; 4]], [x, y, [high[2]; 4]]];
        let each = few.iter().map(|face| greater(over(&halves[0], *face), over(&halves[1], *face)));
        each.fold(f64::INFINITY, |least: f64, x| if x < least { x } else { least })
    };
    let boxes = m_a.div_ceil(TOGETHER);
    let greatest = (0..boxes).into_par_iter().map(|i| bounds(i * TOGETHER)).reduce(|| 0.0, greater);
    (greatest.sqrt(), (boxes * few.len() * 8) as u64)
}

/// The farthest of so many corners of A, at most [`POINTS`], with the face of B nearest to it.
fn farthest(count: usize, a: &TriMesh, b: &TriMesh, frame: &Frame) -> Farthest {
    let (m_a, m_b) = (a.faces().len(), b.faces().len());
    let from: Vec<usize> = (0..m_a).step_by(m_a.div_ceil(count)).collect();
    // Lanes without a point of their own repeat the first.
    let faces: [usize; POINTS] = std::array::from_fn(|lane| from.get(lane).copied().unwrap_or(0));
    let points = faces.map(|f| corners(a, frame, f)[0]);
    let lanes = [0, 1, 2].map(|k| points.map(|p| p[k]));
    let lesser = |x: [(f64, usize); POINTS], y: [(f64, usize); POINTS]| {
        std::array::from_fn(|lane| if y[lane] < x[lane] { y[lane] } else { x[lane] })
    };
    let none = [(f64::INFINITY, 0); POINTS];
    let nearest = (0..m_b.div_ceil(TASK))
        .into_par_iter()
        .map(|i| {
            (i * TASK..m_b.min((i + 1) * TASK)).fold(none, |nearest, g| {
                lesser(nearest, four_points_distances_sq(&lanes, corners(b, frame, g)).map(|d| (d, g)))
            })
        })
        .reduce(|| none, lesser);
    let lane =
        (0..from.len()).fold(0, |best, lane| if nearest[lane].0 > nearest[best].0 { lane } else { best });
    let (distance_sq, g) = nearest[lane];
    Farthest {
        face: FaceId(faces[lane] as u32),
        point: points[lane],
        distance: distance_sq.sqrt(),
        nearest: (FaceId(g as u32), corners(b, frame, g)),
    }
}
