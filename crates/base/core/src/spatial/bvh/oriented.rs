//! Leaves near a box along the edges of a face.
//!
//! Boxes of a tree lie along the axes of coordinates. Around long thin faces that do not, they are far larger than the faces, and
//! most of a tessellated cylinder meets the box of one of its faces.

use super::{Bvh, Leaf};
use crate::geom::Aabb;
use crate::geom::point_triangle::{LANES, TriangleBlock};
use glam::DVec3;
use multiversion::multiversion;

/// Where there are more leaves, those beside an oriented box are left out.
const FEW_LEAVES: usize = 24;

impl Bvh {
    /// Leaves out leaves whose triangles are all farther than `beside` from some points, where there are many: those that lie beside what the points cover
    /// along the longest edge of a face, across it, or along its normal. All stay where the face has no area.
    ///
    /// # Accuracy
    /// Along a direction of length one, triangles are no nearer to points than the way between what both cover of it. With coordinates of at most M, both ends
    /// are off by less than `7 u M` (three products and two sums of terms below M), and the length of a direction by `4 u`, of ways of at
    /// most `2 sqrt(3) M`: together below 32 (u = 2^-53), by which `beside` must be widened.
    pub fn keep_leaves_near(
        &self,
        leaves: &mut Vec<(Leaf, Aabb)>,
        face: [[f64; 3]; 3],
        points: impl Iterator<Item = [f64; 3]>,
        beside: f64,
    ) {
        if leaves.len() > FEW_LEAVES
            && let Some(mut around) = OrientedBox::along(face)
        {
            points.for_each(|point| around.add(point));
            keep_near(&around, self, leaves, beside);
        }
    }
}

/// What some points cover along three directions, each of length one up to rounding.
struct OrientedBox {
    axes: [[f64; 3]; 3],
    lower: [f64; 3],
    upper: [f64; 3],
}

impl OrientedBox {
    /// Without points. None for a face without area.
    fn along(corners: [[f64; 3]; 3]) -> Option<Self> {
        let [a, b, c] = corners.map(DVec3::from_array);
        let edges = [b - a, c - b, a - c];
        let longest = (1..3).fold(0, |longest, k| {
            if edges[k].length_squared() > edges[longest].length_squared() { k } else { longest }
        });
        let normal = unit(edges[0].cross(edges[1]))?;
        let long = unit(edges[longest])?;
        let across = unit(normal.cross(long))?;
        let axes = [long, across, normal].map(|axis| axis.to_array());
        Some(Self { axes, lower: [f64::INFINITY; 3], upper: [f64::NEG_INFINITY; 3] })
    }

    fn add(&mut self, [x, y, z]: [f64; 3]) {
        for (k, [p, q, r]) in self.axes.into_iter().enumerate() {
            let at = p * x + q * y + r * z;
            self.lower[k] = if at < self.lower[k] { at } else { self.lower[k] };
            self.upper[k] = if at > self.upper[k] { at } else { self.upper[k] };
        }
    }

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
    fn is_far(&self, block: &TriangleBlock, beside: f64) -> bool {
        let mut is_far = false;
        for k in 0..3 {
            let [p, q, r] = self.axes[k];
            let mut low = [f64::INFINITY; LANES];
            let mut high = [f64::NEG_INFINITY; LANES];
            for [x, y, z] in block {
                for l in 0..LANES {
                    let at = p * x[l] + q * y[l] + r * z[l];
                    low[l] = if at < low[l] { at } else { low[l] };
                    high[l] = if at > high[l] { at } else { high[l] };
                }
            }
            let (mut least, mut greatest) = (low[0], high[0]);
            for l in 1..LANES {
                least = if low[l] < least { low[l] } else { least };
                greatest = if high[l] > greatest { high[l] } else { greatest };
            }
            is_far |= least > self.upper[k] + beside || greatest < self.lower[k] - beside;
        }
        is_far
    }
}

/// A vector made one of length one; none where squares of its components are subnormal.
fn unit(v: DVec3) -> Option<DVec3> {
    v.try_normalize().filter(|v| (v.length_squared() - 1.0).abs() < 8.0 * f64::EPSILON)
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn keep_near(around: &OrientedBox, bvh: &Bvh, leaves: &mut Vec<(Leaf, Aabb)>, beside: f64) {
    let mut kept = 0;
    for i in 0..leaves.len() {
        if !around.is_far(bvh.triangles(leaves[i].0), beside) {
            leaves[kept] = leaves[i];
            kept += 1;
        }
    }
    leaves.truncate(kept);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Frame;
    use crate::mesh::shapes::icosphere;
    use crate::mesh::{Affine, transform};
    use proptest::prelude::*;

    proptest! {
        /// Of thin turned faces, all that come near a triangle stay.
        #[test]
        fn what_comes_near_stays(
            corners in [[-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], [-1.0..1.0, -1.0..1.0, -1.0..1.0], [-1.0..1.0, -1.0..1.0, -1.0..1.0]],
            beside in 0.0..0.3_f64, degrees in 0.0..180.0_f64,
        ) {
            let stretch = Affine { linear: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 9.0]], translation: [0.0; 3] };
            let stretched = transform(&icosphere(1.0, 3).unwrap(), &stretch).unwrap();
            let mesh = transform(&stretched, &Affine::rotate([1.0, 2.0, -1.0], degrees).unwrap()).unwrap();
            let frame = Frame::of(&Aabb::of_faces(&mesh));
            let bvh = Bvh::build(&mesh, &frame);
            let corners = corners.map(|[x, y, z]| [0.05 * x, 0.05 * y, z]);
            let mut leaves = Vec::new();
            bvh.leaves_meeting([-2.0; 3], [2.0; 3], &mut Vec::new(), &mut leaves);
            let all = leaves.clone();
            bvh.keep_leaves_near(&mut leaves, corners, corners.into_iter(), beside);
            for (leaf, _) in all.iter().filter(|leaf| !leaves.contains(leaf)) {
                for slot in (0..LANES).map(|lane| bvh.slot_in(*leaf, lane)) {
                    for i in 0..=8 {
                        for j in 0..=8 - i {
                            let (v, w) = (f64::from(i) / 8.0, f64::from(j) / 8.0);
                            let p = [0, 1, 2].map(|k| (1.0 - v - w) * corners[0][k] + v * corners[1][k] + w * corners[2][k]);
                            prop_assert!(bvh.distance_sq(p, slot).sqrt() > beside);
                        }
                    }
                }
            }
        }
    }
}
