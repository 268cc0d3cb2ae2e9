//! Exact solutions on the unit sphere.

use crate::{jittered_sphere, relative, sphere, values};
use pompeiu_core::mesh::VertexData;
use pompeiu_fluid::{Correction, Diffusion, FluidOptions, Integrator, Scheme, Simulation, ViscosityModel};
use pompeiu_operators::rotation_field;
use pompeiu_surface::EmbeddedSurface;
use std::f64::consts::{PI, TAU};

/// The two spherical harmonics of degree 3 and order 2, up to a factor.
fn pair(surface: &EmbeddedSurface) -> [VertexData<f64>; 2] {
    [values(surface, |[x, y, z]| (x * x - y * y) * z), values(surface, |[x, y, z]| 2.0 * x * y * z)]
}

/// The error of the drift of a Rossby–Haurwitz wave of degree 3 and order 2 on a rotation, in turns, and the relative error of the
/// energy.
fn rossby_haurwitz(surface: &EmbeddedSurface, options: FluidOptions, turns: f64, steps: usize) -> [f64; 2] {
    let [cosine, sine] = pair(surface);
    // Degree l drifts at α (1 − 2 / (l (l + 1))).
    let speed = 1.0 - 2.0 / 12.0;
    let dt = turns * TAU / speed / steps as f64;
    let options = FluidOptions { time_step: pompeiu_fluid::TimeStep::Fixed(dt), ..options };
    let mut fluid = Simulation::new(surface.surface(), options).unwrap();
    let zonal = values(surface, |[_, _, z]| 2.0 * z);
    let vorticity = VertexData::from_fn(zonal.len(), |v| zonal[v] + 0.5 * cosine[v]);
    fluid.set_vorticity(&vorticity, &[]).unwrap();
    let before = fluid.measure().unwrap();
    for _ in 0..steps {
        let step = fluid.step().unwrap();
        assert!(step.total_vorticity.abs() < 1e-12 && step.divergence < 1e-12, "{step:?}");
    }
    let state = fluid.state();
    let areas = surface.surface().vertex_areas();
    let along = |wave: &VertexData<f64>| -> f64 {
        wave.iter().zip(&state.vorticity).zip(&areas).map(|((y, w), a)| a * y * w).sum()
    };
    let phase = along(&sine).atan2(along(&cosine)) / 2.0;
    let expected = (turns * TAU + PI / 2.0).rem_euclid(PI) - PI / 2.0;
    let drift = (phase - expected + PI / 2.0).rem_euclid(PI) - PI / 2.0;
    [drift.abs() / TAU, relative(fluid.measure().unwrap().energy, before.energy)]
}

#[test]
fn a_rossby_haurwitz_wave_travels_at_its_speed() {
    let [coarse, fine] = [2, 3].map(|n| rossby_haurwitz(&sphere(n), FluidOptions::new(1.0), 0.5, 30 << n));
    assert!(fine[0] < 6e-4 && fine[0] < 0.35 * coarse[0], "{coarse:?} {fine:?}");
    assert!(fine[1] < 1e-6, "{fine:?}");
    let jittered = rossby_haurwitz(&jittered_sphere(3, 0.25), FluidOptions::new(1.0), 0.5, 240);
    assert!(jittered[0] < 2e-3 && jittered[1] < 1e-6, "{jittered:?}");
}

#[test]
fn the_scheme_for_any_step_is_near_it_and_stable_at_long_steps() {
    let options = FluidOptions { scheme: Scheme::AnyStep, ..FluidOptions::new(1.0) };
    let found = rossby_haurwitz(&sphere(4), options.clone(), 0.25, 40);
    assert!(found[0] < 2.5e-3 && found[1] < 0.02, "{found:?}");
    let [_, energy] = rossby_haurwitz(&sphere(3), options, 4.0, 8);
    assert!(energy < 1.0, "{energy}");
}

#[test]
fn velocities_on_faces_lose_energy_and_corrections_give_most_of_it_back() {
    let faces = |correction| FluidOptions { scheme: Scheme::Faces, correction, ..FluidOptions::new(1.0) };
    let [linear, corrected, compensated] =
        Correction::ALL.map(|correction| rossby_haurwitz(&sphere(4), faces(correction), 0.25, 20));
    assert!(0.02 < linear[1] && linear[0] < 0.05, "{linear:?}");
    for found in [corrected, compensated] {
        assert!(found[0] < 2e-3 && found[1] < 0.02, "{found:?}");
    }
}

#[test]
fn with_the_lengths_of_edges_for_weights_viscosity_depends_on_the_mesh() {
    // (1 + ν Δt λ)^-1 with λ = 1 for rotations, if it were a Laplacian.
    let kept = |n: u32, viscosity: f64| {
        let sphere = sphere(n);
        let options = FluidOptions {
            scheme: Scheme::Faces,
            correction: Correction::Linear,
            diffusion: Diffusion::EdgeLength,
            viscosity,
            ..FluidOptions::new(1.0)
        };
        let mut fluid = Simulation::new(sphere.surface(), options).unwrap();
        fluid.set_velocity(&rotation_field(&sphere, [0.0, 0.0, 1e-9])).unwrap();
        let before = fluid.measure().unwrap().energy;
        (fluid.step().unwrap().energy / before).sqrt()
    };
    // Two interpolations per step lose energy even at rest.
    let rates = [2, 3, 4].map(|n| (kept(n, 0.0) / kept(n, 0.1) - 1.0) / 0.1);
    for (found, expected) in rates.into_iter().zip([0.177, 0.088, 0.044]) {
        assert!(relative(found, expected) < 0.03, "{rates:?}");
    }
}

#[test]
fn the_implicit_midpoint_rule_agrees() {
    let options = FluidOptions { integrator: Integrator::ImplicitMidpoint, ..FluidOptions::new(1.0) };
    let found = rossby_haurwitz(&sphere(2), options, 0.25, 60);
    assert!(found[0] < 4e-3 && found[1] < 1e-13, "{found:?}");
}

/// The decay rate of a vorticity's amplitude, by one step of backward Euler, relative to the viscosity.
fn rate(
    surface: &EmbeddedSurface,
    scheme: Scheme,
    model: ViscosityModel,
    shape: impl Fn([f64; 3]) -> f64,
) -> f64 {
    let product = 0.05;
    let options =
        FluidOptions { scheme, viscosity: product, viscosity_model: model, ..FluidOptions::new(1.0) };
    let mut fluid = Simulation::new(surface.surface(), options).unwrap();
    let vorticity = values(surface, shape);
    // So slow that advection is negligible.
    let faint = VertexData::from_fn(vorticity.len(), |v| 1e-9 * vorticity[v]);
    fluid.set_vorticity(&faint, &[]).unwrap();
    let before = fluid.state().stream.clone();
    fluid.step().unwrap();
    let dot = |a: &VertexData<f64>| -> f64 { a.iter().zip(&before).map(|(x, y)| x * y).sum() };
    (dot(&before) / dot(&fluid.state().stream) - 1.0) / product
}

#[test]
fn three_viscosities_decay_at_their_rates() {
    type Shape = fn([f64; 3]) -> f64;
    let shapes: [(f64, Shape); 3] = [
        (1.0, |[x, _, z]| x + 0.3 * z),
        (2.0, |[x, y, z]| x * y + 0.5 * (y * y - z * z)),
        (3.0, |[x, y, z]| (x * x - y * y) * z + x * y * z),
    ];
    let models =
        [(ViscosityModel::Hodge, 0.0), (ViscosityModel::Bochner, 1.0), (ViscosityModel::Physical, 2.0)];
    for surface in [sphere(4), jittered_sphere(4, 0.25)] {
        for (l, shape) in shapes {
            for (model, less) in models {
                for scheme in [Scheme::Vorticity, Scheme::CrouzeixRaviart] {
                    let (found, expected) = (rate(&surface, scheme, model, shape), l * (l + 1.0) - less);
                    let error = (found - expected).abs();
                    assert!(
                        error < 0.01 * expected.max(1.0),
                        "{scheme:?}, {model:?}, degree {l}: {found} {expected}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_rigid_rotation_does_not_slow_down_and_energy_does_not_rise() {
    for surface in [sphere(3), jittered_sphere(3, 0.25)] {
        let schemes = [Scheme::Vorticity, Scheme::CrouzeixRaviart];
        for (model, scheme) in ViscosityModel::ALL.into_iter().flat_map(|m| schemes.map(|s| (m, s))) {
            let options =
                FluidOptions { scheme, viscosity: 1.0, viscosity_model: model, ..FluidOptions::new(0.05) };
            let mut fluid = Simulation::new(surface.surface(), options).unwrap();
            fluid.set_velocity(&rotation_field(&surface, [0.3, 0.0, 0.1])).unwrap();
            let before = fluid.measure().unwrap().energy;
            let mut last = before;
            for _ in 0..20 {
                let energy = fluid.step().unwrap().energy;
                assert!(energy <= last * (1.0 + 1e-14), "{model:?}: {last} {energy}");
                last = energy;
            }
            let kept = (last / before).sqrt();
            match model {
                ViscosityModel::Physical => assert!((kept - 1.0).abs() < 0.005, "{kept}"),
                // (1 + 0.05 λ)^-20 with λ = 1 and 2.
                ViscosityModel::Bochner => assert!(relative(kept, 1.05_f64.powi(-20)) < 0.02, "{kept}"),
                ViscosityModel::Hodge => assert!(relative(kept, 1.1_f64.powi(-20)) < 0.02, "{kept}"),
            }
        }
    }
}

#[test]
fn antipodal_vortices_stay() {
    let surface = sphere(4);
    let mut fluid = Simulation::new(surface.surface(), FluidOptions::new(0.02)).unwrap();
    // Centred on the y axis, where no vertex pattern favours them.
    let axis = [0.36, 0.48, 0.8];
    let along = |p: [f64; 3]| (0..3).map(|i| p[i] * axis[i]).sum::<f64>();
    let vorticity = values(&surface, |p| {
        let s = along(p);
        3.0 * ((-(1.0 - s) / 0.05).exp() - (-(1.0 + s) / 0.05).exp())
    });
    fluid.set_vorticity(&vorticity, &[]).unwrap();
    for _ in 0..50 {
        fluid.step().unwrap();
    }
    let areas = surface.surface().vertex_areas();
    let mut centre = [0.0; 3];
    for (v, w) in fluid.state().vorticity.entries().filter(|(v, _)| along(surface.positions()[*v]) > 0.0) {
        for i in 0..3 {
            centre[i] += areas[v] * w * surface.positions()[v][i];
        }
    }
    let length = centre.iter().map(|x| x * x).sum::<f64>().sqrt();
    let sine = 1.0 - (along(centre) / length).powi(2);
    assert!(sine.max(0.0).sqrt() < 2e-3, "{centre:?}");
}
