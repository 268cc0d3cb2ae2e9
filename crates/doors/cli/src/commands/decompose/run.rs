//! Runs the command.

use super::args::{Boundary, Decompose, Splitting};
use super::text::{Report, Split};
use crate::called::called;
use crate::exit::Exit;
use crate::field::{self, FieldSource};
use crate::files;
use crate::printer::Printer;
use anyhow::{Context, bail};
use pompeiu::core::mesh::{unreferenced_vertices, without_unreferenced};
use pompeiu::fields::show::DecompositionPage;
use pompeiu::fields::{DecompositionOptions, DegreesOfFreedom, HodgeSolver};
use pompeiu::operators;
use pompeiu::surface::EmbeddedSurface;
use std::path::{Path, PathBuf};
use std::time::Instant;

pub(crate) fn run(args: &Decompose, printer: &Printer) -> anyhow::Result<Exit> {
    let source = args.field.as_deref().map(|text| FieldSource::parse(text, "--field")).transpose()?;
    if let Some(output) = &args.output {
        super::output::check(output)?;
    }
    if source.is_none() && args.picture.outputs().next().is_some() {
        bail!("--report and --image show a field and its parts; name one with --field");
    }
    let file = source.as_ref().and_then(FieldSource::file);
    // Before what may take long.
    file.map_or(Ok(()), files::check_readable)?;
    let inputs: Vec<&Path> = std::iter::once(args.mesh.as_path()).chain(file).collect();
    let outputs = args.output.iter().map(PathBuf::as_path).chain(args.picture.outputs());
    files::check_places(outputs, &inputs)?;
    let shown = || args.mesh.display().to_string();
    let read = files::read(&args.mesh)?;
    files::warn_of_changes(&args.mesh, &read, printer);
    let mut mesh = read.mesh;
    if unreferenced_vertices(&mesh) > 0 {
        files::warn_of_unreferenced(&args.mesh, unreferenced_vertices(&mesh), printer);
        mesh = without_unreferenced(&mesh);
    }
    let start = Instant::now();
    let surface = EmbeddedSurface::new(&mesh).with_context(shown)?;
    let splitting = match args.splitting {
        Splitting::Primal => operators::Splitting::Primal,
        Splitting::Dual => operators::Splitting::Dual,
    };
    let boundary = match args.boundary {
        Boundary::Tangential => operators::Boundary::Tangential,
        Boundary::Normal => operators::Boundary::Normal,
    };
    let degrees_of_freedom = DegreesOfFreedom::of(surface.mesh(), boundary);
    let split = match source {
        None => None,
        Some(source) => {
            let options = DecompositionOptions { splitting, boundary };
            let solver = HodgeSolver::new(surface.surface(), &options).with_context(shown)?;
            let harmonic = solver.basis().fields();
            let name = args.name.as_deref();
            let field = field::field(&source, "--field", name, &mesh, &surface, harmonic, printer)?;
            let before = Instant::now();
            let parts = solver.decompose(&field).context("--field")?;
            let (solve, times) = (before.elapsed(), solver.setup_times());
            if let Some(output) = &args.output {
                super::output::write(output, &mesh, &surface, splitting, &field, &parts, printer)?;
            }
            let shown = DecompositionPage {
                path: &shown(),
                mesh: &mesh,
                surface: &surface,
                field: &field,
                parts: &parts,
                degrees_of_freedom,
                up: args.picture.up.axis(),
                command: Some(&called()),
            };
            args.picture.write(
                || shown.html(),
                |width, height, theme, view| shown.image(width, height, theme, view),
                printer,
            )?;
            Some(Split {
                quality: parts.quality,
                factor: times.factor,
                basis: times.basis,
                solve,
                total: start.elapsed(),
            })
        }
    };
    let report = Report::new(shown(), surface.mesh(), degrees_of_freedom, split);
    Printer::answer(&if args.json { report.json()? } else { report.text() })?;
    Ok(Exit::Done)
}
