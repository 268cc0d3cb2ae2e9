//! Faces of B as cells need them: each with its plane, what is beyond its edges, and planes behind which the faces around it lie.
//!
//! Many cells lie over one face of B, and the faces around it are the same for all of them: so they are compared once, with the
//! face, and what comes of it is remembered. What is remembered depends on the face alone, so that it makes no difference which
//! cells asked before.
//!
//! # What is proven
//! Let F be a face of B, and R a reach. Each face that meets the box around F widened by R, and that along the edges of a face beside F ([`Bvh::keep_leaves_near`]), lies behind
//! one of a few planes, F itself included: `g . t <= c` for each of its corners t, and g has length one. So no point x is nearer to any of these faces than the
//! least of `g . x - c`. If x is no farther than R / 2 from F, all other faces are farther from x than F: what comes as near to x as F
//! has a point that is no farther than R from F, and so in that box. Faces of which all points lie farther than R beyond an edge of F,
//! seen along its normal, or above its plane, have no such point either, and need no plane.
//!
//! `g . x - c` is computed at the corners of a piece as they are placed. Products and sums in `g . x` are off by less than 6 units of
//! `u M` (see [`rounding`](crate::rounding)), those in `c` by less than 14 (the plane of F is raised to the other faces
//! behind it by a difference), the last difference by 4, the length of g by 28, and the placing of the corner by 28: together
//! below 80, and less than [`Scale::margin`](super::candidates::Scale).

use super::behind::{Group, Plane, rising_on_both_sides, tilted};
use super::envelope::unit;
use super::linear::{greater, lesser};
use super::polygon::{MOST_CORNERS, Row};
use crate::rounding::Rounding;
use glam::DVec3;
use multiversion::multiversion;
use pompeiu_core::geom::Aabb;
use pompeiu_core::geom::point_triangle::{LANES, TriangleBlock, lane_of};
use pompeiu_core::spatial::bvh::Leaf;
use pompeiu_core::spatial::{Bvh, Neighbours, Slot};

/// A face of B, and what is beyond its edges.
#[derive(Clone, Copy)]
pub(super) struct Facet {
    pub(super) slot: Slot,
    pub(super) corners: [DVec3; 3],
    /// Of length one; zero for a face without area.
    pub(super) normal: DVec3,
    pub(super) area: f64,
    pub(super) edges: [Edge; 3],
    /// In its plane, from the edges to the inside, of length one or zero.
    inward: [DVec3; 3],
}

impl Facet {
    /// The square of the length of the longest edge.
    pub(super) fn longest_edge_sq(&self) -> f64 {
        let [a, b, c] = self.corners;
        [a - b, b - c, c - a].map(DVec3::length_squared).into_iter().fold(0.0, greater)
    }
}

/// The plane between a face and the one across an edge.
#[derive(Clone, Copy)]
pub(super) struct Edge {
    /// From this face to the other, of length one or zero.
    pub(super) outward: DVec3,
    pub(super) from: DVec3,
    pub(super) across: Option<Slot>,
}

/// All `x` with `normal . x <= offset`.
#[derive(Clone, Copy)]
struct Half {
    normal: DVec3,
    offset: f64,
}

/// The faces around a face that rise over its plane on one side, how high the others rise, and planes behind which all lie.
#[derive(Default)]
struct Side {
    rising: Vec<Slot>,
    highest: f64,
    /// Empty before they are made.
    halves: Vec<Half>,
    are_too_many: bool,
}

/// What is around a face of B.
#[derive(Default)]
struct Surroundings {
    slot: Slot,
    /// Zero before it is known.
    reach: f64,
    sides: [Side; 2],
}

/// The leaves around a leaf of the tree.
#[derive(Default)]
struct Around {
    leaf: Option<Leaf>,
    reach: f64,
    leaves: Vec<(Leaf, Aabb)>,
}

/// Faces of B that were asked for, and memory for that.
pub(super) struct Facets<'b> {
    bvh: &'b Bvh,
    neighbours: &'b Neighbours,
    /// Faces that rise no higher over a plane count as lying behind.
    rise: f64,
    /// About the usual distance.
    mean: f64,
    known: Vec<Option<Facet>>,
    surroundings: Vec<Surroundings>,
    around: Vec<Around>,
    walk: Vec<u32>,
    group: Group,
}

/// Faces that are remembered, surroundings, and leaves.
const FACETS: usize = 1024;
const SURROUNDINGS: usize = 2048;
const LEAVES: usize = 256;
/// How far apart surroundings of a face with different reaches are kept.
const REACHES: usize = 613;
/// Planes of a face at most, and leaves around a leaf.
const MOST_HALVES: usize = 20;
const MOST_LEAVES: usize = 64;
/// Surroundings reach at least so many times the mean distance, as long as that is no more than this part of the size of the face, the root of its
/// area: what is around a face within its own size is little, and serves more cells. Farther where faces are far larger still, so that one reach
/// serves nearly all cells: planes that are compared at a height of many times the distance are not as good.
const LEAST_REACHES: [(f64, f64); 2] = [(4.0, 1.0), (12.0, 0.125)];
/// The part of the reach at which planes are compared.
const HEIGHT: f64 = 0.25;
/// A plane that is short of what is wanted by no more than this part of that height is good enough.
const SHORT: f64 = 4e-3;
/// One that is short by more than this part is bad.
const FAR_SHORT: f64 = 2e-2;
/// The squared length of the sum of the unit normals of two faces at an edge, at least: beyond, they are folded onto each other.
const LEAST_OPENING: f64 = 0.5;

impl<'b> Facets<'b> {
    /// `mean` is about the usual distance.
    pub(super) fn new(bvh: &'b Bvh, neighbours: &'b Neighbours, rounding: Rounding, mean: f64) -> Self {
        let rise = 4.0 * rounding.bound(0);
        let mut facets = Self {
            bvh,
            neighbours,
            rise,
            mean,
            known: vec![None; FACETS],
            surroundings: Vec::new(),
            around: Vec::new(),
            walk: Vec::new(),
            group: Group::default(),
        };
        facets.surroundings.resize_with(SURROUNDINGS, Surroundings::default);
        facets.around.resize_with(LEAVES, Around::default);
        facets
    }

    /// A face.
    pub(super) fn facet(&mut self, slot: Slot) -> &Facet {
        let Self { bvh, neighbours, .. } = *self;
        let place = &mut self.known[slot.index() % FACETS];
        if place.as_ref().is_none_or(|known| known.slot != slot) {
            *place = None;
        }
        place.get_or_insert_with(|| Facet::new(bvh, neighbours, slot))
    }

    /// Values at points of a function below the distance from B, for points over one side of a face that are no farther from it than a
    /// distance; none if too many faces are near.
    pub(super) fn below(&mut self, slot: Slot, below: bool, distance: f64, points: &[Row; 3]) -> Option<Row> {
        let wanted = 2.0 * distance + self.rise;
        let size = self.facet(slot).area.sqrt();
        let least = LEAST_REACHES.iter().fold(wanted, |least, (of_mean, of_size)| {
            greater(least, lesser(of_mean * self.mean, of_size * size))
        });
        let reach = power_of_two(least);
        // Reaches of neighbouring cells alternate: they are a power of two each.
        let index = (slot.index() + REACHES * (reach.to_bits() >> 52) as usize) % SURROUNDINGS;
        let known = &self.surroundings[index];
        if known.slot != slot || known.reach != reach {
            self.surround(index, slot, reach);
        }
        if self.surroundings[index].sides[usize::from(below)].halves.is_empty() {
            let facet = *self.facet(slot);
            let side = &mut self.surroundings[index].sides[usize::from(below)];
            side.make(self.bvh, &facet, below, reach, &mut self.group);
        }
        let side = &self.surroundings[index].sides[usize::from(below)];
        (!side.are_too_many).then(|| least_along(&side.halves, points))
    }

    /// Finds the faces around a face that rise over its plane.
    fn surround(&mut self, index: usize, slot: Slot, reach: f64) {
        let leaf = self.bvh.leaf_of(slot);
        let place = leaf.index() % LEAVES;
        if self.around[place].leaf != Some(leaf) || self.around[place].reach != reach {
            let Around { leaf: known, reach: known_reach, leaves } = &mut self.around[place];
            (*known, *known_reach) = (Some(leaf), reach);
            leaves.clear();
            let aabb = box_of(self.bvh.triangles(leaf));
            let (lower, upper) = (aabb.lower.map(|x| x - reach), aabb.upper.map(|x| x + reach));
            self.bvh.leaves_meeting(lower, upper, &mut self.walk, leaves);
            let triangles = self.bvh.triangles(leaf);
            let corners = (0..LANES).flat_map(|lane| lane_of(triangles, lane));
            self.bvh.keep_leaves_near(leaves, lane_of(triangles, 0), corners, reach + self.rise);
        }
        let facet = *self.facet(slot);
        let known = &mut self.surroundings[index];
        (known.slot, known.reach) = (slot, reach);
        let [above, below] = &mut known.sides;
        for side in [&mut *above, &mut *below] {
            side.rising.clear();
            side.halves.clear();
        }
        let leaves = &self.around[place].leaves;
        (above.are_too_many, below.are_too_many) = (leaves.len() > MOST_LEAVES, leaves.len() > MOST_LEAVES);
        if above.are_too_many {
            return;
        }
        let aabb = Aabb::of_points(&facet.corners.map(|p| p.to_array()));
        let plane = Plane {
            normal: facet.normal,
            through: facet.corners[0],
            lower: aabb.lower.map(|x| x - reach),
            upper: aabb.upper.map(|x| x + reach),
            rise: self.rise,
        };
        let lists = [&mut above.rising, &mut below.rising];
        [above.highest, below.highest] = rising_on_both_sides(self.bvh, leaves, &plane, lists);
    }
}

impl Side {
    /// Finds planes behind which the faces lie.
    fn make(&mut self, bvh: &Bvh, facet: &Facet, below: bool, reach: f64, group: &mut Group) {
        let normal = if below { -facet.normal } else { facet.normal };
        let through = facet.corners[0];
        let own = greatest_along(normal, &facet.corners.map(|p| p - through));
        let highest = if own > self.highest { own } else { self.highest };
        self.halves.push(Half { normal, offset: normal.dot(through) + highest });
        if self.are_too_many {
            return;
        }
        // The planes of those across edges lie in front of most others.
        let is_adjacent = |slot: Slot| facet.edges.iter().any(|edge| edge.across == Some(slot));
        let others = |adjacent: bool| {
            self.rising
                .iter()
                .copied()
                .filter(move |slot| *slot != facet.slot && is_adjacent(*slot) == adjacent)
        };
        group.fill(bvh, others(true).chain(others(false)));
        facet.cross_off_what_is_out_of_reach(normal, reach, group);
        while let Some(corners) = group.take() {
            if self.halves.len() == MOST_HALVES {
                self.are_too_many = true;
                return;
            }
            let half = facet.half_around(normal, &corners, HEIGHT * reach);
            group.cross_off(half.normal, half.offset);
            self.halves.push(half);
        }
    }
}

/// How far a triangle reaches along a direction.
#[inline]
fn greatest_along(g: DVec3, [a, b, c]: &[DVec3; 3]) -> f64 {
    let (a, b, c) = (g.dot(*a), g.dot(*b), g.dot(*c));
    let m = if a > b { a } else { b };
    if m > c { m } else { c }
}

/// The least of how far points lie in front of some planes.
#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn least_along(halves: &[Half], points: &[Row; 3]) -> Row {
    let mut row = [f64::INFINITY; MOST_CORNERS];
    for Half { normal, offset } in halves {
        for j in 0..MOST_CORNERS {
            let value = normal.x * points[0][j] + normal.y * points[1][j] + normal.z * points[2][j] - offset;
            row[j] = if value < row[j] { value } else { row[j] };
        }
    }
    row
}

impl Facet {
    fn new(bvh: &Bvh, neighbours: &Neighbours, slot: Slot) -> Self {
        let corners = bvh.corners(slot).map(DVec3::from_array);
        let [a, b, c] = corners;
        let doubled = (b - a).cross(c - a);
        let normal = unit(doubled).unwrap_or(DVec3::ZERO);
        let edges = [0, 1, 2].map(|k| {
            let (p, q) = (corners[k], corners[(k + 1) % 3]);
            let opened = neighbours.across(slot, k).and_then(|across| {
                let [a, b, c] = bvh.corners(across.slot).map(DVec3::from_array);
                let other = unit((b - a).cross(c - a)).unwrap_or(DVec3::ZERO);
                let both = normal + if across.same_direction { -other } else { other };
                (both.length_squared() > LEAST_OPENING).then_some((across.slot, both))
            });
            let (across, both) = opened.map_or((None, normal), |(slot, both)| (Some(slot), both));
            Edge { outward: unit((q - p).cross(both)).unwrap_or(DVec3::ZERO), from: p, across }
        });
        let inward =
            [0, 1, 2].map(|k| unit(normal.cross(corners[(k + 1) % 3] - corners[k])).unwrap_or(DVec3::ZERO));
        Self { slot, corners, normal, area: 0.5 * doubled.length(), edges, inward }
    }

    /// Of some faces crosses off those farther than the reach beyond an edge of this one or above it.
    fn cross_off_what_is_out_of_reach(&self, normal: DVec3, reach: f64, group: &mut Group) {
        group.cross_off(-normal, -normal.dot(self.corners[0]) - reach);
        for (inward, p) in self.inward.iter().zip(&self.corners) {
            group.cross_off(*inward, inward.dot(*p) - reach);
        }
    }

    /// A plane behind which another face lies, and in front of which, as far as possible, what is over this face up to a height:
    /// the best of that of the other face, of one between the centres of both, and of those through an edge of this one.
    fn half_around(&self, normal: DVec3, corners: &[DVec3; 3], height: f64) -> Half {
        let mut best = (Half { normal, offset: greatest_along(normal, corners) }, f64::NEG_INFINITY);
        // Says whether a plane is good enough.
        let mut consider = |g: Option<DVec3>, enough: f64| {
            let Some(g) = g else { return false };
            let half = Half { normal: g, offset: greatest_along(g, corners) };
            // How far what is over the corners of this face lies behind the plane, compared with how far it is away.
            let wanted = half.offset + height * (1.0 - g.dot(normal));
            let mut score = 0.0;
            for p in &self.corners {
                let short = g.dot(*p) - wanted;
                score += if short < 0.0 { short } else { 0.0 };
            }
            best = if score > best.1 { (half, score) } else { best };
            best.1 >= -enough * height
        };
        let [a, b, c] = *corners;
        let third = 1.0 / 3.0;
        let centre = (self.corners[0] + self.corners[1] + self.corners[2]) * third;
        let own = unit((b - a).cross(c - a));
        let own = own.map(|n| if n.dot(centre - a) < 0.0 { -n } else { n });
        let shared = corners.iter().filter(|p| self.corners.contains(p)).count();
        if consider(own, SHORT) || shared == 2 && own.is_some() {
            return best.0;
        }
        let way = centre - (a + b + c) * third;
        let nearer = |p: DVec3, q: DVec3| if way.dot(q) < way.dot(p) { q } else { p };
        let hinge = nearer(nearer(self.corners[0], self.corners[1]), self.corners[2]);
        let mut is_good = consider(tilted(&[a - hinge, b - hinge, c - hinge], normal, way), FAR_SHORT);
        for k in 0..3 {
            // Of the edges that lie between both faces.
            let (p, inward) = (self.corners[k], self.inward[k]);
            if !is_good && inward.dot(way) > 0.0 {
                is_good = consider(tilted(&[a - p, b - p, c - p], normal, inward), FAR_SHORT);
            }
        }
        best.0
    }
}

/// The box around the triangles of a leaf.
fn box_of(block: &TriangleBlock) -> Aabb {
    let mut aabb = Aabb::EMPTY;
    for corner in block {
        for k in 0..3 {
            for x in corner[k] {
                aabb.lower[k] = if x < aabb.lower[k] { x } else { aabb.lower[k] };
                aabb.upper[k] = if x > aabb.upper[k] { x } else { aabb.upper[k] };
            }
        }
    }
    aabb
}

/// The least power of two that is no less; of a number that is positive and no infinity.
fn power_of_two(x: f64) -> f64 {
    const FRACTION: u64 = (1 << 52) - 1;
    f64::from_bits((x.to_bits() + FRACTION) & !FRACTION)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Target;
    use pompeiu_core::TriMesh;
    use pompeiu_testkit::plain::{point_triangle, point_triangles};
    use proptest::prelude::*;

    /// A sheet of triangles with rough heights.
    fn sheet() -> impl Strategy<Value = TriMesh> {
        let heights = prop::collection::vec(prop_oneof![-0.3..0.3_f64, Just(0.0)], 25);
        (heights, 0.0..0.4_f64).prop_map(|(heights, fold)| {
            let place = |i: usize| {
                let (x, y) = ((i % 5) as f64, (i / 5) as f64);
                [0.25 * (x - 2.0), 0.25 * (y - 2.0), heights[i] + fold * (x - 2.0).abs()]
            };
            let quad = |i: usize| [[i, i + 1, i + 6], [i, i + 6, i + 5]];
            let faces = (0..20).filter(|i| i % 5 < 4).flat_map(quad).map(|f| f.map(|v| v as u32)).collect();
            TriMesh::new((0..25).map(place).collect(), faces).expect("indices are in range")
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        /// No point is nearer to any triangle than the function says, on both sides and at any distance it was asked for.
        #[test]
        fn planes_lie_below_the_distance(
            mesh in sheet(),
            at in prop::collection::vec([-0.2..1.2_f64, -0.2..1.2, -0.5..0.5], 8),
            mean in 0.001..0.1_f64,
        ) {
            let target = Target::new(&mesh);
            let (bvh, neighbours) = (target.bvh(), target.neighbours().expect("a prepared target has them"));
            let rounding = Rounding::new(target.max_coordinate_with(&target.aabb()));
            let triangles: Vec<_> = bvh.slots().map(|slot| bvh.corners(slot)).collect();
            let mut facets = Facets::new(bvh, neighbours, rounding, mean);
            let mut bounded = 0;
            for slot in bvh.slots() {
                let Facet { corners: [a, b, c], normal, .. } = *facets.facet(slot);
                for below in [false, true] {
                    let side = if below { -1.0 } else { 1.0 };
                    let mut points = [[0.0; MOST_CORNERS]; 3];
                    let mut most = 0.0;
                    for (j, [v, w, h]) in at.iter().enumerate() {
                        let x = a + *v * (b - a) + *w * (c - a) + side * 0.3 * h * h.abs() * normal;
                        let d = point_triangle(x.to_array(), bvh.corners(slot));
                        most = if d > most { d } else { most };
                        for k in 0..3 {
                            points[k][j] = x[k];
                        }
                    }
                    let Some(row) = facets.below(slot, below, most, &points) else { continue };
                    bounded += 1;
                    for j in 0..MOST_CORNERS {
                        let exact = point_triangles([0, 1, 2].map(|k| points[k][j]), &triangles);
                        prop_assert!(row[j] <= exact + 2.0 * rounding.bound(0), "{} {exact}", row[j]);
                    }
                }
            }
            prop_assert!(bounded > 0);
        }
    }

    #[test]
    fn powers_of_two() {
        for (x, power) in [(1.0, 1.0), (1.1, 2.0), (2.0, 2.0), (0.3, 0.5), (1e-3, 1.0 / 512.0)] {
            assert_eq!(power_of_two(x), power);
        }
    }
}
