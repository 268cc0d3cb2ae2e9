//! Distances along a surface, from the way heat spreads.

use crate::OperatorError;
use crate::gradient::{divergence, gradient};
use crate::laplacian::cotan_laplacian;
use pompeiu_core::VertexId;
use pompeiu_core::mesh::VertexData;
use pompeiu_solve::{Cholesky, LinearSolver, SemidefiniteCholesky, SparseMatrix};
use pompeiu_surface::Surface;
use pompeiu_surface::plane::norm;

/// A surface made ready for distances from any vertices: the heat method.
///
/// # Definition
/// Heat spreads from the sources for a short time t, `(M + t L) u = δ`; its gradient points along shortest ways, so the
/// distance is the function whose gradient is nearest to `−∇u / |∇u|`, zero on average at the sources. Nothing flows through
/// the boundary.
///
/// # Accuracy
/// First order in the length of edges, in practice about a percent of the distance on evenly triangulated surfaces. Not a
/// bound on either side. Where edges are not Delaunay the Laplacian has no maximum principle, and distances get worse.
///
/// # Limits
/// Heat that has fallen below the range of doubles has no direction: at more than some seven hundred edges from the sources
/// distances are those of the smoothest continuation. A longer time helps.
///
/// # Cost
/// Two sparse factorizations to prepare, two solves for each question.
///
/// # Source
/// `crane_geodesics_2013`.
#[derive(Debug)]
pub struct HeatMethod<'s> {
    surface: &'s Surface,
    heat: Cholesky,
    poisson: SemidefiniteCholesky,
}

impl<'s> HeatMethod<'s> {
    /// Prepares a surface, with the square of the mean length of edges for time.
    ///
    /// # Errors
    /// [`OperatorError::Solve`] if a matrix cannot be factored, which very thin faces can cause.
    pub fn new(surface: &'s Surface) -> Result<Self, OperatorError> {
        let lengths = surface.edge_lengths();
        let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
        Self::with_time(surface, mean * mean)
    }

    /// Prepares a surface with heat that spreads for this time, in squared length.
    ///
    /// # Errors
    /// [`OperatorError::Solve`]; also for a time that is not a finite number above zero.
    pub fn with_time(surface: &'s Surface, time: f64) -> Result<Self, OperatorError> {
        let laplacian = cotan_laplacian(surface)?;
        let mass = SparseMatrix::diagonal(&surface.vertex_areas())?;
        let heat = Cholesky::new(&mass.combined(1.0, &laplacian, time)?)?;
        let mesh = surface.mesh();
        let group: Vec<Option<u32>> = mesh.vertex_ids().map(|v| Some(mesh.component(v) as u32)).collect();
        let poisson = SemidefiniteCholesky::new(laplacian, &vec![false; mesh.vertices()], &group)?;
        Ok(Self { surface, heat, poisson })
    }

    /// The distance of every vertex from the nearest source; infinite on components without one.
    ///
    /// # Errors
    /// [`OperatorError::NoSuchVertex`]; [`OperatorError::Solve`] when values leave the range of doubles.
    pub fn distances(&self, sources: &[VertexId]) -> Result<VertexData<f64>, OperatorError> {
        let mesh = self.surface.mesh();
        let mut heat = VertexData::filled(mesh.vertices(), 0.0);
        for &vertex in sources {
            let vertices = mesh.vertices();
            *heat.get_mut(vertex.index()).ok_or(OperatorError::NoSuchVertex { vertex, vertices })? = 1.0;
        }
        self.heat.solve_in_place(&mut heat)?;
        let mut field = gradient(self.surface, &heat)?;
        for u in &mut field {
            let largest = if u[0].abs() > u[1].abs() { u[0].abs() } else { u[1].abs() };
            if largest > 0.0 {
                // Scaled first: squares of faint heat would be zero.
                let scaled = u.map(|x| x / largest);
                let length = norm(scaled);
                *u = scaled.map(|x| -x / length);
            }
        }
        // G_vᵀ M u is minus the divergence.
        let mut distances = divergence(self.surface, &field)?;
        for value in &mut distances {
            *value = -*value;
        }
        self.poisson.solve_in_place(&mut distances)?;
        let mut sums = vec![(0.0, 0.0); mesh.components()];
        for &source in sources {
            let (sum, count) = &mut sums[mesh.component(source)];
            *sum += distances[source];
            *count += 1.0;
        }
        for (v, distance) in mesh.vertex_ids().zip(&mut distances) {
            let (sum, count) = sums[mesh.component(v)];
            *distance = if count > 0.0 { *distance - sum / count } else { f64::INFINITY };
        }
        Ok(distances)
    }
}
