//! `pompeiu repair`.

mod text;

use crate::appearance;
use crate::args::{OutputFile, hold_in, suffix, tell};
pub(crate) use crate::door::run;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::numbers::shortest;
use crate::{certificate, files};
use anyhow::Context;
use clap::Args;
use pompeiu::hausdorff::{ProvenRepairReport, RepairRequest};
use pompeiu::io::Attributes;
use std::path::PathBuf;

pub(crate) type Repair = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
In this order: drops vertices in no face, makes one vertex of those at one position, drops degenerate and duplicate faces, gives
each fan of faces around a vertex a vertex of its own so that no edge has more than two faces, turns faces to agree, fills holes
when asked, cuts surfaces with one side only open. With --within the Pompeiu–Hausdorff distance of the result from the input is proven to be at most that length;
otherwise nothing is written, and the exit code is 1.

Examples:
  pompeiu repair scan.stl clean.ply
  pompeiu repair scan.ply clean.ply --weld 0.001 --within 0.01
  pompeiu repair scan.ply clean.ply --weld 0.001 --within 0.01 --certificate proof.phc
  pompeiu repair scan.ply closed.ply --fill-holes 30 --json")]
pub(crate) struct Files {
    /// The mesh file to read
    #[arg(value_name = "IN")]
    input: PathBuf,
    #[command(flatten)]
    output: OutputFile,
    /// Write a file from which anybody can prove anew that the result is within --within of the input, see `pompeiu verify`
    #[arg(long, value_parser = suffix::certificate, value_name = "FILE")]
    certificate: Option<PathBuf>,
}

impl System for Files {
    type Request = RepairRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        let output = self.output.path();
        files::check_writable(output)?;
        files::check_places([Some(output), self.certificate.as_deref()].into_iter().flatten(), &[&self.input])
    }

    fn run(
        &self,
        request: &mut RepairRequest,
        session: &mut Session<'_>,
    ) -> anyhow::Result<ProvenRepairReport> {
        certificate::check_result(
            self.certificate.as_deref(),
            request.within.is_some(),
            request.coordinates.center,
        )?;
        let mesh = session.read_mesh(&self.input)?;
        let output = self.output.path();
        hold_in(output, &mut request.coordinates);
        let found = request.run(&mesh, &session.context());
        let mut found = found.with_context(|| self.input.display().to_string())?;
        session.stop_waiting();
        files::refuse_joined(output, &found.report.rounding.written(&found.mesh)?)?;
        let is_changed =
            found.mesh.faces() != mesh.faces() || found.mesh.positions().len() != mesh.positions().len();
        let attributes = if is_changed {
            let why = "because repairing changed the faces";
            appearance::leave_out(&self.input, &mesh, why, session.printer)?;
            Attributes::for_mesh(&found.mesh)
        } else {
            let looks = appearance::read(&self.input, &mesh, output, session.printer)?;
            appearance::of_same_faces(looks, &found.mesh)?
        };
        if let (true, Some(path), Some(within)) =
            (found.report.written, &self.certificate, found.report.within)
        {
            let answer = certificate::write_within(path, [&mesh, &found.mesh], within, session)?;
            found.report.certificate = Some(answer);
        }
        if found.report.written {
            tell(output, &found.report.rounding, session.printer);
            let rounding = &found.report.rounding;
            files::write_shifted(output, &found.mesh, &attributes, rounding, session.printer)?;
        } else if let Some(within) = found.report.within {
            session.printer.warning(format_args!(
                "{}: not written, for the result is not proven to be within {} of the input; allow more, or repair less",
                output.display(),
                shortest(within)
            ));
        }
        Ok(found.report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(self.certificate.as_deref(), answer)
    }
}
