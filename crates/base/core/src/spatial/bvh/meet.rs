//! The leaves near a box, eight triangles at a time.

use super::{Bvh, LEAF, Slot};
use crate::geom::Aabb;
use crate::geom::point_triangle::{LANES, TriangleBlock};
use multiversion::multiversion;

/// A leaf of a [`Bvh`]: up to eight triangles that lie together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Leaf(pub(super) u32);

impl Leaf {
    /// Its place among the leaves.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl Bvh {
    /// Appends the leaves whose boxes meet the box from `lower` to `upper`, with their boxes. The order is deterministic but
    /// unspecified. Every point of a triangle lies in the box of a leaf that holds it.
    pub fn leaves_meeting(
        &self,
        lower: [f64; 3],
        upper: [f64; 3],
        stack: &mut Vec<u32>,
        leaves: &mut Vec<(Leaf, Aabb)>,
    ) {
        leaves_meeting(self, lower, upper, stack, leaves);
    }

    /// The triangles of a leaf, corner by corner, coordinate by coordinate, lane last. Lanes without a triangle repeat one.
    pub fn triangles(&self, leaf: Leaf) -> &TriangleBlock {
        &self.blocks[leaf.0 as usize]
    }

    /// The leaf that holds a slot; the first, of a long triangle that others hold as well.
    pub fn leaf_of(&self, slot: Slot) -> Leaf {
        Leaf((slot.index() / LANES) as u32)
    }

    /// The slot of the triangle in a lane of a leaf. Lanes without a triangle repeat the last one, and several leaves may hold the same long
    /// triangle: see [`Bvh::remove_repeats`].
    pub fn slot_in(&self, leaf: Leaf, lane: usize) -> Slot {
        let first = leaf.0 as usize * LANES;
        (0..=lane).rev().find_map(|lane| self.slot_at(first + lane)).unwrap_or_default()
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn leaves_meeting(
    bvh: &Bvh,
    lower: [f64; 3],
    upper: [f64; 3],
    stack: &mut Vec<u32>,
    leaves: &mut Vec<(Leaf, Aabb)>,
) {
    stack.clear();
    stack.push(0);
    while let Some(entry) = stack.pop() {
        let node = &bvh.nodes[entry as usize];
        let mut meets = [1_u64; LANES];
        for k in 0..3 {
            for l in 0..LANES {
                let apart = node.lower[k][l] > upper[k] || node.upper[k][l] < lower[k];
                meets[l] &= u64::from(!apart);
            }
        }
        for (lane, child) in node.child.iter().enumerate() {
            if meets[lane] == 0 {
                continue;
            }
            if child & LEAF == 0 {
                stack.push(*child);
            } else {
                // Without closures, which are not compiled for the instruction set of this function.
                let mut aabb = Aabb::EMPTY;
                for k in 0..3 {
                    (aabb.lower[k], aabb.upper[k]) = (node.lower[k][lane], node.upper[k][lane]);
                }
                leaves.push((Leaf(child & !LEAF), aabb));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TriMesh;
    use crate::geom::Frame;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn finds_every_triangle_that_meets_a_box(
            points in prop::collection::vec([-1.0..1.0, -1.0..1.0, -1.0..1.0], 3..200),
            centre in [-1.5..1.5_f64, -1.5..1.5, -1.5..1.5],
            half in 0.0..0.5_f64,
        ) {
            let faces = (0..points.len() as u32 - 2).map(|i| [i, i + 1, i + 2]).collect();
            let mesh = TriMesh::new(points, faces).unwrap();
            let bvh = Bvh::build(&mesh, &Frame::of(&Aabb::of_faces(&mesh)));
            let around = Aabb { lower: centre.map(|x| x - half), upper: centre.map(|x| x + half) };
            let mut leaves = Vec::new();
            bvh.leaves_meeting(around.lower, around.upper, &mut Vec::new(), &mut leaves);
            let mut found: Vec<Slot> =
                leaves.iter().flat_map(|(leaf, _)| (0..LANES).map(|lane| bvh.slot_in(*leaf, lane))).collect();
            found.sort_unstable();
            found.dedup();
            for (leaf, aabb) in &leaves {
                for lane in 0..LANES {
                    let corners = [0, 1, 2].map(|i| [0, 1, 2].map(|k| bvh.triangles(*leaf)[i][k][lane]));
                    prop_assert_eq!(corners, bvh.corners(bvh.slot_in(*leaf, lane)));
                    prop_assert_eq!(bvh.leaf_of(bvh.slot_in(*leaf, lane)), *leaf);
                    prop_assert_eq!(aabb.union(Aabb::of_points(&corners)), *aabb);
                }
            }
            for slot in bvh.slots() {
                let own = Aabb::of_points(&bvh.corners(slot));
                let meets = own.meets(&around);
                prop_assert!(!meets || found.binary_search(&slot).is_ok());
            }
        }
    }
}
