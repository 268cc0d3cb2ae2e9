//! `pompeiu flow`.

mod text;

use crate::appearance;
use crate::args::{Picture, hold_in, tell};
use crate::called::called;
pub(crate) use crate::door::run;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::series::Series;
use crate::{files, interrupt};
use anyhow::{Context, bail};
use clap::Args;
use pompeiu::core::TriMesh;
use pompeiu::core::run::Progress;
use pompeiu::flow::show::{FlowPage, Frames};
use pompeiu::flow::{Flow as Report, FlowObserver, FlowRequest, FlowStep};
use pompeiu::io::{Attributes, write_with};
use std::path::{Path, PathBuf};

/// Surfaces that a page plays at most.
const MOST_FRAMES: usize = 120;

pub(crate) type Flow = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
The mesh must be an oriented manifold. Its boundary stays, or slides in planes (--planes). Every step is recorded with its
scheme, the reason for it and the area after it. Where angles decay the surface is remeshed on the way.

Ends:
  stationary       a minimal surface: the gradient of the area along vertex normals vanishes. The answer says whether it is a local
                   minimum or a saddle, and for two boundary loops whether two discs would have less area
  stationary:TOL   the same with a tolerance, as a part of the square root of the area
  time:T           mean curvature flow until this time, in squared lengths
  steps:N          so many steps

Schemes:
  normal-newton       Newton's method along vertex normals (default to a stationary surface)
  implicit            backward Euler with the Laplacian of each step (default in time, with Richardson extrapolation)
  conformalized       the Laplacian of the first step, the areas of each: does not pinch
  fixed-laplacian     Laplacian and areas of the first step; ends in no minimal surface
  explicit            gradient descent
  newton              Newton's method for all coordinates
  newton-or-gradient  Newton's method while the area falls, gradient descent where it would not

Examples:
  pompeiu generate schwarz-lantern --segments 96 --bands 24 --height 1 -o tube.obj
  pompeiu flow tube.obj -o catenoid.ply --report catenoid.html
  pompeiu flow scan.ply --until time:0.01 --series flow.pvd -o smooth.ply
  pompeiu flow blob.ply --volume keep --until stationary:1e-6 -o bubble.ply")]
pub(crate) struct Files {
    /// The mesh file
    mesh: PathBuf,
    /// The mesh file to write
    #[arg(long, short, value_name = "OUT")]
    output: Option<PathBuf>,
    /// Write every step as VTP, with a list of them for ParaView
    #[arg(long, value_name = "FILE.pvd")]
    series: Option<PathBuf>,
    #[command(flatten)]
    picture: Picture,
}

impl System for Files {
    type Request = FlowRequest;

    fn check(&self, json: bool) -> anyhow::Result<()> {
        let shows = self.picture.outputs().next().is_some();
        if self.output.is_none() && self.series.is_none() && !shows && !json {
            bail!(
                "nothing would be written; name the result with -o, or ask for --series, --report, --image or --json"
            );
        }
        self.output.as_deref().map_or(Ok(()), files::check_writable)?;
        let outputs = self.output.iter().chain(&self.series).map(PathBuf::as_path);
        files::check_places(outputs.chain(self.picture.outputs()), &[&self.mesh])
    }

    fn run(&self, request: &mut FlowRequest, session: &mut Session<'_>) -> anyhow::Result<Report> {
        let shown = self.mesh.display().to_string();
        let series = self.series.as_deref().map(Series::new).transpose()?;
        let mesh = session.read_mesh(&self.mesh)?;
        if let Some(output) = &self.output {
            hold_in(output, &mut request.coordinates);
        }
        let shows = self.picture.outputs().next().is_some();
        let frames = Frames::new(if shows { MOST_FRAMES } else { 2 });
        let wait = &session.wait;
        let watch = |step: &FlowStep<'_>| {
            let doing = format!("step {}, area {:.6}", step.step, step.record.area);
            match step.share {
                Some(_) => wait.progress(&Progress { doing: &doing, share: step.share }),
                None => wait.show(doing),
            }
            if shows {
                frames.step(step)?;
            }
            if let Some(series) = &series {
                // Steps without a length in time are counted.
                let time = step.record.time.unwrap_or(step.step as f64);
                series.add(step.step, time, |path| write_step(path, step))?;
            }
            interrupt::flow()
        };
        let flow = request.run(&mesh, &session.context(), Some(&watch)).with_context(|| shown.clone())?;
        session.stop_waiting();
        let printer = session.printer;
        if let Some(series) = series {
            series.finish(printer)?;
        }
        if let Some(output) = &self.output {
            tell(output, &flow.rounding, printer);
            let attributes = if flow.mesh.faces() == mesh.faces() {
                let mut looks = appearance::read(&self.mesh, &mesh, output, printer)?;
                // Those of the surface as it is now are other ones.
                looks.normals = None;
                appearance::of_same_faces(looks, &flow.mesh)?
            } else {
                let why = "because the surface was remeshed on the way";
                appearance::leave_out(&self.mesh, &mesh, why, printer)?;
                Attributes::for_mesh(&flow.mesh)
            };
            files::write_shifted(output, &flow.mesh, &attributes, &flow.rounding, printer)?;
        }
        let page = FlowPage {
            path: &shown,
            flow: &flow,
            frames: &frames.into_frames(),
            up: self.picture.up.axis(),
            command: Some(&called()),
        };
        self.picture.write(
            || page.html(),
            |width, height, theme, view| page.image(width, height, theme, view),
            printer,
        )?;
        Ok(flow)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(answer)
    }
}

/// Writes the surface after a step.
fn write_step(path: &Path, step: &FlowStep<'_>) -> anyhow::Result<()> {
    let mesh = TriMesh::new(step.positions.to_vec(), step.faces.to_vec())?;
    Ok(write_with(path, &mesh, &Attributes::for_mesh(&mesh))?)
}
