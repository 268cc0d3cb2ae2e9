//! `pompeiu simplify`.

mod text;

use crate::appearance::{self, Carried};
use crate::args::{hold_in, suffix, tell};
pub(crate) use crate::door::run;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::{certificate, files};
use anyhow::Context;
use clap::Args;
use pompeiu::remesh::{SimplifyReport, SimplifyRequest};
use std::path::{Path, PathBuf};

pub(crate) type Simplify = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
One of --within, --relative and --faces is given. Edges are collapsed in order of their quadric error. With --within or --relative
each collapse is tested on both sides, and the Pompeiu–Hausdorff distance of the result is proven to be at most that length; otherwise
nothing is written. With --faces the distance follows, and is proven too; a number that cannot be reached is said with the reason
(exit code 3). Where --intersections refuses them, no more faces intersect than in the input. The mesh must be an oriented manifold, with
or without boundary, or be repaired (--repair). Colours of vertices (PLY, OBJ, glTF), texture coordinates and materials (OBJ, glTF) are
carried over, and seams are kept as curves, if the output has a place for them; normals are those of the new faces. What is not kept is
said. Further levels of detail (--levels) are written beside OUT, with -1, -2, … before its suffix.

Examples:
  pompeiu simplify scan.ply --within 0.05 -o light.ply
  pompeiu simplify scan.ply --relative 0.001 -o light.ply --json
  pompeiu simplify scan.ply --within 0.05 -o light.ply --certificate proof.phc
  pompeiu simplify scan.ply --faces 5000 -o light.glb
  pompeiu simplify scan.ply --relative 0.02 --levels 4 -o light.ply")]
pub(crate) struct Files {
    /// The mesh file
    mesh: PathBuf,
    /// The mesh file to write
    #[arg(long, short, value_name = "OUT")]
    output: PathBuf,
    /// Write a file from which anybody can prove anew that the result (OUT) is within the distance of the input, see `pompeiu verify`
    #[arg(long, value_parser = suffix::certificate, value_name = "FILE")]
    certificate: Option<PathBuf>,
}

impl System for Files {
    type Request = SimplifyRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        files::check_writable(&self.output)?;
        Ok(())
    }

    fn run(
        &self,
        request: &mut SimplifyRequest,
        session: &mut Session<'_>,
    ) -> anyhow::Result<SimplifyReport> {
        let places: Vec<PathBuf> =
            (0..usize::from(request.levels)).map(|level| place(&self.output, level)).collect();
        let outputs = places.iter().chain(&self.certificate);
        files::check_places(outputs.map(PathBuf::as_path), &[&self.mesh])?;
        let asked = request.within.is_some() || request.relative.is_some();
        let is_centered = request.coordinates.center;
        certificate::check_result(self.certificate.as_deref(), asked, is_centered)?;
        let mesh = session.read_mesh(&self.mesh)?;
        let carried = if request.repair {
            let why = "because repairing cuts faces apart; repair the mesh first";
            appearance::leave_out(&self.mesh, &mesh, why, session.printer)?;
            Carried::default()
        } else {
            let found = appearance::read(&self.mesh, &mesh, &self.output, session.printer)?;
            Carried::of(found, &mesh, &self.mesh)?
        };
        hold_in(&self.output, &mut request.coordinates);
        let found = request.run(&mesh, &carried.seams, &session.context());
        let mut found = found.with_context(|| self.mesh.display().to_string())?;
        session.stop_waiting();
        tell(&self.output, &found.report.rounding, session.printer);
        for (place, level) in places.iter().zip(&found.levels) {
            let attributes = carried.attributes(&level.mesh, &level.kept)?;
            files::write_shifted(place, &level.mesh, &attributes, &level.rounding, session.printer)?;
        }
        found.report.kept = carried.kept();
        if let Some((path, within)) = self.certificate.as_ref().zip(found.report.level.within) {
            let (answer, _) = certificate::write_of_output(path, &mesh, &self.output, within, session)?;
            found.report.certificate = Some(answer);
            session.stop_waiting();
        }
        Ok(found.report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(&self.output, self.certificate.as_deref(), answer)
    }
}

/// Where a level goes: the first to the path itself, others with their number before the suffix.
fn place(path: &Path, level: usize) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    match name.split_once('.') {
        Some((stem, suffix)) if level > 0 => path.with_file_name(format!("{stem}-{level}.{suffix}")),
        _ => path.to_owned(),
    }
}
