//! OFF against a word-by-word reader.

use super::data::real_meshes;
use super::meshes::{assert_same, file, wavy_sphere};
use pompeiu_core::TriMesh;
use pompeiu_io::{Format, OutputFormat, read, read_bytes};

/// Reads an OFF file of triangles without comments and colours, word by word.
fn second_reading(bytes: &[u8]) -> TriMesh {
    let text = std::str::from_utf8(bytes).unwrap();
    let mut words = text.split_whitespace();
    assert_eq!(words.next(), Some("OFF"));
    let mut count = || words.next().unwrap().parse::<usize>().unwrap();
    let [vertices, faces, _] = [count(), count(), count()];
    let mut number = || words.next().unwrap().parse::<f64>().unwrap();
    let positions = (0..vertices).map(|_| [number(), number(), number()]).collect();
    let mut index = || words.next().unwrap().parse::<u32>().unwrap();
    let faces = (0..faces)
        .map(|_| {
            assert_eq!(index(), 3);
            [index(), index(), index()]
        })
        .collect();
    TriMesh::new(positions, faces).unwrap()
}

#[test]
fn generated_meshes_are_read_as_by_words() {
    let mesh = wavy_sphere(40);
    let bytes = file(OutputFormat::Off, &mesh);
    let found = read_bytes(&bytes, None).unwrap();
    assert_eq!(found.format, Format::Off);
    assert_same(&found.mesh, &mesh, "our own file");
    assert_same(&found.mesh, &second_reading(&bytes), "our own file read by words");
}

#[test]
fn real_meshes_are_read_as_by_words() {
    for path in real_meshes("off") {
        let second = second_reading(&std::fs::read(&path).unwrap());
        assert_same(&read(&path).unwrap().mesh, &second, &path.display().to_string());
    }
}
