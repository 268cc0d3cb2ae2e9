//! The files of a ranking or a matrix, with the journal that its results go to.

use super::journal::{Fingerprint, fingerprint};
use super::meshes::MeshFiles;
use super::notes::Notes;
use crate::args::Many;
use crate::door::Session;
use crate::interrupt;
use crate::wait::Wait;
use anyhow::Context;
use pompeiu::core::TriMesh;
use pompeiu::matching::{Meshes, TaskProgress};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub(crate) struct Collection {
    files: MeshFiles,
    notes: Option<Notes>,
    /// The file that all answers depend on.
    template: Option<Fingerprint>,
}

impl Collection {
    /// Files, and the journal if one is wanted.
    pub(crate) fn open(
        paths: Vec<PathBuf>,
        many: &Many,
        template: Option<&Path>,
        session: &Session<'_>,
    ) -> anyhow::Result<Self> {
        let files = MeshFiles::new(paths, many.cache(session.memory_limit()));
        let notes =
            many.resume.as_deref().map(|path| Notes::open(path, &files, &session.wait)).transpose()?;
        let template = template
            .filter(|_| notes.is_some())
            .map(|path| fingerprint(path).with_context(|| path.display().to_string()));
        Ok(Self { files, notes, template: template.transpose()? })
    }

    /// Says what came of the journal, and notes which files were read.
    pub(crate) fn close(self, session: &mut Session<'_>) {
        if let Some(notes) = &self.notes {
            notes.tell(session.printer);
        }
        for (path, counts) in self.files.into_read() {
            session.note_counts(&path, counts);
        }
    }
}

/// Shows the progress, and ends the computation at Ctrl-C.
pub(crate) fn show(wait: &Wait, progress: &TaskProgress, message: String) -> ControlFlow<()> {
    if progress.done == 0 {
        wait.restart();
    }
    wait.count(message, [progress.done, progress.tasks].map(|n| n as u64));
    interrupt::flow()
}

impl Meshes for Collection {
    type Mesh = Arc<TriMesh>;

    fn count(&self) -> usize {
        self.files.paths().len()
    }

    fn name(&self, index: usize) -> String {
        self.files.paths()[index].display().to_string()
    }

    fn mesh(&self, index: usize) -> Result<Arc<TriMesh>, String> {
        self.files.mesh(index)
    }

    fn failure(&self, index: usize) -> Option<String> {
        self.files.failure(index)
    }

    fn bytes(&self) -> usize {
        self.files.bytes()
    }

    fn keep_only(&self, wanted: &dyn Fn(usize) -> bool) {
        self.files.keep_only(wanted);
    }

    fn known<R: DeserializeOwned>(&self, question: &impl Serialize, meshes: &[usize]) -> Option<R> {
        self.notes.as_ref()?.get(&(&self.template, question), meshes)
    }

    fn found<R: Serialize>(&self, question: &impl Serialize, meshes: &[usize], result: &R) {
        if let Some(notes) = &self.notes {
            notes.add(&(&self.template, question), meshes, result);
        }
    }
}
