//! Faces of A that are far from B for their size: whole, or in halves, in front of planes behind which all of B lies.
//!
//! A cell over each face of B would be far narrower than asked there: seen from afar, the distance from all of B is nearly linear on
//! a face of A. Its gap to a linear function is of the second order, the square of the diameter by the distance. Where what the distances
//! of the corners say (`corners`) is narrow enough, not even planes are looked for.
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
use super::corners;
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
        let Task { scale, criterion, area } = task;
        let longest = scale.longest_edge_sq();
        let [x, y, z] = start.distances;
        let distance = (x + y + z) * (1.0 / 3.0);
        let widths = if distance * distance > FAR * longest { MOST_WIDTHS_OF_FAR } else { MOST_WIDTHS };
        if longest > widths * criterion.width_of(area) * distance {
            return false;
        }
        self.beyond = None;
        let near = self.face_near(start, workspace);
        if let Some(polygon) = self.by_corners(task, start, near, workspace) {
            pieces.push(Piece { polygon, near });
            return true;
        }
        let mut looks = 0;
        self.parts.clear();
        self.parts.push((Outline::WHOLE, near));
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
            if criterion.width_unless_met(&looked.polygon, &weights, area).is_none() {
                pieces.push(Piece { polygon: looked.polygon, near: looked.near });
                continue;
            }
            for half in outline.halve_triangle(scale) {
                self.parts.push((half, looked.near));
            }
        }
        true
    }

    /// The whole face as a piece, if what the distances of its corners say is narrow enough.
    fn by_corners(
        &self,
        Task { scale, criterion, area }: Task<'_>,
        start: &Start,
        near: Slot,
        workspace: &mut Workspace,
    ) -> Option<Polygon> {
        let below = corners::below(start.corners, start.distances, scale.margin)?;
        let mut polygon = Polygon::unknown(Outline::WHOLE, 0.0);
        polygon.lower = std::array::from_fn(|j| below[j.min(2)]);
        let points = scale.points(&Outline::WHOLE);
        let distances = distances(self.bvh, near, &points, 3, workspace);
        polygon.upper = distances.map(|distance| distance + scale.margin);
        criterion.width_unless_met(&polygon, &Outline::WHOLE.weights(), area).is_none().then_some(polygon)
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
        Task { scale, criterion, area }: Task<'_>,
        outline: &Outline,
        near: Slot,
        workspace: &mut Workspace,
    ) -> Looked {
        let points = scale.points(outline);
        let margin = scale.margin + scale.displacement(outline);
        let weights = outline.weights();
        let width = criterion.width_of(weights.iter().sum::<f64>() * area);
        let mut above = |slot: Slot| -> Row {
            distances(self.bvh, slot, &points, outline.count, workspace).map(|distance| distance + margin)
        };
        let mut polygon = Polygon::unknown(*outline, 0.0);
        polygon.upper = above(near);
        let mut looked = Looked { polygon, near };
        for again in [false, true] {
            let support = self.support(&looked, &points, SLACK * width + 2.0 * margin);
            let of_whole = self.beyond.filter(|_| again || outline.depth > 0);
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
            if criterion.width_unless_met(&looked.polygon, &weights, area).is_none() {
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
        let corners = from_centre(block, support);
        let common = common_plane(&corners, support);
        include(&planes_of(&corners, common, support), i, &mut below, &mut met);
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
    let corners = from_centre(block, support);
    let common = common_plane(&corners, support);
    // One plane in front of all of them is enough as a rule.
    let mut short = 0.0;
    for l in 0..LANES {
        short += common.1[l];
    }
    if short == 0.0 {
        for i in 0..3 {
            for l in 0..LANES {
                let value = common.0[i][l];
                below[i] = if value < below[i] { value } else { below[i] };
                beyond[i] = if value < beyond[i] { value } else { beyond[i] };
            }
        }
        return 0;
    }
    let planes = planes_of(&corners, common, support);
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

// What follows goes over all lanes one operation at a time, without closures: so it is compiled for the instruction set of its caller.

/// A number for each of eight triangles, and a vector.
type Lanes = [f64; LANES];
type Vectors = [Lanes; 3];

/// The corners of eight triangles as seen from the centre.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn from_centre(block: &TriangleBlock, support: &Support) -> [Vectors; 3] {
    let o = broadcast(support.centre);
    [minus(&block[0], &o), minus(&block[1], &o), minus(&block[2], &o)]
}

/// The planes of eight triangles along the direction that is common to all.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn common_plane([a, b, c]: &[Vectors; 3], support: &Support) -> (Vectors, Lanes) {
    plane(&broadcast(support.common), [a, b, c], support)
}

/// The best of three planes of each triangle: any direction no longer than one is valid, for how far the triangle reaches along it is computed.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn planes_of([a, b, c]: &[Vectors; 3], common: (Vectors, Lanes), support: &Support) -> PlanesOfBlock {
    let (ab, ac, bc) = (minus(b, a), minus(c, a), minus(c, b));
    let edges = nearer(from_edge(a, &ab), from_edge(a, &ac));
    let edges = nearer(edges, from_edge(b, &bc));
    let normal = cross(&ab, &ac);
    let square = dot(&normal, &normal);
    let (height, v, w) = (dot(&normal, a), dot(&cross(&ac, a), &normal), dot(&cross(a, &ab), &normal));
    let mut foot = [0.0; LANES];
    let mut side = [0.0; LANES];
    let own_length = inverse_length(&square);
    for l in 0..LANES {
        foot[l] = -height[l] / square[l];
        side[l] = if height[l] > 0.0 { -own_length[l] } else { own_length[l] };
    }
    let foot = times(&foot, &normal);
    let mut foot_square = dot(&foot, &foot);
    for l in 0..LANES {
        // What is no number counts as outside.
        let least = if v[l] < w[l] { v[l] } else { w[l] };
        let most = v[l] + w[l];
        let beside = if least >= 0.0 { most } else { f64::INFINITY };
        foot_square[l] = if beside <= square[l] { foot_square[l] } else { f64::INFINITY };
    }
    let (way, distances_sq) = nearer((foot, foot_square), edges);
    let tangent = plane(&times(&inverse_length(&distances_sq), &way), [a, b, c], support);
    let own = plane(&times(&side, &normal), [a, b, c], support);
    let (rows, _) = better(better(common, tangent), own);
    PlanesOfBlock { rows, distances_sq }
}

/// Values at the corners of P of the planes that touch triangles along directions, and how far they are short of the wanted ones together:
/// not positive.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn plane(g: &Vectors, [a, b, c]: [&Vectors; 3], support: &Support) -> (Vectors, Lanes) {
    let (x, y, z) = (dot(g, a), dot(g, b), dot(g, c));
    let mut rows = [[0.0; LANES]; 3];
    let mut short = [0.0; LANES];
    for i in 0..3 {
        let (way, wanted) = (support.ways[i], support.wanted[i]);
        for l in 0..LANES {
            let reach = if x[l] > y[l] { x[l] } else { y[l] };
            let reach = if reach > z[l] { reach } else { z[l] };
            let value = g[0][l] * way[0] + g[1][l] * way[1] + g[2][l] * way[2] - reach;
            rows[i][l] = value;
            short[l] += if value < wanted { value - wanted } else { 0.0 };
        }
    }
    (rows, short)
}

/// From the nearest points of edges to the centre, and the squares of these ways.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn from_edge(p: &Vectors, edge: &Vectors) -> (Vectors, Lanes) {
    let (along, square) = (dot(p, edge), dot(edge, edge));
    let mut r = [[0.0; LANES]; 3];
    let mut t = [0.0; LANES];
    for l in 0..LANES {
        let x = -along[l] / square[l];
        let x = if x > 0.0 { x } else { 0.0 };
        t[l] = if x < 1.0 { x } else { 1.0 };
    }
    for k in 0..3 {
        for l in 0..LANES {
            r[k][l] = -(p[k][l] + t[l] * edge[k][l]);
        }
    }
    (r, dot(&r, &r))
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn nearer(x: (Vectors, Lanes), y: (Vectors, Lanes)) -> (Vectors, Lanes) {
    let (mut r, mut square) = y;
    for l in 0..LANES {
        for k in 0..3 {
            r[k][l] = if x.1[l] < y.1[l] { x.0[k][l] } else { y.0[k][l] };
        }
        square[l] = if x.1[l] < y.1[l] { x.1[l] } else { y.1[l] };
    }
    (r, square)
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn better(x: (Vectors, Lanes), y: (Vectors, Lanes)) -> (Vectors, Lanes) {
    let (mut rows, mut short) = x;
    for l in 0..LANES {
        for i in 0..3 {
            rows[i][l] = if y.1[l] > x.1[l] { y.0[i][l] } else { x.0[i][l] };
        }
        short[l] = if y.1[l] > x.1[l] { y.1[l] } else { x.1[l] };
    }
    (rows, short)
}

/// One by a length, given its square; less where digits of the square are lost.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn inverse_length(square: &Lanes) -> Lanes {
    let mut inverse = [0.0; LANES];
    for l in 0..LANES {
        let square = if square[l] > LEAST_SQUARE { square[l] } else { LEAST_SQUARE };
        inverse[l] = 1.0 / square.sqrt();
    }
    inverse
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn broadcast(a: [f64; 3]) -> Vectors {
    [[a[0]; LANES], [a[1]; LANES], [a[2]; LANES]]
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn times(s: &Lanes, a: &Vectors) -> Vectors {
    let mut out = [[0.0; LANES]; 3];
    for k in 0..3 {
        for l in 0..LANES {
            out[k][l] = s[l] * a[k][l];
        }
    }
    out
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn minus(a: &Vectors, b: &Vectors) -> Vectors {
    let mut out = [[0.0; LANES]; 3];
    for k in 0..3 {
        for l in 0..LANES {
            out[k][l] = a[k][l] - b[k][l];
        }
    }
    out
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn dot(a: &Vectors, b: &Vectors) -> Lanes {
    let mut out = [0.0; LANES];
    for l in 0..LANES {
        out[l] = a[0][l] * b[0][l] + a[1][l] * b[1][l] + a[2][l] * b[2][l];
    }
    out
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn cross(a: &Vectors, b: &Vectors) -> Vectors {
    let mut out = [[0.0; LANES]; 3];
    for l in 0..LANES {
        out[0][l] = a[1][l] * b[2][l] - a[2][l] * b[1][l];
        out[1][l] = a[2][l] * b[0][l] - a[0][l] * b[2][l];
        out[2][l] = a[0][l] * b[1][l] - a[1][l] * b[0][l];
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::candidates::Scale;
    use super::super::criterion::Criterion;
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
            let criterion = Criterion { mass: 0.1 * width, focus: Vec::new(), focus_mass: f64::INFINITY, floor: 1e-12 };
            let control = Control::default();
            let (mut pieces, mut rest) = (Vec::new(), Vec::new());
            let mut planes = Planes::new(bvh, &neighbours);
            let task = Task { scale: &scale, criterion: &criterion, area: start.area };
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
