//! OBJ, read back by tobj.

use super::encoded;
use super::meshes::{any_mesh, bits, colored, tetrahedron};
use pompeiu_core::TriMesh;
use pompeiu_io::{Attributes, OutputFormat};
use proptest::prelude::*;

/// tobj renumbers vertices in the order faces use them, so positions are compared corner by corner.
fn corners(bytes: &[u8]) -> (Vec<[f64; 3]>, Vec<[f64; 3]>) {
    let no_materials = |_: &std::path::Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) =
        tobj::load_obj_buf(&mut &bytes[..], &tobj::LoadOptions::default(), no_materials).unwrap();
    let [model] = &models[..] else { panic!("{} models", models.len()) };
    let triple = |values: &[f64], i: u32| [0, 1, 2].map(|k| values[3 * i as usize + k]);
    let of = |values: &[f64]| {
        if values.is_empty() {
            return Vec::new();
        }
        model.mesh.indices.iter().map(|&i| triple(values, i)).collect()
    };
    (of(&model.mesh.positions), of(&model.mesh.vertex_color))
}

fn expected(mesh: &TriMesh) -> Vec<[f64; 3]> {
    mesh.faces().as_flattened().iter().map(|&v| mesh.positions()[v as usize]).collect()
}

proptest! {
    #[test]
    fn coordinates_keep_every_bit(mesh in any_mesh()) {
        let bytes = encoded(OutputFormat::Obj, &mesh, &Attributes::for_mesh(&mesh));
        // tobj's parser is not correctly rounded at the extremes; std's is, and judges the text below.
        let text = String::from_utf8(bytes).unwrap();
        let rows = |tag: &'static str| {
            text.lines().filter_map(move |line| line.strip_prefix(tag)).map(|row| row.split(' ').collect::<Vec<_>>())
        };
        let positions: Vec<[f64; 3]> = rows("v ").map(|row| [0, 1, 2].map(|k| row[k].parse().unwrap())).collect();
        let faces: Vec<[u32; 3]> = rows("f ").map(|row| [0, 1, 2].map(|k| row[k].parse::<u32>().unwrap() - 1)).collect();
        prop_assert_eq!(bits(&positions), bits(mesh.positions()));
        prop_assert_eq!(&faces[..], mesh.faces());
        prop_assert_eq!(text.lines().count(), positions.len() + faces.len());
    }

    #[test]
    fn tobj_reads_the_same_corners_and_colors((mesh, attributes) in colored(any_mesh())) {
        let (positions, colors) = corners(&encoded(OutputFormat::Obj, &mesh, &attributes));
        prop_assert_eq!(positions, expected(&mesh));
        let colors: Vec<[u8; 3]> = colors.iter().map(|c| c.map(|x| (x * 255.0).round() as u8)).collect();
        let written = attributes.vertex_colors().unwrap();
        let expected: Vec<_> = mesh.faces().as_flattened().iter().map(|&v| written[v as usize]).collect();
        prop_assert_eq!(colors, expected);
    }
}

#[test]
fn small_numbers_read_well() {
    let mesh = tetrahedron();
    let text = String::from_utf8(encoded(OutputFormat::Obj, &mesh, &Attributes::for_mesh(&mesh))).unwrap();
    assert_eq!(text, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
}

/// A tetrahedron whose first vertex has other texture coordinates in each face, and coordinates that nothing uses.
pub(super) fn with_seams() -> (TriMesh, Vec<[f64; 2]>, Vec<[u32; 3]>) {
    let mesh = tetrahedron();
    let places =
        vec![[0.1, 0.9], [1.0 / 3.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.2, 0.7], [0.3, 0.5], [9.0, 9.0]];
    let corners = vec![[0, 2, 1], [4, 1, 3], [5, 3, 2], [1, 2, 3]];
    (mesh, places, corners)
}

#[test]
fn texture_coordinates_keep_every_bit_and_their_seams() {
    let (mesh, places, corners) = with_seams();
    let attributes = Attributes::for_mesh(&mesh).with_texture(places.clone(), corners.clone(), None).unwrap();
    let bytes = encoded(OutputFormat::Obj, &mesh, &attributes);
    let no_materials = |_: &std::path::Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) =
        tobj::load_obj_buf(&mut &bytes[..], &tobj::LoadOptions::default(), no_materials).unwrap();
    let read = &models[0].mesh;
    for (f, face) in mesh.faces().iter().enumerate() {
        for i in 0..3 {
            let (v, t) = (read.indices[3 * f + i] as usize, read.texcoord_indices[3 * f + i] as usize);
            assert_eq!(read.positions[3 * v..3 * v + 3], mesh.positions()[face[i] as usize]);
            assert_eq!(read.texcoords[2 * t..2 * t + 2], places[corners[f][i] as usize]);
        }
    }
    // Our own reader ignores them.
    let again = pompeiu_io::read_bytes(&bytes, Some(pompeiu_io::Format::Obj)).unwrap();
    assert_eq!(again.mesh.faces(), mesh.faces());
}

#[test]
fn places_that_do_not_exist_are_refused() {
    let (mesh, places, mut corners) = with_seams();
    let none = || Attributes::for_mesh(&mesh);
    assert!(none().with_texture(places.clone(), corners[1..].to_vec(), None).is_err());
    corners[2][1] = 7;
    let error = none().with_texture(places.clone(), corners.clone(), None).unwrap_err();
    assert_eq!(error.to_string(), "face 2 names texture coordinates 7, but there are 7 (the first is 0)");
    corners[2][1] = 6;
    let attributes = none().with_texture(places, corners, Some(vec![1])).unwrap();
    for format in OutputFormat::ALL {
        let written = pompeiu_io::encode(&mut Vec::new(), format, &mesh, &attributes);
        assert_eq!(written.is_ok(), format == OutputFormat::Glb, "{format:?}");
    }
}
