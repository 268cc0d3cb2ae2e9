//! Statistics of deviation: more closed forms, motions, and ends that limits and observers put to the work.

use crate::support::largest_coordinate;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{Diagonal, grid, icosphere};
use pompeiu_core::mesh::{Affine, displace_at_random, transform};
use pompeiu_core::run::Limits;
use pompeiu_hausdorff::deviation::Statistics;
use pompeiu_hausdorff::{DeviationOptions, DirectedDeviation, Enclosure, Observer, Progress, StopReason};
use pompeiu_testkit::strategies::scaled;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

/// Rounding of statistics of size one.
const ROUNDING: f64 = 1e-12;

fn rough() -> (TriMesh, TriMesh) {
    let a = displace_at_random(&icosphere(1.0, 3).unwrap(), 0.03, 3).unwrap();
    (a, displace_at_random(&icosphere(1.0, 2).unwrap(), 0.05, 4).unwrap())
}

fn numbers(statistics: &Statistics) -> Vec<Enclosure> {
    let mut numbers = vec![statistics.mean, statistics.rms];
    numbers.extend(statistics.percentiles.iter().map(|p| p.distance));
    numbers
}

fn all(report: &DirectedDeviation) -> Vec<Enclosure> {
    let mut all = numbers(report.statistics.as_ref().unwrap());
    all.extend(report.faces.iter().flat_map(|face| [face.max, face.min, face.mean]));
    all
}

#[track_caller]
fn check_overlap(here: &[Enclosure], there: &[Enclosure], slack: f64) {
    assert_eq!(here.len(), there.len());
    for (x, y) in here.iter().zip(there) {
        assert!(x.lower() <= y.upper() + slack && y.lower() <= x.upper() + slack, "{x} {y}");
    }
}

/// Between concentric spheres every distance lies between those of the spheres that bound their faces.
#[test]
fn a_sphere_inside_a_sphere() {
    let (radius, outer) = (0.8, 1.0);
    let (a, b) = (icosphere(radius, 3).unwrap(), icosphere(outer, 4).unwrap());
    // Faces reach inside their sphere as far as their planes: of these, the nearest to the centre.
    let inner = |mesh: &TriMesh| {
        mesh.face_ids().fold(f64::INFINITY, |least: f64, f| {
            let triangle = mesh.corners(f);
            least.min(pompeiu_testkit::plain::point_triangle([0.0; 3], triangle))
        })
    };
    let (least, most) = (inner(&b) - radius, outer - inner(&a));
    assert!(least > 0.19 && most < 0.21);
    let report = DeviationOptions { accuracy: 1e-3, ..DeviationOptions::default() }.directed(&a, &b).unwrap();
    for number in all(&report) {
        assert!(number.upper() >= least - ROUNDING && number.lower() <= most + ROUNDING, "{number}");
        assert!(number.upper() <= most * 1.005 && number.lower() >= least * 0.995, "{number}");
    }
}

/// Half of a plate is raised: the median lies in the gap and says so, all other percentiles are narrow.
#[test]
fn a_plate_half_of_which_is_raised() {
    let plate = grid([1.0, 1.0], [4, 4], Diagonal::Rising).unwrap();
    let at = |height: f64, to: f64| transform(&plate, &Affine::translate([to, 0.0, height])).unwrap();
    let a = pompeiu_core::mesh::merge(&[&at(1.0, 0.0), &at(2.0, 2.0)]).unwrap();
    let b = transform(&grid([8.0, 8.0], [3, 3], Diagonal::Falling).unwrap(), &Affine::translate([0.0; 3]))
        .unwrap();
    let query =
        DeviationOptions { percentiles: [0.1, 0.4, 0.5, 0.6, 0.9].to_vec(), ..DeviationOptions::default() };
    let report = query.directed(&a, &b).unwrap();
    let percentiles = report.statistics.unwrap().percentiles;
    for (percentile, value) in percentiles.iter().zip([1.0, 1.0, 1.0, 2.0, 2.0]) {
        let distance = percentile.distance;
        assert!(
            distance.lower() <= value + ROUNDING && value <= distance.upper() + ROUNDING,
            "{percentile:?}"
        );
        assert!(distance.upper() <= 2.0 + ROUNDING);
        assert!(percentile.share == 0.5 || distance.gap() <= ROUNDING, "{percentile:?}");
    }
}

#[test]
fn motions_and_scales_keep_what_is_enclosed() {
    let (a, b) = rough();
    let here = DeviationOptions::default().directed(&a, &b).unwrap();
    let rotation = Affine::rotate([1.0, 2.0, -0.5], 37.0).unwrap();
    let moved =
        |m| transform(&transform(m, &rotation).unwrap(), &Affine::translate([0.3, -4.0, 1.0])).unwrap();
    let (moved_a, moved_b) = (moved(&a), moved(&b));
    let slack = 32.0 * f64::EPSILON * largest_coordinate(&[&a, &b, &moved_a, &moved_b]);
    check_overlap(
        &all(&here),
        &all(&DeviationOptions::default().directed(&moved_a, &moved_b).unwrap()),
        slack,
    );
    for exponent in [-300, -3, 200] {
        let (small_a, small_b) = (scaled(&a, exponent).unwrap(), scaled(&b, exponent).unwrap());
        let there = DeviationOptions::default().directed(&small_a, &small_b).unwrap();
        let by = 2.0_f64.powi(exponent);
        for (x, y) in all(&here).iter().zip(all(&there)) {
            assert_eq!((x.lower() * by, x.upper() * by), (y.lower(), y.upper()));
        }
        assert_eq!(here.regions.len(), there.regions.len());
        assert_eq!(here.work.looks, there.work.looks);
    }
}

#[test]
fn more_accuracy_is_narrower() {
    let (a, b) = rough();
    let mut before: Option<Vec<Enclosure>> = None;
    for accuracy in [0.3, 0.03, 0.003] {
        let report = DeviationOptions { accuracy, ..DeviationOptions::default() }.directed(&a, &b).unwrap();
        assert_eq!(report.stop, StopReason::Tolerance);
        let now = numbers(&report.statistics.unwrap());
        assert!(now.iter().all(|x| x.gap() <= accuracy * x.lower() + 1e-8), "{accuracy} {now:?}");
        if let Some(before) = before {
            check_overlap(&before, &now, 0.0);
            assert!(now[0].gap() < before[0].gap() && now[1].gap() < before[1].gap());
        }
        before = Some(now);
    }
}

/// Many faces, whose pieces are summed up and not kept: numbers enclose the same as at an accuracy for which pieces are kept, in both directions and
/// together, and no limit makes them wrong.
#[test]
fn sums_of_many_faces_enclose_what_pieces_do() {
    let a = displace_at_random(&icosphere(1.0, 5).unwrap(), 0.01, 3).unwrap();
    let b = displace_at_random(&icosphere(1.0, 5).unwrap(), 0.01, 4).unwrap();
    let coarse = DeviationOptions { threshold: Some(0.005), ..DeviationOptions::default() };
    let summed = coarse.symmetric(&a, &b).unwrap();
    let kept = DeviationOptions { accuracy: 2e-3, ..coarse.clone() }.symmetric(&a, &b).unwrap();
    let everything = |statistics: &Statistics| {
        let mut all = numbers(statistics);
        all.push(statistics.above.unwrap().share);
        all.extend(statistics.histogram.bins.iter().chain(&statistics.histogram.cumulative));
        all
    };
    let both = [(&summed.a_to_b, &kept.a_to_b), (&summed.b_to_a, &kept.b_to_a)];
    for (summed, kept) in both {
        assert_eq!((summed.stop, kept.stop), (StopReason::Tolerance, StopReason::Tolerance));
        check_overlap(&all(summed), &all(kept), 0.0);
    }
    let statistics =
        both.map(|(summed, kept)| [summed, kept].map(|report| report.statistics.as_ref().unwrap()));
    let pooled = [&summed, &kept].map(|report| report.pooled.as_ref().unwrap());
    for [summed, kept] in statistics.into_iter().chain([pooled]) {
        check_overlap(&everything(summed), &everything(kept), 0.0);
        assert!(numbers(summed).iter().all(|x| x.gap() <= 0.01 * x.lower() + 1e-8), "{:?}", numbers(summed));
        assert!(summed.above.unwrap().share.gap() <= 0.011);
    }
    for (limits, stop) in [
        (Limits { pieces: Some(24_000), ..Limits::default() }, StopReason::Pieces),
        (Limits { memory: Some(8 << 20), ..Limits::default() }, StopReason::Memory),
    ] {
        let report = DeviationOptions { limits, ..coarse.clone() }.directed(&a, &b).unwrap();
        assert_eq!(report.stop, stop);
        check_overlap(&all(&report), &all(&kept.a_to_b), 0.0);
    }
}

/// Breaks off after some looks.
struct Cancels(AtomicU32);

impl Observer for Cancels {
    fn progress(&self, _: &Progress) -> ControlFlow<()> {
        let left = self.0.load(Ordering::Relaxed).saturating_sub(1);
        self.0.store(left, Ordering::Relaxed);
        if left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn limits_leave_true_numbers_and_say_why() {
    let (a, b) = rough();
    let fine = DeviationOptions { accuracy: 1e-3, ..DeviationOptions::default() };
    let whole = fine.directed(&a, &b).unwrap();
    let truth = all(&whole);
    let check = |report: DirectedDeviation, stop: StopReason| {
        assert_eq!(report.stop, stop);
        check_overlap(&all(&report), &truth, 0.0);
        let off = report.vertex_error + whole.vertex_error;
        assert!(report.vertices.iter().zip(&whole.vertices).all(|(x, y)| (x - y).abs() <= off));
        let largest = report.distance.distance.upper();
        assert!(report.regions.iter().all(|region| region.peak.lower() <= largest));
    };
    for (limits, stop) in [
        (Limits { pieces: Some(1500), ..Limits::default() }, StopReason::Pieces),
        (Limits { memory: Some(1), ..Limits::default() }, StopReason::Memory),
        (Limits { time: Some(Duration::ZERO), ..Limits::default() }, StopReason::Time),
    ] {
        check(DeviationOptions { limits, ..fine.clone() }.directed(&a, &b).unwrap(), stop);
    }
    // From where there is no room to look at any face to where there is enough.
    let threads = NonZeroUsize::new(1);
    let (mut nothing_known, mut some_known) = (false, false);
    for memory in (16 << 20..).step_by(192 << 10) {
        let limits = Limits { memory: Some(memory), threads, ..Limits::default() };
        let report = DeviationOptions { limits, accuracy: 5e-3, ..fine.clone() }.directed(&a, &b).unwrap();
        if report.stop != StopReason::Memory {
            break;
        }
        nothing_known |= report.pieces() == 1;
        some_known |= report.pieces() > a.faces().len();
        check(report, StopReason::Memory);
    }
    assert!(nothing_known && some_known);
    // At each of its chances, until it has one more than there are.
    let mut chances = 0;
    loop {
        let observer = Cancels(AtomicU32::new(chances + 1));
        let observed = DeviationOptions { observer: Some(&observer), ..fine.clone() };
        let report = observed.directed(&a, &b).unwrap();
        if observer.0.load(Ordering::Relaxed) > 0 {
            break;
        }
        check(report, StopReason::Cancelled);
        chances += 1;
    }
    assert!(chances >= 4, "{chances}");
}
