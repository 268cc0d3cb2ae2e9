//! Identities that hold for any surface and any field.

use crate::common::{Random, cases, largest, shared_cases};
use pompeiu_core::VertexId;
use pompeiu_operators::{
    cotan_laplacian, crouzeix_raviart_curl, crouzeix_raviart_divergence, crouzeix_raviart_gradient,
    crouzeix_raviart_gradient_matrix, crouzeix_raviart_laplacian, curl, divergence, face_mass,
    field_inner_product, gradient, gradient_matrix, mass_matrix, rotated,
};
use pompeiu_solve::SparseMatrix;

/// The largest entry of `|Aᵀ M J B|` relative to the sum of the absolute values of its terms.
fn relative_overlap(a: &SparseMatrix, mass: &SparseMatrix, b: &SparseMatrix) -> f64 {
    let weights = mass.diagonal_entries();
    let by_row = a.transposed();
    let mut worst = 0.0_f64;
    for j in 0..b.columns() {
        let mut sums = std::collections::BTreeMap::new();
        for (row, value) in b.column(j) {
            // J maps the component along the first axis to the second, and the second to minus the first.
            let (turned, sign) = if row % 2 == 0 { (row + 1, 1.0) } else { (row - 1, -1.0) };
            for (i, other) in by_row.column(turned) {
                let term = sign * value * other * weights[row];
                let (sum, size) = sums.entry(i).or_insert((0.0, 0.0));
                *sum += term;
                *size += term.abs();
            }
        }
        for &(sum, size) in sums.values() {
            if size > 0.0 {
                worst = worst.max(f64::abs(sum) / size);
            }
        }
    }
    worst
}

#[test]
fn gradients_and_rotated_gradients_are_orthogonal() {
    for case in cases().into_iter().chain(shared_cases()) {
        let surface = &case.surface;
        let (v, e) = (gradient_matrix(surface).unwrap(), crouzeix_raviart_gradient_matrix(surface).unwrap());
        // At the boundary one of the two potentials is zero; inner columns only.
        let mesh = surface.mesh();
        let at_boundary = |e: usize| mesh.is_boundary_edge(pompeiu_surface::EdgeId(e as u32));
        let inner: Vec<(usize, usize, f64)> = e.iter().filter(|entry| !at_boundary(entry.1)).collect();
        let inner = SparseMatrix::from_triplets(e.rows(), e.columns(), &inner).unwrap();
        let overlap = relative_overlap(&v, &face_mass(surface).unwrap(), &inner);
        assert!(overlap <= 1e-13, "{}: {overlap:e}", case.name);
    }
}

#[test]
fn functions_and_matrices_are_the_same_operators() {
    for case in cases() {
        let (surface, name) = (&case.surface, case.name);
        let mut random = Random(7);
        let a = random.values(surface.mesh().vertices());
        let b = random.values(surface.mesh().edges());
        let by_matrix = gradient_matrix(surface).unwrap().multiply(&a);
        let direct = gradient(surface, &a).unwrap();
        let scale = largest(&by_matrix);
        for (x, y) in direct.as_flattened().iter().zip(&by_matrix) {
            assert!((x - y).abs() <= 1e-13 * scale, "{name}");
        }
        let by_matrix = crouzeix_raviart_gradient_matrix(surface).unwrap().multiply(&b);
        let direct = crouzeix_raviart_gradient(surface, &b).unwrap();
        let scale = largest(&by_matrix);
        for (x, y) in direct.as_flattened().iter().zip(&by_matrix) {
            assert!((x - y).abs() <= 1e-13 * scale, "{name}");
        }
    }
}

#[test]
fn divergence_and_curl_are_adjoint_to_gradients() {
    for case in cases() {
        let (surface, name) = (&case.surface, case.name);
        let mut random = Random(11);
        let u = random.field(surface);
        let a = random.values(surface.mesh().vertices());
        let b = random.values(surface.mesh().edges());
        let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
        let (ga, gb) = (gradient(surface, &a).unwrap(), crouzeix_raviart_gradient(surface, &b).unwrap());
        let pairs = [
            (field_inner_product(surface, &ga, &u), -dot(&a, &divergence(surface, &u).unwrap())),
            (field_inner_product(surface, &rotated(&ga), &u), dot(&a, &curl(surface, &u).unwrap())),
            (
                field_inner_product(surface, &rotated(&gb), &u),
                dot(&b, &crouzeix_raviart_curl(surface, &u).unwrap()),
            ),
            (
                field_inner_product(surface, &gb, &u),
                -dot(&b, &crouzeix_raviart_divergence(surface, &u).unwrap()),
            ),
        ];
        for (i, (x, y)) in pairs.into_iter().enumerate() {
            assert!((x - y).abs() <= 1e-11 * (1.0 + x.abs()), "{name}, {i}: {x} {y}");
        }
    }
}

#[test]
fn laplacians_are_products_of_gradients() {
    for case in cases() {
        let (surface, name) = (&case.surface, case.name);
        let mass = face_mass(surface).unwrap().diagonal_entries();
        for (gradient, laplacian) in [
            (gradient_matrix(surface).unwrap(), cotan_laplacian(surface).unwrap()),
            (
                crouzeix_raviart_gradient_matrix(surface).unwrap(),
                crouzeix_raviart_laplacian(surface).unwrap(),
            ),
        ] {
            let x = Random(5).values::<VertexId>(gradient.columns());
            let weighted: Vec<f64> = gradient.multiply(&x).iter().zip(&mass).map(|(y, m)| y * m).collect();
            let expected = gradient.multiply_transposed(&weighted);
            let found = laplacian.multiply(&x);
            let scale = largest(&expected);
            for (x, y) in found.iter().zip(&expected) {
                assert!((x - y).abs() <= 1e-12 * scale, "{name}: {x} {y}");
            }
            let constant = laplacian.multiply(&vec![1.0; x.len()]);
            assert!(largest(&constant) <= 1e-12 * scale, "{name}: constants are in the kernel");
            assert_eq!(laplacian.transposed(), laplacian, "{name}: symmetric, bit by bit");
        }
        let edge_rows = crouzeix_raviart_laplacian(surface).unwrap();
        assert!((0..edge_rows.columns()).all(|j| edge_rows.column(j).len() <= 5), "{name}");
    }
}

#[test]
fn masses_add_up_to_the_area() {
    for case in cases() {
        let (surface, name) = (&case.surface, case.name);
        let area = surface.area();
        let close = |x: f64| (x - area).abs() <= 1e-13 * area;
        assert!(close(surface.vertex_areas().iter().sum()), "{name}");
        assert!(close(surface.edge_areas().iter().sum()), "{name}");
        let consistent = mass_matrix(surface).unwrap();
        let rows = consistent.multiply(&vec![1.0; surface.mesh().vertices()]);
        assert!(close(rows.iter().sum()), "{name}");
        for (row, lumped) in rows.iter().zip(surface.vertex_areas()) {
            assert!((row - lumped).abs() <= 1e-13 * area, "{name}");
        }
    }
}

#[test]
fn angle_defects_add_up_to_the_euler_characteristic() {
    for case in cases().into_iter().chain(shared_cases()) {
        let expected = std::f64::consts::TAU * case.surface.mesh().euler_characteristic() as f64;
        let sum: f64 = case.surface.angle_defects().iter().sum();
        let bound = 1e-15 * 8.0 * case.surface.mesh().halfedges() as f64;
        assert!((sum - expected).abs() <= bound, "{}: {sum} {expected}", case.name);
    }
}
