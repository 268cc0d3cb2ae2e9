//! Simplified meshes are as near as they say, and smaller.

use crate::operations::topology;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::{self, Diagonal, Ends};
use pompeiu_flow::remesh::{Simplified, SimplifyError, SimplifyOptions, SimplifyTarget, simplify_levels};
use pompeiu_hausdorff::symmetric_hausdorff;

fn simplify(mesh: &TriMesh, target: SimplifyTarget) -> Result<Simplified, SimplifyError> {
    pompeiu_flow::remesh::simplify(mesh, &SimplifyOptions::new(target))
}

#[test]
fn a_sphere_within_a_distance() {
    let sphere = shapes::icosphere(1.0, 4).unwrap();
    let mut before = sphere.faces().len();
    for within in [1e-3, 1e-2, 5e-2] {
        let found = simplify(&sphere, SimplifyTarget::Within(within)).unwrap();
        let faces = found.mesh.faces().len();
        assert!(symmetric_hausdorff(&sphere, &found.mesh).distance.upper() <= within);
        assert!(faces < before, "{faces} faces within {within}");
        assert_eq!(topology(&found.mesh), topology(&sphere));
        before = faces;
    }
    // Faces of a sphere with sagitta s have a circumradius of about sqrt(2 s): fewer than 8 pi / (3 sqrt(3) s / 2) cannot do
    // where vertices may lie s/2 outside and faces s/2 inside; three times as many are enough.
    assert!(before <= 150, "{before} faces");
}

#[test]
fn flat_places_need_no_vertices() {
    let grid = shapes::grid([4.0, 3.0], [16, 12], Diagonal::Rising).unwrap();
    let found = simplify(&grid, SimplifyTarget::Within(1e-6)).unwrap();
    // Collapses are chosen greedily: a few more than the two that would do.
    assert!(found.mesh.faces().len() <= 16, "{} faces", found.mesh.faces().len());
    let cube = shapes::cube(2.0, 5).unwrap();
    let found = simplify(&cube, SimplifyTarget::Within(1e-6)).unwrap();
    assert_eq!(found.mesh.faces().len(), 12);
}

#[test]
fn open_rough_and_several_components() {
    let tube = shapes::cylinder(1.0, 3.0, 40, 30, Ends::Open).unwrap();
    let rough = displace_at_random(&shapes::torus(2.0, 0.7, 60, 40).unwrap(), 0.01, 3).unwrap();
    let parts = pompeiu_core::mesh::merge(&[&tube, &rough]).unwrap();
    for mesh in [&tube, &rough, &parts] {
        let found = simplify(mesh, SimplifyTarget::Within(0.05)).unwrap();
        assert!(found.distance.distance.upper() <= 0.05);
        assert!(found.mesh.faces().len() < mesh.faces().len() / 4);
        assert_eq!(topology(&found.mesh), topology(mesh));
    }
}

#[test]
fn a_number_of_faces_is_kept_to() {
    let sphere = shapes::icosphere(1.0, 4).unwrap();
    let found = simplify(&sphere, SimplifyTarget::Faces(200)).unwrap();
    assert!((190..=200).contains(&found.mesh.faces().len()));
    assert!(found.distance.distance.upper() < 0.1);
    // Nothing is smaller than a tetrahedron.
    let found = simplify(&sphere, SimplifyTarget::Faces(1)).unwrap();
    assert!(found.mesh.faces().len() >= 4);
}

#[test]
fn the_same_bits_at_any_number_of_threads() {
    let mesh = displace_at_random(&shapes::icosphere(1.0, 4).unwrap(), 0.01, 3).unwrap();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| simplify(&mesh, SimplifyTarget::Within(0.1)).unwrap().mesh)
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(8));
}

#[test]
fn what_cannot_be_asked_for() {
    let sphere = shapes::icosphere(1.0, 1).unwrap();
    let error = |target| simplify(&sphere, target).unwrap_err();
    assert_eq!(error(SimplifyTarget::Within(0.0)), SimplifyError::Distance(0.0));
    assert!(matches!(error(SimplifyTarget::Within(f64::NAN)), SimplifyError::Distance(_)));
    assert!(matches!(error(SimplifyTarget::Within(1e-14)), SimplifyError::BelowRounding { .. }));
    assert_eq!(error(SimplifyTarget::Faces(0)), SimplifyError::NoFaces);
}

#[test]
fn the_scale_does_not_matter() {
    let sphere = shapes::icosphere(1.0, 3).unwrap();
    let one = simplify(&sphere, SimplifyTarget::Within(0.01)).unwrap().mesh;
    for scale in [1e-150_f64, 1e150] {
        // Powers of two, so that no coordinate is rounded.
        let scale = scale.log2().round().exp2();
        let positions = sphere.positions().iter().map(|p| p.map(|x| x * scale)).collect();
        let scaled = TriMesh::new(positions, sphere.faces().to_vec()).unwrap();
        let found = simplify(&scaled, SimplifyTarget::Within(0.01 * scale)).unwrap().mesh;
        assert_eq!(found.faces(), one.faces());
    }
}

#[test]
fn each_level_has_its_own_proof() {
    let mesh = displace_at_random(&shapes::icosphere(1.0, 4).unwrap(), 0.005, 3).unwrap();
    let options = SimplifyOptions::new(SimplifyTarget::Within(0.1));
    let levels = simplify_levels(&mesh, &options, 4).unwrap();
    let mut before = mesh.faces().len();
    for (level, within) in levels.iter().zip([0.0125, 0.025, 0.05, 0.1]) {
        assert_eq!(level.target, SimplifyTarget::Within(within));
        assert!(symmetric_hausdorff(&mesh, &level.mesh).distance.upper() <= within);
        assert!(level.mesh.faces().len() < before);
        before = level.mesh.faces().len();
    }
    // Going on from a finer level costs few faces.
    let at_once = simplify(&mesh, SimplifyTarget::Within(0.1)).unwrap().mesh.faces().len();
    assert!(before <= at_once + at_once / 4, "{before} and {at_once}");
    let by_faces = simplify_levels(&mesh, &SimplifyOptions::new(SimplifyTarget::Faces(300)), 3).unwrap();
    let counts: Vec<usize> = by_faces.iter().map(|level| level.mesh.faces().len()).collect();
    assert!(counts.iter().zip([1200, 600, 300]).all(|(n, most)| *n <= most && *n + 20 > most), "{counts:?}");
    assert_eq!(simplify_levels(&mesh, &options, 0).unwrap_err(), SimplifyError::NoLevels);
}
