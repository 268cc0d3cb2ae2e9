//! The directed distance between small meshes, enclosed by exact fractions.
//!
//! A search in ordinary arithmetic finds a point of A that is far from B, and a partition of A into triangles each with a
//! face of B that is near all its corners. What it found is then proven in exact arithmetic: the distance of the point
//! from every face of B bounds h from below; the distances of the corners from their face bound it from above, since the
//! distance from a face is convex. The search itself may be as wrong as it likes. No code is shared with the engine.

use crate::exact::{Fraction, Lattice, Triangle, point_triangle_sq};
use crate::plain::point_triangle;
use dashu_int::IBig;
use pompeiu_core::{FaceId, TriMesh};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Exact bounds on the square of a distance, in units of a lattice.
#[derive(Clone, Debug)]
pub struct ExactEnclosure {
    /// The lattice in whose unit the bounds are.
    pub lattice: Lattice,
    /// `lower_sq <= h^2`.
    pub lower_sq: Fraction,
    /// `h^2 <= upper_sq`.
    pub upper_sq: Fraction,
}

impl ExactEnclosure {
    /// The ends as lengths in the unit of the meshes, rounded.
    pub fn rounded(&self) -> (f64, f64) {
        (self.lattice.length(&self.lower_sq), self.lattice.length(&self.upper_sq))
    }

    /// Whether a value can be an upper bound on the distance: it is not below the lower end.
    pub fn allows_upper(&self, upper: f64) -> bool {
        self.lattice.length_sq(upper) >= self.lower_sq
    }

    /// Whether a value can be a lower bound on the distance: it is not above the upper end.
    pub fn allows_lower(&self, lower: f64) -> bool {
        self.lattice.length_sq(lower) <= self.upper_sq
    }
}

/// Corner weights in units of `2^-BITS`.
type Weights = [u64; 3];
const BITS: u32 = 52;
/// The search ends when its bounds agree to this part.
const AGREEMENT: f64 = 1e-13;

struct Piece {
    face: usize,
    corners: [Weights; 3],
    /// Face of B with the least bound.
    near: usize,
    bound: f64,
    level: u32,
}

impl PartialEq for Piece {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Piece {}

impl PartialOrd for Piece {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Piece {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

/// Encloses `h(A, B)`, splitting at most `splits` triangles. Meant for some tens of faces each.
///
/// The enclosure is valid whatever the number of splits; where whole regions of A are equally far from B, no number
/// makes it narrow.
pub fn directed(a: &TriMesh, b: &TriMesh, splits: usize) -> ExactEnclosure {
    let lattice = Lattice::of(&[a, b]);
    let exact = |mesh: &TriMesh| -> Vec<Triangle> {
        (0..mesh.faces().len() as u32).map(|f| lattice.triangle(mesh.corners(FaceId(f)))).collect()
    };
    let (exact_a, exact_b) = (exact(a), exact(b));
    let (best, pieces) = Search::new(a, b).run(splits);

    let x = exact_mean(&exact_a[best.0], best.1);
    let lower_sq = exact_b.iter().map(|t| point_triangle_sq(&x, t)).min().expect("a mesh has a face");
    let corner_sq = |piece: &Piece, weights: Weights| {
        point_triangle_sq(&exact_mean(&exact_a[piece.face], weights), &exact_b[piece.near])
    };
    let upper_sq = pieces.iter().flat_map(|piece| piece.corners.map(|w| corner_sq(piece, w))).max();
    ExactEnclosure { lattice, lower_sq, upper_sq: upper_sq.expect("a mesh has a face") }
}

fn exact_mean(triangle: &Triangle, weights: Weights) -> crate::exact::Point {
    Lattice::integer_mean(triangle, &weights.map(IBig::from))
}

/// The search in ordinary arithmetic, on coordinates scaled to the size of one.
struct Search {
    a: Vec<[[f64; 3]; 3]>,
    b: Vec<[[f64; 3]; 3]>,
    best: (usize, Weights),
    lower: f64,
}

impl Search {
    fn new(a: &TriMesh, b: &TriMesh) -> Self {
        let used =
            |m: &TriMesh| m.faces().iter().flatten().map(|&v| m.positions()[v as usize]).collect::<Vec<_>>();
        let points: Vec<[f64; 3]> = [used(a), used(b)].concat();
        let centre = points[0];
        let size = points.iter().flat_map(|p| [0, 1, 2].map(|k| (0.5 * p[k] - 0.5 * centre[k]).abs()));
        let size = size.fold(0.0, |m: f64, x| if x > m { x } else { m });
        let size = if size > 0.0 { size } else { 1.0 };
        let scaled = |m: &TriMesh| {
            let corners = (0..m.faces().len() as u32).map(|f| m.corners(FaceId(f)));
            corners.map(|t| t.map(|p| [0, 1, 2].map(|k| (0.5 * p[k] - 0.5 * centre[k]) / size))).collect()
        };
        Self { a: scaled(a), b: scaled(b), best: (0, [1 << BITS, 0, 0]), lower: -1.0 }
    }

    /// The face and weights of the farthest point met, and the partition.
    fn run(mut self, splits: usize) -> ((usize, Weights), Vec<Piece>) {
        let whole = [[1 << BITS, 0, 0], [0, 1 << BITS, 0], [0, 0, 1 << BITS]];
        let mut open: BinaryHeap<Piece> = (0..self.a.len()).map(|face| self.piece(face, whole, 0)).collect();
        let mut done = Vec::new();
        let mut left = splits;
        while let Some(piece) = open.pop() {
            // The largest bound comes first: when it is low enough, all are.
            if left == 0 || piece.bound <= self.lower * (1.0 + AGREEMENT) || piece.level + 2 >= BITS {
                let stop = left == 0 || piece.level + 2 < BITS;
                done.push(piece);
                if stop {
                    break;
                }
                continue;
            }
            left -= 1;
            let [p, q, r] = piece.corners;
            let middle = |p: Weights, q: Weights| [0, 1, 2].map(|i| u64::midpoint(p[i], q[i]));
            let (pq, qr, rp) = (middle(p, q), middle(q, r), middle(r, p));
            for corners in [[p, pq, rp], [pq, q, qr], [rp, qr, r], [pq, qr, rp]] {
                let part = self.piece(piece.face, corners, piece.level + 1);
                open.push(part);
            }
        }
        done.extend(open);
        (self.best, done)
    }

    fn piece(&mut self, face: usize, corners: [Weights; 3], level: u32) -> Piece {
        let triangle = self.a[face];
        let at = |w: Weights| {
            let w = w.map(|x| x as f64 / (1_u64 << BITS) as f64);
            [0, 1, 2].map(|k| w[0] * triangle[0][k] + w[1] * triangle[1][k] + w[2] * triangle[2][k])
        };
        let points = corners.map(at);
        let (mut bound, mut near) = (f64::INFINITY, 0);
        let mut least = [f64::INFINITY; 3];
        for (i, t) in self.b.iter().enumerate() {
            let d = points.map(|p| point_triangle(p, *t));
            for j in 0..3 {
                least[j] = if d[j] < least[j] { d[j] } else { least[j] };
            }
            let farthest = d.into_iter().fold(0.0, |m: f64, x| if x > m { x } else { m });
            if farthest < bound {
                (bound, near) = (farthest, i);
            }
        }
        for j in 0..3 {
            if least[j] > self.lower {
                (self.lower, self.best) = (least[j], (face, corners[j]));
            }
        }
        Piece { face, corners, near, bound, level }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(positions: &[[f64; 3]], faces: &[[u32; 3]]) -> TriMesh {
        TriMesh::new(positions.to_vec(), faces.to_vec()).unwrap()
    }

    #[track_caller]
    fn check(a: &TriMesh, b: &TriMesh, expected: f64, width: f64) {
        let (lower, upper) = directed(a, b, 4000).rounded();
        assert!(lower <= expected * (1.0 + 1e-14) && expected <= upper * (1.0 + 1e-14), "{lower} {upper}");
        assert!(upper - lower <= width, "{lower} {upper}");
    }

    #[test]
    fn closed_forms() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]];
        let (a, b) = (mesh(&corners, &[[0, 1, 2], [0, 2, 3]]), mesh(&corners, &[[0, 1, 3], [1, 2, 3]]));
        check(&a, &b, 1.0 / 3.0_f64.sqrt(), 1e-12);
        let s = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 3.0_f64.sqrt(), 0.0]];
        check(
            &mesh(&s, &[[0, 1, 2]]),
            &mesh(&s, &[[0, 0, 0], [1, 1, 1], [2, 2, 2]]),
            2.0 / 3.0_f64.sqrt(),
            1e-12,
        );
        check(&mesh(&s, &[[0, 1, 2]]), &mesh(&s, &[[0, 1, 2], [2, 2, 0]]), 0.0, 0.0);
    }

    #[test]
    fn scales_whose_squares_leave_the_range_of_doubles() {
        for scale in [1e-300, 1e-160, 1e160, 1e300] {
            let t = |z: f64| {
                mesh(&[[0.0, 0.0, z * scale], [scale, 0.0, z * scale], [0.0, scale, z * scale]], &[[0, 1, 2]])
            };
            check(&t(0.0), &t(0.75), 0.75 * scale, 1e-12 * scale);
        }
    }

    #[test]
    fn few_splits_give_a_wide_but_valid_enclosure() {
        let s = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 3.0_f64.sqrt(), 0.0]];
        let (a, b) = (mesh(&s, &[[0, 1, 2]]), mesh(&s, &[[0, 0, 0], [1, 1, 1], [2, 2, 2]]));
        let mut before = f64::INFINITY;
        for splits in [0, 1, 10, 100] {
            let (lower, upper) = directed(&a, &b, splits).rounded();
            let h = 2.0 / 3.0_f64.sqrt();
            assert!(lower <= h && h <= upper && upper <= before, "{splits} {lower} {upper}");
            before = upper;
        }
    }
}
