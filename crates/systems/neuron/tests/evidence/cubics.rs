//! Tricubic meshes: closed forms, certificates, quality, distance from the tubes, the same bits at any number of threads.

use crate::flows::{FORK, FORKED};
use pompeiu_core::run::Limits;
use pompeiu_neuron::{
    CubicMesh, MeshError, MeshOptions, RefineAt, RefineOptions, Skeleton, SplineReport, cubic_neuron,
    read_swc, refined_splines, refined_vtu,
};
use pompeiu_volume::SplineSpace;
use std::f64::consts::PI;
use std::num::NonZeroUsize;
use std::path::Path;

fn cubic(text: &str, options: &MeshOptions<'_>) -> CubicMesh {
    let skeleton = Skeleton::new(&read_swc(text.as_bytes()).unwrap()).unwrap();
    let found = cubic_neuron(&skeleton, options).unwrap();
    assert!(found.report.certified, "{:?}", found.report);
    found
}

fn quick() -> MeshOptions<'static> {
    MeshOptions { measure: false, ..MeshOptions::default() }
}

#[test]
fn straight_tubes_have_the_volume_and_the_wall_of_the_cylinder() {
    let options = MeshOptions::default();
    let found = cubic("1 2 0 0 0 1.5 -1\n2 2 4 4 0 1.5 1\n3 2 8 8 0 1.5 2\n", &options);
    let length = 8.0 * 2.0_f64.sqrt();
    assert!((found.mesh.volume() / (PI * 2.25 * length) - 1.0).abs() < 1e-12, "{}", found.mesh.volume());
    assert_eq!((found.caps.len(), found.mesh.cells().len()), (2, 20));
    // Polygons of twelve sides.
    let share = 6.0 * libm::sin(PI / 6.0) / PI;
    assert!((found.report.linear.unwrap().volume - share).abs() < 1e-3, "{:?}", found.report.linear);
    let wall = found.report.wall.unwrap();
    assert!(wall.wall_to_cones.upper_radii < 0.03 && wall.cones_to_wall.upper_radii < 0.04, "{wall:?}");
    assert!(found.report.min_scaled_jacobian > 0.8);
    // A frustum: its sections are similar. The surface that touches the balls is wider than they are.
    let cone = cubic("1 2 0 0 0 1 -1\n2 2 30 0 0 2 1\n", &quick());
    assert!((cone.mesh.volume() / (PI * 30.0 * 7.0 / 3.0 * (900.0 / 899.0)) - 1.0).abs() < 1e-4);
}

#[test]
fn furcations_are_certified_and_conform() {
    let found = &*FORKED;
    assert!(found.report.certified, "{:?}", found.report);
    assert!(found.report.min_scaled_jacobian >= 0.5, "{:?}", found.report);
    assert_eq!((found.faces.components(), found.caps.len()), (1, 3));
    let one = Limits { threads: NonZeroUsize::new(1), ..Limits::default() };
    assert_eq!(cubic(FORK, &MeshOptions { limits: one, ..quick() }).mesh, found.mesh);
}

#[test]
fn narrow_furcations_do_not_fold() {
    // A branch half as thick at 30° from its parent: the cells of the usual complex fold between the points where shape is measured.
    let text = "1 2 0 0 0 1 -1\n2 2 10 0 0 1 1\n3 2 20 0 0 1 2\n4 2 18.660254 5 0 0.5 2\n";
    let found = cubic(text, &MeshOptions::default()).report;
    assert!(found.min_scaled_jacobian > 0.3, "{found:?}");
    assert_eq!(found.wall.unwrap().is_within(), Some(true));
}

#[test]
fn tubes_do_not_fold_where_the_radius_jumps() {
    // A ball four times as wide as its neighbours, nearer to them than its radius.
    let line = |i: i32| {
        let radius = if i == 6 { 4.0 } else { 1.0 };
        format!("{i} 2 {} 0 0 {radius} {}\n", 2 * i, if i == 1 { -1 } else { i - 1 })
    };
    let text: String = (1..12).map(line).collect();
    let found = cubic(&text, &MeshOptions::default()).report;
    assert!(found.min_scaled_jacobian > 0.3, "{found:?}");
    assert_eq!(found.wall.unwrap().is_within(), Some(true));
}

#[test]
fn splines_are_refined_at_nodes_ends_walls_branches_and_samples() {
    let mesh = &*FORKED;
    let skeleton = Skeleton::new(&read_swc(FORK.as_bytes()).unwrap()).unwrap();
    let refine = |names: &[&str], times: usize| {
        let at: Vec<RefineAt> =
            names.iter().map(|name| RefineAt::from_name(name, Some(&skeleton)).unwrap()).collect();
        let limits = Limits::default();
        refined_splines(mesh, &RefineOptions { elements: 1, at: &at, times, limits, progress: None })
    };
    let plain = refine(&[], 0).unwrap();
    assert_eq!(plain.functions(), SplineSpace::new(&mesh.mesh, 1).functions());
    for (names, times) in [
        (&["nodes"][..], 1),
        (&["ends"], 2),
        (&["wall"], 1),
        (&["branch=1", "sample=4"], 1),
        (&["ball=6,0,0,0.5"], 2),
    ] {
        let splines = refine(names, times).unwrap();
        let report = SplineReport::of_refined(&splines);
        assert_eq!(report.levels.len(), times + 1, "{names:?}");
        assert!(report.partition_of_unity_error <= 1e-14, "{report:?}");
        assert!(report.levels.iter().skip(1).all(|level| level.elements > 0 && level.functions > 0));
        let cells = splines.cells(&mesh.mesh).unwrap();
        assert!((cells.volume() / mesh.mesh.volume() - 1.0).abs() < 1e-13);
        let marked = splines.elements().iter().filter(|element| match names[0] {
            "nodes" => mesh.parts[element.patch as usize] < 0,
            "branch=1" => mesh.parts[element.patch as usize] == 1,
            _ => false,
        });
        assert!(marked.clone().all(|element| usize::from(element.level) == times), "{names:?}");
        let text = String::from_utf8_lossy(&refined_vtu(mesh, &splines, false).unwrap()).into_owned();
        assert!(text.contains(&format!("NumberOfCells=\"{}\"", splines.elements().len())));
    }
    assert!(matches!(refine(&["branch=7"], 1), Err(MeshError::Place { .. })));
    assert!(matches!(refine(&["nodes"], 6), Err(MeshError::Option { .. })));
    for name in ["node", "sample=9", "ball=1,2", "branch=x"] {
        assert!(matches!(RefineAt::from_name(name, Some(&skeleton)), Err(MeshError::Place { .. })), "{name}");
    }
    assert!(matches!(RefineAt::from_name("nodes", None), Err(MeshError::Place { .. })));
    let at = [RefineAt::Nodes];
    let limits = Limits { memory: Some(1 << 20), ..Limits::default() };
    let little = RefineOptions { elements: 4, at: &at, times: 1, limits, progress: None };
    assert!(matches!(refined_splines(mesh, &little), Err(MeshError::Memory { .. })));
}

#[test]
fn skeletons_of_neurons_reach_half_in_tricubic_mode() {
    let folder = std::env::var("POMPEIU_DATA").unwrap_or_else(|_| "../../../../shared/data".to_owned());
    let path = Path::new(&folder).join("neurons").join("bifurcation").join("skeleton_smooth.swc");
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("left out: {}", path.display());
        return;
    };
    let found = cubic(&text, &quick());
    println!("{:?}", found.report);
    assert!(found.report.min_scaled_jacobian >= 0.5, "{:?}", found.report);
}
