//! glTF 2.0 in one binary file.

mod materials;
mod vertices;
mod views;

use super::{Attributes, EncodeError, OutputFormat};
use crate::formats::gltf::numbers::VERTEX_NUMBERS;
use materials::Looks;
use pompeiu_core::{TriMesh, VertexId};
use serde_json::{Value, json};
use std::io::Write;
use vertices::Written;
use views::Views;

const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;
const TRIANGLES: u32 = 4;

pub(super) fn write(mut out: impl Write, mesh: &TriMesh, attributes: &Attributes) -> Result<(), EncodeError> {
    let written = Written::of(mesh, attributes);
    let looks = Looks::of(attributes, mesh.faces().len());
    let origin = origin(mesh);
    let [lowest, highest] = range(mesh, &written.vertices, origin)?;
    let n = written.vertices.len() as u64;

    let mut views = Views::default();
    let mut array = |bytes: u64, kind: u32, shape: &str| {
        let view = views.add(bytes * n, Some(ARRAY_BUFFER));
        json!({ "bufferView": view, "componentType": kind, "count": n, "type": shape })
    };
    let mut position = array(12, FLOAT, "VEC3");
    position["min"] = json!(lowest.map(f64::from));
    position["max"] = json!(highest.map(f64::from));
    let mut accessors = vec![position, array(12, FLOAT, "VEC3")];
    let mut of_vertices = json!({ "POSITION": 0, "NORMAL": 1 });
    if written.colors.is_some() {
        of_vertices["COLOR_0"] = json!(accessors.len());
        let mut colors = array(8, UNSIGNED_SHORT, "VEC4");
        colors["normalized"] = json!(true);
        accessors.push(colors);
    }
    for set in 0..written.texture.len() {
        of_vertices[format!("TEXCOORD_{set}")] = json!(accessors.len());
        accessors.push(array(8, FLOAT, "VEC2"));
    }
    let has_numbers = has_equal_positions(mesh, origin);
    if has_numbers {
        of_vertices[VERTEX_NUMBERS] = json!(accessors.len());
        accessors.push(array(4, UNSIGNED_SHORT, "VEC2"));
    }
    let mut primitives = Vec::new();
    for (material, faces) in &looks.primitives {
        let count = 3 * faces.len() as u64;
        let view = views.add(4 * count, Some(ELEMENT_ARRAY_BUFFER));
        let mut primitive =
            json!({ "attributes": of_vertices, "indices": accessors.len(), "mode": TRIANGLES });
        if let Some(material) = material {
            primitive["material"] = json!(material);
        }
        accessors.push(
            json!({ "bufferView": view, "componentType": UNSIGNED_INT, "count": count, "type": "SCALAR" }),
        );
        primitives.push(primitive);
    }
    let mut document = json!({
        "asset": { "version": "2.0", "generator": "pompeiu" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": primitives }],
        "accessors": accessors
    });
    if origin != [0.0; 3] {
        document["nodes"][0]["translation"] = json!(origin);
    }
    looks.describe(&mut document, &mut views);
    document["bufferViews"] = Value::Array(views.described);
    document["buffers"] = json!([{ "byteLength": views.length }]);

    write_header(&mut out, &document, views.length)?;
    write_vertices(&mut out, mesh, &written, origin)?;
    if has_numbers {
        // The lower half first, as the bytes of the whole number.
        written.vertices.iter().try_for_each(|v| out.write_all(&v.to_le_bytes()))?;
    }
    for (_, faces) in &looks.primitives {
        for vertex in faces.iter().flat_map(|f| written.faces[*f as usize]) {
            out.write_all(&vertex.to_le_bytes())?;
        }
    }
    for image in looks.images() {
        out.write_all(image)?;
        out.write_all(&[0; 3][..image.len().next_multiple_of(4) - image.len()])?;
    }
    Ok(())
}

fn write_header(out: &mut impl Write, document: &Value, length: u64) -> Result<(), EncodeError> {
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
    Ok(out.write_all(b"BIN\0")?)
}

fn write_vertices(
    out: &mut impl Write,
    mesh: &TriMesh,
    written: &Written,
    origin: [f64; 3],
) -> Result<(), EncodeError> {
    let mut reals = |values: &[f32]| values.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()));
    for &v in &written.vertices {
        reals(&relative(mesh.positions()[v as usize], origin))?;
    }
    for normal in &written.normals {
        reals(normal)?;
    }
    for channel in written.colors.iter().flatten().flatten() {
        out.write_all(&channel.to_le_bytes())?;
    }
    let places = written.texture.iter().flatten().flatten();
    Ok(places.into_iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))?)
}

/// Whether vertices have equal positions in the file, so that readers could not tell them from one vertex that is written twice.
fn has_equal_positions(mesh: &TriMesh, origin: [f64; 3]) -> bool {
    let as_read = |p: &[f64; 3]| {
        let written = relative(*p, origin);
        [0, 1, 2].map(|axis| (f64::from(written[axis]) + origin[axis] + 0.0).to_bits())
    };
    let mut places: Vec<[u64; 3]> = mesh.positions().iter().map(as_read).collect();
    places.sort_unstable();
    places.windows(2).any(|pair| pair[0] == pair[1])
}

fn relative(position: [f64; 3], origin: [f64; 3]) -> [f32; 3] {
    [0, 1, 2].map(|axis| (position[axis] - origin[axis]) as f32)
}

/// The origin of the written coordinates: along each axis the centre if that makes them smaller, or zero if single precision holds
/// all coordinates exactly. It is a single-precision number itself, because many programs store translations as such.
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
fn range(mesh: &TriMesh, vertices: &[u32], origin: [f64; 3]) -> Result<[[f32; 3]; 2], EncodeError> {
    let [mut lowest, mut highest] = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    for &v in vertices {
        let position = mesh.positions()[v as usize];
        let written = relative(position, origin);
        for axis in 0..3 {
            if written[axis].is_infinite() {
                let (format, vertex, value) = (OutputFormat::Glb, VertexId(v), position[axis]);
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
