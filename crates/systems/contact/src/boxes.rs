//! A tree over boxes, for all boxes that meet a given one, or one another.

use glam::{DVec3, Vec3A};

/// The place and scale in which boxes are kept in single precision: the scene is about as large as 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoxFrame {
    centre: DVec3,
    scale: f64,
}

/// The error of coordinates in the frame before they are rounded to single precision.
const SLOP: f64 = 1e-15;

impl BoxFrame {
    /// The frame of points.
    pub(crate) fn of(points: &[DVec3]) -> Self {
        let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let (centre, size) = (0.5 * low + 0.5 * high, (high - low).max_element());
        let usable = centre.is_finite() && size.is_finite() && size > f64::MIN_POSITIVE;
        if usable { Self { centre, scale: 1.0 / size } } else { Self { centre: DVec3::ZERO, scale: 1.0 } }
    }

    /// A box that surely holds points and what is nearer to them than a distance.
    pub(crate) fn around(&self, points: impl IntoIterator<Item = DVec3>, distance: f64) -> Box3 {
        let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = points.into_iter().fold(empty, |(low, high), p| (low.min(p), high.max(p)));
        let grown = DVec3::splat(distance * self.scale + SLOP);
        let low = ((low - self.centre) * self.scale - grown).as_vec3a();
        let high = ((high - self.centre) * self.scale + grown).as_vec3a();
        // Rounding to single precision was by less than a unit in the last place.
        Box3 {
            low: Vec3A::from_array(low.to_array().map(f32::next_down)),
            high: Vec3A::from_array(high.to_array().map(f32::next_up)),
        }
    }
}

/// An axis-aligned box in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Box3 {
    low: Vec3A,
    high: Vec3A,
}

impl Box3 {
    fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    fn meets(&self, other: &Self) -> bool {
        (self.low.cmple(other.high) & other.low.cmple(self.high)).all()
    }
}

/// Boxes that a leaf holds at most.
const LEAF: usize = 4;

/// Bounds of a node.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Box3,
    /// Nodes from this one to the next that is not below it.
    skip: u32,
    /// Where its boxes begin and end.
    start: u32,
    end: u32,
}

/// A tree over boxes, halved at the median of their centres.
#[derive(Debug)]
pub(crate) struct BoxTree {
    /// The number of each box.
    order: Vec<u32>,
    /// The boxes in that order.
    boxes: Vec<Box3>,
    /// In the order of a walk that goes to the low half first.
    nodes: Vec<Node>,
}

impl BoxTree {
    pub(crate) fn new(boxes: &[Box3]) -> Self {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = Vec::with_capacity(boxes.len());
        if !boxes.is_empty() {
            build(&mut nodes, boxes, &mut order, 0);
        }
        let boxes = order.iter().map(|&i| boxes[i as usize]).collect();
        Self { order, boxes, nodes }
    }

    /// Calls with the number of each box that meets a given one.
    pub(crate) fn query(&self, of: &Box3, found: impl FnMut(u32)) {
        self.walk(of, 0, found);
    }

    /// How many boxes there are.
    pub(crate) fn len(&self) -> usize {
        self.order.len()
    }

    /// Calls with the numbers of a box, which has a place in the order of the tree, and of each one after it that it meets.
    pub(crate) fn pairs_of(&self, place: usize, mut found: impl FnMut(u32, u32)) {
        let own = self.order[place];
        self.walk(&self.boxes[place], place + 1, |other| found(own, other));
    }

    /// Boxes from a place on that meet a given one.
    fn walk(&self, of: &Box3, from: usize, mut found: impl FnMut(u32)) {
        let mut node = 0;
        while let Some(Node { bounds, skip, start, end }) = self.nodes.get(node) {
            if *end as usize <= from || !bounds.meets(of) {
                node += *skip as usize;
                continue;
            }
            if *skip == 1 {
                for place in (*start as usize).max(from)..*end as usize {
                    if self.boxes[place].meets(of) {
                        found(self.order[place]);
                    }
                }
            }
            node += 1;
        }
    }
}

/// Adds the node of a part of the order that begins at `start`, and those below it.
fn build(nodes: &mut Vec<Node>, boxes: &[Box3], order: &mut [u32], start: u32) {
    let bounds = order.iter().map(|&i| boxes[i as usize]).reduce(Box3::union).expect("a node holds a box");
    let node = nodes.len();
    let end = start + order.len() as u32;
    nodes.push(Node { bounds, skip: 1, start, end });
    if order.len() > LEAF {
        let middle = order.len() / 2;
        let size = (bounds.high - bounds.low).to_array();
        let wider = usize::from(size[1] > size[0]);
        let axis = if size[2] > size[wider] { 2 } else { wider };
        let key = |i: &u32| boxes[*i as usize].low[axis] + boxes[*i as usize].high[axis];
        order.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
        let (low, high) = order.split_at_mut(middle);
        build(nodes, boxes, low, start);
        build(nodes, boxes, high, start + middle as u32);
        nodes[node].skip = (nodes.len() - node) as u32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(count: usize) -> Vec<DVec3> {
        let mut state = 5_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / (1_u64 << 31) as f64
        };
        (0..count).map(|_| DVec3::new(next(), next(), next())).collect()
    }

    #[test]
    fn every_pair_that_is_near_is_found_once_wherever_the_scene_is() {
        for (shift, scale) in [(0.0, 1.0), (1e6, 1.0), (-3.0, 1e-150), (1e10, 1e190), (0.0, 0.0)] {
            let ends = numbers(600);
            let ends: Vec<DVec3> = ends.iter().map(|p| (*p + DVec3::splat(shift)) * scale).collect();
            let distance = 0.01 * scale;
            let frame = BoxFrame::of(&ends);
            let part = |i: usize| [ends[2 * i], ends[2 * i] + (ends[2 * i + 1] - ends[2 * i]) * 0.1];
            let boxes: Vec<Box3> = (0..300).map(|i| frame.around(part(i), 0.5 * distance)).collect();
            let tree = BoxTree::new(&boxes);
            let mut found = Vec::new();
            for place in 0..tree.len() {
                tree.pairs_of(place, |a, b| found.push([a.min(b), a.max(b)]));
            }
            found.sort_unstable();
            let distinct = found.len();
            found.dedup();
            assert_eq!(distinct, found.len());
            for i in 0..300 {
                let mut of_one = Vec::new();
                tree.query(&boxes[i], |other| of_one.push(other as usize));
                for j in i + 1..300 {
                    let ([a, b], [c, d]) = (part(i), part(j));
                    let apart = (a.min(b) - c.max(d)).max(c.min(d) - a.max(b)).max_element();
                    if apart <= distance {
                        assert!(found.contains(&[i as u32, j as u32]), "{i} {j} {apart:e}");
                        assert!(of_one.contains(&j));
                    }
                }
            }
            assert!(scale == 0.0 || distinct < 20_000, "{distinct}");
        }
    }
}
