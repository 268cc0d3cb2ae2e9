//! Closing seams where that costs least.

use super::arcs::{Arc, arcs};
use super::layout::{Layout, Trial};
use crate::watch::Watch;
use pompeiu_solve::SolveError;
use pompeiu_surface::EdgeId;
use std::collections::BTreeMap;

/// What closing an arc costs: the excess that it adds for each unit of length that it takes away, and its greatest length.
#[derive(Clone, Copy, PartialEq)]
struct Price {
    excess: f64,
    length: f64,
}

impl Price {
    const NEVER: Self = Self { excess: f64::INFINITY, length: 0.0 };

    fn of(trial: &Trial) -> Self {
        let excess = if trial.excess > 0.0 { trial.excess } else { 0.0 };
        Self { excess: excess / -trial.length, length: -trial.length }
    }

    /// The lesser excess first, then the greater length.
    fn is_below(&self, other: &Self) -> bool {
        self.excess.total_cmp(&other.excess).then(other.length.total_cmp(&self.length)).is_lt()
    }
}

/// The best closing of an arc that leaves disks, with no more excess in all than `most`.
fn best_closing(layout: &mut Layout<'_>, arc: &Arc, most: f64) -> Result<Option<(Price, Trial)>, SolveError> {
    let before = layout.excess();
    let mut best: Option<(Price, Trial)> = None;
    for closing in arc.closings(layout) {
        let Some(trial) = layout.trial(&[], &closing)? else { continue };
        let price = Price::of(&trial);
        if trial.length < 0.0
            && before + trial.excess <= most
            && best.as_ref().is_none_or(|(least, _)| price.is_below(least))
        {
            best = Some((price, trial));
        }
    }
    Ok(best)
}

/// Closes arcs, the cheapest first, while the excess of all charts is at most `most`.
///
/// Prices rise as charts grow: that of an arc is looked at again only when it is the least of those known.
pub(super) fn shrink(layout: &mut Layout<'_>, most: f64, watch: &Watch<'_>) -> Result<(), SolveError> {
    // By the first of its edges and their number.
    let mut prices: BTreeMap<(EdgeId, usize), Price> = BTreeMap::new();
    loop {
        let all = arcs(layout);
        let key = |arc: &Arc| arc.edges.iter().min().map(|&edge| (edge, arc.edges.len()));
        for arc in &all {
            let Some(key) = key(arc).filter(|key| !prices.contains_key(key)) else { continue };
            if watch.is_stopped() {
                return Ok(());
            }
            let found = best_closing(layout, arc, most)?;
            prices.insert(key, found.map_or(Price::NEVER, |(price, _)| price));
        }
        let mut chosen = None;
        while chosen.is_none() {
            let mut least: Option<(Price, &Arc)> = None;
            for arc in &all {
                let Some(&price) = key(arc).and_then(|key| prices.get(&key)) else { continue };
                if price.excess.is_finite() && least.is_none_or(|(other, _)| price.is_below(&other)) {
                    least = Some((price, arc));
                }
            }
            let Some((before, arc)) = least else { return Ok(()) };
            if watch.is_stopped() {
                return Ok(());
            }
            let found = best_closing(layout, arc, most)?;
            let price = found.as_ref().map_or(Price::NEVER, |(price, _)| *price);
            // The arc may be another one soon, with the same first edge.
            let next = if price == before { Price::NEVER } else { price };
            key(arc).and_then(|key| prices.insert(key, next));
            chosen = found.filter(|_| price == before).map(|(_, trial)| trial);
        }
        if let Some(trial) = chosen {
            layout.accept(trial);
        }
    }
}
