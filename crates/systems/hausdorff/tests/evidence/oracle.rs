//! Small random meshes against an exact oracle that shares no code with the engine.

use crate::support::{check_report, is_one_point};
use pompeiu_core::TriMesh;
use pompeiu_hausdorff::{DirectedReport, directed_hausdorff};
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::oracle::directed;
use pompeiu_testkit::strategies::{pair, scaled};
use proptest::prelude::*;

/// Triangles that the oracle splits: ends most searches with 13 digits.
const SPLITS: usize = 600;

fn check(a: &TriMesh, b: &TriMesh, report: &DirectedReport) -> Result<(), TestCaseError> {
    let oracle = directed(a, b, SPLITS);
    let distance = report.distance;
    prop_assert!(oracle.allows_upper(distance.upper()), "{:?} {distance:?}", oracle.rounded());
    prop_assert!(oracle.allows_lower(distance.lower()), "{:?} {distance:?}", oracle.rounded());
    check_report(a, b, report);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(192)))]

    #[test]
    fn the_enclosure_holds_the_distance_and_is_as_narrow_as_asked((a, b) in pair()) {
        let report = directed_hausdorff(&a, &b);
        prop_assert!(report.distance.gap() <= report.tolerance || is_one_point(&a, &b), "{report:?}");
        check(&a, &b, &report)?;
    }

    #[test]
    fn at_extreme_scales_too((a, b) in pair(), exponent in prop_oneof![-1040..-990_i32, -520..-480_i32, 480..520_i32, 970..988_i32]) {
        let (Some(a), Some(b)) = (scaled(&a, exponent), scaled(&b, exponent)) else { return Ok(()) };
        check(&a, &b, &directed_hausdorff(&a, &b))?;
    }
}

#[test]
fn the_oracle_is_narrow_on_ordinary_soups() {
    use pompeiu_testkit::strategies::soup;
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let mut narrow = 0;
    for _ in 0..40 {
        let mut mesh = || soup(12).new_tree(&mut runner).unwrap().current();
        let (lower, upper) = directed(&mesh(), &mesh(), SPLITS).rounded();
        narrow += usize::from(upper - lower <= 1e-11);
    }
    assert!(narrow >= 30, "{narrow} of 40");
}
