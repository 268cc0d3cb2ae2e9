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
    pub(super) const fn from_number(number: u64) -> Option<Self> {
        Some(match number {
            0..=4 => Self::NoSurface,
            5 => Self::Triangle,
            6 => Self::TriangleStrip,
            7 => Self::Polygon,
            8 => Self::Pixel,
            9 => Self::Quadrilateral,
            _ => return None,
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
    kind: impl Fn(usize) -> Option<CellKind>,
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
        let kind = kind(cell).ok_or_else(|| wrong("the cell is not of a surface".into()))?;
        add_cell(raw, kind, &local).map_err(wrong)?;
    }
    Ok(())
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
