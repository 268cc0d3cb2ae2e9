//! Limits end a search with a wider enclosure, never with a wrong one.

use crate::support::{check_both, check_report, overlap, same};
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::{icosphere, torus};
use pompeiu_hausdorff::{
    DirectedReport, Method, Observer, Progress, Query, StopReason, Target, directed_hausdorff,
};
use pompeiu_testkit::cases::all;
use std::ops::ControlFlow;
use std::time::Duration;

/// More than one round of the sweep, and a search after it.
fn large_pair() -> (TriMesh, TriMesh) {
    let fine = icosphere(1.0, 5).unwrap();
    (
        displace_at_random(&fine, 0.02, 1).unwrap(),
        displace_at_random(&icosphere(1.0, 3).unwrap(), 0.02, 2).unwrap(),
    )
}

#[track_caller]
fn check_stopped(
    a: &TriMesh,
    b: &TriMesh,
    report: &DirectedReport,
    full: &DirectedReport,
    reason: StopReason,
) {
    check_report(a, b, report);
    assert!(overlap(report.distance, full.distance, 0.0), "{report:?} {full:?}");
    if report.stop != reason {
        assert!(same(report, full), "{report:?} {full:?}");
    }
}

#[test]
fn no_time_at_all() {
    for case in all() {
        for method in [Method::Fast, Method::Classic] {
            let query = Query::new().method(method).time_limit(Duration::ZERO);
            let report = query.symmetric(&case.a, &case.b);
            check_both(&case.a, &case.b, &report);
            assert_eq!(
                (report.a_to_b.stop, report.b_to_a.stop),
                (StopReason::Time, StopReason::Time),
                "{}",
                case.name
            );
            let d = report.a_to_b.distance;
            assert!(
                d.lower() - case.rounding <= case.a_to_b && case.a_to_b <= d.upper() + case.rounding,
                "{}",
                case.name
            );
        }
    }
}

#[test]
fn little_time() {
    let (a, b) = large_pair();
    let full = directed_hausdorff(&a, &b);
    let target = Target::new(&b);
    for microseconds in [1, 100, 1000, 3000, 10_000, 30_000, 60_000_000] {
        let query = Query::new().time_limit(Duration::from_micros(microseconds));
        check_stopped(&a, &b, &query.directed(&a, &b), &full, StopReason::Time);
        check_stopped(&a, &b, &query.directed_to(&a, &target), &full, StopReason::Time);
    }
    assert!(same(&Query::new().time_limit(Duration::MAX).directed(&a, &b), &full));
}

#[test]
fn from_no_memory_to_plenty() {
    let a = displace_at_random(&torus(1.0, 0.3, 40, 40).unwrap(), 0.01, 4).unwrap();
    let b = torus(1.0, 0.3, 30, 30).unwrap();
    let full = directed_hausdorff(&a, &b);
    let mut stopped = 0;
    let mut widest = f64::INFINITY;
    for bytes in (0..10).map(|i| i * 40_000).chain((0..40).map(|i| 400_000 + i * 20_000)) {
        let report = Query::new().memory_limit(bytes).directed(&a, &b);
        check_stopped(&a, &b, &report, &full, StopReason::Memory);
        stopped += usize::from(report.stop == StopReason::Memory);
        if bytes == 0 {
            assert_eq!(report.stop, StopReason::Memory);
            widest = report.distance.gap();
        }
        assert!(report.distance.gap() <= widest, "{bytes} {report:?}");
    }
    assert!((2..50).contains(&stopped), "{stopped}");
    assert!(same(&Query::new().memory_limit(1 << 30).directed(&a, &b), &full));
    assert!(same(
        &Query::new().memory_limit(usize::MAX).directed_to(&a, &Target::new(&b)),
        &Query::new().directed_to(&a, &Target::new(&b))
    ));
}

/// With the target given, there is always room to start; what the limit leaves for pieces may be nothing.
#[test]
fn no_memory_for_pieces() {
    let a = displace_at_random(&torus(1.0, 0.3, 40, 40).unwrap(), 0.01, 4).unwrap();
    let b = torus(1.0, 0.3, 30, 30).unwrap();
    let target = Target::new(&b);
    let full = Query::new().directed_to(&a, &target);
    let report = Query::new().memory_limit(0).directed_to(&a, &target);
    assert_eq!(report.stop, StopReason::Memory);
    assert!(report.distance.gap() > full.distance.gap());
    check_stopped(&a, &b, &report, &full, StopReason::Memory);
}

#[test]
fn no_memory_still_encloses_every_closed_form() {
    for case in all() {
        let report = Query::new().memory_limit(0).symmetric(&case.a, &case.b);
        check_both(&case.a, &case.b, &report);
        for (report, h) in [(&report.a_to_b, Some(case.a_to_b)), (&report.b_to_a, case.b_to_a)] {
            let (Some(h), d) = (h, report.distance) else { continue };
            assert!(
                d.lower() - case.rounding <= h && h <= d.upper() + case.rounding,
                "{} {report:?}",
                case.name
            );
            assert!(matches!(report.stop, StopReason::Memory | StopReason::Tolerance), "{report:?}");
        }
    }
}

struct CancelAt {
    call: usize,
    calls: usize,
}

impl Observer for CancelAt {
    fn progress(&mut self, progress: &Progress) -> ControlFlow<()> {
        assert!(progress.lower <= progress.upper && progress.upper.is_finite(), "{progress:?}");
        self.calls += 1;
        if self.calls > self.call { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn cancelling_at_any_call() {
    let (a, b) = large_pair();
    for method in [Method::Fast, Method::Classic] {
        // The textbook method is slow: fewer faces.
        let (a, b) = match method {
            Method::Fast => (&a, &b),
            Method::Classic => (
                &icosphere(1.0, 2).unwrap(),
                &displace_at_random(&icosphere(1.0, 1).unwrap(), 0.1, 1).unwrap(),
            ),
        };
        let query = Query::new().method(method);
        let query = if method == Method::Classic {
            query.tolerance(pompeiu_hausdorff::Tolerance::RelativeToDiagonal(1e-3)).unwrap()
        } else {
            query
        };
        let mut counting = CancelAt { call: usize::MAX, calls: 0 };
        let full = query.directed_observed(a, b, &mut counting);
        let calls = counting.calls;
        assert!(calls >= 3, "{method:?}: {calls} calls");
        let mut gap = f64::INFINITY;
        for call in 0..=calls {
            let mut observer = CancelAt { call, calls: 0 };
            let report = query.directed_observed(a, b, &mut observer);
            check_stopped(a, b, &report, &full, StopReason::Cancelled);
            assert_eq!(report.stop == StopReason::Cancelled, call < calls, "{call} of {calls} {report:?}");
            assert!(report.distance.gap() <= gap, "{call} {gap} {report:?}");
            gap = report.distance.gap();
        }
    }
}
