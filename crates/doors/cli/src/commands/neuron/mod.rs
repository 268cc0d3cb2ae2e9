//! `pompeiu neuron`.

mod args;
mod extraction;
mod output;
mod text;

use crate::door::{AnswerOf, Invocation, Session, System};
use crate::files;
use anyhow::Context;
pub(crate) use args::Files;
use output::Outputs;
use pompeiu::neuron::{NeuronReport, NeuronRequest, NeuronRequestError, NeuronSource};
use pompeiu::options::{Options, OptionsError, options_of_toml};
use pompeiu::volume::HexMesh;
use std::path::Path;

pub(crate) use crate::door::run;

pub(crate) type Neuron = Invocation<Files>;

impl System for Files {
    type Request = NeuronRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        Ok(())
    }

    /// A parameter file of `NeuronTransportIGA` is named by the option that takes it.
    fn options_in(path: &Path, text: &str) -> Result<Options, OptionsError> {
        let read = options_of_toml(text);
        if read.is_err() && is_pairs(text) {
            return Ok(Options::from_iter([("parameters".to_owned(), path.display().to_string().into())]));
        }
        read
    }

    fn run(&self, request: &mut NeuronRequest, session: &mut Session<'_>) -> anyhow::Result<NeuronReport> {
        let skeleton = self.skeleton();
        request.stage = self.stage(request.stage)?;
        let outputs = Outputs::of(self, request, session.is_json())?;
        let shown = || skeleton.display().to_string();
        session.wait.show(format!("reading {}", shown()));
        let source = source(skeleton)?;
        let found = request.run(source, self.extraction.is_some(), &session.context());
        let mut found = found.map_err(|error| match &error {
            NeuronRequestError::File { .. }
            | NeuronRequestError::Parameters { .. }
            | NeuronRequestError::Checkpoint { .. }
            | NeuronRequestError::Table(_) => anyhow::Error::new(error),
            _ => anyhow::Error::new(error).context(shown()),
        })?;
        session.stop_waiting();
        session.note_points(skeleton, found.points);
        outputs.write(&mut found, session.printer)?;
        if let Some(ended) = &found.report.ended {
            session.printer.warning(format_args!("{}: {ended}", shown()));
        }
        Ok(found.report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(&self.skeleton().display().to_string(), answer)
    }
}

/// Whether a text begins with a name and a value, without a sign of TOML.
fn is_pairs(text: &str) -> bool {
    let first = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'));
    first.is_some_and(|line| {
        !line.starts_with('[') && !line.contains('=') && line.split_whitespace().count() == 2
    })
}

/// Reads a skeleton, or a mesh.
fn source(path: &Path) -> anyhow::Result<NeuronSource> {
    let shown = || path.display().to_string();
    if !is_mesh(path) {
        files::check_file(path, "a skeleton")?;
        return Ok(NeuronSource::skeleton(std::fs::read(path).with_context(shown)?));
    }
    files::check_readable(path)?;
    let content = std::fs::read(path).with_context(shown)?;
    let read = pompeiu::io::read_hexahedra(path)?;
    let positions = read.positions.into_iter().map(Into::into).collect();
    Ok(NeuronSource::mesh(content, HexMesh::new(positions, read.cells).with_context(shown)?, read.labels))
}

/// Whether a file is a mesh by its name.
fn is_mesh(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let name = name.strip_suffix(".gz").unwrap_or(&name);
    [".vtk", ".vtu"].iter().any(|suffix| name.ends_with(suffix))
}
