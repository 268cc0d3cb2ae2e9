//! Damaged files give an error or a valid mesh, never a panic.

use super::vtk;
use pompeiu_core::TriMesh;
use pompeiu_io::{Attributes, Format, OutputFormat, encode, read_bytes, read_face_vectors};
use pompeiu_testkit::effort::cases;
use proptest::prelude::*;
use std::fs;

/// An offset and the change made there.
#[derive(Clone, Debug)]
enum Damage {
    Set(prop::sample::Index, u8),
    Flip(prop::sample::Index, u8),
    Cut(prop::sample::Index),
    Remove(prop::sample::Index, usize),
    Repeat(prop::sample::Index, usize),
    Number(prop::sample::Index, u64),
}

fn damage() -> impl Strategy<Value = Damage> {
    use prop::sample::Index;
    prop_oneof![
        (any::<Index>(), any::<u8>()).prop_map(|(at, byte)| Damage::Set(at, byte)),
        (any::<Index>(), 0_u8..8).prop_map(|(at, bit)| Damage::Flip(at, bit)),
        any::<Index>().prop_map(Damage::Cut),
        (any::<Index>(), 1_usize..9).prop_map(|(at, n)| Damage::Remove(at, n)),
        (any::<Index>(), 1_usize..40).prop_map(|(at, n)| Damage::Repeat(at, n)),
        (any::<Index>(), any::<u64>()).prop_map(|(at, n)| Damage::Number(at, n)),
    ]
}

fn apply(mut bytes: Vec<u8>, damages: &[Damage]) -> Vec<u8> {
    for damage in damages {
        if bytes.is_empty() {
            break;
        }
        let length = bytes.len();
        match damage {
            Damage::Set(at, byte) => bytes[at.index(length)] = *byte,
            Damage::Flip(at, bit) => bytes[at.index(length)] ^= 1 << bit,
            Damage::Cut(at) => bytes.truncate(at.index(length)),
            Damage::Remove(at, n) => {
                let at = at.index(length);
                bytes.drain(at..(at + n).min(length));
            }
            Damage::Repeat(at, n) => {
                let at = at.index(length);
                let part = bytes[at..(at + n).min(length)].to_vec();
                bytes.splice(at..at, part);
            }
            // In text, a digit changes the next number.
            Damage::Number(at, number) => {
                let at = at.index(length);
                if let Some(start) = bytes[at..].iter().position(u8::is_ascii_digit).map(|n| at + n) {
                    let digits = bytes[start..].iter().take_while(|b| b.is_ascii_digit()).count();
                    bytes.splice(start..start + digits, number.to_string().into_bytes());
                }
            }
        }
    }
    bytes
}

fn samples() -> Vec<(Format, Vec<u8>)> {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mesh = TriMesh::new(positions, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]).unwrap();
    let attributes = Attributes::for_mesh(&mesh).with_vertex_colors(vec![[1, 2, 3]; 4]).unwrap();
    let mut samples = Vec::new();
    for (output, format) in [
        (OutputFormat::Glb, Format::Glb),
        (OutputFormat::Vtp, Format::Vtp),
        (OutputFormat::Vtu, Format::Vtu),
        (OutputFormat::ThreeMf, Format::ThreeMf),
    ] {
        let mut bytes = Vec::new();
        let plain = Attributes::for_mesh(&mesh);
        encode(&mut bytes, output, &mesh, if output.holds_vertex_colors() { &attributes } else { &plain })
            .unwrap();
        samples.push((format, bytes));
    }
    samples
}

/// Also files by other programs.
fn all_samples() -> Vec<(Format, Vec<u8>)> {
    let mut samples = samples();
    for (suffix, format) in [("vtk", Format::VtkLegacy), ("vtp", Format::Vtp), ("vtu", Format::Vtu)] {
        samples.extend(vtk::files(suffix).into_iter().map(|path| (format, fs::read(path).unwrap())));
    }
    samples
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(20_000)))]

    #[test]
    fn no_damage_makes_a_reader_panic(
        (format, bytes) in prop::sample::select(all_samples()),
        damages in prop::collection::vec(damage(), 1..5),
    ) {
            let bytes = apply(bytes, &damages);
            match read_bytes(&bytes, Some(format)) {
                Ok(read) => prop_assert!(!read.mesh.faces().is_empty()),
                Err(error) => prop_assert!(!error.to_string().contains('\n'), "{}", error),
            }
    }

    #[test]
    fn no_bytes_make_a_reader_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        for format in [Format::Gltf, Format::Glb, Format::VtkLegacy, Format::Vtp, Format::Vtu, Format::ThreeMf] {
            prop_assert!(read_bytes(&bytes, Some(format)).is_err());
        }
    }
}

/// Files with vectors on faces, by suffix.
fn samples_with_vectors() -> Vec<(&'static str, Vec<u8>)> {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = TriMesh::new(positions, vec![[0, 1, 2], [0, 2, 1]]).unwrap();
    let vectors = vec![[1.0, -0.5, 0.25], [0.0, 1e-300, 3.0]];
    let attributes = Attributes::for_mesh(&mesh).with_face_vector("wind", vectors).unwrap();
    let mut samples = vec![("csv", b"x,y,z\n1,-0.5,.25 # calm\n0;1e-300;3\n".to_vec())];
    for (output, suffix) in
        [(OutputFormat::Ply, "ply"), (OutputFormat::Vtp, "vtp"), (OutputFormat::Vtu, "vtu")]
    {
        let mut bytes = Vec::new();
        encode(&mut bytes, output, &mesh, &attributes).unwrap();
        samples.push((suffix, bytes));
    }
    samples
}

#[test]
fn vectors_of_undamaged_files_are_read() {
    let folder = tempfile::tempdir().unwrap();
    for (suffix, bytes) in samples_with_vectors() {
        let path = folder.path().join(format!("field.{suffix}"));
        fs::write(&path, bytes).unwrap();
        assert_eq!(
            read_face_vectors(&path, None).unwrap(),
            [[1.0, -0.5, 0.25], [0.0, 1e-300, 3.0]],
            "{suffix}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(4_000)))]

    #[test]
    fn no_damage_makes_a_reader_of_vectors_panic(
        (suffix, bytes) in prop::sample::select(samples_with_vectors()),
        damages in prop::collection::vec(damage(), 1..5),
        named in any::<bool>(),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(format!("field.{suffix}"));
        fs::write(&path, apply(bytes, &damages)).unwrap();
        if let Err(error) = read_face_vectors(&path, named.then_some("wind")) {
            prop_assert!(!error.to_string().contains('\n'), "{}", error);
        }
    }
}

/// Every proper prefix of a file is an error if the format states its extent. Legacy VTK files do not: cut between two arrays, they
/// are smaller files.
#[test]
fn truncated_files_are_errors() {
    let told = all_samples().into_iter().filter(|(format, _)| *format != Format::VtkLegacy);
    for (format, bytes) in told {
        for length in 0..bytes.trim_ascii_end().len() {
            if let Ok(read) = read_bytes(&bytes[..length], Some(format)) {
                panic!(
                    "{format} cut after {length} of {} bytes: {} faces",
                    bytes.len(),
                    read.mesh.faces().len()
                );
            }
        }
    }
}
