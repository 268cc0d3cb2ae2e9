//! What is told of the mean distance before an analysis has ended.

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_core::run::{Limits, Progress, RunContext};
use pompeiu_hausdorff::{
    DeviationOptions, DeviationRequest, Direction, Enclosure, MeanSoFar, Observer, PreparedPair, StopReason,
};
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::time::Duration;

/// Keeps what it is told.
#[derive(Default)]
struct Means(Mutex<Vec<(Direction, MeanSoFar)>>);

impl Observer for Means {
    fn wants_mean(&self) -> bool {
        true
    }

    fn mean(&self, direction: Direction, mean: MeanSoFar) {
        self.0.lock().unwrap().push((direction, mean));
    }
}

/// What was told of a direction: sampled once, then enclosures; and the mean of the report. Also what people saw.
fn told(a: &TriMesh, b: &TriMesh) -> (f64, Vec<Enclosure>, Enclosure, Vec<String>) {
    let (means, shown) = (Means::default(), Mutex::new(Vec::new()));
    let watch = |progress: &Progress<'_>| {
        shown.lock().unwrap().push(progress.doing.to_owned());
        ControlFlow::Continue(())
    };
    let context = RunContext::start(Limits::default()).watched_by(&watch);
    let pair = PreparedPair::new(a, b);
    let (_, report) = DeviationRequest::default().run(pair, [&[], &[]], &context, Some(&means)).unwrap();
    let told = means.0.into_inner().unwrap();
    let mut there = told.iter().filter(|(direction, _)| *direction == Direction::AToB).map(|(_, mean)| *mean);
    let Some(MeanSoFar::Sampled(sampled)) = there.next() else {
        panic!("nothing was sampled first: {told:?}")
    };
    let enclosures = there
        .map(|mean| match mean {
            MeanSoFar::Enclosed(ends) => ends,
            MeanSoFar::Sampled(mean) => panic!("sampled again: {mean}"),
        })
        .collect();
    let mean = report.deviation.a_to_b.statistics.unwrap().mean;
    (sampled, enclosures, mean, shown.into_inner().unwrap())
}

#[track_caller]
fn check(sampled: f64, enclosures: &[Enclosure], mean: Enclosure) {
    assert!((sampled - mean.lower()).abs() < 0.1 * mean.lower(), "{sampled} {mean}");
    assert!(enclosures.len() > 2);
    for pair in enclosures.windows(2) {
        assert!(pair[0].lower() <= pair[1].lower() && pair[1].upper() <= pair[0].upper(), "{pair:?}");
    }
    for ends in enclosures {
        assert!(ends.lower() <= mean.upper() && mean.lower() <= ends.upper(), "{ends} {mean}");
    }
    let last = enclosures.last().unwrap();
    assert!(last.gap() <= 1.001 * mean.gap(), "{last} {mean}");
}

/// The shares that people see, of all stages of both directions: the first takes a call to its half.
#[test]
fn shares_are_those_of_the_call() {
    let (a, b) = (icosphere(1.0, 5).unwrap(), icosphere(1.1, 5).unwrap());
    let shares = Mutex::new(Vec::new());
    let watch = |progress: &Progress<'_>| {
        shares.lock().unwrap().push((progress.doing.starts_with("A to B"), progress.share.unwrap()));
        ControlFlow::Continue(())
    };
    let context = RunContext::start(Limits::default()).watched_by(&watch);
    DeviationRequest::default().run(PreparedPair::new(&a, &b), [&[], &[]], &context, None).unwrap();
    let shares = shares.into_inner().unwrap();
    let [there, back] = [true, false]
        .map(|is_there| shares.iter().filter(move |(of, _)| *of == is_there).map(|(_, share)| *share));
    assert!(there.clone().all(|share| (0.0..=0.5).contains(&share)), "{shares:?}");
    assert!(back.clone().all(|share| (0.5..=1.0).contains(&share)), "{shares:?}");
    for (shares, half) in [(there.collect::<Vec<_>>(), 0.0), (back.collect(), 0.5)] {
        let between = shares.iter().filter(|share| (0.1..0.35).contains(&(**share - half)));
        assert!(between.count() > 2, "{shares:?}");
        assert!(shares.iter().any(|share| share - half > 0.35), "{shares:?}");
    }
}

/// Where cutting is ended the other faces have values between two ends, from the distances of their corners.
#[test]
fn faces_that_are_not_cut_have_values_by_their_corners() {
    struct Ends;
    impl Observer for Ends {
        fn progress(&self, progress: &pompeiu_hausdorff::Progress) -> ControlFlow<()> {
            if progress.share > 0.25 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        }
    }
    let (a, b) = (icosphere(1.0, 5).unwrap(), icosphere(1.1, 5).unwrap());
    let of = |observer| {
        let options = DeviationOptions { observer, ..DeviationOptions::default() };
        options.directed(&a, &b).unwrap()
    };
    let (ended, whole) = (of(Some(&Ends as &dyn Observer)), of(None));
    assert_eq!(ended.stop, StopReason::Cancelled);
    assert!(ended.work.looks < whole.work.looks / 2, "{} {}", ended.work.looks, whole.work.looks);
    let mean = ended.statistics.as_ref().unwrap().mean;
    let exact = whole.statistics.as_ref().unwrap().mean;
    assert!(mean.gap() < 0.1 * mean.lower() && mean.gap() > 2.0 * exact.gap(), "{mean} {exact}");
    assert!(mean.lower() <= exact.upper() && exact.lower() <= mean.upper(), "{mean} {exact}");
    for (ended, whole) in ended.faces.iter().zip(&whole.faces) {
        for (ended, whole) in [(ended.max, whole.max), (ended.min, whole.min), (ended.mean, whole.mean)] {
            assert!(ended.lower() <= whole.upper() && whole.lower() <= ended.upper(), "{ended} {whole}");
            assert!(ended.gap() < 0.1 * ended.upper(), "{ended}");
        }
    }
}

/// Wherever a time limit ends the work, what is said holds: of the largest distance, of means and percentiles, of faces and of vertices.
#[test]
fn what_is_said_holds_under_any_time_limit() {
    let a = icosphere(1.0, 5).unwrap();
    let b = displace_at_random(&icosphere(1.05, 5).unwrap(), 0.01, 7).unwrap();
    let within = |time: Option<Duration>| {
        let limits = Limits { time, ..Limits::default() };
        DeviationOptions { limits, ..DeviationOptions::default() }.symmetric(&a, &b).unwrap()
    };
    let overlap = |x: Enclosure, y: Enclosure| x.lower() <= y.upper() && y.lower() <= x.upper();
    let whole = within(None);
    let mut stops = Vec::new();
    for time in [0, 2, 8, 12, 16, 24, 40, 80].map(Duration::from_millis) {
        let some = within(Some(time));
        assert!(overlap(some.distance, whole.distance), "{time:?}: {} {}", some.distance, whole.distance);
        for (some, whole) in [(&some.a_to_b, &whole.a_to_b), (&some.b_to_a, &whole.b_to_a)] {
            stops.push((some.stop, some.work.pieces));
            let [x, y] = [some, whole].map(|directed| directed.statistics.as_ref().unwrap());
            assert!(overlap(x.mean, y.mean) && overlap(x.rms, y.rms), "{time:?}: {} {}", x.mean, y.mean);
            for (x, y) in x.percentiles.iter().zip(&y.percentiles) {
                assert!(overlap(x.distance, y.distance), "{time:?}: {} {}", x.distance, y.distance);
            }
            for (x, y) in some.faces.iter().zip(&whole.faces) {
                assert!(
                    overlap(x.max, y.max) && overlap(x.min, y.min) && overlap(x.mean, y.mean),
                    "{time:?}"
                );
            }
            let error = some.vertex_error + whole.vertex_error;
            for (x, y) in some.vertices.iter().zip(&whole.vertices) {
                assert!((x - y).abs() <= error, "{time:?}: {x} {y} {error}");
            }
        }
    }
    assert!(stops.iter().any(|(stop, _)| *stop == StopReason::Time), "{stops:?}");
}

/// The distances of corners alone enclose the mean within a tenth before any face is cut.
#[test]
fn of_surfaces_that_are_apart_the_mean_is_enclosed_at_once() {
    let (sampled, enclosures, mean, shown) = told(&icosphere(1.0, 5).unwrap(), &icosphere(1.1, 5).unwrap());
    check(sampled, &enclosures, mean);
    assert!(enclosures[0].gap() < 0.1 * enclosures[0].lower(), "{}", enclosures[0]);
    let of_mean = |line: &&String| line.starts_with("A to B: largest ") && line.contains(", mean 0.0");
    assert!(shown.iter().filter(of_mean).count() > 2, "{shown:?}");
}

/// Where they are near each other the mean is sampled, and said to be, until most faces are cut.
#[test]
fn of_surfaces_that_are_near_the_mean_is_sampled() {
    let a = icosphere(1.0, 5).unwrap();
    let b = displace_at_random(&a, 1e-3, 7).unwrap();
    let (sampled, enclosures, mean, shown) = told(&a, &b);
    check(sampled, &enclosures, mean);
    assert!(enclosures[0].gap() > 0.5 * enclosures[0].upper(), "{}", enclosures[0]);
    let called =
        shown.iter().position(|line| line.contains("mean about 0.000") && line.ends_with("(sampled)"));
    let enclosed = shown.iter().rposition(|line| line.contains(", mean 0.000"));
    assert!(called.unwrap() < enclosed.unwrap(), "{shown:?}");
}
