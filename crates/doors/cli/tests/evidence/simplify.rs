//! `pompeiu simplify`: what is carried over from the input.

use crate::common::{Folder, report_of};
use std::fmt::Write;

/// Number of squares along each side.
const SIDE: usize = 24;

/// A flat square of side 1 with colours. Its left half is of oak, with texture coordinates equal to its coordinates; the right half of
/// ash, with coordinates moved by 3.
fn square() -> String {
    let at = |i: usize| i as f64 / SIDE as f64;
    let mut text = String::from("mtllib wood.mtl\n");
    let nodes = || (0..=SIDE).flat_map(|j| (0..=SIDE).map(move |i| (i, j)));
    for (i, j) in nodes() {
        writeln!(text, "v {} {} 0 {} 0 1", at(i), at(j), at(i)).unwrap();
    }
    for moved in [0.0, 3.0] {
        for (i, j) in nodes() {
            writeln!(text, "vt {} {}", at(i) + moved, at(j)).unwrap();
        }
    }
    for (name, columns) in [("oak", 0..SIDE / 2), ("ash", SIDE / 2..SIDE)] {
        writeln!(text, "usemtl {name}").unwrap();
        for i in columns {
            for j in 0..SIDE {
                let corner = |i: usize, j: usize| {
                    let v = j * (SIDE + 1) + i + 1;
                    let moved = if name == "ash" { (SIDE + 1) * (SIDE + 1) } else { 0 };
                    format!("{v}/{}", v + moved)
                };
                let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
                writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}").unwrap();
            }
        }
    }
    text
}

#[test]
fn texture_coordinates_materials_and_colours_are_carried_over() {
    let folder = Folder::new();
    folder.write("square.obj", square());
    let report = folder.ok("simplify square.obj --within 0.001 -o few.obj --json");
    let report = report_of(serde_json::from_str(&report).unwrap());
    let kept = serde_json::json!({ "texture": true, "seam_edges": SIDE, "materials": 2, "colors": true });
    assert_eq!(report["kept"], kept);
    let text = std::fs::read_to_string(folder.path().join("few.obj")).unwrap();
    assert!(text.starts_with("mtllib wood.mtl\n"));
    let rows = |keyword: &str| -> Vec<Vec<f64>> {
        let rows = text.lines().filter_map(|line| line.strip_prefix(&format!("{keyword} ")));
        rows.map(|row| row.split(' ').map(|x| x.parse().unwrap()).collect()).collect()
    };
    let (vertices, places) = (rows("v"), rows("vt"));
    for vertex in &vertices {
        assert!((vertex[3] - vertex[0]).abs() <= 0.5 / 255.0 + 1e-9 && vertex[5] == 1.0, "{vertex:?}");
    }
    let mut material = "";
    let mut faces = 0;
    for line in text.lines() {
        match line.split_once(' ') {
            Some(("usemtl", name)) => material = name,
            Some(("f", corners)) => {
                faces += 1;
                for corner in corners.split(' ') {
                    let (v, place) = corner.split_once('/').unwrap();
                    let [v, place] = [(&vertices, v), (&places, place)]
                        .map(|(rows, index)| &rows[index.parse::<usize>().unwrap() - 1]);
                    let moved = if material == "ash" { 3.0 } else { 0.0 };
                    assert!(
                        (place[0] - v[0] - moved).abs() < 1e-9 && (place[1] - v[1]).abs() < 1e-9,
                        "{line}"
                    );
                    assert!(
                        if material == "ash" { v[0] > 0.499 } else { v[0] < 0.501 },
                        "{material}: {line}"
                    );
                }
            }
            _ => {}
        }
    }
    assert!(faces < 40, "{faces} faces");

    // What a format has no place for is named; the rest is kept.
    let (code, _, talk) = folder.transcript("simplify square.obj --within 0.001 -o few.ply");
    assert_eq!(code, Some(0));
    assert!(
        talk.contains("texture coordinates and materials are not in the output") && !talk.contains("colours"),
        "{talk}"
    );
    let report = folder.ok("simplify few.ply --faces 8 -o fewer.ply --json");
    let report = report_of(serde_json::from_str(&report).unwrap());
    assert_eq!(report["kept"]["colors"], true);
    let (_, _, talk) = folder.transcript("simplify square.obj --within 0.001 --repair -o repaired.obj");
    assert!(talk.contains("repair the mesh first"), "{talk}");
}

/// The document of a binary glTF.
fn document(folder: &Folder, name: &str) -> serde_json::Value {
    let bytes = std::fs::read(folder.path().join(name)).unwrap();
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    serde_json::from_slice(&bytes[20..20 + length]).unwrap()
}

#[test]
fn what_glb_holds_is_kept_from_command_to_command() {
    let folder = Folder::new();
    folder.write("square.obj", square());
    let (_, _, talk) = folder.transcript("convert square.obj square.glb");
    assert!(talk.contains("materials but for their names are not in the output, because GLB"), "{talk}");
    folder.ok("flatten square.glb -o flat.glb");
    folder.ok("simplify flat.glb --within 0.001 -o few.glb");
    folder.ok("remesh few.glb --edge-length 0.2 -o even.glb");
    for name in ["square.glb", "flat.glb", "few.glb", "even.glb"] {
        let document = document(&folder, name);
        let names: Vec<_> = document["materials"].as_array().unwrap().iter().map(|m| &m["name"]).collect();
        assert_eq!(names[names.len() - 2..], ["oak", "ash"], "{name}");
        let primitives = document["meshes"][0]["primitives"].as_array().unwrap();
        assert_eq!(primitives.len(), 2, "{name}: one for each material");
        let has = |what: &str| primitives[0]["attributes"][what].is_u64();
        assert!(has("NORMAL") && has("COLOR_0") && has("TEXCOORD_0"), "{name}");
        assert_eq!(has("TEXCOORD_1"), name != "square.glb", "{name}: the map is one set more");
    }
    let (_, _, talk) = folder.transcript("convert few.glb few.ply");
    let said = "few.glb: texture coordinates, normals and materials are not in the output, because PLY has no place for them; write GLB";
    assert!(talk.contains(said), "{talk}");
    let (_, _, talk) = folder.transcript("simplify few.glb --faces 8 --repair -o fewer.glb");
    assert!(talk.contains("repair the mesh first"), "{talk}");
}

#[test]
fn what_is_not_kept_is_said_in_one_line() {
    let folder = Folder::new();
    folder.write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nf 1/1/1 2/1/1 3/1/1\n");
    let (code, _, said) = folder.transcript("convert part.obj part.ply");
    assert_eq!(code, Some(0), "{said}");
    let line = "part.obj: texture coordinates are not in the output, because PLY has no place for them; write OBJ or GLB; normals are not read";
    assert_eq!(said.matches(line).count(), 1, "{said}");
    let (_, _, said) = folder.transcript("cut part.obj -o part.off");
    assert!(said.contains("part.obj: texture coordinates and normals are not in the output"), "{said}");
    let (_, _, said) = folder.transcript("convert part.ply plain.off");
    assert!(!said.contains("not read"), "{said}");
}
