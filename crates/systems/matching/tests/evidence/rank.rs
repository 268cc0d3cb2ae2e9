//! Ranking against exhaustive computation of all distances.

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_core::mesh::{Affine, Random, displace_at_random, transform};
use pompeiu_hausdorff::{HausdorffOptions, OptionError, Tolerance, directed_hausdorff, symmetric_hausdorff};
use pompeiu_matching::align::Alignment;
use pompeiu_matching::matrix::{MatrixOptions, matrix_of};
use pompeiu_matching::rank::{
    Action, Measure, Outcome, RankError, RankOptions, Ranking, Report, Request, Status, Summary, Template,
    box_upper_bound, perform, rank_meshes, refine, support_lower_bound,
};
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::strategies::{any_mesh, pair};
use proptest::prelude::*;

const MEASURES: [Measure; 3] = [Measure::Both, Measure::FromTemplate, Measure::ToTemplate];

fn full(template: &TriMesh, target: &TriMesh, measure: Measure) -> [f64; 2] {
    let distance = match measure {
        Measure::Both => symmetric_hausdorff(template, target).distance,
        Measure::FromTemplate => directed_hausdorff(template, target).distance,
        Measure::ToTemplate => directed_hausdorff(target, template).distance,
    };
    [distance.lower(), distance.upper()]
}

/// Ranks that the full enclosures leave possible.
fn oracle(all: &[[f64; 2]], i: usize) -> [usize; 2] {
    let nearer = all.iter().filter(|other| other[1] < all[i][0]).count();
    let perhaps = all.iter().filter(|other| other[0] <= all[i][1]).count();
    [nearer + 1, perhaps]
}

fn check(
    template: &TriMesh,
    targets: &[TriMesh],
    options: &RankOptions<'_>,
) -> Result<Report, TestCaseError> {
    let report = rank_meshes(template, targets, options).unwrap();
    let all: Vec<_> = targets.iter().map(|target| full(template, target, options.measure)).collect();
    prop_assert_eq!(report.standings.len(), targets.len());
    for standing in &report.standings {
        let [lower, upper] = all[standing.target];
        let (l, u) = (standing.lower.unwrap(), standing.upper.unwrap());
        // Both hold the distance, so they meet.
        prop_assert!(l <= upper && lower <= u, "{standing:?} {lower} {upper}");
        let possible = oracle(&all, standing.target);
        let found = standing.ranks.unwrap();
        // Ranges both hold the true rank, so they meet; a discarded target is not among the best.
        prop_assert!(found[0] <= possible[1] && possible[0] <= found[1], "{standing:?} {possible:?}");
        match &standing.status {
            Status::Ranked => {
                let slack = 2.0 * options.tolerance.value().max(1e-12) * 2000.0;
                prop_assert!((l - lower).abs() <= slack && (u - upper).abs() <= slack, "{standing:?}");
            }
            Status::Discarded(_) => prop_assert!(!options.all && possible[1] > options.top),
            other => prop_assert!(false, "{other:?}"),
        }
    }
    let ranked = report.ranked().count();
    prop_assert!(ranked >= options.top.min(targets.len()));
    Ok(report)
}

fn options() -> impl Strategy<Value = RankOptions<'static>> {
    let tolerance = prop_oneof![Just(1e-12), Just(1e-6), Just(1e-3), Just(0.3)];
    (0..3_usize, 1..4_usize, prop::bool::weighted(0.2), tolerance).prop_map(
        |(measure, top, all, tolerance)| RankOptions {
            measure: MEASURES[measure],
            alignment: Alignment::None,
            top,
            all,
            tolerance: Tolerance::RelativeToDiagonal(tolerance),
            ..RankOptions::default()
        },
    )
}

/// Some meshes, some of them twice, some of them moved a little.
fn targets() -> impl Strategy<Value = Vec<TriMesh>> {
    let one = (any_mesh(), 0..3_u32, 0..4_i32);
    prop::collection::vec(one, 1..7).prop_map(|all| {
        let mut targets: Vec<TriMesh> = Vec::new();
        for (mesh, kind, digits) in all {
            let earlier = targets.first().cloned().unwrap_or_else(|| mesh.clone());
            targets.push(match kind {
                0 => mesh,
                1 => earlier,
                _ => transform(&mesh, &Affine::translate([10_f64.powi(-digits), 0.0, 0.0])).unwrap(),
            });
        }
        targets
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(300)))]

    #[test]
    fn agrees_with_all_distances_in_full(template in any_mesh(), targets in targets(), options in options()) {
        check(&template, &targets, &options)?;
    }

    #[test]
    fn the_order_of_the_targets_does_not_matter(template in any_mesh(), targets in targets(), top in 1..4_usize) {
        // Names belong to meshes, as those of files do.
        let options = RankOptions { top, ..RankOptions::default() };
        let prepared = Template::new(template, &options).unwrap();
        let rank = |order: &[usize]| {
            let names = order.iter().map(|i| format!("{i}")).collect();
            let mut ranking = Ranking::new(names, &options).unwrap();
            while !ranking.round().is_empty() {
                let done = |task: &pompeiu_matching::rank::Task| perform(&prepared, &targets[order[task.target]], &task.action, &HausdorffOptions::default());
                let outcomes = ranking.round().iter().map(done).collect();
                ranking.merge(outcomes).unwrap();
            }
            let mut report = ranking.report();
            for standing in &mut report.standings {
                standing.target = order[standing.target];
            }
            report
        };
        let forwards: Vec<usize> = (0..targets.len()).collect();
        let backwards: Vec<usize> = (0..targets.len()).rev().collect();
        prop_assert_eq!(rank(&forwards), rank(&backwards));
    }

    #[test]
    fn cheap_bounds_enclose_the_distance((template, target) in pair()) {
        let [one, other] = [&template, &target].map(Summary::new);
        for measure in MEASURES {
            let [lower, upper] = full(&template, &target, measure);
            prop_assert!(support_lower_bound(&one, &other, measure) <= upper);
            prop_assert!(box_upper_bound(&one.aabb(), &other.aabb(), measure) >= lower);
            let options = RankOptions { measure, ..RankOptions::default() };
            let prepared = Template::new(template.clone(), &options).unwrap();
            let Outcome::Seen(sight) = perform(&prepared, &target, &Action::Look, &HausdorffOptions::default()) else { panic!("seen") };
            prop_assert!(sight.probe_lower <= upper && sight.support_lower <= upper && sight.upper >= lower);
            for threshold in [None, Some(0.5 * lower), Some(upper)] {
                let request = Request { tolerance: Tolerance::RelativeToDiagonal(1e-2), threshold, transform: None };
                let found = refine(&prepared, &target, &request, &HausdorffOptions::default()).unwrap();
                let (found_lower, found_upper) = (found.lower(), found.upper(measure));
                prop_assert!(found_lower <= upper && found_upper.is_none_or(|u| u >= lower));
                let beyond = threshold.is_some_and(|t| found_lower > t);
                let wide = found_upper.is_none_or(|u| u - found_lower > 1e-2 * sight.diagonal * (1.0 + 1e-12));
                prop_assert!(beyond || !wide, "{found:?}");
            }
        }
    }
}

/// A sphere and rough copies, most of them very rough.
fn rough(count: usize) -> (TriMesh, Vec<TriMesh>) {
    let sphere = icosphere(1.0, 3).unwrap();
    let target = |i: usize| displace_at_random(&sphere, 0.002 * (i + 1) as f64, i as u64).unwrap();
    let targets = (0..count).map(|i| target((i * 37) % count)).collect();
    (sphere, targets)
}

#[test]
fn most_targets_are_discarded_cheaply() {
    let (template, targets) = rough(100);
    let options = RankOptions { top: 3, ..RankOptions::default() };
    let report = rank_meshes(&template, &targets, &options).unwrap();
    let expected: Vec<usize> = (0..3).map(|i| (0..100).find(|k| k * 37 % 100 == i).unwrap()).collect();
    let best: Vec<usize> = report.ranked().map(|standing| standing.target).collect();
    assert_eq!(best, expected);
    assert!(report.ranked().enumerate().all(|(i, standing)| standing.ranks == Some([i + 1; 2])));
    let full = rank_meshes(&template, &targets, &RankOptions { all: true, ..options }).unwrap();
    assert_eq!(full.ranked().count(), 100);
    let searches: usize = report.work.searches.iter().map(|(_, count)| count).sum();
    assert!(searches <= 40 && report.work.trees <= 40, "{:?}", report.work);
    assert!(4 * report.work.distances < full.work.distances, "{:?} {:?}", report.work, full.work);
}

#[test]
fn threads_do_not_change_a_bit() {
    let (template, targets) = rough(8);
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    for alignment in [Alignment::None, Alignment::Rigid] {
        let options = RankOptions { top: 2, alignment, ..RankOptions::default() };
        let on =
            |threads: usize| pool(threads).install(|| rank_meshes(&template, &targets, &options).unwrap());
        let one = on(1);
        assert_eq!((&one, &one), (&on(2), &on(8)));
    }
    let matrix_options =
        MatrixOptions { tolerance: Tolerance::RelativeToDiagonal(1e-9), ..MatrixOptions::default() };
    let on = |threads: usize| pool(threads).install(|| matrix_of(&targets[..4], &matrix_options).unwrap());
    let one = on(1);
    assert_eq!((&one, &one), (&on(2), &on(8)));
    for i in 0..4 {
        for j in 0..4 {
            let [lower, upper] = full(&targets[i], &targets[j], Measure::Both);
            let [l, u] = one.symmetric(i, j).unwrap();
            assert!(l <= upper && lower <= u && one.symmetric(j, i) == Some([l, u]));
        }
    }
}

#[test]
fn tasks_and_results_are_plain_values() {
    let (template, targets) = rough(12);
    let options = RankOptions { top: 2, alignment: Alignment::Rigid, ..RankOptions::default() };
    let prepared = Template::new(template.clone(), &options).unwrap();
    let names = (0..12).map(|i| format!("{i:02}")).collect();
    let mut ranking = Ranking::new(names, &options).unwrap();
    while !ranking.round().is_empty() {
        let tasks = serde_json::to_string(ranking.round()).unwrap();
        let tasks: Vec<pompeiu_matching::rank::Task> = serde_json::from_str(&tasks).unwrap();
        assert_eq!(tasks, ranking.round());
        let done = |task: &pompeiu_matching::rank::Task| {
            perform(&prepared, &targets[task.target], &task.action, &HausdorffOptions::default())
        };
        let outcomes: Vec<Outcome> = tasks.iter().map(done).collect();
        let back: Vec<Outcome> = serde_json::from_str(&serde_json::to_string(&outcomes).unwrap()).unwrap();
        assert_eq!(outcomes, back);
        ranking.merge(back).unwrap();
    }
    assert_eq!(ranking.report(), rank_meshes(&template, &targets, &options).unwrap());
}

#[test]
fn a_turned_copy_is_found_by_aligning() {
    let body = transform(&icosphere(1.0, 3).unwrap(), &Affine::scale([2.0, 1.3, 0.8])).unwrap();
    let template = displace_at_random(&body, 0.05, 1).unwrap();
    let mut random = Random::new(9);
    let mut targets = Vec::new();
    for i in 0..8 {
        let other = displace_at_random(&template, 0.01 * f64::from(i), 40 + i as u64).unwrap();
        let turn = Affine::rotate(random.direction(), 180.0 * random.signed_unit()).unwrap();
        let motion = Affine { translation: random.direction().map(|x| 3.0 * x), ..turn };
        targets.push(transform(&other, &motion).unwrap());
    }
    let options = RankOptions { top: 3, alignment: Alignment::Rigid, ..RankOptions::default() };
    let report = rank_meshes(&template, &targets, &options).unwrap();
    let best: Vec<_> = report.ranked().map(|standing| (standing.target, standing.ranks)).collect();
    assert_eq!(best, [(0, Some([1, 1])), (1, Some([2, 2])), (2, Some([3, 3]))]);
    assert!(report.standings[0].upper.unwrap() < 1e-9 && report.standings[0].transform.is_some());
}

#[test]
fn failures_stay_with_their_target_and_bring_others_back() {
    let (template, targets) = rough(6);
    let options = RankOptions { top: 1, ..RankOptions::default() };
    let prepared = Template::new(template.clone(), &options).unwrap();
    let mut ranking = Ranking::new((0..6).map(|i| i.to_string()).collect(), &options).unwrap();
    let mut rounds = 0;
    // The best target can be read once, but not again.
    while !ranking.round().is_empty() {
        let done = |task: &pompeiu_matching::rank::Task| match (&task.action, task.target) {
            (Action::Refine(request), 0) if request.tolerance.value() < 1e-3 => {
                Outcome::Failed("it is gone".to_owned())
            }
            _ => perform(&prepared, &targets[task.target], &task.action, &HausdorffOptions::default()),
        };
        let outcomes = ranking.round().iter().map(done).collect();
        ranking.merge(outcomes).unwrap();
        rounds += 1;
    }
    let report = ranking.report();
    assert!(
        rounds > 2
            && matches!(report.standings[5].status, Status::Failed(_))
            && report.standings[5].target == 0
    );
    let others = rank_meshes(&template, &targets[1..], &options).unwrap();
    let (best, expected) = (&report.standings[0], &others.standings[0]);
    assert_eq!((best.target, best.ranks), (expected.target + 1, Some([1, 1])));
    assert!(best.upper.unwrap() - best.lower.unwrap() < 1e-10);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let (template, targets) = rough(2);
    let with = |top, tolerance| {
        let tolerance = Tolerance::RelativeToDiagonal(tolerance);
        RankOptions { top, tolerance, ..RankOptions::default() }
    };
    assert_eq!(rank_meshes(&template, &targets, &with(0, 1e-3)), Err(RankError::NoPlaces));
    assert_eq!(
        rank_meshes(&template, &targets, &with(1, -1.0)),
        Err(RankError::Option(OptionError::Tolerance(-1.0)))
    );
    assert!(matches!(
        rank_meshes(&template, &targets, &with(1, f64::NAN)),
        Err(RankError::Option(OptionError::Tolerance(_)))
    ));
    assert_eq!(rank_meshes(&template, &[], &with(1, 0.1)), Err(RankError::NoTargets));
    let mut ranking = Ranking::new(vec!["a".to_owned()], &with(1, 0.1)).unwrap();
    assert_eq!(ranking.merge(vec![]), Err(RankError::Results { expected: 1, found: 0 }));
    let refined = pompeiu_matching::rank::Refined { target_to_template: None, template_to_target: None };
    assert_eq!(
        ranking.merge(vec![Outcome::Refined(Box::new(refined))]),
        Err(RankError::Answer { target: 0 })
    );
    assert_eq!(ranking.round().len(), 1);
    let point = TriMesh::new(vec![[0.0; 3]], vec![[0; 3]]).unwrap();
    let rigid = RankOptions { alignment: Alignment::Rigid, ..with(1, 0.1) };
    assert!(matches!(rank_meshes(&point, &targets, &rigid), Err(RankError::Template(_))));
    let report = rank_meshes(&template, &[point, targets[0].clone()], &rigid).unwrap();
    assert!(matches!(&report.standings[1].status, Status::Failed(why) if why.contains("area")), "{report:?}");
}
