//! glTF 2.0 in one binary file.

use super::{Attributes, EncodeError, OutputFormat};
use pompeiu_core::{TriMesh, VertexId};
use serde_json::json;
use std::io::Write;

const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;
const TRIANGLES: u32 = 4;

pub(super) fn write(mut out: impl Write, mesh: &TriMesh, attributes: &Attributes) -> Result<(), EncodeError> {
    let origin = origin(mesh);
    let [lowest, highest] = range(mesh, origin)?;
    let (n, m) = (mesh.positions().len() as u64, mesh.faces().len() as u64);
    let colors = attributes.vertex_colors();

    let (position_bytes, index_bytes) = (12 * n, 12 * m);
    let color_bytes = if colors.is_some() { 8 * n } else { 0 };
    let length = position_bytes + index_bytes + color_bytes;
    let mut document = json!({
        "asset": { "version": "2.0", "generator": "pompeiu" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": 0 }, "indices": 1, "material": 0, "mode": TRIANGLES
        }] }],
        // The default is polished metal, which is dark wherever there is nothing around to mirror.
        "materials": [{
            "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 1 }, "doubleSided": true
        }],
        "buffers": [{ "byteLength": length }],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": position_bytes, "target": ARRAY_BUFFER },
            { "buffer": 0, "byteOffset": position_bytes, "byteLength": index_bytes,
              "target": ELEMENT_ARRAY_BUFFER }
        ],
        "accessors": [
            { "bufferView": 0, "componentType": FLOAT, "count": n, "type": "VEC3",
              "min": lowest.map(f64::from), "max": highest.map(f64::from) },
            { "bufferView": 1, "componentType": UNSIGNED_INT, "count": 3 * m, "type": "SCALAR" }
        ]
    });
    if origin != [0.0; 3] {
        document["nodes"][0]["translation"] = json!(origin);
    }
    if colors.is_some() {
        document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(2);
        let view = json!({ "buffer": 0, "byteOffset": position_bytes + index_bytes,
            "byteLength": color_bytes, "target": ARRAY_BUFFER });
        let accessor = json!({ "bufferView": 2, "componentType": UNSIGNED_SHORT, "normalized": true,
            "count": n, "type": "VEC4" });
        for (list, item) in [("bufferViews", view), ("accessors", accessor)] {
            if let Some(list) = document[list].as_array_mut() {
                list.push(item);
            }
        }
    }
    let mut document = document.to_string().into_bytes();
    document.resize(document.len().next_multiple_of(4), b' ');

    let total = 12 + 8 + document.len() as u64 + 8 + length;
    let Ok(file_length) = u32::try_from(total) else {
        let (format, limit) = (OutputFormat::Glb, u64::from(u32::MAX));
        return Err(EncodeError::TooLong { format, bytes: total, limit });
    };
    out.write_all(b"glTF")?;
    for word in [2, file_length, document.len() as u32] {
        out.write_all(&word.to_le_bytes())?;
    }
    out.write_all(b"JSON")?;
    out.write_all(&document)?;
    out.write_all(&(length as u32).to_le_bytes())?;
    out.write_all(b"BIN\0")?;
    for position in mesh.positions() {
        for coordinate in relative(*position, origin) {
            out.write_all(&coordinate.to_le_bytes())?;
        }
    }
    for vertex in mesh.faces().as_flattened() {
        out.write_all(&vertex.to_le_bytes())?;
    }
    if let Some(colors) = colors {
        let linear = linear_from_srgb();
        for [red, green, blue] in colors {
            for channel in [linear[*red as usize], linear[*green as usize], linear[*blue as usize], u16::MAX]
            {
                out.write_all(&channel.to_le_bytes())?;
            }
        }
    }
    Ok(())
}

fn relative(position: [f64; 3], origin: [f64; 3]) -> [f32; 3] {
    [0, 1, 2].map(|axis| (position[axis] - origin[axis]) as f32)
}

/// Where the coordinates written are counted from: the centre along an axis where that leaves smaller numbers,
/// zero where single precision holds all coordinates as they are. A single-precision number itself, because many
/// programs hold the translation of a node as one.
fn origin(mesh: &TriMesh) -> [f64; 3] {
    [0, 1, 2].map(|axis| {
        let coordinates = || mesh.positions().iter().map(|p| p[axis]);
        if coordinates().all(|x| f64::from(x as f32) == x) {
            return 0.0;
        }
        let (lowest, highest) = coordinates().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (if x < low { x } else { low }, if x > high { x } else { high })
        });
        let centre = f64::from((0.5 * lowest + 0.5 * highest) as f32);
        let half_extent = 0.5 * highest - 0.5 * lowest;
        if centre.is_finite() && centre.abs() > half_extent { centre } else { 0.0 }
    })
}

/// The lowest and highest coordinates as written, or the first that overflows.
fn range(mesh: &TriMesh, origin: [f64; 3]) -> Result<[[f32; 3]; 2], EncodeError> {
    let [mut lowest, mut highest] = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    for (v, position) in mesh.positions().iter().enumerate() {
        let written = relative(*position, origin);
        for axis in 0..3 {
            if written[axis].is_infinite() {
                let (format, vertex, value) = (OutputFormat::Glb, VertexId(v as u32), position[axis]);
                return Err(EncodeError::SinglePrecision { format, vertex, axis, value });
            }
            if written[axis] < lowest[axis] {
                lowest[axis] = written[axis];
            }
            if written[axis] > highest[axis] {
                highest[axis] = written[axis];
            }
        }
    }
    Ok([lowest, highest])
}

/// Light proportional to the number, as glTF wants vertex colours, for each value of an sRGB channel (IEC 61966-2-1).
/// Sixteen bits keep all 256 values apart; eight would merge the dark ones.
fn linear_from_srgb() -> [u16; 256] {
    std::array::from_fn(|value| {
        let encoded = value as f64 / 255.0;
        let linear = if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) };
        (linear * f64::from(u16::MAX)).round() as u16
    })
}
