//! `pompeiu complexity`.

mod text;

use crate::args::suffix;
use crate::called::called;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::files;
use crate::printer::Printer;
use clap::Args;
use pompeiu::complexity::show::ComplexityPage;
use pompeiu::complexity::{ComplexityReport, ComplexityRequest, NamedShape, RankingSource};
use std::path::{Path, PathBuf};

pub(crate) use crate::door::run;

pub(crate) type Complexity = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
Shapes are pictures (PNG, JPEG, GIF, BMP: the largest part that stands out), drawings (SVG, DXF) and lists of points (TXT, CSV). Of each
the outline counts, without its holes. Files that cannot be used are reported, and the others measured; further parts of a picture are told of.

Measures, by family; + grows with complexity, - falls:
  boundary   boundary-  boundary-500-  boundary-100-  boundary-50-  boundary-25-  boundary-8-
  curvature  t18+  neg5+  sharp+  per-shape+  peaks+  total-curvature+
  skeleton   skeleton-length+  skeleton-ends+  skeleton-junctions+  skeleton-radius-  skeleton-variation+
  moments    elongation+  spread+
  coverage   hull-  rectangle-  circle-
  global     compactness-  convexity-  aspect-  diameter+

Exit codes:
  0  done
  2  an argument cannot be used, or none of the files
  3  some of the files cannot be used, or a limit or Ctrl-C left shapes out; the others are measured

Examples:
  pompeiu complexity shapes/ --report shapes.html
  pompeiu complexity shapes/ --rank-by boundary-25 --against mine.csv
  pompeiu complexity shapes/ --clusters 4 --features log:peaks,log:total-curvature --json")]
pub(crate) struct Files {
    /// Folders of shapes, or files
    #[arg(value_name = "FOLDER", required = true)]
    inputs: Vec<PathBuf>,
    /// Write a page with a gallery that can be sorted, one file that needs no network
    #[arg(long, value_parser = suffix::page, value_name = "FILE.html")]
    report: Option<PathBuf>,
}

impl System for Files {
    type Request = ComplexityRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        let inputs: Vec<&Path> = self.inputs.iter().map(PathBuf::as_path).collect();
        files::check_places(self.report.as_deref(), &inputs)
    }

    fn run(
        &self,
        request: &mut ComplexityRequest,
        session: &mut Session<'_>,
    ) -> anyhow::Result<ComplexityReport> {
        session.wait.show("reading shapes".to_owned());
        let named: Vec<NamedShape> = self.inputs.iter().cloned().map(NamedShape::file).collect();
        let found = request.run(&named, &session.context())?;
        session.stop_waiting();
        for shape in &found.shapes {
            session.note_points(Path::new(&shape.file), shape.outline.points().len());
        }
        for failed in &found.report.failed {
            Printer::error(&anyhow::anyhow!(failed.to_string()));
        }
        for left_out in &found.report.left_out {
            session.printer.warning(left_out);
        }
        if let Some(path) = &self.report {
            // Files in the folders are known only now.
            let mut read: Vec<&Path> = found.shapes.iter().map(|shape| Path::new(&shape.file)).collect();
            read.extend(request.against.as_ref().and_then(RankingSource::file));
            files::check_places([path.as_path()], &read)?;
            let inputs: Vec<String> = self.inputs.iter().map(|input| input.display().to_string()).collect();
            let page = ComplexityPage {
                title: &inputs.join(", "),
                shapes: &found.shapes,
                report: &found.report,
                command: Some(&called()),
            };
            files::write_whole(path, page.html()?.as_bytes(), session.printer)?;
        }
        Ok(found.report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(answer)
    }
}
