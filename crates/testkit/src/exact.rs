//! Exact numbers: doubles as integers on a common lattice, squared distances as fractions.
//!
//! Every double is an integer times a power of two, so sums and products need no rounding, and a point–triangle distance
//! needs one division, which a fraction without reduction holds.

use dashu_int::IBig;
use pompeiu_core::TriMesh;
use std::cmp::Ordering;

/// A quotient of integers with a positive denominator, not reduced.
#[derive(Clone, Debug)]
pub struct Fraction {
    numerator: IBig,
    denominator: IBig,
}

impl Fraction {
    /// The quotient.
    ///
    /// # Panics
    /// Unless the denominator is positive.
    pub fn new(numerator: IBig, denominator: IBig) -> Self {
        assert!(denominator > IBig::ZERO, "a denominator must be positive");
        Self { numerator, denominator }
    }

    /// A double, exactly.
    ///
    /// # Panics
    /// If it is not finite.
    pub fn from_f64(x: f64) -> Self {
        let (integer, exponent) = decode(x);
        Self::new(integer, IBig::ONE).times_power_of_two(exponent)
    }

    /// `self * 2^exponent`.
    #[must_use]
    pub fn times_power_of_two(mut self, exponent: i32) -> Self {
        let shift = exponent.unsigned_abs() as usize;
        if exponent > 0 {
            self.numerator <<= shift;
        } else {
            self.denominator <<= shift;
        }
        self
    }

    /// The square.
    #[must_use]
    pub fn square(&self) -> Self {
        Self::new(&self.numerator * &self.numerator, &self.denominator * &self.denominator)
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let numerator = &self.numerator * &other.denominator + &other.numerator * &self.denominator;
        Self::new(numerator, &self.denominator * &other.denominator)
    }

    /// The product.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        Self::new(&self.numerator * &other.numerator, &self.denominator * &other.denominator)
    }

    /// The square root of a nonnegative fraction times `2^exponent`, as a double off by at most `2^-50` relative in its
    /// normal range. For printing and for sums of roots; proofs compare squares.
    pub fn root(&self, exponent: i32) -> f64 {
        if self.numerator <= IBig::ZERO {
            return 0.0;
        }
        // Sixty-odd significant bits of the quotient, times an even power of two.
        let mut shift = 64 + self.denominator.significant() - self.numerator.significant();
        shift += shift.rem_euclid(2);
        let scaled = self.clone().times_power_of_two(shift);
        let quotient = &scaled.numerator / &scaled.denominator;
        let quotient = u128::try_from(quotient).expect("sixty-odd bits") as f64;
        let exponent = exponent - shift / 2;
        let (third, rest) = (exponent / 3, exponent - 2 * (exponent / 3));
        quotient.sqrt() * 2.0_f64.powi(third) * 2.0_f64.powi(third) * 2.0_f64.powi(rest)
    }
}

/// Number of significant bits.
trait Bits {
    fn significant(&self) -> i32;
}

impl Bits for IBig {
    fn significant(&self) -> i32 {
        use dashu_int::ops::BitTest;
        i32::try_from(self.bit_len()).expect("numbers of far fewer bits")
    }
}

impl PartialEq for Fraction {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Fraction {}

impl PartialOrd for Fraction {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Fraction {
    fn cmp(&self, other: &Self) -> Ordering {
        (&self.numerator * &other.denominator).cmp(&(&other.numerator * &self.denominator))
    }
}

/// A point with rational coordinates over one positive denominator, in units of a lattice.
#[derive(Clone, Debug)]
pub struct Point {
    numerators: [IBig; 3],
    denominator: IBig,
}

/// Three lattice points.
pub type Triangle = [[IBig; 3]; 3];

/// All multiples of a power of two: fine enough to hold the coordinates of some meshes.
#[derive(Clone, Copy, Debug)]
pub struct Lattice {
    exponent: i32,
}

impl Lattice {
    /// The coarsest lattice that holds all vertices of all meshes.
    pub fn of(meshes: &[&TriMesh]) -> Self {
        let coordinates = meshes.iter().flat_map(|m| m.positions().iter().flatten());
        let exponent = coordinates.filter(|x| **x != 0.0).map(|&x| decode(x).1).min();
        Self { exponent: exponent.unwrap_or(0) }
    }

    /// The corners of a triangle whose coordinates are multiples of the unit, as those of the meshes are.
    ///
    /// # Panics
    /// If a corner does not lie on the lattice.
    pub fn triangle(&self, corners: [[f64; 3]; 3]) -> Triangle {
        corners.map(|p| {
            p.map(|x| {
                let (integer, exponent) = decode(x);
                assert!(integer == IBig::ZERO || exponent >= self.exponent, "{x} is not on the lattice");
                if integer == IBig::ZERO { integer } else { integer << (exponent - self.exponent) as usize }
            })
        })
    }

    /// A lattice fine enough for some points too.
    #[must_use]
    pub fn with(&self, points: &[[f64; 3]]) -> Self {
        let exponents = points.iter().flatten().filter(|x| **x != 0.0).map(|&x| decode(x).1);
        Self { exponent: exponents.fold(self.exponent, |least, e| if e < least { e } else { least }) }
    }

    /// Any point with finite coordinates.
    pub fn point(&self, p: [f64; 3]) -> Point {
        let decoded = p.map(decode);
        let least = decoded.iter().filter(|d| d.0 != IBig::ZERO).map(|d| d.1).min().unwrap_or(0);
        let finer = (self.exponent - least).max(0);
        let numerators = decoded.map(|(integer, exponent)| {
            if integer == IBig::ZERO {
                integer
            } else {
                integer << (exponent - self.exponent + finer) as usize
            }
        });
        Point { numerators, denominator: IBig::ONE << finer as usize }
    }

    /// `sum(w_i v_i) / sum(w_i)` for the corners of a triangle.
    ///
    /// # Panics
    /// Unless the weights are nonnegative with a positive sum.
    pub fn mean(&self, triangle: &Triangle, weights: [f64; 3]) -> Point {
        assert!(weights.iter().all(|w| *w >= 0.0), "negative weight in {weights:?}");
        let decoded = weights.map(decode);
        let least = decoded.iter().map(|d| d.1).min().unwrap_or(0);
        let weights = decoded.map(|(integer, exponent)| integer << (exponent - least) as usize);
        Self::integer_mean(triangle, &weights)
    }

    /// The same with integers as weights, whose sum is positive.
    ///
    /// # Panics
    /// Unless it is.
    pub fn integer_mean(triangle: &Triangle, weights: &[IBig; 3]) -> Point {
        let denominator = &weights[0] + &weights[1] + &weights[2];
        assert!(denominator > IBig::ZERO, "the weights must have a positive sum");
        let numerators = [0, 1, 2].map(|k| {
            &weights[0] * &triangle[0][k] + &weights[1] * &triangle[1][k] + &weights[2] * &triangle[2][k]
        });
        Point { numerators, denominator }
    }

    /// The square of a length, in units of this lattice.
    pub fn length_sq(&self, length: f64) -> Fraction {
        Fraction::from_f64(length).times_power_of_two(-self.exponent).square()
    }

    /// The root of a squared length of this lattice, in the unit of the meshes, rounded: see [`Fraction::root`].
    pub fn length(&self, length_sq: &Fraction) -> f64 {
        length_sq.root(self.exponent)
    }
}

/// The exact squared distance between two points.
pub fn point_point_sq(p: &Point, q: &Point) -> Fraction {
    let difference = [0, 1, 2].map(|k| &p.numerators[k] * &q.denominator - &q.numerators[k] * &p.denominator);
    let denominator = &p.denominator * &q.denominator;
    Fraction::new(dot(&difference, &difference), &denominator * &denominator)
}

/// The exact squared distance between a point and a triangle, which may be a segment or a point.
pub fn point_triangle_sq(p: &Point, [a, b, c]: &Triangle) -> Fraction {
    let d = &p.denominator;
    // All offsets from p carry the factor d.
    let from = |corner: &[IBig; 3]| [0, 1, 2].map(|k| &p.numerators[k] - d * &corner[k]);
    let (ab, ac, ap) = (minus(b, a), minus(c, a), from(a));
    let n = cross(&ab, &ac);
    let nn = dot(&n, &n);
    let d_sq = d * d;
    if nn > IBig::ZERO {
        let v = dot(&cross(&ap, &ac), &n);
        let w = dot(&cross(&ab, &ap), &n);
        if v >= IBig::ZERO && w >= IBig::ZERO && &v + &w <= d * &nn {
            let height = dot(&n, &ap);
            return Fraction::new(&height * &height, nn * d_sq);
        }
    }
    let bc = minus(c, b);
    let bp = from(b);
    let edges = [segment_sq(&ap, &ab, d), segment_sq(&ap, &ac, d), segment_sq(&bp, &bc, d)];
    edges.into_iter().min().expect("three edges")
}

/// The squared distance of `from / d`, seen from one end of a segment along `edge`.
fn segment_sq(from: &[IBig; 3], edge: &[IBig; 3], d: &IBig) -> Fraction {
    let d_sq = d * d;
    let along = dot(from, edge);
    let edge_sq = dot(edge, edge);
    if along <= IBig::ZERO {
        return Fraction::new(dot(from, from), d_sq);
    }
    if along >= d * &edge_sq {
        let beyond = [0, 1, 2].map(|k| &from[k] - d * &edge[k]);
        return Fraction::new(dot(&beyond, &beyond), d_sq);
    }
    Fraction::new(dot(from, from) * &edge_sq - &along * &along, edge_sq * d_sq)
}

fn minus(a: &[IBig; 3], b: &[IBig; 3]) -> [IBig; 3] {
    [0, 1, 2].map(|k| &a[k] - &b[k])
}

fn dot(a: &[IBig; 3], b: &[IBig; 3]) -> IBig {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn cross(a: &[IBig; 3], b: &[IBig; 3]) -> [IBig; 3] {
    [&a[1] * &b[2] - &a[2] * &b[1], &a[2] * &b[0] - &a[0] * &b[2], &a[0] * &b[1] - &a[1] * &b[0]]
}

/// `x = integer * 2^exponent`, the integer odd unless x is zero.
fn decode(x: f64) -> (IBig, i32) {
    assert!(x.is_finite(), "{x} has no exact value");
    if x == 0.0 {
        return (IBig::ZERO, 0);
    }
    let bits = x.abs().to_bits();
    let biased = (bits >> 52) as i32;
    let fraction = bits & ((1 << 52) - 1);
    let (mantissa, exponent) =
        if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
    let even = mantissa.trailing_zeros().cast_signed();
    let integer = IBig::from(mantissa >> even);
    (if x < 0.0 { -integer } else { integer }, exponent + even)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const T: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];

    fn check(p: [f64; 3], corners: [[f64; 3]; 3], expected: &Fraction) {
        let mesh = TriMesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap();
        let lattice = Lattice::of(&[&mesh]);
        let d = point_triangle_sq(&lattice.point(p), &lattice.triangle(corners));
        let unit = lattice.length_sq(1.0);
        assert_eq!(d, expected.times(&unit), "{p:?} {corners:?}");
    }

    fn integer(x: i32) -> Fraction {
        Fraction::new(x.into(), IBig::ONE)
    }

    #[test]
    fn every_region_of_a_triangle() {
        check([0.5, 0.5, 3.0], T, &integer(9));
        check([1.0, -2.0, 0.0], T, &integer(4));
        check([-3.0, 1.0, 0.0], T, &integer(9));
        check([2.0, 2.0, 1.0], T, &integer(3));
        check([-1.0, -1.0, 1.0], T, &integer(3));
        check([4.0, -1.0, 0.0], T, &integer(5));
        check([-1.0, 4.0, 0.0], T, &integer(5));
        check([0.125, 0.125, 0.0], T, &integer(0));
        // A face that is seen at a slant: distance 1/sqrt(3) from the origin.
        check(
            [0.0; 3],
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            &Fraction::new(1.into(), 3.into()),
        );
    }

    #[test]
    fn triangles_without_area_are_segments_and_points() {
        let p = [1.0, 1.0, 0.0];
        check(p, [[0.0; 3]; 3], &integer(2));
        check(p, [[0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &integer(1));
        check(p, [[5.0, 0.0, 0.0], [5.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &integer(5));
        check(p, [[0.0; 3], [0.0, 4.0, 0.0], [0.0, 2.0, 0.0]], &integer(1));
    }

    #[test]
    fn doubles_of_any_size_are_exact() {
        for x in [0.1, -3.0, 5e-324, 1e300, f64::MIN_POSITIVE] {
            let (numerator, exponent) = decode(x);
            let back = Fraction::from_f64(x);
            assert_eq!(back, Fraction::new(numerator, IBig::ONE).times_power_of_two(exponent));
            assert!((back.square().root(0) / x.abs() - 1.0).abs() < 1e-14, "{x}");
        }
        assert!(Fraction::from_f64(0.1).plus(&Fraction::from_f64(0.2)) > Fraction::from_f64(0.3));
    }

    proptest! {
        #[test]
        fn agrees_with_rounded_arithmetic_and_no_point_of_the_triangle_is_nearer(
            p in [-1.0..1.0, -1.0..1.0, -1.0..1.0_f64],
            t in [[-1.0..1.0, -1.0..1.0, -1.0..1.0], [-1.0..1.0, -1.0..1.0, -1.0..1.0], [-1.0..1.0, -1.0..1.0, -1.0..1.0_f64]],
            weights in [0.0..1.0, 0.0..1.0, 0.01..1.0_f64],
        ) {
            let mesh = TriMesh::new(t.to_vec(), vec![[0, 1, 2]]).unwrap();
            let lattice = Lattice::of(&[&mesh]);
            let (point, triangle) = (lattice.point(p), lattice.triangle(t));
            let d = point_triangle_sq(&point, &triangle);
            let plain = crate::plain::point_triangle(p, t);
            prop_assert!((lattice.length(&d) - plain).abs() < 1e-12);
            let inside = lattice.mean(&triangle, weights);
            prop_assert!(d <= point_point_sq(&point, &inside));
            prop_assert_eq!(point_triangle_sq(&inside, &triangle), integer(0));
        }
    }
}
