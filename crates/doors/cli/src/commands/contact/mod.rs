//! `pompeiu contact`.

mod args;
mod output;
mod text;

pub(crate) use crate::door::run;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::series::Series;
use crate::{files, film};
use anyhow::Context;
pub(crate) use args::Files;
use output::Outputs;
use pompeiu::contact::request::{BodyMesh, ContactRequestError};
use pompeiu::contact::{ContactReport, ContactRequest, ContactStep, Scene, Simulation};
use pompeiu::io::{SurfaceOrSolid, read_surface_or_solid};
use std::path::{Path, PathBuf};

pub(crate) type Contact = Invocation<Files>;

impl System for Files {
    type Request = ContactRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        let outputs = self.output.iter().chain(&self.checkpoint).chain(&self.video).chain(&self.report);
        let inputs: Vec<&Path> = std::iter::once(&self.scene)
            .chain(&self.meshes)
            .chain(&self.resume)
            .map(PathBuf::as_path)
            .collect();
        self.video.as_deref().map_or(Ok(()), film::check)?;
        files::check_places(outputs.map(PathBuf::as_path), &inputs)
    }

    fn run(&self, request: &mut ContactRequest, session: &mut Session<'_>) -> anyhow::Result<ContactReport> {
        let scene = Scene::named(&self.scene)?;
        let series = self.output.as_deref().map(Series::new).transpose()?;
        session.note_points(&self.scene, 0);
        let given = self.meshes.iter().map(|path| read(path, session)).collect::<anyhow::Result<_>>()?;
        let meshes = scene.with_meshes(given, |path| read(path, session))?;
        let resume = match &self.resume {
            Some(path) => {
                files::check_readable(path)?;
                Some(std::fs::read(path).with_context(|| path.display().to_string())?)
            }
            None => None,
        };
        let mut outputs = Outputs::new(self, session.printer, series);
        let mut watch = |simulation: &Simulation, steps: &[ContactStep]| outputs.add(simulation, steps);
        let run = request.run(&scene, &meshes, resume.as_deref(), &session.context(), &mut watch);
        session.stop_waiting();
        let run = run.map_err(|error| {
            let place = match (&error, &self.resume) {
                (ContactRequestError::Checkpoint(_), Some(state)) => state,
                _ => &self.scene,
            };
            anyhow::Error::from(error).context(place.display().to_string())
        })?;
        outputs.finish(&run)?;
        Ok(run.report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(answer)
    }
}

/// Reads a surface or tetrahedra.
fn read(path: &Path, session: &mut Session<'_>) -> anyhow::Result<BodyMesh> {
    files::check_readable(path)?;
    Ok(match read_surface_or_solid(path)? {
        SurfaceOrSolid::Surface(read) => {
            files::warn_of_changes(path, &read, session.printer);
            session.note(path, &read.mesh);
            BodyMesh::Surface(read.mesh)
        }
        SurfaceOrSolid::Solid(solid) => {
            session.note_counts(path, [solid.positions.len(), 0]);
            BodyMesh::Tetrahedra { positions: solid.positions, cells: solid.cells }
        }
    })
}
