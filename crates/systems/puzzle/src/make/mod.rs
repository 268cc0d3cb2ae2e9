//! Puzzles on a rectangle or within an outline.

mod cells;
mod clip;
mod mend;
mod tabs;
mod tree;
mod whimsy;

pub(crate) use clip::faces_within;
pub(crate) use mend::mended;
pub(crate) use tree::lock_by_tabs;

use crate::space::Corner;
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
    /// The least width of necks that tabs leave, in the unit of `size`; by default 15 % of the mean side of a piece, at least 3 and at
    /// most a fifth of that side.
    pub neck: Option<f64>,
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
            neck: None,
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

/// The least neck by default, relative to the mean side of a piece and in millimetres; and the greatest share of a side that the
/// millimetres may take, so that tabs still fit on the sides of small pieces.
const NECK: f64 = 0.15;
const NECK_MILLIMETRES: f64 = 3.0;
const MOST_NECK: f64 = 0.2;

/// Rounds of Lloyd's method on random sites.
const ROUNDS: usize = 12;

/// Makes a puzzle.
///
/// # Definition
/// A grid uses the factorisation of the number of pieces into rows × columns with the squarest cells. Hexagons use the rows and
/// columns that come nearest to regular hexagons; a number of pieces that is off by more than a tenth counts four times as much. Each border gets one tab where one fits without
/// crossing a border or leaving a neck below the least width ([`Puzzle::neck`]): on a side and at a position chosen by the seed,
/// otherwise on the other side, elsewhere, or smaller. Necks of the outline itself, where it is narrow, stay.
///
/// An outline that is a rectangle with sides along the axes has the pieces of that rectangle. Within others, cells are clipped, and parts of less than a third of the mean area are merged with a neighbour; of a few numbers
/// of cells, the one whose number of pieces comes nearest is taken; where all are far too many or too few, as for a comb, the smallest parts are merged. Where a border leaves a neck below the least width, the
/// part beyond it is given to the piece across the border if that leaves wider ones. The outline gets corners where borders meet it, less than a lattice step away.
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
        None if options.whimsies.is_empty() => rectangle(options, options.size, &mut random, control)?,
        None => {
            let [w, h] = options.size;
            let sides = Outline::new(vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]]);
            shaped(options, &sides.map_err(|_| PuzzleError::Narrow { piece: 0 })?, &mut random, control)?
        }
        Some(outline) => match rectangular(outline, options.size) {
            Some(size) if options.whimsies.is_empty() => rectangle(options, size, &mut random, control)?,
            _ => shaped(options, outline, &mut random, control)?,
        },
    };
    let neck = options.least_neck(puzzle.unit()) / puzzle.step;
    if options.tab != Tab::None {
        tabs::add(&mut puzzle, options.tab, neck, &mut random, control);
    }
    if !puzzle.whimsies.is_empty() {
        whimsy::hold(&mut puzzle, options.tab, neck, control);
    }
    Ok(puzzle)
}

impl PuzzleOptions {
    /// The least width of necks, for pieces with a mean side.
    pub(crate) fn least_neck(&self, unit: f64) -> f64 {
        self.neck.unwrap_or_else(|| (NECK * unit).max(NECK_MILLIMETRES.min(MOST_NECK * unit)))
    }

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
        if let Some(value) = self.neck.filter(|neck| !(*neck >= 0.0 && neck.is_finite())) {
            let expected = "it must be a finite width that is not negative";
            return Err(PuzzleError::Option { what: "neck", value, expected });
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

/// How much of the box around it an outline may leave to be that box, relative to its area: rounding.
const LEFT_OF_BOX: f64 = 1e-12;

/// The width and the height of an outline that fits into a size, if it is a rectangle with sides along the axes. Its pieces need not be
/// clipped, and there are as many as asked for.
fn rectangular(outline: &Outline, wanted: [f64; 2]) -> Option<[f64; 2]> {
    let [low, high] = outline.bounds();
    let sides = [0, 1].map(|k| high[k] - low[k]);
    let is_box = outline.area() >= (1.0 - LEFT_OF_BOX) * sides[0] * sides[1];
    let aspect = (sides[0] / sides[1]).max(sides[1] / sides[0]);
    let scale = (wanted[0] / sides[0]).min(wanted[1] / sides[1]);
    (is_box && aspect <= MOST_ASPECT).then(|| sides.map(|side| scale * side))
}

fn rectangle(
    options: &PuzzleOptions,
    size: [f64; 2],
    random: &mut Random,
    control: &Control,
) -> Result<Puzzle, PuzzleError> {
    let step = step(size);
    let size = size.map(|side| (side / step).round());
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

/// A number of pieces that is near enough, relative to the one asked for.
const NEAR: f64 = 0.02;

/// How much a deviation from the number of pieces counts beside one from the least neck.
const COUNTS: f64 = 2.0;

/// Largest number of partitions to try within an outline, and of pieces in all of them but for the first few.
const PARTITIONS: usize = 20;
const FEWEST_PARTITIONS: usize = 5;
const PARTITIONED: usize = 4000;

/// A number of pieces that is so much too great or too small, relative to the one asked for, after half of the partitions: cells of an outline
/// with many thin parts fall apart, however few they are. Then the smallest parts are merged of cells that gave enough.
const MANY: f64 = 1.1;

/// The largest number of cells that is tried, relative to the number of pieces asked for.
const MOST_CELLS: usize = 8;

/// The step of further numbers of cells, relative to the number that gives as many pieces as asked for.
const FURTHER: f64 = 0.02;

/// An outline on the lattice, in a rectangle with some room around it.
struct Shaped {
    outline: Outline,
    corners: Vec<Corner>,
    size: [f64; 2],
    step: f64,
}

impl Shaped {
    fn new(outline: &Outline, wanted: [f64; 2]) -> Result<Self, PuzzleError> {
        let [low, high] = outline.bounds();
        let scale = [0, 1].map(|k| wanted[k] / (high[k] - low[k])).into_iter().fold(f64::INFINITY, f64::min);
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
        let corners = rounded.points().iter().map(|p| p.map(|x| x as i64)).collect();
        Ok(Self { outline: rounded, corners, size, step })
    }

    /// Sites of about so many cells within the outline; those in rows are moved by a share of the frame, and around it.
    fn sites(&self, (layout, count): (Layout, usize), shift: Point, random: &mut Random) -> Vec<Point> {
        let size = self.size;
        let moved = |site: Point| [0, 1].map(|k| (site[k] + shift[k] * size[k]).rem_euclid(size[k]));
        match layout {
            Layout::Grid => {
                let unit = (self.outline.area() / count as f64).sqrt();
                let count = |side: f64| (side / unit).round().max(1.0) as usize;
                lattice(size, count(size[0]), count(size[1])).into_iter().map(moved).collect()
            }
            Layout::Hexagons => {
                let share = self.outline.area() / (size[0] * size[1]);
                let in_frame = ((count as f64 / share).round() as usize).clamp(2, 4 * MOST_PIECES);
                hexagons(size, in_frame).into_iter().map(moved).collect()
            }
            Layout::Voronoi => {
                let mut sites = Vec::with_capacity(count);
                while sites.len() < count {
                    let place = size.map(|side| side * (0.5 + 0.5 * random.signed_unit()));
                    if self.outline.contains(place) {
                        sites.push(place);
                    }
                }
                sites
            }
        }
    }

    /// The parts of about so many cells within the outline, at most so many. When the control stops, cells are less regular.
    fn parts(
        &self,
        cells: (Layout, usize),
        shift: Point,
        (whimsies, most): (&[Vec<Corner>], usize),
        random: &mut Random,
        control: &Control,
    ) -> Result<Puzzle, PuzzleError> {
        let unit = (self.outline.area() / cells.1 as f64).sqrt();
        let mut sites = self.sites(cells, shift, random);
        let rounds = if cells.0 == Layout::Voronoi { ROUNDS } else { 0 };
        for _ in 0..rounds {
            // Each part has one site in the next round: more parts than cells would become more and more in thin parts of the outline.
            let most = [cells.1, most.min(cells.1)];
            let parts = cut(&mut sites, self.size, self.step, (&self.corners, &[], most), unit, random)?;
            if control.is_stopped() && whimsies.is_empty() {
                return Ok(parts);
            }
            if control.is_stopped() {
                break;
            }
            sites = parts.centroids();
        }
        cut(&mut sites, self.size, self.step, (&self.corners, whimsies, [cells.1, most]), unit, random)
    }
}

/// Pieces within an outline. It cuts cells into parts, of which small ones are merged, and leaves necks where a border passes near to
/// it. So numbers and places of cells are tried until the number of pieces is near to the one asked for and no cell has a neck below the least
/// width, or else the best of them is taken.
fn shaped(
    options: &PuzzleOptions,
    outline: &Outline,
    random: &mut Random,
    control: &Control,
) -> Result<Puzzle, PuzzleError> {
    let shape = Shaped::new(outline, options.size)?;
    let whimsies = whimsy::placed(&options.whimsies, &shape.outline, options.pieces, random)?;
    let asked = options.pieces as f64;
    let most = (PARTITIONED / options.pieces).clamp(FEWEST_PARTITIONS, PARTITIONS);
    let mut best: Option<(f64, Puzzle)> = None;
    let mut failed = None;
    // The number of cells that gives the number of pieces, and the number that is tried.
    let (mut cells, mut count, mut shift) = (asked, options.pieces, [0.0; 2]);
    // The least number of cells that gave as many pieces as asked for.
    let mut enough: Option<usize> = None;
    for k in 1..=most {
        let is_off = |(_, parts): &(f64, Puzzle)| off(parts, asked) > libm::log(MANY);
        let is_merged = 2 * k > most && best.as_ref().is_some_and(is_off);
        let most_parts = if is_merged && enough.is_some() { options.pieces } else { usize::MAX };
        match shape.parts((options.layout, count), shift, (&whimsies, most_parts), random, control) {
            Ok(parts) => {
                let missed = COUNTS * (off(&parts, asked) - NEAR).max(0.0) + lacking(&parts, options);
                if most_parts == usize::MAX && off(&parts, asked) > NEAR {
                    cells = count as f64 * asked / parts.pieces() as f64;
                }
                if most_parts == usize::MAX && parts.pieces() >= options.pieces {
                    enough = Some(enough.map_or(count, |least| least.min(count)));
                }
                if best.as_ref().is_none_or(|(least, _)| missed < *least) {
                    best = Some((missed, parts));
                }
            }
            // Other cells may fit the lattice.
            Err(error) => failed = Some(error),
        }
        if control.is_stopped() || best.as_ref().is_some_and(|(missed, _)| *missed == 0.0) {
            break;
        }
        // Parts that will be merged are those of as many cells as pieces, or more where that is not enough.
        let will_merge = 2 * (k + 1) > most && best.as_ref().is_some_and(is_off);
        let around = enough.filter(|_| will_merge).map_or(cells, |least| asked.max(least as f64));
        let side = if k % 2 == 0 { 0.5 } else { -0.5 };
        let next = (around * (1.0 + side * FURTHER * k as f64)).round() as usize;
        count = next.clamp(1, (MOST_CELLS * options.pieces).min(2 * MOST_PIECES));
        shift = [0, 1].map(|_| random.signed_unit());
    }
    let mend = |puzzle: Puzzle| {
        let least = options.least_neck(puzzle.unit());
        mended(puzzle, least)
    };
    best.map(|(_, puzzle)| mend(puzzle)).ok_or(failed.unwrap_or(PuzzleError::Narrow { piece: 0 }))
}

/// How far a number of pieces is from the one asked for: the logarithm of their ratio, without its sign.
fn off(puzzle: &Puzzle, asked: f64) -> f64 {
    libm::log(puzzle.pieces() as f64 / asked).abs()
}

/// How much the narrowest neck is below the least width, relative to that; 0 if none is.
fn lacking(puzzle: &Puzzle, options: &PuzzleOptions) -> f64 {
    let least = options.least_neck(puzzle.unit());
    let necks = (0..puzzle.pieces()).filter_map(|piece| puzzle.neck(piece));
    necks.map(|neck| 1.0 - neck.width / least).fold(0.0, f64::max)
}

/// The parts of the cells of sites within an outline, after moving sites slightly if necessary.
fn cut(
    sites: &mut [Point],
    size: [f64; 2],
    step: f64,
    (outline, whimsies, most): (&[Corner], &[Vec<Corner>], [usize; 2]),
    unit: f64,
    random: &mut Random,
) -> Result<Puzzle, PuzzleError> {
    let mut found = Err(PuzzleError::Narrow { piece: 0 });
    for _ in 0..TRIES {
        found = cells::partition(sites, size, step)
            .and_then(|cells| clip::within(&cells, outline, whimsies, most));
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

/// How much a deviation from the number of hexagons counts beside one from regular ones, and the deviation that does not count.
const COUNTS_OF_HEXAGONS: f64 = 4.0;
const FREE: f64 = 0.1;

fn hexagons([width, height]: [f64; 2], pieces: usize) -> Vec<Point> {
    // The distance of rows is √3/2 of the distance of neighbours.
    let regular = (pieces as f64 * height / width * 2.0 / 3.0_f64.sqrt()).sqrt();
    let columns_of = |rows: usize| (pieces as f64 / rows as f64).round().max(1.0) as usize;
    let missed = |rows: usize| {
        let off = libm::log((rows * columns_of(rows)) as f64 / pieces as f64).abs();
        COUNTS_OF_HEXAGONS * (off - FREE).max(0.0) + (rows as f64 - regular).abs() / regular
    };
    let rows = (1..=pieces).min_by(|a, b| missed(*a).total_cmp(&missed(*b))).unwrap_or(1);
    let columns = columns_of(rows);
    let y = |r: usize| height * (2 * r + 1) as f64 / (2 * rows) as f64;
    let x = |r: usize, c: usize| width * ((4 * c + 1 + 2 * (r % 2)) as f64) / ((4 * columns) as f64);
    (0..rows).flat_map(|r| (0..columns).map(move |c| [x(r, c), y(r)])).collect()
}
