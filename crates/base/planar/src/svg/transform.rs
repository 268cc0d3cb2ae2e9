//! Affine maps in the attribute `transform`.

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

    /// A list of transforms; the last one is applied first.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let mut all = Self::IDENTITY;
        for part in text.split(')').map(|part| part.trim_matches(|c: char| c.is_whitespace() || c == ',')) {
            if part.is_empty() {
                continue;
            }
            let (name, arguments) = part.split_once('(').ok_or_else(|| format!("`{part}` lacks brackets"))?;
            all = all.then_inner(Self::one(name.trim(), &numbers(arguments)?)?);
        }
        Ok(all)
    }

    fn one(name: &str, arguments: &[f64]) -> Result<Self, String> {
        let rotation = |degrees: f64| {
            let (s, c) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
            Self([c, s, -s, c, 0.0, 0.0])
        };
        Ok(match (name, arguments) {
            ("matrix", &[a, b, c, d, e, f]) => Self([a, b, c, d, e, f]),
            ("translate", &[x]) => Self::shift([x, 0.0]),
            ("translate", &[x, y]) => Self::shift([x, y]),
            ("scale", &[s]) => Self::scale([s, s]),
            ("scale", &[x, y]) => Self::scale([x, y]),
            ("rotate", &[degrees]) => rotation(degrees),
            ("rotate", &[degrees, x, y]) => {
                Self::shift([x, y]).then_inner(rotation(degrees)).then_inner(Self::shift([-x, -y]))
            }
            ("skewX", &[degrees]) => Self([1.0, 0.0, libm::tan(degrees.to_radians()), 1.0, 0.0, 0.0]),
            ("skewY", &[degrees]) => Self([1.0, libm::tan(degrees.to_radians()), 0.0, 1.0, 0.0, 0.0]),
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
        assert!(Transform::parse("turn(3)").is_err() && Transform::parse("scale 2").is_err());
    }
}
