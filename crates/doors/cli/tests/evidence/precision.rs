//! What commands say of a result is true of the bytes that they wrote, whatever the numbers of the format.

use crate::common::{Folder, report_of};
use pompeiu::core::TriMesh;
use pompeiu::core::mesh::{Affine, shapes, transform};
use pompeiu::hausdorff::symmetric_hausdorff;
use serde_json::Value;
use std::fmt::Write;

/// Where surveyors have their coordinates.
const FAR: [f64; 3] = [1_234_560.25, -7_654_313.125, 0.5];

/// A binary STL as its specification has it: 80 bytes, a count, a normal and three corners for each triangle.
fn read_stl(bytes: &[u8]) -> TriMesh {
    let number = |at: usize| f64::from(f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()));
    let count = u32::from_le_bytes(bytes[80..84].try_into().unwrap());
    let corner = |i: u32| {
        let at = 84 + 50 * (i / 3) as usize + 12 + 12 * (i % 3) as usize;
        [number(at), number(at + 4), number(at + 8)]
    };
    TriMesh::new(
        (0..3 * count).map(corner).collect(),
        (0..count).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect(),
    )
    .unwrap()
}

/// A binary glTF with one node, as programs read it that add up in single precision.
fn read_glb(bytes: &[u8]) -> TriMesh {
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let json = word(12) as usize;
    let document: Value = serde_json::from_slice(&bytes[20..20 + json]).unwrap();
    let data = &bytes[28 + json..];
    let primitive = &document["meshes"][0]["primitives"][0];
    let view = |accessor: &Value| {
        let accessor = &document["accessors"][accessor.as_u64().unwrap() as usize];
        let view = &document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let from = view["byteOffset"].as_u64().unwrap_or(0) as usize;
        (from, accessor["count"].as_u64().unwrap() as usize)
    };
    let moved = |k: usize| document["nodes"][0]["translation"][k].as_f64().unwrap_or(0.0) as f32;
    let (from, count) = view(&primitive["attributes"]["POSITION"]);
    let at = |i: usize| data[from + 4 * i..from + 4 * i + 4].try_into().unwrap();
    let positions =
        (0..count).map(|v| [0, 1, 2].map(|k| f64::from(f32::from_le_bytes(at(3 * v + k)) + moved(k))));
    let (from, count) = view(&primitive["indices"]);
    let at = |i: usize| data[from + 4 * i..from + 4 * i + 4].try_into().unwrap();
    let faces = (0..count / 3).map(|f| [0, 1, 2].map(|k| u32::from_le_bytes(at(3 * f + k))));
    TriMesh::new(positions.collect(), faces.collect()).unwrap()
}

fn read(folder: &Folder, name: &str) -> TriMesh {
    let bytes = std::fs::read(folder.path().join(name)).unwrap();
    if bytes.starts_with(b"glTF") { read_glb(&bytes) } else { read_stl(&bytes) }
}

/// A sphere of radius 10 far from zero, in double precision.
fn sphere() -> TriMesh {
    transform(&shapes::icosphere(10.0, 3).unwrap(), &Affine::translate(FAR)).unwrap()
}

fn number(answer: &Value, path: &str) -> f64 {
    answer.pointer(path).and_then(Value::as_f64).unwrap_or(0.0)
}

#[test]
fn a_proven_distance_is_that_of_the_file() {
    let folder = Folder::new();
    let sphere = sphere();
    pompeiu::io::write(folder.path().join("far.obj"), &sphere).unwrap();
    let commands = [
        ("simplify far.obj", "--within 0.05"),
        ("simplify far.obj", "--faces 300"),
        ("remesh far.obj --relative 0.08", "--within 0.3"),
        ("remesh far.obj --relative 0.08", ""),
    ];
    for (command, asked) in commands {
        for suffix in ["stl", "glb"] {
            for center in ["", "--center"] {
                let call = format!("{command} {asked} -o out.{suffix} {center} --json");
                let output = folder.run(&call);
                let allowed = asked.strip_prefix("--within ").map(|d| d.parse::<f64>().unwrap());
                if output.status.code() != Some(0) {
                    let told = String::from_utf8(output.stderr).unwrap();
                    assert!(center.is_empty() && allowed.is_some(), "{call}: {told}");
                    assert!(told.contains("--center") && told.contains("PLY"), "{call}: {told}");
                    assert!(!folder.path().join(format!("out.{suffix}")).exists(), "{call}");
                    continue;
                }
                let answer = report_of(serde_json::from_slice(&output.stdout).unwrap());
                let shift = [0, 1, 2].map(|k| number(&answer, &format!("/rounding/shift/{k}")));
                assert_eq!(shift != [0.0; 3], !center.is_empty(), "{call}");
                let found = read(&folder, &format!("out.{suffix}"));
                let back = transform(&found, &Affine::translate(shift)).unwrap();
                let distance = symmetric_hausdorff(&sphere, &back).distance;
                let said = ["lower", "upper"].map(|end| number(&answer, &format!("/distance/{end}")));
                assert!(
                    distance.lower() <= said[1] && said[0] <= distance.upper(),
                    "{call}: {distance:?} {said:?}"
                );
                assert!(allowed.is_none_or(|d| distance.lower() <= d), "{call}: {distance:?}");
                std::fs::remove_file(folder.path().join(format!("out.{suffix}"))).unwrap();
            }
        }
    }
}

#[test]
fn a_mesh_is_repaired_as_it_is_written() {
    let folder = Folder::new();
    let small = transform(&shapes::icosphere(1.0, 3).unwrap(), &Affine::translate(FAR)).unwrap();
    pompeiu::io::write(folder.path().join("far.obj"), &small).unwrap();
    for center in ["", "--center"] {
        let answer = folder.ok(&format!("repair far.obj out.glb {center} --json"));
        let answer = report_of(serde_json::from_str(&answer).unwrap());
        let found = read(&folder, "out.glb");
        assert_eq!(answer["degenerate_faces"]["count"].as_u64() > Some(0), center.is_empty(), "{answer}");
        let area = |face| {
            let [a, b, c] = found.corners(face);
            let [u, v] = [b, c].map(|p| [0, 1, 2].map(|k| p[k] - a[k]));
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]] != [0.0; 3]
        };
        assert!(found.face_ids().all(area), "a face without area was written");
    }
}

#[test]
fn an_aligned_mesh_is_measured_as_it_is_written() {
    let folder = Folder::new();
    let sphere = transform(&shapes::icosphere(10.0, 2).unwrap(), &Affine::translate(FAR)).unwrap();
    let moved = transform(&sphere, &Affine::translate([0.3, -0.2, 0.1])).unwrap();
    pompeiu::io::write(folder.path().join("fixed.obj"), &sphere).unwrap();
    pompeiu::io::write(folder.path().join("moving.obj"), &moved).unwrap();
    let output = folder.run("align moving.obj fixed.obj -o out.stl --json");
    let answer = report_of(serde_json::from_slice(&output.stdout).unwrap());
    let distance = symmetric_hausdorff(&read(&folder, "out.stl"), &sphere).distance;
    assert!(distance.lower() > 0.05, "single precision is coarse here: {distance:?}");
    assert!(number(&answer, "/moved_to_fixed/upper") >= distance.lower(), "{answer} {distance:?}");
}

/// The texture coordinates of a binary glTF with one primitive, as they are stored, and its triangles.
fn read_texture(bytes: &[u8]) -> (Vec<[f32; 2]>, Vec<[u32; 3]>) {
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let json = word(12) as usize;
    let document: Value = serde_json::from_slice(&bytes[20..20 + json]).unwrap();
    let data = &bytes[28 + json..];
    let primitive = &document["meshes"][0]["primitives"][0];
    let view = |accessor: &Value| {
        let accessor = &document["accessors"][accessor.as_u64().unwrap() as usize];
        let view = &document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        (view["byteOffset"].as_u64().unwrap_or(0) as usize, accessor["count"].as_u64().unwrap() as usize)
    };
    let (from, count) = view(&primitive["attributes"]["TEXCOORD_0"]);
    let at = |i: usize| f32::from_le_bytes(data[from + 4 * i..from + 4 * i + 4].try_into().unwrap());
    let places = (0..count).map(|v| [at(2 * v), at(2 * v + 1)]).collect();
    let (from, count) = view(&primitive["indices"]);
    let at = |i: usize| u32::from_le_bytes(data[from + 4 * i..from + 4 * i + 4].try_into().unwrap());
    (places, (0..count / 3).map(|f| [0, 1, 2].map(|k| at(3 * f + k))).collect())
}

#[test]
fn flipped_faces_are_those_of_the_file() {
    let folder = Folder::new();
    // Rings of faces around a point, each ten times as small as the next: single precision cannot resolve the least of the map.
    let mut text = String::from("v 0 0 0\n");
    for ring in 0..12 {
        for k in 0..8 {
            let (r, a) = (10_f64.powi(ring - 8), std::f64::consts::TAU * f64::from(k) / 8.0);
            writeln!(text, "v {} {} {}", r * a.cos(), r * a.sin(), 0.1 * r).unwrap();
        }
    }
    for k in 0..8 {
        let next = (k + 1) % 8;
        writeln!(text, "f 1 {} {}", 2 + k, 2 + next).unwrap();
        for ring in 0..11 {
            let [a, b, c, d] =
                [(ring, k), (ring, next), (ring + 1, k), (ring + 1, next)].map(|(r, k)| 2 + 8 * r + k);
            writeln!(text, "f {a} {c} {d}\nf {a} {d} {b}").unwrap();
        }
    }
    folder.write("cone.obj", text);
    let flipped = |output: &str| {
        let answer = folder.run(&format!("flatten cone.obj --boundary circle -o {output} --json"));
        let answer = report_of(serde_json::from_slice(&answer.stdout).unwrap());
        answer["flipped"].as_u64().unwrap()
    };
    assert_eq!(flipped("flat.obj"), 0);
    let said = flipped("flat.glb");
    assert!(said > 0, "nothing is lost");
    let (places, faces) = read_texture(&std::fs::read(folder.path().join("flat.glb")).unwrap());
    // Rows are counted from above, so that faces that keep their orientation are clockwise. Differences of such numbers are exact.
    let is_flipped = |face: &&[u32; 3]| {
        let [a, b, c] = face.map(|v| places[v as usize].map(f64::from));
        let [p, q] = [b, c].map(|x| [x[0] - a[0], x[1] - a[1]]);
        p[0] * q[1] - p[1] * q[0] >= 0.0
    };
    let found = faces.iter().filter(is_flipped).count() as u64;
    assert_eq!(found, said);
}

#[test]
fn what_a_repair_splits_is_not_written_where_readers_join_it() {
    let folder = Folder::new();
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 2 1 4\nf 1 2 5\n";
    folder.write("three.obj", three);
    let (code, _, said) = folder.transcript("repair three.obj out.stl");
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("write PLY or OBJ") && !folder.path().join("out.stl").exists(), "{said}");
    // Neither what was split before.
    folder.write("split.obj", format!("{three}v 0 0 0\nv 1 0 0\n").replace("f 1 2 5", "f 6 7 5"));
    let (code, _, said) = folder.transcript("repair split.obj out.stl --no-weld");
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("join 2 vertices") && !folder.path().join("out.stl").exists(), "{said}");
    folder.ok("repair three.obj out.ply");
    let found = report_of(serde_json::from_str(&folder.ok("info out.ply --json")).unwrap());
    assert_eq!(found["non_manifold_edges"], 0);
}

#[test]
fn a_cut_is_open_in_the_file_or_there_is_none() {
    let folder = Folder::new();
    folder.ok("generate torus --major-segments 12 --minor-segments 8 -o torus.obj");
    for suffix in ["obj", "ply", "glb", "off", "3mf", "vtp"] {
        folder.ok(&format!("cut torus.obj -o out.{suffix}"));
        let found = folder.ok(&format!("info out.{suffix} --json"));
        let found = report_of(serde_json::from_str(&found).unwrap());
        assert_eq!(
            (&found["boundary_loops"], &found["euler_characteristic"]),
            (&Value::from(1), &Value::from(1)),
            "{suffix}"
        );
    }
    let (code, _, said) = folder.transcript("cut torus.obj -o out.stl");
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("write PLY or OBJ") && !folder.path().join("out.stl").exists(), "{said}");
}

#[test]
fn a_map_to_a_circle_ends_with_its_time() {
    let folder = Folder::new();
    folder.ok("generate torus --major-segments 24 --minor-segments 16 -o torus.obj");
    for options in ["--boundary circle", "--boundary circle --weights cotangent", "--energy lscm", ""] {
        let call = format!("flatten torus.obj {options} --time-limit 0s --json");
        let output = folder.run(&call);
        let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!((output.status.code(), &answer["stop"]), (Some(3), &Value::from("time")), "{call}");
        assert!(answer["report"]["flipped"] == 0 || options.contains("lscm"), "{call}");
    }
    // A target that cannot be reached with the cuts allowed is no success.
    let output = folder.run("flatten torus.obj --target 4.001 --most-cuts 1 --json");
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((output.status.code(), &answer["stop"]), (Some(3), &Value::from("steps")));
}
