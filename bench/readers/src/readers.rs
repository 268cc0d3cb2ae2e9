//! The readers compared; each returns the number of faces it found.

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{BeginList, PropertyAccess, PropertyAccessResult};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

pub fn ours(path: &Path) -> usize {
    pompeiu_io::read(path).expect("a mesh").mesh.faces().len()
}

pub fn tobj(path: &Path) -> usize {
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let (models, _) = tobj::load_obj(path, &options).expect("a mesh");
    models.iter().map(|model| model.mesh.indices.len() / 3).sum()
}

pub fn stl_io(path: &Path) -> usize {
    let mut file = BufReader::new(File::open(path).expect("a file"));
    stl_io::read_stl(&mut file).expect("a mesh").faces.len()
}

struct Vertex([f64; 3]);

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self([0.0; 3])
    }

    fn set_float(&mut self, name: &str, value: f32) -> PropertyAccessResult {
        self.set_double(name, f64::from(value))
    }

    fn set_double(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        match name {
            "x" => self.0[0] = value,
            "y" => self.0[1] = value,
            "z" => self.0[2] = value,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

struct Face(Vec<i32>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Self(Vec::new())
    }

    fn begin_list_int(&mut self, _: &str, _: usize) -> BeginList<'_, i32> {
        BeginList::Fill(&mut self.0)
    }
}

/// ply-rs-bw the fast way: into structures of our own.
pub fn ply_rs_bw(path: &Path) -> usize {
    let mut reader = Reader::new(BufReader::new(File::open(path).expect("a file")));
    let (vertex_parser, face_parser) = (Parser::<Vertex>::new(), Parser::<Face>::new());
    let header = vertex_parser.read_header(&mut reader).expect("a header");
    let (mut positions, mut corners) = (Vec::new(), 0);
    for element in header.elements.values() {
        if element.name == "vertex" {
            positions =
                vertex_parser.read_payload_for_element(&mut reader, element, &header).expect("vertices");
        } else {
            let faces = face_parser.read_payload_for_element(&mut reader, element, &header).expect("faces");
            corners = faces.iter().map(|face| face.0.len()).sum();
        }
    }
    std::hint::black_box(positions.iter().map(|vertex| vertex.0[0]).sum::<f64>());
    corners / 3
}
