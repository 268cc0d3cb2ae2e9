//! The worst regions, told apart.

use super::area;
use super::bounds::{FaceBounds, Maximum, Precision};
use super::connected::Entering;
use super::linear::greater;
use super::maxima::Maxima;
use super::statistics::length_out;
use crate::engine::Farthest;
use crate::report::{Enclosure, Witness};
use crate::target::Target;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::mesh::first_at_position;
use pompeiu_core::spatial::Workspace;
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;
use std::ops::Range;

/// A part of a surface that is far from the other one.
///
/// # Definition
/// Faces are neighbours when they have a vertex position in common, welded or not. The value of a face is the greatest distance of
/// its points. The region of a face are the faces that can be reached from it over faces whose value is at least
/// [`Region::OF_PEAK`] of its value; the face is a peak, and its region is listed, when none of them has a greater value (of equal
/// values the first face counts). So a region never holds a greater peak, while the wide surroundings of a great one may hold
/// lesser ones that are listed by themselves. With a threshold instead, regions are the connected parts of the faces whose
/// value exceeds it.
/// # Accuracy
/// Values are enclosed, and their upper ends count. The values of the faces that may be peaks of listed regions are enclosed to one
/// part in a thousand, and those of the faces that reach the level of such a region to one in 256, unless a limit ends the work or
/// they are no greater than rounding. So peaks come in descending order of the upper ends of their enclosures, and those closer than
/// that may be ties; a face whose value is within that of the level of a region may or may not belong to it.
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
pub(super) struct Peaks<'l> {
    mesh: &'l TriMesh,
    target: &'l Target,
    /// For each vertex the least vertex at the same position.
    place: Vec<u32>,
    maxima: Maxima<'l>,
    /// Values and faces, in descending order.
    order: Vec<(f64, u32)>,
}

/// The faces of a region, in ascending order, and the distance that they reach.
struct Part {
    faces: Vec<u32>,
    level: f64,
}

/// From this part of all faces on it is quicker to look at all of them, in the order of the mesh.
const MANY: usize = 16;

/// Lets faces with these places in the order of values enter, in the order of the mesh.
fn enter(entering: &mut Entering<'_>, order: &[(f64, u32)], places: Range<usize>) {
    let mut ranked: Vec<(u32, u32)> = places.map(|rank| (order[rank].1, rank as u32)).collect();
    ranked.par_sort_unstable();
    for (face, rank) in ranked {
        entering.enter(face, rank);
    }
}

/// Of the faces that entered those that are connected with the first of them, in ascending order.
fn connected(entering: &mut Entering<'_>, entered: &[(f64, u32)], first: u32) -> Vec<u32> {
    if entered.len() > entering.faces() / MANY {
        return entering.with_first(first);
    }
    let faces = entered.iter().map(|(_, face)| *face);
    let mut connected: Vec<u32> = faces.filter(|face| entering.first(*face) == first).collect();
    connected.sort_unstable();
    connected
}

impl<'l> Peaks<'l> {
    pub(super) fn new(mesh: &'l TriMesh, target: &'l Target, maxima: Maxima<'l>) -> Self {
        let order = (0..mesh.faces().len() as u32).map(|face| (0.0, face)).collect();
        let mut peaks = Self { mesh, target, place: first_at_position(mesh.positions()), maxima, order };
        peaks.sort();
        peaks
    }

    fn sort(&mut self) {
        let of_faces = &self.maxima.of_faces;
        self.order.par_iter_mut().for_each(|(value, face)| *value = of_faces[*face as usize].max.upper);
        self.order.par_sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    }

    fn value(&self, face: u32) -> f64 {
        self.maxima.of_faces[face as usize].max.upper
    }

    /// Makes maxima narrower until those that decide about the worst regions, of each kind, are narrow.
    pub(super) fn settle(&mut self, count: usize, threshold: Option<f64>, tell: &mut dyn FnMut(u64, usize)) {
        while !self.maxima.scene.control.is_stopped() {
            let mut parts = self.peaks(count);
            // Faces below all levels join no region, and split none from a greater one.
            let least = if parts.len() == count { parts[count - 1].level } else { 0.0 };
            let matters = |face: &u32| {
                let Maximum { lower, upper, .. } = self.maxima.of_faces[*face as usize].max;
                upper >= least || threshold.is_some_and(|t| lower <= t && t < upper)
            };
            let mut precision = Precision::Level;
            let wide = |face: &u32| matters(face) && self.maxima.is_wide(*face, Precision::Level);
            let mut wide: Vec<u32> = self.order.iter().map(|(_, face)| *face).filter(wide).collect();
            if wide.is_empty() {
                precision = Precision::Peak;
                if let Some(threshold) = threshold {
                    parts.extend(self.above(threshold, count));
                }
                for part in &parts {
                    let lower = |face: &u32| self.maxima.of_faces[*face as usize].max.lower;
                    let peak = part.faces.iter().map(lower).fold(0.0, greater);
                    let may_be_peak = |face: &&u32| self.value(**face) >= peak;
                    let may_be_peak = part.faces.iter().filter(may_be_peak);
                    wide.extend(may_be_peak.filter(|face| self.maxima.is_wide(**face, Precision::Peak)));
                }
                wide.sort_unstable();
                wide.dedup();
            }
            if wide.is_empty() {
                break;
            }
            self.maxima.narrow(&wide, precision, tell);
            self.sort();
        }
    }

    /// The regions of the `count` greatest peaks, and those above a threshold.
    pub(super) fn regions(&self, count: usize, threshold: Option<f64>) -> (Vec<Region>, Vec<Region>) {
        let describe = |parts: Vec<Part>| parts.iter().map(|part| self.describe(part)).collect();
        let above = threshold.map(|t| self.above(t, count)).unwrap_or_default();
        (describe(self.peaks(count)), describe(above))
    }

    pub(super) fn into_bounds(self) -> Vec<FaceBounds> {
        self.maxima.of_faces
    }

    fn peaks(&self, count: usize) -> Vec<Part> {
        let mut entering = Entering::new(self.mesh, &self.place);
        let mut parts = Vec::new();
        let mut entered = 0;
        for (rank, &(value, peak)) in self.order.iter().enumerate() {
            if parts.len() == count {
                break;
            }
            if self.maxima.of_faces[peak as usize].max.lower <= 0.0 {
                continue;
            }
            // Levels descend with the peaks, so faces only ever come in, and what is connected with a greater one stays so.
            if rank < entered && entering.first(peak) != peak {
                continue;
            }
            let level = Region::OF_PEAK * value;
            let reached = entered + self.order[entered..].partition_point(|(value, _)| *value >= level);
            enter(&mut entering, &self.order, entered..reached);
            entered = reached;
            if entering.first(peak) == peak {
                parts.push(Part { faces: connected(&mut entering, &self.order[..entered], peak), level });
            }
        }
        parts
    }

    /// The connected parts of the faces above a level, at most `count`.
    fn above(&self, level: f64, count: usize) -> Vec<Part> {
        let above = self.order.partition_point(|(value, _)| *value > level);
        let mut entering = Entering::new(self.mesh, &self.place);
        enter(&mut entering, &self.order, 0..above);
        let faces = self.order[..above].iter().map(|(_, face)| *face);
        let peaks: Vec<u32> = faces.filter(|face| entering.first(*face) == *face).take(count).collect();
        let part = |peak| Part { faces: connected(&mut entering, &self.order[..above], peak), level };
        peaks.into_iter().map(part).collect()
    }

    fn describe(&self, Part { faces, level }: &Part) -> Region {
        let frame = self.maxima.scene.frame;
        let (mut low, mut high, mut highest) = (0.0, 0.0, faces[0]);
        let mut aabb = Aabb::EMPTY;
        let (mut area, mut centre, mut plain) = (0.0, [0.0; 3], [0.0; 3]);
        for &face in faces {
            let maximum = &self.maxima.of_faces[face as usize].max;
            high = greater(high, maximum.upper);
            if maximum.lower > low {
                (low, highest) = (maximum.lower, face);
            }
            let corners = self.mesh.corners(FaceId(face));
            aabb = aabb.union(Aabb::of_points(&corners));
            let mapped = corners.map(|p| frame.map(p));
            let (least, most) = area::of_face(self.mesh, frame, face);
            let of_face = 0.5 * (least + most);
            area += of_face;
            for k in 0..3 {
                let middle = (mapped[0][k] + mapped[1][k] + mapped[2][k]) * (1.0 / 3.0);
                centre[k] += of_face * middle;
                plain[k] += middle;
            }
        }
        let centre =
            if area > 0.0 { centre.map(|x| x / area) } else { plain.map(|x| x / faces.len() as f64) };
        Region {
            faces: faces.iter().map(|f| FaceId(*f)).collect(),
            area: frame.length_out(frame.length_out(area)),
            centre: frame.unmap(centre),
            aabb,
            peak: length_out(frame, low, high),
            witness: self.witness(frame, highest),
            level: frame.length_out(*level),
        }
    }

    fn witness(&self, frame: &Frame, face: u32) -> Witness {
        let bvh = self.target.bvh();
        let point = self.maxima.of_faces[face as usize].max.point;
        let nearest = bvh.nearest(point, bvh.any_slot(), &mut Workspace::default());
        let farthest = Farthest {
            face: FaceId(face),
            point,
            distance: nearest.distance_sq.sqrt(),
            nearest: self.target.nearest_face(nearest.slot, point),
        };
        farthest.witness(self.mesh, frame).0
    }
}
