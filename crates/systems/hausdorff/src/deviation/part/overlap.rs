//! The points over another surface, not beside it.
//!
//! A point lies beside a surface where the nearest point of it is on its boundary, as the bottom of a model does where a scan has no bottom. That
//! alone is no stable test: where the walls of the scan end a hair below that bottom, the nearest points of all of the bottom are inner points of the
//! walls. So a point counts as over the surface where the boundary is more than a quarter farther away than the surface. A point at some height over the
//! surface is then left out within three quarters of that height of the boundary, and below walls that end a length beyond the bottom no point is kept
//! that is farther from them than 4/3 of that length.
//!
//! Nor does a point lie over a surface that it sees from behind only: the nearest point of the bottom of a plate, where the scan has none, is on the back of
//! the top. Where both surfaces are oriented, as told by the points of each and their nearest points on the other one, points whose nearest face is
//! turned away from theirs, by more than 120 degrees, are left out as well. At 90 degrees they stay: so are the sides of a rib that is missing.
//!
//! With `g(p)` as the distance from the boundary less 5/4 of that from the surface, `g` changes by no more than 9/4 of the way
//! that `p` goes. So what `g` is at the middle of a triangle settles all of it, unless it is nearly zero there.

use super::Part;
use super::pieces::{Fate, finest};
use crate::PreparedPair;
use crate::deviation::frame_of;
use crate::report::Direction;
use crate::target::Target;
use glam::DVec3;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::mesh::first_at_position;
use pompeiu_core::run::{Control, Limits};
use pompeiu_core::spatial::{Bvh, Leaves, Slot, Workspace, morton_order};
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;

/// How many times as far as the surface its boundary must be.
const RATIO: f64 = 1.25;
/// The cosine of the angle between two normals below which faces look away from each other.
const AWAY: f64 = -0.5;
/// The part of the area that must agree on whether both surfaces are oriented alike, and faces that are asked at most.
const AGREED: f64 = 0.8;
const ASKED: usize = 2048;
/// Triangles with a radius of so many finest lengths are looked at in their corners, too, for the way that the nearest faces look.
const LARGE: f64 = 4.0;
/// Lengths in a frame, which has a size of about one, that rounding does not tell from zero.
const SAME: f64 = 1e-12;

impl Part {
    /// The points of a part of one mesh of a pair that lie over the other one rather than beside it: its boundary, where an edge belongs to one face,
    /// is more than a quarter farther from them than its surface, and the nearest face is not turned away where both are oriented. Over a closed surface
    /// all do. None if there is no such point.
    ///
    /// # Accuracy
    /// Each triangle of what is kept consists of such points, and each that is left out of others, but for triangles with edges shorter than a part in
    /// 2048 of the root of the area of the smaller mesh, of which the middle decides.
    #[must_use]
    pub fn over(&self, pair: &PreparedPair<'_>, direction: Direction) -> Option<Self> {
        self.over_until(pair, direction, &Control::start(&Limits::default()))
    }

    /// The same; faces are cut no further once that is stopped.
    pub(crate) fn over_until(
        &self,
        pair: &PreparedPair<'_>,
        direction: Direction,
        control: &Control,
    ) -> Option<Self> {
        let Some(boundary) = boundary(pair.other(direction)) else { return Some(self.clone()) };
        let frame = frame_of(pair.a(), pair.b()).0;
        let (surface, boundary) =
            (pair.target(direction, frame), Target::in_frame(&boundary, frame, Leaves::Compact));
        let trees = [surface.bvh(), boundary.bvh()];
        let whole = pair.whole(direction);
        let finest = finest(pair, &frame);
        let over = Over { frame, trees, sense: sense(pair, frame), finest: frame.length_in(finest) };
        self.cut(whole, finest, &mut |mesh| {
            let fates = over.fates(mesh);
            let decided = |fate| match fate {
                Fate::Open(true) => Fate::Kept,
                Fate::Open(false) => Fate::LeftOut,
                fate => fate,
            };
            if control.is_stopped() { fates.into_iter().map(decided).collect() } else { fates }
        })
    }
}

/// What triangles are compared with.
struct Over<'o> {
    frame: Frame,
    /// Of the surface, and of its boundary.
    trees: [&'o Bvh; 2],
    /// Whether both surfaces are oriented alike, 1, or oppositely, -1; 0 where that cannot be told.
    sense: f64,
    /// The length below which edges are not cut, in the frame.
    finest: f64,
}

impl Over<'_> {
    fn fates(&self, mesh: &TriMesh) -> Vec<Fate> {
        let order = morton_order(mesh, &Aabb::of_faces(mesh));
        let of_task = |task: &[u32]| -> Vec<Fate> {
            let mut workspace = Workspace::default();
            let mut fate = |face: &u32| {
                let corners = mesh.corners(FaceId(*face)).map(|p| DVec3::from_array(self.frame.map(p)));
                self.fate(corners, &mut workspace)
            };
            task.iter().map(&mut fate).collect()
        };
        let found: Vec<Fate> = order.par_chunks(256).flat_map_iter(of_task).collect();
        let mut fates = vec![Fate::LeftOut; found.len()];
        for (face, fate) in order.iter().zip(found) {
            fates[*face as usize] = fate;
        }
        fates
    }

    fn fate(&self, corners: [DVec3; 3], workspace: &mut Workspace) -> Fate {
        let [surface, boundary] = self.trees;
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let reach = corners.map(|p| p.distance_squared(centre));
        let radius = reach.into_iter().fold(0.0, |most, x| if x > most { x } else { most }).sqrt();
        let nearest = surface.nearest(centre.to_array(), surface.any_slot(), workspace);
        let rim = boundary.nearest(centre.to_array(), boundary.any_slot(), workspace).distance_sq.sqrt();
        let over = rim - RATIO * nearest.distance_sq.sqrt();
        let doubt = (1.0 + RATIO) * radius + SAME;
        if over < -doubt {
            return Fate::LeftOut;
        }
        let normal = normal(corners);
        let mut is_behind = |slot: Slot| self.sense * cosine(normal, surface.corners(slot)) < AWAY;
        let behind = is_behind(nearest.slot);
        let in_corners = if radius > LARGE * self.finest && self.sense != 0.0 {
            let slots = corners.map(|p| surface.nearest(p.to_array(), nearest.slot, workspace).slot);
            slots.map(&mut is_behind)
        } else {
            [behind; 3]
        };
        match (behind, in_corners) {
            (true, [true, true, true]) => Fate::LeftOut,
            (false, [false, false, false]) if over > doubt => Fate::Kept,
            _ => Fate::Open(!behind && over > SAME),
        }
    }
}

/// Whether both surfaces of a pair are oriented alike, oppositely, or neither.
fn sense(pair: &PreparedPair<'_>, frame: Frame) -> f64 {
    let [there, back] = [Direction::AToB, Direction::BToA].map(|direction| votes(pair, direction, frame));
    // A part that is not shown may be near the back of another one; of a scan all points have a counterpart.
    let most = if back.abs() > there.abs() { back } else { there };
    if most.abs() > AGREED { most.signum() } else { 0.0 }
}

/// The mean of the cosines between the normals of faces and of those nearest to them, by area, relative to the mean of their sizes.
fn votes(pair: &PreparedPair<'_>, direction: Direction, frame: Frame) -> f64 {
    let (mesh, target) = (pair.whole(direction), pair.target(direction, frame));
    let bvh = target.bvh();
    let order = morton_order(mesh, &Aabb::of_faces(mesh));
    let mut workspace = Workspace::default();
    let (mut sum, mut all) = (0.0, 0.0);
    for face in order.iter().step_by(order.len().div_ceil(ASKED)) {
        let corners = mesh.corners(FaceId(*face)).map(|p| DVec3::from_array(frame.map(p)));
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let nearest = bvh.nearest(centre.to_array(), bvh.any_slot(), &mut workspace);
        let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
        let cosine = cosine(normal(corners), bvh.corners(nearest.slot));
        sum += area * cosine;
        all += area * cosine.abs();
    }
    if all > 0.0 { sum / all } else { 0.0 }
}

fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

/// The cosine of the angle between a normal and that of a face.
fn cosine(normal_of_one: DVec3, other: [[f64; 3]; 3]) -> f64 {
    normal_of_one.dot(normal(other.map(DVec3::from_array)))
}

/// The edges that belong to one face, as triangles without area; none of a closed surface.
fn boundary(mesh: &TriMesh) -> Option<TriMesh> {
    let place = first_at_position(mesh.positions());
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deviation::DeviationOptions;
    use pompeiu_core::mesh::shapes::{Diagonal, cube, grid};
    use pompeiu_core::mesh::{Affine, displace_at_random, transform};

    fn plate(size: f64, cells: u32, height: f64) -> TriMesh {
        let plate = grid([size, size], [cells, cells], Diagonal::Rising).unwrap();
        let aabb = Aabb::of_faces(&plate);
        let middle = [0, 1].map(|k| -0.5 * (aabb.lower[k] + aabb.upper[k]));
        transform(&plate, &Affine::translate([middle[0], middle[1], height])).unwrap()
    }

    fn all(mesh: &TriMesh) -> Part {
        Part::of(mesh, |_| true).unwrap()
    }

    fn over(a: &TriMesh, b: &TriMesh) -> Option<Part> {
        all(a).over(&PreparedPair::new(a, b), Direction::AToB)
    }

    /// Two faces that reach far over the rim of a plate below them count as far as the plate covers them.
    #[test]
    fn coarse_faces_are_cut_beside_an_open_surface() {
        let (large, small) = (plate(4.0, 1, 0.0), plate(2.0, 3, -0.1));
        let kept = over(&large, &small).unwrap();
        assert_eq!((kept.left_out.faces, kept.left_out.cut, kept.left_out.components), (0, 2, 1));
        // Points with the height as distance, from which the rim is a quarter farther: three quarters of the height beside it.
        let finest = 2.0 / 2048.0;
        assert!(
            kept.left_out.share.contains(1.0 - 1.85 * 1.85 / 16.0) || {
                let share = kept.left_out.share.lower();
                (share - (1.0 - 1.85 * 1.85 / 16.0)).abs() < 4.0 * 1.85 * finest / 16.0
            }
        );
        for face in kept.mesh.face_ids() {
            let inside = |p: [f64; 3]| p[0].abs() < 0.925 + finest && p[1].abs() < 0.925 + finest;
            assert!(kept.mesh.corners(face).into_iter().all(inside));
        }
        // On the other side the plate is larger, and a closed surface has no rim.
        assert_eq!(over(&small, &large).unwrap().left_out.share.upper(), 0.0);
        assert_eq!(over(&large, &cube(1.0, 1).unwrap()).unwrap().left_out.faces, 0);
        assert!(
            over(&plate(1.0, 1, 0.0), &transform(&small, &Affine::translate([9.0, 0.0, 0.0])).unwrap())
                .is_none()
        );
    }

    /// A plate that was scanned from above: the nearest points of its lower side are on the back of the upper one.
    #[test]
    fn the_back_of_a_surface_is_not_what_lies_over_it() {
        let model = cube(1.0, 1).unwrap();
        let flat = Affine::scale([20.0, 20.0, 1.0]);
        let model = transform(&model, &flat).unwrap();
        let fine = transform(&cube(1.0, 8).unwrap(), &flat).unwrap();
        let top = Aabb::of_faces(&fine).upper[2];
        let shown: Vec<[u32; 3]> = fine
            .face_ids()
            .filter(|face| fine.corners(*face).into_iter().all(|p| p[2] == top))
            .map(|face| fine.faces()[face.index()])
            .collect();
        for turned in [false, true] {
            let faces =
                shown.iter().map(|[a, b, c]| if turned { [*a, *c, *b] } else { [*a, *b, *c] }).collect();
            let scan = TriMesh::new(fine.positions().to_vec(), faces).unwrap();
            let kept = over(&model, &scan).unwrap();
            assert!(
                kept.mesh.face_ids().all(|face| kept.mesh.corners(face).iter().all(|p| p[2] > top - 0.1))
            );
            let share = 400.0 / (2.0 * 400.0 + 4.0 * 20.0);
            assert!((1.0 - kept.left_out.share.lower() - share).abs() < 2e-3, "{:?}", kept.left_out);
        }
    }

    /// A block with two faces a side, and a scan of it without its bottom and with holes in other sides, whose points are off by up to .05, so that its
    /// walls end above and below the bottom that was not scanned.
    #[test]
    fn what_a_scan_does_not_show_is_not_measured() {
        let (model, fine) = (cube(10.0, 1).unwrap(), cube(10.0, 24).unwrap());
        let noise = 0.05;
        let positions = displace_at_random(&fine, noise, 7).unwrap().positions().to_vec();
        let low = Aabb::of_faces(&model).lower;
        let holes = [([10.0, 5.0, 6.0], 2.0), ([6.0, 0.0, 4.0], 1.0)];
        let shown = |face: &FaceId| {
            let [a, b, c] = fine.corners(*face);
            let centre = [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0);
            let in_hole = |(at, radius): ([f64; 3], f64)| {
                (0..3).map(|k| (centre[k] - low[k] - at[k]).powi(2)).sum::<f64>() < radius * radius
            };
            centre[2] > low[2] + 1e-9 && !holes.into_iter().any(in_hole)
        };
        let faces: Vec<FaceId> = fine.face_ids().filter(shown).collect();
        let corners = faces.iter().map(|face| fine.faces()[face.index()]).collect();
        let scan = TriMesh::new(positions, corners).unwrap();
        let pair = PreparedPair::new(&model, &scan);
        let parts = [
            all(&model).over(&pair, Direction::AToB).unwrap(),
            all(&scan).over(&pair, Direction::BToA).unwrap(),
        ];
        // The bottom, both holes, and little else.
        let missing = (100.0 + std::f64::consts::PI * (4.0 + 1.0)) / 600.0;
        let share = parts[0].left_out.share;
        assert!((share.lower() - missing).abs() < 0.01, "{share:?} {missing}");
        let options = DeviationOptions { accuracy: 0.3, regions: 0, ..DeviationOptions::default() };
        let found = options.symmetric_of(&pair.with_parts(parts)).unwrap();
        let farthest = found.distance.upper();
        assert!(farthest < 2.0 * noise, "{farthest}");
    }
}
