//! Growing a cut by joining vertices to it.

use super::costs::Costs;
use pompeiu_core::VertexId;
use pompeiu_surface::{EdgeData, EdgeDistances, Surface};

/// A cut that grows by shortest paths from the existing cut or from the boundary.
///
/// On a disk, and on a sphere from the first vertex on, the cut stays a tree rooted in the boundary, and the opened surface stays a
/// disk.
#[derive(Clone, Debug)]
pub(crate) struct GrowingCut<'s> {
    surface: &'s Surface,
    costs: &'s Costs,
    pub(crate) edges: EdgeData<bool>,
    /// Vertices on the cut or on the boundary.
    reached: Vec<bool>,
}

impl<'s> GrowingCut<'s> {
    pub(crate) fn new(surface: &'s Surface, costs: &'s Costs, edges: EdgeData<bool>) -> Self {
        let mesh = surface.mesh();
        let mut reached: Vec<bool> = mesh.vertex_ids().map(|v| mesh.is_boundary_vertex(v)).collect();
        for edge in mesh.edge_ids().filter(|&edge| edges[edge]) {
            for v in mesh.ends(edge) {
                reached[v.index()] = true;
            }
        }
        Self { surface, costs, edges, reached }
    }

    /// Whether the cut is empty and there is no boundary.
    pub(crate) fn is_empty(&self) -> bool {
        !self.reached.contains(&true)
    }

    /// Makes a vertex the root of the cut.
    pub(crate) fn start_at(&mut self, v: VertexId) {
        self.reached[v.index()] = true;
    }

    /// The vertices that are reached.
    pub(crate) fn reached(&self) -> Vec<VertexId> {
        self.surface.mesh().vertex_ids().filter(|v| self.reached[v.index()]).collect()
    }

    /// Joins all these vertices, nearest first; returns those that no path reaches.
    ///
    /// # Source
    /// `takahashi_approximate_1980`: the length is less than twice the minimum.
    pub(crate) fn join(&mut self, terminals: &[VertexId]) -> Vec<VertexId> {
        let mut left = terminals.to_vec();
        if self.is_empty()
            && let Some(&first) = left.first()
        {
            self.start_at(first);
        }
        loop {
            left.retain(|v| !self.reached[v.index()]);
            let from = EdgeDistances::along(self.surface, &self.reached(), |edge| self.costs.of(edge));
            let near = left.iter().copied().min_by(|a, b| from.distances[*a].total_cmp(&from.distances[*b]));
            let Some(near) = near.filter(|v| from.distances[*v].is_finite()) else { return left };
            for edge in from.path_to(self.surface, near) {
                self.edges[edge] = true;
                for v in self.surface.mesh().ends(edge) {
                    self.reached[v.index()] = true;
                }
            }
        }
    }
}
