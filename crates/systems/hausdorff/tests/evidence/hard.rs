//! Small inputs on which the maximum is attained along a line, or many faces are nearly equally far: pieces must not become many.

use crate::pairs::load_from;
use crate::support::check_report;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::{Affine, transform};
use pompeiu_hausdorff::{DirectedReport, HausdorffOptions, Observer, Progress, StopReason};
use proptest::prelude::*;
use std::ops::ControlFlow;

/// Pieces that a pair of a few dozen faces may take. Of nine million random ones the worst took a quarter of it; before pieces were
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

/// Cuts along bisectors once followed the rounding of feet that are 1e-11 away, and 130,512 pieces were cut into needles.
#[test]
#[expect(clippy::unreadable_literal, reason = "digits as they were found")]
fn a_bisector_of_sheets_that_nearly_touch() {
    let a: [Triangle; 1] = [[
        [-0.5388733369304137, 0.0, 1e-10],
        [-0.25, 0.3198934796500089, 1e-10],
        [-0.2153847866860168, -0.25, 2e-10],
    ]];
    let b: [Triangle; 4] = [
        [
            [-0.48593011416089626, -0.16778150303190412, 2e-10],
            [-0.5102073601513372, 0.294759677740889, 2e-10],
            [0.5246682285567854, -0.7029440123404692, 2e-10],
        ],
        [
            [-0.12152248278328726, -0.25, 1e-10],
            [-0.5, -0.12951433299267442, 1e-10],
            [0.637414726256282, 0.0, 1e-10],
        ],
        [
            [-0.75, -0.4608288552597585, 1e-10],
            [-0.7724902059193154, 0.8786444345292138, 1e-10],
            [0.01628110930972717, 0.106425191188187, 1e-10],
        ],
        [[1.0, 0.5, 0.0], [-0.5, 0.5, 0.0], [0.75, -0.8026975160675712, 0.0]],
    ];
    let report = search(&soup(&a), &soup(&b));
    assert!(report.work.pieces <= 100, "{report:?}");
}

/// Cuts along bisectors once left nearly the whole of a needle, 25 times in a row: 9,404 pieces.
#[test]
#[expect(clippy::unreadable_literal, reason = "digits as they were found")]
fn a_bisector_beside_a_kink() {
    let a: [Triangle; 1] = [[
        [-31.116921027055817, -21.228364732775365, 46.7567744577532],
        [-29.97729180859243, -20.80088753841183, 45.89175227247743],
        [-30.824724537146118, -21.613035332386772, 45.85583347171798],
    ]];
    let b: [Triangle; 5] = [
        [
            [-30.690344187367547, -22.876657724278736, 46.492615535258835],
            [-29.551524201901817, -21.112768418648766, 46.05495408790479],
            [-30.083944240692066, -22.717493709258093, 46.68814261920748],
        ],
        [
            [-31.009620193088598, -21.437144843523534, 46.99383363509338],
            [-29.857753672214482, -21.364611961277287, 46.98484109985209],
            [-30.609588407524875, -22.235068594526563, 46.26588754289725],
        ],
        [
            [-30.012487204781966, -21.762391881891666, 46.83800281028758],
            [-30.45862723448122, -20.940323212747714, 46.2344840726675],
            [-29.663430550854095, -21.705466353947127, 47.4840963391645],
        ],
        [
            [-31.270002957140445, -21.723492454300864, 46.272607550415714],
            [-30.53848392517781, -21.06838332888285, 46.43806962061877],
            [-30.929939709543888, -21.864819230698984, 47.32063168696424],
        ],
        [
            [-30.32918047441157, -21.387023331975282, 46.70737026542045],
            [-29.533270313422534, -21.991196029917944, 46.004630638507294],
            [-30.12198210422425, -22.41379667339652, 46.82167343981864],
        ],
    ];
    let report = search(&soup(&a), &soup(&b));
    assert!(report.work.pieces <= 100, "{report:?}");
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
