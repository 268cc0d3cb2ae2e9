//! Flow: Poiseuille, a manufactured solution, a network of tubes, conservation through every section, rejected input.

use glam::DVec3;
use pompeiu_core::run::{Control, Limits};
use pompeiu_neuron::{
    CubicMesh, Drive, Flow, FlowCells, FlowError, FlowOptions, FlowParameters, FlowSystem, MeshOptions,
    Parameters, Skeleton, TransportOptions, cubic_neuron, neuron_flow, read_swc, read_transport_config,
    transport_in_flow,
};
use pompeiu_volume::bernstein::{GAUSS_5, derivatives, interpolate_lattice, value};
use pompeiu_volume::{BezierMesh, HexMesh, face_flux, place_of_64};
use std::f64::consts::PI;
use std::sync::LazyLock;

const TUBE: &str = "1 2 0 0 0 0.5 -1\n2 2 10 0 0 0.5 1\n";
pub(crate) const FORK: &str = "1 2 0 0 0 1 -1\n2 2 12 0 0 1 1\n3 2 24 8 0 0.8 2\n4 2 22 -9 2 0.7 2\n";

/// The furcation of several tests, meshed once.
pub(crate) static FORKED: LazyLock<CubicMesh> = LazyLock::new(|| cubic(FORK));

fn cubic(text: &str) -> CubicMesh {
    let skeleton = Skeleton::new(&read_swc(text.as_bytes()).unwrap()).unwrap();
    cubic_neuron(&skeleton, &MeshOptions { measure: false, ..MeshOptions::default() }).unwrap()
}

fn flow(mesh: &CubicMesh, parameters: &FlowParameters) -> Flow {
    let found = neuron_flow(mesh, parameters, &FlowOptions::default()).unwrap();
    let report = &found.report;
    assert!(report.newton.last().is_some_and(|r| *r <= 1e-8), "{report:?}");
    assert!(report.imbalance < 1e-10 && report.wall_leak < 1e-14, "{report:?}");
    assert!(report.section_flux_drift < 1e-10, "{report:?}");
    found
}

#[test]
fn a_long_tube_has_the_profile_and_the_pressure_of_poiseuille() {
    let mesh = cubic(TUBE);
    let found = flow(&mesh, &FlowParameters::default());
    // 8 μ L U / R²: 1 mPa s, 10 µm, 1 µm/s, 0.5 µm.
    let expected = 8.0 * 1e-3 * 10.0 / 0.25;
    let drop = found.report.pressure_drop;
    assert!((drop / expected - 1.0).abs() < 2e-3, "{drop} {expected}");
    assert!((found.report.reynolds - 1e-6).abs() < 1e-9);
    // Twice the mean on the axis.
    let core = found.mesh.cells()[0].map(|v| found.velocity[v as usize]);
    let greatest = value(&core, [0.5; 3]).length();
    assert!((greatest - 2.0).abs() < 0.01, "{greatest}");
    // With a pressure at the inlet, the same flux for the same pressure drop.
    let driven = FlowParameters { drive: Drive::Pressure(expected), ..FlowParameters::default() };
    let found = flow(&mesh, &driven);
    let flux = found.ends.iter().find(|end| end.sample == 2).unwrap().flux;
    assert!((flux / (PI * 0.25) - 1.0).abs() < 2e-3, "{flux}");
    // Reversed, with the pressure at the other end.
    let back = FlowParameters {
        drive: Drive::Pressure(0.0),
        pressures: vec![(2, expected)],
        ..FlowParameters::default()
    };
    let flux_back = flow(&mesh, &back).ends.iter().find(|end| end.sample == 2).unwrap().flux;
    assert!((flux_back + flux).abs() < 1e-9 * flux, "{flux_back} {flux}");
}

#[test]
fn cells_of_any_size_keep_the_pressure_and_the_balance() {
    let mesh = cubic("1 2 0 0 0 1 -1\n2 2 2 0 0 1 1\n");
    let parameters = FlowParameters::default();
    let drop = |elements: usize| {
        let options = FlowOptions { elements, ..FlowOptions::default() };
        let found = neuron_flow(&mesh, &parameters, &options).unwrap();
        assert!(found.report.section_flux_drift < 1e-10, "{:?}", found.report);
        (found.report.pressure_drop / (8.0 * 1e-3 * 2.0) - 1.0).abs()
    };
    let (coarse, fine) = (drop(1), drop(2));
    // The rest is due to the rim, which is not an exact circle.
    assert!(coarse < 2e-4 && fine < 2e-4, "{coarse:e} {fine:e}");
}

#[test]
fn a_furcation_divides_the_flow_as_a_network_of_tubes_does() {
    let found = flow(&FORKED, &FlowParameters::default());
    // Hagen–Poiseuille tubes whose radii vary along them: ∫ ds / R⁴.
    let tube = |from: [f64; 4], to: [f64; 4]| -> f64 {
        let length = (0..3).map(|k| (to[k] - from[k]).powi(2)).sum::<f64>().sqrt();
        let n = 1000.0_f64;
        (0..1000).map(|k| 1.0 / (from[3] + (to[3] - from[3]) * (f64::from(k) + 0.5) / n).powi(4)).sum::<f64>()
            * length
            / n
    };
    let node = [12.0, 0.0, 0.0, 1.0];
    let (a, b) = (tube(node, [24.0, 8.0, 0.0, 0.8]), tube(node, [22.0, -9.0, 2.0, 0.7]));
    let at = |sample: i64| found.ends.iter().find(|end| end.sample == sample).unwrap();
    let ratio = at(3).flux / at(4).flux;
    // The node is wider than its tubes, and belongs to all of them.
    assert!((ratio / (b / a) - 1.0).abs() < 0.05, "{ratio} {}", b / a);
    let network = 8.0e-3 / PI * at(1).flux.abs() * (tube([0.0, 0.0, 0.0, 1.0], node) + a * b / (a + b));
    let drop = found.report.pressure_drop;
    assert!((drop / network - 1.0).abs() < 0.1, "{drop} {network}");
}

#[test]
fn fast_flow_needs_newton_and_converges_quadratically() {
    // Reynolds 40 in the inlet.
    let parameters = FlowParameters { drive: Drive::Speed(2e7), ..FlowParameters::default() };
    let found = flow(&FORKED, &parameters);
    let newton = &found.report.newton;
    assert!((found.report.reynolds - 40.0).abs() < 0.1 && newton.len() >= 4, "{newton:?}");
    let [.., before, last] = newton[..] else { panic!("{newton:?}") };
    assert!(last < 1e-8 && last < before * before.sqrt(), "{newton:?}");
}

/// The errors of velocity in L² and H¹ and of pressure in L² for a manufactured solution on a bent cube.
fn manufactured(n: u32) -> [f64; 3] {
    let (a, b) = (1.7, 1.3);
    let speed = |p: DVec3| {
        let (x, y, z) = (a * p.x, a * p.y, b * p.z);
        // The curl of (0, 0, sin x sin y cos z)-like potentials: free of divergence.
        DVec3::new(x.sin() * y.cos() * z.cos(), -x.cos() * y.sin() * z.cos(), 0.0) * 2.0
    };
    let step = 1e-4;
    let gradient = |p: DVec3| {
        [DVec3::X, DVec3::Y, DVec3::Z].map(|e| (speed(p + e * step) - speed(p - e * step)) / (2.0 * step))
    };
    let pressure = |p: DVec3| (p.x * 1.1).sin() * p.y + p.z * p.z;
    let kappa = 3.0;
    let force = |p: DVec3| {
        let laplacian = -(2.0 * a * a + b * b) * speed(p);
        let [dx, dy, dz] = gradient(p);
        let u = speed(p);
        let slope = DVec3::new(1.1 * (p.x * 1.1).cos() * p.y, (p.x * 1.1).sin(), 2.0 * p.z);
        -laplacian + (dx * u.x + dy * u.y + dz * u.z) * kappa + slope
    };
    let straight = BezierMesh::from_trilinear(&HexMesh::grid([n, n, n], [1.0; 3]));
    let bend = |p: DVec3| p + DVec3::new(0.1 * p.y * p.y, 0.08 * p.z * p.x, 0.07 * (2.0 * p.x).sin());
    let mut points = straight.points().to_vec();
    for (c, cell) in straight.cells().iter().enumerate() {
        let lattice = std::array::from_fn(|k| {
            bend(value(&straight.control(c), place_of_64(k).map(|i| i as f64 / 3.0)))
        });
        for (&v, point) in cell.iter().zip(interpolate_lattice(&lattice)) {
            points[v as usize] = point;
        }
    }
    let mesh = BezierMesh::new(points, straight.cells().to_vec()).unwrap();
    let mut given = vec![None; mesh.points().len()];
    for (c, cell) in mesh.cells().iter().enumerate() {
        let control = mesh.control(c);
        let lattice = std::array::from_fn(|k| speed(value(&control, place_of_64(k).map(|i| i as f64 / 3.0))));
        for (k, u) in interpolate_lattice(&lattice).into_iter().enumerate() {
            let p = straight.points()[cell[k] as usize];
            if [p.x, p.y, p.z].iter().any(|x| *x < 1e-9 || *x > 1.0 - 1e-9) {
                given[cell[k] as usize] = Some(u);
            }
        }
    }
    // Layers from the top to the bottom.
    let groups = (0..mesh.cells().len() as u32).map(|c| n - 1 - c / (n * n)).collect();
    let parents = (0..n).map(|g| if g + 1 < n { Some(g + 1) } else { None }).collect();
    let system = FlowSystem {
        mesh: &mesh,
        given,
        tractions: Vec::new(),
        force: Some(&force),
        inverse_viscosity: kappa,
        groups,
        parents,
        pinned: Some(0),
    };
    let control = Control::start(&Limits::default());
    let found = system.solve(1 << 32, &control, &mut |_| ()).unwrap();
    let mut errors = [0.0; 3];
    let (mut mean, mut volume) = (0.0, 0.0);
    for pass in 0..2 {
        for (c, cell) in mesh.cells().iter().enumerate() {
            let points = mesh.control(c);
            let field = cell.map(|v| found.velocity[v as usize]);
            let size = pompeiu_volume::bezier_volume(&points).cbrt();
            let middle = value(&points, [0.5; 3]);
            for q in 0..125 {
                let rule = [GAUSS_5[q % 5], GAUSS_5[q / 5 % 5], GAUSS_5[q / 25]];
                let place = rule.map(|r| r.0);
                let [du, dv, dw] = derivatives(&points, place);
                let det = du.dot(dv.cross(dw));
                let weight = det * rule.iter().map(|r| r.1).product::<f64>();
                let p = value(&points, place);
                let [x, y, z] = ((p - middle) / size).to_array();
                let polynomials = [1.0, x, y, z, x * x, x * y, x * z, y * y, y * z, z * z];
                let off =
                    polynomials.iter().zip(&found.pressure[c]).map(|(a, b)| a * b).sum::<f64>() - pressure(p);
                if pass == 0 {
                    mean += weight * off;
                    volume += weight;
                    continue;
                }
                errors[2] += weight * (off - mean / volume).powi(2);
                errors[0] += weight * (value(&field, place) - speed(p)).length_squared();
                let slopes = derivatives(&field, place);
                let dual = [dv.cross(dw) / det, dw.cross(du) / det, du.cross(dv) / det];
                for (axis, exact) in gradient(p).into_iter().enumerate() {
                    let slope: DVec3 = (0..3).map(|k| slopes[k] * dual[k][axis]).sum();
                    errors[1] += weight * (slope - exact).length_squared();
                }
            }
        }
    }
    // No cell gains or loses volume.
    for (c, cell) in mesh.cells().iter().enumerate().skip(1) {
        let field = cell.map(|v| found.velocity[v as usize]);
        let net: f64 = (0..6).map(|face| face_flux(&mesh.control(c), &field, face)).sum();
        assert!(net.abs() < 1e-12, "{c}: {net:e}");
    }
    errors.map(f64::sqrt)
}

#[test]
fn a_manufactured_solution_converges_at_the_rates_of_the_pair() {
    let (coarse, fine) = (manufactured(2), manufactured(3));
    let rates = [0, 1, 2].map(|k| (coarse[k] / fine[k]).ln() / 1.5_f64.ln());
    println!("rates {rates:?}, errors {fine:?}");
    assert!(rates[0] > 3.6 && rates[1] > 2.7 && rates[2] > 2.6, "{rates:?} {fine:?}");
}

#[test]
fn what_cannot_flow_is_refused() {
    let mesh = cubic(TUBE);
    let refused = |parameters: &FlowParameters, options: &FlowOptions<'_>| {
        neuron_flow(&mesh, parameters, options).unwrap_err()
    };
    let defaults = FlowOptions::default();
    let with = |inlet| FlowParameters { inlet: Some(inlet), ..FlowParameters::default() };
    assert_eq!(refused(&with(7), &defaults), FlowError::NotAnEnd { sample: 7, ends: "1, 2".to_owned() });
    let viscosity = FlowParameters { viscosity: 0.0, ..FlowParameters::default() };
    assert!(matches!(refused(&viscosity, &defaults), FlowError::Parameter { what: "the viscosity", .. }));
    let little =
        FlowOptions { limits: Limits { memory: Some(1000), ..Limits::default() }, ..FlowOptions::default() };
    assert!(matches!(refused(&FlowParameters::default(), &little), FlowError::Memory { .. }));
    let many = FlowOptions { elements: 9, ..FlowOptions::default() };
    assert!(matches!(refused(&FlowParameters::default(), &many), FlowError::Parameter { .. }));
    let now = Limits { time: Some(std::time::Duration::ZERO), ..Limits::default() };
    let at_once = FlowOptions { limits: now, ..FlowOptions::default() };
    assert!(matches!(refused(&FlowParameters::default(), &at_once), FlowError::Stopped(_)));
}

#[test]
fn transport_along_a_viscous_flow_keeps_mass_and_bounds() {
    let config = "[transport]\ndiffusion = \"0.5 um^2/s\"\nspeed_plus = \"2 um/s\"\nspeed_minus = \"0.5 um/s\"\nattach_minus = \"0.2 /s\"\nstep = \"0.5 s\"\nsteps = 20\n[inlet]\nfree = 1.0\nplus = 2.0\n[flow]\nviscosity = \"2 mPa s\"\npressure = \"1 Pa\"\npressures = { 4 = \"10 mPa\" }\n";
    let parameters = read_transport_config(config).unwrap();
    assert_eq!((parameters.flow.viscosity, parameters.flow.drive), (2e-3, Drive::Pressure(1.0)));
    assert_eq!(parameters.flow.pressures, [(4, 0.01)]);
    assert!(read_transport_config("[flow]\nspeed = \"1 um/s\"\npressure = \"1 Pa\"\n").is_err());
    let found = flow(&FORKED, &parameters.flow);
    let cells = FlowCells::new(&found, 2, &Limits::default()).unwrap();
    let moved = transport_in_flow(&cells, &parameters, 3, &TransportOptions::default()).unwrap();
    assert_eq!((moved.report.steps, moved.report.tips.len()), (20, 2));
    assert!(moved.report.mass_balance < 1e-10 && moved.report.minimum >= -1e-10, "{:?}", moved.report);
    assert!(moved.report.maximum < 4.0 && moved.report.maximum > 1.0, "{:?}", moved.report);
    assert_eq!(moved.state.frames[2].values.len(), cells.cells());
    // Only motors: they fill what they reach within bounds, because the fluxes balance.
    let only = Parameters {
        diffusion: 0.0,
        attach_plus: 0.0,
        attach_minus: 0.0,
        detach_plus: 0.0,
        inlet_free: None,
        step: 1.0,
        steps: 40,
        ..parameters
    };
    let moved = transport_in_flow(&cells, &only, 2, &TransportOptions::default()).unwrap();
    assert!((moved.report.maximum - 2.0).abs() < 1e-9 && moved.report.minimum > -1e-12, "{:?}", moved.report);
}
