//! Options of the neuron command.

use crate::args::Limits;
use crate::numbers::magnitude;
use clap::{ArgMatches, Args, Command, Error, FromArgMatches, Subcommand};
use std::path::PathBuf;

/// Compute what travels through a neuron, from its skeleton to a movie
#[derive(Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = "\
Skeletons are SWC files, in micrometres: comments, ids in any order, several trees, a soma of one, three or many samples, any line
ends. Without the name of a stage all of them follow each other: the skeleton is checked and filled with tricubic cells, the flow through
them is solved for, and material is transported along it. The output is a collection (.pvd) of grids of Bezier hexahedra in a folder
beside it. The configuration is that of `transport`, and [flow] as in `flow`.

Examples:
  pompeiu neuron cell.swc --config run.toml -o run.pvd --report run.html
  pompeiu neuron check cell.swc
  pompeiu neuron check cell.swc --repair --smooth 20 --spacing 0.5 -o smooth.swc
  pompeiu neuron mesh smooth.swc -o cell.vtu
  pompeiu neuron flow smooth.swc --config run.toml -o flow.vtu"
)]
pub(crate) struct Neuron {
    #[command(subcommand)]
    pub(crate) stage: Option<Stage>,
    #[command(flatten)]
    pub(crate) whole: Whole,
}

/// All stages at once, where no stage is named. The derived option of a flattened struct is none for a struct that flattens others.
pub(crate) struct Whole(pub(crate) Option<Everything>);

impl Args for Whole {
    fn augment_args(command: Command) -> Command {
        Everything::augment_args(command)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Everything::augment_args_for_update(command)
    }
}

impl FromArgMatches for Whole {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let is_given = matches.contains_id("skeleton");
        is_given.then(|| Everything::from_arg_matches(matches)).transpose().map(Self)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

#[derive(Subcommand)]
#[command(subcommand_value_name = "STAGE", subcommand_help_heading = "Stages")]
pub(crate) enum Stage {
    /// Look at the skeleton, and say what is wrong with it and where
    #[command(after_help = "\
The exit code is 1 if there are problems: several trees, samples without a radius or at the place of their parent, branches within
the balls of their nodes, branches inside others, tubes that overlap, turns by more than 60 degrees within a radius.

Examples:
  pompeiu neuron check cell.swc --json
  pompeiu neuron check cell.swc --repair -o repaired.swc")]
    Check(Check),
    /// Fill the neuron with hexahedra
    #[command(after_help = "\
Sections are discs of five blocks, each cut into parts; around nodes there are complexes that suit their degree, and the wall is a
smooth union of the tubes. Tips, and roots with one branch, end with flat caps. Sections keep the area of the discs. The exit code is
3 if a cell is not proven valid.

The output has cell data: branch (from 0; -1, -2, ... at nodes). --extraction writes the files of NeuronTransportIGA for the splines with
one function for each vertex, whose order is 2.5 only; --compare reads such files, and the exit code is 1 if they differ by more
than 1e-6. --partition writes which process works on which cell, as METIS does.

Examples:
  pompeiu neuron mesh cell.swc -o cell.vtu
  pompeiu neuron mesh cell.swc --repair --parts 3 --layer 1 --json -o fine.vtu
  pompeiu neuron mesh controlmesh.vtk --extraction splines --partition 28")]
    Mesh(Mesh),
    /// Fill the neuron with tricubic cells, and count the splines over them
    #[command(after_help = "\
Each block is one cell, a patch of cubic splines: twice continuously differentiable within patches, continuous across them. Sections
have five patches, whose rim is a circle but for 3e-4 of the radius. The exit code is 3 if a patch is not proven valid.

--refine halves elements --levels times at nodes, ends (flat ones), the wall, branch=N (the cell data branch), sample=ID (within the
sample's ball) or ball=X,Y,Z,R: truncated hierarchical splines, which contain all splines of that size there, and those without
refinement. The output then has the elements as cells, with cell data level. --extraction writes which splines each element has, and
their Bezier coefficients, in the format of NeuronTransportIGA.

Examples:
  pompeiu neuron spline cell.swc -o cell.vtu
  pompeiu neuron spline cell.swc --elements 2 --refine nodes --refine sample=57 --levels 2 -o refined.vtu
  pompeiu neuron spline cell.swc --elements 3 --json")]
    Spline(Spline),
    /// Solve for the steady viscous flow through the neuron
    #[command(after_help = "\
The fluid is at rest at the wall; it is driven at the inlet, the root's flat end, by a speed or a pressure, and all other flat ends have
a pressure. Newton's method for the equations of Navier and Stokes ends at 1e-8 of the first residual. Its table in the configuration:

  [flow]
  viscosity = \"1 mPa s\"
  density = \"1000 kg/m^3\"
  speed = \"1 um/s\"             # the mean at the inlet; or: pressure = \"10 Pa\"
  pressures = { 57 = \"1 Pa\" }  # at the ends of these samples; 0 Pa elsewhere
  [inlet]
  sample = 1

The output has the velocity at control points, in um/s, and the pressure and the branch of each cell, in Pa.

Examples:
  pompeiu neuron flow cell.swc -o flow.vtu
  pompeiu neuron flow cell.swc --config run.toml --elements 2 --json")]
    Flow(Flow),
    /// Mesh the neuron, and let material diffuse and be carried through it
    #[command(after_help = "\
Free material diffuses, attaches to motors that move away from the inlet or towards it, and detaches. Motors follow the potential flow
from the inlet, the root's flat end, to the tips. The configuration is TOML with units, or a parameter file of NeuronTransportIGA:

  [transport]
  diffusion = \"1 um^2/s\"
  speed_plus = \"1 um/s\"       # away from the inlet; speed_minus: towards it
  attach_plus = \"1 /s\"        # attach_minus, detach_plus, detach_minus
  step = \"0.1 s\"
  steps = 100
  [inlet]
  free = 1.0                   # or \"closed\"
  plus = 2.0
  [tips]
  free = \"closed\"
  minus = 0.0
  [initial]
  free = 0.0                   # plus, minus

The ends of a mesh are where the \"label\" of its vertices says so, 1 for the inlet, 2 and more for others, or sides of the box around
it: side = \"-x\" in [inlet], sides = [\"+x\"] in [tips]. Heat is free material, with all speeds and rates 0.

The output is a collection (.pvd) of grids in a folder beside it. The exit code is 3 if the time limit or Ctrl-C ended it early; with
--checkpoint FILE, --resume FILE goes on from there, bit for bit.

Examples:
  pompeiu neuron transport cell.swc --config run.toml -o run.pvd --tips tips.csv
  pompeiu neuron transport cell.swc --config simulation_parameter.txt --json")]
    Transport(Transport),
}

#[derive(Args)]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) skeleton: SkeletonChoice,
    /// The skeleton file to write (.swc), after repair, smoothing and resampling
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct Mesh {
    #[command(flatten)]
    pub(crate) skeleton: SkeletonChoice,
    #[command(flatten)]
    pub(crate) blocks: Blocks,
    /// The mesh file to write (.vtu)
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Write controlmesh.vtk, bzmeshinfo.txt, bzpt.txt and cmat.txt into this folder
    #[arg(long, value_name = "FOLDER")]
    pub(crate) extraction: Option<PathBuf>,
    /// Compare with bzmeshinfo.txt, bzpt.txt and cmat.txt in this folder, those there are
    #[arg(long, value_name = "FOLDER")]
    pub(crate) compare: Option<PathBuf>,
    /// Deal the cells out to N processes, in a file .epart.N beside OUT or beside bzmeshinfo.txt
    #[arg(long, value_parser = clap::value_parser!(u32).range(2..=1_000_000), value_name = "N")]
    pub(crate) partition: Option<u32>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}

#[derive(Args)]
pub(crate) struct Spline {
    #[command(flatten)]
    pub(crate) skeleton: SkeletonChoice,
    #[command(flatten)]
    pub(crate) patches: Patches,
    /// Halve elements here: nodes, ends, wall, branch=N, sample=ID or ball=X,Y,Z,R; may be given more than once
    #[arg(long, value_name = "WHERE")]
    pub(crate) refine: Vec<String>,
    /// How often elements are halved where --refine says so
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=5), requires = "refine", value_name = "N")]
    pub(crate) levels: u8,
    /// Write bzmeshinfo.txt, bzpt.txt and cmat.txt of the elements into this folder
    #[arg(long, value_name = "FOLDER")]
    pub(crate) extraction: Option<PathBuf>,
    /// The file to write (.vtu)
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}

#[derive(Args)]
pub(crate) struct Flow {
    #[command(flatten)]
    pub(crate) skeleton: SkeletonChoice,
    #[command(flatten)]
    pub(crate) patches: Patches,
    /// Parameters: TOML with units
    #[arg(long, value_name = "FILE")]
    pub(crate) config: Option<PathBuf>,
    /// The file to write (.vtu)
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}

/// How patches are cut and written.
#[derive(Args)]
pub(crate) struct Patches {
    /// Elements of each patch along each edge
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=4), value_name = "N")]
    pub(crate) elements: u8,
    /// Length of a patch along a branch, in radii
    #[arg(long, default_value = "2", value_parser = magnitude, value_name = "RADII")]
    pub(crate) layer: f64,
    /// Write trilinear cells, 27 for each tricubic one, instead of Bezier hexahedra
    #[arg(long)]
    pub(crate) linear: bool,
}

/// All stages.
#[derive(Args)]
pub(crate) struct Everything {
    #[command(flatten)]
    pub(crate) transport: Transport,
    /// Elements of each patch along each edge, for the flow; transport cuts each into parts
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=4), value_name = "N")]
    pub(crate) elements: u8,
    /// Write trilinear cells instead of Bezier hexahedra
    #[arg(long)]
    pub(crate) linear: bool,
}

#[derive(Args)]
pub(crate) struct Transport {
    #[command(flatten)]
    pub(crate) skeleton: SkeletonChoice,
    #[command(flatten)]
    pub(crate) blocks: Blocks,
    /// Parameters: TOML with units, or pairs of names and values
    #[arg(long, value_name = "FILE")]
    pub(crate) config: Option<PathBuf>,
    /// The collection to write (.pvd), with a grid for each frame beside it
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Frames that are written, the first and the last among them
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(2..=100_000), value_name = "N")]
    pub(crate) frames: u32,
    /// Concentrations at the flat ends after each step, as CSV
    #[arg(long, value_name = "OUT")]
    pub(crate) tips: Option<PathBuf>,
    /// Write a page that plays the transport, with concentrations at the ends over time: one file that needs no network
    #[arg(long, value_name = "FILE.html")]
    pub(crate) report: Option<PathBuf>,
    /// Write the state in the end, however it ended
    #[arg(long, value_name = "FILE")]
    pub(crate) checkpoint: Option<PathBuf>,
    /// Go on from a state that --checkpoint wrote, with the same options; steps count from the beginning
    #[arg(long, value_name = "FILE")]
    pub(crate) resume: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}

/// How the blocks of a mesh are cut.
#[derive(Args)]
pub(crate) struct Blocks {
    /// Parts of each block along each edge: 1, 2 and 3 give 5, 20 and 45 cells to a section
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u8).range(1..=8), value_name = "N")]
    pub(crate) parts: u8,
    /// Length of a block along a branch, in radii
    #[arg(long, default_value = "2", value_parser = magnitude, value_name = "RADII")]
    pub(crate) layer: f64,
}

/// The skeleton, and what is done to it before anything else.
#[derive(Args)]
pub(crate) struct SkeletonChoice {
    /// The skeleton file (SWC), or a hexahedral mesh (.vtk, .vtu)
    pub(crate) skeleton: PathBuf,
    /// Repair what can be repaired: missing parents, cycles, missing radii, coincident samples, branches within the ball of their
    /// node; each repair is told
    #[arg(long)]
    pub(crate) repair: bool,
    /// Steps of smoothing along branches, radius included
    #[arg(long, default_value_t = 0, value_parser = clap::value_parser!(u32).range(..=100_000), value_name = "N")]
    pub(crate) smooth: u32,
    /// Distance of new samples along smooth branches, in micrometres
    #[arg(long, value_parser = spacing, value_name = "LENGTH")]
    pub(crate) spacing: Option<f64>,
}

fn spacing(text: &str) -> Result<f64, String> {
    magnitude(text).and_then(|length| {
        if length > 0.0 { Ok(length) } else { Err("expected a length above 0".to_owned()) }
    })
}
