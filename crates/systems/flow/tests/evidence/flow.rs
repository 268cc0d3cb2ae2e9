//! Mean curvature flow and minimal surfaces against closed forms and published values.

use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::merge;
use pompeiu_core::mesh::shapes::{
    Diagonal, cuboid, dumbbell, grid, icosphere, revolved, scherk, schwarz_lantern, torus,
};
use pompeiu_flow::{
    BoundaryCondition, Flow, FlowError, FlowOptions, FlowStep, FlowStop, Remeshing, Scheme, StepReason,
    Until, mean_curvature_flow,
};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;

/// Area and waist of the catenoid between circles of radius 1 at heights ±0.5.
const CATENOID: (f64, f64) = (5.991_796_975_802_282, 0.848_337_938_094_978_9);

fn tube(half_height: f64, around: u32, along: u32) -> TriMesh {
    schwarz_lantern(1.0, 2.0 * half_height, around, along).unwrap()
}

fn stationary(mesh: &TriMesh) -> Flow {
    mean_curvature_flow(mesh, &FlowOptions::new(Until::STATIONARY)).unwrap()
}

fn waist(mesh: &TriMesh) -> f64 {
    mesh.positions().iter().map(|p| p[0].hypot(p[1])).fold(f64::INFINITY, f64::min)
}

#[test]
fn a_tube_becomes_the_catenoid_with_order_two() {
    let mut errors = Vec::new();
    // The errors of published prototypes at these sizes.
    for (around, along, allowed) in [(48, 12, 3.81e-4), (96, 24, 9.5e-5)] {
        let flow = stationary(&tube(0.5, around, along));
        assert_eq!(flow.stop, FlowStop::Stationary, "{:?}", flow.history.last());
        assert!(flow.gradient.normal <= 1e-10, "{:?}", flow.gradient);
        let error = (flow.area.r#final / CATENOID.0 - 1.0).abs();
        assert!(error < 1.1 * allowed, "{around}: {error:e}");
        errors.push(error);
        assert!((waist(&flow.mesh) - CATENOID.1).abs() < 0.02);
    }
    let order = (errors[0] / errors[1]).log2();
    assert!((order - 2.0).abs() < 0.15, "{order}");
}

#[test]
fn an_unstable_catenoid_comes_to_an_end_that_is_said() {
    // The other catenoid between circles of radius 1 at heights ±0.5: r = c cosh(z / c), a saddle.
    let c = 0.235_095_034_1;
    for (around, along) in [(24, 16), (64, 48)] {
        let tube = tube(0.5, around, along);
        let narrow = |p: &[f64; 3]| {
            let shrunk = c * (p[2] / c).cosh() / p[0].hypot(p[1]);
            [p[0] * shrunk, p[1] * shrunk, p[2]]
        };
        let start =
            TriMesh::new(tube.positions().iter().map(narrow).collect(), tube.faces().to_vec()).unwrap();
        let flow = stationary(&start);
        assert!(flow.steps < 1_000, "{} steps, {:?}", flow.steps, flow.stop);
        let has_place = matches!(flow.stop, FlowStop::Stalled | FlowStop::Degenerate);
        assert_eq!(flow.place.is_some(), has_place, "{:?}", flow.stop);
        if flow.stop == FlowStop::Stationary {
            assert!(flow.stability.is_some());
        }
    }
}

#[test]
fn flows_of_plates_end_however_thin_they_are() {
    for thickness in [1e-3, 1e-5, 1e-7, 1e-9, 1e-12] {
        let plate = cuboid([1.0, 1.0, thickness], 4).unwrap();
        for improve in [true, false] {
            let options = FlowOptions { improve, ..FlowOptions::new(Until::Steps(5)) };
            let flow = mean_curvature_flow(&plate, &options).unwrap();
            let has_place = matches!(flow.stop, FlowStop::Stalled | FlowStop::Degenerate);
            assert_eq!(flow.place.is_some(), has_place, "{thickness}: {:?}", flow.stop);
        }
    }
}

#[test]
fn the_catenoid_is_a_minimum_and_its_least_eigenvalue_is_known() {
    let flow = stationary(&tube(0.5, 96, 24));
    let stability = flow.stability.unwrap();
    assert_eq!(stability.is_minimum(), Some(true));
    // The least eigenvalue of -u'' - 2 sech^2(v) u = lambda c^2 cosh^2(v) u.
    assert!((stability.least_eigenvalue / 6.883_343 - 1.0).abs() < 0.01, "{stability:?}");
    // Discs of radius 1 have the area 2 pi, more than the catenoid.
    assert!(flow.discs.is_some_and(|discs| discs.plane && !discs.less), "{:?}", flow.discs);
    let lower = stationary(&tube(0.6, 96, 24));
    assert_eq!(lower.stability.unwrap().is_minimum(), Some(true));
    assert!(lower.discs.is_some_and(|discs| discs.less), "beyond 0.5277 the discs have less area");
}

#[test]
fn the_other_catenoid_is_a_saddle() {
    // From the exact shape Newton's method ends in it.
    let c = 0.235_094_990_2_f64;
    let (rows, v) = (64, (0.5 / 0.235_094_990_2_f64));
    let profile = |row: u32| {
        let t = v * (2.0 * f64::from(row) / f64::from(rows) - 1.0);
        [c * t.cosh(), c * t]
    };
    let mesh = revolved(96, rows, profile).unwrap();
    let options = FlowOptions { improve: false, ..FlowOptions::new(Until::Steps(0)) };
    let flow = mean_curvature_flow(&mesh, &options).unwrap();
    assert!((flow.area.initial / 6.845_655_394_3 - 1.0).abs() < 2e-3, "{:?}", flow.area);
    let still = FlowOptions { improve: false, ..FlowOptions::new(Until::Stationary(0.05)) };
    let flow = mean_curvature_flow(&mesh, &still).unwrap();
    assert_eq!(flow.steps, 0, "the shape is nearly stationary: {:?}", flow.gradient);
    let stability = flow.stability.unwrap();
    assert_eq!(stability.is_minimum(), Some(false));
    assert!((stability.least_eigenvalue / -10.065_114 - 1.0).abs() < 0.03, "{stability:?}");
}

#[test]
fn beyond_the_last_catenoid_there_is_none() {
    let flow = stationary(&tube(0.6627, 64, 20));
    assert!(flow.cone.is_none());
    for h in [0.6630, 0.70] {
        let flow = stationary(&tube(h, 64, 20));
        assert!(flow.cone.is_some(), "{h}");
        assert_eq!(flow.stop, FlowStop::Pinched, "{h}: {:?}", flow.history.last());
        assert!(flow.mesh.positions().iter().flatten().all(|x| x.is_finite()));
        assert!(flow.neck.is_some_and(|neck| neck.position[2].abs() < 0.35), "{:?}", flow.neck);
    }
}

#[test]
fn scherks_surface_is_reached_from_a_flat_start_over_its_boundary() {
    let exact = scherk(1.2, 24).unwrap();
    let on_boundary = |p: &[f64; 3]| p[0].abs().max(p[1].abs()) > 1.2 - 1e-12;
    let flat =
        exact.positions().iter().map(|p| if on_boundary(p) { *p } else { [p[0], p[1], 0.1] }).collect();
    let flow = stationary(&TriMesh::new(flat, exact.faces().to_vec()).unwrap());
    assert_eq!(flow.stop, FlowStop::Stationary);
    assert!((flow.area.r#final / 9.949_824_998_708 - 1.0).abs() < 2e-3, "{:?}", flow.area);
}

/// Mean radius of a sphere-like mesh.
fn radius(mesh: &TriMesh) -> f64 {
    let sum: f64 = mesh.positions().iter().map(|p| DVec3::from_array(*p).length()).sum();
    sum / mesh.positions().len() as f64
}

#[test]
fn a_sphere_shrinks_as_it_must() {
    // R^2 = R0^2 - 4 t.
    let mesh = icosphere(1.0, 3).unwrap();
    let end = 3.0 / 16.0;
    let adaptive = mean_curvature_flow(&mesh, &FlowOptions::new(Until::Time(end))).unwrap();
    assert_eq!(adaptive.stop, FlowStop::Time);
    assert!((adaptive.history.last().unwrap().time.unwrap() - end).abs() < 1e-15);
    // The mesh of 1,280 faces itself is the error: its curvature is 1 % off.
    assert!((radius(&adaptive.mesh) / 0.5 - 1.0).abs() < 1e-2, "{}", radius(&adaptive.mesh));
    let fixed = |step: f64, extrapolate: bool| {
        let options =
            FlowOptions { time_step: Some(step), extrapolate, ..FlowOptions::new(Until::Time(end)) };
        radius(&mean_curvature_flow(&mesh, &options).unwrap().mesh)
    };
    // Order one and two in time against the same mesh with small steps.
    let fine = fixed(end / 150.0, true);
    let errors = |extrapolate: bool| [12.0, 24.0].map(|n| (fixed(end / n, extrapolate) - fine).abs());
    let ([a, b], [c, d]) = (errors(false), errors(true));
    assert!((1.6..2.6).contains(&(a / b)), "{a} {b}");
    assert!(c / d > 3.0 && c < 0.2 * a, "{c} {d}");
}

/// A sphere with a spike of faces a hundredth as long as the others.
fn sphere_with_a_spike() -> TriMesh {
    let sphere = icosphere(1.0, 4).unwrap();
    let (top, size) = (699, 1e-3);
    let mut positions: Vec<DVec3> = sphere.positions().iter().map(|p| DVec3::from_array(*p)).collect();
    let around = sphere.faces().iter().filter(|face| face.contains(&top)).flatten().copied();
    let around: std::collections::BTreeSet<u32> = around.filter(|v| *v != top).collect();
    let centre = positions[top as usize];
    for v in around {
        positions[v as usize] = centre + size * (positions[v as usize] - centre).normalize();
    }
    positions[top as usize] *= 1.0 + 2.0 * size;
    TriMesh::new(positions.iter().map(DVec3::to_array).collect(), sphere.faces().to_vec()).unwrap()
}

#[test]
fn one_rough_place_does_not_stop_the_others() {
    let options = FlowOptions { scheme: Some(Scheme::Implicit), ..FlowOptions::new(Until::Steps(4)) };
    let flow = mean_curvature_flow(&sphere_with_a_spike(), &options).unwrap();
    assert_eq!((flow.stop, flow.steps), (FlowStop::Steps, 4));
    assert!(flow.area.r#final < (1.0 - 1e-6) * flow.area.initial, "{:?}", flow.area);
}

#[test]
fn every_scheme_makes_the_area_less_and_says_what_it_did() {
    let mesh = tube(0.4, 24, 8);
    for scheme in Scheme::ALL {
        let mut options = FlowOptions { scheme: Some(scheme), ..FlowOptions::new(Until::Steps(12)) };
        options.improve = false;
        let flow = mean_curvature_flow(&mesh, &options).unwrap();
        assert!(matches!(flow.stop, FlowStop::Steps | FlowStop::Stalled), "{scheme:?} {:?}", flow.stop);
        assert!(flow.area.r#final < flow.area.initial, "{scheme:?} {:?}", flow.area);
        assert_eq!(flow.history.len(), flow.steps + 1);
        for pair in flow.history.windows(2) {
            let falls = pair[1].area <= pair[0].area * (1.0 + 1e-12);
            assert!(
                falls || scheme == Scheme::FixedLaplacian || scheme == Scheme::Conformalized,
                "{scheme:?} {pair:?}"
            );
        }
    }
}

#[test]
fn the_laplacian_of_the_first_step_leads_elsewhere() {
    // It minimises the Dirichlet energy over the cylinder: radius cosh z / cosh h.
    let options = FlowOptions {
        scheme: Some(Scheme::FixedLaplacian),
        improve: false,
        ..FlowOptions::new(Until::Steps(3))
    };
    let flow = mean_curvature_flow(&tube(0.5, 96, 24), &options).unwrap();
    assert!((waist(&flow.mesh) - 1.0 / 0.5_f64.cosh()).abs() < 1e-3, "{}", waist(&flow.mesh));
    assert!((flow.area.r#final - 6.0075).abs() < 3e-3, "{:?}", flow.area);
}

#[test]
fn full_newton_and_the_switch_reach_a_smaller_area_than_the_gradient() {
    let mesh = tube(0.5, 24, 8);
    let run = |scheme| {
        let options = FlowOptions { scheme: Some(scheme), ..FlowOptions::new(Until::Steps(40)) };
        mean_curvature_flow(&mesh, &options).unwrap()
    };
    let newton = run(Scheme::Newton);
    let switch = run(Scheme::NewtonOrGradient);
    assert!(newton.gradient.normal < 1e-4, "{:?}", newton.gradient);
    assert!(switch.history.iter().any(|record| record.scheme == Scheme::Explicit));
    assert!(switch.history.iter().any(|record| record.reason != StepReason::Scheme));
    assert!(newton.area.r#final <= run(Scheme::Explicit).area.r#final + 1e-9);
}

#[test]
fn a_bubble_of_kept_volume_becomes_a_sphere() {
    let start = icosphere(1.0, 3).unwrap();
    let stretched = start.positions().iter().map(|p| [1.6 * p[0], 0.9 * p[1], 0.7 * p[2]]).collect();
    let mesh = TriMesh::new(stretched, start.faces().to_vec()).unwrap();
    let options = FlowOptions { keep_volume: true, ..FlowOptions::new(Until::Stationary(1e-6)) };
    let flow = mean_curvature_flow(&mesh, &options).unwrap();
    assert_eq!(flow.stop, FlowStop::Stationary, "{:?}", flow.history.last());
    let volume = flow.volume.unwrap();
    assert!((volume.r#final / volume.initial - 1.0).abs() < 1e-10, "{volume:?}");
    let sphere = (36.0 * std::f64::consts::PI * volume.initial * volume.initial).cbrt();
    assert!((flow.area.r#final / sphere - 1.0).abs() < 5e-3, "{:?} {sphere}", flow.area);
    // Laplace: the area changes with the volume by 2/R.
    let radius = (0.75 * volume.initial / std::f64::consts::PI).cbrt();
    assert!((flow.pressure.unwrap() * radius / 2.0 - 1.0).abs() < 1e-2, "{:?}", flow.pressure);
}

#[test]
fn a_boundary_that_slides_in_planes_meets_them_at_right_angles() {
    // Between two planes a bulged tube becomes a cylinder first, and the cylinder shrinks: r^2 = r0^2 - 2 t.
    let mesh = revolved(48, 12, |row| [1.0, f64::from(row) / 12.0 - 0.5]).unwrap();
    // Turned, so that the planes are orthogonal to x.
    let turned = mesh.positions().iter().map(|p| [p[2], p[0], p[1]]).collect();
    let mesh = TriMesh::new(turned, mesh.faces().to_vec()).unwrap();
    let boundary = BoundaryCondition::Planes([2.0, 0.0, 0.0]);
    let options = FlowOptions { boundary, ..FlowOptions::new(Until::Time(0.25)) };
    let flow = mean_curvature_flow(&mesh, &options).unwrap();
    assert_eq!(flow.stop, FlowStop::Time);
    for p in flow.mesh.positions() {
        assert!((p[1].hypot(p[2]) - 0.5_f64.sqrt()).abs() < 5e-3, "{p:?}");
    }
    let ends = |x: f64| flow.mesh.positions().iter().filter(|p| (p[0] - x).abs() < 1e-12).count();
    assert_eq!((ends(-0.5), ends(0.5)), (48, 48));
    assert!(flow.volume.is_none());
}

#[test]
fn a_dumbbell_pinches_at_its_neck_and_a_torus_does_not_blow_up() {
    let mesh = dumbbell(1.0, 0.25, 32, 64).unwrap();
    let flow = mean_curvature_flow(&mesh, &FlowOptions::new(Until::Time(1.0))).unwrap();
    assert_eq!(flow.stop, FlowStop::Pinched, "{:?}", flow.history.last());
    let neck = flow.neck.unwrap();
    assert!(neck.position[2].abs() < 0.3 && neck.length < 1.6, "{neck:?}");
    let ring = torus(1.0, 0.3, 48, 24).unwrap();
    let flow = mean_curvature_flow(&ring, &FlowOptions::new(Until::Time(1.0))).unwrap();
    assert_eq!(flow.stop, FlowStop::Pinched);
    assert!(flow.mesh.positions().iter().flatten().all(|x| x.is_finite()));
}

#[test]
fn a_plane_surface_is_stationary_and_stays_the_same_bits() {
    let mesh = grid([2.0, 1.0], [8, 8], Diagonal::Alternating).unwrap();
    let flow = stationary(&mesh);
    assert_eq!((flow.stop, flow.steps), (FlowStop::Stationary, 0));
    assert_eq!(flow.mesh, mesh);
}

#[test]
fn surfaces_that_cannot_flow_are_refused_in_words() {
    let flow = |mesh: &TriMesh, options: &FlowOptions<'_>| {
        mean_curvature_flow(mesh, options).unwrap_err().to_string()
    };
    let needle = TriMesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], vec![[0, 1, 2]]).unwrap();
    let options = FlowOptions::new(Until::STATIONARY);
    assert!(flow(&needle, &options).contains("face 0 has no area"));
    let face = TriMesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).unwrap();
    assert!(flow(&face, &options).contains("nothing can move"));
    let sphere = icosphere(1.0, 1).unwrap();
    let beside = merge(&[&tube(0.5, 12, 4), &sphere]).unwrap();
    assert!(flow(&beside, &options).contains("component with vertex 60 has no boundary"));
    let with = |change: &dyn Fn(&mut FlowOptions<'_>)| {
        let mut options = FlowOptions::new(Until::Time(0.1));
        change(&mut options);
        mean_curvature_flow(&sphere, &options).unwrap_err()
    };
    assert!(matches!(
        with(&|o| o.until = Until::Time(f64::NAN)),
        FlowError::NotPositive { what: "time", .. }
    ));
    assert!(matches!(with(&|o| o.time_step = Some(-1.0)), FlowError::NotPositive { .. }));
    assert!(matches!(with(&|o| o.scheme = Some(Scheme::Newton)), FlowError::NoTime { .. }));
    assert!(matches!(
        with(&|o| (o.keep_volume, o.scheme) = (true, Some(Scheme::Explicit))),
        FlowError::VolumeNotKept { .. }
    ));
    let remesh = Some(Remeshing { edge_length: 0.1, every: NonZeroUsize::MIN });
    for scheme in [Scheme::FixedLaplacian, Scheme::Conformalized] {
        let error = with(&|o| (o.remesh, o.scheme) = (remesh, Some(scheme)));
        assert!(matches!(error, FlowError::KeepsFirstMetric { .. }), "{error}");
    }
    assert!(matches!(
        with(&|o| o.boundary = BoundaryCondition::Planes([0.0; 3])),
        FlowError::PlaneNormal { .. }
    ));
}

#[test]
fn an_observer_sees_every_step_and_can_end_the_flow() {
    let mesh = icosphere(1.0, 2).unwrap();
    let watch = |step: &FlowStep<'_>| {
        assert_eq!(step.positions.len(), 162);
        if step.step == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let options = FlowOptions { observer: Some(&watch), ..FlowOptions::new(Until::Time(0.2)) };
    let flow = mean_curvature_flow(&mesh, &options).unwrap();
    assert_eq!((flow.stop, flow.steps), (FlowStop::Cancelled, 3));
}

#[test]
fn the_result_has_the_same_bits_at_any_number_of_threads() {
    let mesh = tube(0.5, 64, 40);
    let with = |threads: usize| {
        let mut options = FlowOptions::new(Until::STATIONARY);
        options.limits.threads = std::num::NonZeroUsize::new(threads);
        mean_curvature_flow(&mesh, &options).unwrap().mesh
    };
    assert_eq!(with(1), with(3));
}
