//! Colours, texture coordinates and materials come back from the files they were written to.

use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_io::{Attributes, CornerValues, Materials, OutputFormat, read_appearance, write_with};
use std::fs;

#[test]
fn what_is_written_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = icosphere(1.0, 2).unwrap();
    let faces = mesh.faces().len() as u32;
    let colors: Vec<[u8; 3]> = (0..mesh.positions().len()).map(|v| [v as u8, 255 - v as u8, 7]).collect();
    let texture = CornerValues {
        values: (0..3 * faces).map(|i| [f64::from(i) / 7.0, -0.25]).collect(),
        corners: (0..faces).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect(),
    };
    let materials = Materials {
        library: Some("of wood.mtl".into()),
        names: vec![String::new(), "oak".into(), "ash".into()],
        faces: (0..faces).map(|f| f % 3).collect(),
        ..Materials::default()
    };
    let bare = || Attributes::for_mesh(&mesh);
    let (coordinates, corners) = (texture.values.clone(), texture.corners.clone());
    let all = bare().with_vertex_colors(colors.clone()).unwrap();
    let all = all.with_texture(coordinates, corners, None).unwrap();
    let all = all.with_materials(materials.clone()).unwrap();
    let path = folder.path().join("all.obj");
    write_with(&path, &mesh, &all).unwrap();
    let found = read_appearance(&path, &mesh).unwrap();
    assert_eq!(found.colors.as_ref(), Some(&colors));
    assert_eq!(found.texture, [texture]);
    let read = found.materials.unwrap();
    let name = |m: &Materials, f: usize| m.names[m.faces[f] as usize].clone();
    assert!((0..faces as usize).all(|f| name(&read, f) == name(&materials, f)));
    assert_eq!(read.library, materials.library);

    let colored = bare().with_vertex_colors(colors.clone()).unwrap();
    for name in ["colored.ply", "colored.ply.gz"] {
        let path = folder.path().join(name);
        write_with(&path, &mesh, &colored).unwrap();
        assert_eq!(read_appearance(&path, &mesh).unwrap().colors.as_ref(), Some(&colors), "{name}");
    }
    for format in [OutputFormat::Stl, OutputFormat::Off] {
        let path = folder.path().join(format!("bare.{}", format.suffix()));
        write_with(&path, &mesh, &bare()).unwrap();
        assert_eq!(read_appearance(&path, &mesh).unwrap(), pompeiu_io::Appearance::default());
    }
}

#[test]
fn colours_of_any_number_type() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("colors.ply");
    let of = |kind: &str, most: f64| {
        let vertex = |p: &str| format!("{p} {most} 0 {}\n", most / 5.0);
        let text = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
             property {kind} red\nproperty {kind} green\nproperty {kind} blue\nelement face 1\n\
             property list uchar int vertex_indices\nend_header\n{}{}{}3 0 1 2\n",
            vertex("0 0 0"),
            vertex("1 0 0"),
            vertex("0 1 0")
        );
        fs::write(&path, text).unwrap();
        let mesh = pompeiu_io::read_mesh(&path).unwrap();
        read_appearance(&path, &mesh).unwrap().colors.unwrap()
    };
    for (kind, most) in [("uchar", 255.0), ("ushort", 65535.0), ("float", 1.0)] {
        assert_eq!(of(kind, most), [[255, 0, 51]; 3], "{kind}");
    }
}

#[test]
fn a_file_that_changed_is_an_error_and_no_panic() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\n").unwrap();
    let error = read_appearance(&path, &icosphere(1.0, 0).unwrap()).map(|found| found.texture);
    assert_eq!(error.unwrap(), [], "other faces");
    let one = pompeiu_core::TriMesh::new(vec![[0.0; 3]; 3], vec![[0, 1, 2]]).unwrap();
    let error = read_appearance(&path, &one).unwrap_err().to_string();
    assert!(error.contains("line 5: found more faces"), "{error}");
}
