//! Remeshed surfaces keep what they must, and have good triangles.

use crate::operations::topology;
use pompeiu_core::mesh::repair::{RepairOptions, repair};
use pompeiu_core::mesh::shapes::{self, Diagonal, Ends};
use pompeiu_core::mesh::{Affine, Coordinates, MeshSummary, Precision, displace_at_random, merge, transform};
use pompeiu_core::run::{Limits, StopReason};
use pompeiu_core::spatial::self_intersections;
use pompeiu_core::{FaceId, TriMesh, VertexId};
use pompeiu_remesh::{
    ConnectivityError, FeatureError, Features, Intersections, LengthError, Quality, RemeshError,
    RemeshOptions, Remeshed, Sizing, remesh,
};
use std::time::Duration;

fn with_length(mesh: &TriMesh, length: f64) -> Remeshed {
    let found = remesh(mesh, &RemeshOptions::new(Sizing::Length(length))).unwrap();
    assert_eq!(topology(&found.mesh), topology(mesh));
    found
}

fn distance(found: &Remeshed) -> f64 {
    found.distance.as_ref().unwrap().distance.upper()
}

fn length([p, q]: [[f64; 3]; 2]) -> f64 {
    (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn closed_surfaces_get_nearly_equilateral_faces() {
    let rough = displace_at_random(&shapes::torus(2.0, 0.7, 60, 24).unwrap(), 0.02, 3).unwrap();
    let needles = shapes::torus(2.0, 0.7, 200, 24).unwrap();
    for (mesh, target) in [(shapes::icosphere(1.0, 3).unwrap(), 0.08), (rough, 0.2), (needles, 0.15)] {
        let found = with_length(&mesh, target);
        let Quality { least_angle, nearly_regular, near_target, edge_length, .. } = found.after;
        assert!(least_angle.least > 37.0 && least_angle.mean > 53.0, "{:?}", found.after);
        assert!(nearly_regular > 0.995 && near_target.unwrap() > 0.9, "{:?}", found.after);
        assert!((edge_length.mean / target - 1.0).abs() < 0.15, "{:?}", found.after);
        assert_eq!(found.after.faces, found.mesh.faces().len());
        // Chords of that length are this high at most where the smaller radius is 0.7.
        assert!(distance(&found) < target * target, "{}", distance(&found));
    }
}

#[test]
fn needles_become_about_as_many_faces_as_their_area_holds() {
    let tube = |height| shapes::cylinder(1.0, height, 200, 1, Ends::Open).unwrap();
    // How far the longest edges that are not split stand off a circle of radius 1.
    let chord = |target: f64| 1.0 - (1.0 - (2.0 / 3.0 * target).powi(2)).sqrt();
    // Of each the target, and the distance that this allows.
    let cases = [
        (tube(10.0), 0.5, 1.1 * chord(0.5)),
        (tube(30.0), 0.4, 1.1 * chord(0.4)),
        (tube(100.0), 0.8, 1.1 * chord(0.8)),
        (shapes::cone(1.0, 10.0, 200, Ends::Open).unwrap(), 0.3, 0.5 * 0.3),
        (shapes::disk(10.0, 100, 1).unwrap(), 0.5, 0.02),
    ];
    for (mesh, target, most) in cases {
        let found = with_length(&mesh, target);
        let area = MeshSummary::of(&mesh).area;
        let share = found.after.faces as f64 / (area / (0.25 * 3.0_f64.sqrt() * target * target));
        assert!((0.75..1.15).contains(&share), "{share} times as many faces");
        assert!(found.after.least_angle.mean > 50.0, "{:?}", found.after);
        assert!(distance(&found) < most, "{} for {most}", distance(&found));
    }
    // With its edges kept, a long box stays the same set.
    let long = shapes::cuboid([300.0, 1.0, 1.0], 1).unwrap();
    let features = Features { angle: Some(40.0), ..Features::default() };
    let found =
        remesh(&long, &RemeshOptions { features, ..RemeshOptions::new(Sizing::Length(0.5)) }).unwrap();
    assert!((8_000..12_000).contains(&found.after.faces), "{:?}", found.after);
    assert!(distance(&found) < 1e-9 && found.after.least_angle.least > 20.0, "{:?}", found.after);
}

/// A surface of revolution about the z axis whose section is a polygon of radii and heights.
fn turned(section: &[[f64; 2]], segments: u32) -> TriMesh {
    let rows = section.len() as u32;
    let at = |i: u32, [radius, height]: [f64; 2]| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(segments);
        [radius * angle.cos(), radius * angle.sin(), height]
    };
    let positions = (0..segments).flat_map(|i| section.iter().map(move |p| at(i, *p))).collect();
    let quads = (0..segments).flat_map(|i| (0..rows).map(move |k| (i, k)));
    let faces = quads.flat_map(|(i, k)| {
        let [this, next] = [i * rows, (i + 1) % segments * rows];
        let (here, there) = (k, (k + 1) % rows);
        [[this + here, next + here, next + there], [this + here, next + there, this + there]]
    });
    TriMesh::new(positions, faces.collect()).unwrap()
}

#[test]
fn needles_across_sharp_edges_do_not_stay() {
    // Edges asked for are hundreds of times as long as chords of the input, and longer than the tube is thick.
    let tube = turned(&[[1.0, 0.0], [1.0, 3.0], [0.8, 3.0], [0.8, 0.0]], 600);
    let shaft =
        turned(&[[0.2, 0.0], [1.0, 0.0], [1.0, 2.0], [0.6, 2.0], [0.6, 4.0], [0.8, 4.0], [0.2, 5.0]], 600);
    for (mesh, target) in [(tube, 1.0), (shaft, 0.6)] {
        let found = with_length(&mesh, target);
        assert!(found.after.faces < 400, "{:?}", found.after);
        assert!(found.after.near_target.is_some_and(|share| share > 0.6), "{:?}", found.after);
    }
}

#[test]
fn tips_are_reached_though_edges_are_longer_than_they_are_wide() {
    let spikes = shapes::icosphere(1.0, 4).unwrap();
    let tips: Vec<[f64; 3]> = shapes::icosphere(1.0, 0).unwrap().positions().to_vec();
    let stretched = |p: &[f64; 3]| {
        let cosine = tips.iter().map(|q| (0..3).map(|k| p[k] * q[k]).sum::<f64>()).fold(-1.0, f64::max);
        let height = (1.0 - cosine.min(1.0).acos() / 0.25).max(0.0);
        p.map(|x| x * (1.0 + 1.5 * height))
    };
    let spikes =
        TriMesh::new(spikes.positions().iter().map(stretched).collect(), spikes.faces().to_vec()).unwrap();
    // Without vertices held there, the tips are lost by several edge lengths.
    let cases = [
        (shapes::cone(1.0, 1.0, 64, Ends::Capped).unwrap(), 0.1, 35.0),
        (shapes::cone(1.0, 3.0, 64, Ends::Capped).unwrap(), 0.2, 28.0),
        (spikes, 0.1, 25.0),
    ];
    for (mesh, target, least) in cases {
        let found = with_length(&mesh, target);
        assert!(distance(&found) < 0.7 * target, "{} for {target}", distance(&found));
        assert!(found.after.least_angle.least > least, "{:?}", found.after);
    }
}

#[test]
fn a_thin_box_keeps_its_rim_though_edges_are_longer_than_it_is_high() {
    let plate = shapes::cuboid([20.0, 20.0, 0.5], 1).unwrap();
    let options =
        RemeshOptions { intersections: Intersections::RefuseNew, ..RemeshOptions::new(Sizing::Length(1.0)) };
    let found = remesh(&plate, &options).unwrap();
    assert!(distance(&found) < 1.0, "{}", distance(&found));
    assert_eq!(found.intersections.map(|count| count.pairs), Some(0));
    assert!(found.after.least_angle.least > 28.0, "{:?}", found.after);
}

/// A plate over an outline that is seen from the origin.
fn plate(outline: &[[f64; 2]], height: f64) -> TriMesh {
    let n = outline.len() as u32;
    let level = |z: f64| outline.iter().map(move |[x, y]| [*x, *y, z]);
    let positions = level(0.0).chain(level(height)).chain([[0.0; 3], [0.0, 0.0, height]]).collect();
    let faces = (0..n).flat_map(|i| {
        let j = (i + 1) % n;
        [[i, j, n + j], [i, n + j, n + i], [2 * n, j, i], [2 * n + 1, n + i, n + j]]
    });
    TriMesh::new(positions, faces.collect()).unwrap()
}

#[test]
fn thin_plates_keep_their_outlines() {
    let around = |n: u32, radius: &dyn Fn(u32) -> f64| -> Vec<[f64; 2]> {
        let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(n);
        (0..n).map(|i| [radius(i) * angle(i).cos(), radius(i) * angle(i).sin()]).collect()
    };
    let star = around(10, &|i| if i % 2 == 0 { 10.0 } else { 4.0 });
    let disc = around(64, &|_| 10.0);
    for (outline, height) in [(star, 0.2), (disc, 0.1)] {
        let found = with_length(&plate(&outline, height), 0.5);
        assert!(distance(&found) < 0.4, "{}", distance(&found));
        assert!(found.after.least_angle.least > 20.0, "{:?}", found.after);
    }
}

#[test]
fn pairs_that_intersect_are_told_with_those_of_the_input() {
    let sphere = shapes::icosphere(1.0, 3).unwrap();
    let beside = transform(&sphere, &Affine::translate([0.8, 0.0, 0.0])).unwrap();
    let both = merge(&[&sphere, &beside]).unwrap();
    let options =
        RemeshOptions { intersections: Intersections::RefuseNew, ..RemeshOptions::new(Sizing::Length(0.3)) };
    let count = remesh(&both, &options).unwrap().intersections.unwrap();
    let before = self_intersections(&both, 1_000_000).pairs.len();
    assert!(count.pairs > 0 && !count.is_more(), "{count:?}");
    assert_eq!(count.of_input, Some(before));
}

#[test]
fn creases_that_are_not_kept_are_cut_off_by_less_than_half_an_edge() {
    for (mesh, target) in [
        (shapes::cube(2.0, 4).unwrap(), 0.2),
        (shapes::cube(2.0, 10).unwrap(), 0.2),
        (shapes::cylinder(1.0, 2.0, 32, 16, Ends::Capped).unwrap(), 0.1),
    ] {
        let found = with_length(&mesh, target);
        assert!(distance(&found) < 0.4 * target, "{} for {target}", distance(&found) / target);
        assert!(found.after.least_angle.least > 35.0, "{:?}", found.after);
    }
}

#[test]
fn narrow_tubes_do_not_intersect_themselves() {
    for (height, target) in [(60.0, 3.0), (60.0, 2.5), (20.0, 1.5)] {
        let tube = shapes::cylinder(1.0, height, 200, 1, Ends::Open).unwrap();
        let options = RemeshOptions {
            intersections: Intersections::RefuseNew,
            ..RemeshOptions::new(Sizing::Length(target))
        };
        let found = remesh(&tube, &options).unwrap();
        assert_eq!(found.intersections.map(|count| count.pairs), Some(0));
        assert!(found.after.faces < 600, "{:?}", found.after);
    }
}

/// Corners at the boundary, where held edges end, get other numbers when edges that start at them collapse.
#[test]
fn surfaces_with_holes_are_remeshed_within_a_distance() {
    for (subdivisions, length, within) in [(2, 0.3, 0.01), (3, 0.15, 0.005)] {
        let ball = shapes::icosphere(1.0, subdivisions).unwrap();
        for radius in [0.2, 0.25, 0.3, 0.4] {
            let is_left = |face: &&[u32; 3]| {
                let corners = face.map(|v| ball.positions()[v as usize]);
                let centre = [0, 1, 2].map(|k| corners.iter().map(|p| p[k]).sum::<f64>() / 3.0);
                (centre[0] - 1.0).hypot(centre[1].hypot(centre[2])) > radius
            };
            let left = ball.faces().iter().filter(is_left).copied().collect();
            let holed = TriMesh::new(ball.positions().to_vec(), left).unwrap();
            let within = within * 12.0_f64.sqrt();
            let options =
                RemeshOptions { within: Some(within), ..RemeshOptions::new(Sizing::Length(length)) };
            let found = remesh(&holed, &options).unwrap();
            assert!(distance(&found) <= within, "{subdivisions} {radius}");
            assert_eq!(topology(&found.mesh), topology(&holed));
        }
    }
}

#[test]
fn needles_are_remeshed_within_a_distance() {
    let tube = shapes::cylinder(1.0, 20.0, 200, 1, Ends::Open).unwrap();
    for within in [0.05, 0.01] {
        let options = RemeshOptions { within: Some(within), ..RemeshOptions::new(Sizing::Length(0.5)) };
        let found = remesh(&tube, &options).unwrap();
        assert!(distance(&found) <= within && found.after.faces < 8000, "{:?}", found.after);
    }
}

#[test]
fn no_face_is_turned() {
    let sphere = displace_at_random(&shapes::icosphere(1.0, 4).unwrap(), 0.01, 3).unwrap();
    let found = with_length(&sphere, 0.15);
    for f in 0..found.mesh.faces().len() as u32 {
        let [a, b, c] = found.mesh.corners(FaceId(f));
        let minus = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| p[k] - q[k]);
        let (u, v) = (minus(b, a), minus(c, a));
        let normal = [0, 1, 2].map(|k| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
        assert!((0..3).map(|k| normal[k] * a[k]).sum::<f64>() > 0.0, "face {f}");
    }
}

#[test]
fn boundaries_stay_where_they_are() {
    // A square with its corners: the same area, exactly.
    let grid = shapes::grid([3.0, 2.0], [7, 9], Diagonal::Rising).unwrap();
    let found = with_length(&grid, 0.2);
    assert!((MeshSummary::of(&found.mesh).area - 6.0).abs() < 1e-12);
    assert!(distance(&found) < 1e-12);
    assert!(found.after.least_angle.least > 30.0, "{:?}", found.after);
    // Rings: vertices slide along them.
    let tube = shapes::cylinder(1.0, 2.0, 48, 5, Ends::Open).unwrap();
    let found = with_length(&tube, 0.15);
    assert!(distance(&found) < 0.01);
    let on_rings = found.mesh.positions().iter().filter(|p| (p[2].abs() - 1.0).abs() < 1e-12).count();
    assert!((70..=100).contains(&on_rings), "{on_rings}");
}

#[test]
fn creases_and_corners_are_kept() {
    let cube = shapes::cube(2.0, 3).unwrap();
    let features = Features { angle: Some(40.0), ..Features::default() };
    let options = RemeshOptions { features, ..RemeshOptions::new(Sizing::Length(0.2)) };
    let found = remesh(&cube, &options).unwrap();
    assert!(distance(&found) < 1e-12, "{}", distance(&found));
    assert!((MeshSummary::of(&found.mesh).area - 24.0).abs() < 1e-10);
    for corner in cube.positions().iter().filter(|p| p.iter().all(|x| x.abs() == 1.0)) {
        assert!(found.mesh.positions().contains(corner), "{corner:?}");
    }
    // Without features corners are cut off.
    assert!(distance(&with_length(&cube, 0.2)) > 1e-3);
}

#[test]
fn selected_vertices_and_edges_are_kept() {
    let sphere = shapes::icosphere(1.0, 3).unwrap();
    let kept: Vec<VertexId> = (0..12).map(VertexId).collect();
    // The edges of one face become a curve with three corners.
    let [a, b, c] = sphere.faces()[100].map(VertexId);
    let edges = [[a, b], [b, c], [c, a]];
    let features = Features { vertices: &kept, edges: &edges, ..Features::default() };
    let options = RemeshOptions { features, ..RemeshOptions::new(Sizing::Length(0.3)) };
    let found = remesh(&sphere, &options).unwrap();
    for v in kept.iter().chain(&[a, b, c]) {
        assert!(found.mesh.positions().contains(&sphere.positions()[v.index()]), "{v:?}");
    }
    let none = Features { vertices: &[VertexId(7000)], ..Features::default() };
    let options = RemeshOptions { features: none, ..options };
    assert_eq!(
        remesh(&sphere, &options).unwrap_err(),
        RemeshError::Features(FeatureError::NoVertex { vertex: 7000, vertices: sphere.positions().len() })
    );
}

#[test]
fn the_distance_asked_for_is_proven() {
    let sphere = shapes::icosphere(1.0, 3).unwrap();
    let ring = shapes::torus(2.0, 0.5, 48, 24).unwrap();
    let both = merge(&[&sphere, &ring]).unwrap();
    let mut before = 0;
    for within in [0.1, 0.03] {
        let options = RemeshOptions { within: Some(within), ..RemeshOptions::new(Sizing::Length(0.8)) };
        let found = remesh(&both, &options).unwrap();
        assert!(distance(&found) <= within);
        assert!(found.mesh.faces().len() > before);
        assert_eq!(topology(&found.mesh), topology(&both));
        before = found.mesh.faces().len();
    }
    // The creases of a cube are met although they are no features.
    let cube = shapes::cube(2.0, 1).unwrap();
    let options = RemeshOptions { within: Some(0.1), ..RemeshOptions::new(Sizing::Length(0.5)) };
    assert!(distance(&remesh(&cube, &options).unwrap()) <= 0.1);
    // Those of an icosahedron make no curves.
    let solid = shapes::icosphere(1.0, 0).unwrap();
    let few = RemeshOptions { within: Some(0.002), most_faces: 4000, ..options };
    assert!(distance(&remesh(&solid, &few).unwrap()) <= 0.002);
    let error = remesh(&solid, &RemeshOptions { most_faces: 60, ..few }).unwrap_err();
    assert!(matches!(error, RemeshError::TooManyFaces { .. }), "{error}");
}

#[test]
fn a_distance_is_kept_on_rough_surfaces_without_many_faces() {
    // Creases everywhere, which shorter edges would only follow; spikes; a boundary.
    let rough = displace_at_random(&shapes::icosphere(1.0, 2).unwrap(), 0.1, 3).unwrap();
    let (positions, faces) = shapes::torus(2.0, 0.7, 20, 10).unwrap().into_parts();
    let spiked = positions.into_iter().enumerate();
    let spiked = spiked.map(|(i, p)| p.map(|x| if i % 37 == 0 { 1.4 * x } else { x })).collect();
    let spiked = TriMesh::new(spiked, faces).unwrap();
    let sheet = shapes::grid([2.0, 2.0], [10, 10], Diagonal::Rising).unwrap();
    let sheet = displace_at_random(&sheet, 0.1, 9).unwrap();
    for mesh in [&rough, &spiked, &sheet] {
        for (length, within) in [(0.2, 0.01), (0.4, 1e-6)] {
            for precision in [Precision::Double, Precision::Single] {
                let coordinates = Coordinates { precision, center: false };
                let options = RemeshOptions {
                    within: Some(within),
                    coordinates,
                    ..RemeshOptions::new(Sizing::Length(length))
                };
                let found = remesh(mesh, &options).unwrap();
                assert!(distance(&found) <= within);
                assert_eq!(topology(&found.mesh), topology(mesh));
                let free = remesh(mesh, &RemeshOptions::new(Sizing::Length(length))).unwrap();
                let most = 3 * (free.mesh.faces().len() + mesh.faces().len());
                assert!(found.mesh.faces().len() < most, "{length} {within}: {}", found.mesh.faces().len());
                let is_held = |x: &f64| f64::from(*x as f32) == *x;
                assert!(
                    precision == Precision::Double || found.mesh.positions().iter().flatten().all(is_held)
                );
            }
        }
    }
}

#[test]
fn a_run_that_ends_early_leaves_a_valid_mesh() {
    let mesh = displace_at_random(&shapes::torus(2.0, 0.7, 60, 30).unwrap(), 0.02, 3).unwrap();
    for (within, intersections) in [(None, Intersections::RefuseNew), (Some(0.001), Intersections::RefuseNew)]
    {
        for milliseconds in [0, 1, 5, 20] {
            let time = Some(Duration::from_millis(milliseconds));
            let options = RemeshOptions {
                within,
                intersections,
                limits: Limits { time, ..Limits::default() },
                ..RemeshOptions::new(Sizing::Length(0.03))
            };
            let found = remesh(&mesh, &options).unwrap();
            assert_eq!(topology(&found.mesh), topology(&mesh));
            assert!(found.after.least_angle.least > 0.0);
            match within {
                Some(within) => assert!(distance(&found) <= within),
                None if found.stop == StopReason::Time => {
                    assert!(found.distance.is_none() && found.intersections.is_none());
                }
                None => assert!(found.distance.is_some()),
            }
        }
    }
}

#[test]
fn lengths_follow_curvature_and_fields() {
    let ring = shapes::torus(1.0, 0.25, 96, 32).unwrap();
    let ball = shapes::icosphere(2.0, 4).unwrap();
    for tolerance in [0.01, 0.003] {
        let sizing = Sizing::ChordHeight { tolerance, between: [1e-3, 1.0] };
        for (mesh, radius) in [(&ring, 0.25), (&ball, 2.0_f64)] {
            let found = remesh(mesh, &RemeshOptions::new(sizing)).unwrap();
            // The longest edge that is left has this height; most are shorter.
            let chord = (6.0 * tolerance * radius - 3.0 * tolerance * tolerance).sqrt();
            let mean = found.after.edge_length.mean;
            assert!((0.5 * chord..chord).contains(&mean), "{mean} of {chord}");
            assert!(distance(&found) < 1.5 * tolerance, "{} of {tolerance}", distance(&found));
        }
    }
    // Short edges on one side of a sphere, long ones on the other.
    let field = |p: [f64; 3]| 0.15 + 0.05 * p[2];
    let found = remesh(&ball, &RemeshOptions::new(Sizing::Field(&field))).unwrap();
    let mesh = &found.mesh;
    let mean = |upper: bool| {
        let faces = mesh.face_ids().map(|f| mesh.corners(f)).filter(|c| upper == (c[0][2] > 1.0));
        let lengths: Vec<f64> =
            faces.filter(|c| upper || c[0][2] < -1.0).map(|[p, q, _]| length([p, q])).collect();
        lengths.iter().sum::<f64>() / lengths.len() as f64
    };
    assert!(
        (0.2..0.26).contains(&mean(true)) && (0.06..0.1).contains(&mean(false)),
        "{} {}",
        mean(true),
        mean(false)
    );
    assert!(found.after.least_angle.least > 25.0, "{:?}", found.after);
    let bad = |p: [f64; 3]| p[2];
    let error = remesh(&ball, &RemeshOptions::new(Sizing::Field(&bad))).unwrap_err();
    assert!(matches!(error, RemeshError::Field { length, .. } if length <= 0.0));
}

#[test]
fn the_same_bits_at_any_number_of_threads_and_scale() {
    let mesh = displace_at_random(&shapes::icosphere(1.0, 4).unwrap(), 0.01, 3).unwrap();
    let on = |threads: usize, mesh: &TriMesh, length: f64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| remesh(mesh, &RemeshOptions::new(Sizing::Length(length))).unwrap().mesh)
    };
    let one = on(1, &mesh, 0.1);
    assert_eq!(one, on(2, &mesh, 0.1));
    assert_eq!(one, on(8, &mesh, 0.1));
    for exponent in [-400, 400] {
        let scale = f64::from(exponent).exp2();
        let positions = mesh.positions().iter().map(|p| p.map(|x| x * scale)).collect();
        let scaled = TriMesh::new(positions, mesh.faces().to_vec()).unwrap();
        assert_eq!(on(1, &scaled, 0.1 * scale).faces(), one.faces());
    }
}

#[test]
fn a_mesh_at_one_position_has_no_surface() {
    let point = TriMesh::new(vec![[1.0; 3]; 3], vec![[0, 1, 2]]).unwrap();
    let error = remesh(&point, &RemeshOptions::new(Sizing::Length(1.0))).unwrap_err();
    assert_eq!(error, RemeshError::OnePosition);
}

#[test]
fn what_cannot_be_asked_for() {
    let sphere = shapes::icosphere(1.0, 2).unwrap();
    let error = |length| remesh(&sphere, &RemeshOptions::new(Sizing::Length(length))).unwrap_err();
    assert!(matches!(error(0.0), RemeshError::Length(LengthError::NotPositive { length: 0.0, .. })));
    assert!(matches!(error(f64::NAN), RemeshError::Length(LengthError::NotPositive { .. })));
    assert!(matches!(error(1e-14), RemeshError::Length(LengthError::BelowRounding { .. })));
    assert!(matches!(error(4.0), RemeshError::TooLong { .. }));
    // 4 pi of area, faces of sqrt 3 / 4 * 10^-8.
    match error(1e-4) {
        RemeshError::TooManyFaces { faces, most } => {
            assert!((faces / 2.9e9 - 1.0).abs() < 0.1, "{faces}");
            assert_eq!(most, RemeshOptions::MOST_FACES);
        }
        other => panic!("{other}"),
    }
    let within = RemeshOptions { within: Some(1e-15), ..RemeshOptions::new(Sizing::Length(0.1)) };
    assert!(matches!(
        remesh(&sphere, &within),
        Err(RemeshError::Length(LengthError::BelowRounding { what: "distance", .. }))
    ));
    let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let book = TriMesh::new(points, vec![[0, 1, 2], [1, 0, 3], [0, 1, 3]]).unwrap();
    let error = remesh(&book, &RemeshOptions::new(Sizing::Length(0.1))).unwrap_err();
    assert!(matches!(error, RemeshError::Connectivity(ConnectivityError::SharedHalfedge { .. })));
    assert!(error.to_string().contains("pompeiu repair"));
}

#[test]
fn faces_without_area_do_no_harm() {
    // Needles, and vertices at one position.
    let mut positions = shapes::grid([1.0, 1.0], [4, 4], Diagonal::Rising).unwrap().into_parts();
    let (p, q) = (positions.0[6], positions.0[12]);
    positions.0[7] = p;
    positions.0[13] = [0, 1, 2].map(|k| 0.5 * (p[k] + q[k]));
    positions.0[11] = [0, 1, 2].map(|k| 0.5 * (p[k] + q[k]));
    let mesh = TriMesh::new(positions.0, positions.1).unwrap();
    assert!(MeshSummary::of(&mesh).degenerate_faces > 0);
    for length in [0.05, 0.3, 1.2] {
        let found = with_length(&mesh, length);
        assert!(found.mesh.positions().iter().flatten().all(|x| x.is_finite()));
    }
    // All of it at one point, and all on one line.
    for squeeze in [0.0, 1.0] {
        let flat = mesh.positions().iter().map(|p| [p[0] * squeeze, 0.0, 0.0]).collect();
        let mesh = TriMesh::new(flat, mesh.faces().to_vec()).unwrap();
        let options = RemeshOptions { measure: false, ..RemeshOptions::new(Sizing::Length(0.1)) };
        match remesh(&mesh, &options) {
            Ok(found) => {
                assert!(found.mesh.positions().iter().flatten().all(|x| x.abs() <= 1.0));
            }
            Err(error) => assert!(squeeze == 0.0 && matches!(error, RemeshError::OnePosition), "{error}"),
        }
    }
}

#[test]
fn a_real_mesh() {
    let Some(mesh) = crate::real_mesh("bunny.off") else { return };
    let length = Quality::of(&mesh).unwrap().edge_length.mean;
    let found = with_length(&mesh, 1.5 * length);
    let Quality { least_angle, near_target, .. } = found.after;
    assert!(least_angle.least > 37.0 && least_angle.mean > 53.0, "{:?}", found.after);
    assert!(near_target.unwrap() > 0.9);
}

#[test]
fn features_meet_in_valid_faces() {
    // Two blocks with creases in many directions, turned so that nothing is axis-parallel.
    let cube = shapes::cube(2.0, 6).unwrap();
    let cylinder = shapes::cylinder(1.0, 2.0, 48, 12, Ends::Capped).unwrap();
    for mesh in [&cube, &cylinder] {
        let turn = Affine::rotate([1.0, 2.0, 3.0], 31.0).unwrap();
        let mesh = transform(mesh, &turn).unwrap();
        for length in [0.11, 0.23, 0.47] {
            let options = RemeshOptions {
                features: Features { angle: Some(40.0), ..Features::default() },
                intersections: Intersections::Report,
                ..RemeshOptions::new(Sizing::Length(length))
            };
            let found = remesh(&mesh, &options).unwrap();
            // No face is thinner than a twentieth of its longest edge.
            assert!(found.after.least_angle.least > 2.5, "{length}: {:?}", found.after.least_angle);
            assert_eq!(found.intersections.map(|count| count.pairs), Some(0), "{length}");
        }
    }
}

#[test]
fn an_outline_is_followed_to_a_chord_height() {
    // A disc has no curvature but that of its boundary.
    let disc = shapes::disk(1.0, 200, 20).unwrap();
    let sizing = Sizing::ChordHeight { tolerance: 0.01, between: [1e-3, 1.0] };
    let found = remesh(&disc, &RemeshOptions::new(sizing)).unwrap();
    assert!(distance(&found) < 0.02, "{}", distance(&found));
}

#[test]
fn creases_are_kept_where_a_distance_asks_for_it() {
    // Without curves along its edges a cube is cut off there by a share of the edge length.
    let cube = shapes::cube(2.0, 8).unwrap();
    let within = |distance| {
        let options = RemeshOptions { within: Some(distance), ..RemeshOptions::new(Sizing::Length(0.3)) };
        remesh(&cube, &options).unwrap()
    };
    let near = within(1e-6);
    assert!(near.distance.unwrap().distance.upper() <= 1e-6);
    assert!(near.after.faces < 2000, "{} faces", near.after.faces);
    // Where the distance allows it they are rounded off, as without.
    let free = remesh(&cube, &RemeshOptions::new(Sizing::Length(0.3))).unwrap();
    let allowed = free.distance.unwrap().distance.upper() * 1.5;
    assert_eq!(within(allowed).mesh.faces().len(), free.mesh.faces().len());
}

#[test]
fn faces_that_intersect_are_refused_where_the_input_has_none() {
    // Two sheets that are nearer to each other than edges are long.
    let outer = shapes::icosphere(1.0, 4).unwrap();
    let inner = shapes::icosphere(0.995, 4).unwrap();
    let join = |inner: &TriMesh| {
        let count = outer.positions().len() as u32;
        let positions = [outer.positions(), inner.positions()].concat();
        let moved = inner.faces().iter().map(|face| face.map(|v| v + count));
        TriMesh::new(positions, outer.faces().iter().copied().chain(moved).collect()).unwrap()
    };
    let with = |mesh: &TriMesh, intersections| {
        let options = RemeshOptions { intersections, ..RemeshOptions::new(Sizing::Length(0.5)) };
        remesh(mesh, &options)
    };
    let apart = join(&inner);
    let found = with(&apart, Intersections::Report).unwrap().intersections.unwrap();
    assert!(found.pairs > 0);
    // Nearer to the input there are none.
    let mended = with(&apart, Intersections::RefuseNew).unwrap();
    assert_eq!(mended.intersections.map(|count| count.pairs), Some(0));
    assert!(distance(&mended) < 0.025);
    assert!(matches!(with(&apart, Intersections::Refuse), Err(RemeshError::Intersects(_))));
    // An input with intersections is none the worse.
    let crossed = join(&transform(&inner, &Affine::translate([0.01, 0.0, 0.0])).unwrap());
    let counted = with(&crossed, Intersections::RefuseNew).unwrap().intersections.unwrap();
    assert!(counted.pairs > 0);
}

#[test]
fn sheets_that_were_cut_apart_are_named_where_they_intersect() {
    // Two bent boxes with a wall between them: three sheets at each of its edges.
    let cube = shapes::cube(1.0, 5).unwrap();
    let both = merge(&[&cube, &transform(&cube, &Affine::translate([1.0, 0.0, 0.0])).unwrap()]).unwrap();
    let bent = both.positions().iter().map(|&[x, y, z]| {
        [x + 0.15 * (3.0 * y + z).sin(), y + 0.1 * (2.0 * x + 2.0 * z).sin(), z + 0.1 * (3.0 * x * y).cos()]
    });
    let bent = TriMesh::new(bent.collect(), both.faces().to_vec()).unwrap();
    let apart = repair(&bent, &RepairOptions::default()).unwrap().mesh;
    let with = |intersections| {
        remesh(&apart, &RemeshOptions { intersections, ..RemeshOptions::new(Sizing::Length(0.07)) })
    };
    assert!(with(Intersections::Report).unwrap().intersections.unwrap().pairs > 0);
    let error = with(Intersections::RefuseNew).unwrap_err();
    assert!(matches!(error, RemeshError::Intersects(found) if found.touching > 20), "{error:?}");
    assert!(error.to_string().contains("cut apart at a common edge"), "{error}");
}
