//! The overlay of a triangle with the faces of B above and below it: a partition along the edges of B in one step.
//!
//! A triangle T of A is looked at along its normal. The edges of B that cross it in this view cut it into cells, each over one
//! face of B. The distance from a face is convex, so the corners of its cell bound the distance from B on the cell. Corners
//! are vertices of B, crossings of edges, and corners of T; at the former two the point of B above bounds the distance for all
//! cells that meet there.
//!
//! Where the view is not worth following (B ends, or turns away), the strip between the edge and the nearest part of the
//! boundary of T makes a cell of its own, bounded by the face before the edge.
//!
//! # Why no rounding leaves a gap
//! The cells cover T whatever the signs were computed to be, for it is not the signs that are trusted:
//! * every edge of B is clipped to T once; the segment, if there is one, bounds the cells of both faces that share the edge, in
//!   opposite directions, or a cell and a strip;
//! * strips meet along the ways from the ends of their segments to the boundary of T, each run through in both directions;
//! * what is left of the boundaries of cells and strips runs along the boundary of T, from where one segment or way ends to where the
//!   next begins.
//!
//! So in the sum of all cells and strips, each a fan of triangles, everything inside cancels, and the boundary of the sum runs along
//! that of T, m times round in all. It is counted where it passes the first corner of T. If m >= 1, every point of T has
//! degree m in the sum, and so lies in some triangle of some fan. The points of the fans lie in T up to rounding, which is
//! accounted for by [`OVERLAY_CUTS`]; where in T they lie does not matter to the argument.

mod cells;
mod clip;
mod polygon;
mod segment;
#[cfg(test)]
mod tests;
mod view;

pub(crate) use polygon::Cell;
#[cfg(test)]
pub(crate) use tests::{lattice, sheet};
pub(crate) use view::{View, clamped};

use glam::DVec3;
use polygon::{Polygon, Strip};
use pompeiu_core::spatial::{Bvh, Neighbours, Slot, Workspace};
use segment::{Clip, Point, Seen};
use std::collections::HashMap;

/// The rounding of an overlay, in cuts: points inside T lie within 28 units of it and points of its sides within 9 (see
/// [`rounding`](crate::rounding)), together less than the 40 units of four cuts.
pub(crate) const OVERLAY_CUTS: u32 = 4;
/// Faces of B that one overlay looks at, and one of a triangle no larger than they are: there they are many because they are thin or meet in one vertex, and
/// parts of the triangle would see as many.
pub(crate) const MOST_FACES: usize = 128;
pub(crate) const MOST_LARGE_FACES: usize = 2048;

/// What an overlay has come to.
pub(crate) enum Overlaid {
    /// All cells are within the limit of the face they lie over. The greatest squared distance.
    Covered(f64),
    /// Some cells are not. The greatest squared distance of the others.
    Beyond(f64),
    /// Too many faces of B are seen over the triangle.
    Many,
    /// B is not seen as a surface over the triangle.
    None,
}

/// Memory that overlays reuse, and what the last one found.
#[derive(Default)]
pub(crate) struct Overlay {
    slots: Vec<Slot>,
    /// Places of slots, once there are so many that looking through them takes longer.
    places: HashMap<Slot, usize>,
    faces: Vec<Face>,
    points: Vec<Point>,
    strips: Vec<Strip>,
    /// The cell at hand.
    polygon: Polygon,
    /// Faces that are looked at, at most.
    most: usize,
    /// Whether all cells are listed, not only those beyond the limit.
    pub(crate) keep_all: bool,
    /// The cells beyond the limit, or all of them.
    pub(crate) cells: Vec<Cell>,
    /// The corner of a cell that is farthest from the face of its cell, that face, and the squared distance, beyond the limit.
    pub(crate) worst: Option<([f64; 3], Slot, f64)>,
    beyond: usize,
    greatest: f64,
    /// How often the boundary of the sum of all cells passes the first corner of T.
    passes: i32,
}

/// A face of B that was reached.
#[derive(Clone, Copy)]
struct Face {
    clips: [Clip; 3],
    /// Whether its boundary is run through against the order of its corners.
    reversed: bool,
}

/// What an overlay asks of B.
pub(crate) struct Below<'b> {
    pub(crate) bvh: &'b Bvh,
    pub(crate) neighbours: &'b Neighbours,
    /// Cells whose corners have squared distances up to this from their face are covered.
    pub(crate) limit_sq: f64,
}

impl Overlay {
    /// `keep_all`: list all cells.
    pub(crate) fn new(keep_all: bool) -> Self {
        Self { keep_all, ..Self::default() }
    }

    /// Partitions a triangle by the faces of B around one that is seen over its centre, at most so many.
    pub(crate) fn run(
        &mut self,
        view: &View,
        below: &Below<'_>,
        start: Slot,
        most: usize,
        workspace: &mut Workspace,
    ) -> Overlaid {
        self.most = most;
        self.slots.clear();
        self.places.clear();
        self.faces.clear();
        self.points.clear();
        self.strips.clear();
        self.cells.clear();
        (self.worst, self.beyond, self.greatest, self.passes) = (None, 0, 0.0, 0);
        let corners = below.bvh.corners(start).map(DVec3::from_array);
        let reversed = view.is_reversed(&corners);
        if view.is_steep(&corners, reversed) {
            return Overlaid::None;
        }
        self.push(start, Face { clips: [Clip::Unknown; 3], reversed });
        let mut next = 0;
        while next < self.slots.len() {
            if let Err(failed) = self.visit(next, view, below, workspace) {
                return failed;
            }
            next += 1;
        }
        for i in 0..self.strips.len() {
            self.strip_cell(self.strips[i], view, below, workspace);
        }
        if self.passes < 1 {
            Overlaid::None
        } else if self.beyond == 0 {
            Overlaid::Covered(self.greatest)
        } else {
            Overlaid::Beyond(self.greatest)
        }
    }

    /// Whether most cells are beyond the limit.
    pub(crate) fn is_mostly_beyond(&self) -> bool {
        2 * self.beyond > self.slots.len() + self.strips.len()
    }

    /// Clips the edges of a face, reaches the faces across, and makes the cell of the face.
    fn visit(
        &mut self,
        index: usize,
        view: &View,
        below: &Below<'_>,
        workspace: &mut Workspace,
    ) -> Result<(), Overlaid> {
        let slot = self.slots[index];
        let corners = below.bvh.corners(slot).map(DVec3::from_array);
        let seen = Seen { corners, over: corners.map(|c| view.barycentric(c)) };
        let Face { mut clips, reversed } = self.faces[index];
        for k in 0..3 {
            if clips[k] != Clip::Unknown {
                continue;
            }
            clips[k] = self.clip(view, &seen, &clips, k);
            if let Clip::Segment { from, to } = clips[k]
                && !self.reach_across(slot, k, clips[k], reversed, view, below)?
            {
                let [from, to] = if reversed { [to, from] } else { [from, to] };
                self.strips.push(Strip { slot, from, to });
            }
        }
        self.faces[index].clips = clips;
        self.face_cell(index, &seen, view, below, workspace)
    }

    /// Hands the segment of an edge to the face across. False if there is none that is worth following.
    fn reach_across(
        &mut self,
        slot: Slot,
        edge: usize,
        segment: Clip,
        reversed: bool,
        view: &View,
        below: &Below<'_>,
    ) -> Result<bool, Overlaid> {
        let Some(across) = below.neighbours.across(slot, edge) else { return Ok(false) };
        let reversed = reversed != across.same_direction;
        let segment = if across.same_direction { segment } else { segment.turned() };
        if let Some(known) = self.place_of(across.slot) {
            let face = &mut self.faces[known];
            if face.reversed != reversed || face.clips[across.edge] != Clip::Unknown {
                return Err(Overlaid::None);
            }
            face.clips[across.edge] = segment;
            return Ok(true);
        }
        if view.is_steep(&below.bvh.corners(across.slot).map(DVec3::from_array), reversed) {
            return Ok(false);
        }
        if self.slots.len() == self.most {
            return Err(Overlaid::Many);
        }
        let mut clips = [Clip::Unknown; 3];
        clips[across.edge] = segment;
        self.push(across.slot, Face { clips, reversed });
        Ok(true)
    }

    fn push(&mut self, slot: Slot, face: Face) {
        if self.slots.len() == MOST_FACES {
            self.places.extend(self.slots.iter().zip(0..).map(|(slot, place)| (*slot, place)));
        }
        if self.slots.len() >= MOST_FACES {
            self.places.insert(slot, self.slots.len());
        }
        self.slots.push(slot);
        self.faces.push(face);
    }

    fn place_of(&self, slot: Slot) -> Option<usize> {
        if self.slots.len() > MOST_FACES {
            self.places.get(&slot).copied()
        } else {
            self.slots.iter().position(|s| *s == slot)
        }
    }
}
