//! Assigning colours to values.

use super::{ColorMap, Rgb};
use thiserror::Error;

/// Why a scale cannot be made.
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
        /// The end given as the lower one.
        low: f64,
        /// The end given as the upper one.
        high: f64,
    },
    /// Class boundaries are not increasing.
    #[error("ends of classes ascend, but {lower} is followed by {upper}")]
    Classes {
        /// A class boundary.
        lower: f64,
        /// The next one.
        upper: f64,
    },
}

/// Assigns colours to values: a map stretched over a range, a colour for missing values, and optionally a limit beyond which values
/// get a contrasting colour.
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
    classes: Classes,
}

/// Class boundaries, up to their count; readers cannot distinguish more classes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Classes {
    ends: [f64; Scale::MOST_CLASS_ENDS],
    count: usize,
}

impl Classes {
    const NONE: Self = Self { ends: [0.0; Scale::MOST_CLASS_ENDS], count: 0 };
}

impl Scale {
    /// The default colour of missing values: a middle grey, which is in no map.
    const MISSING: Rgb = [150, 150, 150];

    /// Largest number of class boundaries; further ones are ignored.
    pub const MOST_CLASS_ENDS: usize = 15;

    /// The part of the map used for classes, as on pages: the ends of the map are too dark to be distinguished under lighting.
    const CLASS_COLORS: [f64; 2] = [0.12, 0.88];

    /// A map stretched over a range.
    ///
    /// The ends may be equal, for instance if all distances are zero; values up to this number then get the first colour.
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
        Ok(Self { map, low, high, missing: Self::MISSING, limit: None, classes: Classes::NONE })
    }

    /// A map stretched over the range from `-extent` to `extent`, for diverging maps.
    ///
    /// # Errors
    /// As [`Scale::new`].
    pub fn symmetric(map: ColorMap, extent: f64) -> Result<Self, ScaleError> {
        Self::new(map, -extent, extent)
    }

    /// Gives values with an absolute value above `limit` the map's [contrast](ColorMap::contrast) colour.
    ///
    /// A NaN limit is ignored.
    #[must_use]
    pub fn with_limit(mut self, limit: f64) -> Self {
        self.limit = (!limit.is_nan()).then_some(limit);
        self
    }

    /// Sets the colour of missing values, which are NaN.
    #[must_use]
    pub fn with_missing(mut self, color: Rgb) -> Self {
        self.missing = color;
        self
    }

    /// Divides the scale into classes of one colour each, at these boundaries and as pages do; values below the first and above the
    /// last boundary form classes, too. A boundary belongs to the class below it, except the first, which belongs to the class
    /// above. Without boundaries there are no classes.
    ///
    /// # Errors
    /// [`ScaleError`] if a boundary is not finite, or they are not increasing.
    pub fn with_classes(mut self, ends: &[f64]) -> Result<Self, ScaleError> {
        if let Some(&value) = ends.iter().find(|end| !end.is_finite()) {
            return Err(ScaleError::NonFinite { value });
        }
        if let Some(pair) = ends.windows(2).find(|pair| pair[0] >= pair[1]) {
            return Err(ScaleError::Classes { lower: pair[0], upper: pair[1] });
        }
        self.classes.count = ends.len().min(Self::MOST_CLASS_ENDS);
        self.classes.ends[..self.classes.count].copy_from_slice(&ends[..self.classes.count]);
        Ok(self)
    }

    /// The class boundaries, increasing; empty for continuous colours.
    pub fn classes(&self) -> &[f64] {
        &self.classes.ends[..self.classes.count]
    }

    /// The colour of a class, counted from the lowest.
    pub fn class_color(&self, class: usize) -> Rgb {
        let [low, high] = Self::CLASS_COLORS;
        let part = class as f64 / self.classes.count.max(1) as f64;
        self.map.color(low + (high - low) * part)
    }

    fn class_of(&self, value: f64) -> usize {
        match self.classes() {
            [first, rest @ ..] if value >= *first => 1 + rest.iter().filter(|end| value > **end).count(),
            _ => 0,
        }
    }

    /// The map.
    pub fn map(&self) -> ColorMap {
        self.map
    }

    /// The ends of the range.
    pub fn range(&self) -> (f64, f64) {
        (self.low, self.high)
    }

    /// The absolute value above which values get the contrast colour.
    pub fn limit(&self) -> Option<f64> {
        self.limit
    }

    /// The colour of missing values.
    pub fn missing(&self) -> Rgb {
        self.missing
    }

    /// The position of a value in the range: 0 at its lower end, 1 at its upper end; below 0 or above 1 outside.
    ///
    /// NaN for NaN.
    pub fn place(&self, value: f64) -> f64 {
        // Halved, so that the width of a range is finite whenever its ends are.
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
        } else if self.classes.count > 0 {
            self.class_color(self.class_of(value))
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
    fn classes_have_one_colour_each() {
        let scale = Scale::symmetric(ColorMap::Vik, 1.0).unwrap().with_classes(&[-0.2, 0.1, 0.3]).unwrap();
        let colors: Vec<Rgb> = (0..4).map(|class| scale.class_color(class)).collect();
        assert!(colors.windows(2).all(|pair| pair[0] != pair[1]));
        // A boundary belongs to the class below it, except the first, which belongs to the class above.
        for (value, class) in [(-9.0, 0), (-0.2, 1), (0.0, 1), (0.1, 1), (0.11, 2), (0.3, 2), (0.31, 3)] {
            assert_eq!(scale.color(value), colors[class], "{value}");
        }
        assert_eq!(scale.color(f64::NAN), Scale::MISSING);
        assert_eq!(
            scale.with_classes(&[0.0, 0.0]).unwrap_err(),
            ScaleError::Classes { lower: 0.0, upper: 0.0 }
        );
        assert!(
            scale.with_classes(&[f64::NAN]).is_err()
                && scale.with_classes(&[0.0; 0]).unwrap().classes().is_empty()
        );
        let many: Vec<f64> = (0..40).map(f64::from).collect();
        assert_eq!(scale.with_classes(&many).unwrap().classes().len(), Scale::MOST_CLASS_ENDS);
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
