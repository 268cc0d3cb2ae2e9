//! PLY, read back by ply-rs-bw.

use super::encoded;
use super::meshes::{any_mesh, bits, fully_attributed};
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Ply, Property};
use pompeiu_io::{Attributes, OutputFormat};
use proptest::prelude::*;

fn parsed(bytes: &[u8]) -> Ply<DefaultElement> {
    Parser::new().read_ply(&mut &bytes[..]).unwrap()
}

fn double(element: &DefaultElement, name: &str) -> f64 {
    match element[name] {
        Property::Double(value) => value,
        ref other => panic!("{name} is {other:?}"),
    }
}

fn color(element: &DefaultElement) -> [u8; 3] {
    ["red", "green", "blue"].map(|name| match element[name] {
        Property::UChar(value) => value,
        ref other => panic!("{name} is {other:?}"),
    })
}

fn corners(element: &DefaultElement) -> [u32; 3] {
    match &element["vertex_indices"] {
        Property::ListInt(list) => [0, 1, 2].map(|k| u32::try_from(list[k]).unwrap()),
        other => panic!("vertex_indices is {other:?}"),
    }
}

proptest! {
    #[test]
    fn mesh_alone(mesh in any_mesh()) {
        let ply = parsed(&encoded(OutputFormat::Ply, &mesh, &Attributes::for_mesh(&mesh)));
        let positions: Vec<_> = ply.payload["vertex"].iter().map(|v| ["x", "y", "z"].map(|k| double(v, k))).collect();
        prop_assert_eq!(bits(&positions), bits(mesh.positions()));
        prop_assert_eq!(&ply.payload["face"].iter().map(corners).collect::<Vec<_>>()[..], mesh.faces());
    }

    #[test]
    fn every_attribute((mesh, attributes) in fully_attributed()) {
        let ply = parsed(&encoded(OutputFormat::Ply, &mesh, &attributes));
        let (vertices, faces) = (&ply.payload["vertex"], &ply.payload["face"]);
        prop_assert_eq!(&vertices.iter().map(color).collect::<Vec<_>>()[..], attributes.vertex_colors().unwrap());
        prop_assert_eq!(&faces.iter().map(color).collect::<Vec<_>>()[..], attributes.face_colors().unwrap());
        let both = attributes.vertex_scalars().map(|s| (s, vertices)).chain(attributes.face_scalars().map(|s| (s, faces)));
        for ((name, values), elements) in both {
            let read: Vec<u64> = elements.iter().map(|e| double(e, name).to_bits()).collect();
            prop_assert_eq!(read, values.iter().map(|x| x.to_bits()).collect::<Vec<_>>());
        }
        prop_assert_eq!(&faces.iter().map(corners).collect::<Vec<_>>()[..], mesh.faces());
    }
}
