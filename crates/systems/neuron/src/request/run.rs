//! The whole pipeline: skeleton, cells, splines, flow, transport.

use super::{NeuronRequest, NeuronRequestError, Stage};
use crate::mesh::cells_are;
use crate::source::Prepared;
use crate::{
    Checkpoint, CubicMesh, Flow, FlowCells, FlowOptions, MaterialCells, MeshOptions, NeuronMesh,
    NeuronReport, NeuronSource, Parameters, Problem, RefineAt, RefineOptions, RunIdentity, Skeleton,
    SplineReport, Timing, Transport, TransportOptions, TransportState, neuron_flow, refined_splines,
};
use pompeiu_core::run::Instant;
use pompeiu_core::run::{RunContext, StopReason};
use pompeiu_volume::HierarchicalSplines;
use std::path::PathBuf;

/// What the stages left.
#[derive(Clone, Debug, Default)]
pub struct NeuronAnswer {
    /// The skeleton, unless a mesh was given.
    pub skeleton: Option<Skeleton>,
    /// The skeleton before smoothing and resampling, if one of them was requested.
    pub original: Option<Skeleton>,
    /// Points that were read: samples, or vertices of a mesh.
    pub points: usize,
    /// Trilinear cells of the stage mesh.
    pub hexahedra: Option<NeuronMesh>,
    /// Tricubic cells of the stages spline and flow.
    pub patches: Option<CubicMesh>,
    /// Splines over them, where they were refined or asked for.
    pub splines: Option<HierarchicalSplines>,
    /// The flow of the stage flow.
    pub flow: Option<Flow>,
    /// Material that was carried.
    pub transported: Option<Transported>,
    /// The report.
    pub report: NeuronReport,
}

/// Material that was carried, and the cells that carried it.
#[derive(Clone, Debug)]
pub struct Transported {
    /// The cells.
    pub cells: MaterialCells,
    /// What became of it.
    pub found: Transport,
    /// The parameters.
    pub parameters: Parameters,
    /// What a checkpoint belongs to.
    pub run: RunIdentity,
}

impl Transported {
    /// The state after the last step, from which another run goes on.
    pub fn checkpoint(&self) -> Checkpoint {
        Checkpoint::new(&self.run, self.found.state.clone())
    }
}

/// Stages as they follow each other.
struct Run<'r, 'c> {
    request: &'r NeuronRequest,
    context: &'r RunContext<'c>,
    parameters: Parameters,
    resume: Option<TransportState>,
    identity: RunIdentity,
    answer: NeuronAnswer,
    started: Instant,
    /// Milliseconds until the last stage ended.
    until: f64,
}

impl NeuronRequest {
    /// Does all stages up to the one that is asked for; `wants_splines` computes splines that are not refined, too.
    ///
    /// When a limit ends a stage, the answer has what the stages before it left, and of transport the steps that were done.
    ///
    /// # Errors
    /// [`NeuronRequestError`].
    pub fn run(
        &self,
        source: NeuronSource,
        wants_splines: bool,
        context: &RunContext<'_>,
    ) -> Result<NeuronAnswer, NeuronRequestError> {
        self.check(source.is_mesh())?;
        let parameters = self.parameters()?;
        let identity = RunIdentity::new(&source.content, &self.cells_line(), &parameters);
        let resume = self.resume.clone().map(|path| resumed(path, &identity)).transpose()?;
        let started = Instant::now();
        let mut run = Run {
            request: self,
            context,
            parameters,
            resume,
            identity,
            answer: NeuronAnswer::default(),
            started,
            until: 0.0,
        };
        run.answer.report.is_check = self.stage == Stage::Check;
        let done = context.on_threads(|| run.stages(source, wants_splines));
        if let Err(error) = done {
            let Some(stop) = error.stop() else { return Err(error) };
            run.answer.report.stop = stop;
            run.answer.report.ended = Some(error.to_string());
        }
        run.answer.report.timing.total = milliseconds(started);
        Ok(run.answer)
    }
}

fn milliseconds(since: Instant) -> f64 {
    1e3 * since.elapsed().as_secs_f64()
}

/// The state to go on from.
fn resumed(path: PathBuf, identity: &RunIdentity) -> Result<TransportState, NeuronRequestError> {
    let bytes = match std::fs::read(&path) {
        Ok(bytes) => bytes,
        Err(error) => return Err(NeuronRequestError::File { path, error }),
    };
    match Checkpoint::from_bytes(&bytes, identity) {
        Ok(checkpoint) => Ok(checkpoint.state),
        Err(error) => Err(NeuronRequestError::Checkpoint { path, error }),
    }
}

impl Run<'_, '_> {
    /// Milliseconds since the last stage ended.
    fn lap(&mut self) -> f64 {
        let now = milliseconds(self.started);
        now - std::mem::replace(&mut self.until, now)
    }

    fn stages(&mut self, source: NeuronSource, wants_splines: bool) -> Result<(), NeuronRequestError> {
        let source = source.prepared(&self.request.preparation())?;
        self.answer.points = source.points();
        self.answer.skeleton = source.skeleton().cloned();
        self.answer.original = source.original().cloned();
        self.answer.report.skeleton = source.report().cloned();
        self.answer.report.timing = Timing { skeleton: self.lap(), ..Timing::default() };
        match self.request.stage {
            Stage::Check => self.check(&source),
            Stage::Mesh => {
                self.answer.hexahedra = Some(self.hexahedra(&source)?);
                Ok(())
            }
            Stage::Spline => self.spline(&source, wants_splines),
            Stage::Flow => {
                self.answer.flow = self.flow(&source)?;
                Ok(())
            }
            Stage::Transport => {
                let mesh = self.hexahedra(&source)?;
                if self.is_refused() {
                    return Ok(());
                }
                self.transport(MaterialCells::Hexahedra(mesh))
            }
            Stage::All => {
                let Some(flow) = self.flow(&source)? else { return Ok(()) };
                let cells =
                    MaterialCells::Flow(FlowCells::new(&flow, self.request.parts, &self.context.limits())?);
                self.transport(cells)
            }
        }
    }

    fn options(&self, parts: usize) -> MeshOptions<'_> {
        MeshOptions {
            parts,
            layer: self.request.layer,
            within: self.request.within,
            limits: self.context.limits(),
            progress: self.context.progress(),
            ..MeshOptions::default()
        }
    }

    /// Keeps the problems of the file, and in the place of those of shape what a mesh cannot do.
    fn check(&mut self, source: &Prepared) -> Result<(), NeuronRequestError> {
        if let Some(skeleton) = &mut self.answer.report.skeleton {
            skeleton.problems.retain(|problem| problem.kind.is_of_file());
        }
        let found = source.meshability(&self.options(self.request.parts))?;
        self.answer.report.meshable = found.meshable;
        if let Some(skeleton) = &mut self.answer.report.skeleton {
            let is_new = |problem: &Problem| !skeleton.problems.contains(problem);
            let new: Vec<Problem> = found.problems.into_iter().filter(is_new).collect();
            skeleton.problems.extend(new);
        }
        self.answer.report.timing.mesh = Some(self.lap());
        Ok(())
    }

    fn hexahedra(&mut self, source: &Prepared) -> Result<NeuronMesh, NeuronRequestError> {
        // Sides of a mesh are ends for material only.
        let sides = if self.request.stage.carries() { &self.parameters.sides[..] } else { &[] };
        let mesh = source.hexahedra(sides, &self.options(self.request.parts))?;
        self.answer.report.mesh = Some(mesh.report.clone());
        self.answer.report.timing.mesh = Some(self.lap());
        Ok(mesh)
    }

    fn patches(&mut self, source: &Prepared) -> Result<CubicMesh, NeuronRequestError> {
        let sides = if self.request.stage == Stage::Spline { &[] } else { &self.parameters.sides[..] };
        let mesh = source.patches(sides, &self.options(MeshOptions::default().parts))?;
        self.answer.report.timing.mesh = Some(self.lap());
        self.answer.report.mesh = Some(mesh.report.clone());
        self.answer.report.spline = Some(SplineReport::new(&mesh.mesh, self.request.elements));
        self.answer.report.timing.spline = Some(self.lap());
        Ok(mesh)
    }

    fn spline(&mut self, source: &Prepared, wants_splines: bool) -> Result<(), NeuronRequestError> {
        let NeuronRequest { refine, elements, levels, .. } = self.request;
        let at = refine.iter().map(|name| RefineAt::from_name(name, source.skeleton()));
        let at = at.collect::<Result<Vec<_>, _>>()?;
        let mesh = self.patches(source)?;
        if wants_splines || !at.is_empty() {
            let options = RefineOptions {
                elements: *elements,
                at: &at,
                times: if at.is_empty() { 0 } else { *levels },
                limits: self.context.limits(),
                progress: self.context.progress(),
            };
            let splines = refined_splines(&mesh, &options)?;
            if !at.is_empty() {
                self.answer.report.spline = Some(SplineReport::of_refined(&splines));
            }
            self.answer.splines = Some(splines);
            let before = self.answer.report.timing.spline.unwrap_or(0.0);
            self.answer.report.timing.spline = Some(before + self.lap());
        }
        self.answer.patches = Some(mesh);
        Ok(())
    }

    /// Whether cells are proven to be folded, or the wall to be farther from the cones than is tolerated, so that no stage follows the mesh; says so.
    fn is_refused(&mut self) -> bool {
        let Some(mesh) = &self.answer.report.mesh else { return false };
        let folded = mesh.folded();
        if folded > 0 {
            let cells = cells_are(folded);
            let worst = mesh.unproven.iter().find(|cell| cell.folded).and_then(|cell| cell.sample);
            let near = worst.map_or(String::new(), |sample| format!(", the worst near sample {sample}"));
            self.answer.report.ended = Some(format!("ended after the mesh, of which {cells} folded{near}"));
            return true;
        }
        let Some(wall) = mesh.wall.as_ref().filter(|wall| wall.is_within() == Some(false)) else {
            return false;
        };
        self.answer.report.ended = Some(format!(
            "ended after the mesh, whose wall is not within {} radii of the cones; --within {} accepts it",
            wall.within,
            wall.sufficient()
        ));
        true
    }

    /// `None` if the mesh is not tolerated.
    fn flow(&mut self, source: &Prepared) -> Result<Option<Flow>, NeuronRequestError> {
        let mesh = self.patches(source)?;
        if self.is_refused() {
            return Ok(None);
        }
        let options = FlowOptions {
            elements: self.request.elements,
            limits: self.context.limits(),
            progress: self.context.progress(),
        };
        let flow = neuron_flow(&mesh, &self.parameters.flow, &options)?;
        self.answer.report.timing.flow = Some(self.lap());
        self.answer.report.flow = Some(flow.report.clone());
        if self.request.stage == Stage::Flow {
            self.answer.patches = Some(mesh);
        }
        Ok(Some(flow))
    }

    fn transport(&mut self, cells: MaterialCells) -> Result<(), NeuronRequestError> {
        let options = TransportOptions {
            limits: self.context.limits(),
            progress: self.context.progress(),
            resume: self.resume.as_ref(),
        };
        let found = cells.transport(&self.parameters, self.request.frames, &options)?;
        self.answer.report.timing.transport = Some(self.lap());
        self.answer.report.transport = Some(found.report.clone());
        if found.stop != StopReason::Steps {
            self.answer.report.stop = found.stop;
            let done = found.report.steps;
            self.answer.report.ended = Some(format!("transport ended after {done} steps"));
        }
        let (parameters, run) = (self.parameters.clone(), self.identity.clone());
        self.answer.transported = Some(Transported { cells, found, parameters, run });
        Ok(())
    }
}
