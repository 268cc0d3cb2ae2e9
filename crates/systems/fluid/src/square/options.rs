//! Options of a simulation in the square.

use crate::{FluidError, Wall};
use std::fmt;
use std::str::FromStr;

/// The discretisation of the velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "String", into = "String"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(with = "String"))]
pub enum SquareScheme {
    /// Components on the sides of cells (marker and cell): divergence is zero to rounding. Supports obstacles.
    #[default]
    Mac,
    /// Both components at the centres of cells, with a ring of ghost cells, as in Stam's code for games but in double precision;
    /// the projection is approximate.
    Stam {
        /// Gauss–Seidel sweeps for each linear system, 20 in that code; `None` for direct solves.
        sweeps: Option<usize>,
    },
}

impl SquareScheme {
    /// The scheme with a name: `mac`, `stam`, or `stam:SWEEPS`.
    pub fn named(name: &str) -> Option<Self> {
        match name.split_once(':') {
            None if name == "mac" => Some(Self::Mac),
            None if name == "stam" => Some(Self::Stam { sweeps: None }),
            Some(("stam", sweeps)) => {
                let sweeps = sweeps.parse().ok().filter(|&n: &usize| n > 0)?;
                Some(Self::Stam { sweeps: Some(sweeps) })
            }
            _ => None,
        }
    }
}

impl fmt::Display for SquareScheme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mac => f.write_str("mac"),
            Self::Stam { sweeps: None } => f.write_str("stam"),
            Self::Stam { sweeps: Some(sweeps) } => write!(f, "stam:{sweeps}"),
        }
    }
}

/// Conditions at the edges of the square.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "String", into = "String"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(with = "String"))]
pub enum Edges {
    /// Walls.
    #[default]
    Walls,
    /// Opposite edges are identified.
    Periodic,
    /// Inflow on the left with a given speed, outflow on the right, free-slip walls above and below; for [`SquareScheme::Mac`].
    Channel {
        /// The speed of the inflow.
        speed: f64,
    },
}

impl Edges {
    /// The edges with a name: `walls`, `periodic`, or `channel:SPEED`.
    pub fn named(name: &str) -> Option<Self> {
        match name.split_once(':') {
            None if name == "walls" => Some(Self::Walls),
            None if name == "periodic" => Some(Self::Periodic),
            Some(("channel", speed)) => Some(Self::Channel { speed: speed.parse().ok()? }),
            _ => None,
        }
    }
}

impl fmt::Display for Edges {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Walls => f.write_str("walls"),
            Self::Periodic => f.write_str("periodic"),
            Self::Channel { speed } => write!(f, "channel:{speed}"),
        }
    }
}

/// Text of a type with a name.
macro_rules! as_text {
    ($($Named:ty: $expected:literal),*) => {
        $(
            impl FromStr for $Named {
                type Err = &'static str;

                fn from_str(text: &str) -> Result<Self, Self::Err> {
                    Self::named(text).ok_or(concat!("expected ", $expected))
                }
            }

            impl TryFrom<String> for $Named {
                type Error = &'static str;

                fn try_from(text: String) -> Result<Self, Self::Error> {
                    text.parse()
                }
            }

            impl From<$Named> for String {
                fn from(value: $Named) -> Self {
                    value.to_string()
                }
            }
        )*
    };
}

as_text!(SquareScheme: "mac, stam or stam:SWEEPS", Edges: "walls, periodic or channel:SPEED");

/// A transported density in the square.
#[derive(Clone, Debug, PartialEq)]
pub struct SquareDensity {
    /// The name.
    pub name: String,
    /// Initial value in each cell, row by row from below.
    pub initial: Vec<f64>,
    /// Diffusivity.
    pub diffusivity: f64,
    /// The weight: the acceleration is weight times value times gravity.
    pub weight: f64,
    /// Source in each cell per time.
    pub source: Option<Vec<f64>>,
}

/// Options of a [`Square`](super::Square), the unit square with n × n cells.
#[derive(Clone, Debug, PartialEq)]
pub struct SquareOptions {
    /// Cells on each side.
    pub cells: usize,
    /// The discretisation of the velocity.
    pub scheme: SquareScheme,
    /// Conditions at the edges.
    pub edges: Edges,
    /// Length of a time step.
    pub time_step: f64,
    /// Kinematic viscosity.
    pub viscosity: f64,
    /// The condition for a viscous flow at walls and obstacles, for [`SquareScheme::Mac`]. Stam's walls are free-slip.
    pub wall: Wall,
    /// The velocity of the upper wall to the right, for [`Wall::NoSlip`].
    pub lid: f64,
    /// Gravity, which acts on densities with weight.
    pub gravity: [f64; 2],
    /// An acceleration in each cell.
    pub force: Option<Vec<[f64; 2]>>,
    /// The cells that are obstacles.
    pub solid: Option<Vec<bool>>,
    /// The transported densities.
    pub densities: Vec<SquareDensity>,
}

/// Largest number of cells on a side: factors of larger systems take several gigabytes.
pub(super) const MOST_CELLS: usize = 4096;

impl SquareOptions {
    /// An inviscid flow between walls without forces.
    pub fn new(cells: usize, time_step: f64) -> Self {
        Self {
            cells,
            scheme: SquareScheme::default(),
            edges: Edges::default(),
            time_step,
            viscosity: 0.0,
            wall: Wall::default(),
            lid: 0.0,
            gravity: [0.0; 2],
            force: None,
            solid: None,
            densities: Vec::new(),
        }
    }

    pub(super) fn is_periodic(&self) -> bool {
        self.edges == Edges::Periodic
    }

    pub(super) fn check(&self) -> Result<(), FluidError> {
        super::Square::check_cells(self.cells)?;
        let positive = |what, value: f64| {
            let ok = value > 0.0 && value.is_finite();
            if ok { Ok(()) } else { Err(FluidError::Parameter { what, value, expected: "above 0" }) }
        };
        let not_negative = |what, value: f64| {
            let ok = value >= 0.0 && value.is_finite();
            if ok { Ok(()) } else { Err(FluidError::Parameter { what, value, expected: "not negative" }) }
        };
        let any = |what, value: f64| {
            let expected = "finite";
            if value.is_finite() { Ok(()) } else { Err(FluidError::Parameter { what, value, expected }) }
        };
        positive("time step", self.time_step)?;
        not_negative("viscosity", self.viscosity)?;
        any("velocity of the lid", self.lid)?;
        self.gravity.iter().try_for_each(|&g| any("gravity", g))?;
        if let Edges::Channel { speed } = self.edges {
            any("speed of the inflow", speed)?;
        }
        let is_stam = matches!(self.scheme, SquareScheme::Stam { .. });
        let channel = matches!(self.edges, Edges::Channel { .. });
        if is_stam && (self.solid.is_some() || channel || self.lid != 0.0) {
            return Err(FluidError::StamHasNone);
        }
        let count = self.cells * self.cells;
        let fits = |what, found: usize| {
            let (element, expected) = ("cell", count);
            if found == count { Ok(()) } else { Err(FluidError::Length { what, element, found, expected }) }
        };
        let finite = |what, values: &[f64]| {
            fits(what, values.len())?;
            match values.iter().position(|x| !x.is_finite()) {
                None => Ok(()),
                Some(index) => {
                    Err(FluidError::NonFinite { what, element: "cell", index, value: values[index] })
                }
            }
        };
        if let Some(force) = &self.force {
            fits("force", force.len())?;
            (0..2).try_for_each(|k| finite("force", &force.iter().map(|f| f[k]).collect::<Vec<_>>()))?;
        }
        if let Some(solid) = &self.solid {
            fits("list of obstacles", solid.len())?;
        }
        for density in &self.densities {
            not_negative("diffusivity", density.diffusivity)?;
            any("weight of a density", density.weight)?;
            finite("density", &density.initial)?;
            density.source.iter().try_for_each(|source| finite("source of a density", source))?;
        }
        Ok(())
    }
}
