//! `pompeiu medial`.

use crate::args::Picture;
use crate::called::called;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::exit::stopped_by;
use crate::files;
use crate::numbers::{counted, grouped, time};
use crate::page::Page;
use anyhow::{Context, bail};
use clap::Args;
use pompeiu::medial::show::MedialPage;
use pompeiu::medial::{MedialReport, MedialRequest};
use std::path::{Path, PathBuf};

pub(crate) use crate::door::run;

pub(crate) type Medial = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
Balls are shrunk from points of the surface until they touch it on two sides, and then replaced by fewer ones. Edges join balls that
lie beside each other along the medial axis.

Outputs:
  .ma    balls and edges as text: v X Y Z RADIUS and e I J, after a line with their numbers
  .png   surface and balls beside each other
  .obj, .ply and other mesh files: a sphere of triangles for each ball

Examples:
  pompeiu medial cow.off -o cow.ma
  pompeiu medial cow.off --balls 50 --report balls.html --json")]
pub(crate) struct Files {
    /// The mesh file
    mesh: PathBuf,
    /// The file to write: .ma, .png or a mesh
    #[arg(long, short, value_name = "OUT")]
    output: Option<PathBuf>,
    #[command(flatten)]
    picture: Picture,
}

fn has_suffix(path: &Path, suffix: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(suffix))
}

impl System for Files {
    type Request = MedialRequest;

    fn check(&self, json: bool) -> anyhow::Result<()> {
        if self.output.is_none() && self.picture.outputs().next().is_none() && !json {
            bail!(
                "nothing would be written; name the result with -o, or ask for --report, --image or --json"
            );
        }
        let is_mesh = |path: &&Path| !has_suffix(path, "ma") && !has_suffix(path, "png");
        if let Some(output) = self.output.as_deref().filter(is_mesh) {
            files::check_writable(output)?;
        }
        let outputs = self.output.iter().map(PathBuf::as_path).chain(self.picture.outputs());
        files::check_places(outputs, &[&self.mesh])
    }

    fn run(&self, request: &mut MedialRequest, session: &mut Session<'_>) -> anyhow::Result<MedialReport> {
        let shown = self.mesh.display().to_string();
        let (mesh, surface) = session.read_surface(&self.mesh)?;
        session.wait.show("finding balls".to_owned());
        let medial = request.run(&surface, &session.context()).with_context(|| shown.clone())?;
        session.stop_waiting();
        let command = called();
        let mut page = MedialPage::new(&shown, &mesh, &medial)?;
        (page.up, page.command) = (self.picture.up.axis(), Some(command.as_str()));
        let (picture, printer) = (&self.picture, session.printer);
        match &self.output {
            Some(output) if has_suffix(output, "ma") => {
                files::write_whole(output, medial.to_ma().as_bytes(), printer)?;
            }
            Some(output) if has_suffix(output, "png") => {
                picture.write_image(
                    output,
                    |width, height, theme, view| page.image(width, height, theme, view),
                    printer,
                )?;
            }
            Some(output) => files::write(output, &medial.spheres()?, printer)?,
            None => {}
        }
        picture.write(
            || page.html(),
            |width, height, theme, view| page.image(width, height, theme, view),
            printer,
        )?;
        Ok(MedialReport::from(&medial))
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        let report = &answer.report;
        let number = |n: usize| grouped(n as u64);
        let mut page = Page::new();
        let (balls, shrunk) = (counted(report.balls.len(), "ball"), number(report.shrunk));
        page.row(
            "result",
            &format!("{balls} in the place of {shrunk}, joined by {}", counted(report.edges.len(), "edge")),
        );
        if report.stop.is_early() {
            page.row("", &format!("stopped early by {}", stopped_by(report.stop)));
        }
        let [lower, upper] = report.deviation.surface_to_balls;
        page.row("distance", &format!("from the surface to the balls between {lower:.6} and {upper:.6}"));
        page.row("", &format!("out of the surface at most {:.6}", report.deviation.balls_to_surface));
        page.row("overlaps", &format!("{} of balls", counted(report.overlaps.len(), "pair")));
        page.row("time", &time(answer.timing.total));
        page.into_text()
    }
}
