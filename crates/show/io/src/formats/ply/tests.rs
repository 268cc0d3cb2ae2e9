use super::*;
use crate::polygon::Polygon;

const SQUARE: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.25], [0.0, 1.0, 0.1]];

fn message(bytes: &[u8]) -> String {
    read(bytes).unwrap_err().to_string()
}

/// A number in a row: its type and value.
#[derive(Clone, Copy)]
enum Field {
    U8(u8),
    I8(i8),
    U16(u16),
    I16(i16),
    U32(u32),
    I32(i32),
    F32(f32),
    F64(f64),
}

fn binary(header: &str, fields: &[Field], big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut bytes = format!("ply\nformat binary_{order}_endian 1.0\n{header}end_header\n").into_bytes();
    for &field in fields {
        let mut number = match field {
            Field::U8(x) => x.to_be_bytes().to_vec(),
            Field::I8(x) => x.to_be_bytes().to_vec(),
            Field::U16(x) => x.to_be_bytes().to_vec(),
            Field::I16(x) => x.to_be_bytes().to_vec(),
            Field::U32(x) => x.to_be_bytes().to_vec(),
            Field::I32(x) => x.to_be_bytes().to_vec(),
            Field::F32(x) => x.to_be_bytes().to_vec(),
            Field::F64(x) => x.to_be_bytes().to_vec(),
        };
        if !big {
            number.reverse();
        }
        bytes.extend(number);
    }
    bytes
}

#[test]
fn ascii_with_everything_in_another_order() {
    let text = "ply\nformat ascii 1.0\ncomment a\nobj_info b\nelement junk 2\nproperty list uchar float w\n\
        element face 3\nproperty uchar flag\nproperty list uchar int vertex_index\nproperty list int float uv\n\
        element empty 3\nelement vertex 4\nproperty double z\nproperty list char int near\nproperty double x\n\
        property float q\nproperty double y\nelement edge 1\nproperty int a\nend_header\n\
        0\n2 nan 1e999\n7 3 0 1 2 0\n\n 8 4 0 1 2 3 2 .5 .5 \n9 2 0 1 0\n\
        0 0 0 9 0\n0 1 5 1 9 0\n.25 0 1 9 1\n1d-1 0 0 x 1\n5";
    for text in [text.to_owned(), text.replace('\n', "\r\n"), text.replace('\n', "\r")] {
        let mesh = read(text.as_bytes()).unwrap();
        assert_eq!(mesh.positions, SQUARE);
        assert_eq!(mesh.faces, [[0, 1, 2], [0, 1, 2], [0, 2, 3]]);
        assert_eq!(mesh.polygons, [Polygon { first: 1, corners: 4 }]);
        assert_eq!(mesh.faces_dropped, 1);
    }
}

#[test]
fn binary_in_every_type_and_both_orders() {
    use Field::{F32, F64, I8, I16, I32, U8, U16, U32};
    let double = "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n";
    let doubles = SQUARE.as_flattened().iter().map(|&x| F64(x));
    let face = |count: &str, item: &str| {
        format!(
            "{double}element face 2\nproperty short s\nproperty list {count} {item} vertex_indices\nproperty uchar c\n"
        )
    };
    let cases = [
        (
            face("uchar", "int"),
            vec![I16(1), U8(3), I32(0), I32(1), I32(2), U8(9), I16(1), U8(3), I32(0), I32(2), I32(3), U8(9)],
        ),
        (
            face("char", "uint"),
            vec![I16(1), I8(3), U32(0), U32(1), U32(2), U8(9), I16(1), I8(3), U32(0), U32(2), U32(3), U8(9)],
        ),
        (
            face("ushort", "char"),
            vec![I16(1), U16(3), I8(0), I8(1), I8(2), U8(9), I16(1), U16(3), I8(0), I8(2), I8(3), U8(9)],
        ),
        (
            face("int", "ushort"),
            vec![
                I16(1),
                I32(3),
                U16(0),
                U16(1),
                U16(2),
                U8(9),
                I16(1),
                I32(3),
                U16(0),
                U16(2),
                U16(3),
                U8(9),
            ],
        ),
        (
            face("uint32", "float32"),
            vec![
                I16(1),
                U32(3),
                F32(0.),
                F32(1.),
                F32(2.),
                U8(9),
                I16(1),
                U32(3),
                F32(0.),
                F32(2.),
                F32(3.),
                U8(9),
            ],
        ),
    ];
    for (header, faces) in cases {
        for big in [false, true] {
            let fields: Vec<Field> = doubles.clone().chain(faces.iter().copied()).collect();
            let mesh = read(&binary(&header, &fields, big)).unwrap();
            assert_eq!(mesh.positions, SQUARE, "{header} {big}");
            assert_eq!(mesh.faces, [[0, 1, 2], [0, 2, 3]], "{header} {big}");
        }
    }
}

#[test]
fn binary_faces_of_many_sizes_between_other_lists() {
    use Field::{F32, I16, I32, U8, U16};
    let header = "element extra 2\nproperty list ushort double d\nelement nothing 5\n\
        element face 3\nproperty list uchar uchar other\nproperty list uchar int vertex_indices\n\
        element vertex 4\nproperty uchar red\nproperty float x\nproperty short y\nproperty float z\n";
    let mut fields = vec![U16(0), U16(1), Field::F64(f64::NAN)];
    fields.extend([U8(0), U8(4), I32(0), I32(1), I32(2), I32(3)]);
    fields.extend([U8(2), U8(7), U8(7), U8(3), I32(3), I32(2), I32(1), U8(1), U8(7), U8(1), I32(0)]);
    for p in [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, -2]] {
        fields.extend([U8(255), F32(f32::from(p[0])), I16(p[1]), F32(f32::from(p[2]))]);
    }
    for big in [false, true] {
        let mesh = read(&binary(header, &fields, big)).unwrap();
        assert_eq!(mesh.positions, [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, -2.0]]);
        assert_eq!(mesh.faces, [[0, 1, 2], [0, 2, 3], [3, 2, 1]]);
        assert_eq!((mesh.polygons.len(), mesh.faces_dropped), (1, 1));
    }
}

#[test]
fn binary_quadrilaterals_are_read_as_one_size() {
    use Field::{F64, U8};
    let header = "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n\
        element face 2\nproperty list uchar uchar vertex_indices\n";
    let mut fields: Vec<Field> = SQUARE.as_flattened().iter().map(|&x| F64(x)).collect();
    fields.extend([U8(4), U8(0), U8(1), U8(2), U8(3), U8(4), U8(3), U8(2), U8(1), U8(0)]);
    let mesh = read(&binary(header, &fields, false)).unwrap();
    assert_eq!(mesh.faces, [[0, 1, 2], [0, 2, 3], [3, 2, 1], [3, 1, 0]]);
    assert_eq!(mesh.polygons, [Polygon { first: 0, corners: 4 }, Polygon { first: 2, corners: 4 }]);
}

#[test]
fn a_polygon_behind_triangles_is_seen() {
    use Field::{F64, I32, U8};
    let header = "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n\
        element face 2\nproperty list uchar int vertex_indices\n";
    let mut fields: Vec<Field> = SQUARE.as_flattened().iter().map(|&x| F64(x)).collect();
    fields.extend([U8(3), I32(1), I32(2), I32(3), U8(4), I32(0), I32(1), I32(2), I32(3)]);
    let mesh = read(&binary(header, &fields, false)).unwrap();
    assert_eq!(mesh.faces, [[1, 2, 3], [0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.polygons, [Polygon { first: 1, corners: 4 }]);
}

#[test]
fn strips_restart_and_alternate() {
    use Field::{F64, I32};
    let header = "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n\
        element tristrips 1\nproperty list int int vertex_indices\n";
    let strip = [0, 1, 2, 3, -1, 3, 2, 1, 1, 0];
    let expected = [[0, 1, 2], [2, 1, 3], [3, 2, 1]];
    let mut fields: Vec<Field> = SQUARE.as_flattened().iter().map(|&x| F64(x)).collect();
    fields.push(I32(10));
    fields.extend(strip.map(I32));
    assert_eq!(read(&binary(header, &fields, true)).unwrap().faces, expected);
    let text = format!(
        "ply\nformat ascii 1.0\n{header}end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n10 0 1 2 3 -1 3 2 1 1 0\n"
    );
    assert_eq!(read(text.as_bytes()).unwrap().faces, expected);
}

#[test]
fn errors_in_text_name_the_line() {
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (body, expected) in [
        ("0 0 0\n0 nan 0\n", "line 11: found \"nan\", expected a finite coordinate"),
        ("0 0 0\n0 0\n", "line 11: found the end of the line, expected a coordinate"),
        ("0 0 0\n0 0 0 0\n", "line 11: found \"0\", expected the end of the line"),
        ("0 0 0\n0 0 0\n", "line 12: found the end of the file after 2 rows of element vertex, expected 3"),
        ("0 0 0\n0 0 0\n0 0 0\n3 0 1 3\n", "line 13: found vertex index 3, but there are only 3 vertices"),
        ("0 0 0\n0 0 0\n0 0 0\n3 0 1 -1\n", "line 13: found \"-1\", expected a vertex index"),
        ("0 0 0\n0 0 0\n0 0 0\n3 0 1 1.5\n", "line 13: found \"1.5\", expected a vertex index"),
        ("0 0 0\n0 0 0\n0 0 0\n4 0 1 2\n", "line 13: found the end of the line, expected a vertex index"),
        ("0 0 0\n0 0 0\n0 0 0\n-3 0 1 2\n", "line 13: found \"-3\", expected a number of corners"),
        ("0 0 0\n0 0 0\n0 0 0\nx", "line 13: found \"x\", expected a number of corners"),
    ] {
        let found = message(format!("{header}{body}").as_bytes());
        assert!(found.starts_with(expected), "{body:?} gave {found}");
    }
}

#[test]
fn errors_in_the_header_name_the_line() {
    let too_many = (0..200).fold("ply\n".to_owned(), |text, i| text + &format!("element e{i} 1\n"));
    for (text, expected) in [
        ("ply", "line 1: found the end of the file in the header"),
        ("ply\nformat ascii 1.0\nelement vertex 3\n", "line 4: found the end of the file in the header"),
        ("ply\nformat ascii 2.0\n", "line 2: found \"format ascii 2.0\" in the header"),
        ("ply\nformat binary 1.0\n", "line 2: found \"format binary 1.0\" in the header"),
        (
            "ply\nproperty float x\n",
            "line 2: found \"property float x\" in the header, expected element before",
        ),
        ("ply\nelement vertex -1\n", "line 2: found \"element vertex -1\" in the header"),
        (
            "ply\nelement a 1\nelement a 1\n",
            "line 3: found \"element a 1\" in the header, expected each element once",
        ),
        (&too_many, "line 102: found \"element e100 1\" in the header, expected at most 100 elements"),
        (
            "ply\nelement a 1\nproperty real x\n",
            "line 3: found \"property real x\" in the header, expected property",
        ),
        ("ply\nelement a 1\nproperty list float int x\n", "line 3: found \"property list float int …\""),
        ("ply\n\u{1}\u{2}\n", "line 2: found \"\\x01\\x02\" in the header"),
        ("ply\nend_header\n", "line 1: found no format line in the header"),
        (
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
            "line 3: found no number y in element vertex, expected x, y and z",
        ),
        (
            "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int v\nend_header\n1 1\n",
            "line 3: found no list of indices in element \"face\", expected vertex_indices or vertex_index",
        ),
    ] {
        let found = message(text.as_bytes());
        assert!(found.starts_with(expected), "{text:?} gave {found}");
    }
}

#[test]
fn errors_in_binary_name_the_byte_or_the_face() {
    use Field::{F32, I8, U8};
    let header = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 2\nproperty list char uchar vertex_indices\n";
    let vertices = [F32(0.0); 9];
    let body = binary(header, &vertices, true).len();
    for (faces, place, expected) in [
        (
            &[][..],
            format!("byte {body}"),
            "found 0 bytes, expected 2 rows of element face of at least 1 bytes",
        ),
        (
            &[I8(3), U8(0), U8(1)],
            format!("byte {body}"),
            "found 3 bytes in row 0 of the 2 of element face, expected at least 4",
        ),
        (
            &[I8(0), I8(-2)],
            format!("byte {}", body + 1),
            "found a list count below 0 in row 1 of the 2 of element face",
        ),
        (
            &[I8(1), U8(0), I8(1), U8(3)],
            "face 1".into(),
            "found vertex index 3, but there are only 3 vertices",
        ),
        (
            &[I8(3), U8(0), U8(1), U8(2), I8(3), U8(0), U8(1), U8(3)],
            "face 1".into(),
            "found vertex index 3, but",
        ),
    ] {
        let fields: Vec<Field> = vertices.iter().chain(faces).copied().collect();
        let found = message(&binary(header, &fields, true));
        assert!(found.starts_with(&format!("{place}: {expected}")), "{found}");
    }
    let found = message(&binary(header, &vertices[..8], true));
    assert!(
        found.contains("found 32 bytes, expected 3 rows of element vertex of at least 12 bytes"),
        "{found}"
    );
}

#[test]
fn promises_cost_nothing() {
    for count in [1_000_000_000_u64, u64::MAX / 13, u64::MAX] {
        for format in ["ascii", "binary_little_endian"] {
            let text = format!(
                "ply\nformat {format} 1.0\nelement empty {count}\nelement vertex {count}\nproperty float x\n\
                 property float y\nproperty float z\nelement face {count}\n\
                 property list uchar int vertex_indices\nend_header\n0 0 0\n"
            );
            assert!(message(text.as_bytes()).contains(&format!("expected {count}")));
        }
    }
}
