//! The Gaussian curvature of faces in the viscous forces, and how much of it they may contain.

use crate::FluidError;
use crate::space::Space;
use pompeiu_core::VertexId;
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_solve::{SolveError, SparseMatrix};
use pompeiu_surface::Surface;
use pompeiu_surface::plane::dot;
use std::f64::consts::PI;

/// The largest angle defect of a vertex that counts as curvature, in radians, and whether walls may drive the flow.
///
/// # Definition
/// Viscous power is the integral of a square minus a multiple of `∫ K |u|²`. On a smooth surface the difference is not negative. On
/// a mesh, the curvature of a vertex, its angle defect over its area, grows without bound where faces are small or
/// thin, and the squares of derivatives do not follow: viscosity would add energy there. The difference is made semidefinite by
/// limiting angle defects. The first limit of [`Self::ALL`] with which the rate of growth of every velocity is at most
/// [`GROWTH`] is taken; without any curvature and without driving walls, a sum of squares is left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CurvatureLimit {
    /// In radians; infinite if there is none.
    pub(crate) defect: f64,
    /// Whether the curvature of a wall may add to the tangential velocity there.
    pub(crate) walls_drive: bool,
}

/// The greatest rate at which viscosity may let a velocity of a component grow, for unit viscosity and area 4π.
///
/// On a sphere, rigid motions should neither grow nor decay; on an icosphere of 42 vertices they grow at a rate of about 0.1, which the
/// limit on the energy corrects. Curvature that is not resolved lets velocities grow at rates from about ten to the inverse of the
/// smallest area.
const GROWTH: f64 = 0.5;

impl CurvatureLimit {
    /// Those that are tried, in this order.
    const ALL: [Self; 8] = [
        Self::NONE,
        Self::of(1.0, true),
        Self::of(0.5, true),
        Self::of(0.25, true),
        Self::of(0.125, true),
        Self::of(0.0625, true),
        Self::of(0.0, true),
        Self::of(0.0, false),
    ];

    /// All curvature counts.
    pub(crate) const NONE: Self = Self::of(f64::INFINITY, true);

    const fn of(defect: f64, walls_drive: bool) -> Self {
        Self { defect, walls_drive }
    }

    /// What is left of the factor of a wall, which is negative where its curvature adds to the velocity.
    pub(crate) fn of_wall(self, factor: f64) -> f64 {
        if self.walls_drive || factor > 0.0 { factor } else { 0.0 }
    }

    /// The first limit that `is_semidefinite`, up to [`GROWTH`], with what `make` makes of it.
    ///
    /// # Errors
    /// Those of the two, but for matrices that are not definite.
    pub(crate) fn find<P>(
        mut make: impl FnMut(Self) -> Result<P, FluidError>,
        is_semidefinite: impl Fn(&P) -> Result<(), FluidError>,
    ) -> Result<(Self, P), FluidError> {
        let [tried @ .., last] = Self::ALL;
        for limit in tried {
            let made = make(limit)?;
            match is_semidefinite(&made) {
                Ok(()) => return Ok((limit, made)),
                Err(FluidError::Solve(SolveError::NotPositiveDefinite { .. })) => {}
                Err(error) => return Err(error),
            }
        }
        Ok((last, make(last)?))
    }

    /// The number of vertices inside whose angle defects are above the limit.
    pub(crate) fn limited(self, space: &Space<'_>) -> usize {
        let mesh = space.mesh();
        let defects = space.surface.angle_defects();
        let is_limited = |v: &VertexId| !mesh.is_boundary_vertex(*v) && defects[*v].abs() > self.defect;
        mesh.vertex_ids().filter(is_limited).count()
    }
}

/// A matrix of twice the energy times the rate of growth that is allowed on the component of each unknown.
pub(crate) fn allowed_growth(
    space: &Space<'_>,
    energy: &SparseMatrix,
    component: impl Fn(usize) -> usize,
) -> Result<SparseMatrix, FluidError> {
    let mesh = space.mesh();
    let mut areas = vec![0.0; mesh.components()];
    for v in mesh.vertex_ids() {
        areas[mesh.component(v)] += space.areas[v];
    }
    let scaled: Vec<(usize, usize, f64)> =
        energy.iter().map(|(i, j, value)| (i, j, GROWTH * 4.0 * PI / areas[component(j)] * value)).collect();
    Ok(SparseMatrix::from_triplets(energy.rows(), energy.columns(), &scaled)?)
}

/// The Gaussian curvature of each face: the mean of the limited angle defects per area at its corners. Boundary corners take the
/// values of their inner neighbours.
pub(crate) fn face_curvature(
    surface: &Surface,
    areas: &VertexData<f64>,
    limit: CurvatureLimit,
) -> FaceData<f64> {
    let mesh = surface.mesh();
    let mut defects = surface.angle_defects();
    defects.iter_mut().for_each(|defect| *defect = defect.clamp(-limit.defect, limit.defect));
    let inner = |v: &VertexId| !mesh.is_boundary_vertex(*v);
    let at = VertexData::from_fn(mesh.vertices(), |v| {
        if inner(&v) {
            return defects[v] / areas[v];
        }
        let neighbours = mesh.outgoing(v).flat_map(|h| [mesh.head(h), mesh.tail(h.previous())]);
        let (sum, area) =
            neighbours.filter(inner).fold((0.0, 0.0), |(sum, area), w| (sum + defects[w], area + areas[w]));
        if area > 0.0 { sum / area } else { 0.0 }
    });
    FaceData::from_fn(mesh.faces(), |face| mesh.face(face).into_iter().map(|v| at[v] / 3.0).sum())
}

/// At each boundary vertex the geodesic curvature integrated over half of the adjacent boundary edges, and their length; zero
/// inside.
///
/// The turning angle of the boundary at the vertex includes curvature of the surface, which is subtracted.
pub(crate) fn bends(space: &Space<'_>) -> (VertexData<f64>, VertexData<f64>) {
    let mesh = space.mesh();
    let curvature = face_curvature(space.surface, &space.areas, CurvatureLimit::NONE);
    let lengths = space.along_boundary(|h| {
        let side = space.surface.vector(h);
        dot(side, side).sqrt()
    });
    let turning = space.surface.angle_defects();
    let bend = VertexData::from_fn(mesh.vertices(), |v| {
        if !mesh.is_boundary_vertex(v) {
            return 0.0;
        }
        let inside: f64 =
            mesh.outgoing(v).map(|h| curvature[h.face()] * space.surface.face_area(h.face()) / 3.0).sum();
        turning[v] - inside
    });
    (bend, lengths)
}
