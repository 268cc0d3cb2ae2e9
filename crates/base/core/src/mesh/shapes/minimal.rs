//! Minimal surfaces with known areas.

use super::ShapeError;
use super::arrays::{Arrays, centred, count, length, turn};
use super::planar::{Diagonal, grid};
use crate::mesh::TriMesh;

/// Catenoid around the z axis: circles of radius `c cosh(z/c)`, with `waist` c, for z between `−height/2` and `height/2`; every other
/// circle turned by half a step.
///
/// # Shapes and units
/// `segments ≥ 3` around, `rows ≥ 1` along the height, evenly spaced in z: `segments·(rows+1)` vertices, `2·segments·rows` faces.
/// The smooth surface has the area `π c (h + c sinh(h/c))`.
/// # Errors
/// [`ShapeError::Size`], also for a height at which the radius exceeds doubles; [`ShapeError::TooFew`], [`ShapeError::TooMany`],
/// [`ShapeError::NoMemory`].
pub fn catenoid(waist: f64, height: f64, segments: u32, rows: u32) -> Result<TriMesh, ShapeError> {
    length("waist", waist)?;
    length("height", height)?;
    revolved(segments, rows, |row| {
        let z = centred(height, row, rows);
        [waist * libm::cosh(z / waist), z]
    })
}

/// Surface of revolution around the z axis through profile points `[radius, z]`, one for each circle, every other circle turned by half
/// a step.
///
/// # Errors
/// [`ShapeError::Size`] for a radius that is not a finite number above zero; [`ShapeError::TooFew`], [`ShapeError::TooMany`],
/// [`ShapeError::NoMemory`].
pub fn revolved(segments: u32, rows: u32, profile: impl Fn(u32) -> [f64; 2]) -> Result<TriMesh, ShapeError> {
    let (n, m) = (count("segments", segments, 3)?, count("rows", rows, 1)?);
    let mut arrays = Arrays::with_capacity(n * (m + 1), 2 * n * m)?;
    for row in 0..=rows {
        let [radius, z] = profile(row);
        length("radius of a circle", radius)?;
        for segment in 0..segments {
            let [x, y] = turn(2 * u64::from(segment) + u64::from(row % 2), 2 * u64::from(segments));
            arrays.positions.push([radius * x, radius * y, z]);
        }
    }
    arrays.staggered(segments, rows);
    arrays.into_mesh()
}

/// Two balls joined by a neck, around the z axis, closed: radius `neck + (1 − neck) sin²(π z/2)` for a ball's radius of 1, rounded
/// off at both ends.
///
/// # Shapes and units
/// `radius` of the balls, `neck` as a part of it, above 0 and below 1. The length is 4 radii. `segments ≥ 3` around, `rows ≥ 8`
/// along the axis, with two poles.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn dumbbell(radius: f64, neck: f64, segments: u32, rows: u32) -> Result<TriMesh, ShapeError> {
    length("radius", radius)?;
    length("neck", neck)?;
    if neck >= 1.0 {
        return Err(ShapeError::Size { what: "neck, as a part of the radius", value: neck });
    }
    let (n, m) = (count("segments", segments, 3)?, count("rows", rows, 8)?);
    // Circles between the poles, `rows − 1` of them.
    let circles = rows - 2;
    let mut arrays = Arrays::with_capacity(n * (m - 1) + 2, 2 * n * (m - 1))?;
    for row in 0..=circles {
        // From pole to pole at even angles of two half circles, each around the middle of a ball.
        let t = f64::from(row + 1) / f64::from(rows);
        let z = -2.0 * libm::cos(std::f64::consts::PI * t);
        let ball = libm::sqrt((1.0 - (z.abs() - 1.0) * (z.abs() - 1.0)).max(0.0));
        let s = libm::sin(0.5 * std::f64::consts::PI * z);
        let r = if z.abs() > 1.0 { ball } else { neck + (1.0 - neck) * s * s };
        for segment in 0..segments {
            let [x, y] = turn(2 * u64::from(segment) + u64::from(row % 2), 2 * u64::from(segments));
            arrays.positions.push([radius * r * x, radius * r * y, radius * z]);
        }
    }
    arrays.staggered(segments, circles);
    let bottom = arrays.positions.len() as u32;
    arrays.positions.extend([[0.0, 0.0, -2.0 * radius], [0.0, 0.0, 2.0 * radius]]);
    let last = circles * segments;
    for s in 0..segments {
        let after = (s + 1) % segments;
        arrays.faces.push([bottom, after, s]);
        arrays.faces.push([bottom + 1, last + s, last + after]);
    }
    arrays.into_mesh()
}

/// Helicoid around the z axis: `(r cos t, r sin t, pitch·t/2π)` for r between `−radius` and `radius`.
///
/// # Shapes and units
/// `turns` above 0 of them; `segments ≥ 1` along the axis, `strips ≥ 1` across. With `p = pitch/2π` the smooth surface has the area
/// `2π turns (R √(R² + p²) + p² asinh(R/p))`.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn helicoid(
    radius: f64,
    pitch: f64,
    turns: f64,
    segments: u32,
    strips: u32,
) -> Result<TriMesh, ShapeError> {
    length("radius", radius)?;
    length("pitch", pitch)?;
    length("number of turns", turns)?;
    let (n, m) = (count("segments", segments, 1)?, count("strips", strips, 1)?);
    let mut arrays = Arrays::with_capacity((n + 1) * (m + 1), 2 * n * m)?;
    for i in 0..=segments {
        let share = centred(turns, i, segments);
        let angle = std::f64::consts::TAU * share;
        let (cos, sin) = (libm::cos(angle), libm::sin(angle));
        for j in 0..=strips {
            let r = centred(2.0 * radius, j, strips);
            arrays.positions.push([r * cos, r * sin, pitch * share]);
        }
    }
    let vertex = |i: u32, j: u32| i * (strips + 1) + j;
    for i in 0..segments {
        for j in 0..strips {
            arrays.quad([vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j)]);
        }
    }
    arrays.into_mesh()
}

/// Enneper's surface over the disk of radius `r`: `(u − u³/3 + uv², −v + v³/3 − u²v, u² − v²)`.
///
/// # Shapes and units
/// `segments ≥ 3` around, `rings ≥ 1`. Embedded for `r < √3`, area `π ((1 + r²)³ − 1)/3`.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn enneper(radius: f64, segments: u32, rings: u32) -> Result<TriMesh, ShapeError> {
    let flat = super::disk(radius, segments, rings)?;
    mapped(&flat, |u, v| [u - u * u * u / 3.0 + u * v * v, -v + v * v * v / 3.0 - u * u * v, u * u - v * v])
}

/// Scherk's surface `z = ln(cos y / cos x)` over the square from `−half` to `half`, with `half < π/2`.
///
/// # Shapes and units
/// `cells ≥ 1` along each side, diagonals alternating.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn scherk(half: f64, cells: u32) -> Result<TriMesh, ShapeError> {
    length("half side", half)?;
    if half >= std::f64::consts::FRAC_PI_2 {
        return Err(ShapeError::Size { what: "half side, which must be below π/2,", value: half });
    }
    let flat = grid([2.0 * half; 2], [cells; 2], Diagonal::Alternating)?;
    mapped(&flat, |x, y| [x, y, libm::log(libm::cos(y) / libm::cos(x))])
}

fn mapped(flat: &TriMesh, to: impl Fn(f64, f64) -> [f64; 3]) -> Result<TriMesh, ShapeError> {
    let positions = flat.positions().iter().map(|p| to(p[0], p[1])).collect();
    Ok(TriMesh::new(positions, flat.faces().to_vec())?)
}

#[cfg(test)]
mod tests {
    use super::super::measure::{area, edges};
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn areas_are_those_of_the_smooth_surfaces() {
        let near = |mesh: TriMesh, exact: f64| {
            let found = area(&mesh);
            assert!((found / exact - 1.0).abs() < 2e-3, "{found} {exact}");
        };
        let c: f64 = 0.8;
        near(catenoid(c, 1.0, 96, 48).unwrap(), PI * c * (1.0 + c * (1.0 / c).sinh()));
        let (r, p) = (1.0_f64, 0.5 / std::f64::consts::TAU);
        let half_turn = r * (r * r + p * p).sqrt() + p * p * (r / p).asinh();
        near(helicoid(r, 0.5, 2.0, 200, 40).unwrap(), 2.0 * PI * 2.0 * half_turn);
        near(enneper(1.2, 192, 64).unwrap(), PI * ((1.0 + 1.44_f64).powi(3) - 1.0) / 3.0);
        near(scherk(1.2, 48).unwrap(), 9.949_824_998_708);
    }

    #[test]
    fn a_dumbbell_is_closed_and_narrow_in_the_middle() {
        let mesh = dumbbell(2.0, 0.3, 24, 40).unwrap();
        let (_, boundary, consistent) = edges(&mesh);
        assert_eq!((boundary, consistent), (0, true));
        let radius = |p: &[f64; 3]| p[0].hypot(p[1]);
        let neck = mesh.positions().iter().filter(|p| p[2].abs() < 0.2).map(radius).fold(9.0, f64::min);
        assert!((neck - 0.6).abs() < 0.05, "{neck}");
    }

    #[test]
    fn sizes_beyond_the_shape_are_refused() {
        assert!(matches!(scherk(1.6, 4), Err(ShapeError::Size { .. })));
        assert!(matches!(dumbbell(1.0, 1.5, 8, 8), Err(ShapeError::Size { .. })));
        assert!(matches!(catenoid(1e-3, 10.0, 8, 8), Err(ShapeError::Size { .. })));
        assert!(matches!(helicoid(1.0, 1.0, f64::NAN, 8, 8), Err(ShapeError::Size { .. })));
    }
}
