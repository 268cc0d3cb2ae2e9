//! Binary STL.

use super::{EncodeError, OutputFormat};
use pompeiu_core::{TriMesh, VertexId};
use std::io::Write;

/// Must not begin with `solid`, by which readers recognise the text variant.
const HEADER: [u8; 80] = {
    let mut header = [b' '; 80];
    let text = b"binary STL, single precision";
    let mut i = 0;
    while i < text.len() {
        header[i] = text[i];
        i += 1;
    }
    header
};

pub(super) fn write(mut out: impl Write, mesh: &TriMesh) -> Result<(), EncodeError> {
    check_range(mesh)?;
    out.write_all(&HEADER)?;
    out.write_all(&(mesh.faces().len() as u32).to_le_bytes())?;
    let mut record = [0; 50];
    for face in mesh.faces() {
        let corners = face.map(|v| mesh.positions()[v as usize]);
        let rows = [normal(corners), corners[0], corners[1], corners[2]];
        for (bytes, value) in record.chunks_exact_mut(4).zip(rows.as_flattened()) {
            bytes.copy_from_slice(&(*value as f32).to_le_bytes());
        }
        out.write_all(&record)?;
    }
    Ok(())
}

fn check_range(mesh: &TriMesh) -> Result<(), EncodeError> {
    for (v, position) in mesh.positions().iter().enumerate() {
        if let Some(axis) = position.iter().position(|x| (*x as f32).is_infinite()) {
            let (format, vertex, value) = (OutputFormat::Stl, VertexId(v as u32), position[axis]);
            return Err(EncodeError::SinglePrecision { format, vertex, axis, value });
        }
    }
    Ok(())
}

/// The counter-clockwise unit normal; zero for corners without an area in double precision.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let sub = |p: [f64; 3], q: [f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    // Scaled to the longest edge, so that the products neither overflow nor underflow.
    let (u, v) = (sub(b, a), sub(c, a));
    let largest = u.iter().chain(&v).fold(0.0_f64, |most, x| if x.abs() > most { x.abs() } else { most });
    let (u, v) = (u.map(|x| x / largest), v.map(|x| x / largest));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 { n.map(|x| x / length) } else { [0.0; 3] }
}
