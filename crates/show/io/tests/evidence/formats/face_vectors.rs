//! Vectors on faces: round trips, and errors that name the defect.

use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_io::{
    AttributeError, Attributes, EncodeError, OutputFormat, encode, read_face_vectors, write_with,
};
use std::path::PathBuf;
use tempfile::TempDir;

fn vectors(count: usize) -> Vec<[f64; 3]> {
    (0..count).map(|f| [f as f64, (f as f64).sin(), -1.0 / (f as f64 + 0.3)]).collect()
}

fn file(folder: &TempDir, name: &str, content: &[u8]) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, content).unwrap();
    path
}

#[test]
fn vtp_and_ply_bring_back_every_bit() {
    let mesh = icosphere(1.0, 1).unwrap();
    let (first, second) = (vectors(80), vectors(80).into_iter().rev().collect::<Vec<_>>());
    let folder = TempDir::new().unwrap();
    for name in ["a.vtp", "a.ply", "a.ply.gz", "a.vtp.gz"] {
        let path = folder.path().join(name);
        let attributes = Attributes::for_mesh(&mesh)
            .with_face_scalar("height", vec![2.0; 80])
            .unwrap()
            .with_face_vector("wind", first.clone())
            .unwrap();
        write_with(&path, &mesh, &attributes).unwrap();
        assert_eq!(read_face_vectors(&path, None).unwrap(), first, "{name}");
        assert_eq!(pompeiu_io::read_mesh(&path).unwrap(), mesh, "{name}");
        let attributes = attributes.with_face_vector("rain", second.clone()).unwrap();
        write_with(&path, &mesh, &attributes).unwrap();
        assert_eq!(read_face_vectors(&path, Some("rain")).unwrap(), second, "{name}");
        assert_eq!(read_face_vectors(&path, Some("wind")).unwrap(), first, "{name}");
        let message = read_face_vectors(&path, None).unwrap_err().to_string();
        assert!(message.contains("several vectors") && message.contains("wind, rain"), "{message}");
        let message = read_face_vectors(&path, Some("snow")).unwrap_err().to_string();
        assert!(message.contains("snow"), "{message}");
    }
}

#[test]
fn text_formats_of_others() {
    let folder = TempDir::new().unwrap();
    let expected = [[1.0, 2.0, 3.0], [-4.0, 5.5, 6e-3]];
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        element face 2\nproperty float vx\nproperty list uchar int vertex_indices\nproperty float vy\n\
        property float vz\nproperty float nx\nproperty float ny\nproperty float nz\nend_header\n\
        0 0 0\n1 0 0\n0 1 0\n1 1 0\n1 3 0 1 2 2 3 0 0 1\n-4 3 2 1 3 5.5 6e-3 0 0 1\n";
    let vtu = "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">\
        <CellData><DataArray type=\"Int32\" Name=\"ids\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 0 0 0\
        </DataArray><DataArray type=\"Float32\" Name=\"u\" NumberOfComponents=\"3\" format=\"ascii\">1 2 3 -4 5.5 6e-3\
        </DataArray></CellData></Piece></UnstructuredGrid></VTKFile>";
    for (name, content) in [("a.ply", ply), ("a.vtu", vtu), ("a.csv", "x y z\n1 2 3\n-4;5.5;6e-3\n")] {
        assert_eq!(
            read_face_vectors(file(&folder, name, content.as_bytes()), None).unwrap(),
            expected,
            "{name}"
        );
    }
    assert_eq!(read_face_vectors(file(&folder, "b.ply", ply.as_bytes()), Some("v")).unwrap(), expected);
}

#[test]
fn what_cannot_be_read_is_named() {
    let folder = TempDir::new().unwrap();
    let message = |name: &str, content: &str| {
        let error = read_face_vectors(file(&folder, name, content.as_bytes()), None).unwrap_err().to_string();
        error.rsplit_once(&format!("{name}: ")).unwrap().1.to_owned()
    };
    assert_eq!(message("a.csv", "1,2,3\n4,5\n"), "line 2: found 2 numbers, expected 3: a vector");
    assert_eq!(
        message("a.off", "OFF\n3 1 0\n"),
        "found a OFF file, expected vectors in VTP, VTU, PLY or CSV"
    );
    let lines = "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfLines=\"1\" NumberOfPolys=\"1\">\
        </Piece></PolyData></VTKFile>";
    assert!(message("a.vtp", lines).contains("cells beside polygons"));
    let bare =
        "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPolys=\"1\"></Piece></PolyData></VTKFile>";
    assert!(message("b.vtp", bare).contains("no CellData"));
    assert!(read_face_vectors(folder.path().join("missing.csv"), None).is_err());
}

#[test]
fn names_and_formats_are_checked() {
    let mesh = icosphere(1.0, 0).unwrap();
    let with = |name: &str| Attributes::for_mesh(&mesh).with_face_vector(name, vectors(20));
    let duplicate = |name: &str| Err(AttributeError::Duplicate { name: name.into(), elements: "faces" });
    let scalar = with("u").unwrap().with_face_scalar("u_y", vec![0.0; 20]);
    assert_eq!(scalar, duplicate("u_y"));
    let after = Attributes::for_mesh(&mesh).with_face_scalar("u_z", vec![0.0; 20]).unwrap();
    assert_eq!(after.with_face_vector("u", vectors(20)), duplicate("u"));
    assert!(matches!(with("u v"), Err(AttributeError::Name { .. })));
    let short = Attributes::for_mesh(&mesh).with_face_vector("u", vectors(19));
    assert!(matches!(short, Err(AttributeError::Length { expected: 20, found: 19, .. })));
    for format in [OutputFormat::Obj, OutputFormat::Stl, OutputFormat::Off, OutputFormat::Glb] {
        let error = encode(Vec::new(), format, &mesh, &with("u").unwrap()).unwrap_err();
        assert!(matches!(error, EncodeError::Unsupported { attribute: "face vectors", .. }), "{error}");
    }
}
