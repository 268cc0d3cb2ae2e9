//! Sums of products with twice the digits of doubles.
//!
//! # Source
//! `ogita_accurate_2005`.

use glam::DVec3;

/// Splits a double into two of half the digits (Veltkamp).
const SPLITTER: f64 = 134_217_729.0;

/// `a + b` and what rounding leaves out.
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

fn split(a: f64) -> (f64, f64) {
    let scaled = SPLITTER * a;
    let high = scaled - (scaled - a);
    (high, a - high)
}

/// `a b` and what rounding leaves out.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    (product, al * bl - (((product - ah * bh) - al * bh) - ah * bl))
}

/// The sum of points with weights, each a double and what its rounding left out, as accurate as if computed with twice the digits and
/// rounded then. Where that overflows: the plain sum.
pub(crate) fn weighted_sum(weights: &[f64; 4], left_out: &[f64; 4], x: &[DVec3; 4]) -> DVec3 {
    let of = |axis: usize| {
        let (mut sum, mut rest, mut plain) = (0.0, 0.0, 0.0);
        for i in 0..4 {
            let (product, lost) = two_product(weights[i], x[i][axis]);
            let (next, error) = two_sum(sum, product);
            sum = next;
            rest += error + lost + left_out[i] * x[i][axis];
            plain += product;
        }
        let precise = sum + rest;
        if precise.is_finite() { precise } else { plain }
    };
    DVec3::new(of(0), of(1), of(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cancels_in_doubles_is_there() {
        // 1/3 and 2/3 are not doubles, and the sum is far below the rounding of its terms.
        let third = 1.0 / 3.0;
        let (rest, lost) = two_sum(1.0, -third);
        let weights = [1.0, -rest, -third, 0.0];
        let x = [DVec3::splat(1.0 + 1e-12), DVec3::ONE, DVec3::ONE, DVec3::ZERO];
        let found = weighted_sum(&weights, &[0.0, -lost, 0.0, 0.0], &x);
        // The double nearest to 1 + 1e-12 is 4504 units of 2⁻⁵² above 1.
        assert_eq!(found, DVec3::splat(4504.0 / (1_u64 << 52) as f64));
        assert!(weighted_sum(&[1e300; 4], &[0.0; 4], &[DVec3::splat(1e-300); 4]).is_finite());
    }
}
