//! The points that are within a length of the other mesh, as far as that is proven.

use super::Part;
use super::level::Level;
use super::pieces::{Fate, finest};
use crate::deviation::frame_of;
use crate::deviation::linear::greater;
use crate::deviation::measure::VertexDistances;
use crate::deviation::options::DeviationOptions;
use crate::observer::{Observer, Progress};
use crate::prepared::PreparedPair;
use crate::report::{Direction, StopReason};
use crate::rounding::Rounding;
use crate::search::{Limits, Local, Scene, Start, search_each};
use crate::target::Target;
use crate::tolerance::OptionError;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::run::{Control, on_threads};
use pompeiu_core::spatial::{Workspace, morton_order};
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;

/// Faces searched by a task, and tasks between two looks at the limits.
const FACES_OF_TASK: usize = 32;
const TASKS_PER_ROUND: usize = 64;

/// What triangles are compared with.
struct Comparison<'c> {
    direction: Direction,
    other: &'c TriMesh,
    target: &'c Target,
    frame: Frame,
    rounding: Rounding,
    length: f64,
    control: &'c Control,
    observer: &'c dyn Observer,
}

impl DeviationOptions<'_> {
    /// The points of a part of a mesh that are not farther than a length from the other mesh of a pair; none if there is no such point. Faces that
    /// reach farther are cut. Pieces that reach just so far, as far as double precision tells, stay; those of which limits leave it open do not. Of the
    /// options only the limits and the observer matter.
    ///
    /// # Accuracy
    /// What is kept is proven to be within the length but for rounding. Each triangle that is left out is farther as a whole but for rounding, or
    /// has no edge longer than a part in 2048 of the root of the area of the smaller mesh.
    ///
    /// # Errors
    /// [`DeviationOptions::check`].
    pub fn within(
        &self,
        part: &Part,
        pair: &PreparedPair<'_>,
        direction: Direction,
        length: f64,
    ) -> Result<Option<Part>, OptionError> {
        self.check()?;
        Ok(on_threads(self.limits.threads, || self.cut_within(part, pair, direction, length)))
    }

    fn cut_within(
        &self,
        part: &Part,
        pair: &PreparedPair<'_>,
        direction: Direction,
        length: f64,
    ) -> Option<Part> {
        let (frame, _, rounding) = frame_of(pair.a(), pair.b());
        let control = Control::start(&self.limits);
        let target = pair.target(direction, frame);
        let comparison = Comparison {
            direction,
            other: pair.other(direction),
            target: &target,
            frame,
            rounding,
            length,
            control: &control,
            observer: self.observer.unwrap_or(&()),
        };
        let bvh = target.bvh();
        let level = Level::new(bvh, frame.length_in(length), rounding);
        let mut most = 0.0;
        let within = part.cut(pair.whole(direction), finest(pair, &frame), &mut |mesh| {
            let order = morton_order(mesh, &Aabb::of_faces(mesh));
            let Some(vertices) = VertexDistances::limited(mesh, &frame, bvh, &order, &control) else {
                return vec![Fate::LeftOut; mesh.faces().len()];
            };
            let farthest = comparison.farthest_if_within(mesh, &order, &vertices);
            most = farthest.iter().flatten().copied().fold(most, greater);
            let fate = |workspace: &mut Workspace, (face, known): (usize, &Option<f64>)| match known {
                Some(_) => Fate::Kept,
                None if control.is_stopped() => Fate::LeftOut,
                None => {
                    let corners = mesh.corners(FaceId(face as u32)).map(|p| frame.map(p));
                    level.fate(corners, vertices.of_corners(mesh.faces()[face]), workspace)
                }
            };
            farthest.par_iter().enumerate().map_init(Workspace::default, fate).collect()
        })?;
        // Faces that were kept piece by piece are whole again, and pieces are rounded.
        let rounding = if most > 0.0 { Part::ROUNDING * largest_coordinate(&within.mesh) } else { 0.0 };
        Some(Part { farthest: Some((most + rounding).next_up()), ..within })
    }
}

fn largest_coordinate(mesh: &TriMesh) -> f64 {
    mesh.positions().iter().flatten().fold(0.0, |most, x| greater(most, x.abs()))
}

impl Comparison<'_> {
    /// How far each face is at most, of those that are proven to be within the length but for rounding.
    fn farthest_if_within(
        &self,
        mesh: &TriMesh,
        order: &[u32],
        vertices: &VertexDistances,
    ) -> Vec<Option<f64>> {
        let Self { frame, rounding, control, .. } = *self;
        let mut found = vec![None; mesh.faces().len()];
        let bvh = self.target.bvh();
        let threshold = frame.length_in(self.length);
        // A corner that is too far settles most of the others.
        let is_open = |face: &u32| {
            let corners = mesh.faces()[*face as usize];
            corners.iter().all(|v| vertices.distances[*v as usize] - rounding.bound(0) <= threshold)
        };
        let open: Vec<u32> = order.iter().copied().filter(is_open).collect();
        let neighbours = Some(self.target.neighbours_in(self.other));
        let scene = Scene { a: mesh, order, frame: &frame, bvh, neighbours, control };
        let limits = Limits {
            diagonal: 1.0,
            tolerance: 0.0,
            tolerance_of_distance: 0.0,
            threshold: Some(threshold),
            rounding,
            least_size: 16.0 * rounding.unit(),
        };
        let most = threshold + rounding.least_tolerance();
        let mut examined = 0;
        for round in open.chunks(FACES_OF_TASK * TASKS_PER_ROUND) {
            let of_task = |faces: &[u32]| {
                let start = |face: &u32| {
                    let vertices_of_face = mesh.faces()[*face as usize];
                    let point = frame.map(mesh.positions()[vertices_of_face[0] as usize]);
                    let corners = vertices.of_corners(vertices_of_face);
                    Start { face: *face, point, depth: 0, near: corners[0].1, corners }
                };
                search_each(&scene, limits, &faces.iter().map(start).collect::<Vec<_>>())
            };
            let locals: Vec<Vec<Local>> = round.par_chunks(FACES_OF_TASK).map(of_task).collect();
            for (face, local) in round.iter().zip(locals.into_iter().flatten()) {
                let is_within = local.upper <= most;
                found[*face as usize] = is_within.then(|| frame.length_out(local.upper).next_up());
            }
            examined += round.len();
            let left = (open.len() - examined) as u64;
            let progress = Progress::new(self.direction, [0.0, self.length], examined as u64, left);
            if self.observer.progress(&progress).is_break() {
                control.stop(StopReason::Cancelled);
            }
            if control.is_stopped() {
                return found;
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::{Diagonal, grid};
    use pompeiu_core::mesh::{Affine, merge, transform};

    /// Faces that reach just as far as the length stay, others do not, whatever part of their distance that is.
    #[test]
    fn exactly_the_faces_beyond_a_length_are_left_out() {
        let plate = grid([4.0, 1.0], [4, 1], Diagonal::Rising).unwrap();
        // Steps at heights that differ by a thousandth of themselves, and by nothing.
        let heights = [1.0, 1.0, 1.001, 0.999];
        let steps: Vec<TriMesh> = (0..4)
            .map(|i| {
                let step = grid([0.5, 0.5], [1, 1], Diagonal::Rising).unwrap();
                transform(&step, &Affine::translate([f64::from(i) - 1.5, 0.0, heights[i as usize]])).unwrap()
            })
            .collect();
        let steps = merge(&steps.iter().collect::<Vec<_>>()).unwrap();
        let all = Part::of(&steps, |_| true).unwrap();
        let options = DeviationOptions::default();
        let pair = PreparedPair::new(&steps, &plate);
        let within = |length| options.within(&all, &pair, Direction::AToB, length).unwrap();
        let kept = within(1.0).unwrap();
        assert_eq!(kept.left_out.cut, 0);
        assert_eq!(kept.faces, [0, 1, 2, 3, 6, 7].map(FaceId).to_vec());
        assert!((kept.farthest.unwrap() - 1.0).abs() < 1e-12);
        assert!(within(0.9).is_none());
        // Without time nothing is known but that.
        let limits =
            pompeiu_core::run::Limits { time: Some(std::time::Duration::ZERO), ..Default::default() };
        let hurried = DeviationOptions { limits, ..DeviationOptions::default() };
        let most = kept.farthest.unwrap();
        let parts = [kept, Part::of(&plate, |_| true).unwrap()];
        let found = hurried.symmetric_of(&pair.with_parts(parts)).unwrap();
        assert!(found.a_to_b.distance.distance.upper() <= most);
    }

    /// A ramp over a plate is cut at the height that is asked for.
    #[test]
    fn faces_are_cut_where_they_go_beyond_a_length() {
        let plate = grid([1.0, 1.0], [1, 1], Diagonal::Rising).unwrap();
        let ramp = TriMesh::new(
            vec![[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 0.0]],
            vec![[0, 1, 2], [0, 2, 3]],
        )
        .unwrap();
        let middle = Aabb::of_faces(&plate);
        let plate = transform(&plate, &Affine::translate([-middle.lower[0], -middle.lower[1], 0.0])).unwrap();
        let pair = PreparedPair::new(&ramp, &plate);
        let all = Part::of(&ramp, |_| true).unwrap();
        let options = DeviationOptions::default();
        let kept = options.within(&all, &pair, Direction::AToB, 0.3).unwrap().unwrap();
        assert_eq!((kept.left_out.faces, kept.left_out.cut), (0, 2));
        assert!(kept.farthest.unwrap() <= 0.3 + 1e-12 && kept.farthest.unwrap() > 0.299);
        let share = kept.left_out.share;
        assert!(share.contains(0.7) && share.gap() < 1e-9, "{share:?}");
        let found = options.symmetric_of(&pair.with_parts([kept, Part::of(&plate, |_| true).unwrap()]));
        assert!(found.unwrap().a_to_b.distance.distance.upper() <= 0.3 + 1e-12);
    }

    /// A plate over a valley whose sides rise by 45 degrees: its middle is at equal distances from both.
    #[test]
    fn what_is_within_ends_at_lines_over_each_of_two_faces() {
        let valley = TriMesh::new(
            [-2.0_f64, 0.0, 2.0].iter().flat_map(|x| [-3.0, 3.0].map(|y| [*x, y, x.abs()])).collect(),
            vec![[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]],
        )
        .unwrap();
        let corner = |x: f64, y: f64| [x, y, 0.6];
        let plate = TriMesh::new(
            vec![corner(-0.5, -0.3), corner(0.5, -0.45), corner(0.5, 0.4), corner(-0.5, 0.4)],
            vec![[0, 1, 2], [0, 2, 3]],
        )
        .unwrap();
        let pair = PreparedPair::new(&plate, &valley);
        let all = Part::of(&plate, |_| true).unwrap();
        let kept = DeviationOptions::default().within(&all, &pair, Direction::AToB, 0.3).unwrap().unwrap();
        // The distance at x is (.6 - |x|) / sqrt(2); the length of the plate along y is .775 - .075 - .15 x.
        let end = 0.6 - 0.3 * 2.0_f64.sqrt();
        let share = kept.left_out.share;
        assert!((share.lower() - 2.0 * end).abs() < 1e-9 && share.gap() < 1e-9, "{share:?} {end}");
        let beyond = kept.mesh.positions().iter().skip(4).filter(|p| p[0].abs() < end - 1e-12).count();
        assert_eq!(beyond, 0);
    }

    /// Of what lies in one plane with a smaller plate, that plate is at no distance.
    #[test]
    fn at_length_zero_what_coincides_stays() {
        let all = grid([4.0, 1.0], [4, 1], Diagonal::Rising).unwrap();
        let plate = grid([3.0, 1.0], [1, 1], Diagonal::Rising).unwrap();
        let pair = PreparedPair::new(&all, &plate);
        let whole = Part::of(&all, |_| true).unwrap();
        let kept = DeviationOptions::default().within(&whole, &pair, Direction::AToB, 0.0).unwrap().unwrap();
        assert_eq!((kept.left_out.faces, kept.left_out.cut), (0, 4));
        assert!((kept.left_out.share.lower() - 0.25).abs() < 1e-2, "{:?}", kept.left_out);
    }
}
