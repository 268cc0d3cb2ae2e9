//! Faces of A that are far from B for their size: whole, or in halves, in front of planes behind which all of B lies.
//!
//! A cell over each face of B would be far narrower than asked there: seen from afar, the distance from all of B is nearly linear on
//! a face of A. Its gap to a linear function is of the second order, the square of the diameter by the distance.
//!
//! # What is proven
//! On a triangle P with corners p and centre c:
//! * **above:** the distance from one face of B is convex, so its interpolation lies above the distance from B;
//! * **below:** each triangle of B lies behind one of three planes (with a normal common to all, with that from its nearest point to c, or with
//!   its own), computed as `g . (p - c) - max_j g . (t_j - c)`, and so no nearer than that; whole boxes of the tree lie behind planes of their own
//!   ([`Support`]). The least of these functions is concave, so its interpolation lies below the distance from B.
//!
//! What is left out for a whole face T is no nearer than a function that is interpolated from the corners of T (`beyond`), on parts of T as well.
//!
//! Errors are those of separating planes (see [`rounding`](crate::rounding)) and of the placing of corners, less than
//! [`Scale::margin`](super::candidates::Scale) together.

use super::candidates::Linear;
use super::cells::{Limits, Rest, Task};
use super::envelope::{distances, unit};
use super::face::Start;
use super::polygon::{Outline, Piece, Polygon, Row, integral};
use glam::DVec3;
use multiversion::multiversion;
use pompeiu_core::geom::point_triangle::{LANES, TriangleBlock, closest_barycentric, lane_of, set_lane};
use pompeiu_core::spatial::bvh::{LEAST_SQUARE, Leaf, Support};
use pompeiu_core::spatial::{Bvh, Neighbours, Slot, Workspace};

/// A face whose distance from a linear function, estimated as this part of the square of its longest edge by the distance, is more
/// than so many times the allowed width would be halved too often.
const CURVATURE: f64 = 0.1;
const MOST_WIDTHS: f64 = 40.0;
/// Pieces looked at, of a face.
const MOST_LOOKS: usize = 48;
/// Leaves that a face keeps for its parts; beyond, each part asks the tree.
const MOST_LEAVES: usize = 96;
/// Part of the allowed width by which planes may lie below the function above.
const SLACK: f64 = 0.3;
/// Steps across edges to a nearer face.
const MOST_STEPS: usize = 16;

/// Looks at faces of A, and memory for that.
pub(super) struct Planes<'b> {
    bvh: &'b Bvh,
    neighbours: &'b Neighbours,
    walk: Vec<u32>,
    leaves: Vec<Leaf>,
    /// The triangles that may be nearest on the face, eight to a block, and their places in the tree.
    blocks: Vec<TriangleBlock>,
    slots: Vec<[Slot; LANES]>,
    parts: Vec<(Outline, Slot)>,
}

/// A piece as it came out, and the nearest face that was met.
struct Looked {
    polygon: Polygon,
    near: Slot,
}

/// What is known of all faces that are not among the blocks: a function on the whole face. None before the tree was asked, or where too many
/// leaves came of it.
type Beyond = Option<Linear>;

impl<'b> Planes<'b> {
    pub(super) fn new(bvh: &'b Bvh, neighbours: &'b Neighbours) -> Self {
        Self {
            bvh,
            neighbours,
            walk: Vec::new(),
            leaves: Vec::new(),
            blocks: Vec::new(),
            slots: Vec::new(),
            parts: Vec::new(),
        }
    }

    /// Cuts a face into pieces that are narrow enough, and what is left, unless it is too near to B for its size. Says whether it was tried.
    pub(super) fn cut(
        &mut self,
        task: Task<'_>,
        start: &Start,
        limits: Limits<'_>,
        workspace: &mut Workspace,
        pieces: &mut Vec<Piece>,
        rest: &mut Vec<Rest>,
    ) -> bool {
        let Task { scale, goal, area } = task;
        let longest = scale.longest_edge_sq();
        let [x, y, z] = start.distances;
        let nearest = if x < y { x } else { y };
        let nearest = if nearest < z { nearest } else { z };
        if !(CURVATURE * longest <= MOST_WIDTHS * goal.width_of(area) * nearest) {
            return false;
        }
        let mut beyond = None;
        let mut looks = 0;
        self.parts.clear();
        self.parts.push((Outline::WHOLE, self.face_near(start, workspace)));
        while let Some((outline, near)) = self.parts.pop() {
            looks += 1;
            if looks > MOST_LOOKS
                || pieces.len() + self.parts.len() + rest.len() >= limits.most
                || limits.control.is_stopped()
            {
                rest.push(Rest { outline, near });
                continue;
            }
            let is_whole = outline.depth == 0;
            let looked = self.look(task, &outline, near, &beyond, workspace);
            let weights = outline.weights();
            if goal.wanted(&looked.polygon, &weights, area).is_none() {
                pieces.push(Piece { polygon: looked.polygon, near: looked.near });
                continue;
            }
            if is_whole {
                beyond = self.keep_what_may_be_nearest(task, &looked);
            }
            for half in outline.halve_triangle(scale) {
                self.parts.push((half, looked.near));
            }
        }
        true
    }

    /// Of the faces nearest to the corners the one nearest to the centre, or one that is nearer and reached across edges.
    fn face_near(&self, start: &Start, workspace: &mut Workspace) -> Slot {
        let [a, b, c] = start.corners;
        let centre: [f64; 3] = std::array::from_fn(|k| (a[k] + b[k] + c[k]) * (1.0 / 3.0));
        let mut best = (f64::INFINITY, start.near[0]);
        let mut tried = [None; 3];
        for (i, slot) in start.near.into_iter().enumerate() {
            if tried.contains(&Some(slot)) {
                continue;
            }
            tried[i] = Some(slot);
            let distance = self.bvh.distance_sq(centre, slot);
            workspace.distances += 1;
            best = if distance < best.0 { (distance, slot) } else { best };
        }
        for _ in 0..MOST_STEPS {
            let before = best;
            for k in 0..3 {
                if let Some(across) = self.neighbours.across(before.1, k) {
                    let distance = self.bvh.distance_sq(centre, across.slot);
                    workspace.distances += 1;
                    best = if distance < best.0 { (distance, across.slot) } else { best };
                }
            }
            if best.1 == before.1 {
                break;
            }
        }
        best.1
    }

    /// Bounds the distance on a triangle from above by one face of B, and from below by planes of all.
    fn look(
        &mut self,
        Task { scale, goal, area }: Task<'_>,
        outline: &Outline,
        near: Slot,
        beyond: &Beyond,
        workspace: &mut Workspace,
    ) -> Looked {
        let points = scale.points(outline);
        let margin = scale.margin + scale.displacement(outline);
        let weights = outline.weights();
        let width = goal.width_of(weights.iter().sum::<f64>() * area);
        let mut above = |slot: Slot| -> Row {
            distances(self.bvh, slot, &points, outline.count, workspace).map(|distance| distance + margin)
        };
        let mut polygon = Polygon::unknown(*outline, 0.0);
        polygon.upper = above(near);
        let mut looked = Looked { polygon, near };
        for again in [false, true] {
            let support = self.support(&looked, &points, SLACK * width + 2.0 * margin);
            let (mut below, met) = match beyond {
                Some(beyond) => {
                    let row = beyond.row(outline);
                    least_of_planes(&self.blocks, &support, [row[0], row[1], row[2]])
                }
                None => {
                    let below = self.bvh.leaves_in_front(&support, &mut self.walk, &mut self.leaves);
                    least_of_leaves(self.bvh, &self.leaves, &support, below)
                }
            };
            below = below.map(|value| value - margin);
            let row: Row = std::array::from_fn(|j| below[j.min(2)]);
            // Both are valid: the better one stays.
            if !again || integral(&weights, &row) > integral(&weights, &looked.polygon.lower) {
                looked.polygon.lower = row;
            }
            let nearest = match (met, beyond) {
                (Some(Met { place, .. }), Some(_)) => self.slots[place / LANES][place % LANES],
                (Some(Met { place, .. }), None) => self.bvh.slot_in(self.leaves[place / LANES], place % LANES),
                (None, _) => looked.near,
            };
            if again || nearest == looked.near {
                break;
            }
            let upper = above(nearest);
            looked.near = nearest;
            if integral(&weights, &upper) < integral(&weights, &looked.polygon.upper) {
                looked.polygon.upper = upper;
            } else {
                break;
            }
            if goal.wanted(&looked.polygon, &weights, area).is_none() {
                break;
            }
        }
        looked
    }

    /// What planes are compared with: the function above, less what may be lost.
    fn support(&self, looked: &Looked, points: &[Row; 3], slack: f64) -> Support {
        let corner = |i: usize| DVec3::new(points[0][i], points[1][i], points[2][i]);
        let corners = [corner(0), corner(1), corner(2)];
        let centre = (corners[0] + corners[1] + corners[2]) * (1.0 / 3.0);
        let face = self.bvh.corners(looked.near);
        let beta = closest_barycentric(centre.to_array(), face);
        let [a, b, c] = face.map(DVec3::from_array);
        let away = centre - (a + beta[1] * (b - a) + beta[2] * (c - a));
        let common = unit(away).unwrap_or(DVec3::X);
        Support {
            centre: centre.to_array(),
            ways: corners.map(|corner| (corner - centre).to_array()),
            wanted: [0, 1, 2].map(|i| looked.polygon.upper[i] - slack),
            common: common.to_array(),
        }
    }

    /// Puts the triangles that may be nearest somewhere on the whole face into blocks, and returns what bounds the others.
    fn keep_what_may_be_nearest(&mut self, Task { scale, goal, area }: Task<'_>, looked: &Looked) -> Beyond {
        let outline = &looked.polygon.outline;
        let slack = SLACK * goal.width_of(area) + 2.0 * scale.margin;
        let support = self.support(looked, &scale.points(outline), slack);
        let mut beyond = self.bvh.leaves_in_front(&support, &mut self.walk, &mut self.leaves);
        self.blocks.clear();
        self.slots.clear();
        if self.leaves.len() > MOST_LEAVES {
            return None;
        }
        let mut lane = LANES;
        for leaf in &self.leaves {
            let block = self.bvh.triangles(*leaf);
            let planes = planes_of(block, &support);
            for l in 0..LANES {
                let row = [0, 1, 2].map(|i| planes.rows[i][l]);
                if (0..3).all(|i| row[i] >= support.wanted[i]) {
                    for i in 0..3 {
                        beyond[i] = if row[i] < beyond[i] { row[i] } else { beyond[i] };
                    }
                    continue;
                }
                let slot = self.bvh.slot_in(*leaf, l);
                if lane == LANES {
                    // Lanes without a triangle repeat the first.
                    let mut first = [[[0.0; LANES]; 3]; 3];
                    for l in 0..LANES {
                        set_lane(&mut first, l, self.bvh.corners(slot));
                    }
                    self.blocks.push(first);
                    self.slots.push([slot; LANES]);
                    lane = 0;
                }
                let last = self.blocks.len() - 1;
                set_lane(&mut self.blocks[last], lane, lane_of(block, l));
                self.slots[last][lane] = slot;
                lane += 1;
            }
        }
        // Nothing may lie beyond: no distance is greater than this, which can be interpolated.
        let far = 4.0 * scale.size;
        Some(Linear::through(beyond.map(|value| if value < far { value } else { far })))
    }
}

/// The nearest triangle met: its place among the lanes, and its squared distance from the centre.
#[derive(Clone, Copy)]
struct Met {
    place: usize,
    distance_sq: f64,
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn least_of_planes(blocks: &[TriangleBlock], support: &Support, mut below: [f64; 3]) -> ([f64; 3], Option<Met>) {
    let mut met = None;
    for (i, block) in blocks.iter().enumerate() {
        include(&planes_of(block, support), i, &mut below, &mut met);
    }
    (below, met)
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn least_of_leaves(bvh: &Bvh, leaves: &[Leaf], support: &Support, mut below: [f64; 3]) -> ([f64; 3], Option<Met>) {
    let mut met = None;
    for (i, leaf) in leaves.iter().enumerate() {
        include(&planes_of(bvh.triangles(*leaf), support), i, &mut below, &mut met);
    }
    (below, met)
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn include(planes: &PlanesOfBlock, block: usize, below: &mut [f64; 3], met: &mut Option<Met>) {
    let mut nearest = met.map_or(f64::INFINITY, |met| met.distance_sq);
    for l in 0..LANES {
        for i in 0..3 {
            below[i] = if planes.rows[i][l] < below[i] { planes.rows[i][l] } else { below[i] };
        }
        if planes.distances_sq[l] < nearest {
            nearest = planes.distances_sq[l];
            *met = Some(Met { place: block * LANES + l, distance_sq: nearest });
        }
    }
}

/// For each of eight triangles, values at the corners of P of a function below the distance from it, and the squared distance of the centre.
struct PlanesOfBlock {
    rows: [[f64; LANES]; 3],
    distances_sq: [f64; LANES],
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn planes_of([a, b, c]: &TriangleBlock, support: &Support) -> PlanesOfBlock {
    let mut planes = PlanesOfBlock { rows: [[0.0; LANES]; 3], distances_sq: [0.0; LANES] };
    let o = support.centre;
    for l in 0..LANES {
        let from_centre = |p: &[[f64; LANES]; 3]| [p[0][l] - o[0], p[1][l] - o[1], p[2][l] - o[2]];
        let (row, distance_sq) = best_plane(from_centre(a), from_centre(b), from_centre(c), support);
        for i in 0..3 {
            planes.rows[i][l] = row[i];
        }
        planes.distances_sq[l] = distance_sq;
    }
    planes
}

/// The best of three planes of a triangle, whose corners are given from the centre. Any direction is valid, for how far the triangle reaches
/// along it is computed; one that is no number is not chosen.
#[inline(always)]
#[allow(clippy::inline_always, reason = "must be inlined into the lane loops to be vectorised")]
#[allow(clippy::needless_bitwise_bool, reason = "a branch here would keep the lane loops from being vectorised")]
fn best_plane(a: [f64; 3], b: [f64; 3], c: [f64; 3], support: &Support) -> ([f64; 3], f64) {
    let (ab, ac, bc) = (minus(b, a), minus(c, a), minus(c, b));
    // From the nearest point of each edge, and of the plane, to the centre.
    let from_edge = |p: [f64; 3], edge: [f64; 3]| {
        let t = -dot(p, edge) / dot(edge, edge);
        let t = if t > 0.0 { t } else { 0.0 };
        let t = if t < 1.0 { t } else { 1.0 };
        let r = [0, 1, 2].map(|k| -(p[k] + t * edge[k]));
        (r, dot(r, r))
    };
    let nearer = |x: ([f64; 3], f64), y: ([f64; 3], f64)| {
        let first = x.1 < y.1;
        ([0, 1, 2].map(|k| if first { x.0[k] } else { y.0[k] }), if first { x.1 } else { y.1 })
    };
    let edges = nearer(nearer(from_edge(a, ab), from_edge(a, ac)), from_edge(b, bc));
    let normal = cross(ab, ac);
    let square = dot(normal, normal);
    let height = -dot(normal, a);
    let inverse = 1.0 / square;
    let v = dot(cross(ac, a), normal) * inverse;
    let w = dot(cross(a, ab), normal) * inverse;
    let inside = (v >= 0.0) & (w >= 0.0) & (v + w <= 1.0);
    let foot = height * inverse;
    let of_foot = [0, 1, 2].map(|k| foot * normal[k]);
    let of_foot = (of_foot, if inside { dot(of_foot, of_foot) } else { f64::INFINITY });
    let (r, distance_sq) = nearer(of_foot, edges);

    let plane = |g: [f64; 3]| {
        let (x, y, z) = (dot(g, a), dot(g, b), dot(g, c));
        let reach = if x > y { x } else { y };
        let reach = if reach > z { reach } else { z };
        let row = support.ways.map(|way| dot(g, way) - reach);
        let short = |i: usize| {
            let short = row[i] - support.wanted[i];
            if short < 0.0 { short } else { 0.0 * short }
        };
        (row, short(0) + short(1) + short(2))
    };
    let better = |x: ([f64; 3], f64), y: ([f64; 3], f64)| {
        let second = y.1 > x.1;
        ([0, 1, 2].map(|i| if second { y.0[i] } else { x.0[i] }), if second { y.1 } else { x.1 })
    };
    let direction = |g: [f64; 3], square: f64| {
        let inverse = 1.0 / square.sqrt();
        let inverse = if square > LEAST_SQUARE { inverse } else { f64::NAN };
        g.map(|x| x * inverse)
    };
    let side = if height < 0.0 { -1.0 } else { 1.0 };
    let own = direction(normal, square).map(|x| x * side);
    let best = better(plane(support.common), plane(direction(r, distance_sq)));
    (better(best, plane(own)).0, distance_sq)
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
