//! The textbook method, another way to the same numbers.

use crate::support::{check_report, is_one_point, overlap};
use pompeiu_core::TriMesh;
use pompeiu_hausdorff::classic::CornerBound;
use pompeiu_hausdorff::{
    DirectedReport, HausdorffOptions, Method, StopReason, Tolerance, directed_hausdorff,
};
use pompeiu_testkit::cases::all;
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::plain::{point_point, point_triangles};
use pompeiu_testkit::strategies::{pair, point};
use proptest::prelude::*;

fn classic(a: &TriMesh, b: &TriMesh, tolerance: f64) -> DirectedReport {
    let options = HausdorffOptions {
        method: Method::Classic,
        tolerance: Tolerance::RelativeToDiagonal(tolerance),
        ..HausdorffOptions::default()
    };
    options.directed(a, b).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(64)))]

    #[test]
    fn both_methods_enclose_the_same_distance((a, b) in pair()) {
        let slow = classic(&a, &b, 1e-2);
        check_report(&a, &b, &slow);
        prop_assert!(slow.distance.gap() <= slow.tolerance, "{slow:?}");
        let fast = directed_hausdorff(&a, &b);
        prop_assert!(overlap(slow.distance, fast.distance, 0.0), "{slow:?} {fast:?}");
    }

    /// Both forms bound the distance of every point, and the least is not above the greatest.
    #[test]
    fn corner_bounds_hold_at_every_point(
        t in [point(), point(), point()], b in [point(), point(), point()], s in 0.0..1.0_f64, r in 0.0..1.0_f64
    ) {
        let distances = t.map(|p| point_triangles(p, &[b]));
        let (least, greatest) = (CornerBound::Least.of(&t, &distances), CornerBound::Greatest.of(&t, &distances));
        let x = [0, 1, 2].map(|k| t[0][k] + s * (1.0 - r) * (t[1][k] - t[0][k]) + s * r * (t[2][k] - t[0][k]));
        prop_assert!(point_triangles(x, &[b]) <= least + 1e-14 && least <= greatest);
        let longest = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| point_point(t[i], t[j]));
        let longest = longest.into_iter().fold(0.0, |m: f64, x| if x > m { x } else { m });
        let far = distances.into_iter().fold(0.0, |m: f64, x| if x > m { x } else { m });
        prop_assert!(greatest <= longest + far + 1e-15);
    }
}

#[test]
fn closed_forms_by_the_textbook() {
    for case in all().into_iter().filter(|c| c.a.faces().len() <= 12 && !is_one_point(&c.a, &c.b)) {
        let report = classic(&case.a, &case.b, 3e-2);
        let d = report.distance;
        assert_eq!(report.stop, StopReason::Tolerance, "{}: {report:?}", case.name);
        assert!(
            d.lower() - case.rounding <= case.a_to_b && case.a_to_b <= d.upper() + case.rounding,
            "{}: {report:?}",
            case.name
        );
        check_report(&case.a, &case.b, &report);
    }
}
