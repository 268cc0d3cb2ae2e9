//! Maps: planar disks are recovered, developable surfaces keep their lengths, no face flips or overlaps.

use super::{real_mesh, surface, zoo};
use pompeiu_core::mesh::shapes::{self, Diagonal, Ends};
use pompeiu_core::mesh::{displace_at_random, merge};
use pompeiu_core::run::{Limits, RunContext};
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_flatten::{
    Conformal, ConvexBoundary, CutOptions, CutRequest, CutStrategy, FlattenError, FlattenOptions,
    FlattenRequest, Flattening, Method, RingKind, VirtualBoundary, Weights, flatten,
};

fn convex(boundary: ConvexBoundary, weights: Weights) -> FlattenOptions<'static> {
    FlattenOptions {
        method: Method::Convex { boundary, weights, around: None },
        pack: false,
        ..FlattenOptions::default()
    }
}

/// Twice the area of each face in the map.
fn areas(flat: &Flattening) -> Vec<f64> {
    let twice = |[a, b, c]: [[f64; 2]; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    flat.corner_uv().into_iter().map(twice).collect()
}

/// A planar disk with displaced inner vertices.
fn planar_disk() -> TriMesh {
    let (positions, faces) = shapes::disk(2.0, 24, 7).unwrap().into_parts();
    let mut random = pompeiu_core::mesh::Random::new(5);
    let moved = positions.into_iter().map(|[x, y, _]| {
        let inside = (4.0 - x * x - y * y).max(0.0) / 4.0;
        [x + 0.02 * inside * random.signed_unit(), y + 0.02 * inside * random.signed_unit(), 0.0]
    });
    TriMesh::new(moved.collect(), faces).unwrap()
}

#[test]
fn planar_disks_are_reproduced() {
    let mesh = planar_disk();
    let disk = surface(&mesh);
    let error = |weights| {
        let flat = flatten(&disk, &convex(ConvexBoundary::Own, weights)).unwrap();
        let offset = |k: usize| flat.uv[VertexId(0)][k] - mesh.positions()[0][k];
        let [dx, dy] = [offset(0), offset(1)];
        let errors =
            flat.uv.iter().zip(mesh.positions()).map(|(p, q)| (p[0] - q[0] - dx).hypot(p[1] - q[1] - dy));
        errors.fold(0.0, f64::max)
    };
    for weights in [Weights::Cotangent, Weights::MeanValue] {
        assert!(error(weights) <= 1e-12, "{weights:?}: {:e}", error(weights));
    }
    assert!(error(Weights::Uniform) > 1e-3);
}

#[test]
fn a_regular_polygon_is_its_own_circle_by_chord_length() {
    let disk = shapes::disk(1.0, 17, 1).unwrap();
    let flat = flatten(&surface(&disk), &convex(ConvexBoundary::Circle, Weights::MeanValue)).unwrap();
    let distortion = flat.report.distortion;
    assert!(distortion.angle.max - 1.0 < 1e-12 && distortion.isometric.max - 1.0 < 1e-12, "{distortion:?}");
}

#[test]
fn convex_maps_flip_nothing_at_any_genus_and_any_number_of_loops() {
    for (genus, loops) in [(0, 0), (0, 1), (0, 4), (1, 0), (2, 1), (5, 2)] {
        let surface = surface(&zoo(genus, loops));
        for weights in [Weights::Uniform, Weights::MeanValue, Weights::Cotangent] {
            let flat = flatten(&surface, &convex(ConvexBoundary::Circle, weights)).unwrap();
            assert!(flat.report.is_one_to_one(), "{genus} {loops} {weights:?}");
            assert!(areas(&flat).into_iter().all(|area| area > 0.0));
        }
    }
}

#[test]
fn needles_and_obtuse_fans_flip_nothing() {
    let needles = shapes::uv_sphere(1.0, 60, 4).unwrap();
    let lantern = shapes::schwarz_lantern(1.0, 1.0, 7, 40).unwrap();
    let noise = displace_at_random(&shapes::icosphere(1.0, 3).unwrap(), 0.2, 3).unwrap();
    for mesh in [needles, lantern, noise] {
        for weights in [Weights::MeanValue, Weights::Cotangent] {
            let flat = flatten(&surface(&mesh), &convex(ConvexBoundary::Circle, weights)).unwrap();
            assert!(flat.report.is_one_to_one(), "{weights:?}");
        }
        assert!(flatten(&surface(&mesh), &FlattenOptions::default()).unwrap().report.is_one_to_one());
    }
}

/// A tube closed at one end, so many circumferences long.
fn tube(ratio: f64) -> TriMesh {
    let rows = (16.0 * ratio) as u32;
    let closed = shapes::cylinder(1.0, std::f64::consts::TAU * ratio, 16, rows, Ends::Capped).unwrap();
    let (positions, faces) = closed.into_parts();
    let top = positions.iter().map(|p| p[2]).fold(f64::NEG_INFINITY, f64::max);
    let is_cap = |face: &&[u32; 3]| face.iter().all(|&v| positions[v as usize][2] == top);
    let kept: Vec<_> = faces.iter().filter(|face| !is_cap(face)).copied().collect();
    let tube = TriMesh::new(positions, kept).unwrap();
    pompeiu_core::mesh::without_unreferenced(&tube)
}

#[test]
fn crowded_tubes_are_cured_or_named() {
    let mut cured = 0;
    for ratio in [1.0, 4.0, 8.0, 12.0] {
        match flatten(&surface(&tube(ratio)), &convex(ConvexBoundary::Circle, Weights::MeanValue)) {
            Ok(flat) => {
                assert!(flat.report.is_one_to_one() && flat.report.distortion.least_singular_ratio >= 1e-10);
                cured += usize::from(flat.report.reweightings > 0);
            }
            Err(error) => assert!(matches!(error, FlattenError::Crowded { .. }), "{error}"),
        }
    }
    assert!(cured >= 1, "no map was crowded");
}

#[test]
fn faces_of_hardly_any_height_are_mapped_with_the_rest() {
    let grid = shapes::grid([6.0, 6.0], [6, 6], Diagonal::Rising).unwrap();
    for (bend, expected) in [(0.0, 4.0 + 1e-6), (0.3, 4.1)] {
        for height in [1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 4e-12] {
            let (mut positions, mut faces) = grid.clone().into_parts();
            for p in &mut positions {
                p[2] = bend * p[0].sin() * p[1].cos();
            }
            // Three faces are divided at points that nearly lie on an edge.
            for f in [20, 33, 50] {
                let [a, b, c] = faces[f];
                let [p, q, r] = faces[f].map(|v| positions[v as usize]);
                let middle = [0, 1, 2].map(|k| 0.5 * (p[k] + q[k]));
                let v = positions.len() as u32;
                positions.push([0, 1, 2].map(|k| middle[k] + height * (r[k] - middle[k])));
                faces[f] = [a, b, v];
                faces.extend([[b, c, v], [c, a, v]]);
            }
            let mesh = TriMesh::new(positions, faces).unwrap();
            let flat = flatten(&surface(&mesh), &FlattenOptions::default()).unwrap();
            let energy = flat.report.distortion.symmetric_dirichlet.mean;
            assert!(energy < expected, "{bend} {height:e}: {energy}");
        }
    }
}

#[test]
fn developable_surfaces_keep_their_lengths() {
    let cylinder = shapes::cylinder(1.0, 2.0, 24, 5, Ends::Open).unwrap();
    let cone = shapes::cone(1.0, 2.0, 24, Ends::Open).unwrap();
    let apex = (0..cone.positions().len())
        .max_by(|&a, &b| cone.positions()[a][2].total_cmp(&cone.positions()[b][2]));
    let to_apex = CutStrategy::Through(vec![VertexId(apex.unwrap() as u32)]);
    for (mesh, strategy) in [(cylinder, CutStrategy::Auto), (cone, to_apex)] {
        let cut = CutOptions { strategy, ..CutOptions::default() };
        let flat = flatten(&surface(&mesh), &FlattenOptions { cut, ..FlattenOptions::default() }).unwrap();
        let distortion = flat.report.distortion;
        assert!(flat.report.is_one_to_one());
        assert!(
            distortion.angle.max - 1.0 <= 1e-9 && distortion.isometric.max - 1.0 <= 1e-9,
            "{distortion:?}"
        );
    }
}

#[test]
fn free_maps_of_the_zoo_are_one_to_one_and_good() {
    for (genus, loops) in [(0, 0), (0, 2), (1, 0), (1, 1), (3, 0)] {
        let flat = flatten(&surface(&zoo(genus, loops)), &FlattenOptions::default()).unwrap();
        let report = &flat.report;
        assert!(report.is_one_to_one() && areas(&flat).into_iter().all(|area| area > 0.0));
        let energy = report.distortion.symmetric_dirichlet.mean;
        assert!(energy < 4.4, "genus {genus}, {loops} loops: {energy}");
        assert!(flat.uv.iter().flatten().all(|x| (0.0..=1.0).contains(x)));
    }
}

#[test]
fn several_components_share_one_square_at_one_scale() {
    let sphere = shapes::icosphere(1.0, 2).unwrap();
    let grid = shapes::grid([3.0, 1.0], [6, 2], Diagonal::Rising).unwrap();
    let both = merge(&[&grid, &sphere, &shapes::tetrahedron(0.5).unwrap(), &grid]).unwrap();
    let flat = flatten(&surface(&both), &FlattenOptions::default()).unwrap();
    assert!(flat.report.is_one_to_one());
    assert_eq!((flat.report.charts, flat.report.boundary_loops), (4, 4));
    let parts = &flat.report.parts;
    assert_eq!(parts.iter().map(|part| part.faces).collect::<Vec<_>>(), [24, 320, 4, 24]);
    assert_eq!(parts.iter().map(|part| part.first_face).collect::<Vec<_>>(), [0, 24, 344, 348]);
    assert!(parts.iter().all(|part| part.flipped == 0 && part.overlapping == 0));
    // The grids are not cut and stay unchanged; lengths and edges of the others add up to the whole cut.
    for grid in [&parts[0], &parts[3]] {
        assert_eq!(grid.cut_edges, 0);
        assert!((grid.distortion.symmetric_dirichlet.max - 4.0).abs() < 1e-9);
    }
    assert!(parts[1].distortion.symmetric_dirichlet.mean > 4.01);
    let length: f64 = parts.iter().map(|part| part.cut_length).sum();
    let edges: usize = parts.iter().map(|part| part.cut_edges).sum();
    assert!((length / flat.report.cut.length - 1.0).abs() < 1e-12 && edges == flat.report.cut.edges);
    // Both grids are flat, and stay as they are.
    let singular = |face: usize| flat.singular_values.as_slice()[face];
    let last = both.faces().len() - 1;
    for k in 0..2 {
        assert!((singular(0)[k] / singular(last)[k] - 1.0).abs() < 1e-9);
    }
}

#[test]
fn a_closed_path_makes_two_charts_of_a_sphere() {
    let sphere = surface(&shapes::uv_sphere(1.0, 12, 6).unwrap());
    let mut around: Vec<VertexId> =
        sphere.mesh().vertex_ids().filter(|&v| sphere.positions()[v][2].abs() < 1e-9).collect();
    let angle = |v: &VertexId| sphere.positions()[*v][1].atan2(sphere.positions()[*v][0]);
    around.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    around.push(around[0]);
    let cut = CutOptions { strategy: CutStrategy::Along(vec![around]), ..CutOptions::default() };
    let convex =
        Method::Convex { boundary: ConvexBoundary::Circle, weights: Weights::MeanValue, around: None };
    for method in [Method::default(), convex] {
        let flat =
            flatten(&sphere, &FlattenOptions { cut: cut.clone(), method, ..FlattenOptions::default() });
        let report = flat.unwrap().report;
        assert!(report.is_one_to_one());
        assert_eq!((report.charts, report.cut.edges), (2, 12));
        let parts = &report.parts;
        assert_eq!(parts.iter().map(|part| (part.faces, part.cut_edges)).collect::<Vec<_>>(), [(60, 12); 2]);
        // Both halves are alike.
        let [one, other] = [0, 1].map(|k| parts[k].distortion.symmetric_dirichlet.mean);
        assert!((one / other - 1.0).abs() < 1e-6, "{one} {other}");
    }
}

/// Faces with two or three vertices on one side are nowhere degenerate: a strip without inner vertices, a fan, a sheet with thin corners, a
/// cube that is cut open, and real meshes.
#[test]
fn any_disk_is_mapped_onto_a_square_or_a_polygon() {
    let strip = {
        let positions =
            (0..24).map(|i| [f64::from(i / 2), f64::from(i % 2), 0.1 * f64::from(i % 5)]).collect();
        TriMesh::new(
            positions,
            (0..22).map(|i| if i % 2 == 0 { [i, i + 2, i + 1] } else { [i, i + 1, i + 2] }).collect(),
        )
    };
    let fan = {
        let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / 30.0;
        let positions = (0..30).map(|i| [libm::cos(angle(i)), libm::sin(angle(i)), 0.0]).collect();
        TriMesh::new(positions, (1..29).map(|i| [0, i, i + 1]).collect())
    };
    // One vertex inside.
    let wheel = {
        let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / 9.0;
        let around = (0..9).map(|i| [libm::cos(angle(i)), libm::sin(angle(i)), 0.0]);
        let positions = [[0.0, 0.0, 0.3]].into_iter().chain(around).collect();
        TriMesh::new(positions, (0..9).map(|i| [0, 1 + i, 1 + (i + 1) % 9]).collect()).unwrap()
    };
    let sheet = shapes::grid([3.0, 1.0], [9, 4], Diagonal::Falling).unwrap();
    let mut all = vec![strip.unwrap(), fan.unwrap(), wheel, sheet, shapes::cube(1.0, 2).unwrap()];
    all.extend(["camelhead.off", "mountain.obj"].iter().filter_map(|name| real_mesh(name)));
    let mut divided = 0;
    for mesh in &all {
        let is_large = mesh.faces().len() > 1000;
        let boundaries = ["square", "polygon:0,0;5,0;1,2", "polygon:0,0;1,-1;3,-1;4,2;2,5;0,4"];
        for boundary in boundaries.into_iter().take(if is_large { 1 } else { 3 }) {
            // A straightened cut of the cube has four vertices, fewer than corners.
            let ways: &[bool] = if mesh.faces().len() == 48 || is_large { &[false] } else { &[false, true] };
            for &straighten in ways {
                let cut = CutRequest { straighten, ..CutRequest::default() };
                let boundary = boundary.parse().unwrap();
                let request = FlattenRequest { boundary, cut, ..FlattenRequest::default() };
                let found = request.run(surface(mesh), &RunContext::start(Limits::default())).unwrap();
                assert!(found.flat.report.is_one_to_one(), "{request:?}");
                // The surface is the same, with more vertices on it.
                let [before, after] = [&surface(mesh), &found.surface].map(|s| s.surface().area());
                assert!((after / before - 1.0).abs() < 1e-12);
                divided += found.divided;
                assert!(
                    straighten || (found.surface.mesh().faces() > mesh.faces().len()) == (found.divided > 0)
                );
            }
        }
    }
    assert!(divided > 0);
}

/// The right-hand side of a coordinate may vanish: five neighbours of one vertex, whose weighted mean is zero.
#[test]
fn neighbours_may_cancel() {
    let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / 5.0;
    let around = (0..5).map(|i| [libm::cos(angle(i)), libm::sin(angle(i)), 0.0]);
    let positions = [[0.0, 0.0, 0.3]].into_iter().chain(around).collect();
    let wheel = TriMesh::new(positions, (0..5).map(|i| [0, 1 + i, 1 + (i + 1) % 5]).collect()).unwrap();
    for weights in [Weights::Uniform, Weights::MeanValue, Weights::Cotangent] {
        let flat = flatten(&surface(&wheel), &convex(ConvexBoundary::Square, weights)).unwrap();
        assert!(flat.report.is_one_to_one(), "{weights:?}");
    }
}

#[test]
fn squares_and_polygons_have_their_corners() {
    let disk = surface(&shapes::disk(1.0, 20, 5).unwrap());
    let triangle = vec![[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]];
    let flat =
        flatten(&disk, &convex(ConvexBoundary::Polygon(triangle.clone()), Weights::MeanValue)).unwrap();
    assert!(triangle.iter().all(|corner| flat.uv.contains(corner)) && flat.report.is_one_to_one());
    let square = flatten(&disk, &convex(ConvexBoundary::Square, Weights::Uniform)).unwrap();
    let total: f64 = areas(&square).iter().sum::<f64>() / 2.0;
    assert!((total / disk.surface().area() - 1.0).abs() < 1e-12);
    let clockwise = ConvexBoundary::Polygon(vec![[0.0, 0.0], [0.0, 4.0], [4.0, 0.0]]);
    let error = flatten(&disk, &convex(clockwise, Weights::MeanValue)).unwrap_err();
    assert_eq!(error, FlattenError::Polygon { corners: 3 });
    let dome = surface(&shapes::catenoid(1.0, 1.0, 12, 4).unwrap());
    assert!(matches!(
        flatten(&dome, &convex(ConvexBoundary::Own, Weights::MeanValue)),
        Err(FlattenError::NotPlanar { .. })
    ));
}

#[test]
fn the_same_bits_at_any_number_of_threads() {
    let mesh = merge(&[&zoo(1, 0), &zoo(0, 2)]).unwrap();
    let surface = surface(&mesh);
    let run = |threads: usize| {
        let mut options = FlattenOptions::default();
        options.limits.threads = Some(std::num::NonZeroUsize::new(threads).unwrap());
        flatten(&surface, &options).unwrap().uv.into_vec()
    };
    let once = run(1);
    assert!(once == run(2) && once == run(8));
}

#[test]
fn real_meshes_flatten_well_with_a_short_seam() {
    for name in ["spot.obj", "cow.off"] {
        let Some(mesh) = real_mesh(name) else { continue };
        let report = flatten(&surface(&mesh), &FlattenOptions::default()).unwrap().report;
        assert!(report.is_one_to_one(), "{name}");
        let energy = report.distortion.symmetric_dirichlet.mean;
        assert!(
            energy <= 4.25 && report.cut.relative_length <= 5.0,
            "{name}: {energy} {}",
            report.cut.relative_length
        );
    }
}

fn with(method: Method) -> FlattenOptions<'static> {
    FlattenOptions { method, pack: false, ..FlattenOptions::default() }
}

#[test]
fn conformal_maps_keep_the_angles_of_planar_disks_and_rigid_ones_the_lengths_of_cylinders() {
    let disk = surface(&planar_disk());
    for kind in [Conformal::LeastSquares, Conformal::Spectral] {
        let flat = flatten(&disk, &with(Method::Conformal(kind))).unwrap();
        let distortion = flat.report.distortion;
        assert!(flat.report.is_one_to_one() && distortion.angle.max - 1.0 < 1e-6, "{kind:?}: {distortion:?}");
        assert!((distortion.scale - 1.0).abs() < 1e-6, "{}", distortion.scale);
    }
    let cylinder = surface(&shapes::cylinder(1.0, 2.0, 24, 6, Ends::Open).unwrap());
    let flat = flatten(&cylinder, &with(Method::Rigid { steps: 2000 })).unwrap();
    assert!(
        flat.report.is_one_to_one() && flat.report.distortion.isometric.max < 1.02,
        "{:?}",
        flat.report.distortion
    );
    assert!(flat.report.steps > 3);
}

#[test]
fn conformal_maps_have_less_angle_error_than_any_other() {
    let cap = {
        let (positions, faces) = shapes::icosphere(1.0, 4).unwrap().into_parts();
        let kept = faces.iter().filter(|face| face.iter().all(|&v| positions[v as usize][2] > -0.2));
        let mesh = TriMesh::new(positions.clone(), kept.copied().collect()).unwrap();
        surface(&pompeiu_core::mesh::without_unreferenced(&mesh))
    };
    let angle = |method: Method| {
        let report = flatten(&cap, &with(method)).unwrap().report;
        assert!(report.is_one_to_one());
        report.distortion.angle.mean
    };
    let free = angle(Method::default());
    let rigid = angle(Method::Rigid { steps: 100 });
    for kind in [Conformal::LeastSquares, Conformal::Spectral] {
        let conformal = angle(Method::Conformal(kind));
        assert!(
            conformal < 1.05 && conformal < free && conformal < rigid,
            "{kind:?}: {conformal} {free} {rigid}"
        );
    }
}

#[test]
fn faces_around_the_disk_lessen_stretch_and_are_dropped() {
    let stretch = |mesh: &TriMesh, around: Option<VirtualBoundary>| {
        let method = Method::Convex { boundary: ConvexBoundary::Circle, weights: Weights::MeanValue, around };
        let flat = flatten(&surface(mesh), &with(method)).unwrap();
        assert_eq!(flat.uv.len(), mesh.positions().len());
        assert!(flat.report.is_one_to_one());
        flat.report.distortion.stretch_l2
    };
    let layers = |n: usize, scale: f64, kind: RingKind| {
        Some(VirtualBoundary { layers: std::num::NonZeroUsize::new(n).unwrap(), scale, kind })
    };
    // A square is not round, and may stay a square.
    let square = shapes::grid([1.0, 1.0], [12, 12], Diagonal::Rising).unwrap();
    let none = stretch(&square, None);
    for kind in [RingKind::Intrinsic, RingKind::Extrinsic] {
        let one = stretch(&square, layers(1, 1.2, kind));
        let ten = stretch(&square, layers(10, 1.2, kind));
        assert!(one < none - 0.005 && ten < none - 0.005, "{none} {one} {ten}");
    }
    if let Some(mountain) = real_mesh("mountain.obj") {
        let (none, one) = (stretch(&mountain, None), stretch(&mountain, layers(1, 1.2, RingKind::Intrinsic)));
        assert!((none - 1.29).abs() < 0.01 && (one - 1.07).abs() < 0.01, "{none} {one}");
    }
    let refused = |boundary: ConvexBoundary, around: Option<VirtualBoundary>| {
        let method = Method::Convex { boundary, weights: Weights::MeanValue, around };
        flatten(&surface(&square), &with(method)).unwrap_err()
    };
    let one = layers(1, 1.2, RingKind::Intrinsic);
    assert_eq!(refused(ConvexBoundary::Own, one), FlattenError::VirtualOwn);
    for scale in [1.0, f64::NAN, f64::INFINITY] {
        let error = refused(ConvexBoundary::Circle, layers(1, scale, RingKind::Intrinsic));
        assert!(matches!(error, FlattenError::Option { .. }), "{error}");
    }
}
