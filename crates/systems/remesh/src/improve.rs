//! Better triangles for a surface on its way.

use super::connectivity::{DynamicMesh, NONE};
use super::features::Features;
use super::flips::flip_to_delaunay;
use super::marked::{Hold, Marked};
use super::remesh_options::{RemeshError, RemeshOptions};
use super::run::remesh;
use super::sizing::Sizing;
use super::smooth::smooth;
use pompeiu_core::VertexId;
use pompeiu_core::spatial::Slot;

/// Rounds of remeshing: few, because the surface is remeshed again and again.
const ITERATIONS: usize = 3;

impl DynamicMesh {
    /// The surface with edges flipped towards Delaunay triangles, and vertices moved within it towards the middle of their neighbours.
    /// The boundary stays, or its vertices move along it.
    #[must_use]
    pub fn improved(&self, moves: usize, boundary_stays: bool) -> Self {
        let count = self.positions.len();
        let hold = |v: u32| match self.is_boundary(v) {
            true if boundary_stays => Hold::Corner,
            true => Hold::Curve(0),
            false => Hold::Free,
        };
        let curve = |h: usize| if self.origin[h] != NONE && self.twin[h] == NONE { 0 } else { NONE };
        let mut surface = Marked {
            mesh: self.clone(),
            curve: (0..self.origin.len()).map(curve).collect(),
            hold: (0..count as u32).map(hold).collect(),
            // Neither lengths nor an input are asked for.
            length: vec![0.0; count],
            near: vec![Slot::default(); count],
        };
        flip_to_delaunay(&mut surface);
        for _ in 0..moves {
            smooth(&mut surface, None, 1);
            flip_to_delaunay(&mut surface);
        }
        surface.mesh
    }

    /// The surface with edges of this length. The vertices of the boundary stay, or move along it.
    ///
    /// # Errors
    /// [`RemeshError`]: the length must be one that the surface can have.
    pub fn remeshed(&self, length: f64, boundary_stays: bool) -> Result<Self, RemeshError> {
        let mesh = self.to_mesh()?;
        let kept: Vec<VertexId> = (0..mesh.positions().len() as u32)
            .filter(|&v| boundary_stays && self.is_boundary(v))
            .map(VertexId)
            .collect();
        let options = RemeshOptions {
            features: Features { vertices: &kept, ..Features::default() },
            iterations: ITERATIONS,
            measure: false,
            ..RemeshOptions::new(Sizing::Length(length))
        };
        let found = remesh(&mesh, &options)?.mesh;
        Ok(Self::new(found.positions(), found.faces())?)
    }
}
