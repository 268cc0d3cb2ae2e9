//! Runs the command.

use super::args::Deviation;
use super::verdict::Verdict;
use super::{bands, csv, full, json, meshes, parts, text};
use crate::aligned;
use crate::called::called;
use crate::exit::Exit;
use crate::files;
use crate::interrupt;
use crate::numbers::{between, few};
use crate::pair::{self, File};
use crate::printer::Printer;
use crate::wait::Wait;
use pompeiu::core::TriMesh;
use pompeiu::figures::paper::Paper;
use pompeiu::hausdorff::deviation::{self, BandReport, Bands, DeviationOptions, DirectedDeviation, LeftOut};
use pompeiu::hausdorff::show::{DeviationFigures, DeviationPage, NamedMesh, search_stages};
use pompeiu::hausdorff::{Direction, Observer, Progress};
use pompeiu::matching::align::Registration;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Everything there is to report.
pub(super) struct Outcome {
    /// What the two are called.
    pub(super) names: [&'static str; 2],
    pub(super) a: File,
    pub(super) b: File,
    /// How B was moved, if it was.
    pub(super) alignment: Option<Registration>,
    pub(super) unit: String,
    pub(super) accuracy: f64,
    pub(super) threshold: Option<f64>,
    /// The share of each area that may be farther, or outside of all bands.
    pub(super) allowed: f64,
    /// What was left out of A and of B, if something was to be.
    pub(super) left_out: Option<[LeftOut; 2]>,
    /// How much lies in which tolerance band, if there are some.
    pub(super) bands: Option<BandReport>,
    pub(super) deviation: deviation::Deviation,
    pub(super) read: Duration,
    pub(super) total: Duration,
}

impl Outcome {
    /// Whether both are within the threshold or the bands, if there are any.
    pub(super) fn verdict(&self) -> Option<Verdict> {
        if let Some(found) = &self.bands {
            return Some(bands::verdict(found, self.allowed));
        }
        self.threshold.map(|threshold| Verdict::of(&self.deviation, threshold, self.allowed))
    }
}

pub(crate) fn run(args: &Deviation, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let threshold = args.threshold.as_ref().map(|length| length.in_unit(&args.unit)).transpose()?;
    let bands = tolerated(args)?;
    let paths = args.meshes.paths();
    pair::check([paths[0], paths[1]])?;
    if args.meshes.look_swapped() {
        printer.note(format_args!(
            "note: {} is taken as it should be and {} as it is; --model and --scan name them in any order",
            paths[0].display(),
            paths[1].display()
        ));
    }
    let outputs = [&args.output_a, &args.output_b];
    for path in outputs.into_iter().flatten() {
        meshes::check(path)?;
    }
    let written = outputs.into_iter().chain([&args.csv, &args.pdf]).flatten().map(PathBuf::as_path);
    files::check_places(written.chain(args.picture.outputs()), &paths)?;
    args.limits.apply_threads()?;
    let wait = Wait::new(printer);
    let [a, b] = pair::read_files(paths, (&args.limits, started), &wait, printer)?;
    let groups = [&a.groups[..], &b.groups[..]];
    let (a, mut b) = (a.mesh, b.mesh);
    let read = started.elapsed();
    interrupt::listen();
    let mut alignment = None;
    if let Some(before) = args.align {
        let (moved, found) = before.align(paths, [&a, &b], &args.limits.after(read), &wait, printer)?;
        (b, alignment) = (moved, Some(found));
    }
    wait.show("building trees".to_owned());
    let chosen = args.parts.choose([&a, &b], groups, &args.unit, &args.limits.after(started.elapsed()))?;
    let [a_part, b_part] = match &chosen {
        Some([a_part, b_part]) => [&a_part.mesh, &b_part.mesh],
        None => [&a, &b],
    };
    let farthest = chosen.as_ref().map_or([None; 2], |[a, b]| [a.farthest, b.farthest]);
    let deviation =
        DeviationOptions { observer: Some(&Watch(&wait)), ..options(args, threshold, started.elapsed()) }
            .symmetric_of_parts([a_part, &a], [b_part, &b], farthest)?;
    let bands = bands.map(|bands| {
        wait.restart();
        let limits = args.limits.after(started.elapsed());
        deviation.bands_of_parts(
            [a_part, &a],
            [b_part, &b],
            &bands,
            args.accuracy,
            &limits,
            Some(&Watch(&wait)),
        )
    });
    drop(wait);
    warn(&deviation, [a_part, b_part], args.meshes.names(), printer);
    let mut outcome = Outcome {
        names: args.meshes.names(),
        a: File::new(paths[0], &a),
        b: File::new(paths[1], &b),
        alignment,
        unit: args.unit.clone(),
        accuracy: args.accuracy,
        threshold,
        allowed: args.allow.unwrap_or(0.0),
        left_out: chosen.as_ref().map(|[a, b]| [a.left_out, b.left_out]),
        bands,
        deviation,
        read,
        total: started.elapsed(),
    };
    let measured = [NamedPart { part: a_part, whole: &a }, NamedPart { part: b_part, whole: &b }];
    write(args, &outcome, measured, printer)?;
    if let Some([a, b]) = &chosen {
        outcome.deviation.a_to_b.renumber(&a.faces);
        outcome.deviation.b_to_a.renumber(&b.faces);
    }
    Printer::answer(&match (args.json, args.full) {
        (true, _) => json::json(&outcome)?,
        (false, true) => full::text(&outcome),
        (false, false) => text::text(&outcome),
    })?;
    let stops = [&outcome.deviation.a_to_b, &outcome.deviation.b_to_a]
        .map(|directed| directed.stop.is_early() || directed.distance.stop.is_early());
    Ok(match outcome.verdict() {
        Some(verdict) => verdict.exit(),
        None if stops.contains(&true) => Exit::Undecided,
        None => Exit::Done,
    })
}

/// The tolerance bands that were given.
fn tolerated(args: &Deviation) -> anyhow::Result<Option<Bands>> {
    if args.band.is_empty() {
        return Ok(None);
    }
    let ends: Vec<[f64; 2]> =
        args.band.iter().map(|band| band.in_unit(&args.unit)).collect::<anyhow::Result<_>>()?;
    Ok(Some(Bands::new(&ends)?))
}

fn options(args: &Deviation, threshold: Option<f64>, spent: Duration) -> DeviationOptions<'static> {
    DeviationOptions {
        accuracy: args.accuracy,
        threshold,
        percentiles: args.percentiles.0.clone(),
        regions: args.regions,
        signed: args.signed || !args.band.is_empty(),
        limits: args.limits.after(spent),
        ..DeviationOptions::default()
    }
}

/// A part that was measured, and the mesh that the other one was measured to.
#[derive(Clone, Copy)]
struct NamedPart<'p> {
    part: &'p TriMesh,
    whole: &'p TriMesh,
}

/// Shares of the area below which a component is junk, and above which two meshes are probably not aligned.
const JUNK: f64 = 0.01;
const NEARLY_ALL: f64 = 0.9;

/// Warns of what makes an answer useless more often than not.
fn warn(deviation: &deviation::Deviation, parts: [&TriMesh; 2], names: [&str; 2], printer: &Printer) {
    let mut beyond = true;
    for ((_, directed), (mesh, name)) in directions(deviation).into_iter().zip(parts.into_iter().zip(names)) {
        if let Some((share, within)) = directed.outlying_component(mesh, JUNK) {
            printer.warning(format_args!(
                "the largest distance is that of a part with {} % of {name}'s area; all larger parts are within {}. \
                 --ignore-components 1% leaves such parts out",
                few(100.0 * share),
                few(within)
            ));
        }
        let above = directed.statistics.as_ref().and_then(|statistics| statistics.above.as_ref());
        beyond &= above.is_some_and(|above| above.share.lower() > NEARLY_ALL);
    }
    if beyond {
        printer.warning(format_args!(
            "more than 90 % of both areas are beyond the threshold; if the meshes are not aligned, --align rigid moves B onto A first"
        ));
    }
}

fn write(
    args: &Deviation,
    outcome: &Outcome,
    measured: [NamedPart<'_>; 2],
    printer: &Printer,
) -> anyhow::Result<()> {
    let [a, b] = measured.map(|measured| measured.part);
    let Outcome { deviation, .. } = outcome;
    let extent = deviation.distance.upper();
    let sides: [(&Option<_>, _, _); 2] =
        [(&args.output_a, a, &deviation.a_to_b), (&args.output_b, b, &deviation.b_to_a)];
    for (path, mesh, directed) in sides {
        if let Some(path) = path {
            meshes::write(path, mesh, directed, extent, printer)?;
        }
    }
    if args.picture.outputs().next().is_some() || args.pdf.is_some() {
        show(args, outcome, measured, printer)?;
    }
    if let Some(path) = &args.csv {
        files::write_whole(path, csv::csv(outcome).as_bytes(), printer)?;
    }
    Ok(())
}

/// Writes the page and the picture.
fn show(
    args: &Deviation,
    outcome: &Outcome,
    [a, b]: [NamedPart<'_>; 2],
    printer: &Printer,
) -> anyhow::Result<()> {
    // The search is that of whole meshes.
    let is_wanted = args.picture.report.is_some() && outcome.left_out.is_none();
    let stages = if is_wanted { search_stages(a.whole, b.whole) } else { Vec::new() };
    let verdict = outcome.verdict().map(|verdict| verdict.sentence(outcome));
    let command = called();
    let shown = DeviationPage {
        a: NamedMesh { path: &outcome.a.path, mesh: a.part, whole: a.whole },
        b: NamedMesh { path: &outcome.b.path, mesh: b.part, whole: b.whole },
        deviation: &outcome.deviation,
        stages: &stages,
        unit: &outcome.unit,
        threshold: outcome.threshold,
        bands: outcome.bands.as_ref(),
        verdict: verdict.as_deref(),
        up: args.picture.up.axis(),
        command: Some(&command),
    }
    .figures();
    if let Some(path) = &args.pdf {
        print(args, outcome, &shown, verdict.clone(), path, printer)?;
    }
    args.picture.write(
        || shown.html(),
        |width, height, theme, view| shown.image(width, height, theme, view),
        printer,
    )
}

/// Writes the document for printing.
fn print(
    args: &Deviation,
    outcome: &Outcome,
    shown: &DeviationFigures<'_>,
    verdict: Option<String>,
    path: &Path,
    printer: &Printer,
) -> anyhow::Result<()> {
    let mut provenance = Vec::new();
    for (name, (file, path)) in
        outcome.names.into_iter().zip([&outcome.a, &outcome.b].into_iter().zip(args.meshes.paths()))
    {
        provenance.push([name.to_owned(), file.described()]);
        if let Ok(sum) = files::sha256(path) {
            provenance.push([String::new(), format!("SHA-256 {sum}")]);
        }
    }
    for (name, left_out) in outcome.names.into_iter().zip(outcome.left_out.iter().flatten()) {
        provenance.push(["left out".to_owned(), parts::described(name, left_out)]);
    }
    if let Some(found) = &outcome.alignment {
        provenance.push(["moved".to_owned(), aligned::verdict(found)]);
    }
    provenance.push(["command".to_owned(), called()]);
    provenance.push(["program".to_owned(), format!("pompeiu {}", env!("CARGO_PKG_VERSION"))]);
    let paper = match args.paper {
        super::args::Paper::A4 => Paper::A4,
        super::args::Paper::Letter => Paper::Letter,
    };
    let document = shown.document(verdict, &provenance, args.picture.view(), paper)?;
    files::write_whole(path, &document.pdf(), printer)
}

/// Moves the progress bar.
struct Watch<'w>(&'w Wait);

impl Observer for Watch<'_> {
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        let ends = match progress.direction {
            Direction::AToB => "A to B",
            Direction::BToA => "B to A",
        };
        self.0.advance(
            format!("{ends}: {}", between(progress.lower, progress.upper)),
            [progress.examined, progress.examined.saturating_add(progress.left)],
        );
        interrupt::flow()
    }
}

/// Both directions, with their keys.
pub(super) fn directions(deviation: &deviation::Deviation) -> [(&'static str, &DirectedDeviation); 2] {
    [("a_to_b", &deviation.a_to_b), ("b_to_a", &deviation.b_to_a)]
}

/// A share of the area as a percentile is called.
pub(super) fn percent(share: f64) -> String {
    // Shares come from percent: what rounding left over is not shown.
    let percent = (share * 1e12).round() / 1e10;
    format!("{percent}")
}
