//! The worst regions, told apart.

use super::faces::greatest_on;
use super::linear::greater;
use super::report::Field;
use super::statistics::length_out;
use crate::engine::Farthest;
use crate::report::{Enclosure, Witness};
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::spatial::{Bvh, Workspace};
use pompeiu_core::{FaceId, TriMesh};

/// A part of a surface that is far from the other one.
///
/// # Definition
/// Faces are neighbours when they have a vertex position in common, welded or not. The value of a face is the upper end of its
/// greatest distance. The region of a face are the faces that can be reached from it over faces whose value is at least
/// [`Region::OF_PEAK`] of its own; the face is a peak, and its region is listed, when none of them has a greater value (of equal
/// values the first face counts). So a region never holds a greater peak, while the wide surroundings of a great one may hold
/// lesser ones that are listed by themselves. With a threshold instead, regions are the connected parts of the faces whose
/// value exceeds it, which may be faces whose distance itself does not: the enclosure of the peak tells.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Its faces, in ascending order.
    pub faces: Vec<FaceId>,
    /// Their area, rounded, in the square of the unit of the meshes.
    pub area: f64,
    /// Mean of the points of the region, by area; of its faces' centroids where there is none.
    pub centre: [f64; 3],
    /// The box around its faces.
    pub aabb: Aabb,
    /// Encloses the greatest distance of its points.
    pub peak: Enclosure,
    /// The point with the greatest distance met, and a nearest point of the other mesh.
    pub witness: Witness,
    /// The distance that its faces reach: a part of the peak, or the threshold.
    pub level: f64,
}

impl Region {
    /// The level of a region, as a part of its peak.
    pub const OF_PEAK: f64 = 0.5;
}

/// What regions are made of.
pub(super) struct Landscape<'l> {
    mesh: &'l TriMesh,
    field: &'l Field,
    bvh: &'l Bvh,
    /// Greatest distances of the faces.
    values: Vec<(f64, f64)>,
    /// Faces in descending order of their values.
    order: Vec<u32>,
    /// For each vertex the first vertex at its position.
    place: Vec<u32>,
    /// Faces at each place, as ranges of the list.
    starts: Vec<u32>,
    faces_at: Vec<u32>,
}

impl<'l> Landscape<'l> {
    pub(super) fn new(mesh: &'l TriMesh, field: &'l Field, bvh: &'l Bvh) -> Self {
        let count = mesh.faces().len();
        let values: Vec<_> = (0..count).map(|face| greatest_on(field, face)).collect();
        let mut order: Vec<u32> = (0..count as u32).collect();
        order.sort_by(|a, b| values[*b as usize].1.total_cmp(&values[*a as usize].1).then(a.cmp(b)));
        let place = places(mesh);
        let mut starts = vec![0_u32; mesh.positions().len() + 1];
        for v in mesh.faces().iter().flatten() {
            starts[place[*v as usize] as usize + 1] += 1;
        }
        for v in 0..mesh.positions().len() {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut faces_at = vec![0; 3 * count];
        for (f, face) in mesh.faces().iter().enumerate() {
            for v in face {
                let at = &mut next[place[*v as usize] as usize];
                faces_at[*at as usize] = f as u32;
                *at += 1;
            }
        }
        Self { mesh, field, bvh, values, order, place, starts, faces_at }
    }

    /// The regions of the `count` greatest peaks.
    pub(super) fn peaks(&self, count: usize) -> Vec<Region> {
        let mut sets = Sets::new(self.values.len());
        let mut regions = Vec::new();
        let mut entering = self.order.iter().peekable();
        for &peak in &self.order {
            let (proven, value) = self.values[peak as usize];
            if regions.len() == count || proven <= 0.0 {
                break;
            }
            // Levels descend with the peaks, so faces only ever come in.
            let level = Region::OF_PEAK * value;
            while let Some(&face) = entering.next_if(|face| self.values[**face as usize].1 >= level) {
                sets.enter(face);
                self.for_neighbours(face, |other| sets.join(face, other));
            }
            if sets.first(peak) == peak {
                regions.push(self.region(peak, level, |value| value >= level));
            }
        }
        regions
    }

    /// The connected parts of the faces above a level, at most `count`.
    pub(super) fn above(&self, level: f64, count: usize) -> Vec<Region> {
        let mut taken = vec![false; self.values.len()];
        let mut regions = Vec::new();
        for &peak in &self.order {
            if regions.len() == count || self.values[peak as usize].1 <= level {
                break;
            }
            if !taken[peak as usize] {
                let region = self.region(peak, level, |value| value > level);
                for face in &region.faces {
                    taken[face.index()] = true;
                }
                regions.push(region);
            }
        }
        regions
    }

    fn for_neighbours(&self, face: u32, mut each: impl FnMut(u32)) {
        for v in self.mesh.faces()[face as usize] {
            let place = self.place[v as usize] as usize;
            for &other in &self.faces_at[self.starts[place] as usize..self.starts[place + 1] as usize] {
                if other != face {
                    each(other);
                }
            }
        }
    }

    /// The faces with wanted values that are connected with a peak.
    fn region(&self, peak: u32, level: f64, wanted: impl Fn(f64) -> bool) -> Region {
        let mut faces = vec![peak];
        let mut known = std::collections::HashSet::from([peak]);
        let mut at = 0;
        while at < faces.len() {
            self.for_neighbours(faces[at], |other| {
                if wanted(self.values[other as usize].1) && known.insert(other) {
                    faces.push(other);
                }
            });
            at += 1;
        }
        faces.sort_unstable();
        self.describe(&faces, level)
    }

    fn describe(&self, faces: &[u32], level: f64) -> Region {
        let Field { frame, areas, .. } = self.field;
        let mut peak = (0.0, 0.0);
        let mut aabb = Aabb::EMPTY;
        let (mut area, mut centre, mut plain) = (0.0, [0.0; 3], [0.0; 3]);
        let mut farthest: Option<(f64, u32, [f64; 3])> = None;
        for &face in faces {
            let (low, high) = self.values[face as usize];
            peak = (greater(peak.0, low), greater(peak.1, high));
            let corners = self.mesh.corners(FaceId(face));
            aabb = aabb.union(Aabb::of_points(&corners));
            let mapped = corners.map(|p| frame.map(p));
            let of_face = 0.5 * (areas[face as usize].0 + areas[face as usize].1);
            area += of_face;
            for k in 0..3 {
                let middle = (mapped[0][k] + mapped[1][k] + mapped[2][k]) * (1.0 / 3.0);
                centre[k] += of_face * middle;
                plain[k] += middle;
            }
            for piece in self.field.of_face(face as usize) {
                for (value, corner) in piece.lower.into_iter().zip(piece.corners) {
                    if farthest.is_none_or(|(best, ..)| value > best) {
                        farthest = Some((value, face, corner));
                    }
                }
            }
        }
        let centre =
            if area > 0.0 { centre.map(|x| x / area) } else { plain.map(|x| x / faces.len() as f64) };
        let (_, face, point) = farthest.expect("a region has a face, and a face a piece");
        Region {
            faces: faces.iter().map(|f| FaceId(*f)).collect(),
            area: frame.length_out(frame.length_out(area)),
            centre: frame.unmap(centre),
            aabb,
            peak: length_out(frame, peak.0, peak.1),
            witness: self.witness(frame, face, point),
            level: frame.length_out(level),
        }
    }

    fn witness(&self, frame: &Frame, face: u32, point: [f64; 3]) -> Witness {
        let nearest = self.bvh.nearest(point, self.bvh.any_slot(), &mut Workspace::default());
        let farthest = Farthest {
            face: FaceId(face),
            point,
            distance: nearest.distance_sq.sqrt(),
            nearest_face: self.bvh.face(nearest.slot),
            nearest_corners: self.bvh.corners(nearest.slot),
        };
        let mut witness = farthest.witness(self.mesh, frame).0;
        witness.to.position = frame.unmap(witness.to.position);
        witness
    }
}

/// For each vertex the least vertex at the same position.
fn places(mesh: &TriMesh) -> Vec<u32> {
    // Adding zero makes both zeros one.
    let key = |v: u32| mesh.positions()[v as usize].map(|x| (x + 0.0).to_bits());
    let mut sorted: Vec<u32> = (0..mesh.positions().len() as u32).collect();
    sorted.sort_by(|a, b| key(*a).cmp(&key(*b)).then(a.cmp(b)));
    let mut place = vec![0; sorted.len()];
    let mut first = 0;
    for (i, &v) in sorted.iter().enumerate() {
        if i == 0 || key(sorted[i - 1]) != key(v) {
            first = v;
        }
        place[v as usize] = first;
    }
    place
}

/// Disjoint sets of faces, each of which knows the one that entered first.
struct Sets {
    /// Itself for a root; `u32::MAX` before a face has entered.
    parents: Vec<u32>,
    /// When each face entered; roots have the least of their sets.
    entered: Vec<u32>,
    count: u32,
}

impl Sets {
    fn new(faces: usize) -> Self {
        Self { parents: vec![u32::MAX; faces], entered: vec![0; faces], count: 0 }
    }

    fn enter(&mut self, face: u32) {
        self.parents[face as usize] = face;
        self.entered[face as usize] = self.count;
        self.count += 1;
    }

    /// The face of its set that entered first.
    fn first(&mut self, mut face: u32) -> u32 {
        while self.parents[face as usize] != face {
            let up = self.parents[self.parents[face as usize] as usize];
            self.parents[face as usize] = up;
            face = up;
        }
        face
    }

    /// Makes one set of two, if both faces have entered.
    fn join(&mut self, a: u32, b: u32) {
        if self.parents[b as usize] == u32::MAX {
            return;
        }
        let (a, b) = (self.first(a), self.first(b));
        let (first, later) =
            if self.entered[a as usize] < self.entered[b as usize] { (a, b) } else { (b, a) };
        self.parents[later as usize] = first;
    }
}
