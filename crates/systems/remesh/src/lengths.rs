//! What lengths and distances can be asked for, and whether a distance is kept.

use pompeiu_hausdorff::SymmetricReport;

/// Least distance and least length of edges that can be asked for, as a fraction of the diagonal of the bounding box: some 4,500 units
/// in the last place of the largest coordinate.
const LEAST_LENGTH: f64 = 1e-12;

/// Why a length cannot be asked for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LengthError {
    /// It is not a positive finite number.
    #[error("the {what} is {length}; it must be a positive finite number")]
    NotPositive {
        /// Which one.
        what: &'static str,
        /// Its value.
        length: f64,
    },
    /// It is too small for double precision.
    #[error(
        "the {what} {length} is below {least}, the least that double precision resolves for these coordinates; ask for more"
    )]
    BelowRounding {
        /// Which one.
        what: &'static str,
        /// What was asked for.
        length: f64,
        /// The least that can be asked for.
        least: f64,
    },
}

/// Whether a length can be asked for on a mesh with this diagonal.
pub(super) fn check_length(what: &'static str, length: f64, diagonal: f64) -> Result<(), LengthError> {
    let least = LEAST_LENGTH * diagonal;
    if !(length > 0.0 && length < f64::INFINITY) {
        Err(LengthError::NotPositive { what, length })
    } else if length < least {
        Err(LengthError::BelowRounding { what, length, least })
    } else {
        Ok(())
    }
}

/// A result is farther from the input than asked for, as far as is proven.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the result is up to {upper} away from the input near {place:?}, more than the {distance} asked for")]
pub struct NotWithin {
    /// What was asked for.
    pub distance: f64,
    /// The proven upper bound.
    pub upper: f64,
    /// A point of one surface that is about as far from the other.
    pub place: [f64; 3],
}

impl NotWithin {
    pub(super) fn check(distance: f64, found: &SymmetricReport) -> Result<(), Self> {
        let upper = found.distance.upper();
        let directed = [&found.a_to_b, &found.b_to_a];
        let [a, b] = directed.map(|report| report.distance.upper());
        let place = directed[usize::from(b > a)].witness.from.position;
        if upper <= distance { Ok(()) } else { Err(Self { distance, upper, place }) }
    }
}
