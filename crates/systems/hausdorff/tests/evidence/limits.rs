//! Limits end a search with a wider enclosure, never with a wrong one.

use crate::support::{check_both, check_report, overlap, same};
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::{Diagonal, grid, icosphere, point_lattice, torus};
use pompeiu_core::run::{CancelToken, Limits};
use pompeiu_hausdorff::{
    DirectedReport, Direction, HausdorffOptions, Method, Observer, Progress, StopReason, Target, Tolerance,
    directed_hausdorff, symmetric_hausdorff,
};
use pompeiu_testkit::cases::all;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

fn limited(limits: Limits) -> HausdorffOptions<'static> {
    HausdorffOptions { limits, ..HausdorffOptions::default() }
}

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
            let query = HausdorffOptions {
                method,
                limits: Limits { time: Some(Duration::ZERO), ..Limits::default() },
                ..HausdorffOptions::default()
            };
            let report = query.symmetric(&case.a, &case.b).unwrap();
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
        let query = limited(Limits { time: Some(Duration::from_micros(microseconds)), ..Limits::default() });
        check_stopped(&a, &b, &query.directed(&a, &b).unwrap(), &full, StopReason::Time);
        check_stopped(&a, &b, &query.directed_to(&a, &target).unwrap(), &full, StopReason::Time);
    }
    assert!(same(
        &limited(Limits { time: Some(Duration::MAX), ..Limits::default() }).directed(&a, &b).unwrap(),
        &full
    ));
}

#[test]
fn from_no_memory_to_plenty() {
    let a = displace_at_random(&torus(1.0, 0.3, 40, 40).unwrap(), 0.01, 4).unwrap();
    let b = torus(1.0, 0.3, 30, 30).unwrap();
    let full = directed_hausdorff(&a, &b);
    let mut stopped = 0;
    let mut widest = f64::INFINITY;
    for bytes in (0..10).map(|i| i * 40_000).chain((0..40).map(|i| 400_000 + i * 20_000)) {
        let report = limited(Limits { memory: Some(bytes), ..Limits::default() }).directed(&a, &b).unwrap();
        check_stopped(&a, &b, &report, &full, StopReason::Memory);
        stopped += usize::from(report.stop == StopReason::Memory);
        if bytes == 0 {
            assert_eq!(report.stop, StopReason::Memory);
            widest = report.distance.gap();
        }
        assert!(report.distance.gap() <= widest, "{bytes} {report:?}");
    }
    assert!((2..50).contains(&stopped), "{stopped}");
    assert!(same(
        &limited(Limits { memory: Some(1 << 30), ..Limits::default() }).directed(&a, &b).unwrap(),
        &full
    ));
    assert!(same(
        &limited(Limits { memory: Some(usize::MAX), ..Limits::default() })
            .directed_to(&a, &Target::new(&b))
            .unwrap(),
        &HausdorffOptions::default().directed_to(&a, &Target::new(&b)).unwrap()
    ));
}

/// With the target given, there is always room to start; what the limit leaves for pieces may be nothing.
#[test]
fn no_memory_for_pieces() {
    let a = displace_at_random(&torus(1.0, 0.3, 40, 40).unwrap(), 0.01, 4).unwrap();
    let b = torus(1.0, 0.3, 30, 30).unwrap();
    let target = Target::new(&b);
    let full = HausdorffOptions::default().directed_to(&a, &target).unwrap();
    let report = limited(Limits { memory: Some(0), ..Limits::default() }).directed_to(&a, &target).unwrap();
    assert_eq!(report.stop, StopReason::Memory);
    assert!(report.distance.gap() > full.distance.gap());
    check_stopped(&a, &b, &report, &full, StopReason::Memory);
}

#[test]
fn no_memory_still_encloses_every_closed_form() {
    for case in all() {
        let report =
            limited(Limits { memory: Some(0), ..Limits::default() }).symmetric(&case.a, &case.b).unwrap();
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
    calls: AtomicUsize,
}

impl Observer for CancelAt {
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        assert!(progress.lower <= progress.upper && progress.upper.is_finite(), "{progress:?}");
        if self.calls.fetch_add(1, Ordering::Relaxed) >= self.call {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
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
        let tolerance = match method {
            Method::Fast => Tolerance::default(),
            Method::Classic => Tolerance::RelativeToDiagonal(1e-3),
        };
        let cancelled_at = |observer: &CancelAt| {
            let observer = Some(observer as &dyn Observer);
            let options = HausdorffOptions { tolerance, method, observer, ..HausdorffOptions::default() };
            options.directed(a, b).unwrap()
        };
        let counting = CancelAt { call: usize::MAX, calls: AtomicUsize::new(0) };
        let full = cancelled_at(&counting);
        let calls = counting.calls.into_inner();
        assert!(calls >= 3, "{method:?}: {calls} calls");
        let mut gap = f64::INFINITY;
        for call in 0..=calls {
            let report = cancelled_at(&CancelAt { call, calls: AtomicUsize::new(0) });
            check_stopped(a, b, &report, &full, StopReason::Cancelled);
            assert_eq!(report.stop == StopReason::Cancelled, call < calls, "{call} of {calls} {report:?}");
            assert!(report.distance.gap() <= gap, "{call} {gap} {report:?}");
            gap = report.distance.gap();
        }
    }
}

/// A token cancels without an observer, before there is a tree and while there is none.
#[test]
fn cancelling_by_a_token() {
    let (a, b) = large_pair();
    let full = directed_hausdorff(&a, &b);
    let cancel = CancelToken::default();
    let query = limited(Limits { cancel: Some(cancel.clone()), ..Limits::default() });
    assert!(same(&query.directed(&a, &b).unwrap(), &full));
    let target = Target::new(&b);
    cancel.cancel();
    let both = query.symmetric(&a, &b).unwrap();
    check_both(&a, &b, &both);
    assert_eq!((both.a_to_b.stop, both.b_to_a.stop), (StopReason::Cancelled, StopReason::Cancelled));
    assert_eq!((both.a_to_b.work.queries, both.b_to_a.work.queries), (0, 0));
    check_stopped(&a, &b, &both.a_to_b, &full, StopReason::Cancelled);
    let searched = query.directed_to(&a, &target).unwrap();
    check_stopped(&a, &b, &searched, &full, StopReason::Cancelled);
}

/// Ends a search after so many pieces.
struct CancelAfter(u64);

impl Observer for CancelAfter {
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        if progress.examined >= self.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// A long search that is ended early has lowered the bounds of all pieces, not searched some of them to the last digit: what a
/// coarse tolerance takes, and a while more, gives about what that tolerance would have given.
#[test]
fn bounds_of_a_search_that_is_ended_are_those_of_a_coarser_one() {
    let plate = grid([1.0, 1.0], [1, 1], Diagonal::Rising).unwrap();
    let points = displace_at_random(&point_lattice(1.0, 60).unwrap(), 0.004, 1).unwrap();
    let full = directed_hausdorff(&plate, &points);
    for tolerance in [0.1, 0.03, 0.01] {
        let coarse = HausdorffOptions {
            tolerance: Tolerance::RelativeToDiagonal(tolerance),
            ..HausdorffOptions::default()
        };
        let coarse = coarse.directed(&plate, &points).unwrap();
        let observer = CancelAfter(2 * coarse.work.pieces + 4096);
        assert!(observer.0 < full.work.pieces, "{} {full:?}", observer.0);
        let ended = HausdorffOptions { observer: Some(&observer), ..HausdorffOptions::default() };
        let ended = ended.directed(&plate, &points).unwrap();
        assert_eq!(ended.stop, StopReason::Cancelled);
        check_stopped(&plate, &points, &ended, &full, StopReason::Cancelled);
        assert!(ended.distance.gap() <= 8.0 * coarse.tolerance, "{tolerance} {ended:?}");
    }
}

/// Spends half of the time in the first direction, the first time that it is searched.
struct Dawdles {
    half: Duration,
    directions: Mutex<Vec<Direction>>,
}

impl Observer for Dawdles {
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        let mut directions = self.directions.lock().unwrap();
        if directions.is_empty() {
            std::thread::sleep(self.half);
        }
        if directions.last() != Some(&progress.direction) {
            directions.push(progress.direction);
        }
        ControlFlow::Continue(())
    }
}

/// When the first direction needs more than half of the time, it gets what the second leaves.
#[test]
fn directions_share_the_time() {
    let (a, b) =
        (icosphere(1.0, 2).unwrap(), displace_at_random(&icosphere(1.0, 2).unwrap(), 0.1, 1).unwrap());
    let full = symmetric_hausdorff(&a, &b);
    // Long enough for the second direction on a machine with other work.
    let half = Duration::from_secs(2);
    let observer = Dawdles { half, directions: Mutex::default() };
    let limits = Limits { time: Some(2 * half), ..Limits::default() };
    let report = HausdorffOptions { observer: Some(&observer), ..limited(limits) }.symmetric(&a, &b).unwrap();
    check_both(&a, &b, &report);
    assert_eq!(*observer.directions.lock().unwrap(), [Direction::AToB, Direction::BToA, Direction::AToB]);
    assert_eq!(report.a_to_b.stop, StopReason::Tolerance, "{report:?}");
    assert_eq!(report.a_to_b.distance, full.a_to_b.distance);
    assert!(report.a_to_b.timing.search >= half && report.a_to_b.work.queries > full.a_to_b.work.queries);
    assert!(same(&report.b_to_a, &full.b_to_a));
}

/// A distance that exceeds the threshold one way needs no search the other way.
#[test]
fn a_threshold_that_is_exceeded_ends_both_directions() {
    let (a, b) = large_pair();
    let full = symmetric_hausdorff(&a, &b);
    let options = HausdorffOptions {
        threshold: Some(0.5 * full.a_to_b.distance.lower()),
        ..HausdorffOptions::default()
    };
    let report = options.symmetric(&a, &b).unwrap();
    check_both(&a, &b, &report);
    assert!(report.a_to_b.distance.lower() > options.threshold.unwrap());
    assert_eq!(report.b_to_a.stop, StopReason::Threshold);
    assert!(overlap(report.b_to_a.distance, full.b_to_a.distance, 0.0), "{report:?}");
    assert_eq!((report.b_to_a.work.queries, report.b_to_a.work.games), (0, 0));
}
