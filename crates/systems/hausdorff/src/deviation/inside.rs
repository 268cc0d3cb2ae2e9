//! Whether points are inside a closed, oriented surface, by the faces nearest to them.
//!
//! From a point to its nearest point on the surface nothing is in the way. So the winding number about the point is that beside the face on
//! which the nearest point lies, on the side where the point is. Along faces that are neighbours and that no other face intersects, the winding
//! number on each side is constant: it is computed once for each such set of faces, on both sides. Where the nearest point lies on an
//! edge or a vertex, the point is on the side to which the mean of the normals there points; it is enough that it is in front of all faces
//! around, or behind all. Faces that may be nearest, within rounding, must all agree. Elsewhere, and beside faces that intersect others, the
//! winding number about the point itself decides.
//!
//! # Source
//! The sign of the distance by normals at edges and vertices: `baerentzen_signed_2005`. That intersections are exact, that sets of faces have
//! winding numbers of their own, and what counts as certain under rounding are ours.

#[cfg(feature = "figures")]
use super::across::neighbours;
use super::connected::Sets;
use crate::rounding::Rounding;
use glam::DVec3;
use pompeiu_core::TriMesh;
#[cfg(feature = "figures")]
use pompeiu_core::geom::Aabb;
use pompeiu_core::geom::Frame;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::{Bvh, Nearest, Slot, Winding, Workspace, self_intersections_in, winding_number};
use rayon::prelude::*;

/// Pairs of faces that may intersect, as a part of all faces; with more the winding number decides everywhere.
const MOST_INTERSECTING: f64 = 0.05;
/// Faces of a set that are tried until a point beside one of them has no other face near, and how far from the face that point is, as parts
/// of the longest edge.
const TRIALS: usize = 4;
const AWAY: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-5];
/// Sets of faces, at most, for which winding numbers are summed over all faces; more are worth a tree.
const FEW: usize = 4;
/// What rounding may do to a winding number, generously.
const ROUNDING: f64 = 1e-6;
/// A point is in front of a plane by this part of its distance, or as good as in the plane.
const IN_FRONT: f64 = 1e-3;
const IN_PLANE: f64 = 1e-12;
/// The least height of a triangle whose normal counts, as a part of its longest edge.
const LEAST_HEIGHT: f64 = 1e-6;
/// Cosine of the angle that normals of faces in whose planes a point lies may have between them. Less than that of the normals of a thin
/// wedge or needle, of which some pair is at least 120 degrees apart.
const LEAST_COSINE: f64 = -0.1;

/// Tells inside from outside of a closed, oriented surface.
pub(super) struct Inside<'t> {
    bvh: &'t Bvh,
    frame: &'t Frame,
    /// The set of each slot; [`NONE`] for faces that intersect others, and of sets of which nothing is known.
    set_of: Vec<u32>,
    /// Winding numbers behind and in front of the faces of each set.
    beside: Vec<[f64; 2]>,
    /// Decides where faces do not.
    winding: Option<Winding>,
    /// Distances are off by less than half of this.
    slack: f64,
    /// Points that are no farther than this may be on the surface.
    pub(super) touching: f64,
}

const NONE: u32 = u32::MAX;

/// What is kept from question to question.
#[derive(Default)]
pub(super) struct Scratch {
    pub(super) workspace: Workspace,
    pub(super) found: Vec<Nearest>,
}

/// Which faces intersect others; none if many do, or if the control stops.
pub(super) fn intersecting(
    mesh: &TriMesh,
    (bvh, frame): (&Bvh, &Frame),
    control: &Control,
) -> Option<Vec<bool>> {
    let most = (MOST_INTERSECTING * mesh.faces().len() as f64) as usize;
    let found = self_intersections_in(mesh, (bvh, frame), most, control);
    if control.is_stopped() || !found.complete {
        return None;
    }
    let mut intersects = vec![false; mesh.faces().len()];
    for face in found.pairs.iter().flat_map(|pair| pair.faces) {
        intersects[face.index()] = true;
    }
    Some(intersects)
}

impl<'t> Inside<'t> {
    /// Whether a winding number of a closed surface is that of a point inside.
    pub(super) fn is_inside(winding: f64) -> bool {
        winding.abs() > 0.5
    }

    /// Prepares a closed and oriented mesh with its tree and the neighbours of its faces. `None` if the control stops meanwhile.
    pub(super) fn new(
        mesh: &TriMesh,
        neighbours: &[[u32; 2]],
        (bvh, frame): (&'t Bvh, &'t Frame),
        rounding: Rounding,
        control: &Control,
    ) -> Option<Self> {
        let intersects = intersecting(mesh, (bvh, frame), control);
        if control.is_stopped() {
            return None;
        }
        let mut inside = Self {
            bvh,
            frame,
            set_of: vec![NONE; bvh.len()],
            beside: Vec::new(),
            winding: None,
            slack: 4.0 * rounding.bound(0),
            touching: 2.0 * rounding.bound(super::face::MOST_CUTS),
        };
        let Some(intersects) = intersects else {
            inside.winding = Some(Winding::new(mesh));
            return Some(inside);
        };
        let firsts = inside.divide(mesh, neighbours, &intersects);
        inside.number(mesh, &firsts);
        Some(inside)
    }

    /// Divides faces into sets of neighbours that no other face intersects; the first slots of each.
    fn divide(&mut self, mesh: &TriMesh, neighbours: &[[u32; 2]], intersects: &[bool]) -> Vec<Vec<Slot>> {
        let mut sets = Sets::new(mesh.faces().len());
        for face in (0..mesh.faces().len() as u32).filter(|face| !intersects[*face as usize]) {
            sets.enter(face, face);
        }
        for [one, two] in neighbours {
            if !intersects[*one as usize] && !intersects[*two as usize] {
                sets.join(*one, *two);
            }
        }
        let mut number_of = vec![NONE; mesh.faces().len()];
        let mut firsts: Vec<Vec<Slot>> = Vec::new();
        for slot in self.bvh.slots() {
            let face = self.bvh.face(slot);
            if intersects[face.index()] {
                continue;
            }
            let number = &mut number_of[sets.first(face.0) as usize];
            if *number == NONE {
                *number = firsts.len() as u32;
                firsts.push(Vec::new());
            }
            self.set_of[slot.index()] = *number;
            let of_set = &mut firsts[*number as usize];
            if of_set.len() < TRIALS {
                of_set.push(slot);
            }
        }
        firsts
    }

    /// Finds the winding numbers on both sides of each set. Sets of which they are not found count as intersecting others.
    fn number(&mut self, mesh: &TriMesh, firsts: &[Vec<Slot>]) {
        if firsts.len() > FEW {
            self.winding = Some(Winding::new(mesh));
        }
        let found: Vec<Option<[f64; 2]>> = firsts
            .par_iter()
            .map(|slots| {
                let mut scratch = Scratch::default();
                slots.iter().find_map(|slot| self.beside(mesh, *slot, &mut scratch))
            })
            .collect();
        self.beside = found.iter().map(|numbers| numbers.unwrap_or_default()).collect();
        for set in &mut self.set_of {
            if *set != NONE && found[*set as usize].is_none() {
                *set = NONE;
            }
        }
    }

    /// Winding numbers behind and in front of a face, at points with no other face as near.
    fn beside(&self, mesh: &TriMesh, slot: Slot, scratch: &mut Scratch) -> Option<[f64; 2]> {
        let (centre, normal, distances) = away_from(self.bvh, slot)?;
        distances.into_iter().find_map(|distance| {
            let mut numbers = [0.0; 2];
            for (number, side) in numbers.iter_mut().zip([-1.0, 1.0]) {
                let p = (centre + side * distance * normal).to_array();
                self.find(p, slot, scratch);
                let &[Nearest { distance_sq, slot: nearest }] = &scratch.found[..] else { return None };
                if nearest != slot || distance_sq.sqrt() <= self.touching {
                    return None;
                }
                *number = match &self.winding {
                    Some(winding) => decided(winding, self.frame.unmap(p))?,
                    None => winding_number(mesh, self.frame.unmap(p)).round(),
                };
            }
            Some(numbers)
        })
    }

    /// Lists the faces that may be nearest to a point in the frame.
    fn find(&self, p: [f64; 3], near: Slot, scratch: &mut Scratch) {
        self.bvh.all_nearest(p, near, self.slack, &mut scratch.workspace, &mut scratch.found);
    }

    /// The winding number about a point in the frame that is farther than [`Inside::touching`], as far as it is certain whether the point is
    /// inside. `near` is a face believed to be near.
    pub(super) fn about(&self, p: [f64; 3], near: Slot, scratch: &mut Scratch) -> Option<f64> {
        if self.beside.is_empty() {
            return self.by_winding(p);
        }
        self.find(p, near, scratch);
        self.by_faces(p, &scratch.found).or_else(|| self.by_winding(p))
    }

    /// The winding number about a point in the frame, if the faces that are nearest decide it. `near` is a face believed to be near.
    pub(super) fn by_nearest(&self, p: [f64; 3], near: Slot, scratch: &mut Scratch) -> Option<f64> {
        self.find(p, near, scratch);
        let is_free = |nearest: &Nearest| nearest.distance_sq.sqrt() > self.touching;
        if scratch.found.iter().all(is_free) { self.by_faces(p, &scratch.found) } else { None }
    }

    fn by_winding(&self, p: [f64; 3]) -> Option<f64> {
        decided(self.winding.as_ref()?, self.frame.unmap(p))
    }

    /// The winding number on the side of the nearest faces on which a point lies, if all agree.
    fn by_faces(&self, p: [f64; 3], nearest: &[Nearest]) -> Option<f64> {
        let mut answer = None;
        let p = DVec3::from_array(p);
        for &Nearest { distance_sq, slot } in nearest {
            let set = self.set_of[slot.index()];
            if set == NONE {
                return None;
            }
            let side = side_of(self.bvh, p, distance_sq, slot)?;
            let number = match side {
                Side::InPlane(_) => continue,
                Side::Behind => self.beside[set as usize][0],
                Side::InFront => self.beside[set as usize][1],
            };
            if answer.is_some_and(|answer| answer != (side, number)) {
                return None;
            }
            answer = Some((side, number));
        }
        let (_, number) = answer?;
        self.planes_leave_no_doubt(p, nearest, number).then_some(number)
    }

    /// Whether faces in whose planes a point lies could not outweigh the others in the mean of the normals.
    fn planes_leave_no_doubt(&self, p: DVec3, nearest: &[Nearest], number: f64) -> bool {
        let normals: Vec<DVec3> = nearest
            .iter()
            .filter_map(|one| match side_of(self.bvh, p, one.distance_sq, one.slot) {
                Some(Side::InPlane(normal)) => Some(normal),
                _ => None,
            })
            .collect();
        let is_apart = |i: usize, j: usize| normals[i].dot(normals[j]) < LEAST_COSINE;
        let opposite = (0..normals.len()).any(|i| (0..i).any(|j| is_apart(i, j)));
        let of_set = |one: &Nearest| self.beside[self.set_of[one.slot.index()] as usize];
        normals.is_empty() || !opposite && nearest.iter().all(|one| of_set(one).contains(&number))
    }

    /// Whether it is faces that decide, as a rule: there are few pairs that intersect.
    pub(super) fn is_by_faces(&self) -> bool {
        !self.beside.is_empty()
    }

    /// Prepares what decides where faces do not.
    pub(super) fn with_winding(&mut self, mesh: &TriMesh) {
        self.winding.get_or_insert_with(|| Winding::new(mesh));
    }
}

/// Whether points, in the unit of the mesh, are inside; none for points of which it is not certain, and none at all for a mesh that is not closed and
/// oriented, or of which many faces intersect.
#[cfg(feature = "figures")]
pub(super) fn of_points(points: &[[f64; 3]], mesh: &TriMesh) -> Option<Vec<Option<bool>>> {
    const TASK: usize = 256;
    let neighbours = neighbours(mesh)?;
    let frame = Frame::of(&Aabb::of_faces(mesh));
    let bvh = Bvh::build(mesh, &frame);
    let around = points.iter().fold(Aabb::of_faces(mesh), |around, p| around.union(Aabb::of_points([p])));
    let rounding = Rounding::new(frame.max_coordinate(&around));
    let inside = Inside::new(mesh, &neighbours, (&bvh, &frame), rounding, &Control::default())?;
    let of_task = |points: &[[f64; 3]]| {
        let mut scratch = Scratch::default();
        let of_point = |p: &[f64; 3]| {
            let p = frame.map(*p);
            let near = bvh.some_near(p, &mut scratch.workspace);
            let is_free = bvh.distance_sq(p, near) > 0.0;
            let number = inside.about(p, near, &mut scratch).filter(|_| is_free);
            number.map(Inside::is_inside)
        };
        points.iter().map(of_point).collect::<Vec<_>>()
    };
    inside.is_by_faces().then(|| points.par_chunks(TASK).flat_map_iter(of_task).collect())
}

/// The winding number about a point, if it is certain on which side of one half it is.
fn decided(winding: &Winding, point: [f64; 3]) -> Option<f64> {
    let number = winding.about(point);
    ((number.value.abs() - 0.5).abs() > number.error + ROUNDING).then(|| number.value.round())
}

/// On which side of the plane of a face a point at this distance of it lies, if that is certain.
pub(super) fn side_of(bvh: &Bvh, p: DVec3, distance_sq: f64, slot: Slot) -> Option<Side> {
    let [a, b, c] = bvh.corners(slot).map(DVec3::from_array);
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let normal = ab.cross(ac);
    let (size, height) = (normal.length(), normal.dot(ap));
    let doubt = 64.0 * f64::EPSILON * ab.length() * ac.length() * ap.length();
    let far = distance_sq.sqrt() * size;
    let longest_sq = ab.length_squared().max(ac.length_squared()).max((c - b).length_squared());
    if height.abs() > doubt && (height.abs() > IN_FRONT * far && size > LEAST_HEIGHT * longest_sq) {
        return Some(if height > 0.0 { Side::InFront } else { Side::Behind });
    }
    (height.abs() + doubt <= IN_PLANE.max(64.0 * f64::EPSILON) * far).then(|| Side::InPlane(normal / size))
}

/// The centroid of a face, its normal, and distances at which points are beside it; none of a face without area.
pub(super) fn away_from(bvh: &Bvh, slot: Slot) -> Option<(DVec3, DVec3, [f64; 4])> {
    let [a, b, c] = bvh.corners(slot).map(DVec3::from_array);
    let normal = (b - a).cross(c - a).try_normalize()?;
    let size = (b - a).length().max((c - a).length()).max((c - b).length());
    Some(((a + b + c) * (1.0 / 3.0), normal, AWAY.map(|away| away * size)))
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Side {
    InFront,
    Behind,
    /// As good as in the plane with this normal.
    InPlane(DVec3),
}
