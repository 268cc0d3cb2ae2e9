//! Surfaces between two loops: the discs over them, and loops too far apart for any minimal surface.

use pompeiu_core::TriMesh;
use pompeiu_flow::{Flow, FlowOptions, Until, mean_curvature_flow};
use std::f64::consts::TAU;

/// What is said of a tube between two loops of as many points, with one more loop between them, before it moves.
fn between(first: &[[f64; 3]], last: &[[f64; 3]]) -> Flow {
    let n = first.len() as u32;
    let middle = first.iter().zip(last).map(|(p, q)| [0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
    let positions = first.iter().copied().chain(middle).chain(last.iter().copied()).collect();
    let mut faces = Vec::new();
    for (row, i) in [0, n].into_iter().flat_map(|row| (0..n).map(move |i| (row, i))) {
        let j = (i + 1) % n;
        let [a, b, c, d] = [row + i, row + j, row + n + j, row + n + i];
        faces.extend([[a, b, c], [a, c, d]]);
    }
    let mesh = TriMesh::new(positions, faces).unwrap();
    mean_curvature_flow(&mesh, &FlowOptions::new(Until::Steps(0))).unwrap()
}

#[test]
fn discs_over_plane_loops_have_the_area_of_their_polygons() {
    // An L of area 3.
    let l = |z: f64| {
        [(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)].map(|(x, y)| [x, y, z]).to_vec()
    };
    let discs = between(&l(0.0), &l(7.0)).discs.unwrap();
    assert!((discs.area - 6.0).abs() < 1e-14 && discs.plane && discs.less, "{discs:?}");
    let near = between(&l(0.0), &l(0.5)).discs.unwrap();
    assert!((near.area - 6.0).abs() < 1e-14 && !near.less, "{near:?}");
    // A square, and a saddle over it: the cone over the saddle has the area √2.
    let square = [[0., 0., -5.], [1., 0., -5.], [1., 1., -5.], [0., 1., -5.]];
    let saddle = [[0., 0., 1.], [1., 0., 0.], [1., 1., 1.], [0., 1., 0.]];
    let discs = between(&square, &saddle).discs.unwrap();
    assert!((discs.area - 1.0 - 2.0_f64.sqrt()).abs() < 1e-14 && !discs.plane, "{discs:?}");
}

fn circle(radius: f64, z: f64, turned: f64) -> Vec<[f64; 3]> {
    let at = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / 96.0).sin_cos();
        [radius * cos, radius * sin * turned.cos(), z + radius * sin * turned.sin()]
    };
    (0..96).map(at).collect()
}

#[test]
fn two_circles_are_separated_beyond_the_last_catenoid() {
    // The cone of catenoids through its apex has the slope sinh τ where τ tanh τ = 1, by Newton's method.
    let mut tau = 1.2_f64;
    for _ in 0..8 {
        tau -= (tau * tau.tanh() - 1.0) / (tau.tanh() + tau / tau.cosh().powi(2));
    }
    let last = 1.0 / tau.sinh();
    // The greatest half height of a catenoid between circles of radius 1.
    assert!((last - 0.66274).abs() < 5e-6, "{last}");
    for (h, separated) in [(0.5, false), (last * 0.999_999, false), (last * 1.000_001, true), (0.8, true)] {
        let flow = between(&circle(1.0, -h, 0.0), &circle(1.0, h, 0.0));
        assert_eq!(flow.cone.is_some(), separated, "{h}");
    }
    // Circles of different radii, one turned.
    let flow = between(&circle(0.3, 0.0, 0.2), &circle(1.0, 1.5, 0.0));
    assert!(flow.cone.is_some());
}
