//! Texture coordinates and colours stay where they were on a simplified mesh.

use pompeiu_core::mesh::shapes::{self, Ends};
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_remesh::{
    Carrier, CarryError, CornerValues, Features, Simplified, SimplifyOptions, SimplifyTarget, simplify,
};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

const RADIUS: f64 = 1.0;
const HEIGHT: f64 = 3.0;

/// A tube, and its development cut open at angle 0: angle and height.
fn tube() -> (TriMesh, CornerValues<2>) {
    let mesh = shapes::cylinder(RADIUS, HEIGHT, 48, 36, Ends::Open).unwrap();
    let mut values = Vec::new();
    let mut corners = Vec::new();
    for face in mesh.faces() {
        let points = face.map(|v| mesh.positions()[v as usize]);
        let angles = points.map(|p| p[1].atan2(p[0]).rem_euclid(TAU));
        let wraps = angles.iter().any(|a| *a > 0.75 * TAU);
        corners.push([0, 1, 2].map(|i| {
            let angle = if wraps && angles[i] < 0.25 * TAU { angles[i] + TAU } else { angles[i] };
            values.push([angle, points[i][2]]);
            values.len() as u32 - 1
        }));
    }
    (mesh, CornerValues { values, corners })
}

fn simplified(mesh: &TriMesh, seams: &[[VertexId; 2]], within: f64) -> Simplified {
    let options = SimplifyOptions {
        features: Features { edges: seams, ..Features::default() },
        ..SimplifyOptions::new(SimplifyTarget::Within(within))
    };
    simplify(mesh, &options).unwrap()
}

#[test]
fn a_development_stays_open_along_its_seam() {
    let (mesh, values) = tube();
    let carrier = Carrier::new(&mesh, values, &[]).unwrap();
    let seams = carrier.seams();
    assert_eq!(seams.len(), 36, "the edges of one generator");
    let light = simplified(&mesh, &seams, 0.02);
    assert!(light.mesh.faces().len() < mesh.faces().len() / 4);
    let carried = carrier.carry(&light.mesh, &light.kept).unwrap();
    let mut area = 0.0;
    let mut doubled = BTreeSet::new();
    for (face, corners) in light.mesh.faces().iter().zip(&carried.corners) {
        let places = corners.map(|i| carried.values[i as usize]);
        for (v, place) in face.iter().zip(places) {
            let p = light.mesh.positions()[*v as usize];
            let turn = (place[0] - p[1].atan2(p[0])).rem_euclid(TAU);
            assert!(turn.min(TAU - turn) < 0.02, "{place:?} at {p:?}");
            assert!((place[1] - p[2]).abs() < 0.02, "{place:?} at {p:?}");
            if place[0].min(TAU - place[0]) < 1e-3 {
                doubled.insert((v, place[0] > 1.0));
            }
        }
        let [[a, b], [c, d], [e, f]] = places;
        let twice = (c - a) * (f - b) - (e - a) * (d - b);
        assert!(twice > 0.0, "the face of {places:?} is turned over");
        area += 0.5 * twice;
    }
    // The development is covered once: a face that crossed the seam would take area away or add it.
    assert!((area / (TAU * HEIGHT) - 1.0).abs() < 1e-3, "{area}");
    assert_eq!(doubled.len() % 2, 0, "each vertex of the seam has two places");
    assert!(carried.values.len() < light.mesh.positions().len() + doubled.len());
}

#[test]
fn values_at_vertices_have_no_seam_but_between_groups() {
    let (mesh, _) = tube();
    let heights = || CornerValues { values: mesh.positions().to_vec(), corners: mesh.faces().to_vec() };
    assert!(Carrier::new(&mesh, heights(), &[]).unwrap().seams().is_empty());
    let middle = |face: &[u32; 3]| face.iter().map(|v| mesh.positions()[*v as usize][2]).sum::<f64>() / 3.0;
    let centre = mesh.positions().iter().map(|p| p[2]).sum::<f64>() / mesh.positions().len() as f64;
    let groups: Vec<u32> = mesh.faces().iter().map(|face| u32::from(middle(face) > centre)).collect();
    let carrier = Carrier::new(&mesh, heights(), &groups).unwrap();
    assert_eq!(carrier.seams().len(), 48, "the edges of one circle");
    let light = simplified(&mesh, &carrier.seams(), 0.02);
    // The circle is kept, so every face of the result lies on one side of it.
    for (face, below) in light.mesh.faces().iter().zip(carrier.faces_below(&light.mesh)) {
        let heights = face.map(|v| light.mesh.positions()[v as usize][2] - centre);
        let sign = if groups[below as usize] == 1 { 1.0 } else { -1.0 };
        assert!(heights.iter().all(|h| sign * h > -1e-9), "{heights:?}");
    }
    // Values at vertices stay values at vertices.
    let carried = carrier.carry(&light.mesh, &light.kept).unwrap();
    assert_eq!(carried.values.len(), light.mesh.positions().len());
}

#[test]
fn at_any_scale() {
    let (mesh, values) = tube();
    let seams = Carrier::new(&mesh, values.clone(), &[]).unwrap().seams();
    let light = simplified(&mesh, &seams, 0.02);
    let scaled = |mesh: &TriMesh, by: f64| {
        let positions = mesh.positions().iter().map(|p| p.map(|x| x * by)).collect();
        TriMesh::new(positions, mesh.faces().to_vec()).unwrap()
    };
    let carried = |by| {
        let carrier = Carrier::new(&scaled(&mesh, by), values.clone(), &[]).unwrap();
        carrier.carry(&scaled(&light.mesh, by), &light.kept).unwrap()
    };
    assert_eq!(carried(1.0), carried(2.0_f64.powi(-600)));
    assert_eq!(carried(1.0), carried(2.0_f64.powi(600)));
}

#[test]
fn values_that_do_not_belong_are_refused() {
    let (mesh, mut values) = tube();
    let found = Carrier::new(&mesh, values.clone(), &[0]).err().unwrap();
    assert_eq!(found, CarryError::Faces { found: 1, expected: mesh.faces().len() });
    values.corners[5][1] = 1 << 20;
    let found = Carrier::new(&mesh, values.clone(), &[]).err().unwrap();
    assert!(matches!(found, CarryError::Index { face: 5, index: 1_048_576, .. }), "{found}");
    values.corners.pop();
    assert!(matches!(Carrier::new(&mesh, values, &[]), Err(CarryError::Faces { .. })));
}
