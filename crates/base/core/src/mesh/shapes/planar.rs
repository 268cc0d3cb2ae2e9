//! Flat shapes in the plane z = 0, facing up.

use super::ShapeError;
use super::arrays::{Arrays, centred, count, length, turn};
use crate::mesh::TriMesh;

/// How the rectangles of a grid are split into two triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Diagonal {
    /// From the corner of least x and y to the corner of greatest x and y.
    #[default]
    Rising,
    /// From the corner of least x and greatest y to the corner of greatest x and least y.
    Falling,
    /// Rising and falling in turn, like the colours of a chessboard, rising first.
    Alternating,
}

/// Rectangle of `cells[0] × cells[1]` split rectangles.
///
/// # Shapes and units
/// `size`: extents along x and y. `(n+1)(m+1)` vertices, `2nm` faces, area `size[0]·size[1]`.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn grid(size: [f64; 2], cells: [u32; 2], diagonal: Diagonal) -> Result<TriMesh, ShapeError> {
    for extent in size {
        length("side", extent)?;
    }
    let (n, m) = (count("cells", cells[0], 1)?, count("cells", cells[1], 1)?);
    let mut arrays = Arrays::with_capacity((n + 1) * (m + 1), 2 * n * m)?;
    for j in 0..=cells[1] {
        for i in 0..=cells[0] {
            arrays.positions.push([centred(size[0], i, cells[0]), centred(size[1], j, cells[1]), 0.0]);
        }
    }
    for j in 0..cells[1] {
        for i in 0..cells[0] {
            let a = j * (cells[0] + 1) + i;
            let d = a + cells[0] + 1;
            let rising = match diagonal {
                Diagonal::Rising => true,
                Diagonal::Falling => false,
                Diagonal::Alternating => i % 2 == j % 2,
            };
            arrays.quad(if rising { [a, a + 1, d + 1, d] } else { [a + 1, d + 1, d, a] });
        }
    }
    arrays.into_mesh()
}

/// Disk of `rings` concentric bands around its centre.
///
/// # Shapes and units
/// `segments ≥ 3` around, `rings ≥ 1`: `segments·rings + 1` vertices, `segments·(2·rings − 1)` faces, the area
/// `(n/2)·sin(2π/n)·r²` of the regular polygon.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn disk(radius: f64, segments: u32, rings: u32) -> Result<TriMesh, ShapeError> {
    length("radius", radius)?;
    let (n, m) = (count("segments", segments, 3)?, count("rings", rings, 1)?);
    let mut arrays = Arrays::with_capacity(n * m + 1, n * (2 * m - 1))?;
    arrays.positions.push([0.0; 3]);
    for ring in 1..=rings {
        let distance = radius * (f64::from(ring) / f64::from(rings));
        for segment in 0..segments {
            let [x, y] = turn(segment.into(), segments.into());
            arrays.positions.push([distance * x, distance * y, 0.0]);
        }
    }
    let vertex = |ring: u32, segment: u32| 1 + (ring - 1) * segments + segment % segments;
    for segment in 0..segments {
        arrays.faces.push([0, vertex(1, segment), vertex(1, segment + 1)]);
    }
    for ring in 1..rings {
        for s in 0..segments {
            arrays.quad([vertex(ring, s), vertex(ring + 1, s), vertex(ring + 1, s + 1), vertex(ring, s + 1)]);
        }
    }
    arrays.into_mesh()
}

/// The corners of the cells of a square grid as triangles shrunk to points: each face names one vertex three times.
///
/// # Shapes and units
/// `(n+1)²` vertices and faces; area 0. The Pompeiu–Hausdorff distance from the square to them is `side·√2/(2n)`.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn point_lattice(side: f64, cells: u32) -> Result<TriMesh, ShapeError> {
    length("side", side)?;
    let n = count("cells", cells, 1)? + 1;
    let mut arrays = Arrays::with_capacity(n * n, n * n)?;
    for j in 0..=cells {
        for i in 0..=cells {
            arrays.faces.push([arrays.positions.len() as u32; 3]);
            arrays.positions.push([centred(side, i, cells), centred(side, j, cells), 0.0]);
        }
    }
    arrays.into_mesh()
}

#[cfg(test)]
mod tests {
    use super::super::measure::{area, assert_close, edges, euler_characteristic};
    use super::*;

    #[test]
    fn grids_have_their_counts_and_area_whatever_the_diagonals() {
        for diagonal in [Diagonal::Rising, Diagonal::Falling, Diagonal::Alternating] {
            let mesh = grid([2.0, 3.0], [4, 5], diagonal).unwrap();
            assert_eq!((mesh.positions().len(), mesh.faces().len()), (30, 40));
            assert_close(area(&mesh), 6.0);
            assert_eq!((edges(&mesh).1, edges(&mesh).2, euler_characteristic(&mesh)), (18, true, 1));
            assert_eq!((mesh.positions()[0], mesh.positions()[29]), ([-1.0, -1.5, 0.0], [1.0, 1.5, 0.0]));
        }
        let diagonals = |diagonal| {
            let mesh = grid([2.0, 1.0], [2, 1], diagonal).unwrap();
            let [a, b] = [0, 2].map(|f| [mesh.faces()[f][0], mesh.faces()[f][2]]);
            [a, b].map(|[p, q]| [p.min(q), p.max(q)])
        };
        assert_eq!(diagonals(Diagonal::Rising), [[0, 4], [1, 5]]);
        assert_eq!(diagonals(Diagonal::Falling), [[1, 3], [2, 4]]);
        assert_eq!(diagonals(Diagonal::Alternating), [[0, 4], [2, 4]]);
        // All four diagonals of a 2 × 2 board meet in its centre.
        let board = grid([2.0, 2.0], [2, 2], Diagonal::Alternating).unwrap();
        assert_eq!(board.faces().iter().filter(|f| f.contains(&4)).count(), 8);
    }

    #[test]
    fn disk_is_a_regular_polygon() {
        for (segments, rings) in [(3, 1), (5, 4), (64, 3)] {
            let mesh = disk(2.0, segments, rings).unwrap();
            let (n, m) = (segments as usize, rings as usize);
            assert_eq!((mesh.positions().len(), mesh.faces().len()), (n * m + 1, n * (2 * m - 1)));
            assert_close(area(&mesh), 2.0 * n as f64 * (std::f64::consts::TAU / n as f64).sin());
            assert_eq!((edges(&mesh).1, edges(&mesh).2, euler_characteristic(&mesh)), (n, true, 1));
            for (i, p) in mesh.positions()[1..].iter().enumerate() {
                assert_close(p[0].hypot(p[1]), 2.0 * (i / n + 1) as f64 / m as f64);
            }
        }
    }

    #[test]
    fn point_lattice_is_made_of_points() {
        let mesh = point_lattice(1.0, 2).unwrap();
        assert_eq!(mesh.faces(), (0..9).map(|v| [v; 3]).collect::<Vec<_>>());
        assert_eq!(mesh.positions()[4], [0.0; 3]);
    }

    #[test]
    fn unusable_parameters_are_refused() {
        assert!(matches!(grid([1.0, 0.0], [1, 1], Diagonal::Rising), Err(ShapeError::Size { .. })));
        assert!(matches!(grid([1.0, 1.0], [1, 0], Diagonal::Rising), Err(ShapeError::TooFew { .. })));
        assert!(matches!(point_lattice(1.0, u32::MAX), Err(ShapeError::TooMany { .. })));
        assert!(matches!(disk(1.0, 3, 0), Err(ShapeError::TooFew { what: "rings", .. })));
    }
}
