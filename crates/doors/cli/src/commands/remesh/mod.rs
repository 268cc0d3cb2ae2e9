//! `pompeiu remesh`.

mod text;

use crate::appearance::{self, Carried};
use crate::args::{Picture, hold_in, suffix, tell};
use crate::called::called;
pub(crate) use crate::door::run;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::numbers::pairs_that_intersect;
use crate::{certificate, files};
use anyhow::Context;
use clap::Args;
use pompeiu::remesh::show::RemeshPage;
use pompeiu::remesh::{IntersectionCount, RemeshReport, RemeshRequest};
use std::path::PathBuf;

pub(crate) type Remesh = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
Of --edge-length, --relative and --adaptive at most one is given; without any, edges are as long as those of the mesh in the
mean, or shorter where its faces are long and thin: at most 4/3 of those of as many equilateral faces. Edges are split, collapsed and flipped, vertices move within the surface
and onto the input. Topology, boundaries and the edges that --features names are kept. The Pompeiu–Hausdorff distance from the
input is measured; with --within it is proven to be at most that length, for which edges are shortened where they must be; otherwise
nothing is written. The mesh must be an oriented manifold, with or without boundary. Colours, texture coordinates and materials are
carried over, and seams are kept as curves, if the output has a place for them; normals are those of the new faces. What is not kept is
said.

Examples:
  pompeiu remesh scan.ply --edge-length 0.5 -o even.ply
  pompeiu remesh scan.ply --relative 0.01 --within 0.1 -o even.ply --certificate proof.phc
  pompeiu remesh part.stl --relative 0.01 --features 40 -o even.ply
  pompeiu remesh scan.ply --adaptive 0.01 --within 0.05 -o light.ply --report light.html")]
pub(crate) struct Files {
    /// The mesh file
    mesh: PathBuf,
    /// The mesh file to write
    #[arg(long, short, value_name = "OUT")]
    output: PathBuf,
    /// Write a file from which anybody can prove anew that the result is within the distance of the input, see `pompeiu verify`
    #[arg(long, value_parser = suffix::certificate, value_name = "FILE")]
    certificate: Option<PathBuf>,
    #[command(flatten)]
    picture: Picture,
}

impl System for Files {
    type Request = RemeshRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        files::check_writable(&self.output)?;
        let proof = self.certificate.as_deref();
        let outputs = std::iter::once(self.output.as_path()).chain(self.picture.outputs()).chain(proof);
        files::check_places(outputs, &[&self.mesh])
    }

    fn run(&self, request: &mut RemeshRequest, session: &mut Session<'_>) -> anyhow::Result<RemeshReport> {
        certificate::check_result(
            self.certificate.as_deref(),
            request.within.is_some(),
            request.coordinates.center,
        )?;
        let shown = self.mesh.display().to_string();
        let mesh = session.read_mesh(&self.mesh)?;
        hold_in(&self.output, &mut request.coordinates);
        let looks = appearance::read(&self.mesh, &mesh, &self.output, session.printer)?;
        let carried = Carried::of(looks, &mesh, &self.mesh)?;
        let answer = request.run_keeping(&mesh, &carried.seams, &session.context());
        let mut answer = answer.with_context(|| shown.clone())?;
        session.stop_waiting();
        let (found, printer) = (&answer.found, session.printer);
        tell(&self.output, &found.rounding, printer);
        if let Some(count) = answer.report.intersections.filter(IntersectionCount::is_more) {
            printer.warning(format_args!(
                "more faces of the result intersect than of the input: {}",
                pairs_that_intersect(count)
            ));
        }
        if answer.report.is_far {
            printer.warning(text::far(&answer.report, request.features.is_some()));
        }
        if answer.report.is_uneven {
            printer.warning(text::uneven(&answer.report));
        }
        let attributes = carried.attributes(&found.mesh, &found.kept)?;
        files::write_shifted(&self.output, &found.mesh, &attributes, &found.rounding, printer)?;
        let mut proof = None;
        if let Some((path, within)) = self.certificate.as_ref().zip(answer.report.within) {
            let (written, result) = certificate::write_of_output(path, &mesh, &self.output, within, session)?;
            if self.picture.report.is_some() {
                proof = certificate::attached(path, [&mesh, &result], &written, session)?;
            }
            answer.report.certificate = Some(written);
            session.stop_waiting();
        }
        let (up, command) = (self.picture.up.axis(), called());
        let (proof, found) = (proof.as_ref(), &answer.found);
        let page = RemeshPage { path: &shown, input: &mesh, found, proof, up, command: Some(&command) };
        self.picture.write(
            || page.html(),
            |width, height, theme, view| page.image(width, height, theme, view),
            printer,
        )?;
        Ok(answer.report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(self.certificate.as_deref(), answer)
    }
}
