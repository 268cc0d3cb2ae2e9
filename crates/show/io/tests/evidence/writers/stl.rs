//! STL, read back by `stl_io`.

use super::encoded;
use super::meshes::{single_precision_mesh, tetrahedron};
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_io::{Attributes, EncodeError, OutputFormat, encode};
use proptest::prelude::*;
use std::io::Cursor;

fn triangles(mesh: &TriMesh) -> Vec<stl_io::Triangle> {
    let mut bytes = Cursor::new(encoded(OutputFormat::Stl, mesh, &Attributes::for_mesh(mesh)));
    stl_io::create_stl_reader(&mut bytes).unwrap().map(Result::unwrap).collect()
}

proptest! {
    #[test]
    fn corners_are_the_nearest_single_precision_numbers(mesh in single_precision_mesh()) {
        let read = triangles(&mesh);
        prop_assert_eq!(read.len(), mesh.faces().len());
        for (triangle, face) in read.iter().zip(mesh.faces()) {
            let expected = face.map(|v| mesh.positions()[v as usize].map(|x| (x as f32).to_bits()));
            prop_assert_eq!(triangle.vertices.map(|corner| corner.0.map(f32::to_bits)), expected);
            let length = triangle.normal.0.map(f64::from).iter().map(|x| x * x).sum::<f64>();
            prop_assert!(length == 0.0 || (length - 1.0).abs() < 1e-6, "normal of length {}", length.sqrt());
        }
    }
}

#[test]
fn normals_point_outward_at_any_scale() {
    for scale in [1e-200, 1e-30, 1.0, 1e38] {
        let positions = tetrahedron().positions().iter().map(|p| p.map(|x| x * scale)).collect();
        let read = triangles(&TriMesh::new(positions, tetrahedron().faces().to_vec()).unwrap());
        let third = (1.0_f64 / 3.0).sqrt() as f32;
        let expected = [[0.0, 0.0, -1.0], [0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [third; 3]];
        for (triangle, normal) in read.iter().zip(expected) {
            for k in 0..3 {
                assert!((triangle.normal.0[k] - normal[k]).abs() < 1e-6, "{scale:e}: {:?}", triangle.normal);
            }
        }
    }
}

#[test]
fn overflow_is_an_error_before_the_first_byte() {
    let past = f64::from(f32::MAX) * (1.0 + f64::EPSILON);
    for (value, fits) in [(f64::from(f32::MAX), true), (past, true), (3.41e38, false), (-1e200, false)] {
        let mesh = TriMesh::new(vec![[0.0; 3], [0.0, value, 0.0]], vec![[0, 1, 0]]).unwrap();
        let mut bytes = Vec::new();
        let result = encode(&mut bytes, OutputFormat::Stl, &mesh, &Attributes::for_mesh(&mesh));
        if fits {
            result.unwrap();
        } else {
            let error = result.unwrap_err();
            assert!(
                matches!(error, EncodeError::SinglePrecision { vertex: VertexId(1), axis: 1, value: v, .. } if v == value)
            );
            assert!(error.to_string().starts_with("coordinate y of vertex 1 is "), "{error}");
            assert!(bytes.is_empty());
        }
    }
}
