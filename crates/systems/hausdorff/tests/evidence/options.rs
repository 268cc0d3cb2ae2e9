//! Tolerances, thresholds, and what cannot be asked.

use crate::support::{check_report, is_one_point};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_hausdorff::{HausdorffOptions, OptionError, StopReason, Target, Tolerance, directed_hausdorff};
use pompeiu_testkit::cases::all;
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::strategies::pair;
use proptest::prelude::*;

/// No enclosure of meshes at the origin needs to be wider than this part of their diagonal.
const FINEST: f64 = 1e-12;

fn sphere_and_noise() -> (TriMesh, TriMesh) {
    let sphere = icosphere(1.0, 3).unwrap();
    let noisy = displace_at_random(&sphere, 0.05, 3).unwrap();
    (sphere, noisy)
}

fn diagonal(a: &TriMesh, b: &TriMesh) -> f64 {
    Aabb::of_faces(a).union(Aabb::of_faces(b)).diagonal()
}

#[test]
fn each_kind_of_tolerance_is_kept_and_reported() {
    let (a, b) = sphere_and_noise();
    let exact = directed_hausdorff(&a, &b).distance;
    let diagonal = diagonal(&a, &b);
    for x in [1e-1, 1e-3, 1e-6, 1e-9, 3e-12] {
        for (tolerance, least, most) in [
            (Tolerance::Absolute(x), x, x),
            (Tolerance::RelativeToDiagonal(x), x * diagonal, x * diagonal),
            (Tolerance::RelativeToDistance(x), x * exact.lower() * (1.0 - x), x * exact.upper()),
        ] {
            let report =
                HausdorffOptions { tolerance, ..HausdorffOptions::default() }.directed(&a, &b).unwrap();
            check_report(&a, &b, &report);
            let allowed = report.tolerance;
            assert!(
                least * (1.0 - 1e-14) <= allowed && allowed <= most * (1.0 + 1e-14),
                "{tolerance:?} {allowed}"
            );
            // A part of the distance can be finer than doubles are.
            if report.stop == StopReason::Rounding {
                assert!(
                    allowed < FINEST * diagonal && report.distance.gap() <= FINEST * diagonal,
                    "{report:?}"
                );
            } else {
                assert_eq!(report.stop, StopReason::Tolerance);
                assert!(report.distance.gap() <= allowed);
            }
            assert!(crate::support::overlap(report.distance, exact, 0.0));
        }
    }
}

#[test]
fn a_tolerance_of_zero_ends_where_doubles_do() {
    let (a, b) = sphere_and_noise();
    for (a, b) in [(&a, &b), (&b, &a), (&a, &a)] {
        for tolerance in [
            Tolerance::Absolute(0.0),
            Tolerance::RelativeToDiagonal(0.0),
            Tolerance::RelativeToDistance(0.0),
            Tolerance::Absolute(1e-300),
        ] {
            let report =
                HausdorffOptions { tolerance, ..HausdorffOptions::default() }.directed(a, b).unwrap();
            check_report(a, b, &report);
            assert_eq!(report.stop, StopReason::Rounding, "{tolerance:?} {report:?}");
            assert!(report.distance.gap() <= FINEST * diagonal(a, b), "{tolerance:?} {report:?}");
        }
    }
}

#[test]
fn coarser_tolerances_cost_less() {
    let (a, b) = sphere_and_noise();
    let work = |x| {
        let query =
            HausdorffOptions { tolerance: Tolerance::RelativeToDiagonal(x), ..HausdorffOptions::default() };
        query.directed(&a, &b).unwrap().work.pieces
    };
    assert!(
        work(0.5) <= work(1e-2) && work(1e-2) < work(1e-12),
        "{} {} {}",
        work(0.5),
        work(1e-2),
        work(1e-12)
    );
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let refused = |options: HausdorffOptions<'_>| {
        let triangle = TriMesh::new(vec![[0.0; 3]], vec![[0, 0, 0]]).unwrap();
        let refused = options.check().unwrap_err();
        // What is NaN does not equal itself.
        let same = |other: OptionError| format!("{other:?}") == format!("{refused:?}");
        assert!(options.directed(&triangle, &triangle).is_err_and(same));
        assert!(options.symmetric(&triangle, &triangle).is_err_and(same));
        assert!(options.directed_to(&triangle, &Target::new(&triangle)).is_err_and(same));
        refused
    };
    let staged =
        |stages: &[f64]| refused(HausdorffOptions { stages: stages.to_vec(), ..HausdorffOptions::default() });
    for x in [-1.0, f64::NAN, f64::INFINITY] {
        let tolerance = Tolerance::Absolute(x);
        let options = HausdorffOptions { tolerance, ..HausdorffOptions::default() };
        assert!(matches!(refused(options), OptionError::Tolerance(_)));
        let options = HausdorffOptions { threshold: Some(x), ..HausdorffOptions::default() };
        assert!(matches!(refused(options), OptionError::Threshold(_)));
        assert!(matches!(staged(&[x]), OptionError::Stage { index: 0, .. }));
    }
    assert!(matches!(staged(&[0.1, 0.1]), OptionError::Stage { index: 1, .. }));
    assert!(matches!(staged(&[0.1, 0.0]), OptionError::Stage { index: 1, .. }));
}

/// The answer to "at most this?", as the enclosure gives it.
#[derive(Debug, PartialEq)]
enum Answer {
    Yes,
    No,
    Undecided,
}

fn ask(a: &TriMesh, b: &TriMesh, threshold: f64) -> Answer {
    let report = HausdorffOptions { threshold: Some(threshold), ..HausdorffOptions::default() }
        .directed(a, b)
        .unwrap();
    check_report(a, b, &report);
    let answer = if report.distance.upper() <= threshold {
        Answer::Yes
    } else if report.distance.lower() > threshold {
        Answer::No
    } else {
        Answer::Undecided
    };
    let decided = matches!(report.stop, StopReason::Threshold | StopReason::Tolerance);
    assert!(decided || answer == Answer::Undecided, "{report:?}");
    assert!(report.stop != StopReason::Threshold || answer != Answer::Undecided, "{report:?}");
    answer
}

#[test]
fn a_threshold_is_decided_on_either_side_and_never_wrongly_at_equality() {
    for case in all().into_iter().filter(|c| !is_one_point(&c.a, &c.b)) {
        let (a, b, h) = (&case.a, &case.b, case.a_to_b);
        // As near as the enclosure and the rounding of the value allow.
        let near = 2.0 * (1e-12 * diagonal(a, b) + case.rounding);
        assert_eq!(ask(a, b, h + near), Answer::Yes, "{}", case.name);
        assert_eq!(ask(a, b, 2.0 * h + near), Answer::Yes, "{}", case.name);
        if h > near {
            assert_eq!(ask(a, b, h - near), Answer::No, "{}", case.name);
            assert_eq!(ask(a, b, 0.5 * h), Answer::No, "{}", case.name);
            assert_eq!(ask(a, b, 0.0), Answer::No, "{}", case.name);
        }
        // Where the value is exact, "no" would be wrong; "yes" needs an upper bound that is exact too.
        if h == 0.5 || h == 1.0 || h == 0.0 {
            assert_ne!(ask(a, b, h), Answer::No, "{}", case.name);
        }
    }
}

#[test]
fn a_threshold_far_from_the_distance_is_decided_early() {
    let (a, b) = sphere_and_noise();
    let full = directed_hausdorff(&a, &b);
    let work = |factor: f64| {
        let report = HausdorffOptions {
            threshold: Some(factor * full.distance.upper()),
            ..HausdorffOptions::default()
        }
        .directed(&a, &b)
        .unwrap();
        assert_eq!(report.stop, StopReason::Threshold, "{factor}");
        report.work.distances
    };
    assert!(
        2 * work(2.0) < full.work.distances && 2 * work(0.5) < full.work.distances,
        "{} {} {full:?}",
        work(2.0),
        work(0.5)
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(96)))]

    #[test]
    fn thresholds_agree_with_the_distance((a, b) in pair(), factor in prop_oneof![0.0..2.0_f64, Just(1.0), 1.0..1.000_001_f64]) {
        let d = directed_hausdorff(&a, &b).distance;
        let threshold = factor * d.lower();
        match ask(&a, &b, threshold) {
            Answer::Yes => prop_assert!(d.lower() <= threshold),
            Answer::No => prop_assert!(d.upper() > threshold),
            Answer::Undecided => prop_assert!(d.lower() - d.gap() <= threshold && threshold <= d.upper() + d.gap()),
        }
    }
}
