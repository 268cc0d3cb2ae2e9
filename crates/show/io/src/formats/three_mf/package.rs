//! The parts of the archive.

use crate::error::{FormatError, Location};
use crate::expansion::Allowance;
use quick_xml::Reader;
use quick_xml::events::Event;
use std::io::{self, BufRead, BufReader, Cursor, Read};
use zip::ZipArchive;

/// Where the model is unless the archive says otherwise.
const USUAL_PART: &str = "3D/3dmodel.model";
const RELATIONSHIPS: &str = "_rels/.rels";
/// How the type of the relationship to the model ends; years differ.
const MODEL_TYPE: &str = "/3dmodel";

pub(super) struct Package<'a> {
    archive: ZipArchive<Cursor<&'a [u8]>>,
}

impl<'a> Package<'a> {
    pub(super) fn open(bytes: &'a [u8]) -> Result<Self, FormatError> {
        let archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| {
            FormatError::new(
                Location::File,
                format!("the zip archive of the 3MF file cannot be opened: {error}"),
            )
        })?;
        Ok(Self { archive })
    }

    /// The name of the part with the model.
    pub(super) fn model_part(&mut self, allowance: &mut Allowance) -> Result<String, FormatError> {
        let target = if self.archive.index_for_name(RELATIONSHIPS).is_some() {
            self.read(RELATIONSHIPS, allowance, model_of)?
        } else {
            None
        };
        let part = target.unwrap_or_else(|| USUAL_PART.to_owned());
        if self.archive.index_for_name(&part).is_none() {
            return Err(in_part("a zip archive", format!("found no part {part}, expected a 3MF file")));
        }
        Ok(part)
    }

    /// Parses a part, at most as long as is allowed whatever the archive says of its length.
    pub(super) fn read<T>(
        &mut self,
        part: &str,
        allowance: &mut Allowance,
        parse: impl FnOnce(&mut dyn BufRead) -> Result<T, String>,
    ) -> Result<T, FormatError> {
        let file = self.archive.by_name(part).map_err(|error| in_part(part, error))?;
        let limited = Limited { inner: file, allowance };
        parse(&mut BufReader::with_capacity(1 << 16, limited)).map_err(|problem| in_part(part, problem))
    }
}

/// A reader that fails once more is read than is allowed.
struct Limited<'a, R> {
    inner: R,
    allowance: &'a mut Allowance,
}

impl<R: Read> Read for Limited<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.inner.read(buffer)?;
        self.allowance.take(read as u64).map_err(|most| {
            io::Error::other(format!(
                "the parts unpack to more than {most} bytes, expected a mesh, which shrinks less"
            ))
        })?;
        Ok(read)
    }
}

/// The target of the relationship to the model.
fn model_of(xml: &mut dyn BufRead) -> Result<Option<String>, String> {
    let mut reader = Reader::from_reader(xml);
    let mut buffer = Vec::new();
    loop {
        buffer.clear();
        let event = reader.read_event_into(&mut buffer).map_err(|error| error.to_string())?;
        let (Event::Start(tag) | Event::Empty(tag)) = event else {
            if matches!(event, Event::Eof) {
                return Ok(None);
            }
            continue;
        };
        let value = |name| super::model::text(&tag, name);
        if value("Type")?.is_some_and(|kind| kind.ends_with(MODEL_TYPE))
            && let Some(target) = value("Target")?
        {
            return Ok(Some(target.trim_start_matches('/').to_owned()));
        }
    }
}

/// What is wrong in a part of the archive.
pub(super) fn in_part(part: &str, problem: impl std::fmt::Display) -> FormatError {
    // What is quoted of the file may have ends of lines.
    let problem = format!("{part}: {problem}").replace(char::is_control, " ");
    FormatError::new(Location::File, problem)
}
