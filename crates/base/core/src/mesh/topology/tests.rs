//! Summaries of shapes whose topology is known.

use super::*;
use crate::mesh::shapes::{
    Diagonal, Ends, cube, cylinder, disk, grid, icosphere, mobius_strip, point_lattice, tetrahedron, torus,
    uv_sphere,
};
use crate::mesh::{Affine, merge, shuffle, transform, unweld};
use std::f64::consts::PI;

fn summary(mesh: &TriMesh) -> MeshSummary {
    MeshSummary::of(mesh)
}

fn mesh(vertices: usize, faces: &[[u32; 3]]) -> TriMesh {
    // Points on a curve that no plane meets more than three times, so that no face is degenerate.
    let positions = (0..vertices).map(|i| i as f64).map(|t| [t, t * t, t * t * t]).collect();
    TriMesh::new(positions, faces.to_vec()).unwrap()
}

/// Flips some faces.
fn turned(mesh: &TriMesh, every: usize) -> TriMesh {
    let (positions, mut faces) = mesh.clone().into_parts();
    faces.iter_mut().step_by(every).for_each(|f| f.swap(0, 1));
    TriMesh::new(positions, faces).unwrap()
}

/// Checks components, Euler characteristic, boundary loops and genus, and that there are no defects.
#[track_caller]
fn assert_manifold(mesh: &TriMesh, expected: (usize, isize, usize, Option<usize>)) -> MeshSummary {
    let s = summary(mesh);
    let c = s.connectivity;
    assert_eq!((c.components, c.euler_characteristic, c.boundary_loops, c.genus), expected);
    let odd = [s.unreferenced_vertices, s.degenerate_faces, s.duplicate_faces];
    assert_eq!((odd, c.non_manifold_edges, c.non_manifold_vertices), ([0; 3], 0, 0));
    s
}

#[test]
fn closed_surfaces() {
    for (shape, characteristic, genus) in [
        (icosphere(1.0, 3).unwrap(), 2, 0),
        (uv_sphere(1.0, 9, 6).unwrap(), 2, 0),
        (cube(1.0, 3).unwrap(), 2, 0),
        (tetrahedron(1.0).unwrap(), 2, 0),
        (torus(2.0, 1.0, 7, 5).unwrap(), 0, 1),
    ] {
        let s = assert_manifold(&shape, (1, characteristic, 0, Some(genus)));
        assert_eq!((s.connectivity.boundary_edges, s.connectivity.inconsistent_edges), (0, 0));
        assert!(s.connectivity.orientable && s.volume.unwrap() > 0.0);
    }
}

#[test]
fn measures_follow_closed_forms_at_any_scale() {
    for scale in [1e-100, 1.0, 1e100] {
        let s = summary(&cube(2.0 * scale, 4).unwrap());
        assert!((s.area / (24.0 * scale * scale) - 1.0).abs() < 1e-14);
        assert!((s.volume.unwrap() / (8.0 * scale * scale * scale) - 1.0).abs() < 1e-14);
        assert_eq!(s.bounding_box, Aabb { lower: [-scale; 3], upper: [scale; 3] });
    }
    // Far from the origin, coordinates lose digits, and measures lose no more than these.
    let far = transform(&cube(2.0, 4).unwrap(), &Affine::translate([1e9, -1e9, 1e9])).unwrap();
    assert!((summary(&far).volume.unwrap() - 8.0).abs() < 1e-6);
    let inside_out = turned(&cube(2.0, 1).unwrap(), 1);
    assert!((summary(&inside_out).volume.unwrap() + 8.0).abs() < 1e-14);
    assert_eq!(summary(&cube(1e200, 1).unwrap()).volume, Some(f64::INFINITY));
    let sphere = summary(&icosphere(1.0, 5).unwrap());
    assert!(
        (sphere.area / (4.0 * PI) - 1.0).abs() < 1e-3
            && (sphere.volume.unwrap() * 0.75 / PI - 1.0).abs() < 2e-3
    );
}

#[test]
fn surfaces_with_boundary() {
    let s = assert_manifold(&disk(1.0, 8, 3).unwrap(), (1, 1, 1, Some(0)));
    assert_eq!((s.connectivity.boundary_edges, s.volume), (8, None));
    assert_manifold(&grid([1.0, 1.0], [3, 2], Diagonal::Rising).unwrap(), (1, 1, 1, Some(0)));
    assert_manifold(&cylinder(1.0, 1.0, 8, 3, Ends::Open).unwrap(), (1, 0, 2, Some(0)));
    // A torus without one face: a handle and a boundary.
    let (positions, mut faces) = torus(2.0, 1.0, 7, 5).unwrap().into_parts();
    faces.remove(3);
    assert_manifold(&TriMesh::new(positions, faces).unwrap(), (1, -1, 1, Some(1)));
}

#[test]
fn several_components_add_up() {
    let (a, b) = (torus(2.0, 1.0, 7, 5).unwrap(), torus(3.0, 1.0, 6, 4).unwrap());
    let c = cylinder(1.0, 1.0, 8, 3, Ends::Open).unwrap();
    assert_manifold(&merge(&[&a, &b, &c]).unwrap(), (3, 0, 2, Some(2)));
    let soup = assert_manifold(&unweld(&a).unwrap(), (70, 70, 70, Some(0)));
    assert_eq!(soup.volume, None);
    // All edges of the soup are seams; the torus has none, nor does a true boundary.
    assert_eq!((soup.seam_edges, soup.connectivity.boundary_edges), (210, 210));
    assert_eq!([summary(&a).seam_edges, summary(&disk(1.0, 8, 3).unwrap()).seam_edges], [0, 0]);
}

#[test]
fn orientation_is_told_from_orientability() {
    let s = assert_manifold(&mobius_strip(2.0, 1.0, 9, 2).unwrap(), (1, 0, 1, None));
    assert!(!s.connectivity.orientable);
    assert_eq!(s.connectivity.inconsistent_edges, 2);
    let sphere = turned(&icosphere(1.0, 2).unwrap(), 5);
    let s = assert_manifold(&sphere, (1, 2, 0, Some(0)));
    assert!(s.connectivity.orientable && s.connectivity.inconsistent_edges > 50);
    assert_eq!(s.volume, None);
    // A Klein bottle: a torus glued with a reflection.
    let (n, m) = (6, 5);
    let vertex = |i: u32, j: u32| if i < n { i * m + j % m } else { (2 * m - j) % m };
    let cells = (0..n).flat_map(|i| (0..m).map(move |j| (i, j)));
    let faces: Vec<_> = cells
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let s = assert_manifold(&mesh(30, &faces), (1, 0, 0, None));
    assert!(!s.connectivity.orientable && s.volume.is_none());
}

#[test]
fn order_does_not_matter() {
    let shape = turned(&mobius_strip(2.0, 1.0, 9, 2).unwrap(), 4);
    for seed in 0..3 {
        assert_eq!(summary(&shuffle(&shape, seed)).connectivity, summary(&shape).connectivity);
    }
}

#[test]
fn touching_and_crossing_surfaces_are_not_manifold() {
    // A bow-tie: two faces with one vertex in common.
    let s = summary(&mesh(5, &[[0, 1, 2], [2, 3, 4]]));
    let c = s.connectivity;
    assert_eq!((c.non_manifold_edges, c.non_manifold_vertices, c.components), (0, 1, 1));
    assert_eq!((c.boundary_loops, c.euler_characteristic, c.genus), (2, 1, None));
    // Three sheets on one edge.
    let s = summary(&mesh(5, &[[0, 1, 2], [0, 1, 3], [1, 0, 4]]));
    let c = s.connectivity;
    assert_eq!((c.non_manifold_edges, c.non_manifold_vertices, c.genus), (1, 2, None));
    assert_eq!((c.boundary_edges, c.boundary_loops, c.inconsistent_edges), (6, 3, 0));
    // Two tetrahedra with an edge in common still enclose a volume.
    let solid = |a, b, c, d| [[a, b, c], [a, c, d], [a, d, b], [b, d, c]];
    let faces = [solid(0, 1, 2, 3), solid(0, 1, 4, 5)].concat();
    let s = summary(&mesh(6, &faces));
    assert_eq!(s.connectivity.non_manifold_edges, 1);
    assert!(s.volume.is_some() && s.connectivity.genus.is_none());
}

#[test]
fn doubled_degenerate_and_unreferenced_elements_are_counted() {
    let s = summary(&mesh(4, &[[0, 1, 2], [1, 2, 0], [2, 1, 0], [1, 2, 3]]));
    assert_eq!((s.duplicate_faces, s.connectivity.non_manifold_edges), (2, 3));
    assert_eq!(summary(&mesh(4, &[[0, 1, 2], [0, 1, 3], [2, 0, 1], [3, 1, 0]])).duplicate_faces, 2);
    // The same face twice, once turned: a closed surface without volume.
    let pillow = summary(&mesh(5, &[[0, 2, 4], [2, 0, 4]]));
    assert_eq!((pillow.duplicate_faces, pillow.unreferenced_vertices), (1, 2));
    assert_eq!((pillow.volume, pillow.connectivity.genus), (Some(0.0), Some(0)));
    let s = summary(&mesh(5, &[[0, 1, 2], [3, 3, 4], [4, 4, 4]]));
    assert_eq!((s.degenerate_faces, s.duplicate_faces, s.connectivity.components), (2, 0, 2));
    assert_eq!((s.connectivity.edges, s.connectivity.genus), (3, Some(0)));
    let points = summary(&point_lattice(1.0, 3).unwrap());
    assert_eq!((points.degenerate_faces, points.connectivity.components, points.area), (16, 16, 0.0));
    assert_eq!((points.volume, points.connectivity.genus), (None, None));
}

#[test]
fn threads_do_not_matter() {
    let shape = icosphere(1.0, 6).unwrap();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| summary(&shape))
    };
    assert_eq!(with(1), with(5));
}
