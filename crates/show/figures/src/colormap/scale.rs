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
    /// Ends of classes that do not ascend.
    #[error("ends of classes ascend, but {lower} is followed by {upper}")]
    Classes {
        /// An end.
        lower: f64,
        /// The one after it.
        upper: f64,
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
    classes: Classes,
}

/// Ends of classes, as many as there are; no more are told apart by eye.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Classes {
    ends: [f64; Scale::MOST_CLASS_ENDS],
    count: usize,
}

impl Classes {
    const NONE: Self = Self { ends: [0.0; Scale::MOST_CLASS_ENDS], count: 0 };
}

impl Scale {
    /// The colour of what has no value, unless another is chosen: a middle grey, which is in no map.
    const MISSING: Rgb = [150, 150, 150];

    /// Most ends of classes; further ones are left out.
    pub const MOST_CLASS_ENDS: usize = 15;

    /// The part of the map that classes take, as pages do: its ends are too dark to be told apart when lit.
    const CLASS_COLORS: [f64; 2] = [0.12, 0.88];

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
        Ok(Self { map, low, high, missing: Self::MISSING, limit: None, classes: Classes::NONE })
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

    /// Gives each class between these ends one colour, and what is below the first or above the last another: as pages do. An end belongs to
    /// the class below it, the first to the one above it. Without ends there are no classes.
    ///
    /// # Errors
    /// [`ScaleError`] if an end is not finite, or they do not ascend.
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

    /// Ends of classes, ascending; empty where colours are continuous.
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
        // An end belongs to the class below it, the first to the one above it.
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
