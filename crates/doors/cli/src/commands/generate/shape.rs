//! Shapes to generate, and what can be done to them before they are written.

use crate::numbers::{counts, tuple};
use clap::{Args, Subcommand, ValueEnum};
use pompeiu::core::mesh::shapes;
use std::path::PathBuf;

#[derive(Subcommand)]
#[command(subcommand_value_name = "SHAPE", subcommand_help_heading = "Shapes")]
pub(crate) enum Shape {
    /// Sphere of nearly equal triangles: a subdivided icosahedron
    Icosphere {
        /// Of the sphere
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        radius: f64,
        /// How often each face is split into four
        #[arg(long, default_value_t = 3, value_name = "N")]
        subdivisions: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Sphere of meridians and circles of latitude
    UvSphere {
        /// Of the sphere
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        radius: f64,
        /// Faces around the axis
        #[arg(long, default_value_t = 32, value_name = "N")]
        segments: u32,
        /// Bands from pole to pole
        #[arg(long, default_value_t = 16, value_name = "N")]
        rings: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Torus around the z axis
    Torus {
        /// From the axis to the middle of the tube
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        major_radius: f64,
        /// Of the tube
        #[arg(long, default_value_t = 0.4, value_name = "LENGTH", allow_negative_numbers = true)]
        minor_radius: f64,
        /// Around the axis
        #[arg(long, default_value_t = 48, value_name = "N")]
        major_segments: u32,
        /// Around the tube
        #[arg(long, default_value_t = 24, value_name = "N")]
        minor_segments: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Cube with N x N cells on each side
    Cube {
        /// Length of an edge
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        side: f64,
        /// Cells along each edge
        #[arg(long, default_value_t = 1, value_name = "N")]
        cells: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Box with N x N cells on each side
    Box {
        /// Extents along x, y and z
        #[arg(long, value_parser = tuple::<3>, default_value = "1,1,1", value_name = "X,Y,Z", allow_hyphen_values = true)]
        size: [f64; 3],
        /// Cells along each edge
        #[arg(long, default_value_t = 1, value_name = "N")]
        cells: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Flat rectangle of N x M cells in the plane z = 0
    Grid {
        /// Extents along x and y
        #[arg(long, value_parser = tuple::<2>, default_value = "1,1", value_name = "X,Y", allow_hyphen_values = true)]
        size: [f64; 2],
        /// Cells along x and y
        #[arg(long, value_parser = counts, default_value = "1,1", value_name = "N,M")]
        cells: [u32; 2],
        /// How each cell is cut in two
        #[arg(long, value_enum, default_value_t)]
        diagonal: Diagonal,
        #[command(flatten)]
        finish: Finish,
    },
    /// Flat disk in the plane z = 0
    Disk {
        /// Of the circle around it
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        radius: f64,
        /// Around the axis
        #[arg(long, default_value_t = 32, value_name = "N")]
        segments: u32,
        /// Bands around the centre
        #[arg(long, default_value_t = 4, value_name = "N")]
        rings: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Cylinder around the z axis
    Cylinder {
        /// Of the circle around it
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        radius: f64,
        /// Along the z axis
        #[arg(long, default_value_t = 2.0, value_name = "LENGTH", allow_negative_numbers = true)]
        height: f64,
        /// Around the axis
        #[arg(long, default_value_t = 32, value_name = "N")]
        segments: u32,
        /// Bands along the height
        #[arg(long, default_value_t = 1, value_name = "N")]
        rows: u32,
        /// Close both ends
        #[arg(long)]
        capped: bool,
        #[command(flatten)]
        finish: Finish,
    },
    /// Schwarz's lantern: near a cylinder, yet of any area you like
    SchwarzLantern {
        /// Of the cylinder that the vertices lie on
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        radius: f64,
        /// Along the z axis
        #[arg(long, default_value_t = 2.0, value_name = "LENGTH", allow_negative_numbers = true)]
        height: f64,
        /// Around the axis
        #[arg(long, default_value_t = 16, value_name = "N")]
        segments: u32,
        /// Bands along the height
        #[arg(long, default_value_t = 32, value_name = "N")]
        bands: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Cone over the plane z = 0
    Cone {
        /// Of the circle around the base
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        radius: f64,
        /// Along the z axis
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        height: f64,
        /// Around the axis
        #[arg(long, default_value_t = 32, value_name = "N")]
        segments: u32,
        /// Close the base
        #[arg(long)]
        capped: bool,
        #[command(flatten)]
        finish: Finish,
    },
    /// Four sloping faces over a square in the plane z = 0
    Tent {
        /// Of the square
        #[arg(long, default_value_t = 2.0, value_name = "LENGTH", allow_negative_numbers = true)]
        side: f64,
        /// Along the z axis
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        height: f64,
        #[command(flatten)]
        finish: Finish,
    },
    /// Regular tetrahedron
    Tetrahedron {
        /// Length of an edge
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        edge: f64,
        #[command(flatten)]
        finish: Finish,
    },
    /// Regular icosahedron
    Icosahedron {
        /// Of the sphere around it
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        radius: f64,
        #[command(flatten)]
        finish: Finish,
    },
    /// Catenoid around the z axis, a minimal surface
    Catenoid {
        /// Least radius
        #[arg(
            long,
            default_value_t = 0.8483379380949789,
            value_name = "LENGTH",
            allow_negative_numbers = true
        )]
        waist: f64,
        /// Along the z axis
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        height: f64,
        /// Around the axis
        #[arg(long, default_value_t = 96, value_name = "N")]
        segments: u32,
        /// Bands along the height
        #[arg(long, default_value_t = 24, value_name = "N")]
        rows: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Helicoid around the z axis, a minimal surface
    Helicoid {
        /// From the axis to the rim
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        radius: f64,
        /// Height of a turn
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        pitch: f64,
        /// Number of turns
        #[arg(long, default_value_t = 1.0, value_name = "X", allow_negative_numbers = true)]
        turns: f64,
        /// Along the axis
        #[arg(long, default_value_t = 64, value_name = "N")]
        segments: u32,
        /// Across the strip
        #[arg(long, default_value_t = 16, value_name = "N")]
        strips: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Enneper's minimal surface over a disk
    Enneper {
        /// Of the disk of parameters
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        radius: f64,
        /// Around the centre
        #[arg(long, default_value_t = 48, value_name = "N")]
        segments: u32,
        /// Bands around the centre
        #[arg(long, default_value_t = 16, value_name = "N")]
        rings: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Scherk's minimal surface over a square
    Scherk {
        /// Half the side of the square, below 1.5707
        #[arg(long, default_value_t = 1.2, value_name = "LENGTH", allow_negative_numbers = true)]
        half: f64,
        /// Cells along each side
        #[arg(long, default_value_t = 24, value_name = "N")]
        cells: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Two balls joined by a neck, around the z axis
    Dumbbell {
        /// Of the balls
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        radius: f64,
        /// Radius of the neck, as a part of that of the balls
        #[arg(long, default_value_t = 0.3, value_name = "SHARE", allow_negative_numbers = true)]
        neck: f64,
        /// Around the axis
        #[arg(long, default_value_t = 48, value_name = "N")]
        segments: u32,
        /// Bands along the axis
        #[arg(long, default_value_t = 96, value_name = "N")]
        rows: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Möbius strip around the z axis, which has one side only
    MobiusStrip {
        /// Of the middle circle
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        radius: f64,
        /// Of the band
        #[arg(long, default_value_t = 0.5, value_name = "LENGTH", allow_negative_numbers = true)]
        width: f64,
        /// Around the axis
        #[arg(long, default_value_t = 48, value_name = "N")]
        segments: u32,
        /// Across the band
        #[arg(long, default_value_t = 4, value_name = "N")]
        strips: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Plate with a row of square holes: a closed surface with as many handles
    PerforatedPlate {
        /// Of the cubes that it is made of
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        edge: f64,
        /// The genus
        #[arg(long, default_value_t = 2, value_name = "N")]
        holes: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Corners of the cells of a square, as faces shrunk to points
    PointLattice {
        /// Of the square
        #[arg(long, default_value_t = 1.0, value_name = "LENGTH", allow_negative_numbers = true)]
        side: f64,
        /// Cells along each side
        #[arg(long, default_value_t = 4, value_name = "N")]
        cells: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Surface spanned on wires: a disc on one closed polygon, an annulus on two
    Wire {
        /// The polygons: an OBJ file with lines, or a text with three coordinates on each line and an empty line between polygons
        #[arg(value_name = "IN")]
        input: PathBuf,
        /// Bands of faces between the polygon and its middle, or between both
        #[arg(long, default_value_t = 16, value_name = "N")]
        rows: u32,
        #[command(flatten)]
        finish: Finish,
    },
    /// Closed curve through random points in the plane, more complex the more there are
    Polyline(super::planar::Polyline),
    /// Circle of pixels in the plane whose border random walks have roughened
    NoisyCircle(super::planar::NoisyCircle),
    /// The mesh of a file, to be edited
    Mesh {
        /// The mesh file to read
        #[arg(value_name = "IN")]
        input: PathBuf,
        #[command(flatten)]
        finish: Finish,
    },
}

#[derive(Clone, Copy, Default, ValueEnum)]
pub(crate) enum Diagonal {
    /// All from lower left to upper right
    #[default]
    Rising,
    /// All from upper left to lower right
    Falling,
    /// By turns
    Alternating,
}

impl From<Diagonal> for shapes::Diagonal {
    fn from(diagonal: Diagonal) -> Self {
        match diagonal {
            Diagonal::Rising => Self::Rising,
            Diagonal::Falling => Self::Falling,
            Diagonal::Alternating => Self::Alternating,
        }
    }
}

const EDITS: &str = "Edits, made in this order";

/// What happens to a shape before it is written.
#[derive(Args)]
pub(crate) struct Finish {
    /// The mesh file to write; the suffix names the format
    #[arg(long, short, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// Split each face into four, N times
    #[arg(long, help_heading = EDITS, default_value_t = 0, value_name = "N", hide_default_value = true)]
    pub(crate) subdivide: u32,
    /// Move along smooth waves of this height and length
    #[arg(long, help_heading = EDITS, value_parser = tuple::<2>, value_name = "AMPLITUDE,WAVELENGTH", allow_hyphen_values = true)]
    pub(crate) ripple: Option<[f64; 2]>,
    /// Move each vertex by this length in a random direction
    #[arg(long, help_heading = EDITS, value_name = "LENGTH", allow_negative_numbers = true)]
    pub(crate) noise: Option<f64>,
    /// Which random directions
    #[arg(long, help_heading = EDITS, default_value_t = 0, value_name = "N")]
    pub(crate) seed: u64,
    /// Multiply all coordinates
    #[arg(long, help_heading = EDITS, value_name = "FACTOR", allow_hyphen_values = true)]
    pub(crate) scale: Option<f64>,
    /// Turn about the axis x,y,z through the origin
    #[arg(long, help_heading = EDITS, value_parser = tuple::<4>, value_name = "X,Y,Z,DEGREES", allow_hyphen_values = true)]
    pub(crate) rotate: Option<[f64; 4]>,
    /// Move by a vector
    #[arg(long, help_heading = EDITS, value_parser = tuple::<3>, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(crate) translate: Option<[f64; 3]>,
    /// Put the faces in a random order, each starting at a random corner
    #[arg(long, help_heading = EDITS, value_name = "SEED")]
    pub(crate) shuffle: Option<u64>,
    /// Give each face three vertices of its own
    #[arg(long, help_heading = EDITS)]
    pub(crate) unweld: bool,
}
