//! The piston: every number has a closed form.

use pompeiu_coupling::piston::{Piston, PistonOptions, TimeRule};
use pompeiu_coupling::{Coupling, CouplingError, CouplingOptions, Scheme, Subproblem};

fn piston(mu: f64, time_step: f64, rule: TimeRule) -> Piston {
    let (mass, stiffness) = (1.0, 100.0);
    let fluid_mass = mu * (mass + stiffness * time_step * time_step);
    Piston::new(PistonOptions { mass, stiffness, fluid_mass, time_step, start: 1.0, rule }).unwrap()
}

/// By what one relaxed iteration multiplies the distance from the answer, in the first step.
fn factor(piston: &Piston, relaxation: f64) -> f64 {
    let exact = piston.monolithic(1)[0];
    let (mut fluid, mut solid) = (piston.fluid(), piston.solid());
    let x = exact + 1e-3;
    let (mut y, mut out) = ([0.0], [0.0]);
    fluid.solve(&[x], &mut y).unwrap();
    solid.solve(&y, &mut out).unwrap();
    (x + relaxation * (out[0] - x) - exact) / 1e-3
}

#[test]
fn relaxed_iteration_multiplies_errors_as_predicted() {
    for (mu, relaxation) in [(0.5, 1.0), (0.98, 0.95), (9.0, 0.09), (14.0, 0.12), (990.0, 0.01)] {
        let found = factor(&piston(mu, 0.01, TimeRule::BackwardEuler), relaxation);
        let expected = 1.0 - relaxation * (1.0 + mu);
        assert!((found - expected).abs() < 1e-3 * expected.abs(), "{mu} {relaxation}: {found} {expected}");
    }
}

#[test]
fn three_solves_are_enough_and_two_and_one_after_that() {
    for mu in [0.5, 0.98, 9.0, 99.0, 990.0] {
        for scheme in [Scheme::IqnIls, Scheme::IqnImvj, Scheme::Aitken(0.01), Scheme::TwoModels] {
            let piston = piston(mu, 0.01, TimeRule::BackwardEuler);
            let options = CouplingOptions { scheme, tolerance: 1e-6, ..CouplingOptions::default() };
            let mut coupling =
                Coupling::new(piston.fluid(), piston.solid(), &[piston.start()], options).unwrap();
            for (step, exact) in piston.monolithic(50).into_iter().enumerate() {
                let window = coupling.advance().unwrap();
                let most = if step == 0 { 4 } else { 3 };
                assert!(window.solves <= most, "{mu} {scheme:?} step {step}: {} solves", window.solves);
                assert!(
                    (coupling.x()[0] - exact).abs() < 1e-4,
                    "{mu} {scheme:?}: {} {exact}",
                    coupling.x()[0]
                );
            }
        }
    }
}

#[test]
fn the_solves_tell_the_added_mass() {
    let heavy = piston(14.0, 0.01, TimeRule::BackwardEuler);
    let options = CouplingOptions::default();
    let mut coupling = Coupling::new(heavy.fluid(), heavy.solid(), &[1.0], options).unwrap();
    let added = coupling.advance().unwrap().added_mass.unwrap();
    assert!((added.number - 14.0).abs() < 1e-6, "{added:?}");
    assert!((added.relaxation_below - 2.0 / 15.0).abs() < 1e-7, "{added:?}");

    let options = CouplingOptions { scheme: Scheme::Fixed, ..CouplingOptions::default() };
    let mut coupling = Coupling::new(heavy.fluid(), heavy.solid(), &[1.0], options).unwrap();
    let error = coupling.advance().unwrap_err();
    let CouplingError::NotConverged { added_mass: Some(added), .. } = &error else { panic!("{error}") };
    assert!((added.number - 14.0).abs() < 1e-3, "{added:?}");
    assert!(error.to_string().contains("cannot agree by plain iteration"), "{error}");
}

#[test]
fn relaxation_converges_below_the_bound_and_not_beyond() {
    let heavy = piston(14.0, 0.01, TimeRule::BackwardEuler);
    for (relaxation, converges) in [(0.98 * 2.0 / 15.0, true), (1.02 * 2.0 / 15.0, false)] {
        let scheme = Scheme::Constant(relaxation);
        let options = CouplingOptions { scheme, most_solves: 1000, ..CouplingOptions::default() };
        let mut coupling = Coupling::new(heavy.fluid(), heavy.solid(), &[1.0], options).unwrap();
        assert_eq!(coupling.advance().is_ok(), converges, "{relaxation}");
    }
}

#[test]
fn the_trapezoidal_rule_finds_the_frequency_to_second_order() {
    let errors = [0.02, 0.01, 0.005].map(|time_step| {
        let options =
            PistonOptions { mass: 1.0, stiffness: 20.0, fluid_mass: 4.0, ..PistonOptions::default() };
        let piston =
            Piston::new(PistonOptions { time_step, rule: TimeRule::Trapezoidal, ..options }).unwrap();
        let options = CouplingOptions { tolerance: 1e-10, ..CouplingOptions::default() };
        let mut coupling = Coupling::new(piston.fluid(), piston.solid(), &[1.0], options).unwrap();
        // The first zero of a cosine of angular frequency 2 is at π/4, the seventh six half-periods later.
        let (mut last, mut time, mut zeros) = (1.0, 0.0, Vec::new());
        while zeros.len() < 7 {
            coupling.advance().unwrap();
            let now = coupling.x()[0];
            if last * now <= 0.0 {
                zeros.push(time + time_step * last / (last - now));
            }
            (last, time) = (now, time + time_step);
        }
        let frequency = 6.0 * std::f64::consts::PI / (zeros[6] - zeros[0]);
        (frequency / 2.0 - 1.0).abs()
    });
    assert!(errors[0] < 4e-4, "{errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.7..2.3).contains(&order), "{errors:?}");
    }
}
