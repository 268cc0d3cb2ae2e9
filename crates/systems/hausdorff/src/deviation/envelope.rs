//! Between which two linear functions the distance from B lies on a piece of A.
//!
//! **Above:** the distance from one face of B is convex, so the linear function with its values at the corners lies above it, and
//! above the distance from B.
//!
//! **Below:** a face F with corners `t` lies behind the plane with unit normal g at `max_t g . t`, so `d(x, F) >= g . x - max_t g . t`
//! everywhere. The least of several such functions is concave, so the linear function with *its* values at the corners lies
//! below it. One g for each face is enough; any will do, a bad one costs tightness. The normal at the point of B nearest to
//! the centre serves all faces that lie behind it: where B is flat or falls away, the functions above and below are one.
//!
//! **Which faces:** all of B are on the list of a piece, or cannot be nearest anywhere on it, or lie beyond a linear function
//! that the piece carries along (`beyond`). Boxes of the tree are put there whole where one plane separates them from the
//! piece by as much as the function above.

use super::linear::{Corners, greater, lesser, mean};
use crate::rounding::Rounding;
use crate::search::piece::{best_prism_plane, crossing};
use glam::DVec3;
use pompeiu_core::geom::point_triangle::closest_barycentric;
use pompeiu_core::spatial::{Bvh, Nearest, Slot, Workspace};
use std::ops::ControlFlow;

use super::cut::{self, LEAST_PART, Parts};

/// A part of a face of A, and what is known about its distance from B: `lower <= d <= upper` for the linear functions with these
/// values at its corners. Lengths and coordinates are in the frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) corners: [[f64; 3]; 3],
    pub(super) lower: Corners,
    pub(super) upper: Corners,
    /// Fraction of the area of the face.
    pub(super) share: f64,
    /// The face of A.
    pub(super) face: u32,
    /// A face of B near its centre.
    pub(super) near: Slot,
    /// Cuts between the face and this piece.
    pub(super) depth: u32,
}

impl Piece {
    /// A whole face, of which only is known that distances are neither negative nor above the largest.
    pub(super) fn whole(face: u32, corners: [[f64; 3]; 3], near: Slot, largest: f64) -> Self {
        Self { corners, lower: [0.0; 3], upper: [largest; 3], share: 1.0, face, near, depth: 0 }
    }

    /// Mean width between the functions, as far as the one below is not negative; rounded.
    pub(super) fn mean_gap(&self) -> f64 {
        mean([0, 1, 2].map(|j| self.upper[j] - greater(self.lower[j], 0.0)))
    }

    /// Greatest width between the functions.
    pub(super) fn greatest_gap(&self) -> f64 {
        super::linear::greatest([0, 1, 2].map(|j| self.upper[j] - greater(self.lower[j], 0.0)))
    }
}

/// A piece with its list of faces.
#[derive(Clone, Copy)]
pub(super) struct Open {
    pub(super) piece: Piece,
    /// Faces that are not on the list are at least this far, linearly between the corners.
    pub(super) beyond: Corners,
    /// Where in the workspace; none if the tree must be asked.
    pub(super) list: Option<(usize, usize)>,
}

impl Open {
    pub(super) fn new(piece: Piece) -> Self {
        Self { piece, beyond: [f64::INFINITY; 3], list: None }
    }
}

/// Faces by which a piece may be cut.
pub(super) struct Look {
    /// Nearest to the centre, and how far.
    near: Slot,
    distance: f64,
    /// The face whose plane lies lowest below the function above, and its values at the corners.
    blocking: Option<(Slot, Corners)>,
}

/// A face on the list of a piece.
#[derive(Clone, Copy)]
pub(super) struct Listed {
    slot: Slot,
    /// Others were left out because they are no nearer than the function above that this one gives: so it stays, or parts of the
    /// piece would be bounded from below by those and from above by nothing as good.
    pinned: bool,
}

/// Faces on the lists of the pieces of one stack, and memory for looking at them.
pub(super) struct Envelope<'b> {
    bvh: &'b Bvh,
    rounding: Rounding,
    workspace: Workspace,
    walk: Vec<u32>,
    /// The lists, one after the other.
    pub(super) lists: Vec<Listed>,
    /// Squared distances of the three corners and the centre of a piece from the faces on its list.
    distances_sq: Vec<[f64; 4]>,
}

/// Faces on a list at most: beyond, a piece is bounded by the distance of its centre, and cut.
const LONGEST_LIST: usize = 192;
/// Part of the allowed gap that may be lost by taking a face off a list.
const SLACK: f64 = 1e-3;
/// Corners that hang over a plane so little that this part of the allowed gap comes of it are no reason for a cut.
const OVERHANG: f64 = 0.125;
/// Where the functions of two faces cross so close to a corner, the middle of the longest edge is the better place.
const LEAST_CROSSING: f64 = 0.01;
/// Deeper pieces are only bisected, which shrinks them for certain.
const BISECT_BELOW_DEPTH: u32 = 48;

impl<'b> Envelope<'b> {
    pub(super) fn new(bvh: &'b Bvh, rounding: Rounding) -> Self {
        Self {
            bvh,
            rounding,
            workspace: Workspace::default(),
            walk: Vec::new(),
            lists: Vec::new(),
            distances_sq: Vec::new(),
        }
    }

    /// Point–triangle distances evaluated so far.
    pub(super) fn distances(&self) -> u64 {
        self.workspace.distances
    }

    /// Improves the functions of a piece; its list becomes a new one at the end of the lists. `allowed` is the gap that matters, for
    /// a mean of the function above.
    pub(super) fn look(&mut self, open: &mut Open, allowed: impl Fn(f64) -> f64) -> Look {
        let corners = open.piece.corners.map(DVec3::from_array);
        let centre = (corners[0] + corners[1] + corners[2]) * (1.0 / 3.0);
        let arms = corners.map(|p| p - centre);
        let radius = arms.iter().fold(0.0, |r, arm| greater(r, arm.length()));
        let mut points = [[0.0; 4]; 3];
        for k in 0..3 {
            points[k] = [corners[0][k], corners[1][k], corners[2][k], centre[k]];
        }
        let seen = View { centre, arms, radius, points, margin: self.rounding.bound(open.piece.depth) };
        let complete = match open.list {
            Some(_) => true,
            None => self.gather(open, &seen, &allowed),
        };
        let (first, last) = open.list.unwrap_or((self.lists.len(), self.lists.len()));
        self.compare(open, &seen, first..last, complete, &allowed)
    }

    /// Lists the faces that the tree holds near a piece, or only the nearest if they are too many.
    fn gather(&mut self, open: &mut Open, seen: &View, allowed: &impl Fn(f64) -> f64) -> bool {
        let centre = seen.centre.to_array();
        let nearest = self.bvh.nearest(centre, open.piece.near, &mut self.workspace);
        let distance = nearest.distance_sq.sqrt();
        let d = self.bvh.four_distances_sq(&seen.points, nearest.slot, &mut self.workspace);
        let upper = [d[0].sqrt(), d[1].sqrt(), d[2].sqrt()];
        let slack = SLACK * allowed(mean(upper)) + 2.0 * seen.margin;
        let reach = distance + 2.0 * (seen.radius + seen.margin);
        let common = seen.direction_from(self.bvh.corners(nearest.slot));
        let mut beyond = [f64::INFINITY; 3];
        let first = self.lists.len();
        let Self { bvh, walk, lists, .. } = self;
        lists.push(Listed { slot: nearest.slot, pinned: true });
        let enter = |aabb: &pompeiu_core::geom::Aabb| {
            let closest = [0, 1, 2].map(|k| lesser(greater(centre[k], aabb.lower[k]), aabb.upper[k]));
            let away = seen.centre - DVec3::from_array(closest);
            let d = away.length();
            if d > reach {
                return false;
            }
            // By the plane that faces are compared with, and by the one at the nearest point of the box.
            let support = (0..3).map(|k| {
                let side = if common[k] > 0.0 { aabb.upper[k] } else { aabb.lower[k] };
                common[k] * (side - centre[k])
            });
            let mut plane = (common, support.sum::<f64>());
            for attempt in 0..2 {
                let (g, support) = plane;
                let s = seen.arms.map(|arm| g.dot(arm) - support);
                if (0..3).all(|j| s[j] >= upper[j] - slack) {
                    beyond = [0, 1, 2].map(|j| lesser(beyond[j], s[j] - seen.margin));
                    return false;
                }
                if attempt == 0 && d > 0.0 {
                    plane = (away / d, -d);
                } else {
                    break;
                }
            }
            true
        };
        let listed = bvh.walk(walk, enter, |slot| {
            if slot != nearest.slot {
                lists.push(Listed { slot, pinned: false });
            }
            if lists.len() - first > LONGEST_LIST {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        let complete = listed.is_continue();
        if complete {
            open.beyond = beyond;
        } else {
            self.lists.truncate(first + 1);
            open.beyond = seen.arms.map(|arm| distance - arm.length() - seen.margin);
        }
        open.list = Some((first, self.lists.len()));
        complete
    }

    fn compare(
        &mut self,
        open: &mut Open,
        seen: &View,
        list: std::ops::Range<usize>,
        complete: bool,
        allowed: &impl Fn(f64) -> f64,
    ) -> Look {
        let Self { bvh, workspace, lists, distances_sq, .. } = self;
        distances_sq.clear();
        let mut near = Nearest { slot: open.piece.near, distance_sq: f64::INFINITY };
        let (mut upper, mut uppermost) = ([f64::INFINITY; 3], near.slot);
        let mut at_corners = [f64::INFINITY; 3];
        for &Listed { slot, .. } in &lists[list.clone()] {
            let d = bvh.four_distances_sq(&seen.points, slot, workspace);
            distances_sq.push(d);
            if d[3] < near.distance_sq {
                near = Nearest { slot, distance_sq: d[3] };
            }
            let row = [d[0].sqrt(), d[1].sqrt(), d[2].sqrt()];
            at_corners = [0, 1, 2].map(|j| lesser(at_corners[j], row[j]));
            if mean(row) < mean(upper) {
                (upper, uppermost) = (row, slot);
            }
        }
        let upper = upper.map(|u| u + seen.margin);
        let distance = near.distance_sq.sqrt();
        let piece = &mut open.piece;
        if mean(upper) < mean(piece.upper) {
            piece.upper = upper;
        }
        piece.near = near.slot;

        let slack = SLACK * allowed(mean(upper)) + 2.0 * seen.margin;
        let reach = distance + 2.0 * (seen.radius + seen.margin);
        let common = seen.direction_from(bvh.corners(near.slot));
        let mut lower = open.beyond;
        let mut blocking: Option<(Slot, Corners)> = None;
        let mut worst = 0.0;
        let first = lists.len();
        let mut dropped = false;
        let mut uppermost_at = None;
        for (k, place) in list.enumerate() {
            let Listed { slot, pinned } = lists[place];
            if distances_sq[k][3].sqrt() > reach {
                continue;
            }
            let face = bvh.corners(slot).map(DVec3::from_array);
            // The direction from the nearest point of the nearest face is the common one.
            let attempts = if slot == near.slot { 2 } else { 3 };
            let (s, enough) = seen.plane_below(
                &face,
                common,
                upper.map(|u| u - slack),
                at_corners.map(|d| d - slack),
                attempts,
            );
            let s = s.map(|s| s - seen.margin);
            lower = [0, 1, 2].map(|j| lesser(lower[j], s[j]));
            if enough && !pinned && slot != near.slot && slot != uppermost {
                open.beyond = [0, 1, 2].map(|j| lesser(open.beyond[j], s[j]));
                dropped = true;
                continue;
            }
            if slot == uppermost {
                uppermost_at = Some(lists.len());
            }
            lists.push(Listed { slot, pinned });
            let deficit = super::linear::greatest([0, 1, 2].map(|j| upper[j] - s[j]));
            if deficit > worst {
                (worst, blocking) = (deficit, Some((slot, s)));
            }
        }
        if let Some(place) = uppermost_at.filter(|_| dropped) {
            lists[place].pinned = true;
        }
        // The distance changes by no more than the way from the centre.
        let at_centre = lesser(distance, if complete { mean(open.beyond) } else { distance });
        let steepest = seen.arms.map(|arm| at_centre - arm.length() - seen.margin);
        let lower = if mean(steepest) > mean(lower) { steepest } else { lower };
        if mean(lower) > mean(piece.lower) {
            piece.lower = lower;
        }
        // Parts of a piece whose list was cut short ask the tree again.
        open.list = complete.then_some((first, lists.len()));
        Look { near: near.slot, distance, blocking }
    }

    /// Cuts a piece where the nearest face ends, or the one that is in the way; or where their distances are equal; or in the
    /// middle.
    pub(super) fn cut(&self, piece: &Piece, look: &Look, allowed: f64) -> Parts {
        if piece.depth < BISECT_BELOW_DEPTH {
            let corners = piece.corners.map(DVec3::from_array);
            // Beside a face at distance d by s, the distance from it is greater by about s^2 / 2d.
            let beside = OVERHANG * allowed;
            let beside = (beside * beside + 2.0 * beside * look.distance).sqrt();
            let nearest = Some(look.near);
            let blocking = look.blocking.map(|(slot, _)| slot).filter(|slot| *slot != look.near);
            for slot in [nearest, blocking].into_iter().flatten() {
                if let Some(line) = best_prism_plane(&corners, self.bvh.corners(slot), beside)
                    && line.lesser_part() > LEAST_PART
                {
                    return cut::along(&line, &piece.corners);
                }
            }
            if let Some((_, s)) = look.blocking {
                let sides = [[0, 1, 2].map(|j| s[j] - piece.upper[j]), s];
                for side in sides {
                    if let Some(line) = crossing(side)
                        && line.lesser_part() > LEAST_CROSSING
                    {
                        return cut::along(&line, &piece.corners);
                    }
                }
            }
        }
        cut::bisect(&piece.corners)
    }
}

/// A piece as faces of B are compared with it.
struct View {
    centre: DVec3,
    /// From the centre to the corners.
    arms: [DVec3; 3],
    radius: f64,
    points: [[f64; 4]; 3],
    margin: f64,
}

impl View {
    /// The direction to the centre from the nearest point of a face, or any if there is none.
    fn direction_from(&self, face: [[f64; 3]; 3]) -> DVec3 {
        let beta = closest_barycentric(self.centre.to_array(), face);
        let [a, b, c] = face.map(DVec3::from_array);
        let away = self.centre - (a + beta[1] * (b - a) + beta[2] * (c - a));
        unit(away).unwrap_or_else(|| self.normal(&[a, b, c]))
    }

    /// The normal of a face on the side of the centre; zero for a face without area.
    fn normal(&self, [a, b, c]: &[DVec3; 3]) -> DVec3 {
        let n = unit((b - a).cross(c - a)).unwrap_or(DVec3::ZERO);
        if n.dot(self.centre - a) < 0.0 { -n } else { n }
    }

    /// Values at the corners of the best function below the distance from a face, of a few; and whether it nowhere lies below the
    /// wanted one. Above the distances at the corners, which are given a little too low, no function helps.
    fn plane_below(
        &self,
        face: &[DVec3; 3],
        common: DVec3,
        wanted: Corners,
        at_corners: Corners,
        attempts: usize,
    ) -> (Corners, bool) {
        let mut best = [f64::NEG_INFINITY; 3];
        let mut best_score = f64::NEG_INFINITY;
        for attempt in 0..attempts {
            let g = match attempt {
                0 => common,
                1 => self.normal(face),
                _ => self.direction_from(face.map(|t| t.to_array())),
            };
            let farthest = face.map(|t| g.dot(t - self.centre));
            let support = super::linear::greatest(farthest);
            let s = self.arms.map(|arm| g.dot(arm) - support);
            if (0..3).all(|j| s[j] >= wanted[j]) {
                return (s, true);
            }
            let score = mean([0, 1, 2].map(|j| lesser(s[j] - at_corners[j], 0.0)));
            if score > best_score {
                (best, best_score) = (s, score);
            }
            if score == 0.0 {
                break;
            }
        }
        (best, false)
    }
}

/// The direction of a vector of which enough is left to have one.
fn unit(v: DVec3) -> Option<DVec3> {
    let length = v.length();
    (length > f64::MIN_POSITIVE.sqrt()).then(|| v / length)
}
