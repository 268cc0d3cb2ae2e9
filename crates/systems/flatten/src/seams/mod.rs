//! Short seams between charts that distort little.
//!
//! Charts are judged by a potential that takes one linear system for each of them, so that many seams can be tried before any chart is
//! mapped.

mod arcs;
mod layout;
mod potential;
mod routes;
mod search;
mod shrink;

use crate::watch::Watch;
use layout::Layout;
use pompeiu_solve::SolveError;
use pompeiu_surface::{EdgeData, Surface};
use search::Known;

/// The estimate compares the potential with constants instead of harmonic functions, so it is this many times the excess of a map at most.
const ESTIMATE: f64 = 1.8;

/// Ways to add the last seam that are given back at most.
const LAST_ROUTES: usize = 6;

/// The length of marked edges.
pub(crate) fn seam_length(surface: &Surface, seams: &EdgeData<bool>) -> f64 {
    let marked = seams.entries().filter(|(_, is_seam)| **is_seam);
    // A sum of nothing would be -0.
    marked.fold(0.0, |sum, (edge, _)| sum + surface.edge_length(edge))
}

/// Seams that grow, from given ones, between disks: short for how little the charts are estimated to distort.
pub(crate) struct ShortSeams<'s> {
    layout: Layout<'s>,
    known: Known,
    price: f64,
}

impl<'s> ShortSeams<'s> {
    pub(crate) fn new(surface: &'s Surface, seams: &EdgeData<bool>) -> Result<Self, SolveError> {
        Ok(Self { layout: Layout::new(surface, seams.clone())?, known: Known::default(), price: 0.0 })
    }

    /// Adds the seams that are worth most, until the mean energy is estimated to exceed that of an isometry by not much more than `excess`,
    /// and by no more than `estimate`; none if no seam makes it less.
    pub(crate) fn grow(
        &mut self,
        excess: f64,
        estimate: f64,
        watch: &Watch<'_>,
    ) -> Result<Option<EdgeData<bool>>, SolveError> {
        let most = (ESTIMATE * excess).min(estimate) * self.layout.surface.area();
        loop {
            let Some(price) = search::open(&mut self.layout, &mut self.known, watch)? else {
                return Ok(None);
            };
            self.price = if price > self.price { price } else { self.price };
            if !watch.is_stopped() && self.layout.excess() > most {
                continue;
            }
            search::close(&mut self.layout, self.price, &mut self.known, watch)?;
            return Ok(Some(self.layout.seams.clone()));
        }
    }

    /// Closes the seams that are worth least, while the mean energy is estimated to exceed that of an isometry by no more than `estimate`.
    pub(crate) fn shrink(&mut self, estimate: f64, watch: &Watch<'_>) -> Result<EdgeData<bool>, SolveError> {
        let most = estimate * self.layout.surface.area();
        shrink::shrink(&mut self.layout, most, watch)?;
        Ok(self.layout.seams.clone())
    }

    /// The mean energy beyond that of an isometry, as it is estimated for the seams given back last.
    pub(crate) fn estimate(&self) -> f64 {
        self.layout.excess() / self.layout.surface.area()
    }

    /// Some seams that are shorter than a length, the shortest first, and add one route to given ones, whose maps exceed the energy of an
    /// isometry by `reached`, so that it may be `allowed` after that.
    pub(crate) fn completed(
        &self,
        seams: &EdgeData<bool>,
        reached: f64,
        allowed: f64,
        length: f64,
        watch: &Watch<'_>,
    ) -> Result<Vec<EdgeData<bool>>, SolveError> {
        let mut layout = Layout::new(self.layout.surface, seams.clone())?;
        // The estimate is taken to be wrong by one factor.
        let excess = (1.0 - allowed / reached) * layout.excess();
        let longest = length - seam_length(self.layout.surface, seams);
        let mut known = Known::default();
        let mut all = search::last_routes(&mut layout, &mut known, excess, longest, watch)?;
        all.truncate(LAST_ROUTES);
        Ok(all)
    }
}
