//! STL against `stl_io`.

use super::meshes::{file, wavy_sphere};
use pompeiu_core::TriMesh;
use pompeiu_io::{Format, OutputFormat, read_bytes};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::io::Cursor;

fn corners(mesh: &TriMesh) -> Vec<[[f64; 3]; 3]> {
    mesh.faces().iter().map(|face| face.map(|i| mesh.positions()[i as usize])).collect()
}

/// The corners that `stl_io` reads.
fn second_reading(bytes: &[u8]) -> Vec<[[f64; 3]; 3]> {
    let mesh = stl_io::read_stl(&mut Cursor::new(bytes)).unwrap();
    mesh.faces.iter().map(|face| face.vertices.map(|i| mesh.vertices[i].0.map(f64::from))).collect()
}

/// Equal positions share a vertex, and every vertex is used.
fn assert_welded(mesh: &TriMesh) {
    let different: BTreeSet<[u64; 3]> =
        corners(mesh).as_flattened().iter().map(|p| p.map(|x| (x + 0.0).to_bits())).collect();
    assert_eq!(different.len(), mesh.positions().len());
}

#[test]
fn binary_is_read_as_by_stl_io() {
    let mesh = wavy_sphere(80);
    let bytes = file(OutputFormat::Stl, &mesh);
    let found = read_bytes(&bytes, None).unwrap();
    assert_eq!(found.format, Format::Stl);
    assert!(corners(&found.mesh) == second_reading(&bytes));
    assert_welded(&found.mesh);
}

#[test]
fn files_of_the_other_are_read() {
    let mesh = wavy_sphere(10);
    let triangles: Vec<stl_io::Triangle> = corners(&mesh)
        .into_iter()
        .map(|corners| stl_io::Triangle {
            normal: stl_io::Normal::new([0.0, 0.0, 1.0]),
            vertices: corners.map(|p| stl_io::Vertex::new(p.map(|x| x as f32))),
        })
        .collect();
    let mut bytes = Vec::new();
    stl_io::write_stl(&mut bytes, triangles.iter()).unwrap();
    let found = read_bytes(&bytes, None).unwrap().mesh;
    let expected: Vec<_> = triangles.iter().map(|t| t.vertices.map(|v| v.0.map(f64::from))).collect();
    assert!(corners(&found) == expected);
    bytes[..5].copy_from_slice(b"solid");
    assert!(corners(&read_bytes(&bytes, None).unwrap().mesh) == expected);
}

#[test]
fn ascii_is_read_as_by_stl_io() {
    // Single precision, since `stl_io` keeps no more.
    let expected: Vec<[[f64; 3]; 3]> =
        corners(&wavy_sphere(10)).iter().map(|t| t.map(|p| p.map(|x| f64::from(x as f32)))).collect();
    let mut text = "solid sphere\n".to_owned();
    for triangle in &expected {
        text += "facet normal 0 0 1\nouter loop\n";
        for [x, y, z] in triangle {
            writeln!(text, "vertex {x} {y} {z}").unwrap();
        }
        text += "endloop\nendfacet\n";
    }
    text += "endsolid sphere\n";
    let found = read_bytes(text.as_bytes(), None).unwrap();
    assert_eq!(found.format, Format::Stl);
    assert!(corners(&found.mesh) == expected);
    assert!(second_reading(text.as_bytes()) == expected);
    assert_welded(&found.mesh);
}
