//! From a question to a report: the frame, the limits, the search, and the certificate of the lower bound.

use crate::certify;
use crate::options::HausdorffOptions;
use crate::report::{DirectedReport, Direction, Enclosure, StopReason, SurfacePoint, Timing, Witness};
use crate::rounding::Rounding;
use crate::search::{Limits, Scene, Search};
use crate::target::{NEIGHBOURS, Target};
use crate::tolerance::Tolerance;
use pompeiu_core::geom::point_triangle::closest_barycentric;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::run::Control;
use pompeiu_core::run::Instant;
use pompeiu_core::spatial::{Bvh, Slot, morton_order};
use pompeiu_core::{FaceId, TriMesh};
use std::ops::ControlFlow;

/// The options of one directed search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Question<'q> {
    pub(crate) options: &'q HausdorffOptions<'q>,
    pub(crate) direction: Direction,
    pub(crate) deadline: Option<Instant>,
}

impl Question<'_> {
    /// The limits, watched from now on.
    pub(crate) fn control(&self) -> Control {
        Control::start(&self.options.limits).until(self.deadline)
    }

    /// The same in units of a frame.
    pub(crate) fn limits(&self, joint: &Aabb, frame: &Frame, rounding: Rounding) -> Limits {
        let diagonal = frame.length_in(joint.diagonal());
        let (tolerance, tolerance_of_distance) = match self.options.tolerance {
            Tolerance::RelativeToDiagonal(x) => (x * diagonal, 0.0),
            Tolerance::RelativeToDistance(x) => (0.0, x),
            Tolerance::Absolute(x) => (frame.length_in(x), 0.0),
        };
        let threshold = self.options.threshold.map(|t| frame.length_in(t));
        Limits {
            diagonal,
            tolerance,
            tolerance_of_distance,
            threshold,
            rounding,
            least_size: 16.0 * rounding.unit(),
        }
    }

    /// The tolerances of the stages that are coarser than what is asked, in units of a frame.
    pub(crate) fn stages(&self, limits: &Limits) -> Vec<f64> {
        self.options.stages.iter().map(|s| s * limits.diagonal).filter(|s| *s > limits.tolerance).collect()
    }
}

/// The frame of the joint bounding box of two meshes, that box, and the rounding model there.
pub(crate) fn joint_frame(a: &TriMesh, b: &TriMesh) -> (Frame, Aabb, Rounding) {
    let joint = Aabb::of_faces(a).union(Aabb::of_faces(b));
    let frame = Frame::of(&joint);
    (frame, joint, Rounding::new(frame.max_coordinate(&joint)))
}

/// A mesh that is measured, with its box and its faces in an order in which neighbours are close together.
pub(crate) struct Ordered<'m> {
    pub(crate) mesh: &'m TriMesh,
    pub(crate) aabb: Aabb,
    pub(crate) order: Vec<u32>,
}

impl<'m> Ordered<'m> {
    pub(crate) fn new(mesh: &'m TriMesh) -> Self {
        let aabb = Aabb::of_faces(mesh);
        Self { mesh, aabb, order: morton_order(mesh, &aabb) }
    }
}

/// Searches in the frame of the target. A target without neighbours comes with the mesh `b` that it was made of; the target keeps the
/// neighbours if the search needed them.
pub(crate) fn search(
    question: &Question<'_>,
    a: &Ordered<'_>,
    target: &Target,
    b: Option<&TriMesh>,
) -> DirectedReport {
    let started = Instant::now();
    let Ordered { mesh: a, aabb: a_box, order } = a;
    let joint = a_box.union(target.aabb());
    let reframed;
    let target = if target.suits(a_box) {
        target
    } else {
        reframed = target.reframed(&joint);
        &reframed
    };
    // Proofs that an observer wants to see name the faces of B.
    let own = if question.options.observer().wants_discards() { target.with_its_own_faces() } else { None };
    let target = own.as_ref().unwrap_or(target);
    let rounding = target.rounding_with(a_box);
    let limits = question.limits(&joint, target.frame(), rounding);
    let stages = question.stages(&limits);
    let later = if b.is_some() { target.faces() * NEIGHBOURS } else { 0 };
    let held = bytes_of(a) + target.bytes() + later + a.faces().len() * size_of::<u32>();
    let control = question.control().holding(held);
    let scene =
        Scene { a, order, frame: target.frame(), bvh: target.bvh(), neighbours: None, control: &control };
    let mut search = Search::new(scene, limits, question.options.observer(), question.direction);
    search.sample();
    // A prepared target with its neighbours gives the same report as one without.
    let tries_overlays = search.tries_overlays();
    let made = |b: &TriMesh| (!control.is_stopped()).then(|| target.neighbours_in(b));
    let neighbours = if tries_overlays { target.neighbours().or_else(|| made(b?)) } else { None };
    let result = search.run(neighbours, &stages);

    let found = result.found;
    let farthest = Farthest {
        face: FaceId(found.face),
        point: found.point,
        distance: found.distance,
        nearest: target.nearest_face(found.nearest, found.point),
    };
    let (witness, x) = farthest.witness(a, target.frame());
    let lower = certified_lower(&x, &farthest, target, rounding);
    let (distance, stop, tolerance) =
        conclude(question, &limits, target.frame(), lower, result.upper, control.reason());
    DirectedReport {
        distance,
        witness,
        stop,
        tolerance,
        work: result.work,
        timing: Timing { search: started.elapsed(), ..Timing::default() },
    }
}

/// The farthest point of A that a search found, and the face of B nearest to it, in its frame.
pub(crate) struct Farthest {
    pub(crate) face: FaceId,
    pub(crate) point: [f64; 3],
    pub(crate) distance: f64,
    /// With its corners.
    pub(crate) nearest: (FaceId, [[f64; 3]; 3]),
}

impl Farthest {
    /// The witness in the unit of the meshes, and an enclosure of its point on A in the frame.
    pub(crate) fn witness(&self, a: &TriMesh, frame: &Frame) -> (Witness, certify::Box3) {
        let corners = a.corners(self.face);
        let weights = closest_barycentric(self.point, corners.map(|p| frame.map(p)));
        let x = certify::point_in_frame(frame, corners, weights);
        let (face, corners) = self.nearest;
        let barycentric = closest_barycentric(certify::middle(&x), corners);
        let position = [0, 1, 2].map(|k| (0..3).map(|i| barycentric[i] * corners[i][k]).sum());
        let to = SurfacePoint { face, barycentric, position: frame.unmap(position) };
        (Witness { from: SurfacePoint::new(a, self.face, weights), to }, x)
    }
}

/// A proven lower bound on the distance between the enclosed point and what is measured to.
fn certified_lower(x: &certify::Box3, farthest: &Farthest, target: &Target, rounding: Rounding) -> f64 {
    let bvh = target.bvh();
    let middle = certify::middle(x);
    // Triangles not reported are farther than this from the middle, and so than what the search believes from x.
    let reach = farthest.distance + 4.0 * rounding.lower();
    let slots = slots_within(bvh, middle, reach);
    let near = certify::distance_lower_bound(*x, slots.into_iter().map(|slot| bvh.corners(slot)));
    let lower = if near < farthest.distance { near } else { farthest.distance };
    let moved = target.moved();
    if moved > 0.0 { f64::max(0.0, (lower - moved).next_down()) } else { lower }
}

/// The triangles in leaves whose boxes come as near to a point as `reach`: all that have a point within `reach`, rounding included, and
/// others.
fn slots_within(bvh: &Bvh, p: [f64; 3], reach: f64) -> Vec<Slot> {
    // Each term of the squared distance to a box carries a relative error below 2^-51, far inside this margin.
    const MARGIN: f64 = 1.0 + 1.0 / (1_u64 << 40) as f64;
    let limit = reach * reach * MARGIN;
    let mut slots = Vec::new();
    let all = bvh.walk(
        &mut Vec::new(),
        |aabb| aabb.distance_sq(p) <= limit,
        |slot| {
            slots.push(slot);
            ControlFlow::Continue(())
        },
    );
    debug_assert!(all.is_continue(), "nothing breaks off the walk");
    slots
}

/// The enclosure in the unit of the meshes, why the search ended, and the tolerance in that unit.
pub(crate) fn conclude(
    question: &Question<'_>,
    limits: &Limits,
    frame: &Frame,
    lower: f64,
    upper: f64,
    stopped: Option<StopReason>,
) -> (Enclosure, StopReason, f64) {
    // Scaling by a power of two rounds only among subnormal numbers; one step outwards covers that.
    let lower = frame.length_out(lower);
    let lower = if lower < f64::MIN_POSITIVE && lower > 0.0 { lower.next_down() } else { lower };
    let upper = frame.length_out(upper);
    let upper = if upper < f64::MIN_POSITIVE { upper.next_up() } else { upper };
    debug_assert!(lower <= upper, "proven bounds cross: {lower} > {upper}");
    // Bounds that cross would show an error of the rounding model. The distance is then at least one and at most the other of
    // what they say, whichever is wrong, and the report says that rounding is why the interval is not what was asked.
    let crossed = lower > upper;
    let (lower, upper) = if crossed { (upper, lower) } else { (lower, upper) };
    let enclosure = Enclosure::new(lower, upper).expect("coordinates are bounded, so distances are finite");
    let tolerance = match question.options.tolerance {
        Tolerance::Absolute(x) => x,
        _ => frame.length_out(limits.requested(frame.length_in(lower))),
    };
    let decided = question.options.threshold.is_some_and(|t| enclosure.upper() <= t || enclosure.lower() > t);
    let stop = match stopped {
        Some(reason) if reason.is_early() => reason,
        _ if crossed => StopReason::Rounding,
        _ if enclosure.gap() <= tolerance => StopReason::Tolerance,
        _ if decided => StopReason::Threshold,
        _ => StopReason::Rounding,
    };
    (enclosure, stop, tolerance)
}

fn bytes_of(mesh: &TriMesh) -> usize {
    size_of_val(mesh.positions()) + size_of_val(mesh.faces())
}

/// Bytes that a search holds before it has looked at a single face.
pub(crate) fn bytes_to_start(a: &TriMesh, b: &TriMesh) -> usize {
    const ORDERING: usize = 16;
    bytes_of(a) + bytes_of(b) + Target::bytes_to_prepare(b.faces().len()) + ORDERING * a.faces().len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::torus;

    #[test]
    fn every_triangle_within_reach_is_listed_once_and_few_others() {
        let target = Target::new(&torus(1.0, 0.3, 40, 30).unwrap());
        let bvh = target.bvh();
        for (i, reach) in [(0, 0.0), (3, 0.01), (7, 0.2), (11, 1.0), (13, 99.0)] {
            let corner = bvh.corner(bvh.slots().nth(97 * i).unwrap(), i % 3);
            let middle = corner.map(|x| x + 1e-3 * i as f64);
            let mut listed = slots_within(bvh, middle, reach);
            let count = listed.len();
            listed.sort_unstable();
            listed.dedup();
            assert_eq!(listed.len(), count, "each once");
            let within: Vec<Slot> =
                bvh.slots().filter(|slot| bvh.distance_sq(middle, *slot) <= reach * reach).collect();
            assert!(within.iter().all(|slot| listed.contains(slot)), "{reach}");
            assert!(within.len() == bvh.len() || listed.len() < bvh.len() / 2, "{reach}: {count}");
        }
    }
}
