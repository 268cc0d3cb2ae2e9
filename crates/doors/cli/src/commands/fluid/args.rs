//! Options of the fluid command.

use crate::args::{Limits, Picture, suffix};
use crate::numbers::{magnitude, tuple};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use pompeiu::fluid::square::{Edges, SquareScheme};
use pompeiu::fluid::{Correction, Diffusion, Integrator, Scheme, Transport, ViscosityModel, Wall};
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Let a fluid flow on a surface, and carry things along
#[derive(Args)]
#[command(after_help = "\
The mesh must be an oriented manifold, with or without boundary, of any genus. A scene is a TOML file with the options below, under
their names with `_` for `-`, and with vortices, densities, sources, forces and moving walls; options on the command line come first.
Nothing flows through the boundary but where a scene says so.

Scenes:
  steps = 200
  dt = 0.01
  viscosity = 1e-3
  velocity = \"rotation:z\"        # or vorticity = \"sin(3*x)*y\"

  [[vortex]]                     # a Gaussian of vorticity
  at = [0, 0, 1]
  circulation = 2
  radius = 0.2

  [[density]]
  name = \"dye\"
  initial = \"exp(-9*x^2)\"        # an expression in x, y and z
  diffusivity = 1e-4
  weight = 1                     # pulled by gravity; below zero for what rises
  source = [{ at = [0, 1, 0], radius = 0.1, rate = 5 }, { picture = \"smoke.png\", rate = 1 }]

  A picture lies over the square, or over the box around the mesh as seen from above (axis = \"z\", or \"x\", \"y\"); what is
  black counts in full, what is white not at all. `picture = \"FILE\"` beside `initial` starts a density from one.

  [[force]]                      # an acceleration in a ball
  at = [1, 0, 0]
  radius = 0.2
  acceleration = [0, 1, 0]

  [[moving_wall]]                # boundary edges in a ball move along themselves
  at = [0, 1, 0]
  radius = 0.5
  speed = 1

  [[inflow]]                     # through boundary edges in a ball; beside it [[outflow]] with `at` and `radius`
  at = [-1, 0, 0]
  radius = 0.5
  speed = 1

Velocities:
  rotation:AXIS, random:SEED, harmonic:K, or a FILE with a vector for each face; what has divergence is taken off.
  In the square two expressions in x and y: \"sin(6*y); 0\"

Schemes:
  vorticity   vorticity at vertices and harmonic coefficients, in substeps; conserves energy and enstrophy in space (default)
  any-step    the same unknowns, traced back along the flow: stable at any step, loses energy
  faces       velocities on faces, traced back from their centroids and projected: stable at any step, loses most energy
  crouzeix-raviart   as vorticity, with viscosity on velocities at midpoints of edges: rotations never gain energy
  With `--correction linear --transport faces --diffusion edge-length` the scheme faces is that of Stable Fluids on triangle meshes
  as it is often first written.

OUT.pvd lists one VTP file for each step, with velocity, vorticity and densities, for ParaView. Ctrl-C ends the run after the present
step and keeps what is done; the exit code is then 3. With --checkpoint FILE, --resume FILE goes on from there, bit for bit.

Examples:
  pompeiu fluid sphere.obj --velocity rotation:z --viscosity 0.1 --steps 100 --dt 0.01 --json
  pompeiu fluid --square 128 --lid 1 --viscosity 0.01 --steps 300 --dt 0.05 --video cavity.html
  pompeiu fluid bunny.off smoke.toml --steps 300 --dt 0.02 -o smoke.pvd --video smoke.html")]
pub(crate) struct Fluid {
    /// The mesh file
    #[arg(required_unless_present = "square")]
    pub(crate) mesh: Option<PathBuf>,
    /// A scene
    #[arg(value_name = "SCENE.toml")]
    pub(crate) scene: Option<PathBuf>,
    /// The unit square of N x N cells instead of a mesh
    #[arg(long, value_name = "N")]
    pub(crate) square: Option<usize>,
    /// How the square stores velocities: mac, stam (solved directly) or stam:SWEEPS of Gauss and Seidel
    #[arg(long, value_parser = grid, value_name = "GRID")]
    pub(crate) grid: Option<SquareScheme>,
    /// What is at the edges of the square: walls, periodic or channel:SPEED (inflow on the left)
    #[arg(long, value_parser = edges, value_name = "EDGES")]
    pub(crate) edges: Option<Edges>,
    /// The velocity of the upper wall of the square, to the right
    #[arg(long, allow_hyphen_values = true, value_name = "SPEED")]
    pub(crate) lid: Option<f64>,
    /// A black and white picture of the square; what is dark is an obstacle
    #[arg(long, value_name = "PICTURE")]
    pub(crate) obstacles: Option<PathBuf>,
    /// Number of steps
    #[arg(long, value_name = "N")]
    pub(crate) steps: Option<usize>,
    /// Length of a step in time; with --cfl the longest
    #[arg(long, value_name = "T")]
    pub(crate) dt: Option<f64>,
    /// Halve the step until no more than this part of what a dual cell holds flows out of it in a step
    #[arg(long, value_parser = magnitude, value_name = "NUMBER")]
    pub(crate) cfl: Option<f64>,
    /// How the velocity is stored and advected
    #[arg(long, value_parser = named(&Scheme::ALL.map(Scheme::name), Scheme::named), value_name = "NAME")]
    pub(crate) scheme: Option<Scheme>,
    /// How the vorticity moves on in time
    #[arg(long, value_parser = named(&Integrator::ALL.map(Integrator::name), Integrator::named), value_name = "NAME")]
    pub(crate) integrator: Option<Integrator>,
    /// What is done about the blur of what is traced back
    #[arg(long, value_parser = named(&Correction::ALL.map(Correction::name), Correction::named), value_name = "NAME")]
    pub(crate) correction: Option<Correction>,
    /// By which weights of edges what is stored on faces diffuses; edge-length is no Laplacian and depends on the mesh
    #[arg(long, value_parser = named(&Diffusion::ALL.map(Diffusion::name), Diffusion::named), value_name = "NAME")]
    pub(crate) diffusion: Option<Diffusion>,
    /// Kinematic viscosity, squared length per time
    #[arg(long, value_name = "NU")]
    pub(crate) viscosity: Option<f64>,
    /// Which Laplacian viscosity goes with; physical keeps rigid motions
    #[arg(long, value_parser = named(&ViscosityModel::ALL.map(ViscosityModel::name), ViscosityModel::named), value_name = "NAME")]
    pub(crate) viscosity_model: Option<ViscosityModel>,
    /// What a viscous flow does at the boundary
    #[arg(long, value_parser = named(&Wall::ALL.map(Wall::name), Wall::named), value_name = "NAME")]
    pub(crate) wall: Option<Wall>,
    /// How densities are carried
    #[arg(long, value_parser = named(&Transport::ALL.map(Transport::name), Transport::named), value_name = "NAME")]
    pub(crate) transport: Option<Transport>,
    /// Gravity, felt by densities that weigh something
    #[arg(long, value_parser = tuple::<3>, allow_hyphen_values = true, value_name = "X,Y,Z")]
    pub(crate) gravity: Option<[f64; 3]>,
    /// Angular velocity of the whole surface: Coriolis force
    #[arg(long, value_parser = tuple::<3>, allow_hyphen_values = true, value_name = "X,Y,Z")]
    pub(crate) rotation: Option<[f64; 3]>,
    /// An acceleration everywhere, along the surface
    #[arg(long, value_parser = tuple::<3>, allow_hyphen_values = true, value_name = "X,Y,Z")]
    pub(crate) acceleration: Option<[f64; 3]>,
    /// Strength of vorticity confinement
    #[arg(long, value_name = "STRENGTH")]
    pub(crate) confinement: Option<f64>,
    /// The velocity at first
    #[arg(long, value_name = "FIELD", allow_hyphen_values = true)]
    pub(crate) velocity: Option<String>,
    /// The vorticity at first, an expression in x, y and z
    #[arg(long, value_name = "EXPRESSION", allow_hyphen_values = true)]
    pub(crate) vorticity: Option<String>,
    /// Coefficients of the harmonic fields at first, with a vorticity
    #[arg(long, value_delimiter = ',', allow_hyphen_values = true, value_name = "C,C,…")]
    pub(crate) harmonic: Option<Vec<f64>>,
    /// A density at first, an expression in x, y and z
    #[arg(long, value_name = "EXPRESSION", allow_hyphen_values = true)]
    pub(crate) density: Option<String>,
    /// Write every step as VTP, with a list of them for ParaView
    #[arg(long, short, value_name = "OUT.pvd")]
    pub(crate) output: Option<PathBuf>,
    /// Write only every so many steps
    #[arg(long, default_value = "1", value_name = "N", requires = "output")]
    pub(crate) every: NonZeroUsize,
    /// Write the state there at the end, when interrupted, and every minute
    #[arg(long, value_name = "FILE")]
    pub(crate) checkpoint: Option<PathBuf>,
    /// Go on from a state that --checkpoint wrote, of the same mesh and scene; --steps counts from the beginning
    #[arg(long, value_name = "FILE")]
    pub(crate) resume: Option<PathBuf>,
    /// Write a page that plays the flow, as --report does
    #[arg(long, value_parser = suffix::page, value_name = "RUN.html")]
    pub(crate) video: Option<PathBuf>,
    /// Write the frames of the page as pictures into a new folder
    #[arg(long, value_name = "FOLDER")]
    pub(crate) frames: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) picture: Box<Picture>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}

/// Parses how the square stores velocities.
pub(super) fn grid(text: &str) -> Result<SquareScheme, String> {
    SquareScheme::named(text).ok_or_else(|| "expected mac, stam or stam:SWEEPS".to_owned())
}

/// Parses what is at the edges of the square.
pub(super) fn edges(text: &str) -> Result<Edges, String> {
    Edges::named(text).ok_or_else(|| "expected walls, periodic or channel:SPEED".to_owned())
}

/// Parses one of some names.
fn named<T: Clone + Send + Sync + 'static>(
    names: &[&'static str],
    parse: fn(&str) -> Option<T>,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(names.to_vec()).try_map(move |name| parse(&name).ok_or("there is no such name"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_and_edges_are_told_apart() {
        assert_eq!(grid("mac"), Ok(SquareScheme::Mac));
        assert_eq!(grid("stam:20"), Ok(SquareScheme::Stam { sweeps: Some(20) }));
        assert_eq!(edges("periodic"), Ok(Edges::Periodic));
        assert_eq!(edges("channel:1.5"), Ok(Edges::Channel { speed: 1.5 }));
        for wrong in ["", "stam:0", "stam:x", "mac:3"] {
            assert!(grid(wrong).is_err(), "{wrong}");
        }
        assert!(edges("channel").is_err() && edges("channel:x").is_err());
    }
}
