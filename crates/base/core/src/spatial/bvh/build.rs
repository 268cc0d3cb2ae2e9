//! Building a tree along a space-filling curve.
//!
//! Faces are sorted by their Morton codes, and ranges of them are split where the highest bit of the code changes, so the
//! order of faces is that of the codes down to the lowest nodes. There, [`FEW`] faces at a time are put into leaves as they follow each
//! other, or sorted into leaves by their boxes. Where more faces have equal codes, as when nearly all of the mesh is in one corner
//! of its bounding box, ranges are split by boxes from there on.
//!
//! The left side of a split holds a multiple of [`FEW`] faces, or of eight where boxes decide. So all lowest nodes but the last are
//! full, and the place of a leaf follows from the place of its triangles: subtrees are built in parallel without coordination.
//!
//! How a range of faces is split by boxes is in `split`; long faces, whose boxes are nearly empty, in `slabs`.
//!
//! # Source
//! Splitting sorted codes at their highest bit: `lauterbach_fast_2009`.

use super::slabs::Long;
use super::split::{Bounds, FEW, Item, Split, split};
use super::{Bvh, LEAF, Node};
use crate::geom::point_triangle::{LANES, TriangleBlock, set_lane};
use crate::geom::{Aabb, Frame};
use crate::mesh::{FaceId, TriMesh};
use crate::run::Control;
use crate::spatial::morton::sorted_keys;
use rayon::prelude::*;

/// Which faces of a lowest node are put into one leaf.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Leaves {
    /// Those whose boxes are small together: queries look at fewer faces.
    #[default]
    Compact,
    /// Those that follow each other along the curve: building takes a third of the time, and a query some five per cent more.
    Consecutive,
}

/// Ranges longer than this are built in parallel.
const PARALLEL_ABOVE: usize = 1 << 11;

impl Bvh {
    /// Builds the tree over the faces of a mesh, seen in a frame.
    ///
    /// # Cost
    /// O(m) time on all threads of the current pool for meshes whose faces are about evenly large, O(m log m) for any; the same tree for
    /// any number of threads.
    pub fn build(mesh: &TriMesh, frame: &Frame) -> Self {
        Self::build_while(mesh, &Aabb::of_faces(mesh), frame, Leaves::default(), &Control::default())
    }

    /// [`Bvh::build`] of a mesh with a known bounding box and these leaves that gives up soon after it is told to stop, and then returns `None`.
    pub fn build_unless_stopped(
        mesh: &TriMesh,
        aabb: &Aabb,
        frame: &Frame,
        leaves: Leaves,
        control: &Control,
    ) -> Option<Self> {
        let bvh = Self::build_while(mesh, aabb, frame, leaves, control);
        (!control.is_stopped()).then_some(bvh)
    }

    /// The tree is complete only if the control did not stop it.
    fn build_while(mesh: &TriMesh, aabb: &Aabb, frame: &Frame, leaves: Leaves, control: &Control) -> Self {
        let corners = |face: u32| {
            let [a, b, c] = mesh.corners(FaceId(face));
            [frame.map(a), frame.map(b), frame.map(c)]
        };
        let keys = sorted_keys(mesh, aabb);
        let long = Long::find(mesh.faces().len(), &corners);
        let boxes = |face: u32, corners: &[[f64; 3]; 3]| match &long {
            Some(long) if long.contains(face) => Aabb::EMPTY,
            _ => Aabb::of_points(corners),
        };
        let count = keys.len();
        let mut blocks = vec![[[[0.0; LANES]; 3]; 3]; count.div_ceil(LANES)];
        let mut faces = vec![0; count];
        let mut nodes = Vec::new();
        let part =
            Part { range: Range::Sorted(&keys, leaves), blocks: &mut blocks, faces: &mut faces, first: 0 };
        Builder { corners: &corners, boxes: &boxes, control }.subtree(part, 0, &mut nodes);
        nodes.shrink_to_fit();
        let mut bvh = Self { nodes, blocks, faces, originals: Vec::new() };
        if let Some(long) = &long
            && !control.is_stopped()
        {
            bvh.add_slabs(long, &corners, control);
        }
        bvh
    }

    /// Hangs a tree over slabs beside this one, whose boxes do not hold the long faces.
    fn add_slabs(
        &mut self,
        long: &Long,
        corners: &(impl Fn(u32) -> [[f64; 3]; 3] + Sync),
        control: &Control,
    ) {
        let count = long.slabs.len();
        let first = self.blocks.len();
        let mut items: Vec<Item> =
            long.slabs.iter().zip(0..).map(|((_, aabb), slab)| Item::new(aabb, slab)).collect();
        let bounds = Bounds::of(&items);
        self.blocks.resize(first + count.div_ceil(LANES), [[[0.0; LANES]; 3]; 3]);
        let mut order = vec![0; count];
        let part = Part {
            range: Range::Boxes(&mut items, bounds),
            blocks: &mut self.blocks[first..],
            faces: &mut order,
            first: first * LANES,
        };
        let of_slab = |slab: u32| corners(long.slabs[slab as usize].0);
        let aabb = |slab: u32, _: &[[f64; 3]; 3]| long.slabs[slab as usize].1;
        let mut slabs = Vec::new();
        Builder { corners: &of_slab, boxes: &aabb, control }.subtree(part, 0, &mut slabs);
        let mut slot_of = vec![0; self.faces.len()];
        for (face, slot) in self.faces.iter().zip(0..) {
            slot_of[*face as usize] = slot;
        }
        self.originals = order.iter().map(|slab| slot_of[long.slabs[*slab as usize].0 as usize]).collect();
        let faces = std::mem::take(&mut self.nodes);
        self.nodes.reserve_exact(1 + faces.len() + slabs.len());
        self.nodes.push(Node::EMPTY);
        for (lane, below) in [faces, slabs].into_iter().enumerate() {
            let whole = below[0].whole();
            let child = self.nodes.len() as u32;
            append(&mut self.nodes, below);
            self.nodes[0].set(lane, &whole, child);
        }
    }
}

/// The faces of a range of the tree.
enum Range<'i> {
    /// Codes and faces, by ascending code.
    Sorted(&'i [u64], Leaves),
    /// Boxes and faces in any order, and a box about all of them.
    Boxes(&'i mut [Item], Bounds),
}

/// Faces that will lie below one child.
struct Part<'i> {
    range: Range<'i>,
    /// Where their triangles will be.
    blocks: &'i mut [TriangleBlock],
    faces: &'i mut [u32],
    /// Place of the first face in the order of the whole tree; a multiple of eight.
    first: usize,
}

impl Part<'_> {
    fn len(&self) -> usize {
        self.faces.len()
    }

    fn is_leaf(&self) -> bool {
        self.len() <= LANES
    }

    /// Whether the part can be split directly. Sorted ranges that are split by boxes are so in a node of their own.
    fn can_be_split(&self) -> bool {
        match &self.range {
            Range::Sorted(keys, Leaves::Consecutive) if keys.len() <= FEW => !self.is_leaf(),
            Range::Sorted(keys, _) => Change::of(keys).is_some(),
            Range::Boxes(..) => !self.is_leaf(),
        }
    }

    fn split(self, depth: usize) -> [Self; 2] {
        let (left, ranges) = match self.range {
            Range::Sorted(keys, leaves) => {
                let left = if keys.len() <= FEW {
                    (keys.len() / 2).next_multiple_of(LANES)
                } else {
                    Change::of(keys).map_or(FEW, |change| change.place(keys))
                };
                let (one, other) = keys.split_at(left);
                (left, [Range::Sorted(one, leaves), Range::Sorted(other, leaves)])
            }
            Range::Boxes(items, bounds) => {
                let Split { left, bounds: [one, other] } = split(items, &bounds, depth);
                let (these, those) = items.split_at_mut(left);
                (left, [Range::Boxes(these, one), Range::Boxes(those, other)])
            }
        };
        let blocks = self.blocks.split_at_mut(left / LANES);
        let faces = self.faces.split_at_mut(left);
        let [one, other] = ranges;
        [
            Self { range: one, blocks: blocks.0, faces: faces.0, first: self.first },
            Self { range: other, blocks: blocks.1, faces: faces.1, first: self.first + left },
        ]
    }

    /// Splits the largest part that can be split, until there are eight parts or none can be.
    fn split_into_eight(self, depth: usize) -> Vec<Self> {
        let mut parts = Vec::with_capacity(LANES);
        parts.push(self);
        while parts.len() < LANES {
            let largest = (0..parts.len())
                .filter(|&i| parts[i].can_be_split())
                .max_by_key(|&i| (parts[i].len(), LANES - i));
            let Some(largest) = largest else { break };
            let part = parts.swap_remove(largest);
            parts.extend(part.split(depth));
        }
        parts
    }
}

/// Where a sorted range is split: at the change of the highest bit in which its codes differ.
struct Change {
    /// The bit of a key.
    bit: u32,
    /// The bits of the keys from that bit upwards, after the change.
    upper: u64,
}

impl Change {
    /// Ignores the few codes at both ends that got there when splits were aligned. `None` for a short range, and for one whose
    /// codes are equal.
    fn of(keys: &[u64]) -> Option<Self> {
        let count = keys.len();
        if count <= FEW {
            return None;
        }
        let few = if count < 2 * FEW { count / 4 } else { FEW / 2 };
        let (least, greatest) = (keys[few], keys[count - 1 - few]);
        let differ = (least ^ greatest) >> 32;
        (differ != 0).then(|| {
            let bit = 32 + differ.ilog2();
            Self { bit, upper: greatest >> bit }
        })
    }

    /// The multiple of [`FEW`] nearest to the change, with keys on both sides.
    fn place(&self, keys: &[u64]) -> usize {
        let place = keys.partition_point(|&key| key >> self.bit < self.upper);
        let most = (keys.len() - 1) / FEW * FEW;
        ((place + FEW / 2) / FEW * FEW).clamp(FEW, most)
    }
}

struct Builder<'c, C, B> {
    corners: &'c C,
    /// The box of a face in its leaf, of a face and its corners.
    boxes: &'c B,
    control: &'c Control,
}

impl<C: Fn(u32) -> [[f64; 3]; 3] + Sync, B: Fn(u32, &[[f64; 3]; 3]) -> Aabb + Sync> Builder<'_, C, B> {
    /// Appends the node over a part and all below it; returns its box. The box is meaningless if the control has stopped the build.
    fn subtree(&self, part: Part<'_>, depth: usize, nodes: &mut Vec<Node>) -> Aabb {
        match part.range {
            Range::Sorted(keys, _) if !part.is_leaf() && !part.can_be_split() => {
                let (mut few, mut many) = ([Item::NONE; FEW], Vec::new());
                let items = if keys.len() <= FEW {
                    &mut few[..keys.len()]
                } else {
                    many.resize(keys.len(), Item::NONE);
                    &mut many[..]
                };
                for (item, &key) in items.iter_mut().zip(keys) {
                    *item = Item::new(&Aabb::of_points(&(self.corners)(key as u32)), key as u32);
                }
                let bounds = Bounds::of(items);
                self.node(Part { range: Range::Boxes(items, bounds), ..part }, depth, nodes)
            }
            _ => self.node(part, depth, nodes),
        }
    }

    /// [`Builder::subtree`] of a part that can be split, or is a leaf.
    fn node(&self, part: Part<'_>, depth: usize, nodes: &mut Vec<Node>) -> Aabb {
        let parallel = part.len() > PARALLEL_ABOVE;
        if parallel && self.control.is_stopped() {
            return Aabb::EMPTY;
        }
        let place = nodes.len();
        nodes.push(Node::EMPTY);
        let parts = part.split_into_eight(depth);
        let mut children = [(Aabb::EMPTY, 0); LANES];
        let count = parts.len();
        if parallel {
            let built: Vec<_> = parts
                .into_par_iter()
                .map(|part| {
                    let mut below = Vec::new();
                    (self.child(part, depth, &mut below), below)
                })
                .collect();
            for (child, ((aabb, index), below)) in children.iter_mut().zip(built) {
                let offset = nodes.len() as u32;
                *child = (aabb, if index & LEAF == 0 { index + offset } else { index });
                append(nodes, below);
            }
        } else {
            for (child, part) in children.iter_mut().zip(parts) {
                *child = self.child(part, depth, nodes);
            }
        }
        let mut whole = Aabb::EMPTY;
        let node = &mut nodes[place];
        for (lane, (aabb, child)) in children.iter().enumerate().take(count) {
            node.set(lane, aabb, *child);
            whole = whole.union(*aabb);
        }
        whole
    }

    /// The box and the entry of a child, which is appended if it is a node.
    fn child(&self, part: Part<'_>, depth: usize, nodes: &mut Vec<Node>) -> (Aabb, u32) {
        if part.is_leaf() {
            for (face, place) in part.faces.iter_mut().zip(0..) {
                *face = match &part.range {
                    Range::Sorted(keys, _) => keys[place] as u32,
                    Range::Boxes(items, _) => items[place].face(),
                };
            }
            return (self.leaf(part.faces, &mut part.blocks[0]), LEAF | (part.first / LANES) as u32);
        }
        let place = nodes.len() as u32;
        (self.subtree(part, depth + 1, nodes), place)
    }

    /// Writes the triangles of a leaf, and returns their box.
    fn leaf(&self, faces: &[u32], block: &mut TriangleBlock) -> Aabb {
        let mut aabb = Aabb::EMPTY;
        for lane in 0..LANES {
            let face = faces[if lane < faces.len() { lane } else { faces.len() - 1 }];
            let corners = (self.corners)(face);
            aabb = aabb.union((self.boxes)(face, &corners));
            set_lane(block, lane, corners);
        }
        aabb
    }
}

/// Appends nodes whose child indices were counted from zero.
fn append(nodes: &mut Vec<Node>, mut below: Vec<Node>) {
    let offset = nodes.len() as u32;
    for node in &mut below {
        for (lane, child) in node.child.iter_mut().enumerate() {
            if *child & LEAF == 0 && node.lower[0][lane] < f64::INFINITY {
                *child += offset;
            }
        }
    }
    nodes.append(&mut below);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::StopReason;
    use crate::spatial::bvh::split::MEDIAN_BELOW_DEPTH;
    use crate::spatial::bvh::{Slot, Workspace};
    use proptest::prelude::*;

    fn tree_over(points: Vec<[f64; 3]>) -> (TriMesh, Bvh) {
        let faces = (0..points.len() as u32 - 2).map(|i| [i, i + 1, i + 2]).collect();
        let mesh = TriMesh::new(points, faces).unwrap();
        let bvh = Bvh::build(&mesh, &Frame::of(&Aabb::of_faces(&mesh)));
        (mesh, bvh)
    }

    /// Every slot is in exactly one leaf, and inside all boxes above it. Returns the depth.
    fn check(bvh: &Bvh) -> usize {
        fn visit(bvh: &Bvh, node: usize, inside: Aabb, seen: &mut [bool]) -> usize {
            let node = &bvh.nodes[node];
            let mut depth = 0;
            for lane in 0..LANES {
                if node.lower[0][lane] == f64::INFINITY {
                    continue;
                }
                let aabb = Aabb {
                    lower: [0, 1, 2].map(|k| node.lower[k][lane]),
                    upper: [0, 1, 2].map(|k| node.upper[k][lane]),
                };
                assert_eq!(aabb.union(inside), inside);
                if node.child[lane] & LEAF == 0 {
                    depth = depth.max(visit(bvh, node.child[lane] as usize, aabb, seen));
                    continue;
                }
                let first = (node.child[lane] & !LEAF) as usize * LANES;
                for slot in first..bvh.len().min(first + LANES) {
                    assert!(!std::mem::replace(&mut seen[slot], true));
                    let corners = bvh.corners(Slot(slot as u32));
                    if !bvh.originals.contains(&(slot as u32)) {
                        assert_eq!(aabb.union(Aabb::of_points(&corners)), aabb);
                    }
                }
            }
            depth + 1
        }
        let mut seen = vec![false; bvh.len()];
        let everything = Aabb { lower: [f64::NEG_INFINITY; 3], upper: [f64::INFINITY; 3] };
        let depth = visit(bvh, 0, everything, &mut seen);
        assert!(seen.into_iter().all(|s| s));
        depth
    }

    #[test]
    fn holds_every_face_once_and_stays_shallow_on_hostile_input() {
        let same = vec![[1.0; 3]; 5000];
        let exponential = (0..6000).map(|i| [2.0_f64.powi(-(i % 1000)), 0.0, f64::from(i)]).collect();
        let line: Vec<_> = (0..30_000).map(|i| [f64::from(i), 0.0, 0.0]).collect();
        for points in [same, exponential, line] {
            let (mesh, bvh) = tree_over(points);
            let mut faces = bvh.faces.clone();
            faces.sort_unstable();
            assert!(faces.iter().copied().eq(0..mesh.faces().len() as u32));
            assert!(check(&bvh) <= MEDIAN_BELOW_DEPTH + 12);
        }
    }

    #[test]
    fn building_ends_when_it_is_told_to() {
        let (mesh, bvh) =
            tree_over((0..9000).map(|i| [f64::from(i).sin(), f64::from(i % 97), 0.0]).collect());
        let frame = Frame::of(&Aabb::of_faces(&mesh));
        let control = Control::default();
        let unless_stopped =
            || Bvh::build_unless_stopped(&mesh, &Aabb::of_faces(&mesh), &frame, Leaves::Compact, &control);
        let again = unless_stopped().unwrap();
        assert_eq!(format!("{again:?}"), format!("{bvh:?}"));
        control.stop(StopReason::Cancelled);
        assert!(unless_stopped().is_none());
    }

    /// All faces but one in one cell of the curve, as when one vertex is far from all others.
    #[test]
    fn faces_in_one_cell_are_told_apart_by_their_boxes() {
        let grid = (0..4000).map(|i| [f64::from(i % 60), f64::from(i / 60), 0.0]);
        let (mesh, bvh) = tree_over(grid.chain([[1e9; 3]]).collect());
        check(&bvh);
        let mut workspace = Workspace::default();
        let p = Frame::of(&Aabb::of_faces(&mesh)).map([30.2, 30.3, 1.0]);
        bvh.nearest(p, bvh.any_slot(), &mut workspace);
        assert!(workspace.distances < 400, "{}", workspace.distances);
    }

    #[test]
    fn the_tree_does_not_depend_on_the_number_of_threads() {
        let points: Vec<_> =
            (0..20_000).map(|i| [f64::from(i).sin(), f64::from(i * 7).cos(), f64::from(i % 97)]).collect();
        let trees: Vec<_> = [1, 2, 8]
            .map(|threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                pool.install(|| format!("{:?}", tree_over(points.clone()).1))
            })
            .into();
        assert!(trees[0] == trees[1] && trees[0] == trees[2]);
    }

    proptest! {
        #[test]
        fn is_a_valid_tree(points in prop::collection::vec([-1.0..1.0, -1.0..1.0, -1.0..1.0], 3..400)) {
            check(&tree_over(points).1);
        }
    }
}
