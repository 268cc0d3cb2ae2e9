//! Evidence that does not come from the code: exact solutions, invariants, closed forms of rates, hostile input.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod definite;
mod densities;
mod handles;
mod input;
#[cfg(feature = "serde")]
mod requests;
mod sphere;
mod square;
mod walls;

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_core::mesh::{Random, VertexData};
use pompeiu_surface::EmbeddedSurface;

fn surface(mesh: &TriMesh) -> EmbeddedSurface {
    EmbeddedSurface::new(mesh).unwrap()
}

/// The unit sphere, from an icosahedron.
fn sphere(subdivisions: u32) -> EmbeddedSurface {
    surface(&icosphere(1.0, subdivisions).unwrap())
}

/// The same with vertices displaced along the sphere by up to about `amount` times the mean edge length.
fn jittered_sphere(subdivisions: u32, amount: f64) -> EmbeddedSurface {
    let mesh = icosphere(1.0, subdivisions).unwrap();
    let h = amount * 1.15 / f64::from(1 << subdivisions);
    let mut random = Random::new(7);
    let (positions, faces) = mesh.into_parts();
    let moved = positions.into_iter().map(|p| {
        let q = p.map(|x| x + h * random.signed_unit());
        let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        q.map(|x| x / length)
    });
    surface(&TriMesh::new(moved.collect(), faces).unwrap())
}

/// Values of a function of space at vertices.
fn values(surface: &EmbeddedSurface, f: impl Fn([f64; 3]) -> f64) -> VertexData<f64> {
    surface.positions().map(|&p| f(p))
}

fn relative(found: f64, expected: f64) -> f64 {
    (found / expected - 1.0).abs()
}
