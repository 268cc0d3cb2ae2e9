//! Object File Format.

use super::text::TextWriter;
use super::{Attributes, EncodeError};
use pompeiu_core::TriMesh;
use std::io::Write;

pub(super) fn write(out: impl Write, mesh: &TriMesh, attributes: &Attributes) -> Result<(), EncodeError> {
    let mut text = TextWriter::new(out);
    text.text(if attributes.vertex_colors().is_some() { "COFF" } else { "OFF" });
    text.end_line()?;
    text.integer(mesh.positions().len());
    text.text(" ");
    text.integer(mesh.faces().len());
    // The number of edges, which readers ignore.
    text.text(" 0");
    text.end_line()?;
    for (v, [x, y, z]) in mesh.positions().iter().enumerate() {
        text.real(*x);
        text.text(" ");
        text.real(*y);
        text.text(" ");
        text.real(*z);
        if let Some(colors) = attributes.vertex_colors() {
            write_color(&mut text, colors[v]);
            // The fourth channel of a COFF vertex is opacity.
            text.text(" 255");
        }
        text.end_line()?;
    }
    for (f, face) in mesh.faces().iter().enumerate() {
        text.text("3");
        for &v in face {
            text.text(" ");
            text.integer(v);
        }
        if let Some(colors) = attributes.face_colors() {
            write_color(&mut text, colors[f]);
        }
        text.end_line()?;
    }
    Ok(text.flush()?)
}

fn write_color(text: &mut TextWriter<impl Write>, color: [u8; 3]) {
    for channel in color {
        text.text(" ");
        text.integer(channel);
    }
}
