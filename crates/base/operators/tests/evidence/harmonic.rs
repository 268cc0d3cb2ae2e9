//! Harmonic fields have zero divergence and curl.

use crate::common::{cases, shared_cases, surface};
use pompeiu_core::mesh::shapes;
use pompeiu_operators::{Boundary, HarmonicBasis, Splitting, crouzeix_raviart_curl, divergence};
use pompeiu_surface::{EdgeId, SurfaceMesh};

#[test]
fn bases_are_orthonormal_without_divergence_or_curl() {
    for case in cases().into_iter().chain(shared_cases()) {
        let (surface, mesh, name) = (&case.surface, case.surface.mesh(), case.name);
        for boundary in [Boundary::Tangential, Boundary::Normal] {
            let basis = HarmonicBasis::new(surface, Splitting::Primal, boundary).unwrap();
            assert_eq!(basis.dimension(), case.harmonic, "{name}");
            for (i, u) in basis.fields().iter().enumerate() {
                for (j, w) in basis.fields().iter().enumerate() {
                    let expected = if i == j { 1.0 } else { 0.0 };
                    let product = pompeiu_operators::field_inner_product(surface, u, w);
                    assert!((product - expected).abs() <= 1e-12, "{name}: {i} {j} {product}");
                }
                let at_edges = boundary == Boundary::Tangential;
                let divergences = divergence(surface, u).unwrap();
                let curls = crouzeix_raviart_curl(surface, u).unwrap();
                // Against test functions whose gradients have norm one.
                let div = largest_inner(&divergences, |v| {
                    at_edges || !mesh.is_boundary_vertex(pompeiu_core::VertexId(v as u32))
                });
                let curl = largest_inner(&curls, |e| !at_edges || !is_boundary(mesh, e));
                assert!(div <= 1e-11 && curl <= 1e-11, "{name}: div {div:e}, curl {curl:e}");
            }
        }
    }
}

#[test]
fn bases_of_high_genus_are_orthonormal_with_the_same_bits_at_any_number_of_threads() {
    let mesh = shapes::perforated_plate(1.0, 6).unwrap();
    let surface = surface(&mesh);
    let basis = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| HarmonicBasis::new(&surface, Splitting::Primal, Boundary::Tangential).unwrap())
    };
    let one = basis(1);
    assert_eq!(one.dimension(), 2 * surface.mesh().genus());
    for (i, u) in one.fields().iter().enumerate() {
        for (j, w) in one.fields().iter().enumerate() {
            let expected = if i == j { 1.0 } else { 0.0 };
            let product = pompeiu_operators::field_inner_product(&surface, u, w);
            assert!((product - expected).abs() <= 1e-12, "{i} {j} {product}");
        }
        let div = largest_inner(&divergence(&surface, u).unwrap(), |_| true);
        let curl = largest_inner(&crouzeix_raviart_curl(&surface, u).unwrap(), |_| true);
        assert!(div <= 1e-11 && curl <= 1e-11, "{i}: div {div:e}, curl {curl:e}");
    }
    assert_eq!(one.fields(), basis(8).fields());
}

fn is_boundary(mesh: &SurfaceMesh, e: usize) -> bool {
    mesh.is_boundary_edge(EdgeId(e as u32))
}

fn largest_inner(values: &[f64], keep: impl Fn(usize) -> bool) -> f64 {
    let kept = values.iter().enumerate().filter(|(i, _)| keep(*i)).map(|(_, x)| x.abs());
    kept.fold(0.0, |m, x| if x > m { x } else { m })
}
