//! The bytes of a file: mapped, read or decompressed.
//!
//! This file holds the only unsafe code of the crate.

use crate::error::{FormatError, Location};
use crate::expansion::most_bytes;
use flate2::bufread::MultiGzDecoder;
use memmap2::Mmap;
use std::borrow::Cow;
use std::fs::File;
use std::io::{self, Read};
use std::ops::Deref;
use std::path::Path;

/// Bytes decompressed or read at a time.
const STEP: usize = 1 << 20;

const GZIP_MAGIC: [u8; 2] = [0x1F, 0x8B];

/// The content of a file, in memory or mapped.
pub(crate) enum Source {
    Mapped(Mmap),
    Owned(Vec<u8>),
}

impl Deref for Source {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        match self {
            Self::Mapped(map) => map,
            Self::Owned(bytes) => bytes,
        }
    }
}

/// Opens a file: maps a regular file, and reads a pipe to its end.
pub(crate) fn open(path: &Path) -> io::Result<Source> {
    let mut file = open_file(path)?;
    let metadata = file.metadata()?;
    if metadata.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    if is_device(&metadata) {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "a device, expected a file or a pipe"));
    }
    // Some kernel files report length 0 and still have content.
    if metadata.is_file() && metadata.len() > 0 {
        return Ok(Source::Mapped(map(&file)?));
    }
    let mut bytes = Vec::new();
    while read_step(&mut file, &mut bytes)? {}
    Ok(Source::Owned(bytes))
}

/// Opens a file; refuses a named pipe without a writer, for which the system would wait forever.
#[cfg(unix)]
fn open_file(path: &Path) -> io::Result<File> {
    use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};
    use std::os::unix::fs::{FileTypeExt, OpenOptionsExt};
    if !std::fs::metadata(path)?.file_type().is_fifo() {
        return File::open(path);
    }
    let flags = OFlags::NONBLOCK.bits().cast_signed();
    let file = File::options().read(true).custom_flags(flags).open(path)?;
    wait_for_writer(&file)?;
    fcntl_setfl(&file, fcntl_getfl(&file)? - OFlags::NONBLOCK)?;
    Ok(file)
}

#[cfg(not(unix))]
fn open_file(path: &Path) -> io::Result<File> {
    File::open(path)
}

/// Waits until a pipe is readable or its writers have closed it.
#[cfg(unix)]
fn wait_for_writer(pipe: &File) -> io::Result<()> {
    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    /// How long a program started at the same time may take to open its end.
    const PATIENCE: Timespec = Timespec { tv_sec: 1, tv_nsec: 0 };
    // A pipe that never had a writer is not ready; after the first writer, it is ready with data or at its end.
    match poll(&mut [PollFd::new(pipe, PollFlags::IN)], Some(&PATIENCE)) {
        Ok(0) => {
            let problem = "a pipe into which nobody writes, expected a writer within 1 s";
            Err(io::Error::new(io::ErrorKind::TimedOut, problem))
        }
        Ok(_) => Ok(()),
        Err(error) => Err(error.into()),
    }
}

/// Maps a nonempty file.
#[allow(
    unsafe_code,
    reason = "there is no safe way to map a file, and copying it costs as much as parsing it"
)]
fn map(file: &File) -> io::Result<Mmap> {
    // SAFETY: The map is read-only and private to this process, which writes no file it reads. What remains is a file
    // that another process changes during the read. If it writes, the bytes seen may be old or new; readers check
    // every value they use and take none as proof of another, so they return an error or a mesh that was never whole.
    // If it shortens the file, the system ends this process when a page behind the new end is touched. That is the
    // accepted risk, which every program that maps its input shares.
    unsafe { Mmap::map(file) }
}

#[cfg(unix)]
fn is_device(metadata: &std::fs::Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    metadata.file_type().is_char_device() || metadata.file_type().is_block_device()
}

#[cfg(not(unix))]
fn is_device(_: &std::fs::Metadata) -> bool {
    false
}

/// Appends up to [`STEP`] bytes; returns false at the end. A failed allocation is an error.
fn read_step(from: &mut impl Read, bytes: &mut Vec<u8>) -> io::Result<bool> {
    bytes.try_reserve(STEP).map_err(|_| io::ErrorKind::OutOfMemory)?;
    Ok(from.take(STEP as u64).read_to_end(bytes)? > 0)
}

/// The bytes themselves or, if they are gzip data, their decompressed content; and whether they are.
pub(crate) fn decompressed(bytes: &[u8]) -> Result<(Cow<'_, [u8]>, bool), FormatError> {
    if !bytes.starts_with(&GZIP_MAGIC) {
        return Ok((Cow::Borrowed(bytes), false));
    }
    let most = most_bytes(bytes.len() as u64);
    let mut decoder = MultiGzDecoder::new(bytes);
    let mut content = Vec::new();
    while read_step(&mut decoder, &mut content).map_err(|error| {
        let reason = match error.kind() {
            io::ErrorKind::UnexpectedEof => "they end early".to_owned(),
            _ => error.to_string(),
        };
        let problem =
            format!("the gzip data cannot be decompressed beyond {} bytes: {reason}", content.len());
        FormatError::new(Location::File, problem)
    })? {
        if content.len() as u64 > most {
            return Err(FormatError::new(
                Location::File,
                format!(
                    "{} bytes of gzip data grow beyond {most} bytes, expected a mesh, which shrinks less",
                    bytes.len()
                ),
            ));
        }
    }
    if content.starts_with(&GZIP_MAGIC) {
        return Err(FormatError::new(Location::File, "found gzip data in gzip data, expected a mesh"));
    }
    Ok((Cow::Owned(content), true))
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::Compression;
    use flate2::write::GzEncoder;
    use std::io::Write;

    fn gzip(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    }

    #[test]
    fn members_are_joined_and_damage_is_named() {
        let mut joined = gzip(b"one ");
        joined.extend(gzip(b"two"));
        assert_eq!(decompressed(&joined).unwrap(), (Cow::Borrowed(&b"one two"[..]), true));
        assert_eq!(decompressed(b"plain").unwrap(), (Cow::Borrowed(&b"plain"[..]), false));

        let short = decompressed(&joined[..joined.len() - 9]).unwrap_err().to_string();
        assert!(short.contains("end early"), "{short}");
        joined[12] ^= 0x55;
        assert!(decompressed(&joined).is_err());
        let nested = decompressed(&gzip(&gzip(b"x"))).unwrap_err().to_string();
        assert!(nested.contains("gzip data in gzip data"), "{nested}");
    }

    #[test]
    fn a_bomb_is_refused() {
        let bomb = gzip(&vec![b' '; 2 * most_bytes(0) as usize]);
        let error = decompressed(&bomb).unwrap_err().to_string();
        assert!(error.contains("grow beyond"), "{error}");
    }
}
