//! Small files that state, share or repeat so much that reading them naively would take minutes or all memory.

use super::refusal;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use pompeiu_io::Format;
use std::fmt::Write as _;
use std::io::Write as _;

/// A compressed array in appended data: zeros, in one block.
fn zeros(length: u32) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(&vec![0; length as usize]).unwrap();
    let block = encoder.finish().unwrap();
    let header = [1, length, length, block.len() as u32];
    header.into_iter().flat_map(u32::to_le_bytes).chain(block).collect()
}

fn vtk_with_pieces(kind: &str, pieces: usize, compressor: &str, points: u32, appended: &[u8]) -> Vec<u8> {
    let mut text = format!(
        "<VTKFile type=\"{kind}\" byte_order=\"LittleEndian\" header_type=\"UInt32\"{compressor}><{kind}>"
    );
    for _ in 0..pieces {
        let _ = write!(
            text,
            "<Piece NumberOfPoints=\"{points}\"><Points>\
             <DataArray type=\"Float64\" format=\"appended\" offset=\"0\"/></Points></Piece>"
        );
    }
    let _ = write!(text, "</{kind}><AppendedData encoding=\"raw\">_");
    let mut bytes = text.into_bytes();
    bytes.extend(appended);
    bytes.extend(b"</AppendedData></VTKFile>");
    bytes
}

#[test]
fn arrays_that_many_pieces_share_are_refused() {
    const POINTS: u32 = 200_000;
    let zlib = " compressor=\"vtkZLibDataCompressor\"";
    for (kind, format) in [("PolyData", Format::Vtp), ("UnstructuredGrid", Format::Vtu)] {
        let file = vtk_with_pieces(kind, 200, zlib, POINTS, &zeros(24 * POINTS));
        let problem = refusal(format, &file);
        assert!(problem.contains("all pieces together unpack to more than 67108864 bytes"), "{problem}");
        // One of them is fine; without faces there is no mesh.
        let problem = refusal(format, &vtk_with_pieces(kind, 1, zlib, POINTS, &zeros(24 * POINTS)));
        assert!(problem.contains("found 200000 vertices"), "{problem}");
    }
    // Not compressed, either.
    let array: Vec<u8> = (24 * 1000_u32).to_le_bytes().into_iter().chain(vec![0; 24_000]).collect();
    let problem = refusal(Format::Vtp, &vtk_with_pieces("PolyData", 10_000, "", 1000, &array));
    assert!(problem.contains("all pieces together unpack to more than"), "{problem}");
}

#[test]
fn elements_with_countless_attributes_or_namespaces_are_refused() {
    let mut element = "<VTKFile type=\"PolyData\"".to_owned();
    let mut nested = String::new();
    for i in 0..100_000 {
        let _ = write!(element, " a{i}=\"\"");
        let _ = write!(nested, "<VTKFile xmlns:a{i}=\"{i}\">");
    }
    element += "><PolyData/></VTKFile>";
    for format in [Format::Vtp, Format::Vtu] {
        let problem = refusal(format, element.as_bytes());
        assert_eq!(problem, "line 1: found more than 256 attributes in one element, expected at most 256");
        let problem = refusal(format, nested.as_bytes());
        assert_eq!(problem, "line 1: found more than 64 namespaces in the document, expected at most 64");
    }
}

#[test]
fn primitives_that_countless_nodes_show_are_refused() {
    const MANY: usize = 5000;
    let nodes = vec!["{\"mesh\":0}"; MANY].join(",");
    // Lines without a vertex, and empty primitives.
    for primitive in ["{\"attributes\":{}}", "{\"attributes\":{\"POSITION\":0},\"mode\":1}"] {
        let primitives = vec![primitive; MANY].join(",");
        let file = format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{nodes}],\"meshes\":[{{\"primitives\":[{primitives}]}}],\
             \"accessors\":[{{\"componentType\":5126,\"count\":0,\"type\":\"VEC3\",\"bufferView\":0}}],\
             \"bufferViews\":[{{\"buffer\":0,\"byteLength\":0}}],\
             \"buffers\":[{{\"byteLength\":0,\"uri\":\"data:;base64,\"}}]}}"
        );
        let problem = refusal(Format::Gltf, file.as_bytes());
        assert!(problem.contains("show meshes so often"), "{problem}");
    }
}

#[test]
fn sparse_accessors_are_taken_at_no_word() {
    let accessor = |count: u64, sparse: u64| {
        format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{{\"mesh\":0}}],\
             \"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}}}}]}}],\
             \"accessors\":[{{\"componentType\":5126,\"count\":{count},\"type\":\"VEC3\",\"sparse\":{{\"count\":{sparse},\
             \"indices\":{{\"bufferView\":0,\"componentType\":5121}},\"values\":{{\"bufferView\":0}}}}}}],\
             \"bufferViews\":[{{\"buffer\":0,\"byteLength\":3}}],\
             \"buffers\":[{{\"byteLength\":3,\"uri\":\"data:;base64,AAAA\"}}]}}"
        )
    };
    for count in [1 << 33, 1 << 60] {
        let problem = refusal(Format::Gltf, accessor(count, count).as_bytes());
        assert!(problem.contains("but the buffer view has 3 bytes"), "{problem}");
    }
    let problem = refusal(Format::Gltf, accessor(1, 2).as_bytes());
    assert!(problem.contains("2 sparse values for 1"), "{problem}");
}
