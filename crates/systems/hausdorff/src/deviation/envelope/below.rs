//! The function below a piece: the least of planes behind which the faces on its list lie.

use super::super::candidates::{Candidate, Linear, Scale};
use super::super::polygon::{Polygon, Row, integral};
use super::view::View;
use super::{Envelope, Look, Open, Wish};
use glam::DVec3;

impl Envelope<'_> {
    /// Improves the function below a piece, and its list.
    pub(super) fn below(
        &mut self,
        open: &mut Open,
        seen: &View,
        (near, distance): (usize, f64),
        complete: bool,
        wish: &Wish,
    ) -> Look {
        let (first, last) = open.list.map_or((0, 0), |(first, last)| (first as usize, last as usize));
        let polygon = &mut open.polygon;
        let slack = wish.negligible + 2.0 * seen.margin;
        let wanted: Row = polygon.upper.map(|upper| upper - slack);
        let far = distance + 2.0 * (seen.radius + seen.margin);
        let nearest = &self.candidates[near];
        let (common, from) = nearest.direction_to(seen);
        let row = self.scale.along(common, from).row(&polygon.outline);
        // Faces that reach no farther than this along the common direction are behind the function above.
        let room = least_difference(&row, &wanted, polygon.outline.count);
        let unlisted = polygon.beyond;
        let mut lower = polygon.beyond;
        let mut beyond = polygon.beyond;
        let mut blocking: Option<(u32, Row)> = None;
        let mut worst = 0.0;
        let start = self.lists.len();
        let mut near_at = None;
        let mut dropped = false;
        for place in first..last {
            let listed = self.lists[place];
            if self.estimates[place - first] > far {
                continue;
            }
            let index = listed.candidate as usize;
            let face = &self.candidates[index];
            let support = face.reach_along(common, from);
            let mut enough = support <= room;
            let mut s: Row = row.map(|x| x - support);
            if !enough {
                (s, enough) = face.best_plane(s, seen, &self.scale, polygon, &wanted, &lower);
            }
            lower = lesser_row(&lower, &s);
            if enough && !listed.pinned && index != near {
                beyond = lesser_row(&beyond, &s);
                dropped = true;
                continue;
            }
            if index == near {
                near_at = Some(self.lists.len());
            }
            self.lists.push(listed);
            let deficit = -least_difference(&s, &polygon.upper, polygon.outline.count);
            if deficit > worst {
                (worst, blocking) = (deficit, Some((listed.candidate, s)));
            }
        }
        if let Some(place) = near_at.filter(|_| dropped) {
            self.lists[place].pinned = true;
        }
        // What is beyond has its margin already; a second one does not matter.
        let planes = lower.map(|x| x - seen.margin);
        polygon.beyond = beyond.map(|x| x - seen.margin);
        let weights = &wish.weights;
        if integral(weights, &planes) > integral(weights, &polygon.lower) {
            polygon.lower = planes;
        }
        // The distance changes by no more than the way from the centre.
        if !complete || worst > slack {
            let beyond_centre =
                unlisted[..polygon.outline.count].iter().sum::<f64>() / polygon.outline.count as f64;
            let at_centre = if complete && beyond_centre < distance { beyond_centre } else { distance };
            let arms = seen.arms();
            let steepest: Row = std::array::from_fn(|j| at_centre - arms[j].sqrt() - seen.margin);
            if integral(weights, &steepest) > integral(weights, &polygon.lower) {
                polygon.lower = steepest;
            }
        }
        // Parts of a piece whose list was cut short ask the tree again, and those of one that is bounded by what is not listed.
        let short = -least_difference(&unlisted, &polygon.upper, polygon.outline.count);
        let ask_again = !complete || short > worst && short > slack;
        open.list = (!ask_again).then_some((start as u32, self.lists.len() as u32));
        Look { near: near as u32, distance, blocking }
    }
}

fn lesser_row(x: &Row, y: &Row) -> Row {
    std::array::from_fn(|j| if y[j] < x[j] { y[j] } else { x[j] })
}

/// The least `x - y` at a corner.
fn least_difference(x: &Row, y: &Row, count: usize) -> f64 {
    (0..count).fold(f64::INFINITY, |least, j| if x[j] - y[j] < least { x[j] - y[j] } else { least })
}
impl Candidate {
    /// The direction from the point of this face that is nearest to the centre of a piece, and a point of the plane behind which
    /// other faces should lie.
    fn direction_to(&self, seen: &View) -> (DVec3, DVec3) {
        if self.is_usable() && self.estimate(seen.at).1 {
            let g = if self.height.at(seen.at) < 0.0 { -self.normal } else { self.normal };
            return (g, self.corners[0]);
        }
        (seen.direction_from(self.corners), self.corners[0])
    }

    /// Values at the corners of the best function below the distance from this face, of a few; and whether it nowhere lies below the
    /// wanted one. No better one is looked for where other faces are known to lie lower.
    fn best_plane(
        &self,
        common: Row,
        seen: &View,
        scale: &Scale,
        polygon: &Polygon,
        wanted: &Row,
        known: &Row,
    ) -> (Row, bool) {
        let mut best = (common, score(&common, wanted, polygon.outline.count));
        if self.normal != DVec3::ZERO {
            let below = self.height.at(seen.at) < 0.0;
            let bulge = self.bulge[usize::from(below)];
            let row = self.height.row(&polygon.outline).map(|h| if below { -h - bulge } else { h - bulge });
            let here = score(&row, wanted, polygon.outline.count);
            best = if here > best.1 { (row, here) } else { best };
        }
        let inside = self.is_usable() && self.estimate(seen.at).1;
        if best.1 < 0.0 && !inside && least_difference(&best.0, known, polygon.outline.count) < 0.0 {
            let g = seen.direction_from(self.corners);
            let y = self.corners[0];
            let support = self.reach_along(g, y);
            let along: Linear = scale.along(g, y);
            let row = along.row(&polygon.outline).map(|x| x - support);
            let here = score(&row, wanted, polygon.outline.count);
            best = if here > best.1 { (row, here) } else { best };
        }
        (best.0, best.1 >= 0.0)
    }
}

/// How far a function falls short of the wanted one at the corners together.
fn score(row: &Row, wanted: &Row, count: usize) -> f64 {
    (0..count).map(|j| row[j] - wanted[j]).map(|x| if x < 0.0 { x } else { 0.0 }).sum()
}
