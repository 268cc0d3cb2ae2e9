//! Which value gets which colour.

use super::{ColorMap, Rgb};
use thiserror::Error;

/// What a [`Scale`] cannot be made of.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum ScaleError {
    /// An end is infinite or not a number.
    #[error("a colour scale needs finite ends, but one of them is {value}")]
    NonFinite {
        /// The end.
        value: f64,
    },
    /// The ends are in the wrong order.
    #[error("a colour scale goes from its lower end to its upper end, but {low} is above {high}")]
    Reversed {
        /// The end that should be the lower one.
        low: f64,
        /// The end that should be the upper one.
        high: f64,
    },
}

/// Which value gets which colour: a map stretched over a range, a colour for what has no value, and perhaps a limit
/// beyond which values get a colour of their own.
///
/// # Shapes and units
/// The ends of the range and the limit are in the unit of the values.
///
/// # Example
/// ```
/// use pompeiu_figures::{ColorMap, Scale};
///
/// let scale = Scale::symmetric(ColorMap::Vik, 0.5)?;
/// assert_eq!(scale.range(), (-0.5, 0.5));
/// assert_eq!(scale.color(-0.5), [0, 18, 97]);
/// # Ok::<(), pompeiu_figures::ScaleError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    map: ColorMap,
    low: f64,
    high: f64,
    missing: Rgb,
    limit: Option<f64>,
}

impl Scale {
    /// The colour of what has no value, unless another is chosen: a middle grey, which is in no map.
    const MISSING: Rgb = [150, 150, 150];

    /// A map stretched over a range.
    ///
    /// The ends may be equal, as they are for distances that are all zero; values up to it then get the first colour.
    ///
    /// # Errors
    /// [`ScaleError`] if an end is not finite, or the lower one is above the upper one.
    pub fn new(map: ColorMap, low: f64, high: f64) -> Result<Self, ScaleError> {
        if let Some(value) = [low, high].into_iter().find(|end| !end.is_finite()) {
            return Err(ScaleError::NonFinite { value });
        }
        if low > high {
            return Err(ScaleError::Reversed { low, high });
        }
        Ok(Self { map, low, high, missing: Self::MISSING, limit: None })
    }

    /// A map stretched over the range from `-extent` to `extent`, as diverging maps want it.
    ///
    /// # Errors
    /// As [`Scale::new`].
    pub fn symmetric(map: ColorMap, extent: f64) -> Result<Self, ScaleError> {
        Self::new(map, -extent, extent)
    }

    /// Gives values of a magnitude above `limit` the map's [contrast](ColorMap::contrast) colour.
    ///
    /// A limit that is not a number is none.
    #[must_use]
    pub fn with_limit(mut self, limit: f64) -> Self {
        self.limit = (!limit.is_nan()).then_some(limit);
        self
    }

    /// Gives what has no value, which is what NaN means, another colour.
    #[must_use]
    pub fn with_missing(mut self, color: Rgb) -> Self {
        self.missing = color;
        self
    }

    /// The map.
    pub fn map(&self) -> ColorMap {
        self.map
    }

    /// The ends of the range.
    pub fn range(&self) -> (f64, f64) {
        (self.low, self.high)
    }

    /// The magnitude above which values get the contrast colour.
    pub fn limit(&self) -> Option<f64> {
        self.limit
    }

    /// The colour of what has no value.
    pub fn missing(&self) -> Rgb {
        self.missing
    }

    /// Where a value lies in the range, 0 at its lower end and 1 at its upper one; outside of it, below 0 or above 1.
    ///
    /// NaN for NaN.
    pub fn place(&self, value: f64) -> f64 {
        // Halves, so that the width of a range is finite whenever its ends are.
        let width = 0.5 * self.high - 0.5 * self.low;
        let past = 0.5 * value - 0.5 * self.low;
        if width > 0.0 || past.is_nan() {
            past / width
        } else if past > 0.0 {
            1.0
        } else {
            0.0
        }
    }

    /// The colour of a value.
    pub fn color(&self, value: f64) -> Rgb {
        if value.is_nan() {
            self.missing
        } else if self.limit.is_some_and(|limit| value.abs() > limit) {
            self.map.contrast()
        } else {
            self.map.color(self.place(value))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_get_the_colour_of_their_place() {
        let scale = Scale::new(ColorMap::Viridis, 2.0, 4.0).unwrap();
        let table = ColorMap::Viridis.table();
        assert_eq!(scale.color(2.0), table[0]);
        assert_eq!(scale.color(4.0), table[255]);
        assert_eq!(scale.color(2.0 + 2.0 * 51.0 / 255.0), table[51]);
        assert_eq!([scale.color(-1e300), scale.color(1e300)], [table[0], table[255]]);
        assert_eq!([scale.color(f64::NEG_INFINITY), scale.color(f64::INFINITY)], [table[0], table[255]]);
        assert_eq!(scale.color(f64::NAN), Scale::MISSING);
        assert_eq!(scale.with_missing([1, 2, 3]).color(f64::NAN), [1, 2, 3]);
    }

    #[test]
    fn beyond_the_limit_values_stand_out_on_both_sides() {
        let scale = Scale::symmetric(ColorMap::Vik, 1.0).unwrap().with_limit(0.5);
        let contrast = ColorMap::Vik.contrast();
        assert_eq!([scale.color(0.51), scale.color(-0.51), scale.color(9.0)], [contrast; 3]);
        assert!([0.5, -0.5, 0.0].iter().all(|&value| scale.color(value) != contrast));
        assert_eq!(scale.color(f64::NAN), Scale::MISSING);
        assert_eq!(scale.with_limit(f64::NAN).limit(), None);
    }

    #[test]
    fn a_range_may_be_a_point_or_all_there_is() {
        let point = Scale::new(ColorMap::Viridis, 0.0, 0.0).unwrap();
        let table = ColorMap::Viridis.table();
        assert_eq!(
            [point.color(0.0), point.color(1e-300), point.color(f64::NAN)],
            [table[0], table[255], Scale::MISSING]
        );
        assert_eq!([point.place(-1.0), point.place(0.0), point.place(1.0)], [0.0, 0.0, 1.0]);
        let all = Scale::symmetric(ColorMap::Vik, f64::MAX).unwrap();
        assert_eq!([all.place(-f64::MAX), all.place(0.0), all.place(f64::MAX)], [0.0, 0.5, 1.0]);
        let least = Scale::new(ColorMap::Viridis, 0.0, f64::from_bits(1)).unwrap();
        assert_eq!(least.color(0.0), table[0]);
    }

    #[test]
    fn what_is_no_range_is_an_error_with_its_numbers() {
        let error = Scale::new(ColorMap::Viridis, 2.0, 1.0).unwrap_err();
        assert_eq!(error, ScaleError::Reversed { low: 2.0, high: 1.0 });
        assert_eq!(
            error.to_string(),
            "a colour scale goes from its lower end to its upper end, but 2 is above 1"
        );
        assert!(matches!(
            Scale::new(ColorMap::Viridis, 0.0, f64::INFINITY),
            Err(ScaleError::NonFinite { value: f64::INFINITY })
        ));
        assert!(Scale::symmetric(ColorMap::Vik, f64::NAN).is_err());
    }
}
