//! Files of the puzzle command.

use crate::args::suffix;
use clap::Args;
use pompeiu::core::request::values::magnitude;
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "\
Pieces tile a rectangle or an outline exactly: corners lie on a lattice of integers, and each border is made once for both of its pieces. Whether any
pieces can move against each other is decided over all motions of all pieces at once. The exit code is 0 whether they can or not.

With --piece, pieces become as similar to a shape as possible, and as few borders get a tab as hold the puzzle together. Without it, each
border gets one; within an outline the number of pieces then only comes near to what is asked for, for parts of cells that are too
small become part of a neighbour.

Shapes for --piece: square, hexagon, classic (knobs on opposite sides), corner (knobs on sides that meet), fish, bird, star, or a file:
a picture (its largest part), a drawing or a list of points.

With --kerf, the paths of --cuts are cut once and leave a gap: whether pieces hold each other with it is tested, over all paths of finite motions of
each two of them. In --output pieces lie in place; with --layout-on or --pull they lie apart, and their paths half a cut outside of them.

When a limit ends the run early, pieces tile all the same: cells are less regular, tabs are missing, or what was not decided is said to be undecided.

Outputs, by suffix:
  .svg   one closed path for each piece
  .dxf   the same as polylines
  .png   the pieces as a picture

Examples:
  pompeiu puzzle --pieces 48 --size 300x200 -o pieces.svg --cuts laser.svg
  pompeiu puzzle --layout voronoi --tab dovetail --seed 7 --report puzzle.html
  pompeiu puzzle --piece bird -n 24 -o birds.svg --report birds.html
  pompeiu puzzle --piece fish.png --outline lake.svg --tab dovetail --cuts laser.dxf
  pompeiu puzzle --piece bird --free-outline -n 30 -o flock.svg
  pompeiu puzzle --layout voronoi -n 60 --whimsy cat.png --whimsy star.svg -o whimsies.svg
  pompeiu puzzle --outline cat.png --layout voronoi -n 40 -o cat.svg
  pompeiu puzzle -n 48 --kerf 0.2 --cuts laser.svg
  pompeiu puzzle -n 48 --kerf 0.2 --layout-on 600x300 -o sheet.svg
  pompeiu puzzle --picture photo.jpg --image photo.png --report photo.html
  pompeiu puzzle --layout voronoi --tab none --motion apart.svg
  pompeiu puzzle --layout hexagons --tab none --json")]
pub(crate) struct Files {
    /// Write the pieces: .svg, .dxf or .png
    #[arg(long, short, value_name = "OUT")]
    pub(super) output: Option<PathBuf>,
    /// Pull the pieces in --output apart, by this factor of their distance from the middle
    #[arg(long, default_value = "0", value_parser = magnitude, value_name = "FACTOR")]
    pub(super) pull: f64,
    /// Write each border once, in the order to cut them: .svg or .dxf
    #[arg(long, value_name = "OUT")]
    pub(super) cuts: Option<PathBuf>,
    /// A picture to lie on the pieces in --output (.svg, .png), --image and --report: PNG, JPEG, GIF or BMP
    #[arg(long, value_name = "PICTURE")]
    pub(super) picture: Option<PathBuf>,
    /// Write a picture of the pieces
    #[arg(long, value_parser = suffix::picture, value_name = "FILE.png")]
    pub(super) image: Option<PathBuf>,
    /// Write the motion that takes a puzzle apart which is not locked: .svg plays it, .png shows its end
    #[arg(long, value_name = "OUT")]
    pub(super) motion: Option<PathBuf>,
    /// Write a page on which pieces can be dragged, one file that needs no network
    #[arg(long, value_parser = suffix::page, value_name = "FILE.html")]
    pub(super) report: Option<PathBuf>,
}
