//! What can be asked: the options of [`NeuronRequest`], as every door offers them.

mod error;
mod run;
mod table;

pub use error::NeuronRequestError;
pub use run::{NeuronAnswer, Transported};
pub use table::ParameterTable;

use crate::{
    MeshOptions, NeuronReport, Parameters, Preparation, SmoothOptions, WallDistance, read_transport_config,
};
use pompeiu_core::request::{Conclusion, Limit, Report, Request};
use pompeiu_core::run::StopReason;
use std::path::PathBuf;

#[cfg(feature = "clap")]
use pompeiu_core::request::values::magnitude;

/// Compute what travels through a neuron, from its skeleton to a movie.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NeuronRequest {
    /// The last stage; the command also takes its name before the file.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "STAGE"))]
    pub stage: Stage,
    /// Repair what can be repaired: missing parents, cycles, missing radii, coincident samples, branches within the ball of their node;
    /// each repair is reported.
    #[cfg_attr(feature = "clap", arg(long))]
    pub repair: bool,
    /// Steps of smoothing along branches, radius included.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub smooth: usize,
    /// Distance of new samples along smooth branches, in micrometres.
    #[cfg_attr(feature = "clap", arg(long, value_parser = magnitude, value_name = "LENGTH"))]
    pub spacing: Option<f64>,
    /// Parts of each block along each edge, 1 to 8: for trilinear cells 1, 2 and 3 give 5, 20 and 45 to a section; cells of a flow are cut
    /// into so many for transport.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub parts: usize,
    /// Length of a block or a patch along a branch, in radii.
    #[cfg_attr(feature = "clap", arg(long, value_parser = magnitude, value_name = "RADII"))]
    pub layer: f64,
    /// Tolerated distance of the wall from the cones of the file, both ways, in radii; the exit code is 1 if it is greater, and no stage
    /// follows the mesh.
    #[cfg_attr(feature = "clap", arg(long, value_parser = magnitude, value_name = "RADII"))]
    pub within: f64,
    /// Elements of each patch along each edge, 1 to 4, for splines and flow.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub elements: usize,
    /// Stage spline: halve elements here: nodes, ends, wall, branch=N, sample=ID or ball=X,Y,Z,R; may be given more than once.
    #[cfg_attr(feature = "clap", arg(long, value_name = "WHERE"))]
    pub refine: Vec<String>,
    /// Stage spline: how often elements are halved there, 1 to 5.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub levels: usize,
    /// Frames of transport that are kept, the first and the last among them.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub frames: usize,
    /// Go on from a state that was written as a checkpoint, with the same options; steps count from the beginning.
    #[cfg_attr(feature = "clap", arg(long, value_name = "FILE"))]
    pub resume: Option<PathBuf>,
    /// A file of parameters, in the place of the tables below: TOML with units, or pairs of names and values of other programs.
    #[cfg_attr(feature = "clap", arg(long, value_name = "FILE"))]
    pub parameters: Option<PathBuf>,
    /// Diffusion, speeds, rates and time steps of transport; in files the table called transport.
    #[cfg_attr(feature = "clap", arg(long = "set-transport", value_name = "NAME = VALUE, …"))]
    pub transport: Option<ParameterTable>,
    /// The fluid and what drives it; in files the table called flow.
    #[cfg_attr(feature = "clap", arg(long = "set-flow", value_name = "NAME = VALUE, …"))]
    pub flow: Option<ParameterTable>,
    /// The inlet and what enters there; in files the table called inlet.
    #[cfg_attr(feature = "clap", arg(long = "set-inlet", value_name = "NAME = VALUE, …"))]
    pub inlet: Option<ParameterTable>,
    /// The conditions at the other flat ends; in files the table called tips.
    #[cfg_attr(feature = "clap", arg(long = "set-tips", value_name = "NAME = VALUE, …"))]
    pub tips: Option<ParameterTable>,
    /// Concentrations in the beginning; in files the table called initial.
    #[cfg_attr(feature = "clap", arg(long = "set-initial", value_name = "NAME = VALUE, …"))]
    pub initial: Option<ParameterTable>,
}

impl Default for NeuronRequest {
    fn default() -> Self {
        Self {
            stage: Stage::default(),
            repair: false,
            smooth: 0,
            spacing: None,
            parts: 2,
            layer: 2.0,
            within: MeshOptions::default().within,
            elements: 1,
            refine: Vec::new(),
            levels: 1,
            frames: 20,
            resume: None,
            parameters: None,
            transport: None,
            flow: None,
            inlet: None,
            tips: None,
            initial: None,
        }
    }
}

/// Stages, each of which does what those before it do, but for splines, flow and transport.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Stage {
    /// The skeleton is read, and what is wrong with it and what the stage mesh cannot do is reported; it takes as long as that.
    Check,
    /// The neuron is filled with trilinear cells.
    Mesh,
    /// The neuron is filled with tricubic cells, and the splines over them are counted.
    Spline,
    /// Tricubic cells, and the steady viscous flow through them.
    Flow,
    /// Trilinear cells, and transport through them along the potential flow.
    Transport,
    /// Tricubic cells, the viscous flow, and transport along it.
    #[default]
    All,
}

impl Stage {
    const fn name(self) -> &'static str {
        match self {
            Self::Check => "check",
            Self::Mesh => "mesh",
            Self::Spline => "spline",
            Self::Flow => "flow",
            Self::Transport => "transport",
            Self::All => "all",
        }
    }

    /// Whether material is carried.
    pub const fn carries(self) -> bool {
        matches!(self, Self::Transport | Self::All)
    }
}

impl Request for NeuronRequest {
    const NAME: &'static str = "neuron";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time, Limit::Memory];
    type Report = NeuronReport;
}

impl Report for NeuronReport {
    fn stop(&self) -> StopReason {
        self.stop
    }

    fn conclusion(&self) -> Conclusion {
        let is_certified = self.mesh.as_ref().is_none_or(|mesh| mesh.certified);
        let has_problems = self.skeleton.as_ref().is_some_and(|skeleton| !skeleton.problems.is_empty());
        let wall = self.mesh.as_ref().and_then(|mesh| mesh.wall.as_ref());
        let is_within = wall.map_or(Some(true), WallDistance::is_within);
        let is_folded = self.mesh.as_ref().is_some_and(|mesh| mesh.folded() > 0);
        let is_undecided = self.is_check && self.meshable.is_none();
        let is_bad = is_folded || is_within == Some(false);
        if (self.is_check && has_problems) || self.agrees == Some(false) || is_bad {
            Conclusion::Refuted
        } else if self.stop.is_early() || !is_certified || is_within.is_none() || is_undecided {
            Conclusion::Incomplete
        } else {
            Conclusion::AsAsked
        }
    }
}

impl NeuronRequest {
    /// What is done to a skeleton.
    pub fn preparation(&self) -> Preparation {
        let smooth = SmoothOptions { steps: self.smooth, spacing: self.spacing };
        Preparation { repair: self.repair, smooth }
    }

    /// The options that cells depend on, in one line.
    fn cells_line(&self) -> String {
        let stage = match self.stage {
            Stage::All => format!("all {}", self.elements),
            stage => stage.name().to_owned(),
        };
        self.preparation().line(&stage, self.parts, self.layer)
    }

    /// The parameters of flow and transport.
    ///
    /// # Errors
    /// [`NeuronRequestError`].
    pub fn parameters(&self) -> Result<Parameters, NeuronRequestError> {
        let tables = [
            ("transport", &self.transport),
            ("flow", &self.flow),
            ("inlet", &self.inlet),
            ("tips", &self.tips),
            ("initial", &self.initial),
        ];
        let mut document = toml::Table::new();
        for (name, table) in tables {
            if let Some(ParameterTable(table)) = table {
                document.insert(name.to_owned(), toml::Value::Table(table.clone()));
            }
        }
        match &self.parameters {
            None if document.is_empty() => Ok(Parameters::default()),
            None => {
                let read = read_transport_config(&document.to_string());
                read.map_err(|error| NeuronRequestError::Table(error.without_line()))
            }
            Some(_) if !document.is_empty() => Err(NeuronRequestError::TwoParameters),
            Some(path) => {
                let path = path.clone();
                let text = std::fs::read_to_string(&path)
                    .map_err(|error| NeuronRequestError::File { path: path.clone(), error })?;
                read_transport_config(&text).map_err(|error| NeuronRequestError::Parameters { path, error })
            }
        }
    }

    /// Refuses options out of range, and those that the stage does not use.
    fn check(&self, is_mesh: bool) -> Result<(), NeuronRequestError> {
        for (option, value, [least, most]) in [
            ("parts", self.parts, [1, 8]),
            ("elements", self.elements, [1, 4]),
            ("levels", self.levels, [1, 5]),
            ("frames", self.frames, [2, 100_000]),
            ("smooth", self.smooth, [0, 100_000]),
        ] {
            if !(least..=most).contains(&value) {
                return Err(NeuronRequestError::Range { option, value, least, most });
            }
        }
        if self.spacing.is_some_and(|spacing| !(spacing.is_finite() && spacing > 0.0)) {
            return Err(NeuronRequestError::Spacing(self.spacing.unwrap_or_default()));
        }
        if !(self.within.is_finite() && self.within > 0.0) {
            return Err(NeuronRequestError::Within(self.within));
        }
        if is_mesh && (self.repair || self.smooth > 0 || self.spacing.is_some()) {
            return Err(NeuronRequestError::OfSkeletons);
        }
        if is_mesh && self.stage == Stage::Check {
            return Err(NeuronRequestError::CheckOfMesh);
        }
        let defaults = Self::default();
        let has_tables = [&self.transport, &self.flow, &self.inlet, &self.tips, &self.initial];
        let has_parameters = self.parameters.is_some() || has_tables.iter().any(|table| table.is_some());
        let tricubic: &[Stage] = &[Stage::Spline, Stage::Flow, Stage::All];
        let carrying: &[Stage] = &[Stage::Transport, Stage::All];
        for (option, is_given, stages) in [
            (
                "parts",
                self.parts != defaults.parts,
                &[Stage::Check, Stage::Mesh, Stage::Transport, Stage::All][..],
            ),
            (
                "layer",
                self.layer != defaults.layer,
                &[Stage::Check, Stage::Mesh, Stage::Spline, Stage::Flow, Stage::Transport, Stage::All],
            ),
            (
                "within",
                self.within != defaults.within,
                &[Stage::Check, Stage::Mesh, Stage::Spline, Stage::Flow, Stage::Transport, Stage::All],
            ),
            ("elements", self.elements != defaults.elements, tricubic),
            ("refine", !self.refine.is_empty(), &[Stage::Spline]),
            ("frames", self.frames != defaults.frames, carrying),
            ("resume", self.resume.is_some(), carrying),
            ("parameters", has_parameters, &[Stage::Flow, Stage::Transport, Stage::All]),
        ] {
            if is_given && !stages.contains(&self.stage) {
                let names = stages.iter().map(|stage| stage.name()).collect::<Vec<_>>().join(", ");
                return Err(NeuronRequestError::Stage { option, stage: self.stage.name(), names });
            }
        }
        if self.levels != defaults.levels && self.refine.is_empty() {
            return Err(NeuronRequestError::LevelsWithoutPlaces);
        }
        Ok(())
    }
}
