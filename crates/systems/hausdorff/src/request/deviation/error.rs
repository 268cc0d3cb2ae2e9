//! Why a deviation cannot be measured as asked.

use crate::OptionError;
use crate::deviation::BandError;
use pompeiu_core::request::LengthError;

/// Why a deviation cannot be measured as asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DeviationRequestError {
    /// An option makes no sense.
    #[error(transparent)]
    Option(#[from] OptionError),
    /// A length cannot be converted to the unit of the meshes.
    #[error(transparent)]
    Length(#[from] LengthError),
    /// The tolerance bands make no sense.
    #[error(transparent)]
    Band(#[from] BandError),
    /// Both kinds of tolerance.
    #[error("a threshold cannot be used with tolerance bands; give one of them")]
    TwoTolerances,
    /// Inside is to be told from outside, and is not.
    #[error("signed and unsigned distances cannot be asked for together; give one of them, or neither")]
    SignedAndUnsigned,
    /// A share may be outside of a tolerance that is not given.
    #[error(
        "a share of the area is allowed to be out of tolerance, but there is none; give a threshold or a tolerance band"
    )]
    NothingAllowed,
    /// A share that is none.
    #[error("the allowed share is {0}; it must be above 0 and at most 1")]
    Allowed(f64),
    /// A percentile that is none.
    #[error("the percentile is {0}; percentiles are in percent of the area, at least 1 and below 100")]
    Percentile(f64),
    /// A least share of connected parts that is none.
    #[error("connected parts below a share of {0} are to be left out; it must be above 0 and at most 1")]
    Component(f64),
    /// No mesh has a group of any of the names.
    #[error("neither file has a group {}{}", quoted(names), listed(known))]
    Group {
        /// The names that were given.
        names: Vec<String>,
        /// Some of the names that there are.
        known: Vec<String>,
    },
    /// Nothing of a mesh is left.
    #[error("nothing of {0} is left to be measured")]
    NothingLeft(&'static str),
}

fn quoted(names: &[String]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(" or ")
}

fn listed(known: &[String]) -> String {
    if known.is_empty() { "; they have none".to_owned() } else { format!("; there are {}", known.join(", ")) }
}
