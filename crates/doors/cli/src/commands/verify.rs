//! `pompeiu verify`.

use crate::certificate::proven;
pub(crate) use crate::door::run;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::files;
use crate::page::{Page, described};
use crate::pair;
use anyhow::Context;
use clap::Args;
use pompeiu::hausdorff::{VerifyReport, VerifyRequest};
use std::fs::File;
use std::io::BufReader;
use std::path::PathBuf;

pub(crate) type Verify = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
The proof rests on the certificate and the two meshes alone, nothing of the search is used. Meshes are read by the readers of all
commands. The program `pompeiu-verify` does the same for OBJ, STL and PLY with readers of its own, and is small enough to be read
in an hour.

Exit codes:
  0  everything that the certificate states is proven
  1  it is not valid: the first statement that is not shown is named
  2  a file cannot be read

Examples:
  pompeiu distance model.obj scan.ply --certificate proof.phc
  pompeiu verify proof.phc model.obj scan.ply")]
pub(crate) struct Files {
    /// The certificate
    #[arg(value_name = "FILE")]
    certificate: PathBuf,
    /// The mesh file A
    #[arg(value_name = "A")]
    a: PathBuf,
    /// The mesh file B
    #[arg(value_name = "B")]
    b: PathBuf,
}

impl System for Files {
    type Request = VerifyRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        files::check_readable(&self.certificate)?;
        pair::check([&self.a, &self.b])
    }

    fn run(&self, request: &mut VerifyRequest, session: &mut Session<'_>) -> anyhow::Result<VerifyReport> {
        let shown = || self.certificate.display().to_string();
        let [a, b] = session.read_pair([&self.a, &self.b])?;
        session.wait.show(format!("checking {}", shown()));
        let file = File::open(&self.certificate).with_context(shown)?;
        let checked = request.run(&a, &b, BufReader::new(file), rayon::current_num_threads());
        checked.with_context(shown)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        let mut page = Page::new();
        for (label, input) in ["A", "B"].iter().zip(&answer.inputs) {
            page.row(label, &described(input));
        }
        page.gap();
        let report = &answer.report;
        match &report.failure {
            Some(failure) => page.row("invalid", &failure.message),
            None => page.row("valid", "proven of the triangles in these files"),
        }
        proven(&mut page, report.a_to_b.as_ref(), report.b_to_a.as_ref());
        for (name, sum) in ["A", "B"].iter().zip(report.sha256.iter().flatten()) {
            page.row("", &format!("SHA-256 of the triangles of {name}: {sum}"));
        }
        page.into_text()
    }
}
