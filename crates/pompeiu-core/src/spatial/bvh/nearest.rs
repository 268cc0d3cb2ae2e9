//! The triangle nearest to a point.

use super::{Bvh, LEAF, Node, Slot};
use crate::geom::point_triangle::{LANES, block_distances_sq, distance_sq};
use multiversion::multiversion;

/// A triangle and its squared distance from the point of a query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// The triangle.
    pub slot: Slot,
    /// Its squared distance, by [`distance_sq`].
    pub distance_sq: f64,
}

/// Memory that queries reuse, and a count of what they did.
#[derive(Clone, Debug, Default)]
pub struct Workspace {
    pub(super) stack: Vec<(f64, u32)>,
    /// Point–triangle distances evaluated so far.
    pub distances: u64,
}

impl Bvh {
    /// A triangle with the least distance from `p`, starting from a triangle believed to be near.
    ///
    /// Boxes are left out when their rounded distance is not below that of the best triangle so far; both roundings are
    /// relative, so what is returned is nearest up to a few units in the last place of its distance.
    ///
    /// # Cost
    /// O(log m) for a point near the surface; no allocation once the workspace has grown.
    pub fn nearest(&self, p: [f64; 3], start: Slot, workspace: &mut Workspace) -> Nearest {
        let [a, b, c] = self.corners(start);
        let start = Nearest { slot: start, distance_sq: distance_sq(p, a, b, c) };
        workspace.distances += 1;
        self.nearest_below(p, start, workspace)
    }

    /// [`Bvh::nearest`] where the distance of the start is known.
    pub fn nearest_below(&self, p: [f64; 3], start: Nearest, workspace: &mut Workspace) -> Nearest {
        traverse(self, p, start, workspace)
    }

    /// The squared distance from `p` to the triangle in a slot.
    #[inline]
    pub fn distance_sq(&self, p: [f64; 3], slot: Slot) -> f64 {
        let [a, b, c] = self.corners(slot);
        distance_sq(p, a, b, c)
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn traverse(bvh: &Bvh, p: [f64; 3], start: Nearest, workspace: &mut Workspace) -> Nearest {
    let mut best = start;
    workspace.stack.clear();
    workspace.stack.push((0.0, 0));
    while let Some((d, entry)) = workspace.stack.pop() {
        if d >= best.distance_sq {
            continue;
        }
        if entry & LEAF == 0 {
            push_children(bvh, p, entry, best.distance_sq, &mut workspace.stack);
        } else {
            workspace.distances += LANES as u64;
            improve(bvh, p, entry & !LEAF, &mut best);
        }
    }
    best
}

/// Takes the nearest triangle of a block if it beats the best so far. Says whether it did.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn improve(bvh: &Bvh, p: [f64; 3], block: u32, best: &mut Nearest) -> bool {
    let distances = block_distances_sq(p, &bvh.blocks[block as usize]);
    let mut least = best.distance_sq;
    let mut lane = LANES;
    for l in 0..LANES {
        if distances[l] < least {
            (least, lane) = (distances[l], l);
        }
    }
    if lane == LANES {
        return false;
    }
    *best = Nearest { slot: Slot(block * LANES as u32 + lane as u32), distance_sq: least };
    true
}

/// Pushes the children that are nearer than `limit`, nearest last.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn push_children(bvh: &Bvh, p: [f64; 3], node: u32, limit: f64, stack: &mut Vec<(f64, u32)>) {
    let node = &bvh.nodes[node as usize];
    let distances = box_distances_sq(p, node);
    let bottom = stack.len();
    for (&d, &child) in distances.iter().zip(&node.child) {
        if d < limit {
            let mut i = stack.len();
            stack.push((d, child));
            while i > bottom && stack[i - 1].0 < d {
                stack.swap(i - 1, i);
                i -= 1;
            }
        }
    }
}

/// Squared distances to the boxes of the children; infinite where there is no child.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn box_distances_sq(p: [f64; 3], node: &Node) -> [f64; LANES] {
    let mut out = [0.0; LANES];
    for k in 0..3 {
        for l in 0..LANES {
            let (below, above) = (node.lower[k][l] - p[k], p[k] - node.upper[k][l]);
            let outside = if below > above { below } else { above };
            let outside = if outside > 0.0 { outside } else { 0.0 };
            out[l] += outside * outside;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TriMesh;
    use crate::geom::Aabb;
    use crate::geom::Frame;
    use proptest::prelude::*;

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![-1.0..1.0, (-4..5_i32).prop_map(|k| f64::from(k) * 0.25)]
    }

    proptest! {
        #[test]
        fn agrees_with_asking_every_triangle(
            points in prop::collection::vec([coordinate(), coordinate(), coordinate()], 3..200),
            queries in prop::collection::vec([-2.0..2.0, -2.0..2.0, -2.0..2.0], 1..20),
        ) {
            let faces = (0..points.len() as u32 - 2).map(|i| [i, i + 1, i + 2]).collect();
            let mesh = TriMesh::new(points, faces).unwrap();
            let bvh = Bvh::build(&mesh, &Frame::of(&Aabb::of_faces(&mesh)));
            let mut workspace = Workspace::default();
            let mut start = bvh.any_slot();
            for p in queries {
                let least = bvh.slots().map(|s| bvh.distance_sq(p, s)).fold(f64::INFINITY, f64::min);
                let found = bvh.nearest(p, start, &mut workspace);
                prop_assert!(found.distance_sq <= least * (1.0 + 1e-14));
                prop_assert_eq!(bvh.distance_sq(p, found.slot), found.distance_sq);
                let mut within = Vec::new();
                bvh.slots_within(p, least.sqrt() * (1.0 + 1e-15), |slot| within.push(slot));
                prop_assert!(within.contains(&found.slot));
                start = found.slot;
            }
        }
    }
}
