//! What can be asked: the options of [`CoupleRequest`], as every door offers them.

mod scene;

pub use scene::{Kind, Scene, SceneError};

use crate::scenario::{RunReport, advance};
use crate::{Closed, Coupling, CouplingError, CouplingOptions, Scheme, Subproblem};
use pompeiu_core::request::{Limit, Report, Request};
use pompeiu_core::run::{Control, Progress, RunContext, StopReason};

/// Make a fluid and a solid agree at the interface between them, window by window in time.
///
/// What is not given is as the scene says, or as [`CouplingOptions`] has it.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CoupleRequest {
    /// The coupling scheme: fixed, constant:W, aitken, aitken:W, iqn-ils, iqn-imvj, two-models.
    #[cfg_attr(feature = "clap", arg(long, value_name = "SCHEME"))]
    pub scheme: Option<Scheme>,
    /// Number of windows in time.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub windows: Option<usize>,
    /// The relative change of both data below which a window is done.
    #[cfg_attr(feature = "clap", arg(long, value_name = "T"))]
    pub tolerance: Option<f64>,
    /// Largest number of solves of an attempt at a window.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub most_solves: Option<usize>,
    /// Number of earlier windows whose solves are used again.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub reuse: Option<usize>,
    /// Leave columns out whose new part is shorter than this part of them.
    #[cfg_attr(feature = "clap", arg(long, value_name = "E"))]
    pub filter: Option<f64>,
    /// Order of the extrapolation of first guesses: 0, 1, 2.
    #[cfg_attr(feature = "clap", arg(long, value_name = "ORDER"))]
    pub extrapolate: Option<usize>,
    /// The treatment of an enclosed fluid.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "WHAT"))]
    pub closed: Option<Closed>,
    /// Run the scene with all schemes, for a table.
    #[cfg_attr(feature = "clap", arg(long))]
    pub compare: bool,
}

impl Request for CoupleRequest {
    const NAME: &'static str = "couple";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time];
    type Report = CoupleReport;
}

/// The report.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CoupleReport {
    /// The problem: piston, tube, channel, box, or solvers that were given.
    pub kind: String,
    /// Windows that were asked for.
    pub windows: usize,
    /// The run, or one for each scheme that is compared.
    pub runs: Vec<RunReport>,
    /// The reason for which the computation ended.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub stop: StopReason,
}

impl Report for CoupleReport {
    fn stop(&self) -> StopReason {
        self.stop
    }
}

impl CoupleReport {
    fn new(kind: &str, windows: usize, runs: Vec<RunReport>, control: &Control) -> Self {
        let is_done = runs.iter().any(|run| run.windows.len() == windows);
        let ended = if is_done { StopReason::Tolerance } else { StopReason::Stalled };
        Self { kind: kind.to_owned(), windows, runs, stop: control.reason().unwrap_or(ended) }
    }
}

/// Schemes that are compared, beside that of the scene.
const COMPARED: [Scheme; 7] = [
    Scheme::Fixed,
    Scheme::Constant(0.1),
    Scheme::Constant(0.01),
    Scheme::Aitken(0.5),
    Scheme::IqnIls,
    Scheme::IqnImvj,
    Scheme::TwoModels,
];

/// Windows where nothing says how many.
const WINDOWS: usize = 100;

/// Gets the number of a window, the data that both solvers agree on, and what the first one gave for it.
type Watch<'w> = dyn FnMut(usize, &[f64], &[f64]) + 'w;

impl CoupleRequest {
    fn replaced(&self, options: &CouplingOptions) -> CouplingOptions {
        CouplingOptions {
            scheme: self.scheme.unwrap_or(options.scheme),
            tolerance: self.tolerance.unwrap_or(options.tolerance),
            most_solves: self.most_solves.unwrap_or(options.most_solves),
            reuse: self.reuse.unwrap_or(options.reuse),
            filter: self.filter.unwrap_or(options.filter),
            extrapolation: self.extrapolate.unwrap_or(options.extrapolation),
            closed: self.closed.unwrap_or(options.closed),
            ..options.clone()
        }
    }

    /// Runs a scene; with `compare` once with each scheme, that of the scene first. `watch` gets the number of each window, the data that
    /// both solvers agree on, and what the first one gave for it.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn run(
        &self,
        scene: &Scene,
        watch: &mut (impl FnMut(usize, &[f64], &[f64]) + Send),
        context: &RunContext<'_>,
    ) -> Result<CoupleReport, SceneError> {
        let (scenario, options) = (scene.scenario()?, self.replaced(&scene.options()));
        let windows = self.windows.or(scene.windows).unwrap_or(WINDOWS);
        let mut schemes = vec![options.scheme];
        if self.compare {
            schemes.extend(COMPARED.into_iter().filter(|scheme| *scheme != options.scheme));
        }
        let control = context.control();
        let all = (schemes.len() * windows).max(1) as f64;
        let runs = context.on_threads(|| {
            let mut runs = Vec::with_capacity(schemes.len());
            for (i, scheme) in schemes.into_iter().enumerate() {
                let options = CouplingOptions { scheme, ..options.clone() };
                let run = scenario.run(&options, windows, &mut |window, x, y| {
                    watch(window, x, y);
                    tell(context, &control, (i * windows + window) as f64 / all)
                })?;
                runs.push(run);
                if control.is_stopped() {
                    break;
                }
            }
            Ok::<_, CouplingError>(runs)
        })?;
        Ok(CoupleReport::new(scene.kind()?.name(), windows, runs, &control))
    }

    /// Couples two solvers from the interface data `x0`; the first gives y for x, the second x for y. One window unless `windows` says
    /// more.
    ///
    /// # Errors
    /// [`SceneError::Coupling`] for numbers that make no sense; [`SceneError::Compare`], because solvers cannot be started again.
    pub fn run_pair<F: Subproblem, S: Subproblem>(
        &self,
        (fluid, solid): (F, S),
        x0: &[f64],
        watch: &mut Watch<'_>,
        context: &RunContext<'_>,
    ) -> Result<CoupleReport, SceneError> {
        if self.compare {
            return Err(SceneError::Compare);
        }
        let options = self.replaced(&CouplingOptions::default());
        let windows = self.windows.unwrap_or(1);
        let control = context.control();
        let coupling = Coupling::new(fluid, solid, x0, options.clone())?;
        let run = advance(coupling, &options, windows, &mut |window, x, y| {
            watch(window, x, y);
            tell(context, &control, window as f64 / windows.max(1) as f64)
        });
        Ok(CoupleReport::new("solvers", windows, vec![run], &control))
    }
}

/// Tells the share of windows that are done; gives whether to go on.
fn tell(context: &RunContext<'_>, control: &Control, share: f64) -> bool {
    let progress = Progress { doing: "coupling", share: Some(share) };
    if context.progress().is_some_and(|observer| observer.progress(&progress).is_break()) {
        control.stop(StopReason::Cancelled);
    }
    share >= 1.0 || !control.is_stopped()
}
