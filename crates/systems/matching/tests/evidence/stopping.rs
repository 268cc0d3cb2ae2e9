//! Rankings and matrices that end early: what is reported is true, and unfinished tasks are listed.

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_core::run::{Limits, StopReason};
use pompeiu_hausdorff::{Tolerance, symmetric_hausdorff};
use pompeiu_matching::matrix::{Matrix, MatrixOptions, matrix_of, tasks};
use pompeiu_matching::rank::{RankOptions, Report, Status, rank_meshes};
use pompeiu_matching::{TaskObserver, TaskProgress};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// A sphere and rough copies, the first the least rough.
fn rough(count: usize) -> (TriMesh, Vec<TriMesh>) {
    let sphere = icosphere(1.0, 3).unwrap();
    let target = |i: usize| displace_at_random(&sphere, 0.01 * (i + 1) as f64, i as u64).unwrap();
    let targets = (0..count).map(target).collect();
    (sphere, targets)
}

/// Every bound and every range of ranks contains the true value.
fn check(report: &Report, template: &TriMesh, targets: &[TriMesh]) {
    let all: Vec<_> = targets.iter().map(|target| symmetric_hausdorff(template, target).distance).collect();
    assert_eq!(report.standings.len(), targets.len());
    for standing in &report.standings {
        let distance = all[standing.target];
        let (lower, upper) = (standing.lower.unwrap_or(0.0), standing.upper.unwrap_or(f64::INFINITY));
        assert!(lower <= distance.upper() && distance.lower() <= upper, "{standing:?} {distance}");
        let [first, last] = standing.ranks.unwrap();
        let rank = 1 + all.iter().filter(|other| other.upper() < distance.lower()).count();
        assert!(first <= rank && rank <= last, "{standing:?} {rank}");
    }
}

/// Ends a computation after this many progress reports.
struct Patience(AtomicUsize);

impl TaskObserver for Patience {
    fn progress(&self, _: &TaskProgress) -> ControlFlow<()> {
        let left = self.0.load(Ordering::Relaxed);
        self.0.store(left.saturating_sub(1), Ordering::Relaxed);
        if left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn a_ranking_can_be_cancelled_at_any_time() {
    let (template, targets) = rough(8);
    let full = rank_meshes(&template, &targets, &RankOptions { top: 2, ..RankOptions::default() }).unwrap();
    assert_eq!((full.stop, full.open().count()), (StopReason::Tolerance, 0));
    let mut sizes = Vec::new();
    for calls in 0..60 {
        let patience = Patience(AtomicUsize::new(calls));
        let options = RankOptions { top: 2, observer: Some(&patience), ..RankOptions::default() };
        let report = rank_meshes(&template, &targets, &options).unwrap();
        check(&report, &template, &targets);
        if report.open().next().is_none() {
            break;
        }
        assert_eq!(report.stop, StopReason::Cancelled);
        let reasons = report.open().all(|standing| standing.status == Status::Open(StopReason::Cancelled));
        // Targets reported as ranked are among the best of the full ranking.
        let best: Vec<usize> = full.ranked().map(|standing| standing.target).collect();
        assert!(reasons && report.ranked().all(|standing| best.contains(&standing.target)));
        sizes.push(report.open().count());
    }
    assert_eq!(sizes[0], 8, "nothing was looked at");
    assert!(sizes.len() > 8 && sizes.last().is_some_and(|open| *open < 8), "{sizes:?}");
}

#[test]
fn a_ranking_keeps_its_limits() {
    let (template, targets) = rough(4);
    let with = |limits| RankOptions { top: 2, limits, ..RankOptions::default() };
    let limits = Limits { time: Some(Duration::ZERO), ..Limits::default() };
    let report = rank_meshes(&template, &targets, &with(limits)).unwrap();
    assert_eq!((report.stop, report.open().count(), report.work.looks), (StopReason::Time, 4, 0));
    assert!(report.standings.iter().all(|standing| standing.ranks == Some([1, 4])));
    // Looks need no memory for a search, searches do: their bounds stay wide, whatever the number of threads.
    let limited = |threads| {
        let limits = Limits { memory: Some(1), threads: NonZeroUsize::new(threads), ..Limits::default() };
        rank_meshes(&template, &targets, &with(limits)).unwrap()
    };
    let report = limited(1);
    check(&report, &template, &targets);
    assert_eq!(report, limited(3));
    assert_eq!((report.stop, report.work.looks), (StopReason::Memory, 4));
    assert!(report.open().count() >= 2 && report.open().all(|standing| standing.upper.is_some()));
    // Enough memory changes nothing.
    let limits = Limits { memory: Some(1 << 30), ..Limits::default() };
    let plain = rank_meshes(&template, &targets, &with(Limits::default())).unwrap();
    assert_eq!(rank_meshes(&template, &targets, &with(limits)).unwrap(), plain);
}

#[test]
fn tolerances_of_every_kind_are_met() {
    let (template, targets) = rough(6);
    for tolerance in
        [Tolerance::Absolute(1e-3), Tolerance::Absolute(10.0), Tolerance::RelativeToDistance(1e-3)]
    {
        for all in [false, true] {
            let options = RankOptions { top: 2, all, tolerance, ..RankOptions::default() };
            let report = rank_meshes(&template, &targets, &options).unwrap();
            check(&report, &template, &targets);
            assert!(report.ranked().count() >= 2 && report.stop == StopReason::Tolerance);
            for standing in report.ranked() {
                let (lower, upper) = (standing.lower.unwrap(), standing.upper.unwrap());
                let width = match tolerance {
                    Tolerance::RelativeToDistance(t) => t * upper,
                    _ => tolerance.value(),
                };
                assert!(upper - lower <= width, "{standing:?} {tolerance:?}");
            }
        }
    }
}

fn check_matrix(matrix: &Matrix, full: &Matrix) {
    for task in tasks(full.count()) {
        if let Some([lower, upper]) = matrix.directed(task.from, task.to) {
            let [l, u] = full.directed(task.from, task.to).unwrap();
            assert!(lower <= u && l <= upper);
        }
    }
}

#[test]
fn a_matrix_can_be_stopped_and_names_the_pairs_that_are_open() {
    let (_, meshes) = rough(3);
    let full = matrix_of(&meshes, &MatrixOptions::default()).unwrap();
    assert_eq!((full.open().count(), full.stop_reason()), (0, StopReason::Tolerance));
    let with = |limits| matrix_of(&meshes, &MatrixOptions { limits, ..MatrixOptions::default() }).unwrap();
    let none = with(Limits { time: Some(Duration::ZERO), ..Limits::default() });
    assert_eq!((none.open().count(), none.stop_reason()), (6, StopReason::Time));
    let narrow = with(Limits { memory: Some(1), ..Limits::default() });
    check_matrix(&narrow, &full);
    assert_eq!((narrow.open().count(), narrow.stop_reason()), (6, StopReason::Memory));
    assert!(tasks(3).all(|task| narrow.directed(task.from, task.to).is_some()));
    assert_eq!(with(Limits { memory: Some(1 << 30), ..Limits::default() }), full);
    let mut sizes = Vec::new();
    for calls in 0..60 {
        let patience = Patience(AtomicUsize::new(calls));
        let matrix =
            matrix_of(&meshes, &MatrixOptions { observer: Some(&patience), ..MatrixOptions::default() })
                .unwrap();
        check_matrix(&matrix, &full);
        sizes.push(matrix.open().count());
        if sizes.last() == Some(&0) {
            break;
        }
        assert_eq!(matrix.stop_reason(), StopReason::Cancelled);
    }
    assert!(sizes[0] == 6 && sizes.last() == Some(&0) && sizes.len() > 3, "{sizes:?}");
}
