//! Stanford PLY, binary little endian.

use super::{Attributes, EncodeError};
use pompeiu_core::TriMesh;
use std::io::Write;

pub(super) fn write(mut out: impl Write, mesh: &TriMesh, attributes: &Attributes) -> Result<(), EncodeError> {
    let vertices = mesh.positions().len();
    writeln!(out, "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}")?;
    writeln!(out, "property double x\nproperty double y\nproperty double z")?;
    declare(&mut out, attributes.vertex_colors(), attributes.vertex_scalars())?;
    writeln!(out, "element face {}", mesh.faces().len())?;
    // Most programs write `int` and some read nothing else; only indices beyond its range need `uint`.
    let index = if i32::try_from(vertices).is_ok() { "int" } else { "uint" };
    writeln!(out, "property list uchar {index} vertex_indices")?;
    declare(&mut out, attributes.face_colors(), attributes.face_scalars())?;
    for (name, _) in attributes.face_vectors() {
        writeln!(out, "property double {name}_x\nproperty double {name}_y\nproperty double {name}_z")?;
    }
    writeln!(out, "end_header")?;

    let scalars: Vec<&[f64]> = attributes.vertex_scalars().map(|(_, values)| values).collect();
    let mut record = Vec::new();
    for (v, position) in mesh.positions().iter().enumerate() {
        record.clear();
        for coordinate in position {
            record.extend_from_slice(&coordinate.to_le_bytes());
        }
        append(&mut record, v, attributes.vertex_colors(), &scalars);
        out.write_all(&record)?;
    }
    let scalars: Vec<&[f64]> = attributes.face_scalars().map(|(_, values)| values).collect();
    for (f, face) in mesh.faces().iter().enumerate() {
        record.clear();
        record.push(3);
        for vertex in face {
            record.extend_from_slice(&vertex.to_le_bytes());
        }
        append(&mut record, f, attributes.face_colors(), &scalars);
        for (_, values) in attributes.face_vectors() {
            record.extend(values[f].iter().flat_map(|x| x.to_le_bytes()));
        }
        out.write_all(&record)?;
    }
    Ok(())
}

fn declare<'a>(
    out: &mut impl Write,
    colors: Option<&[[u8; 3]]>,
    scalars: impl Iterator<Item = (&'a str, &'a [f64])>,
) -> Result<(), EncodeError> {
    if colors.is_some() {
        writeln!(out, "property uchar red\nproperty uchar green\nproperty uchar blue")?;
    }
    for (name, _) in scalars {
        writeln!(out, "property double {name}")?;
    }
    Ok(())
}

fn append(record: &mut Vec<u8>, element: usize, colors: Option<&[[u8; 3]]>, scalars: &[&[f64]]) {
    if let Some(colors) = colors {
        record.extend_from_slice(&colors[element]);
    }
    for values in scalars {
        record.extend_from_slice(&values[element].to_le_bytes());
    }
}
