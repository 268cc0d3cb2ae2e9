//! Faces without area.

use robust::{Coord, orient2d};

/// Whether a triangle has area zero, that is, whether its corners lie on a line.
///
/// # Accuracy
/// Exact, by the signs of its three projections along the axes, unless the coordinates of this one triangle that matter
/// differ in magnitude by more than a factor 2^400.
/// # Source
/// `shewchuk_predicates_1997`, through the crate `robust`.
pub fn is_degenerate(corners: [[f64; 3]; 3]) -> bool {
    let largest = corners.iter().flatten().fold(0.0, |m: f64, x| if x.abs() > m { x.abs() } else { m });
    if largest == 0.0 {
        return true;
    }
    // Scaling by a power of two is exact and keeps the products of the predicate in range.
    let exponent = -libm::ilogb(largest);
    let scaled = corners.map(|p| p.map(|x| libm::scalbn(x, exponent)));
    [(0, 1), (1, 2), (2, 0)].into_iter().all(|(i, j)| {
        let [a, b, c] = scaled.map(|p| Coord { x: p[i], y: p[j] });
        orient2d(a, b, c) == 0.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_segments_and_collinear_corners_have_no_area() {
        let p = [0.1, 0.2, 0.3];
        assert!(is_degenerate([p, p, p]));
        assert!(is_degenerate([p, [1.0, 2.0, 4.0], p]));
        assert!(is_degenerate([[0.0; 3]; 3]));
        assert!(is_degenerate([[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [-3.0, -6.0, -9.0]]));
        assert!(!is_degenerate([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]));
        // Parallel to each coordinate plane in turn.
        for k in 0..3 {
            let on = |x: f64, y: f64| {
                let mut p = [7.0; 3];
                p[(k + 1) % 3] = x;
                p[(k + 2) % 3] = y;
                p
            };
            assert!(!is_degenerate([on(0.0, 0.0), on(1.0, 0.0), on(0.0, 1.0)]));
        }
    }

    #[test]
    fn the_answer_is_exact_where_rounded_areas_are_not() {
        // One unit in the last place off the line through (1, 1, 1), where the rounded cross product has no correct digit.
        let ulp = f64::EPSILON;
        let on = [[0.5, 0.5, 0.5], [12.0, 12.0, 12.0], [24.0, 24.0, 24.0]];
        assert!(is_degenerate(on));
        assert!(!is_degenerate([[0.5, 0.5 + ulp, 0.5], on[1], on[2]]));
        // In floating point 3 · 0.1 is not 0.3.
        let a = [0.1, 0.2, 0.3];
        assert!(!is_degenerate([[0.0; 3], a, a.map(|x| 3.0 * x)]));
        assert!(is_degenerate([[0.0; 3], a, a.map(|x| 4.0 * x)]));
    }

    #[test]
    fn scale_does_not_matter() {
        for scale in [f64::from_bits(1), 1e-300, 1e-160, 1.0, 1e160, 1e300] {
            let thin = [[0.0; 3], [scale, 0.0, 0.0], [0.0, 0.0, scale]];
            assert!(!is_degenerate(thin), "{scale:e}");
            assert!(is_degenerate([[scale; 3], [0.0; 3], [-scale; 3]]), "{scale:e}");
        }
    }
}
