//! Meshes: closed forms, conformity, certificates, difficult cases, rejected input, the same bits at any number of threads.

use pompeiu_core::run::{Limits, StopReason};
use pompeiu_neuron::{MeshError, MeshOptions, NeuronMesh, Skeleton, cubic_neuron, mesh_neuron, read_swc};
use pompeiu_volume::volume;
use std::f64::consts::PI;
use std::fmt::Write;
use std::num::NonZeroUsize;

fn skeleton(text: &str) -> Skeleton {
    Skeleton::new(&read_swc(text.as_bytes()).unwrap()).unwrap()
}

fn quick() -> MeshOptions<'static> {
    MeshOptions { measure: false, ..MeshOptions::default() }
}

fn mesh(text: &str, options: &MeshOptions<'_>) -> NeuronMesh {
    let found = mesh_neuron(&skeleton(text), options).unwrap();
    assert!(found.report.certified);
    found
}

fn total(mesh: &NeuronMesh) -> f64 {
    mesh.mesh.cells().iter().map(|&cell| volume(&mesh.mesh.corners(cell))).sum()
}

/// Branches of length 20 from the origin in these directions, with these radii; the first one is that of the root.
fn star(arms: &[([f64; 3], f64)], soma: Option<f64>) -> String {
    let mut text =
        format!("1 {} 0 0 0 {} -1\n", if soma.is_some() { 1 } else { 3 }, soma.unwrap_or(arms[0].1));
    let mut id = 1;
    for ([x, y, z], radius) in arms {
        let norm = (x * x + y * y + z * z).sqrt();
        let mut parent = 1;
        for k in 0..8 {
            let s = (soma.unwrap_or(0.0) + 2.0 * f64::from(k + 1)) / norm;
            id += 1;
            let _ = writeln!(text, "{id} 3 {} {} {} {radius} {parent}", x * s, y * s, z * s);
            parent = id;
        }
    }
    text
}

#[test]
fn a_straight_tube_has_the_volume_of_the_cylinder() {
    for (parts, cells) in [(1, 5), (2, 20), (3, 45)] {
        let found =
            mesh("1 2 0 0 0 1.5 -1\n2 2 4 4 0 1.5 1\n3 2 8 8 0 1.5 2\n", &MeshOptions { parts, ..quick() });
        let length = 8.0 * 2.0_f64.sqrt();
        assert!((total(&found) / (PI * 2.25 * length) - 1.0).abs() < 1e-12, "{parts}: {}", total(&found));
        assert_eq!(found.caps.len(), 2);
        let on = |cap: u32| found.labels.iter().filter(|label| **label == cap).count();
        assert_eq!((on(1), on(2)), (cells, cells));
        assert_eq!((found.caps[0].sample, found.caps[0].is_root), (1, true));
    }
    // A frustum, whose sections are similar. The surface that touches the balls is wider than they are.
    let cone = mesh("1 2 0 0 0 1 -1\n2 2 30 0 0 2 1\n", &quick());
    assert!((total(&cone) / (PI * 30.0 * 7.0 / 3.0 * (900.0 / 899.0)) - 1.0).abs() < 1e-4);
}

#[test]
fn bent_tubes_keep_their_quality() {
    let mut text = String::new();
    for k in 0..60 {
        let a = 0.25 * f64::from(k);
        let parent = if k == 0 { -1 } else { k };
        let (x, y, z) = (4.0 * a.cos(), 4.0 * a.sin(), 0.8 * a);
        let _ = writeln!(text, "{} 2 {x} {y} {z} 1 {parent}", k + 1);
    }
    let found = mesh(&text, &quick());
    assert!(found.report.min_scaled_jacobian > 0.6, "{}", found.report.min_scaled_jacobian);
    assert_eq!(found.faces.components(), 1);
}

#[test]
fn nodes_of_any_degree_are_valid() {
    let y = |degrees: f64| {
        let (s, c) = (0.5 * degrees.to_radians()).sin_cos();
        vec![([-1.0, 0.0, 0.0], 1.0), ([c, s, 0.0], 1.0), ([c, -s, 0.0], 1.0)]
    };
    let mut thin = y(60.0);
    thin[1].1 = 0.05;
    let tripod = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0], [0.2, 0.3, -1.0]];
    let five: Vec<_> = tripod.iter().map(|&d| (d, 1.0)).collect();
    for (arms, least) in [(y(90.0), 0.4), (y(30.0), 0.3), (thin, 0.2), (five[..4].to_vec(), 0.3), (five, 0.2)]
    {
        let found = mesh(&star(&arms, None), &quick());
        let report = &found.report;
        assert!(report.min_scaled_jacobian > least, "{arms:?}: {}", report.min_scaled_jacobian);
        assert_eq!((found.faces.components(), found.caps.len()), (1, arms.len()), "{arms:?}");
        assert!(report.left_out.is_empty());
    }
}

#[test]
fn a_soma_is_a_ball_that_neurites_leave_with_their_own_radius() {
    let arms: Vec<_> =
        [[1.0, 0.0, 0.0], [-1.0, 0.4, 0.0], [0.0, -1.0, 0.3], [0.1, 0.5, 1.0], [0.0, 0.3, -1.0]]
            .map(|d| (d, 1.0))
            .to_vec();
    let found = mesh(&star(&arms, Some(5.0)), &quick());
    assert!(found.report.min_scaled_jacobian > 0.2, "{}", found.report.min_scaled_jacobian);
    // A ball and five cylinders of length 16; the blend and the polygons of the ball cost some percent.
    let expected = 4.0 / 3.0 * PI * 125.0 + 5.0 * PI * 16.0;
    assert!((total(&found) / expected - 1.0).abs() < 0.12, "{} {expected}", total(&found));
}

/// Dendrites from a ball of radius 1, with four samples each, spread evenly by the golden angle.
fn soma(arms: u32, radius: impl Fn(u32) -> f64) -> String {
    let mut text = "1 1 0 0 0 1 -1\n".to_owned();
    for arm in 0..arms {
        let height = 1.0 - (2.0 * f64::from(arm) + 1.0) / f64::from(arms);
        let angle = PI * (3.0 - 5.0_f64.sqrt()) * f64::from(arm);
        let across = (1.0 - height * height).sqrt();
        let direction = [across * libm::cos(angle), across * libm::sin(angle), height];
        for k in 0..4 {
            let s = 1.0 + radius(arm) * f64::from(4 + 5 * k);
            let [x, y, z] = direction.map(|c| c * s);
            let id = 2 + 4 * arm + k;
            let parent = if k == 0 { 1 } else { id - 1 };
            let _ = writeln!(text, "{id} 3 {x} {y} {z} {} {parent}", radius(arm));
        }
    }
    text
}

#[test]
fn thin_dendrites_leave_a_wide_soma() {
    let options = MeshOptions { parts: 1, ..quick() };
    for (arms, ratio) in [(1, 20.0), (3, 10.0), (3, 16.0)] {
        let found = mesh(&soma(arms, |_| 1.0 / ratio), &options);
        assert_eq!(found.caps.len(), arms as usize);
        assert!(found.report.min_scaled_jacobian > 0.2, "{arms} of 1:{ratio}: {:?}", found.report);
    }
    // Thick and thin ones mixed.
    let found = mesh(&soma(12, |arm| if arm % 3 == 0 { 0.2 } else { 0.06 }), &options);
    assert!(found.caps.len() == 12 && found.report.min_scaled_jacobian > 0.2, "{:?}", found.report);
}

#[test]
fn the_wall_is_as_near_to_the_cones_as_its_polygons_allow() {
    let text = "1 2 0 0 0 1 -1\n2 2 20 0 0 1 1\n";
    for (parts, sides) in [(1, 4.0), (2, 8.0), (4, 16.0)] {
        let found = mesh(text, &MeshOptions { parts, ..MeshOptions::default() }).report.wall.unwrap();
        // Corners lie outside by the factor that keeps the area. Points of the circle are farthest from the polygon beside corners.
        let angle = 2.0 * PI / sides;
        let outside = (angle / angle.sin()).sqrt() - 1.0;
        let beside = (1.0 + outside) * (0.5 * angle).cos() - (0.5 * angle).cos();
        let (there, back) = (found.wall_to_cones, found.cones_to_wall);
        assert!(there.lower > outside - 1e-9 && there.upper < outside + 1e-3, "{there:?} {outside}");
        assert!(
            back.lower <= beside + 1e-9 && back.upper >= beside && back.upper < beside + 0.03,
            "{back:?}"
        );
        assert_eq!((there.lower, there.upper), (there.lower_radii, there.upper_radii));
    }
}

#[test]
fn nodes_that_are_too_near_become_one_and_short_tips_are_told() {
    let near =
        "1 2 -12 0 0 1 -1\n2 2 0 0 0 1 1\n3 2 1.5 0 0 1 2\n4 2 14 6 0 1 3\n5 2 14 -6 0 1 3\n6 2 0 0 14 1 2\n";
    let found = mesh(near, &quick());
    assert_eq!((found.caps.len(), found.faces.components()), (4, 1));
    let nodes = found.parts.iter().filter(|part| **part < 0).min();
    assert_eq!(nodes, Some(&-1), "one node");
    let stub = "1 2 -12 0 0 1 -1\n2 2 0 0 0 1 1\n3 2 12 0 0 1 2\n4 2 0 1.2 0 0.9 2\n";
    let found = mesh(stub, &quick());
    assert_eq!((found.caps.len(), found.report.left_out.len()), (2, 1));
    assert!(found.report.left_out[0].starts_with("the branch from sample 2 to 4, 1.2000 long"));
}

#[test]
fn tips_end_as_near_as_their_sections_are_clear() {
    // Beyond a turn of 99°, and two thirds of a radius beside a trunk.
    let turn = "1 2 0 0 0 1 -1\n2 2 8 0 0 1 1\n3 2 7.76 1.48 0 1 2\n";
    let beside = "1 2 -12 0 0 1 -1\n2 2 0 0 0 1 1\n3 2 12 0 0 1 2\n4 2 0 1.5 0 0.9 2\n";
    for text in [turn, beside] {
        let skeleton = skeleton(text);
        let options = MeshOptions::default();
        let linear = mesh_neuron(&skeleton, &options).unwrap().report;
        let cubic = cubic_neuron(&skeleton, &options).unwrap().report;
        for report in [linear, cubic] {
            assert!(report.certified && report.left_out.is_empty(), "{report:?}");
            assert_eq!(report.wall.as_ref().unwrap().is_within(), Some(true), "{report:?}");
        }
    }
}

#[test]
fn what_cannot_be_meshed_is_refused() {
    let y = star(&[([1.0, 0.0, 0.0], 1.0), ([-1.0, 1.0, 0.0], 1.0), ([-1.0, -1.0, 0.0], 1.0)], None);
    let refused = |text: &str, options: &MeshOptions<'_>| mesh_neuron(&skeleton(text), options).unwrap_err();
    let zero = refused("1 2 0 0 0 1 -1\n2 2 9 0 0 0 1\n", &quick());
    assert_eq!(zero, MeshError::ZeroRadius { sample: 2, line: 2 });
    let one_place = "1 2 0 0 0 1 -1\n2 2 0 0 0 1 1\n3 2 0 0 0 1 2\n";
    for points in ["1 2 0 0 0 1 -1\n", one_place] {
        assert_eq!(refused(points, &quick()), MeshError::NoBranch);
        assert_eq!(cubic_neuron(&skeleton(points), &quick()).unwrap_err(), MeshError::NoBranch);
    }
    let beside = mesh(&format!("{one_place}4 2 8 0 0 1 -1\n5 2 16 0 0 1 4\n"), &quick());
    assert_eq!((beside.caps.len(), beside.report.left_out.len()), (2, 1));
    let little = Limits { memory: Some(1 << 20), ..Limits::default() };
    let error = refused(&y, &MeshOptions { limits: little, ..quick() });
    assert!(matches!(error, MeshError::Memory { needed, limit: 1, .. } if needed > 1), "{error}");
    let now = Limits { time: Some(std::time::Duration::ZERO), ..Limits::default() };
    assert_eq!(refused(&y, &MeshOptions { limits: now, ..quick() }), MeshError::Stopped(StopReason::Time));
    for options in [MeshOptions { parts: 0, ..quick() }, MeshOptions { layer: f64::NAN, ..quick() }] {
        assert!(matches!(refused(&y, &options), MeshError::Option { .. }));
    }
}

#[test]
fn branches_with_which_cells_stay_folded_are_left_out_by_name() {
    // Turns of 60 to 120° beside nodes, with next to no room between them.
    let text = "1 3 0 0 0 1 -1\n2 3 2.7079 0 0 0.9288 1\n3 3 3.3393 3.0858 -0.6193 0.9519 2\n\
        4 3 4.6457 1.7473 1.778 0.9244 3\n5 3 2.7649 4.4758 2.8141 0.8506 4\n6 3 3.3255 3.54 4.2623 0.7676 5\n\
        7 3 4.496 4.8227 4.723 0.7976 6\n8 3 5.7947 0.9246 2.232 0.4648 4\n9 3 6.0235 2.6464 2.4623 0.4588 8\n\
        10 3 2.6636 1.9296 5.1073 0.6109 6\n11 3 1.2717 2.4645 3.8224 0.5584 10\n12 3 1.3369 3.1725 4.9896 0.53 11\n\
        13 3 6.2413 0.0036 2.4294 0.3667 8\n14 3 6.8956 0.4126 2.1699 0.3795 13\n";
    let report = mesh(text, &MeshOptions::default()).report;
    assert!(report.certified && report.wall.unwrap().is_within() == Some(false));
    let named = |branch: &String| {
        branch.starts_with("the branch from sample ")
            && branch.contains(" long, is left out: the node at sample ")
    };
    assert!(report.left_out.iter().any(named), "{:?}", report.left_out);
}

#[test]
fn a_root_that_is_left_out_is_told() {
    // The root's branch ends within the ball of its node.
    let text = "1 2 0 1.2 0 0.9 -1\n2 2 0 0 0 1 1\n3 2 12 0 0 1 2\n4 2 -12 0 0 1 2\n";
    let found = mesh(text, &quick());
    assert_eq!((found.caps.len(), found.report.left_out.len()), (2, 2));
    assert!(
        found.report.left_out[1].starts_with("the root, sample 1, is left out, so that flow has no inlet")
    );
    assert!(found.caps.iter().all(|cap| !cap.is_root));
}

#[test]
fn the_same_bits_at_any_number_of_threads() {
    let text = "1 2 -12 0 0 1 -1\n2 2 0 0 0 1 1\n3 2 12 9 0 1 2\n4 2 12 -9 0 1 2\n5 2 24 18 5 1 3\n6 2 24 9 -5 1 3\n";
    let at = |threads| {
        let limits = Limits { threads: NonZeroUsize::new(threads), ..Limits::default() };
        mesh(text, &MeshOptions { parts: 1, limits, ..quick() })
    };
    let one = at(1);
    for threads in [2, 8] {
        let other = at(threads);
        assert_eq!((&one.mesh, &one.parts, &one.labels), (&other.mesh, &other.parts, &other.labels));
    }
}

#[test]
fn turns_are_followed() {
    // Samples 6 radii apart that turn by so much at each.
    for (degrees, least) in [(15.0, 0.6), (40.0, 0.6), (59.0, 0.55), (90.0, 0.45), (120.0, 0.3)] {
        let (mut text, mut place, mut angle) = (String::new(), [0.0_f64; 2], 0.0_f64);
        for i in 0..6_i32 {
            let parent = if i == 0 { -1 } else { i };
            let _ = writeln!(text, "{} 2 {} {} 0 1 {parent}", i + 1, place[0], place[1]);
            place = [place[0] + 6.0 * angle.cos(), place[1] + 6.0 * angle.sin()];
            angle += f64::to_radians(if i % 2 == 0 { degrees } else { -degrees });
        }
        let found = mesh(&text, &MeshOptions::default());
        assert!(found.report.certified && found.report.moved.is_empty(), "{degrees}°: {:?}", found.report);
        assert!(found.report.min_scaled_jacobian > least, "{degrees}°: {}", found.report.min_scaled_jacobian);
        // What a section in the bisecting plane adds outside it nearly takes inside.
        let volume = total(&found) / (PI * 30.0);
        assert!((volume - 1.0).abs() < if degrees > 100.0 { 0.06 } else { 0.03 }, "{degrees}°: {volume}");
        let wall = found.report.wall.unwrap();
        assert_eq!(wall.is_within(), Some(true), "{degrees}°: {wall:?}");
    }
    // Two turns between which there is no room for sections.
    let step = "1 2 0 0 0 1 -1\n2 2 6 0 0 1 1\n3 2 6 1.2 0 1 2\n4 2 12 1.2 0 1 3\n";
    let found = mesh(step, &MeshOptions::default()).report;
    assert!(found.moved.is_empty(), "{found:?}");
    assert_eq!(found.wall.unwrap().is_within(), Some(true));
    // A hook at a tip.
    let hook = mesh("1 2 0 0 0 1 -1\n2 2 6 0 0 1 1\n3 2 6 0.1 0 1 2\n", &MeshOptions::default()).report;
    assert_eq!((hook.left_out.len(), hook.wall.unwrap().is_within()), (1, Some(true)));
}

#[test]
fn branches_that_turn_back_are_divided() {
    for degrees in [130.0, 150.0_f64] {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let text =
            format!("1 2 0 0 0 1 -1\n2 2 12 0 0 1 1\n3 2 {} {} 0 1 2\n", 12.0 + 12.0 * cosine, 12.0 * sine);
        let skeleton = skeleton(&text);
        let options = MeshOptions::default();
        let [linear, cubic] = [
            mesh_neuron(&skeleton, &options).unwrap().report,
            cubic_neuron(&skeleton, &options).unwrap().report,
        ];
        for report in [linear, cubic] {
            assert!(report.certified && report.moved.is_empty(), "{degrees}°: {report:?}");
            let wall = report.wall.unwrap();
            assert_eq!(wall.is_within(), Some(true), "{degrees}°: {wall:?}");
        }
        // Both parts are the same branch.
        let found = mesh_neuron(&skeleton, &quick()).unwrap();
        assert!(found.parts.iter().all(|part| [-1, 0].contains(part)), "{degrees}°");
    }
    // Back on itself: the part that ends within the other is left out, and that is said.
    let back = "1 2 0 0 0 1 -1\n2 2 6 0 0 1 1\n3 2 0.5 0.4 0 1 2\n";
    assert_eq!(mesh(back, &quick()).report.left_out.len(), 1);
}

/// A branch that turns at every sample, shorter between them than it is wide.
const CRUMPLED: &str = "1 2 0.00 0.00 0.00 1.29 -1\n2 2 1.67 -0.11 0.65 0.70 1\n3 2 2.61 -1.37 0.61 1.48 2\n4 2 2.36 -2.71 -0.81 1.32 3\n5 2 2.02 -2.79 -1.78 0.92 4\n6 2 0.89 -2.83 -2.81 1.28 5\n\
    7 2 0.04 -2.52 -3.81 1.39 6\n8 2 -0.62 -2.02 -4.37 1.07 7\n9 2 -1.99 -3.33 -4.97 2.39 8\n10 2 -2.47 -3.77 -5.55 2.48 9\n11 2 -3.07 -3.83 -5.96 1.00 10\n12 2 -3.32 -3.75 -7.20 1.82 11\n";

#[test]
fn turned_branches_between_nodes_have_the_same_cells_in_any_unit() {
    let tree = |unit: f64| {
        let samples = [
            ([-8.0, 0.0, 0.0], -1),
            ([0.0, 0.0, 0.0], 1),
            ([-4.0, 6.0, 0.0], 2),
            ([5.0, -3.0, 0.0], 2),
            ([10.0, -3.0, 3.0], 4),
            ([15.0, -6.0, 8.0], 5),
            ([15.0, -6.0, 0.0], 5),
        ];
        let line = |(k, ([x, y, z], parent)): (usize, &([f64; 3], i32))| {
            format!("{} 3 {} {} {} {unit} {parent}\n", k + 1, unit * x, unit * y, unit * z)
        };
        samples.iter().enumerate().map(line).collect::<String>()
    };
    // The least of branches: those of nodes may be less.
    let least = |unit: f64| {
        let found = mesh(&tree(unit), &quick());
        let cells = found.mesh.cells().iter().zip(&found.parts).filter(|(_, part)| **part >= 0);
        let values = cells.map(|(cell, _)| pompeiu_volume::scaled_jacobian(&found.mesh.corners(*cell)));
        values.fold(f64::INFINITY, f64::min)
    };
    let [one, eighth] = [1.0, 0.125].map(least);
    assert!((one - eighth).abs() < 1e-9 && one > 0.6, "{one} {eighth}");
}

#[test]
fn cells_that_are_not_proven_are_named_with_their_places() {
    assert_eq!(mesh("1 2 0 0 0 1 -1\n2 2 8 0 0 1 1\n", &quick()).report.unproven, []);
    let skeleton = skeleton(CRUMPLED);
    let found = mesh_neuron(&skeleton, &quick()).unwrap();
    let unproven = &found.report.unproven;
    assert!(!found.report.certified && !unproven.is_empty());
    assert!(unproven.windows(2).all(|pair| pair[0].scaled_jacobian <= pair[1].scaled_jacobian));
    for place in unproven {
        let corners = found.mesh.corners(found.mesh.cells()[place.cell]);
        assert_ne!(pompeiu_volume::certify(&corners), pompeiu_volume::Jacobian::Positive);
        let away = |sample: usize| skeleton.samples()[sample].position.distance(place.centre.into());
        let named = skeleton.samples().iter().position(|sample| Some(sample.id) == place.sample).unwrap();
        assert!((0..skeleton.samples().len()).all(|other| away(named) <= away(other)), "{place:?}");
        assert_eq!(place.line, place.sample.map(|sample| sample as usize));
        assert!(corners.iter().any(|p| p.distance(place.centre.into()) < 4.0), "{place:?}");
    }
    let every = found.mesh.cells().iter().filter(|cell| {
        pompeiu_volume::certify(&found.mesh.corners(**cell)) != pompeiu_volume::Jacobian::Positive
    });
    assert_eq!(every.count(), unproven.len());
    let cubic = cubic_neuron(&skeleton, &quick()).unwrap().report;
    assert_eq!(cubic.certified, cubic.unproven.is_empty());
    assert!(cubic.unproven.iter().all(|place| place.line.is_some()) && !cubic.certified);
}
