//! The sum of the barriers of all pairs, for those who minimise it themselves or compare it.

use crate::objective::{Element, assemble, sum};
use crate::{Contact, ContactError, Projection, Simulation};
use glam::DVec3;
use pompeiu_solve::{SparseMatrix, SymmetricBlocks};
use rayon::prelude::*;

impl Simulation {
    /// The potential `Σ w m b(d²)` of pairs at the current positions, without κ.
    pub fn potential(&self, pairs: &[Contact]) -> f64 {
        let (x, d) = (self.positions(), self.options.distance);
        sum(pairs.par_iter().map(|pair| pair.energy(x, d)).collect())
    }

    /// The gradient of [`potential`](Self::potential) by the position of each vertex.
    pub fn potential_gradient(&self, pairs: &[Contact]) -> Vec<DVec3> {
        let (x, d) = (self.positions(), self.options.distance);
        let mut gradient = vec![DVec3::ZERO; x.len()];
        let parts: Vec<[DVec3; 4]> =
            pairs.par_iter().map(|pair| pair.derivatives(x, d, Projection::Normal).0).collect();
        for (pair, parts) in pairs.iter().zip(parts) {
            for (&vertex, part) in pair.vertices.iter().zip(parts).take(pair.kind.count()) {
                gradient[vertex as usize] += part;
            }
        }
        gradient
    }

    /// The lower triangle of the positive semi-definite part of its second derivatives, three rows for each vertex that can move, in order.
    ///
    /// # Errors
    /// [`ContactError::Solve`] where an entry overflows.
    pub fn potential_hessian(
        &self,
        pairs: &[Contact],
        projection: Projection,
    ) -> Result<SparseMatrix, ContactError> {
        let (x, d) = (self.positions(), self.options.distance);
        let of_pair = |pair: &Contact| {
            let (gradient, curvature) = pair.derivatives(x, d, projection);
            Element { vertices: pair.vertices, count: pair.kind.count(), gradient, curvature }
        };
        let elements: Vec<Element> = pairs.par_iter().map(of_pair).collect();
        let mut matrix = SymmetricBlocks::default();
        let count = self.unknowns.iter().flatten().count();
        assemble(&mut matrix, &vec![0.0; 3 * count], &elements, &self.unknowns)?;
        Ok(matrix.matrix()?)
    }

    /// The part of a displacement of each vertex, from the current positions, that all can go without touching: 1 is all of it.
    ///
    /// # Panics
    /// If there is not one displacement for each vertex.
    pub fn free_part(&self, displacements: &[DVec3]) -> f64 {
        let x = self.positions();
        assert_eq!(displacements.len(), x.len(), "a displacement for each vertex");
        self.free_part_of(x, displacements, &self.candidates(x, Some(displacements)))
    }
}
