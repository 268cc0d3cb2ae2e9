//! Runs a request.

use super::examples::Built;
use super::{BodyMesh, Certificate, Checkpoint, ContactReport, ContactRequest, ContactRequestError, Scene};
use crate::{Check, ContactError, ContactStep, Simulation};
use pompeiu_core::run::{RunContext, StopReason};
use pompeiu_core::spatial::IntersectingPair;
use std::ops::ControlFlow;

/// A run at its end.
#[derive(Debug)]
pub struct ContactRun {
    /// What was measured.
    pub report: ContactReport,
    /// The bodies as they are.
    pub simulation: Simulation,
}

#[cfg(feature = "figures")]
impl ContactRun {
    /// The page of the run, with frames of it and the command that makes the page again.
    pub fn page<'r>(
        &'r self,
        frames: &'r crate::show::ContactFrames,
        command: Option<&'r str>,
    ) -> crate::show::ContactPage<'r> {
        let gravity = self.simulation.options().gravity;
        crate::show::ContactPage {
            name: &self.report.scene,
            bodies: self.simulation.bodies(),
            distance: self.report.scheme.distance,
            start: &self.report.start,
            steps: &self.report.steps,
            frames: frames.frames(),
            certificate: self.report.certificate.sentence(),
            up: if gravity.length() > 0.0 { (-gravity.normalize()).to_array() } else { [0.0, 0.0, 1.0] },
            command,
        }
    }
}

/// Gets the simulation at first and after each step, with what was measured; may end the run.
type Watch<'w> = dyn FnMut(&Simulation, &[ContactStep]) -> ControlFlow<()> + Send + 'w;

/// Pairs that are named where a start intersects.
const NAMED: usize = 5;

impl ContactRequest {
    /// Lets bodies move, whose meshes are in the order of the scene. It goes on from the state in the bytes of a checkpoint, if one is
    /// given. Where a step cannot be computed, the report says so and has the steps before.
    ///
    /// # Errors
    /// [`ContactRequestError`], before the first step.
    pub fn run(
        &self,
        scene: &Scene,
        meshes: &[BodyMesh],
        resume: Option<&[u8]>,
        context: &RunContext<'_>,
        watch: &mut Watch<'_>,
    ) -> Result<ContactRun, ContactRequestError> {
        context.on_threads(|| self.run_here(scene, meshes, resume, context, watch))
    }

    fn run_here(
        &self,
        scene: &Scene,
        meshes: &[BodyMesh],
        resume: Option<&[u8]>,
        context: &RunContext<'_>,
        watch: &mut Watch<'_>,
    ) -> Result<ContactRun, ContactRequestError> {
        let Built { bodies, options, steps: asked, first_faces, first_of_obstacles } =
            scene.build(meshes, self)?;
        let check = options.check;
        let mut simulation = Simulation::new(bodies, options).map_err(|error| match error {
            ContactError::StartIntersects { pairs } => {
                let firsts = [&first_faces[..], &first_of_obstacles].concat();
                ContactRequestError::StartIntersects { pairs: named(&pairs, &firsts, first_faces.len()) }
            }
            error => error.into(),
        })?;
        let mut report = ContactReport::new(scene.name(), first_faces.len(), asked, &simulation);
        let steps = match resume {
            Some(bytes) => Checkpoint::resume(bytes, &mut simulation)?,
            None => Vec::new(),
        };
        if steps.len() > asked {
            return Err(ContactRequestError::TooFewSteps { done: steps.len(), asked });
        }
        let control = context.control();
        let counts = [steps.len(), asked];
        let mut state = (simulation, steps);
        let taken = context.take_steps(
            &control,
            &mut state,
            counts,
            |(simulation, steps)| watch(simulation, steps),
            |(simulation, steps)| simulation.step().map(|step| steps.push(step)),
        );
        let (simulation, steps) = state;
        let failure = taken.err();
        report.certificate = certificate(&simulation, &steps, check, failure.as_ref())?;
        let is_done = steps.len() == asked;
        let ended = if is_done { StopReason::Steps } else { StopReason::Stalled };
        report.stop = control.reason().filter(|_| !is_done && failure.is_none()).unwrap_or(ended);
        report.steps = steps;
        report.failure = failure.map(|error| error.to_string());
        report.timing = simulation.timing();
        Ok(ContactRun { report, simulation })
    }
}

/// What the exact test found; a last test runs here.
fn certificate(
    simulation: &Simulation,
    steps: &[ContactStep],
    check: Check,
    failure: Option<&ContactError>,
) -> Result<Certificate, ContactError> {
    let mut certificate = Certificate {
        steps: steps.len(),
        tested: steps.iter().filter(|step| step.intersections.is_some()).count(),
        intersecting: steps.iter().filter_map(|step| step.intersections).sum(),
    };
    if check == Check::Last && !steps.is_empty() {
        certificate.tested = 1;
        certificate.intersecting = simulation.certify()?;
    }
    if matches!(failure, Some(ContactError::Intersects { .. })) {
        certificate.tested += 1;
        certificate.intersecting += 1;
    }
    Ok(certificate)
}

/// Pairs of faces with their bodies, and where they meet; bodies come first, then obstacles.
fn named(pairs: &[IntersectingPair], first_faces: &[usize], bodies: usize) -> String {
    let body_and_face = |face: u32| {
        let body = first_faces.partition_point(|first| *first <= face as usize);
        let first = body.checked_sub(1).and_then(|i| first_faces.get(i)).copied().unwrap_or(0);
        let of = match body.checked_sub(bodies) {
            Some(obstacle @ 1..) => format!("mesh {obstacle} of obstacles"),
            _ => format!("body {body}"),
        };
        format!("face {} of {of}", face as usize - first)
    };
    let mut words: Vec<String> = pairs
        .iter()
        .take(NAMED)
        .map(|pair| {
            let [a, b] = pair.faces.map(|face| body_and_face(face.0));
            let [x, y, z] = pair.place;
            format!("{a} and {b} near ({x:.6}, {y:.6}, {z:.6})")
        })
        .collect();
    if pairs.len() > NAMED {
        words.push(format!("{} more pairs", pairs.len() - NAMED));
    }
    words.join("; ")
}
