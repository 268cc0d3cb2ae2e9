//! A tree of boxes, for what is near a point.

use glam::DVec3;

/// Most items of a leaf.
const LEAF: usize = 4;

/// A node of the tree: a box, and two nodes or a range of items.
struct Node {
    low: DVec3,
    high: DVec3,
    first: u32,
    /// Number of items; 0 for an inner node, whose children are the next node and `first`.
    count: u32,
}

/// The squared distance of a point from a box.
#[inline]
fn distance_sq(p: DVec3, low: DVec3, high: DVec3) -> f64 {
    let mut sum = 0.0;
    for axis in 0..3 {
        let (below, above) = (low[axis] - p[axis], p[axis] - high[axis]);
        let off = if below > above { below } else { above };
        let off = if off > 0.0 { off } else { 0.0 };
        sum += off * off;
    }
    sum
}

/// A binary tree over the boxes of items.
pub(super) struct Boxes {
    nodes: Vec<Node>,
    items: Vec<u32>,
    /// The boxes of the items, in this order.
    bounds: Vec<[DVec3; 2]>,
}

impl Boxes {
    /// The tree over boxes, each given by its least and greatest corner.
    pub(super) fn new(boxes: &[[DVec3; 2]]) -> Self {
        let items = (0..boxes.len() as u32).collect();
        let mut tree = Self { nodes: Vec::new(), items, bounds: Vec::new() };
        let mut items = std::mem::take(&mut tree.items);
        if !items.is_empty() {
            tree.build(boxes, &mut items, 0);
        }
        tree.bounds = items.iter().map(|&item| boxes[item as usize]).collect();
        tree.items = items;
        tree
    }

    fn build(&mut self, boxes: &[[DVec3; 2]], items: &mut [u32], offset: usize) {
        let bounds = items.iter().map(|&i| boxes[i as usize]);
        let [low, high] = bounds.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or([DVec3::ZERO; 2]);
        let index = self.nodes.len();
        self.nodes.push(Node { low, high, first: offset as u32, count: items.len() as u32 });
        if items.len() <= LEAF {
            return;
        }
        let size = high - low;
        let axis = (0..3).fold(0, |best, k| if size[k] > size[best] { k } else { best });
        let middle = items.len() / 2;
        let centre = |i: u32| boxes[i as usize][0][axis] + boxes[i as usize][1][axis];
        items.select_nth_unstable_by(middle, |&a, &b| centre(a).total_cmp(&centre(b)).then(a.cmp(&b)));
        let (left, right) = items.split_at_mut(middle);
        self.build(boxes, left, offset);
        self.nodes[index].first = self.nodes.len() as u32;
        self.nodes[index].count = 0;
        self.build(boxes, right, offset + middle);
    }

    /// The squared distance of a point from a node, and the node.
    #[inline]
    fn child(&self, p: DVec3, index: u32) -> (f64, u32) {
        let node = &self.nodes[index as usize];
        (distance_sq(p, node.low, node.high), index)
    }

    /// Calls `visit` with the items whose boxes are at most the distance that the last call returned from a point, those of nearer nodes
    /// first; `most` is the distance in the beginning.
    pub(super) fn visit(&self, p: DVec3, most: f64, mut visit: impl FnMut(u32) -> f64) {
        let mut most_sq = most * most;
        let mut stack: Vec<(f64, u32)> = Vec::with_capacity(64);
        if let Some(root) = self.nodes.first() {
            stack.push((distance_sq(p, root.low, root.high), 0));
        }
        while let Some((square, index)) = stack.pop() {
            if square > most_sq {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                let range = node.first as usize..(node.first + node.count) as usize;
                for (&item, [low, high]) in self.items[range.clone()].iter().zip(&self.bounds[range]) {
                    if distance_sq(p, *low, *high) <= most_sq {
                        let most = visit(item);
                        most_sq = most * most;
                    }
                }
                continue;
            }
            let (left, right) = (self.child(p, index + 1), self.child(p, node.first));
            let (nearer, farther) = if right.0 < left.0 { (right, left) } else { (left, right) };
            if farther.0 <= most_sq {
                stack.push(farther);
            }
            stack.push(nearer);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_near_is_what_all_pairs_say() {
        let mut state = 5_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut point = || DVec3::new(random(), random(), random());
        for count in [0, 1, 4, 5, 300] {
            let boxes: Vec<[DVec3; 2]> = (0..count)
                .map(|_| {
                    let low = point();
                    [low, low + 0.1 * point()]
                })
                .collect();
            let tree = Boxes::new(&boxes);
            for _ in 0..50 {
                let p = point();
                let distance = |i: usize| p.distance(p.clamp(boxes[i][0], boxes[i][1]));
                let mut found = Vec::new();
                tree.visit(p, 0.2, |i| {
                    found.push(i as usize);
                    0.2
                });
                assert!((0..count).all(|i| distance(i) > 0.2 || found.contains(&i)));
                let mut best = f64::INFINITY;
                tree.visit(p, best, |i| {
                    best = best.min(distance(i as usize));
                    best
                });
                assert_eq!(best, (0..count).map(distance).fold(f64::INFINITY, f64::min));
            }
        }
    }
}
