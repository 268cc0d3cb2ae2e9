//! What the pieces of a face say about it.

use super::entry::Moments;
use super::face::Cutter;
use super::linear::{greater, lesser};
use super::polygon::Piece;
use super::signed::SignedFace;
use pompeiu_core::spatial::Slot;

/// What the pieces of a face say about it.
#[derive(Clone, Copy, Debug)]
pub(super) struct FaceBounds {
    pub(super) max: Maximum,
    pub(super) min: (f64, f64),
    pub(super) mean: (f64, f64),
    /// Where inside is told from outside.
    pub(super) signed: Option<SignedFace>,
}

impl FaceBounds {
    /// Of a face of which no more is known than what no distance exceeds.
    pub(super) fn unknown(point: [f64; 3], near: Slot, largest: f64) -> Self {
        let all = (0.0, largest);
        Self { max: Maximum::of_piece(all, point, near), min: all, mean: all, signed: None }
    }

    pub(super) fn new(cutter: &Cutter<'_>, sums: &Moments, largest: f64) -> Self {
        let (mut highest, mut at) = (f64::NEG_INFINITY, (&cutter.pieces[0], 0));
        let mut upper = 0.0;
        let mut min = (f64::INFINITY, f64::INFINITY);
        for piece in &cutter.pieces {
            let Piece { polygon, .. } = piece;
            for j in 0..polygon.outline.count {
                if polygon.lower[j] > highest {
                    (highest, at) = (polygon.lower[j], (piece, j));
                }
                upper = greater(upper, polygon.upper[j]);
                min = (lesser(min.0, polygon.lower[j]), lesser(min.1, polygon.upper[j]));
            }
        }
        let area = sums.area.enclosure();
        let upper = lesser(upper, largest);
        // The mean over a face that may have no area is one of its distances.
        let mean = if area.lower() > 0.0 {
            let mean = sums.first.enclosure().divide_by_positive(area);
            (greater(mean.lower(), 0.0), lesser(mean.upper(), upper))
        } else {
            (greater(min.0, 0.0), upper)
        };
        let (piece, j) = at;
        Self {
            max: Maximum::of_piece(
                (lesser(greater(highest, 0.0), upper), upper),
                cutter.point([piece.polygon.outline.v[j], piece.polygon.outline.w[j]]),
                piece.near,
            ),
            min: (lesser(greater(min.0, 0.0), upper), lesser(min.1, upper)),
            mean: (lesser(mean.0, mean.1), mean.1),
            signed: None,
        }
    }
}

/// The largest distance on a face, from below and from above, in the frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Maximum {
    pub(super) lower: f64,
    pub(super) upper: f64,
    /// Where the distance is at least the lower end, but for rounding.
    pub(super) point: [f64; 3],
    /// Cuts by which that point was placed.
    pub(super) depth: u32,
    /// A face of the other mesh near it.
    pub(super) near: Slot,
    /// How narrow it was asked to be.
    pub(super) asked: Precision,
}

impl Maximum {
    /// As the pieces of a face have it.
    pub(super) fn of_piece((lower, upper): (f64, f64), point: [f64; 3], near: Slot) -> Self {
        Self { lower, upper, point, depth: CUTS_OF_POINT, near, asked: Precision::Pieces }
    }

    /// Takes a corner of the face with a distance of at least `lower` into account.
    pub(super) fn know_point(&mut self, lower: f64, point: [f64; 3], near: Slot) {
        if lower > self.lower {
            self.lower = lesser(lower, self.upper);
            (self.point, self.depth, self.near) = (point, 0, near);
        }
    }
}

/// Points placed by weights lie on the face up to 28 units of rounding (see [`rounding`](crate::rounding)): less than three cuts.
pub(super) const CUTS_OF_POINT: u32 = 3;

/// How narrow a maximum should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Precision {
    /// As the pieces have it.
    Pieces,
    /// [`OF_LARGEST`](super::maxima::OF_LARGEST) of the largest distance of all: a step of a colour map.
    Map,
    /// [`OF_ITSELF`](super::maxima::OF_ITSELF) of itself: to tell whether the face belongs to a region.
    Level,
    /// [`OF_PEAK`] of itself: the peak of a region.
    Peak,
}
