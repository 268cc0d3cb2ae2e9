//! The same input gives the same bits at any number of threads.

use crate::support::same;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::{Diagonal, grid, icosphere, point_lattice, torus};
use pompeiu_core::run::Limits;
use pompeiu_hausdorff::{
    DirectedReport, Discard, HausdorffOptions, Method, Observer, Progress, Stage, Tolerance,
};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::time::Duration;

/// Everything that an observer is told, but for the time.
#[derive(Default, PartialEq)]
struct Record {
    progress: Vec<Progress>,
    discards: Vec<Discard>,
    stages: Vec<Stage>,
}

#[derive(Default)]
struct Recorder {
    record: Mutex<Record>,
    wants_discards: bool,
}

impl Observer for Recorder {
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        self.record.lock().unwrap().progress.push(*progress);
        ControlFlow::Continue(())
    }

    fn wants_discards(&self) -> bool {
        self.wants_discards
    }

    fn discard(&self, discard: &Discard) {
        self.record.lock().unwrap().discards.push(discard.clone());
    }

    fn stage(&self, stage: &Stage) {
        self.record.lock().unwrap().stages.push(Stage { elapsed: Duration::ZERO, ..stage.clone() });
    }
}

fn pairs() -> Vec<(TriMesh, TriMesh)> {
    let sphere = icosphere(1.0, 4).unwrap();
    let ring = torus(1.0, 0.3, 24, 12).unwrap();
    vec![
        (sphere.clone(), displace_at_random(&sphere, 0.01, 8).unwrap()),
        (displace_at_random(&ring, 0.03, 2).unwrap(), ring),
        // Many equally far places: ties are where threads could differ.
        (grid([1.0, 1.0], [16, 16], Diagonal::Alternating).unwrap(), point_lattice(1.0, 8).unwrap()),
        (
            grid([1.0, 1.0], [9, 9], Diagonal::Rising).unwrap(),
            grid([1.0, 1.0], [7, 7], Diagonal::Falling).unwrap(),
        ),
    ]
}

fn run(
    options: &HausdorffOptions<'_>,
    a: &TriMesh,
    b: &TriMesh,
    threads: usize,
    wants_discards: bool,
) -> (DirectedReport, Record) {
    let recorder = Recorder { wants_discards, ..Recorder::default() };
    let limits = Limits { threads: NonZeroUsize::new(threads), ..Limits::default() };
    let options = HausdorffOptions { limits, observer: Some(&recorder), ..options.clone() };
    let report = options.directed(a, b).unwrap();
    (report, recorder.record.into_inner().unwrap())
}

#[test]
fn one_two_and_eight_threads_give_the_same_bits() {
    for (a, b) in &pairs() {
        let stages = vec![1e-1, 1e-2, 1e-3, 1e-6];
        let plain = HausdorffOptions::default();
        let h = plain.directed(a, b).unwrap().distance.lower();
        let variants = [
            (plain.clone(), false),
            (plain.clone(), true),
            (HausdorffOptions { stages: stages.clone(), ..plain.clone() }, false),
            (HausdorffOptions { stages, ..plain.clone() }, true),
            (HausdorffOptions { threshold: Some(0.9 * h), ..plain.clone() }, false),
            (HausdorffOptions { threshold: Some(1.1 * h), ..plain.clone() }, true),
            (HausdorffOptions { tolerance: Tolerance::RelativeToDistance(1e-3), ..plain.clone() }, false),
        ];
        for (options, wants_discards) in &variants {
            let (first, record) = run(options, a, b, 1, *wants_discards);
            assert_eq!(record.discards.is_empty(), !wants_discards);
            for threads in [2, 8, 2] {
                let (report, other) = run(options, a, b, threads, *wants_discards);
                assert!(same(&report, &first), "{threads} {options:?} {report:?} {first:?}");
                assert!(other == record, "{threads} {options:?}");
            }
        }
    }
}

#[test]
fn looking_on_changes_nothing() {
    for (a, b) in &pairs() {
        let silent = HausdorffOptions::default().directed(a, b).unwrap();
        assert!(same(&silent, &run(&HausdorffOptions::default(), a, b, 2, true).0));
    }
}

#[test]
fn the_textbook_method_is_as_steady() {
    let (a, b) =
        (icosphere(1.0, 2).unwrap(), displace_at_random(&icosphere(1.0, 1).unwrap(), 0.1, 6).unwrap());
    let options = HausdorffOptions {
        method: Method::Classic,
        stages: vec![1e-1, 1e-2],
        tolerance: Tolerance::RelativeToDiagonal(1e-3),
        ..HausdorffOptions::default()
    };
    let (first, record) = run(&options, &a, &b, 1, false);
    assert_eq!(record.stages.len(), 2);
    for threads in [2, 8] {
        let (report, other) = run(&options, &a, &b, threads, false);
        assert!(same(&report, &first) && other == record, "{threads}");
    }
}
