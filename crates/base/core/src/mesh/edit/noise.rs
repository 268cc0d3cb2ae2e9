//! Random displacement of vertices.

use super::random::Random;
use crate::mesh::{MeshError, TriMesh};

/// Moves every vertex by `amplitude` in a random direction, uniform on the sphere and independent of the others.
///
/// No point of the surface moves further than `amplitude`, so the distance to the original is at most that (up to
/// rounding).
///
/// # Errors
/// [`MeshError`] if a coordinate leaves the supported range, or if `amplitude` is not finite.
pub fn displace_at_random(mesh: &TriMesh, amplitude: f64, seed: u64) -> Result<TriMesh, MeshError> {
    let mut random = Random::new(seed);
    let displaced = |p: &[f64; 3]| {
        let direction = random.direction();
        std::array::from_fn(|i| p[i] + amplitude * direction[i])
    };
    TriMesh::new(mesh.positions().iter().map(displaced).collect(), mesh.faces().to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::icosphere;

    #[test]
    fn every_vertex_moves_by_the_amplitude_and_the_seed_decides_where() {
        let mesh = icosphere(1.0, 2).unwrap();
        let noisy = displace_at_random(&mesh, 0.25, 7).unwrap();
        assert_eq!(noisy.faces(), mesh.faces());
        for (p, q) in mesh.positions().iter().zip(noisy.positions()) {
            let moved = (0..3).map(|i| (p[i] - q[i]).powi(2)).sum::<f64>().sqrt();
            assert!((moved - 0.25).abs() < 1e-15);
        }
        assert_eq!(noisy, displace_at_random(&mesh, 0.25, 7).unwrap());
        assert_ne!(noisy, displace_at_random(&mesh, 0.25, 8).unwrap());
    }

    #[test]
    fn an_infinite_amplitude_is_refused() {
        let mesh = icosphere(1.0, 0).unwrap();
        assert!(matches!(displace_at_random(&mesh, f64::INFINITY, 0), Err(MeshError::NonFinite { .. })));
    }
}
