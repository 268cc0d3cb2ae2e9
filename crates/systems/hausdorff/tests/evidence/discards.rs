//! Every discard, checked again from nothing but what it says.

use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::{Diagonal, cube, grid, point_lattice, torus};
use pompeiu_core::mesh::{Affine, transform};
use pompeiu_core::{FaceId, TriMesh};
use pompeiu_hausdorff::{Discard, HausdorffOptions, Observer, Proof, StopReason};
use pompeiu_testkit::cases::all;
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::exact::{Fraction, Lattice, point_triangle_sq};
use pompeiu_testkit::plain::area;
use pompeiu_testkit::strategies::pair;
use proptest::prelude::*;
use std::sync::Mutex;

#[derive(Default)]
struct Discards(Mutex<Vec<Discard>>);

impl Observer for Discards {
    fn wants_discards(&self) -> bool {
        true
    }

    fn discard(&self, discard: &Discard) {
        self.0.lock().unwrap().push(discard.clone());
    }
}

/// A mixture of exact roots is evaluated in doubles: eight products and sums, and roots off by `2^-50`.
const MIXTURE: f64 = 1e-14;
/// Areas of pieces and their sums, relative to the longest edge squared; each piece adds its own rounding.
const AREA: f64 = 1e-14;
/// Corners of pieces are rounded to the coordinates of the mesh, relative to the largest of them: cuts round, and so does
/// the way back from a frame with a shifted origin.
const CORNER: f64 = 1e-14;
/// How far a bound may be missed because of the latter, relative to the largest coordinate.
const SHIFTED: f64 = f64::EPSILON;

/// The frame is that of B; its origin is shifted, and corners are shown rounded, where B lies far from zero for its size.
fn shift(b: &TriMesh, size: f64) -> f64 {
    const NEAR: f64 = 3.5;
    let aabb = Aabb::of_faces(b);
    if aabb.max_coordinate() > NEAR * aabb.diagonal() / 3.0_f64.sqrt() { SHIFTED * size } else { 0.0 }
}

/// Barycentric coordinates of points all over a triangle, by a sequence of low discrepancy.
fn spread_points() -> impl Iterator<Item = (f64, f64)> {
    (1..25).map(|i| {
        let (s, t) = ((f64::from(i) * 0.754_877_666).fract(), (f64::from(i) * 0.569_840_291).fract());
        if s + t < 1.0 { (s, t) } else { (1.0 - s, 1.0 - t) }
    })
}

pub(crate) fn check(a: &TriMesh, b: &TriMesh) -> usize {
    let seen = Discards::default();
    let options = HausdorffOptions { observer: Some(&seen), ..HausdorffOptions::default() };
    let report = options.directed(a, b).unwrap();
    let seen = seen.0.into_inner().unwrap();
    assert!(matches!(report.stop, StopReason::Tolerance | StopReason::Rounding), "{report:?}");
    let corners: Vec<_> = seen.iter().flat_map(|d| d.corners).collect();
    let lattice = Lattice::of(&[a, b]).with(&corners);
    let exact_b: Vec<_> =
        (0..b.faces().len() as u32).map(|f| lattice.triangle(b.corners(FaceId(f)))).collect();
    let size = crate::support::largest_coordinate(&[a, b]);
    let mut areas = vec![0.0; a.faces().len()];
    let mut pieces = vec![Vec::new(); a.faces().len()];
    let mut mixtures = 0;
    let shift = shift(b, size);
    for discard in &seen {
        assert!(discard.bound <= report.distance.upper(), "{discard:?} {report:?}");
        for corner in discard.corners {
            let x = lattice.point(corner);
            match &discard.proof {
                Proof::Face(face) => {
                    let d = point_triangle_sq(&x, &exact_b[face.index()]);
                    assert!(
                        d <= lattice.length_sq(discard.bound + shift),
                        "{} {discard:?}",
                        lattice.length(&d)
                    );
                }
                Proof::Mixture(rows) => {
                    assert!(!rows.is_empty() && rows.iter().all(|(_, w)| *w > 0.0), "{discard:?}");
                    let total: f64 = rows.iter().map(|(_, w)| w).sum();
                    let distance =
                        |face: &FaceId| lattice.length(&point_triangle_sq(&x, &exact_b[face.index()]));
                    let mean: f64 = rows.iter().map(|(face, w)| w / total * distance(face)).sum();
                    assert!(mean <= discard.bound * (1.0 + MIXTURE) + shift, "{mean:e} {discard:?}");
                    mixtures += 1;
                }
            }
            let off = lattice.length(&point_triangle_sq(&x, &lattice.triangle(a.corners(discard.face))));
            assert!(off <= CORNER * size, "a corner lies {off:e} outside its face: {discard:?}");
        }
        areas[discard.face.index()] += area(discard.corners);
        pieces[discard.face.index()].push(discard.corners);
    }
    for f in 0..a.faces().len() {
        let corners = a.corners(FaceId(f as u32));
        assert!(!pieces[f].is_empty(), "face {f} was never discarded");
        let slack = AREA * size * size * (1.0 + pieces[f].len() as f64);
        // Pieces may overlap, so areas alone could hide a gap: points of the face lie in its pieces.
        assert!(areas[f] >= area(corners) - slack, "face {f}: {} of {}", areas[f], area(corners));
        for (s, t) in spread_points() {
            let x = [0, 1, 2].map(|k| {
                corners[0][k] + s * (corners[1][k] - corners[0][k]) + t * (corners[2][k] - corners[0][k])
            });
            let near = lattice.length_sq(4.0 * CORNER * size);
            let x = lattice.point(x);
            let mut holding =
                pieces[f].iter().filter(|t| point_triangle_sq(&x, &lattice.triangle(**t)) <= near);
            assert!(holding.next().is_some(), "point {s} {t} of face {f} is lost");
        }
    }
    // The upper bound is that of a discard, or of a piece too small to cut.
    let largest = seen.iter().fold(Fraction::from_f64(0.0), |m, d| m.max(Fraction::from_f64(d.bound)));
    assert!(largest <= Fraction::from_f64(report.distance.upper()));
    mixtures
}

#[test]
fn closed_forms_at_and_far_from_the_origin() {
    for case in all() {
        check(&case.a, &case.b);
        check(&case.b, &case.a);
        check(&case.scaled(-996).a, &case.scaled(-996).b);
        let far = case.translated([3e3, -7.0, 1e5]);
        check(&far.a, &far.b);
    }
}

#[test]
fn searches_with_cuts_and_mixtures() {
    let ring = torus(1.0, 0.3, 16, 10).unwrap();
    let noisy = displace_at_random(&ring, 0.05, 3).unwrap();
    check(&noisy, &ring);
    check(&ring, &noisy);
    let notch = all().into_iter().find(|c| c.name.contains("notch of half-width 2")).unwrap();
    check(&notch.a, &notch.b);
    let square = grid([1.0, 1.0], [3, 3], Diagonal::Alternating).unwrap();
    assert!(check(&square, &point_lattice(1.0, 5).unwrap()) > 100);
    let turn = Affine::rotate([1.0, 2.0, 3.0], 33.0).unwrap();
    let turned = |m: &TriMesh| transform(m, &turn).unwrap();
    let (coarse, fine) = (turned(&cube(1.0, 1).unwrap()), turned(&cube(1.0, 7).unwrap()));
    check(&coarse, &fine);
    check(&fine, &coarse);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(96)))]

    #[test]
    fn random_meshes((a, b) in pair()) {
        check(&a, &b);
    }
}
