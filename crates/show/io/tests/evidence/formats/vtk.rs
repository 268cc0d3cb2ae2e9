//! Files that VTK wrote, and files with one defect.

use super::{read_as, refusal};
use base64::{Engine, prelude::BASE64_STANDARD};
use flate2::{Compression, write::ZlibEncoder};
use pompeiu_io::{Format, ReadError, read};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

pub(crate) fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/vtk")
}

/// The files of a format, by name.
pub(crate) fn files(suffix: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = entries.filter(|path| path.extension().is_some_and(|s| s == suffix)).collect();
    files.sort();
    files
}

const POINTS: [[f64; 3]; 9] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.1, 0.2, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
    [0.5, 0.5, -1e-7],
];

/// Two quadrilaterals cut, a triangle between them, a polygon cut, a strip; in grids also a pixel.
const FACES: [[u32; 3]; 11] = [
    [0, 3, 2],
    [0, 2, 1],
    [4, 5, 6],
    [0, 1, 5],
    [0, 5, 4],
    [1, 2, 6],
    [1, 6, 5],
    [2, 3, 6],
    [3, 7, 6],
    [4, 5, 6],
    [4, 6, 7],
];

#[test]
fn files_by_vtk() {
    let mut seen = 0;
    for (suffix, format) in [("vtk", Format::VtkLegacy), ("vtp", Format::Vtp), ("vtu", Format::Vtu)] {
        for path in files(suffix) {
            let name = path.file_name().unwrap().to_str().unwrap();
            if matches!(name, "lz4.vtp" | "single.vtk") {
                continue;
            }
            let read = read(&path).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(read.format, format, "{name}");
            assert_eq!(read.mesh.positions(), POINTS, "{name}");
            let grid = suffix == "vtu" || name.starts_with("grid");
            assert_eq!(read.mesh.faces(), &FACES[..if grid { 11 } else { 9 }], "{name}");
            assert_eq!(read.faces_dropped, 2, "{name}");
            assert_eq!(read.polygons_triangulated, if grid { 4 } else { 3 }, "{name}");
            seen += 1;
        }
    }
    assert_eq!(seen, 10 + 7 + 7);
}

#[test]
fn single_precision_points() {
    let read = read(folder().join("single.vtk")).unwrap();
    assert_eq!(read.mesh.positions(), POINTS.map(|p| p.map(|x| f64::from(x as f32))));
}

#[test]
fn an_unknown_compressor_is_named() {
    let error = read(folder().join("lz4.vtp")).unwrap_err();
    let ReadError::Format { cause: source, .. } = error else { panic!("{error}") };
    assert!(source.to_string().contains("\"vtkLZ4DataCompressor\", which is not supported"), "{source}");
}

#[test]
fn legacy_spellings() {
    let text = "# vtk datafile version 2.0\r\nany title at all: POINTS 7\r\nascii\r\ndataset polydata\r\n\
                points 3 float\r\n0 0 0\r\n1 0 0\r\n 0 1 0\r\n\r\npolygons 1 4\r\n3 0 1 2";
    let read = read_as(Format::VtkLegacy, text.as_bytes());
    assert_eq!(read.mesh.positions(), [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let metadata =
        text.replace("\r\n\r\n", "\r\nMETADATA\r\nINFORMATION 1\r\nNAME polygons LOCATION x\r\n\r\n");
    assert_eq!(read_as(Format::VtkLegacy, metadata.as_bytes()).mesh, read.mesh);
}

#[test]
fn legacy_number_types_by_every_name() {
    for (name, bytes) in [
        ("char", 1),
        ("signed_char", 1),
        ("unsigned_char", 1),
        ("short", 2),
        ("unsigned_short", 2),
        ("int", 4),
        ("unsigned_int", 4),
        ("vtkIdType", 4),
        ("long", 8),
        ("unsigned_long", 8),
        ("vtktypeint64", 8),
        ("vtktypeuint64", 8),
    ] {
        let mut file = b"# vtk DataFile Version 5.1\n\nBINARY\nDATASET POLYDATA\nPOINTS 3 ".to_vec();
        let mut block = |header: &str, values: &[u8]| {
            file.extend_from_slice(format!("{header}{name}\n").as_bytes());
            for &value in values {
                file.extend(std::iter::repeat_n(0, bytes - 1));
                file.push(value);
            }
        };
        block("", &[0, 0, 0, 1, 0, 0, 0, 2, 3]);
        block("\nPOLYGONS 2 3\nOFFSETS ", &[0, 3]);
        block("\nCONNECTIVITY ", &[2, 1, 0]);
        let read = read_as(Format::VtkLegacy, &file);
        assert_eq!(read.mesh.positions(), [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 3.0]], "{name}");
        assert_eq!(read.mesh.faces(), [[2, 1, 0]], "{name}");
    }
}

const LEGACY: &str = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n0 0 0\n1 0 0\n0 1 0\n\
                      POLYGONS 1 4\n3 0 1 2\n";
const MODERN: &str = "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n\
                      0 0 0 1 0 0 0 1 0\nCELLS 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 1 2\n\
                      CELL_TYPES 1\n5\n";

#[test]
fn what_is_wrong_in_legacy_files() {
    for text in [LEGACY, MODERN] {
        assert_eq!(read_as(Format::VtkLegacy, text.as_bytes()).mesh.faces(), [[0, 1, 2]]);
    }
    for (text, from, to, message) in [
        (
            LEGACY,
            "# vtk",
            "# vkt",
            "line 1: found \"# vkt DataFile Version 3…\", expected \"# vtk DataFile\"",
        ),
        (LEGACY, "ASCII", "TEXT", "line 3: found \"text\", expected ASCII or BINARY"),
        (LEGACY, "DATASET ", "", "line 4: found \"polydata\", expected DATASET"),
        (
            LEGACY,
            "POLYDATA",
            "STRUCTURED_GRID",
            "line 4: found \"structured_grid\", expected POLYDATA or UNSTRUCTURED_GRID",
        ),
        (LEGACY, "3 double", "x double", "line 5: found \"x\", expected a number of things"),
        (LEGACY, "double", "quadruple", "line 5: found \"quadruple\", expected a type of numbers"),
        (
            LEGACY,
            "POINTS 3",
            "POINTS 1000000000000",
            "line 5: expected 3000000000000 numbers, but the file ends after 40 bytes",
        ),
        (
            LEGACY,
            "POINTS 3",
            "POINTS 18446744073709551615",
            "line 5: expected 18446744073709551615 numbers, but the file ends after 40 bytes",
        ),
        (LEGACY, "1 0 0", "1 nan 0", "line 7: found \"nan\", expected a finite coordinate"),
        (LEGACY, "0 1 0\n", "0 1\n", "line 9: found \"POLYGONS\", expected a coordinate"),
        (LEGACY, "3 0 1 2", "3 0 1 3", "face 0: point 3 does not exist, there are 3 (the first is 0)"),
        (LEGACY, "3 0 1 2", "3 0 1 -2", "line 10: found \"-2\", expected a number of things"),
        (LEGACY, "3 0 1 2", "3 0 1", "line 11: found the end of the line, expected a number of things"),
        (LEGACY, "3 0 1 2", "4 0 1 2", "line 9: cell 0 has 4 corners, but only 3 numbers follow"),
        (LEGACY, "POLYGONS 1", "POLYGONS 2", "line 9: 4 numbers make 1 cells, expected 2"),
        (LEGACY, "POLYGONS", "POLYGON", "line 9: found \"polygon\", expected points, cells or their data"),
        (LEGACY, "POLYGONS 1 4\n3 0 1 2", "LINES 1 3\n2 0 1", "found 3 vertices and 1 faces with fewer"),
        (LEGACY, "POLYGONS 1 4\n3 0 1 2\n", "", "found 3 vertices, expected at least one face"),
        (MODERN, "0 3\n", "1 3\n", "line 7: the first cell begins at 1, expected 0"),
        (MODERN, "0 3\n", "0 4\n", "face 0: its corners end at 4, expected 0 to 3"),
        (
            MODERN,
            "CELLS 2 3",
            "CELLS 999 3",
            "line 8: expected 999 numbers, but the file ends after 52 bytes",
        ),
        (MODERN, "CONNECTIVITY", "connect", "line 10: found \"connect\", expected CONNECTIVITY"),
        (MODERN, "CELL_TYPES 1\n5\n", "", "0 cell types for 1 cells"),
        (MODERN, "CELL_TYPES 1\n5\n", "CELL_TYPES 2\n5 5\n", "2 cell types for 1 cells"),
        (
            MODERN,
            "\n5\n",
            "\n10\n",
            "face 0: the cell is a tetrahedron (VTK type 10), expected a triangle, quadrilateral, polygon or strip",
        ),
        (MODERN, "\n5\n", "\n9\n", "face 0: 3 corners, expected 4"),
    ] {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        let found = refusal(Format::VtkLegacy, text.replace(from, to).as_bytes());
        assert!(found.starts_with(message), "{to}: {found}");
    }
    let mut binary = fs::read(folder().join("poly-4.2-binary.vtk")).unwrap();
    let points = b"POINTS 9";
    let at = binary.windows(points.len()).position(|window| window == points).unwrap();
    binary[at + 7] = b'5';
    // Four points too few: the next keyword is read as a coordinate.
    assert!(refusal(Format::VtkLegacy, &binary).starts_with("byte "));
}

const POLY: &str = r#"<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt32">
<PolyData>
<Piece NumberOfPoints="3" NumberOfPolys="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 <!-- x --> 0 0 1 0</DataArray></Points>
<Polys>
<DataArray type="Int32" Name="connectivity">0 1 2</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii"> 3 </DataArray>
</Polys>
</Piece>
</PolyData>
</VTKFile>
"#;

#[test]
fn what_is_wrong_in_xml_files() {
    assert_eq!(read_as(Format::Vtp, POLY.as_bytes()).mesh.faces(), [[0, 1, 2]]);
    let offsets = "format=\"ascii\"> 3 <";
    for (from, to, message) in [
        ("</Piece>", "", "line 11: not XML that can be read: expected 'Piece' tag, not 'PolyData'"),
        ("\"PolyData\"", "\"ImageData\"", "line 2: VTKFile: expected a VTKFile of the type PolyData"),
        ("LittleEndian", "Middle", "line 2: unknown byte order \"Middle\""),
        ("UInt32", "UInt16", "line 2: unknown header type \"UInt16\""),
        ("NumberOfPoints=\"3\"", "NumberOfPoints=\"4\"", "line 5: DataArray: 9 numbers, expected 12"),
        ("NumberOfPoints=\"3\"", "NumberOfPoints=\"2\"", "line 5: DataArray: 9 numbers, expected 6"),
        (
            "NumberOfPoints=\"3\"",
            "NumberOfPoints=\"-3\"",
            "line 4: Piece: NumberOfPoints is \"-3\", expected a number",
        ),
        (
            "NumberOfPolys=\"1\"",
            "NumberOfPolys=\"9999999999\"",
            "line 8: DataArray \"offsets\": 1 numbers, expected 9999999999",
        ),
        ("NumberOfPolys=\"1\"", "", "found 3 vertices, expected at least one face"),
        ("Float64", "Float128", "line 5: DataArray: unknown type of numbers \"Float128\""),
        ("1 0 <", "1 O <", "line 5: DataArray: number 4 is \"O\""),
        ("1 0 <", "1 inf <", "vertex 1: coordinate y of vertex 1 is inf"),
        (">0 1 2<", ">0 1 3<", "face 0: point 3 does not exist, there are 3 (the first is 0)"),
        (">0 1 2<", ">0 1 -1<", "line 7: DataArray \"connectivity\": number 2 is \"-1\""),
        ("\"connectivity\"", "\"corners\"", "line 6: Polys: no DataArray \"connectivity\""),
        (offsets, "format=\"ascii\"> 4 <", "face 0: its corners end at 4, expected 0 to 3"),
        (offsets, "format=\"binary\">BAA!AAMAAAA=<", "line 8: DataArray \"offsets\": base64: "),
        (offsets, "format=\"binary\">BAAA<", "line 8: DataArray \"offsets\": the data end early"),
        (offsets, "format=\"binary\">////////<", "line 8: DataArray \"offsets\": the data end early"),
        (
            offsets,
            "format=\"binary\">AgAAAAMA<",
            "line 8: DataArray \"offsets\": 2 bytes do not make whole Int32 numbers",
        ),
        (
            offsets,
            "format=\"binary\">BAAAAP////8=<",
            "line 8: DataArray \"offsets\": number 0 is no count or index",
        ),
        (
            offsets,
            "format=\"appended\" offset=\"0\"><",
            "line 8: DataArray \"offsets\": neither text, binary nor at an offset",
        ),
        ("</VTKFile>", "<AppendedData>_", "line 12: the appended data have no end"),
        (
            "</VTKFile>",
            "<AppendedData></AppendedData></VTKFile>",
            "line 12: the appended data do not begin with \"_\"",
        ),
    ] {
        assert_eq!(POLY.matches(from).count(), 1, "{from}");
        let found = refusal(Format::Vtp, POLY.replace(from, to).as_bytes());
        assert!(found.starts_with(message), "{to}: {found}");
    }
    let appended = POLY
        .replace("> 3 <", "><")
        .replace("format=\"ascii\"><", "format=\"appended\" offset=\"7\"><")
        .replace("</VTKFile>", "<AppendedData encoding=\"raw\">_abc</AppendedData></VTKFile>");
    let found = refusal(Format::Vtp, appended.as_bytes());
    assert_eq!(found, "line 8: DataArray \"offsets\": offset 7 in 3 bytes of appended data");
    // Lengths and data encoded together or separately.
    for data in ["BAAAAAMAAAA=", "BAAAAA==AwAAAA==", "\n BAAA AAMA AAA=\n"] {
        let text = POLY.replace(offsets, &format!("format=\"binary\">{data}<"));
        assert_eq!(read_as(Format::Vtp, text.as_bytes()).mesh.faces(), [[0, 1, 2]]);
    }
    assert!(refusal(Format::Vtp, &[POLY.as_bytes(), b"<!-- \xFF -->"].concat()).contains("not UTF-8"));
    let deep = format!("{}{}", "<a>".repeat(200_000), "</a>".repeat(200_000));
    assert!(refusal(Format::Vtp, deep.as_bytes()).starts_with("line 1: "));
}

#[test]
fn damaged_compressed_blocks() {
    let bytes = fs::read(folder().join("appended-raw-zlib.vtp")).unwrap();
    // The mark of zlib data at the level that VTK uses.
    let begin = bytes.windows(2).rposition(|pair| pair == b"x^").unwrap();
    let mut damaged = bytes.clone();
    damaged[begin] ^= 0x0F;
    let message = refusal(Format::Vtp, &damaged);
    assert!(message.contains("a compressed block is damaged"), "{message}");
}

/// Three zero corners in one block that promises `length` bytes.
fn zeros_in_a_block_of(length: u32) -> String {
    let mut block = ZlibEncoder::new(Vec::new(), Compression::default());
    block.write_all(&[0; 4 * 3]).unwrap();
    let block = block.finish().unwrap();
    let header: Vec<u8> = [1, length, 0, block.len() as u32].iter().flat_map(|x| x.to_le_bytes()).collect();
    let data = format!("{}{}", BASE64_STANDARD.encode(header), BASE64_STANDARD.encode(block));
    POLY.replace(">0 1 2<", &format!(" format=\"binary\">{data}<"))
        .replace("header_type", "compressor=\"vtkZLibDataCompressor\" header_type")
}

#[test]
fn compressed_blocks_hold_what_they_promise() {
    let exact = read_as(Format::Vtp, zeros_in_a_block_of(12).as_bytes());
    assert_eq!(exact.mesh.faces(), [[0, 0, 0]]);
    for (length, message) in [
        (11, "a compressed block holds more than its 11 bytes"),
        (13, "a compressed block holds 12 bytes, expected 13"),
    ] {
        let found = refusal(Format::Vtp, zeros_in_a_block_of(length).as_bytes());
        assert!(found.ends_with(message), "{found}");
    }
}

#[test]
fn pieces_are_joined() {
    let start = POLY.find("<Piece").unwrap();
    let end = POLY.find("</Piece>").unwrap() + "</Piece>".len();
    let twice = format!("{}{}{}", &POLY[..end], &POLY[start..end], &POLY[end..]);
    let read = read_as(Format::Vtp, twice.as_bytes());
    assert_eq!((read.mesh.positions().len(), read.mesh.faces()), (6, &[[0, 1, 2], [3, 4, 5]][..]));
}
