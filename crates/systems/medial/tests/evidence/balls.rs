//! Medial balls: those of a capsule and of a sphere are known; the deviation is checked against points.

use super::{real_mesh, surface};
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes;
use pompeiu_medial::{Ball, Medial, MedialError, MedialOptions, medial_balls};
use std::num::NonZeroUsize;

fn options(balls: usize) -> MedialOptions {
    MedialOptions { balls: NonZeroUsize::new(balls).unwrap(), ..MedialOptions::default() }
}

/// A sphere of radius 1 cut in halves, which are four apart.
fn capsule() -> TriMesh {
    let (positions, faces) = shapes::icosphere(1.0, 5).unwrap().into_parts();
    // The sphere stretched: its points above the middle are moved up, those below down; the band between is long.
    let stretched = positions.into_iter().map(|[x, y, z]| [x, y, z + 2.0 * (20.0 * z).clamp(-1.0, 1.0)]);
    TriMesh::new(stretched.collect(), faces).unwrap()
}

fn distance(p: [f64; 3], q: [f64; 3]) -> f64 {
    (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn the_two_balls_of_a_capsule_are_found_within_one_percent() {
    let medial = medial_balls(&surface(&capsule()), &options(2)).unwrap();
    assert_eq!((medial.balls.len(), &medial.edges[..]), (2, &[[0, 1]][..]));
    let mut ends: Vec<f64> = medial.balls.iter().map(|ball| ball.centre[2]).collect();
    ends.sort_by(f64::total_cmp);
    assert!((ends[0] + 2.0).abs() < 0.04 && (ends[1] - 2.0).abs() < 0.04, "{ends:?}");
    for ball in &medial.balls {
        assert!((ball.radius - 1.0).abs() < 0.01, "{}", ball.radius);
        assert!(ball.centre[0].hypot(ball.centre[1]) < 0.01);
    }
    // Halfway between the balls the wall is farthest from them.
    let [lower, upper] = medial.deviation.surface_to_balls;
    let expected = 5_f64.sqrt() - 1.0;
    assert!((lower - expected).abs() < 0.05 && upper - lower < 0.01, "{lower} {upper}");
}

#[test]
fn one_ball_fills_a_sphere_in_any_unit() {
    for unit in [1e-50, 1.0, 1e50] {
        let sphere = shapes::icosphere(unit, 4).unwrap();
        let rough = MedialOptions { tolerance: 1e-2, ..options(1) };
        let medial = medial_balls(&surface(&sphere), &rough).unwrap();
        let [Ball { centre, radius }] = medial.balls[..] else { panic!("{} balls", medial.balls.len()) };
        assert!((radius / unit - 1.0).abs() < 0.01 && centre.iter().all(|x| (x / unit).abs() < 0.01));
        assert!(medial.deviation.surface_to_balls[1] < 0.05 * unit);
        assert!(medial.deviation.balls_to_surface < 0.02 * unit);
    }
}

/// The greatest distance of the corners and middles of faces from the balls.
fn seen(mesh: &TriMesh, medial: &Medial) -> f64 {
    let of_point = |p: [f64; 3]| {
        let depths = medial.balls.iter().map(|ball| distance(p, ball.centre) - ball.radius);
        depths.fold(f64::INFINITY, f64::min).max(0.0)
    };
    let faces = mesh.faces().iter().map(|face| {
        let corners = face.map(|v| mesh.positions()[v as usize]);
        let middle = [0, 1, 2].map(|k| (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0);
        corners.into_iter().chain([middle]).map(of_point).fold(0.0, f64::max)
    });
    faces.fold(0.0, f64::max)
}

#[test]
fn the_deviation_bounds_what_points_show() {
    let mut meshes = vec![shapes::torus(2.0, 0.7, 48, 24).unwrap(), shapes::cube(1.0, 6).unwrap()];
    meshes.extend(real_mesh("spot.obj"));
    for mesh in meshes {
        let surface = surface(&mesh);
        let medial = medial_balls(&surface, &options(20)).unwrap();
        assert!(!medial.balls.is_empty() && medial.balls.len() <= 20);
        let [lower, upper] = medial.deviation.surface_to_balls;
        let diagonal = pompeiu_core::geom::Aabb::of_faces(&mesh).diagonal();
        let seen = seen(&mesh, &medial);
        assert!(
            seen <= upper && lower <= upper && upper - lower <= 1.001e-3 * diagonal,
            "{lower} {seen} {upper}"
        );
        assert!(seen >= 0.5 * lower && lower < 0.25 * diagonal, "{lower} {seen}");
        assert!(medial.deviation.balls_to_surface < 0.1 * diagonal, "{}", medial.deviation.balls_to_surface);
        // The edges join all balls.
        let mut joined = pompeiu_core::mesh::UnionFind::new(medial.balls.len());
        let joins =
            medial.edges.iter().filter(|edge| joined.union(edge[0] as usize, edge[1] as usize)).count();
        assert_eq!(joins + 1, medial.balls.len());
    }
}

#[test]
fn turned_inside_out_nothing_changes_and_open_surfaces_are_named() {
    let (positions, faces) = shapes::icosphere(1.0, 3).unwrap().into_parts();
    let turned = faces.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let inside_out = TriMesh::new(positions.clone(), turned).unwrap();
    let medial = medial_balls(&surface(&inside_out), &options(1)).unwrap();
    assert!((medial.balls[0].radius - 1.0).abs() < 0.02);
    let open = TriMesh::new(positions, faces[1..].to_vec()).unwrap();
    let error = medial_balls(&surface(&open), &options(1)).unwrap_err();
    assert!(matches!(error, MedialError::Open { loops: 1, .. }), "{error}");
    let wrong = MedialOptions { tolerance: f64::NAN, ..options(1) };
    assert!(matches!(medial_balls(&surface(&inside_out), &wrong), Err(MedialError::Tolerance { .. })));
}

#[test]
fn balls_are_written_as_others_read_them() {
    let medial = medial_balls(&surface(&capsule()), &options(2)).unwrap();
    let text = medial.to_ma();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!((lines.len(), lines[0], lines[3]), (4, "2 1 0", "e 0 1"));
    let numbers: Vec<f64> = lines[1][2..].split(' ').map(|x| x.parse().unwrap()).collect();
    assert_eq!(numbers[..3], medial.balls[0].centre);
    assert_eq!(numbers[3], medial.balls[0].radius);
    let spheres = medial.spheres().unwrap();
    assert_eq!(spheres.faces().len(), 2 * 1280);
    let last = *spheres.positions().last().unwrap();
    assert!((distance(last, medial.balls[1].centre) / medial.balls[1].radius - 1.0).abs() < 1e-12);
}
