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
use pompeiu_planar::{Outline, Point, first_crossing};

/// What the pieces are before they get tabs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// Rows of rectangles.
    #[default]
    Grid,
    /// Rows of hexagons.
    Hexagons,
    /// Voronoi cells of random sites that Lloyd's method has evened out.
    Voronoi,
}

/// What borders between pieces get.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tab {
    /// Nothing.
    None,
    /// A round head on a narrower neck.
    #[default]
    Knob,
    /// A trapezium that is wider at its head.
    Dovetail,
}

/// What puzzle to make.
#[derive(Clone, Debug, PartialEq)]
pub struct PuzzleOptions {
    /// What is around the puzzle; without that, the rectangle of `size`.
    pub outline: Option<Outline>,
    /// Width and height; an outline is scaled to fit into that.
    pub size: [f64; 2],
    /// Number of pieces. Rows of squares and hexagons hold as many as fit best, see [`make`].
    pub pieces: usize,
    /// What the pieces are before they get tabs.
    pub layout: Layout,
    /// What borders between pieces get.
    pub tab: Tab,
    /// Outlines that become pieces of their own, each scaled to twice the mean area of a piece and placed where there is most room.
    pub whimsies: Vec<Outline>,
    /// The seed of sites, of the sides that tabs point to, and of their places.
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

/// The most pieces.
const MOST_PIECES: usize = 20_000;

/// Steps of the lattice across the longer side.
pub(crate) const STEPS: f64 = 4_194_304.0;

/// The longest side may be so many times the shorter one.
const MOST_ASPECT: f64 = 100.0;

/// Rounds of Lloyd's method on random sites.
const ROUNDS: usize = 12;

/// Makes a puzzle.
///
/// # Definition
/// A grid has the divisor rows × columns of the number of pieces whose cells are the most square. Hexagons have as many rows and columns as
/// come nearest to regular hexagons, so their number can differ. Each border gets one tab where one fits without crossing a border: on
/// a side and at a place that the seed chooses, and otherwise on the other side, elsewhere, or smaller.
///
/// Within an outline, cells are cut along it, and parts of less than a third of the mean area become part of a neighbour: the number of
/// pieces then only comes near to what is asked for. The outline gets corners where borders meet it, less than a step of the lattice away.
///
/// Whimsies are cut out of the cells; their borders get a tab only where nothing else holds them.
///
/// # Errors
/// [`PuzzleError`] for sizes and numbers out of range.
pub fn make(options: &PuzzleOptions) -> Result<Puzzle, PuzzleError> {
    options.check()?;
    let mut random = Random::new(options.seed);
    let mut puzzle = match &options.outline {
        None if options.whimsies.is_empty() => rectangle(options, &mut random)?,
        None => {
            let [w, h] = options.size;
            let sides = Outline::new(vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]]);
            shaped(options, &sides.map_err(|_| PuzzleError::Narrow { piece: 0 })?, &mut random)?
        }
        Some(outline) => shaped(options, outline, &mut random)?,
    };
    if options.tab != Tab::None {
        tabs::add(&mut puzzle, options.tab, &mut random);
    }
    if !puzzle.whimsies.is_empty() {
        whimsy::hold(&mut puzzle, options.tab);
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

fn rectangle(options: &PuzzleOptions, random: &mut Random) -> Result<Puzzle, PuzzleError> {
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
                sites = cells::partition(&sites, size, step)?.centroids();
            }
            sites
        }
    };
    cells::partition(&sites, size, step)
}

/// Room around an outline within the rectangle of its cells, over its longer side.
const MARGIN: f64 = 0.02;

/// How often sites are moved a little where a border passes through a corner of the outline.
const TRIES: usize = 12;

/// By how much, over the mean side of a piece.
const MOVE: f64 = 1e-3;

fn shaped(options: &PuzzleOptions, outline: &Outline, random: &mut Random) -> Result<Puzzle, PuzzleError> {
    let [low, high] = outline.bounds();
    let scale =
        [0, 1].map(|k| options.size[k] / (high[k] - low[k])).into_iter().fold(f64::INFINITY, f64::min);
    let room = MARGIN * scale * (high[0] - low[0]).max(high[1] - low[1]);
    let frame = [0, 1].map(|k| scale * (high[k] - low[k]) + 2.0 * room);
    let step = step(frame);
    let size = frame.map(|side| (side / step).round());
    let on_lattice = |p: Point| [0, 1].map(|k| ((scale * (p[k] - low[k]) + room) / step).round());
    // Corners that the lattice cannot tell apart become one.
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
        sites = parts.centroids();
    }
    cut(&mut sites, size, step, (&corners, &whimsies), unit, random)
}

/// The parts of the cells of sites within an outline, with sites moved a little where that needs it.
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

/// The step of the lattice: of a thousand about as fine as there may be the one of which both sides are nearest to multiples.
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
    // Rows are √3/2 of the distance of neighbours apart.
    let rows = (pieces as f64 * height / width * 2.0 / 3.0_f64.sqrt()).sqrt().round().max(1.0) as usize;
    let columns = (pieces as f64 / rows as f64).round().max(1.0) as usize;
    let y = |r: usize| height * (2 * r + 1) as f64 / (2 * rows) as f64;
    let x = |r: usize, c: usize| width * ((4 * c + 1 + 2 * (r % 2)) as f64) / ((4 * columns) as f64);
    (0..rows).flat_map(|r| (0..columns).map(move |c| [x(r, c), y(r)])).collect()
}
