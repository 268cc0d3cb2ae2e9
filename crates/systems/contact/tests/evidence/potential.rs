//! Potentials of scenes: differences, sums over pairs one by one, times of impact one by one.

use crate::distances::Numbers;
use glam::DVec3;
use pompeiu_contact::ccd::time_of_impact;
use pompeiu_contact::shapes::sheet;
use pompeiu_contact::{
    Bodies, Check, ContactOptions, Curvature, Kind, Material, PairSet, Projection, Simulation,
};
use std::collections::BTreeSet;

/// Two noisy sheets, one close above the other.
fn sheets(pairs: PairSet, numbers: &mut Numbers) -> Simulation {
    let mut bodies = Bodies::new();
    for height in [0.0, 0.1] {
        let turned = [DVec3::new(1.0, height, 0.0), DVec3::new(-height, 1.0, 0.0)];
        let (mut x, faces) = sheet(DVec3::new(0.0, 0.0, height), turned, [4, 4]);
        for x in &mut x {
            *x += numbers.point() * 0.03;
        }
        let cloth = Material { young: 1e5, poisson: 0.3, density: 300.0 };
        bodies.add_shell(&x, &faces, cloth, 1e-3).unwrap();
    }
    let options =
        ContactOptions { distance: 0.12, pairs, check: Check::Never, ..ContactOptions::new(0.01, 1.0) };
    Simulation::new(bodies, options).unwrap()
}

#[test]
fn the_gradient_is_that_of_differences_and_the_hessian_the_sum_of_pairs() {
    for (pairs, projection) in [(PairSet::Plain, Projection::Normal), (PairSet::Exclusive, Projection::Exact)]
    {
        let mut numbers = Numbers(7);
        let mut simulation = sheets(pairs, &mut numbers);
        let pairs = simulation.contact_pairs();
        assert!(pairs.len() > 20, "{}", pairs.len());
        let gradient = simulation.potential_gradient(&pairs);
        let n = gradient.len();
        let hessian = simulation.potential_hessian(&pairs, projection).unwrap();
        let v: Vec<DVec3> = (0..n).map(|_| numbers.point()).collect();
        let flat: Vec<f64> = v.iter().flat_map(DVec3::to_array).collect();
        // vᵀ H v by the lower triangle: what is below the diagonal counts twice.
        let mut found = 0.0;
        for column in 0..3 * n {
            for (row, value) in hessian.column(column) {
                let times = if row == column { 1.0 } else { 2.0 };
                found += times * value * flat[row] * flat[column];
            }
        }
        let mut expected = 0.0;
        for pair in &pairs {
            let (_, curvature) = pair.derivatives(simulation.positions(), 0.12, projection);
            let by = |i: usize| {
                if i / 3 < pair.kind.count() { v[pair.vertices[i / 3] as usize][i % 3] } else { 0.0 }
            };
            expected += match curvature {
                Curvature::Rank1(factor, vector) => {
                    factor * (0..12).map(|i| vector[i] * by(i)).sum::<f64>().powi(2)
                }
                Curvature::Full(entries) => {
                    (0..144).map(|k| entries[k / 12][k % 12] * by(k / 12) * by(k % 12)).sum()
                }
            };
        }
        assert!(found > 0.0 && (found / expected - 1.0).abs() < 1e-12, "{found} {expected}");

        let slope: f64 = gradient.iter().zip(&v).map(|(g, v)| g.dot(*v)).sum();
        let start = simulation.state();
        let mut moved = |by: f64| {
            let mut state = start.clone();
            for (x, v) in state.positions.iter_mut().zip(&v) {
                *x = (DVec3::from_array(*x) + *v * by).to_array();
            }
            simulation.set_state(&state).unwrap();
            simulation.potential(&pairs)
        };
        let difference = (moved(1e-6) - moved(-1e-6)) / 2e-6;
        assert!((difference / slope - 1.0).abs() < 1e-6, "{difference} {slope}");
    }
}

#[test]
fn the_free_part_is_that_of_the_first_pair_at_any_number_of_threads() {
    let mut numbers = Numbers(8);
    let simulation = sheets(PairSet::Plain, &mut numbers);
    let x = simulation.positions();
    let p: Vec<DVec3> = x.iter().map(|_| numbers.point() * 0.2).collect();
    let faces = simulation.faces();
    let edges: BTreeSet<[u32; 2]> = faces
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    let edges: Vec<[u32; 2]> = edges.into_iter().collect();
    let mut first = f64::INFINITY;
    let mut look = |kind, vertices: [u32; 4]| {
        let of = |values: &[DVec3]| vertices.map(|v| values[v as usize]);
        first = first.min(time_of_impact(kind, &of(x), &of(&p)).unwrap_or(f64::INFINITY));
    };
    for face in faces {
        for v in (0..x.len() as u32).filter(|v| !face.contains(v)) {
            look(Kind::PointTriangle, [v, face[0], face[1], face[2]]);
        }
    }
    for (i, [a, b]) in edges.iter().enumerate() {
        for [c, d] in &edges[i + 1..] {
            if ![a, b].contains(&c) && ![a, b].contains(&d) {
                look(Kind::EdgeEdge, [*a, *b, *c, *d]);
            }
        }
    }
    assert!(first > 0.0 && first < 1.0, "{first}");
    for threads in [1, 2, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        for _ in 0..20 {
            assert_eq!(pool.install(|| simulation.free_part(&p)), 0.9 * first);
        }
    }
}
