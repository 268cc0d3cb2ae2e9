//! glTF 2.0, as JSON and as GLB.
//!
//! All triangles of the default scene: each mesh once for every node that shows it, with the node's transform. Equal positions of a mesh
//! in a node become one vertex, unless its indexed vertices have nothing but positions or have other numbers. Skins, morph targets and
//! animations are ignored: the mesh is as stored.

mod accessor;
mod buffers;
mod container;
mod document;
mod look;
mod materials;
pub(crate) mod numbers;
mod scene;
pub(super) mod transform;

use super::Input;
use crate::appearance::Appearance;
use crate::error::{FormatError, Location};
use crate::raw::RawMesh;
use buffers::Buffers;
use document::{Document, wrong};
use look::Look;
use pompeiu_core::TriMesh;
use std::path::PathBuf;

/// Prefixes of extensions that do not affect triangles.
const HARMLESS_EXTENSIONS: [&str; 8] = [
    "KHR_materials_",
    "KHR_texture_",
    "KHR_lights_",
    "KHR_xmp",
    "EXT_texture_",
    "MSFT_texture_",
    "EXT_lights_",
    // It only allows more number types, all of which are read.
    "KHR_mesh_quantization",
];

/// Reads the JSON form, with buffers in the document or in files next to it.
pub(super) fn read_json(input: Input<'_>) -> Result<RawMesh, FormatError> {
    read_document(&json(input)?, None, input, None)
}

/// Reads the binary form.
pub(super) fn read_binary(input: Input<'_>) -> Result<RawMesh, FormatError> {
    let (document, binary) = binary(input)?;
    read_document(&document, binary, input, None)
}

/// How a mesh looks that was read from the JSON form.
pub(super) fn json_appearance(input: Input<'_>, mesh: &TriMesh) -> Result<Appearance, FormatError> {
    appearance(&json(input)?, None, input, mesh)
}

/// How a mesh looks that was read from the binary form.
pub(super) fn binary_appearance(input: Input<'_>, mesh: &TriMesh) -> Result<Appearance, FormatError> {
    let (document, binary) = binary(input)?;
    appearance(&document, binary, input, mesh)
}

fn json(input: Input<'_>) -> Result<Document, FormatError> {
    let bytes = input.bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(input.bytes);
    serde_json::from_slice(bytes)
        .map_err(|error| FormatError::new(Location::Line(error.line() as u64), message(&error)))
}

fn binary(input: Input<'_>) -> Result<(Document, Option<&[u8]>), FormatError> {
    let container = container::open(input.bytes)?;
    let document = serde_json::from_slice(container.document).map_err(|error| {
        let lines = container.document.split(|&byte| byte == b'\n');
        let before: usize = lines.take(error.line().saturating_sub(1)).map(|line| line.len() + 1).sum();
        let byte = container.start + before + error.column().saturating_sub(1);
        FormatError::new(Location::Byte(byte as u64), message(&error))
    })?;
    Ok((document, container.binary))
}

fn appearance(
    document: &Document,
    binary: Option<&[u8]>,
    input: Input<'_>,
    mesh: &TriMesh,
) -> Result<Appearance, FormatError> {
    let mut look = Look::of(document);
    let raw = read_document(document, binary, input, Some(&mut look))?;
    if raw.faces != mesh.faces() {
        return Ok(Appearance::default());
    }
    drop(raw);
    let descriptions = materials::read(document, &Buffers::new(document, binary, input.folder), input)?;
    Ok(look.finish(mesh, descriptions))
}

/// The buffers in other files.
pub(super) fn referenced_files(input: Input<'_>) -> Vec<PathBuf> {
    let bytes = input.bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(input.bytes);
    let json = container::open(bytes).map_or(bytes, |container| container.document);
    let Ok(document) = serde_json::from_slice::<Document>(json) else { return Vec::new() };
    let uris = document.buffers.iter().filter_map(|buffer| buffer.uri.as_deref());
    uris.filter_map(|uri| buffers::beside(uri, input.folder).ok()).collect()
}

fn read_document(
    document: &Document,
    binary: Option<&[u8]>,
    input: Input<'_>,
    look: Option<&mut Look>,
) -> Result<RawMesh, FormatError> {
    let version = &document.asset.version;
    if !version.starts_with("2.") {
        return Err(wrong(format!("glTF version {version:?}, expected 2.0")));
    }
    let harmless = |name: &&String| !HARMLESS_EXTENSIONS.iter().any(|start| name.starts_with(start));
    if let Some(name) = document.extensions_required.iter().find(harmless) {
        return Err(wrong(format!("the file requires the extension {name:?}, which is not supported")));
    }
    let buffers = Buffers::new(document, binary, input.folder);
    let raw = scene::read(document, &buffers, input.stored_bytes, look)?;
    if raw.faces.is_empty() {
        // A file beside that is missing is a better reason than the lack of faces.
        buffers.check_files()?;
    }
    Ok(raw)
}

/// The message of the JSON parser without the place.
fn message(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let end = text.rfind(" at line ").unwrap_or(text.len());
    format!("not a glTF document: {}", &text[..end])
}
