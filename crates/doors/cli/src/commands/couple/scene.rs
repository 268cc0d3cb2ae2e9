//! The scene: what is coupled, and how.

use super::args::Couple as Args;
use crate::commands::fluid::reader::{Reader, SceneFile};
use anyhow::{Context, anyhow, bail};
use pompeiu::coupling::channel::{ChannelOptions, Drive};
use pompeiu::coupling::piston::{PistonOptions, TimeRule};
use pompeiu::coupling::scenario::Scenario;
use pompeiu::coupling::tube::{Inlet, TubeOptions};
use pompeiu::coupling::wall::{Ends, WallOptions};
use pompeiu::coupling::{Closed, CouplingOptions, Scheme};

/// A scene that has been read.
pub(super) struct Scene {
    pub(super) kind: &'static str,
    pub(super) scenario: Scenario,
    pub(super) options: CouplingOptions,
    pub(super) windows: usize,
}

const KINDS: [&str; 4] = ["piston", "tube", "channel", "box"];

/// Windows of a scene that does not say how many.
const WINDOWS: usize = 100;

/// Bytes of a scene at most.
const LARGEST: u64 = 1 << 20;

/// Sets a field when the scene has the key.
macro_rules! set {
    ($reader:ident . $method:ident ($key:literal) => $($place:tt)+) => {
        if let Some(value) = $reader.$method($key)? {
            $($place)+ = value;
        }
    };
}

fn closed_of(name: &str) -> Option<Closed> {
    match name {
        "project" => Some(Closed::Project),
        "refuse" => Some(Closed::Refuse),
        _ => None,
    }
}

pub(super) fn read(args: &Args) -> anyhow::Result<Scene> {
    let place = args.scene.display();
    let size = std::fs::metadata(&args.scene).with_context(|| format!("{place}"))?.len();
    if size > LARGEST {
        bail!("{place}: {size} bytes are too many for a scene, expected at most {LARGEST}");
    }
    let text = std::fs::read_to_string(&args.scene).with_context(|| format!("{place}"))?;
    let file = SceneFile::parse(&args.scene, text)?;
    let mut top = file.top();
    let kind = top.name("kind", &KINDS, |name| KINDS.into_iter().find(|kind| *kind == name))?;
    let kind = top.required("kind", kind)?;
    let windows = top.count("windows")?.unwrap_or(WINDOWS);
    let time_step = top.number("time-step")?;
    let mut tables = top.tables(kind)?;
    let table = tables.pop();
    let wall = if matches!(kind, "channel" | "box") { top.tables("wall")?.pop() } else { None };
    let coupling = top.tables("coupling")?.pop();
    top.finish()?;
    let scenario = match kind {
        "piston" => Scenario::Piston(piston(table, time_step)?),
        "tube" => Scenario::Tube(tube(table, time_step)?),
        _ => Scenario::Channel(channel(table, wall, time_step, kind == "box")?),
    };
    let mut options = coupling.map_or_else(|| Ok(CouplingOptions::default()), coupling_options)?;
    replace(args, &mut options)?;
    Ok(Scene { kind, scenario, options, windows: args.windows.unwrap_or(windows) })
}

fn piston(table: Option<Reader<'_>>, time_step: Option<f64>) -> anyhow::Result<PistonOptions> {
    let mut options = PistonOptions::default();
    options.time_step = time_step.unwrap_or(options.time_step);
    let Some(mut table) = table else { return Ok(options) };
    set!(table.number("mass") => options.mass);
    set!(table.number("stiffness") => options.stiffness);
    set!(table.number("fluid-mass") => options.fluid_mass);
    set!(table.number("start") => options.start);
    options.rule = rule(&mut table)?.unwrap_or(options.rule);
    table.finish()?;
    Ok(options)
}

fn rule(table: &mut Reader<'_>) -> anyhow::Result<Option<TimeRule>> {
    table.name("rule", &["backward-euler", "trapezoidal"], TimeRule::named)
}

fn tube(table: Option<Reader<'_>>, time_step: Option<f64>) -> anyhow::Result<TubeOptions> {
    let mut options = TubeOptions::default();
    options.time_step = time_step.unwrap_or(options.time_step);
    let Some(mut table) = table else { return Ok(options) };
    set!(table.number("length") => options.length);
    set!(table.count("segments") => options.segments);
    set!(table.number("modulus") => options.modulus);
    let [mut mean, mut amplitude, mut frequency] = [10.0, 3.0, 10.0];
    set!(table.number("mean") => mean);
    set!(table.number("amplitude") => amplitude);
    set!(table.number("frequency") => frequency);
    options.inlet = Inlet::Periodic { mean, amplitude, frequency };
    table.finish()?;
    Ok(options)
}

fn channel(
    table: Option<Reader<'_>>,
    wall: Option<Reader<'_>>,
    time_step: Option<f64>,
    is_box: bool,
) -> anyhow::Result<ChannelOptions> {
    let mut options = ChannelOptions::default();
    let [mut pressure, mut volume, mut duration] = [1.0, 0.04, if is_box { 0.5 } else { 0.4 }];
    if is_box {
        options.cells = [32, 32];
        let damped = WallOptions { mass: 0.5, stiffness: 20.0, tension: 1.0, damping: 4.0, ends: Ends::Free };
        options.wall = damped;
    }
    options.time_step = time_step.unwrap_or(options.time_step);
    if let Some(mut table) = table {
        set!(table.number("height") => options.height);
        set!(table.number("density") => options.density);
        set!(table.number("duration") => duration);
        if is_box {
            set!(table.number("volume") => volume);
        } else {
            set!(table.number("pressure") => pressure);
        }
        options.rule = rule(&mut table)?.unwrap_or(options.rule);
        let advect = |name: &str| ["no", "yes"].into_iter().position(|known| known == name);
        if let Some(advects) = table.name("advect", &["yes", "no"], advect)? {
            options.advect = advects == 1;
        }
        if let Some(cells) = table.numbers("cells")? {
            let whole = |n: f64| n >= 1.0 && n.fract() == 0.0 && n <= f64::from(u32::MAX);
            match cells[..] {
                [x, y] if whole(x) && whole(y) => options.cells = [x as usize, y as usize],
                _ => bail!("`cells` is {cells:?}, expected two whole numbers, such as [192, 32]"),
            }
        }
        table.finish()?;
    }
    if let Some(mut table) = wall {
        set!(table.number("mass") => options.wall.mass);
        set!(table.number("stiffness") => options.wall.stiffness);
        set!(table.number("tension") => options.wall.tension);
        set!(table.number("damping") => options.wall.damping);
        let ends = |name: &str| Ends::named(name).filter(|ends| *ends != Ends::Periodic);
        if let Some(ends) = table.name("ends", &["held", "free"], ends)? {
            options.wall.ends = ends;
        }
        table.finish()?;
    }
    options.drive =
        if is_box { Drive::Injection { volume, duration } } else { Drive::Pulse { pressure, duration } };
    Ok(options)
}

fn coupling_options(mut table: Reader<'_>) -> anyhow::Result<CouplingOptions> {
    let mut options = CouplingOptions::default();
    let schemes = ["fixed", "constant:W", "aitken", "aitken:W", "iqn-ils", "iqn-imvj", "two-models"];
    if let Some(scheme) = table.name("scheme", &schemes, Scheme::named)? {
        options.scheme = scheme;
    }
    set!(table.number("tolerance") => options.tolerance);
    set!(table.count("most-solves") => options.most_solves);
    set!(table.count("reuse") => options.reuse);
    set!(table.number("filter") => options.filter);
    set!(table.count("extrapolate") => options.extrapolation);
    if let Some(closed) = table.name("closed", &["project", "refuse"], closed_of)? {
        options.closed = closed;
    }
    table.finish()?;
    Ok(options)
}

/// What the command line says goes before what the scene says.
fn replace(args: &Args, options: &mut CouplingOptions) -> anyhow::Result<()> {
    if let Some(name) = &args.scheme {
        options.scheme = Scheme::named(name).ok_or_else(|| {
            anyhow!("there is no scheme `{name}`; choose fixed, constant:W, aitken, aitken:W, iqn-ils, iqn-imvj or two-models")
        })?;
    }
    if let Some(name) = &args.closed {
        options.closed = closed_of(name).ok_or_else(|| {
            anyhow!("`{name}` cannot be done about an enclosed fluid; choose project or refuse")
        })?;
    }
    options.tolerance = args.tolerance.unwrap_or(options.tolerance);
    options.most_solves = args.most_solves.unwrap_or(options.most_solves);
    options.reuse = args.reuse.unwrap_or(options.reuse);
    options.filter = args.filter.unwrap_or(options.filter);
    options.extrapolation = args.extrapolate.unwrap_or(options.extrapolation);
    Ok(())
}
