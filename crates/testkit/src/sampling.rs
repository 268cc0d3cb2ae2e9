//! Dense sampling: the distance from below, and from above by the covering radius of the samples.
//!
//! # Source
//! Measuring samples of faces is what most tools do, see `aspert_mesh_2002`; the radius makes it an enclosure.

use crate::plain::{point_point, point_triangles};
use pompeiu_core::{FaceId, TriMesh};

/// The largest distance of a sample, and how far a point of A can be from its nearest sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    /// Rounded; at most `h(A, B)` up to rounding.
    pub largest: f64,
    /// `h(A, B)` is at most `largest + covering_radius`, since distances change by no more than the way between points.
    pub covering_radius: f64,
}

/// Samples every face of A at the corners of `n * n` similar triangles and asks all of B.
///
/// A point lies in one of the similar triangles, and in a triangle no point is farther from the nearest corner than the
/// longest edge over `sqrt(3)`: a flatter triangle is covered by smaller disks around its corners.
pub fn sample(a: &TriMesh, b: &TriMesh, n: u32) -> Sampled {
    let corners = |mesh: &TriMesh| -> Vec<_> {
        (0..mesh.faces().len() as u32).map(|f| mesh.corners(FaceId(f))).collect()
    };
    let triangles = corners(b);
    let (mut largest, mut longest) = (0.0, 0.0);
    let greater = |x: f64, y: f64| if x > y { x } else { y };
    for [p, q, r] in corners(a) {
        for edge in [point_point(p, q), point_point(q, r), point_point(r, p)] {
            longest = greater(longest, edge);
        }
        for i in 0..=n {
            for j in 0..=n - i {
                let (s, t) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
                let x = [0, 1, 2].map(|k| p[k] + s * (q[k] - p[k]) + t * (r[k] - p[k]));
                largest = greater(largest, point_triangles(x, &triangles));
            }
        }
    }
    Sampled { largest, covering_radius: longest / (f64::from(n) * 3.0_f64.sqrt()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::{Diagonal, grid, point_lattice};

    #[test]
    fn brackets_a_known_distance() {
        let (a, b) = (grid([1.0, 1.0], [1, 1], Diagonal::Rising).unwrap(), point_lattice(1.0, 3).unwrap());
        let h = 2.0_f64.sqrt() / 6.0;
        for n in [1, 2, 7, 10] {
            let s = sample(&a, &b, n);
            assert!(s.largest <= h + 1e-15 && h <= s.largest + s.covering_radius + 1e-15, "{n} {s:?}");
        }
        assert!(sample(&a, &b, 40).covering_radius < 0.03);
    }
}
