//! glTF 2.0 in one binary file.

use super::{Attributes, EncodeError, OutputFormat};
use pompeiu_core::{TriMesh, VertexId};
use serde_json::json;
use std::borrow::Cow;
use std::collections::HashMap;
use std::io::Write;

const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;
const TRIANGLES: u32 = 4;

/// The written vertices: for each the vertex of the mesh, and its texture coordinates.
struct Written<'m> {
    vertices: Vec<u32>,
    faces: Cow<'m, [[u32; 3]]>,
    places: Option<Vec<[f32; 2]>>,
    image: &'m [u8],
}

impl<'m> Written<'m> {
    /// A written vertex for each pair of a vertex and texture coordinates, in the order of first use; without texture, the vertices
    /// of the mesh.
    fn of(mesh: &'m TriMesh, attributes: &'m Attributes) -> Self {
        let Some(texture) = attributes.texture() else {
            let vertices = (0..mesh.positions().len() as u32).collect();
            return Self { vertices, faces: Cow::Borrowed(mesh.faces()), places: None, image: &[] };
        };
        let mut known = HashMap::with_capacity(texture.coordinates.len());
        let (mut vertices, mut places) = (Vec::new(), Vec::new());
        let mut number = |pair: (u32, u32)| {
            *known.entry(pair).or_insert_with(|| {
                vertices.push(pair.0);
                // glTF counts from the upper left corner of the image.
                let [u, v] = texture.coordinates[pair.1 as usize];
                places.push([u as f32, (1.0 - v) as f32]);
                (vertices.len() - 1) as u32
            })
        };
        let pairs = mesh.faces().iter().zip(&texture.corners);
        let faces = pairs.map(|(face, corners)| [0, 1, 2].map(|i| number((face[i], corners[i])))).collect();
        Self { vertices, faces, places: Some(places), image: texture.image.as_deref().unwrap_or(&[]) }
    }
}

pub(super) fn write(mut out: impl Write, mesh: &TriMesh, attributes: &Attributes) -> Result<(), EncodeError> {
    let written = Written::of(mesh, attributes);
    let origin = origin(mesh);
    let [lowest, highest] = range(mesh, &written.vertices, origin)?;
    let (n, m) = (written.vertices.len() as u64, written.faces.len() as u64);
    let colors = attributes.vertex_colors();

    let mut views = Vec::new();
    let mut length = 0;
    let mut view = |bytes: u64, target: Option<u32>| {
        let mut view = json!({ "buffer": 0, "byteOffset": length, "byteLength": bytes });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        views.push(view);
        length += bytes;
        views.len() - 1
    };
    let mut accessors = vec![
        json!({ "bufferView": view(12 * n, Some(ARRAY_BUFFER)), "componentType": FLOAT, "count": n, "type": "VEC3",
            "min": lowest.map(f64::from), "max": highest.map(f64::from) }),
        json!({ "bufferView": view(12 * m, Some(ELEMENT_ARRAY_BUFFER)), "componentType": UNSIGNED_INT, "count": 3 * m,
            "type": "SCALAR" }),
    ];
    let mut of_vertices = json!({ "POSITION": 0 });
    if colors.is_some() {
        of_vertices["COLOR_0"] = json!(accessors.len());
        accessors
            .push(json!({ "bufferView": view(8 * n, Some(ARRAY_BUFFER)), "componentType": UNSIGNED_SHORT,
            "normalized": true, "count": n, "type": "VEC4" }));
    }
    if written.places.is_some() {
        of_vertices["TEXCOORD_0"] = json!(accessors.len());
        accessors
            .push(json!({ "bufferView": view(8 * n, Some(ARRAY_BUFFER)), "componentType": FLOAT, "count": n,
            "type": "VEC2" }));
    }
    let image = (!written.image.is_empty()).then(|| view(written.image.len() as u64, None));
    let length = length.next_multiple_of(4);
    let mut document = json!({
        "asset": { "version": "2.0", "generator": "pompeiu" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{
            "attributes": of_vertices, "indices": 1, "material": 0, "mode": TRIANGLES
        }] }],
        // The default material is polished metal, which looks dark without an environment to reflect.
        "materials": [{
            "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 1 }, "doubleSided": true
        }],
        "buffers": [{ "byteLength": length }],
        "bufferViews": views,
        "accessors": accessors
    });
    if origin != [0.0; 3] {
        document["nodes"][0]["translation"] = json!(origin);
    }
    if let Some(view) = image {
        document["images"] = json!([{ "bufferView": view, "mimeType": "image/png" }]);
        document["textures"] = json!([{ "source": 0 }]);
        document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": 0 });
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
    for &v in &written.vertices {
        for coordinate in relative(mesh.positions()[v as usize], origin) {
            out.write_all(&coordinate.to_le_bytes())?;
        }
    }
    for vertex in written.faces.as_flattened() {
        out.write_all(&vertex.to_le_bytes())?;
    }
    if let Some(colors) = colors {
        let linear = linear_from_srgb();
        for &v in &written.vertices {
            let [red, green, blue] = colors[v as usize];
            for channel in [linear[red as usize], linear[green as usize], linear[blue as usize], u16::MAX] {
                out.write_all(&channel.to_le_bytes())?;
            }
        }
    }
    for coordinate in written.places.iter().flatten().flatten() {
        out.write_all(&coordinate.to_le_bytes())?;
    }
    out.write_all(written.image)?;
    let padding = written.image.len().next_multiple_of(4) - written.image.len();
    Ok(out.write_all(&[0; 3][..padding])?)
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

/// The linear value of each sRGB channel value (IEC 61966-2-1), as glTF expects for vertex colours. Sixteen bits keep all 256
/// values distinct; eight would merge the dark ones.
fn linear_from_srgb() -> [u16; 256] {
    std::array::from_fn(|value| {
        let encoded = value as f64 / 255.0;
        let linear = if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) };
        (linear * f64::from(u16::MAX)).round() as u16
    })
}
