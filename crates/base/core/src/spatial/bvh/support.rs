//! Planes behind which all triangles lie: a bound from below on distances of a triangle T, from boxes where these suffice.
//!
//! # Definition
//! The distance from a box Q is convex. With y the point of Q nearest to a point c of T, `r = c - y` and `g = r / |r|`, all of Q lies behind
//! the plane through y with normal g, so the linear function `|r| + g . (x - c)` is nowhere above the distance of x from Q. Behind the
//! plane with a given normal g0 that touches Q, too, all of Q lies. The least of linear functions is concave: on T it lies above the linear
//! interpolation of its values at the corners.
//!
//! # Accuracy
//! Components of r are differences of two coordinates, and zero where c lies between the sides of Q: so g has the signs of r whatever
//! rounding does, and the plane through y with this normal touches Q exactly. Only values are rounded.

use super::{Bvh, LEAF, Leaf, Node};
use crate::geom::point_triangle::LANES;
use multiversion::multiversion;

/// Squared lengths below this are too small for a direction: their digits are lost.
pub const LEAST_SQUARE: f64 = 1e-280;

/// What is asked: where triangles come nearer to a triangle T than a linear function on it.
#[derive(Clone, Copy, Debug)]
pub struct Support {
    /// A point of T.
    pub centre: [f64; 3],
    /// From there to the corners.
    pub ways: [[f64; 3]; 3],
    /// The linear function, at the corners.
    pub wanted: [f64; 3],
    /// A direction of length one: where all triangles lie behind a plane with this normal, one plane bounds them.
    pub common: [f64; 3],
}

impl Bvh {
    /// Lists the leaves that may hold triangles nearer to T than wanted. Returns, at the corners of T, the least of linear functions below the
    /// distances from all others: infinite if there are none.
    ///
    /// # Cost
    /// As many nodes as there are within about twice the wanted distance, where the triangles do not lie behind a plane.
    pub fn leaves_in_front(
        &self,
        support: &Support,
        stack: &mut Vec<u32>,
        leaves: &mut Vec<Leaf>,
    ) -> [f64; 3] {
        leaves_in_front(self, support, stack, leaves)
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn leaves_in_front(bvh: &Bvh, support: &Support, stack: &mut Vec<u32>, leaves: &mut Vec<Leaf>) -> [f64; 3] {
    // Without closures, which are not compiled for the instruction set of this function.
    let [u, v, w] = support.ways;
    let along = [dot(support.common, u), dot(support.common, v), dot(support.common, w)];
    let [p, q, r] = support.wanted;
    // What reaches no farther along the common direction lies behind a plane that is wanted.
    let room = least([along[0] - p, along[1] - q, along[2] - r]);
    let mut behind = f64::NEG_INFINITY;
    let mut below = [f64::INFINITY; 3];
    stack.clear();
    stack.push(0);
    leaves.clear();
    while let Some(entry) = stack.pop() {
        let node = &bvh.nodes[entry as usize];
        let planes = planes_of_boxes(node, support);
        for (lane, child) in node.child.iter().enumerate() {
            if node.lower[0][lane] == f64::INFINITY {
                continue;
            }
            if planes.reach[lane] <= room {
                behind = if planes.reach[lane] > behind { planes.reach[lane] } else { behind };
            } else if planes.short[lane] <= 0.0 {
                for i in 0..3 {
                    let value = planes.rows[i][lane];
                    below[i] = if value < below[i] { value } else { below[i] };
                }
            } else if child & LEAF == 0 {
                stack.push(*child);
            } else {
                leaves.push(Leaf(child & !LEAF));
            }
        }
    }
    if behind > f64::NEG_INFINITY {
        for i in 0..3 {
            below[i] = if along[i] - behind < below[i] { along[i] - behind } else { below[i] };
        }
    }
    below
}

/// The planes of eight boxes.
struct Planes {
    /// How far each box reaches along the common direction, from the centre.
    reach: [f64; LANES],
    /// Values at the corners of the function that touches the distance at the centre.
    rows: [[f64; LANES]; 3],
    /// How far they lie below the wanted ones at most; infinite where there is none.
    short: [f64; LANES],
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn planes_of_boxes(node: &Node, support: &Support) -> Planes {
    let Support { centre, ways, wanted, common } = support;
    let mut planes = Planes { reach: [0.0; LANES], rows: [[0.0; LANES]; 3], short: [f64::INFINITY; LANES] };
    let mut square = [0.0; LANES];
    let mut dots = [[0.0; LANES]; 3];
    for k in 0..3 {
        let far = if common[k] > 0.0 { &node.upper[k] } else { &node.lower[k] };
        for l in 0..LANES {
            planes.reach[l] += common[k] * (far[l] - centre[k]);
            let (below, above) = (centre[k] - node.lower[k][l], centre[k] - node.upper[k][l]);
            let r = if above > 0.0 { above } else { 0.0 };
            let r = if below < 0.0 { below } else { r };
            square[l] += r * r;
            for i in 0..3 {
                dots[i][l] += r * ways[i][k];
            }
        }
    }
    for l in 0..LANES {
        let length = square[l].sqrt();
        let inverse = 1.0 / length;
        let mut short = f64::NEG_INFINITY;
        for i in 0..3 {
            let value = length + dots[i][l] * inverse;
            planes.rows[i][l] = value;
            short = if wanted[i] - value > short { wanted[i] - value } else { short };
        }
        planes.short[l] = if square[l] > LEAST_SQUARE { short } else { f64::INFINITY };
    }
    planes
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the lane loops")]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn least([a, b, c]: [f64; 3]) -> f64 {
    let m = if a < b { a } else { b };
    if m < c { m } else { c }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TriMesh;
    use crate::geom::{Aabb, Frame};
    use glam::DVec3;
    use proptest::prelude::*;

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![-1.0..1.0, (-4..5_i32).prop_map(|k| f64::from(k) * 0.25)]
    }

    proptest! {
        /// Triangles that are in no listed leaf are no nearer to T than the returned function, nor than the wanted one.
        #[test]
        fn what_is_not_listed_lies_beyond(
            points in prop::collection::vec([coordinate(), coordinate(), coordinate()], 3..200),
            t in prop::array::uniform3([coordinate(), coordinate(), coordinate()]),
            wanted in prop::array::uniform3(-0.5..1.5_f64),
            common in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0],
        ) {
            let faces = (0..points.len() as u32 - 2).map(|i| [i, i + 1, i + 2]).collect();
            let mesh = TriMesh::new(points, faces).unwrap();
            let bvh = Bvh::build(&mesh, &Frame::of(&Aabb::of_faces(&mesh)));
            let centre: [f64; 3] = std::array::from_fn(|k| (t[0][k] + t[1][k] + t[2][k]) / 3.0);
            let ways = t.map(|p| [0, 1, 2].map(|k| p[k] - centre[k]));
            let common = DVec3::from_array(common).normalize_or(DVec3::X).to_array();
            let support = Support { centre, ways, wanted, common };
            let mut leaves = Vec::new();
            let below = bvh.leaves_in_front(&support, &mut Vec::new(), &mut leaves);
            let listed: Vec<_> = leaves.iter().flat_map(|leaf| (0..LANES).map(|l| bvh.slot_in(*leaf, l))).collect();
            for slot in bvh.slots().filter(|slot| !listed.contains(slot)) {
                for (v, w) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.5), (0.3, 0.3), (0.1, 0.7)] {
                    let at = |f: [f64; 3]| f[0] + v * (f[1] - f[0]) + w * (f[2] - f[0]);
                    let x = [0, 1, 2].map(|k| at(t.map(|p| p[k])));
                    let distance = bvh.distance_sq(x, slot).sqrt();
                    prop_assert!(at(below) <= distance + 1e-13, "{} {distance}", at(below));
                    prop_assert!((0..3).all(|i| wanted[i] <= below[i] + 1e-13));
                }
            }
        }
    }
}
