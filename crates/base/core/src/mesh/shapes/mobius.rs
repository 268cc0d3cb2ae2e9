//! The Möbius strip.

use super::ShapeError;
use super::arrays::{Arrays, centred, count, length, turn};
use crate::mesh::TriMesh;

/// Möbius strip: a band around the z axis that makes half a turn about its middle circle. It cannot be oriented.
///
/// # Shapes and units
/// `radius` of the middle circle, `width` of the band; `segments = n ≥ 3` around, `strips = m ≥ 1` across: `n(m+1)`
/// vertices, `2nm` faces, one boundary loop, Euler characteristic 0. The edges at the seam are traversed twice the same
/// way by their two faces.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn mobius_strip(radius: f64, width: f64, segments: u32, strips: u32) -> Result<TriMesh, ShapeError> {
    length("radius", radius)?;
    length("width", width)?;
    let (n, m) = (count("segments", segments, 3)?, count("strips", strips, 1)?);
    let mut arrays = Arrays::with_capacity(n * (m + 1), 2 * n * m)?;
    for segment in 0..segments {
        let [x, y] = turn(segment.into(), segments.into());
        let [out, up] = turn(segment.into(), 2 * u64::from(segments));
        for strip in 0..=strips {
            let across = centred(width, strip, strips);
            let distance = radius + across * out;
            arrays.positions.push([distance * x, distance * y, across * up]);
        }
    }
    let vertex = |segment: u32, strip: u32| {
        if segment < segments { segment * (strips + 1) + strip } else { strips - strip }
    };
    for i in 0..segments {
        for j in 0..strips {
            arrays.quad([vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)]);
        }
    }
    arrays.into_mesh()
}

#[cfg(test)]
mod tests {
    use super::super::measure::{area, edges, euler_characteristic};
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn strip_has_one_boundary_and_no_orientation() {
        for (n, m) in [(3, 1), (4, 1), (12, 3)] {
            let mesh = mobius_strip(3.0, 1.0, n, m).unwrap();
            assert_eq!(mesh.positions().len() as u32, n * (m + 1));
            assert_eq!(mesh.faces().len() as u32, 2 * n * m);
            let (_, boundary, consistent) = edges(&mesh);
            assert_eq!((boundary as u32, consistent, euler_characteristic(&mesh)), (2 * n, false, 0));
        }
        // A narrow strip has nearly the area of the band it is twisted from.
        let narrow = mobius_strip(3.0, 0.01, 500, 2).unwrap();
        assert!((area(&narrow) / (TAU * 3.0 * 0.01) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn unusable_parameters_are_refused() {
        assert!(matches!(
            mobius_strip(1.0, f64::INFINITY, 3, 1),
            Err(ShapeError::Size { what: "width", .. })
        ));
        assert!(matches!(mobius_strip(1.0, 0.1, 2, 1), Err(ShapeError::TooFew { what: "segments", .. })));
    }
}
