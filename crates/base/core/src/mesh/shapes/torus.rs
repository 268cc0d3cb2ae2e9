//! The torus.

use super::ShapeError;
use super::arrays::{Arrays, count, length, turn};
use crate::mesh::TriMesh;

/// Torus around the z axis; a ring torus if `minor_radius < major_radius`, else it passes through itself.
///
/// # Shapes and units
/// `major_segments ≥ 3` around the axis, `minor_segments ≥ 3` around the tube: as many vertices as the product p·q of
/// the two, twice as many faces, closed. The volume is `p·sin(2π/p)/(2π) · q·sin(2π/q)/(2π)` times that of the smooth
/// ring torus, `2π²Rr²`; the smooth area is `4π²Rr`.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn torus(
    major_radius: f64,
    minor_radius: f64,
    major_segments: u32,
    minor_segments: u32,
) -> Result<TriMesh, ShapeError> {
    length("major radius", major_radius)?;
    length("minor radius", minor_radius)?;
    let (p, q) = (count("major segments", major_segments, 3)?, count("minor segments", minor_segments, 3)?);
    let mut arrays = Arrays::with_capacity(p * q, 2 * p * q)?;
    for i in 0..major_segments {
        let [x, y] = turn(i.into(), major_segments.into());
        for j in 0..minor_segments {
            let [out, up] = turn(j.into(), minor_segments.into());
            let distance = major_radius + minor_radius * out;
            arrays.positions.push([distance * x, distance * y, minor_radius * up]);
        }
    }
    let vertex = |i: u32, j: u32| (i % major_segments) * minor_segments + j % minor_segments;
    for i in 0..major_segments {
        for j in 0..minor_segments {
            arrays.quad([vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)]);
        }
    }
    arrays.into_mesh()
}

#[cfg(test)]
mod tests {
    use super::super::measure::{area, assert_solid, euler_characteristic};
    use super::*;
    use std::f64::consts::{PI, TAU};

    #[test]
    fn torus_has_its_counts_volume_and_genus() {
        for (p, q) in [(3_u32, 3_u32), (5, 8), (40, 17)] {
            let mesh = torus(2.0, 0.5, p, q).unwrap();
            let n = (p * q) as usize;
            assert_eq!((mesh.positions().len(), mesh.faces().len()), (n, 2 * n));
            assert_eq!(euler_characteristic(&mesh), 0);
        }
        let mesh = torus(2.0, 0.5, 300, 300).unwrap();
        assert!((area(&mesh) / (4.0 * PI * PI) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn volume_follows_its_closed_form() {
        // Between two meridians all edges around the axis are parallel, so the quads are planar and the sum is exact.
        for (p, q) in [(3_u32, 3_u32), (6, 8), (40, 17)] {
            let part = |n: u32| f64::from(n) * (TAU / f64::from(n)).sin() / TAU;
            let smooth = 2.0 * PI * PI * 2.0 * 0.25;
            assert_solid(&torus(2.0, 0.5, p, q).unwrap(), smooth * part(p) * part(q));
        }
    }

    #[test]
    fn unusable_parameters_are_refused() {
        assert_eq!(torus(1.0, 0.0, 3, 3), Err(ShapeError::Size { what: "minor radius", value: 0.0 }));
        let error = torus(1.0, 0.1, 3, 2).unwrap_err();
        assert_eq!(error.to_string(), "the number of minor segments must be at least 3, but it is 2");
        assert!(matches!(
            torus(1.0, 0.1, 1 << 17, 1 << 17),
            Err(ShapeError::TooMany { what: "vertices", .. })
        ));
    }
}
