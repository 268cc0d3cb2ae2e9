//! Real meshes, where they are present: `../shared/data` beside the repository, or the folder named by `POMPEIU_DATA`.

use crate::support::{check_report, overlap};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::subdivide;
use pompeiu_hausdorff::{Enclosure, StopReason, directed_hausdorff};
use pompeiu_testkit::data;

fn read(path: &str) -> Option<TriMesh> {
    Some(pompeiu_io::read(data::file(path)?).expect("a readable mesh").mesh)
}

/// Both meshes of a pair, if they are there.
pub(crate) fn load(name: &str) -> Option<(TriMesh, TriMesh)> {
    load_from(&format!("pairs/{name}/a.obj"), &format!("pairs/{name}/b.obj"))
}

/// Two meshes by their places among the data, if they are there.
pub(crate) fn load_from(a: &str, b: &str) -> Option<(TriMesh, TriMesh)> {
    read(a).zip(read(b))
}

/// The distance of a pair, checked against an interval that other programs enclosed it in.
fn check(name: &str, lower: f64, upper: f64) {
    let Some((a, b)) = load(name) else { return };
    let report = directed_hausdorff(&a, &b);
    println!("{name}: {:?} {:?} {:?}", report.distance, report.work, report.timing);
    assert!(overlap(report.distance, Enclosure::new(lower, upper).unwrap(), 0.0), "{name}: {report:?}");
    assert_eq!(report.stop, StopReason::Tolerance, "{name}: {report:?}");
    check_report(&a, &b, &report);
}

/// Values printed with so many digits stand for an interval of half a unit of the last one to either side.
fn check_digits(name: &str, value: f64, unit: f64) {
    check(name, value - 0.5 * unit, value + 0.5 * unit);
}

#[test]
fn tetrahedral_surface() {
    check_digits("107100", 0.073_072_619_898_8, 1e-13);
}

#[test]
fn smoothed_hand() {
    check("hand", 3.106_126_270, 3.106_126_917);
}

#[test]
fn bunny_decimated_to_a_tenth() {
    check_digits("bunny_dec10", 5.034_138_250e-4, 1e-13);
}

#[test]
fn bunny_decimated_to_a_half() {
    // Printed with eight digits: half a unit of the last one to either side.
    check("bunny_dec50", 1.181_314_25e-4, 1.181_321_35e-4);
}

#[test]
fn armadillo_decimated() {
    check_digits("armadillo_dec10", 4.455_080_450e-3, 1e-12);
}

#[test]
fn spot_and_cow() {
    check_digits("spot_cow", 0.680_551_664_8, 1e-10);
}

#[test]
fn bunny_with_noise() {
    check("bunny_noise1e-5", 1.08772e-5, 1.08783e-5);
}

#[test]
fn coplanar_cubes() {
    check("cube_coplanar_fine_vs_12", 0.0, 0.0);
    // The corners of a rotated cube are rounded.
    check("cube_coplanar_rot", 0.0, 1e-15);
}

/// A mesh against itself and against its subdivision, both ways.
#[test]
fn the_same_surface() {
    for path in [
        "pairs/bunny_dec10/b.obj",
        "pairs/spot_cow/b.obj",
        "pairs/hand/a.obj",
        "meshes/spot.obj",
        "pairs/bunny_dec50/b.obj",
    ] {
        let Some(mesh) = read(path) else {
            println!("skipped: {path} is not there");
            continue;
        };
        let diagonal = Aabb::of_faces(&mesh).diagonal();
        let fine = subdivide(&mesh).unwrap();
        for (a, b) in [(&mesh, &mesh), (&mesh, &fine), (&fine, &mesh)] {
            let report = directed_hausdorff(a, b);
            assert!(report.distance.upper() <= 1e-12 * diagonal, "{path}: {report:?}");
            assert_eq!(report.stop, StopReason::Tolerance, "{path}: {report:?}");
            // Midpoints are rounded.
            assert!(report.distance.lower() <= f64::EPSILON * diagonal, "{path}: {report:?}");
        }
    }
}
