//! Rounding of what is drawn.

use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_figures::page::Bounds;

/// Rounds what is drawn.
pub(super) struct Snap {
    place: f64,
    level: f64,
}

impl Snap {
    pub(super) fn new(mesh: &TriMesh, tolerance: f64) -> Self {
        Self { place: below(Aabb::of_faces(mesh).diagonal() / PLACES), level: below(tolerance / LEVELS) }
    }

    pub(super) fn position(&self, position: [f64; 3]) -> [f64; 3] {
        position.map(|x| to_multiple(x, self.place))
    }

    /// By how much more than nothing rounding may change what a distance and a position say of the space around.
    pub(super) fn doubt(&self) -> f64 {
        self.level + 2.0 * self.place
    }

    pub(super) fn distance(&self, distance: f64) -> f64 {
        to_multiple(distance, self.level)
    }
}

/// The greatest power of two that is not above a length; zero for zero.
fn below(length: f64) -> f64 {
    if length >= f64::MIN_POSITIVE { length.log2().floor().exp2() } else { 0.0 }
}

/// The nearest multiple of a step; the number itself where multiples are too large for doubles, or there is no step.
fn to_multiple(x: f64, step: f64) -> f64 {
    let multiple = (x / step).round() * step;
    if multiple.is_finite() { multiple } else { x }
}

/// Bounds with few digits that lie around the given ones, which are not negative.
pub(super) fn rounded([lower, upper]: Bounds) -> Bounds {
    let dropped = (1_u64 << (52 - KEPT)) - 1;
    let down = f64::from_bits(lower.to_bits() & !dropped);
    let up = f64::from_bits((upper.to_bits() + dropped) & !dropped);
    [down, if up.is_finite() { up } else { upper }]
}

/// Bits of a mantissa that are kept of a bound.
const KEPT: u32 = 12;

/// Parts of the box around a surface that coordinates are rounded to.
const PLACES: f64 = (1_u64 << 14) as f64;

/// Parts of the tolerance that distances are rounded to.
const LEVELS: f64 = 8.0;
