//! Whether two meshes seem to be in different units of length.

use super::TriMesh;
use crate::geom::Aabb;

/// Factors between units of length that people mix up: centimetres, inches and metres against millimetres, and more.
const UNIT_FACTORS: [f64; 4] = [10.0, 25.4, 100.0, 1000.0];

/// How far the ratio of two diagonals may be from a unit factor, relative to it, to be taken for one.
const UNIT_FACTOR_TOLERANCE: f64 = 0.02;

/// The factor between two units of length by which the diagonals of two meshes differ, if there seems to be one, and whether the first mesh
/// is the larger. It suggests that the meshes are in different units, and proves nothing: two parts can differ in size by ten.
pub fn unit_factor(a: &TriMesh, b: &TriMesh) -> Option<(f64, bool)> {
    let [a, b] = [a, b].map(|mesh| Aabb::of_faces(mesh).diagonal());
    let (ratio, first_is_larger) = if a > b { (a / b, true) } else { (b / a, false) };
    let near = |factor: &f64| (ratio / factor - 1.0).abs() <= UNIT_FACTOR_TOLERANCE;
    UNIT_FACTORS.into_iter().find(near).map(|factor| (factor, first_is_larger))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::{cube, point_lattice, tetrahedron};

    #[test]
    fn unit_factors_are_recognised_both_ways_and_nothing_else_is() {
        let size = |side| cube(side, 1).unwrap();
        assert_eq!(unit_factor(&size(2.0), &size(50.8)), Some((25.4, false)));
        assert_eq!(unit_factor(&size(1010.0), &size(1.0)), Some((1000.0, true)));
        assert_eq!(unit_factor(&size(1.0), &size(1.0)), None);
        assert_eq!(unit_factor(&size(1.0), &size(10.5)), None);
        let mut corner = tetrahedron(1.0).unwrap().into_parts();
        corner.1 = vec![[0, 0, 0]];
        let point = TriMesh::new(corner.0, corner.1).unwrap();
        assert_eq!(unit_factor(&point, &point), None);
        assert_eq!(unit_factor(&point, &point_lattice(1.0, 1).unwrap()), None);
    }
}
