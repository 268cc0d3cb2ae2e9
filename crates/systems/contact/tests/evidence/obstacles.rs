//! Obstacles with meshes, which stay or move: they arrive where they go, and nothing passes through them.

use glam::DVec3;
use pompeiu_contact::shapes::{sheet, tetrahedral_box};
use pompeiu_contact::{
    Bodies, ContactError, ContactOptions, HandleMotion, Integrator, Material, PairSet, Simulation,
};
use std::f64::consts::TAU;
use std::ops::Range;

const RUBBER: Material = Material { young: 1e5, poisson: 0.3, density: 1000.0 };

/// A plate of two or more triangles across z.
fn plate(bodies: &mut Bodies, height: f64, cells: usize, motion: Option<HandleMotion>) -> Range<usize> {
    let corner = DVec3::new(-1.0, -1.0, height);
    let (positions, faces) = sheet(corner, [DVec3::X * 2.0, DVec3::Y * 2.0], [cells; 2]);
    match motion {
        Some(motion) => bodies.add_moving(&positions, &faces, motion).unwrap(),
        None => bodies.add_fixed(&positions, &faces).unwrap(),
    }
}

fn cube(bodies: &mut Bodies, low: f64) -> Range<usize> {
    let low = DVec3::new(-0.25, -0.25, low);
    let (positions, tetrahedra) = tetrahedral_box(low, low + DVec3::splat(0.5), [2; 3]);
    bodies.add_solid(&positions, &tetrahedra, RUBBER).unwrap()
}

fn options(time_step: f64) -> ContactOptions {
    ContactOptions {
        gravity: DVec3::ZERO,
        distance: 0.01,
        tolerance: 1e-3,
        ..ContactOptions::new(time_step, 1.0)
    }
}

/// The least and the greatest height of vertices.
fn heights(simulation: &Simulation, range: Range<usize>) -> [f64; 2] {
    let of = simulation.positions()[range].iter().map(|p| p.z);
    of.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)])
}

#[test]
fn a_plate_that_moves_squeezes_a_cube_and_arrives() {
    // It goes two distances of contact in a step, and at the end the cube is pressed to two thirds of its height.
    for pairs in [PairSet::Exclusive, PairSet::Plain] {
        let mut bodies = Bodies::new();
        let squeezed = cube(&mut bodies, 0.02);
        plate(&mut bodies, 0.0, 1, None);
        let moving = plate(&mut bodies, 0.55, 3, Some(HandleMotion::Translate(DVec3::Z * -1.0)));
        let mut simulation = Simulation::new(bodies, ContactOptions { pairs, ..options(0.02) }).unwrap();
        for step in 1..=10 {
            let found = simulation.step().unwrap();
            assert_eq!(found.intersections, Some(0));
            let [low, high] = heights(&simulation, moving.clone());
            let expected = 0.55 - 0.02 * f64::from(step);
            // What is left of the way in a step is not more than the tolerance times its length.
            assert!((low - expected).abs() < 3e-5 && (high - expected).abs() < 3e-5, "{low} {expected}");
            let [below, above] = heights(&simulation, squeezed.clone());
            assert!(below > 0.0 && above < low, "{below} {above} {low}");
        }
    }
}

#[test]
fn a_plate_a_hundred_distances_of_contact_a_step_takes_a_cube_along() {
    for integrator in [Integrator::Euler, Integrator::Bdf2] {
        let mut bodies = Bodies::new();
        let taken = cube(&mut bodies, 0.05);
        plate(&mut bodies, 0.0, 2, Some(HandleMotion::Translate(DVec3::Z * 10.0)));
        let options = ContactOptions { distance: 1e-3, integrator, ..options(0.01) };
        let mut simulation = Simulation::new(bodies, options).unwrap();
        for _ in 0..6 {
            assert_eq!(simulation.step().unwrap().intersections, Some(0));
        }
        let [low, _] = heights(&simulation, taken);
        assert!(low > 0.6, "{low}");
    }
}

#[test]
fn a_plate_that_turns_and_rubs_takes_a_cube_round() {
    let mut bodies = Bodies::new();
    let carried = cube(&mut bodies, 0.005);
    let motion = HandleMotion::Rotate {
        through: DVec3::ZERO,
        about: DVec3::Z,
        speed: TAU / 8.0,
        velocity: DVec3::ZERO,
    };
    plate(&mut bodies, 0.0, 2, Some(motion));
    let gravity = DVec3::new(0.0, 0.0, -9.81);
    let options = ContactOptions { friction: 0.8, gravity, ..options(0.02) };
    let mut simulation = Simulation::new(bodies, options).unwrap();
    let arm = |simulation: &Simulation| {
        let corners = &simulation.positions()[carried.clone()];
        (corners[2] - corners[0]).truncate()
    };
    let before = arm(&simulation);
    for _ in 0..50 {
        assert_eq!(simulation.step().unwrap().intersections, Some(0));
    }
    let turned = before.angle_to(arm(&simulation));
    // An eighth of a turn in a unit of time, less what it slides before it sticks.
    assert!((turned / (TAU / 8.0) - 1.0).abs() < 0.1, "{turned}");
}

#[test]
fn obstacles_that_run_into_each_other_are_named_and_the_state_stays() {
    let mut bodies = Bodies::new();
    cube(&mut bodies, 1.0);
    plate(&mut bodies, 0.0, 1, None);
    let about = HandleMotion::Rotate {
        through: DVec3::new(0.0, 0.0, 0.5),
        about: DVec3::X,
        speed: TAU,
        velocity: DVec3::ZERO,
    };
    plate(&mut bodies, 0.5, 2, Some(about));
    let mut simulation = Simulation::new(bodies, options(0.05)).unwrap();
    let mut last = simulation.state();
    let error = loop {
        match simulation.step() {
            Ok(_) => last = simulation.state(),
            Err(error) => break error,
        }
    };
    assert!(matches!(error, ContactError::ObstaclesMeet { .. }), "{error}");
    assert_eq!(simulation.state(), last);
}

#[test]
fn surfaces_that_start_nearly_touching_come_apart() {
    // Newton steps away from a barrier are as short as the gap, far below the tolerance, and the force is not in balance yet.
    for gap in [1e-3, 1e-6, 1e-9, 1e-12] {
        let mut bodies = Bodies::new();
        plate(&mut bodies, 0.0, 3, None);
        let sides = [DVec3::new(1.0, 0.2, 0.0), DVec3::Y];
        let (positions, faces) = sheet(DVec3::new(-0.5, -0.4, gap), sides, [6; 2]);
        bodies.add_shell(&positions, &faces, RUBBER, 1e-3).unwrap();
        let options = ContactOptions { gravity: DVec3::new(0.0, 0.0, -9.81), ..options(0.01) };
        let simulation = Simulation::new(bodies, options);
        if gap < 1e-10 {
            let error = simulation.err().unwrap();
            assert!(
                matches!(error, ContactError::StartTooClose { gap: found, .. } if (found / gap - 1.0).abs() < 1e-6),
                "{error}"
            );
            continue;
        }
        let step = simulation.unwrap().step().unwrap();
        assert_eq!(step.intersections, Some(0));
        assert!(step.least_gap.unwrap_or(0.01) > 1e-4, "{gap}: {step:?}");
    }
}
