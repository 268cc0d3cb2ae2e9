//! A time step: of first order, or of second order where no concentration becomes negative.

use super::error::TransportError;
use super::factor::lu;
use super::problem::TimeScheme;
use super::system::System;
use pompeiu_core::run::Control;
use pompeiu_solve::{LinearSolver, Lu};

/// γ of the two stages: 1 − 1/√2.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

/// A completed step.
pub(super) struct Stepped {
    pub(super) values: Vec<f64>,
    /// Net inflow through all ends.
    pub(super) net: f64,
    /// Absolute flux through all ends.
    pub(super) gross: f64,
}

/// Makes steps with matrices that are factored once.
pub(super) struct Stepper<'s> {
    system: &'s System<'s>,
    source: Vec<f64>,
    scheme: Scheme,
}

enum Scheme {
    First(Lu),
    /// Both stages have the same matrix. That of first order is factored when it is first needed.
    Second {
        stages: Lu,
        first: Option<Box<Lu>>,
    },
}

impl<'s> Stepper<'s> {
    /// Factors the matrix of the scheme; `None` where the control stops first.
    pub(super) fn new(system: &'s System<'s>, control: &Control) -> Result<Option<Self>, TransportError> {
        let rate = 1.0 / system.parameters.step;
        let scheme = match system.parameters.scheme {
            TimeScheme::First => factored(system, rate, control)?.map(Scheme::First),
            TimeScheme::Second => {
                factored(system, rate / GAMMA, control)?.map(|stages| Scheme::Second { stages, first: None })
            }
        };
        Ok(scheme.map(|scheme| Self { system, source: system.source(), scheme }))
    }

    /// Makes a step; `None` where the control stops first.
    pub(super) fn step(
        &mut self,
        values: &[f64],
        control: &Control,
    ) -> Result<Option<Stepped>, TransportError> {
        let (system, step) = (self.system, self.system.parameters.step);
        let solve = |solver: &Lu, rate: f64, values: &[f64]| -> Result<Vec<f64>, TransportError> {
            let right = values.iter().zip(&self.source).enumerate();
            let mut right: Vec<f64> = right.map(|(k, (x, s))| system.volume(k) * rate * x + s).collect();
            solver.solve_in_place(&mut right)?;
            Ok(right)
        };
        let through_ends = |parts: &[(&[f64], f64)]| {
            let (mut net, mut gross) = (0.0, 0.0);
            for (values, weight) in parts {
                system.each_end_flux(values, |flux| {
                    net += weight * step * flux.amount;
                    gross += weight * step * flux.amount.abs();
                });
            }
            (net, gross)
        };
        match &mut self.scheme {
            Scheme::First(solver) => {
                let next = solve(solver, 1.0 / step, values)?;
                let (net, gross) = through_ends(&[(&next, 1.0)]);
                Ok(Some(Stepped { values: next, net, gross }))
            }
            Scheme::Second { stages, first } => {
                let rate = 1.0 / (GAMMA * step);
                let one = solve(stages, rate, values)?;
                let ahead = (1.0 - GAMMA) / GAMMA;
                let from: Vec<f64> = values.iter().zip(&one).map(|(n, y)| n + ahead * (y - n)).collect();
                let two = solve(stages, rate, &from)?;
                if two.iter().all(|x| *x >= 0.0) {
                    let (net, gross) = through_ends(&[(&one, 1.0 - GAMMA), (&two, GAMMA)]);
                    return Ok(Some(Stepped { values: two, net, gross }));
                }
                if first.is_none() {
                    *first = factored(system, 1.0 / step, control)?.map(Box::new);
                }
                let Some(solver) = first else { return Ok(None) };
                let low = solve(solver, 1.0 / step, values)?;
                Ok(Some(limited(system, &low, [(&one, 1.0 - GAMMA), (&two, GAMMA)])))
            }
        }
    }
}

/// The factors of the matrix for a rate; `None` where the control stops first.
fn factored(system: &System<'_>, rate: f64, control: &Control) -> Result<Option<Lu>, TransportError> {
    lu(system.matrix(rate)?, control)
}

/// The first-order step plus as much of the difference to second-order fluxes as keeps concentrations nonnegative: Zalesak's
/// limiter with the lower bound only.
fn limited(system: &System<'_>, low: &[f64], high: [(&[f64], f64); 2]) -> Stepped {
    let step = system.parameters.step;
    let mut fluxes = Vec::new();
    system.each_flux(low, |flux| fluxes.push((flux, 0.0)));
    for (values, weight) in high {
        let mut k = 0;
        system.each_flux(values, |flux| {
            fluxes[k].1 += weight * flux.amount;
            k += 1;
        });
    }
    let mut taken = vec![0.0; low.len()];
    for (flux, higher) in &fluxes {
        let more = step * (higher - flux.amount);
        let giver = if more > 0.0 { flux.from } else { flux.to };
        if let Some(giver) = giver {
            taken[giver] += more.abs();
        }
    }
    let share: Vec<f64> = low
        .iter()
        .zip(&taken)
        .enumerate()
        .map(|(k, (x, taken))| {
            let there = (system.volume(k) * x).max(0.0);
            if *taken > there { there / taken } else { 1.0 }
        })
        .collect();
    let mut values = low.to_vec();
    let (mut net, mut gross) = (0.0, 0.0);
    for (flux, higher) in &fluxes {
        let more = step * (higher - flux.amount);
        let giver = if more > 0.0 { flux.from } else { flux.to };
        let more = giver.map_or(1.0, |giver| share[giver]) * more;
        if let Some(from) = flux.from {
            values[from] -= more / system.volume(from);
        }
        if let Some(to) = flux.to {
            values[to] += more / system.volume(to);
        }
        if flux.from.is_none() {
            let came = step * flux.amount + more;
            net += came;
            gross += came.abs();
        }
    }
    Stepped { values, net, gross }
}
