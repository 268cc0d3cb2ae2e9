//! Self-intersections: faces of a mesh that meet although they are not neighbours.

use super::bvh::{Bvh, Slot};
use crate::exact::common_point;
use crate::geom::point_triangle::LANES;
use crate::geom::{Aabb, Frame};
use crate::mesh::topology::is_degenerate;
use crate::mesh::{FaceId, TriMesh};
use crate::run::Control;
use glam::DVec3;
use rayon::prelude::*;

/// Pairs of faces that intersect.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SelfIntersections {
    /// Each pair once, the lesser index first, in order; with a point of both faces, rounded.
    pub pairs: Vec<IntersectingPair>,
    /// Number of further pairs that only touch, where different vertices are at one position.
    pub touching: usize,
    /// Whether these are all; otherwise there were more than asked for.
    pub complete: bool,
}

/// Two faces with a common point other than what neighbours share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntersectingPair {
    /// Both faces, the lesser index first.
    pub faces: [FaceId; 2],
    /// A point near both, in the unit of the mesh.
    pub place: [f64; 3],
}

/// Faces of a task.
const TASK: usize = 256;

/// Tasks between two checks of the number of pairs.
const ROUND: usize = 256;

/// Faces farther than this part of the greatest coordinate do not meet, whatever rounding does (see [`Bvh::keep_leaves_near`]).
const BESIDE: f64 = 32.0 * f64::EPSILON;

/// Finds the pairs of faces that intersect.
///
/// # Definition
/// Faces are closed triangles. Two intersect if they have a point in common; those that share a corner by position, if they have
/// another one away from it; those that share an edge, if they lie in one plane and overlap. Faces without area do not count. Pairs
/// that share only a position, with a different vertex there, are counted separately. A program that identifies corners by their
/// vertices, as CGAL does, finds as many pairs as both counts together.
/// # Accuracy
/// Exact; see [`common_point`]. Coordinates are scaled by a power of two and, where the mesh lies far from zero, shifted, both without
/// rounding (see [`Frame`]). Coordinates that differ by less than 2^-200 of the size of the mesh may be taken as equal.
/// # Limits
/// At most `most_pairs` are returned, those of faces that are first in the tree.
/// # Cost
/// O(m log m + candidates): pairs of faces whose boxes meet. Some 100 bytes per face and 40 per pair.
/// # Example
/// ```
/// use pompeiu_core::mesh::{merge, shapes::icosphere, transform, Affine};
/// use pompeiu_core::spatial::self_intersections;
///
/// let ball = icosphere(1.0, 2)?;
/// assert!(self_intersections(&ball, 100).pairs.is_empty());
/// let shifted = transform(&ball, &Affine::translate([0.5, 0.1, 0.2]))?;
/// assert!(!self_intersections(&merge(&[&ball, &shifted])?, 100).pairs.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn self_intersections(mesh: &TriMesh, most_pairs: usize) -> SelfIntersections {
    let frame = Frame::of(&Aabb::of_faces(mesh));
    self_intersections_in(mesh, (&Bvh::build(mesh, &frame), &frame), most_pairs, &Control::default())
}

/// [`self_intersections`] where the tree of the mesh in a frame is known. The frame must map all coordinates of the mesh without rounding.
/// When the control stops, not all pairs are found.
pub fn self_intersections_in(
    mesh: &TriMesh,
    (bvh, frame): (&Bvh, &Frame),
    most_pairs: usize,
    control: &Control,
) -> SelfIntersections {
    let slots: Vec<Slot> = bvh.slots().collect();
    let boxes: Vec<Aabb> = slots.par_iter().map(|s| Aabb::of_points(&bvh.corners(*s))).collect();
    let beside = BESIDE * boxes.iter().map(Aabb::max_coordinate).fold(0.0, f64::max);
    let mut found = SelfIntersections { pairs: Vec::new(), touching: 0, complete: true };
    for round in slots.chunks(TASK * ROUND) {
        let of_task = |task: &[Slot]| {
            if control.is_stopped() {
                SelfIntersections::default()
            } else {
                of_task(mesh, bvh, (&boxes, beside), task, most_pairs)
            }
        };
        let tasks: Vec<SelfIntersections> = round.par_chunks(TASK).map(of_task).collect();
        for task in tasks {
            found.complete &= task.complete;
            found.touching += task.touching;
            found.pairs.extend(task.pairs);
        }
        if found.pairs.len() > most_pairs {
            found.complete = false;
        }
        if !found.complete {
            found.pairs.truncate(most_pairs);
            break;
        }
    }
    for pair in &mut found.pairs {
        pair.place = frame.unmap(pair.place);
    }
    found.pairs.sort_unstable_by_key(|pair| pair.faces);
    found
}

/// Whether two faces have a common point other than what neighbours share, as [`self_intersections`] decides it.
///
/// # Accuracy
/// Exact; see [`common_point`] for coordinates that differ in size.
pub fn faces_intersect(one: &[[f64; 3]; 3], other: &[[f64; 3]; 3]) -> bool {
    !Plane::of(one).is_apart_from(other) && common_point(one, other).is_some()
}

/// The pairs of the faces of some slots with those of later slots. Leaves farther than `beside` are left out.
fn of_task(
    mesh: &TriMesh,
    bvh: &Bvh,
    (boxes, beside): (&[Aabb], f64),
    task: &[Slot],
    most: usize,
) -> SelfIntersections {
    let mut found = SelfIntersections { complete: true, ..SelfIntersections::default() };
    let (mut stack, mut leaves, mut near, mut others) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    // The tree is walked once for the faces of a leaf.
    for group in task.chunks(LANES) {
        let of_group = group.iter().map(|slot| boxes[slot.index()]).reduce(Aabb::union);
        let (Some(around), Some(first)) = (of_group, group.first()) else { continue };
        leaves.clear();
        bvh.leaves_meeting(around.lower, around.upper, &mut stack, &mut leaves);
        let corners = group.iter().flat_map(|slot| bvh.corners(*slot));
        bvh.keep_leaves_near(&mut leaves, bvh.corners(*first), corners, beside);
        near.clear();
        for (leaf, _) in &leaves {
            let slots = (0..LANES).map(|lane| bvh.slot_in(*leaf, lane));
            let is_near = |slot: &Slot| slot > first && around.meets(&boxes[slot.index()]);
            near.extend(slots.filter(is_near));
        }
        bvh.remove_repeats(&mut near);
        others.clear();
        others.extend(near.iter().map(|slot| (*slot, boxes[slot.index()])));
        for &slot in group {
            let (own, corners) = (&boxes[slot.index()], bvh.corners(slot));
            let plane = Plane::of(&corners);
            for (other, _) in others.iter().filter(|(other, aabb)| *other > slot && own.meets(aabb)) {
                let other = *other;
                let mut faces = [bvh.face(slot), bvh.face(other)];
                faces.sort_unstable();
                let of_other = bvh.corners(other);
                match if plane.is_apart_from(&of_other) { None } else { common_point(&corners, &of_other) } {
                    Some(place) => found.pairs.push(IntersectingPair { faces, place }),
                    None => found.touching += usize::from(touch(mesh, faces)),
                }
                if found.pairs.len() > most {
                    found.pairs.truncate(most);
                    found.complete = false;
                    return found;
                }
            }
        }
    }
    found
}

/// The plane of a triangle, rounded.
struct Plane<'t> {
    corners: &'t [[f64; 3]; 3],
    normal: DVec3,
    /// Bound on the error of a height, as a part of the distance from the first corner.
    error: f64,
}

impl<'t> Plane<'t> {
    fn of(corners: &'t [[f64; 3]; 3]) -> Self {
        let [a, b, c] = corners.map(DVec3::from_array);
        let (ab, ac) = (b - a, c - a);
        // Differences, products and sums are each off by half of epsilon, relative to the sum of magnitudes.
        let error = 16.0 * f64::EPSILON * ab.abs().element_sum() * ac.abs().element_sum();
        Self { corners, normal: ab.cross(ac), error }
    }

    /// Whether another triangle certainly meets this one in common corners only, as some plane between them shows.
    fn is_apart_from(&self, other: &[[f64; 3]; 3]) -> bool {
        self.is_beside(other)
            || Plane::of(other).is_beside(self.corners)
            || are_separated(self.corners, other)
    }

    /// Whether all corners of another triangle that are not corners of this one certainly lie on one side: then only common corners meet.
    fn is_beside(&self, other: &[[f64; 3]; 3]) -> bool {
        let a = DVec3::from_array(self.corners[0]);
        let mut sides = [false; 2];
        for q in other.iter().filter(|q| !self.corners.contains(q)) {
            let away = DVec3::from_array(*q) - a;
            let height = self.normal.dot(away);
            if height.abs() <= self.error * away.abs().element_sum() + f64::MIN_POSITIVE {
                return false;
            }
            sides[usize::from(height > 0.0)] = true;
        }
        sides[0] != sides[1]
    }
}

/// Whether a plane certainly separates two triangles but for a common corner. For faces in one plane, whose signs exact arithmetic alone tells, and of which
/// hundreds may meet in a vertex: across the directions in which both leave that, or across their longest edges.
fn are_separated(one: &[[f64; 3]; 3], other: &[[f64; 3]; 3]) -> bool {
    let mut common = one.iter().filter(|p| other.contains(p));
    let (origin, shared) = match (common.next(), common.next()) {
        (Some(p), None) => (*p, true),
        (None, _) => (one[0], false),
        _ => return false,
    };
    let [s, t] = [one, other].map(|t| t.map(|p| DVec3::from_array(p) - DVec3::from_array(origin)));
    let is_apart = |normal: DVec3| {
        // Differences, products and sums are each off by half of epsilon, relative to the sum of magnitudes.
        let ends = |p: DVec3| {
            let (at, error) =
                (normal.dot(p), 16.0 * f64::EPSILON * normal.abs().dot(p.abs()) + f64::MIN_POSITIVE);
            if p == DVec3::ZERO { [0.0; 2] } else { [at - error, at + error] }
        };
        let least = |t: &[DVec3; 3]| t.iter().map(|p| ends(*p)[0]).fold(f64::INFINITY, f64::min);
        let most = |t: &[DVec3; 3]| t.iter().map(|p| ends(*p)[1]).fold(f64::NEG_INFINITY, f64::max);
        if !shared {
            return least(&s) > most(&t) || least(&t) > most(&s);
        }
        let away = |p: &DVec3| *p != DVec3::ZERO;
        s.iter().filter(|p| away(p)).all(|p| ends(*p)[0] > 0.0)
            && t.iter().filter(|p| away(p)).all(|p| ends(*p)[1] < 0.0)
    };
    if shared {
        let directions = |t: &[DVec3; 3]| t.iter().map(|p| p.normalize_or_zero()).sum::<DVec3>();
        return is_apart(directions(&s) - directions(&t));
    }
    let across = |t: &[DVec3; 3]| {
        let edges = [t[1] - t[0], t[2] - t[1], t[0] - t[2]];
        let longest =
            edges.into_iter().reduce(|a, b| if b.length_squared() > a.length_squared() { b } else { a });
        longest.map_or(DVec3::ZERO, |longest| edges[0].cross(edges[1]).cross(longest))
    };
    is_apart(across(&s)) || is_apart(across(&t))
}

/// Whether different vertices of two faces with area are at one position.
fn touch(mesh: &TriMesh, faces: [FaceId; 2]) -> bool {
    let positions = mesh.positions();
    let [one, two] = faces.map(|f| mesh.faces()[f.index()]);
    let same = |v: u32, w: u32| v != w && positions[v as usize] == positions[w as usize];
    one.into_iter().any(|v| two.into_iter().any(|w| same(v, w)))
        && faces.into_iter().all(|f| !is_degenerate(mesh.corners(f)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::{Ends, cube, cylinder, icosphere, torus};
    use crate::mesh::{Affine, displace_at_random, merge, shuffle, transform, unweld};

    fn by_brute_force(mesh: &TriMesh) -> Vec<[FaceId; 2]> {
        let corners: Vec<_> = mesh.face_ids().map(|f| mesh.corners(f)).collect();
        let mut pairs = Vec::new();
        for i in 0..corners.len() {
            for j in i + 1..corners.len() {
                if common_point(&corners[i], &corners[j]).is_some() {
                    pairs.push([FaceId(i as u32), FaceId(j as u32)]);
                }
            }
        }
        pairs
    }

    fn pairs(mesh: &TriMesh) -> Vec<[FaceId; 2]> {
        let found = self_intersections(mesh, usize::MAX);
        assert!(found.complete);
        for pair in &found.pairs {
            for f in pair.faces {
                let [a, b, c] = mesh.corners(f);
                assert!(crate::geom::point_triangle::distance_sq(pair.place, a, b, c) < 1e-2, "{pair:?}");
            }
        }
        found.pairs.iter().map(|pair| pair.faces).collect()
    }

    #[test]
    fn sound_meshes_have_none_welded_or_not() {
        for mesh in [cube(2.0, 4).unwrap(), icosphere(1.0, 3).unwrap(), torus(2.0, 0.5, 24, 12).unwrap()] {
            assert_eq!(
                self_intersections(&mesh, 9),
                SelfIntersections { complete: true, ..Default::default() }
            );
            // Each pair of neighbours: at a vertex of valence n there are n (n - 1) / 2, and those at an edge are there twice.
            let loose = unweld(&mesh).unwrap();
            let mut valence = vec![0; mesh.positions().len()];
            mesh.faces().iter().flatten().for_each(|v| valence[*v as usize] += 1);
            let at_vertices: usize = valence.iter().map(|n| n * (n - 1) / 2).sum();
            let found = self_intersections(&loose, 9);
            assert!(found.pairs.is_empty() && found.complete);
            assert_eq!(found.touching, at_vertices - 3 * mesh.faces().len() / 2);
        }
    }

    /// Long faces are in several leaves of the tree.
    #[test]
    fn pairs_of_long_faces_are_found_once() {
        let tube = cylinder(0.1, 4.0, 40, 1, Ends::Open).unwrap();
        let tilted = transform(&tube, &Affine::rotate([1.0, 2.0, 0.5], 50.0).unwrap()).unwrap();
        let other = transform(&tube, &Affine::rotate([2.0, -1.0, 0.3], 65.0).unwrap()).unwrap();
        let mesh = merge(&[&tilted, &other]).unwrap();
        let all = by_brute_force(&mesh);
        assert!(all.len() > 20);
        assert_eq!(pairs(&mesh), all);
        let touching = |mesh: &TriMesh| self_intersections(mesh, usize::MAX).touching;
        assert_eq!(touching(&unweld(&tilted).unwrap()), touching(&unweld(&tube).unwrap()));
    }

    #[test]
    fn the_tree_finds_what_all_pairs_show() {
        let ball = icosphere(1.0, 2).unwrap();
        let moved = transform(&ball, &Affine::translate([0.7, 0.2, 0.1])).unwrap();
        let rough = displace_at_random(&ball, 0.3, 5).unwrap();
        for mesh in [merge(&[&ball, &moved]).unwrap(), rough, merge(&[&ball, &ball]).unwrap()] {
            let all = by_brute_force(&mesh);
            assert!(all.len() > 20);
            assert_eq!(pairs(&mesh), all);
            assert_eq!(pairs(&shuffle(&mesh, 3)).len(), all.len());
            let some = self_intersections(&mesh, 7);
            assert!(!some.complete && some.pairs.len() == 7);
        }
    }
}
