//! Names, folders and failures.

use super::encoded;
use super::meshes::tetrahedron;
use flate2::read::GzDecoder;
use pompeiu_core::TriMesh;
use pompeiu_io::{
    Attributes, EncodeError, OutputFormat, WriteError, encode, write, write_as, write_whole, write_with,
};
use std::fs;
use std::io::{self, Read};
use std::path::Path;

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn the_suffix_chooses_and_nothing_else_appears() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = tetrahedron();
    let attributes = Attributes::for_mesh(&mesh);
    for format in OutputFormat::ALL {
        let plain = encoded(format, &mesh, &attributes);
        let path = folder.path().join(format!("a.{}", format.suffix()));
        write(&path, &mesh).unwrap();
        assert_eq!(fs::read(&path).unwrap(), plain, "{format:?}");
        let path = folder.path().join(format!("a.{}.gz", format.suffix()));
        write(&path, &mesh).unwrap();
        let mut unpacked = Vec::new();
        GzDecoder::new(fs::File::open(&path).unwrap()).read_to_end(&mut unpacked).unwrap();
        assert_eq!(unpacked, plain, "{format:?}");
    }
    assert_eq!(names(folder.path()).len(), 2 * OutputFormat::ALL.len());
    let path = folder.path().join("a.txt");
    write_as(&path, OutputFormat::Off, &mesh, &attributes).unwrap();
    assert!(fs::read(&path).unwrap().starts_with(b"OFF\n4 4 0\n"));
}

#[test]
fn a_failure_leaves_the_old_file_and_no_other() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.stl");
    fs::write(&path, "old").unwrap();
    let far = TriMesh::new(vec![[1e100; 3]], vec![[0; 3]]).unwrap();
    let error = write(&path, &far).unwrap_err();
    assert!(
        matches!(error, WriteError::Encode { source: EncodeError::SinglePrecision { .. }, .. }),
        "{error}"
    );
    assert!(error.to_string().starts_with(&path.display().to_string()), "{error}");
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(names(folder.path()), ["a.stl"]);
    write(&path, &tetrahedron()).unwrap();
    assert_eq!(fs::metadata(&path).unwrap().len(), 84 + 4 * 50);
}

#[test]
fn unusable_places_are_errors() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = tetrahedron();
    let unknown = write(folder.path().join("a.xyz"), &mesh).unwrap_err();
    assert!(matches!(unknown, WriteError::UnknownFormat { .. }), "{unknown}");
    assert!(unknown.to_string().contains("obj, ply"), "{unknown}");
    let missing = write(folder.path().join("none/a.obj"), &mesh).unwrap_err();
    assert!(matches!(&missing, WriteError::Io { source, .. } if source.kind() == io::ErrorKind::NotFound));
    fs::create_dir(folder.path().join("b.obj")).unwrap();
    let taken = write(folder.path().join("b.obj"), &mesh).unwrap_err();
    assert!(matches!(&taken, WriteError::Io { source, .. } if source.kind() == io::ErrorKind::IsADirectory));
    assert_eq!(names(folder.path()), ["b.obj"]);
}

#[cfg(unix)]
#[test]
fn links_are_followed_and_new_files_have_the_usual_mode() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("target.obj"), "old").unwrap();
    std::os::unix::fs::symlink(at("target.obj"), at("link.obj")).unwrap();
    write(at("link.obj"), &tetrahedron()).unwrap();
    assert!(fs::symlink_metadata(at("link.obj")).unwrap().is_symlink());
    assert!(fs::read(at("target.obj")).unwrap().starts_with(b"v 0 0 0\n"));
    fs::write(at("plain"), "").unwrap();
    let mode = |name| fs::metadata(at(name)).unwrap().permissions().mode();
    assert_eq!(mode("target.obj"), mode("plain"));
    // Replacing the null device would damage the system.
    assert!(
        write_as("/dev/null", OutputFormat::Obj, &tetrahedron(), &Attributes::for_mesh(&tetrahedron()))
            .is_err()
    );
}

#[test]
fn what_a_format_has_no_room_for_is_an_error() {
    let mesh = tetrahedron();
    let of = || Attributes::for_mesh(&mesh);
    let cases = [
        (OutputFormat::Stl, of().with_vertex_colors(vec![[0; 3]; 4]), "STL has no place for vertex colours"),
        (OutputFormat::Obj, of().with_face_colors(vec![[0; 3]; 4]), "OBJ has no place for face colours"),
        (
            OutputFormat::Off,
            of().with_vertex_scalar("d", vec![0.0; 4]),
            "OFF has no place for vertex scalars",
        ),
        (OutputFormat::Obj, of().with_face_scalar("d", vec![0.0; 4]), "OBJ has no place for face scalars"),
    ];
    for (format, attributes, message) in cases {
        let mut bytes = Vec::new();
        let error = encode(&mut bytes, format, &mesh, &attributes.unwrap()).unwrap_err();
        assert_eq!(error.to_string(), message);
        assert!(bytes.is_empty());
    }
}

#[test]
fn attributes_of_another_mesh_are_refused() {
    let other = TriMesh::new(vec![[0.0; 3]; 5], vec![[0, 1, 2]; 4]).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.ply");
    let error = write_with(&path, &tetrahedron(), &Attributes::for_mesh(&other)).unwrap_err();
    let expected = format!("{}: attributes of another mesh: 5 values for 4 vertices", path.display());
    assert_eq!(error.to_string(), expected);
}

#[test]
fn a_full_disk_is_reported() {
    struct Full(usize);
    impl io::Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let taken = bytes.len().min(self.0);
            self.0 -= taken;
            if taken == 0 { Err(io::ErrorKind::StorageFull.into()) } else { Ok(taken) }
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let mesh = tetrahedron();
    let attributes = Attributes::for_mesh(&mesh);
    for format in OutputFormat::ALL {
        let length = encoded(format, &mesh, &attributes).len();
        encode(Full(length), format, &mesh, &attributes).unwrap();
        let error = encode(Full(length - 1), format, &mesh, &attributes).unwrap_err();
        assert!(matches!(&error, EncodeError::Io(e) if e.kind() == io::ErrorKind::StorageFull), "{error}");
    }
}

#[test]
fn any_file_appears_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("page.html");
    for content in ["<p>one", "two"] {
        write_whole(&path, content.as_bytes()).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), content);
    }
    let error = write_whole(folder.path(), b"three").unwrap_err();
    assert!(matches!(error, WriteError::Io { .. }), "{error}");
    assert!(write_whole(folder.path().join("nowhere/page.html"), b"").is_err());
    assert_eq!(names(folder.path()), ["page.html"]);
}
