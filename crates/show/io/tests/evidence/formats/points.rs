//! Files with points and no faces.

use pompeiu_io::{Format, read, read_mesh_or_points};
use std::fs;

#[test]
fn points_are_faces_without_extent_where_they_are_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let points = [[0.0, 0.0, 0.0], [1.0, 0.5, 0.25], [0.1, 1e-3, 7.0]];
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
    let lines = "0 0 0\n1 .5 .25\n.1 1e-3 7\n";
    let files = [
        ("cloud.ply", format!("{ply}{lines}"), Format::Ply),
        ("cloud.xyz", lines.to_owned(), Format::Xyz),
        ("cloud.pts", format!("3\n{lines}"), Format::Xyz),
        ("cloud.obj", format!("v {}\n", lines.trim_end().replace('\n', "\nv ")), Format::Obj),
    ];
    for (name, text, format) in files {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        let found = read_mesh_or_points(&path).unwrap();
        assert_eq!((found.format, found.is_cloud), (format, true), "{name}");
        assert_eq!(
            (found.mesh.positions(), found.mesh.faces()),
            (&points[..], &[[0; 3], [1; 3], [2; 3]][..])
        );
        let error = read(&path).unwrap_err().to_string();
        assert!(
            error.contains("found 3 vertices, expected at least one face; `pompeiu distance`"),
            "{error}"
        );
    }
    let path = folder.path().join("face.obj");
    fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    assert!(!read_mesh_or_points(&path).unwrap().is_cloud);
    fs::write(&path, "o nothing\n").unwrap();
    assert!(read_mesh_or_points(&path).is_err());
}

#[test]
fn other_formats_are_named_with_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text, advice) in [
        (
            "part.step",
            "ISO-10303-21;\nHEADER;\n",
            "a STEP file with exact surfaces, expected triangles: export it from CAD",
        ),
        (
            "scan.e57",
            "ASTM-E57\u{1}",
            "an E57 file with scanned points, which is not read: export it as PLY or XYZ",
        ),
        // The first word of its first line is one of OBJ.
        ("part.igs", &format!("{:<72}S      1\n", "g part"), "an IGES file with exact surfaces"),
    ] {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        let error = read(&path).unwrap_err().to_string();
        assert!(error.contains(advice), "{error}");
    }
}
