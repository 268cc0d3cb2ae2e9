//! The pieces of a direction, or what was summed up of them.

use super::distribution::{Distribution, Measured, level};
use super::entry::{Moments, Sum};
use super::grid::{self, Areas, Grids, Ruler};
use pompeiu_core::exact::Interval;

/// Pieces are kept where faces are few or the accuracy is high, for some of them are cut again then; else they are summed up at once, and
/// in the rare case that they are too wide all are cut again.
#[derive(Clone, Debug)]
pub(super) enum Pieces {
    Kept(Distribution),
    Summed(Summed),
}

/// What was summed up of pieces.
#[derive(Clone, Debug, Default)]
pub(super) struct Summed {
    pub(super) moments: Moments,
    /// How much of it is up to how far away, of one direction or of both.
    pub(super) areas: Vec<Areas>,
    /// A level, and the area up to it.
    pub(super) up_to: Option<(f64, Sum)>,
}

/// From this accuracy on pieces are summed up, of so many faces of both meshes: what rounding to places adds is a part of it, and grids take
/// less than pieces.
const LEAST_ACCURACY: f64 = 8.0 * grid::MOST_MOVED;
const LEAST_FACES: usize = 1 << 15;

/// Whether the pieces of meshes with so many faces together should be summed up, and not kept.
pub(super) fn are_summed(accuracy: f64, faces: usize) -> bool {
    accuracy >= LEAST_ACCURACY && faces >= LEAST_FACES
}

impl Measured for Summed {
    fn moments(&self) -> Moments {
        self.moments
    }

    fn percentiles(&self, shares: &[f64], area: Interval, largest: f64, _: f64) -> Vec<(f64, f64)> {
        grid::percentiles(&self.areas, shares, area, largest)
    }

    fn area_up_to(&self, level: f64) -> Interval {
        match self.up_to {
            Some((known, sum)) if known == level => sum.enclosure(),
            _ => grid::area_up_to(&self.areas, level),
        }
    }

    fn cumulative(&self, largest: f64, bins: usize) -> Vec<Sum> {
        let of_bin = |k: usize| grid::sum_up_to(&self.areas, level(largest, k, bins));
        if bins == 0 { Vec::new() } else { (0..=bins).map(of_bin).collect() }
    }
}

impl Pieces {
    pub(super) fn measured(&self) -> &dyn Measured {
        match self {
            Self::Kept(kept) => kept,
            Self::Summed(summed) => summed,
        }
    }

    pub(super) fn len(&self) -> u64 {
        match self {
            Self::Kept(kept) => kept.len() as u64,
            Self::Summed(summed) => summed.areas.iter().map(Areas::triangles).sum(),
        }
    }

    /// Bytes that they take.
    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::Kept(kept) => kept.bytes(),
            Self::Summed(summed) => summed.areas.iter().map(Areas::bytes).sum(),
        }
    }

    /// Those of two directions. `ruler` is that by which pieces that are kept are summed up beside others.
    pub(super) fn pooled(self, other: Self, ruler: impl Fn(f64) -> Ruler) -> Self {
        match (self, other) {
            (Self::Kept(mut all), Self::Kept(others)) => {
                all.portions.extend(others.portions);
                Self::Kept(all)
            }
            (one, other) => {
                let level = one.level().or(other.level());
                let (mut all, others) = (one.summed(&ruler, level), other.summed(&ruler, level));
                all.moments = all.moments.plus(others.moments);
                all.areas.extend(others.areas);
                let both = all.up_to.zip(others.up_to);
                all.up_to = both.map(|((level, sum), (_, other))| (level, sum.plus(other)));
                Self::Summed(all)
            }
        }
    }

    /// The level up to which the area was summed up by itself.
    fn level(&self) -> Option<f64> {
        match self {
            Self::Summed(Summed { up_to: Some((level, _)), .. }) => Some(*level),
            _ => None,
        }
    }

    fn summed(self, ruler: &impl Fn(f64) -> Ruler, level: Option<f64>) -> Summed {
        match self {
            Self::Summed(summed) => summed,
            Self::Kept(kept) => {
                let moments = kept.moments();
                let mut grids = Grids::new(ruler(moments.area.enclosure().upper()));
                for entry in kept.portions.iter().flat_map(|portion| portion.entries.iter()) {
                    grids.add(&entry);
                }
                let up_to = level.map(|level| {
                    let area = kept.area_up_to(level);
                    (level, Sum::of(area.lower(), area.upper(), 0.0))
                });
                Summed { moments, areas: vec![grids.areas()], up_to }
            }
        }
    }
}
