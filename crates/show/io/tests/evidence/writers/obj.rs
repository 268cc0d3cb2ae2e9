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
        // tobj's parser is not correctly rounded at the extremes, std's is: the text is judged by std below.
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
