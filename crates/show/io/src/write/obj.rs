//! Wavefront OBJ.

use super::text::TextWriter;
use super::{Attributes, EncodeError};
use pompeiu_core::TriMesh;
use std::io::Write;

pub(super) fn write(out: impl Write, mesh: &TriMesh, attributes: &Attributes) -> Result<(), EncodeError> {
    let mut text = TextWriter::new(out);
    let materials = attributes.materials();
    if let Some(library) = materials.and_then(|materials| materials.library.as_deref()) {
        text.text("mtllib ");
        text.text(&on_one_line(library));
        text.end_line()?;
    }
    for (v, position) in mesh.positions().iter().enumerate() {
        text.text("v");
        for &coordinate in position {
            text.text(" ");
            text.real(coordinate);
        }
        if let Some(colors) = attributes.vertex_colors() {
            for channel in colors[v] {
                text.text(" ");
                text.real(f64::from(channel) / 255.0);
            }
        }
        text.end_line()?;
    }
    let texture = attributes.texture().first();
    for place in texture.iter().flat_map(|texture| &texture.values) {
        text.text("vt");
        for &coordinate in place {
            text.text(" ");
            text.real(coordinate);
        }
        text.end_line()?;
    }
    let mut material = 0;
    for (f, face) in mesh.faces().iter().enumerate() {
        if let Some(materials) = materials.filter(|materials| materials.faces[f] != material) {
            material = materials.faces[f];
            text.text("usemtl ");
            text.text(&on_one_line(&materials.names[material as usize]));
            text.end_line()?;
        }
        text.text("f");
        for (i, &v) in face.iter().enumerate() {
            text.text(" ");
            text.integer(u64::from(v) + 1);
            if let Some(texture) = texture {
                text.text("/");
                text.integer(u64::from(texture.corners[f][i]) + 1);
            }
        }
        text.end_line()?;
    }
    Ok(text.flush()?)
}

/// A name without characters that would end the statement.
fn on_one_line(name: &str) -> String {
    name.chars().filter(|c| !c.is_control() && *c != '#').collect()
}
