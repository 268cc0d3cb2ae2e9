//! Tricubic meshes: closed forms, certificates, quality, distance from the tubes, the same bits at any number of threads.

use crate::flows::{FORK, FORKED};
use pompeiu_core::run::Limits;
use pompeiu_neuron::{CubicMesh, MeshOptions, Skeleton, cubic_neuron, read_swc};
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
    let distance = found.report.surface_distance.unwrap();
    // The tubes have 64 sides; the triangles are 8 to each side of a patch.
    assert!(distance.upper < 0.02 * 1.5, "{distance:?}");
    assert!(found.report.min_scaled_jacobian > 0.8, "{:?}", found.report);
    // A frustum, whose sections are scaled alike, and which cubics along it follow exactly.
    let cone = cubic("1 2 0 0 0 1 -1\n2 2 30 0 0 2 1\n", &quick());
    assert!((cone.mesh.volume() / (PI * 30.0 * 7.0 / 3.0) - 1.0).abs() < 1e-12);
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
