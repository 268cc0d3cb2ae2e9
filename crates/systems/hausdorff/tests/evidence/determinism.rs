//! The same input gives the same bits at any number of threads.

use crate::support::same;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::{Diagonal, grid, icosphere, point_lattice, torus};
use pompeiu_hausdorff::{DirectedReport, Discard, Method, Observer, Progress, Query, Stage, Tolerance};
use std::ops::ControlFlow;
use std::time::Duration;

/// Everything that an observer is told, but for the time.
#[derive(Default, PartialEq)]
struct Record {
    progress: Vec<Progress>,
    discards: Vec<Discard>,
    stages: Vec<Stage>,
    wants_discards: bool,
}

impl Observer for Record {
    fn progress(&mut self, progress: &Progress) -> ControlFlow<()> {
        self.progress.push(*progress);
        ControlFlow::Continue(())
    }

    fn wants_discards(&self) -> bool {
        self.wants_discards
    }

    fn discard(&mut self, discard: &Discard) {
        self.discards.push(discard.clone());
    }

    fn stage(&mut self, stage: &Stage) {
        self.stages.push(Stage { elapsed: Duration::ZERO, ..stage.clone() });
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
    query: &Query,
    a: &TriMesh,
    b: &TriMesh,
    threads: usize,
    wants_discards: bool,
) -> (DirectedReport, Record) {
    let mut record = Record { wants_discards, ..Record::default() };
    let report = query.clone().threads(threads).unwrap().directed_observed(a, b, &mut record);
    (report, record)
}

#[test]
fn one_two_and_eight_threads_give_the_same_bits() {
    for (a, b) in &pairs() {
        let stages = [1e-1, 1e-2, 1e-3, 1e-6];
        let plain = Query::new();
        let h = plain.directed(a, b).distance.lower();
        let variants = [
            (plain.clone(), false),
            (plain.clone(), true),
            (plain.clone().stages(&stages).unwrap(), false),
            (plain.clone().stages(&stages).unwrap(), true),
            (plain.clone().threshold(0.9 * h).unwrap(), false),
            (plain.clone().threshold(1.1 * h).unwrap(), true),
            (plain.clone().tolerance(Tolerance::RelativeToDistance(1e-3)).unwrap(), false),
        ];
        for (query, wants_discards) in &variants {
            let (first, record) = run(query, a, b, 1, *wants_discards);
            assert_eq!(record.discards.is_empty(), !wants_discards);
            for threads in [2, 8, 2] {
                let (report, other) = run(query, a, b, threads, *wants_discards);
                assert!(same(&report, &first), "{threads} {query:?} {report:?} {first:?}");
                assert!(other == record, "{threads} {query:?}");
            }
        }
    }
}

#[test]
fn looking_on_changes_nothing() {
    for (a, b) in &pairs() {
        let silent = Query::new().directed(a, b);
        assert!(same(&silent, &run(&Query::new(), a, b, 2, true).0));
    }
}

#[test]
fn the_textbook_method_is_as_steady() {
    let (a, b) =
        (icosphere(1.0, 2).unwrap(), displace_at_random(&icosphere(1.0, 1).unwrap(), 0.1, 6).unwrap());
    let query = Query::new().method(Method::Classic).stages(&[1e-1, 1e-2]).unwrap();
    let query = query.tolerance(Tolerance::RelativeToDiagonal(1e-3)).unwrap();
    let (first, record) = run(&query, &a, &b, 1, false);
    assert_eq!(record.stages.len(), 2);
    for threads in [2, 8] {
        let (report, other) = run(&query, &a, &b, threads, false);
        assert!(same(&report, &first) && other == record, "{threads}");
    }
}
