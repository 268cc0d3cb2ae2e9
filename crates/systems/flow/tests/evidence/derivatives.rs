//! Newton's steps against derivatives of the area by differences.

use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::{Diagonal, grid};
use pompeiu_flow::{FlowOptions, Scheme, Until, mean_curvature_flow};

/// A saddle with rough faces, and the vertices inside.
fn saddle() -> (TriMesh, Vec<usize>) {
    let flat = grid([2.0, 1.5], [4, 3], Diagonal::Rising).unwrap();
    let is_inside = |p: &[f64; 3]| p[0].abs() < 0.99 && p[1].abs() < 0.74;
    let inside = (0..flat.positions().len()).filter(|v| is_inside(&flat.positions()[*v])).collect();
    let lifted = flat.positions().iter().map(|&[x, y, _]| [x, y, 0.5 * x * x - 0.7 * y * y + 0.2 * x * y]);
    let mesh = TriMesh::new(lifted.collect(), flat.faces().to_vec()).unwrap();
    (displace_at_random(&mesh, 0.15, 5).unwrap(), inside)
}

fn points(mesh: &TriMesh) -> Vec<DVec3> {
    mesh.positions().iter().map(|p| DVec3::from_array(*p)).collect()
}

fn area(faces: &[[u32; 3]], points: &[DVec3]) -> f64 {
    let corners = faces.iter().map(|face| face.map(|v| points[v as usize]));
    corners.map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum()
}

/// The gradient of the area by central differences.
fn gradient(faces: &[[u32; 3]], points: &[DVec3], inside: &[usize]) -> Vec<f64> {
    let h = 1e-5;
    let mut moved = points.to_vec();
    let coordinates = inside.iter().flat_map(|v| [0, 1, 2].map(|k| (*v, k)));
    let mut slope = |(v, k): (usize, usize)| {
        let mut at = |x: f64| {
            moved[v][k] = x;
            area(faces, &moved)
        };
        let x = points[v][k];
        let slope = (at(x + h) - at(x - h)) / (2.0 * h);
        moved[v][k] = x;
        slope
    };
    coordinates.map(&mut slope).collect()
}

/// Where the vertices inside go in one whole step of a scheme.
fn step(mesh: &TriMesh, scheme: Scheme) -> Vec<DVec3> {
    let options =
        FlowOptions { scheme: Some(scheme), keep_angles: false, ..FlowOptions::new(Until::Steps(1)) };
    let flow = mean_curvature_flow(mesh, &options).unwrap();
    assert_eq!(flow.history[1].scheme, scheme, "{:?}", flow.history[1]);
    points(&flow.mesh).iter().zip(points(mesh)).map(|(to, from)| *to - from).collect()
}

/// Near a local minimum of the area.
fn nearly_minimal() -> (TriMesh, Vec<usize>) {
    let (mesh, inside) = saddle();
    let options = FlowOptions {
        scheme: Some(Scheme::Newton),
        keep_angles: false,
        ..FlowOptions::new(Until::Steps(60))
    };
    let minimal = mean_curvature_flow(&mesh, &options).unwrap().mesh;
    let mut positions = minimal.positions().to_vec();
    for (i, v) in inside.iter().enumerate() {
        for k in 0..3 {
            positions[*v][k] += 2e-3 * ((i * 7 + k * 3) % 5) as f64 - 4e-3;
        }
    }
    (TriMesh::new(positions, minimal.faces().to_vec()).unwrap(), inside)
}

/// The derivative of the gradient along a step, which Newton's method makes minus the gradient.
fn along(mesh: &TriMesh, inside: &[usize], step: &[DVec3]) -> Vec<f64> {
    let longest = step.iter().map(|s| s.length()).fold(0.0, f64::max);
    let by = 1e-4 / longest;
    let [ahead, behind] = [by, -by].map(|by| {
        let moved: Vec<DVec3> = points(mesh).iter().zip(step).map(|(p, s)| *p + by * *s).collect();
        gradient(mesh.faces(), &moved, inside)
    });
    ahead.iter().zip(behind).map(|(a, b)| (a - b) / (2.0 * by)).collect()
}

#[test]
fn whole_newton_steps_solve_the_system_of_second_derivatives() {
    let (mesh, inside) = nearly_minimal();
    let step = step(&mesh, Scheme::NewtonOrGradient);
    let gradient = gradient(mesh.faces(), &points(&mesh), &inside);
    let largest = gradient.iter().fold(0.0_f64, |m, g| m.max(g.abs()));
    assert!(largest > 1e-3, "{largest}");
    for (change, g) in along(&mesh, &inside, &step).iter().zip(&gradient) {
        assert!((change + g).abs() < 1e-5 * largest, "{change} {g}");
    }
}

#[test]
fn steps_along_normals_solve_the_system_along_normals() {
    let (mesh, inside) = nearly_minimal();
    let step = step(&mesh, Scheme::NormalNewton);
    let gradient = gradient(mesh.faces(), &points(&mesh), &inside);
    let along = along(&mesh, &inside, &step);
    for (i, v) in inside.iter().enumerate() {
        let normal = step[*v].normalize().to_array();
        let dot = |of: &[f64]| (0..3).map(|k| of[3 * i + k] * normal[k]).sum::<f64>();
        assert!((dot(&along) + dot(&gradient)).abs() < 1e-8, "{} {}", dot(&along), dot(&gradient));
        assert!(dot(&gradient).abs() > 1e-5);
    }
}

type Matrix = [[f64; 9]; 9];

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..9).map(|k| a[i][k] * b[k][j]).sum()))
}

/// The positive part of a symmetric matrix, `½ S (1 + sign S)`, with the sign by Newton and Schulz's iteration.
fn positive_part(s: &Matrix) -> Matrix {
    let size = s.iter().flatten().map(|x| x * x).sum::<f64>().sqrt();
    let mut sign = s.map(|row| row.map(|x| x / size));
    for _ in 0..40 {
        let cube = product(&product(&sign, &sign), &sign);
        sign = std::array::from_fn(|i| std::array::from_fn(|j| 1.5 * sign[i][j] - 0.5 * cube[i][j]));
    }
    let absolute = product(s, &sign);
    std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (s[i][j] + absolute[i][j])))
}

#[test]
fn newton_without_negative_parts_solves_the_system_of_the_positive_part_of_each_face() {
    let (mesh, inside) = saddle();
    let step = step(&mesh, Scheme::Newton);
    let start = points(&mesh);
    let expected = gradient(mesh.faces(), &start, &inside);
    let mut found = vec![0.0; expected.len()];
    for face in mesh.faces() {
        let corners = face.map(|v| start[v as usize]);
        let h = 1e-4;
        let hessian: Matrix = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let at = |a: f64, b: f64| {
                    let mut moved = corners;
                    moved[i / 3][i % 3] += a * h;
                    moved[j / 3][j % 3] += b * h;
                    area(&[[0, 1, 2]], &moved)
                };
                (at(1.0, 1.0) - at(1.0, -1.0) - at(-1.0, 1.0) + at(-1.0, -1.0)) / (4.0 * h * h)
            })
        });
        let positive = positive_part(&hessian);
        for i in 0..9 {
            let Some(row) = inside.iter().position(|v| *v == face[i / 3] as usize) else { continue };
            found[3 * row + i % 3] +=
                (0..9).map(|j| positive[i][j] * step[face[j / 3] as usize][j % 3]).sum::<f64>();
        }
    }
    let largest = expected.iter().fold(0.0_f64, |m, g| m.max(g.abs()));
    for (f, g) in found.iter().zip(&expected) {
        assert!((f + g).abs() < 1e-5 * largest, "{f} {g}");
    }
}
