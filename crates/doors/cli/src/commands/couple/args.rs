//! Options of the couple command.

use crate::numbers::duration;
use clap::Args;
use std::path::PathBuf;
use std::time::Duration;

/// Make a fluid and a solid agree at the interface between them, window by window in time
#[derive(Args)]
#[command(after_help = "\
A scene says what is coupled and how; options of the command line replace what it says.

  kind = \"tube\"              # piston, tube, channel, box
  windows = 100
  time-step = 0.01
  [tube]
  modulus = 1e4              # of the wall

  [piston]   mass, stiffness, fluid-mass, start, rule
  [tube]     length, segments, modulus, mean, amplitude, frequency
  [channel]  height, cells, density, rule, advect, pressure, duration
  [box]      height, cells, density, rule, advect, volume, duration
  [wall]     mass, stiffness, tension, damping, ends; of channel and box
  [coupling] scheme, tolerance, most-solves, reuse, filter, extrapolate, closed

Schemes: fixed, constant:W, aitken, aitken:W, iqn-ils, iqn-imvj, two-models. One solve is one of the fluid and one of the solid.

Exit codes:
  0  all windows were solved; with --compare: some scheme solved all
  2  the scene or an argument cannot be used
  3  a window could not be solved, the time limit was reached, or Ctrl-C; what was solved before is written

Examples:
  pompeiu couple tube.toml
  pompeiu couple tube.toml --compare
  pompeiu couple channel.toml --scheme aitken -o wall.csv --json")]
pub(crate) struct Couple {
    /// The scene
    #[arg(value_name = "SCENE.toml")]
    pub(crate) scene: PathBuf,
    /// How the next input is found: fixed, constant:W, aitken[:W], iqn-ils, iqn-imvj, two-models
    #[arg(long, value_name = "SCHEME")]
    pub(crate) scheme: Option<String>,
    /// Windows in time
    #[arg(long, value_name = "N")]
    pub(crate) windows: Option<usize>,
    /// The relative change of both data below which a window is done
    #[arg(long, value_name = "T")]
    pub(crate) tolerance: Option<f64>,
    /// Solves of an attempt at a window at most
    #[arg(long, value_name = "N")]
    pub(crate) most_solves: Option<usize>,
    /// Earlier windows whose solves are used again
    #[arg(long, value_name = "N")]
    pub(crate) reuse: Option<usize>,
    /// Leave columns out whose new part is shorter than this part of them
    #[arg(long, value_name = "E")]
    pub(crate) filter: Option<f64>,
    /// Order of the extrapolation of first guesses: 0, 1, 2
    #[arg(long, value_name = "ORDER")]
    pub(crate) extrapolate: Option<usize>,
    /// What to do about an enclosed fluid: project, refuse
    #[arg(long, value_name = "WHAT")]
    pub(crate) closed: Option<String>,
    /// Run the scene with all schemes, and print a table
    #[arg(long)]
    pub(crate) compare: bool,
    /// Write interface data of each window: displacements or cross-sections, and pressures
    #[arg(short, long, value_name = "FILE.csv", conflicts_with = "compare")]
    pub(crate) output: Option<PathBuf>,
    /// Stop after this time, such as 10s, with the windows that are solved
    #[arg(long, value_parser = duration, value_name = "TIME")]
    pub(crate) time_limit: Option<Duration>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}
