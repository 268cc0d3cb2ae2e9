//! Options of the puzzle command.

use crate::args::Limits;
use clap::{Args, ValueEnum};
use pompeiu::puzzle::{Answer, Layout, Method, Tab, Variant};
use std::path::PathBuf;

/// Make a jigsaw puzzle, and say whether it holds together
#[derive(Args)]
#[command(after_help = "\
Pieces tile a rectangle or an outline exactly: corners lie on a lattice of integers, and each border is made once for both of its pieces. Whether any
pieces can move against each other is decided over all motions of all pieces at once. The exit code is 0 whether they can or not.

With --piece, pieces become as like a shape as they can be, and as few borders get a tab as hold the puzzle together. Without it, each
border gets one; within an outline the number of pieces then only comes near to what is asked for, for parts of cells that are too
small become part of a neighbour.

Shapes for --piece: square, hexagon, classic (knobs on opposite sides), corner (knobs on sides that meet), fish, bird, star, or a file:
a picture (its largest part), a drawing or a list of points.

With --kerf, the paths of --output lie half a cut outside of their pieces, which are pulled apart so far that no two paths meet. Those of --cuts are
cut once and leave a gap: whether pieces hold each other with it is tested, over all paths of finite motions of each two of them.

Outputs, by suffix:
  .svg   one closed path for each piece
  .dxf   the same as polylines
  .png   the pieces as a picture

Examples:
  pompeiu puzzle --pieces 48 --size 300,200 -o pieces.svg --cuts laser.svg
  pompeiu puzzle --layout voronoi --tab dovetail --seed 7 --report puzzle.html
  pompeiu puzzle --piece bird -n 24 -o birds.svg --report birds.html
  pompeiu puzzle --piece fish.png --outline lake.svg --tab dovetail --cuts laser.dxf
  pompeiu puzzle --piece bird --free-outline -n 30 -o flock.svg
  pompeiu puzzle --layout voronoi -n 60 --whimsy cat.png --whimsy star.svg -o whimsies.svg
  pompeiu puzzle --outline cat.png --layout voronoi -n 40 -o cat.svg
  pompeiu puzzle -n 48 --kerf 0.2 --cuts laser.svg -o pieces.svg
  pompeiu puzzle --image photo.jpg -o photo.png --report photo.html
  pompeiu puzzle --layout voronoi --tab none --motion apart.svg
  pompeiu puzzle --layout hexagons --tab none --json")]
#[allow(clippy::struct_excessive_bools, reason = "each one is a switch of the command")]
pub(crate) struct Puzzle {
    /// Number of pieces
    #[arg(long, short = 'n', default_value = "24", value_name = "N")]
    pub(crate) pieces: usize,
    /// What is around the puzzle: a picture (its largest part), a drawing or a list of points; a rectangle by default
    #[arg(long, value_name = "FILE")]
    pub(crate) outline: Option<PathBuf>,
    /// Width and height, in millimetres for drawings; an outline is scaled to fit into that
    #[arg(long, value_parser = crate::numbers::tuple::<2>, default_value = "300,200", value_name = "WIDTH,HEIGHT")]
    pub(crate) size: [f64; 2],
    /// Make pieces like a shape: a name or a file
    #[arg(long, value_name = "SHAPE", conflicts_with = "layout")]
    pub(crate) piece: Option<String>,
    /// How copies of the shape are placed
    #[arg(long, value_enum, default_value_t, requires = "piece")]
    pub(crate) method: MethodName,
    /// Lloyd's method: what counts where a ray from the site meets the shape several times
    #[arg(long, value_enum, default_value_t, requires = "piece")]
    pub(crate) metric: MetricName,
    /// Lloyd's method: measure by the shape's corners instead of its sides
    #[arg(long, requires = "piece")]
    pub(crate) corners: bool,
    /// Lloyd's method: never turn copies as the registration of the shape on their regions says
    #[arg(long, requires = "piece")]
    pub(crate) no_feedback: bool,
    /// Mirror no copy of the shape
    #[arg(long, requires = "piece")]
    pub(crate) no_mirrors: bool,
    /// Let the outline be what whole copies leave, so that it cuts no piece; it comes near to the one asked for
    #[arg(long, requires = "piece", conflicts_with = "method")]
    pub(crate) free_outline: bool,
    /// Make a piece of an outline, twice as large as the others: a picture (its largest part), a drawing or a list of points; may be repeated
    #[arg(long, value_name = "FILE", conflicts_with = "piece")]
    pub(crate) whimsy: Vec<PathBuf>,
    /// What pieces are before they get tabs
    #[arg(long, value_enum, default_value_t)]
    pub(crate) layout: LayoutName,
    /// What borders between pieces get
    #[arg(long, value_enum, default_value_t)]
    pub(crate) tab: TabName,
    /// Seed of places and sides
    #[arg(long, default_value = "0", value_name = "SEED")]
    pub(crate) seed: u64,
    /// Write the pieces: .svg, .dxf or .png
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Pull the pieces in --output apart, by this factor of their distance from the middle
    #[arg(long, default_value = "0", value_parser = crate::numbers::magnitude, value_name = "FACTOR")]
    pub(crate) pull: f64,
    /// Write each border once, in the order to cut them: .svg or .dxf
    #[arg(long, value_name = "OUT")]
    pub(crate) cuts: Option<PathBuf>,
    /// Width of the cut: paths are moved by half of it, and whether the puzzle holds with the gap is tested
    #[arg(long, default_value = "0", value_parser = crate::numbers::magnitude, value_name = "WIDTH")]
    pub(crate) kerf: f64,
    /// A picture to lie on the pieces in --output (.svg, .png) and --report: PNG, JPEG, GIF or BMP
    #[arg(long, value_name = "PICTURE")]
    pub(crate) image: Option<PathBuf>,
    /// Write the motion that takes a puzzle apart which is not locked: .svg plays it, .png shows its end
    #[arg(long, value_name = "OUT")]
    pub(crate) motion: Option<PathBuf>,
    /// Write a page on which pieces can be dragged, one file that needs no network
    #[arg(long, value_name = "FILE.html")]
    pub(crate) report: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}

impl Puzzle {
    /// How copies of the shape are placed.
    pub(crate) fn method(&self) -> Method {
        match self.method {
            MethodName::Descent => Method::Descent,
            MethodName::Lloyd => Method::Lloyd {
                answer: match self.metric {
                    MetricName::Distance => Answer::SignedDistance,
                    MetricName::Least => Answer::Least,
                    MetricName::Greatest => Answer::Greatest,
                },
                variant: if self.corners { Variant::Points } else { Variant::Edges },
                feedback: !self.no_feedback,
            },
        }
    }
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum MethodName {
    /// From lattices, by a descent whose energy never rises, and hops
    #[default]
    Descent,
    /// Lloyd's method with the shape-matching metric
    Lloyd,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum MetricName {
    /// No ray: the distance to the shape, negative inside
    #[default]
    Distance,
    /// The outermost meeting: the least factor by which the shape must grow
    Least,
    /// The innermost meeting: the greatest factor
    Greatest,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum LayoutName {
    /// Rows of rectangles
    #[default]
    Grid,
    /// Rows of hexagons, as many as come nearest to the number of pieces
    Hexagons,
    /// Voronoi cells of random sites
    Voronoi,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum TabName {
    /// Nothing
    None,
    /// A round head on a narrower neck
    #[default]
    Knob,
    /// A trapezium that is wider at its head
    Dovetail,
}

impl From<LayoutName> for Layout {
    fn from(name: LayoutName) -> Self {
        match name {
            LayoutName::Grid => Self::Grid,
            LayoutName::Hexagons => Self::Hexagons,
            LayoutName::Voronoi => Self::Voronoi,
        }
    }
}

impl From<TabName> for Tab {
    fn from(name: TabName) -> Self {
        match name {
            TabName::None => Self::None,
            TabName::Knob => Self::Knob,
            TabName::Dovetail => Self::Dovetail,
        }
    }
}
