//! Cells by their corners, independent of the layout in the file.

use crate::error::{FormatError, Location};
use crate::raw::RawMesh;

/// The cell types of a surface or of lower dimension, by their numbers in `vtkCellType.h`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CellKind {
    /// Points, lines and empty cells.
    NoSurface,
    Triangle,
    TriangleStrip,
    Polygon,
    /// A quadrilateral with its corners row by row.
    Pixel,
    Quadrilateral,
}

impl CellKind {
    /// The kind with a number; the number where it is none of these.
    pub(super) const fn from_number(number: u64) -> Result<Self, u64> {
        Ok(match number {
            0..=4 => Self::NoSurface,
            5 => Self::Triangle,
            6 => Self::TriangleStrip,
            7 => Self::Polygon,
            8 => Self::Pixel,
            9 => Self::Quadrilateral,
            other => return Err(other),
        })
    }
}

/// Corners of many cells, one cell after the other.
#[derive(Debug, Default)]
pub(super) struct CellArray {
    pub(super) corners: Vec<u64>,
    /// Where the corners of each cell end.
    pub(super) ends: Vec<u64>,
}

/// Adds the faces of each cell; corners are relative to the points from `base` on, which are the last of the mesh.
pub(super) fn add(
    raw: &mut RawMesh,
    base: usize,
    cells: &CellArray,
    kind: impl Fn(usize) -> Result<CellKind, u64>,
) -> Result<(), FormatError> {
    let points = (raw.positions.len() - base) as u64;
    let mut begin = 0;
    let mut local = Vec::new();
    for (cell, &end) in cells.ends.iter().enumerate() {
        let wrong = |problem: String| FormatError::new(Location::Face(cell as u64), problem);
        let corners =
            usize::try_from(end).ok().and_then(|end| cells.corners.get(begin..end)).ok_or_else(|| {
                wrong(format!("its corners end at {end}, expected {begin} to {}", cells.corners.len()))
            })?;
        begin += corners.len();
        local.clear();
        for &corner in corners {
            if corner >= points {
                return Err(wrong(format!(
                    "point {corner} does not exist, there are {points} (the first is 0)"
                )));
            }
            local.push((base as u64 + corner) as u32);
        }
        let kind = kind(cell).map_err(|number| wrong(no_surface(number)))?;
        add_cell(raw, kind, &local).map_err(wrong)?;
    }
    Ok(())
}

/// Why a cell of another type, by its number in `vtkCellType.h`, is no part of a surface, and what to do.
fn no_surface(number: u64) -> String {
    const FACES: &str = "cut it into linear triangles first (in ParaView: Tessellate, then save as VTP)";
    const SOLIDS: &str =
        "extract the surface of the solid first (in ParaView: Extract Surface, then save as VTP)";
    let (name, cure) = match number {
        10 => ("a tetrahedron", SOLIDS),
        11 => ("a voxel", SOLIDS),
        12 => ("a hexahedron", SOLIDS),
        13 => ("a wedge", SOLIDS),
        14 => ("a pyramid", SOLIDS),
        15 | 16 => ("a prism", SOLIDS),
        21 | 35 | 68 | 75 => ("a curve", "leave curves out"),
        22 | 23 | 28 | 30 | 34 | 36 => ("a quadratic face", FACES),
        24..=27 | 29 | 31..=33 | 37 => ("a quadratic solid", SOLIDS),
        41 => ("a convex point set", SOLIDS),
        42 => ("a polyhedron", SOLIDS),
        69 | 70 => ("a Lagrange face", FACES),
        71..=74 => ("a Lagrange solid", SOLIDS),
        76 | 77 => ("a Bézier face", FACES),
        78..=81 => ("a Bézier solid", SOLIDS),
        _ => ("of a kind that is not known here", "convert it to triangles first"),
    };
    format!(
        "the cell is {name} (VTK type {number}), expected a triangle, quadrilateral, polygon or strip; {cure}"
    )
}

fn add_cell(raw: &mut RawMesh, kind: CellKind, corners: &[u32]) -> Result<(), String> {
    let corner_count = |expected: usize| match corners.len() {
        n if n == expected => Ok(()),
        n => Err(format!("{n} corners, expected {expected}")),
    };
    match kind {
        CellKind::NoSurface => raw.faces_dropped += 1,
        CellKind::Triangle => {
            corner_count(3)?;
            raw.push_polygon(corners.iter().copied());
        }
        CellKind::Polygon => raw.push_polygon(corners.iter().copied()),
        CellKind::Quadrilateral => {
            corner_count(4)?;
            raw.push_polygon(corners.iter().copied());
        }
        CellKind::Pixel => {
            corner_count(4)?;
            raw.push_polygon([corners[0], corners[1], corners[3], corners[2]]);
        }
        CellKind::TriangleStrip if corners.len() < 3 => raw.faces_dropped += 1,
        CellKind::TriangleStrip => {
            for (t, triangle) in corners.windows(3).enumerate() {
                let [a, b, c] = [triangle[0], triangle[1], triangle[2]];
                raw.faces.push(if t % 2 == 0 { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    Ok(())
}

/// The number of points, if 32-bit indices can name them all.
pub(super) fn check_point_count(points: usize) -> Result<(), FormatError> {
    if u32::try_from(points).is_ok() {
        return Ok(());
    }
    Err(FormatError::new(Location::File, format!("{points} points, at most {} are supported", u32::MAX)))
}
