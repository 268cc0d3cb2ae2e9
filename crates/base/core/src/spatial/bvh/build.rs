//! Top-down building.
//!
//! Every split leaves a multiple of eight triangles on its left, so that all leaves but the last are full and the place
//! of a leaf follows from the place of its triangles: subtrees can be built in parallel with nothing to agree on.
//!
//! How a range of faces is split is in `split`.

use super::split::{Bounds, Item, Split, split};
use super::{Bvh, LEAF, Node};
use crate::geom::point_triangle::{LANES, TriangleBlock, set_lane};
use crate::geom::{Aabb, Frame};
use crate::mesh::{FaceId, TriMesh};
use rayon::prelude::*;

/// Ranges longer than this are built in parallel.
const PARALLEL_ABOVE: usize = 1 << 11;

impl Bvh {
    /// Builds the tree over the faces of a mesh, seen in a frame.
    ///
    /// # Cost
    /// O(m log m) time on all threads of the current pool; the same tree for any number of threads.
    pub fn build(mesh: &TriMesh, frame: &Frame) -> Self {
        let corners = |face: u32| {
            let [a, b, c] = mesh.corners(FaceId(face));
            [frame.map(a), frame.map(b), frame.map(c)]
        };
        let count = mesh.faces().len();
        let mut items = vec![Item { bounds: Bounds::ZERO }; count];
        let bounds = items
            .par_chunks_mut(PARALLEL_ABOVE)
            .enumerate()
            .map(|(i, chunk)| {
                let mut bounds = Bounds::EMPTY;
                for (item, face) in chunk.iter_mut().zip((i * PARALLEL_ABOVE) as u32..) {
                    *item = Item::new(&Aabb::of_points(&corners(face)), face);
                    bounds.add(&item.bounds);
                }
                bounds
            })
            .reduce(|| Bounds::EMPTY, Bounds::union);
        let mut blocks = vec![[[[0.0; LANES]; 3]; 3]; count.div_ceil(LANES)];
        let mut faces = vec![0; count];
        let mut nodes = Vec::new();
        let part = Part { items: &mut items, blocks: &mut blocks, faces: &mut faces, bounds, first: 0 };
        Builder { corners: &corners }.subtree(part, 0, &mut nodes);
        nodes.shrink_to_fit();
        Self { nodes, blocks, faces }
    }
}

/// Items that will lie below one child.
struct Part<'i> {
    items: &'i mut [Item],
    /// Where their triangles will be.
    blocks: &'i mut [TriangleBlock],
    faces: &'i mut [u32],
    bounds: Bounds,
    /// Place of the first item among all; a multiple of eight.
    first: usize,
}

impl<'i> Part<'i> {
    fn is_leaf(&self) -> bool {
        self.items.len() <= LANES
    }

    fn split(self, depth: usize) -> [Self; 2] {
        let Split { left, bounds } = split(self.items, &self.bounds, depth);
        let items = self.items.split_at_mut(left);
        let blocks = self.blocks.split_at_mut(left / LANES);
        let faces = self.faces.split_at_mut(left);
        let first = [self.first, self.first + left];
        [
            Self { items: items.0, blocks: blocks.0, faces: faces.0, bounds: bounds[0], first: first[0] },
            Self { items: items.1, blocks: blocks.1, faces: faces.1, bounds: bounds[1], first: first[1] },
        ]
    }

    /// Splits the largest part until there are eight or all are leaves.
    fn split_into_eight(self, depth: usize) -> Vec<Self> {
        if self.items.len() > PARALLEL_ABOVE {
            let halves = self.split(depth);
            let quarters: Vec<_> =
                halves.into_par_iter().flat_map_iter(|p| p.split_if_possible(depth)).collect();
            return quarters.into_par_iter().flat_map_iter(|p| p.split_if_possible(depth)).collect();
        }
        let mut parts = Vec::with_capacity(LANES);
        parts.push(self);
        while parts.len() < LANES {
            let largest = (0..parts.len()).max_by_key(|&i| (parts[i].items.len(), LANES - i)).unwrap_or(0);
            if parts[largest].is_leaf() {
                break;
            }
            let part = parts.swap_remove(largest);
            parts.extend(part.split(depth));
        }
        parts
    }

    fn split_if_possible(self, depth: usize) -> impl Iterator<Item = Self> + use<'i> {
        let (one, two) = if self.is_leaf() { (Some(self), None) } else { (None, Some(self.split(depth))) };
        one.into_iter().chain(two.into_iter().flatten())
    }
}

struct Builder<'c, C> {
    corners: &'c C,
}

impl<C: Fn(u32) -> [[f64; 3]; 3] + Sync> Builder<'_, C> {
    /// Appends the node over a part and all below it; returns its box.
    fn subtree(&self, part: Part<'_>, depth: usize, nodes: &mut Vec<Node>) -> Aabb {
        let place = nodes.len();
        nodes.push(Node {
            lower: [[f64::INFINITY; LANES]; 3],
            upper: [[f64::NEG_INFINITY; LANES]; 3],
            child: [0; LANES],
        });
        let parallel = part.items.len() > PARALLEL_ABOVE;
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
            for k in 0..3 {
                node.lower[k][lane] = aabb.lower[k];
                node.upper[k][lane] = aabb.upper[k];
            }
            node.child[lane] = *child;
            whole = whole.union(*aabb);
        }
        whole
    }

    /// The box and the entry of a child, which is appended if it is a node.
    fn child(&self, part: Part<'_>, depth: usize, nodes: &mut Vec<Node>) -> (Aabb, u32) {
        if part.is_leaf() {
            return (
                self.leaf(part.items, &mut part.blocks[0], part.faces),
                LEAF | (part.first / LANES) as u32,
            );
        }
        let place = nodes.len() as u32;
        (self.subtree(part, depth + 1, nodes), place)
    }

    /// Writes the triangles of a leaf, and returns their box.
    fn leaf(&self, items: &[Item], block: &mut TriangleBlock, faces: &mut [u32]) -> Aabb {
        let mut aabb = Aabb::EMPTY;
        for (face, item) in faces.iter_mut().zip(items) {
            *face = item.face();
        }
        for lane in 0..LANES {
            let face = faces[if lane < faces.len() { lane } else { faces.len() - 1 }];
            let corners = (self.corners)(face);
            for p in corners {
                aabb.add(p);
            }
            set_lane(block, lane, corners);
        }
        aabb
    }
}

/// Appends nodes that were numbered by themselves.
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
    use crate::spatial::bvh::Slot;
    use crate::spatial::bvh::split::MEDIAN_BELOW_DEPTH;
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
                    assert_eq!(aabb.union(Aabb::of_points(&corners)), aabb);
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
