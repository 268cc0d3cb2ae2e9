//! Cloth and rods in contact with themselves: an exact test at every step.

use glam::DVec3;
use pompeiu_contact::shapes::{sheet, tetrahedral_box};
use pompeiu_contact::{
    Bodies, ContactOptions, Handle, HandleMotion, Material, Obstacle, PairSet, Simulation,
};
use std::f64::consts::TAU;

const CLOTH: Material = Material { young: 1e5, poisson: 0.3, density: 300.0 };

/// Runs so many steps; Newton iterations in all, and the most pairs.
fn run(name: &str, mut simulation: Simulation, steps: usize) -> (usize, usize) {
    let (mut iterations, mut pairs) = (0, 0);
    for _ in 0..steps {
        let step = simulation.step().unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(step.intersections, Some(0));
        iterations += step.iterations;
        pairs = pairs.max(step.pairs);
    }
    (iterations, pairs)
}

fn drape(pairs: PairSet) -> Simulation {
    let mut bodies = Bodies::new();
    let (positions, faces) = sheet(DVec3::new(-0.5, -0.5, 0.32), [DVec3::X, DVec3::Y], [10, 10]);
    bodies.add_shell(&positions, &faces, CLOTH, 1e-3).unwrap();
    bodies.add_obstacle(Obstacle::Ball { centre: DVec3::ZERO, radius: 0.3 }).unwrap();
    let options = ContactOptions {
        friction: 0.2,
        distance: 0.01,
        tolerance: 1e-2,
        pairs,
        ..ContactOptions::new(0.02, 1.0)
    };
    Simulation::new(bodies, options).unwrap()
}

#[test]
fn cloth_drapes_over_a_ball() {
    for pairs in [PairSet::Exclusive, PairSet::Plain] {
        let (_, most) = run(&format!("drape {pairs:?}"), drape(pairs), 25);
        assert!(most > 20, "{most}");
    }
}

fn cloth_twist() -> Simulation {
    let mut bodies = Bodies::new();
    let n = 8;
    let (positions, faces) = sheet(DVec3::new(-0.5, -0.25, 0.0), [DVec3::X, DVec3::Y * 0.5], [n, n]);
    bodies.add_shell(&positions, &faces, CLOTH, 1e-3).unwrap();
    for j in 0..=n {
        for (i, speed) in [(0, 1.0), (n, -1.0)] {
            let motion =
                HandleMotion::Rotate { through: DVec3::ZERO, about: DVec3::X, speed: speed * 0.5 * TAU };
            bodies.add_handle(Handle { vertex: (j * (n + 1) + i) as u32, motion }).unwrap();
        }
    }
    let options = ContactOptions {
        gravity: DVec3::ZERO,
        distance: 0.005,
        tolerance: 1e-2,
        ..ContactOptions::new(0.04, 1.0)
    };
    Simulation::new(bodies, options).unwrap()
}

#[test]
fn cloth_is_twisted() {
    let (_, most) = run("cloth twist", cloth_twist(), 30);
    assert!(most > 20, "{most}");
}

fn rod_twist() -> Simulation {
    let mut bodies = Bodies::new();
    let (low, high) = (DVec3::new(-0.5, -0.06, -0.06), DVec3::new(0.5, 0.06, 0.06));
    let cells = [12, 1, 1];
    let (positions, tetrahedra) = tetrahedral_box(low, high, cells);
    let rubber = Material { young: 1e5, poisson: 0.4, density: 1000.0 };
    bodies.add_solid(&positions, &tetrahedra, rubber).unwrap();
    for (vertex, p) in positions.iter().enumerate() {
        let speed = if p.x < -0.499 {
            1.0
        } else if p.x > 0.499 {
            -1.0
        } else {
            continue;
        };
        let motion = HandleMotion::Rotate { through: DVec3::ZERO, about: DVec3::X, speed: speed * 1.0 * TAU };
        bodies.add_handle(Handle { vertex: vertex as u32, motion }).unwrap();
    }
    let options = ContactOptions {
        gravity: DVec3::ZERO,
        distance: 0.02,
        tolerance: 1e-2,
        ..ContactOptions::new(0.05, 1.0)
    };
    Simulation::new(bodies, options).unwrap()
}

#[test]
fn a_rod_is_twisted() {
    // Two turns in a unit of time: two and a half.
    let (iterations, _) = run("rod twist", rod_twist(), 25);
    assert!(iterations < 25 * 20, "{iterations}");
}
