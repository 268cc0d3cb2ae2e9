//! Winding numbers of surfaces with a boundary, by the faces nearest to points.
//!
//! From a point to its nearest point on the surface nothing is in the way, and along faces that are neighbours and that no other face intersects a way leads
//! in front of them, and one behind. On all of these ways the winding number changes by no more than the boundary lets it ([`Boundary::variation`]),
//! and from the front of a face to what is behind it by one. So faces are divided into patches along which it hardly changes: of each the number is
//! computed once. Where this does not decide, as beside the boundary, the winding number about the point itself does.
//!
//! # Source
//! That the number changes along a way by an integral along the boundary is the law of Biot and Savart; patches and their bounds are ours.

use super::across::pairs;
use super::boundary::Boundary;
use super::inside::{Scratch, Side, away_from, intersecting, side_of};
use crate::rounding::Rounding;
use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Frame;
use pompeiu_core::mesh::first_at_position;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::{Bvh, Nearest, Slot, Winding, WindingNumber};
use rayon::prelude::*;
use std::collections::VecDeque;

/// Edges of the boundary, as a part of all faces; with more, numbers vary too much beside most faces.
const MOST_OPEN: f64 = 0.05;
/// How much the number may vary along a patch, how accurate it is computed there, and how much it may vary over the face that a patch begins with.
const MOST_ALONG: f64 = 0.2;
const MOST_ERROR: f64 = 0.05;
const MOST_AT_FIRST: f64 = 0.2;
/// Faces of a patch that are tried until a point in front of one of them has no other face near.
const TRIALS: usize = 4;
/// What rounding may do to a winding number, generously; and to a length, as a part of it.
const ROUNDING: f64 = 1e-6;
const MORE: f64 = 1.0 + 1e-9;

const NONE: u32 = u32::MAX;

/// Tells winding numbers of a surface with a boundary.
pub(super) struct Patches<'t> {
    bvh: &'t Bvh,
    is_sheet: bool,
    /// The patch of each slot; [`NONE`] for faces that intersect others or are beside the boundary, and of patches whose number is not known.
    patch_of: Vec<u32>,
    numbers: Vec<Patch>,
    /// Distances are off by less than half of this.
    slack: f64,
    /// Points that are no farther than this may be on the surface.
    touching: f64,
}

/// The winding number in front of the faces of a patch.
#[derive(Clone, Copy, Default)]
struct Patch {
    front: f64,
    error: f64,
}

/// The first faces of a patch, and how much the number may differ between the very first and any other.
#[derive(Default)]
struct Found {
    firsts: Vec<Slot>,
    along: f64,
}

impl<'t> Patches<'t> {
    /// Prepares a mesh with its tree. `None` where much of it is boundary or intersects itself, or if the control stops.
    pub(super) fn new(
        mesh: &TriMesh,
        (winding, boundary): (&Winding, &Boundary),
        (bvh, frame): (&'t Bvh, &Frame),
        rounding: Rounding,
        control: &Control,
    ) -> Option<Self> {
        if boundary.len() as f64 > MOST_OPEN * mesh.faces().len() as f64 {
            return None;
        }
        let intersects = intersecting(mesh, (bvh, frame), control)?;
        let mut open = Self {
            bvh,
            is_sheet: winding.is_sheet(),
            patch_of: vec![NONE; bvh.len()],
            numbers: Vec::new(),
            slack: 4.0 * rounding.bound(0),
            touching: 2.0 * rounding.bound(super::face::MOST_CUTS),
        };
        let patches = open.divide(mesh, boundary, &intersects);
        let number = |patch: &Found| {
            let mut scratch = Scratch::default();
            patch.firsts.iter().enumerate().find_map(|(i, slot)| {
                let front = if control.is_stopped() {
                    None
                } else {
                    open.front(winding, frame, boundary, *slot, &mut scratch)
                }?;
                // Ways between two faces may lead past the first.
                let ways = if i == 0 { 1.0 } else { 2.0 };
                Some(Patch { error: front.error + ways * patch.along, ..front })
            })
        };
        let numbers: Vec<Option<Patch>> = patches.par_iter().map(number).collect();
        for patch in &mut open.patch_of {
            if *patch != NONE && numbers[*patch as usize].is_none() {
                *patch = NONE;
            }
        }
        open.numbers = numbers.into_iter().map(Option::unwrap_or_default).collect();
        Some(open)
    }

    /// Divides faces into patches.
    fn divide(&mut self, mesh: &TriMesh, boundary: &Boundary, intersects: &[bool]) -> Vec<Found> {
        let ground = Ground::new(mesh, self.bvh, boundary, intersects);
        let mut patches: Vec<Found> = Vec::new();
        for slot in self.bvh.slots() {
            let first = self.bvh.face(slot);
            if intersects[first.index()] || self.patch_of[slot.index()] != NONE {
                continue;
            }
            let (centre, radius) = around(self.bvh, slot);
            if boundary.variation(centre, radius) <= MOST_AT_FIRST {
                patches.push(ground.grow(first.0, patches.len() as u32, &mut self.patch_of));
            }
        }
        patches
    }

    /// The winding number in front of a face, at a point with no other face as near.
    fn front(
        &self,
        winding: &Winding,
        frame: &Frame,
        boundary: &Boundary,
        slot: Slot,
        scratch: &mut Scratch,
    ) -> Option<Patch> {
        let (centre, normal, distances) = away_from(self.bvh, slot)?;
        distances.into_iter().find_map(|distance| {
            let p = (centre + distance * normal).to_array();
            self.bvh.all_nearest(p, slot, self.slack, &mut scratch.workspace, &mut scratch.found);
            let &[Nearest { distance_sq, slot: nearest }] = &scratch.found[..] else { return None };
            if nearest != slot || distance_sq.sqrt() <= self.touching {
                return None;
            }
            let number = winding.within(frame.unmap(p), MOST_ERROR);
            let error = number.error + boundary.variation(centre, distance * MORE) + ROUNDING;
            Some(Patch { front: number.value, error })
        })
    }

    /// The winding number about a point in the frame, if the faces that are nearest decide whether it is inside. `near` is a face believed to be near.
    pub(super) fn about(
        &self,
        boundary: &Boundary,
        p: [f64; 3],
        near: Slot,
        scratch: &mut Scratch,
    ) -> Option<WindingNumber> {
        self.bvh.all_nearest(p, near, self.slack, &mut scratch.workspace, &mut scratch.found);
        let mut answer: Option<(Side, WindingNumber)> = None;
        for &Nearest { distance_sq, slot } in &scratch.found {
            let patch = self.numbers.get(self.patch_of[slot.index()] as usize)?;
            let distance = distance_sq.sqrt();
            if distance <= self.touching {
                return None;
            }
            let side = side_of(self.bvh, DVec3::from_array(p), distance_sq, slot)?;
            let value = match side {
                Side::InFront => patch.front,
                Side::Behind => patch.front + 1.0,
                Side::InPlane(_) => return None,
            };
            let (centre, radius) = around(self.bvh, slot);
            let error = patch.error + boundary.variation(centre, (radius + distance) * MORE);
            let number = WindingNumber { value, error, of_sheet: self.is_sheet };
            let (first, one) = *answer.get_or_insert((side, number));
            if number.margin() <= error || first != side || one.is_inside() != number.is_inside() {
                return None;
            }
        }
        answer.map(|(_, number)| number)
    }
}

/// Where patches grow.
struct Ground<'g> {
    mesh: &'g TriMesh,
    bvh: &'g Bvh,
    boundary: &'g Boundary,
    intersects: &'g [bool],
    place: Vec<u32>,
    slot_of: Vec<Slot>,
    beside: Vec<[u32; 3]>,
}

impl<'g> Ground<'g> {
    fn new(mesh: &'g TriMesh, bvh: &'g Bvh, boundary: &'g Boundary, intersects: &'g [bool]) -> Self {
        let count = mesh.faces().len();
        let mut slot_of = vec![bvh.any_slot(); count];
        for slot in bvh.slots() {
            slot_of[bvh.face(slot).index()] = slot;
        }
        let place = first_at_position(mesh.positions());
        let mut beside = vec![[NONE; 3]; count];
        for [one, two] in pairs(mesh, &place).0 {
            for (face, other) in [(one, two), (two, one)] {
                if let Some(free) = beside[face as usize].iter_mut().find(|place| **place == NONE) {
                    *free = other;
                }
            }
        }
        Self { mesh, bvh, boundary, intersects, place, slot_of, beside }
    }

    /// A patch that grows from its first face to neighbours, as long as the number changes little on the way there.
    fn grow(&self, first: u32, number: u32, patch_of: &mut [u32]) -> Found {
        let mut found = Found::default();
        let mut queue = VecDeque::from([(first, 0.0)]);
        patch_of[self.slot_of[first as usize].index()] = number;
        while let Some((face, along)) = queue.pop_front() {
            if found.firsts.len() < TRIALS {
                found.firsts.push(self.slot_of[face as usize]);
            }
            found.along = if along > found.along { along } else { found.along };
            for next in self.beside[face as usize] {
                if next == NONE || self.intersects[next as usize] {
                    continue;
                }
                let patch = &mut patch_of[self.slot_of[next as usize].index()];
                if *patch == NONE
                    && let Some(change) = self.change(face, next)
                    && along + change <= MOST_ALONG
                {
                    *patch = number;
                    queue.push_back((next, along + change));
                }
            }
        }
        found
    }

    /// How much the number can change on the way between centroids of neighbours by a corner that they share.
    fn change(&self, from: u32, to: u32) -> Option<f64> {
        let places = |face: u32| self.mesh.faces()[face as usize].map(|v| self.place[v as usize]);
        let (of_from, of_to) = (places(from), places(to));
        let shared = (0..3).find(|corner| of_to.contains(&of_from[*corner]))?;
        let [from, to] = [from, to].map(|face| self.slot_of[face as usize]);
        let corner = DVec3::from_array(self.bvh.corner(from, shared));
        let centre = centroid(self.bvh, from);
        let way = centre.distance(corner) + centroid(self.bvh, to).distance(corner);
        Some(self.boundary.variation(centre, way * MORE))
    }
}

fn centroid(bvh: &Bvh, slot: Slot) -> DVec3 {
    let [a, b, c] = bvh.corners(slot).map(DVec3::from_array);
    (a + b + c) * (1.0 / 3.0)
}

/// A ball about the centroid of a face that holds it.
fn around(bvh: &Bvh, slot: Slot) -> (DVec3, f64) {
    let centre = centroid(bvh, slot);
    let away = bvh.corners(slot).map(|p| DVec3::from_array(p).distance(centre));
    (centre, away.into_iter().fold(0.0, |r: f64, x| if x > r { x } else { r }) * MORE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::geom::Aabb;
    use pompeiu_core::mesh::shapes::{Diagonal, grid, icosphere, torus};
    use pompeiu_core::mesh::{Random, displace_at_random};
    use pompeiu_core::spatial::winding_number;

    /// The faces all of whose corners are kept.
    fn part(mesh: &TriMesh, keeps: impl Fn([f64; 3]) -> bool) -> TriMesh {
        let is_kept = |face: &[u32; 3]| face.iter().all(|v| keeps(mesh.positions()[*v as usize]));
        let faces = mesh.faces().iter().copied().filter(is_kept).collect();
        TriMesh::new(mesh.positions().to_vec(), faces).unwrap()
    }

    fn turned(mesh: &TriMesh) -> TriMesh {
        let faces = mesh.faces().iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        TriMesh::new(mesh.positions().to_vec(), faces).unwrap()
    }

    /// Holes, a sheet, faces that point inwards, two parts that intersect: numbers are as accurate as they say, and most points beside the
    /// surface have one.
    #[test]
    fn numbers_by_faces_are_those_about_points() {
        let ball = part(&icosphere(1.0, 5).unwrap(), |p| p[2] < 0.9);
        let rough = displace_at_random(&ball, 2e-3, 3).unwrap();
        let sheet = displace_at_random(&grid([1.0, 1.0], [60, 60], Diagonal::Rising).unwrap(), 1e-3, 1);
        let ring = part(&torus(1.0, 0.4, 96, 48).unwrap(), |p| p[0] < 1.3);
        let both = pompeiu_core::mesh::merge(&[&ball, &ring]).unwrap();
        for mesh in [&ball, &turned(&ball), &rough, &sheet.unwrap(), &ring, &both] {
            let aabb = Aabb::of_faces(mesh);
            let frame = Frame::of(&aabb);
            let bvh = Bvh::build(mesh, &frame);
            let rounding = Rounding::new(frame.max_coordinate(&aabb));
            let (winding, boundary) = (Winding::new(mesh), Boundary::new(mesh, &frame));
            let control = Control::default();
            let patches =
                Patches::new(mesh, (&winding, &boundary), (&bvh, &frame), rounding, &control).unwrap();
            let mut scratch = Scratch::default();
            let (mut random, mut decided) = (Random::new(5), 0);
            let beside: Vec<[f64; 3]> = (mesh.positions().iter().step_by(mesh.positions().len() / 150))
                .map(|p| p.map(|x| x + 0.02 * random.signed_unit()))
                .collect();
            for p in &beside {
                let near = bvh.some_near(frame.map(*p), &mut scratch.workspace);
                let Some(number) = patches.about(&boundary, frame.map(*p), near, &mut scratch) else {
                    continue;
                };
                let exact = winding_number(mesh, *p);
                assert!((number.value - exact).abs() <= number.error, "{p:?}: {number:?} {exact}");
                assert_eq!(number.is_inside(), winding.about(*p).is_inside(), "{p:?}: {number:?} {exact}");
                decided += 1;
            }
            assert!(4 * decided > 3 * beside.len(), "{decided} of {}", beside.len());
        }
    }

    #[test]
    fn a_soup_has_no_patches() {
        let soup = pompeiu_core::mesh::unweld(&icosphere(1.0, 2).unwrap()).unwrap();
        let soup = displace_at_random(&soup, 0.05, 2).unwrap();
        let frame = Frame::of(&Aabb::of_faces(&soup));
        let bvh = Bvh::build(&soup, &frame);
        let rounding = Rounding::new(frame.max_coordinate(&Aabb::of_faces(&soup)));
        let (winding, boundary) = (Winding::new(&soup), Boundary::new(&soup, &frame));
        let patches =
            Patches::new(&soup, (&winding, &boundary), (&bvh, &frame), rounding, &Control::default());
        assert!(patches.is_none());
    }
}
