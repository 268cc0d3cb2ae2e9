//! VTP and VTU, read back by vtkio, which supports appended data in base64 only: the test re-encodes the raw bytes first.

use super::encoded;
use super::meshes::{any_mesh, bits, fully_attributed};
use base64::{Engine, prelude::BASE64_STANDARD};
use pompeiu_io::{Attributes, OutputFormat};
use proptest::prelude::*;
use vtkio::IOBuffer;
use vtkio::model::{
    Attribute, CellType, DataSet, Piece, PolyDataPiece, UnstructuredGridPiece, VertexNumbers, Vtk,
};

const END: &[u8] = b"\n</AppendedData>\n</VTKFile>\n";

/// The same file with each appended array in base64, at its new offset.
fn with_base64(bytes: &[u8]) -> Vec<u8> {
    let begin = bytes.windows(2).position(|pair| pair == b"\n_").unwrap() + 2;
    let mut xml = String::from_utf8(bytes[..begin].to_vec()).unwrap();
    let mut rest = &bytes[begin..];
    let (mut raw_offset, mut encoded) = (0, String::new());
    while rest != END {
        let length = 8 + u64::from_le_bytes(rest[..8].try_into().unwrap()) as usize;
        let from = format!(" offset=\"{raw_offset}\"/>");
        assert_eq!(xml.matches(&from).count(), 1, "{from}");
        xml = xml.replace(&from, &format!(" offset=\"{} \"/>", encoded.len()));
        encoded += &BASE64_STANDARD.encode(&rest[..length]);
        (raw_offset, rest) = (raw_offset + length, &rest[length..]);
    }
    xml = xml.replace(" \"/>", "\"/>").replace("\"raw\"", "\"base64\"");
    assert!(!xml.contains("raw"));
    [xml.as_bytes(), encoded.as_bytes(), rest].concat()
}

/// The parts common to both data sets.
struct Read {
    points: IOBuffer,
    corners: VertexNumbers,
    data: vtkio::model::Attributes,
}

fn read(format: OutputFormat, bytes: &[u8]) -> Read {
    match Vtk::parse_xml(&with_base64(bytes)[..]).unwrap().data {
        DataSet::PolyData { pieces, .. } if format == OutputFormat::Vtp => {
            let [Piece::Inline(piece)] = &pieces[..] else { panic!("not one piece") };
            let PolyDataPiece { points, polys, data, .. } = (**piece).clone();
            Read { points, corners: polys.expect("polygons"), data }
        }
        DataSet::UnstructuredGrid { pieces, .. } if format == OutputFormat::Vtu => {
            let [Piece::Inline(piece)] = &pieces[..] else { panic!("not one piece") };
            let UnstructuredGridPiece { points, cells, data } = (**piece).clone();
            assert!(cells.types.iter().all(|&kind| kind == CellType::Triangle));
            Read { points, corners: cells.cell_verts, data }
        }
        other => panic!("{other:?}"),
    }
}

fn doubles(buffer: &IOBuffer) -> &[f64] {
    match buffer {
        IOBuffer::F64(values) => values,
        other => panic!("{:?}", other.scalar_type()),
    }
}

fn check_mesh(piece: &Read, mesh: &pompeiu_core::TriMesh) {
    assert_eq!(bits(doubles(&piece.points).as_chunks().0), bits(mesh.positions()));
    let VertexNumbers::XML { connectivity, offsets } = &piece.corners else { panic!("not of XML") };
    let corners: Vec<u64> = mesh.faces().as_flattened().iter().map(|&v| v.into()).collect();
    assert_eq!(*connectivity, corners);
    assert_eq!(*offsets, (1..=mesh.faces().len() as u64).map(|f| 3 * f).collect::<Vec<_>>());
}

proptest! {
    #[test]
    fn mesh_alone(mesh in any_mesh()) {
        for format in [OutputFormat::Vtp, OutputFormat::Vtu] {
            check_mesh(&read(format, &encoded(format, &mesh, &Attributes::for_mesh(&mesh))), &mesh);
        }
    }

    #[test]
    fn every_attribute(
        (mesh, attributes) in fully_attributed(),
        format in prop::sample::select(vec![OutputFormat::Vtp, OutputFormat::Vtu]),
    ) {
        let piece = read(format, &encoded(format, &mesh, &attributes));
        check_mesh(&piece, &mesh);
        let points = (attributes.vertex_colors().unwrap(), attributes.vertex_scalars().collect::<Vec<_>>());
        let cells = (attributes.face_colors().unwrap(), attributes.face_scalars().collect::<Vec<_>>());
        for (read, (colors, scalars)) in [(&piece.data.point, points), (&piece.data.cell, cells)] {
            prop_assert_eq!(read.len(), 1 + scalars.len());
            for attribute in read {
                let Attribute::DataArray(array) = attribute else { panic!("{attribute:?}") };
                if array.name == "Colors" {
                    let IOBuffer::U8(values) = &array.data else { panic!("{:?}", array.data) };
                    prop_assert_eq!(&values[..], colors.as_flattened());
                } else {
                    let (_, values) = scalars.iter().find(|(name, _)| *name == array.name).unwrap();
                    let same = doubles(&array.data).iter().map(|x| x.to_bits()).eq(values.iter().map(|x| x.to_bits()));
                    prop_assert!(same, "{}", array.name);
                }
            }
        }
    }
}
