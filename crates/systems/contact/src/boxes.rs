//! A tree over boxes, for all boxes that meet a given one.

use glam::DVec3;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Box3 {
    pub(crate) low: DVec3,
    pub(crate) high: DVec3,
}

impl Box3 {
    pub(crate) fn of(points: impl IntoIterator<Item = DVec3>) -> Self {
        let empty = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };
        points.into_iter().fold(empty, |b, p| Self { low: b.low.min(p), high: b.high.max(p) })
    }

    pub(crate) fn grown(self, by: f64) -> Self {
        Self { low: self.low - DVec3::splat(by), high: self.high + DVec3::splat(by) }
    }

    fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    pub(crate) fn meets(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }
}

/// Boxes that a leaf holds at most.
const LEAF: usize = 4;

/// A tree over boxes, halved at the median of their centres.
#[derive(Debug)]
pub(crate) struct BoxTree {
    order: Vec<u32>,
    boxes: Vec<Box3>,
    /// Bounds of nodes in the order of a walk that goes to the low half first, with how many nodes there are below.
    nodes: Vec<(Box3, u32, u32, u32)>,
}

impl BoxTree {
    pub(crate) fn new(boxes: Vec<Box3>) -> Self {
        let order = (0..boxes.len() as u32).collect();
        let mut tree = Self { order, boxes, nodes: Vec::new() };
        if !tree.boxes.is_empty() {
            tree.build(0, tree.boxes.len());
        }
        tree
    }

    fn build(&mut self, start: usize, end: usize) {
        let bounds = self.order[start..end]
            .iter()
            .map(|&i| self.boxes[i as usize])
            .reduce(Box3::union)
            .expect("a node holds a box");
        let node = self.nodes.len();
        self.nodes.push((bounds, 1, start as u32, end as u32));
        if end - start > LEAF {
            let middle = usize::midpoint(start, end);
            let size = bounds.high - bounds.low;
            let axis = if size.x >= size.y && size.x >= size.z {
                0
            } else if size.y >= size.z {
                1
            } else {
                2
            };
            let boxes = &self.boxes;
            let key = |i: &u32| boxes[*i as usize].low[axis] + boxes[*i as usize].high[axis];
            self.order[start..end]
                .select_nth_unstable_by(middle - start, |a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
            self.build(start, middle);
            self.build(middle, end);
            self.nodes[node].1 = (self.nodes.len() - node) as u32;
        }
    }

    /// Calls with each box that meets a given one.
    pub(crate) fn query(&self, of: &Box3, mut found: impl FnMut(u32)) {
        let mut node = 0;
        while let Some((bounds, skip, start, end)) = self.nodes.get(node) {
            if !bounds.meets(of) {
                node += *skip as usize;
                continue;
            }
            if *skip == 1 {
                for &i in &self.order[*start as usize..*end as usize] {
                    if self.boxes[i as usize].meets(of) {
                        found(i);
                    }
                }
            }
            node += 1;
        }
    }
}
