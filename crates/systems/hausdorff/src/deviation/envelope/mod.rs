//! Between which two functions the distance from B lies on a convex piece P of a face of A.
//!
//! **Above:** the distance from one face of B is convex, so its linear interpolation between the corners of P lies above it, and above
//! the distance from B.
//!
//! **Below:** a face F with corners `t` lies behind the plane with unit normal g at `max_t g . t`, so `d(x, F) >= g . x - max_t g . t`
//! everywhere. The least of several such functions is concave, so the linear interpolation of *its* values at the corners lies
//! below it. One g for each face is enough; any will do, a bad one costs tightness. The normal of the nearest face
//! serves all faces that lie behind it: where B is flat or falls away, the functions above and below are one.
//!
//! **Which faces:** all of B are on the list of a piece, or cannot be nearest anywhere on it, or lie beyond a function that the piece
//! carries along (`beyond`). The tree is asked for a list once for a whole face, as a rule; the parts of a piece inherit what is left
//! of its list. A face cannot be nearest on P if it is farther from the centre of P than another one by more than twice
//! the radius of P.

mod below;
mod gather;
mod parts;
mod view;

use super::candidates::{Candidate, ESTIMATE, Scale};
use super::corners::{self, Start};
use super::polygon::{MOST_CORNERS, Piece, Polygon, Row, integral};
use crate::rounding::Rounding;
use pompeiu_core::spatial::{Bvh, Slot, Workspace};
use view::View;

pub(super) use view::unit;

/// A face on the list of a piece.
#[derive(Clone, Copy)]
struct Listed {
    /// Its place among the candidates.
    candidate: u32,
    /// Others were left out because they are no nearer than the function above that this one gives: so it stays, or parts of the
    /// piece would be bounded from below by those and from above by nothing as good.
    pinned: bool,
}

/// A piece with its list of faces.
#[derive(Clone, Copy)]
pub(super) struct Open {
    pub(super) polygon: Polygon,
    /// Where in the lists; none if the tree must be asked.
    list: Option<(u32, u32)>,
    /// A face of B near its centre.
    pub(super) near: Slot,
    /// What lists and candidates hold when it is looked at: what came later belongs to pieces that are done.
    held: (u32, u32),
}

/// What a piece may be cut by.
pub(super) struct Look {
    /// The candidate nearest to the centre, and how far.
    near: u32,
    distance: f64,
    /// The candidate whose plane lies lowest below the function above, and its values at the corners.
    blocking: Option<(u32, Row)>,
}

/// What is wanted of a piece.
#[derive(Clone, Copy)]
pub(super) struct Wish {
    /// What each corner counts in integrals.
    pub(super) weights: Row,
    /// Mean width that a piece may have.
    pub(super) width: f64,
    /// Width that may be lost to make a list shorter.
    pub(super) negligible: f64,
    /// No distance on the face is believed to be greater.
    pub(super) reach: f64,
}

/// The faces of B near one face of A, and memory for looking at its pieces.
pub(super) struct Envelope<'b> {
    bvh: &'b Bvh,
    rounding: Rounding,
    pub(super) scale: Scale,
    pub(super) workspace: Workspace,
    walk: Vec<u32>,
    slots: Vec<Slot>,
    candidates: Vec<Candidate>,
    lists: Vec<Listed>,
    /// Distances of the centre of a piece from the faces on its list, from below.
    estimates: Vec<f64>,
}

impl<'b> Envelope<'b> {
    pub(super) fn new(bvh: &'b Bvh, rounding: Rounding) -> Self {
        Self {
            bvh,
            rounding,
            scale: Scale::new([[0.0; 3]; 3], rounding),
            workspace: Workspace::default(),
            walk: Vec::new(),
            slots: Vec::new(),
            candidates: Vec::new(),
            lists: Vec::new(),
            estimates: Vec::new(),
        }
    }

    /// Begins with another face of A.
    pub(super) fn begin(&mut self, corners: [[f64; 3]; 3]) {
        self.scale = Scale::new(corners, self.rounding);
        self.candidates.clear();
        self.lists.clear();
    }

    /// A piece about which the tree must be asked.
    pub(super) fn open(&self, polygon: &Polygon, near: Slot) -> Open {
        Open {
            polygon: *polygon,
            list: None,
            near,
            held: (self.lists.len() as u32, self.candidates.len() as u32),
        }
    }

    /// A part of a piece that was just looked at.
    pub(super) fn part(&self, of: &Open, polygon: &Polygon) -> Open {
        Open { polygon: *polygon, held: (self.lists.len() as u32, self.candidates.len() as u32), ..*of }
    }

    /// What faces of B and the distances of the corners say about a whole face: what is left to do when time runs out.
    pub(super) fn without_looking(&mut self, start: &Start, largest: f64) -> Piece {
        let mut polygon = Polygon::whole(largest);
        let seen = View::new(&self.scale, &polygon);
        let weights = polygon.outline.weights();
        let mut near = start.near[0];
        let mut least = integral(&weights, &polygon.upper);
        for (i, slot) in start.near.into_iter().enumerate() {
            if start.near[..i].contains(&slot) {
                continue;
            }
            let upper =
                bvh_row(self.bvh, slot, &seen, 3, &mut self.workspace).map(|distance| distance + seen.margin);
            if integral(&weights, &upper) < least {
                least = integral(&weights, &upper);
                (polygon.upper, near) = (upper, slot);
            }
        }
        // The distance changes by no more than the way from a corner.
        let way = 2.0 * seen.radius;
        let farthest = start.distances.iter().fold(0.0, |d, x| if *x > d { *x } else { d });
        polygon.lower = [farthest - way - 2.0 * seen.margin; MOST_CORNERS];
        if let Some(below) = corners::below(start.corners, start.distances, self.scale.margin) {
            let mut lower = polygon.lower;
            lower[..3].copy_from_slice(&below);
            if integral(&weights, &lower) > integral(&weights, &polygon.lower) {
                polygon.lower = lower;
            }
        }
        Piece { polygon, near }
    }

    /// Improves the functions of a piece; its list becomes a new one at the end of the lists.
    pub(super) fn look(&mut self, open: &mut Open, wish: &Wish) -> Look {
        self.lists.truncate(open.held.0 as usize);
        self.candidates.truncate(open.held.1 as usize);
        let seen = View::new(&self.scale, &open.polygon);
        let complete = open.list.is_some() || self.gather(open, &seen, wish);
        let (first, last) = open.list.unwrap_or((0, 0));
        let (near, distance) = self.nearest(&seen, first as usize..last as usize);
        open.near = self.candidates[near].slot;
        let upper = self.above(open, near, &seen);
        let polygon = &mut open.polygon;
        if integral(&wish.weights, &upper) < integral(&wish.weights, &polygon.upper) {
            polygon.upper = upper;
        }
        self.below(open, &seen, (near, distance), complete, wish)
    }
    /// The face on a list that is nearest to the centre, and how far.
    fn nearest(&mut self, seen: &View, list: std::ops::Range<usize>) -> (usize, f64) {
        let mut best = (self.lists[list.start].candidate as usize, f64::INFINITY);
        self.estimates.clear();
        for &Listed { candidate, .. } in &self.lists[list] {
            let face = &self.candidates[candidate as usize];
            let mut estimate = 0.0;
            let mut inside = false;
            if face.is_usable() {
                (estimate, inside) = face.estimate(seen.at);
            }
            self.estimates.push(estimate * (1.0 - ESTIMATE) - seen.margin);
            if estimate >= best.1 {
                continue;
            }
            let distance = if inside {
                estimate
            } else {
                self.workspace.distances += 1;
                self.bvh.distance_sq(seen.centre.to_array(), face.slot).sqrt()
            };
            if distance < best.1 {
                best = (candidate as usize, distance);
            }
        }
        best
    }

    /// Values at the corners of the distance from a face, not below it.
    fn above(&mut self, open: &Open, near: usize, seen: &View) -> Row {
        let face = &self.candidates[near];
        let polygon = &open.polygon;
        let mut row = [f64::INFINITY; MOST_CORNERS];
        if face.is_usable() {
            let height = face.height.row(&polygon.outline);
            let [a, b, c] = face.sides.each_ref().map(|side| side.row(&polygon.outline));
            for j in 0..MOST_CORNERS {
                let inside = a[j] <= 0.0 && b[j] <= 0.0 && c[j] <= 0.0;
                row[j] = if inside { face.above(height[j]) } else { f64::INFINITY };
            }
        }
        if row.contains(&f64::INFINITY) {
            let exact = bvh_row(self.bvh, face.slot, seen, polygon.outline.count, &mut self.workspace);
            for (value, exact) in row.iter_mut().zip(exact) {
                *value = if *value < exact { *value } else { exact };
            }
        }
        row.map(|value| value + seen.margin)
    }
}

/// Distances of the corners of a piece from a face.
fn bvh_row(bvh: &Bvh, slot: Slot, seen: &View, count: usize, workspace: &mut Workspace) -> Row {
    distances(bvh, slot, &seen.corners, count, workspace)
}

/// Distances of points from a face.
pub(super) fn distances(
    bvh: &Bvh,
    slot: Slot,
    at: &[Row; 3],
    count: usize,
    workspace: &mut Workspace,
) -> Row {
    let mut row = [0.0; MOST_CORNERS];
    for four in (0..count).step_by(4) {
        let mut points = [[0.0; 4]; 3];
        for k in 0..3 {
            points[k].copy_from_slice(&at[k][four..four + 4]);
        }
        let d = bvh.four_distances_sq(&points, slot, workspace);
        for lane in 0..4 {
            row[four + lane] = d[lane].sqrt();
        }
    }
    let last = row[count - 1];
    row[count..].fill(last);
    row
}
