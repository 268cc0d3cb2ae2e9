//! Areas of faces.
//!
//! Where the corners of a face are nearly in line, what rounding leaves of its area is far more than the area. Far away from the other surface that
//! is much for a mean of squares: of an area of one at distance zero and a face without area at distance one, the root of the mean square is zero,
//! and that of 1e-16 is 1e-8. So the areas of such faces are computed from exact determinants.

use super::entry::Sum;
use super::linear::greater;
use glam::DVec3;
use pompeiu_core::exact::Interval;
use pompeiu_core::geom::Frame;
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;

/// Enclosures that are wider than this part of themselves are made narrower.
const WIDE: f64 = 1e-9;

/// Encloses the area of a face in a frame. It depends on the scale of the frame alone: lengths are the same wherever it moves points.
pub(super) fn of_face(mesh: &TriMesh, frame: &Frame, face: u32) -> (f64, f64) {
    let corners = mesh.corners(FaceId(face)).map(|p| p.map(|x| frame.length_in(x)));
    rounded(corners).unwrap_or_else(|| {
        let project = |i: usize, j: usize| corners.map(|p| [p[i], p[j]]);
        half_length([(1, 2), (2, 0), (0, 1)].map(|(i, j)| determinant(project(i, j))))
    })
}

/// The same in doubles, with what their rounding may do to it; none if that is wide. Each component of the cross product is a difference of two products of
/// differences, rounded six times, so it is off by less than five units of rounding of the magnitudes of both products. These are no more than
/// the lengths of both edges multiplied, and three components make that nine. The root of the sum of squares adds three units of itself.
fn rounded([a, b, c]: [[f64; 3]; 3]) -> Option<(f64, f64)> {
    const OF_EDGES: f64 = 8.0 * f64::EPSILON;
    const OF_ITSELF: f64 = 4.0 * f64::EPSILON;
    let [a, b, c] = [a, b, c].map(DVec3::from_array);
    let (u, v) = (b - a, c - a);
    let area = 0.5 * u.cross(v).length();
    let error = 0.5 * OF_EDGES * u.length() * v.length() + OF_ITSELF * area;
    (area > SMALL && 2.0 * error < WIDE * area).then_some((area - error, area + error))
}

/// Encloses the area of all faces in a frame.
pub(super) fn of_mesh(mesh: &TriMesh, frame: &Frame) -> Sum {
    const TASK: usize = 1 << 12;
    let of_task = |start: usize| {
        let mut area = Sum::default();
        for face in start..mesh.faces().len().min(start + TASK) {
            let (low, high) = of_face(mesh, frame, face as u32);
            area.add(low, high);
        }
        area
    };
    let tasks = (0..mesh.faces().len()).into_par_iter().step_by(TASK).map(of_task).collect::<Vec<_>>();
    tasks.into_iter().fold(Sum::default(), Sum::plus)
}

/// Encloses half of the length of a vector.
fn half_length(n: [Interval; 3]) -> (f64, f64) {
    let area = Interval::point(0.5) * (n[0].square() + n[1].square() + n[2].square()).sqrt();
    (greater(area.lower(), 0.0), area.upper())
}

/// Squares of areas below this are below the range of doubles.
const SMALL: f64 = 1e-140;
/// What products of numbers below the range of doubles are off by: more than the sum of twelve.
const UNDERFLOW: f64 = 1e-300;
/// What a sum of at most twelve parts that do not overlap is off by, relative to itself.
const OF_SUM: f64 = 32.0 * f64::EPSILON;

/// Encloses twice the signed area of a triangle in the plane, narrowly even where it is almost zero.
fn determinant([a, b, c]: [[f64; 2]; 3]) -> Interval {
    let mut sum = Expansion::default();
    for (p, q) in [(a, b), (b, c), (c, a)] {
        sum.add_product(p[0], q[1]);
        sum.add_product(-p[1], q[0]);
    }
    let value = sum.value();
    let error = OF_SUM * value.abs() + if sum.is_exact { 0.0 } else { UNDERFLOW };
    Interval::spanning(value - error, value + error)
}

/// An exact sum, as parts that do not overlap (`shewchuk_predicates_1997`).
struct Expansion {
    parts: [f64; 12],
    count: usize,
    /// Whether no product fell below the range of doubles.
    is_exact: bool,
}

impl Default for Expansion {
    fn default() -> Self {
        Self { parts: [0.0; 12], count: 0, is_exact: true }
    }
}

impl Expansion {
    fn add_product(&mut self, x: f64, y: f64) {
        /// Products no less than this have errors that are no subnormal numbers.
        const SAFE: f64 = 1e-290;
        let product = x * y;
        let ((x1, x2), (y1, y2)) = (halves(x), halves(y));
        let error = x2 * y2 - (((product - x1 * y1) - x2 * y1) - x1 * y2);
        self.is_exact &= product.abs() > SAFE || x == 0.0 || y == 0.0;
        self.add(error);
        self.add(product);
    }

    fn add(&mut self, x: f64) {
        let mut x = x;
        for part in &mut self.parts[..self.count] {
            let sum = x + *part;
            let virtual_part = sum - x;
            *part = (x - (sum - virtual_part)) + (*part - virtual_part);
            x = sum;
        }
        if let Some(next) = self.parts.get_mut(self.count) {
            *next = x;
            self.count += 1;
        }
    }

    /// Rounded: from the least part to the greatest.
    fn value(&self) -> f64 {
        self.parts[..self.count].iter().sum()
    }
}

/// The upper and the lower half of the digits.
fn halves(x: f64) -> (f64, f64) {
    const SPLITTER: f64 = (1_u64 << 27) as f64 + 1.0;
    let scaled = SPLITTER * x;
    let upper = scaled - (scaled - x);
    (upper, x - upper)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::geom::Aabb;
    use pompeiu_core::mesh::Random;

    fn enclosed(corners: [[f64; 3]; 3]) -> (f64, f64) {
        let mesh = TriMesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap();
        let frame = Frame::of(&Aabb::of_faces(&mesh));
        let (low, high) = of_face(&mesh, &frame, 0);
        (frame.length_out(frame.length_out(low)), frame.length_out(frame.length_out(high)))
    }

    /// Corners in line that are no multiples of one another, moved aside or not: the area is found to many digits.
    #[test]
    fn slivers_have_the_area_that_they_have() {
        let (a, b) = ([0.1, 0.7, -0.3], [1.3, -0.2, 0.9]);
        let far = b.map(|x| 3.0 * x);
        let in_line: [[f64; 3]; 3] = [[0.0; 3], b, b.map(|x| 2.0 * x)];
        assert_eq!(enclosed(in_line).0, 0.0);
        assert!(enclosed(in_line).1 < 1e-150, "{:?}", enclosed(in_line));
        // Rounding moves the third corner aside by some 1e-17.
        let beside: [f64; 3] = std::array::from_fn(|k| a[k] + 0.3 * (far[k] - a[k]));
        let (low, high) = enclosed([a, far, beside]);
        assert!(high < 1e-15 && high - low <= 1e-12 * high, "{low} {high}");
        // One unit in the last place of a coordinate.
        let [x, y, z] = in_line[2];
        let (low, high) = enclosed([in_line[0], b, [x, y, z.next_up()]]);
        let exact = 0.5 * b[0].hypot(b[1]) * (z.next_up() - z);
        assert!(
            low <= exact * (1.0 + 1e-12) && exact <= high * (1.0 + 1e-12) && high - low <= 1e-12 * high,
            "{low} {exact} {high}"
        );
    }

    /// Triangles of all shapes with whole coordinates, whose areas are known exactly: those in doubles are enclosed, as far as they are narrow.
    #[test]
    fn rounded_areas_hold_the_exact_ones() {
        const SIZE: f64 = (1_u32 << 29) as f64;
        let mut random = Random::new(5);
        let mut found = 0;
        for i in 0..4000 {
            let mut point = || [0, 1, 2].map(|_| (SIZE * random.signed_unit()).round());
            let (a, b, c) = (point(), point(), point());
            let thin = 10.0_f64.powi(-(i % 12));
            let c: [f64; 3] = [0, 1, 2].map(|k| (a[k] + 0.7 * (b[k] - a[k]) + thin * c[k]).round());
            let edge = |p: [f64; 3]| [0, 1, 2].map(|k| (p[k] - a[k]) as i128);
            let (u, v) = (edge(b), edge(c));
            let n = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| u[i] * v[j] - u[j] * v[i]);
            let exact = 0.5 * (n.iter().map(|x| x.unsigned_abs().pow(2)).sum::<u128>() as f64).sqrt();
            if let Some((low, high)) = rounded([a, b, c]) {
                let doubt = 2.0 * f64::EPSILON * exact;
                assert!(low <= exact + doubt && exact - doubt <= high, "{i}: {low} {high} {exact}");
                found += 1;
            }
        }
        assert!((1500..3900).contains(&found), "{found}");
    }
}
