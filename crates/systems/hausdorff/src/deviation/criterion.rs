//! What pieces must satisfy to be left as they are.

use super::entry::Entry;
use super::linear::{greatest, least};
use super::polygon::{Polygon, Row};

/// How narrow pieces should be. Lengths and areas are in the frame.
#[derive(Clone, Debug)]
pub(super) struct Criterion {
    /// Area times mean width that a piece may leave undecided.
    pub(super) mass: f64,
    /// Ranges of distances in which a piece may leave only [`Criterion::focus_mass`] undecided.
    pub(super) focus: Vec<(f64, f64)>,
    pub(super) focus_mass: f64,
    /// Widths that never matter.
    pub(super) floor: f64,
}

impl Criterion {
    /// A criterion for the greatest width alone.
    pub(super) fn of_width(width: f64) -> Self {
        Self { mass: 0.0, focus: Vec::new(), focus_mass: 0.0, floor: width }
    }

    /// Takes ranges of distances into focus. Earlier ones stay: faces are cut anew, and what was narrow there would come out wide.
    pub(super) fn focus_on(&mut self, ranges: Vec<(f64, f64)>) {
        for range in ranges {
            let is_inside = |(from, to): &(f64, f64)| *from <= range.0 && range.1 <= *to;
            if !self.focus.iter().any(is_inside) {
                self.focus.push(range);
            }
        }
    }

    /// Whether a piece with distances in this range is in focus.
    pub(super) fn is_in_focus(&self, low: f64, high: f64) -> bool {
        self.focus.iter().any(|(from, to)| low <= *to && *from <= high)
    }

    /// Area times width that is allowed of a piece with distances in this range.
    fn allowed(&self, low: f64, high: f64) -> f64 {
        if self.is_in_focus(low, high) && self.focus_mass < self.mass { self.focus_mass } else { self.mass }
    }

    /// Whether a piece with this mass and distances in this range is good enough as far as statistics go.
    pub(super) fn is_met(&self, mass: f64, low: f64, high: f64) -> bool {
        mass <= self.allowed(low, high)
    }

    /// Sum of what pieces leave undecided, each as a part of what is allowed of it.
    pub(super) fn excess(&self, pieces: impl Iterator<Item = Entry>) -> f64 {
        let of_piece = |entry: Entry| {
            let mass = entry.mass();
            if mass > 0.0 { mass / self.allowed(least(entry.lower()), greatest(entry.upper())) } else { 0.0 }
        };
        pieces.map(of_piece).sum()
    }

    /// The mean width that a piece of a face of this area should be cut to, if it is not good enough. `weights` are those of the
    /// piece.
    pub(super) fn width_unless_met(&self, piece: &Polygon, weights: &Row, area: f64) -> Option<f64> {
        if piece.mass_at_most(weights) * area <= self.least() {
            return None;
        }
        let mass = piece.mass(weights) * area;
        if mass <= self.least() || piece.most_width() <= self.floor {
            return None;
        }
        let greater = |x: f64, y: &f64| if *y > x { *y } else { x };
        let lesser = |x: f64, y: &f64| if *y < x { *y } else { x };
        let low = piece.lower[..piece.outline.count].iter().fold(f64::INFINITY, lesser);
        let high = piece.upper[..piece.outline.count].iter().fold(0.0, greater);
        let allowed = self.allowed(low, high);
        (mass > allowed).then(|| self.width(allowed, weights, area))
    }

    /// The width that may be lost to make a list shorter.
    pub(super) fn negligible(&self, weights: &Row, area: f64) -> f64 {
        NEGLIGIBLE * self.width(self.least(), weights, area)
    }

    /// Area times width that is allowed of any piece.
    pub(super) fn least(&self) -> f64 {
        if self.focus.is_empty() || self.mass < self.focus_mass { self.mass } else { self.focus_mass }
    }

    /// The width that a piece with this area may have.
    pub(super) fn width_of(&self, area: f64) -> f64 {
        self.spread(self.least(), area)
    }

    fn width(&self, mass: f64, weights: &Row, area: f64) -> f64 {
        self.spread(mass, weights.iter().sum::<f64>() * area)
    }

    fn spread(&self, mass: f64, area: f64) -> f64 {
        let width = mass / area;
        // Not where there is no area.
        if width > self.floor { width } else { self.floor }
    }
}

/// Part of the allowed width.
const NEGLIGIBLE: f64 = 1e-2;
