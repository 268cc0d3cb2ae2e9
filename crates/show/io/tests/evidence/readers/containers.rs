//! File names, compression, and other kinds of input.

use super::meshes::{assert_same, file, wavy_sphere};
use flate2::Compression;
use flate2::write::GzEncoder;
use pompeiu_io::{Format, OutputFormat, read, read_bytes};
use std::io::Write;

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

#[test]
fn content_decides_whatever_the_name_says() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = wavy_sphere(8);
    for (output, format) in [
        (OutputFormat::Obj, Format::Obj),
        (OutputFormat::Ply, Format::Ply),
        (OutputFormat::Stl, Format::Stl),
        (OutputFormat::Off, Format::Off),
    ] {
        let bytes = file(output, &mesh);
        let plain = read_bytes(&bytes, Some(format)).unwrap();
        for name in ["mesh", "mesh.obj", "mesh.ply", "mesh.stl", "mesh.off", "mesh.txt.gz"] {
            let path = folder.path().join(name);
            for (compressed, content) in [(false, &bytes), (true, &gzip(&bytes))] {
                std::fs::write(&path, content).unwrap();
                let found = read(&path).unwrap();
                assert_eq!((found.format, found.compressed), (format, compressed), "{name}");
                assert_same(&found.mesh, &plain.mesh, name);
            }
        }
    }
}

#[test]
fn the_name_decides_where_content_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let text = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let path = folder.path().join("mesh.off");
    std::fs::write(&path, text).unwrap();
    assert_eq!(read(&path).unwrap().format, Format::Off);
    let path = folder.path().join("mesh.OFF.GZ");
    std::fs::write(&path, gzip(text.as_bytes())).unwrap();
    assert!(read(&path).unwrap().compressed);
    assert!(
        read_bytes(text.as_bytes(), None).unwrap_err().to_string().starts_with("begins with \"3 1 0\\n0 0")
    );
}

#[cfg(target_os = "linux")]
#[test]
fn names_need_not_be_unicode_and_pipes_can_be_read() {
    use std::os::unix::ffi::OsStrExt;
    let folder = tempfile::tempdir().unwrap();
    let mesh = wavy_sphere(8);
    let bytes = file(OutputFormat::Obj, &mesh);
    let path = folder.path().join(std::ffi::OsStr::from_bytes(b"\xFF\xFE.obj"));
    std::fs::write(&path, &bytes).unwrap();
    assert_same(&read(&path).unwrap().mesh, &mesh, "a name that is not Unicode");

    let (pipe, mut writer) = std::io::pipe().unwrap();
    let feeder = std::thread::spawn(move || writer.write_all(&bytes).unwrap());
    let path = format!("/proc/self/fd/{}", std::os::fd::AsRawFd::as_raw_fd(&pipe));
    assert_same(&read(path).unwrap().mesh, &mesh, "a pipe");
    feeder.join().unwrap();
}
