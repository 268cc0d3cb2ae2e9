//! The glTF and VTK readers on files made here, on files by other writers, and on damaged files.

mod damage;
mod face_vectors;
mod gltf;
mod gltf_appearance;
mod hostile;
mod left_out;
mod points;
mod round_trip;
mod solids;
mod three_mf;
mod vtk;

use pompeiu_core::TriMesh;
use pompeiu_io::{Format, ReadMesh, read_bytes};

fn read_as(format: Format, bytes: &[u8]) -> ReadMesh {
    read_bytes(bytes, Some(format)).unwrap_or_else(|error| panic!("{format}: {error}"))
}

fn refusal(format: Format, bytes: &[u8]) -> String {
    match read_bytes(bytes, Some(format)) {
        Ok(read) => panic!("read {} faces, expected an error", read.mesh.faces().len()),
        Err(error) => error.to_string(),
    }
}

/// The corners of each face.
fn triangles(mesh: &TriMesh) -> Vec<[[f64; 3]; 3]> {
    mesh.faces().iter().map(|face| face.map(|v| mesh.positions()[v as usize])).collect()
}
