//! Small inputs on which the maximum is attained along a line, or many faces are nearly equally far: pieces must not become many.

use crate::pairs::load_from;
use crate::support::check_report;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::{Affine, transform};
use pompeiu_hausdorff::{DirectedReport, HausdorffOptions, Observer, Progress, StopReason};
use proptest::prelude::*;
use std::ops::ControlFlow;

/// Pieces that a pair of a few dozen faces may take. Of a million random ones the worst took half of it; before pieces were
/// cut where faces are equally far, some took millions.
const MOST_PIECES: u64 = 10_000;

/// Ends a search that takes many more.
struct Patience;

impl Observer for Patience {
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        if progress.examined > 10 * MOST_PIECES { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

fn search(a: &TriMesh, b: &TriMesh) -> DirectedReport {
    let options = HausdorffOptions { observer: Some(&Patience), ..HausdorffOptions::default() };
    options.directed(a, b).unwrap()
}

fn check(a: &TriMesh, b: &TriMesh) {
    let report = search(a, b);
    check_report(a, b, &report);
    assert!(matches!(report.stop, StopReason::Tolerance | StopReason::Rounding), "{report:?}");
    assert!(report.work.pieces <= MOST_PIECES, "{report:?}");
}

type Triangle = [[f64; 3]; 3];

fn soup(triangles: &[Triangle]) -> TriMesh {
    let faces = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    TriMesh::new(triangles.concat(), faces).unwrap()
}

/// Coordinates that often coincide.
fn coordinate() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![-1.0..1.0, (-4..5_i32).prop_map(|k| f64::from(k) * 0.25)]
}

fn triangle(height: impl Strategy<Value = f64> + Clone + 'static) -> impl Strategy<Value = Triangle> {
    let corner = (coordinate(), coordinate(), height).prop_map(|(x, y, z)| [x, y, z]);
    [corner.clone(), corner.clone(), corner]
}

/// Strips along y over a polyline: distances do not depend on y, and maxima are lines.
fn extruded() -> impl Strategy<Value = (Vec<Triangle>, Vec<Triangle>)> {
    let profile = prop::collection::vec((coordinate(), coordinate()), 3..7);
    let a = ((coordinate(), coordinate()), (coordinate(), coordinate()), 0.0..1.0, 0.3..1.3);
    (a, profile).prop_map(|((p, q, top, end), profile)| {
        let strips = profile.windows(2).flat_map(|w| {
            let at = |(x, z): (f64, f64), y: f64| [x, y, z];
            let (s, t) = (w[0], w[1]);
            [[at(s, -2.0), at(t, -2.0), at(t, 3.0)], [at(s, -2.0), at(t, 3.0), at(s, 3.0)]]
        });
        (vec![[[p.0, 0.0, p.1], [p.0, top, p.1], [q.0, end, q.1]]], strips.collect())
    })
}

/// Triangles in three parallel planes that nearly touch.
fn sheets() -> impl Strategy<Value = (Vec<Triangle>, Vec<Triangle>)> {
    (3..12_i32).prop_flat_map(|digits| {
        let gap = 10.0_f64.powi(-digits);
        let height = (0..3_i32).prop_map(move |k| f64::from(k) * gap);
        let leaning = prop::collection::vec(triangle(height.clone()), 1..3);
        let flat = height.prop_flat_map(|z| triangle(Just(z)));
        (leaning, prop::collection::vec(flat, 2..7))
    })
}

/// Triangles anywhere.
fn soups() -> impl Strategy<Value = (Vec<Triangle>, Vec<Triangle>)> {
    let some = |count| prop::collection::vec(triangle(coordinate()), 1..count);
    (some(4), some(7))
}

/// As they are, or turned and shifted, so that nothing is aligned with the axes.
fn moved() -> impl Strategy<Value = Affine> {
    let turned =
        ([-1.0..1.0, -1.0..1.0, 0.1..1.0], 0.0..180.0, [-50.0..50.0, -50.0..50.0, -50.0..50.0]).prop_map(
            |(axis, degrees, translation)| Affine { translation, ..Affine::rotate(axis, degrees).unwrap() },
        );
    prop_oneof![Just(Affine::translate([0.0; 3])), turned]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn few_pieces_where_the_maximum_is_a_line((a, b) in extruded(), by in moved()) {
        check(&transform(&soup(&a), &by).unwrap(), &transform(&soup(&b), &by).unwrap());
    }

    #[test]
    fn few_pieces_between_thin_sheets((a, b) in sheets(), by in moved()) {
        check(&transform(&soup(&a), &by).unwrap(), &transform(&soup(&b), &by).unwrap());
    }

    #[test]
    fn few_pieces_in_soups((a, b) in soups(), by in moved()) {
        check(&transform(&soup(&a), &by).unwrap(), &transform(&soup(&b), &by).unwrap());
    }
}

/// Pairs that a search for such inputs found.
#[test]
fn pairs_that_were_hard() {
    for name in ["min146", "min54", "s300150", "s5000146", "s7002879", "s70054", "s80981"] {
        let Some((a, b)) = load_from(&format!("hard/{name}_a.obj"), &format!("hard/{name}_b.obj")) else {
            continue;
        };
        for (a, b) in [(&a, &b), (&b, &a)] {
            let report = search(a, b);
            assert_eq!(report.stop, StopReason::Tolerance, "{name} {report:?}");
            assert!(report.work.pieces <= MOST_PIECES, "{name} {report:?}");
        }
    }
}
