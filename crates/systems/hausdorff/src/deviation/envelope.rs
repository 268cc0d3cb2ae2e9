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

use super::candidates::{Candidate, ESTIMATE, Linear, Scale};
use super::polygon::{MOST_CORNERS, Polygon, Row, integral};
use crate::rounding::Rounding;
use glam::DVec3;
use pompeiu_core::geom::Aabb;
use pompeiu_core::geom::point_triangle::closest_barycentric;
use pompeiu_core::spatial::{Bvh, Slot, Workspace};
use std::ops::ControlFlow;

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

/// Faces on a list at most: beyond, a piece is bounded by the distance of its centre, and cut.
const LONGEST_LIST: usize = 256;
/// Corners that hang over a plane so little that this part of the allowed gap comes of it are no reason for a cut.
const OVERHANG: f64 = 0.125;
/// Where the functions of two faces cross so close to a corner, the middle is the better place.
const LEAST_CROSSING: f64 = 0.01;
/// A face that rises over the plane of its neighbour by less than this part of an edge forms no valley with it.
const LEAST_RISE: f64 = 1e-3;
/// Faces are listed up to the first of these multiples of the distance of the centre, or up to the second where that is known to
/// suffice.
const NEAREST: f64 = 1.25;
const FARTHEST: f64 = 4.0;
/// Part of the allowed width that faces may take which are not listed.
const UNLISTED: f64 = 0.25;
/// Deeper pieces are only halved, which shrinks them for certain.
const HALVE_BELOW_DEPTH: u32 = 48;

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

    /// What one face of B and the distances of the corners say about a whole face: what is left to do when time runs out.
    pub(super) fn without_looking(
        &mut self,
        mut polygon: Polygon,
        near: Slot,
        distances: [f64; 3],
    ) -> Polygon {
        let seen = View::new(&self.scale, &polygon);
        let upper =
            bvh_row(self.bvh, near, &seen, 3, &mut self.workspace).map(|distance| distance + seen.margin);
        let weights = polygon.outline.weights();
        if integral(&weights, &upper) < integral(&weights, &polygon.upper) {
            polygon.upper = upper;
        }
        // The distance changes by no more than the way from a corner.
        let way = 2.0 * seen.radius;
        let farthest = distances.iter().fold(0.0, |d, x| if *x > d { *x } else { d });
        polygon.lower = [farthest - way - 2.0 * seen.margin; MOST_CORNERS];
        polygon
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

    /// Lists the faces that the tree holds near a piece, or only the nearest if they are too many.
    fn gather(&mut self, open: &mut Open, seen: &View, wish: &Wish) -> bool {
        let Self { bvh, workspace, walk, slots, scale, .. } = self;
        let polygon = &mut open.polygon;
        let centre = seen.centre.to_array();
        let nearest = bvh.nearest(centre, open.near, workspace);
        let distance = nearest.distance_sq.sqrt();
        let far = distance + 2.0 * (seen.radius + seen.margin);
        let far_sq = far * far;
        // Faces outside of a box around the piece, and outside of a slab around its plane, are farther than `reach`.
        let reach = reach_of(polygon, distance, wish.reach);
        let beside = reach + 2.0 * seen.margin;
        let around = |k: usize| {
            let row = &seen.corners[k][..polygon.outline.count];
            row.iter().fold((row[0], row[0]), |(l, u), x| {
                (if *x < l { *x } else { l }, if *x > u { *x } else { u })
            })
        };
        let lower = [0, 1, 2].map(|k| around(k).0 - beside);
        let upper = [0, 1, 2].map(|k| around(k).1 + beside);
        let normal = scale.normal();
        // By the plane that faces are compared with.
        let common = seen.direction_from(bvh.corners(nearest.slot).map(DVec3::from_array));
        let row = seen.along(common);
        let values = bvh_row(bvh, nearest.slot, seen, polygon.outline.count, workspace);
        let slack = UNLISTED * wish.width + 2.0 * seen.margin;
        let room = (0..polygon.outline.count).fold(f64::INFINITY, |room, j| {
            let here = row[j] - (values[j] - slack);
            if here < room { here } else { room }
        });
        let mut behind = f64::NEG_INFINITY;
        let enter = |aabb: &Aabb| {
            if (0..3).any(|k| aabb.lower[k] > upper[k] || aabb.upper[k] < lower[k]) {
                return false;
            }
            let mut away = 0.0;
            let (mut middle, mut half, mut support) = (0.0, 0.0, 0.0);
            for k in 0..3 {
                let (l, u) = (aabb.lower[k], aabb.upper[k]);
                let outside = if centre[k] < l {
                    l - centre[k]
                } else if centre[k] > u {
                    centre[k] - u
                } else {
                    0.0
                };
                away += outside * outside;
                middle += normal[k] * (0.5 * (l + u) - centre[k]);
                half += normal[k].abs() * (0.5 * (u - l));
                support += common[k] * (if common[k] > 0.0 { u } else { l } - centre[k]);
            }
            if away > far_sq || middle.abs() > half + beside {
                return false;
            }
            if support <= room {
                behind = if support > behind { support } else { behind };
                return false;
            }
            true
        };
        slots.clear();
        let listed = bvh.walk(walk, enter, |slot| {
            slots.push(slot);
            if slots.len() > LONGEST_LIST * 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let mut complete = listed.is_continue();
        let (from, first) = (self.candidates.len(), self.lists.len());
        if complete {
            for &slot in slots.iter() {
                let corners = bvh.corners(slot);
                if slot != nearest.slot && seen.is_beside(&corners, normal, &lower, &upper, beside) {
                    continue;
                }
                self.candidates.push(Candidate::new(slot, corners, scale));
            }
            if !slots.contains(&nearest.slot) {
                self.candidates.push(Candidate::new(nearest.slot, bvh.corners(nearest.slot), scale));
            }
            complete = self.candidates.len() - from <= LONGEST_LIST;
        }
        if complete {
            polygon.beyond = std::array::from_fn(|j| {
                let plane = row[j] - behind - seen.margin;
                if plane < reach { plane } else { reach }
            });
        } else {
            self.candidates.truncate(from);
            self.candidates.push(Candidate::new(nearest.slot, bvh.corners(nearest.slot), scale));
            polygon.beyond = seen.arms().map(|arm| distance - arm.sqrt() - seen.margin);
        }
        self.lists.extend((from..self.candidates.len()).map(|candidate| Listed {
            candidate: candidate as u32,
            pinned: self.candidates[candidate].slot == nearest.slot,
        }));
        open.list = Some((first as u32, self.lists.len() as u32));
        complete
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

    /// Improves the function below a piece, and its list.
    fn below(
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

    /// Cuts a piece where the nearest face ends, or where its plane is crossed, or the same for the face that is in the way; or where
    /// their distances are equal; or in the middle. `width` is what the piece should be cut to.
    pub(super) fn cut(&self, polygon: &Polygon, look: &Look, width: f64) -> Option<[Polygon; 2]> {
        if polygon.outline.count == MOST_CORNERS {
            return polygon.cut_along_diagonal();
        }
        if polygon.outline.depth < HALVE_BELOW_DEPTH {
            // Beside a face at distance d by s, the distance from it is greater by about s^2 / 2d.
            let beside = OVERHANG * width;
            let beside = (beside * beside + 2.0 * beside * look.distance).sqrt();
            let nearest = &self.candidates[look.near as usize];
            if let Some((blocking, _)) = &look.blocking
                && let Some(parts) = cut_between(polygon, nearest, &self.candidates[*blocking as usize])
            {
                return Some(parts);
            }
            if let Some(parts) = cut_by_face(polygon, nearest, beside, OVERHANG * width) {
                return Some(parts);
            }
            if let Some((blocking, row)) = &look.blocking {
                if *blocking != look.near {
                    let blocking = &self.candidates[*blocking as usize];
                    if let Some(parts) = cut_by_face(polygon, blocking, beside, f64::INFINITY) {
                        return Some(parts);
                    }
                }
                for side in [std::array::from_fn(|j| row[j] - polygon.upper[j]), *row] {
                    if let Some([one, two]) = polygon.cut(&side) {
                        let (s, t) = (one.outline.share(), two.outline.share());
                        let lesser = if s < t { s } else { t };
                        if lesser > LEAST_CROSSING * (s + t) {
                            return Some([one, two]);
                        }
                    }
                }
            }
        }
        self.halve(polygon)
    }

    /// Cuts across the longest way between two corners.
    fn halve(&self, polygon: &Polygon) -> Option<[Polygon; 2]> {
        let way = |i: usize, j: usize| {
            self.scale.way([
                polygon.outline.v[j] - polygon.outline.v[i],
                polygon.outline.w[j] - polygon.outline.w[i],
            ])
        };
        let mut longest = (0, 1, -1.0);
        for i in 0..polygon.outline.count {
            for j in i + 1..polygon.outline.count {
                let length = way(i, j).length_squared();
                if length > longest.2 {
                    longest = (i, j, length);
                }
            }
        }
        let (i, j, _) = longest;
        if polygon.outline.count == 3 {
            return Some(polygon.halve(if i == 0 && j == 2 { 2 } else { i }));
        }
        let along = way(i, j);
        let middle = [
            0.5 * (polygon.outline.v[i] + polygon.outline.v[j]),
            0.5 * (polygon.outline.w[i] + polygon.outline.w[j]),
        ];
        let side = std::array::from_fn(|k| {
            along.dot(self.scale.way([polygon.outline.v[k] - middle[0], polygon.outline.w[k] - middle[1]]))
        });
        polygon.cut(&side).or_else(|| polygon.cut_along_diagonal())
    }

    /// Length of the longest way between two corners.
    pub(super) fn size(&self, polygon: &Polygon) -> f64 {
        let first = [polygon.outline.v[0], polygon.outline.w[0]];
        let away = |j: usize| {
            self.scale.way([polygon.outline.v[j] - first[0], polygon.outline.w[j] - first[1]]).length()
        };
        2.0 * (1..polygon.outline.count).map(away).fold(0.0, |m, x| if x > m { x } else { m })
    }
}

/// How far faces of B are listed: all that may be nearest to a corner, as far as is known, but not many times the distance of the
/// centre.
fn reach_of(polygon: &Polygon, distance: f64, wish: f64) -> f64 {
    let upper =
        polygon.upper[..polygon.outline.count].iter().fold(0.0, |most, x| if *x > most { *x } else { most });
    let known = if upper < FARTHEST * distance { upper } else { NEAREST * distance };
    if wish > known { wish } else { known }
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

/// Cuts where the planes of two faces are equally far, if they meet in an edge and form a valley: then no other place is as near.
fn cut_between(polygon: &Polygon, one: &Candidate, other: &Candidate) -> Option<[Polygon; 2]> {
    if !(one.is_usable() && other.is_usable()) {
        return None;
    }
    let shared = one.corners.iter().filter(|p| other.corners.contains(p)).count();
    if shared != 2 {
        return None;
    }
    let at = polygon.outline.centre();
    let [one_below, other_below] = [one, other].map(|face| face.height.at(at) < 0.0);
    let g = if one_below { -one.normal } else { one.normal };
    let rise = other.reach_along(g, one.corners[0]);
    if rise <= LEAST_RISE * (one.corners[1] - one.corners[0]).length() {
        return None;
    }
    let (h, k) = (one.height.row(&polygon.outline), other.height.row(&polygon.outline));
    let same = one_below == other_below;
    let side = std::array::from_fn(|j| if same { h[j] - k[j] } else { h[j] + k[j] });
    let [one, two] = polygon.cut(&side)?;
    let (s, t) = (one.outline.share(), two.outline.share());
    let lesser = if s < t { s } else { t };
    (lesser > LEAST_CROSSING * (s + t)).then_some([one, two])
}

/// Cuts where a face ends, at the side that leaves most beyond it; or where its plane is crossed.
fn cut_by_face(polygon: &Polygon, face: &Candidate, beside: f64, height: f64) -> Option<[Polygon; 2]> {
    if !face.is_usable() {
        return None;
    }
    let mut best = (0.0, None);
    let sides = face.sides.each_ref().map(|side| (side.row(&polygon.outline), beside));
    for (row, least) in sides.into_iter().chain([(face.height.row(&polygon.outline), height)]) {
        let (mut low, mut high) = (row[0], row[0]);
        for x in &row[1..polygon.outline.count] {
            low = if *x < low { *x } else { low };
            high = if *x > high { *x } else { high };
        }
        let lesser = if high < -low { high } else { -low };
        if lesser > least && (best.1.is_none() || lesser > best.0) {
            best = (lesser, Some(row));
        }
    }
    polygon.cut(&best.1?)
}

fn lesser_row(x: &Row, y: &Row) -> Row {
    std::array::from_fn(|j| if y[j] < x[j] { y[j] } else { x[j] })
}

/// The least `x - y` at a corner.
fn least_difference(x: &Row, y: &Row, count: usize) -> f64 {
    (0..count).fold(f64::INFINITY, |least, j| if x[j] - y[j] < least { x[j] - y[j] } else { least })
}

/// A piece as faces of B are compared with it.
pub(super) struct View {
    at: [f64; 2],
    pub(super) centre: DVec3,
    /// The corners, coordinate by coordinate.
    corners: [Row; 3],
    radius: f64,
    margin: f64,
}

impl View {
    fn new(scale: &Scale, polygon: &Polygon) -> Self {
        let at = polygon.outline.centre();
        let centre = scale.point(at);
        let margin = scale.margin + scale.displacement(&polygon.outline);
        let mut view = Self { at, centre, corners: scale.points(&polygon.outline), radius: 0.0, margin };
        let square = view.arms().iter().fold(0.0, |r, a| if *a > r { *a } else { r });
        view.radius = square.sqrt();
        view
    }

    /// Squared lengths of the ways from the centre to the corners.
    fn arms(&self) -> Row {
        let mut arms = [0.0; MOST_CORNERS];
        for k in 0..3 {
            for j in 0..MOST_CORNERS {
                let way = self.corners[k][j] - self.centre[k];
                arms[j] += way * way;
            }
        }
        arms
    }

    /// Values of `g . (x - centre)` at the corners.
    fn along(&self, g: DVec3) -> Row {
        let mut row = [0.0; MOST_CORNERS];
        for k in 0..3 {
            for j in 0..MOST_CORNERS {
                row[j] += g[k] * (self.corners[k][j] - self.centre[k]);
            }
        }
        row
    }

    /// The direction to the centre from the nearest point of a face, or any if there is none.
    fn direction_from(&self, [a, b, c]: [DVec3; 3]) -> DVec3 {
        let beta = closest_barycentric(self.centre.to_array(), [a, b, c].map(|p| p.to_array()));
        let away = self.centre - (a + beta[1] * (b - a) + beta[2] * (c - a));
        let normal = || {
            let n = unit((b - a).cross(c - a)).unwrap_or(DVec3::ZERO);
            if n.dot(self.centre - a) < 0.0 { -n } else { n }
        };
        unit(away).unwrap_or_else(normal)
    }

    /// Whether a face lies outside of a box, or outside of a slab around the plane of the piece.
    fn is_beside(
        &self,
        corners: &[[f64; 3]; 3],
        normal: DVec3,
        lower: &[f64; 3],
        upper: &[f64; 3],
        beside: f64,
    ) -> bool {
        let [a, b, c] = corners;
        if (0..3).any(|k| {
            a[k] > upper[k] && b[k] > upper[k] && c[k] > upper[k]
                || a[k] < lower[k] && b[k] < lower[k] && c[k] < lower[k]
        }) {
            return true;
        }
        let h = corners.map(|p| normal.dot(DVec3::from_array(p) - self.centre));
        h.iter().all(|h| *h > beside) || h.iter().all(|h| *h < -beside)
    }
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

/// The direction of a vector of which enough is left to have one.
pub(super) fn unit(v: DVec3) -> Option<DVec3> {
    let length = v.length();
    (length > f64::MIN_POSITIVE.sqrt()).then(|| v / length)
}
