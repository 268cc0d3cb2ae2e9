//! Options of the generate command.

use super::shape::Shape;
use clap::Args;

/// Make a mesh of a shape that is known exactly, or edit one; make outlines of some complexity
#[derive(Args)]
#[command(after_help = "\
The same arguments give the same file, bit for bit, on every machine.

Examples:
  pompeiu generate icosphere --radius 2 --subdivisions 5 -o sphere.ply
  pompeiu generate schwarz-lantern --segments 12 --bands 40 -o lantern.obj
  pompeiu generate torus --noise 0.01 --seed 7 -o rough.obj
  pompeiu generate cube --cells 4 --rotate 1,1,0,30 --translate 0,0,1 -o tilted.stl
  pompeiu generate wire loops.txt --rows 24 -o film.ply
  pompeiu generate polyline --points 15 --seed 3 -o shape.svg
  pompeiu generate noisy-circle --level 4 -o noise.svg
  pompeiu generate mesh scan.ply --subdivide 1 --shuffle 1 -o same.ply")]
pub(crate) struct Generate {
    #[command(subcommand)]
    pub(crate) shape: Shape,
}
