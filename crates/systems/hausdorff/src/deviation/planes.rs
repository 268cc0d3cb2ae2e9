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

/// The square of the longest edge by the distance is some ten times what a linear function misses. A face of which that is more than so
/// many times the allowed width would be halved too often: cells are quicker. Not so where the distance, squared, is more than a part of
/// that of the longest edge: what is nearest to parts of a cell is then seen in many directions, and cells come out wide.
const MOST_WIDTHS: f64 = 600.0;
const MOST_WIDTHS_OF_FAR: f64 = 6000.0;
const FAR: f64 = 0.5;
/// Pieces looked at, of a face.
const MOST_LOOKS: usize = 64;
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
    /// What is known of all others, as a function on the whole face; none where too many leaves may be nearest.
    beyond: Option<Linear>,
    parts: Vec<(Outline, Slot)>,
}

/// A piece as it came out, and the nearest face that was met.
struct Looked {
    polygon: Polygon,
    near: Slot,
}

impl<'b> Planes<'b> {
    pub(super) fn new(bvh: &'b Bvh, neighbours: &'b Neighbours) -> Self {
        Self {
            bvh,
            neighbours,
            walk: Vec::new(),
            leaves: Vec::new(),
            blocks: Vec::new(),
            slots: Vec::new(),
            beyond: None,
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
        let distance = (x + y + z) * (1.0 / 3.0);
        let widths = if distance * distance > FAR * longest { MOST_WIDTHS_OF_FAR } else { MOST_WIDTHS };
        if longest > widths * goal.width_of(area) * distance {
            return false;
        }
        self.beyond = None;
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
            let looked = self.look(task, &outline, near, workspace);
            let weights = outline.weights();
            if goal.wanted(&looked.polygon, &weights, area).is_none() {
                pieces.push(Piece { polygon: looked.polygon, near: looked.near });
                continue;
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
            let of_whole = self.beyond.filter(|_| outline.depth > 0);
            let (below, met) = match of_whole {
                Some(beyond) => {
                    let row = beyond.row(outline);
                    least_of_planes(&self.blocks, &support, [row[0], row[1], row[2]])
                }
                None => self.ask_the_tree(&support, outline.depth == 0, 4.0 * scale.size),
            };
            let below = below.map(|value| value - margin);
            let row: Row = std::array::from_fn(|j| below[j.min(2)]);
            // Both are valid: the better one stays.
            if !again || integral(&weights, &row) > integral(&weights, &looked.polygon.lower) {
                looked.polygon.lower = row;
            }
            let nearest = match of_whole {
                _ if met.distance_sq == f64::INFINITY => looked.near,
                Some(_) => self.slots[met.place / LANES][met.place % LANES],
                None => self.bvh.slot_in(self.leaves[met.place / LANES], met.place % LANES),
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

    /// The least of the planes of all triangles, and the nearest one that was met, by its place among the leaves. Of a whole face, those that
    /// may be nearest somewhere on it are put into blocks for its parts; no distance is greater than `far`.
    fn ask_the_tree(&mut self, support: &Support, is_whole: bool, far: f64) -> ([f64; 3], Met) {
        let mut beyond = self.bvh.leaves_in_front(support, &mut self.walk, &mut self.leaves);
        let mut below = beyond;
        let mut met = Met { place: 0, distance_sq: f64::INFINITY };
        let keeps = is_whole && self.leaves.len() <= MOST_LEAVES;
        if is_whole {
            self.blocks.clear();
            self.slots.clear();
        }
        let mut lane = LANES;
        for (place, leaf) in self.leaves.iter().enumerate() {
            let block = self.bvh.triangles(*leaf);
            let mut near = least_of_leaf(block, place, support, &mut below, &mut beyond, &mut met);
            while keeps && near != 0 {
                let l = near.trailing_zeros() as usize;
                near &= near - 1;
                let slot = self.bvh.slot_in(*leaf, l);
                let corners = lane_of(block, l);
                if lane == LANES {
                    // Lanes without a triangle repeat the first.
                    let mut first = [[[0.0; LANES]; 3]; 3];
                    for l in 0..LANES {
                        set_lane(&mut first, l, corners);
                    }
                    self.blocks.push(first);
                    self.slots.push([slot; LANES]);
                    lane = 0;
                }
                let last = self.blocks.len() - 1;
                set_lane(&mut self.blocks[last], lane, corners);
                self.slots[last][lane] = slot;
                lane += 1;
            }
        }
        if is_whole {
            // Nothing may lie beyond: what no distance exceeds can be interpolated.
            let beyond = beyond.map(|value| if value < far { value } else { far });
            self.beyond = keeps.then(|| Linear::through(beyond));
        }
        (below, met)
    }
}

/// The nearest triangle met: its place among the lanes, and its squared distance from the centre.
#[derive(Clone, Copy)]
struct Met {
    place: usize,
    distance_sq: f64,
}

/// The least of the planes of all triangles in some blocks, and the nearest one, from what is known of others.
#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn least_of_planes(blocks: &[TriangleBlock], support: &Support, below: [f64; 3]) -> ([f64; 3], Met) {
    let (mut below, mut met) = (below, Met { place: 0, distance_sq: f64::INFINITY });
    for (i, block) in blocks.iter().enumerate() {
        include(&planes_of(block, support), i, &mut below, &mut met);
    }
    (below, met)
}

/// The same of the triangles of a leaf. Returns bits for those that come nearer than wanted; the others go into `beyond`.
#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn least_of_leaf(
    block: &TriangleBlock,
    place: usize,
    support: &Support,
    below: &mut [f64; 3],
    beyond: &mut [f64; 3],
    met: &mut Met,
) -> u8 {
    let planes = planes_of(block, support);
    include(&planes, place, below, met);
    let mut near = 0;
    for l in 0..LANES {
        let mut short = 0_u8;
        for i in 0..3 {
            short |= u8::from(planes.rows[i][l] < support.wanted[i]);
        }
        near |= short << l;
    }
    for i in 0..3 {
        for l in 0..LANES {
            let value = if near >> l & 1 == 0 { planes.rows[i][l] } else { f64::INFINITY };
            beyond[i] = if value < beyond[i] { value } else { beyond[i] };
        }
    }
    near
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn include(planes: &PlanesOfBlock, block: usize, below: &mut [f64; 3], met: &mut Met) {
    for i in 0..3 {
        let mut least = below[i];
        for l in 0..LANES {
            least = if planes.rows[i][l] < least { planes.rows[i][l] } else { least };
        }
        below[i] = least;
    }
    let mut nearest = f64::INFINITY;
    for l in 0..LANES {
        nearest = if planes.distances_sq[l] < nearest { planes.distances_sq[l] } else { nearest };
    }
    if nearest < met.distance_sq {
        let mut lane = 0;
        while lane < LANES - 1 && planes.distances_sq[lane] != nearest {
            lane += 1;
        }
        *met = Met { place: block * LANES + lane, distance_sq: nearest };
    }
}

/// For each of eight triangles, values at the corners of P of a function below the distance from it, and the squared distance of the centre.
struct PlanesOfBlock {
    rows: [[f64; LANES]; 3],
    distances_sq: [f64; LANES],
}

// What follows is written without closures: these are not compiled for the instruction set of their caller.

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn planes_of([a, b, c]: &TriangleBlock, support: &Support) -> PlanesOfBlock {
    let support = *support;
    let o = support.centre;
    let [mut first, mut second, mut third, mut distances_sq] = [[0.0; LANES]; 4];
    for l in 0..LANES {
        let a = [a[0][l] - o[0], a[1][l] - o[1], a[2][l] - o[2]];
        let b = [b[0][l] - o[0], b[1][l] - o[1], b[2][l] - o[2]];
        let c = [c[0][l] - o[0], c[1][l] - o[1], c[2][l] - o[2]];
        let ([x, y, z], distance_sq) = best_plane([a, b, c], &support);
        first[l] = x;
        second[l] = y;
        third[l] = z;
        distances_sq[l] = distance_sq;
    }
    PlanesOfBlock { rows: [first, second, third], distances_sq }
}

/// The best of three planes of a triangle, whose corners are given from the centre. Any direction no longer than one is valid, for how far the
/// triangle reaches along it is computed.
#[inline(always)]
#[allow(clippy::inline_always, reason = "must be inlined into the lane loops to be vectorised")]
#[allow(
    clippy::needless_bitwise_bool,
    reason = "a branch here would keep the lane loops from being vectorised"
)]
fn best_plane(corners: [[f64; 3]; 3], support: &Support) -> ([f64; 3], f64) {
    let [a, b, c] = corners;
    let (ab, ac, bc) = (minus(b, a), minus(c, a), minus(c, b));
    let edges = nearer(nearer(from_edge(a, ab), from_edge(a, ac)), from_edge(b, bc));
    let normal = cross(ab, ac);
    let square = dot(normal, normal);
    let height = -dot(normal, a);
    let inverse = 1.0 / square;
    let v = dot(cross(ac, a), normal) * inverse;
    let w = dot(cross(a, ab), normal) * inverse;
    let inside = (v >= 0.0) & (w >= 0.0) & (v + w <= 1.0);
    let foot = times(height * inverse, normal);
    let (r, distance_sq) = nearer((foot, if inside { dot(foot, foot) } else { f64::INFINITY }), edges);
    let side = if height < 0.0 { -1.0 } else { 1.0 };
    let common = plane(support.common, corners, support);
    let tangent = plane(times(inverse_length(distance_sq), r), corners, support);
    let own = plane(times(side * inverse_length(square), normal), corners, support);
    (better(better(common, tangent), own).0, distance_sq)
}

/// Values at the corners of P of the plane that touches a triangle along a direction, and how far they are short of the wanted ones together:
/// not positive.
#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn plane(g: [f64; 3], [a, b, c]: [[f64; 3]; 3], support: &Support) -> ([f64; 3], f64) {
    let (x, y, z) = (dot(g, a), dot(g, b), dot(g, c));
    let reach = if x > y { x } else { y };
    let reach = if reach > z { reach } else { z };
    let [u, v, w] = support.ways;
    let row = [dot(g, u) - reach, dot(g, v) - reach, dot(g, w) - reach];
    let short = minus(row, support.wanted);
    (row, at_most_zero(short[0]) + at_most_zero(short[1]) + at_most_zero(short[2]))
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn at_most_zero(x: f64) -> f64 {
    if x < 0.0 { x } else { 0.0 }
}

/// From the nearest point of an edge to the centre, and the square of its length.
#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn from_edge(p: [f64; 3], edge: [f64; 3]) -> ([f64; 3], f64) {
    let t = -dot(p, edge) / dot(edge, edge);
    let t = if t > 0.0 { t } else { 0.0 };
    let t = if t < 1.0 { t } else { 1.0 };
    let r = [-(p[0] + t * edge[0]), -(p[1] + t * edge[1]), -(p[2] + t * edge[2])];
    (r, dot(r, r))
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn nearer(x: ([f64; 3], f64), y: ([f64; 3], f64)) -> ([f64; 3], f64) {
    let first = x.1 < y.1;
    (chosen(first, x.0, y.0), if first { x.1 } else { y.1 })
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn better(x: ([f64; 3], f64), y: ([f64; 3], f64)) -> ([f64; 3], f64) {
    let second = y.1 > x.1;
    (chosen(second, y.0, x.0), if second { y.1 } else { x.1 })
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn chosen(first: bool, x: [f64; 3], y: [f64; 3]) -> [f64; 3] {
    [if first { x[0] } else { y[0] }, if first { x[1] } else { y[1] }, if first { x[2] } else { y[2] }]
}

/// One by a length, given its square; less where digits of the square are lost. A direction that comes out shorter than one is valid, too.
#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn inverse_length(square: f64) -> f64 {
    1.0 / (if square > LEAST_SQUARE { square } else { LEAST_SQUARE }).sqrt()
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn times(s: f64, a: [f64; 3]) -> [f64; 3] {
    [s * a[0], s * a[1], s * a[2]]
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

#[cfg(test)]
mod tests {
    use super::super::candidates::Scale;
    use super::super::goal::Goal;
    use super::*;
    use crate::Target;
    use crate::rounding::Rounding;
    use pompeiu_core::TriMesh;
    use pompeiu_core::run::Control;
    use pompeiu_testkit::effort::cases;
    use pompeiu_testkit::plain::point_triangle;
    use proptest::prelude::*;

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![-1.0..1.0_f64, (-2..3_i32).prop_map(|k| 0.25 * f64::from(k))]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(cases(400)))]

        /// Pieces and what is left cover the face, and on each piece the distance from all triangles of B lies between both functions.
        #[test]
        fn pieces_enclose_the_distance_from_every_triangle(
            points in prop::collection::vec([coordinate(), coordinate(), coordinate()], 3..120),
            t in prop::array::uniform3([coordinate(), coordinate(), coordinate()]),
            above in 0.0..2.0_f64,
            size in 0.05..1.0_f64,
            width in prop_oneof![Just(1e-1), Just(1e-2), Just(1e-3), Just(1e-9)],
        ) {
            let faces: Vec<[u32; 3]> = (0..points.len() as u32 - 2).map(|i| [i, i + 1, i + 2]).collect();
            let mesh = TriMesh::new(points, faces).unwrap();
            let rounding = Rounding::new(4.0);
            let target = Target::in_frame(&mesh, pompeiu_core::geom::Frame::of(&pompeiu_core::geom::Aabb::of_faces(&mesh)));
            let bvh = target.bvh();
            let neighbours = Neighbours::new(&mesh, bvh);
            let corners = t.map(|[x, y, z]| target.frame().map([size * x, size * y, size * z + above]));
            let triangles: Vec<_> = bvh.slots().map(|slot| bvh.corners(slot)).collect();
            let distance = |p: [f64; 3]| triangles.iter().map(|t| point_triangle(p, *t)).fold(f64::INFINITY, f64::min);
            let scale = Scale::new(corners, rounding);
            let start = Start { corners, area: 1.0, distances: corners.map(distance), near: [bvh.any_slot(); 3] };
            let goal = Goal { mass: 0.1 * width, focus: Vec::new(), focus_mass: f64::INFINITY, floor: 1e-12 };
            let control = Control::default();
            let (mut pieces, mut rest) = (Vec::new(), Vec::new());
            let mut planes = Planes::new(bvh, &neighbours);
            let task = Task { scale: &scale, goal: &goal, area: start.area };
            let limits = Limits { most: 1000, control: &control };
            if planes.cut(task, &start, limits, &mut Workspace::default(), &mut pieces, &mut rest) {
                let outlines = pieces.iter().map(|piece| piece.polygon.outline).chain(rest.iter().map(|rest| rest.outline));
                let share: f64 = outlines.map(|outline| outline.share()).sum();
                prop_assert!((share - 1.0).abs() < 1e-12, "{share}");
            }
            for Piece { polygon, .. } in &pieces {
                let Polygon { outline, lower, upper, .. } = polygon;
                for (v, w) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.5), (0.3, 0.3), (0.1, 0.6)] {
                    let at = |row: &Row| row[0] + v * (row[1] - row[0]) + w * (row[2] - row[0]);
                    let exact = distance(scale.point([at(&outline.v), at(&outline.w)]).to_array());
                    prop_assert!(at(lower) <= exact && exact <= at(upper), "{} {exact} {}", at(lower), at(upper));
                }
            }
        }
    }
}
