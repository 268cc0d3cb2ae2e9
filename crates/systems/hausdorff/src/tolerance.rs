//! How narrow an enclosure is asked for.

use pompeiu_core::request::LengthError;
use pompeiu_core::run::LimitError;

/// The width of the enclosure to aim for.
///
/// Serialised as two keys, `tolerance` for the number and `tolerance_kind` for [`Tolerance::kind`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "tolerance_kind", content = "tolerance"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Tolerance {
    /// A fraction of the diagonal of the joint bounding box of the faces of A and B.
    #[cfg_attr(feature = "serde", serde(rename = "diagonal"))]
    RelativeToDiagonal(f64),
    /// A fraction of the distance itself. For a distance of zero no width meets it, and the search ends where double
    /// precision does.
    #[cfg_attr(feature = "serde", serde(rename = "relative"))]
    RelativeToDistance(f64),
    /// A length in the unit of the meshes.
    #[cfg_attr(feature = "serde", serde(rename = "absolute"))]
    Absolute(f64),
}

impl Default for Tolerance {
    /// [`Tolerance::DEFAULT_FRACTION`] of the joint diagonal.
    fn default() -> Self {
        Self::RelativeToDiagonal(Self::DEFAULT_FRACTION)
    }
}

impl Tolerance {
    /// The default fraction of the joint diagonal. Some 9000 units in the last place: searching ends rather than
    /// converges, so a coarser one saves little.
    pub const DEFAULT_FRACTION: f64 = 1e-12;

    /// The kind of tolerance in a word, as programs want it: what the number is a fraction of, or `absolute`.
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::RelativeToDiagonal(_) => "diagonal",
            Self::RelativeToDistance(_) => "relative",
            Self::Absolute(_) => "absolute",
        }
    }

    /// Whether the number makes sense.
    ///
    /// # Errors
    /// [`OptionError::Tolerance`] unless it is finite and not negative.
    pub fn check(&self) -> Result<(), OptionError> {
        let value = self.value();
        if (0.0..f64::INFINITY).contains(&value) { Ok(()) } else { Err(OptionError::Tolerance(value)) }
    }

    /// The number, without its meaning.
    pub const fn value(&self) -> f64 {
        match *self {
            Self::RelativeToDiagonal(x) | Self::RelativeToDistance(x) | Self::Absolute(x) => x,
        }
    }
}

/// An option that cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OptionError {
    /// The tolerance is negative or not a finite number.
    #[error("the tolerance is {0}; it must be a finite number that is not negative")]
    Tolerance(f64),
    /// The threshold is negative or not a finite number.
    #[error("the threshold is {0}; it must be a finite number that is not negative")]
    Threshold(f64),
    /// The slack of a certificate is negative or not a finite number.
    #[error("the slack of the certificate is {0}; it must be a finite number that is not negative")]
    Slack(f64),
    /// The accuracy is not a positive, finite number.
    #[error("the accuracy is {0}; it must be a finite number greater than 0")]
    Accuracy(f64),
    /// A share of an area that has no percentile.
    #[error("the share is {0}; it must lie between 0 and 1, both excluded")]
    Share(f64),
    /// A limit that makes no sense.
    #[error(transparent)]
    Limit(#[from] LimitError),
    /// A length cannot be converted to the unit of the meshes.
    #[error(transparent)]
    Length(#[from] LengthError),
    /// A list of stages must descend.
    #[error(
        "stage {index} has tolerance {tolerance}; each must be finite, positive and below the one before"
    )]
    Stage {
        /// Position in the list.
        index: usize,
        /// Its tolerance.
        tolerance: f64,
    },
}

/// Checks that a threshold is a length.
pub(crate) fn check_threshold(threshold: f64) -> Result<(), OptionError> {
    if (0.0..f64::INFINITY).contains(&threshold) { Ok(()) } else { Err(OptionError::Threshold(threshold)) }
}

/// # Errors
/// [`OptionError::Slack`] unless it is finite and not negative.
pub(crate) fn check_slack(slack: f64) -> Result<(), OptionError> {
    if (0.0..f64::INFINITY).contains(&slack) { Ok(()) } else { Err(OptionError::Slack(slack)) }
}
