//! `pompeiu deviation`.

mod csv;
mod full;
mod meshes;
mod text;
mod write;

use crate::aligned;
use crate::args::{Meshes, Picture, suffix};
use crate::certificate;
use crate::door::{self, AnswerOf, Invocation, ReportOf, Session, System, Writes};
use crate::exit::Exit;
use crate::numbers::{few, time};
use crate::page::Page;
use crate::pair;
use crate::printer::Printer;
use anyhow::bail;
use clap::{Args, ValueEnum};
use pompeiu::core::geom::Aabb;
use pompeiu::hausdorff::certificate::AttachedProof;
use pompeiu::hausdorff::{
    DeviationReport, DirectedDeviation, Direction, Enclosure, NamedFaces, PreparedPair, deviation, digits,
};
use pompeiu::io::Group;
use pompeiu::matching::request::{AlignedDeviationReport, AlignedDeviationRequest};
use std::path::{Path, PathBuf};
use std::time::Duration;

pub(crate) type Deviation = Invocation<Files>;

pub(crate) fn run(invocation: &Deviation, printer: &Printer) -> anyhow::Result<Exit> {
    door::run_and_write(invocation, printer)
}

#[derive(Args)]
#[command(after_help = "\
With A as it should be and B as it is: what of A is far from B is missing on B (A to B), what of B is far from
A is excess material (B to A). Percentiles, mean and root mean square weigh by area; every number is an interval
that is proven to hold the value for all points of all faces, not for samples of them.

Meshes written with -a and -b carry the distance of each vertex, and for each face what is proven of its largest
and its mean distance, where the format has a place for them: PLY, VTP and VTU. GLB, OBJ and OFF hold colours.

Exit codes:
  0  done; with --within or --band: proven to be within tolerance
  1  with --within or --band: proven to be out of tolerance
  2  a file or an argument cannot be used
  3  the time or memory limit ran out first, or the tolerance is undecided; what is printed holds, but is wider than asked;
     or the certificate could not be written

Examples:
  pompeiu deviation model.obj scan.ply
  pompeiu deviation --model part.stl --scan part.ply --align rigid --within 0.05 --report scan.html
  pompeiu deviation model.obj scan.ply --within 0.1mm --unit mm --allow 1%
  pompeiu deviation model.obj scan.ply --unit mm --band -0.05..0.1 --band -0.2..0.3
  pompeiu deviation model.obj partial-scan.ply --only-overlap --ignore-components 0.1% --within 0.05
  pompeiu deviation model.obj scan.ply --signed -a model.vtp -b scan.vtp
  pompeiu deviation model.obj scan.ply --within 0.05 --report scan.html --pdf scan.pdf --certificate proof.phc
  pompeiu deviation model.obj scan.ply --json")]
pub(crate) struct Files {
    #[command(flatten)]
    meshes: Meshes,
    #[command(flatten)]
    picture: Picture,
    /// Write the verdict, the picture, the numbers and what was measured for printing
    #[arg(long, value_parser = suffix::document, value_name = "FILE.pdf")]
    pdf: Option<PathBuf>,
    /// The size of the paper
    #[arg(long, value_enum, default_value_t, requires = "pdf")]
    paper: Paper,
    /// What the document is called
    #[arg(long, requires = "pdf", value_name = "TEXT")]
    title: Option<String>,
    /// The name or number of the part that was measured, for the document
    #[arg(long, requires = "pdf", value_name = "TEXT")]
    part: Option<String>,
    /// Who measured, for the document; it then ends with the date and a line to sign on
    #[arg(long, requires = "pdf", value_name = "NAME")]
    operator: Option<String>,
    /// Write A, coloured by its distance from B
    #[arg(long, short = 'a', value_name = "FILE")]
    output_a: Option<PathBuf>,
    /// Write B, coloured by its distance from A
    #[arg(long, short = 'b', value_name = "FILE")]
    output_b: Option<PathBuf>,
    /// Write the statistics as comma-separated values
    #[arg(long, value_parser = suffix::table, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a file from which anybody can prove the largest distances anew, see `pompeiu verify`; pages and documents name it, with its
    /// SHA-256 sum
    #[arg(long, value_parser = suffix::certificate, value_name = "FILE")]
    certificate: Option<PathBuf>,
    /// Print everything: all percentiles of both directions taken together, all regions, all digits that are certain
    #[arg(long)]
    full: bool,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum Paper {
    #[default]
    A4,
    Letter,
}

impl Files {
    /// Whether figures follow, for which trees are kept.
    fn draws(&self) -> bool {
        self.picture.outputs().next().is_some() || self.pdf.is_some()
    }

    fn outputs(&self) -> impl Iterator<Item = &Path> {
        let files = [&self.output_a, &self.output_b, &self.csv, &self.pdf, &self.certificate];
        files.into_iter().flatten().map(PathBuf::as_path).chain(self.picture.outputs())
    }
}

impl System for Files {
    type Request = AlignedDeviationRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        let paths = self.meshes.paths();
        pair::check(paths)?;
        for path in [&self.output_a, &self.output_b].into_iter().flatten() {
            meshes::check(path)?;
        }
        crate::files::check_places(self.outputs(), &paths)
    }

    fn run(
        &self,
        request: &mut AlignedDeviationRequest,
        session: &mut Session<'_>,
    ) -> anyhow::Result<AlignedDeviationReport> {
        Ok(self.find(request, session)?.0)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        let names = self.meshes.names();
        let mut text = if self.full { full::text(names, answer) } else { text::text(names, answer) };
        if let Some((path, answer)) =
            self.certificate.as_ref().zip(answer.report.measured.certificate.as_ref())
        {
            text.push_str(&certificate::text(path, answer));
            text.push('\n');
        }
        text
    }
}

impl Writes for Files {
    type Found = (PreparedPair<'static>, Option<AttachedProof>);

    fn find(
        &self,
        request: &mut AlignedDeviationRequest,
        session: &mut Session<'_>,
    ) -> anyhow::Result<(ReportOf<Self>, Self::Found)> {
        request.deviation.check()?;
        self.check_certificate(request)?;
        let paths = self.meshes.paths();
        if self.meshes.look_swapped() {
            session.printer.note(format_args!(
                "note: {} is taken as it should be and {} as it is; --model and --scan name them in any order",
                paths[0].display(),
                paths[1].display()
            ));
        }
        let [a, b] = session.read_pair_with_groups(paths)?;
        let groups = [named(&a.groups), named(&b.groups)];
        let pair = PreparedPair::new(a.mesh, b.mesh).keeping(self.draws());
        session.wait.show("building trees".to_owned());
        let context = session.context();
        let (pair, mut report) = request
            .run(pair, [&groups[0], &groups[1]], &context, None)
            .map_err(|error| pair::in_files(paths, error))?;
        let proof = self.certify(&mut report.measured, &pair, session)?;
        session.stop_waiting();
        self.warn(&report, &pair, session.printer);
        Ok((report, (pair, proof)))
    }

    fn write(
        &self,
        answer: &AnswerOf<Self>,
        (pair, proof): Self::Found,
        session: &mut Session<'_>,
    ) -> anyhow::Result<()> {
        write::write(self, answer, (&pair, proof.as_ref()), session)
    }

    fn closing(&self, answer: &AnswerOf<Self>, total: Duration, writing: Duration) -> String {
        let deviation = &answer.report.measured.deviation;
        let sum = |part: fn(&DirectedDeviation) -> Duration| {
            time(directions(deviation).map(|(_, directed)| part(directed)).iter().sum())
        };
        let read = time(answer.timing.read);
        let [build, search, refine] = [sum(|d| d.work.build), sum(|d| d.work.search), sum(|d| d.work.refine)];
        let files = if self.outputs().next().is_some() {
            format!("files {}, ", time(writing))
        } else {
            String::new()
        };
        let mut page = Page::new();
        let total = time(total);
        page.row(
            "time",
            &format!("read {read}, build {build}, search {search}, refine {refine}, {files}total {total}"),
        );
        page.into_text()
    }
}

/// The share of an area beyond a threshold, and the part of the size of a mesh as its mean distance, above which two meshes are probably
/// not aligned.
const NEARLY_ALL: f64 = 0.9;
const FAR: f64 = 0.1;

impl Files {
    /// Refuses a certificate of what is not in the files.
    fn check_certificate(&self, request: &AlignedDeviationRequest) -> anyhow::Result<()> {
        let why = if request.align.is_some() {
            "--align moves B; write the moved mesh with `pompeiu align` and compare that"
        } else if !request.deviation.parts.is_empty() {
            "parts of them were to be left out; write what is to be measured as a mesh of its own"
        } else {
            return Ok(());
        };
        if self.certificate.is_some() {
            bail!("a certificate is about all triangles in the files, but {why}");
        }
        Ok(())
    }

    /// Writes the certificate, and checks it where something is drawn that names it.
    fn certify(
        &self,
        report: &mut DeviationReport,
        pair: &PreparedPair<'_>,
        session: &Session<'_>,
    ) -> anyhow::Result<Option<AttachedProof>> {
        let Some(path) = &self.certificate else { return Ok(None) };
        let meshes = [pair.a(), pair.b()];
        let answer =
            certificate::write(path, session, |options, into| report.certify(meshes, options, into))?;
        let proof = if self.draws() { certificate::attached(path, meshes, &answer, session)? } else { None };
        report.certificate = Some(answer);
        Ok(proof)
    }

    /// Warns of what makes an answer useless more often than not.
    fn warn(&self, report: &AlignedDeviationReport, pair: &PreparedPair<'_>, printer: &Printer) {
        if let Some(found) = &report.alignment {
            aligned::warn(self.meshes.paths(), found, printer);
        }
        let [a, b] = self.meshes.names();
        for outlier in &report.measured.outliers {
            let name = if outlier.direction == Direction::AToB { a } else { b };
            printer.warning(format_args!(
                "the largest distance is that of a part with {} % of {name}'s area; all larger parts are within {}. \
                 --ignore-components 1% leaves such parts out",
                few(100.0 * outlier.share),
                few(outlier.others_within)
            ));
        }
        let is_beyond = |(_, directed): (_, &DirectedDeviation)| {
            let above = directed.statistics.as_ref().and_then(|statistics| statistics.above.as_ref());
            above.is_some_and(|above| above.share.lower() > NEARLY_ALL)
        };
        let is_far = |(_, directed): (_, &DirectedDeviation)| {
            let size = Aabb::of_faces(pair.measured(directed.direction)).diagonal();
            directed.statistics.as_ref().is_some_and(|statistics| statistics.mean.lower() > FAR * size)
        };
        if let Some(gain) = report.misplaced {
            return printer.warning(format_args!(
                "as it lies, half of {b} is farther than {} from {a}; turned and moved it would be within {}: the poses do not fit, \
                 and --align rigid moves {b} onto {a} first",
                few(gain.as_it_lies),
                few(gain.aligned)
            ));
        }
        let both = directions(&report.measured.deviation);
        let apart = if both.into_iter().all(is_beyond) {
            "more than 90 % of both areas are beyond the threshold"
        } else if report.alignment.is_none() && both.into_iter().all(is_far) {
            "both surfaces are on average farther from each other than a tenth of their size"
        } else {
            return;
        };
        printer.warning(format_args!(
            "{apart}; if the meshes are not aligned, --align rigid moves {b} onto {a} first"
        ));
    }
}

fn named(groups: &[Group]) -> Vec<NamedFaces> {
    let named = |group: &Group| NamedFaces { name: group.name.clone(), faces: group.faces.clone() };
    groups.iter().map(named).collect()
}

/// Both directions, with their keys.
fn directions(deviation: &deviation::Deviation) -> [(&'static str, &DirectedDeviation); 2] {
    [("a_to_b", &deviation.a_to_b), ("b_to_a", &deviation.b_to_a)]
}

/// A share of the area as a percentile is called.
fn percent(share: f64) -> String {
    // Shares come from percent: what rounding left over is not shown.
    let percent = (share * 1e12).round() / 1e10;
    format!("{percent}")
}

/// A share of the area in percent, rounded outwards to two decimals.
fn percentage(share: Enclosure) -> String {
    digits::percentage(share.lower(), share.upper())
}
