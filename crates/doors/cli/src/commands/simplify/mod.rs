//! `pompeiu simplify`.

mod appearance;
mod text;

use crate::args::{hold_in, tell};
pub(crate) use crate::door::run;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::files;
use anyhow::Context;
use appearance::Appearance;
use clap::Args;
use pompeiu::remesh::{SimplifyReport, SimplifyRequest};
use std::path::{Path, PathBuf};

pub(crate) type Simplify = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
One of --within, --relative and --faces is given. Edges are collapsed in order of their quadric error. With --within or --relative
each collapse is tested on both sides, and the Pompeiu–Hausdorff distance of the result is proven to be at most that length; otherwise
nothing is written. With --faces the distance follows, and is proven too. The mesh must be an oriented manifold, with or without
boundary, or be repaired (--repair). Colours of vertices (PLY, OBJ), texture coordinates and materials (OBJ) are carried over, and seams
are kept as curves, if the output has a place for them. Normals are not in the output. Further levels of detail (--levels) are
written beside OUT, with -1, -2, … before its suffix.

Examples:
  pompeiu simplify scan.ply --within 0.05 -o light.ply
  pompeiu simplify scan.ply --relative 0.001 -o light.ply --json
  pompeiu simplify scan.ply --faces 5000 -o light.glb
  pompeiu simplify scan.ply --relative 0.02 --levels 4 -o light.ply")]
pub(crate) struct Files {
    /// The mesh file
    mesh: PathBuf,
    /// The mesh file to write
    #[arg(long, short, value_name = "OUT")]
    output: PathBuf,
}

impl System for Files {
    type Request = SimplifyRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        files::check_writable(&self.output)?;
        files::check_place(&self.output, &[&self.mesh])
    }

    fn run(
        &self,
        request: &mut SimplifyRequest,
        session: &mut Session<'_>,
    ) -> anyhow::Result<SimplifyReport> {
        let places: Vec<PathBuf> =
            (0..usize::from(request.levels)).map(|level| place(&self.output, level)).collect();
        files::check_places(places.iter().map(PathBuf::as_path), &[&self.mesh])?;
        let mesh = session.read_mesh(&self.mesh)?;
        let appearance = Appearance::read(&self.mesh, &mesh, &self.output, request.repair, session.printer)?;
        hold_in(&self.output, &mut request.coordinates);
        let found = request.run(&mesh, &appearance.seams, &session.context());
        let mut found = found.with_context(|| self.mesh.display().to_string())?;
        session.stop_waiting();
        tell(&self.output, &found.report.rounding, session.printer);
        for (place, level) in places.iter().zip(&found.levels) {
            appearance.write(place, level, session.printer)?;
        }
        found.report.kept = appearance.kept();
        Ok(found.report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(&self.output, answer)
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
