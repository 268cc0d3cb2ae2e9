//! `pompeiu fluid`.

mod args;
mod output;
mod text;

pub(crate) use crate::door::run;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::numbers::{few, grouped};
use crate::series::Series;
use crate::{field, files, film};
use anyhow::{Context, bail};
pub(crate) use args::Files;
use output::Outputs;
use pompeiu::fluid::FluidStep;
use pompeiu::fluid::request::{FluidReport, FluidRequest, FluidRequestError, Place, Stage, StartReport};
use pompeiu::fluid::show::Streaks;
use pompeiu::operators::FieldSource;
use std::path::{Path, PathBuf};

pub(crate) type Fluid = Invocation<Files>;

/// A share of the energy of an initial velocity that is taken off and worth a note.
const NOTABLE: f64 = 2e-3;

impl System for Files {
    type Request = FluidRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        let inputs = self.mesh.iter().chain(&self.scene).chain(&self.resume);
        files::check_places(self.outputs(), &inputs.map(PathBuf::as_path).collect::<Vec<_>>())?;
        self.video.as_deref().map_or(Ok(()), film::check)?;
        if let Some(folder) = self.frames.as_deref().filter(|folder| folder.exists()) {
            bail!("{}: exists; name a folder that does not, the frames go into it", folder.display());
        }
        Ok(())
    }

    /// The scene; in the square there is no mesh before it.
    fn options_below(&self, is_given: impl Fn(&str) -> bool) -> anyhow::Result<Option<&Path>> {
        match (is_given("square"), &self.mesh, &self.scene) {
            (true, _, Some(second)) => {
                bail!("{}: the square has no mesh; name a scene or none", second.display())
            }
            (true, first, None) => Ok(first.as_deref()),
            (false, _, scene) => Ok(scene.as_deref()),
        }
    }

    fn run(&self, request: &mut FluidRequest, session: &mut Session<'_>) -> anyhow::Result<FluidReport> {
        request.check()?;
        for remark in request.remarks() {
            session.printer.warning(remark);
        }
        let pictures: Vec<&Path> = request.obstacles.iter().map(PathBuf::as_path).collect();
        files::check_places(self.outputs(), &pictures)?;
        let series = self.output.as_deref().map(Series::new).transpose()?;
        let (mesh, surface) = match (request.cells()?, &self.mesh) {
            (Some(cells), _) => {
                session.note_counts(Path::new("square"), [cells.positions().len(), cells.faces().len()]);
                (cells, None)
            }
            (None, Some(path)) => {
                let (mesh, surface) = session.read_surface(path)?;
                (mesh, Some(surface))
            }
            (None, None) => bail!("no mesh is given; name one, or the square with --square"),
        };
        let file = self.mesh.as_deref().filter(|_| surface.is_some()).unwrap_or(Path::new("square"));
        let read = match request.velocity.as_ref().filter(|_| surface.is_some()) {
            Some(source) => field::vectors(source, None)?,
            None => None,
        };
        let resume = match &self.resume {
            Some(path) => {
                files::check_readable(path)?;
                Some(std::fs::read(path).with_context(|| path.display().to_string())?)
            }
            None => None,
        };
        session.wait.show("factoring".to_owned());
        let streaks = surface.as_ref().map(Streaks::new);
        let printer = session.printer;
        let mut outputs = Outputs::new(self, printer, (&mesh, streaks), series, request.asked()?);
        let mut watch = |stage: &Stage<'_>, steps: &[FluidStep]| outputs.add(stage, steps);
        let place = Place { mesh: &mesh, surface: surface.as_ref(), velocity: read.as_deref() };
        let run = request.run(place, resume.as_deref(), &session.context(), &mut watch);
        session.stop_waiting();
        let run = run.map_err(|error| {
            let place = match (&error, &self.resume) {
                (FluidRequestError::Checkpoint(_), Some(state)) => state.as_path(),
                _ => file,
            };
            anyhow::Error::from(error).context(place.display().to_string())
        })?;
        if let Some(limit) = run.report.scheme.curvature_limit {
            printer.warning(limited(limit, run.report.scheme.limited_vertices));
        }
        if let (Some(source), Some(start)) = (&request.velocity, &run.report.start) {
            warn_of(source, start, session);
        }
        outputs.finish(&run)?;
        match run.failure {
            Some(failure) => Err(failure).with_context(|| file.display().to_string()),
            None => Ok(run.report),
        }
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(answer)
    }
}

/// Says why the viscous forces do not contain all curvature.
fn limited(defect: f64, vertices: usize) -> String {
    let (noun, count) = (if vertices == 1 { "vertex" } else { "vertices" }, grouped(vertices as u64));
    format!(
        "angle defects of {count} {noun} count as {} rad, because faces do not resolve the curvature there and viscosity would add energy; \
         smaller faces resolve it (`pompeiu remesh`), and --viscosity-model hodge needs no curvature",
        few(defect)
    )
}

/// Says what was left out of an initial velocity.
fn warn_of(source: &FieldSource, start: &StartReport, session: &Session<'_>) {
    field::warn_of_normal_part(source, (start.is_tangent, start.normal_part), session.printer);
    if start.divergence > NOTABLE {
        let part = 100.0 * start.divergence;
        session
            .printer
            .note(format_args!("velocity: {part:.1} % of its energy was divergence and is taken off"));
    }
}
