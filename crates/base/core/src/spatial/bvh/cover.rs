//! Finding one triangle that is near all corners of a piece of surface.

use super::nearest::{improve, push_children};
use super::{Bvh, LEAF, Nearest, Slot, Workspace};
use crate::geom::point_triangle::{LANES, four_points_distances_sq};
use multiversion::multiversion;

/// What [`Bvh::cover`] found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cover {
    /// All corners are within the limit of this triangle, the farthest at this squared distance.
    By {
        /// The triangle.
        slot: Slot,
        /// The largest squared distance of a corner from it.
        distance_sq: f64,
    },
    /// No triangle that was visited covers the corners; this is the one nearest to the centre.
    Nearest(Nearest),
    /// Only from [`Bvh::cover_or_neighbour`]: this one is within the limit of the centre, but another may be nearer.
    Neighbour(Nearest),
}

impl Bvh {
    /// Squared distances from four points, coordinate by coordinate, to the triangle in a slot.
    pub fn four_distances_sq(
        &self,
        points: &[[f64; 4]; 3],
        slot: Slot,
        workspace: &mut Workspace,
    ) -> [f64; 4] {
        workspace.distances += 4;
        four(points, self.corners(slot))
    }

    /// Looks for a triangle near three corners on the way to the triangle nearest to a centre point.
    ///
    /// `points` are the three corners and the centre, coordinate by coordinate. The search goes nearest first and stops at
    /// the first triangle within `limit_sq` of all three corners; if none that it meets is, it ends with the triangle
    /// nearest to the centre. `start` must be a triangle with its distance from the centre; it is not tried as a cover.
    pub fn cover(
        &self,
        points: &[[f64; 4]; 3],
        limit_sq: f64,
        start: Nearest,
        workspace: &mut Workspace,
    ) -> Cover {
        traverse(self, points, limit_sq, start, false, workspace)
    }

    /// [`Bvh::cover`] for callers to whom any close triangle will do: the search also ends if the best triangle in the leaf of the
    /// start is within `limit_sq` of the centre.
    pub fn cover_or_neighbour(
        &self,
        points: &[[f64; 4]; 3],
        limit_sq: f64,
        start: Nearest,
        workspace: &mut Workspace,
    ) -> Cover {
        traverse(self, points, limit_sq, start, true, workspace)
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn four(points: &[[f64; 4]; 3], triangle: [[f64; 3]; 3]) -> [f64; 4] {
    four_points_distances_sq(points, triangle)
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn traverse(
    bvh: &Bvh,
    points: &[[f64; 4]; 3],
    limit_sq: f64,
    start: Nearest,
    neighbours_suffice: bool,
    workspace: &mut Workspace,
) -> Cover {
    let centre = [points[0][3], points[1][3], points[2][3]];
    let mut best = start;
    // Triangles in the leaf of the start are likely covers, and cheaper to test than descending from the root.
    let start_block = start.slot.0 / LANES as u32;
    if let Some(cover) = visit_leaf(bvh, points, centre, limit_sq, start_block, &mut best, workspace) {
        return cover;
    }
    if neighbours_suffice && best.distance_sq <= limit_sq {
        return Cover::Neighbour(best);
    }
    workspace.stack.restart();
    while let Some((d, entry)) = workspace.stack.pop() {
        if d >= best.distance_sq || entry == LEAF | start_block {
            continue;
        }
        if entry & LEAF == 0 {
            push_children(bvh, centre, entry, best.distance_sq, &mut workspace.stack);
        } else if let Some(cover) =
            visit_leaf(bvh, points, centre, limit_sq, entry & !LEAF, &mut best, workspace)
        {
            return cover;
        }
    }
    Cover::Nearest(best)
}

/// Tests the triangles of a leaf; the best of them is tried as a cover if it improves on the nearest so far.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn visit_leaf(
    bvh: &Bvh,
    points: &[[f64; 4]; 3],
    centre: [f64; 3],
    limit_sq: f64,
    block: u32,
    best: &mut Nearest,
    workspace: &mut Workspace,
) -> Option<Cover> {
    workspace.distances += LANES as u64;
    if !improve(bvh, centre, block, best) || best.distance_sq > limit_sq {
        return None;
    }
    workspace.distances += 3;
    let [x, y, z, _] = four_points_distances_sq(points, bvh.corners(best.slot));
    let farthest = if x > y { x } else { y };
    let farthest = if z > farthest { z } else { farthest };
    (farthest <= limit_sq).then_some(Cover::By { slot: best.slot, distance_sq: farthest })
}
