//! Bounds of the kernels against rational arithmetic: never on the wrong side, and how far they are off at worst.

use pompeiu_core::TriMesh;
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::exact::{Fraction, Lattice, Point, point_triangle_sq};
use pompeiu_verify::kernel::{Corner, Facet, between, mean, whole};
use proptest::prelude::*;

type Triangle = [[f64; 3]; 3];

fn coordinate() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![-1.0..1.0, (-4..5_i32).prop_map(|k| f64::from(k) * 0.25)]
}

fn point() -> impl Strategy<Value = [f64; 3]> + Clone {
    [coordinate(), coordinate(), coordinate()]
}

/// Triangles of any shape: needles, caps, segments and points, too, somewhere, of some size.
fn triangle() -> impl Strategy<Value = Triangle> + Clone {
    (point(), point(), point(), 0.0..1.0_f64, 0..18_i32, 0..5_u8).prop_map(|(p, q, r, t, digits, kind)| {
        let width = 10_f64.powi(-digits);
        let on = [0, 1, 2].map(|k| p[k] + t * (q[k] - p[k]));
        let beside = |s: [f64; 3]| [0, 1, 2].map(|k| s[k] + width * (r[k] - s[k]));
        match kind {
            0 => [p, q, r],
            1 => [p, q, beside(q)],
            2 => [p, q, beside(on)],
            3 => [p, beside(p), r],
            _ => [p, p, beside(p)],
        }
    })
}

/// Two triangles, the second one near the first in half of the cases, both far from the origin in some.
fn faces() -> impl Strategy<Value = (Triangle, Triangle)> {
    let away = prop_oneof![3 => Just(0.0), 1 => Just(1000.0), 1 => Just(1e6)];
    (triangle(), triangle(), 0..17_i32, any::<bool>(), away, -150..150_i32).prop_map(
        |(a, b, digits, near, away, exponent)| {
            let width = 10_f64.powi(-digits);
            let b = if near { [0, 1, 2].map(|i| [0, 1, 2].map(|k| a[i][k] + width * b[i][k])) } else { b };
            let moved = |t: Triangle| t.map(|p| p.map(|x| (x + away) * 2_f64.powi(exponent)));
            (moved(a), moved(b))
        },
    )
}

fn lattice(a: Triangle, b: Triangle) -> Lattice {
    let positions = [a, b].concat();
    Lattice::of(&[&TriMesh::new(positions, vec![[0, 1, 2], [3, 4, 5]]).unwrap()])
}

/// The largest coordinate that a bound may be measured with: of all corners, from the first one of `a`.
fn size(a: Triangle, b: Triangle) -> f64 {
    a.iter().chain(&b).flat_map(|p| [0, 1, 2].map(|k| (p[k] - a[0][k]).abs())).fold(0.0, f64::max)
}

/// Asserts that both bounds on the distance hold, and how far they are apart in units of 2^-53 of the size.
fn assert_encloses(x: &Corner, exact: &Point, a: Triangle, b: Triangle) -> f64 {
    let lattice = lattice(a, b);
    let facet = Facet::new(b, a[0]);
    let distance_sq: Fraction = point_triangle_sq(exact, &lattice.triangle(b));
    let (low, high) = (facet.at_least(x, f64::INFINITY), facet.at_most(x));
    assert!(lattice.length_sq(high) >= distance_sq, "{high:e} is no upper bound: {a:?} {b:?}");
    assert!(low <= 0.0 || lattice.length_sq(low) <= distance_sq, "{low:e} is no lower bound: {a:?} {b:?}");
    // What is added for underflow shows where all is one point.
    let unit = size(a, b) * f64::EPSILON / 2.0;
    if unit > 0.0 { (high - low.max(0.0)) / unit } else { 0.0 }
}

/// Bounds may be this far apart, in units of 2^-53 of the largest coordinate: twice what is derived for `at_most`, and for
/// `at_least` with a direction that is off by rounding.
const APART: f64 = 200.0;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(20_000)))]

    #[test]
    fn distances_of_means_are_enclosed((a, b) in faces(), weights in [0.0..1.0, 0.0..1.0, 1e-3..1.0_f64]) {
        let x = mean(a, weights).unwrap();
        let exact = lattice(a, b).mean(&lattice(a, b).triangle(a), weights);
        let apart = assert_encloses(&x, &exact, a, b);
        prop_assert!(apart < APART, "{apart}");
    }

    #[test]
    fn distances_of_corners_of_cuts_are_enclosed((a, b) in faces(), cuts in prop::collection::vec((0..3_usize, 0..3_usize, 0..1_u64 << 52), 1..12)) {
        use dashu_int::IBig;
        let one = IBig::from(1_u64 << 52);
        let mut corners = whole(a);
        let mut weights = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|w| w.map(IBig::from));
        for (to, other, t) in &cuts {
            let (p, q) = (corners[*to], corners[*other]);
            corners[*to] = between(&p, &q, *t as f64 / (1_u64 << 52) as f64);
            let sum = |w: &[IBig; 3]| &w[0] + &w[1] + &w[2];
            let (wp, wq) = (weights[*to].clone(), weights[*other].clone());
            let t = IBig::from(*t);
            weights[*to] = [0, 1, 2].map(|i| (&one - &t) * &wp[i] * sum(&wq) + &t * &wq[i] * sum(&wp));
        }
        let lattice = lattice(a, b);
        for (x, weights) in corners.iter().zip(&weights) {
            let exact = Lattice::integer_mean(&lattice.triangle(a), weights);
            let apart = assert_encloses(x, &exact, a, b);
            prop_assert!(apart < APART + 20.0 * cuts.len() as f64, "{apart}");
        }
    }
}

#[test]
fn the_radius_of_a_corner_counts_in_full() {
    let facet = Facet::new([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [0.0; 3]);
    let x = Corner { offset: [0.25, 0.25, 1.0], radius: 0.125 };
    assert!(facet.at_most(&x) >= 1.125, "the exact corner may be as far as that");
    for enough in [0.0, 0.9, f64::INFINITY] {
        assert!(facet.at_least(&x, enough) <= 0.875, "or as near as that");
    }
    let (p, q) = (x, Corner { radius: 0.25, ..x });
    assert!(between(&p, &q, 0.5).radius >= 0.1875);
}

#[test]
fn weights_that_mean_no_point_are_refused() {
    let face = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for weights in
        [[0.0; 3], [-1.0, 2.0, 0.0], [f64::NAN, 1.0, 1.0], [f64::INFINITY, 1.0, 1.0], [1e308; 3], [1e-300; 3]]
    {
        assert_eq!(mean(face, weights), None, "{weights:?}");
    }
}
