//! Parts of a mesh that are measured while the rest is left out, with a statement of what that is.

use super::area;
use super::connected::{Sets, Touching, places};
use super::entry::Sum;
use super::linear::greater;
use super::measure::VertexDistances;
use super::options::DeviationOptions;
use super::report::DirectedDeviation;
use super::statistics::share_of;
use crate::engine::joint_frame;
use crate::observer::{Observer, Progress};
use crate::prepared::PreparedPair;
use crate::report::{Direction, Enclosure};
use crate::search::{Limits, Local, Scene, Start, search_each};
use crate::target::Target;
use crate::tolerance::OptionError;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::run::{Control, on_threads};
use pompeiu_core::spatial::{Bvh, Workspace, morton_order};
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;

/// Some faces of a mesh, on all its vertices.
#[derive(Clone, Debug)]
pub struct Part {
    /// The mesh of these faces.
    pub mesh: TriMesh,
    /// For each of its faces, which one of the whole mesh it is; ascending.
    pub faces: Vec<FaceId>,
    /// What is not in it.
    pub left_out: LeftOut,
    /// No point of it is known to be farther than this from the other mesh, if it was chosen so ([`DeviationOptions::within`]).
    pub farthest: Option<f64>,
}

/// What of a mesh is left out.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LeftOut {
    /// Number of faces.
    pub faces: usize,
    /// Number of connected parts that they make; faces are neighbours when they have a vertex position in common, welded or not.
    pub components: usize,
    /// Encloses their share of the area of the mesh.
    pub share: Enclosure,
}

impl Part {
    /// The faces that are wanted; none if there is no such face.
    pub fn of(mesh: &TriMesh, wanted: impl Fn(FaceId) -> bool) -> Option<Self> {
        let kept: Vec<bool> = mesh.face_ids().map(wanted).collect();
        let faces: Vec<FaceId> = mesh.face_ids().filter(|face| kept[face.index()]).collect();
        let corners = faces.iter().map(|face| mesh.faces()[face.index()]).collect();
        let part = TriMesh::new(mesh.positions().to_vec(), corners).ok()?;
        let left_out = LeftOut {
            faces: mesh.faces().len() - faces.len(),
            components: count_components(mesh, |face| !kept[face as usize]),
            share: share(mesh, |face| !kept[face as usize]),
        };
        Some(Self { mesh: part, faces, left_out, farthest: None })
    }

    /// Only the faces of it that are wanted, by their places in the whole mesh `of`.
    #[must_use]
    pub fn and(&self, of: &TriMesh, wanted: impl Fn(FaceId) -> bool) -> Option<Self> {
        let mut kept = vec![false; of.faces().len()];
        for face in &self.faces {
            kept[face.index()] = wanted(*face);
        }
        Self::of(of, |face| kept[face.index()])
    }
}

/// The share of the area of a mesh that some faces have.
fn share(mesh: &TriMesh, of: impl Fn(u32) -> bool) -> Enclosure {
    let frame = Frame::of(&Aabb::of_faces(mesh));
    let (mut part, mut all) = (Sum::default(), Sum::default());
    for face in 0..mesh.faces().len() as u32 {
        let (low, high) = area::of_face(mesh, &frame, face);
        all.add(low, high);
        if of(face) {
            part.add(low, high);
        }
    }
    let (part, all) = (part.enclosure(), all.enclosure());
    if all.lower() <= 0.0 || part.upper() == 0.0 {
        return share_of((0.0, 0.0));
    }
    let share = part.divide_by_positive(all);
    share_of((if share.lower() < 1.0 { share.lower() } else { 1.0 }, share.upper()))
}

/// The connected parts of some faces: for each face the first face of its part, and itself for the others.
fn first_faces(mesh: &TriMesh, of: impl Fn(u32) -> bool) -> Vec<u32> {
    let touching = Touching::new(mesh);
    let count = mesh.faces().len() as u32;
    let mut sets = Sets::new(count as usize);
    for face in (0..count).filter(|face| of(*face)) {
        sets.enter(face);
        touching.for_neighbours(face, |other| sets.join(face, other));
    }
    (0..count).map(|face| if of(face) { sets.first(face) } else { face }).collect()
}

fn count_components(mesh: &TriMesh, of: impl Fn(u32) -> bool) -> usize {
    let first = first_faces(mesh, &of);
    first.iter().enumerate().filter(|(face, first)| of(*face as u32) && *face as u32 == **first).count()
}

/// For each face the share of the area, rounded, that its connected part has.
pub fn component_shares(mesh: &TriMesh) -> Vec<f64> {
    let frame = Frame::of(&Aabb::of_faces(mesh));
    let first = first_faces(mesh, |_| true);
    let mut areas = vec![0.0; first.len()];
    for (face, first) in first.iter().enumerate() {
        let (low, high) = area::of_face(mesh, &frame, face as u32);
        areas[*first as usize] += 0.5 * (low + high);
    }
    let total: f64 = areas.iter().sum();
    first.iter().map(|first| if total > 0.0 { areas[*first as usize] / total } else { 0.0 }).collect()
}

/// For each face of A whether it lies over B rather than beside it: whether the nearest point of B to its centroid is not on the
/// boundary of B, where an edge belongs to one face. Over a closed surface every face does.
pub fn overlapping(a: &TriMesh, b: &TriMesh) -> Vec<bool> {
    overlapping_of(&PreparedPair::for_one_question(a, b), Direction::AToB)
}

/// The same for the faces of the whole mesh that a prepared pair measures in a direction.
pub(crate) fn overlapping_of(pair: &PreparedPair<'_>, direction: Direction) -> Vec<bool> {
    /// Distances that differ by no more than this part of them, or of the frame, are the same.
    const SAME: f64 = 1e-12;
    let (a, b) = match direction {
        Direction::AToB => (pair.a(), pair.b()),
        Direction::BToA => (pair.b(), pair.a()),
    };
    let Some(boundary) = boundary(b) else { return vec![true; a.faces().len()] };
    let frame = joint_frame(a, b).0;
    let (surface, rim) = (pair.target(direction, frame), Target::in_frame(&boundary, frame));
    let order = morton_order(a, &Aabb::of_faces(a));
    let lies_over = |task: &[u32]| -> Vec<bool> {
        let mut workspace = Workspace::default();
        let mut distance =
            |bvh: &Bvh, point| bvh.nearest(point, bvh.any_slot(), &mut workspace).distance_sq.sqrt();
        let of_face = |face: &u32| {
            let corners = a.corners(FaceId(*face)).map(|p| frame.map(p));
            let centre = [0, 1, 2].map(|k| (corners[0][k] + corners[1][k] + corners[2][k]) * (1.0 / 3.0));
            distance(rim.bvh(), centre) > distance(surface.bvh(), centre) * (1.0 + SAME) + SAME
        };
        task.iter().map(of_face).collect()
    };
    let found: Vec<bool> = order.par_chunks(256).flat_map_iter(lies_over).collect();
    let mut over = vec![true; found.len()];
    for (face, found) in order.iter().zip(found) {
        over[*face as usize] = found;
    }
    over
}

/// The edges that belong to one face, as triangles without area; none of a closed surface.
fn boundary(mesh: &TriMesh) -> Option<TriMesh> {
    let place = places(mesh);
    let mut edges: Vec<[u32; 2]> = mesh
        .faces()
        .iter()
        .flat_map(|face| {
            let [a, b, c] = face.map(|v| place[v as usize]);
            [[a, b], [b, c], [c, a]]
        })
        .filter(|[from, to]| from != to)
        .map(|[from, to]| if from < to { [from, to] } else { [to, from] })
        .collect();
    edges.par_sort_unstable();
    let single = edges.chunk_by(|x, y| x == y).filter(|same| same.len() == 1).map(|same| same[0]);
    let faces: Vec<[u32; 3]> = single.map(|[from, to]| [from, to, to]).collect();
    if faces.is_empty() { None } else { TriMesh::new(mesh.positions().to_vec(), faces).ok() }
}

impl DeviationOptions<'_> {
    /// The faces of a part of a mesh that do not reach farther than a length from the other mesh of a pair; none if there is no such face. Faces that reach just so
    /// far, as far as double precision tells, stay; those of which limits leave it open do not. Of the options only the limits and the
    /// observer matter.
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
        let find = || self.farthest_if_within(&part.mesh, pair, direction, length);
        let farthest = on_threads(self.limits.threads, find);
        let whole = match direction {
            Direction::AToB => pair.a(),
            Direction::BToA => pair.b(),
        };
        let mut kept = vec![false; whole.faces().len()];
        let mut most = 0.0;
        for (face, farthest) in part.faces.iter().zip(farthest) {
            if let Some(farthest) = farthest {
                kept[face.index()] = true;
                most = greater(most, farthest);
            }
        }
        let within = part.and(whole, |face| kept[face.index()]);
        Ok(within.map(|within| Self::known(within, most)))
    }

    fn known(part: Part, farthest: f64) -> Part {
        Part { farthest: Some(farthest), ..part }
    }

    /// How far each face is at most, of those that are proven to be within a length but for rounding.
    fn farthest_if_within(
        &self,
        mesh: &TriMesh,
        pair: &PreparedPair<'_>,
        direction: Direction,
        length: f64,
    ) -> Vec<Option<f64>> {
        let other = pair.other(direction);
        let (frame, _, rounding) = joint_frame(mesh, other);
        let control = Control::start(&self.limits);
        let mut found = vec![None; mesh.faces().len()];
        let target = pair.target(direction, frame);
        let bvh = target.bvh();
        let order = morton_order(mesh, &Aabb::of_faces(mesh));
        let Some(vertices) = VertexDistances::limited(mesh, &frame, bvh, &order, &control) else {
            return found;
        };
        let threshold = frame.length_in(length);
        // A corner that is too far settles most of the others.
        let is_open = |face: &u32| {
            let corners = mesh.faces()[*face as usize];
            corners.iter().all(|v| vertices.distances[*v as usize] - rounding.bound(0) <= threshold)
        };
        let open: Vec<u32> = order.iter().copied().filter(is_open).collect();
        let neighbours = target.neighbours_in(other);
        let scene = Scene {
            a: mesh,
            order: &order,
            frame: &frame,
            bvh,
            neighbours: Some(neighbours),
            control: &control,
        };
        let limits = Limits {
            diagonal: 1.0,
            tolerance: 0.0,
            tolerance_of_distance: 0.0,
            threshold: Some(threshold),
            rounding,
            least_size: 16.0 * rounding.unit(),
        };
        let most = threshold + rounding.least_tolerance();
        let observer: &dyn Observer = self.observer.unwrap_or(&());
        let mut examined = 0;
        for round in open.chunks(FACES_OF_TASK * TASKS_PER_ROUND) {
            let of_task = |faces: &[u32]| {
                let start = |face: &u32| {
                    let first = mesh.faces()[*face as usize][0] as usize;
                    let point = frame.map(mesh.positions()[first]);
                    Start { face: *face, point, depth: 0, near: vertices.near[first] }
                };
                search_each(&scene, limits, &faces.iter().map(start).collect::<Vec<_>>())
            };
            let locals: Vec<Vec<Local>> = round.par_chunks(FACES_OF_TASK).map(of_task).collect();
            for (face, local) in round.iter().zip(locals.into_iter().flatten()) {
                let is_within = local.upper <= most;
                found[*face as usize] = is_within.then(|| frame.length_out(local.upper).next_up());
            }
            examined += round.len();
            let progress = Progress {
                direction,
                lower: 0.0,
                upper: length,
                examined: examined as u64,
                left: (open.len() - examined) as u64,
            };
            if observer.progress(&progress).is_break() || control.is_stopped() {
                return found;
            }
        }
        found
    }
}

/// Faces searched by a task, and tasks between two looks at the limits.
const FACES_OF_TASK: usize = 32;
const TASKS_PER_ROUND: usize = 64;

impl DirectedDeviation {
    /// Faces of the measured mesh are those of a part of another one from now on: `faces` says which they are.
    pub fn renumber(&mut self, faces: &[FaceId]) {
        self.distance.witness.from.face = faces[self.distance.witness.from.face.index()];
        for region in self.regions.iter_mut().chain(&mut self.beyond_threshold) {
            region.witness.from.face = faces[region.witness.from.face.index()];
            for face in &mut region.faces {
                *face = faces[face.index()];
            }
        }
    }

    /// Whether the largest distance is that of a connected part with less than such a share of the area, while everything else is
    /// within half of it: that share, and what everything else is within. `mesh` must be the one that was measured.
    pub fn outlying_component(&self, mesh: &TriMesh, less_than: f64) -> Option<(f64, f64)> {
        let shares = component_shares(mesh);
        let share = *shares.get(self.distance.witness.from.face.index())?;
        if share >= less_than {
            return None;
        }
        let rest = self.faces.iter().zip(&shares).filter(|(_, share)| **share >= less_than);
        let within = rest.map(|(face, _)| face.max.upper()).fold(0.0, |a, b| if b > a { b } else { a });
        (within > 0.0 && within < 0.5 * self.distance.distance.lower()).then_some((share, within))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::{Diagonal, cube, grid};
    use pompeiu_core::mesh::{Affine, merge, transform};

    fn two_cubes() -> TriMesh {
        let small = transform(&cube(0.1, 1).unwrap(), &Affine::translate([9.0, 0.0, 0.0])).unwrap();
        merge(&[&cube(2.0, 2).unwrap(), &small]).unwrap()
    }

    #[test]
    fn what_is_left_out_is_stated() {
        let mesh = two_cubes();
        let part = Part::of(&mesh, |face| mesh.corners(face)[0][0] < 5.0).unwrap();
        assert_eq!((part.left_out.faces, part.left_out.components, part.faces.len()), (12, 1, 48));
        assert!(part.left_out.share.contains(0.06 / 24.06) && part.left_out.share.gap() < 1e-12);
        assert!(Part::of(&mesh, |_| false).is_none());
        let all = Part::of(&mesh, |_| true).unwrap();
        assert_eq!((all.left_out.faces, all.left_out.components, all.left_out.share.upper()), (0, 0, 0.0));
        let less = part.and(&mesh, |face| face.0 >= 10).unwrap();
        assert_eq!((less.faces[0], less.faces.len()), (FaceId(10), 38));
        let shares = component_shares(&mesh);
        assert!((shares[0] - 24.0 / 24.06).abs() < 1e-12 && (shares[50] - 0.06 / 24.06).abs() < 1e-12);
    }

    #[test]
    fn faces_beside_an_open_surface_do_not_lie_over_it() {
        let plate = |size: f64, cells: u32| grid([size, size], [cells, cells], Diagonal::Rising).unwrap();
        let middle = |mesh: &TriMesh| {
            let aabb = Aabb::of_faces(mesh);
            [0, 1, 2].map(|k| -0.5 * (aabb.lower[k] + aabb.upper[k]))
        };
        let centred = |mesh: TriMesh| transform(&mesh, &Affine::translate(middle(&mesh))).unwrap();
        let (large, small) = (centred(plate(4.0, 8)), centred(plate(2.0, 3)));
        let over = overlapping(&large, &small);
        for (face, over) in large.face_ids().zip(over) {
            let corners = large.corners(face);
            let [x, y] = [0, 1].map(|k| (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0);
            assert_eq!(over, x.abs() < 1.0 && y.abs() < 1.0, "{face:?}");
        }
        assert!(overlapping(&small, &large).iter().all(|over| *over));
        assert!(overlapping(&large, &cube(1.0, 1).unwrap()).iter().all(|over| *over));
    }

    #[test]
    fn parts_are_measured_to_the_whole_and_outliers_are_told() {
        let (a, b) = (cube(2.0, 2).unwrap(), two_cubes());
        let options = DeviationOptions::default();
        let whole = options.symmetric(&a, &b).unwrap();
        let (share, within) = whole.b_to_a.outlying_component(&b, 0.01).unwrap();
        assert!((share - 0.06 / 24.06).abs() < 1e-12 && within < 1e-9 + whole.b_to_a.floor);
        assert!(whole.a_to_b.outlying_component(&a, 0.01).is_none());
        // Without the first faces: they are counted as in the whole.
        let part = Part::of(&b, |face| face.0 >= 5).unwrap();
        let of_a = Part::of(&a, |_| true).unwrap();
        let pair = PreparedPair::new(&a, &b).with_parts([of_a, part.clone()]);
        let mut found = options.symmetric_of(&pair).unwrap();
        assert_eq!(found.a_to_b.distance.distance, whole.a_to_b.distance.distance);
        found.b_to_a.renumber(&part.faces);
        // The small cube has the last faces, in the whole as in the part.
        let upper = [&found, &whole].map(|deviation| deviation.b_to_a.distance.distance.upper());
        assert!((upper[0] - upper[1]).abs() < 1e-9);
        assert!(found.b_to_a.distance.witness.from.face.0 >= 48);
        assert_eq!(found.b_to_a.regions[0].faces, (48..60).map(FaceId).collect::<Vec<_>>());
    }

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
}
