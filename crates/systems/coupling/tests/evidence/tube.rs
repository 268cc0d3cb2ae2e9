//! The elastic tube, beside both problems solved at once and beside the published log of preCICE.

use pompeiu_coupling::tube::{Inlet, Tube, TubeOptions};
use pompeiu_coupling::{Coupling, CouplingOptions, Scheme};

/// Solves of each window, and the greatest distance of the pressure from that of both solved at once, relative to the greatest one.
fn run(tube: TubeOptions, options: CouplingOptions, windows: usize) -> Result<(Vec<usize>, f64), String> {
    let tube = Tube::new(tube).unwrap();
    let mut coupling = Coupling::new(tube.fluid(), tube.solid(), &tube.start(), options).unwrap();
    let mut together = tube.monolithic();
    let (mut solves, mut worst, mut greatest) = (Vec::new(), 0.0_f64, 0.0_f64);
    for _ in 0..windows {
        let window = coupling.advance().map_err(|error| format!("{error} after {solves:?}"))?;
        solves.push(window.solves);
        together.advance().unwrap();
        for (p, q) in coupling.y().unwrap().iter().zip(together.pressure()) {
            worst = worst.max((p - q).abs());
            greatest = greatest.max(q.abs());
        }
    }
    Ok((solves, worst / greatest))
}

fn mean(solves: &[usize]) -> f64 {
    solves.iter().sum::<usize>() as f64 / solves.len() as f64
}

#[test]
fn the_tube_takes_no_more_solves_than_precice() {
    // precice/tutorials, elastic-tube-1d/fluid-python/precice-Fluid-iterations.log: 857 solves in 100 windows.
    let same = CouplingOptions { extrapolation: 0, ..CouplingOptions::default() };
    let (solves, _) = run(TubeOptions::default(), same, 100).unwrap();
    assert!(mean(&solves) <= 8.6, "{solves:?}");
    assert_eq!(solves[0], 20);
}

#[test]
fn the_default_takes_six_solves_and_ends_where_both_solved_at_once_do() {
    let (solves, distance) = run(TubeOptions::default(), CouplingOptions::default(), 100).unwrap();
    assert!(mean(&solves) <= 6.6, "{solves:?}");
    assert!(distance < 1e-5, "{distance}");
    let finer = CouplingOptions { tolerance: 1e-9, ..CouplingOptions::default() };
    let (_, distance) = run(TubeOptions::default(), finer, 20).unwrap();
    assert!(distance < 1e-8, "{distance}");
}

#[test]
fn other_schemes_agree_on_the_tube() {
    for (scheme, most) in
        [(Scheme::IqnImvj, 11.0), (Scheme::TwoModels, 10.0), (Scheme::Constant(0.01), 400.0)]
    {
        let options = CouplingOptions { scheme, most_solves: 600, ..CouplingOptions::default() };
        let (solves, distance) = run(TubeOptions::default(), options, 30).unwrap();
        assert!(mean(&solves) <= most, "{scheme:?} {}", mean(&solves));
        assert!(distance < 2e-3, "{scheme:?} {distance}");
    }
    for scheme in [Scheme::Fixed, Scheme::Constant(0.05), Scheme::Aitken(0.1)] {
        let options = CouplingOptions { scheme, ..CouplingOptions::default() };
        let error = run(TubeOptions::default(), options, 30).unwrap_err();
        assert!(error.contains("do not agree"), "{error}");
    }
}

#[test]
fn soft_walls_and_short_steps_converge_with_the_rest_damped() {
    for (modulus, time_step, most) in [(5e3, 0.01, 12.0), (5e3, 0.002, 16.0), (1e4, 0.001, 16.0)] {
        let tube = TubeOptions { modulus, time_step, ..TubeOptions::default() };
        let (solves, distance) = run(tube, CouplingOptions::default(), 60).unwrap();
        assert!(mean(&solves) <= most, "{modulus} {time_step}: {solves:?}");
        assert!(distance < 1e-4, "{modulus} {time_step}: {distance}");
    }
}

#[test]
fn a_pulse_travels_with_the_stream_and_the_speed_of_waves() {
    let inlet = Inlet::Pulse { mean: 10.0, amplitude: 0.01, duration: 0.01 };
    let tube = Tube::new(TubeOptions { time_step: 0.002, inlet, ..TubeOptions::default() }).unwrap();
    let options = CouplingOptions { tolerance: 1e-6, ..CouplingOptions::default() };
    let mut coupling = Coupling::new(tube.fluid(), tube.solid(), &tube.start(), options).unwrap();
    let mut centroids = Vec::new();
    for step in 1..=28 {
        coupling.advance().unwrap();
        if step == 15 || step == 28 {
            let weighted = coupling.y().unwrap().iter().enumerate();
            let (sum, moment) =
                weighted.fold((0.0, 0.0), |(sum, moment), (i, p)| (sum + p, moment + p * i as f64 * 0.1));
            centroids.push(moment / sum);
        }
    }
    let speed = (centroids[1] - centroids[0]) / (13.0 * 0.002);
    let expected = 10.0 + tube.wave_speed();
    assert!((speed / expected - 1.0).abs() < 2e-3, "{speed} {expected}");
}

#[test]
fn a_scenario_runs_until_it_ends_or_is_told_to() {
    use pompeiu_coupling::scenario::Scenario;
    let scenario = Scenario::Tube(TubeOptions::default());
    let report = scenario.run(&CouplingOptions::default(), 10, &mut |_, _, _| true).unwrap();
    assert_eq!((report.windows.len(), report.failure), (10, None));
    assert!(report.from_monolithic.unwrap() < 1e-4);
    let report = scenario.run(&CouplingOptions::default(), 10, &mut |window, _, _| window < 3).unwrap();
    assert_eq!(report.windows.len(), 3);
    assert!(report.failure.unwrap().contains("after window 3"));
    let options = CouplingOptions { scheme: Scheme::Fixed, ..CouplingOptions::default() };
    let report = scenario.run(&options, 10, &mut |_, _, _| true).unwrap();
    assert!(report.windows.is_empty() && report.added_mass.unwrap().number > 1.0);
    assert_eq!(report.from_monolithic, None, "nothing was compared");
}
