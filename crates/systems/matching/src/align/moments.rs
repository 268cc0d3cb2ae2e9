//! Area, centroid and second moments of a surface.

use super::AlignError;
use glam::{DMat3, DVec3};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::{Aabb, Frame, eigenvectors};

/// The moments of a surface, in the frame of its box.
#[derive(Clone, Debug)]
pub(super) struct Moments {
    pub(super) frame: Frame,
    pub(super) centroid: DVec3,
    /// Second moments about the centroid, per area.
    covariance: DMat3,
    /// In units of the frame.
    pub(super) area: f64,
    /// Of the box of the faces, in the frame.
    pub(super) diagonal: f64,
}

impl Moments {
    /// Sums over the faces in their order, so that the bits do not depend on threads.
    ///
    /// # Definition
    /// For a triangle of area A with corners `v_i` the integral of `x xᵀ` is `A / 12 (Σ v_i v_iᵀ + s sᵀ)`, `s = Σ v_i`.
    pub(super) fn of(mesh: &TriMesh) -> Result<Self, AlignError> {
        let aabb = Aabb::of_faces(mesh);
        let frame = Frame::of(&aabb);
        let corners =
            || mesh.face_ids().map(|face| mesh.corners(face).map(|p| DVec3::from_array(frame.map(p))));
        let (mut area, mut first) = (0.0, DVec3::ZERO);
        for [a, b, c] in corners() {
            let doubled = (b - a).cross(c - a).length();
            area += doubled;
            first += doubled * (a + b + c);
        }
        let centroid = first / (3.0 * area);
        if !centroid.is_finite() {
            return Err(AlignError::NoArea { faces: mesh.faces().len() });
        }
        let mut second = DMat3::ZERO;
        for triangle in corners() {
            let [a, b, c] = triangle.map(|v| v - centroid);
            let square = |v: DVec3| DMat3::from_cols(v * v.x, v * v.y, v * v.z);
            let doubled = (b - a).cross(c - a).length();
            second += doubled * (square(a) + square(b) + square(c) + square(a + b + c));
        }
        let diagonal = frame.length_in(aabb.diagonal());
        Ok(Self { frame, centroid, covariance: second * (1.0 / (12.0 * area)), area: 0.5 * area, diagonal })
    }

    /// Root-mean-square distance from the centroid, in the unit of the mesh.
    pub(super) fn radius(&self) -> f64 {
        let c = self.covariance;
        self.frame.length_out((c.x_axis.x + c.y_axis.y + c.z_axis.z).sqrt())
    }

    /// The centroid in the unit of the mesh.
    pub(super) fn world_centroid(&self) -> [f64; 3] {
        self.frame.unmap(self.centroid.to_array())
    }

    /// Unit principal axes as the columns of a rotation, that of the largest moment first.
    pub(super) fn axes(&self) -> DMat3 {
        eigenvectors(self.covariance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::{cube, icosphere};
    use pompeiu_core::mesh::{Affine, transform};

    #[test]
    fn a_cube_has_the_moments_of_its_surface() {
        for cells in [1, 4] {
            let cube = cube(2.0, cells).unwrap();
            let moved = transform(&cube, &Affine::translate([1e3, -7.0, 0.5])).unwrap();
            let moments = Moments::of(&moved).unwrap();
            let found = moments.world_centroid();
            let corner = Aabb::of_faces(&moved).lower;
            assert!((0..3).all(|k| (found[k] - corner[k] - 1.0).abs() < 1e-12), "{found:?} {corner:?}");
            // Two faces at distance 1 and four on which the mean square is 1/3, for each axis.
            let expected = (3.0 * (2.0 + 4.0 / 3.0) / 6.0_f64).sqrt();
            assert!((moments.radius() / expected - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn a_fine_sphere_has_nearly_the_radius_of_its_vertices() {
        let moments = Moments::of(&icosphere(3.0, 5).unwrap()).unwrap();
        assert!((moments.radius() / 3.0 - 1.0).abs() < 1e-3);
        assert!(moments.centroid.length() < 1e-12);
    }
}
