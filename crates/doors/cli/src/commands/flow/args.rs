//! Options of the flow command.

use crate::args::{Centered, Intersections, Limits, Picture};
use crate::numbers::{direction, magnitude};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use pompeiu::flow::{Scheme, Until};
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Let a surface flow to less area: minimal surfaces, mean curvature flow, bubbles
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
pub(crate) struct Flow {
    /// The mesh file
    pub(crate) mesh: PathBuf,
    /// How the surface is moved
    #[arg(long, value_parser = scheme(), value_name = "NAME")]
    pub(crate) scheme: Option<Scheme>,
    /// When to end: stationary, stationary:TOL, time:T or steps:N
    #[arg(long, value_parser = until, default_value = "stationary", value_name = "END")]
    pub(crate) until: Until,
    /// Length of a step in time; by default each is chosen
    #[arg(long, value_parser = magnitude, value_name = "T")]
    pub(crate) time_step: Option<f64>,
    /// Let the boundary slide in planes with this normal: x, y, z or three numbers
    #[arg(long, value_parser = direction, allow_hyphen_values = true, value_name = "NORMAL")]
    pub(crate) planes: Option<[f64; 3]>,
    /// What becomes of the enclosed volume
    #[arg(long, value_enum, default_value_t)]
    pub(crate) volume: Volume,
    /// Remesh to edges of this length on the way
    #[arg(long, value_parser = magnitude, value_name = "LENGTH")]
    pub(crate) remesh: Option<f64>,
    /// Steps between two remeshings
    #[arg(long, default_value = "5", value_name = "N", requires = "remesh")]
    pub(crate) remesh_every: NonZeroUsize,
    #[command(flatten)]
    pub(crate) guard: Intersections,
    #[command(flatten)]
    pub(crate) centered: Centered,
    /// The mesh file to write
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Write every step as VTP, with a list of them for ParaView
    #[arg(long, value_name = "FILE.pvd")]
    pub(crate) series: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) picture: Picture,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Volume {
    /// It changes
    #[default]
    Free,
    /// It stays: a soap bubble
    Keep,
}

/// Parses when to end.
fn until(text: &str) -> Result<Until, String> {
    let number = |rest: &str| rest.parse::<f64>().map_err(|_| format!("`{rest}` is no number"));
    match text.split_once(':') {
        None if text == "stationary" => Ok(Until::STATIONARY),
        Some(("stationary", rest)) => number(rest).map(Until::Stationary),
        Some(("time", rest)) => number(rest).map(Until::Time),
        Some(("steps", rest)) => {
            rest.parse().map(Until::Steps).map_err(|_| format!("`{rest}` is no whole number"))
        }
        _ => Err("expected stationary, stationary:TOL, time:T or steps:N".to_owned()),
    }
}

/// Parses the name of a scheme.
fn scheme() -> impl TypedValueParser<Value = Scheme> {
    PossibleValuesParser::new(Scheme::ALL.map(Scheme::name))
        .try_map(|name| Scheme::named(&name).ok_or("there is no such scheme"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_told_apart() {
        assert_eq!(until("stationary"), Ok(Until::STATIONARY));
        assert_eq!(until("stationary:1e-6"), Ok(Until::Stationary(1e-6)));
        assert_eq!(until("time:0.5"), Ok(Until::Time(0.5)));
        assert_eq!(until("steps:7"), Ok(Until::Steps(7)));
        for wrong in ["", "time", "steps:1.5", "time:x", "never"] {
            assert!(until(wrong).is_err(), "{wrong}");
        }
    }
}
