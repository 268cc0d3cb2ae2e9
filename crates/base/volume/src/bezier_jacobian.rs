//! The Jacobian determinant of a tricubic cell: certificates over the whole cell, and quality.

use crate::Jacobian;
use crate::bernstein::{bernstein, bernstein_slopes};
use crate::parameter_box::{ParameterBox, greatest, least};
use glam::DVec3;

/// Largest depth of halvings along each axis; dividing a cell into eight halves it along all three.
const DEPTH: usize = 4;

/// Rounding of a Bernstein coefficient of the determinant, relative to the product of the greatest control vectors of the derivatives.
///
/// # Accuracy
/// With u = 2⁻⁵³. A coefficient is a sum of triple products of control vectors with positive weights that add up to one.
/// Differences of control points are exact to u in each component, the factors to 3 u. A triple product has six terms of at most
/// `|a| |b| |c|` with five operations each. The weights are quotients of products of small binomial coefficients, exact but for the
/// 6 operations with them. Two sums of at most 48 terms each follow one another. Together: less than 6 (3·3 + 5 + 6 + 96) u = 696
/// u. Each of at most 24 halvings takes eight means in sequence, u each: 192 u. The sum is less than 900 u, and is nearly doubled.
const ROUNDING: f64 = 1600.0 * 1.110_223_024_625_156_5e-16;

/// Degree of the determinant along each axis, and the number of its coefficients.
const N: usize = 9;

/// Binomial coefficients C(n, k) for n from 2 to 8.
fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
}

/// A tensor of coefficients with sizes along the axes, the first fastest.
#[derive(Clone)]
struct Tensor<T> {
    size: [usize; 3],
    values: Vec<T>,
}

impl<T: Copy> Tensor<T> {
    fn new(size: [usize; 3], of: impl Fn([usize; 3]) -> T) -> Self {
        let count = size.iter().product();
        let values =
            (0..count).map(|n| of([n % size[0], n / size[0] % size[1], n / size[0] / size[1]])).collect();
        Self { size, values }
    }

    /// Bernstein coefficients are scaled by binomial coefficients, so that products of polynomials become convolutions.
    fn weight(size: [usize; 3], at: [usize; 3]) -> f64 {
        (0..3).map(|axis| binomial(size[axis] - 1, at[axis])).product()
    }

    /// Keeps one half along an axis, by de Casteljau's algorithm.
    fn halve(&mut self, axis: usize, side: usize)
    where
        T: std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
    {
        let (count, stride) = (self.size[axis], self.size[..axis].iter().product::<usize>());
        for start in (0..self.values.len()).filter(|n| n / stride % count == 0) {
            for round in 1..count {
                let places = if side == 0 { round..count } else { 0..count - round };
                let mut mean = |k: usize, other: usize| {
                    let [a, b] = [k, other].map(|k| self.values[start + k * stride]);
                    self.values[start + k * stride] = (a + b) * 0.5;
                };
                if side == 0 {
                    places.rev().for_each(|k| mean(k, k - 1));
                } else {
                    places.for_each(|k| mean(k, k + 1));
                }
            }
        }
    }

    /// Values made of the old ones and their weights.
    fn mapped<U>(&self, of: impl Fn(T, f64) -> U) -> Tensor<U> {
        let values = self.places().map(|(at, value)| of(value, Self::weight(self.size, at))).collect();
        Tensor { size: self.size, values }
    }

    fn places(&self) -> impl Iterator<Item = ([usize; 3], T)> + '_ {
        let [a, b, _] = self.size;
        self.values.iter().enumerate().map(move |(n, v)| ([n % a, n / a % b, n / a / b], *v))
    }
}

fn product<A: Copy, B: Copy, C: Copy>(
    a: &Tensor<A>,
    b: &Tensor<B>,
    zero: C,
    mut add: impl FnMut(&mut C, A, B),
) -> Tensor<C> {
    let size: [usize; 3] = std::array::from_fn(|k| a.size[k] + b.size[k] - 1);
    let mut values = vec![zero; size.iter().product()];
    for ([i, j, k], x) in a.places() {
        for ([l, m, n], y) in b.places() {
            add(&mut values[i + l + size[0] * (j + m + size[1] * (k + n))], x, y);
        }
    }
    Tensor { size, values }
}

/// The Bernstein coefficients of the determinant, and the product of the greatest control vectors.
fn coefficients(points: &[DVec3; 64]) -> (Tensor<f64>, f64) {
    let mut scale = 1.0;
    let [a, b, c] = [0, 1, 2].map(|axis| {
        let slope = slope(points, axis);
        scale *= greatest(&slope.values);
        slope.mapped(|value, weight| value * weight)
    });
    let cross = product(&b, &c, DVec3::ZERO, |sum, x: DVec3, y: DVec3| *sum += x.cross(y));
    let scaled = product(&a, &cross, 0.0, |sum, x: DVec3, y: DVec3| *sum += x.dot(y));
    (scaled.mapped(|value, weight| value / weight), scale)
}

/// Whether the Jacobian determinant of the tricubic map with these control points is positive over the whole cell.
///
/// # Definition
/// The determinant is a polynomial of degree eight along each axis. It lies between the least and the greatest of its 729 Bernstein
/// coefficients; at the corners of the cell it equals the coefficient there. A cell with coefficients of both signs is divided into
/// eight.
/// # Accuracy
/// [`Jacobian::Positive`] and [`Jacobian::Folded`] hold for the control points as stored, rounding included.
/// # Cost
/// Some 15,000 products of vectors for a cell that needs no division.
/// # Source
/// `johnen_hexahedra_2017` for coefficients that bound the determinant of a hexahedron.
pub fn certify_bezier(points: &[DVec3; 64]) -> Jacobian {
    let (coefficients, scale) = coefficients(points);
    decide(&coefficients, ROUNDING * scale, DEPTH)
}

fn decide(coefficients: &Tensor<f64>, doubt: f64, depth: usize) -> Jacobian {
    let values = &coefficients.values;
    if values.iter().all(|&c| c > doubt) {
        return Jacobian::Positive;
    }
    let last = N - 1;
    let corner = |k: usize| (k & 1) * last + N * ((k >> 1 & 1) * last + N * ((k >> 2) * last));
    if (0..8).any(|k| values[corner(k)] < -doubt) {
        return Jacobian::Folded;
    }
    if depth == 0 || !values.iter().all(|c| c.is_finite()) {
        return Jacobian::Undecided;
    }
    let mut result = Jacobian::Positive;
    for part in 0..8 {
        let mut half = coefficients.clone();
        for axis in 0..3 {
            half.halve(axis, part >> axis & 1);
        }
        match decide(&half, doubt, depth - 1) {
            Jacobian::Folded => return Jacobian::Folded,
            Jacobian::Undecided => result = Jacobian::Undecided,
            Jacobian::Positive => (),
        }
    }
    result
}

/// Rounding of a control vector of a derivative, relative to the greatest one along its axis: 3 u for each component, and at most 24 halvings with
/// three means in sequence, u each. Less than 128 u for vectors of three components, doubled.
const LENGTH_ROUNDING: f64 = 256.0 * 1.110_223_024_625_156_5e-16;

/// A box of parameters of a tricubic cell.
pub(crate) struct CubicBox {
    coefficients: Tensor<f64>,
    doubt: f64,
    /// The control vectors of the derivatives.
    slopes: [Tensor<DVec3>; 3],
    /// Rounding of the length of a derivative.
    off: [f64; 3],
}

impl CubicBox {
    pub(crate) fn new(points: &[DVec3; 64]) -> Self {
        let (coefficients, scale) = coefficients(points);
        let slopes = [0, 1, 2].map(|axis| slope(points, axis));
        let off = slopes.each_ref().map(|slope| LENGTH_ROUNDING * greatest(&slope.values));
        Self { coefficients, doubt: ROUNDING * scale, slopes, off }
    }

    fn part(&self, sides: [usize; 3]) -> Self {
        let mut coefficients = self.coefficients.clone();
        let mut slopes = self.slopes.clone();
        for (axis, side) in sides.into_iter().enumerate() {
            coefficients.halve(axis, side);
            for slope in &mut slopes {
                slope.halve(axis, side);
            }
        }
        Self { coefficients, slopes, ..*self }
    }
}

impl ParameterBox for CubicBox {
    fn coefficients(&self, mut act: impl FnMut(f64, f64)) {
        let lengths =
            |axis: usize| self.slopes[axis].mapped(|v, weight| (v.length() + self.off[axis]) * weight);
        let [a, b, c] = [0, 1, 2].map(lengths);
        let add = |sum: &mut f64, x: f64, y: f64| *sum += x * y;
        let sizes = product(&a, &product(&b, &c, 0.0, add), 0.0, add);
        let sizes = sizes.mapped(|size, weight| size / weight);
        for (determinant, size) in self.coefficients.values.iter().zip(sizes.values) {
            act(determinant - self.doubt, size);
        }
    }

    fn attained(&self) -> f64 {
        let at = |k: usize| {
            let corner = |size: [usize; 3]| {
                let [i, j, l] = std::array::from_fn(|axis| (k >> axis & 1) * (size[axis] - 1));
                i + size[0] * (j + size[1] * l)
            };
            let size: f64 =
                self.slopes.iter().map(|slope| slope.values[corner(slope.size)].length()).product();
            if size > 0.0 { self.coefficients.values[corner([N; 3])] / size } else { 0.0 }
        };
        least(&std::array::from_fn::<f64, 8, _>(at))
    }

    fn divided(&self) -> [Self; 8] {
        std::array::from_fn(|k| self.part([k & 1, k >> 1 & 1, k >> 2]))
    }
}

/// The control vectors of the derivative along an axis.
fn slope(points: &[DVec3; 64], axis: usize) -> Tensor<DVec3> {
    let step = [1, 4, 16][axis];
    Tensor::new(std::array::from_fn(|k| if k == axis { 3 } else { 4 }), |[i, j, k]| {
        let at = i + 4 * (j + 4 * k);
        (points[at + step] - points[at]) * 3.0
    })
}

/// Parameters along each axis at which quality is measured.
pub const QUALITY_PLACES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// The least scaled Jacobian at the 125 points of a cell whose coordinates are multiples of a quarter: the determinant over the product
/// of the lengths of the three derivatives. 1 for a box, 0 or less where the cell is folded.
///
/// # Accuracy
/// The least over these points, not over the cell: [`scaled_jacobian_bound_bezier`](crate::scaled_jacobian_bound_bezier) is proven over the
/// whole cell.
pub fn scaled_jacobian_bezier(points: &[DVec3; 64]) -> f64 {
    let mut least = f64::INFINITY;
    for [a, b, c] in slopes_at(points, &QUALITY_PLACES.map(|t| (bernstein(t), bernstein_slopes(t)))) {
        let size = a.length() * b.length() * c.length();
        let scaled = if size > 0.0 { a.dot(b.cross(c)) / size } else { 0.0 };
        least = if scaled < least || scaled.is_nan() { scaled } else { least };
    }
    least
}

/// The derivatives along the three axes at all points of a tensor grid, the first axis fastest, by summation along one axis after
/// the other. The table holds the values and derivatives of the four basis functions at each parameter.
pub fn slopes_at(points: &[DVec3; 64], table: &[([f64; 4], [f64; 4])]) -> Vec<[DVec3; 3]> {
    let q = table.len();
    let sum = |weights: &[f64; 4], of: &dyn Fn(usize) -> DVec3| {
        of(0) * weights[0] + of(1) * weights[1] + of(2) * weights[2] + of(3) * weights[3]
    };
    // Along u, then v: values and derivatives.
    let mut along_u = vec![[DVec3::ZERO; 2]; 16 * q];
    for (jk, line) in points.chunks_exact(4).enumerate() {
        for (a, (value, slope)) in table.iter().enumerate() {
            along_u[a + q * jk] = [sum(value, &|i| line[i]), sum(slope, &|i| line[i])];
        }
    }
    let mut along_v = vec![[DVec3::ZERO; 3]; 4 * q * q];
    for k in 0..4 {
        for (b, (value, slope)) in table.iter().enumerate() {
            for a in 0..q {
                let at = |kind: usize| move |j: usize, line: &[[DVec3; 2]]| line[a + q * (j + 4 * k)][kind];
                along_v[a + q * (b + q * k)] = [
                    sum(value, &|j| at(0)(j, &along_u)),
                    sum(value, &|j| at(1)(j, &along_u)),
                    sum(slope, &|j| at(0)(j, &along_u)),
                ];
            }
        }
    }
    let mut result = Vec::with_capacity(q * q * q);
    for (value, slope) in table {
        for ab in 0..q * q {
            let at = |kind: usize, k: usize| along_v[ab + q * q * k][kind];
            result.push([sum(value, &|k| at(1, k)), sum(value, &|k| at(2, k)), sum(slope, &|k| at(0, k))]);
        }
    }
    result
}
