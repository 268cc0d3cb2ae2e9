//! Changing seams while this makes them shorter, or the charts flatter.

use super::arcs::{Arc, arcs};
use super::layout::{Layout, Trial};
use super::routes::{between, routes};
use crate::watch::Watch;
use pompeiu_solve::SolveError;
use pompeiu_surface::{EdgeData, EdgeId};
use std::collections::{BTreeMap, HashSet};

/// Least improvement, relative to the square root of the area, that counts.
const LEAST: f64 = 1e-4;

/// What is known of the layout's charts, by their numbers. All of it stays true at higher prices.
#[derive(Default)]
pub(super) struct Known {
    /// For each chart routes that may be opened.
    routes: BTreeMap<u32, Vec<Route>>,
    /// Arcs that were not worth closing or moving, by their first edge and their charts.
    kept: HashSet<(EdgeId, [u32; 2])>,
}

/// A route with what it adds to the excess and to the length.
#[derive(Clone, Debug)]
struct Route {
    edges: Vec<EdgeId>,
    excess: f64,
    length: f64,
    /// Whether it divides a chart. The sides of one that does not may overlap in a map, which the excess does not tell.
    divides: bool,
}

impl Route {
    /// The price of excess at which it is worth its length.
    fn price(&self) -> f64 {
        if self.excess < 0.0 { -self.length / self.excess } else { f64::INFINITY }
    }
}

/// What a change costs: the length of seams, and the excess at a price.
fn cost(trial: &Trial, price: f64) -> f64 {
    trial.length + price * trial.excess
}

/// The least length for which something counts as an improvement.
fn least(layout: &Layout<'_>) -> f64 {
    LEAST * layout.surface.area().sqrt()
}

/// Finds the routes of charts that are new; of fewer if the run is stopped.
fn look(layout: &mut Layout<'_>, known: &mut Known, watch: &Watch<'_>) -> Result<(), SolveError> {
    let charts = layout.charts();
    known.routes.retain(|chart, _| charts.binary_search(chart).is_ok());
    for chart in charts {
        if known.routes.contains_key(&chart) {
            continue;
        }
        if watch.is_stopped() {
            break;
        }
        let mut found = Vec::new();
        for edges in routes(layout, chart) {
            if let Some(trial) = layout.trial(&edges, &[])? {
                let (excess, length) = (trial.excess, trial.length);
                found.push(Route { edges, excess, length, divides: trial.divides() });
            }
        }
        known.routes.insert(chart, found);
    }
    Ok(())
}

/// Opens the route through a chart that takes away most excess for its length, and returns the price at which that is worth it; none if no
/// route takes any away.
pub(super) fn open(
    layout: &mut Layout<'_>,
    known: &mut Known,
    watch: &Watch<'_>,
) -> Result<Option<f64>, SolveError> {
    look(layout, known, watch)?;
    let through = known.routes.values().flatten().filter(|route| route.divides);
    let best = through.min_by(|a, b| a.price().total_cmp(&b.price()));
    let Some(best) = best.filter(|best| best.price().is_finite()) else { return Ok(None) };
    let (price, edges) = (best.price(), best.edges.clone());
    let Some(trial) = layout.trial(&edges, &[])? else { return Ok(None) };
    layout.accept(trial);
    Ok(Some(price))
}

/// The seams with one route more that takes away at least so much excess and is no longer than a length, for the shortest of such routes.
pub(super) fn last_routes(
    layout: &mut Layout<'_>,
    known: &mut Known,
    excess: f64,
    length: f64,
    watch: &Watch<'_>,
) -> Result<Vec<EdgeData<bool>>, SolveError> {
    look(layout, known, watch)?;
    let is_enough = |route: &&Route| -route.excess >= excess && route.length < length;
    let mut routes: Vec<&Route> = known.routes.values().flatten().filter(is_enough).collect();
    routes.sort_by(|a, b| a.length.total_cmp(&b.length));
    let with = |route: &Route| {
        let mut seams = layout.seams.clone();
        route.edges.iter().for_each(|&edge| seams[edge] = true);
        seams
    };
    Ok(routes.into_iter().map(with).collect())
}

/// Closes arcs, or moves them, where this is worth it.
pub(super) fn close(
    layout: &mut Layout<'_>,
    price: f64,
    known: &mut Known,
    watch: &Watch<'_>,
) -> Result<(), SolveError> {
    let least = least(layout);
    loop {
        let mut changed = false;
        let mut at = 0;
        loop {
            // After a change arcs are others; those that were looked at are known.
            let all = arcs(layout);
            let is_new = |arc: &Arc| !known.kept.contains(&(arc.edges[0], arc.charts));
            let Some(arc) = all.iter().skip(at).find(|arc| is_new(arc)) else { break };
            at = all.iter().position(|other| other.edges[0] == arc.edges[0]).unwrap_or(0);
            if watch.is_stopped() {
                return Ok(());
            }
            let found = match closed(layout, arc, price, least)? {
                Some(found) => Some(found),
                None => moved(layout, arc, price, least)?,
            };
            if let Some(found) = found {
                layout.accept(found);
                changed = true;
            } else {
                known.kept.insert((arc.edges[0], arc.charts));
            }
        }
        if !changed {
            return Ok(());
        }
    }
}

/// The cheapest of some changes, given by what they open and what they close, if it is an improvement.
fn cheapest<'e>(
    layout: &mut Layout<'_>,
    changes: impl Iterator<Item = (&'e [EdgeId], &'e [EdgeId])>,
    price: f64,
    least: f64,
) -> Result<Option<Trial>, SolveError> {
    let mut best: Option<Trial> = None;
    for (opened, closed) in changes {
        let bound = best.as_ref().map_or(-least, |best| cost(best, price));
        if let Some(trial) = layout.trial(opened, closed)?
            && cost(&trial, price) < bound
        {
            best = Some(trial);
        }
    }
    Ok(best)
}

/// The best way to close an arc, or a part of it.
fn closed(layout: &mut Layout<'_>, arc: &Arc, price: f64, least: f64) -> Result<Option<Trial>, SolveError> {
    let closings = arc.closings(layout);
    cheapest(layout, closings.iter().map(|closing| (&[][..], &closing[..])), price, least)
}

/// The best way to lead an arc between two charts along another path.
fn moved(layout: &mut Layout<'_>, arc: &Arc, price: f64, least: f64) -> Result<Option<Trial>, SolveError> {
    if arc.charts[0] == arc.charts[1] {
        return Ok(None);
    }
    let Some(closed) = layout.trial(&[], &arc.edges)? else { return Ok(None) };
    let before = layout.accept(closed);
    let union = layout.charts().last().copied();
    let others = union.map_or_else(Vec::new, |union| between(layout, union, arc.ends));
    layout.restore(before);
    cheapest(layout, others.iter().map(|other| (&other[..], &arc.edges[..])), price, least)
}
