//! `pompeiu rank`.

mod csv;
mod text;

use crate::args::{Many, suffix};
pub(crate) use crate::door::run;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::files;
use crate::many::{Collection, expand, report, show};
use anyhow::bail;
use clap::Args;
use pompeiu::core::mesh::unreferenced_vertices;
use pompeiu::matching::TaskProgress;
use pompeiu::matching::rank::{Kind, RankError, Row};
use pompeiu::matching::request::{RankReport, RankRequest};
use std::path::{Path, PathBuf};

pub(crate) type Rank = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
The targets are ranked by their Pompeiu–Hausdorff distance from the template: all points of all
faces count. A target is discarded as soon as it is proven to be farther than the K best. Where
distances cannot be told apart, ranks are given as a range. The answer does not depend on the order
of the targets or the number of threads.

A folder stands for the mesh files in it, by their suffixes; a pattern in quotes may hold *, ?,
[abc] and **. With --align, distances hold for the targets as moved, their coordinates rounded; a
rigid alignment is a local optimum.

A limit or Ctrl-C ends the ranking with what is proven: targets that are not settled are open, with
the bounds and the ranks known so far.

Exit codes:
  0  done
  2  the template, an argument, or all of the targets cannot be used
  3  some of the targets cannot be used, or a limit or Ctrl-C left targets open; the others are ranked

Examples:
  pompeiu rank part.stl library/ --top 5
  pompeiu rank part.stl 'library/**/*.stl' --align rigid --resume part.journal --csv part.csv
  pompeiu rank tooth.ply scans/ --direction from-template --json")]
pub(crate) struct Files {
    /// The mesh file to compare with
    #[arg(value_name = "TEMPLATE")]
    template: PathBuf,
    /// Files, folders and patterns, in the same unit
    #[arg(value_name = "TARGETS", required = true)]
    targets: Vec<PathBuf>,
    /// Write a table of all targets to this file
    #[arg(long, value_parser = suffix::table, value_name = "FILE")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    many: Many,
}

impl System for Files {
    type Request = RankRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        // Files in folders are looked at when they are known.
        files::check_places(self.outputs(), &[&self.template])
    }

    fn run(&self, request: &mut RankRequest, session: &mut Session<'_>) -> anyhow::Result<RankReport> {
        request.options().check()?;
        let inputs = expand(&self.targets, self.many.recursive);
        let read: Vec<&Path> = inputs.paths.iter().map(PathBuf::as_path).collect();
        files::check_places(self.outputs(), &read)?;
        let template = session.read_mesh(&self.template)?;
        session.wait.suspend(|| {
            files::warn_of_unreferenced(&self.template, unreferenced_vertices(&template), session.printer);
        });
        if inputs.paths.is_empty() {
            session.stop_waiting();
            report(&inputs.problems);
            bail!("there are no targets to rank");
        }
        let targets = Collection::open(inputs.paths, &self.many, Some(&self.template), session)?;
        let watch = |progress: &TaskProgress| {
            show(&session.wait, progress, format!("{} of {} settled", progress.settled, progress.meshes))
        };
        let found = request.run(&template, &targets, &session.context(), Some(&watch));
        let mut found = found.map_err(|error| match error {
            RankError::Template(_) => anyhow::anyhow!("{}: {error}", self.template.display()),
            _ => error.into(),
        })?;
        session.stop_waiting();
        targets.close(session);
        let unusable = inputs.problems.into_iter().map(|one| Row::failed(one.path, one.message));
        found.targets.extend(unusable);
        report(&found.of(Kind::Failed).map(Row::unusable).collect::<Vec<_>>());
        if let Some(path) = &self.csv {
            files::write_whole(path, &csv::csv(request, &found)?, session.printer)?;
        }
        Ok(found)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(answer)
    }
}

impl Files {
    fn outputs(&self) -> impl Iterator<Item = &Path> {
        self.csv.iter().chain(&self.many.resume).map(PathBuf::as_path)
    }
}
