//! Given fields: by name, by formula, by vectors in space.

use pompeiu_core::FaceId;
use pompeiu_core::mesh::FaceData;
use pompeiu_core::mesh::shapes::{Diagonal, grid, icosphere, torus};
use pompeiu_operators::{FieldSource, FieldSourceError, random_field, rotation_field, tangent_field};
use pompeiu_surface::EmbeddedSurface;

#[test]
fn rotating_a_plane_about_its_normal_is_tangent_everywhere() {
    let mesh = grid([2.0, 2.0], [3, 3], Diagonal::Rising).unwrap();
    let surface = EmbeddedSurface::new(&mesh).unwrap();
    for (face, &u) in mesh.face_ids().zip(&rotation_field(&surface, [0.0, 0.0, 2.0])) {
        let corners = mesh.corners(face);
        let [x, y] = [0, 1].map(|i| corners.iter().map(|p| p[i]).sum::<f64>() / 3.0);
        let [a, b, c] = surface.to_space(face, u);
        assert!((a + 2.0 * y).abs() < 1e-14 && (b - 2.0 * x).abs() < 1e-14 && c.abs() < 1e-14);
    }
}

#[test]
fn normal_parts_are_left_out_and_measured() {
    let mesh = icosphere(1.0, 1).unwrap();
    let surface = EmbeddedSurface::new(&mesh).unwrap();
    let field = random_field(surface.mesh(), 4);
    let lifted = FaceData::from_fn(field.len(), |face| {
        let tangent = surface.to_space(face, field[face]);
        let normal = surface.frame(face)[2];
        [0, 1, 2].map(|i| tangent[i] - 3.0 * normal[i])
    });
    let (found, normal) = tangent_field(&surface, &lifted);
    assert!((normal - 3.0).abs() < 1e-14);
    assert!(found.iter().zip(&field).all(|(u, w)| (u[0] - w[0]).abs() + (u[1] - w[1]).abs() < 1e-14));
    assert_eq!(field, random_field(surface.mesh(), 4));
    assert_ne!(field, random_field(surface.mesh(), 5));
}

#[test]
fn fields_are_told_apart() {
    let parse = |text: &str| text.parse::<FieldSource>();
    assert_eq!(parse("rotation:z"), Ok(FieldSource::Rotation([0.0, 0.0, 1.0])));
    assert_eq!(parse("gradient:x*y"), Ok(FieldSource::Gradient("x*y".to_owned())));
    assert_eq!(parse("random:7"), Ok(FieldSource::Random(7)));
    assert_eq!(parse("harmonic:1"), Ok(FieldSource::Harmonic(1)));
    assert_eq!(parse("wind.csv"), Ok(FieldSource::File("wind.csv".into())));
    assert_eq!(parse("C:wind.csv"), Ok(FieldSource::File("C:wind.csv".into())));
    for wrong in ["rotation:w", "rotation:0,0,0", "rotation:1,inf,0", "random:-1", "harmonic:x"] {
        assert!(parse(wrong).is_err(), "{wrong}");
    }
    for text in ["rotation:0,-1.5,2", "gradient:0,1,1", "random:7", "harmonic:1", "C:wind.csv"] {
        assert_eq!(parse(text).unwrap().to_string(), text);
    }
}

#[test]
fn directions_are_linear_functions() {
    let surface = EmbeddedSurface::new(&torus(2.0, 0.7, 12, 8).unwrap()).unwrap();
    let field = |text: &str| text.parse::<FieldSource>().unwrap().field(&surface, &[], None).unwrap().field;
    let (by_direction, by_expression) = (field("gradient:0,-1,2"), field("gradient:2*z-y"));
    for ((_, a), (_, b)) in by_direction.entries().zip(by_expression.entries()) {
        assert!((a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12);
    }
    assert_eq!(field("gradient:y").entries().count(), 192);
}

#[test]
fn vectors_are_checked_and_made_tangent() {
    let surface = EmbeddedSurface::new(&torus(2.0, 0.7, 12, 8).unwrap()).unwrap();
    let of = |source: FieldSource| source.field(&surface, &[], None);
    let along = of(FieldSource::Vectors(vec![[0.0, 0.0, 3.0]; 192])).unwrap();
    assert!(along.normal_part > 1.0 && !along.is_tangent);
    let found = of(FieldSource::Vectors(vec![[0.0; 3]; 5])).unwrap_err();
    assert_eq!(found, FieldSourceError::Length { found: 5, expected: 192 });
    let mut vectors = vec![[0.0; 3]; 192];
    vectors[3][1] = f64::INFINITY;
    let found = of(FieldSource::Vectors(vectors)).unwrap_err();
    assert!(matches!(found, FieldSourceError::NotFinite { face: FaceId(3), .. }));
    let found = of(FieldSource::Harmonic(2)).unwrap_err();
    assert_eq!(found, FieldSourceError::Harmonic { index: 2, dimension: 0 });
    assert!(matches!(of(FieldSource::File("a.csv".into())), Err(FieldSourceError::NotRead { .. })));
}
