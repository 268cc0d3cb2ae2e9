//! Closed forms and published values.

use crate::support::{check_both, is_one_point};
use pompeiu_hausdorff::{DirectedReport, StopReason, symmetric_hausdorff};
use pompeiu_testkit::cases::{Case, all};

/// The value lies in the enclosure, but for the rounding of the value itself, and the enclosure is as narrow as asked.
#[track_caller]
fn check(name: &str, report: &DirectedReport, expected: f64, rounding: f64) {
    let (lower, upper) = (report.distance.lower(), report.distance.upper());
    assert!(
        lower - rounding <= expected && expected <= upper + rounding,
        "{name}: {expected:e} is not in [{lower:e}, {upper:e}], off by {:e}",
        if expected < lower { lower - expected } else { expected - upper }
    );
    assert_eq!(report.stop, StopReason::Tolerance, "{name}: {report:?}");
    assert!(report.distance.gap() <= report.tolerance, "{name}: {report:?}");
}

#[track_caller]
fn check_case(case: &Case) {
    let report = symmetric_hausdorff(&case.a, &case.b);
    check_both(&case.a, &case.b, &report);
    if is_one_point(&case.a, &case.b) {
        assert!(report.distance.contains(0.0));
        return;
    }
    check(&case.name, &report.a_to_b, case.a_to_b, case.rounding);
    if let Some(h) = case.b_to_a {
        check(&case.name, &report.b_to_a, h, case.rounding);
        let greater = if h > case.a_to_b { h } else { case.a_to_b };
        let both = report.distance;
        assert!(both.lower() - case.rounding <= greater && greater <= both.upper() + case.rounding);
    }
}

#[test]
fn closed_forms() {
    for case in all() {
        check_case(&case);
    }
}

#[test]
fn closed_forms_far_from_the_origin() {
    for case in all() {
        for by in [[1e6, 1e6, 1e6], [-1e9, 1e9, 0.0], [0.0, 0.0, 1e9], [3.0, -4.5, 2.0], [3e3, -7.0, 1e5]] {
            check_case(&case.translated(by));
        }
    }
}

#[test]
fn closed_forms_at_any_scale() {
    for case in all() {
        // About 1e-300, 1e-150, 1e150 and 1e300.
        for exponent in [-996, -498, 498, 993] {
            check_case(&case.scaled(exponent));
        }
    }
}

#[test]
fn the_interior_maximum_is_found_where_it_is() {
    let case = all().into_iter().find(|c| c.name == "interior maximum").unwrap();
    let witness = symmetric_hausdorff(&case.a, &case.b).a_to_b.witness.from;
    // Published with six decimals.
    let expected = [0.0, 0.250_984, 1.0];
    for k in 0..3 {
        assert!((witness.position[k] - expected[k]).abs() < 6e-7, "{witness:?}");
    }
}
