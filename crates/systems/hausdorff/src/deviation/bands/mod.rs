//! Signed tolerance bands: how much of an area lies how far on which side.

mod cut;
mod run;
mod share;
mod side;

use crate::report::{Enclosure, StopReason};

/// Tolerance bands of signed deviations, as classes that follow each other.
///
/// # Definition
/// The deviation of B from A is signed: positive where B has more than A, negative where it lacks something. At a point of B it is
/// the distance from A, negative inside A. At a point of A it is the distance from B, negative outside of B. Inside is where the
/// magnitude of the winding number is above one half, and behind a sheet ([`Sides`](super::Sides)).
///
/// With the ends of all bands in ascending order `e_0 < … < e_n`, the classes are: below `e_0`, which is too low; from `e_0` to
/// `e_1`, both included; above `e_1` up to `e_2`, and so on; above `e_n`, which is too high.
///
/// # Example
/// ```
/// use pompeiu_core::mesh::shapes::cube;
/// use pompeiu_core::run::Limits;
/// use pompeiu_hausdorff::DeviationOptions;
/// use pompeiu_hausdorff::deviation::Bands;
///
/// // A cube that came out larger by 0.1 on all sides.
/// let (a, b) = (cube(2.0, 2)?, cube(2.2, 2)?);
/// let deviation = DeviationOptions::default().symmetric(&a, &b)?;
/// let bands = Bands::new(&[[-0.05, 0.05]])?;
/// let found = deviation.bands(&a, &b, &bands, 0.01, &Limits::default(), None);
/// assert!(found.b_to_a.shares.unwrap()[2].lower() > 0.99);
/// assert!(found.b_to_a.lowest.lower > 0.08 && found.b_to_a.lowest.upper < 0.1001);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Bands {
    edges: Vec<f64>,
}

/// Bands that make no sense.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BandError {
    /// No band.
    #[error("there is no tolerance band; at least one is needed")]
    None,
    /// An end that is no number, or ends the wrong way round.
    #[error(
        "a tolerance band reaches from {0} to {1}; the first must be less than the second, and both finite"
    )]
    Ends(f64, f64),
    /// A part between two bands belongs to none.
    #[error("the tolerance bands leave out what lies between {0} and {1}; bands must touch or overlap")]
    Gap(f64, f64),
}

impl Bands {
    /// Bands from their ends. They may touch, overlap or lie in each other.
    ///
    /// # Errors
    /// [`BandError`] for none, for ends that are not finite or do not ascend, and for a gap between bands.
    pub fn new(bands: &[[f64; 2]]) -> Result<Self, BandError> {
        let mut sorted = bands.to_vec();
        sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let Some(&[_, mut reached]) = sorted.first() else { return Err(BandError::None) };
        for &[low, high] in &sorted {
            if !(low < high && low.is_finite() && high.is_finite()) {
                return Err(BandError::Ends(low, high));
            }
            if low > reached {
                return Err(BandError::Gap(reached, low));
            }
            reached = if high > reached { high } else { reached };
        }
        // Adding zero makes both zeros one.
        let mut edges: Vec<f64> = sorted.iter().flatten().map(|x| x + 0.0).collect();
        edges.sort_by(f64::total_cmp);
        edges.dedup();
        Ok(Self { edges })
    }

    /// The ends of all bands, in ascending order: at least two.
    pub fn edges(&self) -> &[f64] {
        &self.edges
    }

    /// The least and the greatest deviation that is within tolerance.
    pub fn ends(&self) -> [f64; 2] {
        [self.edges[0], self.edges[self.edges.len() - 1]]
    }

    /// The class of a deviation: 0 is too low, `edges().len()` too high.
    pub fn class(&self, deviation: f64) -> usize {
        let Some((first, rest)) = self.edges.split_first() else { return 0 };
        if deviation < *first { 0 } else { 1 + rest.iter().filter(|edge| deviation > **edge).count() }
    }
}

/// The share of both surfaces in each class.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BandReport {
    /// Ends of the classes between the first, which is too low, and the last, which is too high; ascending.
    pub edges: Vec<f64>,
    /// Of the points of A: what is missing in B is negative, where B has more is positive.
    pub a_to_b: DirectedBands,
    /// Of the points of B: outside of A is positive, inside of it negative.
    pub b_to_a: DirectedBands,
}

/// The share of one surface in each class.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DirectedBands {
    /// Encloses the least signed deviation.
    pub lowest: Extreme,
    /// Encloses the greatest signed deviation.
    pub highest: Extreme,
    /// For each class the share of the area, enclosed; null for a surface without area.
    pub shares: Option<Vec<Enclosure>>,
    /// Whether the other surface is closed. Beside the boundary of an open one, which side is inside is a choice.
    pub closed: bool,
    /// The reason for which cutting ended: [`StopReason::Tolerance`] if all shares are as narrow as requested; they hold in every case.
    pub stop: StopReason,
}

/// Two bounds that are proven to hold a signed number between them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Extreme {
    /// At most the number.
    pub lower: f64,
    /// At least the number.
    pub upper: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_become_classes() {
        let bands = Bands::new(&[[-0.1, 0.2], [-0.05, 0.05]]).unwrap();
        assert_eq!(bands.edges(), [-0.1, -0.05, 0.05, 0.2]);
        assert_eq!(bands.ends(), [-0.1, 0.2]);
        let classes = [-0.2, -0.1, -0.05, 0.0, 0.05, 0.06, 0.2, 0.3].map(|x| bands.class(x));
        assert_eq!(classes, [0, 1, 1, 2, 2, 3, 3, 4]);
        assert_eq!(Bands::new(&[[0.0, 1.0], [-1.0, -0.0]]).unwrap().edges(), [-1.0, 0.0, 1.0]);
    }

    #[test]
    fn bands_without_sense_are_refused() {
        assert_eq!(Bands::new(&[]), Err(BandError::None));
        assert_eq!(Bands::new(&[[1.0, 1.0]]), Err(BandError::Ends(1.0, 1.0)));
        assert_eq!(Bands::new(&[[0.0, f64::INFINITY]]), Err(BandError::Ends(0.0, f64::INFINITY)));
        assert!(Bands::new(&[[f64::NAN, 1.0]]).is_err());
        assert_eq!(Bands::new(&[[0.5, 1.0], [-1.0, 0.0]]), Err(BandError::Gap(0.0, 0.5)));
    }
}
