//! Options of a coupling.

use crate::CouplingError;
use std::str::FromStr;

/// The coupling scheme, which computes the next input from the previous solves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "String", into = "String"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(with = "String"))]
#[non_exhaustive]
pub enum Scheme {
    /// Fixed-point iteration: the output is the next input.
    Fixed,
    /// Constant relaxation: `x + ω (x̃ − x)`.
    Constant(f64),
    /// Relaxation by Aitken's formula from the last two changes; the first factor is given.
    Aitken(f64),
    /// Interface quasi-Newton with the inverse Jacobian from least squares.
    #[default]
    IqnIls,
    /// Interface quasi-Newton with the inverse Jacobian that is nearest to that of the previous window: a dense matrix.
    IqnImvj,
    /// A least-squares model of each solver (block quasi-Newton).
    TwoModels,
}

impl Scheme {
    /// The one of a name: `fixed`, `constant:W`, `aitken`, `aitken:W`, `iqn-ils`, `iqn-imvj`, `two-models`.
    pub fn named(name: &str) -> Option<Self> {
        let number = |text: &str| text.parse().ok().filter(|w: &f64| w.is_finite() && *w != 0.0);
        match name.split_once(':') {
            Some(("constant", w)) => Some(Self::Constant(number(w)?)),
            Some(("aitken", w)) => Some(Self::Aitken(number(w)?)),
            Some(_) => None,
            None => match name {
                "fixed" => Some(Self::Fixed),
                "aitken" => Some(Self::Aitken(0.5)),
                "iqn-ils" => Some(Self::IqnIls),
                "iqn-imvj" | "imvj" => Some(Self::IqnImvj),
                "two-models" => Some(Self::TwoModels),
                _ => None,
            },
        }
    }

    /// Its name, as [`named`](Self::named) reads it.
    pub fn name(self) -> String {
        match self {
            Self::Fixed => "fixed".to_owned(),
            Self::Constant(w) => format!("constant:{w}"),
            Self::Aitken(w) => format!("aitken:{w}"),
            Self::IqnIls => "iqn-ils".to_owned(),
            Self::IqnImvj => "iqn-imvj".to_owned(),
            Self::TwoModels => "two-models".to_owned(),
        }
    }

    /// Whether it has a model, whose residual may be damped.
    pub(crate) fn has_model(self) -> bool {
        matches!(self, Self::IqnIls | Self::IqnImvj | Self::TwoModels)
    }
}

impl FromStr for Scheme {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::named(text).ok_or_else(|| {
            format!("there is no scheme `{text}`; choose fixed, constant:W, aitken, aitken:W, iqn-ils, iqn-imvj or two-models")
        })
    }
}

impl TryFrom<String> for Scheme {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<Scheme> for String {
    fn from(scheme: Scheme) -> Self {
        scheme.name()
    }
}

/// Treatment of an enclosed region.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Closed {
    /// The pressure constant is chosen so that the displacement of the solid equals the inflow.
    #[default]
    Project,
    /// The run ends with an error that states the imbalance.
    Refuse,
}

/// Options of a [`Coupling`](crate::Coupling).
#[derive(Clone, Debug, PartialEq)]
pub struct CouplingOptions {
    /// How the next input is computed.
    pub scheme: Scheme,
    /// A window has converged when both data change by less than this, relative to their Euclidean norms.
    pub tolerance: f64,
    /// Largest number of solves of each attempt at a window.
    pub most_solves: usize,
    /// Number of earlier windows whose solves are reused.
    pub reuse: usize,
    /// A column is dropped if its component orthogonal to newer ones is shorter than this share of its length.
    pub filter: f64,
    /// Order of extrapolation for the initial guess of a window: 0, 1 or 2.
    pub extrapolation: usize,
    /// Relaxation factor of the first change, before there is a model.
    pub initial_relaxation: f64,
    /// Damping factors for the residual that the model does not explain, tried in order when a window fails.
    pub damping: Vec<f64>,
    /// Treatment of an enclosed region.
    pub closed: Closed,
}

impl Default for CouplingOptions {
    fn default() -> Self {
        Self {
            scheme: Scheme::default(),
            tolerance: 1e-5,
            most_solves: 60,
            reuse: 8,
            filter: 1e-3,
            extrapolation: 2,
            initial_relaxation: 0.01,
            damping: vec![1.0, 0.3, 0.1, 0.03],
            closed: Closed::default(),
        }
    }
}

impl CouplingOptions {
    pub(crate) fn check(&self) -> Result<(), CouplingError> {
        let above = |what, value: f64, most: f64, expected| {
            let ok = value > 0.0 && value < most;
            if ok { Ok(()) } else { Err(CouplingError::Parameter { what, value, expected }) }
        };
        above("tolerance", self.tolerance, 1.0, "above 0 and below 1")?;
        above("filter", self.filter, 1.0, "above 0 and below 1")?;
        above("initial relaxation", self.initial_relaxation, f64::INFINITY, "above 0")?;
        for &part in &self.damping {
            above("damping", part, f64::INFINITY, "above 0")?;
        }
        if let Scheme::Constant(value) | Scheme::Aitken(value) = self.scheme
            && !(value.is_finite() && value != 0.0)
        {
            let expected = "not 0";
            return Err(CouplingError::Parameter { what: "relaxation", value, expected });
        }
        let counted = |what, value: usize, least: usize, most: usize, expected| {
            let ok = (least..=most).contains(&value);
            if ok { Ok(()) } else { Err(CouplingError::Parameter { what, value: value as f64, expected }) }
        };
        counted("order of the extrapolation", self.extrapolation, 0, 2, "0, 1 or 2")?;
        counted("most solves of a window", self.most_solves, 2, usize::MAX, "at least 2")
    }
}
