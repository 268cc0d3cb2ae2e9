//! A valid enclosure in linear time and almost no memory, where a search is not possible or not needed.

use crate::certify;
use crate::engine::{Farthest, Question, conclude, joint_frame};
use crate::report::{DirectedReport, StopReason, Timing, WorkCount};
use pompeiu_core::geom::point_triangle::distance_sq;
use pompeiu_core::{FaceId, TriMesh};
use std::time::Instant;

/// Faces of B that bound every face of A from above.
const FACES: usize = 16;
/// Points of A that are measured against all of B.
const POINTS: usize = 4;

/// Bounds `h(A, B)` without a tree: from above by the best of a few faces of B for each face of A, from below by the
/// farthest of a few corners of A. Linear time, no allocation that grows with the meshes.
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
    let corners = |mesh: &TriMesh, f: usize| mesh.corners(FaceId(f as u32)).map(|p| frame.map(p));
    let distance = |p, [x, y, z]: [[f64; 3]; 3]| distance_sq(p, x, y, z).sqrt();

    let (m_a, m_b) = (a.faces().len(), b.faces().len());
    let few: Vec<_> = (0..m_b).step_by(m_b.div_ceil(faces)).map(|f| corners(b, f)).collect();
    let mut upper = 0.0;
    for f in 0..m_a {
        let piece = corners(a, f);
        let farthest = |face: &[[f64; 3]; 3]| piece.iter().map(|p| distance(*p, *face)).fold(0.0, f64::max);
        let least = few.iter().map(farthest).fold(f64::INFINITY, f64::min);
        upper = f64::max(upper, least);
    }

    let mut best: Option<Farthest> = None;
    for f in (0..m_a).step_by(m_a.div_ceil(points)) {
        let point = corners(a, f)[0];
        let (mut least, mut nearest) = (f64::INFINITY, 0);
        for g in 0..m_b {
            let d = distance(point, corners(b, g));
            if d < least {
                (least, nearest) = (d, g);
            }
        }
        if best.as_ref().is_none_or(|b| least > b.distance) {
            best = Some(Farthest {
                face: FaceId(f as u32),
                point,
                distance: least,
                nearest_face: FaceId(nearest as u32),
                nearest_corners: corners(b, nearest),
            });
        }
    }
    let best = best.expect("a mesh has a face");
    let (witness, x) = best.witness(a, &frame);
    let lower =
        if points > 1 { certify::distance_lower_bound(x, (0..m_b).map(|g| corners(b, g))) } else { 0.0 };
    let (distance, stop, tolerance) =
        conclude(question, &limits, &frame, lower, upper + rounding.bound(0), None);
    // A bound that is as good as asked needs no search.
    let stop = if stop == StopReason::Rounding { instead } else { stop };
    let work = WorkCount {
        distances: (m_a * few.len() * 3 + points * m_b) as u64,
        pieces: m_a as u64,
        ..WorkCount::default()
    };
    let timing = Timing { search: started.elapsed(), ..Timing::default() };
    DirectedReport { distance, witness, stop, tolerance, work, timing }
}
