//! `pompeiu info`.

mod text;

pub(crate) use crate::door::run;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::files;
use clap::Args;
use pompeiu::core::request::{FileFacts, InfoReport, InfoRequest};
use std::path::PathBuf;

pub(crate) type Info = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
Examples:
  pompeiu info bunny.ply
  pompeiu info bunny.ply --json
  pompeiu info bunny.ply --intersections")]
pub(crate) struct Files {
    /// The mesh file
    file: PathBuf,
}

impl System for Files {
    type Request = InfoRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        Ok(())
    }

    fn run(&self, request: &mut InfoRequest, session: &mut Session<'_>) -> anyhow::Result<InfoReport> {
        let read = files::read(&self.file)?;
        session.note(&self.file, &read.mesh);
        files::warn_of_changes(&self.file, &read, session.printer);
        let file = FileFacts {
            format: read.format.to_string(),
            compressed: read.compressed,
            polygons_triangulated: read.polygons_triangulated,
            faces_dropped: read.faces_dropped,
        };
        Ok(InfoReport { file: Some(file), ..request.run(&read.mesh) })
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(&self.file, &answer.report)
    }
}
