//! Files without a usable mesh: the error is one line that names the file and the place.

use super::meshes::{file, wavy_sphere};
use pompeiu_io::{OutputFormat, ReadError, read};
use std::path::Path;

/// The message for a file of this name and content, which is one line and begins with the path.
fn message(folder: &Path, name: &str, content: &[u8]) -> String {
    let path = folder.join(name);
    std::fs::write(&path, content).unwrap();
    complaint(&path)
}

fn complaint(path: &Path) -> String {
    let error = read(path).expect_err("this file holds no usable mesh");
    let message = error.to_string();
    assert!(!message.contains('\n'), "{message:?}");
    let start = format!("{}: ", path.display());
    message
        .strip_prefix(&start)
        .unwrap_or_else(|| panic!("{message:?} does not begin with {start:?}"))
        .to_owned()
}

#[test]
fn missing_empty_and_unreadable() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    assert!(matches!(read(at("none.obj")), Err(ReadError::Io { .. })));
    assert!(complaint(&at("none.obj")).contains("No such file"));
    std::fs::create_dir(at("folder.obj")).unwrap();
    assert!(complaint(&at("folder.obj")).contains("directory"));
    for name in ["empty", "empty.obj", "empty.ply", "empty.stl", "empty.off", "empty.gz"] {
        assert_eq!(message(folder.path(), name, b""), "the file is empty, expected a mesh");
    }
    #[cfg(target_os = "linux")]
    assert!(complaint(Path::new("/dev/zero")).contains("a device, expected a file or a pipe"));
    #[cfg(target_os = "linux")]
    assert_eq!(complaint(Path::new("/dev/null")), "a device, expected a file or a pipe");
}

#[cfg(unix)]
#[test]
fn pipes_are_read_when_somebody_writes_into_them() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe.obj");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    assert!(complaint(&pipe).contains("a pipe into which nobody writes"), "{}", complaint(&pipe));
    // More than a pipe buffers, from a writer that starts late and pauses.
    let (mesh, bytes) = wavy_sphere_as_obj();
    let writer = {
        let pipe = pipe.clone();
        std::thread::spawn(move || {
            use std::io::Write;
            let pause = || std::thread::sleep(std::time::Duration::from_millis(50));
            pause();
            let mut pipe = std::fs::File::options().write(true).open(pipe).unwrap();
            let (first, rest) = bytes.split_at(1000);
            pipe.write_all(first).unwrap();
            pause();
            pipe.write_all(rest).unwrap();
        })
    };
    assert_eq!(read(&pipe).unwrap().mesh.faces(), mesh.faces());
    writer.join().unwrap();
}

#[cfg(unix)]
fn wavy_sphere_as_obj() -> (pompeiu_core::TriMesh, Vec<u8>) {
    let mesh = wavy_sphere(60);
    let bytes = file(OutputFormat::Obj, &mesh);
    assert!(bytes.len() > 1 << 17);
    (mesh, bytes)
}

#[test]
fn wrong_formats_and_garbage() {
    let folder = tempfile::tempdir().unwrap();
    let noise: Vec<u8> = (0..5000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    for (name, content, expected) in [
        ("a.jpg", &b"\xFF\xD8\xFF\xE0\0\x10JFIF"[..], "begins with \"\\xff\\xd8"),
        ("a.obj", b"\xFF\xD8\xFF\xE0\0\x10JFIF", "line 1: found \"\\xff\\xd8"),
        ("a.ply", b"\xFF\xD8\xFF\xE0\0\x10JFIF", "line 1: found the end of the file in the header"),
        ("a.ply", b"hello\nworld\n", "line 1: found \"hello\", expected \"ply\""),
        ("a.off", b"hello\nworld\n", "line 1: found \"hello\", expected OFF"),
        ("a.stl", b"hello\nworld\n", "byte 12: found 12 bytes, expected a header of 84 bytes"),
        ("a.obj", b"hello\nworld\n", "found 0 vertices, expected at least one face"),
        ("a.txt", b"hello\nworld\n", "begins with \"hello\\nworld\\n\", expected OBJ, PLY, STL"),
        ("a.obj", b"\n\n\n", "found 0 vertices"),
        ("noise.obj", &noise, "line 1: found"),
        ("noise.ply", &noise, "line 1: found"),
        ("noise.stl", &noise, "byte 84: found 4916 bytes (98 triangles), expected the"),
        ("noise.off", &noise, "line 1: found"),
        ("noise", &noise, "begins with"),
        ("a.gz", b"\x1F\x8Bxxxxx", "the gzip data cannot be decompressed"),
    ] {
        let found = message(folder.path(), name, content);
        assert!(found.starts_with(expected), "{name} gave {found}");
    }
}

#[test]
fn no_faces() {
    let folder = tempfile::tempdir().unwrap();
    let ply = b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n";
    for (name, content, expected) in [
        ("a.obj", &b"v 0 0 0\nv 1 0 0\n"[..], "found 2 vertices, expected at least one face"),
        (
            "b.obj",
            b"v 0 0 0\nf 1\nl 1 1\nf 1 1\n",
            "found 1 vertices and 2 faces with fewer than three corners, expected",
        ),
        ("a.ply", ply, "found 1 vertices, expected at least one face"),
        ("a.off", b"OFF\n1 0 0\n0 0 0\n", "found 1 vertices, expected at least one face"),
        ("a.stl", b"solid\nendsolid\n", "found 0 vertices, expected at least one face"),
    ] {
        let found = message(folder.path(), name, content);
        assert!(found.starts_with(expected), "{name} gave {found}");
    }
}

#[test]
fn binary_files_with_numbers_that_are_none() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = wavy_sphere(4);
    let (n, m) = (mesh.positions().len(), mesh.faces().len());
    let mut ply = file(OutputFormat::Ply, &mesh);
    let vertices = ply.len() - 13 * m - 24 * n;
    ply[vertices + 24 * 7 + 8..][..8].copy_from_slice(&f64::NAN.to_le_bytes());
    assert_eq!(message(folder.path(), "a.ply", &ply), "vertex 7: coordinate y of vertex 7 is NaN");
    ply[vertices + 24 * 7 + 8..][..8].copy_from_slice(&1e308_f64.to_le_bytes());
    assert!(
        message(folder.path(), "a.ply", &ply)
            .starts_with("vertex 7: coordinate y of vertex 7 is 1e308; at most")
    );
    let mut ply = file(OutputFormat::Ply, &mesh);
    ply[vertices + 24 * n + 13 * 5 + 9..][..4].copy_from_slice(&(-1_i32).to_le_bytes());
    let found = message(folder.path(), "a.ply", &ply);
    assert!(found.starts_with("face 5: found vertex index -1, but there are only"), "{found}");
    let mut stl = file(OutputFormat::Stl, &mesh);
    stl[84 + 50 * 3 + 12..][..4].copy_from_slice(&f32::NEG_INFINITY.to_le_bytes());
    let found = message(folder.path(), "a.stl", &stl);
    assert!(found.starts_with("face 3: found coordinate x = -inf of corner 1"), "{found}");
}

/// A file cut anywhere is an error.
#[test]
fn truncated_files_are_errors() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = wavy_sphere(3);
    for format in [OutputFormat::Ply, OutputFormat::Stl, OutputFormat::Off] {
        let bytes = file(format, &mesh);
        // The last number of a text may lose digits and still be valid.
        let text = format == OutputFormat::Off;
        let end = if text { bytes.iter().rposition(|&b| b == b' ').unwrap() } else { bytes.len() - 1 };
        for cut in (1..end).step_by(7).chain([end]) {
            let path = folder.path().join(format!("cut.{}", format.suffix()));
            std::fs::write(&path, &bytes[..cut]).unwrap();
            complaint(&path);
        }
    }
    // OBJ has no counts: a truncated file is valid unless the cut divides a statement or removes vertices that faces use.
    let bytes = file(OutputFormat::Obj, &mesh);
    let text = String::from_utf8(bytes).unwrap();
    let vertices = text.find("\nf ").unwrap();
    for cut in 1..vertices {
        let found = message(folder.path(), "cut.obj", &text.as_bytes()[..cut]);
        assert!(found.contains("expected"), "{found}");
    }
    let mut without_last_vertex = text.clone();
    without_last_vertex.replace_range(text[..vertices].rfind('\n').unwrap()..vertices, "");
    let found = message(folder.path(), "cut.obj", without_last_vertex.as_bytes());
    assert!(found.contains("found vertex index"), "{found}");
}

#[test]
fn truncated_gzip_is_an_error() {
    use std::io::Write;
    let folder = tempfile::tempdir().unwrap();
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    encoder.write_all(&file(OutputFormat::Obj, &wavy_sphere(20))).unwrap();
    let bytes = encoder.finish().unwrap();
    for cut in (2..bytes.len()).step_by(97).chain([bytes.len() - 1]) {
        let found = message(folder.path(), "cut.obj.gz", &bytes[..cut]);
        assert!(found.starts_with("the gzip data cannot be decompressed beyond"), "{found}");
    }
}

/// Ear clipping of a face of this size could take minutes.
#[test]
fn a_face_with_very_many_corners_is_refused_when_it_crosses_itself() {
    use std::fmt::Write;
    let folder = tempfile::tempdir().unwrap();
    let mut text = "v 0 0 0\nf 1 1 1 1\nf 1 1 1\nf".to_owned();
    let corners = 70_000;
    (2..=corners).chain([1]).for_each(|i| write!(text, " {i}").unwrap());
    text.push('\n');
    for i in 1..corners {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(corners);
        writeln!(text, "v {} {} 0", f64::from(1 + i % 2) * angle.cos(), f64::from(1 + i % 2) * angle.sin())
            .unwrap();
    }
    std::fs::write(folder.path().join("star.obj"), &text).unwrap();
    let star = read(folder.path().join("star.obj")).unwrap();
    assert_eq!((star.mesh.faces().len(), star.polygons_triangulated), (2 + 1 + 69_998, 2));
    // One vertex of the star at the other side.
    let crossing = text.replacen("v 1.9", "v -1.9", 1);
    assert_ne!(crossing, text);
    let found = message(folder.path(), "a.obj", crossing.as_bytes());
    assert_eq!(
        found,
        "face 2: found a face with 70000 corners that touches or crosses itself, expected at most 16384"
    );
}
