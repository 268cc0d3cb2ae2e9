//! What can be asked: the options of [`FlowRequest`], as every door offers them.

use crate::{
    BoundaryCondition, Flow, FlowError, FlowObserver, FlowOptions, FlowStop, Remeshing, Scheme, Until,
    mean_curvature_flow,
};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::Coordinates;
use pompeiu_core::request::{Length, Limit, Report, Request};
use pompeiu_core::run::{RunContext, StopReason};
use pompeiu_remesh::Intersections;
use std::fmt;
use std::num::NonZeroUsize;
use std::str::FromStr;

#[cfg(feature = "clap")]
use pompeiu_core::request::values::{direction, magnitude};

/// Let a surface flow to less area: minimal surfaces, mean curvature flow, bubbles.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FlowRequest {
    /// The scheme that moves the surface; normal-newton to a stationary surface, implicit otherwise.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "NAME"))]
    pub scheme: Option<Scheme>,
    /// When to end: stationary, stationary:TOL, time:T or steps:N.
    #[cfg_attr(feature = "clap", arg(long, value_name = "END"))]
    pub until: Until,
    /// Length of a step in time, in squared lengths; by default each is chosen.
    #[cfg_attr(feature = "clap", arg(long, value_parser = magnitude, value_name = "T"))]
    pub time_step: Option<f64>,
    /// Let the boundary slide in planes with this normal, three numbers (on the command line also x, y or z); otherwise it stays.
    #[cfg_attr(feature = "clap", arg(long, value_parser = direction, allow_hyphen_values = true, value_name = "NORMAL"))]
    pub planes: Option<[f64; 3]>,
    /// The treatment of the enclosed volume.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub volume: Volume,
    /// Remesh on the way to edges of this length, such as 2, 2mm with the unit given, or 1% of the diagonal.
    #[cfg_attr(feature = "clap", arg(long, allow_negative_numbers = true, value_name = "LENGTH"))]
    pub remesh: Option<Length>,
    /// The unit of the coordinates, such as mm; files have none.
    #[cfg_attr(feature = "clap", arg(long, value_name = "NAME"))]
    pub unit: String,
    /// Steps between two remeshings to that length.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub remesh_every: NonZeroUsize,
    /// Where angles decay, remesh to the mean length of edges; not by schemes that keep the metric of the first surface.
    #[cfg_attr(
        feature = "clap",
        arg(long = "no-keep-angles", action = clap::ArgAction::SetFalse, help = "Go on with the same triangles where angles decay")
    )]
    pub keep_angles: bool,
    /// The treatment of faces of the result that intersect.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "WHAT"))]
    pub intersections: Intersections,
    /// Coordinates of the result.
    #[cfg_attr(feature = "clap", command(flatten))]
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub coordinates: Coordinates,
}

impl Default for FlowRequest {
    fn default() -> Self {
        Self {
            scheme: None,
            until: Until::STATIONARY,
            time_step: None,
            planes: None,
            volume: Volume::default(),
            remesh: None,
            unit: String::new(),
            remesh_every: const { NonZeroUsize::new(5).unwrap() },
            keep_angles: true,
            intersections: Intersections::Report,
            coordinates: Coordinates::default(),
        }
    }
}

/// The treatment of the enclosed volume.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Volume {
    /// It changes.
    #[default]
    Free,
    /// It stays: a soap bubble.
    Keep,
}

impl FromStr for Until {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |rest: &str| rest.parse::<f64>().map_err(|_| format!("`{rest}` is no number"));
        match text.split_once(':') {
            None if text == "stationary" => Ok(Self::STATIONARY),
            Some(("stationary", rest)) => number(rest).map(Self::Stationary),
            Some(("time", rest)) => number(rest).map(Self::Time),
            Some(("steps", rest)) => {
                rest.parse().map(Self::Steps).map_err(|_| format!("`{rest}` is no whole number"))
            }
            _ => Err("expected stationary, stationary:TOL, time:T or steps:N".to_owned()),
        }
    }
}

impl fmt::Display for Until {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            end if *end == Self::STATIONARY => f.write_str("stationary"),
            Self::Stationary(tolerance) => write!(f, "stationary:{tolerance:e}"),
            Self::Time(time) => write!(f, "time:{time}"),
            Self::Steps(count) => write!(f, "steps:{count}"),
        }
    }
}

impl TryFrom<String> for Until {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<Until> for String {
    fn from(until: Until) -> Self {
        until.to_string()
    }
}

impl Request for FlowRequest {
    const NAME: &'static str = "flow";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time];
    type Report = Flow;
}

impl Report for Flow {
    fn stop(&self) -> StopReason {
        match self.stop {
            FlowStop::Limit => StopReason::Time,
            FlowStop::Cancelled => StopReason::Cancelled,
            FlowStop::Stalled | FlowStop::Degenerate => StopReason::Stalled,
            FlowStop::Stationary | FlowStop::Time | FlowStop::Steps | FlowStop::Pinched => {
                StopReason::Tolerance
            }
        }
    }
}

impl FlowRequest {
    /// Lets a surface flow; the observer is shown each step.
    ///
    /// # Errors
    /// [`FlowError`].
    pub fn run(
        &self,
        mesh: &TriMesh,
        context: &RunContext<'_>,
        observer: Option<&dyn FlowObserver>,
    ) -> Result<Flow, FlowError> {
        let every = self.remesh_every;
        let diagonal = Aabb::of_faces(mesh).diagonal();
        let edge_length = self.remesh.as_ref().map(|length| length.of(&self.unit, diagonal)).transpose()?;
        let options = FlowOptions {
            scheme: self.scheme,
            time_step: self.time_step,
            boundary: self.planes.map_or(BoundaryCondition::Fixed, BoundaryCondition::Planes),
            keep_volume: self.volume == Volume::Keep,
            remesh: edge_length.map(|edge_length| Remeshing { edge_length, every }),
            keep_angles: self.keep_angles,
            coordinates: self.coordinates,
            intersections: self.intersections,
            limits: context.limits(),
            observer,
            ..FlowOptions::new(self.until)
        };
        mean_curvature_flow(mesh, &options)
    }
}
