//! Materials, kept as the document describes them, with the images of their textures.

use super::super::Input;
use super::buffers::Buffers;
use super::document::{Document, wrong};
use crate::appearance::Descriptions;
use crate::error::FormatError;
use crate::expansion::most_bytes;
use serde_json::{Map, Value};

/// The materials, textures, samplers and images of a document.
///
/// # Errors
/// If images take more bytes than a file of this size may hold.
pub(super) fn read(
    document: &Document,
    buffers: &Buffers<'_>,
    input: Input<'_>,
) -> Result<Descriptions, FormatError> {
    let mut found =
        Descriptions { required: document.extensions_required.clone(), ..Descriptions::default() };
    let mut bytes = 0;
    let mut described = Vec::new();
    for (index, image) in document.images.iter().enumerate() {
        let (mut entries, data) =
            described_image(image, buffers).map_err(|problem| wrong(format!("image {index}: {problem}")))?;
        if let Some(data) = &data {
            bytes += data.len() as u64;
            let most = most_bytes(input.stored_bytes.saturating_add(buffers.loaded_bytes()));
            if bytes > most {
                return Err(wrong(format!(
                    "the images take more than {most} bytes, the most that a file of this size may hold"
                )));
            }
            if let Some(kind) = kind(data) {
                entries.insert("mimeType".into(), kind.into());
            }
        }
        found.images.push(data);
        described.push(Value::Object(entries));
    }
    for (name, list) in [
        ("materials", &document.materials),
        ("textures", &document.textures),
        ("samplers", &document.samplers),
        ("images", &described),
    ] {
        if !list.is_empty() {
            found.lists.insert(name.into(), Value::Array(list.clone()));
        }
    }
    Ok(found)
}

/// The entries of an image, and its data.
type Described = (Map<String, Value>, Option<Vec<u8>>);

/// The entries of an image without the place of its data, and the data; with its address where there is no data of a known kind.
fn described_image(image: &Value, buffers: &Buffers<'_>) -> Result<Described, String> {
    let mut entries = image.as_object().cloned().unwrap_or_default();
    let view = entries.remove("bufferView");
    let is_described = entries.contains_key("mimeType");
    let is_image = |data: &[u8]| is_described || kind(data).is_some();
    if let Some(view) = view {
        let view = view.as_u64().and_then(|view| usize::try_from(view).ok());
        let view = view.ok_or("the buffer view is no index")?;
        let data = buffers.view(view).map_err(|error| error.problem)?.0;
        if is_image(data) {
            return Ok((entries, Some(data.to_vec())));
        }
        return Err("the data is of no known kind, and no media type is given".into());
    }
    let Some(address) = entries.get("uri").and_then(Value::as_str) else {
        return Err("there is neither data nor an address".into());
    };
    let data = buffers.load(address).ok().filter(|data| is_image(data)).map(|data| data.to_vec());
    if data.is_some() {
        entries.remove("uri");
    }
    Ok((entries, data))
}

/// The media type of an image, by its first bytes.
fn kind(data: &[u8]) -> Option<&'static str> {
    match data {
        [0x89, b'P', b'N', b'G', ..] => Some("image/png"),
        [0xFF, 0xD8, 0xFF, ..] => Some("image/jpeg"),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => Some("image/webp"),
        [0xAB, b'K', b'T', b'X', ..] => Some("image/ktx2"),
        _ => None,
    }
}
