//! Meshes and attributes with extreme values.

use pompeiu_core::TriMesh;
use pompeiu_io::Attributes;
use proptest::prelude::*;

/// Coordinates of every magnitude that a mesh may have, subnormal and negative zero included.
fn any_coordinate() -> impl Strategy<Value = f64> {
    any::<u64>().prop_map(supported)
}

/// Coordinates that single precision holds without overflow.
fn single_coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![-1e3..1e3, -1e-40..1e-40, -3.4e38..3.4e38]
}

/// The double with these bits; where it would be too large, without the top bit of the exponent.
fn supported(bits: u64) -> f64 {
    let value = f64::from_bits(bits);
    if value.abs() <= TriMesh::MAX_COORDINATE { value } else { f64::from_bits(bits & !(1 << 62)) }
}

fn mesh_of(coordinate: impl Strategy<Value = f64> + Clone) -> impl Strategy<Value = TriMesh> {
    let position = [coordinate.clone(), coordinate.clone(), coordinate];
    prop::collection::vec(position, 1..40).prop_flat_map(|positions| {
        let n = positions.len() as u32;
        prop::collection::vec([0..n, 0..n, 0..n], 1..60)
            .prop_map(move |faces| TriMesh::new(positions.clone(), faces).unwrap())
    })
}

pub(crate) fn any_mesh() -> impl Strategy<Value = TriMesh> {
    mesh_of(any_coordinate().boxed())
}

pub(crate) fn single_precision_mesh() -> impl Strategy<Value = TriMesh> {
    mesh_of(single_coordinate().boxed())
}

pub(crate) fn any_colors(count: usize) -> impl Strategy<Value = Vec<[u8; 3]>> {
    prop::collection::vec(any::<[u8; 3]>(), count)
}

/// Any bits: infinities and NaN are values like others here.
fn any_scalar(count: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(any::<u64>().prop_map(f64::from_bits), count)
}

pub(crate) fn colored(mesh: impl Strategy<Value = TriMesh>) -> impl Strategy<Value = (TriMesh, Attributes)> {
    mesh.prop_flat_map(|mesh| {
        (any_colors(mesh.positions().len()), Just(mesh)).prop_map(|(colors, mesh)| {
            let attributes = Attributes::for_mesh(&mesh).with_vertex_colors(colors).unwrap();
            (mesh, attributes)
        })
    })
}

pub(crate) fn fully_attributed() -> impl Strategy<Value = (TriMesh, Attributes)> {
    any_mesh().prop_flat_map(|mesh| {
        let (n, m) = (mesh.positions().len(), mesh.faces().len());
        let values = (any_colors(n), any_colors(m), any_scalar(n), any_scalar(n), any_scalar(m));
        values.prop_map(move |(vertex_colors, face_colors, first, second, of_faces)| {
            let attributes = Attributes::for_mesh(&mesh)
                .with_vertex_colors(vertex_colors)
                .and_then(|a| a.with_face_colors(face_colors))
                .and_then(|a| a.with_vertex_scalar("distance", first))
                .and_then(|a| a.with_vertex_scalar("mean_curvature-2", second))
                .and_then(|a| a.with_face_scalar("distance", of_faces))
                .unwrap();
            (mesh.clone(), attributes)
        })
    })
}

pub(crate) fn bits(positions: &[[f64; 3]]) -> Vec<[u64; 3]> {
    positions.iter().map(|p| p.map(f64::to_bits)).collect()
}

pub(crate) fn tetrahedron() -> TriMesh {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    TriMesh::new(positions, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]).unwrap()
}
