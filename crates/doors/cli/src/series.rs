//! Every step as a file, and a list of them with their times, as ParaView reads it.

use crate::files;
use crate::numbers::counted;
use crate::printer::Printer;
use anyhow::{Context, bail};
use pompeiu::core::vtk;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// A series on its way.
pub(crate) struct Series {
    list: PathBuf,
    folder: PathBuf,
    suffix: &'static str,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    /// Numbers of the steps written, with their times.
    written: Vec<(usize, f64)>,
    error: Option<anyhow::Error>,
}

impl Series {
    /// A series with this list; its steps go into a folder of the same name beside it, which must not exist.
    pub(crate) fn new(list: &Path) -> anyhow::Result<Self> {
        Self::of(list, "vtp")
    }

    /// The same with another suffix of the steps' files.
    pub(crate) fn of(list: &Path, suffix: &'static str) -> anyhow::Result<Self> {
        if !list.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("pvd")) {
            bail!("{}: a series is a list of files; give it the suffix .pvd", list.display());
        }
        let folder = list.with_extension("");
        if folder.exists() {
            bail!(
                "{}: exists; the steps go to a folder of this name, give the list another one",
                folder.display()
            );
        }
        Ok(Self { list: list.to_owned(), folder, suffix, state: Mutex::default() })
    }

    /// Writes a step by a function that writes a file. The computation should end where that fails; [`Series::finish`] says why.
    pub(crate) fn add(
        &self,
        step: usize,
        time: f64,
        write: impl FnOnce(&Path) -> anyhow::Result<()>,
    ) -> ControlFlow<()> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        // The folder is made with the first step: what cannot start leaves none behind.
        let made = if state.written.is_empty() {
            std::fs::create_dir(&self.folder).with_context(|| self.folder.display().to_string())
        } else {
            Ok(())
        };
        match made.and_then(|()| write(&self.folder.join(name(step, self.suffix)))) {
            Ok(()) => {
                state.written.push((step, time));
                ControlFlow::Continue(())
            }
            Err(error) => {
                state.error = Some(error);
                ControlFlow::Break(())
            }
        }
    }

    /// Writes the list of what was written, then says what went wrong if something did.
    pub(crate) fn finish(self, printer: &Printer) -> anyhow::Result<()> {
        let Self { list: place, folder: steps, suffix, state } = self;
        let State { written, error } = state.into_inner().unwrap_or_else(PoisonError::into_inner);
        if written.is_empty() {
            return error.map_or(Ok(()), Err);
        }
        let folder = steps.file_name().unwrap_or_default().to_string_lossy();
        let list = vtk::series(
            written.iter().map(|&(step, time)| (time, format!("{folder}/{}", name(step, suffix)))),
        );
        let listed = files::write_whole(&place, list.as_bytes(), printer);
        // What failed first is told first.
        error.map_or(Ok(()), Err)?;
        listed?;
        printer.note(format_args!("{}: {}", steps.display(), counted(written.len(), "step")));
        Ok(())
    }
}

fn name(step: usize, suffix: &str) -> String {
    format!("step-{step:05}.{suffix}")
}
