//! The files of `NeuronTransportIGA`: `controlmesh.vtk`, `bzmeshinfo.txt`, `bzpt.txt`, `cmat.txt`.

use crate::text_rows::TextRows;
use crate::{CellKind, CellSplines, HexMesh, UnstructuredSplines};
use glam::DVec3;
use std::fmt::Write;

/// Why a file cannot be read as one of `NeuronTransportIGA`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: found {found:?}, expected {expected}")]
pub struct IgaFileError {
    /// The line, from 1.
    pub line: usize,
    /// What is there.
    pub found: String,
    /// What should be.
    pub expected: String,
}

/// The mesh as `controlmesh.vtk`, with a label for each vertex: −1 inside, 0 on the wall, 1 at the inlet, 2 and more at the other
/// ends.
///
/// # Panics
/// Unless there is a label for each vertex.
pub fn controlmesh(mesh: &HexMesh, labels: &[i64]) -> String {
    assert_eq!(labels.len(), mesh.positions().len(), "a label for each vertex");
    let mut text = String::from("# vtk DataFile Version 3.1\npompeiu\nASCII\nDATASET UNSTRUCTURED_GRID\n");
    let (vertices, cells) = (mesh.positions().len(), mesh.cells().len());
    let _ = writeln!(text, "POINTS {vertices} FLOAT");
    for p in mesh.positions() {
        let _ = writeln!(text, "{} {} {}", p.x, p.y, p.z);
    }
    let _ = writeln!(text, "CELLS {cells} {}", 9 * cells);
    for cell in mesh.cells() {
        text.push('8');
        for v in cell {
            let _ = write!(text, " {v}");
        }
        text.push('\n');
    }
    let _ = writeln!(text, "CELL_TYPES {cells}");
    text.push_str(&"12\n".repeat(cells));
    let _ = writeln!(text, "POINT_DATA {vertices}\nSCALARS label float 1\nLOOKUP_TABLE default");
    for label in labels {
        let _ = writeln!(text, "{label}");
    }
    text
}

/// Positions in the units of `bzpt.txt`: relative to the lowest corner of their bounding box, in units of its shortest side.
pub fn iga_units(places: &[DVec3]) -> Vec<DVec3> {
    let low = places.iter().fold(DVec3::INFINITY, |low, p| low.min(*p));
    let high = places.iter().fold(DVec3::NEG_INFINITY, |high, p| high.max(*p));
    let unit = (high - low).min_element();
    let unit = if unit > 0.0 { unit } else { 1.0 };
    places.iter().map(|p| (*p - low) / unit).collect()
}

impl UnstructuredSplines {
    /// The functions of each cell as `bzmeshinfo.txt`, numbered from 1, which METIS reads as a mesh.
    pub fn bzmeshinfo(&self) -> String {
        let mut text = TextRows::new(self.cells().len());
        self.cells().iter().for_each(|cell| text.functions(cell));
        text.into_string()
    }

    /// The functions of each cell and their coefficients as `cmat.txt`.
    pub fn cmat(&self) -> String {
        let mut text = TextRows::new(self.cells().len());
        self.cells().iter().enumerate().for_each(|(index, cell)| text.coefficients(index, cell));
        text.into_string()
    }

    /// The Bézier points of each cell as `bzpt.txt`.
    ///
    /// # Panics
    /// If a function has no position.
    pub fn bzpt(&self, places: &[DVec3]) -> String {
        let mut text = TextRows::new(64 * self.cells().len());
        self.cells().iter().for_each(|cell| text.points(&cell.bezier_points(places)));
        text.into_string()
    }

    /// Reads `cmat.txt`.
    ///
    /// # Errors
    /// [`IgaFileError`] with the line.
    pub fn from_cmat(text: &str) -> Result<Self, IgaFileError> {
        let mut lines = Lines::new(text);
        let count: usize = lines.one("the number of cells")?;
        let mut cells = Vec::new();
        for index in 0..count {
            let [number, functions, kind] =
                lines.numbers::<usize>("a cell's number, functions and type")?[..]
            else {
                return Err(lines.wrong("three numbers: a cell's number, functions and type"));
            };
            if number != index {
                return Err(lines.wrong(&format!("cell {index}")));
            }
            let kind = u8::try_from(kind).ok().and_then(CellKind::from_number);
            let kind = kind.ok_or_else(|| lines.wrong("a type of 0, 1 or 2"))?;
            let list: Vec<u32> = lines.numbers("the functions of a cell")?;
            if list.len() != functions {
                return Err(lines.wrong(&format!("{functions} functions")));
            }
            let coefficients = list.iter().map(|_| {
                let row: Vec<f64> = lines.numbers("64 coefficients")?;
                <[f64; 64]>::try_from(row).map_err(|_| lines.wrong("64 coefficients"))
            });
            let coefficients = coefficients.collect::<Result<_, _>>()?;
            cells.push(CellSplines { functions: list, kind, coefficients });
        }
        lines.end()?;
        Ok(Self::from_cells(cells))
    }
}

/// Reads `bzmeshinfo.txt`: the functions of each cell, from 0.
///
/// # Errors
/// [`IgaFileError`] with the line.
pub fn read_bzmeshinfo(text: &str) -> Result<Vec<Vec<u32>>, IgaFileError> {
    let mut lines = Lines::new(text);
    let count: usize = lines.one("the number of cells")?;
    let mut cells = Vec::new();
    for _ in 0..count {
        let list: Vec<u32> = lines.numbers("the functions of a cell")?;
        if list.contains(&0) {
            return Err(lines.wrong("numbers from 1"));
        }
        cells.push(list.into_iter().map(|v| v - 1).collect());
    }
    lines.end()?;
    Ok(cells)
}

/// Reads `bzpt.txt`: the Bézier points of each cell.
///
/// # Errors
/// [`IgaFileError`] with the line.
pub fn read_bzpt(text: &str) -> Result<Vec<[DVec3; 64]>, IgaFileError> {
    let mut lines = Lines::new(text);
    let count: usize = lines.one("the number of points")?;
    if !count.is_multiple_of(64) {
        return Err(lines.wrong("a multiple of 64"));
    }
    let mut cells = Vec::new();
    for _ in 0..count / 64 {
        let mut points = [DVec3::ZERO; 64];
        for point in &mut points {
            let [x, y, z] = lines.numbers::<f64>("three coordinates")?[..] else {
                return Err(lines.wrong("three coordinates"));
            };
            *point = DVec3::new(x, y, z);
        }
        cells.push(points);
    }
    lines.end()?;
    Ok(cells)
}

/// Lines that are not blank.
struct Lines<'t> {
    rest: std::iter::Enumerate<std::str::Lines<'t>>,
    line: usize,
    text: &'t str,
}

impl<'t> Lines<'t> {
    fn new(text: &'t str) -> Self {
        Self { rest: text.lines().enumerate(), line: 0, text: "" }
    }

    fn wrong(&self, expected: &str) -> IgaFileError {
        let found = self.text.chars().take(40).collect();
        IgaFileError { line: self.line, found, expected: expected.to_owned() }
    }

    fn next(&mut self) -> bool {
        for (index, text) in self.rest.by_ref() {
            (self.line, self.text) = (index + 1, text.trim());
            if !self.text.is_empty() {
                return true;
            }
        }
        (self.line, self.text) = (self.line + 1, "");
        false
    }

    fn numbers<T: std::str::FromStr>(&mut self, expected: &str) -> Result<Vec<T>, IgaFileError> {
        if !self.next() {
            return Err(self.wrong(expected));
        }
        let words = self.text.split_ascii_whitespace();
        words.map(|word| word.parse().map_err(|_| self.wrong(expected))).collect()
    }

    fn one(&mut self, expected: &str) -> Result<usize, IgaFileError> {
        let list: Vec<usize> = self.numbers(expected)?;
        if let [one] = list[..] { Ok(one) } else { Err(self.wrong(expected)) }
    }

    fn end(&mut self) -> Result<(), IgaFileError> {
        if self.next() { Err(self.wrong("the end of the file")) } else { Ok(()) }
    }
}
