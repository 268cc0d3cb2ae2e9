//! Cells compared with the faces of B around them, one by one.
//!
//! # What is proven
//! On a cell over F faces behind the plane of F, raised by their greatest rise over it, are no nearer than that plane; each other face
//! is no nearer than a plane of its own (`fronts`, `candidates`); and faces that do not meet the box around the cell, or a box along the edges of its face
//! ([`Bvh::keep_leaves_near`]), widened by the greatest value above, are no nearer than that value, while the function below is nowhere greater, because F lies
//! behind its plane.

use super::behind::{Plane, rising, tilted};
use super::candidates::{Candidate, Linear, Scale};
use super::fronts::Front;
use super::polygon::{MOST_CORNERS, Outline, Polygon, Row};
use super::walk::Walk;
use glam::DVec3;
use pompeiu_core::geom::Aabb;
use pompeiu_core::geom::point_triangle::LANES;
use pompeiu_core::spatial::bvh::Leaf;
use pompeiu_core::spatial::{Bvh, Slot};

/// A part of a face of A over one face of B.
#[derive(Clone, Copy)]
pub(super) struct Cell {
    pub(super) outline: Outline,
    pub(super) slot: Slot,
    pub(super) walk: Walk,
    /// The corners, coordinate by coordinate.
    pub(super) points: [Row; 3],
    /// Distances of the corners from the face, with their margin, and the greatest.
    pub(super) upper: Row,
    pub(super) most: f64,
    /// The width that may be left.
    pub(super) width: f64,
}

/// What came of a comparison.
pub(super) struct Compared {
    /// The functions on the cell.
    pub(super) polygon: Polygon,
    /// The face that keeps it from being as narrow as wanted.
    pub(super) blocking: Option<Blocking>,
}

/// A face that may be nearer on some of a cell than the face that the cell is over: where the cell lies over both, it is where the height over the
/// plane of the other is between that over the plane of the cell's face and its negative.
#[derive(Clone, Copy)]
pub(super) struct Blocking {
    pub(super) slot: Slot,
    /// Height over the plane of the cell's face, not negative.
    own: Linear,
    /// Height over the plane of the blocking face, not negative at the centre of the cell.
    other: Linear,
}

impl Blocking {
    /// The part of the cell where this face is nearer, if there is any, and what is left on the near and on the far side of it.
    pub(super) fn divide(&self, outline: &Outline) -> Option<(Outline, [Option<Outline>; 2])> {
        let (own, other) = (self.own.row(outline), self.other.row(outline));
        let [there, near] = outline.cut(&std::array::from_fn(|j| own[j] - other[j]))?;
        let (own, other) = (self.own.row(&there), self.other.row(&there));
        match there.cut(&std::array::from_fn(|j| -own[j] - other[j])) {
            Some([far, there]) => Some((there, [Some(near), Some(far)])),
            None => Some((there, [Some(near), None])),
        }
    }
}

/// Memory for comparing.
pub(super) struct Compare<'b> {
    bvh: &'b Bvh,
    candidates: Vec<Candidate>,
    leaves: Vec<(Leaf, Aabb)>,
    walk: Vec<u32>,
    rising: Vec<Slot>,
}

/// Leaves around cells, at most.
const MOST_LEAVES: usize = 512;
/// Part of the allowed width by which planes are lowered for faces that rise over them.
const RISE: f64 = 0.15;

impl<'b> Compare<'b> {
    pub(super) fn new(bvh: &'b Bvh) -> Self {
        Self { bvh, candidates: Vec::new(), leaves: Vec::new(), walk: Vec::new(), rising: Vec::new() }
    }

    /// Begins with some cells of one face of A.
    pub(super) fn begin(&mut self, cells: &[Cell], scale: &Scale) {
        let mut lower = [f64::INFINITY; 3];
        let mut upper = [f64::NEG_INFINITY; 3];
        for cell in cells {
            let (l, u) = cell.around(scale);
            for k in 0..3 {
                lower[k] = if l[k] < lower[k] { l[k] } else { lower[k] };
                upper[k] = if u[k] > upper[k] { u[k] } else { upper[k] };
            }
        }
        self.candidates.clear();
        self.leaves.clear();
        self.bvh.leaves_meeting(lower, upper, &mut self.walk, &mut self.leaves);
        let most = cells.iter().fold(0.0, |most, cell| if cell.most > most { cell.most } else { most });
        let corners = cells
            .iter()
            .flat_map(|Cell { points: [x, y, z], .. }| (0..MOST_CORNERS).map(|j| [x[j], y[j], z[j]]));
        let face = scale.corners.map(|p| p.to_array());
        self.bvh.keep_leaves_near(&mut self.leaves, face, corners, most + 2.0 * scale.margin);
    }

    /// Bounds the distance on one of the cells; none if too many faces are near.
    pub(super) fn bound(&mut self, cell: &Cell, scale: &Scale) -> Option<Compared> {
        if self.leaves.len() > MOST_LEAVES {
            return None;
        }
        let outline = &cell.outline;
        let face = self.candidate(cell.slot, scale);
        let face = &self.candidates[face];
        let at = outline.centre();
        let margin = scale.margin + scale.displacement(outline);
        let g = if face.height.at(at) < 0.0 { -face.normal } else { face.normal };
        let (lower, upper) = cell.around(scale);
        let through = face.corners[0];
        let rise = RISE * cell.width + 2.0 * margin;
        self.rising.clear();
        let plane = Plane { normal: g, through, lower, upper, rise };
        let highest = rising(self.bvh, &self.leaves, &plane, &mut self.rising);
        let own = face.reach_along(g, through);
        let highest = if own > highest { own } else { highest };
        let own_height = scale.along(g, through);
        let here = own_height.row(outline);
        let mut row = here.map(|x| x - highest);
        let mut worst = rise;
        let mut blocking = None;
        let centre = scale.point(at);
        let along = outline.longest_way(scale).0;
        let front = Front::new(centre, &cell.points, along, &cell.upper, rise);
        for from in (0..self.rising.len()).step_by(LANES) {
            let count = self.rising[from..].len().min(LANES);
            let fronts = front.look(self.bvh, &self.rising[from..from + count]);
            for lane in 0..count {
                let slot = self.rising[from + lane];
                if slot == cell.slot {
                    continue;
                }
                let (theirs, deficit) = (fronts.row(lane), fronts.deficits[lane]);
                if deficit <= rise {
                    lower_to(&mut row, &theirs);
                    continue;
                }
                let away = fronts.way(lane);
                let facing = Facing { nearest: centre - away, away, row: theirs, deficit };
                let other = self.candidate(slot, scale);
                let other = &self.candidates[other];
                let (theirs, deficit) = other.best_below(&cell.upper, outline, scale, g, &facing, rise);
                lower_to(&mut row, &theirs);
                if deficit > worst {
                    worst = deficit;
                    let height =
                        if other.height.at(at) < 0.0 { other.height.negative() } else { other.height };
                    blocking = (other.normal != DVec3::ZERO).then_some(Blocking {
                        slot,
                        own: own_height,
                        other: height,
                    });
                }
            }
        }
        let mut polygon = Polygon::unknown(*outline, 0.0);
        polygon.upper = cell.upper;
        polygon.lower = row.map(|x| x - margin);
        Some(Compared { polygon, blocking })
    }

    /// Its place among the candidates.
    fn candidate(&mut self, slot: Slot, scale: &Scale) -> usize {
        let known = self.candidates.iter().position(|candidate| candidate.slot == slot);
        known.unwrap_or_else(|| {
            self.candidates.push(Candidate::new(slot, self.bvh.corners(slot), scale));
            self.candidates.len() - 1
        })
    }
}

impl Cell {
    /// The box around it, widened by its greatest value above.
    fn around(&self, scale: &Scale) -> ([f64; 3], [f64; 3]) {
        let beside = self.most + 2.0 * scale.margin;
        let ranges = self.points.each_ref().map(range);
        (ranges.map(|(low, _)| low - beside), ranges.map(|(_, high)| high + beside))
    }
}

/// The least and the greatest of the values at the corners.
pub(super) fn range(row: &Row) -> (f64, f64) {
    // What lies beyond the corners repeats the last one.
    let (mut low, mut high) = (row[0], row[0]);
    for x in &row[1..] {
        low = if *x < low { *x } else { low };
        high = if *x > high { *x } else { high };
    }
    (low, high)
}

fn lower_to(row: &mut Row, other: &Row) {
    for j in 0..MOST_CORNERS {
        row[j] = if other[j] < row[j] { other[j] } else { row[j] };
    }
}

/// How far a function below the distance lies below the wanted one at most.
fn deficit(row: &Row, wanted: &Row) -> f64 {
    let mut most = wanted[0] - row[0];
    for j in 1..MOST_CORNERS {
        let here = wanted[j] - row[j];
        most = if here > most { here } else { most };
    }
    most
}

/// A face in front of planes with its normal, or that from about its nearest point to the centre of a cell: of what lies farther away than the cell
/// is long no more needs to be known.
struct Facing {
    nearest: DVec3,
    /// From there to the centre.
    away: DVec3,
    /// Values at the corners of the cell of the better function below the distance from the face, and how far it lies below the wanted one at most.
    row: Row,
    deficit: f64,
}

/// Values at the corners of a cell of `g . (x - y)`, less how far a face reaches along g beyond y.
fn plane_in_front([a, b, c]: &[DVec3; 3], g: DVec3, y: DVec3, outline: &Outline, scale: &Scale) -> Row {
    let (a, b, c) = (g.dot(*a - y), g.dot(*b - y), g.dot(*c - y));
    let reach = if a > b { a } else { b };
    let reach = if reach > c { reach } else { c };
    let mut row = scale.along(g, y).row(outline);
    for x in &mut row {
        *x -= reach;
    }
    row
}

impl Candidate {
    /// Values at the corners of the best of a few functions below the distance from this face, and how far it lies below the wanted
    /// one at most. `normal` is that of a plane over which this face rises; a function that lies `enough` below ends the search.
    fn best_below(
        &self,
        wanted: &Row,
        outline: &Outline,
        scale: &Scale,
        normal: DVec3,
        facing: &Facing,
        enough: f64,
    ) -> (Row, f64) {
        let mut best = (facing.row, facing.deficit);
        let Facing { nearest, away, .. } = *facing;
        let [a, b, c] = self.corners;
        let ways = [a - nearest, b - nearest, c - nearest];
        let mut plane = |aside: DVec3| {
            if let Some(g) = tilted(&ways, normal, aside) {
                let row = plane_in_front(&self.corners, g, nearest, outline, scale);
                let here = deficit(&row, wanted);
                best = if here < best.1 { (row, here) } else { best };
            }
            best.1 <= enough
        };
        let across = |way: DVec3| {
            let across = normal.cross(way);
            if across.dot(away) < 0.0 { -across } else { across }
        };
        let _ = plane(-(ways[0] + ways[1] + ways[2]))
            || plane(away)
            || plane(across(ways[0]))
            || plane(across(ways[1]))
            || plane(across(ways[2]));
        best
    }
}
