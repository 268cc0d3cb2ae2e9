//! `pompeiu cut`.

use crate::appearance;
use crate::args::ForbidFile;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::files;
use crate::numbers::{counted, grouped, shortest, time};
use crate::page::Page;
use anyhow::{Context, bail};
use clap::Args;
use pompeiu::flatten::{CutRequest, OpenedReport};
use std::path::PathBuf;

pub(crate) use crate::door::run;

pub(crate) type Cut = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
The mesh must be a manifold. Faces and their corners stay as they are; a vertex gets a copy for each part that the cut makes of
its faces. The first copy keeps the number of the vertex, so that gluing gives the input back. STL cannot hold a cut.

Examples:
  pompeiu cut torus.obj -o disk.obj
  pompeiu cut cow.off --strategy tips -o cow-open.ply
  pompeiu cut ball.ply --through 0,17,230 -o ball-open.ply")]
pub(crate) struct Files {
    /// The mesh file
    mesh: PathBuf,
    #[command(flatten)]
    forbid: ForbidFile,
    /// The mesh file to write
    #[arg(long, short, value_name = "OUT")]
    output: Option<PathBuf>,
}

impl System for Files {
    type Request = CutRequest;

    fn check(&self, json: bool) -> anyhow::Result<()> {
        let Some(output) = &self.output else {
            if json {
                return Ok(());
            }
            bail!("nothing would be written; name the result with -o, or ask for --json");
        };
        files::check_writable(output)?;
        files::check_place(output, &[&self.mesh])
    }

    fn run(&self, request: &mut CutRequest, session: &mut Session<'_>) -> anyhow::Result<OpenedReport> {
        let (mesh, surface) = session.read_surface(&self.mesh)?;
        self.forbid.add_to(request)?;
        session.wait.show("choosing edges".to_owned());
        let found = request.run(surface).with_context(|| self.mesh.display().to_string())?;
        session.stop_waiting();
        if let Some(output) = &self.output {
            files::refuse_joined(output, &found.mesh)?;
            let why = "because `pompeiu cut` writes the surface alone";
            appearance::leave_out(&self.mesh, &mesh, why, session.printer)?;
            files::write(output, &found.mesh, session.printer)?;
        }
        Ok(found.report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        let report = &answer.report;
        let mut page = Page::new();
        page.row("result", &counted(report.components, "disk"));
        let cut = &report.cut;
        let (edges, length) = (counted(cut.edges, "edge"), shortest(cut.length));
        page.row("cut", &format!("{edges} of length {length} ({})", cut.strategy));
        page.row(
            "mesh",
            &format!(
                "{}: {}, {} of them copies, {}",
                self.mesh.display(),
                counted(report.vertices, "vertex"),
                grouped(report.copies as u64),
                counted(report.faces, "face")
            ),
        );
        page.row("time", &time(answer.timing.total));
        page.into_text()
    }
}
