//! Areas of faces.
//!
//! Where the corners of a face are nearly in line, what rounding leaves of its area is far more than the area. Far away from the other surface that
//! is much for a mean of squares: of an area of one at distance zero and a face without area at distance one, the root of the mean square is zero,
//! and that of 1e-16 is 1e-8. So the areas of such faces are computed from exact determinants.

use super::linear::greater;
use pompeiu_core::exact::Interval;
use pompeiu_core::geom::Frame;
use pompeiu_core::{FaceId, TriMesh};

/// Enclosures that are wider than this part of themselves are made narrower.
const WIDE: f64 = 1e-9;

/// Encloses the area of a face in a frame.
pub(super) fn of_face(mesh: &TriMesh, frame: &Frame, face: u32) -> (f64, f64) {
    let corners = mesh.corners(FaceId(face));
    let [a, b, c] = corners.map(|p| frame.enclosure(p));
    let u = [0, 1, 2].map(|k| b[k] - a[k]);
    let v = [0, 1, 2].map(|k| c[k] - a[k]);
    let area = half_length([(1, 2), (2, 0), (0, 1)].map(|(i, j)| u[i] * v[j] - u[j] * v[i]));
    if area.1 - area.0 > WIDE * area.1 {
        // Each end is valid: the better ones stay.
        let [a, b, c] = corners.map(|p| p.map(|x| frame.length_in(x)));
        let exact =
            half_length([(1, 2), (2, 0), (0, 1)].map(|(i, j)| determinant([a, b, c].map(|p| [p[i], p[j]]))));
        return (greater(area.0, exact.0), if exact.1 < area.1 { exact.1 } else { area.1 });
    }
    area
}

/// Encloses half of the length of a vector.
fn half_length(n: [Interval; 3]) -> (f64, f64) {
    let area = Interval::point(0.5) * (n[0].square() + n[1].square() + n[2].square()).sqrt();
    (greater(area.lower(), 0.0), area.upper())
}

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
}
