//! Which faces of B lie behind a plane, and which rise over it near a piece; eight faces at a time.

use glam::DVec3;
use multiversion::multiversion;
use pompeiu_core::geom::Aabb;
use pompeiu_core::geom::point_triangle::{LANES, TriangleBlock};
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
    rising_over(bvh, leaves, plane, list)
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn rising_over(bvh: &Bvh, leaves: &[(Leaf, Aabb)], plane: &Plane, list: &mut Vec<Slot>) -> f64 {
    let mut highest = f64::NEG_INFINITY;
    for (leaf, aabb) in leaves {
        if (0..3).any(|k| aabb.lower[k] > plane.upper[k] || aabb.upper[k] < plane.lower[k]) {
            continue;
        }
        let (rise, near) = rises(bvh.triangles(*leaf), plane);
        for lane in 0..LANES {
            if near[lane] == 0 {
                continue;
            }
            if rise[lane] <= plane.rise {
                highest = if rise[lane] > highest { rise[lane] } else { highest };
            } else {
                let slot = bvh.slot_in(*leaf, lane);
                // Lanes without a triangle repeat the last one.
                if list.last() != Some(&slot) {
                    list.push(slot);
                }
            }
        }
    }
    highest
}

/// How high each of eight triangles rises, and whether it meets the box.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn rises(block: &TriangleBlock, plane: &Plane) -> ([f64; LANES], [u64; LANES]) {
    let g = plane.normal.to_array();
    let y = plane.through.to_array();
    let mut rise = [f64::NEG_INFINITY; LANES];
    let mut near = [1; LANES];
    for corner in block {
        for l in 0..LANES {
            let height =
                g[0] * (corner[0][l] - y[0]) + g[1] * (corner[1][l] - y[1]) + g[2] * (corner[2][l] - y[2]);
            rise[l] = if height > rise[l] { height } else { rise[l] };
        }
    }
    let [a, b, c] = block;
    for k in 0..3 {
        for l in 0..LANES {
            let low = if a[k][l] < b[k][l] { a[k][l] } else { b[k][l] };
            let low = if c[k][l] < low { c[k][l] } else { low };
            let high = if a[k][l] > b[k][l] { a[k][l] } else { b[k][l] };
            let high = if c[k][l] > high { c[k][l] } else { high };
            near[l] &= u64::from(low <= plane.upper[k]) & u64::from(high >= plane.lower[k]);
        }
    }
    (rise, near)
}
