//! Time steps of second order: nonnegative concentrations, and resuming with the same bits.

use pompeiu_core::run::{Progress, StopReason};
use pompeiu_neuron::{
    MeshOptions, NeuronMesh, Parameters, Skeleton, TimeScheme, Transport, TransportError, TransportOptions,
    mesh_neuron, read_swc, transport,
};
use std::ops::ControlFlow;

fn tube(layer: f64) -> NeuronMesh {
    let skeleton = Skeleton::new(&read_swc(b"1 2 0 0 0 1 -1\n2 2 8 0 0 1 1\n").unwrap()).unwrap();
    let options = MeshOptions { parts: 1, layer, measure: false, ..MeshOptions::default() };
    mesh_neuron(&skeleton, &options).unwrap()
}

fn run(mesh: &NeuronMesh, parameters: &Parameters) -> Transport {
    let found = transport(mesh, parameters, 3, &TransportOptions::default()).unwrap();
    assert!(found.report.mass_balance < 1e-12, "{:e}", found.report.mass_balance);
    assert!(found.report.minimum >= -1e-15, "{:e}", found.report.minimum);
    found
}

#[test]
fn the_second_order_is_seen_in_exchange_and_along_a_tube() {
    let mesh = tube(2.0);
    let error = |scheme: TimeScheme, steps: u32| {
        let parameters = Parameters {
            scheme,
            diffusion: 0.0,
            speed_plus: 0.0,
            attach_plus: 0.6,
            detach_plus: 0.4,
            inlet_free: None,
            initial: [1.0, 0.0, 0.0],
            step: 1.0 / f64::from(steps),
            steps: steps as usize,
            ..Parameters::default()
        };
        let expected = 0.4 + 0.6 * libm::exp(-1.0);
        (run(&mesh, &parameters).report.tips[0].free - expected).abs()
    };
    let ratio = |scheme: TimeScheme| error(scheme, 10) / error(scheme, 20);
    assert!((ratio(TimeScheme::First) - 2.0).abs() < 0.1, "{}", ratio(TimeScheme::First));
    assert!((ratio(TimeScheme::Second) - 4.0).abs() < 0.3, "{}", ratio(TimeScheme::Second));
    // With motors and diffusion, compared with ten times as many steps.
    let at = |scheme: TimeScheme, steps: usize| {
        let parameters = Parameters {
            scheme,
            initial: [1.0, 0.5, 0.0],
            step: 2.0 / steps as f64,
            steps,
            ..Parameters::default()
        };
        run(&mesh, &parameters).report.tips[0].plus
    };
    let fine = at(TimeScheme::Second, 160);
    let off = |scheme, steps| (at(scheme, steps) - fine).abs();
    let rate = (off(TimeScheme::Second, 8) / off(TimeScheme::Second, 16)).log2();
    assert!(rate > 1.8 && off(TimeScheme::Second, 16) < 0.1 * off(TimeScheme::First, 16), "{rate}");
}

#[test]
fn fronts_of_second_order_are_limited_and_keep_mass() {
    // A jump at the inlet and steps in which it crosses many cells: the two stages alone fall below zero.
    let parameters = Parameters {
        scheme: TimeScheme::Second,
        diffusion: 0.0,
        speed_plus: 1.0,
        attach_plus: 0.0,
        detach_plus: 0.0,
        inlet_free: None,
        inlet_plus: 1.0,
        step: 2.0,
        steps: 12,
        ..Parameters::default()
    };
    let found = run(&tube(0.25), &parameters);
    assert!(found.report.maximum <= 1.3, "{}", found.report.maximum);
    assert!((found.report.tips[0].plus - 1.0).abs() < 0.05, "{:?}", found.report.tips);
}

#[test]
fn a_run_that_was_ended_goes_on_to_the_same_bits() {
    let mesh = tube(1.0);
    for scheme in [TimeScheme::First, TimeScheme::Second] {
        let parameters = Parameters { scheme, steps: 20, step: 0.7, ..Parameters::default() };
        let whole = run(&mesh, &parameters);
        let count = std::sync::atomic::AtomicUsize::new(0);
        let end = |_: &Progress<'_>| {
            let done = count.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1;
            if done < 7 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        let options = TransportOptions { progress: Some(&end), ..TransportOptions::default() };
        let part = transport(&mesh, &parameters, 3, &options).unwrap();
        assert_eq!((part.stop, part.report.steps), (StopReason::Cancelled, 7));
        let on = TransportOptions { resume: Some(&part.state), ..TransportOptions::default() };
        let found = transport(&mesh, &parameters, 3, &on).unwrap();
        assert_eq!((found.stop, &found.report), (StopReason::Steps, &whole.report));
        assert_eq!((&found.state.ends, &found.state.frames), (&whole.state.ends, &whole.state.frames));
        let other = transport(&tube(2.0), &parameters, 3, &on).unwrap_err();
        assert_eq!(other, TransportError::State { what: "cells", found: 35, expected: 20 });
        let short = Parameters { steps: 5, ..parameters };
        let fewer = transport(&mesh, &short, 3, &on).unwrap_err();
        assert_eq!(fewer, TransportError::State { what: "steps", found: 7, expected: 5 });
    }
}
