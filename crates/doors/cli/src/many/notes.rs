//! What a run notes in its journal, and takes from it.

use super::journal::{Fingerprint, Journal, fingerprint};
use super::meshes::MeshFiles;
use crate::numbers::counted;
use crate::printer::Printer;
use crate::wait::Wait;
use rayon::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::Path;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

/// The journal of one run over some meshes.
pub(crate) struct Notes {
    journal: Journal,
    /// None for files that cannot be read.
    files: Vec<Option<Fingerprint>>,
    taken: AtomicU64,
    /// The first result that could not be noted.
    problem: OnceLock<anyhow::Error>,
}

impl Notes {
    pub(crate) fn open(path: &Path, meshes: &MeshFiles, wait: &Wait) -> anyhow::Result<Self> {
        let journal = Journal::open(path)?;
        wait.show("looking for what was done before".to_owned());
        let files = meshes.paths().par_iter().map(|path| fingerprint(path).ok()).collect();
        Ok(Self { journal, files, taken: AtomicU64::new(0), problem: OnceLock::new() })
    }

    /// The key of the answer to a question about some of the meshes.
    fn key(&self, question: &impl Serialize, meshes: &[usize]) -> Option<String> {
        let files: Option<Vec<_>> = meshes.iter().map(|&mesh| self.files[mesh].as_ref()).collect();
        Journal::key(&(question, files?)).ok()
    }

    pub(crate) fn get<V: DeserializeOwned>(&self, question: &impl Serialize, meshes: &[usize]) -> Option<V> {
        let found = self.journal.get(&self.key(question, meshes)?)?;
        self.taken.fetch_add(1, Ordering::Relaxed);
        Some(found)
    }

    pub(crate) fn add(&self, question: &impl Serialize, meshes: &[usize], result: &impl Serialize) {
        let Some(key) = self.key(question, meshes) else { return };
        if let Err(error) = self.journal.add(key, result) {
            let _ = self.problem.set(error);
        }
    }

    /// Tells how much was there before, and of what could not be noted.
    pub(crate) fn tell(&self, printer: &Printer) {
        if self.journal.len() > 0 {
            let taken = self.taken.load(Ordering::Relaxed);
            let were = if taken == 1 { "was" } else { "were" };
            printer.note(format_args!("{} {were} taken from the journal", counted(taken as usize, "result")));
        }
        if let Some(error) = self.problem.get() {
            printer.warning(format_args!("{error:#}; this run cannot be resumed"));
        }
    }
}
