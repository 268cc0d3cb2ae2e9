//! Degrees of freedom, by elimination on dense matrices.

use crate::common::{Case, cases};
use pompeiu_fields::Audit;
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
            let audit = Audit::of(mesh, boundary);
            let at_edges = boundary == Boundary::Tangential;
            let vertex = |v: usize| at_edges || !mesh.is_boundary_vertex(pompeiu_core::VertexId(v as u32));
            let edge = |e: usize| !at_edges || !mesh.is_boundary_edge(EdgeId(e as u32));
            let gradients = dense(&vertices, false, vertex);
            let rotated = dense(&edges, true, edge);
            assert_eq!(rank(gradients.clone()), audit.mixed.gradient, "{name}");
            assert_eq!(rank(rotated.clone()), audit.mixed.rotated, "{name}");
            // The two ranges have nothing in common.
            let both = rank([gradients, rotated].concat());
            assert_eq!(both, audit.mixed.gradient + audit.mixed.rotated, "{name}");
            assert_eq!(audit.degrees_of_freedom - both, case.harmonic, "{name}");
            assert!(audit.adds_up() && audit.harmonic == case.harmonic, "{name}: {audit:?}");
        }
    }
}

#[test]
fn one_kind_of_function_is_not_enough_or_too_much() {
    for case in small_cases().into_iter().filter(|case| case.surface.mesh().boundary_loops().is_empty()) {
        let (surface, name) = (&case.surface, case.name);
        let audit = Audit::of(surface.mesh(), Boundary::Tangential);
        let vertices = gradient_matrix(surface).unwrap();
        let both = [dense(&vertices, false, |_| true), dense(&vertices, true, |_| true)].concat();
        let conforming = rank(both).cast_signed();
        assert_eq!(audit.degrees_of_freedom.cast_signed() - conforming, audit.conforming.left_over, "{name}");
        let edges = crouzeix_raviart_gradient_matrix(surface).unwrap();
        let [first, second] = [false, true].map(|turn| dense(&edges, turn, |_| true));
        assert_eq!(rank(first), audit.nonconforming.gradient, "{name}");
        assert_eq!(rank(second), audit.nonconforming.rotated, "{name}");
        assert!(audit.nonconforming.left_over < 0, "{name}");
    }
}

#[test]
fn the_torus_of_the_literature() {
    let torus = cases().into_iter().find(|case| case.name == "torus").unwrap();
    let audit = Audit::of(torus.surface.mesh(), Boundary::Tangential);
    assert_eq!((audit.mixed.gradient, audit.mixed.rotated, audit.harmonic), (383, 1151, 2));
    assert_eq!(audit.degrees_of_freedom, 1536);
    assert_eq!(audit.conforming.left_over, 770);
    assert_eq!(audit.nonconforming.gradient + audit.nonconforming.rotated, 2302);
    let sphere = cases().into_iter().find(|case| case.name == "sphere").unwrap();
    assert_eq!(Audit::of(sphere.surface.mesh(), Boundary::Tangential).conforming.left_over, 318);
}
