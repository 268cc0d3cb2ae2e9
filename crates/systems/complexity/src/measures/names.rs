//! Measures by name.

use super::Measures;
use crate::ComplexityError;

/// The direction in which a measure grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Greater values are more complex.
    Up,
    /// Smaller values are more complex.
    Down,
}

/// A measure by name.
#[derive(Clone, Copy)]
pub struct Measure {
    /// The name in the command and in reports.
    pub name: &'static str,
    /// The direction in which it grows with complexity.
    pub direction: Direction,
    value: fn(&Measures) -> f64,
}

impl std::fmt::Debug for Measure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Measure").field(&self.name).finish()
    }
}

macro_rules! measures {
    ($($name:literal, $direction:ident, $value:expr;)*) => {
        &[$(Measure { name: $name, direction: Direction::$direction, value: $value },)*]
    };
}

impl Measure {
    /// All measures, grouped by family.
    pub const ALL: &[Self] = measures! {
        "boundary", Down, |m| m.boundary.mean;
        "boundary-500", Down, |m| m.boundary.m500;
        "boundary-100", Down, |m| m.boundary.m100;
        "boundary-50", Down, |m| m.boundary.m50;
        "boundary-25", Down, |m| m.boundary.m25;
        "boundary-8", Down, |m| m.boundary.m8;
        "t18", Up, |m| m.curvature.one_minus_first_bin;
        "neg5", Up, |m| m.curvature.neg5;
        "sharp", Up, |m| m.curvature.sharp;
        "per-shape", Up, |m| m.curvature.per_shape;
        "peaks", Up, |m| m.curvature.peaks as f64;
        "total-curvature", Up, |m| m.curvature.total;
        "skeleton-length", Up, |m| m.skeleton.length;
        "skeleton-ends", Up, |m| m.skeleton.ends as f64;
        "skeleton-junctions", Up, |m| m.skeleton.junctions as f64;
        "skeleton-radius", Down, |m| m.skeleton.radius;
        "skeleton-variation", Up, |m| m.skeleton.variation;
        "elongation", Up, |m| m.moments.elongation;
        "spread", Up, |m| m.moments.spread;
        "hull", Down, |m| m.coverage.hull;
        "rectangle", Down, |m| m.coverage.rectangle;
        "circle", Down, |m| m.coverage.circle;
        "compactness", Down, |m| m.global.compactness;
        "convexity", Down, |m| m.global.convexity;
        "aspect", Down, |m| m.global.aspect;
        "diameter", Up, |m| m.global.diameter;
    };

    /// The measure with a name.
    ///
    /// # Errors
    /// [`ComplexityError::Measure`] with the list of names.
    pub fn named(name: &str) -> Result<Self, ComplexityError> {
        Self::ALL.iter().find(|measure| measure.name == name).copied().ok_or_else(|| {
            let known: Vec<&str> = Self::ALL.iter().map(|measure| measure.name).collect();
            ComplexityError::Measure { found: name.to_owned(), known: known.join(", ") }
        })
    }

    /// Its value for a shape.
    pub fn value(&self, measures: &Measures) -> f64 {
        (self.value)(measures)
    }

    /// Its value, negated if smaller values are more complex.
    pub fn complexity(&self, measures: &Measures) -> f64 {
        match self.direction {
            Direction::Up => self.value(measures),
            Direction::Down => -self.value(measures),
        }
    }
}

/// The value of a feature: a measure, or `log:` and a measure for ln(1 + value).
pub(crate) fn feature(name: &str) -> Result<impl Fn(&Measures) -> f64, ComplexityError> {
    let (inner, is_log) = name.strip_prefix("log:").map_or((name, false), |inner| (inner, true));
    let measure = Measure::named(inner)?;
    Ok(move |measures: &Measures| {
        let value = measure.value(measures);
        if is_log { libm::log1p(value.max(0.0)) } else { value }
    })
}
