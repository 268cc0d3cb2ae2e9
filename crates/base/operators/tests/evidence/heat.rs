//! Distances against great circles and straight lines.

use crate::common::surface;
use pompeiu_core::mesh::shapes::Diagonal;
use pompeiu_core::mesh::{displace_at_random, merge, shapes};
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_operators::hodge::{conforming_system, crouzeix_raviart_system};
use pompeiu_operators::{HeatMethod, HeatOptions, OperatorError};
use pompeiu_surface::EdgeDistances;

fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), x| (sum + x * x, count + 1.0));
    (sum / count).sqrt()
}

#[test]
fn great_circles_on_the_sphere() {
    let errors: Vec<f64> = (2..6)
        .map(|subdivisions| {
            let mesh = shapes::icosphere(1.0, subdivisions).unwrap();
            let surface = surface(&mesh);
            let distances = HeatMethod::new(&surface, &HeatOptions::default())
                .unwrap()
                .distances(&[VertexId(0)])
                .unwrap();
            let pole = mesh.positions()[0];
            let exact =
                |p: &[f64; 3]| (p[0] * pole[0] + p[1] * pole[1] + p[2] * pole[2]).clamp(-1.0, 1.0).acos();
            assert_eq!(distances[VertexId(0)], 0.0);
            root_mean_square(mesh.positions().iter().zip(&distances).map(|(p, d)| d - exact(p)))
        })
        .collect();
    assert!(errors.windows(2).all(|pair| pair[1] < 0.75 * pair[0]) && errors[3] < 0.02, "{errors:?}");
}

#[test]
fn the_nearest_of_several_sources_on_each_component() {
    let errors = [20_u32, 40, 80].map(|rings| {
        let disk = shapes::disk(1.0, 3 * rings, rings).unwrap();
        let sphere = shapes::icosphere(1.0, 1).unwrap();
        let both = surface(&merge(&[&disk, &sphere]).unwrap());
        let heat = HeatMethod::new(&both, &HeatOptions::default()).unwrap();
        let n = disk.positions().len();
        let rim = 1 + 3 * rings * (rings - 1);
        let sources = [VertexId(0), VertexId(rim)];
        let distances = heat.distances(&sources).unwrap();
        let edges = EdgeDistances::from(&both, &sources).distances;
        let rim = disk.positions()[rim as usize];
        let exact = |p: &[f64; 3]| p[0].hypot(p[1]).min((p[0] - rim[0]).hypot(p[1] - rim[1]));
        assert!(distances.iter().skip(n).all(|d| *d == f64::INFINITY));
        // Along edges no path is shorter than the straight one.
        for (p, along) in disk.positions().iter().zip(&edges) {
            assert!(*along >= exact(p) - 1e-14 && *along <= 1.6 * exact(p) + 1e-14);
        }
        assert_eq!(edges[VertexId(n as u32)], f64::INFINITY);
        root_mean_square(disk.positions().iter().zip(&distances).map(|(p, d)| d - exact(p)))
    });
    assert!(errors.windows(2).all(|pair| pair[1] < 0.7 * pair[0]) && errors[2] < 0.02, "{errors:?}");
}

/// Exact distances along the faces from vertex 0 of an icosphere of 1,280 faces with half axes 2, 1 and 0.5, by pygeodesic 0.1.11.
const ELLIPSOID: &str = include_str!("ellipsoid_geodesics.txt");

#[test]
fn exact_geodesics_of_an_ellipsoid() {
    let sphere = shapes::icosphere(1.0, 3).unwrap();
    let stretched = sphere.positions().iter().map(|&[x, y, z]| [2.0 * x, y, 0.5 * z]).collect();
    let mesh = TriMesh::new(stretched, sphere.faces().to_vec()).unwrap();
    let surface = surface(&mesh);
    let exact: Vec<f64> = ELLIPSOID.lines().map(|line| line.parse().unwrap()).collect();
    assert_eq!(exact.len(), mesh.positions().len());
    let greatest = exact.iter().copied().fold(0.0, f64::max);
    let along_edges = EdgeDistances::from(&surface, &[VertexId(0)]).distances;
    assert!(along_edges.iter().zip(&exact).all(|(edges, exact)| *edges >= exact - 1e-6));
    let errors = [false, true].map(|intrinsic_delaunay| {
        let options = HeatOptions { intrinsic_delaunay, ..Default::default() };
        let distances = HeatMethod::new(&surface, &options).unwrap().distances(&[VertexId(0)]).unwrap();
        root_mean_square(distances.iter().zip(&exact).map(|(d, exact)| d - exact)) / greatest
    });
    assert!(errors[1] < 0.02 && errors[1] < 0.5 * errors[0], "{errors:?}");
}

#[test]
fn unusable_questions_are_named() {
    let sphere = surface(&shapes::icosphere(1.0, 1).unwrap());
    let heat = HeatMethod::new(&sphere, &HeatOptions::default()).unwrap();
    let error = heat.distances(&[VertexId(42)]).unwrap_err();
    assert_eq!(error.to_string(), "vertex 42 does not exist, there are 42 (the first is 0)");
    assert!(heat.distances(&[]).unwrap().iter().all(|d| *d == f64::INFINITY));
    for time in [-1.0, 0.0, f64::NAN, f64::INFINITY] {
        let options = HeatOptions { time: Some(time), ..Default::default() };
        let error = HeatMethod::new(&sphere, &options).unwrap_err();
        assert!(matches!(error, OperatorError::HeatTime { .. }), "{error}");
    }
    // With such a short time, heat underflows after a few edges.
    let options = HeatOptions { time: Some(1e-310), ..Default::default() };
    let error = HeatMethod::new(&sphere, &options).unwrap().distances(&[VertexId(3)]).unwrap_err();
    assert!(matches!(error, OperatorError::HeatUnderflow { .. }), "{error}");
}

#[test]
fn heat_below_the_range_of_doubles_is_continued() {
    let strip = |length: u32| shapes::grid([f64::from(length), 1.0], [length, 1], Diagonal::Rising).unwrap();
    for (length, from_end) in [(1500, true), (1500, false), (2100, true)] {
        let mesh = merge(&[&strip(length), &shapes::icosphere(1.0, 1).unwrap()]).unwrap();
        let surface = surface(&mesh);
        let start = if from_end { -0.5 * f64::from(length) } else { 0.0 };
        let strip_vertices = 2 * (length as usize + 1);
        let places = mesh.positions().iter().take(strip_vertices);
        let sources: Vec<VertexId> =
            places.enumerate().filter(|(_, p)| p[0] == start).map(|(v, _)| VertexId(v as u32)).collect();
        assert_eq!(sources.len(), 2);
        let distances =
            HeatMethod::new(&surface, &HeatOptions::default()).unwrap().distances(&sources).unwrap();
        for (v, p) in mesh.positions().iter().enumerate().take(strip_vertices) {
            let (found, exact) = (distances[VertexId(v as u32)], (p[0] - start).abs());
            // Half an edge, from the sources on: the distance is zero on average there.
            assert!((found - exact).abs() <= 0.5, "{length}, {p:?}: {found}");
        }
        assert!(distances.iter().rev().take(42).all(|d| *d == f64::INFINITY));
    }
}

#[test]
fn distances_do_not_depend_on_where_heat_was_continued() {
    // A rough strip of unit edges. A hundred edges beyond the nearer source, the heat of both has the same shape across the strip.
    // It is continued every 670 edges or so from each, thus at different places.
    let strip = shapes::grid([2000.0, 4.0], [2000, 4], Diagonal::Rising).unwrap();
    let mesh = displace_at_random(&strip, 0.2, 7).unwrap();
    let surface = surface(&mesh);
    let heat = HeatMethod::new(&surface, &HeatOptions::default()).unwrap();
    let from = |x: f64| {
        let at = strip.positions().iter().position(|p| p[0] == x && p[1] == 0.0).unwrap();
        heat.distances(&[VertexId(at as u32)]).unwrap()
    };
    let (far, near) = (from(-1000.0), from(-700.0));
    let beyond: Vec<f64> = (strip.positions().iter().zip(far.iter().zip(&near)))
        .filter(|(p, _)| p[0] > -600.0)
        .map(|(_, (far, near))| far - near)
        .collect();
    assert!((beyond[0] - 300.0).abs() < 30.0, "{}", beyond[0]);
    for difference in &beyond {
        assert!((difference - beyond[0]).abs() < 1e-6, "{difference} {}", beyond[0]);
    }
}

#[test]
fn delaunay_triangulations_give_better_distances_on_obtuse_faces() {
    // A sheared grid: its long diagonals are no Delaunay edges.
    let grid = shapes::grid([4.0, 4.0], [40, 40], Diagonal::Rising).unwrap();
    let sheared = grid.positions().iter().map(|&[x, y, z]| [x + 1.5 * y, y, z]).collect();
    let mesh = TriMesh::new(sheared, grid.faces().to_vec()).unwrap();
    let surface = surface(&mesh);
    let centre = mesh.positions().iter().position(|p| p[0].hypot(p[1]) < 1e-9).unwrap();
    let errors = [false, true].map(|intrinsic_delaunay| {
        let options = HeatOptions { intrinsic_delaunay, ..Default::default() };
        let distances =
            HeatMethod::new(&surface, &options).unwrap().distances(&[VertexId(centre as u32)]).unwrap();
        let exact = |p: &[f64; 3]| p[0].hypot(p[1]);
        root_mean_square(mesh.positions().iter().zip(&distances).map(|(p, d)| d - exact(p)))
    });
    assert!(errors[1] < 0.5 * errors[0], "{errors:?}");
}

#[test]
fn thin_faces_are_named() {
    let torus = shapes::torus(2.0, 0.7, 48, 24).unwrap();
    let mut refused = 0;
    for height in [1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10] {
        let flat = torus.positions().iter().map(|&[x, y, z]| [x, height * y, height * z]).collect();
        let flat = surface(&TriMesh::new(flat, torus.faces().to_vec()).unwrap());
        let heat = HeatMethod::new(&flat, &HeatOptions::default()).err();
        let systems = [conforming_system(&flat, false).err(), crouzeix_raviart_system(&flat, false).err()];
        for error in systems.into_iter().chain([heat]).flatten() {
            refused += 1;
            let OperatorError::ThinFaces { face, height: found, count } = error else { panic!("{error}") };
            assert!(count > 0 && found < 10.0 * height && found == flat.relative_height(face), "{error}");
        }
    }
    assert!(refused > 0);
}
