//! Geodesics with known ends.

use pompeiu_core::FaceId;
use pompeiu_core::mesh::shapes::{self, Diagonal};
use pompeiu_core::mesh::{Random, displace_at_random};
use pompeiu_surface::{EmbeddedSurface, Ray, Surface, Trace, TraceEnd, TraceOptions, Tracer, flat_torus};
use std::f64::consts::TAU;

/// A ray from inside a face.
fn ray(surface: &Surface, random: &mut Random, length: f64) -> Ray {
    let face = FaceId(random.below(surface.mesh().faces() as u32));
    let weights = [0; 3].map(|_| 0.1 + random.signed_unit().abs());
    let sum: f64 = weights.iter().sum();
    let angle = random.signed_unit() * TAU;
    let direction = [angle.cos(), angle.sin()];
    Ray { face, point: surface.point(face, weights.map(|w| w / sum)), direction, length }
}

fn close(a: [f64; 2], b: [f64; 2], bound: f64) -> bool {
    (a[0] - b[0]).abs() <= bound && (a[1] - b[1]).abs() <= bound
}

#[test]
fn forwards_and_back_again() {
    let torus = shapes::torus(2.0, 0.7, 24, 16).unwrap();
    for mesh in [
        shapes::icosphere(1.0, 3).unwrap(),
        displace_at_random(&torus, 0.05, 2).unwrap(),
        torus,
        shapes::perforated_plate(1.0, 2).unwrap(),
    ] {
        let embedded = EmbeddedSurface::new(&mesh).unwrap();
        let tracer = Tracer::new(embedded.surface(), &TraceOptions::default());
        let mut random = Random::new(8);
        for _ in 0..300 {
            let ray = ray(embedded.surface(), &mut random, 3.0);
            let there = tracer.trace(&ray);
            assert_eq!(there.end, TraceEnd::Length);
            assert!(there.crossings > 0 && there.length == 3.0);
            let back = tracer.trace(&there.reversed());
            assert_eq!(back.face, ray.face);
            assert!(close(back.point, ray.point, 1e-10), "{:?} {:?}", back.point, ray.point);
            assert!(close(back.direction, ray.direction.map(|x| -x), 1e-10));
        }
    }
}

/// Position and direction in the plane of a point on the flat torus of `cells` unit cells. Odd faces are rotated by half a turn,
/// with their first corner at the far corner of the cell.
fn in_plane(face: FaceId, point: [f64; 2], direction: [f64; 2], cells: u32) -> ([f64; 2], [f64; 2]) {
    let cell = face.0 / 2;
    let corner = [f64::from(cell % cells), f64::from(cell / cells)];
    if face.0.is_multiple_of(2) {
        ([corner[0] + point[0], corner[1] + point[1]], direction)
    } else {
        ([corner[0] + 1.0 - point[0], corner[1] + 1.0 - point[1]], direction.map(|x| -x))
    }
}

fn assert_straight(ray: &Ray, trace: &Trace, cells: [u32; 2]) {
    let size = ray.direction[0].hypot(ray.direction[1]);
    let (start, along) = in_plane(ray.face, ray.point, ray.direction.map(|x| x / size), cells[0]);
    let (end, direction) = in_plane(trace.face, trace.point, trace.direction, cells[0]);
    for axis in 0..2 {
        let period = f64::from(cells[axis]);
        let off = end[axis] - (start[axis] + ray.length * along[axis]);
        let off = off - period * (off / period).round();
        assert!(off.abs() <= 1e-12, "{ray:?} {trace:?}: {off:e}");
        assert!((direction[axis] - along[axis]).abs() <= 1e-12);
    }
}

#[test]
fn the_flat_torus_is_the_plane() {
    let torus = flat_torus([5.0, 4.0], [5, 4]).unwrap();
    let tracer = Tracer::new(&torus, &TraceOptions::default());
    let mut random = Random::new(1);
    for _ in 0..1000 {
        let ray = ray(&torus, &mut random, 40.0);
        assert_straight(&ray, &tracer.trace(&ray), [5, 4]);
    }
}

#[test]
fn through_vertices_and_along_edges() {
    let torus = flat_torus([5.0, 4.0], [5, 4]).unwrap();
    let tracer = Tracer::new(&torus, &TraceOptions::default());
    // Through corners of cells, along sides and along diagonals, starting at corners, on sides and inside.
    for point in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, 0.0], [0.75, 0.5], [0.5, 0.5]] {
        for direction in
            [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [2.0, 1.0]]
        {
            for length in [0.0, 0.25, 1.0, 7.5] {
                let ray = Ray { face: FaceId(0), point, direction, length };
                let trace = tracer.trace(&ray);
                assert_eq!(trace.end, TraceEnd::Length, "{ray:?}");
                assert_straight(&ray, &trace, [5, 4]);
            }
        }
    }
}

#[test]
fn at_a_corner_of_the_cube_both_sides_have_equal_angles() {
    // The bisector of the corner's angle in one face continues along the edge between the other two.
    let mesh = shapes::cube(2.0, 1).unwrap();
    let embedded = EmbeddedSurface::new(&mesh).unwrap();
    let (surface, connectivity) = (embedded.surface(), embedded.mesh());
    let tracer = Tracer::new(surface, &TraceOptions::default());
    let mut met = 0;
    for face in connectivity.face_ids() {
        for corner in 0..3 {
            // Faces whose right angle is here: the way from the middle of the diagonal to the corner.
            let corners = surface.corners(face);
            let (a, b, c) = (corners[corner], corners[(corner + 1) % 3], corners[(corner + 2) % 3]);
            let middle = [0, 1].map(|i| f64::midpoint(b[i], c[i]));
            let direction = [0, 1].map(|i| a[i] - middle[i]);
            if (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]) > 0.1 {
                continue;
            }
            let vertex = connectivity.face(face)[corner];
            met += 1;
            let ray = Ray { face, point: middle, direction, length: 2.0_f64.sqrt() + 1.0 };
            let trace = tracer.trace(&ray);
            let end = surface.barycentric(trace.face, trace.point);
            let ends = connectivity.face(trace.face).map(|v| mesh.positions()[v.index()]);
            let position = [0, 1, 2].map(|i| (0..3).map(|k| end[k] * ends[k][i]).sum::<f64>());
            let apex = mesh.positions()[vertex.index()];
            let inwards: Vec<f64> = (0..3).map(|i| (position[i] - apex[i]).abs()).collect();
            let along = inwards.iter().filter(|x| (**x - 1.0).abs() < 1e-12).count();
            let still = inwards.iter().filter(|x| **x < 1e-12).count();
            assert_eq!((along, still), (1, 2), "{position:?} from {apex:?}");
            let back = tracer.trace(&trace.reversed());
            assert!(close(back.point, middle, 1e-12) && back.face == face || back.length == ray.length);
        }
    }
    assert!(met > 0);
}

#[test]
fn rays_aimed_at_a_vertex_pass_through_it() {
    let embedded =
        EmbeddedSurface::new(&displace_at_random(&shapes::icosphere(1.0, 2).unwrap(), 0.02, 5).unwrap());
    let embedded = embedded.unwrap();
    let (surface, mesh) = (embedded.surface(), embedded.mesh());
    // Deviation from straight when a ray that came from a vertex is reversed and passes the vertex.
    let deviations = |tolerance: f64| {
        let options = TraceOptions { vertex_tolerance: tolerance, ..Default::default() };
        let tracer = Tracer::new(surface, &options);
        let mut random = Random::new(12);
        let mut deviations = Vec::new();
        for vertex in mesh.vertex_ids() {
            let total = surface.total_angle(vertex);
            // Angles around the vertex, counter-clockwise from its first half-edge.
            let angle_of = |face: FaceId, point: [f64; 2]| {
                let mut before = 0.0;
                for h in mesh.outgoing(vertex) {
                    if h.face() == face {
                        let (from, along) = (surface.corners(face)[h.corner()], surface.vector(h));
                        let to = [point[0] - from[0], point[1] - from[1]];
                        let cross = along[0] * to[1] - along[1] * to[0];
                        return before + cross.atan2(along[0] * to[0] + along[1] * to[1]);
                    }
                    before += surface.angle(h);
                }
                panic!("face {face} is not at vertex {vertex}");
            };
            for h in mesh.outgoing(vertex) {
                let (along, share) = (surface.vector(h), 0.5 + 0.4 * random.signed_unit());
                let (sin, cos) = (share * surface.angle(h)).sin_cos();
                let direction = [cos * along[0] - sin * along[1], sin * along[0] + cos * along[1]];
                let point = surface.corners(h.face())[h.corner()];
                let out = Ray { face: h.face(), point, direction, length: 2.0 };
                let back = Ray { length: 2.05, ..tracer.trace(&out).reversed() };
                let end = tracer.trace(&back);
                assert_eq!(end.end, TraceEnd::Length);
                let start = angle_of(h.face(), [point[0] + direction[0], point[1] + direction[1]]);
                let turned = (angle_of(end.face, end.point) - start).rem_euclid(total);
                deviations.push((turned - 0.5 * total).abs());
            }
        }
        deviations
    };
    let worst = deviations(TraceOptions::default().vertex_tolerance).into_iter().fold(0.0, f64::max);
    assert!(worst < 1e-9, "{worst:e}");
    // Without a tolerance most pass on one side or the other.
    let missed = deviations(0.0).into_iter().filter(|deviation| *deviation > 1e-3).count();
    assert!(missed > 100, "{missed}");
}

#[test]
fn great_circles_close_better_on_finer_spheres() {
    let median = |subdivisions: u32| {
        let mesh = shapes::icosphere(1.0, subdivisions).unwrap();
        let embedded = EmbeddedSurface::new(&mesh).unwrap();
        let surface = embedded.surface();
        let tracer = Tracer::new(surface, &TraceOptions::default());
        let mut random = Random::new(3);
        let place = |face: FaceId, point: [f64; 2]| {
            let (weights, corners) = (surface.barycentric(face, point), mesh.corners(face));
            [0, 1, 2].map(|i| (0..3).map(|k| weights[k] * corners[k][i]).sum::<f64>())
        };
        let mut gaps: Vec<f64> = (0..61)
            .map(|_| {
                let ray = ray(surface, &mut random, TAU);
                let trace = tracer.trace(&ray);
                let (a, b) = (place(ray.face, ray.point), place(trace.face, trace.point));
                (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
            })
            .collect();
        gaps.sort_unstable_by(f64::total_cmp);
        gaps[30]
    };
    let medians = [3, 4, 5].map(median);
    assert!(
        medians[0] < 0.04 && medians[0] > 1.8 * medians[1] && medians[1] > 1.8 * medians[2],
        "{medians:?}"
    );
}

#[test]
fn the_boundary_ends_a_walk() {
    let mesh = shapes::grid([2.0, 2.0], [4, 4], Diagonal::Alternating).unwrap();
    let embedded = EmbeddedSurface::new(&mesh).unwrap();
    let tracer = Tracer::new(embedded.surface(), &TraceOptions::default());
    let mut random = Random::new(4);
    for _ in 0..100 {
        let ray = ray(embedded.surface(), &mut random, 100.0);
        let trace = tracer.trace(&ray);
        let TraceEnd::Boundary(halfedge) = trace.end else { panic!("{:?}", trace.end) };
        assert!(embedded.mesh().twin(halfedge).is_none() && trace.length < 2.83);
        let weights = embedded.surface().barycentric(trace.face, trace.point);
        let corners = mesh.corners(trace.face);
        let [x, y] = [0, 1].map(|i| (0..3).map(|k| weights[k] * corners[k][i]).sum::<f64>().abs());
        assert!((x.max(y) - 1.0).abs() < 1e-14, "({x}, {y})");
    }
    // Straight into a corner of the square.
    let corner = mesh.positions().iter().position(|p| *p == [1.0, 1.0, 0.0]).unwrap() as u32;
    let face =
        embedded.mesh().face_ids().find(|&f| embedded.mesh().face(f).iter().any(|v| v.0 == corner)).unwrap();
    let at = embedded.mesh().face(face).iter().position(|v| v.0 == corner).unwrap();
    let corners = embedded.surface().corners(face);
    let centre = [0, 1].map(|i| corners.iter().map(|p| p[i]).sum::<f64>() / 3.0);
    let direction = [0, 1].map(|i| corners[at][i] - centre[i]);
    let trace = tracer.trace(&Ray { face, point: centre, direction, length: 9.0 });
    let met_corner = matches!(trace.end, TraceEnd::BoundaryVertex(v) if v.0 == corner);
    // Rounding may miss the corner on one side and reach the boundary beside it.
    assert!(
        met_corner || matches!(trace.end, TraceEnd::Boundary(_)) && close(trace.point, corners[at], 1e-14)
    );
}

#[test]
fn many_rays_are_single_rays_at_any_number_of_threads() {
    let embedded = EmbeddedSurface::new(&shapes::torus(2.0, 0.7, 24, 16).unwrap()).unwrap();
    let tracer = Tracer::new(embedded.surface(), &TraceOptions::default());
    let mut random = Random::new(6);
    let rays: Vec<Ray> = (0..2000).map(|_| ray(embedded.surface(), &mut random, 1.5)).collect();
    let single: Vec<Trace> = rays.iter().map(|ray| tracer.trace(ray)).collect();
    for threads in [1, 2, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| tracer.trace_many(&rays)), single);
    }
    let (trace, path) = tracer.path(&rays[0]);
    assert_eq!(trace, single[0]);
    assert_eq!((path[0], path[path.len() - 1]), ((rays[0].face, rays[0].point), (trace.face, trace.point)));
    assert_eq!(path.len(), trace.crossings + 2);
}

#[test]
fn transport_turns_all_vectors_alike() {
    let embedded = EmbeddedSurface::new(&shapes::icosphere(1.0, 2).unwrap()).unwrap();
    let tracer = Tracer::new(embedded.surface(), &TraceOptions::default());
    let ray = ray(embedded.surface(), &mut Random::new(2), 1.0);
    let trace = tracer.trace(&ray);
    let turned = pompeiu_surface::plane::rotate(trace.transport(&ray), ray.direction);
    assert!(close(turned, trace.direction, 1e-14));
}

#[test]
fn rays_that_cannot_be_followed_stay() {
    let embedded = EmbeddedSurface::new(&shapes::icosphere(1.0, 1).unwrap()).unwrap();
    let tracer = Tracer::new(embedded.surface(), &TraceOptions::default());
    let good = ray(embedded.surface(), &mut Random::new(2), 1.0);
    for wrong in [
        Ray { direction: [0.0; 2], ..good },
        Ray { direction: [f64::NAN, 1.0], ..good },
        Ray { length: -1.0, ..good },
        Ray { length: f64::INFINITY, ..good },
        Ray { point: [f64::INFINITY, 0.0], ..good },
    ] {
        let trace = tracer.trace(&wrong);
        assert_eq!((trace.end, trace.length, trace.crossings), (TraceEnd::Unusable, 0.0, 0));
    }
    let options = TraceOptions { max_crossings: 2, ..Default::default() };
    let few = Tracer::new(embedded.surface(), &options).trace(&Ray { length: 50.0, ..good });
    assert_eq!((few.end, few.crossings), (TraceEnd::Crossings, 2));
}
