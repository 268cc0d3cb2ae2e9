//! Iterated closest points: the pose that minimises the distance of points from a surface.

use super::equations::Equations;
use super::pose::{Pose, axis_rotations};
use glam::{DMat3, DVec3};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Frame;
use pompeiu_core::geom::point_triangle::closest_barycentric;
use pompeiu_core::spatial::bvh::{Bvh, Slot, Workspace};

/// Sample points that distinguish initial poses.
const FEW_POINTS: usize = 200;
/// Steps before initial poses are compared.
const FEW_STEPS: usize = 8;
/// Number of poses that are refined to convergence.
const FOLLOWED: usize = 3;
/// Sample points for the final alignment.
const POINTS: usize = 2000;
/// Largest number of its steps.
const STEPS: usize = 60;
/// Initial damping, relative to the mean diagonal entry of the normal equations; a tenth of it after each successful step.
const DAMPING: f64 = 1e-3;
/// Smallest damping: keeps the equations of a sphere or a plane solvable.
const LEAST_DAMPING: f64 = 1e-12;
/// Damping beyond which no step can succeed.
const MOST_DAMPING: f64 = 1e3;
/// Converged if the mean squared distance decreases by less than this share.
const REST: f64 = 1e-10;

/// A surface for closest-point queries.
#[derive(Debug)]
pub(super) struct Surface {
    bvh: Bvh,
}

impl Surface {
    pub(super) fn new(mesh: &TriMesh, frame: &Frame) -> Self {
        Self { bvh: Bvh::build(mesh, frame) }
    }

    /// Some slot, to start a query from.
    pub(super) fn any_slot(&self) -> Slot {
        self.bvh.any_slot()
    }

    /// The point nearest to `p`, and the unit normal of its face, or the direction to `p` where the face has none.
    pub(super) fn nearest(&self, p: DVec3, slot: &mut Slot, workspace: &mut Workspace) -> (DVec3, DVec3) {
        *slot = self.bvh.nearest(p.to_array(), *slot, workspace).slot;
        let corners = self.bvh.corners(*slot);
        let weights = closest_barycentric(p.to_array(), corners);
        let [a, b, c] = corners.map(DVec3::from_array);
        let q = a + weights[1] * (b - a) + weights[2] * (c - a);
        let normal = (b - a).cross(c - a);
        let normal = normal.try_normalize().or_else(|| (p - q).try_normalize()).unwrap_or(DVec3::ZERO);
        (q, normal)
    }
}

/// The best pose found; axes and centroids are those of the surface and of the points.
pub(super) fn registered(
    surface: &Surface,
    axes: [DMat3; 2],
    centroids: [DVec3; 2],
    in_place: DVec3,
    points: impl Fn(usize) -> Vec<DVec3>,
) -> Pose {
    let centred = |rotation: DMat3| Pose { rotation, translation: centroids[0] - rotation * centroids[1] };
    let few = points(FEW_POINTS);
    let mut found: Vec<Descent<'_>> = starts(axes, centroids, in_place)
        .map(|start| Descent::new(surface, &few, start, centroids[1]).run(FEW_STEPS))
        .collect();
    // Stable, so that equal errors stay in the order of the starts.
    found.sort_by(|a, b| a.mean_square.total_cmp(&b.mean_square));
    let many = points(POINTS);
    let mut best: Option<Descent<'_>> = None;
    for start in &found[..FOLLOWED] {
        let end = Descent::new(surface, &many, start.pose, centroids[1]).run(STEPS);
        if best.as_ref().is_none_or(|best| end.mean_square < best.mean_square) {
            best = Some(end);
        }
    }
    best.map_or(centred(DMat3::IDENTITY), |best| best.pose)
}

/// Sample points for a look at how much a better pose would gain, and largest number of its steps.
const LOOK_POINTS: usize = 400;
const LOOK_STEPS: usize = 30;

/// The median distance of points from the surface as they lie, and in about the best pose; axes and centroids are those of the surface and of the
/// points.
pub(super) fn gain(
    surface: &Surface,
    axes: [DMat3; 2],
    centroids: [DVec3; 2],
    in_place: DVec3,
    points: impl Fn(usize) -> Vec<DVec3>,
) -> [f64; 2] {
    let few = points(FEW_POINTS);
    let mut found: Vec<Descent<'_>> = starts(axes, centroids, in_place)
        .map(|start| Descent::new(surface, &few, start, centroids[1]).run(FEW_STEPS))
        .collect();
    // Stable, so that equal errors stay in the order of the starts.
    found.sort_by(|a, b| a.mean_square.total_cmp(&b.mean_square));
    let many = points(LOOK_POINTS);
    let as_it_lies = Pose { rotation: DMat3::IDENTITY, translation: in_place };
    let before = Descent::new(surface, &many, as_it_lies, centroids[1]);
    let best = found.first().map_or(as_it_lies, |best| best.pose);
    let after = Descent::new(surface, &many, best, centroids[1]).run(LOOK_STEPS);
    [before, after].map(Descent::median)
}

/// Poses that a search for the best one starts from.
fn starts(axes: [DMat3; 2], centroids: [DVec3; 2], in_place: DVec3) -> impl Iterator<Item = Pose> {
    let centred =
        move |rotation: DMat3| Pose { rotation, translation: centroids[0] - rotation * centroids[1] };
    let turned = axis_rotations().map(move |r| centred(axes[0] * r * axes[1].transpose()));
    let starts = [Pose { rotation: DMat3::IDENTITY, translation: in_place }, centred(DMat3::IDENTITY)];
    starts.into_iter().chain(turned)
}

/// A descent towards a local optimum.
struct Descent<'s> {
    surface: &'s Surface,
    points: &'s [DVec3],
    /// The centre of rotation, before the pose.
    centre: DVec3,
    pose: Pose,
    /// Mean squared distance of the points from the surface, in this pose.
    mean_square: f64,
    equations: Equations<6>,
    /// The face nearest to each point in the previous query.
    slots: Vec<Slot>,
    workspace: Workspace,
}

impl<'s> Descent<'s> {
    fn new(surface: &'s Surface, points: &'s [DVec3], pose: Pose, centre: DVec3) -> Self {
        let mut descent = Self {
            surface,
            points,
            centre,
            pose,
            mean_square: f64::INFINITY,
            equations: Equations::new(),
            slots: vec![surface.any_slot(); points.len()],
            workspace: Workspace::default(),
        };
        (descent.mean_square, descent.equations) = descent.look(&pose);
        descent
    }

    /// Descends for at most this many trials.
    fn run(mut self, steps: usize) -> Self {
        let mut damping = DAMPING;
        for _ in 0..steps {
            let about = self.pose.apply(self.centre);
            let Some(x) = self.equations.solved(damping + LEAST_DAMPING) else { break };
            let [turn, shift] = [DVec3::from_slice(&x[..3]), DVec3::from_slice(&x[3..])];
            let pose = self.pose.then(turn, about, shift);
            let (mean_square, equations) = self.look(&pose);
            if mean_square < self.mean_square {
                let rest = mean_square > (1.0 - REST) * self.mean_square;
                (self.pose, self.mean_square, self.equations) = (pose, mean_square, equations);
                damping *= 0.1;
                if rest {
                    break;
                }
            } else {
                damping = if damping < LEAST_DAMPING { DAMPING } else { 10.0 * damping };
                if damping > MOST_DAMPING {
                    break;
                }
            }
        }
        self
    }

    /// The median distance of the points.
    fn median(mut self) -> f64 {
        let nearest = |(point, slot): (&DVec3, &mut Slot)| {
            let p = self.pose.apply(*point);
            self.surface.nearest(p, slot, &mut self.workspace).0.distance(p)
        };
        let mut distances: Vec<f64> = self.points.iter().zip(&mut self.slots).map(nearest).collect();
        let middle = distances.len() / 2;
        if distances.is_empty() { 0.0 } else { *distances.select_nth_unstable_by(middle, f64::total_cmp).1 }
    }

    /// The mean squared distance in a pose, and the equations for the next step.
    fn look(&mut self, pose: &Pose) -> (f64, Equations<6>) {
        let about = pose.apply(self.centre);
        let mut equations = Equations::new();
        let mut sum = 0.0;
        for (point, slot) in self.points.iter().zip(&mut self.slots) {
            let p = pose.apply(*point);
            let (q, normal) = self.surface.nearest(p, slot, &mut self.workspace);
            sum += (p - q).length_squared();
            let arm = (p - about).cross(normal);
            equations.add(1.0, [arm.x, arm.y, arm.z, normal.x, normal.y, normal.z], normal.dot(q - p));
        }
        (sum / self.points.len() as f64, equations)
    }
}
