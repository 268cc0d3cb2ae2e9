//! What can be asked: the options of [`ContactRequest`], as every door offers them, and scenes.

mod checkpoint;
mod error;
mod examples;
mod own;
mod report;
mod run;
mod scene;

pub use checkpoint::{Checkpoint, CheckpointError};
pub use error::ContactRequestError;
pub use examples::Example;
pub use own::{BodyKind, BodyMesh};
pub use report::{Certificate, ContactReport, ContactScheme};
pub use run::ContactRun;
pub use scene::Scene;

use crate::{Check, Integrator, PairSet, Projection};
#[cfg(feature = "clap")]
use pompeiu_core::request::values::tuple;
use pompeiu_core::request::{Limit, Request};

/// Let elastic solids, cloth and shells move and touch without ever intersecting.
///
/// What is not given is as the scene says, or follows from the size of its bodies.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ContactRequest {
    /// Number of steps, from the beginning also where a state is resumed.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub steps: Option<usize>,
    /// Length of a step in time.
    #[cfg_attr(feature = "clap", arg(long, value_name = "T"))]
    pub dt: Option<f64>,
    /// The distance below which surfaces push each other.
    #[cfg_attr(feature = "clap", arg(long, value_name = "LENGTH"))]
    pub distance: Option<f64>,
    /// Coefficient of friction.
    #[cfg_attr(feature = "clap", arg(long, value_name = "MU"))]
    pub friction: Option<f64>,
    /// The acceleration of gravity.
    #[cfg_attr(
        feature = "clap",
        arg(long, value_parser = tuple::<3>, allow_hyphen_values = true, value_name = "X,Y,Z")
    )]
    pub gravity: Option<[f64; 3]>,
    /// The sum of barriers for a contact: exclusive pushes a point once however a flat surface is divided, plain adds all pairs.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "PAIRS"))]
    pub pairs: Option<PairSet>,
    /// The projection of second derivatives of barriers to positive semi-definite matrices.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "NAME"))]
    pub projection: Option<Projection>,
    /// The time integrator: implicit Euler damps, bdf2 is of second order.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "NAME"))]
    pub integrator: Option<Integrator>,
    /// When the exact test looks for intersections.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "WHEN"))]
    pub check: Option<Check>,
    /// The speed of the fastest vertex of a Newton step below which a step in time is done.
    #[cfg_attr(feature = "clap", arg(long, value_name = "SPEED"))]
    pub tolerance: Option<f64>,
    /// The stiffness of barriers, kept fixed; by default it is chosen from the weight and raised where surfaces come too close.
    #[cfg_attr(feature = "clap", arg(long, value_name = "KAPPA"))]
    pub stiffness: Option<f64>,
}

impl Request for ContactRequest {
    const NAME: &'static str = "contact";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time];
    type Report = ContactReport;
}
