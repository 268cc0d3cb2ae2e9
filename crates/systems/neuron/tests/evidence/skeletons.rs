//! Skeletons in all dialects, their defects, repairs and smoothing.

use pompeiu_neuron::{
    ProblemKind, Skeleton, SkeletonReport, SmoothOptions, Soma, SwcError, SwcRow, problems, read_swc, smooth,
    write_swc,
};
use std::fmt::Write;
use std::path::Path;

fn skeleton(text: &str) -> Skeleton {
    Skeleton::new(&read_swc(text.as_bytes()).unwrap()).unwrap()
}

fn kinds(text: &str) -> Vec<(ProblemKind, i64)> {
    problems(&skeleton(text)).iter().map(|problem| (problem.kind, problem.sample)).collect()
}

/// The parent of a sample in a chain.
fn parent(sample: usize) -> String {
    if sample == 0 { "-1".to_owned() } else { sample.to_string() }
}

/// A tube along x with a sample every half micrometre.
fn tube(length: usize, radius: f64) -> String {
    let row = |i: usize| format!("{} 3 {} 0 0 {radius} {}\n", i + 1, 0.5 * i as f64, parent(i));
    (0..=2 * length).map(row).collect()
}

#[test]
fn order_does_not_matter() {
    let rows =
        read_swc(b"1 2 0 0 0 1 -1\n2 2 4 0 0 1 1\n3 2 8 0 0 1 2\n4 2 8 4 0 1 3\n5 2 8 -4 0 1 3\n").unwrap();
    let sorted = Skeleton::new(&rows).unwrap();
    let mut turned = rows.clone();
    turned.reverse();
    let other = Skeleton::new(&turned).unwrap();
    assert_eq!(sorted.branches(), [vec![0, 1, 2], vec![2, 3], vec![2, 4]]);
    let ids = |s: &Skeleton| s.samples().iter().map(|sample| sample.id).collect::<Vec<_>>();
    // Children come in the order of the file.
    assert_eq!((ids(&sorted), ids(&other)), (vec![1, 2, 3, 4, 5], vec![1, 2, 3, 5, 4]));
    for i in 0..5 {
        assert!(other.parent(i).is_none_or(|parent| parent < i));
    }
}

#[test]
fn the_soma_is_one_three_or_many_points() {
    let point = skeleton("1 1 0 0 0 5 -1\n2 3 9 0 0 1 1\n");
    assert_eq!((point.soma(), point.samples().len()), (Soma::Point, 2));
    let three = skeleton("1 1 0 0 0 5 -1\n2 1 0 5 0 5 1\n3 1 0 -5 0 5 1\n4 3 9 0 0 1 1\n5 3 0 9 0 1 2\n");
    assert_eq!((three.soma(), three.samples().len(), three.branches().len()), (Soma::ThreePoints, 3, 2));
    assert_eq!(three.parent(2), Some(0), "what continued a point that is left out continues its parent");
    let chain = skeleton("1 1 0 0 0 5 -1\n2 1 0 5 0 4 1\n3 1 0 12 0 3 2\n4 3 0 20 0 1 3\n");
    assert_eq!((chain.soma(), chain.samples().len()), (Soma::Cylinders, 4));
    assert_eq!(skeleton("7 2 0 0 0 5 -1\n").soma(), Soma::None);
}

#[test]
fn a_tree_that_is_none_is_refused_and_located() {
    let error = |text: &str| Skeleton::new(&read_swc(text.as_bytes()).unwrap()).unwrap_err();
    assert_eq!(
        error("1 2 0 0 0 1 -1\n\n2 2 1 0 0 1 9\n"),
        SwcError::MissingParent { line: 3, id: 2, parent: 9 }
    );
    assert_eq!(
        error("1 2 0 0 0 1 -1\n2 2 1 0 0 1 4\n3 2 1 0 0 1 2\n4 2 1 0 0 1 3\n5 2 0 0 0 1 4\n"),
        SwcError::Cycle { line: 2, id: 2, length: 3 }
    );
    assert_eq!(error("1 2 0 0 0 1 1\n"), SwcError::Cycle { line: 1, id: 1, length: 1 });
    assert_eq!(error("1 2 0 0 0 1 -1\n1 2 1 0 0 1 -1\n"), SwcError::Duplicate { line: 2, id: 1, first: 1 });
    assert_eq!(error("1 2 0 0 0 -2 -1\n"), SwcError::NegativeRadius { line: 1, id: 1, radius: -2.0 });
}

#[test]
fn repairs_are_done_when_asked_and_told() {
    let rows = read_swc(
        b"1 2 0 0 0 2 -1\n2 2 5 0 0 0 1\n3 2 20 0 0 1 2\n4 2 20 0 0 1 3\n5 2 30 0 0 -1 4\n6 2 9 9 9 1 77\n7 2 9 9 8 1 8\n8 2 9 9 7 1 7\n",
    )
    .unwrap();
    let (skeleton, repairs) = Skeleton::repaired(&rows).unwrap();
    let told: Vec<String> = repairs.iter().map(ToString::to_string).collect();
    assert_eq!(
        told,
        [
            "sample 6 (line 6) became a root: its parent 77 does not exist",
            "sample 7 (line 7) became a root: it continued itself",
            "sample 4 (line 4) was left out: it lies where its parent 3 lies",
            "sample 2 (line 2) has the radius 1.750000 instead of 0",
            "sample 5 (line 5) has the radius 1.000000 instead of -1",
        ]
    );
    assert_eq!((skeleton.samples().len(), skeleton.roots().count()), (7, 3));
    let (_, again) = Skeleton::repaired(&skeleton.rows()).unwrap();
    assert!(again.is_empty(), "a repaired skeleton needs no repair");
    let short = read_swc(b"1 2 0 0 0 3 -1\n2 2 9 0 0 3 1\n3 2 19 0 0 3 2\n4 2 9 2 0 1 2\n").unwrap();
    let (skeleton, repairs) = Skeleton::repaired(&short).unwrap();
    // The furcation no longer exists.
    assert_eq!((skeleton.branches().len(), repairs.len()), (1, 1));
}

#[test]
fn problems_are_found_where_they_are_and_nowhere_else() {
    assert_eq!(kinds(&tube(10, 1.0)), []);
    assert_eq!(
        kinds("1 2 0 0 0 1 -1\n2 2 9 0 0 0 1\n3 2 9 0 0 1 2\n4 2 50 0 0 1 -1\n5 2 60 0 0 1 4\n"),
        [(ProblemKind::SeveralRoots, 4), (ProblemKind::ZeroRadius, 2), (ProblemKind::Coincident, 3)]
    );
    // A tip inside the ball of its node, and two furcations that are too near.
    let short = "1 2 0 0 0 3 -1\n2 2 9 0 0 3 1\n3 2 19 0 0 3 2\n4 2 9 2 0 1 2\n";
    assert_eq!(kinds(short), [(ProblemKind::TooShort, 4)]);
    let near =
        "1 2 0 0 0 1 -1\n2 2 9 0 0 1 1\n3 2 10 0 0 1 2\n4 2 9 9 0 1 2\n5 2 20 0 0 1 3\n6 2 14 -9 0 1 3\n";
    assert_eq!(kinds(near), [(ProblemKind::TooShort, 3)]);
    // Two branches that leave in the same direction.
    let along = "1 2 0 0 0 1 -1\n2 2 9 0 0 1 1\n3 2 30 0 0 1 2\n4 2 29 0.5 0 1 2\n";
    assert!(kinds(along).iter().all(|(kind, _)| *kind == ProblemKind::Inside), "{:?}", kinds(along));
    assert_eq!(kinds(along).len(), 1);
}

#[test]
fn overlaps_are_those_of_tubes_and_not_of_samples() {
    // Two trees that cross with samples far from the crossing.
    let crossing = |height: f64| {
        format!("1 2 -9 0 0 1 -1\n2 2 9 0 0 1 1\n3 2 0 -9 {height} 0.5 -1\n4 2 0 9 {height} 0.5 3\n")
    };
    let found = problems(&skeleton(&crossing(1.2)));
    let overlap = found.iter().find(|problem| problem.kind == ProblemKind::Overlap).unwrap();
    assert_eq!((overlap.branch, overlap.other_branch), (Some(0), Some(1)));
    assert!((overlap.value - 0.3).abs() < 1e-9, "{}", overlap.value);
    assert!(kinds(&crossing(1.6)).iter().all(|(kind, _)| *kind != ProblemKind::Overlap));
    // A branch that returns to its neighbour after leaving it.
    let back = "1 2 0 0 0 1 -1\n2 2 10 0 0 1 1\n3 2 20 0 0 1 2\n4 2 30 0 0 1 3\n5 2 40 0 0 1 4\n6 2 10 6 0 1 2\n7 2 25 6 0 1 6\n8 2 25 1 0 1 7\n";
    let found = problems(&skeleton(back));
    assert!(
        found
            .iter()
            .any(|p| p.kind == ProblemKind::Overlap && p.branch == Some(1) && p.other_branch == Some(2)),
        "{found:?}"
    );
    // A coil that runs into itself, and one that does not.
    let coil = |pitch: f64| {
        let row = |i: usize| {
            let angle = i as f64 * 0.2;
            let (x, y, z) = (5.0 * angle.cos(), 5.0 * angle.sin(), pitch * angle / std::f64::consts::TAU);
            format!("{} 2 {x} {y} {z} 1 {}\n", i + 1, parent(i))
        };
        (0..80).map(row).collect::<String>()
    };
    assert_eq!(kinds(&coil(1.5)).len(), 1);
    assert_eq!(kinds(&coil(2.5)), []);
}

#[test]
fn sharp_turns_depend_on_the_radius() {
    let bend = |radius: f64| {
        let mut text = tube(10, radius);
        for i in 1..=20 {
            let _ = writeln!(text, "{} 3 10 {} 0 {radius} {}", 21 + i, 0.5 * f64::from(i), 20 + i);
        }
        text
    };
    let found = problems(&skeleton(&bend(2.0)));
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].kind, found[0].sample), (ProblemKind::SharpTurn, 21));
    assert!((found[0].value - 90.0).abs() < 1e-9);
    // An arc of radius 5 turns by less than 60° within 4 either way, by more within 6.
    let arc = |radius: f64| {
        let row = |i: usize| {
            let angle = i as f64 * 0.05;
            format!("{} 2 {} {} 0 {radius} {}\n", i + 1, 5.0 * angle.cos(), 5.0 * angle.sin(), parent(i))
        };
        (0..=60).map(row).collect::<String>()
    };
    assert_eq!(kinds(&arc(4.0)), []);
    assert_eq!(kinds(&arc(6.0)).first().map(|found| found.0), Some(ProblemKind::SharpTurn));
}

#[test]
fn smoothing_says_how_far_it_moves() {
    let straight = skeleton(&tube(10, 1.0));
    let (same, deviation) = smooth(&straight, &SmoothOptions { steps: 20, spacing: Some(0.25) });
    assert_eq!(same.samples().len(), 41);
    assert!(deviation.position < 1e-12 && deviation.radius < 1e-12);
    let bump = skeleton("1 2 0 0 0 1 -1\n2 2 1 0 0 1 1\n3 2 2 1 0 2 2\n4 2 3 0 0 1 3\n5 2 4 0 0 1 4\n");
    let (_, deviation) = smooth(&bump, &SmoothOptions { steps: 1, spacing: None });
    // The middle goes half way to its neighbours, (1, 0) and (3, 0), and these rise by a quarter; its radius likewise.
    assert_eq!((deviation.sample, deviation.position), (3, 0.5));
    assert!((deviation.radius - 0.5).abs() < 1e-12, "{}", deviation.radius);
    let text = write_swc(&smooth(&bump, &SmoothOptions { steps: 1, spacing: None }).0.rows());
    assert_eq!(skeleton(&text).samples().len(), 5);
}

#[test]
fn damaged_bytes_never_panic() {
    let text = tube(6, 1.0);
    let mut state = 3_u64;
    for _ in 0..400 {
        let mut bytes = text.clone().into_bytes();
        for _ in 0..4 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let at = (state >> 33) as usize % bytes.len();
            bytes[at] = (state >> 20) as u8;
        }
        if let Ok(rows) = read_swc(&bytes) {
            let _ = Skeleton::new(&rows);
            if let Ok((repaired, _)) = Skeleton::repaired(&rows) {
                let _ = problems(&repaired);
            }
        }
    }
}

/// Properties of another program's skeletons, counted from its files; skipped if they are not present.
#[test]
fn skeletons_of_neurons() {
    let folder = std::env::var("POMPEIU_DATA").unwrap_or_else(|_| "../../../../shared/data".to_owned());
    for (name, samples, tips, overlaps) in [
        ("bifurcation", 58, 2, 0),
        ("cylinder", 21, 1, 0),
        ("NMO_66748", 1145, 35, 0),
        ("NMO_00865", 4848, 357, 2),
    ] {
        let path = Path::new(&folder).join("neurons").join(name).join("skeleton_smooth.swc");
        let Ok(bytes) = std::fs::read(&path) else {
            println!("left out: {}", path.display());
            continue;
        };
        let rows: Vec<SwcRow> = read_swc(&bytes).unwrap();
        let report = SkeletonReport::new(&Skeleton::new(&rows).unwrap(), None, None);
        let found = report.problems.iter().filter(|p| p.kind == ProblemKind::Overlap).count();
        assert_eq!(
            (report.samples, report.tips, found),
            (samples, tips, overlaps),
            "{name}: {:?}",
            report.problems
        );
    }
}
