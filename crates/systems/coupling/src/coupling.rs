//! Time windows in sequence.

use crate::added_mass::AddedMass;
use crate::columns::difference;
use crate::iteration::{Iteration, Memory, relative};
use crate::{Closed, CouplingError, CouplingOptions, Imbalance, Refusal, Scheme, Subproblem, WindowReport};

/// Largest number of interface values for the dense matrix of IQN-IMVJ: half a gigabyte.
const MOST_DENSE: usize = 8192;

/// Inflow minus outflow, relative to both, that counts as zero.
const BALANCED: f64 = 1e-13;

/// Inflow minus outflow, relative to both, above which an enclosed region is rejected unless it is to be corrected.
const REFUSED: f64 = 1e-9;

/// Steps of the secant method for the pressure constant; a linear solid needs two.
const MOST_SECANTS: usize = 20;

/// Two coupled solvers with the data of their previous solves.
///
/// # Shapes and units
/// The first maps x to y, the second y to x. Units are those of the solvers: changes are relative to the norm of x and of y.
/// # Cost
/// One solve of both solvers for each iteration, plus O(n c²) for n values and c ≤ 50 columns, O(n² c) for IQN-IMVJ.
#[derive(Debug)]
pub struct Coupling<F, S> {
    fluid: F,
    solid: S,
    options: CouplingOptions,
    memory: Memory,
    /// Accepted interface data, the newest first.
    accepted: Vec<Vec<f64>>,
    y: Option<Vec<f64>>,
    window: usize,
    constant: Constant,
    /// The damping factor with which the last window ended.
    rung: usize,
}

/// The pressure constant of an enclosed region.
#[derive(Clone, Copy, Debug, Default)]
struct Constant {
    value: f64,
    /// Derivative of the inflow by the constant.
    slope: Option<f64>,
    /// The largest flow in and out so far, the scale for the remainder: at the end of a motion only rounding errors remain.
    gross: f64,
}

/// An attempt that succeeded.
struct Agreed {
    x: Vec<f64>,
    y: Vec<f64>,
    change: f64,
    solves: usize,
}

/// An attempt that failed.
struct Failed {
    solves: usize,
    change: f64,
    refusal: Option<Refusal>,
    added_mass: Option<AddedMass>,
}

enum Outcome {
    Agreed(Agreed),
    Failed(Failed),
}

impl<F: Subproblem, S: Subproblem> Coupling<F, S> {
    /// Couples two solvers from given interface data.
    ///
    /// # Errors
    /// [`CouplingError`] if options are invalid, or if the outputs of one solver do not match the inputs of the other.
    pub fn new(fluid: F, solid: S, x0: &[f64], options: CouplingOptions) -> Result<Self, CouplingError> {
        options.check()?;
        let fits = |what, found: usize, expected: usize| {
            if found == expected { Ok(()) } else { Err(CouplingError::Length { what, found, expected }) }
        };
        fits("first input", x0.len(), fluid.inputs())?;
        fits("output of the second solver", solid.outputs(), fluid.inputs())?;
        fits("output of the first solver", fluid.outputs(), solid.inputs())?;
        if options.scheme == Scheme::IqnImvj && x0.len() > MOST_DENSE {
            return Err(CouplingError::TooLarge { found: x0.len(), most: MOST_DENSE });
        }
        if let Some(value) = x0.iter().find(|x| !x.is_finite()) {
            let (what, expected) = ("first input", "a number");
            return Err(CouplingError::Parameter { what, value: *value, expected });
        }
        Ok(Self {
            fluid,
            solid,
            options,
            memory: Memory::default(),
            accepted: vec![x0.to_vec()],
            y: None,
            window: 0,
            constant: Constant::default(),
            rung: 0,
        })
    }

    /// The first solver.
    pub fn fluid(&self) -> &F {
        &self.fluid
    }

    /// The second solver.
    pub fn solid(&self) -> &S {
        &self.solid
    }

    /// Number of converged windows.
    pub fn windows(&self) -> usize {
        self.window
    }

    /// The converged interface data.
    pub fn x(&self) -> &[f64] {
        &self.accepted[0]
    }

    /// The output of the first solver for it; none before the first window.
    pub fn y(&self) -> Option<&[f64]> {
        self.y.as_deref()
    }

    /// Solves the next window. On failure the state is unchanged.
    ///
    /// # Errors
    /// [`CouplingError::NotConverged`] with the reason if known; [`CouplingError::Closed`] and
    /// [`CouplingError::ClosedUnsolved`] for enclosed regions.
    pub fn advance(&mut self) -> Result<WindowReport, CouplingError> {
        let mut report = WindowReport::default();
        let mut worst: Option<Failed> = None;
        for (damping, forgets) in self.attempts() {
            if forgets {
                self.memory.clear();
            }
            let mut memory = std::mem::take(&mut self.memory);
            let mut iteration = Iteration::new(&self.options, &memory, damping);
            let outcome = attempt(
                (&mut self.fluid, &mut self.solid),
                (&self.accepted, self.y.as_deref()),
                &mut self.constant,
                &mut iteration,
                &self.options,
                self.window + 1,
            );
            match outcome {
                Ok(Outcome::Agreed(agreed)) => {
                    (report.columns, report.dropped) = (iteration.columns, iteration.dropped);
                    report.added_mass = AddedMass::of(iteration.composed().iter());
                    let learned = iteration.into_memory();
                    memory.keep(learned, self.options.reuse);
                    self.memory = memory;
                    report.solves += agreed.solves;
                    (report.damping, report.change) = (damping, agreed.change);
                    let closed = self.fluid.imbalance(&agreed.x).is_some();
                    report.pressure_constant = closed.then_some(self.constant.value);
                    self.fluid.accept();
                    self.solid.accept();
                    self.accepted.insert(0, agreed.x);
                    self.accepted.truncate(3);
                    self.y = Some(agreed.y);
                    self.window += 1;
                    self.rung = self.options.damping.iter().position(|&part| part == damping).unwrap_or(0);
                    return Ok(report);
                }
                Ok(Outcome::Failed(mut failed)) => {
                    failed.added_mass = AddedMass::of(iteration.composed().iter());
                    self.memory = memory;
                    report.solves += failed.solves;
                    report.failed_attempts += 1;
                    let better = worst.as_ref().is_none_or(|w| failed.change < w.change);
                    let kept = worst.take();
                    worst = Some(match kept {
                        Some(mut kept) if !better => {
                            kept.refusal = failed.refusal.or(kept.refusal);
                            kept
                        }
                        _ => failed,
                    });
                }
                Err(error) => {
                    self.memory = memory;
                    self.reject();
                    return Err(error);
                }
            }
            self.reject();
        }
        let failed = worst.unwrap_or(Failed { solves: 0, change: f64::NAN, refusal: None, added_mass: None });
        Err(CouplingError::NotConverged {
            window: self.window + 1,
            solves: report.solves,
            change: failed.change,
            tolerance: self.options.tolerance,
            added_mass: failed.added_mass,
            refusal: failed.refusal,
        })
    }

    fn reject(&mut self) {
        self.fluid.reject();
        self.solid.reject();
    }

    /// The damping factors to try, first with the model from earlier windows, then without.
    fn attempts(&self) -> Vec<(f64, bool)> {
        let parts = match self.options.damping.as_slice() {
            parts if self.options.scheme.has_model() && !parts.is_empty() => parts,
            _ => &[1.0],
        };
        let with = parts[self.rung.min(parts.len() - 1)..].iter().map(|&part| (part, false));
        let without = parts.iter().map(|&part| (part, true));
        let forgets = self.options.scheme.has_model() && !self.memory.is_empty();
        with.chain(without.filter(|_| forgets)).collect()
    }
}

/// The initial guess of a window: polynomial extrapolation of the last ones.
fn guess(accepted: &[Vec<f64>], order: usize) -> Vec<f64> {
    let weights: &[f64] = match order.min(accepted.len() - 1) {
        0 => &[1.0],
        1 => &[2.0, -1.0],
        _ => &[3.0, -3.0, 1.0],
    };
    let value = |i: usize| weights.iter().zip(accepted).map(|(w, x)| w * x[i]).sum();
    (0..accepted[0].len()).map(value).collect()
}

fn attempt<F: Subproblem, S: Subproblem>(
    (fluid, solid): (&mut F, &mut S),
    (accepted, last_y): (&[Vec<f64>], Option<&[f64]>),
    constant: &mut Constant,
    iteration: &mut Iteration<'_>,
    options: &CouplingOptions,
    window: usize,
) -> Result<Outcome, CouplingError> {
    let mut x = guess(accepted, options.extrapolation);
    let mut before = last_y.map(<[f64]>::to_vec);
    let (mut y, mut out) = (vec![0.0; fluid.outputs()], vec![0.0; solid.outputs()]);
    let mut least = f64::INFINITY;
    let failed =
        |solves, change, refusal| Ok(Outcome::Failed(Failed { solves, change, refusal, added_mass: None }));
    for solves in 1..=options.most_solves {
        if let Err(refusal) = fluid.solve(&x, &mut y) {
            return failed(solves, least, Some(refusal));
        }
        let mut given = iteration.between(&x, &y);
        let solved = match fluid.imbalance(&x) {
            None => solid.solve(&given, &mut out).map(|()| true),
            Some(now) => {
                if options.closed == Closed::Refuse && now.net.abs() > REFUSED * now.gross {
                    return Err(CouplingError::Closed { window, net: now.net });
                }
                take_in(fluid, solid, constant, &mut given, &mut out)
            }
        };
        match solved {
            Ok(true) => {}
            Ok(false) => {
                let net = fluid.imbalance(&out).map_or(f64::NAN, |imbalance| imbalance.net);
                return Err(CouplingError::ClosedUnsolved { window, net });
            }
            Err(refusal) => return failed(solves, least, Some(refusal)),
        }
        if y.iter().chain(&out).any(|value| !value.is_finite()) {
            return failed(solves, least, Some(Refusal::new("values are no longer finite")));
        }
        let change = relative(&difference(&out, &x), &out);
        // Two models: the data between the solvers has converged when the second got what the first gave.
        let between = match (&before, options.scheme) {
            (_, Scheme::TwoModels) => {
                relative(&difference(&given, &with_constant(&y, &given, fluid, &x, constant)), &given)
            }
            (Some(before), _) => relative(&difference(&given, before), &given),
            (None, _) => f64::INFINITY,
        };
        let greater = if between > change { between } else { change };
        if greater < least {
            least = greater;
        }
        if change <= options.tolerance && between <= options.tolerance {
            iteration.record(&x, &y, &given, &out);
            return Ok(Outcome::Agreed(Agreed { x: out, y: given, change, solves }));
        }
        let next = iteration.next(&x, &y, &given, &out);
        before = Some(given);
        x = next;
        if x.iter().any(|value| !value.is_finite()) {
            return failed(solves, least, None);
        }
    }
    failed(options.most_solves, least, None)
}

/// The output of the first solver, with the pressure constant if there is one.
fn with_constant<F: Subproblem>(
    y: &[f64],
    given: &[f64],
    fluid: &F,
    x: &[f64],
    constant: &Constant,
) -> Vec<f64> {
    debug_assert_eq!(y.len(), given.len());
    let constant = if fluid.imbalance(x).is_some() { constant.value } else { 0.0 };
    y.iter().map(|y| y + constant).collect()
}

/// Computes the pressure constant for which the displacement of the solid equals the inflow, by the secant method; the slope is kept.
///
/// On return `given` contains the constant. False if there is none.
fn take_in<F: Subproblem, S: Subproblem>(
    fluid: &F,
    solid: &mut S,
    constant: &mut Constant,
    given: &mut [f64],
    out: &mut [f64],
) -> Result<bool, Refusal> {
    let free = given.to_vec();
    let mut net_at = |value: f64, given: &mut [f64], out: &mut [f64]| -> Result<Imbalance, Refusal> {
        for (given, free) in given.iter_mut().zip(&free) {
            *given = free + value;
        }
        solid.solve(given, out)?;
        Ok(fluid.imbalance(out).unwrap_or(Imbalance { net: 0.0, gross: 0.0 }))
    };
    let mut value = constant.value;
    let mut now = net_at(value, given, out)?;
    for _ in 0..MOST_SECANTS {
        if now.gross > constant.gross {
            constant.gross = now.gross;
        }
        let gross = constant.gross;
        // Rounding of the solid's answer is all that may be left.
        if now.net.abs() <= BALANCED * gross {
            constant.value = value;
            return Ok(true);
        }
        let step = match constant.slope {
            Some(slope) if slope != 0.0 => -now.net / slope,
            _ => 1.0,
        };
        let next = net_at(value + step, given, out)?;
        constant.slope =
            Some((next.net - now.net) / step).filter(|slope| slope.is_finite()).or(constant.slope);
        // The last step may be one of rounding alone.
        if next.net.abs() >= now.net.abs() && now.net.abs() <= 1e3 * BALANCED * gross {
            net_at(value, given, out)?;
            constant.value = value;
            return Ok(true);
        }
        (value, now) = (value + step, next);
    }
    Ok(false)
}
