//! A bounding-volume hierarchy over triangles, eight children to a node and eight triangles to a leaf.
//!
//! The tree owns a copy of its triangles, laid out for SIMD, and is independent of the queries: `build` and `split` build it;
//! `nearest`, `cover` and `meet` hold the queries, each with its own traversal.

mod build;
mod cover;
mod meet;
mod nearest;
mod oriented;
mod slabs;
mod split;
mod support;

use crate::FaceId;
use crate::geom::Aabb;
use crate::geom::point_triangle::{LANES, TriangleBlock, lane_of};

use std::ops::ControlFlow;

pub use build::Leaves;
pub use cover::Cover;
pub use meet::Leaf;
pub use nearest::{Nearest, Workspace};
pub use support::{LEAST_SQUARE, Support};

/// Place of a triangle in the leaves of a [`Bvh`]; by default the first, which every tree has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Slot(u32);

impl Slot {
    /// The slot at a place in the order of the leaves.
    pub(super) fn new(index: u32) -> Self {
        Self(index)
    }

    /// Its place in the order of the leaves.
    #[inline]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// An inner node with up to eight children: their boxes, and what each child is.
#[derive(Clone, Debug)]
struct Node {
    /// Least coordinates, axis by axis, child last; infinite where there is no child.
    lower: [[f64; LANES]; 3],
    upper: [[f64; LANES]; 3],
    /// Index of a node, or with [`LEAF`] set, of a block of triangles.
    child: [u32; LANES],
}

impl Node {
    const EMPTY: Self = Self {
        lower: [[f64::INFINITY; LANES]; 3],
        upper: [[f64::NEG_INFINITY; LANES]; 3],
        child: [0; LANES],
    };

    fn set(&mut self, lane: usize, aabb: &Aabb, child: u32) {
        for k in 0..3 {
            self.lower[k][lane] = aabb.lower[k];
            self.upper[k][lane] = aabb.upper[k];
        }
        self.child[lane] = child;
    }

    fn aabb(&self, lane: usize) -> Aabb {
        Aabb { lower: [0, 1, 2].map(|k| self.lower[k][lane]), upper: [0, 1, 2].map(|k| self.upper[k][lane]) }
    }

    /// The box of all children.
    fn whole(&self) -> Aabb {
        (0..LANES).fold(Aabb::EMPTY, |whole, lane| whole.union(self.aabb(lane)))
    }
}

/// Marks a child that is a block.
const LEAF: u32 = 1 << 31;

/// A bounding-volume hierarchy over the faces of a mesh, for closest-point queries.
///
/// # Cost
/// About 85 bytes per face: corner positions by value, the face's index, and its share of the nodes above. As much again for each of the
/// boxes of a long face that does not lie along an axis, four for each face of a mesh at most.
#[derive(Clone, Debug)]
pub struct Bvh {
    /// The root is the first.
    nodes: Vec<Node>,
    /// Triangles in groups of eight; the last group is filled up with copies of its last triangle.
    blocks: Vec<TriangleBlock>,
    /// Face of each slot.
    faces: Vec<u32>,
    /// Slots of the triangles in the blocks after those of all faces, which hold long faces once more (see `slabs`).
    originals: Vec<u32>,
}

impl Bvh {
    /// Number of faces.
    pub fn len(&self) -> usize {
        self.faces.len()
    }

    /// Never true: a mesh has a face.
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    /// The face of the mesh that a slot holds.
    pub fn face(&self, slot: Slot) -> FaceId {
        FaceId(self.faces[slot.0 as usize])
    }

    /// The corners of the triangle in a slot, as given to the builder.
    #[inline]
    pub fn corners(&self, slot: Slot) -> [[f64; 3]; 3] {
        let (block, lane) = (slot.0 as usize / LANES, slot.0 as usize % LANES);
        lane_of(&self.blocks[block], lane)
    }

    /// One corner of the triangle in a slot.
    #[inline]
    pub fn corner(&self, slot: Slot, corner: usize) -> [f64; 3] {
        let (block, lane) = (slot.0 as usize / LANES, slot.0 as usize % LANES);
        let from = &self.blocks[block][corner];
        [from[0][lane], from[1][lane], from[2][lane]]
    }

    /// Some triangle: the start of a search without a better guess.
    pub fn any_slot(&self) -> Slot {
        Slot(0)
    }

    /// All slots, in the order of the leaves.
    pub fn slots(&self) -> impl Iterator<Item = Slot> + use<> {
        (0..self.faces.len() as u32).map(Slot)
    }

    /// The slot of the triangle at a place in the blocks; none where the last block of a tree repeats its last triangle.
    #[inline]
    fn slot_at(&self, place: usize) -> Option<Slot> {
        if place < self.faces.len() {
            return Some(Slot(place as u32));
        }
        self.originals
            .get(place.checked_sub(self.faces.len().next_multiple_of(LANES))?)
            .map(|slot| Slot(*slot))
    }

    /// Removes the repeats from a list of the slots in some leaves: lanes without a triangle repeat one, and several leaves may hold the same
    /// long triangle. The order stays, but for trees with long triangles.
    pub fn remove_repeats(&self, slots: &mut Vec<Slot>) {
        if !self.originals.is_empty() {
            slots.sort_unstable();
        }
        slots.dedup();
    }

    /// Bytes of memory held.
    pub fn bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>()
            + self.blocks.capacity() * size_of::<TriangleBlock>()
            + (self.faces.capacity() + self.originals.capacity()) * size_of::<u32>()
    }

    /// Bytes that building over `faces` faces takes at its peak, within a tenth, where none is long.
    pub fn bytes_to_build(faces: usize) -> usize {
        faces * 128 + (1 << 12)
    }

    /// The same tree over transformed triangles.
    ///
    /// `map` must transform each axis by itself, and must be nondecreasing along it. Scaling and shifting are, even after rounding.
    /// Boxes then stay bounding boxes; those of parts of faces are made wider by what rounding may have moved.
    #[must_use]
    pub fn mapped(&self, map: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let each = |axes: &mut [[f64; LANES]; 3]| {
            for lane in 0..LANES {
                let p = [0, 1, 2].map(|k| axes[k][lane]);
                if p[0].is_finite() {
                    let q = map(p);
                    for k in 0..3 {
                        axes[k][lane] = q[k];
                    }
                }
            }
        };
        let mut tree = self.clone();
        for node in &mut tree.nodes {
            each(&mut node.lower);
            each(&mut node.upper);
        }
        if !tree.originals.is_empty() {
            let Aabb { lower, upper } = tree.nodes[0].whole();
            let far = lower.iter().chain(&upper).fold(0.0, |far: f64, x| far.max(x.abs()));
            for node in &mut tree.nodes {
                node.lower.as_flattened_mut().iter_mut().for_each(|x| *x -= slabs::WIDER * far);
                node.upper.as_flattened_mut().iter_mut().for_each(|x| *x += slabs::WIDER * far);
            }
        }
        tree.blocks.iter_mut().flatten().for_each(each);
        tree
    }

    /// Traverses the tree: `enter` decides for each box whether to descend, and `visit` receives the slots of the leaves that are
    /// reached. The order is deterministic but unspecified. The traversal ends when `visit` breaks.
    ///
    /// Every point of a triangle lies in the box of a leaf that holds it; a long triangle may be in several leaves, and its slot comes
    /// once from each.
    pub fn walk(
        &self,
        stack: &mut Vec<u32>,
        mut enter: impl FnMut(&Aabb) -> bool,
        mut visit: impl FnMut(Slot) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        stack.clear();
        stack.push(0);
        while let Some(entry) = stack.pop() {
            if entry & LEAF != 0 {
                let first = (entry & !LEAF) as usize * LANES;
                for slot in (first..first + LANES).map_while(|place| self.slot_at(place)) {
                    visit(slot)?;
                }
                continue;
            }
            let node = &self.nodes[entry as usize];
            for (lane, child) in node.child.iter().enumerate() {
                let aabb = node.aabb(lane);
                if aabb.lower[0] < f64::INFINITY && enter(&aabb) {
                    stack.push(*child);
                }
            }
        }
        ControlFlow::Continue(())
    }
}
