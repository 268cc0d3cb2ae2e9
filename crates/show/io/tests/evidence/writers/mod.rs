//! Every writer against an independent reader, and the state of files after a failed write.

mod appearance;
mod files;
mod glb;
mod meshes;
mod obj;
mod off;
mod ply;
mod stl;
mod vtk_xml;

use pompeiu_core::TriMesh;
use pompeiu_io::{Attributes, OutputFormat, encode};

fn encoded(format: OutputFormat, mesh: &TriMesh, attributes: &Attributes) -> Vec<u8> {
    let mut bytes = Vec::new();
    encode(&mut bytes, format, mesh, attributes).unwrap();
    bytes
}
