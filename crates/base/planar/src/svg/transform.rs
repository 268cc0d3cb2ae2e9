//! Affine maps in the attribute and in the property `transform`.

use super::lengths::{Of, length};
use super::numbers::numbers;
use crate::Point;

/// Maps (x, y) to (a x + c y + e, b x + d y + f); the coefficients are in the order a to f.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Transform([f64; 6]);

impl Transform {
    pub(super) const IDENTITY: Self = Self([1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);

    pub(super) fn shift([x, y]: Point) -> Self {
        Self([1.0, 0.0, 0.0, 1.0, x, y])
    }

    pub(super) fn scale([x, y]: Point) -> Self {
        Self([x, 0.0, 0.0, y, 0.0, 0.0])
    }

    /// A list of transforms; the last one is applied first. `none` is that of no transforms.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        Self::list(text, |_, arguments| numbers(arguments))
    }

    /// The same with lengths and angles that have units, as properties have them.
    pub(super) fn parse_property(text: &str) -> Result<Self, String> {
        let with_unit = |name: &str, argument: &str| match name {
            "rotate" | "skew" | "skewX" | "skewY" => degrees(argument),
            "translate" | "translateX" | "translateY" => length(argument, Of::Width, None),
            _ => argument.trim().parse().map_err(|_| format!("expected a number, found `{argument}`")),
        };
        Self::list(text, |name, arguments| {
            arguments.split(',').map(|argument| with_unit(name, argument.trim())).collect()
        })
    }

    fn list(text: &str, read: impl Fn(&str, &str) -> Result<Vec<f64>, String>) -> Result<Self, String> {
        let mut all = Self::IDENTITY;
        if text.trim() == "none" {
            return Ok(all);
        }
        for part in text.split(')').map(|part| part.trim_matches(|c: char| c.is_whitespace() || c == ',')) {
            if part.is_empty() {
                continue;
            }
            let (name, arguments) = part.split_once('(').ok_or_else(|| format!("`{part}` lacks brackets"))?;
            let name = name.trim();
            all = all.then_inner(Self::one(name, &read(name, arguments)?)?);
        }
        Ok(all)
    }

    fn one(name: &str, arguments: &[f64]) -> Result<Self, String> {
        let rotation = |degrees: f64| {
            let (s, c) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
            Self([c, s, -s, c, 0.0, 0.0])
        };
        let skew = |degrees: Point| {
            let [x, y] = degrees.map(|degrees| libm::tan(degrees.to_radians()));
            Self([1.0, y, x, 1.0, 0.0, 0.0])
        };
        Ok(match (name, arguments) {
            ("matrix", &[a, b, c, d, e, f]) => Self([a, b, c, d, e, f]),
            ("translate" | "translateX", &[x]) => Self::shift([x, 0.0]),
            ("translateY", &[y]) => Self::shift([0.0, y]),
            ("translate", &[x, y]) => Self::shift([x, y]),
            ("scale", &[s]) => Self::scale([s, s]),
            ("scale", &[x, y]) => Self::scale([x, y]),
            ("scaleX", &[x]) => Self::scale([x, 1.0]),
            ("scaleY", &[y]) => Self::scale([1.0, y]),
            ("rotate", &[degrees]) => rotation(degrees),
            ("rotate", &[degrees, x, y]) => {
                Self::shift([x, y]).then_inner(rotation(degrees)).then_inner(Self::shift([-x, -y]))
            }
            ("skewX" | "skew", &[x]) => skew([x, 0.0]),
            ("skewY", &[y]) => skew([0.0, y]),
            ("skew", &[x, y]) => skew([x, y]),
            _ => return Err(format!("there is no transform {name} of {} numbers", arguments.len())),
        })
    }

    /// The composition that applies `inner` first.
    pub(super) fn then_inner(&self, inner: Self) -> Self {
        let Self([a, b, c, d, e, f]) = *self;
        let Self([g, h, i, j, k, l]) = inner;
        let [ox, oy] = [a * k + c * l + e, b * k + d * l + f];
        Self([a * g + c * h, b * g + d * h, a * i + c * j, b * i + d * j, ox, oy])
    }

    pub(super) fn apply(&self, [x, y]: Point) -> Point {
        let Self([a, b, c, d, e, f]) = *self;
        [a * x + c * y + e, b * x + d * y + f]
    }
}

/// An angle in degrees.
fn degrees(text: &str) -> Result<f64, String> {
    // `grad` ends with `rad`.
    let units = [("deg", 1.0), ("grad", 0.9), ("rad", 180.0 / std::f64::consts::PI), ("turn", 360.0)];
    let found = units.iter().find_map(|(unit, factor)| Some((text.strip_suffix(unit)?, *factor)));
    let (number, factor) = found.unwrap_or((text, 1.0));
    match number.trim_end().parse::<f64>() {
        // Without a unit only 0 is an angle in a style sheet; programs mean degrees.
        Ok(x) if (x * factor).is_finite() => Ok(x * factor),
        _ => Err(format!("`{text}` is not an angle in deg, grad, rad or turn")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_transform_comes_first() {
        let t = Transform::parse("translate(5, 6) scale(2) rotate(90)").unwrap();
        let [x, y] = t.apply([1.0, 0.0]);
        assert!((x - 5.0).abs() < 1e-15 && (y - 8.0).abs() < 1e-15);
        let about = Transform::parse("rotate(180 1 1)").unwrap().apply([0.0, 0.0]);
        assert!((about[0] - 2.0).abs() < 1e-15 && (about[1] - 2.0).abs() < 1e-15);
        assert_eq!(Transform::parse("none").unwrap(), Transform::IDENTITY);
        let of_style = Transform::parse_property("translateX(1in) rotate(0.25turn) scale(2, 3)").unwrap();
        let [x, y] = of_style.apply([1.0, 1.0]);
        assert!((x - 93.0).abs() < 1e-13 && (y - 2.0).abs() < 1e-13, "{x} {y}");
        assert!(Transform::parse_property("rotate(1px)").is_err());
        assert!(Transform::parse("turn(3)").is_err() && Transform::parse("scale 2").is_err());
    }
}
