//! Discs that span the boundary loops one by one: Goldschmidt's surface.

use glam::DVec3;

/// Discs that span two boundary loops one by one, the surface that a film jumps to when it breaks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Discs {
    /// Area of both. Exact for plane loops; for others that of the cones over them, an upper bound of the least area.
    pub area: f64,
    /// Whether both loops are plane.
    pub plane: bool,
    /// Whether the discs have less area than the surface: then it is no global minimum.
    pub less: bool,
}

/// A loop is plane if its points are no farther from a plane than this part of its size.
const PLANE: f64 = 1e-9;

/// The discs over two loops, beside a surface of this area.
pub(crate) fn compare(loops: [&[DVec3]; 2], area: f64) -> Discs {
    let [first, second] = loops.map(disc);
    let all = first.0 + second.0;
    Discs { area: all, plane: first.1 && second.1, less: all < area }
}

/// Area of the disc over a loop, and whether the loop is plane.
fn disc(points: &[DVec3]) -> (f64, bool) {
    let centre = points.iter().sum::<DVec3>() / points.len() as f64;
    let parts: Vec<DVec3> = points
        .iter()
        .zip(points.iter().cycle().skip(1))
        .map(|(p, q)| 0.5 * (*p - centre).cross(*q - centre))
        .collect();
    let vector = parts.iter().sum::<DVec3>();
    let normal = vector.normalize_or_zero();
    let farthest = |of: &dyn Fn(&DVec3) -> f64| points.iter().map(of).fold(0.0, f64::max);
    let size = farthest(&|p| (*p - centre).length());
    let plane = normal != DVec3::ZERO && farthest(&|p| (*p - centre).dot(normal).abs()) <= PLANE * size;
    let area = if plane { vector.length() } else { parts.iter().map(|part| part.length()).sum() };
    (area, plane)
}
