//! `pompeiu matrix`.

use crate::args::Many;
pub(crate) use crate::door::run;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::exit::stopped_by;
use crate::files;
use crate::many::{Collection, expand, report, show};
use crate::numbers::{grouped, shortest};
use anyhow::bail;
use clap::Args;
use pompeiu::matching::TaskProgress;
use pompeiu::matching::matrix::tasks;
use pompeiu::matching::request::{MatrixReport, MatrixRequest};
use std::path::{Path, PathBuf};

pub(crate) type Matrix = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
Prints a line for each pair with the proven bounds on its symmetric distance, as comma-separated
values; --directed prints both directed distances instead, h(A, B) in the line from A to B. A folder
stands for the mesh files in it, by their suffixes; a pattern in quotes may hold *, ?, [abc] and **.
--json has square arrays.

A limit or Ctrl-C ends the run with what is proven; the bounds of pairs that were not measured are
left empty.

Exit codes:
  0  done
  2  an argument, or all of the files cannot be used
  3  some of the files cannot be used, or a limit or Ctrl-C left pairs open; the others are measured

Examples:
  pompeiu matrix library/ > distances.csv
  pompeiu matrix 'scans/*.ply' --tolerance 1e-6 --resume scans.journal --json")]
pub(crate) struct Files {
    /// Files, folders and patterns, in the same unit
    #[arg(value_name = "FILES", required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    many: Many,
}

impl System for Files {
    type Request = MatrixRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        files::check_places(self.many.resume.as_deref(), &[])
    }

    fn run(&self, request: &mut MatrixRequest, session: &mut Session<'_>) -> anyhow::Result<MatrixReport> {
        let mut inputs = expand(&self.files, self.many.recursive);
        if inputs.paths.is_empty() {
            report(&inputs.problems);
            bail!("there are no meshes to measure");
        }
        if let [only] = &inputs.paths[..] {
            session.printer.note(format_args!(
                "note: {} is the only mesh; a matrix has the distances of all pairs of several, such as those of a folder",
                only.display()
            ));
        }
        let read: Vec<&Path> = inputs.paths.iter().map(PathBuf::as_path).collect();
        files::check_places(self.many.resume.as_deref(), &read)?;
        let meshes = Collection::open(inputs.paths, &self.many, None, session)?;
        let watch = |progress: &TaskProgress| show(&session.wait, progress, "pairs measured".to_owned());
        let (mut found, _) = request.run(&meshes, &session.context(), Some(&watch))?;
        session.stop_waiting();
        meshes.close(session);
        inputs.problems.append(&mut found.failed);
        found.failed = inputs.problems;
        report(&found.failed);
        if !found.open.is_empty() {
            session.printer.warning(format_args!(
                "ended by {}: {} of {} directed distances are open",
                stopped_by(found.stop),
                grouped(found.open.len() as u64),
                grouped(tasks(found.meshes.len()).count() as u64)
            ));
        }
        Ok(found)
    }

    /// A line for each pair, empty bounds where one of the two cannot be used, or was not measured.
    fn text(&self, answer: &AnswerOf<Self>) -> String {
        let (found, directed) = (&answer.report, answer.request.directed);
        let mut table = csv::Writer::from_writer(Vec::new());
        let mut add = |row: [&str; 4]| {
            // Text can be written to memory.
            let _ = table.write_record(row);
        };
        add([if directed { "from" } else { "a" }, if directed { "to" } else { "b" }, "lower", "upper"]);
        for (i, a) in found.meshes.iter().enumerate() {
            for (j, b) in found.meshes.iter().enumerate().filter(|(j, _)| i < *j || (directed && i != *j)) {
                let [lower, upper] =
                    [&found.lower, &found.upper].map(|square| square[i][j].map(shortest).unwrap_or_default());
                add([a, b, &lower, &upper]);
            }
        }
        String::from_utf8(table.into_inner().unwrap_or_default()).unwrap_or_default()
    }
}
