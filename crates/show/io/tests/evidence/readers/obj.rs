//! OBJ against tobj.

use super::data::real_meshes;
use super::meshes::{assert_same, file, wavy_sphere};
use pompeiu_core::TriMesh;
use pompeiu_io::{Format, OutputFormat, read, read_bytes};
use std::fmt::Write;

/// What tobj reads, all models together, with its own fans for polygons.
fn second_reading(bytes: &[u8]) -> TriMesh {
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let (models, _) =
        tobj::load_obj_buf(&mut &*bytes, &options, |_| Err(tobj::LoadError::GenericFailure)).unwrap();
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for tobj::Model { mesh, .. } in models {
        let before = positions.len() as u32;
        positions.extend_from_slice(mesh.positions.as_chunks().0);
        faces.extend(mesh.indices.as_chunks::<3>().0.iter().map(|face| face.map(|i| i + before)));
    }
    TriMesh::new(positions, faces).unwrap()
}

/// The corners of all faces: tobj orders vertices by their first use, so indices differ.
fn corners(mesh: &TriMesh) -> Vec<[[f64; 3]; 3]> {
    mesh.faces().iter().map(|face| face.map(|i| mesh.positions()[i as usize])).collect()
}

#[test]
fn generated_meshes_are_read_as_by_tobj() {
    let mesh = wavy_sphere(60);
    let bytes = file(OutputFormat::Obj, &mesh);
    let found = read_bytes(&bytes, None).unwrap();
    assert_eq!((found.format, found.compressed), (Format::Obj, false));
    assert_same(&found.mesh, &mesh, "our own file");
    assert!(corners(&found.mesh) == corners(&second_reading(&bytes)));
}

#[test]
fn every_form_is_read_as_by_tobj() {
    let mesh = wavy_sphere(20);
    let mut text = "# header\nmtllib none.mtl\no sphere\n".to_owned();
    for (i, [x, y, z]) in mesh.positions().iter().enumerate() {
        writeln!(text, "v\t{x:+e}  {y:.80} {z} 0.5 0.25 1\r\nvt 0.5 {i}\nvn 0 0 1").unwrap();
    }
    let n = mesh.positions().len();
    for (k, face) in mesh.faces().iter().enumerate() {
        let [a, b, c] = face.map(|i| i as usize + 1);
        match k % 5 {
            0 => writeln!(text, "f {a} {b} {c}").unwrap(),
            1 => writeln!(text, "f {a}/{a} {b}/{b} {c}/{c} ").unwrap(),
            2 => writeln!(text, "f {a}//{c} {b}//{b} {c}//{a}").unwrap(),
            3 => writeln!(text, "usemtl m{k}\ng group{k}\n f  {a}/{b}/{c}\t{b}/{c}/{a} {c}/{a}/{b}").unwrap(),
            _ => writeln!(text, "s {k}\nf -{} -{} -{}", n + 1 - a, n + 1 - b, n + 1 - c).unwrap(),
        }
    }
    let found = read_bytes(text.as_bytes(), None).unwrap().mesh;
    assert_same(&found, &mesh, "every form");
    assert!(corners(&found) == corners(&second_reading(text.as_bytes())));
}

#[test]
fn convex_polygons_are_cut_as_by_tobj() {
    let mut text = String::new();
    let sides = 3..12;
    for (row, sides) in sides.clone().enumerate() {
        for k in 0..sides {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(sides);
            writeln!(text, "v {} {} {row}", angle.cos(), angle.sin()).unwrap();
        }
        text += "f";
        for k in (1..=sides).rev() {
            write!(text, " -{k}").unwrap();
        }
        text += "\n";
    }
    let found = read_bytes(text.as_bytes(), None).unwrap();
    assert_eq!(found.polygons_triangulated, 8);
    assert_eq!(found.mesh.faces().len() as u32, sides.map(|n| n - 2).sum::<u32>());
    assert!(corners(&found.mesh) == corners(&second_reading(text.as_bytes())));
}

#[test]
fn concave_polygons_keep_their_area() {
    let text = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 3 1 0\nv 0 1 0\nf 1 2 3 4\nf 2 3 4 1\nf 5 4 3 2 1\nf 1 2\n";
    let found = read_bytes(text.as_bytes(), None).unwrap();
    let area =
        |[a, b, c]: [[f64; 3]; 3]| ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0;
    let areas: Vec<f64> = corners(&found.mesh).into_iter().map(area).collect();
    assert!(areas[..4].iter().all(|&a| a > 0.0) && areas[4..].iter().all(|&a| a < 0.0), "{areas:?}");
    assert_eq!(
        [areas[..2].iter().sum::<f64>(), areas[2..4].iter().sum(), areas[4..].iter().sum()],
        [4.0, 4.0, -5.5]
    );
    assert_eq!((found.polygons_triangulated, found.faces_dropped), (3, 1));
}

#[test]
fn real_meshes_are_read_as_by_tobj() {
    for path in real_meshes("obj") {
        let found = read(&path).unwrap();
        let second = second_reading(&std::fs::read(&path).unwrap());
        if found.polygons_triangulated == 0 {
            assert!(corners(&found.mesh) == corners(&second), "{}", path.display());
        } else {
            assert_eq!(found.mesh.faces().len(), second.faces().len(), "{}", path.display());
        }
    }
}
