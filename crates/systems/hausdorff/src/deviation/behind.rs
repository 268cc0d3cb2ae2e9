//! Which faces of B lie behind a plane, and which rise over it near a piece; eight faces at a time.

use super::envelope::unit;
use glam::DVec3;
use multiversion::multiversion;
use pompeiu_core::geom::Aabb;
use pompeiu_core::geom::point_triangle::{LANES, TriangleBlock, lane_of, set_lane};
use pompeiu_core::spatial::bvh::{Bvh, Leaf, Slot};

/// The plane through a point with a unit normal, and a box beyond which faces do not matter.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    pub(super) normal: DVec3,
    pub(super) through: DVec3,
    pub(super) lower: [f64; 3],
    pub(super) upper: [f64; 3],
    /// Faces that rise no higher count as lying behind.
    pub(super) rise: f64,
}

/// Lists the faces of some leaves that rise over a plane and meet its box. Returns how high the others that meet it rise, at most;
/// negative infinity if there are none.
pub(super) fn rising(bvh: &Bvh, leaves: &[(Leaf, Aabb)], plane: &Plane, list: &mut Vec<Slot>) -> f64 {
    let highest = rising_over(bvh, leaves, plane, list);
    bvh.remove_repeats(list);
    highest
}

/// The same for both sides of a plane: above, and below.
pub(super) fn rising_on_both_sides(
    bvh: &Bvh,
    leaves: &[(Leaf, Aabb)],
    plane: &Plane,
    [above, below]: [&mut Vec<Slot>; 2],
) -> [f64; 2] {
    let highest = rising_and_falling(bvh, leaves, plane, [&mut *above, &mut *below]);
    bvh.remove_repeats(above);
    bvh.remove_repeats(below);
    highest
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn rising_over(bvh: &Bvh, leaves: &[(Leaf, Aabb)], plane: &Plane, list: &mut Vec<Slot>) -> f64 {
    let mut highest = f64::NEG_INFINITY;
    for (leaf, aabb) in leaves {
        if plane.is_out_of_reach(aabb) {
            continue;
        }
        let block = bvh.triangles(*leaf);
        let near = meets(block, plane);
        if near == [0; LANES] {
            continue;
        }
        let [rise, _] = rises(block, plane);
        for lane in 0..LANES {
            if near[lane] != 0 {
                sort(bvh, *leaf, lane, rise[lane], plane.rise, &mut highest, list);
            }
        }
    }
    highest
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn rising_and_falling(
    bvh: &Bvh,
    leaves: &[(Leaf, Aabb)],
    plane: &Plane,
    lists: [&mut Vec<Slot>; 2],
) -> [f64; 2] {
    let mut highest = [f64::NEG_INFINITY; 2];
    for (leaf, aabb) in leaves {
        if plane.is_out_of_reach(aabb) {
            continue;
        }
        let block = bvh.triangles(*leaf);
        let near = meets(block, plane);
        if near == [0; LANES] {
            continue;
        }
        let rises = rises(block, plane);
        for lane in 0..LANES {
            if near[lane] == 0 {
                continue;
            }
            for side in 0..2 {
                let rise = rises[side][lane];
                sort(bvh, *leaf, lane, rise, plane.rise, &mut highest[side], lists[side]);
            }
        }
    }
    highest
}

impl Plane {
    /// Whether a box does not meet that of the plane.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
    fn is_out_of_reach(&self, aabb: &Aabb) -> bool {
        // Without closures, which are not compiled for the instruction set of the caller.
        let mut is_out = false;
        for k in 0..3 {
            is_out |= aabb.lower[k] > self.upper[k] || aabb.upper[k] < self.lower[k];
        }
        is_out
    }
}

/// Lists a triangle that rises too high, or remembers how high.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn sort(bvh: &Bvh, leaf: Leaf, lane: usize, rise: f64, most: f64, highest: &mut f64, list: &mut Vec<Slot>) {
    if rise <= most {
        *highest = if rise > *highest { rise } else { *highest };
    } else {
        list.push(bvh.slot_in(leaf, lane));
    }
}

/// How high each of eight triangles rises above a plane, and below it.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn rises(block: &TriangleBlock, plane: &Plane) -> [[f64; LANES]; 2] {
    let g = plane.normal.to_array();
    let y = plane.through.to_array();
    let mut rise = [[f64::NEG_INFINITY; LANES]; 2];
    for corner in block {
        for l in 0..LANES {
            let height =
                g[0] * (corner[0][l] - y[0]) + g[1] * (corner[1][l] - y[1]) + g[2] * (corner[2][l] - y[2]);
            rise[0][l] = if height > rise[0][l] { height } else { rise[0][l] };
            rise[1][l] = if -height > rise[1][l] { -height } else { rise[1][l] };
        }
    }
    rise
}

/// Whether each of eight triangles meets the box of a plane, as far as the box around it says.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn meets([a, b, c]: &TriangleBlock, plane: &Plane) -> [u64; LANES] {
    let mut near = [1; LANES];
    for k in 0..3 {
        for l in 0..LANES {
            let low = if a[k][l] < b[k][l] { a[k][l] } else { b[k][l] };
            let low = if c[k][l] < low { c[k][l] } else { low };
            let high = if a[k][l] > b[k][l] { a[k][l] } else { b[k][l] };
            let high = if c[k][l] > high { c[k][l] } else { high };
            near[l] &= u64::from(low <= plane.upper[k]) & u64::from(high >= plane.lower[k]);
        }
    }
    near
}

/// Ways that lead away from a plane by less than this part of their length, squared, lead along it.
const LEAST_RUN: f64 = 1e-18;

/// A normal turned aside so far that the plane lies over all ends of some ways.
pub(super) fn tilted(ways: &[DVec3; 3], normal: DVec3, aside: DVec3) -> Option<DVec3> {
    let aside = aside - normal.dot(aside) * normal;
    let least = LEAST_RUN * aside.length_squared();
    if least.is_nan() || least <= 0.0 {
        return None;
    }
    let mut slope = 0.0;
    for way in ways {
        let (rise, run) = (normal.dot(*way), -aside.dot(*way));
        if run > 0.0 && run * run > least * way.length_squared() && rise > slope * run {
            slope = rise / run;
        }
    }
    (slope < f64::INFINITY).then(|| unit(normal + slope * aside)).flatten()
}

/// Some triangles, eight to a block, of which those behind planes are crossed off.
#[derive(Default)]
pub(super) struct Group {
    blocks: Vec<TriangleBlock>,
    /// A bit for each triangle that is left.
    left: Vec<u8>,
}

impl Group {
    /// Begins with the triangles in some slots.
    pub(super) fn fill(&mut self, bvh: &Bvh, slots: impl Iterator<Item = Slot>) {
        self.blocks.clear();
        self.left.clear();
        let mut lane = LANES;
        for slot in slots {
            if lane == LANES {
                self.blocks.push([[[0.0; LANES]; 3]; 3]);
                self.left.push(0);
                lane = 0;
            }
            let last = self.blocks.len() - 1;
            set_lane(&mut self.blocks[last], lane, bvh.corners(slot));
            self.left[last] |= 1 << lane;
            lane += 1;
        }
    }

    /// Crosses off the triangles that reach along a direction no farther than this.
    pub(super) fn cross_off(&mut self, normal: DVec3, offset: f64) {
        cross_off(&self.blocks, &mut self.left, normal, offset);
    }

    /// The first triangle that is left, which is crossed off.
    pub(super) fn take(&mut self) -> Option<[DVec3; 3]> {
        let index = self.left.iter().position(|left| *left != 0)?;
        let lane = self.left[index].trailing_zeros() as usize;
        self.left[index] &= self.left[index] - 1;
        Some(lane_of(&self.blocks[index], lane).map(DVec3::from_array))
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn cross_off(blocks: &[TriangleBlock], left: &mut [u8], normal: DVec3, offset: f64) {
    for (block, left) in blocks.iter().zip(left) {
        if *left == 0 {
            continue;
        }
        let mut reach = [f64::NEG_INFINITY; LANES];
        for corner in block {
            for l in 0..LANES {
                let along = normal.x * corner[0][l] + normal.y * corner[1][l] + normal.z * corner[2][l];
                reach[l] = if along > reach[l] { along } else { reach[l] };
            }
        }
        let mut behind = 0;
        for l in 0..LANES {
            behind |= u8::from(reach[l] <= offset) << l;
        }
        *left &= !behind;
    }
}
