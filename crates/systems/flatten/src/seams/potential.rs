//! How far a chart is from a flat one, before it is mapped.

use pompeiu_core::mesh::VertexData;
use pompeiu_core::{FaceId, VertexId};
use pompeiu_solve::{Analysis, Cholesky, ElementPattern, FIXED, LinearSolver, Ordering, SolveError};
use pompeiu_surface::Surface;

/// The energy beyond that of an isometry for a squared logarithm of the scale, to first order.
const PER_SQUARE: f64 = 4.0;

/// Greatest cotangent, so that faces without angle do not make the system singular to rounding.
const GREATEST_COTANGENT: f64 = 1e6;

/// The logarithm u of the scale of the conformal map that keeps the lengths of the outline, up to its sign, and what it says of the
/// energy.
#[derive(Clone, Debug)]
pub(super) struct Potential {
    /// The vertices of the chart, increasing, with their values; zero on the outline.
    pub(super) values: Vec<(VertexId, f64)>,
    /// The estimated symmetric Dirichlet energy beyond that of an isometry, integrated over the area.
    pub(super) excess: f64,
}

/// The parts of the computation that do not depend on charts.
pub(super) struct Curvature<'s> {
    surface: &'s Surface,
    defects: VertexData<f64>,
}

impl<'s> Curvature<'s> {
    pub(super) fn new(surface: &'s Surface) -> Self {
        Self { surface, defects: surface.angle_defects() }
    }

    /// The potential of the chart with these faces, whose outline is where vertices are fixed.
    ///
    /// # Definition
    /// The solution of Δu = K that vanishes on the outline; the excess is four times the integral of its squared deviation from the mean.
    /// In linear elasticity without lateral contraction, the energy of a plate that is flattened is four times the squared distance of u
    /// from all harmonic functions; on strips and on discs of constant curvature the constants among these are the nearest.
    ///
    /// # Source
    /// Ours; `sawhney_boundary_2017` for the conformal map.
    pub(super) fn potential(
        &self,
        faces: &[FaceId],
        is_fixed: impl Fn(VertexId) -> bool,
    ) -> Result<Potential, SolveError> {
        let mesh = self.surface.mesh();
        let mut vertices: Vec<VertexId> = faces.iter().flat_map(|&face| mesh.face(face)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let mut unknowns = 0;
        let number: Vec<u32> = vertices
            .iter()
            .map(|&v| {
                if is_fixed(v) {
                    return FIXED;
                }
                unknowns += 1;
                unknowns - 1
            })
            .collect();
        let place = |v: VertexId| vertices.binary_search(&v).unwrap_or(0);
        let corners: Vec<[usize; 3]> = faces.iter().map(|&face| mesh.face(face).map(place)).collect();
        let mut solution = vec![0.0; unknowns as usize];
        if unknowns > 0 {
            for (&v, &k) in vertices.iter().zip(&number).filter(|(_, k)| **k != FIXED) {
                solution[k as usize] = self.defects[v];
            }
            let elements: Vec<[u32; 3]> = corners.iter().map(|face| face.map(|i| number[i])).collect();
            let matrix = ElementPattern::new(unknowns as usize, &elements)?
                .assemble(&vec![0.0; unknowns as usize], |m| self.stiffness(faces[m]))?;
            let analysis = Analysis::new(&matrix, &Ordering::MinimumDegree)?;
            Cholesky::with(&analysis, &matrix)?.solve_in_place(&mut solution)?;
        }
        let value = |i: usize| number.get(i).and_then(|&k| solution.get(k as usize)).copied().unwrap_or(0.0);
        let (mut area, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for (&face, corners) in faces.iter().zip(&corners) {
            let third = self.surface.face_area(face) / 3.0;
            for u in corners.map(value) {
                area += third;
                sum += third * u;
                squares += third * u * u;
            }
        }
        let excess = PER_SQUARE * (squares - sum * sum / area);
        let values = vertices.iter().enumerate().map(|(i, &v)| (v, value(i))).collect();
        Ok(Potential { values, excess })
    }

    /// The stiffness matrix of a face for continuous linear functions.
    fn stiffness(&self, face: FaceId) -> [[f64; 3]; 3] {
        let halves = [0, 1, 2].map(|i| {
            let cotangent = self.surface.cotangent(pompeiu_surface::HalfedgeId::of(face, i));
            0.5 * cotangent.clamp(-GREATEST_COTANGENT, GREATEST_COTANGENT)
        });
        let [a, b, c] = halves;
        [[b + c, -c, -b], [-c, a + c, -a], [-b, -a, a + b]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::TriMesh;
    use pompeiu_core::mesh::shapes::disk;
    use pompeiu_surface::EmbeddedSurface;

    /// On a cap of radius R of a unit sphere the potential is (R² − r²)/4 to first order, and the excess per area R⁴/48.
    #[test]
    fn the_excess_of_a_cap_is_that_of_its_closed_form() {
        for radius in [0.2, 0.3] {
            let flat = disk(radius, 64, 24).unwrap();
            let lifted = flat.positions().iter().map(|[x, y, _]| {
                let r = x.hypot(*y);
                let s = if r > 0.0 { libm::sin(r) / r } else { 1.0 };
                [s * x, s * y, libm::cos(r)]
            });
            let cap = TriMesh::new(lifted.collect(), flat.faces().to_vec()).unwrap();
            let cap = EmbeddedSurface::new(&cap).unwrap();
            let (surface, mesh) = (cap.surface(), cap.mesh());
            let faces: Vec<FaceId> = mesh.face_ids().collect();
            let found = Curvature::new(surface).potential(&faces, |v| mesh.is_boundary_vertex(v)).unwrap();
            let expected = radius.powi(4) / 48.0;
            let ratio = found.excess / surface.area() / expected;
            assert!((ratio - 1.0).abs() < 0.05, "{radius}: {ratio}");
            let centre = found.values.iter().fold(0.0_f64, |most, (_, u)| most.max(u.abs()));
            assert!((centre / (radius * radius / 4.0) - 1.0).abs() < 0.03, "{radius}: {centre}");
        }
    }
}
