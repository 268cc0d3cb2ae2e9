//! Cones and tents: an apex above a base in the plane z = 0.

use super::arrays::{Arrays, count, length, turn};
use super::{Ends, ShapeError};
use crate::mesh::TriMesh;

/// Cone: a pyramid over a regular polygon in z = 0 with its apex at `[0, 0, height]`.
///
/// # Shapes and units
/// `segments = n ≥ 3`: `n + 1` vertices and `n` faces, and with a base 1 vertex and `n` faces more; volume
/// `h/3 · (n/2)·sin(2π/n)·r²`.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn cone(radius: f64, height: f64, segments: u32, base: Ends) -> Result<TriMesh, ShapeError> {
    length("radius", radius)?;
    length("height", height)?;
    let n = count("segments", segments, 3)?;
    let closed = u128::from(base == Ends::Capped);
    let mut arrays = Arrays::with_capacity(n + 1 + closed, n + n * closed)?;
    arrays.positions.push([0.0, 0.0, height]);
    for segment in 0..segments {
        let [x, y] = turn(segment.into(), segments.into());
        arrays.positions.push([radius * x, radius * y, 0.0]);
    }
    let vertex = |segment: u32| 1 + segment % segments;
    for s in 0..segments {
        arrays.faces.push([0, vertex(s), vertex(s + 1)]);
    }
    if base == Ends::Capped {
        let centre = arrays.positions.len() as u32;
        arrays.positions.push([0.0; 3]);
        for s in 0..segments {
            arrays.faces.push([centre, vertex(s + 1), vertex(s)]);
        }
    }
    arrays.into_mesh()
}

/// Tent: the four sloping faces of a pyramid over the square `[−side/2, side/2]²` in z = 0, apex at `[0, 0, height]`.
///
/// # Shapes and units
/// 5 vertices, 4 faces, no base, area `side·√(side² + 4·height²)`. For `side = 2` the distance from the square to the
/// tent is `h/√(1+h²)`, from the tent to the square `h`.
/// # Errors
/// [`ShapeError::Size`], or [`ShapeError::Mesh`] beyond the largest coordinate.
pub fn tent(side: f64, height: f64) -> Result<TriMesh, ShapeError> {
    let (s, h) = (length("side", side)? / 2.0, length("height", height)?);
    let positions = vec![[-s, -s, 0.0], [s, -s, 0.0], [s, s, 0.0], [-s, s, 0.0], [0.0, 0.0, h]];
    Ok(TriMesh::new(positions, vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])?)
}

#[cfg(test)]
mod tests {
    use super::super::measure::{area, assert_close, assert_solid, edges, euler_characteristic, volume};
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn cone_follows_its_closed_forms() {
        for n in [3, 4, 31] {
            let base = 2.0 * f64::from(n) * (TAU / f64::from(n)).sin();
            let closed = cone(2.0, 3.0, n, Ends::Capped).unwrap();
            assert_eq!((closed.positions().len() as u32, closed.faces().len() as u32), (n + 2, 2 * n));
            assert_solid(&closed, base);
            let open = cone(2.0, 3.0, n, Ends::Open).unwrap();
            assert_eq!((open.positions().len() as u32, open.faces().len() as u32), (n + 1, n));
            assert_eq!((edges(&open).1 as u32, euler_characteristic(&open)), (n, 1));
            // The base lies in z = 0 and contributes no volume.
            assert_close(volume(&open), base);
        }
    }

    #[test]
    fn tent_follows_its_closed_forms() {
        let mesh = tent(2.0, 0.75).unwrap();
        assert_close(area(&mesh), 2.0 * (4.0_f64 + 4.0 * 0.5625).sqrt());
        assert_close(volume(&mesh), 4.0 * 0.75 / 3.0);
        assert_eq!(edges(&mesh), (8, 4, true));
    }

    #[test]
    fn unusable_parameters_are_refused() {
        assert!(matches!(tent(1.0, 0.0), Err(ShapeError::Size { what: "height", .. })));
        assert!(matches!(cone(1.0, 1.0, 2, Ends::Open), Err(ShapeError::TooFew { what: "segments", .. })));
    }
}
