//! The legacy format: each array follows a few words of text, and is text or big-endian binary itself.

use super::cells::{self, CellArray, CellKind};
use super::numbers::{ByteOrder, NumberType};
use crate::error::{FormatError, Location};
use crate::raw::RawMesh;
use crate::solids::Solids;
use crate::text::{self, Problem, quoted};

pub(crate) fn read(bytes: &[u8]) -> Result<RawMesh, FormatError> {
    let mut scanner = Scanner { bytes, at: 0, binary: false, last: Vec::new() };
    let parts = read_parts(&mut scanner).map_err(|problem| scanner.error(problem))?;
    cells::check_point_count(parts.positions.len())?;
    let mut raw = RawMesh { positions: parts.positions, ..RawMesh::default() };
    match parts.types {
        None => {
            for (kind, array) in &parts.arrays {
                cells::add(&mut raw, 0, array, |_| Ok(*kind))?;
            }
        }
        Some(types) => {
            for (_, array) in &parts.arrays {
                if types.len() != array.ends.len() {
                    let problem = format!("{} cell types for {} cells", types.len(), array.ends.len());
                    return Err(FormatError::new(Location::File, problem));
                }
                cells::add(&mut raw, 0, array, |cell| CellKind::from_number(types[cell]))?;
            }
        }
    }
    Ok(raw)
}

/// Whether data of points or cells follow the surface.
pub(crate) fn has_data(bytes: &[u8]) -> Result<bool, FormatError> {
    let mut scanner = Scanner { bytes, at: 0, binary: false, last: Vec::new() };
    read_parts(&mut scanner).map_err(|problem| scanner.error(problem))?;
    Ok(!scanner.last.is_empty())
}

/// Reads the solid cells of an unstructured grid, and the point data named `label`.
pub(crate) fn read_solids<const N: usize>(bytes: &[u8]) -> Result<Solids<N>, FormatError> {
    let mut scanner = Scanner { bytes, at: 0, binary: false, last: Vec::new() };
    let read = |scanner: &mut Scanner<'_>| {
        let parts = read_parts(scanner)?;
        let labels = read_labels(scanner, parts.positions.len() as u64)?;
        Ok((parts, labels))
    };
    let (parts, labels) = read(&mut scanner).map_err(|problem| scanner.error(problem))?;
    cells::check_point_count(parts.positions.len())?;
    let Some(types) = parts.types else {
        let problem = "found POLYDATA, expected an unstructured grid";
        return Err(FormatError::new(Location::File, problem));
    };
    let mut grid = Solids { positions: parts.positions, labels, ..Solids::default() };
    for (_, array) in &parts.arrays {
        if types.len() != array.ends.len() {
            let problem = format!("{} cell types for {} cells", types.len(), array.ends.len());
            return Err(FormatError::new(Location::File, problem));
        }
        grid.add(0, (&array.corners, &array.ends), &types)?;
    }
    Ok(grid)
}

/// The point data named `label`, if it comes first; other data is ignored.
fn read_labels(scanner: &mut Scanner<'_>, points: u64) -> Result<Option<Vec<f64>>, Problem> {
    if scanner.last != b"point_data" {
        return Ok(None);
    }
    let (at, count) = (scanner.at, scanner.count()?);
    if scanner.keyword().1 != b"scalars" || scanner.keyword().1 != b"label" {
        return Ok(None);
    }
    if count != points {
        return Err(Problem::new(at, format!("found data for {count} points, expected {points}")));
    }
    let number_type = scanner.number_type()?;
    let mut next = scanner.keyword();
    if next.1 == b"1" {
        next = scanner.keyword();
    }
    if next.1 != b"lookup_table" {
        let problem = format!("found {}, expected LOOKUP_TABLE", quoted(&next.1));
        return Err(Problem::new(next.0, problem));
    }
    scanner.keyword();
    scanner.end_header_line();
    scanner.reals(count, number_type).map(Some)
}

#[derive(Default)]
struct Parts {
    positions: Vec<[f64; 3]>,
    arrays: Vec<(CellKind, CellArray)>,
    /// One for each cell; unstructured grids only.
    types: Option<Vec<u64>>,
}

fn read_parts(scanner: &mut Scanner<'_>) -> Result<Parts, Problem> {
    let first = scanner.line();
    if !first.to_ascii_lowercase().starts_with(b"# vtk datafile") {
        return Err(Problem::new(0, format!("found {}, expected \"# vtk DataFile\"", quoted(first))));
    }
    scanner.line();
    let at = scanner.at;
    scanner.binary = match scanner.line().to_ascii_lowercase().trim_ascii() {
        b"ascii" => false,
        b"binary" => true,
        other => return Err(Problem::new(at, format!("found {}, expected ASCII or BINARY", quoted(other)))),
    };
    scanner.expect("dataset")?;
    let (at, dataset) = scanner.keyword();
    let grid = match dataset.as_slice() {
        b"polydata" => false,
        b"unstructured_grid" => true,
        other => {
            let problem = format!("found {}, expected POLYDATA or UNSTRUCTURED_GRID", quoted(other));
            return Err(Problem::new(at, problem));
        }
    };
    let mut parts = Parts { types: grid.then(Vec::new), ..Parts::default() };
    loop {
        let (at, keyword) = scanner.keyword();
        let kind = match keyword.as_slice() {
            // Point and cell data follow, and no more points or cells.
            b"" | b"point_data" | b"cell_data" => {
                scanner.last = keyword;
                return Ok(parts);
            }
            b"points" => {
                parts.positions = read_points(scanner)?;
                continue;
            }
            b"cell_types" if grid => {
                let count = scanner.count()?;
                scanner.end_header_line();
                parts.types = Some(scanner.counts(count, NumberType::I32)?);
                continue;
            }
            b"field" => {
                skip_field(scanner)?;
                continue;
            }
            b"metadata" => {
                skip_metadata(scanner);
                continue;
            }
            b"vertices" | b"lines" if !grid => CellKind::NoSurface,
            b"polygons" if !grid => CellKind::Polygon,
            b"triangle_strips" if !grid => CellKind::TriangleStrip,
            // The cell types follow in their own section.
            b"cells" if grid => CellKind::NoSurface,
            other => {
                let problem = format!("found {}, expected points, cells or their data", quoted(other));
                return Err(Problem::new(at, problem));
            }
        };
        parts.arrays.push((kind, read_cells(scanner)?));
    }
}

fn read_points(scanner: &mut Scanner<'_>) -> Result<Vec<[f64; 3]>, Problem> {
    let count = scanner.count()?;
    let number_type = scanner.number_type()?;
    scanner.end_header_line();
    let values = scanner.reals(count.saturating_mul(3), number_type)?;
    Ok(values.as_chunks().0.to_vec())
}

fn read_cells(scanner: &mut Scanner<'_>) -> Result<CellArray, Problem> {
    let (at, first, second) = (scanner.at, scanner.count()?, scanner.count()?);
    scanner.end_header_line();
    let data = scanner.at;
    if scanner.keyword().1 != b"offsets" {
        scanner.at = data;
        return cells_with_counts(scanner, first, second, at);
    }
    // Since version 5.1: one offset more than cells, then all corners.
    let offset_type = scanner.number_type()?;
    scanner.end_header_line();
    let mut ends = scanner.counts(first, offset_type)?;
    scanner.expect("connectivity")?;
    let corner_type = scanner.number_type()?;
    scanner.end_header_line();
    let corners = scanner.counts(second, corner_type)?;
    if !ends.is_empty() {
        let start = ends.remove(0);
        if start != 0 {
            return Err(Problem::new(at, format!("the first cell begins at {start}, expected 0")));
        }
    }
    Ok(CellArray { corners, ends })
}

/// The older layout: each cell is its number of corners followed by the corners.
fn cells_with_counts(
    scanner: &mut Scanner<'_>,
    cells: u64,
    size: u64,
    at: usize,
) -> Result<CellArray, Problem> {
    let values = scanner.counts(size, NumberType::I32)?;
    let mut array = CellArray::default();
    let mut rest = values.as_slice();
    while let Some((&count, behind)) = rest.split_first() {
        let Some((corners, next)) = usize::try_from(count).ok().and_then(|n| behind.split_at_checked(n))
        else {
            let (cell, left) = (array.ends.len(), behind.len());
            return Err(Problem::new(
                at,
                format!("cell {cell} has {count} corners, but only {left} numbers follow"),
            ));
        };
        array.corners.extend_from_slice(corners);
        array.ends.push(array.corners.len() as u64);
        rest = next;
    }
    if array.ends.len() as u64 != cells {
        return Err(Problem::new(
            at,
            format!("{size} numbers make {} cells, expected {cells}", array.ends.len()),
        ));
    }
    Ok(array)
}

fn skip_field(scanner: &mut Scanner<'_>) -> Result<(), Problem> {
    scanner.keyword();
    let arrays = scanner.count()?;
    for _ in 0..arrays {
        // A name, or other information about the array before.
        while scanner.keyword().1 == b"metadata" {
            skip_metadata(scanner);
        }
        let (components, tuples) = (scanner.count()?, scanner.count()?);
        let values = components.saturating_mul(tuples);
        let before = scanner.at;
        match scanner.keyword().1.as_slice() {
            b"string" | b"utf8_string" => scanner.skip_strings(values)?,
            b"bit" if scanner.binary => {
                scanner.end_header_line();
                scanner.skip(values.div_ceil(8), NumberType::U8)?;
            }
            b"bit" => scanner.skip(values, NumberType::U8)?,
            _ => {
                scanner.at = before;
                let number_type = scanner.number_type()?;
                scanner.end_header_line();
                scanner.skip(values, number_type)?;
            }
        }
    }
    Ok(())
}

/// Skips to the next empty line.
fn skip_metadata(scanner: &mut Scanner<'_>) {
    scanner.line();
    while !scanner.line().trim_ascii().is_empty() {}
}

struct Scanner<'a> {
    bytes: &'a [u8],
    at: usize,
    binary: bool,
    /// The keyword that ended points and cells.
    last: Vec<u8>,
}

impl<'a> Scanner<'a> {
    fn error(&self, problem: Problem) -> FormatError {
        if self.binary {
            FormatError::new(Location::Byte(problem.offset as u64), problem.text)
        } else {
            problem.in_text(self.bytes)
        }
    }

    /// The rest of the line, without its end.
    fn line(&mut self) -> &'a [u8] {
        let (start, next) = (self.at, text::next_line(self.bytes, self.at));
        self.at = next;
        let line = &self.bytes[start..next];
        let end = line.iter().rposition(|b| !text::is_line_end(*b)).map_or(0, |last| last + 1);
        &line[..end]
    }

    /// The next word on this or a later line, and its place; empty at the end.
    fn word(&mut self) -> (usize, &'a [u8]) {
        let blanks = self.bytes[self.at..].iter().take_while(|b| b.is_ascii_whitespace()).count();
        let at = self.at + blanks;
        let length = self.bytes[at..].iter().take_while(|b| !b.is_ascii_whitespace()).count();
        self.at = at + length;
        (at, &self.bytes[at..at + length])
    }

    /// The next word in lower case.
    fn keyword(&mut self) -> (usize, Vec<u8>) {
        let (at, word) = self.word();
        // Longer than any keyword: data in the place of a keyword.
        (at, word[..word.len().min(64)].to_ascii_lowercase())
    }

    fn expect(&mut self, keyword: &str) -> Result<(), Problem> {
        let (at, found) = self.keyword();
        if found == keyword.as_bytes() {
            return Ok(());
        }
        Err(Problem::new(at, format!("found {}, expected {}", quoted(&found), keyword.to_ascii_uppercase())))
    }

    fn count(&mut self) -> Result<u64, Problem> {
        let (at, word) = self.word();
        let count = str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        count.ok_or_else(|| Problem::new(at, format!("found {}, expected a number of things", quoted(word))))
    }

    fn number_type(&mut self) -> Result<NumberType, Problem> {
        let (at, word) = self.keyword();
        let number_type = str::from_utf8(&word).ok().and_then(NumberType::from_legacy_name);
        number_type
            .ok_or_else(|| Problem::new(at, format!("found {}, expected a type of numbers", quoted(&word))))
    }

    /// Binary data begin on the next line.
    fn end_header_line(&mut self) {
        if self.binary {
            self.line();
        }
    }

    fn reals(&mut self, count: u64, number_type: NumberType) -> Result<Vec<f64>, Problem> {
        if self.binary {
            let size = number_type.size();
            let bytes = self.block(count, number_type)?;
            return Ok(bytes.chunks_exact(size).map(|x| number_type.real(x, ByteOrder::Big)).collect());
        }
        let mut values = Vec::with_capacity(self.most_words(count)?);
        for _ in 0..count {
            let (at, _) = self.word();
            let (value, end) = text::coordinate(self.bytes, at)?;
            self.at = end;
            values.push(value);
        }
        Ok(values)
    }

    fn counts(&mut self, count: u64, number_type: NumberType) -> Result<Vec<u64>, Problem> {
        if !self.binary {
            let capacity = self.most_words(count)?;
            let mut values = Vec::with_capacity(capacity);
            for _ in 0..count {
                values.push(self.count()?);
            }
            return Ok(values);
        }
        let (at, size) = (self.at, number_type.size());
        let bytes = self.block(count, number_type)?;
        let read = |(i, x)| {
            let value = number_type.count(x, ByteOrder::Big);
            value.ok_or_else(|| Problem::new(at + i * size, "found a number that is no count or index"))
        };
        bytes.chunks_exact(size).enumerate().map(read).collect()
    }

    fn skip(&mut self, count: u64, number_type: NumberType) -> Result<(), Problem> {
        if self.binary {
            self.block(count, number_type)?;
        } else {
            self.most_words(count)?;
            for _ in 0..count {
                self.word();
            }
        }
        Ok(())
    }

    /// Text has one string per line. In binary each string follows its length; the first two bits give the number of bytes of the
    /// length.
    fn skip_strings(&mut self, count: u64) -> Result<(), Problem> {
        self.line();
        for _ in 0..count {
            if self.at == self.bytes.len() {
                return Err(Problem::new(self.at, "expected a string, but the file ends here"));
            }
            if !self.binary {
                self.line();
                continue;
            }
            let width = [8, 4, 2, 1][usize::from(self.bytes[self.at] >> 6)];
            let prefix = self.block(width, NumberType::U8)?;
            let word = prefix.iter().fold(0_u64, |word, &byte| word << 8 | u64::from(byte));
            let length = word & (u64::MAX >> (64 - 8 * width + 2));
            self.block(length, NumberType::U8)?;
        }
        Ok(())
    }

    /// `count`, if the file is long enough for that many words.
    fn most_words(&self, count: u64) -> Result<usize, Problem> {
        let left = self.bytes.len() - self.at;
        match usize::try_from(count) {
            Ok(count) if count <= left.div_ceil(2) => Ok(count),
            _ => Err(self.too_short(count)),
        }
    }

    fn block(&mut self, count: u64, number_type: NumberType) -> Result<&'a [u8], Problem> {
        let length = usize::try_from(count).ok().and_then(|n| n.checked_mul(number_type.size()));
        let block = length.and_then(|length| self.bytes[self.at..].get(..length));
        let block = block.ok_or_else(|| self.too_short(count))?;
        self.at += block.len();
        Ok(block)
    }

    fn too_short(&self, count: u64) -> Problem {
        let left = self.bytes.len() - self.at;
        Problem::new(self.at, format!("expected {count} numbers, but the file ends after {left} bytes"))
    }
}
