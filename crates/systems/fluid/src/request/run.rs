//! Runs a request.

use super::report::TimingReport;
use super::{Checkpoint, CheckpointError, FluidReport, FluidRequest, FluidRequestError, Stage};
use crate::{FluidError, FluidStep};
use pompeiu_core::TriMesh;
use pompeiu_core::run::{RunContext, StopReason};
use pompeiu_surface::EmbeddedSurface;
use std::ops::ControlFlow;

/// Where a fluid flows.
#[derive(Clone, Copy)]
pub struct Place<'s> {
    /// The mesh, or a vertex for each cell of the square.
    pub mesh: &'s TriMesh,
    /// The surface of the mesh; none in the square.
    pub surface: Option<&'s EmbeddedSurface>,
    /// The vectors of the file that the initial velocity names, if it names one.
    pub velocity: Option<&'s [[f64; 3]]>,
}

/// A flow at its end.
pub struct FluidRun<'s> {
    /// What was measured.
    pub report: FluidReport,
    /// The flow as it is.
    pub stage: Stage<'s>,
    /// Why a step could not be computed; the report then has the steps before.
    pub failure: Option<FluidError>,
}

/// Gets the flow at first and after each step, with what was measured; may end the run.
type Watch<'w, 's> = dyn FnMut(&Stage<'s>, &[FluidStep]) -> ControlFlow<()> + Send + 'w;

impl FluidRequest {
    /// What of the options has no effect, a sentence each.
    pub fn remarks(&self) -> Vec<String> {
        let weighs = self.density.iter().find(|density| density.weight != 0.0);
        match (weighs, self.gravity) {
            (Some(density), None) => vec![format!(
                "the density {} has a weight, but there is no gravity, so that it moves nothing; give gravity a direction, such as 0,0,-1",
                density.name
            )],
            (None, Some(_)) => {
                vec!["there is gravity, but no density has a weight, so that it moves nothing".to_owned()]
            }
            _ => Vec::new(),
        }
    }

    /// Lets the fluid flow. It goes on from the state in the bytes of a checkpoint, if one is given.
    ///
    /// # Errors
    /// [`FluidRequestError`], before the first step.
    pub fn run<'s>(
        &self,
        place: Place<'s>,
        resume: Option<&[u8]>,
        context: &RunContext<'_>,
        watch: &mut Watch<'_, 's>,
    ) -> Result<FluidRun<'s>, FluidRequestError> {
        context.on_threads(|| self.run_here(place, resume, context, watch))
    }

    /// Checks what does not depend on the mesh.
    ///
    /// # Errors
    /// [`FluidRequestError::Missing`], [`FluidRequestError::TwoStarts`], [`FluidRequestError::Cells`].
    pub fn check(&self) -> Result<(), FluidRequestError> {
        if self.steps.is_none() && self.dt.is_none() {
            let both = "the number of steps with --steps and the length of a step with --dt";
            return Err(FluidRequestError::Missing(both));
        }
        self.asked()?;
        self.length_of_step()?;
        self.cells()?;
        let has_vorticity = self.vorticity.is_some() || !self.harmonic.is_empty() || !self.vortex.is_empty();
        if self.velocity.is_some() && has_vorticity {
            return Err(FluidRequestError::TwoStarts);
        }
        Ok(())
    }

    /// The number of steps.
    ///
    /// # Errors
    /// [`FluidRequestError::Missing`].
    pub fn asked(&self) -> Result<usize, FluidRequestError> {
        self.steps.ok_or(FluidRequestError::Missing("the number of steps with --steps"))
    }

    /// The length of a step, where nobody asks for a number of steps.
    pub(super) fn length_of_step(&self) -> Result<f64, FluidRequestError> {
        self.dt.ok_or(FluidRequestError::Missing("the length of a step with --dt"))
    }

    fn run_here<'s>(
        &self,
        place: Place<'s>,
        resume: Option<&[u8]>,
        context: &RunContext<'_>,
        watch: &mut Watch<'_, 's>,
    ) -> Result<FluidRun<'s>, FluidRequestError> {
        self.check()?;
        let asked = self.asked()?;
        let (mut stage, start) = match (place.surface, self.square) {
            (Some(surface), None) => {
                let (fluid, start) = self.on_surface(place.mesh, surface, place.velocity)?;
                (Stage::Surface(Box::new(fluid), surface), start)
            }
            (None, Some(cells)) => (Stage::Square(Box::new(self.in_square(cells, place.mesh)?)), None),
            _ => return Err(FluidRequestError::Place),
        };
        let steps = match resume {
            Some(bytes) => resumed(bytes, place.mesh, &mut stage)?,
            None => vec![stage.measure()?],
        };
        if steps.len() > asked.saturating_add(1) {
            return Err(FluidRequestError::TooFewSteps { done: steps.len() - 1, asked });
        }
        let control = context.control();
        let counts = [steps.len() - 1, asked];
        let mut state = (stage, steps);
        let taken = context.take_steps(
            &control,
            &mut state,
            counts,
            |(stage, steps)| watch(stage, steps),
            |(stage, steps)| stage.step().map(|step| steps.push(step)),
        );
        let (stage, steps) = state;
        let failure = taken.err();
        let done = steps.len();
        let report = FluidReport {
            timing: TimingReport::new(stage.timing(), done - 1),
            steps,
            asked,
            scheme: stage.scheme(),
            start,
            stop: control.reason().filter(|_| done <= asked).unwrap_or(StopReason::Steps),
        };
        Ok(FluidRun { report, stage, failure })
    }
}

/// What was measured before a state that the stage goes on from.
fn resumed(bytes: &[u8], mesh: &TriMesh, stage: &mut Stage<'_>) -> Result<Vec<FluidStep>, CheckpointError> {
    let checkpoint = Checkpoint::from_bytes(bytes, mesh, &stage.scheme())?;
    let steps = checkpoint.steps()?.to_vec();
    stage.restore(checkpoint.stored())?;
    Ok(steps)
}
