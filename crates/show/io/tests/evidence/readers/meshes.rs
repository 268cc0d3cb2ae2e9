//! Meshes and their files.

use pompeiu_core::TriMesh;
use pompeiu_io::{Attributes, OutputFormat, encode};

/// A closed surface over a grid of angles, uneven in every coordinate, with about 4 `side`² faces.
pub(crate) fn wavy_sphere(side: u32) -> TriMesh {
    let (rows, columns) = (side, 2 * side);
    let mut positions = Vec::new();
    for i in 0..=rows {
        for j in 0..columns {
            let (t, p) = (f64::from(i) / f64::from(rows), f64::from(j) / f64::from(columns));
            let (t, p) = (t * std::f64::consts::PI, p * std::f64::consts::TAU);
            let r = 1.0 + 0.1 * (5.0 * t).sin() * (7.0 * p).cos();
            positions.push([r * t.sin() * p.cos(), -r * t.sin() * p.sin(), r * t.cos() * 1e-3]);
        }
    }
    let index = |i: u32, j: u32| i * columns + j % columns;
    let faces = (0..rows * columns)
        .map(|k| (k / columns, k % columns))
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    TriMesh::new(positions, faces).unwrap()
}

/// The file that our writer makes.
pub(crate) fn file(format: OutputFormat, mesh: &TriMesh) -> Vec<u8> {
    let mut bytes = Vec::new();
    encode(&mut bytes, format, mesh, &Attributes::for_mesh(mesh)).unwrap();
    bytes
}

/// Asserts the same arrays, bit for bit.
pub(crate) fn assert_same(found: &TriMesh, expected: &TriMesh, what: &str) {
    assert_eq!(found.faces(), expected.faces(), "faces of {what}");
    let bits = |mesh: &TriMesh| -> Vec<u64> {
        mesh.positions().as_flattened().iter().map(|x| x.to_bits()).collect()
    };
    assert!(bits(found) == bits(expected), "positions of {what}");
}
