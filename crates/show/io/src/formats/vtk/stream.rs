//! The bytes of an array in an XML file: raw or base64, uncompressed or in compressed blocks.

use super::numbers::{ByteOrder, NumberType};
use crate::expansion::Allowance;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use std::io::Read;

/// How a file packs its arrays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Packing<'a> {
    /// The type of the lengths before the data.
    pub(super) header: NumberType,
    pub(super) order: ByteOrder,
    /// The name of the compressor, if there is one.
    pub(super) compressor: Option<&'a str>,
}

/// Bytes that are read part by part.
pub(super) enum Stream<'a> {
    Raw(&'a [u8]),
    Base64(Base64<'a>),
}

impl<'a> Stream<'a> {
    pub(super) fn base64(text: &'a [u8]) -> Self {
        Self::Base64(Base64 { text, pending: Vec::new() })
    }

    fn take(&mut self, length: u64) -> Result<Vec<u8>, String> {
        let most = match self {
            Self::Raw(bytes) => bytes.len(),
            Self::Base64(source) => source.pending.len() + source.text.len() / 4 * 3,
        };
        let length = usize::try_from(length).ok().filter(|&length| length <= most);
        let length = length.ok_or_else(ends_early)?;
        match self {
            Self::Raw(bytes) => {
                let (part, rest) = bytes.split_at(length);
                *bytes = rest;
                Ok(part.to_vec())
            }
            Self::Base64(source) => source.take(length),
        }
    }

    /// The data of one array.
    ///
    /// # Errors
    /// The data is damaged, or exceeds the rest of the allowance, from which its size is subtracted.
    pub(super) fn unpack(
        mut self,
        packing: &Packing<'_>,
        allowance: &mut Allowance,
    ) -> Result<Vec<u8>, String> {
        let mut length = || self.words(1, packing).map(|words| words[0]);
        match packing.compressor {
            None => {
                let length = length()?;
                let bytes = self.take(length)?;
                allowance.take(length).map_err(too_large)?;
                Ok(bytes)
            }
            Some("vtkZLibDataCompressor") => {
                let (blocks, full, last) = (length()?, length()?, length()?);
                let compressed = self.words(blocks, packing)?;
                let mut bytes = Vec::new();
                for (i, &size) in compressed.iter().enumerate() {
                    let is_partial = i + 1 == compressed.len() && last != 0;
                    let block = self.take(size)?;
                    let length = if is_partial { last } else { full };
                    allowance.take(length).map_err(too_large)?;
                    inflate(&block, length, &mut bytes)?;
                }
                Ok(bytes)
            }
            Some(other) => Err(format!("compressed by {other:?}, which is not supported")),
        }
    }

    fn words(&mut self, count: u64, packing: &Packing<'_>) -> Result<Vec<u64>, String> {
        let size = packing.header.size();
        let bytes = self.take(count.saturating_mul(size as u64))?;
        let read = |word: &[u8]| packing.header.count(word, packing.order);
        Ok(bytes.chunks_exact(size).filter_map(read).collect())
    }
}

/// Decodes exactly as much as asked for: the next array follows without a separator.
pub(super) struct Base64<'a> {
    text: &'a [u8],
    /// Decoded bytes that were not read yet.
    pending: Vec<u8>,
}

impl Base64<'_> {
    fn take(&mut self, length: usize) -> Result<Vec<u8>, String> {
        const CHARACTERS: usize = 1 << 12;
        let mut bytes = std::mem::take(&mut self.pending);
        let mut part = Vec::with_capacity(CHARACTERS);
        while bytes.len() < length {
            let most = CHARACTERS.min((length - bytes.len()).div_ceil(3) * 4);
            part.clear();
            // Padding ends a part, wherever it stands: some writers encode the lengths separately.
            while part.len() < most && !(part.len().is_multiple_of(4) && part.last() == Some(&b'=')) {
                let Some((&character, rest)) = self.text.split_first() else { break };
                self.text = rest;
                if !character.is_ascii_whitespace() {
                    part.push(character);
                }
            }
            if part.is_empty() {
                return Err(ends_early());
            }
            STANDARD.decode_vec(&part, &mut bytes).map_err(|error| format!("base64: {error}"))?;
        }
        self.pending = bytes.split_off(length);
        Ok(bytes)
    }
}

fn inflate(block: &[u8], length: u64, bytes: &mut Vec<u8>) -> Result<(), String> {
    let before = bytes.len();
    // One byte more than expected detects excess data.
    let read = ZlibDecoder::new(block).take(length.saturating_add(1)).read_to_end(bytes);
    read.map_err(|error| format!("a compressed block is damaged: {error}"))?;
    match (bytes.len() - before) as u64 {
        found if found == length => Ok(()),
        found if found > length => Err(format!("a compressed block holds more than its {length} bytes")),
        found => Err(format!("a compressed block holds {found} bytes, expected {length}")),
    }
}

fn too_large(most: u64) -> String {
    format!(
        "the arrays of all pieces together unpack to more than {most} bytes, the most that a file of this size may hold"
    )
}

fn ends_early() -> String {
    "the data end early".into()
}
