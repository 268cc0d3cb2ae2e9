//! A few triangles, to ask which of them are near a point.

use super::triangle::Triangle;
use glam::DVec3;
use multiversion::multiversion;
use pompeiu_core::geom::point_triangle::{LANES, TriangleBlock, block_distances_sq, lane_of, set_lane};

/// Up to [`Candidates::MOST`] triangles in groups of [`LANES`]; the last group is filled up with copies of the last triangle.
#[derive(Clone, Debug, Default)]
pub(crate) struct Candidates {
    blocks: Vec<TriangleBlock>,
    count: usize,
}

impl Candidates {
    /// As many as a mask has bits.
    pub(crate) const MOST: usize = u64::BITS as usize;

    /// Takes the first [`Candidates::MOST`] of some triangles.
    pub(crate) fn set(&mut self, triangles: impl Iterator<Item = Triangle>) {
        self.blocks.clear();
        self.count = 0;
        for triangle in triangles.take(Self::MOST) {
            let lane = self.count % LANES;
            if lane == 0 {
                self.blocks.push([[[0.0; LANES]; 3]; 3]);
            }
            if let Some(block) = self.blocks.last_mut() {
                (lane..LANES).for_each(|lane| set_lane(block, lane, triangle.map(|p| p.to_array())));
            }
            self.count += 1;
        }
    }

    fn triangle(&self, i: usize) -> Triangle {
        lane_of(&self.blocks[i / LANES], i % LANES).map(DVec3::from_array)
    }

    /// A mask for each point: bit `i` is set if it is within the limit of triangle `i`. Bits beyond the last triangle are those of the
    /// last one. Ends at the first point that `must` be near one and is not, with its index.
    pub(crate) fn near(
        &self,
        points: &[[f64; 3]],
        must: &[bool],
        limit_sq: f64,
        masks: &mut [u64],
    ) -> Result<(), usize> {
        near(points, must, &self.blocks, limit_sq, masks)
    }

    /// The squared distance of a point from the nearest.
    pub(crate) fn distance_sq(&self, p: [f64; 3]) -> f64 {
        nearest(p, &self.blocks).0
    }

    /// A mask for each of three points.
    pub(crate) fn near_each(&self, points: &[[f64; 3]; 3], limit_sq: f64) -> [u64; 3] {
        let mut masks = [0; 3];
        // None must be near, so no point ends it.
        let _ = near(points, &[false; 3], &self.blocks, limit_sq, &mut masks);
        masks
    }

    /// The squared distance of a point from the nearest triangle, and that triangle.
    pub(crate) fn nearest(&self, p: [f64; 3]) -> (f64, Triangle) {
        let (distance_sq, i) = nearest(p, &self.blocks);
        (distance_sq, self.triangle(i))
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn near(
    points: &[[f64; 3]],
    must: &[bool],
    blocks: &[TriangleBlock],
    limit_sq: f64,
    masks: &mut [u64],
) -> Result<(), usize> {
    for (i, ((p, must), mask)) in points.iter().zip(must).zip(masks).enumerate() {
        *mask = 0;
        for (b, block) in blocks.iter().enumerate() {
            let distances = block_distances_sq(*p, block);
            let mut bits = 0;
            for (lane, d) in distances.into_iter().enumerate() {
                bits |= u64::from(d <= limit_sq) << lane;
            }
            *mask |= bits << (b * LANES);
        }
        if *must && *mask == 0 {
            return Err(i);
        }
    }
    Ok(())
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn nearest(p: [f64; 3], blocks: &[TriangleBlock]) -> (f64, usize) {
    let mut best = (f64::INFINITY, 0);
    for (b, block) in blocks.iter().enumerate() {
        for (lane, d) in block_distances_sq(p, block).into_iter().enumerate() {
            if d < best.0 {
                best = (d, b * LANES + lane);
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::geom::point_triangle::distance_sq;
    use pompeiu_core::mesh::Random;

    #[test]
    fn masks_and_nearest_agree_with_single_distances() {
        let mut random = Random::new(5);
        let mut point = || DVec3::from_array([0; 3].map(|_| f64::from(random.below(1 << 16)) / 65536.0));
        for count in [1, 2, 7, 8, 9, 23, 64] {
            let triangles: Vec<Triangle> = (0..count).map(|_| [(); 3].map(|()| point())).collect();
            let mut candidates = Candidates::default();
            candidates.set(triangles.iter().copied());
            let points = [(); 3].map(|()| point().to_array());
            let masks = candidates.near_each(&points, 0.05);
            for (p, mask) in points.iter().zip(masks) {
                let distances: Vec<f64> = triangles
                    .iter()
                    .map(|[a, b, c]| distance_sq(*p, a.to_array(), b.to_array(), c.to_array()))
                    .collect();
                for (i, d) in distances.iter().enumerate() {
                    assert_eq!(mask >> i & 1 == 1, *d <= 0.05, "triangle {i} of {count}");
                }
                let (least, nearest) = candidates.nearest(*p);
                assert_eq!(least, distances.iter().copied().fold(f64::INFINITY, f64::min));
                assert!(triangles.iter().zip(&distances).any(|(t, d)| *t == nearest && *d == least));
            }
            let far = [[9.0; 3]];
            assert_eq!(candidates.near(&far, &[true], 0.05, &mut [0]), Err(0));
            assert_eq!(candidates.near(&far, &[false], 0.05, &mut [0]), Ok(()));
        }
    }
}
