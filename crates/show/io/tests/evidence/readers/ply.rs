//! PLY against ply-rs-bw, which writes the files and reads ours.

use super::meshes::{assert_same, file, wavy_sphere};
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{
    Addable, DefaultElement, ElementDef, Encoding, Ply, Property, PropertyDef, PropertyType, ScalarType,
};
use ply_rs_bw::writer::Writer;
use pompeiu_core::TriMesh;
use pompeiu_io::{Format, OutputFormat, read_bytes};

/// A file by ply-rs-bw that also has properties and elements unrelated to the surface.
fn written_by_the_other(mesh: &TriMesh, encoding: Encoding, single: bool) -> Vec<u8> {
    let coordinate = |x: f64| if single { Property::Float(x as f32) } else { Property::Double(x) };
    let kind = PropertyType::Scalar(if single { ScalarType::Float } else { ScalarType::Double });
    let list = |index, item| PropertyType::List(index, item);
    let mut ply = Ply::<DefaultElement>::new();
    ply.header.encoding = encoding;
    let mut element = |name: &str, properties: Vec<(&str, PropertyType)>, rows: Vec<DefaultElement>| {
        let mut definition = ElementDef::new(name.to_owned());
        definition.count = rows.len();
        for (name, kind) in properties {
            definition.properties.add(PropertyDef::new(name.to_owned(), kind));
        }
        ply.header.elements.add(definition);
        ply.payload.insert(name.to_owned(), rows);
    };
    let row = |entries: Vec<(&str, Property)>| -> DefaultElement {
        let mut row = DefaultElement::new();
        for (name, value) in entries {
            row.insert(name.to_owned(), value);
        }
        row
    };
    element(
        "camera",
        vec![("view", list(ScalarType::UChar, ScalarType::Float))],
        (0..3).map(|i| row(vec![("view", Property::ListFloat(vec![1.5; i]))])).collect(),
    );
    element(
        "vertex",
        vec![
            ("z", kind.clone()),
            ("red", PropertyType::Scalar(ScalarType::UChar)),
            ("x", kind.clone()),
            ("y", kind),
        ],
        mesh.positions()
            .iter()
            .map(|&[x, y, z]| {
                row(vec![
                    ("z", coordinate(z)),
                    ("red", Property::UChar(13)),
                    ("x", coordinate(x)),
                    ("y", coordinate(y)),
                ])
            })
            .collect(),
    );
    element(
        "face",
        vec![
            ("quality", PropertyType::Scalar(ScalarType::Short)),
            ("vertex_indices", list(ScalarType::UChar, ScalarType::Int)),
            ("texture", list(ScalarType::UChar, ScalarType::Float)),
        ],
        mesh.faces()
            .iter()
            .map(|face| {
                row(vec![
                    ("quality", Property::Short(-7)),
                    ("vertex_indices", Property::ListInt(face.iter().map(|&i| i.cast_signed()).collect())),
                    ("texture", Property::ListFloat(vec![0.5; (face[0] % 3) as usize])),
                ])
            })
            .collect(),
    );
    let mut bytes = Vec::new();
    Writer::new().write_ply(&mut bytes, &mut ply).unwrap();
    bytes
}

/// What ply-rs-bw reads.
fn second_reading(bytes: &[u8]) -> TriMesh {
    let ply: Ply<DefaultElement> = Parser::new().read_ply(&mut &*bytes).unwrap();
    let coordinate = |element: &DefaultElement, name: &str| match element[name] {
        Property::Float(x) => f64::from(x),
        Property::Double(x) => x,
        ref other => panic!("{name} is {other:?}"),
    };
    let positions =
        ply.payload["vertex"].iter().map(|v| ["x", "y", "z"].map(|name| coordinate(v, name))).collect();
    let faces = ply.payload["face"]
        .iter()
        .map(|face| match &face["vertex_indices"] {
            Property::ListInt(list) => [0, 1, 2].map(|k: usize| u32::try_from(list[k]).unwrap()),
            other => panic!("vertex_indices is {other:?}"),
        })
        .collect();
    TriMesh::new(positions, faces).unwrap()
}

#[test]
fn files_of_the_other_are_read_in_every_encoding() {
    let mesh = wavy_sphere(25);
    for encoding in [Encoding::Ascii, Encoding::BinaryLittleEndian, Encoding::BinaryBigEndian] {
        for single in [false, true] {
            let bytes = written_by_the_other(&mesh, encoding, single);
            let found = read_bytes(&bytes, None).unwrap();
            assert_eq!(found.format, Format::Ply);
            let second = second_reading(&bytes);
            let what = format!("{encoding:?}, single precision: {single}");
            if single && encoding == Encoding::Ascii {
                // ply-rs-bw rounds the written value to single precision, as the header says; we keep it.
                let rounded = found.mesh.positions().iter().map(|p| p.map(|x| f64::from(x as f32))).collect();
                let rounded = TriMesh::new(rounded, found.mesh.faces().to_vec()).unwrap();
                assert_same(&rounded, &second, &what);
                continue;
            }
            assert_same(&found.mesh, &second, &what);
            if !single {
                assert_same(&found.mesh, &mesh, &format!("{encoding:?}"));
            }
        }
    }
}

#[test]
fn our_files_are_read_by_both() {
    let mesh = wavy_sphere(50);
    let bytes = file(OutputFormat::Ply, &mesh);
    assert_same(&read_bytes(&bytes, None).unwrap().mesh, &mesh, "our own file");
    assert_same(&second_reading(&bytes), &mesh, "our own file read by the other");
}
