//! Puzzles on a rectangle or within an outline.

mod cells;
mod clip;
mod tabs;
mod tree;
mod whimsy;

pub(crate) use clip::faces_within;
pub(crate) use tree::lock_by_tabs;

use crate::puzzle::Corner;
use crate::{Puzzle, PuzzleError};
use pompeiu_core::mesh::edit::Random;
use pompeiu_core::run::Control;
use pompeiu_planar::{Outline, Point, first_crossing};

/// The shapes of pieces before tabs are added.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Layout {
    /// Rows of rectangles.
    #[default]
    Grid,
    /// Rows of hexagons.
    Hexagons,
    /// Voronoi cells of random sites, made regular by Lloyd's method.
    Voronoi,
}

/// The shape of tabs on borders between pieces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Tab {
    /// Straight borders.
    None,
    /// A round head on a narrower neck.
    #[default]
    Knob,
    /// A trapezium that is wider at its head.
    Dovetail,
}

/// Options of a puzzle.
#[derive(Clone, Debug, PartialEq)]
pub struct PuzzleOptions {
    /// The outline of the puzzle; by default the rectangle of `size`.
    pub outline: Option<Outline>,
    /// Width and height; an outline is scaled to fit.
    pub size: [f64; 2],
    /// Number of pieces. Squares and hexagons use the best fitting number of rows and columns, see [`make`].
    pub pieces: usize,
    /// The shapes of pieces before tabs are added.
    pub layout: Layout,
    /// The shape of tabs on borders between pieces.
    pub tab: Tab,
    /// Outlines that become pieces of their own, each scaled to twice the mean area of a piece and placed where there is most room.
    pub whimsies: Vec<Outline>,
    /// The seed for the sites, and for the sides and positions of tabs.
    pub seed: u64,
}

impl Default for PuzzleOptions {
    fn default() -> Self {
        Self {
            outline: None,
            size: [300.0, 200.0],
            pieces: 24,
            layout: Layout::Grid,
            tab: Tab::Knob,
            whimsies: Vec::new(),
            seed: 0,
        }
    }
}

/// Largest number of pieces.
const MOST_PIECES: usize = 20_000;

/// Steps of the lattice across the longer side.
pub(crate) const STEPS: f64 = 4_194_304.0;

/// Largest ratio of the longer to the shorter side.
const MOST_ASPECT: f64 = 100.0;

/// Rounds of Lloyd's method on random sites.
const ROUNDS: usize = 12;

/// Makes a puzzle.
///
/// # Definition
/// A grid uses the factorisation of the number of pieces into rows × columns with the squarest cells. Hexagons use the rows and
/// columns that come nearest to regular hexagons, so their number can differ. Each border gets one tab where one fits without
/// crossing a border: on a side and at a position chosen by the seed, otherwise on the other side, elsewhere, or smaller.
///
/// Within an outline, cells are clipped, and parts of less than a third of the mean area are merged with a neighbour: the number of
/// pieces is then only approximate. The outline gets corners where borders meet it, less than a lattice step away.
///
/// Whimsies are cut out of the cells; their borders get a tab only where nothing else holds them.
///
/// # Errors
/// [`PuzzleError`] if sizes or numbers are out of range.
pub fn make(options: &PuzzleOptions) -> Result<Puzzle, PuzzleError> {
    make_until(options, &Control::default())
}

/// As [`make`]. Once the control stops, sites stay where they are and no further border gets a tab.
pub(crate) fn make_until(options: &PuzzleOptions, control: &Control) -> Result<Puzzle, PuzzleError> {
    options.check()?;
    let mut random = Random::new(options.seed);
    let mut puzzle = match &options.outline {
        None if options.whimsies.is_empty() => rectangle(options, &mut random, control)?,
        None => {
            let [w, h] = options.size;
            let sides = Outline::new(vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]]);
            shaped(options, &sides.map_err(|_| PuzzleError::Narrow { piece: 0 })?, &mut random, control)?
        }
        Some(outline) => shaped(options, outline, &mut random, control)?,
    };
    if options.tab != Tab::None {
        tabs::add(&mut puzzle, options.tab, &mut random, control);
    }
    if !puzzle.whimsies.is_empty() {
        whimsy::hold(&mut puzzle, options.tab, control);
    }
    Ok(puzzle)
}

impl PuzzleOptions {
    pub(crate) fn check(&self) -> Result<(), PuzzleError> {
        let [width, height] = self.size;
        for (what, value) in [("width", width), ("height", height)] {
            if !(value > 1e-100 && value < 1e100) {
                let expected = "it must be a positive number, not beyond 1e100";
                return Err(PuzzleError::Option { what, value, expected });
            }
        }
        let aspect = (width / height).max(height / width);
        if aspect > MOST_ASPECT {
            let expected = "the longer side may be at most 100 times the shorter one";
            return Err(PuzzleError::Option { what: "ratio of the sides", value: aspect, expected });
        }
        if !(2..=MOST_PIECES).contains(&self.pieces) {
            return Err(PuzzleError::Pieces { found: self.pieces, most: MOST_PIECES });
        }
        for whimsy in &self.whimsies {
            if let Some(crossing) = first_crossing(whimsy) {
                return Err(PuzzleError::PieceCrossing { sides: crossing.sides, place: crossing.place });
            }
        }
        if let Some(crossing) = self.outline.as_ref().and_then(first_crossing) {
            return Err(PuzzleError::Crossing { sides: crossing.sides, place: crossing.place });
        }
        Ok(())
    }
}

fn rectangle(options: &PuzzleOptions, random: &mut Random, control: &Control) -> Result<Puzzle, PuzzleError> {
    let step = step(options.size);
    let size = options.size.map(|side| (side / step).round());
    let sites = match options.layout {
        Layout::Grid => grid(size, options.pieces),
        Layout::Hexagons => hexagons(size, options.pieces),
        Layout::Voronoi => {
            let unit = |random: &mut Random| 0.5 + 0.5 * random.signed_unit();
            let mut sites: Vec<Point> =
                (0..options.pieces).map(|_| size.map(|side| side * unit(random))).collect();
            for _ in 0..ROUNDS {
                let cells = cells::partition(&sites, size, step)?;
                if control.is_stopped() {
                    return Ok(cells);
                }
                sites = cells.centroids();
            }
            sites
        }
    };
    cells::partition(&sites, size, step)
}

/// Margin around an outline within the rectangle of its cells, relative to its longer side.
const MARGIN: f64 = 0.02;

/// Number of attempts to move sites slightly if a border passes through a corner of the outline.
const TRIES: usize = 12;

/// Size of that displacement, relative to the mean side of a piece.
const MOVE: f64 = 1e-3;

fn shaped(
    options: &PuzzleOptions,
    outline: &Outline,
    random: &mut Random,
    control: &Control,
) -> Result<Puzzle, PuzzleError> {
    let [low, high] = outline.bounds();
    let scale =
        [0, 1].map(|k| options.size[k] / (high[k] - low[k])).into_iter().fold(f64::INFINITY, f64::min);
    let room = MARGIN * scale * (high[0] - low[0]).max(high[1] - low[1]);
    let frame = [0, 1].map(|k| scale * (high[k] - low[k]) + 2.0 * room);
    let step = step(frame);
    let size = frame.map(|side| (side / step).round());
    let on_lattice = |p: Point| [0, 1].map(|k| ((scale * (p[k] - low[k]) + room) / step).round());
    // Merges corners that coincide on the lattice.
    let rounded = outline.map(on_lattice).map_err(|_| PuzzleError::Narrow { piece: 0 })?;
    if let Some(crossing) = first_crossing(&rounded) {
        return Err(PuzzleError::Crossing { sides: crossing.sides, place: crossing.place });
    }
    let corners: Vec<Corner> = rounded.points().iter().map(|p| p.map(|x| x as i64)).collect();
    let whimsies = whimsy::placed(&options.whimsies, &rounded, options.pieces, random)?;
    let share = rounded.area() / (size[0] * size[1]);
    let unit = (rounded.area() / options.pieces as f64).sqrt();
    let in_frame = ((options.pieces as f64 / share).round() as usize).clamp(2, 4 * MOST_PIECES);
    let mut sites = match options.layout {
        Layout::Grid => {
            let count = |side: f64| (side / unit).round().max(1.0) as usize;
            lattice(size, count(size[0]), count(size[1]))
        }
        Layout::Hexagons => hexagons(size, in_frame),
        Layout::Voronoi => {
            let mut sites = Vec::with_capacity(options.pieces);
            while sites.len() < options.pieces {
                let place = size.map(|side| side * (0.5 + 0.5 * random.signed_unit()));
                if rounded.contains(place) {
                    sites.push(place);
                }
            }
            sites
        }
    };
    let rounds = if options.layout == Layout::Voronoi { ROUNDS } else { 0 };
    for _ in 0..rounds {
        let parts = cut(&mut sites, size, step, (&corners, &[]), unit, random)?;
        if control.is_stopped() && whimsies.is_empty() {
            return Ok(parts);
        }
        if control.is_stopped() {
            break;
        }
        sites = parts.centroids();
    }
    cut(&mut sites, size, step, (&corners, &whimsies), unit, random)
}

/// The parts of the cells of sites within an outline, after moving sites slightly if necessary.
fn cut(
    sites: &mut [Point],
    size: [f64; 2],
    step: f64,
    (outline, whimsies): (&[Corner], &[Vec<Corner>]),
    unit: f64,
    random: &mut Random,
) -> Result<Puzzle, PuzzleError> {
    let mut found = Err(PuzzleError::Narrow { piece: 0 });
    for _ in 0..TRIES {
        found = cells::partition(sites, size, step).and_then(|cells| clip::within(&cells, outline, whimsies));
        if found.is_ok() {
            break;
        }
        for site in &mut *sites {
            *site = [0, 1].map(|k| (site[k] + MOVE * unit * random.signed_unit()).clamp(0.0, size[k]));
        }
    }
    found
}

/// The lattice step: among a thousand nearly as fine as possible, the one of which both sides are nearest to multiples.
pub(crate) fn step([width, height]: [f64; 2]) -> f64 {
    let (long, short) = (width.max(height), width.min(height));
    let off = |k: u32| {
        let steps = short / long * (STEPS - f64::from(k));
        (steps - steps.round()).abs()
    };
    let best = (0..1000).min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap_or(0);
    long / (STEPS - f64::from(best))
}

fn grid([width, height]: [f64; 2], pieces: usize) -> Vec<Point> {
    let squareness = |rows: usize| {
        let columns = pieces / rows;
        let ratio = width / columns as f64 * rows as f64 / height;
        ratio.max(1.0 / ratio)
    };
    let divisors = (1..=pieces).filter(|rows| pieces.is_multiple_of(*rows));
    let rows = divisors.min_by(|a, b| squareness(*a).total_cmp(&squareness(*b))).unwrap_or(1);
    lattice([width, height], pieces / rows, rows)
}

fn lattice([width, height]: [f64; 2], columns: usize, rows: usize) -> Vec<Point> {
    let at = |i: usize, n: usize, side: f64| side * (2 * i + 1) as f64 / (2 * n) as f64;
    (0..rows).flat_map(|r| (0..columns).map(move |c| [at(c, columns, width), at(r, rows, height)])).collect()
}

fn hexagons([width, height]: [f64; 2], pieces: usize) -> Vec<Point> {
    // The distance of rows is √3/2 of the distance of neighbours.
    let rows = (pieces as f64 * height / width * 2.0 / 3.0_f64.sqrt()).sqrt().round().max(1.0) as usize;
    let columns = (pieces as f64 / rows as f64).round().max(1.0) as usize;
    let y = |r: usize| height * (2 * r + 1) as f64 / (2 * rows) as f64;
    let x = |r: usize, c: usize| width * ((4 * c + 1 + 2 * (r % 2)) as f64) / ((4 * columns) as f64);
    (0..rows).flat_map(|r| (0..columns).map(move |c| [x(r, c), y(r)])).collect()
}
