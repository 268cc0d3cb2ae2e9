//! Surfaces with handles: harmonic fields have their own dynamics.

use crate::{surface, values};
use pompeiu_core::mesh::VertexData;
use pompeiu_core::mesh::shapes::{perforated_plate, torus};
use pompeiu_core::mesh::subdivide;
use pompeiu_fluid::{FluidOptions, Integrator, Simulation, ViscosityModel};
use pompeiu_operators::{FaceField, difference, field_norm};
use pompeiu_surface::plane::quarter_turn;
use pompeiu_surface::{EmbeddedSurface, flat_torus};

#[test]
fn a_constant_field_on_the_flat_torus_is_a_fixed_point() {
    let torus = flat_torus([2.0, 1.0], [12, 7]).unwrap();
    let options = FluidOptions { viscosity: 0.1, ..FluidOptions::new(0.05) };
    let mut fluid = Simulation::new(&torus, options).unwrap();
    // The frames of odd faces are rotated by half a turn.
    let field =
        FaceField::from_fn(torus.mesh().faces(), |f| if f.0 % 2 == 0 { [0.8, 0.3] } else { [-0.8, -0.3] });
    fluid.set_velocity(&field).unwrap();
    for _ in 0..1000 {
        fluid.step().unwrap();
    }
    let error = field_norm(&torus, &difference(&fluid.state().velocity, &field));
    assert!(error < 1e-12, "{error:e}");
    assert_eq!(fluid.state().harmonic.len(), 2);
}

/// A vorticity with some structure.
fn some_vorticity(surface: &EmbeddedSurface) -> VertexData<f64> {
    values(surface, |[x, y, z]| (3.0 * x + y).sin() + (2.0 * y - z).cos() * x)
}

#[test]
fn energy_and_enstrophy_are_conserved_and_harmonic_parts_move() {
    let plate = surface(&subdivide(&perforated_plate(1.0, 2).unwrap()).unwrap());
    let options = FluidOptions { integrator: Integrator::ImplicitMidpoint, ..FluidOptions::new(0.1) };
    let mut fluid = Simulation::new(plate.surface(), options).unwrap();
    fluid.set_vorticity(&some_vorticity(&plate), &[1.0, -0.5, 0.3, 0.2]).unwrap();
    let first = fluid.measure().unwrap();
    let mut last = first.clone();
    for _ in 0..15 {
        last = fluid.step().unwrap();
    }
    let change = |a: f64, b: f64| (a / b - 1.0).abs();
    assert!(change(last.energy, first.energy) < 1e-12, "{first:?} {last:?}");
    assert!(change(last.enstrophy, first.enstrophy) < 1e-12, "{first:?} {last:?}");
    assert!(last.total_vorticity.abs() < 1e-12 && last.divergence < 1e-12);
    let moved = last.harmonic.iter().zip(&first.harmonic).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(moved > 0.01, "{:?} {:?}", first.harmonic, last.harmonic);
}

/// A zonal flow with speed f(ρ) on a torus of revolution, on faces.
fn zonal(surface: &EmbeddedSurface, f: impl Fn(f64, f64) -> f64) -> FaceField {
    FaceField::from_fn(surface.mesh().faces(), |face| {
        let [x, y, z] = surface.centroid(face);
        let rho = x.hypot(y);
        let speed = f(rho, z);
        surface.to_tangent(face, [-speed * y / rho, speed * x / rho, 0.0])
    })
}

#[test]
fn zonal_flows_that_depend_on_the_distance_from_the_axis_are_steady() {
    let errors = [1, 2].map(|n: u32| {
        let torus = surface(&torus(1.0, 0.4, 24 * n, 12 * n).unwrap());
        let mut fluid = Simulation::new(torus.surface(), FluidOptions::new(0.05)).unwrap();
        let field = zonal(&torus, |rho, _| 1.0 / (rho * rho) + rho);
        fluid.set_velocity(&field).unwrap();
        let start = fluid.state().velocity.clone();
        for _ in 0..20 {
            fluid.step().unwrap();
        }
        let difference = difference(&fluid.state().velocity, &start);
        field_norm(torus.surface(), &difference) / field_norm(torus.surface(), &start)
    });
    assert!(errors[0] < 0.05 && errors[1] < 0.4 * errors[0], "{errors:?}");
}

#[test]
fn harmonic_coefficients_change_as_the_integral_says() {
    // For u = f e_φ on a torus of revolution: c' = −∫ ω (J u)·h with the harmonic field h along the tube, |h| ∝ 1/ρ.
    let (big, small) = (1.0, 0.4);
    let f = |rho: f64, z: f64| rho * (1.0 + 2.0 * z);
    let errors = [1, 2].map(|n: u32| {
        let mesh = torus(big, small, 32 * n, 16 * n).unwrap();
        let surface = surface(&mesh);
        // The axis of revolution is the axis of least extent.
        let step = 1e-4;
        let mut fluid = Simulation::new(surface.surface(), FluidOptions::new(step)).unwrap();
        fluid.set_velocity(&zonal(&surface, f)).unwrap();
        // The harmonic field along the tube is e_θ / ρ, normalised.
        let along = FaceField::from_fn(surface.mesh().faces(), |face| {
            let [x, y, _] = surface.centroid(face);
            let rho = x.hypot(y);
            let around = surface.to_tangent(face, [-y / rho, x / rho, 0.0]);
            quarter_turn(around).map(|c| c / rho)
        });
        let along_norm = field_norm(surface.surface(), &along);
        let coefficient = |velocity: &FaceField| {
            pompeiu_operators::field_inner_product(surface.surface(), velocity, &along) / along_norm
        };
        let before = coefficient(&fluid.state().velocity);
        fluid.step().unwrap();
        let found = (coefficient(&fluid.state().velocity) - before) / step;
        // With θ along the tube, ρ = R + r cos θ, z = r sin θ, e_θ = (−sin θ, cos θ): a quarter turn of e_φ is −e_θ or e_θ by the
        // orientation; signs cancel in ω (J u)·h up to that of h. ω = (ρ f)_θ / (r ρ) up to the same sign.
        let count = 20_000;
        let (mut integral, mut norm) = (0.0, 0.0);
        for i in 0..count {
            let theta = std::f64::consts::TAU * f64::from(i) / f64::from(count);
            let at = |t: f64| (big + small * t.cos(), small * t.sin());
            let (rho, z) = at(theta);
            let moment = |t: f64| {
                let (rho, z) = at(t);
                rho * f(rho, z)
            };
            let slope = (moment(theta + 1e-5) - moment(theta - 1e-5)) / 2e-5;
            let vorticity = slope / (small * rho);
            let area = std::f64::consts::TAU * rho * small * std::f64::consts::TAU / f64::from(count);
            integral += vorticity * f(rho, z) / rho * area;
            norm += area / (rho * rho);
        }
        let expected = integral / norm.sqrt();
        (found.abs() - expected.abs()).abs() / expected.abs()
    });
    assert!(errors[0] < 0.05 && errors[1] < 0.35 * errors[0], "{errors:?}");
}

#[test]
fn a_rotation_of_a_torus_is_kept_by_physical_viscosity_only() {
    let surface = surface(&torus(1.0, 0.4, 48, 24).unwrap());
    let kept = ViscosityModel::ALL.map(|model| {
        let options = FluidOptions { viscosity: 1.0, viscosity_model: model, ..FluidOptions::new(0.05) };
        let mut fluid = Simulation::new(surface.surface(), options).unwrap();
        fluid.set_velocity(&zonal(&surface, |rho, _| 0.1 * rho)).unwrap();
        let before = fluid.measure().unwrap().energy;
        for _ in 0..20 {
            fluid.step().unwrap();
        }
        (fluid.measure().unwrap().energy / before).sqrt()
    });
    let [hodge, bochner, physical] = kept;
    assert!((physical - 1.0).abs() < 0.01 && bochner < 0.9 && hodge < 0.95, "{kept:?}");
}
