//! Problems that can be run by name, with any scheme, and compared.

use crate::channel::{Channel, ChannelOptions};
use crate::piston::{Piston, PistonOptions};
use crate::tube::{Tube, TubeOptions};
use crate::{AddedMass, Coupling, CouplingError, CouplingOptions, Subproblem, WindowReport};

/// A problem of two solvers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scenario {
    /// A column of fluid and a piston on a spring.
    Piston(PistonOptions),
    /// An elastic tube.
    Tube(TubeOptions),
    /// A channel or a box below an elastic wall.
    Channel(ChannelOptions),
}

/// Gets the number of a window, the data that both solvers agree on, and what the first one gave for it; says whether to go on.
pub type Observer<'o> = dyn FnMut(usize, &[f64], &[f64]) -> bool + 'o;

/// A run of a scenario.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RunReport {
    /// The scheme.
    pub scheme: String,
    /// The windows that were solved.
    pub windows: Vec<WindowReport>,
    /// Solves in all, those of a window that failed left out.
    pub solves: usize,
    /// The greatest added-mass number of all windows.
    pub added_mass: Option<AddedMass>,
    /// The greatest distance of the interface from that of both solvers solved at once, relative to the greatest value; for the piston
    /// (positions) and the tube (pressures).
    pub from_monolithic: Option<f64>,
    /// The reason for which the run ended early, if it did.
    pub failure: Option<String>,
}

impl RunReport {
    /// Solves of a window, on average; none without windows.
    pub fn mean_solves(&self) -> Option<f64> {
        let count = self.windows.len();
        (count > 0).then(|| self.solves as f64 / count as f64)
    }

    /// A run that is still going on.
    fn start(options: &CouplingOptions) -> Self {
        Self { scheme: options.scheme.name(), ..Self::default() }
    }

    fn add(&mut self, window: WindowReport) {
        self.solves += window.solves;
        let greater = |a: &AddedMass| self.added_mass.is_none_or(|b| a.number > b.number);
        self.added_mass = window.added_mass.filter(greater).or(self.added_mass);
        self.windows.push(window);
    }
}

/// The greatest difference so far, and the greatest value.
#[derive(Default)]
struct Distance {
    difference: f64,
    value: f64,
    is_compared: bool,
}

impl Distance {
    fn add(&mut self, found: &[f64], expected: &[f64]) {
        self.is_compared = true;
        for (a, b) in found.iter().zip(expected) {
            self.difference = self.difference.max((a - b).abs());
            self.value = self.value.max(b.abs());
        }
    }

    /// None where nothing was compared.
    fn relative(&self) -> Option<f64> {
        let relative = if self.difference == 0.0 { 0.0 } else { self.difference / self.value };
        self.is_compared.then_some(relative)
    }
}

impl Scenario {
    /// Length of a window.
    pub fn time_step(&self) -> f64 {
        match self {
            Self::Piston(options) => options.time_step,
            Self::Tube(options) => options.time_step,
            Self::Channel(options) => options.time_step,
        }
    }

    /// Runs windows. The observer gets the number of each window from 1, what both agree on, and what the first solver gave for it; it
    /// says whether to go on.
    ///
    /// A window that cannot be solved ends the run; the report says why.
    ///
    /// # Errors
    /// [`CouplingError`] for numbers that make no sense.
    pub fn run(
        &self,
        options: &CouplingOptions,
        windows: usize,
        observer: &mut Observer<'_>,
    ) -> Result<RunReport, CouplingError> {
        match *self {
            Self::Piston(piston) => {
                let piston = Piston::new(piston)?;
                let coupling =
                    Coupling::new(piston.fluid(), piston.solid(), &[piston.start()], options.clone())?;
                let mut exact = piston.monolithic(windows).into_iter();
                let mut distance = Distance::default();
                let mut report = advance(coupling, options, windows, &mut |window, x, y| {
                    distance.add(x, exact.next().as_slice());
                    observer(window, x, y)
                });
                report.from_monolithic = distance.relative();
                Ok(report)
            }
            Self::Tube(tube) => {
                let tube = Tube::new(tube)?;
                let coupling = Coupling::new(tube.fluid(), tube.solid(), &tube.start(), options.clone())?;
                let mut together = Some(tube.monolithic());
                let mut distance = Distance::default();
                let mut report = advance(coupling, options, windows, &mut |window, x, y| {
                    // Where both at once cannot be solved there is nothing to compare with.
                    together = together.take().and_then(|mut tube| tube.advance().is_ok().then_some(tube));
                    if let Some(tube) = &together {
                        distance.add(y, tube.pressure());
                    }
                    observer(window, x, y)
                });
                report.from_monolithic = together.and_then(|_| distance.relative());
                Ok(report)
            }
            Self::Channel(channel) => {
                let channel = Channel::new(channel)?;
                let (fluid, solid) = (channel.fluid()?, channel.solid()?);
                let coupling = Coupling::new(fluid, solid, &channel.start(), options.clone())?;
                Ok(advance(coupling, options, windows, observer))
            }
        }
    }
}

pub(crate) fn advance<F: Subproblem, S: Subproblem>(
    mut coupling: Coupling<F, S>,
    options: &CouplingOptions,
    windows: usize,
    observer: &mut Observer<'_>,
) -> RunReport {
    let mut report = RunReport::start(options);
    for window in 1..=windows {
        match coupling.advance() {
            Ok(solved) => report.add(solved),
            Err(error) => {
                report.failure = Some(error.to_string());
                if let CouplingError::NotConverged { added_mass: Some(added), .. } = error {
                    let greater = report.added_mass.is_none_or(|known| added.number > known.number);
                    report.added_mass = if greater { Some(added) } else { report.added_mass };
                }
                break;
            }
        }
        if !observer(window, coupling.x(), coupling.y().unwrap_or_default()) {
            report.failure = Some(format!("interrupted after window {window}"));
            break;
        }
    }
    report
}
