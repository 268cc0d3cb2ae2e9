//! Cloth and rods in contact with themselves: an exact test at every step.

use glam::DVec3;
use pompeiu_contact::shapes::{sheet, tetrahedral_box};
use pompeiu_contact::{
    Bodies, ContactOptions, Handle, HandleMotion, Material, Obstacle, PairSet, Simulation,
};
use std::f64::consts::TAU;

const CLOTH: Material = Material { young: 1e5, poisson: 0.3, density: 300.0 };

/// Runs so many steps; Newton iterations in all, the end, and the most pairs.
fn run(name: &str, mut simulation: Simulation, steps: usize) -> (usize, Simulation, usize) {
    let (mut iterations, mut pairs) = (0, 0);
    for _ in 0..steps {
        let step = simulation.step().unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(step.intersections, Some(0));
        iterations += step.iterations;
        pairs = pairs.max(step.pairs);
    }
    (iterations, simulation, pairs)
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
        let (.., most) = run(&format!("drape {pairs:?}"), drape(pairs), 25);
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
            let motion = HandleMotion::Rotate {
                through: DVec3::ZERO,
                about: DVec3::X,
                speed: speed * 0.5 * TAU,
                velocity: DVec3::ZERO,
            };
            bodies.add_handle(Handle::new((j * (n + 1) + i) as u32, motion)).unwrap();
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
    let (.., most) = run("cloth twist", cloth_twist(), 30);
    assert!(most > 20, "{most}");
}

/// A rod whose ends turn against each other so often in three units of time, and come nearer.
fn rod_twist(turns: f64) -> Simulation {
    let mut bodies = Bodies::new();
    let (low, high) = (DVec3::new(-0.5, -0.02, -0.02), DVec3::new(0.5, 0.02, 0.02));
    let (positions, tetrahedra) = tetrahedral_box(low, high, [28, 1, 1]);
    let rubber = Material { young: 1e5, poisson: 0.4, density: 1000.0 };
    bodies.add_solid(&positions, &tetrahedra, rubber).unwrap();
    for (vertex, p) in positions.iter().enumerate().filter(|(_, p)| p.x.abs() > 0.42) {
        let motion = HandleMotion::Rotate {
            through: DVec3::ZERO,
            about: DVec3::X,
            speed: -p.x.signum() * 0.5 * turns * TAU / 3.0,
            velocity: DVec3::X * (-p.x.signum() * 0.5 * 0.4 / 3.0),
        };
        bodies.add_handle(Handle { stiffness: 1e6, ..Handle::new(vertex as u32, motion) }).unwrap();
    }
    let options = ContactOptions {
        gravity: DVec3::ZERO,
        distance: 0.005,
        tolerance: 1e-2,
        ..ContactOptions::new(0.05, 1.0)
    };
    Simulation::new(bodies, options).unwrap()
}

#[test]
fn a_rod_winds_about_itself() {
    let simulation = rod_twist(4.0);
    let rest = simulation.positions().to_vec();
    let (iterations, simulation, _) = run("rod twist", simulation, 60);
    assert!(iterations < 60 * 20, "{iterations}");
    // Pairs of points that are an eighth of the rod or more apart along it.
    let far = |v: [u32; 4]| (rest[v[0] as usize].x - rest[v[3] as usize].x).abs() > 0.125;
    let touching =
        simulation.contact_pairs().iter().filter(|pair| pair.kind.count() == 4 && far(pair.vertices)).count();
    assert!(touching > 5, "{touching}");
}
