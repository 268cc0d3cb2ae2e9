//! The tables of a scene.

use super::FluidRequestError;
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer, Serialize};
use std::path::PathBuf;

/// A ball in space.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Ball {
    /// Its centre.
    pub at: [f64; 3],
    /// Its radius.
    pub radius: f64,
}

impl Ball {
    /// The ball, if its radius is finite and above 0.
    pub(super) fn checked(self) -> Result<Self, FluidRequestError> {
        if self.radius > 0.0 && self.radius.is_finite() {
            Ok(self)
        } else {
            Err(FluidRequestError::Radius(self.radius))
        }
    }
}

/// Tables of a ball and one further value.
macro_rules! in_balls {
    ($($(#[doc = $doc:literal])* $Name:ident { $(#[doc = $field:literal])* $value:ident: $kind:ty })*) => {
        $(
            $(#[doc = $doc])*
            #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
            #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
            #[serde(deny_unknown_fields)]
            pub struct $Name {
                /// The centre of the ball.
                pub at: [f64; 3],
                /// The radius of the ball.
                pub radius: f64,
                $(#[doc = $field])*
                pub $value: $kind,
            }

            impl $Name {
                /// Where it is.
                pub(super) fn ball(&self) -> Result<Ball, FluidRequestError> {
                    Ball { at: self.at, radius: self.radius }.checked()
                }
            }
        )*
    };
}

in_balls! {
    /// A Gaussian of vorticity, whose standard deviation is the radius.
    Vortex {
        /// The integral of its vorticity.
        circulation: f64
    }
    /// An acceleration in a ball.
    LocalForce {
        /// The acceleration.
        acceleration: [f64; 3]
    }
    /// Boundary edges in a ball that move along themselves.
    MovingWall {
        /// Their speed, counter-clockwise around the surface.
        speed: f64
    }
    /// Inflow through boundary edges in a ball.
    InflowScene {
        /// Its speed.
        speed: f64
    }
}

/// A coordinate axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    #[default]
    Z,
}

/// A density that the fluid carries.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct DensityScene {
    /// Its name.
    pub name: String,
    /// Initial values: an expression in x, y and z.
    pub initial: Option<String>,
    /// A picture of the initial values, black for 1 and white for 0, which are added to those of the expression.
    pub picture: Option<PathBuf>,
    /// The axis along which the picture is seen.
    pub axis: Axis,
    /// Diffusivity, squared length per time.
    pub diffusivity: f64,
    /// The acceleration is this times the value times gravity.
    pub weight: f64,
    /// A source: its place and its rate.
    #[serde(deserialize_with = "one_or_many")]
    pub source: Vec<Source>,
}

impl Default for DensityScene {
    fn default() -> Self {
        Self {
            name: "density".to_owned(),
            initial: None,
            picture: None,
            axis: Axis::default(),
            diffusivity: 0.0,
            weight: 0.0,
            source: Vec::new(),
        }
    }
}

/// A source of a density: a ball, or the dark of a picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// The centre of the ball.
    #[serde(default)]
    pub at: Option<[f64; 3]>,
    /// The radius of the ball; the nearest vertex is in it in any case.
    #[serde(default)]
    pub radius: Option<f64>,
    /// A picture instead of a ball.
    #[serde(default)]
    pub picture: Option<PathBuf>,
    /// The axis along which the picture is seen.
    #[serde(default)]
    pub axis: Axis,
    /// The amount that is added per time, below zero for a sink.
    pub rate: f64,
}

/// A list of tables, or one alone.
pub(super) fn one_or_many<'de, D, T>(deserializer: D) -> Result<Vec<T>, D::Error>
where
    D: Deserializer<'de>,
    T: DeserializeOwned,
{
    let value = match serde_json::Value::deserialize(deserializer)? {
        one @ serde_json::Value::Object(_) => serde_json::Value::Array(vec![one]),
        many => many,
    };
    serde_json::from_value(value).map_err(D::Error::custom)
}

/// A table as text: `name = value, …`.
#[cfg(feature = "clap")]
pub(super) fn table<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    #[derive(Deserialize)]
    struct Line<T> {
        table: T,
    }
    let read: Result<Line<T>, _> = toml::from_str(&format!("table = {{ {text} }}"));
    read.map(|line| line.table).map_err(|error| error.message().to_owned())
}

/// A density as text: a table, or an expression for its initial values.
#[cfg(feature = "clap")]
pub(super) fn density(text: &str) -> Result<DensityScene, String> {
    let is_table = toml::from_str::<toml::Table>(&format!("table = {{ {text} }}")).is_ok();
    if is_table {
        table(text)
    } else {
        Ok(DensityScene { initial: Some(text.to_owned()), ..DensityScene::default() })
    }
}
