//! Cubic Bernstein polynomials in one and three variables, and Gauss points.

use glam::DVec3;

/// Points and weights of the Gauss rules on [0, 1] that are exact for polynomials of degree 7 and 9.
pub const GAUSS_4: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// See [`GAUSS_4`].
pub const GAUSS_5: [(f64, f64); 5] = [
    (0.046_910_077_030_668_0, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// The four cubic Bernstein polynomials at a parameter.
pub fn bernstein(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

/// Their derivatives.
pub fn bernstein_slopes(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t]
}

/// The Bézier coefficients of the cubic that interpolates these values at 0, 1/3, 2/3 and 1.
pub fn interpolate<T>([a, b, c, d]: [T; 4]) -> [T; 4]
where
    T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
{
    let inner = |a: T, b: T, c: T, d: T| a * (-5.0 / 6.0) + b * 3.0 + c * -1.5 + d * (1.0 / 3.0);
    [a, inner(a, b, c, d), inner(d, c, b, a), d]
}

/// The value of a tricubic polynomial at a parameter, from its 64 coefficients, the first axis fastest.
pub fn value(points: &[DVec3; 64], [u, v, w]: [f64; 3]) -> DVec3 {
    contract(points, bernstein(u), bernstein(v), bernstein(w))
}

/// Its derivatives along the three axes.
pub fn derivatives(points: &[DVec3; 64], [u, v, w]: [f64; 3]) -> [DVec3; 3] {
    let [bu, bv, bw] = [u, v, w].map(bernstein);
    [
        contract(points, bernstein_slopes(u), bv, bw),
        contract(points, bu, bernstein_slopes(v), bw),
        contract(points, bu, bv, bernstein_slopes(w)),
    ]
}

fn contract(points: &[DVec3; 64], a: [f64; 4], b: [f64; 4], c: [f64; 4]) -> DVec3 {
    let mut sum = DVec3::ZERO;
    for (layer, c) in points.chunks_exact(16).zip(c) {
        let mut plane = DVec3::ZERO;
        for (row, b) in layer.chunks_exact(4).zip(b) {
            plane += (row[0] * a[0] + row[1] * a[1] + row[2] * a[2] + row[3] * a[3]) * b;
        }
        sum += plane * c;
    }
    sum
}

/// The Bézier coefficients of the tricubic that interpolates a lattice of values at thirds.
pub fn interpolate_lattice(values: &[DVec3; 64]) -> [DVec3; 64] {
    let mut points = *values;
    for [stride, p, q] in [[1, 4, 16], [4, 1, 16], [16, 1, 4]] {
        for a in 0..4 {
            for b in 0..4 {
                let start = a * p + b * q;
                let line = interpolate([0, 1, 2, 3].map(|k| points[start + k * stride]));
                for (k, point) in line.into_iter().enumerate() {
                    points[start + k * stride] = point;
                }
            }
        }
    }
    points
}

/// The matrix that maps the coefficients over [0, 1] to those over [a, b]. Row r holds the blossoms of the four polynomials at 3 −
/// r arguments a and r arguments b.
pub(crate) fn part(a: f64, b: f64) -> [[f64; 4]; 4] {
    [[a, a, a], [a, a, b], [a, b, b], [b, b, b]].map(blossoms)
}

/// The blossoms of the four Bernstein polynomials at three arguments.
pub(crate) fn blossoms([x, y, z]: [f64; 3]) -> [f64; 4] {
    let (p, q, r) = (1.0 - x, 1.0 - y, 1.0 - z);
    [p * q * r, x * q * r + p * y * r + p * q * z, x * y * r + x * q * z + p * y * z, x * y * z]
}
