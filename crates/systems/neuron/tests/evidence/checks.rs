//! What a check says of a skeleton, beside what its mesh does.

use crate::walls::Random;
use glam::DVec3;
use pompeiu_neuron::{
    MeshOptions, Meshability, ProblemKind, Skeleton, WallDistance, mesh_neuron, meshability, read_swc,
};
use pompeiu_testkit::effort::cases;
use std::fmt::Write;

fn skeleton(text: &str) -> Skeleton {
    Skeleton::new(&read_swc(text.as_bytes()).unwrap()).unwrap()
}

fn check(text: &str) -> Meshability {
    meshability(&skeleton(text), &MeshOptions::default()).unwrap()
}

/// A branch that turns at every sample, shorter between them than it is wide.
const CRUMPLED: &str = "1 2 0.00 0.00 0.00 2.00 -1\n2 2 1.12 -0.36 -1.27 2.00 1\n3 2 0.95 -1.16 -1.83 2.00 2\n4 2 0.63 -1.69 -2.42 2.00 3\n5 2 -0.08 -2.54 -2.36 2.00 4\n6 2 0.27 -2.91 -2.29 2.00 5\n\
    7 2 0.79 -4.00 -1.35 2.00 6\n8 2 0.99 -4.40 -1.34 2.00 7\n9 2 0.80 -5.45 -1.38 2.00 8\n10 2 1.68 -6.43 -1.19 2.00 9\n11 2 2.27 -6.52 -0.93 2.00 10\n12 2 3.48 -7.29 -0.33 2.00 11\n";

/// Turns that nothing follows, a branch that turns back into itself, a twig within its node, branches that cross, narrow angles, no radius, and
/// points only.
const HARD: [(&str, ProblemKind, i64); 7] = [
    (CRUMPLED, ProblemKind::SharpTurn, 1),
    ("1 2 0 0 0 1 -1\n2 2 6 0 0 1 1\n3 2 0.5 0.6 0 1 2\n", ProblemKind::TooShort, 3),
    ("1 2 0 0 0 1 -1\n2 2 8 0 0 1 1\n3 2 16 0 0 1 2\n4 2 8 1.1 0 0.6 2\n", ProblemKind::TooShort, 4),
    (
        "1 2 0 0 0 1 -1\n2 2 10 0 0 1 1\n3 2 10 10 0 1 2\n4 2 5 10 0 1 3\n5 2 5 -6 0.5 1 4\n",
        ProblemKind::Overlap,
        2,
    ),
    (
        "1 2 0 0 0 1 -1\n2 2 6 0 0 1 1\n3 2 16 3 0 1 2\n4 2 16 -3 0 1 2\n5 2 16 0 0.5 1 2\n",
        ProblemKind::Node,
        2,
    ),
    ("1 2 0 0 0 1 -1\n2 2 8 0 0 0 1\n", ProblemKind::ZeroRadius, 2),
    ("1 2 0 0 0 1 -1\n", ProblemKind::NoBranch, 1),
];

#[test]
fn what_cannot_be_meshed_is_named_with_its_cause() {
    for (text, kind, sample) in HARD {
        let found = check(text);
        let first = &found.problems[0];
        assert_eq!((first.kind, first.sample, found.meshable), (kind, sample, Some(false)), "{found:?}");
    }
}

/// What the mesh itself is: `Some(true)` if every cell is proven valid and the wall is within the tolerance.
fn meshed(text: &str) -> Option<bool> {
    let Ok(mesh) = mesh_neuron(&skeleton(text), &MeshOptions::default()) else { return Some(false) };
    let within = mesh.report.wall.as_ref().map_or(Some(true), WallDistance::is_within);
    if mesh.report.certified { within } else { Some(false) }
}

/// A branch that turns and forks at random angles, into branches of random radii.
fn tree(random: &mut Random) -> String {
    let mut text = String::from("1 2 0 0 0 1 -1\n2 2 6 0 0 1 1\n");
    let mut id = 2;
    for _ in 0..=usize::from(random.next() < 0.7) {
        let (mut p, mut parent, mut d) = (DVec3::X * 6.0, 2, random.turned(DVec3::X, 120.0));
        let radius = random.between(0.3, 1.0);
        for _ in 0..2 {
            p += d * random.between(1.0, 7.0);
            id += 1;
            let _ = writeln!(text, "{id} 2 {} {} {} {radius} {parent}", p.x, p.y, p.z);
            (parent, d) = (id, random.turned(d, 90.0));
        }
    }
    text
}

#[test]
fn a_check_agrees_with_the_mesh() {
    let mut random = Random(5);
    let mut counts = [0; 2];
    for case in 0..cases(12) {
        let text = tree(&mut random);
        let (found, mesh) = (check(&text), meshed(&text));
        assert_eq!(found.meshable, mesh, "{case}: {found:?}\n{text}");
        assert_eq!(found.problems.is_empty(), mesh != Some(false), "{case}: {found:?}\n{text}");
        counts[usize::from(mesh == Some(true))] += 1;
    }
    assert!(counts.iter().all(|count| *count > 0), "{counts:?}");
}
