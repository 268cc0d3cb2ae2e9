//! What it costs to cut along each edge.

use pompeiu_surface::{EdgeData, EdgeId, Surface};

/// The cost of each edge: its length, times a weight; infinite where no cut may go.
#[derive(Clone, Debug)]
pub(crate) struct Costs(EdgeData<f64>);

impl Costs {
    /// The lengths, infinite along forbidden edges.
    pub(crate) fn new(surface: &Surface, is_forbidden: impl Fn(EdgeId) -> bool) -> Self {
        let cost = |edge| if is_forbidden(edge) { f64::INFINITY } else { surface.edge_length(edge) };
        Self(EdgeData::from_fn(surface.mesh().edges(), cost))
    }

    pub(crate) fn of(&self, edge: EdgeId) -> f64 {
        self.0[edge]
    }

    /// The cost of a set of edges.
    pub(crate) fn total(&self, cut: &EdgeData<bool>) -> f64 {
        cut.entries().filter(|(_, is_cut)| **is_cut).map(|(edge, _)| self.0[edge]).sum()
    }
}
