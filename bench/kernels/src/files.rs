//! Mesh files in memory.

use pompeiu_core::TriMesh;
use pompeiu_io::{Attributes, Format, OutputFormat, encode};

/// A file as a reader gets it.
pub struct File {
    pub name: &'static str,
    pub format: Format,
    pub bytes: Vec<u8>,
}

/// One mesh in the formats whose readers are our own. `obj_6_digits` holds decimals as most programs write them,
/// `obj` every digit of the doubles.
pub fn of_mesh(mesh: &TriMesh) -> Vec<File> {
    let attributes = Attributes::for_mesh(mesh);
    let file = |name, mesh: &TriMesh, to, format| {
        let mut bytes = Vec::new();
        encode(&mut bytes, to, mesh, &attributes).expect("a vector takes everything");
        File { name, format, bytes }
    };
    let decimals = mesh.positions().iter().map(|p| p.map(|x| (x * 1e6).round() / 1e6)).collect();
    let decimals = TriMesh::new(decimals, mesh.faces().to_vec()).expect("finite");
    vec![
        file("obj_6_digits", &decimals, OutputFormat::Obj, Format::Obj),
        file("obj", mesh, OutputFormat::Obj, Format::Obj),
        file("ply", mesh, OutputFormat::Ply, Format::Ply),
        file("stl", mesh, OutputFormat::Stl, Format::Stl),
        file("off", mesh, OutputFormat::Off, Format::Off),
    ]
}
