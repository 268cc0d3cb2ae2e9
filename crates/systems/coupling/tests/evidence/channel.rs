//! The channel and the box below an elastic wall: closed forms of added mass, frequency, volume and pressure.

use pompeiu_coupling::channel::{Channel, ChannelFluid, ChannelOptions, Drive};
use pompeiu_coupling::piston::TimeRule;
use pompeiu_coupling::wall::{ElasticWall, Ends, WallOptions};
use pompeiu_coupling::{Coupling, CouplingOptions, Scheme, Subproblem};
use std::f64::consts::PI;

fn coupled(channel: &Channel, options: CouplingOptions) -> Coupling<ChannelFluid, ElasticWall> {
    Coupling::new(channel.fluid().unwrap(), channel.solid().unwrap(), &channel.start(), options).unwrap()
}

fn periodic(cells: usize, time_step: f64, rule: TimeRule, waves: usize) -> Channel {
    let wall = WallOptions { mass: 1.0, stiffness: 2.0, tension: 0.5, damping: 0.0, ends: Ends::Periodic };
    let drive = Drive::Periodic { amplitude: 1e-3, waves };
    let cells = [cells, cells / 4];
    Channel::new(ChannelOptions {
        height: PI / 2.0,
        cells,
        time_step,
        rule,
        advect: false,
        drive,
        wall,
        ..ChannelOptions::default()
    })
    .unwrap()
}

/// The mass of fluid that a mode of the periodic channel moves, by area of the wall.
fn moved_mass(waves: usize) -> f64 {
    let q = waves as f64;
    1.0 / (q * (q * PI / 2.0).tanh())
}

#[test]
fn each_mode_has_its_added_mass() {
    let time_step = 0.02;
    for waves in [1, 2, 4] {
        let channel = periodic(128, time_step, TimeRule::BackwardEuler, waves);
        let (mut fluid, mut solid) = (channel.fluid().unwrap(), channel.solid().unwrap());
        let mode = channel.start();
        let mut composed = |scale: f64| {
            let x: Vec<f64> = mode.iter().map(|m| scale * m).collect();
            let (mut y, mut out) = (vec![0.0; x.len()], vec![0.0; x.len()]);
            fluid.solve(&x, &mut y).unwrap();
            solid.solve(&y, &mut out).unwrap();
            out
        };
        let (one, two) = (composed(1.0), composed(2.0));
        let product: f64 = one.iter().zip(&two).zip(&mode).map(|((a, b), m)| (b - a) * m).sum();
        let found = product / mode.iter().map(|m| m * m).sum::<f64>();
        let q = waves as f64;
        let expected = -moved_mass(waves) / (1.0 + time_step * time_step * (2.0 + 0.5 * q * q));
        let spacing = 2.0 * PI / 128.0;
        assert!(
            (found / expected - 1.0).abs() < 0.25 * (q * spacing).powi(2),
            "mode {waves}: {found} {expected}"
        );
    }
}

#[test]
fn the_periodic_channel_rings_at_its_frequency_to_second_order() {
    let expected = (2.5 / (1.0 + moved_mass(1))).sqrt();
    let errors = [32, 64, 128].map(|cells| {
        let time_step = 1.6 / cells as f64;
        let channel = periodic(cells, time_step, TimeRule::Trapezoidal, 1);
        let mut coupling =
            coupled(&channel, CouplingOptions { tolerance: 1e-8, ..CouplingOptions::default() });
        let place = cells / 4;
        let (mut last, mut time, mut zeros) = (channel.start()[place], 0.0, Vec::new());
        while zeros.len() < 2 {
            coupling.advance().unwrap();
            let now = coupling.x()[place];
            if last * now <= 0.0 {
                zeros.push(time + time_step * last / (last - now));
            }
            (last, time) = (now, time + time_step);
        }
        (PI / (zeros[1] - zeros[0]) / expected - 1.0).abs()
    });
    assert!(errors[2] < 1e-3, "{errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.7..2.3).contains(&order), "{errors:?}");
    }
}

#[test]
fn a_pulse_along_a_light_and_a_heavy_wall_takes_few_solves() {
    for (mass, most, number) in [(0.1, 6.5, 38.4), (5.0, 3.5, 0.80)] {
        let wall = WallOptions { mass, ..WallOptions::default() };
        let channel = Channel::new(ChannelOptions { wall, ..ChannelOptions::default() }).unwrap();
        let mut coupling =
            coupled(&channel, CouplingOptions { tolerance: 1e-6, ..CouplingOptions::default() });
        let (mut solves, mut added) = (0, 0.0_f64);
        for _ in 0..100 {
            let window = coupling.advance().unwrap();
            solves += window.solves;
            added = added.max(window.added_mass.map_or(0.0, |a| a.number));
        }
        assert!(f64::from(u32::try_from(solves).unwrap()) <= 100.0 * most, "{solves}");
        // The slowest wave between the open ends, half a wave long, is what iteration has most trouble with.
        let q = PI / channel.length();
        let inertia = mass + 0.02 * 0.02 * (10.0 + 5.0 * q * q);
        let expected = 1.0 / (q * q.tanh()) / inertia;
        assert!(
            (added / expected - 1.0).abs() < 0.03 && (added / number - 1.0).abs() < 0.03,
            "{added} {expected}"
        );
        assert!(coupling.fluid().divergence() < 1e-15);
    }
}

#[test]
fn plain_iteration_fails_along_a_light_wall_and_the_error_says_why() {
    let channel = Channel::new(ChannelOptions { cells: [48, 8], ..ChannelOptions::default() }).unwrap();
    let options = CouplingOptions { scheme: Scheme::Fixed, ..CouplingOptions::default() };
    let error = coupled(&channel, options).advance().unwrap_err().to_string();
    assert!(error.contains("cannot agree by plain iteration: added-mass number 3"), "{error}");
}

fn closed_box() -> Channel {
    let wall = WallOptions { mass: 0.5, stiffness: 20.0, tension: 1.0, damping: 4.0, ends: Ends::Free };
    let drive = Drive::Injection { volume: 0.04, duration: 0.5 };
    Channel::new(ChannelOptions {
        cells: [32, 32],
        drive,
        wall,
        time_step: 0.02,
        ..ChannelOptions::default()
    })
    .unwrap()
}

#[test]
fn a_closed_box_takes_in_what_flows_in() {
    let mut coupling =
        coupled(&closed_box(), CouplingOptions { tolerance: 1e-8, ..CouplingOptions::default() });
    let mut solves = 0;
    let mut constant = 0.0;
    for step in 1..=400 {
        let window = coupling.advance().unwrap();
        solves += window.solves;
        constant = window.pressure_constant.unwrap();
        let volume = coupling.solid().displacement().iter().sum::<f64>() / 32.0;
        let injected = 0.04 * (f64::from(step) / 25.0).min(1.0);
        assert!((volume - injected).abs() < 1e-12, "{step}: {volume} {injected}");
        assert!(coupling.fluid().divergence() < 1e-12);
    }
    assert!(solves <= 5 * 400, "{solves}");
    assert!((constant - 0.8).abs() < 1e-6, "{constant}");
    let pressure = coupling.y().unwrap();
    assert!(pressure.iter().all(|p| (p - 0.8).abs() < 1e-6), "{pressure:?}");
}

/// A fluid that does not say that it is enclosed.
struct Silent(ChannelFluid);

impl Subproblem for Silent {
    fn inputs(&self) -> usize {
        self.0.inputs()
    }
    fn outputs(&self) -> usize {
        self.0.outputs()
    }
    fn solve(&mut self, input: &[f64], output: &mut [f64]) -> Result<(), pompeiu_coupling::Refusal> {
        self.0.solve(input, output)
    }
    fn accept(&mut self) {
        self.0.accept();
    }
}

#[test]
fn without_the_constant_a_closed_box_converges_to_a_wrong_volume() {
    let channel = closed_box();
    let options = CouplingOptions { tolerance: 1e-8, ..CouplingOptions::default() };
    let fluid = Silent(channel.fluid().unwrap());
    let mut coupling = Coupling::new(fluid, channel.solid().unwrap(), &channel.start(), options).unwrap();
    for _ in 0..25 {
        coupling.advance().unwrap();
    }
    let volume = coupling.solid().displacement().iter().sum::<f64>() / 32.0;
    assert!(volume < 0.02, "{volume}");
}

#[test]
fn a_closed_box_is_refused_on_request_with_the_imbalance_named() {
    let options = CouplingOptions { closed: pompeiu_coupling::Closed::Refuse, ..CouplingOptions::default() };
    let error = coupled(&closed_box(), options).advance().unwrap_err();
    assert!(error.to_string().contains("∮u·n is 8e-2"), "{error}");
}
