//! Degrees of freedom, by elimination on dense matrices.

use crate::common::{Case, cases};
use pompeiu_fields::DegreesOfFreedom;
use pompeiu_operators::{Boundary, crouzeix_raviart_gradient_matrix, gradient_matrix};
use pompeiu_solve::SparseMatrix;
use pompeiu_surface::EdgeId;

/// The rank, by elimination with full pivoting among rows; columns are scaled to length one first.
fn rank(columns: Vec<Vec<f64>>) -> usize {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for mut column in columns {
        let norm = |c: &[f64]| c.iter().map(|x| x * x).sum::<f64>().sqrt();
        let size = norm(&column);
        if size == 0.0 {
            continue;
        }
        for _ in 0..2 {
            for b in &basis {
                let s: f64 = column.iter().zip(b).map(|(x, y)| x * y).sum();
                column.iter_mut().zip(b).for_each(|(x, y)| *x -= s * y);
            }
        }
        let rest = norm(&column);
        if rest > 1e-9 * size {
            basis.push(column.iter().map(|x| x / rest).collect());
        }
    }
    basis.len()
}

fn dense(matrix: &SparseMatrix, turn: bool, keep: impl Fn(usize) -> bool) -> Vec<Vec<f64>> {
    (0..matrix.columns())
        .filter(|&j| keep(j))
        .map(|j| {
            let mut column = vec![0.0; matrix.rows()];
            for (i, value) in matrix.column(j) {
                match (turn, i % 2) {
                    (false, _) => column[i] = value,
                    (true, 0) => column[i + 1] = value,
                    (true, _) => column[i - 1] = -value,
                }
            }
            column
        })
        .collect()
}

fn small_cases() -> Vec<Case> {
    cases().into_iter().filter(|case| case.surface.mesh().faces() <= 450).collect()
}

#[test]
fn counted_ranks_are_ranks() {
    for case in small_cases() {
        let (surface, mesh, name) = (&case.surface, case.surface.mesh(), case.name);
        let vertices = gradient_matrix(surface).unwrap();
        let edges = crouzeix_raviart_gradient_matrix(surface).unwrap();
        for boundary in [Boundary::Tangential, Boundary::Normal] {
            let counted = DegreesOfFreedom::of(mesh, boundary);
            let at_edges = boundary == Boundary::Tangential;
            let vertex = |v: usize| at_edges || !mesh.is_boundary_vertex(pompeiu_core::VertexId(v as u32));
            let edge = |e: usize| !at_edges || !mesh.is_boundary_edge(EdgeId(e as u32));
            let gradients = dense(&vertices, false, vertex);
            let rotated = dense(&edges, true, edge);
            assert_eq!(rank(gradients.clone()), counted.mixed.gradient, "{name}");
            assert_eq!(rank(rotated.clone()), counted.mixed.rotated, "{name}");
            // The two ranges intersect in zero only.
            let both = rank([gradients, rotated].concat());
            assert_eq!(both, counted.mixed.gradient + counted.mixed.rotated, "{name}");
            assert_eq!(counted.total - both, case.harmonic, "{name}");
            assert!(counted.adds_up() && counted.harmonic == case.harmonic, "{name}: {counted:?}");
        }
    }
}

#[test]
fn a_single_function_space_is_too_small_or_too_large() {
    for case in small_cases().into_iter().filter(|case| case.surface.mesh().boundary_loops().is_empty()) {
        let (surface, name) = (&case.surface, case.name);
        let counted = DegreesOfFreedom::of(surface.mesh(), Boundary::Tangential);
        let vertices = gradient_matrix(surface).unwrap();
        let both = [dense(&vertices, false, |_| true), dense(&vertices, true, |_| true)].concat();
        let conforming = rank(both).cast_signed();
        assert_eq!(counted.total.cast_signed() - conforming, counted.conforming.residual_dimension, "{name}");
        let edges = crouzeix_raviart_gradient_matrix(surface).unwrap();
        let [first, second] = [false, true].map(|turn| dense(&edges, turn, |_| true));
        assert_eq!(rank(first), counted.nonconforming.gradient, "{name}");
        assert_eq!(rank(second), counted.nonconforming.rotated, "{name}");
        assert!(counted.nonconforming.residual_dimension < 0, "{name}");
    }
}

#[test]
fn the_torus_of_the_literature() {
    let torus = cases().into_iter().find(|case| case.name == "torus").unwrap();
    let counted = DegreesOfFreedom::of(torus.surface.mesh(), Boundary::Tangential);
    assert_eq!((counted.mixed.gradient, counted.mixed.rotated, counted.harmonic), (383, 1151, 2));
    assert_eq!(counted.total, 1536);
    assert_eq!(counted.conforming.residual_dimension, 770);
    assert_eq!(counted.nonconforming.gradient + counted.nonconforming.rotated, 2302);
    let sphere = cases().into_iter().find(|case| case.name == "sphere").unwrap();
    assert_eq!(
        DegreesOfFreedom::of(sphere.surface.mesh(), Boundary::Tangential).conforming.residual_dimension,
        318
    );
}
