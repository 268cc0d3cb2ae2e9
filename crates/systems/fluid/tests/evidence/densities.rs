//! Densities: masses, bounds, diffusion rates.

use crate::{jittered_sphere, relative, sphere, surface, values};
use pompeiu_core::VertexId;
use pompeiu_core::mesh::VertexData;
use pompeiu_core::mesh::shapes::{Diagonal, grid};
use pompeiu_fluid::{
    Correction, Density, Diffusion, FluidOptions, Scheme, Simulation, Transport, tangential,
};
use pompeiu_operators::rotation_field;
use pompeiu_surface::EmbeddedSurface;

/// A disc of ones around a point.
fn disc(surface: &EmbeddedSurface) -> VertexData<f64> {
    values(surface, |[x, y, z]| {
        let away = (x - 0.6).hypot(y - 0.8).hypot(z);
        f64::from(u8::from(away < 0.4))
    })
}

#[test]
fn corrected_fluxes_keep_mass_and_bounds() {
    for surface in [sphere(3), jittered_sphere(3, 0.3)] {
        let options =
            FluidOptions { densities: vec![Density::new("dye", disc(&surface))], ..FluidOptions::new(0.1) };
        let mut fluid = Simulation::new(surface.surface(), options).unwrap();
        fluid.set_velocity(&rotation_field(&surface, [0.2, 0.7, 1.0])).unwrap();
        let before = fluid.measure().unwrap();
        for _ in 0..100 {
            let step = fluid.step().unwrap();
            assert!(relative(step.mass[0], before.mass[0]) < 1e-12, "{step:?}");
            let [least, most] = step.range[0];
            assert!(least > -1e-15 && most < 1.0 + 1e-14, "{step:?}");
        }
    }
}

#[test]
fn traced_densities_stay_within_bounds_and_the_correction_restores_mass() {
    let surface = jittered_sphere(3, 0.25);
    let run = |transport: Transport| {
        let densities = vec![Density::new("dye", disc(&surface))];
        let options = FluidOptions { densities, transport, ..FluidOptions::new(0.1) };
        let mut fluid = Simulation::new(surface.surface(), options).unwrap();
        fluid.set_velocity(&rotation_field(&surface, [0.2, 0.7, 1.0])).unwrap();
        let before = fluid.measure().unwrap().mass[0];
        let mut drift: f64 = 0.0;
        for _ in 0..40 {
            let step = fluid.step().unwrap();
            drift = drift.max(relative(step.mass[0], before));
            assert!(step.range[0][0] > -1e-14 && step.range[0][1] < 1.0 + 1e-14, "{step:?}");
        }
        drift
    };
    assert!(run(Transport::SemiLagrangian) > 1e-4);
    assert!(run(Transport::SemiLagrangianCorrected) < 1e-12);
}

#[test]
fn a_turning_blob_arrives() {
    // Half a turn about the axis of z takes x and y to −x and −y.
    let surface = sphere(3);
    let blob = |sign: f64| {
        values(&surface, |[x, y, z]| {
            (-4.0 * ((sign * x - 0.6).powi(2) + (sign * y - 0.8).powi(2) + z * z)).exp()
        })
    };
    let (start, end) = (blob(1.0), blob(-1.0));
    let (linear, corrected, bfecc) = (Correction::Linear, Correction::MacCormack, Correction::Bfecc);
    for (transport, correction, bound) in [
        (Transport::FluxCorrected, corrected, 0.25),
        (Transport::SemiLagrangian, corrected, 0.2),
        (Transport::SemiLagrangian, bfecc, 0.2),
        (Transport::Faces, corrected, 0.35),
        (Transport::Faces, bfecc, 0.35),
        // Two interpolations per step add diffusion.
        (Transport::Faces, linear, 0.8),
    ] {
        let densities = vec![Density::new("dye", start.clone())];
        let dt = std::f64::consts::PI / 30.0;
        let options = FluidOptions { densities, transport, correction, ..FluidOptions::new(dt) };
        let mut fluid = Simulation::new(surface.surface(), options).unwrap();
        fluid.set_velocity(&rotation_field(&surface, [0.0, 0.0, 1.0])).unwrap();
        for _ in 0..30 {
            fluid.step().unwrap();
        }
        let areas = surface.surface().vertex_areas();
        let weighed = |f: &dyn Fn(VertexId) -> f64| -> f64 { end.ids().map(|v| areas[v] * f(v)).sum() };
        let error = weighed(&|v| (fluid.state().densities[0][v] - end[v]).abs()) / weighed(&|v| end[v]);
        assert!(error < bound, "{transport:?}, {correction:?}: {error}");
        assert!(correction != linear || error > 0.3, "{error}");
    }
}

#[test]
fn heat_decays_at_the_rates_of_backward_euler() {
    let surface = sphere(3);
    // On an icosphere with lumped masses x is an eigenvector to rounding, because all of its symmetries are present.
    let shape = values(&surface, |[x, _, _]| x);
    let laplacian = pompeiu_operators::cotan_laplacian(surface.surface()).unwrap();
    let areas = surface.surface().vertex_areas();
    let lx = laplacian.multiply(&shape);
    let inner = |a: &[f64]| -> f64 { a.iter().zip(&shape).map(|(x, y)| x * y).sum() };
    let mass: Vec<f64> = shape.iter().zip(&areas).map(|(x, a)| a * x).collect();
    let eigenvalue = inner(&lx) / inner(&mass);
    assert!(relative(eigenvalue, 2.0) < 1e-3, "{eigenvalue}");
    let mut density = Density::new("temperature", shape.clone());
    density.diffusivity = 0.3;
    let options = FluidOptions { densities: vec![density], ..FluidOptions::new(0.25) };
    let mut fluid = Simulation::new(surface.surface(), options).unwrap();
    fluid.step().unwrap();
    let after = &fluid.state().densities[0];
    let weighted: Vec<f64> = after.iter().zip(&areas).map(|(x, a)| a * x).collect();
    let factor = inner(&weighted) / inner(&mass);
    assert!((factor - 1.0 / (1.0 + 0.3 * 0.25 * eigenvalue)).abs() < 1e-4, "{factor}");
    assert!(fluid.measure().unwrap().mass[0].abs() < 1e-12);
    // Constants do not change.
    let mut still = Density::new("temperature", VertexData::filled(shape.len(), 3.5));
    still.diffusivity = 7.0;
    let options = FluidOptions { densities: vec![still], ..FluidOptions::new(0.25) };
    let mut fluid = Simulation::new(surface.surface(), options).unwrap();
    fluid.step().unwrap();
    assert!(fluid.state().densities[0].iter().all(|x| (x - 3.5).abs() < 1e-12));
}

#[test]
fn sources_fill_and_sinks_empty() {
    let surface = sphere(2);
    let count = surface.mesh().vertices();
    let mut filled = Density::new("filled", VertexData::filled(count, 0.0));
    filled.source = Some(VertexData::filled(count, 2.0));
    let mut emptied = Density::new("emptied", VertexData::filled(count, 0.3));
    emptied.source = Some(VertexData::filled(count, -1.0));
    let options = FluidOptions { densities: vec![filled, emptied], ..FluidOptions::new(0.25) };
    let mut fluid = Simulation::new(surface.surface(), options).unwrap();
    fluid.step().unwrap();
    let step = fluid.step().unwrap();
    assert!(relative(step.mass[0], surface.surface().area()) < 1e-13);
    assert_eq!(step.range[1], [0.0, 0.0]);
}

#[test]
fn what_is_heavy_sinks_and_what_is_light_rises() {
    let square = surface(&grid([1.0, 1.0], [24, 24], Diagonal::Alternating).unwrap());
    for scheme in Scheme::ALL {
        let run = |weight: f64| {
            let blob = values(&square, |[x, y, _]| f64::from(u8::from(x.hypot(y) < 0.2)));
            let mut density = Density::new("dye", blob);
            density.weight = weight;
            let options = FluidOptions {
                scheme,
                densities: vec![density],
                gravity: Some(tangential(&square, [0.0, -1.0, 0.0])),
                viscosity: 1e-3,
                ..FluidOptions::new(0.02)
            };
            let mut fluid = Simulation::new(square.surface(), options).unwrap();
            for _ in 0..40 {
                fluid.step().unwrap();
            }
            let areas = square.surface().vertex_areas();
            let density = &fluid.state().densities[0];
            let moment: f64 = density.entries().map(|(v, x)| areas[v] * x * square.positions()[v][1]).sum();
            moment / fluid.measure().unwrap().mass[0]
        };
        let [sunk, risen, still] = [1.0, -1.0, 0.0].map(run);
        assert!(sunk < still - 0.02 && risen > still + 0.02, "{scheme:?}: {sunk} {still} {risen}");
    }
}

#[test]
fn what_is_stored_on_faces_diffuses_alike_in_all_directions_unless_weighed_by_edges() {
    // A flat torus of faces that are four times as long as wide.
    let cells = [16, 64];
    let torus = pompeiu_surface::flat_torus([1.0, 1.0], cells).unwrap();
    let wave = |axis: usize| {
        VertexData::from_fn(torus.mesh().vertices(), |v| {
            let place = [v.0 % cells[0], v.0 / cells[0]];
            (std::f64::consts::TAU * f64::from(place[axis]) / f64::from(cells[axis])).cos()
        })
    };
    let rate = |axis: usize, diffusion: Diffusion| {
        let density = Density { diffusivity: 1e-3, ..Density::new("heat", wave(axis)) };
        let (densities, transport) = (vec![density], Transport::Faces);
        let options = FluidOptions { densities, transport, diffusion, ..FluidOptions::new(1.0) };
        let mut fluid = Simulation::new(&torus, options).unwrap();
        let size =
            |fluid: &Simulation<'_>| fluid.state().face_densities[0].iter().map(|x| x * x).sum::<f64>();
        let before = size(&fluid);
        fluid.step().unwrap();
        (before / size(&fluid)).sqrt() - 1.0
    };
    let [along, across] = [0, 1].map(|axis| rate(axis, Diffusion::EdgeLength));
    assert!(across > 3.0 * along || along > 3.0 * across, "{along} {across}");
    let [along, across] = [0, 1].map(|axis| rate(axis, Diffusion::Laplacian));
    assert!(across < 2.0 * along && along < 2.0 * across, "{along} {across}");
}
