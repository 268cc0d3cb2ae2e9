//! The same mesh at any number of threads.

use super::meshes::{assert_same, file, wavy_sphere};
use pompeiu_core::TriMesh;
use pompeiu_io::{Format, OutputFormat, read_bytes};
use std::fmt::Write;

fn with_threads(threads: usize, bytes: &[u8]) -> TriMesh {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| read_bytes(bytes, None)).unwrap().mesh
}

/// An OBJ file of several megabytes with vertices and faces mixed, polygons concave and not, and relative indices.
fn mixed_obj() -> Vec<u8> {
    let mut text = String::new();
    for i in 0..40_000_u32 {
        let (x, y) = (f64::from(i % 200), f64::from(i / 200));
        writeln!(
            text,
            "v {x} {y} {}\nv {} {y} 0.125\nv {} {} 0\nv {x} {} 0",
            x * y / 7.0,
            x + 0.9,
            x + 0.2,
            y + 0.3,
            y + 0.9
        )
        .unwrap();
        match i % 3 {
            0 => writeln!(text, "f -4 -3 -2 -1").unwrap(),
            1 => writeln!(text, "f {}/1 {} \\\n {} -1 -{}", 4 * i + 1, 4 * i + 2, 4 * i + 3, 4 * i + 4)
                .unwrap(),
            _ => writeln!(text, "f {} 1 -2", 4 * i + 1).unwrap(),
        }
    }
    text.into_bytes()
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let mesh = wavy_sphere(150);
    let mut stl = file(OutputFormat::Stl, &mesh);
    stl[..5].copy_from_slice(b"solid");
    for (format, bytes) in [
        (Format::Obj, file(OutputFormat::Obj, &mesh)),
        (Format::Obj, mixed_obj()),
        (Format::Ply, file(OutputFormat::Ply, &mesh)),
        (Format::Stl, stl),
        (Format::Off, file(OutputFormat::Off, &mesh)),
    ] {
        let one = with_threads(1, &bytes);
        for threads in [2, 8] {
            assert_same(&with_threads(threads, &bytes), &one, &format!("{format} with {threads} threads"));
        }
    }
}

#[test]
fn the_first_error_is_reported_at_any_number_of_threads() {
    let mut bytes = mixed_obj();
    let places: Vec<usize> = [3, 2, 1].map(|k| bytes.len() * k / 4).to_vec();
    for place in places {
        let line = place + bytes[place..].windows(3).position(|w| w == b"\nv ").unwrap() + 3;
        bytes[line] = b'?';
        let messages: Vec<String> = [1, 2, 8]
            .map(|threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                pool.install(|| read_bytes(&bytes, None)).unwrap_err().to_string()
            })
            .to_vec();
        let number = 1 + bytes[..line].split(|&b| b == b'\n').skip(1).count();
        assert!(messages[0].starts_with(&format!("line {number}: found \"?")), "{}", messages[0]);
        assert!(messages.iter().all(|message| *message == messages[0]), "{messages:?}");
    }
}
