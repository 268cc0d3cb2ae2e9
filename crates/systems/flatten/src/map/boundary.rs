//! Boundary positions of a disk.

use crate::FlattenError;
use crate::check::orientation;
use glam::DVec3;
use pompeiu_core::VertexId;
use pompeiu_surface::plane::{Vec2, add, norm, scale, sub};
use pompeiu_surface::{EmbeddedSurface, HalfedgeId, Surface};

/// The convex curve to which the boundary of a disk is mapped.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum ConvexBoundary {
    /// A circle.
    #[default]
    Circle,
    /// A square; its corners are vertices.
    Square,
    /// A convex polygon, given by its corners counter-clockwise.
    Polygon(Vec<Vec2>),
    /// The boundary itself, in its plane.
    Own,
}

/// Largest distance of a planar boundary from its plane, relative to its length.
const PLANAR: f64 = 1e-9;

impl ConvexBoundary {
    /// The positions of the vertices of a boundary loop, in its order, counter-clockwise. Circles and squares enclose the area of
    /// the surface; lengths along the curve are proportional to those of the boundary (chord length).
    ///
    /// The surface is the disk itself, or the disk with a virtual boundary around it, for which [`ConvexBoundary::Own`] is invalid.
    pub(crate) fn places(
        &self,
        disk: &EmbeddedSurface,
        surface: &Surface,
        along: &[HalfedgeId],
    ) -> Result<Vec<Vec2>, FlattenError> {
        let area = surface.area();
        let lengths: Vec<f64> = along.iter().map(|&h| surface.edge_length(surface.mesh().edge(h))).collect();
        match self {
            Self::Circle => Ok(on_circle(&lengths, (area / std::f64::consts::PI).sqrt())),
            Self::Square => on_polygon(&lengths, &SQUARE.map(|corner| scale(area.sqrt(), corner))),
            Self::Polygon(corners) => {
                check_convex(corners)?;
                on_polygon(&lengths, corners)
            }
            Self::Own if surface.mesh().faces() > disk.mesh().faces() => Err(FlattenError::VirtualOwn),
            Self::Own => in_plane(disk, along),
        }
    }
}

/// The half side of a square of unit area.
const HALF: f64 = 0.5;

/// The corners of a square of unit area.
const SQUARE: [Vec2; 4] = [[-HALF, -HALF], [HALF, -HALF], [HALF, HALF], [-HALF, HALF]];

/// The straight sides of a boundary loop: of each, the places in the loop of its first and its last vertex. The last side ends at the
/// first vertex, whose place is then the number of vertices.
pub(crate) fn straight_sides(
    boundary: &ConvexBoundary,
    lengths: &[f64],
) -> Result<Vec<[usize; 2]>, FlattenError> {
    let first = match boundary {
        ConvexBoundary::Circle | ConvexBoundary::Own => return Ok(Vec::new()),
        ConvexBoundary::Square => corner_places(lengths, &SQUARE)?,
        ConvexBoundary::Polygon(corners) => {
            check_convex(corners)?;
            corner_places(lengths, corners)?
        }
    };
    Ok(first.windows(2).map(|ends| [ends[0], ends[1]]).collect())
}

fn on_circle(lengths: &[f64], radius: f64) -> Vec<Vec2> {
    let total: f64 = lengths.iter().sum();
    let mut passed = 0.0;
    let mut places = Vec::with_capacity(lengths.len());
    for length in lengths {
        let angle = std::f64::consts::TAU * (passed / total);
        places.push([radius * libm::cos(angle), radius * libm::sin(angle)]);
        passed += length;
    }
    places
}

fn check_convex(corners: &[Vec2]) -> Result<(), FlattenError> {
    let n = corners.len();
    let finite = corners.iter().flatten().all(|x| x.is_finite());
    let turns = (0..n).all(|i| {
        // All other corners to the left of each side.
        let [a, b] = [corners[i], corners[(i + 1) % n]];
        (0..n).filter(|&k| k != i && k != (i + 1) % n).all(|k| orientation(a, b, corners[k]) > 0.0)
    });
    if n >= 3 && finite && turns { Ok(()) } else { Err(FlattenError::Polygon { corners: n }) }
}

/// The place of the vertex at each corner, the nearest by chord length; at the end the number of vertices.
fn corner_places(lengths: &[f64], corners: &[Vec2]) -> Result<Vec<usize>, FlattenError> {
    let (n, k) = (lengths.len(), corners.len());
    if n < k {
        return Err(FlattenError::FewVertices { boundary: n, corners: k });
    }
    let sides: Vec<f64> = (0..k).map(|i| norm(sub(corners[(i + 1) % k], corners[i]))).collect();
    let perimeter: f64 = sides.iter().sum();
    let at = shares(lengths);
    // As near as possible, leaving enough vertices for the following corners.
    let mut first = vec![0; k + 1];
    let mut passed = 0.0;
    for i in 1..k {
        passed += sides[i - 1] / perimeter;
        let (from, to) = (first[i - 1] + 1, n - (k - i));
        first[i] = (from..=to)
            .min_by(|&a, &b| (at[a] - passed).abs().total_cmp(&(at[b] - passed).abs()))
            .unwrap_or(from);
    }
    first[k] = n;
    Ok(first)
}

/// The share of the length of the loop before each vertex, and 1.
fn shares(lengths: &[f64]) -> Vec<f64> {
    let total: f64 = lengths.iter().sum();
    let mut at = vec![0.0; lengths.len() + 1];
    for (i, length) in lengths.iter().enumerate() {
        at[i + 1] = at[i] + length / total;
    }
    at
}

/// Puts the vertices between those at corners on the sides, by chord length.
fn on_polygon(lengths: &[f64], corners: &[Vec2]) -> Result<Vec<Vec2>, FlattenError> {
    let (first, at) = (corner_places(lengths, corners)?, shares(lengths));
    let k = corners.len();
    let mut places = vec![[0.0; 2]; lengths.len()];
    for i in 0..k {
        let side = sub(corners[(i + 1) % k], corners[i]);
        let span = at[first[i + 1]] - at[first[i]];
        for v in first[i]..first[i + 1] {
            places[v] = add(corners[i], scale((at[v] - at[first[i]]) / span, side));
        }
    }
    Ok(places)
}

fn in_plane(surface: &EmbeddedSurface, along: &[HalfedgeId]) -> Result<Vec<Vec2>, FlattenError> {
    let mesh = surface.mesh();
    let points: Vec<DVec3> =
        along.iter().map(|&h| DVec3::from_array(surface.positions()[mesh.tail(h)])).collect();
    let n = points.len();
    let mut normal = DVec3::ZERO;
    for i in 0..n {
        normal += (points[i] - points[0]).cross(points[(i + 1) % n] - points[0]);
    }
    let length = normal.length();
    let perimeter: f64 = along.iter().map(|&h| surface.surface().edge_length(mesh.edge(h))).sum();
    let unit = normal / length;
    let heights = points.iter().map(|&p| unit.dot(p - points[0]).abs());
    let height = heights.fold(0.0, |most: f64, h| if h <= most { most } else { h });
    if length.is_nan() || height.is_nan() || height > PLANAR * perimeter {
        let vertex = along.first().map_or(VertexId(0), |&h| mesh.tail(h));
        return Err(FlattenError::NotPlanar { vertex, height, most: PLANAR * perimeter });
    }
    // The axis farthest from the normal completes a right-handed frame: x and y if the plane is theirs.
    let axis = (0..3).fold(0, |least, k| if unit[k].abs() < unit[least].abs() { k } else { least });
    let first = DVec3::AXES[axis];
    let first = first - first.dot(unit) * unit;
    let first = first / first.length();
    let second = unit.cross(first);
    Ok(points.into_iter().map(|p| [first.dot(p), second.dot(p)]).collect())
}
