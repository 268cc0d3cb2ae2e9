//! The buffers of a glTF document: in the file, in the document, or in files beside it.

use super::document::{Buffer, BufferView, Document, entry, wrong};
use crate::error::FormatError;
use crate::source::{self, Source};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::cell::{Cell, OnceCell};
use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};

pub(super) struct Buffers<'a> {
    document: &'a Document,
    binary: Option<&'a [u8]>,
    folder: Option<&'a Path>,
    /// The buffers read so far; buffers that only hold images are never read.
    loaded: Vec<OnceCell<Source>>,
    /// Their total size in bytes.
    loaded_bytes: Cell<u64>,
}

impl<'a> Buffers<'a> {
    pub(super) fn new(document: &'a Document, binary: Option<&'a [u8]>, folder: Option<&'a Path>) -> Self {
        let loaded = document.buffers.iter().map(|_| OnceCell::new()).collect();
        Self { document, binary, folder, loaded, loaded_bytes: Cell::new(0) }
    }

    /// The number of bytes read in addition to those of the file itself.
    pub(super) fn loaded_bytes(&self) -> u64 {
        self.loaded_bytes.get()
    }

    /// The bytes of a buffer view, with the view.
    pub(super) fn view(&self, index: usize) -> Result<(&[u8], &'a BufferView), FormatError> {
        let view = entry(&self.document.buffer_views, "buffer view", index)?;
        let buffer = self.buffer(view.buffer)?;
        let bytes = part(buffer, view.byte_offset, view.byte_length).ok_or_else(|| {
            wrong(format!(
                "buffer view {index} has {} bytes from byte {} on, but buffer {} has {} bytes",
                view.byte_length,
                view.byte_offset,
                view.buffer,
                buffer.len()
            ))
        })?;
        Ok((bytes, view))
    }

    fn buffer(&self, index: usize) -> Result<&[u8], FormatError> {
        let buffer = entry(&self.document.buffers, "buffer", index)?;
        let bytes: &[u8] = match (&buffer.uri, self.binary, self.loaded[index].get()) {
            (None, Some(binary), _) if index == 0 => binary,
            (_, _, Some(bytes)) => bytes,
            (Some(uri), _, None) => {
                let bytes = self.load(uri).map_err(|problem| wrong(format!("buffer {index}: {problem}")))?;
                self.loaded_bytes.set(self.loaded_bytes.get().saturating_add(bytes.len() as u64));
                self.loaded[index].get_or_init(|| bytes)
            }
            (None, _, None) => return Err(wrong(without_data(index, buffer))),
        };
        part(bytes, 0, buffer.byte_length).ok_or_else(|| {
            wrong(format!("buffer {index} has {} bytes, expected {}", bytes.len(), buffer.byte_length))
        })
    }

    /// Whether all buffers in other files are there.
    pub(super) fn check_files(&self) -> Result<(), FormatError> {
        let outside = |buffer: &Buffer| buffer.uri.as_ref().is_some_and(|uri| !uri.starts_with("data:"));
        let buffers = self.document.buffers.iter().enumerate().filter(|(_, buffer)| outside(buffer));
        buffers.into_iter().try_for_each(|(index, _)| self.buffer(index).map(|_| ()))
    }

    /// The content of an address: data in the document, or a file beside it.
    pub(super) fn load(&self, uri: &str) -> Result<Source, String> {
        if let Some(data) = uri.strip_prefix("data:") {
            let Some((_, data)) = data.split_once(";base64,") else {
                return Err("a data URI without base64 is not supported".into());
            };
            return STANDARD.decode(data).map(Source::Owned).map_err(|error| format!("base64: {error}"));
        }
        let path = beside(uri, self.folder)?;
        // Opening a named pipe would block until a writer opens it.
        match fs::metadata(&path) {
            Ok(metadata) if metadata.is_file() => {
                source::open(&path).map_err(|error| format!("{uri:?}: {error}"))
            }
            Ok(_) => Err(format!("{uri:?} is not a regular file")),
            Err(error) if error.kind() == ErrorKind::NotFound => Err(format!(
                "there is no file {}, which holds a part of this one; put it there",
                path.display()
            )),
            Err(error) => Err(format!("{uri:?}: {error}")),
        }
    }
}

/// The path of an external buffer: below the folder of the file, never elsewhere.
pub(super) fn beside(uri: &str, folder: Option<&Path>) -> Result<PathBuf, String> {
    let name = percent_encoding::percent_decode_str(uri).decode_utf8().map_err(|error| error.to_string())?;
    let name = Path::new(&*name);
    let inside = name.components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir));
    if !inside || uri.contains(':') {
        return Err(format!("{uri:?} does not lie next to the file"));
    }
    match folder {
        Some(folder) => Ok(folder.join(name)),
        None => Err(format!("{uri:?} lies in another file, and the folder is not known")),
    }
}

fn without_data(index: usize, buffer: &Buffer) -> String {
    match buffer.extensions.keys().next() {
        Some(extension) => {
            format!("buffer {index} has its data in the extension {extension:?}, which is not supported")
        }
        None => format!("buffer {index} has no data"),
    }
}

fn part(bytes: &[u8], offset: u64, length: u64) -> Option<&[u8]> {
    let (offset, length) = (usize::try_from(offset).ok()?, usize::try_from(length).ok()?);
    bytes.get(offset..offset.checked_add(length)?)
}
