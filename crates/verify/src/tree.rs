//! The cut trees of a block of faces, read and checked.

use crate::kernel::{Corner, End, Facet, MOST_CORNERS, PLACES, part, whole};
use crate::{Pair, Rejected};

/// Polygons that wait for their node, at most.
pub const MOST_WAITING: usize = 1000;

/// Polygons that wait for their node; the last one in comes first.
#[derive(Clone, Debug, Default)]
pub struct Waiting {
    corners: Vec<Corner>,
    starts: Vec<usize>,
}

impl Waiting {
    /// Adds the part of a polygon from one end of a chord round to the other; false if it has too many corners or too many wait.
    pub fn push(&mut self, polygon: &[Corner], from: End, to: End) -> bool {
        self.starts.push(self.corners.len());
        part(polygon, from, to, &mut self.corners);
        self.corners.len() - self.starts[self.starts.len() - 1] <= MOST_CORNERS
            && self.starts.len() <= MOST_WAITING
    }

    fn start(&mut self, face: [Corner; 3]) {
        self.starts.push(0);
        self.corners.extend(face);
    }

    /// Moves the last polygon into `polygon`.
    pub fn pop(&mut self, polygon: &mut Vec<Corner>) -> bool {
        let start = self.starts.pop();
        polygon.clear();
        polygon.extend(self.corners.drain(start.unwrap_or(self.corners.len())..));
        start.is_some()
    }
}

/// Reads one block: the trees of faces of A that follow each other.
pub(crate) struct Trees<'t> {
    pair: &'t Pair<'t>,
    upper: f64,
    bytes: &'t [u8],
    at: usize,
    last: i64,
}

impl<'t> Trees<'t> {
    pub(crate) fn new(pair: &'t Pair<'t>, upper: f64, bytes: &'t [u8]) -> Self {
        Self { pair, upper, bytes, at: 0, last: 0 }
    }

    /// Shows that no point of these faces is farther from B than `upper`; the number of cells.
    pub(crate) fn check(mut self, faces: std::ops::Range<usize>) -> Result<u64, Rejected> {
        let (mut cells, mut run) = (0, 0);
        let (mut waiting, mut polygon, mut inner) = (Waiting::default(), Vec::new(), Vec::new());
        for face in faces {
            let triangle = self.pair.a.triangle(face);
            let first = cells;
            if run > 0 {
                run -= 1;
                self.leaf(face, 0, &whole(triangle), &self.facet(triangle[0]))?;
                cells += 1;
                continue;
            }
            waiting.start(whole(triangle));
            let mut is_whole = true;
            while waiting.pop(&mut polygon) {
                let code = self.number()?;
                match code & 3 {
                    0 | 2 => {
                        let sides = if code & 3 == 2 { code >> 2 & 7 } else { 0 };
                        self.go_to(code >> if code & 3 == 2 { 5 } else { 2 })?;
                        let facet = self.facet(triangle[0]);
                        for side in (0..3).filter(|side| sides >> side & 1 == 1) {
                            let crossing = facet.crossing(side, &polygon);
                            let [out, back] =
                                crossing.ok_or_else(|| self.malformed("a side that crosses no polygon"))?;
                            let fits = waiting.push(&polygon, out, back);
                            inner.clear();
                            part(&polygon, back, out, &mut inner);
                            std::mem::swap(&mut polygon, &mut inner);
                            if !fits || polygon.len() > MOST_CORNERS {
                                return Err(self.malformed("a tree that is too deep"));
                            }
                        }
                        self.leaf(face, cells - first, &polygon, &facet)?;
                        cells += 1;
                        run = if is_whole && code == 0 { self.number()? } else { 0 };
                    }
                    1 => {
                        let [i, j] = self.chord(code >> 2, polygon.len())?;
                        if !(waiting.push(&polygon, j, i) && waiting.push(&polygon, i, j)) {
                            return Err(self.malformed("a tree that is too deep"));
                        }
                    }
                    _ => return Err(self.malformed("a node of no kind")),
                }
                is_whole = false;
            }
        }
        if run > 0 || self.at < self.bytes.len() {
            return Err(self.malformed("more than the trees of its faces"));
        }
        Ok(cells)
    }

    /// The face of B that was named last.
    fn facet(&self, origin: [f64; 3]) -> Facet {
        Facet::new(self.pair.b.triangle(self.last as usize), origin)
    }

    /// Convexity: what holds at the corners holds on the polygon.
    fn leaf(&self, face: usize, cell: u64, polygon: &[Corner], facet: &Facet) -> Result<(), Rejected> {
        // Written so that what is not a number fails.
        let is_near = polygon.iter().all(|corner| facet.at_most(corner) <= self.upper);
        let [a, b] = [face, self.last as usize].map(|f| f as u32);
        if is_near { Ok(()) } else { Err(Rejected::Cell { face: a, cell, of_b: b }) }
    }

    fn chord(&mut self, rest: u64, corners: usize) -> Result<[End; 2], Rejected> {
        let (sides, n) = (rest >> 6, corners as u64);
        let (i, j) = (sides / n, sides % n);
        if !(i < j && j < n) {
            return Err(self.malformed("a chord between sides that are not there"));
        }
        let t = self.place(rest >> 3 & 7)?;
        Ok([End { side: i as usize, t }, End { side: j as usize, t: self.place(rest & 7)? }])
    }

    /// A position on a side: bytes, most significant first, over 2^8, 2^16, ..., 2^48, or 2^52.
    fn place(&mut self, count: u64) -> Result<f64, Rejected> {
        let mut value = 0_u64;
        for _ in 0..count {
            value = value << 8 | u64::from(self.byte()?);
        }
        let t = value as f64 / if count == 7 { PLACES } else { (1_u64 << (8 * count)) as f64 };
        if t < 1.0 && value < 1 << 52 { Ok(t) } else { Err(self.malformed("a position beyond its side")) }
    }

    fn go_to(&mut self, zigzag: u64) -> Result<(), Rejected> {
        let step = (zigzag >> 1).cast_signed() ^ -(zigzag & 1).cast_signed();
        self.last = self.last.saturating_add(step);
        let is_there = (0..self.pair.b.len().cast_signed() as i64).contains(&self.last);
        if is_there { Ok(()) } else { Err(self.malformed("a face that B does not have")) }
    }

    /// Seven bits a byte, the least significant first.
    fn number(&mut self) -> Result<u64, Rejected> {
        let mut value = 0;
        for shift in (0..63).step_by(7) {
            let byte = self.byte()?;
            value |= u64::from(byte & 127) << shift;
            if byte < 128 {
                return Ok(value);
            }
        }
        Err(self.malformed("a number of more than 63 bits"))
    }

    fn byte(&mut self) -> Result<u8, Rejected> {
        let byte = self.bytes.get(self.at).copied();
        self.at += 1;
        byte.ok_or_else(|| self.malformed("the end of its block in the middle of a tree"))
    }

    fn malformed(&self, found: &'static str) -> Rejected {
        Rejected::Malformed { found, byte: self.at as u64 }
    }
}
