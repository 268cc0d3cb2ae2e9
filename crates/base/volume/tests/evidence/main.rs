//! Evidence for hexahedral meshes.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod hierarchy;
mod polynomials;
mod scaled_bounds;
mod splines;
mod unstructured;

use glam::DVec3;
use pompeiu_volume::{
    CellData, Faces, HexMesh, Jacobian, VolumeError, certify, scaled_jacobian, volume, write_vtu,
};

const UNIT: [DVec3; 8] = [
    DVec3::new(0.0, 0.0, 0.0),
    DVec3::new(1.0, 0.0, 0.0),
    DVec3::new(1.0, 1.0, 0.0),
    DVec3::new(0.0, 1.0, 0.0),
    DVec3::new(0.0, 0.0, 1.0),
    DVec3::new(1.0, 0.0, 1.0),
    DVec3::new(1.0, 1.0, 1.0),
    DVec3::new(0.0, 1.0, 1.0),
];

/// Sample points along each axis of a cell, less one.
const N: usize = 10;

struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The determinant of the trilinear map by its shape functions, independent of the code under test.
fn determinant(corners: &[DVec3; 8], [u, v, w]: [f64; 3]) -> f64 {
    let mut rows = [DVec3::ZERO; 3];
    for (p, place) in corners.iter().zip(UNIT) {
        let factor = |x: f64, side: f64| if side > 0.5 { x } else { 1.0 - x };
        let slope = |side: f64| if side > 0.5 { 1.0 } else { -1.0 };
        let (a, b, c) = (factor(u, place.x), factor(v, place.y), factor(w, place.z));
        rows[0] += *p * slope(place.x) * b * c;
        rows[1] += *p * slope(place.y) * a * c;
        rows[2] += *p * slope(place.z) * a * b;
    }
    rows[0].dot(rows[1].cross(rows[2]))
}

#[test]
fn certificates_agree_with_dense_samples() {
    let mut random = Random(5);
    let (mut positive, mut folded) = (0, 0);
    for trial in 0..1000 {
        let size = 0.2 + 0.5 * f64::from(trial % 10) / 10.0;
        let mut shift = || size * (random.next() - 0.5) * 2.0;
        let corners = UNIT.map(|p| p + DVec3::new(shift(), shift(), shift()));
        let places = (0..=N).flat_map(|i| (0..=N).flat_map(move |j| (0..=N).map(move |k| [i, j, k])));
        let least = places
            .map(|place| determinant(&corners, place.map(|i| i as f64 / N as f64)))
            .fold(f64::INFINITY, f64::min);
        match certify(&corners) {
            Jacobian::Positive => {
                positive += 1;
                assert!(least > 0.0, "{least}");
            }
            Jacobian::Folded => {
                folded += 1;
                assert!(scaled_jacobian(&corners) < 0.9);
            }
            Jacobian::Undecided => assert!(least.abs() < 0.05, "{least}"),
        }
        assert!(certify(&corners) != Jacobian::Folded || least < 0.02);
    }
    assert!(positive > 100 && folded > 100, "{positive} {folded}");
}

#[test]
fn cells_that_are_folded_inside_only_are_found() {
    let mut random = Random(9);
    let mut hidden = 0;
    for _ in 0..20_000 {
        let mut shift = || 1.2 * (random.next() - 0.5);
        let corners = UNIT.map(|p| p + DVec3::new(shift(), shift(), shift()));
        let at_corners = UNIT.map(|p| determinant(&corners, p.to_array()));
        if at_corners.iter().all(|d| *d > 1e-3) && certify(&corners) == Jacobian::Folded {
            hidden += 1;
            let places = (0..=N).flat_map(|i| (0..=N).flat_map(move |j| (0..=N).map(move |k| [i, j, k])));
            let least = places.map(|place| determinant(&corners, place.map(|i| i as f64 / N as f64)));
            assert!(least.fold(f64::INFINITY, f64::min) < 0.02);
        }
    }
    assert!(hidden > 3, "{hidden}");
}

#[test]
fn flat_and_mirrored_cells_are_not_positive() {
    assert_eq!(certify(&UNIT), Jacobian::Positive);
    assert_eq!(certify(&UNIT.map(|p| p * DVec3::new(1.0, 1.0, -1.0))), Jacobian::Folded);
    assert_eq!(certify(&UNIT.map(|p| p * DVec3::new(1.0, 1.0, 0.0))), Jacobian::Undecided);
    let tiny = UNIT.map(|p| p * DVec3::new(1.0, 1.0, 1e-12) + DVec3::splat(0.25));
    assert_eq!(certify(&tiny), Jacobian::Positive);
    let mut folded = UNIT;
    folded[6] = DVec3::new(0.2, 0.2, 0.2);
    assert_eq!(certify(&folded), Jacobian::Folded);
}

#[test]
fn volumes_and_scaled_jacobians_are_closed_forms() {
    let skew = UNIT.map(|p| DVec3::new(2.0 * p.x + p.z, 3.0 * p.y, p.z));
    assert!((volume(&skew) - 6.0).abs() < 1e-14);
    assert!((scaled_jacobian(&skew) - 0.5_f64.sqrt()).abs() < 1e-15);
    // A frustum: the mean of the areas, and a third of the product of the differences.
    let frustum = UNIT.map(|p| DVec3::new(p.x * (2.0 - p.z), p.y * (2.0 - p.z), p.z));
    assert!((volume(&frustum) - 7.0 / 3.0).abs() < 1e-14);
}

#[test]
fn faces_of_a_grid_are_counted_and_look_outwards() {
    let mesh = HexMesh::grid([4, 3, 2], [1.0, 1.0, 1.0]);
    let faces = Faces::new(&mesh).unwrap();
    assert_eq!((faces.inner().len(), faces.boundary().len(), faces.components()), (46, 52, 1));
    // Divergence theorem: the boundary encloses the sum of the volumes.
    let enclosed: f64 = faces
        .boundary()
        .iter()
        .map(|face| {
            let [a, b, c, d] = face.vertices.map(|v| mesh.positions()[v as usize]);
            a.dot((c - a).cross(d - b)) / 6.0
        })
        .sum();
    assert!((enclosed - 1.0).abs() < 1e-13, "{enclosed}");
    let two = HexMesh::new(
        mesh.positions()
            .iter()
            .copied()
            .chain(mesh.positions().iter().map(|p| *p + DVec3::X * 9.0))
            .collect(),
        mesh.cells().iter().copied().chain(mesh.cells().iter().map(|c| c.map(|v| v + 60))).collect(),
    )
    .unwrap();
    assert_eq!(Faces::new(&two).unwrap().components(), 2);
}

#[test]
fn wrong_meshes_are_refused() {
    let mesh = HexMesh::grid([1, 1, 1], [1.0; 3]);
    let cell = mesh.cells()[0];
    let positions = mesh.positions().to_vec();
    assert!(matches!(
        HexMesh::new(positions.clone(), vec![cell.map(|v| v + 1)]),
        Err(VolumeError::Index { .. })
    ));
    assert!(matches!(HexMesh::new(positions.clone(), vec![[cell[0]; 8]]), Err(VolumeError::Repeated { .. })));
    let same = HexMesh::new(positions.clone(), vec![cell, cell]).unwrap();
    assert_eq!(Faces::new(&same), Err(VolumeError::NotConforming { cells: [0, 1] }));
    let mut infinite = positions;
    infinite[3].y = f64::INFINITY;
    assert_eq!(HexMesh::new(infinite, vec![cell]), Err(VolumeError::NotFinite { vertex: 3 }));
}

#[test]
fn files_state_what_they_hold() {
    let mesh = HexMesh::grid([2, 1, 1], [2.0, 1.0, 1.0]);
    let mut bytes = Vec::new();
    let data = [CellData { name: "part", values: &[0.0, 1.0], components: 1 }];
    write_vtu(&mut bytes, &mesh, &[], &data).unwrap();
    let marker = b"<AppendedData encoding=\"raw\">\n_";
    let start = bytes.windows(marker.len()).position(|w| w == marker).unwrap() + marker.len();
    let number = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize;
    // Each array begins with its length in bytes.
    let mut at = start;
    for length in [12 * 24, 2 * 64, 2 * 8, 2, 2 * 8] {
        assert_eq!(number(at), length);
        at += 8 + length;
    }
    assert!(bytes[at..].starts_with(b"\n</AppendedData>"));
    let wrong = [CellData { name: "part", values: &[0.0], components: 1 }];
    assert!(write_vtu(Vec::new(), &mesh, &[], &wrong).is_err());
}
