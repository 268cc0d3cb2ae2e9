//! What a flow leaves in files: a series for ParaView, checkpoints, a page and pictures.

use super::args::Files;
use crate::called::called;
use crate::numbers::counted;
use crate::printer::Printer;
use crate::series::Series;
use crate::{files, film};
use anyhow::Context;
use pompeiu::core::TriMesh;
use pompeiu::figures::View;
use pompeiu::fluid::FluidStep;
use pompeiu::fluid::request::{Checkpoint, FluidRun, Stage};
use pompeiu::fluid::show::{FluidFrame, FluidPage, Streaks, most_frames};
use pompeiu::io::{Attributes, write_with};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

/// How long a run may be that is lost at most, where a checkpoint is asked for.
const BETWEEN_CHECKPOINTS: Duration = Duration::from_mins(1);

pub(super) struct Outputs<'f> {
    files: &'f Files,
    printer: &'f Printer,
    mesh: &'f TriMesh,
    streaks: Option<Streaks<'f>>,
    series: Option<Series>,
    frames: Vec<FluidFrame>,
    asked: usize,
    saved: Instant,
    /// Why a checkpoint could not be written.
    error: Option<anyhow::Error>,
}

impl<'f> Outputs<'f> {
    pub(super) fn new(
        files: &'f Files,
        printer: &'f Printer,
        (mesh, streaks): (&'f TriMesh, Option<Streaks<'f>>),
        series: Option<Series>,
        asked: usize,
    ) -> Self {
        let (frames, saved) = (Vec::new(), Instant::now());
        Self { files, printer, mesh, streaks, series, frames, asked, saved, error: None }
    }

    /// Takes the flow over as it is after a step.
    pub(super) fn add(&mut self, stage: &Stage<'_>, steps: &[FluidStep]) -> ControlFlow<()> {
        let done = steps.len() - 1;
        if self.files.shows() && (done.is_multiple_of(self.stride(stage)) || done == self.asked) {
            self.frames.push(self.frame(stage));
        }
        let series = self.series.as_ref().filter(|_| done.is_multiple_of(self.files.every.get()));
        if let Some(series) = series {
            series.add(done, stage.time(), |path| write_step(stage, path, self.mesh))?;
        }
        if done < self.asked && self.saved.elapsed() >= BETWEEN_CHECKPOINTS {
            self.saved = Instant::now();
            if let Err(error) = self.save(stage, steps) {
                self.error = Some(error);
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }

    /// Writes what is left at the end, whatever ended the run.
    pub(super) fn finish(mut self, run: &FluidRun<'_>) -> anyhow::Result<()> {
        if let Some(series) = self.series.take() {
            series.finish(self.printer)?;
        }
        self.error.take().map_or(Ok(()), Err)?;
        self.save(&run.stage, &run.report.steps)?;
        if run.failure.is_some() {
            return Ok(());
        }
        if self.frames.last().is_some_and(|frame| frame.step + 1 != run.report.steps.len()) {
            self.frames.push(self.frame(&run.stage));
        }
        self.show(run)
    }

    fn stride(&self, stage: &Stage<'_>) -> usize {
        let values = 1 + stage.scheme().densities.len();
        self.asked.div_ceil(most_frames(self.mesh.positions().len(), values)).max(1)
    }

    fn frame(&self, stage: &Stage<'_>) -> FluidFrame {
        match (stage, &self.streaks) {
            (Stage::Surface(fluid, _), Some(streaks)) => FluidFrame::new(fluid.state(), streaks),
            (Stage::Square(square), _) => FluidFrame::of_square(square),
            (Stage::Surface(..), None) => FluidFrame::default(),
        }
    }

    fn save(&self, stage: &Stage<'_>, steps: &[FluidStep]) -> anyhow::Result<()> {
        let Some(path) = &self.files.checkpoint else { return Ok(()) };
        let checkpoint = Checkpoint::new(self.mesh, &stage.scheme(), stage.store(), steps)?;
        files::write_whole(path, &checkpoint.to_bytes()?, self.printer)
    }

    /// Writes the page and the pictures.
    fn show(&self, run: &FluidRun<'_>) -> anyhow::Result<()> {
        let (picture, in_square) = (&self.files.picture, self.streaks.is_none());
        // The square is looked at from the front, unless somebody wants it otherwise.
        let front = |view: View| match picture.from {
            None if in_square => view.with_direction_to_eye([0.0, 0.0, 1.0]),
            _ => view,
        };
        let name = self.files.mesh.as_deref().filter(|_| !in_square).map(|path| path.display().to_string());
        let page = FluidPage {
            path: name.as_deref().unwrap_or("square"),
            mesh: self.mesh,
            scheme: &run.report.scheme,
            steps: &run.report.steps,
            frames: &self.frames,
            up: (!in_square).then(|| picture.up.axis()),
            command: Some(&called()),
        };
        if let Some(video) = &self.files.video {
            let ((width, height), theme) = (picture.image_size, picture.theme);
            let draw = |frame| page.image(frame, width, height, theme.into(), front(picture.view()));
            film::write(video, || page.html(), self.frames.len(), draw, self.printer)?;
        }
        let last = self.frames.len().saturating_sub(1);
        picture.write(
            || page.html(),
            |width, height, theme, view| page.image(last, width, height, theme, front(view)),
            self.printer,
        )?;
        let Some(folder) = &self.files.frames else { return Ok(()) };
        std::fs::create_dir(folder).with_context(|| folder.display().to_string())?;
        for frame in 0..self.frames.len() {
            let png = picture
                .png(|width, height, theme, view| page.image(frame, width, height, theme, front(view)))?;
            pompeiu::io::write_whole(folder.join(format!("frame-{frame:05}.png")), &png)?;
        }
        self.printer.note(format_args!("{}: {}", folder.display(), counted(self.frames.len(), "picture")));
        Ok(())
    }
}

/// Writes the flow as it is.
fn write_step(stage: &Stage<'_>, path: &Path, mesh: &TriMesh) -> anyhow::Result<()> {
    let (mut attributes, densities): (_, Vec<Vec<f64>>) = match stage {
        Stage::Surface(fluid, surface) => {
            let state = fluid.state();
            let velocity = state.velocity.entries().map(|(face, &u)| surface.to_space(face, u)).collect();
            let attributes = Attributes::for_mesh(mesh)
                .with_vertex_scalar("vorticity", state.vorticity.to_vec())?
                .with_vertex_scalar("stream_function", state.stream.to_vec())?
                .with_face_vector("velocity", velocity)?;
            (attributes, state.densities.iter().map(|values| values.to_vec()).collect())
        }
        Stage::Square(square) => {
            let [u, v] = [0, 1].map(|k| square.velocity().iter().map(|u| u[k]).collect());
            let attributes = Attributes::for_mesh(mesh)
                .with_vertex_scalar("vorticity", square.vorticity())?
                .with_vertex_scalar("velocity_along_x", u)?
                .with_vertex_scalar("velocity_along_y", v)?;
            (attributes, square.densities().to_vec())
        }
    };
    for (name, values) in stage.scheme().densities.iter().zip(densities) {
        let named = attributes.with_vertex_scalar(name, values);
        attributes = named.with_context(|| format!("density \"{name}\""))?;
    }
    Ok(write_with(path, mesh, &attributes)?)
}
