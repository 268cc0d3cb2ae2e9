//! GLB: a JSON document and its first buffer in one file.

use crate::error::{FormatError, Location};

const JSON: &[u8] = b"JSON";
const BINARY: &[u8] = b"BIN\0";

/// The document, where it begins in the file, and the binary chunk behind it if there is one.
pub(super) struct Container<'a> {
    pub(super) document: &'a [u8],
    pub(super) start: usize,
    pub(super) binary: Option<&'a [u8]>,
}

pub(super) fn open(bytes: &[u8]) -> Result<Container<'_>, FormatError> {
    let word = |at: usize| {
        let word = bytes.get(at..at + 4).and_then(|word| word.try_into().ok()).map(u32::from_le_bytes);
        word.ok_or_else(|| ends_early(bytes.len(), "a header"))
    };
    if !bytes.starts_with(b"glTF") {
        return Err(FormatError::new(Location::Byte(0), "expected \"glTF\""));
    }
    let version = word(4)?;
    if version != 2 {
        let problem = format!("GLB version {version}, expected 2");
        return Err(FormatError::new(Location::Byte(4), problem));
    }
    let length = word(8)? as usize;
    if length > bytes.len() {
        return Err(ends_early(bytes.len(), &format!("{length} bytes as its header says")));
    }
    let mut chunks = Vec::new();
    let mut at = 12;
    // The format defines two chunks; readers must ignore any others.
    while at < length && chunks.len() < 2 {
        let (start, size) = (at + 8, word(at)? as usize);
        let kind = bytes.get(at + 4..start).unwrap_or_default();
        let Some(chunk) = bytes.get(start..start.saturating_add(size)) else {
            let problem = format!("a chunk of {size} bytes, but the file ends after {}", bytes.len());
            return Err(FormatError::new(Location::Byte(at as u64), problem));
        };
        chunks.push((kind, start, chunk));
        at = start + size;
    }
    match chunks[..] {
        [(JSON, start, document), ref rest @ ..] => {
            let binary = rest.first().filter(|chunk| chunk.0 == BINARY).map(|chunk| chunk.2);
            Ok(Container { document, start, binary })
        }
        _ => Err(FormatError::new(Location::Byte(12), "expected a JSON chunk first")),
    }
}

fn ends_early(length: usize, expected: &str) -> FormatError {
    FormatError::new(Location::Byte(length as u64), format!("the file ends here, expected {expected}"))
}
