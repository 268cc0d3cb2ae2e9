//! Transport: closed forms, mass balance, bounds, exchange, configurations, rejected input.

use pompeiu_core::run::{Control, Limits, StopReason};
use pompeiu_neuron::{
    Discretisation, MeshOptions, NeuronMesh, Parameters, Skeleton, Transport, TransportError,
    TransportOptions, mesh_neuron, potential_flow, read_swc, read_transport_config, transport,
};
use pompeiu_volume::HexMesh;
use std::sync::LazyLock;

fn mesh(text: &str, layer: f64) -> NeuronMesh {
    let skeleton = Skeleton::new(&read_swc(text.as_bytes()).unwrap()).unwrap();
    mesh_neuron(&skeleton, &MeshOptions { parts: 1, layer, measure: false, ..MeshOptions::default() })
        .unwrap()
}

/// A straight tube of length 10 and radius 0.5 in `2 · 10 / layer` layers.
fn tube(layer: f64) -> NeuronMesh {
    mesh("1 2 0 0 0 0.5 -1\n2 2 10 0 0 0.5 1\n", layer)
}

/// The furcation of several tests, meshed once.
static FORKED: LazyLock<NeuronMesh> = LazyLock::new(|| mesh(FORK, 1.0));

const FORK: &str = "1 2 0 0 0 1 -1\n2 2 8 0 0 1 1\n3 2 16 6 0 0.8 2\n4 2 16 -6 2 0.7 2\n";

fn run(mesh: &NeuronMesh, parameters: &Parameters) -> Transport {
    let found = transport(mesh, parameters, 3, &TransportOptions::default()).unwrap();
    assert_eq!((found.stop, found.report.steps), (StopReason::Steps, parameters.steps));
    assert!(found.report.mass_balance < 1e-10, "{:e}", found.report.mass_balance);
    found
}

/// Nothing moves, attaches or enters.
fn still() -> Parameters {
    Parameters {
        speed_plus: 0.0,
        attach_plus: 0.0,
        detach_plus: 0.0,
        inlet_free: None,
        inlet_plus: 0.0,
        ..Parameters::default()
    }
}

/// The positions of cells along the tube, each with a value.
fn along(mesh: &NeuronMesh, values: &[[f64; 3]], kind: usize) -> Vec<(f64, f64)> {
    let place = |&cell: &[u32; 8]| mesh.mesh.corners(cell).iter().map(|p| p.x).sum::<f64>() / 8.0;
    mesh.mesh.cells().iter().map(place).zip(values.iter().map(|v| v[kind])).collect()
}

#[test]
fn diffusion_between_two_ends_is_linear() {
    let mesh = tube(0.5);
    let parameters =
        Parameters { inlet_free: Some(3.0), tips_free: Some(1.0), step: 1e6, steps: 3, ..still() };
    let found = run(&mesh, &parameters);
    for (x, n) in along(&mesh, &found.state.frames.last().unwrap().values, 0) {
        assert!((n - (3.0 - 0.2 * x)).abs() < 1e-9, "{x} {n}");
    }
}

#[test]
fn diffusion_from_one_end_follows_the_error_function() {
    let error_at = |layer: f64, steps: usize| {
        let mesh = tube(layer);
        let parameters =
            Parameters { inlet_free: Some(1.0), diffusion: 0.5, step: 2.0 / steps as f64, steps, ..still() };
        let found = run(&mesh, &parameters);
        let error = |(x, n): (f64, f64)| (n - libm::erfc(x / 2.0)).abs();
        along(&mesh, &found.state.frames.last().unwrap().values, 0).into_iter().map(error).fold(0.0, f64::max)
    };
    let (coarse, fine) = (error_at(0.8, 20), error_at(0.4, 80));
    // The step is quartered when the layer is halved: both errors decrease by a factor of four.
    assert!(coarse < 0.02 && fine < 0.35 * coarse, "{coarse} {fine}");
}

#[test]
fn fronts_move_with_the_motors_and_never_undershoot() {
    let mesh = tube(0.25);
    let parameters = Parameters { speed_plus: 1.0, inlet_plus: 2.0, step: 0.025, steps: 200, ..still() };
    let found = run(&mesh, &parameters);
    assert!(found.report.minimum >= -1e-12 && found.report.maximum <= 2.0 + 1e-12, "{:?}", found.report);
    // After 5 s the content of the tube is the inflow: half of its length is filled, with the front in the middle.
    let values = along(&mesh, &found.state.frames.last().unwrap().values, 1);
    let mean: f64 = values.iter().map(|v| v.1).sum::<f64>() / values.len() as f64;
    assert!((mean - 1.0).abs() < 0.01, "{mean}");
    let at = |place: f64| values.iter().find(|(x, _)| *x > place).unwrap().1;
    assert!(
        at(3.0) > 1.9 && at(7.0) < 0.1 && (at(5.0) - 1.0).abs() < 0.25,
        "{} {} {}",
        at(3.0),
        at(5.0),
        at(7.0)
    );
}

#[test]
fn exchange_ends_in_equilibrium_at_the_sum_of_the_rates() {
    let mesh = tube(8.0);
    let parameters = Parameters {
        diffusion: 0.0,
        attach_plus: 0.6,
        detach_plus: 0.4,
        initial: [1.0, 0.0, 0.0],
        step: 0.001,
        steps: 1000,
        ..still()
    };
    let found = run(&mesh, &parameters);
    // n₀ = k′ / (k + k′) + k / (k + k′) exp(−(k + k′) t), at t = 1.
    let expected = 0.4 + 0.6 * libm::exp(-1.0);
    assert!((found.report.tips[0].free - expected).abs() < 3e-4, "{}", found.report.tips[0].free);
    assert!((found.report.tips[0].free + found.report.tips[0].plus - 1.0).abs() < 1e-12);
    // Motors towards the inlet exchange likewise.
    let back =
        Parameters { attach_plus: 0.0, detach_plus: 0.0, attach_minus: 0.6, detach_minus: 0.4, ..parameters };
    assert!((run(&mesh, &back).report.tips[0].minus - found.report.tips[0].plus).abs() < 1e-12);
}

#[test]
fn fast_exchange_moves_at_the_mean_speed() {
    let mesh = tube(0.5);
    let parameters = Parameters {
        speed_plus: 1.0,
        attach_plus: 30.0,
        detach_plus: 60.0,
        diffusion: 0.01,
        inlet_free: Some(2.0),
        inlet_plus: 1.0,
        step: 0.05,
        steps: 300,
        ..still()
    };
    let found = run(&mesh, &parameters);
    // A third is on motors: a front at 1/3 µm/s is in the middle after 15 s; half of the tube is filled.
    let values = &found.state.frames.last().unwrap().values;
    let mean = values.iter().map(|v| v[0] + v[1]).sum::<f64>() / values.len() as f64;
    assert!((mean / 3.0 - 0.5).abs() < 0.03, "{mean}");
}

#[test]
fn mass_is_kept_through_a_furcation_in_both_directions() {
    let mesh = &*FORKED;
    let parameters = Parameters {
        speed_minus: 0.5,
        attach_minus: 0.3,
        detach_minus: 0.2,
        tips_minus: 1.5,
        initial: [0.5, 0.1, 0.2],
        step: 0.3,
        steps: 40,
        ..Parameters::default()
    };
    let found = run(mesh, &parameters);
    assert!(found.report.minimum >= 0.0, "{:e}", found.report.minimum);
    assert_eq!(found.report.tips.iter().map(|tip| tip.sample).collect::<Vec<_>>(), [3, 4]);
    assert_eq!((found.state.ends.len(), found.state.frames.len()), (41, 3));
    // A closed neuron keeps its content.
    let closed = Parameters {
        diffusion: 2.0,
        initial: [1.0, 0.0, 0.0],
        steps: 50,
        step: 5.0,
        attach_plus: 0.0,
        ..still()
    };
    let found = run(mesh, &closed);
    let free = found.state.frames.iter().flat_map(|frame| &frame.values).map(|v| (v[0] - 1.0).abs());
    assert!(free.fold(0.0, f64::max) < 1e-11);
}

#[test]
fn the_flow_is_the_same_through_every_section_and_splits_at_furcations() {
    let mesh = &*FORKED;
    let volumes = Discretisation::new(&mesh.mesh, &mesh.faces, &mesh.labels);
    let flow = potential_flow(&volumes, 0, &Control::default()).unwrap();
    assert!(flow.imbalance < 1e-12, "{:e}", flow.imbalance);
    let through = |cap: u32| -> f64 {
        volumes.ends.iter().zip(&flow.out).filter(|(end, _)| end.cap == cap).map(|(_, q)| q).sum()
    };
    assert!((through(0) + through(1) + through(2)).abs() < 1e-12);
    assert!(through(1) > 0.0 && through(2) > 0.0 && through(0) < 0.0);
    // The sum of volumes is that of the mesh, whatever the shape of cells.
    let total: f64 = volumes.volumes.iter().sum();
    assert!(total > 0.9 * std::f64::consts::PI * 8.0);
}

#[test]
fn half_conductances_of_a_box_are_area_over_length() {
    let mesh = HexMesh::grid([2, 1, 1], [4.0, 3.0, 0.5]);
    let faces = pompeiu_volume::Faces::new(&mesh).unwrap();
    let volumes = Discretisation::new(&mesh, &faces, &vec![0; faces.boundary().len()]);
    assert_eq!((volumes.volumes.as_slice(), volumes.ends.len()), ([3.0, 3.0].as_slice(), 0));
    assert!((volumes.links[0].1 - 1.5 / 2.0).abs() < 1e-15);
}

#[test]
fn configurations_have_units_and_no_unknown_keys() {
    let toml = "[transport]\ndiffusion = \"60 um^2/min\"\nspeed_minus = \"3.6 mm/h\"\nstep = \"10 ms\"\nsteps = 7\n[inlet]\nfree = \"closed\"\nplus = 2\nsample = 9\n[tips]\nfree = 0.5\n[initial]\nminus = \"1 uM\"\n";
    let read = read_transport_config(toml).unwrap();
    assert_eq!((read.diffusion, read.speed_minus, read.step, read.steps), (1.0, 1.0, 0.01, 7));
    assert_eq!(
        (read.inlet_free, read.inlet_plus, read.inlet, read.tips_free),
        (None, 2.0, Some(9), Some(0.5))
    );
    assert_eq!(read.initial, [0.0, 0.0, 1e-3]);
    let peer = "D 1.0\nvplus 1.00\nvminus -0.5\nkplus 1.0\nkminus 0.0\nk'plus 0.1\nk'minus 0.0\ndt 0.1\nnstep 15\nN0bc 1.0\nNplusbc 2.0\nNminusbc 0.0";
    let read = read_transport_config(peer).unwrap();
    assert_eq!((read.speed_minus, read.steps, read.detach_plus), (0.5, 15, 0.1));
    let error = |text: &str| read_transport_config(text).unwrap_err().to_string();
    assert!(
        error("[transport]\nspeed = \"1 um/s\"\n")
            .starts_with("line 2: there is no key \"speed\" in [transport]")
    );
    assert_eq!(
        error("[transport]\n\nspeed_plus = 1.0\n"),
        "line 3: speed_plus is 1.0; expected a speed such as \"0.5 um/s\""
    );
    assert!(error("[transport]\nstep = \"1 um\"\n").contains("expected a time"));
    assert!(error("[transport]\nspeed_plus = \"-1 um/s\"\n").contains("must be finite and at least 0"));
    assert!(error("[fluid]\n").contains("transport, inlet, tips, initial, flow"));
    assert!(error("[transport\n").contains('1'));
    assert!(error("D 1.0\nvplus one\n").starts_with("line 2: vplus is one"));
    assert!(error("D 1.0\nviscosity 3\n").starts_with("line 2: there is no key \"viscosity\""));
}

#[test]
fn what_cannot_be_transported_is_refused() {
    let mesh = tube(8.0);
    let refused = |parameters: &Parameters, options: &TransportOptions<'_>| {
        transport(&mesh, parameters, 2, options).unwrap_err()
    };
    let with = |inlet| Parameters { inlet: Some(inlet), ..Parameters::default() };
    let error = refused(&with(7), &TransportOptions::default());
    assert_eq!(error, TransportError::NotAnEnd { sample: 7, ends: "1, 2".to_owned() });
    let little = Limits { memory: Some(1000), ..Limits::default() };
    let error = refused(&with(1), &TransportOptions { limits: little, ..TransportOptions::default() });
    assert!(matches!(error, TransportError::Memory { .. }), "{error}");
    // The other end may be the inlet, too.
    assert!(transport(&mesh, &with(2), 2, &TransportOptions::default()).is_ok());
    // Running out of time is no error: the completed steps are returned.
    let now = Limits { time: Some(std::time::Duration::ZERO), ..Limits::default() };
    let options = TransportOptions { limits: now, ..TransportOptions::default() };
    let found = transport(&mesh, &Parameters::default(), 2, &options).unwrap();
    assert_eq!((found.stop, found.report.steps, found.state.frames.len()), (StopReason::Time, 0, 1));
}
