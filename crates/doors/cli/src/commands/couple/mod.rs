//! `pompeiu couple`.

mod text;

use crate::args::suffix;
use crate::called::called;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::files;
use anyhow::bail;
use clap::Args;
use pompeiu::coupling::show::{CoupleFrames, CouplePage};
use pompeiu::coupling::{CoupleReport, CoupleRequest, Scene};
use std::fmt::Write;
use std::path::PathBuf;

pub(crate) use crate::door::run;

pub(crate) type Couple = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
A scene says what is coupled and how; options of the command line and of --config replace what it says.

  kind = \"tube\"              # piston, tube, channel, box
  windows = 100
  time-step = 0.01
  [tube]
  modulus = 1e4              # of the wall

  [piston]   mass, stiffness, fluid-mass, start, rule
  [tube]     length, segments, modulus, mean, amplitude, frequency
  [channel]  height, cells, density, rule, advect, pressure, duration
  [box]      height, cells, density, rule, advect, volume, duration
  [wall]     mass, stiffness, tension, damping, ends; of channel and box
  [coupling] scheme, tolerance, most-solves, reuse, filter, extrapolate, closed

Schemes: fixed, constant:W, aitken, aitken:W, iqn-ils, iqn-imvj, two-models. One solve is one of the fluid and one of the solid.

Exit codes:
  0  all windows were solved; with --compare: some scheme solved all
  2  the scene or an argument cannot be used
  3  a window could not be solved, the time limit was reached, or Ctrl-C; what was solved before is written

Examples:
  pompeiu couple tube.toml
  pompeiu couple tube.toml --compare
  pompeiu couple channel.toml --scheme aitken -o wall.csv --json
  pompeiu couple channel.toml --video channel.html")]
pub(crate) struct Files {
    /// The scene
    #[arg(value_name = "SCENE.toml")]
    scene: PathBuf,
    /// Write interface data of each window: displacements or cross-sections, and pressures
    #[arg(short, long, value_parser = suffix::table, value_name = "FILE.csv")]
    output: Option<PathBuf>,
    /// Write a page that plays the run, as --report does
    #[arg(long, value_parser = suffix::page, value_name = "RUN.html")]
    video: Option<PathBuf>,
    /// Write a page to explore in a browser, one file that needs no network
    #[arg(long, value_parser = suffix::page, value_name = "FILE.html")]
    report: Option<PathBuf>,
}

impl System for Files {
    type Request = CoupleRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        let outputs = self.output.iter().chain(self.pages());
        files::check_places(outputs.map(PathBuf::as_path), &[self.scene.as_path()])
    }

    fn run(&self, request: &mut CoupleRequest, session: &mut Session<'_>) -> anyhow::Result<CoupleReport> {
        let is_paged = self.pages().next().is_some();
        let given = [
            ("--output", self.output.is_some()),
            ("--video", self.video.is_some()),
            ("--report", self.report.is_some()),
        ];
        if let Some((name, _)) = given.into_iter().find(|(_, is_given)| request.compare && *is_given) {
            bail!("{name} has the data of one run, and --compare makes several; leave out one of them");
        }
        let scene = Scene::read(&self.scene)?;
        session.note_points(&self.scene, 0);
        let mut frames = CoupleFrames::default();
        let mut table = String::from("window,quantity");
        let mut watch = |window: usize, x: &[f64], y: &[f64]| {
            if self.output.is_some() {
                add_rows(&mut table, window, x, y);
            }
            if is_paged {
                frames.add(window, x, y);
            }
        };
        let report = request.run(&scene, &mut watch, &session.context())?;
        session.stop_waiting();
        if let Some(path) = &self.output {
            files::write_whole(path, table.as_bytes(), session.printer)?;
        }
        if is_paged {
            let page = CouplePage {
                kind: &report.kind,
                scenario: &scene.scenario()?,
                windows: report.windows,
                run: &report.runs[0],
                frames: frames.frames(),
                command: Some(&called()),
            };
            let html = page.html()?;
            self.pages().try_for_each(|path| files::write_whole(path, html.as_bytes(), session.printer))?;
        }
        Ok(report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(answer)
    }
}

impl Files {
    fn pages(&self) -> impl Iterator<Item = &PathBuf> {
        self.video.iter().chain(&self.report)
    }
}

/// A row for each of the interface's data, with a column for each value.
fn add_rows(table: &mut String, window: usize, x: &[f64], y: &[f64]) {
    if window == 1 {
        for i in 0..x.len() {
            let _ = write!(table, ",{i}");
        }
        table.push('\n');
    }
    for (name, values) in [("x", x), ("y", y)] {
        let _ = write!(table, "{window},{name}");
        for value in values {
            let _ = write!(table, ",{value:?}");
        }
        table.push('\n');
    }
}
