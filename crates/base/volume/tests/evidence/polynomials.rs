//! Rules, values and faces of tricubic polynomials against closed forms and differences.

use glam::DVec3;
use pompeiu_volume::bernstein::{GAUSS_4, GAUSS_5, derivatives, interpolate_lattice, value};
use pompeiu_volume::{BezierMesh, CORNER_PLACES, CORNERS_OF_64, FACES, HexMesh, face_points, place_of_64};

#[test]
fn rules_are_exact_for_their_degrees() {
    for degree in 0..10 {
        let exact = 1.0 / f64::from(degree + 1);
        let sum = |rule: &[(f64, f64)]| rule.iter().map(|(t, w)| w * t.powi(degree)).sum::<f64>();
        assert!((sum(&GAUSS_5) - exact).abs() < 1e-15, "{degree}");
        assert!(degree > 7 || (sum(&GAUSS_4) - exact).abs() < 1e-15, "{degree}");
    }
}

#[test]
fn coefficients_give_the_values_they_interpolate() {
    let values = std::array::from_fn(|k| {
        let x = k as f64;
        DVec3::new(scattered(x), scattered(2.0 * x + 1.0), x * x)
    });
    let points = interpolate_lattice(&values);
    for (k, expected) in values.iter().enumerate() {
        let at = [k % 4, k / 4 % 4, k / 16].map(|i| i as f64 / 3.0);
        assert!((value(&points, at) - *expected).length() < 1e-10);
    }
    let h = 1e-6;
    let [du, ..] = derivatives(&points, [0.3, 0.6, 0.2]);
    let difference = (value(&points, [0.3 + h, 0.6, 0.2]) - value(&points, [0.3 - h, 0.6, 0.2])) / (2.0 * h);
    assert!((du - difference).length() < 1e-4 * du.length());
}

fn scattered(x: f64) -> f64 {
    (x * 12.9898).fract() * 3.0
}

#[test]
fn corners_and_faces_are_those_of_the_trilinear_cell() {
    for (corner, k) in CORNERS_OF_64.into_iter().enumerate() {
        assert_eq!(place_of_64(k).map(|p| p / 3), CORNER_PLACES[corner]);
    }
    let mesh = HexMesh::grid([1, 1, 1], [2.0, 3.0, 5.0]);
    let cubic = BezierMesh::from_trilinear(&mesh);
    let middle = DVec3::new(1.0, 1.5, 2.5);
    for (face, corners) in FACES.iter().enumerate() {
        let centre: DVec3 =
            corners.iter().map(|&k| mesh.positions()[mesh.cells()[0][k] as usize]).sum::<DVec3>() / 4.0;
        let area: DVec3 = face_points(&cubic.control(0), face).iter().map(|(_, area)| *area).sum();
        let outward = (centre - middle).normalize();
        assert!((area.normalize() - outward).length() < 1e-14, "{face} {area} {outward}");
        let [p, _] = [0, 1].map(|k| value(&cubic.control(0), face_points(&cubic.control(0), face)[k].0));
        assert!((p - centre).dot(outward).abs() < 1e-12);
    }
}
