//! Entries of the faces of one task.

use super::entry::{Entry, Moments};
use super::packed::Entries;
use std::ops::Range;

/// The entries of the faces of one task, face by face.
#[derive(Clone, Debug)]
pub(super) struct Portion {
    pub(super) entries: Entries,
    /// Where those of each face start, and one end more.
    pub(super) starts: Vec<u32>,
    /// Of all of them.
    pub(super) moments: Moments,
}

impl Portion {
    /// Where the entries of one of the faces are.
    pub(super) fn places(&self, face: usize) -> Range<usize> {
        self.starts[face] as usize..self.starts[face + 1] as usize
    }

    /// The entries of one of the faces.
    pub(super) fn of_face(&self, face: usize) -> impl Iterator<Item = Entry> + '_ {
        self.entries.range(self.places(face))
    }
}
