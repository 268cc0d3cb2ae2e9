//! Cylinders, and the Schwarz lantern.

use super::ShapeError;
use super::arrays::{Arrays, centred, count, length, turn};
use crate::mesh::TriMesh;

/// Whether the ends of a cylinder or the base of a cone are closed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ends {
    /// No end faces: there is a boundary.
    #[default]
    Open,
    /// Flat polygons around a centre vertex: there is no boundary.
    Capped,
}

/// Cylinder: a prism over a regular polygon.
///
/// # Shapes and units
/// `segments ≥ 3` around, `rows ≥ 1` along the height: `segments·(rows+1)` vertices and `2·segments·rows` faces, and
/// with caps 2 vertices and `2·segments` faces more. The wall has the area `2·n·sin(π/n)·r·h`, a cap `(n/2)·sin(2π/n)·r²`.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn cylinder(
    radius: f64,
    height: f64,
    segments: u32,
    rows: u32,
    ends: Ends,
) -> Result<TriMesh, ShapeError> {
    let (n, m) = (count("segments", segments, 3)?, count("rows", rows, 1)?);
    let caps = u128::from(ends == Ends::Capped);
    let mut arrays = Arrays::with_capacity(n * (m + 1) + 2 * caps, 2 * n * (m + caps))?;
    wall(&mut arrays, [radius, height], segments, rows, |_| 0)?;
    let vertex = |row: u32, segment: u32| row * segments + segment % segments;
    for row in 0..rows {
        for s in 0..segments {
            arrays.quad([vertex(row, s), vertex(row, s + 1), vertex(row + 1, s + 1), vertex(row + 1, s)]);
        }
    }
    if ends == Ends::Capped {
        let bottom = arrays.positions.len() as u32;
        arrays.positions.extend([[0.0, 0.0, -height / 2.0], [0.0, 0.0, height / 2.0]]);
        for s in 0..segments {
            arrays.faces.push([bottom, vertex(0, s + 1), vertex(0, s)]);
            arrays.faces.push([bottom + 1, vertex(rows, s), vertex(rows, s + 1)]);
        }
    }
    arrays.into_mesh()
}

/// Schwarz lantern: isosceles triangles whose corners lie on a cylinder, every other circle turned by half a step.
///
/// Its distance to the cylinder tends to zero as both counts grow, but its area need not converge: with `bands` growing faster than
/// `segments²` it is unbounded.
///
/// # Shapes and units
/// `segments = n ≥ 3` around, `bands = m ≥ 1` along the height: `n(m+1)` vertices, `2nm` faces, area
/// `2·n·m·r·sin(π/n)·√((h/m)² + r²(1 − cos(π/n))²)`.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
/// # Source
/// `schwarz_aire_1890`; the construction is common knowledge.
pub fn schwarz_lantern(radius: f64, height: f64, segments: u32, bands: u32) -> Result<TriMesh, ShapeError> {
    let (n, m) = (count("segments", segments, 3)?, count("bands", bands, 1)?);
    let mut arrays = Arrays::with_capacity(n * (m + 1), 2 * n * m)?;
    wall(&mut arrays, [radius, height], segments, bands, |row| u64::from(row % 2))?;
    arrays.staggered(segments, bands);
    arrays.into_mesh()
}

/// Circles of vertices from bottom to top, each turned by this many half steps.
fn wall(
    arrays: &mut Arrays,
    [radius, height]: [f64; 2],
    segments: u32,
    rows: u32,
    half_steps: impl Fn(u32) -> u64,
) -> Result<(), ShapeError> {
    length("radius", radius)?;
    length("height", height)?;
    for row in 0..=rows {
        for segment in 0..segments {
            let [x, y] = turn(2 * u64::from(segment) + half_steps(row), 2 * u64::from(segments));
            arrays.positions.push([radius * x, radius * y, centred(height, row, rows)]);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::measure::{area, assert_close, assert_solid, edges, euler_characteristic, volume};
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn open_cylinder_has_its_counts_and_two_boundary_circles() {
        for (n, m) in [(3, 1), (6, 4), (50, 7)] {
            let mesh = cylinder(2.0, 3.0, n, m, Ends::Open).unwrap();
            assert_eq!(mesh.positions().len() as u32, n * (m + 1));
            assert_eq!(mesh.faces().len() as u32, 2 * n * m);
            assert_close(area(&mesh), 2.0 * f64::from(n) * (PI / f64::from(n)).sin() * 6.0);
            assert_eq!(
                (edges(&mesh).1 as u32, edges(&mesh).2, euler_characteristic(&mesh)),
                (2 * n, true, 0)
            );
        }
    }

    #[test]
    fn capped_cylinder_is_a_prism() {
        for (n, m) in [(3, 1), (6, 4)] {
            let mesh = cylinder(2.0, 3.0, n, m, Ends::Capped).unwrap();
            let base = 2.0 * f64::from(n) * (2.0 * PI / f64::from(n)).sin();
            assert_solid(&mesh, base * 3.0);
            assert_eq!(euler_characteristic(&mesh), 2);
        }
    }

    #[test]
    fn lantern_lies_on_the_cylinder_and_follows_the_area_formula() {
        for (n, m) in [(3_u32, 1_u32), (3, 2), (8, 5), (10, 1000)] {
            let mesh = schwarz_lantern(2.0, 3.0, n, m).unwrap();
            assert_eq!(mesh.positions().len() as u32, n * (m + 1));
            assert_eq!(mesh.faces().len() as u32, 2 * n * m);
            assert!(mesh.positions().iter().all(|p| (p[0].hypot(p[1]) - 2.0).abs() < 1e-15));
            let (step, count) = (PI / f64::from(n), f64::from(n * m));
            let slant = (3.0 / f64::from(m)).hypot(2.0 * (1.0 - step.cos()));
            assert_close(area(&mesh) / count, 4.0 * step.sin() * slant);
            assert_eq!(
                (edges(&mesh).1 as u32, edges(&mesh).2, euler_characteristic(&mesh)),
                (2 * n, true, 0)
            );
            assert!(volume(&mesh) > 0.0, "the faces point inwards");
        }
    }

    #[test]
    fn unusable_parameters_are_refused() {
        assert!(matches!(
            cylinder(1.0, f64::NAN, 3, 1, Ends::Open),
            Err(ShapeError::Size { what: "height", .. })
        ));
        assert!(matches!(schwarz_lantern(0.0, 1.0, 3, 1), Err(ShapeError::Size { what: "radius", .. })));
        assert!(matches!(schwarz_lantern(1.0, 1.0, 2, 1), Err(ShapeError::TooFew { what: "segments", .. })));
        assert!(matches!(cylinder(1.0, 1.0, u32::MAX, 1, Ends::Open), Err(ShapeError::TooMany { .. })));
    }
}
