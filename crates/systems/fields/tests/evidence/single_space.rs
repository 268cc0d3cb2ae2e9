//! Decomposition with a single function space fails in the two ways that the degrees of freedom predict.

use crate::common::{Field, Random, cases};
use crate::compare::{distance, norm};
use pompeiu_fields::{DecompositionOptions, FunctionSpace, HodgeSolver, SingleSpaceParts, SingleSpaceSolver};
use pompeiu_operators::{Boundary, Splitting, crouzeix_raviart_gradient, gradient, rotated};
use pompeiu_surface::Surface;

const BOTH: [Boundary; 2] = [Boundary::Tangential, Boundary::Normal];

fn split(surface: &Surface, space: FunctionSpace, boundary: Boundary, field: &Field) -> SingleSpaceParts {
    SingleSpaceSolver::new(surface, space, boundary).unwrap().split(field).unwrap()
}

#[test]
fn each_part_is_that_of_the_mixed_splitting_with_this_space() {
    for case in cases() {
        let (surface, name) = (&case.surface, case.name);
        let field = Random(1).field(surface);
        let size = norm(surface, &field);
        for boundary in BOTH {
            let [primal, dual] = [Splitting::Primal, Splitting::Dual]
                .map(|splitting| DecompositionOptions { splitting, boundary })
                .map(|options| HodgeSolver::new(surface, &options).unwrap().decompose(&field).unwrap());
            let conforming = split(surface, FunctionSpace::Conforming, boundary, &field);
            let nonconforming = split(surface, FunctionSpace::Nonconforming, boundary, &field);
            for (found, expected) in [
                (&conforming.gradient, &primal.gradient),
                (&conforming.rotated, &dual.rotated),
                (&nonconforming.gradient, &dual.gradient),
                (&nonconforming.rotated, &primal.rotated),
            ] {
                assert!(distance(surface, found, expected) <= 1e-10 * size, "{name}");
            }
        }
    }
}

#[test]
fn continuous_functions_are_too_few() {
    for case in cases() {
        let (surface, mesh, name) = (&case.surface, case.surface.mesh(), case.name);
        // A rotated gradient without harmonic part or gradient, but not of a continuous function.
        let mut values = Random(2).values(mesh.edges());
        for edge in mesh.edge_ids().filter(|&e| mesh.is_boundary_edge(e)) {
            values[edge] = 0.0;
        }
        let field = rotated(&crouzeix_raviart_gradient(surface, &values).unwrap());
        let size = norm(surface, &field);
        let parts = split(surface, FunctionSpace::Conforming, Boundary::Tangential, &field);
        assert!(norm(surface, &parts.gradient) <= 1e-10 * size, "{name}");
        assert!(norm(surface, &parts.residual) >= 0.3 * size, "{name}");
        // The parts are orthogonal nevertheless: no number indicates the failure.
        let products = [parts.gradient_rotated, parts.residual_products[0], parts.residual_products[1]];
        assert!(products.iter().all(|x| x.abs() <= 1e-10), "{name}: {products:?}");
    }
}

#[test]
fn functions_that_agree_at_midpoints_are_too_many() {
    for case in cases() {
        let (surface, mesh, name) = (&case.surface, case.surface.mesh(), case.name);
        let field = crouzeix_raviart_gradient(surface, &Random(3).values(mesh.edges())).unwrap();
        let size = norm(surface, &field);
        let parts = split(surface, FunctionSpace::Nonconforming, Boundary::Tangential, &field);
        // It is a gradient, but a considerable part of it is also a rotated gradient.
        assert!(distance(surface, &parts.gradient, &field) <= 1e-10 * size, "{name}");
        assert!(norm(surface, &parts.rotated) >= 0.1 * size, "{name}");
        assert!(parts.gradient_rotated >= 0.01, "{name}: {}", parts.gradient_rotated);
        // For a continuous function the overlap is zero.
        let field = gradient(surface, &Random(4).values(mesh.vertices())).unwrap();
        let parts = split(surface, FunctionSpace::Nonconforming, Boundary::Tangential, &field);
        assert!(norm(surface, &parts.rotated) <= 1e-10 * norm(surface, &field), "{name}");
    }
}
