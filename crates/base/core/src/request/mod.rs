//! What can be asked of a system, and what it answers.
//!
//! Each system has one struct for each question, a [`Request`]: plain data, every field with a default. Everything that offers the
//! question is made from that struct: the command's options and help, the keys of `--config` files, Python's signature and
//! docstring, the JSON schema and the table of options in the guide. The doc comment of a field is its description in all of them.
//! A [`Report`] says what was found; an [`Answer`] is both, with the inputs and times.

mod answer;
mod count;
mod info;
mod length;
pub mod values;

pub use answer::{Answer, Conclusion, Input, Report, Timing};
pub use count::{Count, CountError};
pub use info::{FileFacts, InfoReport, InfoRequest, IntersectingFacePair, IntersectingFaces};
pub use length::{Band, Length, LengthError};
use std::fmt::Write;

/// Bytes, such as a SHA-256 sum, as hexadecimal digits.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// A limit of a computation that a person may set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// Number of threads.
    Threads,
    /// Time.
    Time,
    /// Memory.
    Memory,
}

impl Limit {
    /// The name of the option: `threads`, `time_limit` or `memory_limit`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Threads => "threads",
            Self::Time => "time_limit",
            Self::Memory => "memory_limit",
        }
    }
}

/// What can be asked of a system.
///
/// [`Default`] is the only home of default values: help, signatures and schemas ask it.
pub trait Request: Clone + Default + Send + 'static {
    /// The name of the command and of the function in Python.
    const NAME: &'static str;
    /// The limits that are obeyed, by everything that is done. Others are not offered.
    const LIMITS: &'static [Limit];
    /// What is found.
    type Report: Report;
}
