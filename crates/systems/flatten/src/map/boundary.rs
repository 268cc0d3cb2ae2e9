//! Boundary positions of a disk.

use crate::check::orientation;
use crate::{CutError, FlattenError, SymmetryError};
use glam::DVec3;
use pompeiu_core::VertexId;
use pompeiu_surface::plane::{Vec2, add, dot, norm, scale, sub};
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
    /// With a mirror image of the loop, they are those of a square or polygon with an axis of symmetry.
    pub(crate) fn places(
        &self,
        disk: &EmbeddedSurface,
        surface: &Surface,
        along: &[HalfedgeId],
        mirror: Option<LoopMirror>,
    ) -> Result<Vec<Vec2>, FlattenError> {
        let area = surface.area();
        let lengths: Vec<f64> = along.iter().map(|&h| surface.edge_length(surface.mesh().edge(h))).collect();
        match self {
            Self::Circle => Ok(on_circle(&lengths, (area / std::f64::consts::PI).sqrt())),
            Self::Square => on_polygon(&lengths, &SQUARE.map(|corner| scale(area.sqrt(), corner)), mirror),
            Self::Polygon(corners) => on_polygon(&lengths, corners, mirror),
            Self::Own if surface.mesh().faces() > disk.mesh().faces() => Err(FlattenError::VirtualOwn),
            Self::Own => in_plane(disk, along),
        }
    }
}

/// The half side of a square of unit area.
const HALF: f64 = 0.5;

/// The corners of a square of unit area.
const SQUARE: [Vec2; 4] = [[-HALF, -HALF], [HALF, -HALF], [HALF, HALF], [-HALF, HALF]];

/// The straight sides of a boundary loop: of each, the places in the loop of its first and its last vertex.
pub(crate) fn straight_sides(
    boundary: &ConvexBoundary,
    lengths: &[f64],
    mirror: Option<LoopMirror>,
) -> Result<Vec<[usize; 2]>, FlattenError> {
    let at = match boundary {
        ConvexBoundary::Circle | ConvexBoundary::Own => return Ok(Vec::new()),
        ConvexBoundary::Square => corner_places(lengths, &SQUARE, mirror)?.0,
        ConvexBoundary::Polygon(corners) => corner_places(lengths, corners, mirror)?.0,
    };
    Ok((0..at.len()).map(|i| [at[i], at[(i + 1) % at.len()]]).collect())
}

/// The mirror image of a boundary loop: that of its vertex i is its vertex k − i, both modulo their number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoopMirror(usize);

impl LoopMirror {
    /// The mirror image of the loop of a disk, given those of its vertices.
    pub(crate) fn new(along: &[VertexId], partners: &[u32]) -> Option<Self> {
        let first = partners.get(along.first()?.index())?;
        along.iter().position(|v| v.0 == *first).map(Self)
    }
}

/// An axis of symmetry of a polygon: a point on it, and its unit direction.
pub(crate) type Axis = [Vec2; 2];

impl ConvexBoundary {
    /// The axis of symmetry about which the places of a loop with a mirror image are symmetric; none for curves without corners.
    pub(crate) fn axis(&self, lengths: &[f64], mirror: LoopMirror) -> Result<Option<Axis>, FlattenError> {
        let corners = match self {
            Self::Circle | Self::Own => return Ok(None),
            Self::Square => &SQUARE[..],
            Self::Polygon(corners) => corners,
        };
        Ok(corner_places(lengths, corners, Some(mirror))?.1)
    }
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

/// The place of the vertex at each corner, the nearest by chord length; and the axis of symmetry, if the loop has a mirror image.
fn corner_places(
    lengths: &[f64],
    corners: &[Vec2],
    mirror: Option<LoopMirror>,
) -> Result<(Vec<usize>, Option<Axis>), FlattenError> {
    check_convex(corners)?;
    let (n, k) = (lengths.len(), corners.len());
    if n < k {
        return Err(FlattenError::FewVertices { boundary: n, corners: k });
    }
    let sides: Vec<f64> = (0..k).map(|i| norm(sub(corners[(i + 1) % k], corners[i]))).collect();
    let at = shares(lengths);
    if let Some(LoopMirror(image)) = mirror {
        return mirrored_places(&at, corners, &sides, image);
    }
    let perimeter: f64 = sides.iter().sum();
    let mut passed = 0.0;
    let mut wanted = vec![0.0; k];
    for i in 1..k {
        passed += sides[i - 1] / perimeter;
        wanted[i] = passed;
    }
    Ok((nearest(&at, &wanted[1..], [1, n]).map_or_else(Vec::new, |rest| [vec![0], rest].concat()), None))
}

/// For each share of a length the place nearest to it, increasing, within a range; none if the range has too few.
fn nearest(at: &[f64], wanted: &[f64], [mut from, to]: [usize; 2]) -> Option<Vec<usize>> {
    let mut places = Vec::with_capacity(wanted.len());
    for (i, share) in wanted.iter().enumerate() {
        // As near as possible, leaving enough vertices for the following corners.
        let end = (to + i + 1).checked_sub(wanted.len())?;
        let near = (from..end).min_by(|&a, &b| (at[a] - share).abs().total_cmp(&(at[b] - share).abs()))?;
        places.push(near);
        from = near + 1;
    }
    Some(places)
}

/// Relative tolerance of an axis of symmetry of a polygon.
const AXIS: f64 = 1e-9;

/// The places of the corners of a polygon with an axis of symmetry, so that the mirror image of a corner's vertex is that of the corner's
/// mirror image.
fn mirrored_places(
    at: &[f64],
    corners: &[Vec2],
    sides: &[f64],
    image: usize,
) -> Result<(Vec<usize>, Option<Axis>), FlattenError> {
    let (n, k) = (at.len() - 1, corners.len());
    let axes: Vec<(usize, Axis)> = (0..k).filter_map(|m| Some((m, axis(corners, m)?))).collect();
    if axes.is_empty() {
        return Err(CutError::from(SymmetryError::Boundary).into());
    }
    // The loop meets the plane of symmetry in two vertices.
    let Some(start) = (0..n).find(|&i| (2 * i) % n == image).filter(|_| n.is_multiple_of(2)) else {
        return Err(CutError::from(SymmetryError::Boundary).into());
    };
    let half = n / 2;
    let along: Vec<f64> = (0..=half).map(|r| share_between(at, start, r)).collect();
    let perimeter: f64 = sides.iter().sum();
    // Axes between corners first: with them squares stand on a side, and the first of theirs is vertical.
    let by_kind = axes.iter().filter(|(m, _)| m % 2 == 1).chain(axes.iter().filter(|(m, _)| m % 2 == 0));
    for &(m, axis) in by_kind {
        // Corners from the axis on, counter-clockwise, up to where it leaves the polygon.
        let begin = m.div_ceil(2);
        let on_start = m % 2 == 0;
        let count = if on_start { k / 2 + 1 } else { k.div_ceil(2) };
        let on_end = if on_start { k % 2 == 0 } else { k % 2 == 1 };
        let mut passed = if on_start { 0.0 } else { 0.5 * sides[(begin + k - 1) % k] };
        let mut wanted = Vec::with_capacity(count);
        for j in 0..count {
            wanted.push(passed / perimeter);
            passed += sides[(begin + j) % k];
        }
        let inner = &wanted[usize::from(on_start)..count - usize::from(on_end)];
        let Some(mut places) = nearest(&along, inner, [1, half]) else { continue };
        if on_start {
            places.insert(0, 0);
        }
        if on_end {
            places.push(half);
        }
        let mut all = vec![0; k];
        for (j, r) in places.into_iter().enumerate() {
            all[(begin + j) % k] = (start + r) % n;
            all[(m + 2 * k - begin - j) % k] = (start + n - r) % n;
        }
        return Ok((all, Some(axis)));
    }
    Err(FlattenError::FewVertices { boundary: n, corners: k })
}

/// The axis of the reflection that takes each corner i of a polygon to its corner m − i, if it is symmetric about that.
fn axis(corners: &[Vec2], m: usize) -> Option<Axis> {
    let k = corners.len();
    let image = |i: usize| corners[(m + k - i) % k];
    let farthest = (0..k).max_by(|&i, &j| {
        let across = |i: usize| norm(sub(image(i), corners[i]));
        across(i).total_cmp(&across(j))
    })?;
    let across = sub(image(farthest), corners[farthest]);
    let size = norm(across);
    let normal = scale(1.0 / size, across);
    let point = scale(0.5, add(corners[farthest], image(farthest)));
    let fits = |i: usize| {
        let height = dot(sub(corners[i], point), normal);
        norm(sub(sub(corners[i], scale(2.0 * height, normal)), image(i))) <= AXIS * size
    };
    (0..k).all(fits).then_some([point, [-normal[1], normal[0]]])
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

/// The share of the loop between a place and so many places after it, round the end of the loop.
fn share_between(at: &[f64], from: usize, count: usize) -> f64 {
    let (n, to) = (at.len() - 1, from + count);
    if to < n { at[to] - at[from] } else { at[to - n] + 1.0 - at[from] }
}

/// Puts the vertices between those at corners on the sides, by chord length.
fn on_polygon(
    lengths: &[f64],
    corners: &[Vec2],
    mirror: Option<LoopMirror>,
) -> Result<Vec<Vec2>, FlattenError> {
    let (first, at) = (corner_places(lengths, corners, mirror)?.0, shares(lengths));
    let (n, k) = (lengths.len(), corners.len());
    let mut places = vec![[0.0; 2]; n];
    for i in 0..k {
        let side = sub(corners[(i + 1) % k], corners[i]);
        let count = (first[(i + 1) % k] + n - first[i]) % n;
        let passed = |r: usize| share_between(&at, first[i], r);
        let span = passed(count);
        for r in 0..count {
            places[(first[i] + r) % n] = add(corners[i], scale(passed(r) / span, side));
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
