//! Top-down building by the binned surface-area heuristic.
//!
//! Every split leaves a multiple of eight triangles on its left, so that all leaves but the last are full and the place
//! of a leaf follows from the place of its triangles: subtrees can be built in parallel with nothing to agree on.
//!
//! # Source
//! Binning centres along the widest axis: `wald_fast_2007`. Eight children to a node and full leaves are ours.

use super::{Bvh, LEAF, Node};
use crate::geom::point_triangle::{LANES, TriangleBlock};
use crate::geom::{Aabb, Frame};
use crate::memory;
use crate::mesh::{FaceId, TriMesh};
use rayon::prelude::*;

/// What the builder sorts: a face by the box around it, rounded to single precision. Only the quality of the tree
/// depends on it; the boxes that searches use are taken from the triangles themselves.
#[derive(Clone, Copy)]
struct Item {
    /// The unused fourth coordinates hold the low and the high half of the face's index.
    bounds: Bounds,
}

/// A box in single precision. The fourth coordinate means nothing: loops over four become one instruction.
#[derive(Clone, Copy)]
struct Bounds {
    lower: [f32; 4],
    upper: [f32; 4],
}

impl Bounds {
    const ZERO: Self = Self { lower: [0.0; 4], upper: [0.0; 4] };
    const EMPTY: Self = Self { lower: [f32::INFINITY; 4], upper: [f32::NEG_INFINITY; 4] };

    fn of(items: &[Item]) -> Self {
        items.iter().fold(Self::EMPTY, |bounds, item| bounds.union(item.bounds))
    }

    #[inline]
    fn union(mut self, other: Self) -> Self {
        self.add(&other);
        self
    }

    #[inline]
    fn add(&mut self, other: &Self) {
        for k in 0..4 {
            self.lower[k] = if other.lower[k] < self.lower[k] { other.lower[k] } else { self.lower[k] };
            self.upper[k] = if other.upper[k] > self.upper[k] { other.upper[k] } else { self.upper[k] };
        }
    }

    fn half_area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|k| self.upper[k] - self.lower[k]);
        x * y + y * z + z * x
    }
}

impl Item {
    fn new(aabb: &Aabb, face: u32) -> Self {
        let [x, y, z] = aabb.lower.map(|x| x as f32);
        let [u, v, w] = aabb.upper.map(|x| x as f32);
        let (low, high) = ((face & 0xffff) as f32, (face >> 16) as f32);
        Self { bounds: Bounds { lower: [x, y, z, low], upper: [u, v, w, high] } }
    }

    #[inline]
    fn face(&self) -> u32 {
        self.bounds.lower[3] as u32 | (self.bounds.upper[3] as u32) << 16
    }

    #[inline]
    fn centre(&self, axis: usize) -> f32 {
        self.bounds.lower[axis] + self.bounds.upper[axis]
    }
}

const BINS: usize = 16;
/// Ranges longer than this are built in parallel.
const PARALLEL_ABOVE: usize = 1 << 13;
/// Longer ranges are binned over their box instead of their centres: a little coarser, and one pass less.
const EXACT_CENTRES_UP_TO: usize = 512;
/// Below this depth (in nodes) splits go through the middle, which bounds the depth of the tree for every input.
const MEDIAN_BELOW_DEPTH: usize = 24;

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
        let mut items = memory::filled(Item { bounds: Bounds::ZERO }, count);
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
        let mut blocks = memory::filled([[[0.0; LANES]; 3]; 3], count.div_ceil(LANES));
        let mut faces = memory::filled(0, count);
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
            for (into, from) in block.iter_mut().zip((self.corners)(face)) {
                aabb.add(from);
                for k in 0..3 {
                    into[k][lane] = from[k];
                }
            }
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

/// How a range was split.
struct Split {
    /// Items on the left: a multiple of eight.
    left: usize,
    /// About where the items of each side lie.
    bounds: [Bounds; 2],
}

/// Reorders items into two sides.
fn split(items: &mut [Item], bounds: &Bounds, depth: usize) -> Split {
    let (low, high) = if items.len() > EXACT_CENTRES_UP_TO {
        ([0, 1, 2].map(|k| 2.0 * bounds.lower[k]), [0, 1, 2].map(|k| 2.0 * bounds.upper[k]))
    } else {
        range_of_centres(items)
    };
    let axis = (0..3).fold(0, |w, k| if high[k] - low[k] > high[w] - low[w] { k } else { w });
    let spread = high[axis] - low[axis];
    if depth < MEDIAN_BELOW_DEPTH && items.len() > 2 * LANES && spread.is_normal() {
        let scale = BINS as f32 * (1.0 - f32::EPSILON) / spread;
        if let Some((boundary, bounds)) = best_boundary(items, axis, low[axis], scale) {
            let left = partition(items, |item| bin_of(item, axis, low[axis], scale) < boundary);
            return Split { left: align(items, left, axis), bounds };
        }
    }
    let left = (items.len() / 2).next_multiple_of(LANES).min((items.len() - 1) / LANES * LANES);
    items.select_nth_unstable_by(left, |a, b| {
        a.centre(axis).total_cmp(&b.centre(axis)).then(a.face().cmp(&b.face()))
    });
    Split { left, bounds: [Bounds::of(&items[..left]), Bounds::of(&items[left..])] }
}

/// Range of the sums of opposite ends of the boxes.
fn range_of_centres(items: &[Item]) -> ([f32; 3], [f32; 3]) {
    let mut low = [f32::INFINITY; 4];
    let mut high = [f32::NEG_INFINITY; 4];
    for Item { bounds, .. } in items {
        for k in 0..4 {
            let c = bounds.lower[k] + bounds.upper[k];
            low[k] = if c < low[k] { c } else { low[k] };
            high[k] = if c > high[k] { c } else { high[k] };
        }
    }
    ([low[0], low[1], low[2]], [high[0], high[1], high[2]])
}

#[inline]
fn bin_of(item: &Item, axis: usize, low: f32, scale: f32) -> usize {
    let bin = ((item.centre(axis) - low) * scale) as usize;
    if bin < BINS { bin } else { BINS - 1 }
}

/// Moves the items that satisfy a predicate to the front; returns how many.
fn partition(items: &mut [Item], on_the_left: impl Fn(&Item) -> bool) -> usize {
    let mut left = 0;
    for i in 0..items.len() {
        // Without a branch: the outcome is as good as random.
        let goes_left = on_the_left(&items[i]);
        items.swap(left, i);
        left += usize::from(goes_left);
    }
    left
}

/// Moves the few items next to a split that keep its left from being a multiple of eight; returns the new length.
fn align(items: &mut [Item], left: usize, axis: usize) -> usize {
    let most = (items.len() - 1) / LANES * LANES;
    let aligned = ((left + LANES / 2) / LANES * LANES).clamp(LANES, most);
    for end in (aligned..left).rev() {
        let last =
            (0..=end).fold(0, |m, i| if items[i].centre(axis) > items[m].centre(axis) { i } else { m });
        items.swap(last, end);
    }
    for start in left..aligned {
        let first = (start..items.len())
            .fold(start, |m, i| if items[i].centre(axis) < items[m].centre(axis) { i } else { m });
        items.swap(first, start);
    }
    aligned
}

/// The bin with which the right side of the cheapest split begins, by area times count, and the boxes of both sides; none
/// if all are in one bin.
fn best_boundary(items: &[Item], axis: usize, low: f32, scale: f32) -> Option<(usize, [Bounds; 2])> {
    let mut bins = [(Bounds::EMPTY, 0); BINS];
    for item in items {
        let (bounds, count) = &mut bins[bin_of(item, axis, low, scale)];
        bounds.add(&item.bounds);
        *count += 1;
    }
    let mut rights = [(Bounds::EMPTY, 0.0); BINS];
    let (mut right, mut count) = (Bounds::EMPTY, 0);
    for i in (1..BINS).rev() {
        right.add(&bins[i].0);
        count += bins[i].1;
        rights[i] = (right, if count > 0 { right.half_area() * count as f32 } else { 0.0 });
    }
    let mut best = None;
    let mut least = f32::INFINITY;
    let (mut left, mut count) = (Bounds::EMPTY, 0);
    for i in 1..BINS {
        left.add(&bins[i - 1].0);
        count += bins[i - 1].1;
        if count == 0 || count == items.len() {
            continue;
        }
        let cost = left.half_area() * count as f32 + rights[i].1;
        if best.is_none() || cost < least {
            least = cost;
            best = Some((i, [left, rights[i].0]));
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spatial::bvh::Slot;
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
