//! A smooth deformation.

use crate::mesh::{MeshError, TriMesh};
use std::f64::consts::TAU;

/// Moves every vertex along smooth waves: x by `amplitude · sin(2π y / wavelength)`, y by the same of z, z by that of x.
///
/// No vertex moves further than `√3 · amplitude`. Where edges are short compared with the wavelength, both ends move almost alike;
/// nothing folds when `amplitude` is below `wavelength / 4π`.
///
/// # Errors
/// [`MeshError`] if a coordinate leaves the supported range, or if `amplitude` or `wavelength` is not finite, or if
/// `wavelength` is zero.
pub fn ripple(mesh: &TriMesh, amplitude: f64, wavelength: f64) -> Result<TriMesh, MeshError> {
    // An infinite wavelength would silently mean no waves.
    let length = if wavelength.is_finite() { wavelength } else { f64::NAN };
    let displaced =
        |p: &[f64; 3]| std::array::from_fn(|i| p[i] + amplitude * libm::sin(TAU * (p[(i + 1) % 3] / length)));
    TriMesh::new(mesh.positions().iter().map(displaced).collect(), mesh.faces().to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::{Diagonal, grid, icosphere};

    #[test]
    fn crests_and_nodes_are_where_the_sine_has_them() {
        let mesh = grid([1.0, 1.0], [4, 4], Diagonal::Rising).unwrap();
        let waved = ripple(&mesh, 0.1, 1.0).unwrap();
        assert_eq!(waved.faces(), mesh.faces());
        for (p, q) in mesh.positions().iter().zip(waved.positions()) {
            let moved: [f64; 3] = std::array::from_fn(|i| q[i] - p[i]);
            // In the plane z = 0 the displacement of y is zero; vertices at quarters of a wave are nodes or crests.
            let quarters = |x: f64| [0.0, 0.1, 0.0, -0.1][(4.0 * x).round().rem_euclid(4.0) as usize];
            assert_eq!(moved[1], 0.0);
            assert!((moved[0] - quarters(p[1])).abs() < 1e-15, "{p:?} moved by {moved:?}");
            assert!((moved[2] - quarters(p[0])).abs() < 1e-15, "{p:?} moved by {moved:?}");
        }
    }

    #[test]
    fn what_is_not_finite_is_refused() {
        let mesh = icosphere(1.0, 0).unwrap();
        for (amplitude, wavelength) in
            [(f64::INFINITY, 1.0), (f64::NAN, 1.0), (0.1, 0.0), (0.1, f64::INFINITY), (0.1, f64::NAN)]
        {
            let refused = ripple(&mesh, amplitude, wavelength);
            assert!(matches!(refused, Err(MeshError::NonFinite { .. })), "{amplitude} {wavelength}");
        }
    }
}
