//! Every step as a file, and a list of them with their times, as ParaView reads it.

use crate::files;
use crate::numbers::grouped;
use crate::printer::Printer;
use anyhow::{Context, bail};
use pompeiu::core::TriMesh;
use pompeiu::flow::{Flow, FlowStep};
use pompeiu::io::{Attributes, write_with};
use std::fmt::Write;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// A series on its way.
pub(super) struct Series {
    list: PathBuf,
    folder: PathBuf,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    written: usize,
    error: Option<anyhow::Error>,
}

impl Series {
    /// A series with this list; its steps go into a folder of the same name beside it, which must not exist.
    pub(super) fn new(list: &Path) -> anyhow::Result<Self> {
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
        Ok(Self { list: list.to_owned(), folder, state: Mutex::default() })
    }

    /// Writes a step. The flow ends where that fails; [`Series::finish`] says why.
    pub(super) fn add(&self, step: &FlowStep<'_>) -> ControlFlow<()> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        match self.write(step) {
            Ok(()) => {
                state.written += 1;
                ControlFlow::Continue(())
            }
            Err(error) => {
                state.error = Some(error);
                ControlFlow::Break(())
            }
        }
    }

    /// Makes the folder with the first step: a flow that cannot start leaves none behind.
    fn write(&self, step: &FlowStep<'_>) -> anyhow::Result<()> {
        if step.step == 0 {
            std::fs::create_dir(&self.folder).with_context(|| self.folder.display().to_string())?;
        }
        let path = self.folder.join(name(step.step));
        let mesh = TriMesh::new(step.positions.to_vec(), step.faces.to_vec())?;
        Ok(write_with(&path, &mesh, &Attributes::for_mesh(&mesh))?)
    }

    /// Writes the list.
    pub(super) fn finish(self, flow: &Flow, printer: &Printer) -> anyhow::Result<()> {
        let State { written, error } = self.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        if let Some(error) = error {
            return Err(error);
        }
        let folder = self.folder.file_name().unwrap_or_default().to_string_lossy();
        let escaped = folder.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
        let mut list = String::from(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n",
        );
        for (step, record) in flow.history.iter().enumerate().take(written) {
            // Steps without a length in time are counted.
            let time = record.time.unwrap_or(step as f64);
            let _ = writeln!(list, "    <DataSet timestep=\"{time}\" file=\"{escaped}/{}\"/>", name(step));
        }
        list.push_str("  </Collection>\n</VTKFile>\n");
        files::write_whole(&self.list, list.as_bytes(), printer)?;
        printer.note(format_args!("{}: {} steps", self.folder.display(), grouped(written as u64)));
        Ok(())
    }
}

fn name(step: usize) -> String {
    format!("step-{step:05}.vtp")
}
