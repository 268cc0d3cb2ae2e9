//! Boxes at rest, on an incline, and in collision: every number has a closed form.

use glam::DVec3;
use pompeiu_contact::barrier::barrier;
use pompeiu_contact::shapes::{sheet, tetrahedral_box};
use pompeiu_contact::{
    Bodies, ContactError, ContactOptions, Integrator, Material, Obstacle, PairSet, Projection, Simulation,
};

const GRAVITY: f64 = 9.81;
const FLOOR: Obstacle = Obstacle::HalfSpace { normal: DVec3::Z, offset: 0.0 };
const STIFF: Material = Material { young: 1e8, poisson: 0.3, density: 1000.0 };

fn options(time_step: f64) -> ContactOptions {
    ContactOptions {
        distance: 0.01,
        sticking_speed: 1e-3,
        tolerance: 1e-5,
        ..ContactOptions::new(time_step, 1.0)
    }
}

/// The stiffness with which a weight on four corners rests at half the distance of contact.
fn stiffness(weight: f64, distance: f64) -> f64 {
    let d = 0.5 * distance;
    weight / 4.0 / (-2.0 * d * barrier(d * d, distance * distance)[1])
}

fn unit_box(bodies: &mut Bodies, low: DVec3, material: Material) -> std::ops::Range<usize> {
    let (positions, tetrahedra) = tetrahedral_box(low, low + DVec3::ONE, [1, 1, 1]);
    bodies.add_solid(&positions, &tetrahedra, material).unwrap()
}

#[test]
fn the_gap_of_a_box_at_rest_carries_its_weight() {
    let weight = 1000.0 * GRAVITY;
    for (factor, expected) in [(0.1, 0.0472), (1.0, 0.5), (10.0, 0.8591)] {
        for time_step in [0.01, 0.02] {
            let mut bodies = Bodies::new();
            // The corners carry different parts of the box's mass, but the box is stiff.
            unit_box(&mut bodies, DVec3::new(0.0, 0.0, expected * 0.01), STIFF);
            bodies.add_obstacle(FLOOR).unwrap();
            let stiffness = Some(factor * stiffness(weight, 0.01));
            let options = ContactOptions { stiffness, ..options(time_step) };
            let mut simulation = Simulation::new(bodies, options).unwrap();
            let mut last = simulation.step().unwrap();
            for _ in 0..60 {
                last = simulation.step().unwrap();
            }
            let gaps = simulation.positions().iter().take(4).map(|p| p.z / 0.01);
            let mean = gaps.sum::<f64>() / 4.0;
            assert!((mean / expected - 1.0).abs() < 3e-3, "{factor} {time_step}: {mean} {expected}");
            assert!((last.support[2] / weight - 1.0).abs() < 1e-3, "{:?} {weight}", last.support);
        }
    }
}

/// The speed along the incline every tenth of a second.
fn slide(degrees: f64, seconds: usize, speed: f64) -> Vec<f64> {
    let mut bodies = Bodies::new();
    let angle = degrees.to_radians();
    let gravity = DVec3::new(angle.sin(), 0.0, -angle.cos()) * GRAVITY;
    let range = unit_box(&mut bodies, DVec3::new(0.0, 0.0, 0.005), STIFF);
    bodies.set_velocity(range, DVec3::X * speed);
    bodies.add_obstacle(FLOOR).unwrap();
    let stiffness = Some(stiffness(1000.0 * GRAVITY * angle.cos(), 0.01));
    let options = ContactOptions { gravity, friction: 0.5, stiffness, tolerance: 1e-7, ..options(0.01) };
    let mut simulation = Simulation::new(bodies, options).unwrap();
    let mut speeds = Vec::new();
    for _ in 0..10 * seconds {
        let mut last = None;
        for _ in 0..10 {
            last = Some(simulation.step().unwrap());
        }
        speeds.push(last.unwrap().momentum[0] / 1000.0);
    }
    speeds
}

#[test]
fn a_box_sticks_below_the_angle_of_friction_and_slides_above() {
    let theory = |degrees: f64| {
        let angle = degrees.to_radians();
        GRAVITY * (angle.sin() - 0.5 * angle.cos())
    };
    for degrees in [26.7, 27.0] {
        let speeds = slide(degrees, 2, 0.1);
        // The box rocks at first.
        let found = (speeds[19] - speeds[7]) / 1.2;
        assert!((found / theory(degrees) - 1.0).abs() < 0.01, "{degrees}: {found} {}", theory(degrees));
    }
    let speeds = slide(26.5, 2, 0.1);
    let found = (speeds[19] - speeds[7]) / 1.2;
    assert!((found / theory(26.5) - 1.0).abs() < 0.01, "{found} {}", theory(26.5));
    // From rest it creeps at the speed at which smooth friction carries it.
    let speeds = slide(26.0, 2, 0.0);
    let creep = 1e-3 * (1.0 - (1.0 - 26.0_f64.to_radians().tan() / 0.5).sqrt());
    assert!((speeds[19] / creep - 1.0).abs() < 0.02, "{} {creep}", speeds[19]);
}

fn colliding(options: &ContactOptions) -> Simulation {
    let soft = Material { young: 1e5, poisson: 0.3, density: 1000.0 };
    let mut bodies = Bodies::new();
    let (positions, tetrahedra) = tetrahedral_box(DVec3::ZERO, DVec3::ONE, [2, 2, 2]);
    let first = bodies.add_solid(&positions, &tetrahedra, soft).unwrap();
    let moved: Vec<DVec3> = positions.iter().map(|p| *p + DVec3::new(1.02, 0.3, 0.2)).collect();
    let second = bodies.add_solid(&moved, &tetrahedra, soft).unwrap();
    bodies.set_velocity(first, DVec3::new(1.0, 0.0, 0.0));
    bodies.set_velocity(second, DVec3::new(-1.0, 0.1, 0.0));
    Simulation::new(bodies, ContactOptions { gravity: DVec3::ZERO, ..options.clone() }).unwrap()
}

#[test]
fn a_collision_keeps_its_momentum() {
    for projection in [Projection::Normal, Projection::Exact] {
        for integrator in [Integrator::Euler, Integrator::Bdf2] {
            for pairs in [PairSet::Exclusive, PairSet::Plain] {
                let mut simulation =
                    colliding(&ContactOptions { projection, integrator, pairs, ..options(0.01) });
                let mut touched = false;
                for _ in 0..12 {
                    let step = simulation.step().unwrap();
                    touched |= step.pairs > 0;
                    let error = (DVec3::from_array(step.momentum) - DVec3::new(0.0, 100.0, 0.0)).length();
                    assert!(error < 1e-13 * 2000.0 * 10.0, "{error}");
                }
                assert!(touched);
            }
        }
    }
}

#[test]
fn the_same_bits_come_out_at_any_number_of_threads() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut simulation = colliding(&options(0.01));
            for _ in 0..4 {
                simulation.step().unwrap();
            }
            simulation.state()
        })
    };
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(8));
}

#[test]
fn a_state_goes_on_bit_for_bit() {
    let mut whole = colliding(&ContactOptions { integrator: Integrator::Bdf2, ..options(0.01) });
    let mut resumed = colliding(&ContactOptions { integrator: Integrator::Bdf2, ..options(0.01) });
    for _ in 0..3 {
        whole.step().unwrap();
    }
    resumed.set_state(&whole.state()).unwrap();
    for _ in 0..3 {
        assert_eq!(whole.step().unwrap(), resumed.step().unwrap());
    }
    assert_eq!(whole.state(), resumed.state());
}

/// The sideways part of the force on a box one corner of which is near the diagonal of a floor of two triangles.
fn sideways(pairs: PairSet) -> f64 {
    let mut bodies = Bodies::new();
    // The corner at the origin is 0.4 d̂ beside the diagonal y = x; the others are far from all inner edges.
    let corner = DVec3::new(0.004 * std::f64::consts::SQRT_2, 0.0, 0.005);
    unit_box(&mut bodies, corner, STIFF);
    let (positions, faces) = sheet(DVec3::new(-3.0, -3.0, 0.0), [DVec3::X * 6.0, DVec3::Y * 6.0], [1, 1]);
    bodies.add_fixed(&positions, &faces).unwrap();
    let stiffness = Some(stiffness(1000.0 * GRAVITY, 0.01));
    let options = ContactOptions { pairs, stiffness, ..options(0.01) };
    let mut simulation = Simulation::new(bodies, options).unwrap();
    let mut worst = 0.0_f64;
    for _ in 0..40 {
        let step = simulation.step().unwrap();
        worst = worst.max(step.support[0].hypot(step.support[1]) / step.support[2].abs().max(1.0));
    }
    worst
}

#[test]
fn inner_edges_of_a_floor_do_not_push_sideways() {
    let (exclusive, plain) = (sideways(PairSet::Exclusive), sideways(PairSet::Plain));
    assert!(exclusive < 1e-3, "{exclusive}");
    assert!(plain > 0.05, "{plain}");
}

#[test]
fn a_start_that_intersects_is_refused_with_the_faces_named() {
    let mut bodies = Bodies::new();
    unit_box(&mut bodies, DVec3::ZERO, STIFF);
    unit_box(&mut bodies, DVec3::new(0.5, 0.4, 0.3), STIFF);
    let error = Simulation::new(bodies, options(0.01)).unwrap_err();
    let ContactError::StartIntersects { pairs } = &error else { panic!("{error}") };
    assert!(!pairs.is_empty());
    assert!(error.to_string().starts_with("the start intersects: faces "), "{error}");

    let mut bodies = Bodies::new();
    unit_box(&mut bodies, DVec3::new(0.0, 0.0, -0.1), STIFF);
    bodies.add_obstacle(FLOOR).unwrap();
    let error = Simulation::new(bodies, options(0.01)).unwrap_err();
    assert!(matches!(error, ContactError::StartInside { obstacle: 0, .. }), "{error}");
}

#[test]
fn hostile_input_is_refused() {
    let mut bodies = Bodies::new();
    let x = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    assert!(matches!(
        bodies.add_solid(&x, &[[0, 1, 2, 4]], STIFF),
        Err(ContactError::NoVertex { vertex: 4, .. })
    ));
    assert!(matches!(bodies.add_solid(&x, &[[0, 2, 1, 3]], STIFF), Err(ContactError::Degenerate { .. })));
    assert!(matches!(bodies.add_shell(&x, &[[0, 0, 1]], STIFF, 0.1), Err(ContactError::Degenerate { .. })));
    let wrong = Material { poisson: 0.5, ..STIFF };
    assert!(matches!(bodies.add_solid(&x, &[[0, 1, 2, 3]], wrong), Err(ContactError::Parameter { .. })));
    let far = [DVec3::NAN; 4];
    assert!(matches!(bodies.add_fixed(&far, &[]), Err(ContactError::NonFinite { index: 0 })));
    assert!(matches!(Simulation::new(Bodies::new(), options(0.01)), Err(ContactError::NothingMoves)));
}
