//! What a run leaves in files: a series for ParaView, checkpoints, a page.

use super::args::Files;
use crate::called::called;
use crate::printer::Printer;
use crate::series::Series;
use crate::{files, film};
use pompeiu::contact::request::{Checkpoint, ContactRun};
use pompeiu::contact::show::ContactFrames;
use pompeiu::contact::{ContactStep, Simulation};
use pompeiu::figures::{Theme, View};
use pompeiu::io::{Attributes, write_with};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

/// How long a run may be that is lost at most, where a checkpoint is asked for.
const BETWEEN_CHECKPOINTS: Duration = Duration::from_mins(1);

/// Pixels in a row and rows of moving pictures.
const FILM_SIZE: [u32; 2] = [1280, 720];

pub(super) struct Outputs<'f> {
    files: &'f Files,
    printer: &'f Printer,
    series: Option<Series>,
    frames: ContactFrames,
    saved: Instant,
    /// Why a checkpoint could not be written.
    error: Option<anyhow::Error>,
}

impl<'f> Outputs<'f> {
    pub(super) fn new(files: &'f Files, printer: &'f Printer, series: Option<Series>) -> Self {
        let (frames, saved) = (ContactFrames::default(), Instant::now());
        Self { files, printer, series, frames, saved, error: None }
    }

    /// Takes the bodies over as they are after a step.
    pub(super) fn add(&mut self, simulation: &Simulation, steps: &[ContactStep]) -> ControlFlow<()> {
        let done = steps.len();
        if self.is_shown() {
            self.frames.add(simulation);
        }
        let series = self.series.as_ref().filter(|_| done.is_multiple_of(self.files.every.get()));
        if let Some(series) = series {
            series.add(done, simulation.time(), |path| write_step(simulation, path))?;
        }
        if self.saved.elapsed() >= BETWEEN_CHECKPOINTS {
            self.saved = Instant::now();
            if let Err(error) = self.save(simulation, steps) {
                self.error = Some(error);
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }

    /// Writes what is left at the end, whatever ended the run.
    pub(super) fn finish(mut self, run: &ContactRun) -> anyhow::Result<()> {
        if let Some(series) = self.series.take() {
            series.finish(self.printer)?;
        }
        self.error.take().map_or(Ok(()), Err)?;
        self.save(&run.simulation, &run.report.steps)?;
        if !self.is_shown() {
            return Ok(());
        }
        let command = called();
        let page = run.page(&self.frames, Some(&command));
        if let Some(path) = &self.files.report {
            files::write_whole(path, page.html()?.as_bytes(), self.printer)?;
        }
        let Some(path) = &self.files.video else { return Ok(()) };
        let [width, height] = FILM_SIZE;
        let draw = |frame| page.image(frame, width, height, Theme::Light, View::default());
        film::write(path, || page.html(), self.frames.frames().len(), draw, self.printer)
    }

    fn is_shown(&self) -> bool {
        self.files.video.is_some() || self.files.report.is_some()
    }

    fn save(&self, simulation: &Simulation, steps: &[ContactStep]) -> anyhow::Result<()> {
        let Some(path) = &self.files.checkpoint else { return Ok(()) };
        let checkpoint = Checkpoint::new(simulation, steps)?;
        files::write_whole(path, &checkpoint.to_bytes()?, self.printer)
    }
}

/// Writes the surfaces as they are, with velocities.
fn write_step(simulation: &Simulation, path: &Path) -> anyhow::Result<()> {
    let mesh = simulation.mesh()?;
    let [x, y, z] = [0, 1, 2].map(|k| simulation.velocities().iter().map(|v| v[k]).collect());
    let attributes = Attributes::for_mesh(&mesh)
        .with_vertex_scalar("velocity_along_x", x)?
        .with_vertex_scalar("velocity_along_y", y)?
        .with_vertex_scalar("velocity_along_z", z)?;
    Ok(write_with(path, &mesh, &attributes)?)
}
