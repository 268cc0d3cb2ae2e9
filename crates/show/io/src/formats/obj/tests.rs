use super::*;
use std::fmt::Write;

fn faces(text: &str) -> Vec<[u32; 3]> {
    read(text.as_bytes()).unwrap().faces
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn corners_in_every_form() {
    for corners in
        ["1 2 3", "1/1 2/2 3/3", "1//1 2//2 3//3", "1/1/1 2/2/2 3/3/3", "-4 -3 -2", "-4/-1/-1 -3/ -2//5"]
    {
        assert_eq!(faces(&format!("{SQUARE}f {corners}\n")), [[0, 1, 2]], "{corners}");
    }
}

#[test]
fn statements_in_every_layout() {
    for text in [
        "\u{feff}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
        "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",
        "  v 0 0 0\n\tv\t1\t0\t0  \nv 0 1 0 # up\nf 1 2 3 # all",
        "v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\r\n 3\n",
        "v\\\n0 0 0\nv 1 0 0\nv 0 1 0\nf 1\\\n2 3",
        "# C:\\\nmtllib a b.mtl\nv 0 0 0 0.5 0.5 1\no x\nv 1 0 0 1\ng a \\\nb\nv 0 1 0 1 .1 .2 .3\ns off\nusemtl q\nf 1 2 3\n",
        "vt 0 0\nvn 0 0 1\nv 0 0 0\nv 1 0 0\ncurv2 1 2\n\nf 1 2 3\nv 0 1 0\nl 1 2\np 1\n",
    ] {
        let mesh = read(text.as_bytes()).unwrap();
        assert_eq!(mesh.positions, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], "{text:?}");
        assert_eq!(mesh.faces, [[0, 1, 2]], "{text:?}");
    }
}

#[test]
fn polygons_are_fans_for_now_and_points_and_lines_are_dropped() {
    let mesh =
        read(format!("{SQUARE}f 1\nf 1 2\nf\nf 1 2 3 4\nf 1 2 3\nf -1 -2 -3 -4\n").as_bytes()).unwrap();
    assert_eq!(mesh.faces, [[0, 1, 2], [0, 2, 3], [0, 1, 2], [3, 2, 1], [3, 1, 0]]);
    assert_eq!(mesh.polygons, [Polygon { first: 0, corners: 4 }, Polygon { first: 3, corners: 4 }]);
    assert_eq!(mesh.faces_dropped, 3);
}

#[test]
fn the_size_of_the_pieces_does_not_matter() {
    let mut text = String::new();
    for i in 0..200 {
        writeln!(text, "v {i} \\\r\n {}.5 0 # x\\\r\nv 0 {i} 1\rv 1 1 {i}", i * i).unwrap();
        writeln!(text, "f -1 \\\n-2 -3 {}\nf {}/1 1 \\\r -2\n# c\\", i + 1, 3 * i + 1).unwrap();
        writeln!(text, "g a{i} \\\n b # no\no o {i}").unwrap();
    }
    let whole = read_in_pieces(text.as_bytes(), usize::MAX).unwrap();
    assert_eq!((whole.positions.len(), whole.faces.len(), whole.polygons.len()), (600, 600, 200));
    // No face follows the last names.
    assert_eq!(whole.groups.len(), 3 * 199);
    assert!(
        ["a0", "b", "o 0"]
            .iter()
            .all(|name| whole.groups.iter().any(|g| g.name == *name && g.faces == (3..6)))
    );
    for size in (1..60).chain([100, 1000]) {
        let pieces = read_in_pieces(text.as_bytes(), size).unwrap();
        assert_eq!(pieces.positions, whole.positions, "{size}");
        assert_eq!(pieces.faces, whole.faces, "{size}");
        assert_eq!(pieces.polygons, whole.polygons, "{size}");
        assert_eq!(pieces.groups, whole.groups, "{size}");
    }
}

#[test]
fn errors_name_the_line() {
    for (text, message) in [
        ("v 0 0\n", "line 1: found the end of the line, expected a coordinate"),
        ("\nv\n", "line 2: found the end of the line, expected a coordinate"),
        ("v 0 0 0\r\nv 0 nan 0\r\n", "line 2: found \"nan\", expected a finite coordinate"),
        ("v 0 0 1,5\n", "line 1: found \"1,5\", expected a coordinate"),
        (
            "v 0 0 0\nf 0 1 1\n",
            "line 2: found \"0\", expected a vertex index (the first vertex is 1, the last one -1)",
        ),
        (
            "v 0 0 0\n\nf 1 1 2\nv 0 0 0 \nf 1 1 3\n",
            "line 5: found vertex index 3, but there are only 2 vertices",
        ),
        ("v 0 0 0\rf 1 1 -2\r", "line 2: found vertex index -2, but only 1 vertices precede it"),
        (
            "v 0 0 0\nf 1 1 99999999999999999999\n",
            "line 2: found \"99999999999999999999\", expected a vertex index",
        ),
        (
            "v 0 0 0\nf 1 1 5000000000\n",
            "line 2: found vertex index 5000000000, but there are only 4294967295",
        ),
        ("v 0 0 0\nf 1 1 1.5\n", "line 2: found \"1.5\", expected a vertex index"),
        ("v1 0 0 0\n", "line 1: found \"v1\", expected an OBJ statement such as v or f"),
        (
            "\u{0}\u{1}garbage",
            "line 1: found \"\\x00\\x01garbage\", expected an OBJ statement such as v or f",
        ),
    ] {
        for size in [1, 1000] {
            let error = read_in_pieces(text.as_bytes(), size).unwrap_err().in_text(text.as_bytes());
            assert!(error.to_string().starts_with(message), "{text:?} gave {error}");
        }
    }
}
