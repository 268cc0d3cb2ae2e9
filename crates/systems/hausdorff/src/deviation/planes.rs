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
//! What is left out for a whole face T, or for a part of it, is no nearer than a function that is interpolated from the corners (`beyond`), on parts
//! of that as well. So parts of parts look at fewer and fewer triangles.
//!
//! Errors are those of separating planes (see [`rounding`](crate::rounding)) and of the placing of corners, less than
//! [`Scale::margin`](super::candidates::Scale) together.

use super::cells::{Limits, Rest, Task};
use super::corners::{self, Start};
use super::envelope::{distances, unit};
use super::lanes::{Lanes, Seen, Vectors, broadcast, from_point, inverse_length, reach, seen, times};
use super::linear::lesser;
use super::polygon::{MOST_CORNERS, Outline, Piece, Polygon, Row, integral};
use glam::DVec3;
use multiversion::multiversion;
use pompeiu_core::geom::point_triangle::{LANES, TriangleBlock, lane_of, near_weights, set_lane};
use pompeiu_core::spatial::bvh::{Leaf, Support};
use pompeiu_core::spatial::{Bvh, Neighbours, Slot, Workspace};
use std::ops::Range;

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
    /// The triangles of lists, eight to a block, and their places in the tree. Lists of parts follow those of what they are parts of.
    blocks: Vec<TriangleBlock>,
    slots: Vec<[Slot; LANES]>,
    /// For each block of the list that was looked at last a bit for each triangle that comes nearer than wanted.
    near: Vec<u8>,
    parts: Vec<Part>,
}

/// A part of a face that is to be looked at.
#[derive(Clone)]
struct Part {
    outline: Outline,
    /// A face near it.
    near: Slot,
    /// None where too many triangles may be nearest: then it asks the tree.
    list: Option<List>,
}

/// The triangles that may be nearest on a part.
#[derive(Clone)]
struct List {
    /// Its blocks.
    blocks: Range<usize>,
    /// Values at the corners of a function below the distance from all other triangles.
    beyond: Row,
}

/// A piece as it came out, the nearest face that was met, and what its parts look at.
struct Looked {
    polygon: Polygon,
    near: Slot,
    /// What is known of triangles that do not come nearer than wanted.
    beyond: Row,
    list: Option<List>,
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
            near: Vec::new(),
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
        let near = self.face_near(start, workspace);
        if let Some(polygon) = self.by_corners(task, start, near, workspace) {
            pieces.push(Piece { polygon, near });
            return true;
        }
        let mut looks = 0;
        self.parts.clear();
        self.parts.push(Part { outline: Outline::WHOLE, near, list: None });
        while let Some(part) = self.parts.pop() {
            let Part { outline, near, .. } = part;
            // Lists that follow are those of parts that are done with.
            let end = part.list.as_ref().map_or(0, |list| list.blocks.end);
            self.blocks.truncate(end);
            self.slots.truncate(end);
            looks += 1;
            if looks > MOST_LOOKS
                || pieces.len() + self.parts.len() + rest.len() >= limits.most
                || limits.control.is_stopped()
            {
                rest.push(Rest { outline, near });
                continue;
            }
            let looked = self.look(task, part, workspace);
            let weights = outline.weights();
            if criterion.width_unless_met(&looked.polygon, &weights, area).is_none() {
                pieces.push(Piece { polygon: looked.polygon, near: looked.near });
                continue;
            }
            let Looked { near, beyond, list, .. } = looked;
            let list = self.shortened(list.as_ref(), beyond);
            for (outline, beyond) in outline.halve_triangle(|way| scale.way(way).length_squared(), &beyond) {
                let list = list.as_ref().map(|List { blocks, .. }| List { blocks: blocks.clone(), beyond });
                self.parts.push(Part { outline, near, list });
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
        self.nearer(centre, best, workspace)
    }

    /// A face that is nearer to a point than this one at this squared distance, if steps across edges lead to one.
    fn nearer(&self, point: [f64; 3], mut best: (f64, Slot), workspace: &mut Workspace) -> Slot {
        for _ in 0..MOST_STEPS {
            let before = best;
            for k in 0..3 {
                if let Some(across) = self.neighbours.across(before.1, k) {
                    let distance = self.bvh.distance_sq(point, across.slot);
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
        Part { outline, near, mut list }: Part,
        workspace: &mut Workspace,
    ) -> Looked {
        let points = scale.points(&outline);
        let margin = scale.margin + scale.displacement(&outline);
        let weights = outline.weights();
        let width = criterion.width_of(weights.iter().sum::<f64>() * area);
        let bvh = self.bvh;
        let above = |slot: Slot, workspace: &mut Workspace| -> Row {
            distances(bvh, slot, &points, outline.count, workspace).map(|distance| distance + margin)
        };
        let near = if outline.depth == 0 { near } else { self.nearer_to_centre(&points, near, workspace) };
        let mut polygon = Polygon::unknown(outline, 0.0);
        polygon.upper = above(near, workspace);
        let mut looked = Looked { polygon, near, beyond: [0.0; MOST_CORNERS], list: None };
        for again in [false, true] {
            let support = self.support(&looked, &points, SLACK * width + 2.0 * margin);
            let found = match &list {
                Some(list) => self.look_at_list(&support, list),
                None => self.ask_the_tree(&support),
            };
            let row = row_of(found.below.map(|value| value - margin));
            // Both are valid: the better one stays.
            if !again || integral(&weights, &row) > integral(&weights, &looked.polygon.lower) {
                looked.polygon.lower = row;
            }
            // Nothing may lie beyond: what no distance exceeds can be interpolated.
            looked.beyond = row_of(found.beyond.map(|value| lesser(value, 4.0 * scale.size)));
            let nearest = found.met.slot.unwrap_or(looked.near);
            if again || nearest == looked.near {
                break;
            }
            let upper = above(nearest, workspace);
            looked.near = nearest;
            if integral(&weights, &upper) < integral(&weights, &looked.polygon.upper) {
                looked.polygon.upper = upper;
            } else {
                break;
            }
            if criterion.width_unless_met(&looked.polygon, &weights, area).is_none() {
                break;
            }
            list = self.shortened(list.as_ref(), looked.beyond);
        }
        looked.list = list;
        looked
    }

    /// A face near a triangle, or one that is nearer to its centre.
    fn nearer_to_centre(&self, points: &[Row; 3], near: Slot, workspace: &mut Workspace) -> Slot {
        let mut centre = [0.0; 3];
        for k in 0..3 {
            centre[k] = (points[k][0] + points[k][1] + points[k][2]) * (1.0 / 3.0);
        }
        let distance = self.bvh.distance_sq(centre, near);
        workspace.distances += 1;
        self.nearer(centre, (distance, near), workspace)
    }

    /// What planes are compared with: the function above, less what may be lost.
    fn support(&self, looked: &Looked, points: &[Row; 3], slack: f64) -> Support {
        let corner = |i: usize| DVec3::new(points[0][i], points[1][i], points[2][i]);
        let corners = [corner(0), corner(1), corner(2)];
        let centre = (corners[0] + corners[1] + corners[2]) * (1.0 / 3.0);
        let face = self.bvh.corners(looked.near);
        let [v, w] = near_weights(centre.to_array(), face);
        let [a, b, c] = face.map(DVec3::from_array);
        let away = centre - (a + v * (b - a) + w * (c - a));
        let common = unit(away).unwrap_or(DVec3::X);
        Support {
            centre: centre.to_array(),
            ways: corners.map(|corner| (corner - centre).to_array()),
            wanted: [0, 1, 2].map(|i| looked.polygon.upper[i] - slack),
            common: common.to_array(),
        }
    }

    /// Looks at all triangles, those of the leaves that come near one by one.
    fn ask_the_tree(&mut self, support: &Support) -> Found {
        let beyond = self.bvh.leaves_in_front(support, &mut self.walk, &mut self.leaves);
        let mut found = Found { below: beyond, beyond, met: Met::NOTHING };
        self.near.clear();
        for leaf in &self.leaves {
            let before = found.met.distance_sq;
            let near = least_of_leaf(self.bvh.triangles(*leaf), support, &mut found);
            if found.met.distance_sq < before {
                found.met.slot = Some(self.bvh.slot_in(*leaf, found.met.place % LANES));
            }
            self.near.push(near);
        }
        found
    }

    /// Looks at the triangles of a list, and at what is known of all others.
    fn look_at_list(&mut self, support: &Support, List { blocks, beyond }: &List) -> Found {
        let beyond = [beyond[0], beyond[1], beyond[2]];
        let mut found = Found { below: beyond, beyond, met: Met::NOTHING };
        self.near.clear();
        least_of_blocks(&self.blocks[blocks.clone()], support, &mut self.near, &mut found);
        if found.met.distance_sq < f64::INFINITY {
            found.met.slot =
                Some(self.slots[blocks.start + found.met.place / LANES][found.met.place % LANES]);
        }
        found
    }

    /// The triangles of the list that was looked at last, or of the leaves, that came nearer than wanted; none if the leaves are too many.
    fn shortened(&mut self, list: Option<&List>, beyond: Row) -> Option<List> {
        if list.is_none() && self.leaves.len() > MOST_LEAVES {
            return None;
        }
        let start = self.blocks.len();
        let mut lane = LANES;
        for i in 0..self.near.len() {
            let mut near = self.near[i];
            while near != 0 {
                let l = near.trailing_zeros() as usize;
                near &= near - 1;
                let (block, slot) = match list {
                    Some(List { blocks, .. }) => {
                        (&self.blocks[blocks.start + i], self.slots[blocks.start + i][l])
                    }
                    None => (self.bvh.triangles(self.leaves[i]), self.bvh.slot_in(self.leaves[i], l)),
                };
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
        Some(List { blocks: start..self.blocks.len(), beyond })
    }
}

/// Values at three corners as a row.
fn row_of([a, b, c]: [f64; 3]) -> Row {
    [a, b, c, c, c, c, c, c]
}

/// What triangles say of a part.
struct Found {
    /// Values at the corners of a function below the distance from all of B.
    below: [f64; 3],
    /// The same of what does not come nearer than wanted.
    beyond: [f64; 3],
    met: Met,
}

/// The nearest triangle met: its place among the lanes, its squared distance from the centre, and where it is in the tree.
#[derive(Clone, Copy)]
struct Met {
    place: usize,
    distance_sq: f64,
    slot: Option<Slot>,
}

impl Met {
    const NOTHING: Self = Self { place: 0, distance_sq: f64::INFINITY, slot: None };
}

/// Looks at the triangles of some blocks; adds for each block bits for those that come nearer than wanted.
#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn least_of_blocks(blocks: &[TriangleBlock], support: &Support, near: &mut Vec<u8>, found: &mut Found) {
    for (i, block) in blocks.iter().enumerate() {
        near.push(least_of_block(block, i, support, found));
    }
}

/// The same of the triangles of a leaf.
#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn least_of_leaf(block: &TriangleBlock, support: &Support, found: &mut Found) -> u8 {
    least_of_block(block, 0, support, found)
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn least_of_block(block: &TriangleBlock, place: usize, support: &Support, found: &mut Found) -> u8 {
    let Found { below, beyond, met } = found;
    let corners = from_point(support.centre, block);
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
        *met = Met { place: block * LANES + lane, distance_sq: nearest, slot: None };
    }
}

/// For each of eight triangles, values at the corners of P of a function below the distance from it, and the squared distance of the centre.
struct PlanesOfBlock {
    rows: [[f64; LANES]; 3],
    distances_sq: [f64; LANES],
}

// What follows goes over all lanes one operation at a time, without closures: so it is compiled for the instruction set of its caller.

/// The planes of eight triangles along the direction that is common to all.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn common_plane([a, b, c]: &[Vectors; 3], support: &Support) -> (Vectors, Lanes) {
    plane(&broadcast(support.common), [a, b, c], support)
}

/// The best of three planes of each triangle: any direction no longer than one is valid, for how far the triangle reaches along it is computed.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn planes_of(corners: &[Vectors; 3], common: (Vectors, Lanes), support: &Support) -> PlanesOfBlock {
    let [a, b, c] = corners;
    let Seen { way, distances_sq, normal } = seen(corners);
    let tangent = plane(&times(&inverse_length(&distances_sq), &way), [a, b, c], support);
    let own = plane(&normal, [a, b, c], support);
    let (rows, _) = better(better(common, tangent), own);
    PlanesOfBlock { rows, distances_sq }
}

/// Values at the corners of P of the planes that touch triangles along directions, and how far they are short of the wanted ones together:
/// not positive.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn plane(g: &Vectors, [a, b, c]: [&Vectors; 3], support: &Support) -> (Vectors, Lanes) {
    let reach = reach(g, [a, b, c]);
    let mut rows = [[0.0; LANES]; 3];
    let mut short = [0.0; LANES];
    for i in 0..3 {
        let (way, wanted) = (support.ways[i], support.wanted[i]);
        for l in 0..LANES {
            let value = g[0][l] * way[0] + g[1][l] * way[1] + g[2][l] * way[2] - reach[l];
            rows[i][l] = value;
            short[l] += if value < wanted { value - wanted } else { 0.0 };
        }
    }
    (rows, short)
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
            let target = Target::in_frame(&mesh, pompeiu_core::geom::Frame::of(&pompeiu_core::geom::Aabb::of_faces(&mesh)), pompeiu_core::spatial::Leaves::Compact);
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
