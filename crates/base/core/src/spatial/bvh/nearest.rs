//! The triangle nearest to a point.

use super::{Bvh, LEAF, Leaf, Node, Slot};
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

/// Scratch memory that queries reuse, and a count of their work.
#[derive(Clone, Debug, Default)]
pub struct Workspace {
    pub(super) stack: Stack,
    /// Point–triangle distances evaluated so far.
    pub distances: u64,
}

/// Boxes still to visit, with their squared distances: entries up to `len`, and room for eight above.
#[derive(Clone, Debug, Default)]
pub(super) struct Stack {
    entries: Vec<(f64, u32)>,
    len: usize,
}

impl Stack {
    /// Leaves only the root on the stack.
    #[inline]
    pub(super) fn restart(&mut self) {
        self.len = 0;
        self.room()[0] = (0.0, 0);
        self.len = 1;
    }

    #[inline]
    pub(super) fn pop(&mut self) -> Option<(f64, u32)> {
        self.len = self.len.checked_sub(1)?;
        Some(self.entries[self.len])
    }

    /// The eight places above the top.
    #[inline]
    fn room(&mut self) -> &mut [(f64, u32); LANES] {
        if self.entries.len() < self.len + LANES {
            self.grow();
        }
        self.entries[self.len..].first_chunk_mut().expect("room was made")
    }

    #[cold]
    fn grow(&mut self) {
        self.entries.resize(2 * self.len + 8 * LANES, (0.0, 0));
    }
}

impl Bvh {
    /// A triangle with the least distance from `p`, starting from a triangle believed to be near.
    ///
    /// Boxes are skipped when their rounded distance is not below that of the best triangle so far. Both distances have relative
    /// rounding errors, so the result is nearest up to a few units in the last place of its distance.
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

    /// A triangle near `p`, not necessarily the nearest: the nearest in the first leaf on the way down.
    ///
    /// # Cost
    /// A small part of [`Bvh::nearest`].
    pub fn some_near(&self, p: [f64; 3], workspace: &mut Workspace) -> Slot {
        descend(self, p, workspace)
    }

    /// Lists all triangles that are no farther from `p` than the nearest one and a length `slack` together, with their squared distances, starting
    /// from a triangle believed to be near. The order is deterministic but unspecified.
    pub fn all_nearest(
        &self,
        p: [f64; 3],
        start: Slot,
        slack: f64,
        workspace: &mut Workspace,
        found: &mut Vec<Nearest>,
    ) {
        found.clear();
        workspace.distances += 1;
        let most = collect(self, p, reach(self.distance_sq(p, start), slack), slack, workspace, found);
        found.retain(|one| one.distance_sq <= most);
        if !self.originals.is_empty() {
            found.sort_unstable_by_key(|one| one.slot);
            found.dedup_by_key(|one| one.slot);
        }
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
    workspace.stack.restart();
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

/// The square of a distance and a length together, and what rounding takes.
fn reach(distance_sq: f64, slack: f64) -> f64 {
    let distance = distance_sq.sqrt() + slack;
    distance * distance * (1.0 + 8.0 * f64::EPSILON)
}

/// Collects triangles up to a squared distance that falls as nearer ones are met, and returns it.
#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn collect(
    bvh: &Bvh,
    p: [f64; 3],
    mut most: f64,
    slack: f64,
    workspace: &mut Workspace,
    found: &mut Vec<Nearest>,
) -> f64 {
    workspace.stack.restart();
    while let Some((d, entry)) = workspace.stack.pop() {
        if d > most {
            continue;
        }
        if entry & LEAF == 0 {
            push_children(bvh, p, entry, most.next_up(), &mut workspace.stack);
            continue;
        }
        workspace.distances += LANES as u64;
        let block = entry & !LEAF;
        let distances = block_distances_sq(p, &bvh.blocks[block as usize]);
        let mut hits = lanes_below(&distances, most.next_up());
        while hits != 0 {
            let lane = hits.trailing_zeros() as usize;
            hits &= hits - 1;
            // Lanes without a triangle repeat one.
            if let Some(slot) = bvh.slot_at(block as usize * LANES + lane)
                && distances[lane] <= most
            {
                found.push(Nearest { slot, distance_sq: distances[lane] });
                let reached = reach(distances[lane], slack);
                most = if reached < most { reached } else { most };
            }
        }
    }
    most
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn descend(bvh: &Bvh, p: [f64; 3], workspace: &mut Workspace) -> Slot {
    let mut entry = 0;
    while entry & LEAF == 0 {
        workspace.stack.restart();
        push_children(bvh, p, entry, f64::INFINITY, &mut workspace.stack);
        // The nearest child is on top. The root always has a child.
        entry = workspace.stack.pop().map_or(LEAF, |(_, child)| child);
    }
    workspace.distances += LANES as u64;
    let block = entry & !LEAF;
    let mut best = Nearest { slot: bvh.slot_in(Leaf(block), 0), distance_sq: f64::INFINITY };
    improve(bvh, p, block, &mut best);
    best.slot
}

/// Replaces the best triangle by the nearest of a block if that is nearer. Returns whether it was.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn improve(bvh: &Bvh, p: [f64; 3], block: u32, best: &mut Nearest) -> bool {
    let distances = block_distances_sq(p, &bvh.blocks[block as usize]);
    // First the minimum alone: most blocks hold nothing nearer, and need no search for the lane.
    let mut half = [0.0; LANES / 2];
    for l in 0..LANES / 2 {
        half[l] = lesser(distances[l], distances[l + LANES / 2]);
    }
    let least = lesser(lesser(half[0], half[2]), lesser(half[1], half[3]));
    let improves = least < best.distance_sq;
    if !improves {
        return false;
    }
    let mut lane = 0;
    while lane < LANES - 1 && distances[lane] != least {
        lane += 1;
    }
    *best = Nearest { slot: bvh.slot_in(Leaf(block), lane), distance_sq: least };
    true
}

/// Pushes the children that are nearer than `limit`, the nearest last and the others unsorted.
///
/// Sorting them all costs more in mispredicted branches than it saves in visits: once the nearest child has been searched, most of
/// the others are farther than the best triangle in it.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn push_children(bvh: &Bvh, p: [f64; 3], node: u32, limit: f64, stack: &mut Stack) {
    let node = &bvh.nodes[node as usize];
    let distances = box_distances_sq(p, node);
    // So that the loop below runs once per hit instead of branching at each child.
    let mut hits = lanes_below(&distances, limit);
    let room = stack.room();
    let mut count = 0;
    let mut nearest = (f64::INFINITY, 0);
    while hits != 0 {
        let lane = hits.trailing_zeros() as usize;
        hits &= hits - 1;
        let child = (distances[lane], node.child[lane]);
        let closer = child.0 < nearest.0;
        if count > 0 {
            room[(count - 1) % LANES] = if closer { nearest } else { child };
        }
        nearest = if closer { child } else { nearest };
        count += 1;
    }
    if count > 0 {
        room[(count - 1) % LANES] = nearest;
    }
    stack.len += count;
}

// Here and below without closures, which are not compiled for the instruction set of the caller.

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn lesser(x: f64, y: f64) -> f64 {
    if x < y { x } else { y }
}

/// A bit for each lane with less than a limit.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn lanes_below(distances: &[f64; LANES], limit: f64) -> u32 {
    let mut bits = 0;
    for l in 0..LANES {
        bits |= u32::from(distances[l] < limit) << l;
    }
    bits
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

    #[test]
    fn the_stack_keeps_what_it_holds_while_it_grows() {
        let mut stack = Stack::default();
        stack.restart();
        for round in 0..60 {
            for (l, place) in stack.room().iter_mut().enumerate() {
                *place = (f64::from(round), round * 7 + l as u32 + 1);
            }
            stack.len += 7;
        }
        for expected in (0..=60 * 7).rev() {
            assert_eq!(stack.pop().map(|(_, entry)| entry), Some(expected));
        }
        assert_eq!(stack.pop(), None);
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
                let near = bvh.some_near(p, &mut workspace);
                prop_assert!(bvh.distance_sq(p, near) >= least && bvh.face(near).index() < mesh.faces().len());
                start = found.slot;
            }
        }
    }
}
