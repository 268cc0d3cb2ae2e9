use super::*;
use std::fmt::Write;

fn message(bytes: &[u8]) -> String {
    read(bytes).unwrap_err().to_string()
}

fn binary(header: &[u8], triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0xFF; 12]);
        bytes.extend(triangle.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend([7, 8]);
    }
    bytes
}

fn ascii(triangles: &[[[f64; 3]; 3]]) -> String {
    let mut text = "solid a name\n".to_owned();
    for corners in triangles {
        text += "  facet normal nan 0 0\n    outer loop\n";
        for [x, y, z] in corners {
            writeln!(text, "      vertex {x:e} {y} {z}").unwrap();
        }
        text += "    endloop\n  endfacet\n";
    }
    text + "endsolid a name\n"
}

const TWO: [[[f32; 3]; 3]; 2] = [
    [[0.0, -0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.1]],
    [[-0.0, 0.0, 0.0], [1.0, 1.0, 0.1], [0.0, 1.0, 0.0]],
];

#[test]
fn binary_is_welded_whatever_it_begins_with() {
    let tenth = f64::from(0.1_f32);
    for header in [&b""[..], b"solid x facet", b"\0\0\0"] {
        let mesh = read(&binary(header, &TWO)).unwrap();
        assert_eq!(mesh.positions, [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, tenth], [0.0, 1.0, 0.0]]);
        assert_eq!(mesh.faces, [[0, 1, 2], [0, 2, 3]]);
    }
}

#[test]
fn pieces_are_welded_to_each_other() {
    let side = 200;
    let grid = |i: u32, j: u32| [i as f32, j as f32, 0.25];
    let triangles: Vec<[[f32; 3]; 3]> = (0..side * side)
        .map(|k| (k % side, k / side))
        .map(|(i, j)| [grid(i, j), grid(i + 1, j), grid(i, j + 1)])
        .collect();
    let mesh = read(&binary(b"", &triangles)).unwrap();
    assert_eq!(mesh.faces.len(), triangles.len());
    assert_eq!(mesh.positions.len() as u32, (side + 1) * (side + 1) - 1);
    let mut highest = 0;
    for (face, triangle) in mesh.faces.iter().zip(&triangles) {
        assert_eq!(face.map(|i| mesh.positions[i as usize]), triangle.map(|p| p.map(f64::from)));
        for &corner in face {
            assert!(corner <= highest, "indices follow the first appearance");
            highest = highest.max(corner + 1);
        }
    }
}

#[test]
fn what_follows_the_triangles_is_skipped() {
    let mut bytes = binary(b"", &TWO);
    bytes.extend(b"trailer");
    assert_eq!(read(&bytes).unwrap().faces.len(), 2);
}

#[test]
fn ascii_keeps_doubles_and_takes_any_layout() {
    let triangles =
        TWO.map(|triangle| triangle.map(|p| [p[0].into(), p[1].into(), if p[2] > 0.0 { 0.1 } else { 0.0 }]));
    let text = ascii(&triangles);
    for text in [
        text.clone(),
        text.to_uppercase(),
        text.replace('\n', "\r\n"),
        text.replace('\n', "\r\r"),
        text.repeat(3),
    ] {
        let mesh = read(text.as_bytes()).unwrap();
        assert_eq!(mesh.positions, [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.1], [0.0, 1.0, 0.0]]);
        assert_eq!(mesh.faces[..2], [[0, 1, 2], [0, 2, 3]]);
    }
}

#[test]
fn ascii_loops_may_be_polygons() {
    let text = "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid";
    let mesh = read(text.as_bytes()).unwrap();
    assert_eq!((mesh.faces.len(), mesh.polygons.len()), (2, 1));
}

#[test]
fn errors_in_text_name_the_line() {
    let start = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n";
    for (rest, expected) in [
        ("vertex 0 inf 0\n", "line 5: found \"inf\", expected a finite coordinate"),
        ("vertex 0 0\n", "line 5: found the end of the line, expected a coordinate"),
        ("vertex 0 0 0 0\n", "line 5: found \"0\", expected the end of the line"),
        ("vertex 0 0 0\nendloop", "line 6: found 2 vertices in the loop, expected 3"),
        ("endfacet", "line 5: found \"endfacet\", expected vertex or endloop"),
        ("", "line 5: found the end of the file, expected vertex or endloop"),
    ] {
        let found = message(format!("{start}{rest}").as_bytes());
        assert!(found.starts_with(expected), "{rest:?} gave {found}");
    }
    assert!(message(b"solid\n").starts_with("line 2: found the end of the file, expected facet or endsolid"));
}

#[test]
fn errors_in_binary_name_the_byte_or_the_face() {
    let whole = binary(b"", &TWO);
    assert_eq!(message(&whole[..50]), "byte 50: found 50 bytes, expected a header of 84 bytes");
    let short = message(&whole[..183]);
    assert_eq!(short, "byte 84: found 99 bytes (1 triangles), expected the 2 triangles of the header");
    let none = binary(b"", &[]);
    assert!(message(&none).starts_with("byte 80: found a count of 0 triangles before 0 bytes"));
    let mut triangles = TWO;
    triangles[1][2][1] = f32::NAN;
    let found = message(&binary(b"", &triangles));
    assert_eq!(found, "face 1: found coordinate y = NaN of corner 3, expected a finite coordinate");
    let mut lie = whole;
    lie[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(message(&lie).contains("expected the 4294967295 triangles"));
}
