//! The cotangent Laplacian against closed forms.

use crate::common::{shared, surface};
use pompeiu_core::mesh::{displace_at_random, shapes};
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_operators::{HeatMethod, HeatOptions, cotan_laplacian, mass_matrix};
use pompeiu_solve::{LinearSolver, SemidefiniteCholesky};
use pompeiu_surface::{Surface, intrinsic_delaunay};

#[test]
fn the_energy_of_positions_is_twice_the_area() {
    let mut meshes = vec![
        shapes::icosphere(1.0, 3).unwrap(),
        shapes::torus(2.0, 0.7, 24, 16).unwrap(),
        shapes::disk(1.0, 20, 6).unwrap(),
        shapes::perforated_plate(1.0, 2).unwrap(),
    ];
    meshes.extend(["bunny", "3holes", "fertility"].into_iter().filter_map(shared));
    for mesh in meshes {
        let surface = surface(&mesh);
        let laplacian = cotan_laplacian(&surface).unwrap();
        let energy: f64 = (0..3)
            .map(|axis| {
                let x: Vec<f64> = mesh.positions().iter().map(|p| p[axis]).collect();
                x.iter().zip(laplacian.multiply(&x)).map(|(x, lx)| x * lx).sum::<f64>()
            })
            .sum();
        assert!((energy / (2.0 * surface.area()) - 1.0).abs() <= 1e-12, "{energy}");
    }
}

/// The solution of `−Δ u = f` with mean zero, `f` given at vertices.
fn poisson(surface: &Surface, f: &[f64]) -> Vec<f64> {
    let n = surface.mesh().vertices();
    let solver =
        SemidefiniteCholesky::new(cotan_laplacian(surface).unwrap(), &vec![false; n], &vec![Some(0); n])
            .unwrap();
    solver.solve(&mass_matrix(surface).unwrap().multiply(f)).unwrap()
}

/// Root mean square of the difference, after subtracting the means.
fn error(surface: &Surface, u: &[f64], exact: &[f64]) -> f64 {
    let areas = surface.vertex_areas();
    let total: f64 = areas.iter().sum();
    let difference: Vec<f64> = u.iter().zip(exact).map(|(u, w)| u - w).collect();
    let mean = difference.iter().zip(&areas).map(|(d, a)| d * a).sum::<f64>() / total;
    let square: f64 = difference.iter().zip(&areas).map(|(d, a)| (d - mean) * (d - mean) * a).sum();
    (square / total).sqrt()
}

#[test]
fn delaunay_edges_give_a_maximum_principle() {
    let rough = displace_at_random(&shapes::icosphere(1.0, 3).unwrap(), 0.1, 2).unwrap();
    let needles = displace_at_random(&shapes::torus(2.0, 0.7, 24, 16).unwrap(), 0.2, 1).unwrap();
    for mesh in [rough, needles] {
        let before = surface(&mesh);
        let after = intrinsic_delaunay(&before).unwrap().surface;
        let largest = |surface: &Surface| {
            let laplacian = cotan_laplacian(surface).unwrap();
            let others = laplacian.iter().filter(|(i, j, _)| i != j).map(|entry| entry.2);
            others.fold(f64::NEG_INFINITY, |m, x| if x > m { x } else { m })
        };
        let (old, new) = (largest(&before), largest(&after));
        assert!(old > 1e-3 && new <= 1e-9, "{old} {new}");
        // Edges from a vertex to itself and multiple edges are handled.
        let heat =
            HeatMethod::new(&after, &HeatOptions::default()).unwrap().distances(&[VertexId(0)]).unwrap();
        assert!(heat.iter().all(|d| d.is_finite()));
    }
}

fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

#[test]
fn second_order_on_the_sphere() {
    // Harmonic polynomials of degree l are eigenfunctions with l (l + 1).
    for degree in 1..3 {
        let polynomial = |p: [f64; 3]| if degree == 1 { p[2] } else { p[0] * p[1] + p[2] * p[0] };
        let eigenvalue = f64::from(degree * (degree + 1));
        let errors: Vec<f64> = (2..6)
            .map(|subdivisions| {
                let mesh = shapes::icosphere(1.0, subdivisions).unwrap();
                let surface = surface(&mesh);
                let exact: Vec<f64> = mesh.positions().iter().map(|&p| polynomial(p)).collect();
                let f: Vec<f64> = exact.iter().map(|u| eigenvalue * u).collect();
                error(&surface, &poisson(&surface, &f), &exact)
            })
            .collect();
        assert!(orders(&errors).iter().all(|order| (order - 2.0).abs() < 0.15), "{errors:?}");
        assert!(errors[3] < 1e-3, "{errors:?}");
    }
}

#[test]
fn second_order_on_the_torus() {
    // With v around the tube: u = sin v has Δu = (1/(r² (R + r cos v))) d/dv ((R + r cos v) cos v).
    let (big, small) = (2.0, 0.7);
    let errors: Vec<f64> = [16_u32, 32, 64, 128]
        .into_iter()
        .map(|n| {
            let mesh: TriMesh = shapes::torus(big, small, 3 * n, n).unwrap();
            let surface = surface(&mesh);
            let angle = |p: [f64; 3]| f64::atan2(p[2], p[0].hypot(p[1]) - big);
            let exact: Vec<f64> = mesh.positions().iter().map(|&p| angle(p).sin()).collect();
            let f: Vec<f64> = mesh
                .positions()
                .iter()
                .map(|&p| {
                    let (sin, cos) = angle(p).sin_cos();
                    let radius = big + small * cos;
                    (radius * sin + small * sin * cos) / (small * small * radius)
                })
                .collect();
            error(&surface, &poisson(&surface, &f), &exact)
        })
        .collect();
    assert!(orders(&errors).iter().all(|order| (order - 2.0).abs() < 0.15), "{errors:?}");
}
