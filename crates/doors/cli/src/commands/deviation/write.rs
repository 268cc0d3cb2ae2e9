//! The files of a deviation, written after the answer was printed.

use super::{Files, Paper, csv, meshes};
use crate::aligned;
use crate::called::called;
use crate::door::{AnswerOf, Session};
use crate::files;
use crate::page::{described, left_out};
use pompeiu::figures::paper;
use pompeiu::hausdorff::PreparedPair;
use pompeiu::hausdorff::certificate::AttachedProof;
use pompeiu::hausdorff::show::{DeviationFigures, DeviationPage, search_stages};
use std::path::Path;
use std::time::SystemTime;

pub(super) fn write(
    files: &Files,
    answer: &AnswerOf<Files>,
    (pair, proof): (&PreparedPair<'_>, Option<&AttachedProof>),
    session: &mut Session<'_>,
) -> anyhow::Result<()> {
    let deviation = &answer.report.measured.deviation;
    let extent = deviation.distance.upper();
    let sides = [(&files.output_a, &deviation.a_to_b), (&files.output_b, &deviation.b_to_a)];
    for (path, directed) in sides {
        if let Some(path) = path {
            meshes::write(path, pair.measured(directed.direction), directed, extent, session.printer)?;
        }
    }
    if files.draws() {
        show(files, answer, (pair, proof), session)?;
    }
    if let Some(path) = &files.csv {
        files::write_whole(path, csv::csv(&answer.report.measured).as_bytes(), session.printer)?;
    }
    Ok(())
}

/// Writes the page, the picture and the document.
fn show(
    files: &Files,
    answer: &AnswerOf<Files>,
    (pair, proof): (&PreparedPair<'_>, Option<&AttachedProof>),
    session: &mut Session<'_>,
) -> anyhow::Result<()> {
    let report = &answer.report.measured;
    let unit = &answer.request.deviation.measures.unit;
    session.wait_for("drawing");
    let limits = session.context().limits();
    let stages = if files.picture.report.is_some() { search_stages(pair, &limits) } else { Vec::new() };
    let verdict = report.sentence(files.meshes.names(), unit);
    let command = called();
    let [a, b] = files.meshes.paths().map(|path| path.display().to_string());
    let figures = DeviationPage {
        pair,
        paths: [&a, &b],
        names: files.meshes.names(),
        deviation: &report.deviation,
        stages: &stages,
        unit,
        threshold: report.threshold,
        bands: report.bands.as_ref(),
        verdict: report.verdict.as_ref().map(|found| found.answer).zip(verdict.as_deref()),
        proof,
        up: files.picture.up.axis(),
        command: Some(&command),
    }
    .figures(&session.context().limits());
    if let Some(path) = &files.pdf {
        print(files, answer, &figures, path, session)?;
    }
    let printer = session.printer;
    files.picture.write(
        || figures.html(),
        |width, height, theme, view| figures.image(width, height, theme, view),
        printer,
    )
}

/// Writes the document for printing.
fn print(
    files: &Files,
    answer: &AnswerOf<Files>,
    figures: &DeviationFigures<'_>,
    path: &Path,
    session: &Session<'_>,
) -> anyhow::Result<()> {
    let mut provenance: Vec<_> = files.part.iter().map(|part| ["part".to_owned(), part.clone()]).collect();
    let names = files.meshes.names();
    for ((name, input), path) in names.into_iter().zip(&answer.inputs).zip(files.meshes.paths()) {
        provenance.push([name.to_owned(), described(input)]);
        if let Ok(sum) = files::sha256(path) {
            provenance.push([String::new(), format!("SHA-256 {sum}")]);
        }
    }
    for sentence in left_out(names, answer.report.measured.left_out.as_ref()) {
        provenance.push(["left out".to_owned(), sentence]);
    }
    if let Some(found) = &answer.report.alignment {
        provenance.push(["moved".to_owned(), aligned::verdict(found)]);
    }
    provenance.push(["command".to_owned(), called()]);
    provenance.push(["program".to_owned(), format!("pompeiu {}", env!("CARGO_PKG_VERSION"))]);
    let paper = match files.paper {
        Paper::A4 => paper::Paper::A4,
        Paper::Letter => paper::Paper::Letter,
    };
    let mut document = figures.document(None, &provenance, files.picture.view(), paper)?;
    if let Some(title) = &files.title {
        document.title.clone_from(title);
    }
    if let Some(operator) = &files.operator {
        document.blocks.extend(signature(operator));
    }
    files::write_whole(path, &document.pdf(), session.printer)
}

/// A line to sign on, with today's date.
fn signature(operator: &str) -> [paper::Block; 2] {
    let now = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
    let date = now.split('T').next().unwrap_or_default();
    let columns = [("date (UTC)", 1.0), ("operator", 2.0), ("signature", 3.0)];
    let row = [date, operator, "________________________________"];
    [
        paper::Block::Heading("Signed".to_owned()),
        paper::Block::Table {
            columns: columns.map(|(name, share)| (name.to_owned(), share)).to_vec(),
            rows: vec![row.map(str::to_owned).to_vec()],
        },
    ]
}
