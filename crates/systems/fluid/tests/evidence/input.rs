//! Invalid input is rejected; equal input gives equal bits.

use crate::{sphere, values};
use pompeiu_core::mesh::VertexData;
use pompeiu_fluid::{
    Density, Diffusion, FluidError, FluidOptions, Scheme, Simulation, TimeStep, Transport, coriolis,
    tangential,
};
use pompeiu_operators::{FaceField, OperatorError, random_field, rotation_field};

#[test]
fn bad_numbers_are_named() {
    let surface = sphere(2);
    let new = |options: FluidOptions| Simulation::new(surface.surface(), options).map(|_| ());
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = new(FluidOptions::new(step)).unwrap_err();
        assert!(matches!(error, FluidError::Parameter { what: "time step", .. }), "{error}");
    }
    let viscosity = new(FluidOptions { viscosity: -0.1, ..FluidOptions::new(0.1) }).unwrap_err();
    assert_eq!(viscosity.to_string(), "the viscosity is -0.1; it must be finite and not negative");
    let mut force = FaceField::filled(surface.mesh().faces(), [0.0; 2]);
    force.as_mut_slice()[17][1] = f64::NAN;
    let error = new(FluidOptions { force: Some(force.clone()), ..FluidOptions::new(0.1) }).unwrap_err();
    assert!(matches!(error, FluidError::Operator(OperatorError::NonFiniteField { .. })), "{error}");
    let mut fluid = Simulation::new(surface.surface(), FluidOptions::new(0.1)).unwrap();
    assert!(fluid.step_with(Some(&force)).unwrap_err().to_string().contains("on face 17"));
    assert_eq!(fluid.state().step, 0);
    let mut dye = VertexData::filled(surface.mesh().vertices(), 0.0);
    dye.as_mut_slice()[3] = f64::INFINITY;
    let error = new(FluidOptions { densities: vec![Density::new("dye", dye)], ..FluidOptions::new(0.1) })
        .unwrap_err();
    assert_eq!(error.to_string(), "the density is inf at vertex 3, expected a finite number");
    let short = Density::new("dye", VertexData::filled(3, 0.0));
    let error = new(FluidOptions { densities: vec![short], ..FluidOptions::new(0.1) }).unwrap_err();
    assert!(matches!(error, FluidError::Length { found: 3, .. }), "{error}");
    assert!(matches!(
        fluid.set_vorticity(&values(&surface, |p| p[0]), &[1.0]),
        Err(FluidError::Harmonic { found: 1, expected: 0 })
    ));
}

#[test]
fn a_step_that_is_far_too_long_is_refused_and_changes_nothing() {
    let surface = sphere(2);
    let mut fluid = Simulation::new(surface.surface(), FluidOptions::new(1e9)).unwrap();
    fluid.set_velocity(&rotation_field(&surface, [0.0, 0.0, 1.0])).unwrap();
    let before = fluid.state().clone();
    let error = fluid.step().unwrap_err();
    assert!(matches!(error, FluidError::StepTooLong { .. }), "{error}");
    assert_eq!(*fluid.state(), before);
    // A fluid at rest has no paths.
    let mut fluid = Simulation::new(surface.surface(), FluidOptions::new(1e9)).unwrap();
    fluid.step().unwrap();
}

#[test]
fn steps_are_chosen_by_their_courant_number() {
    let surface = sphere(3);
    let time_step = TimeStep::Cfl { number: 0.8, longest: 10.0 };
    let options = FluidOptions { time_step, viscosity: 0.01, ..FluidOptions::new(1.0) };
    let mut fluid = Simulation::new(surface.surface(), options).unwrap();
    fluid.set_velocity(&rotation_field(&surface, [0.0, 0.0, 1.0])).unwrap();
    for _ in 0..3 {
        let step = fluid.step().unwrap();
        assert!(step.cfl <= 0.81 && step.cfl > 0.38 && step.substeps == 1, "{step:?}");
    }
}

#[test]
fn the_bits_do_not_depend_on_threads_and_a_state_goes_on_where_it_was() {
    let surface = sphere(3);
    let options = || FluidOptions {
        viscosity: 0.01,
        coriolis: Some(coriolis(&surface, [0.0, 0.0, 2.0])),
        gravity: Some(tangential(&surface, [0.0, 0.0, -1.0])),
        confinement: 0.1,
        densities: vec![Density {
            weight: 1.0,
            diffusivity: 0.01,
            ..Density::new("dye", values(&surface, |[x, _, _]| x.max(0.0)))
        }],
        ..FluidOptions::new(0.05)
    };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut fluid = Simulation::new(surface.surface(), options()).unwrap();
            fluid.set_velocity(&random_field(surface.mesh(), 5)).unwrap();
            for _ in 0..3 {
                fluid.step().unwrap();
            }
            fluid.state().clone()
        })
    };
    let one = run(1);
    assert_eq!(run(2), one);
    assert_eq!(run(8), one);
    let mut fluid = Simulation::new(surface.surface(), options()).unwrap();
    fluid.set_state(&one).unwrap();
    let mut other = Simulation::new(surface.surface(), options()).unwrap();
    other.set_velocity(&random_field(surface.mesh(), 5)).unwrap();
    for _ in 0..3 {
        other.step().unwrap();
    }
    assert_eq!(fluid.step().unwrap(), other.step().unwrap());
}

#[test]
fn a_state_goes_on_bit_for_bit_with_every_scheme() {
    let sphere = sphere(2);
    for (scheme, transport) in Scheme::ALL.into_iter().zip(Transport::ALL) {
        let dye = values(&sphere, |[x, y, _]| x * x + y);
        let density = Density { diffusivity: 0.01, ..Density::new("dye", dye) };
        let options = FluidOptions {
            scheme,
            transport,
            viscosity: 0.01,
            densities: vec![density],
            ..FluidOptions::new(0.1)
        };
        let mut fluid = Simulation::new(sphere.surface(), options.clone()).unwrap();
        fluid.set_vorticity(&values(&sphere, |[x, _, z]| z + x * z), &[]).unwrap();
        fluid.step().unwrap();
        let state = fluid.state().clone();
        fluid.step().unwrap();
        let mut other = Simulation::new(sphere.surface(), options).unwrap();
        other.set_state(&state).unwrap();
        other.step().unwrap();
        assert_eq!(other.state(), fluid.state(), "{scheme:?}, {transport:?}");
    }
}

#[test]
fn weights_of_edges_are_for_faces() {
    let options = FluidOptions { diffusion: Diffusion::EdgeLength, ..FluidOptions::new(0.1) };
    assert_eq!(Simulation::new(sphere(1).surface(), options).unwrap_err(), FluidError::EdgeLength);
}
