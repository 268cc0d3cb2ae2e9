//! Whether triangles lie within a distance of other triangles: tests on a few faces at a time.
//!
//! The distance from a convex set is a convex function. A triangle whose three corners are within `D` of one and the same triangle
//! lies within `D` of it as a whole. Where no single triangle serves, the tested one is cut along a side plane of the prism
//! over the triangle nearest to its centroid: inside the prism that triangle is nearest, and coplanar faces need no further cut.
//! The tests steer the simplification; the proof for the whole result is that of [`pompeiu_hausdorff`].

use super::candidates::Candidates;
use super::triangle::Triangle;
use glam::DVec3;
use pompeiu_core::spatial::bvh::{Bvh, Cover, Nearest, Slot, Workspace};

/// Pieces that one test of a face of the input looks at, at most; a test that needs more fails.
const MOST_PIECES: usize = 256;

/// A cut leaves at least this share of a piece's size on both sides.
const LEAST_CUT: f64 = 1e-6;

fn centroid([a, b, c]: &Triangle) -> DVec3 {
    (*a + *b + *c) / 3.0
}

fn greater(x: f64, y: f64) -> f64 {
    if x > y { x } else { y }
}

/// What is known of a piece.
enum Verdict {
    /// All of it is near enough.
    Near,
    /// Some point of it is too far away.
    Far,
    /// Neither; the triangle nearest to its centroid.
    Open(Triangle),
}

/// Looks at a triangle, and at its parts where it must be cut, until all are near, one is far, or there are too many.
fn all_near(triangle: Triangle, most_pieces: usize, mut look: impl FnMut(&Triangle) -> Verdict) -> bool {
    let mut open = vec![triangle];
    for _ in 0..most_pieces {
        let Some(piece) = open.pop() else { return true };
        match look(&piece) {
            Verdict::Near => {}
            Verdict::Far => return false,
            Verdict::Open(nearest) => cut(&piece, &nearest, &mut open),
        }
    }
    false
}

/// Cuts a piece along the side plane of the prism over a triangle that leaves most on its lesser side, or else through the
/// middle of its longest edge.
fn cut(piece: &Triangle, over: &Triangle, parts: &mut Vec<Triangle>) {
    let normal = (over[1] - over[0]).cross(over[2] - over[0]);
    let size = greater(
        piece[0].distance_squared(piece[1]),
        greater(piece[1].distance_squared(piece[2]), piece[2].distance_squared(piece[0])),
    )
    .sqrt();
    let mut best: Option<(f64, [f64; 3])> = None;
    for i in 0..3 {
        let (from, to) = (over[i], over[(i + 1) % 3]);
        let Some(outwards) = (to - from).cross(normal).try_normalize() else { continue };
        let heights = piece.map(|p| outwards.dot(p - from));
        let highest = heights.into_iter().fold(f64::NEG_INFINITY, greater);
        let deepest = heights.into_iter().map(|h| -h).fold(f64::NEG_INFINITY, greater);
        let lesser = if highest < deepest { highest } else { deepest };
        if lesser > LEAST_CUT * size && best.is_none_or(|(most, _)| lesser > most) {
            best = Some((lesser, heights));
        }
    }
    match best {
        Some((_, heights)) => cut_at(piece, heights, parts),
        None => bisect(piece, parts),
    }
}

/// Cuts a piece where a linear function, given at the corners, is zero.
fn cut_at(piece: &Triangle, heights: [f64; 3], parts: &mut Vec<Triangle>) {
    // The corner that is alone on its side.
    let above = heights.map(|h| h > 0.0);
    let alone =
        (0..3).find(|&i| above[i] != above[(i + 1) % 3] && above[i] != above[(i + 2) % 3]).unwrap_or(0);
    let [i, j, k] = [alone, (alone + 1) % 3, (alone + 2) % 3];
    let between = |j: usize| piece[i] + (piece[j] - piece[i]) * (heights[i] / (heights[i] - heights[j]));
    let (p, q) = (between(j), between(k));
    let (tip, rest) = ([piece[i], p, q], [p, piece[j], piece[k], q]);
    // What is inside the prism last, so that it is looked at first.
    if above[alone] {
        parts.push(tip);
        quadrangle(rest, parts);
    } else {
        quadrangle(rest, parts);
        parts.push(tip);
    }
}

/// Two triangles, along the shorter diagonal.
fn quadrangle([a, b, c, d]: [DVec3; 4], parts: &mut Vec<Triangle>) {
    if a.distance_squared(c) < d.distance_squared(b) {
        parts.extend([[a, b, c], [a, c, d]]);
    } else {
        parts.extend([[a, b, d], [d, b, c]]);
    }
}

fn bisect(piece: &Triangle, parts: &mut Vec<Triangle>) {
    let length = |i: usize| piece[i].distance_squared(piece[(i + 1) % 3]);
    let i = (1..3).fold(0, |best, i| if length(i) > length(best) { i } else { best });
    let [a, b, c] = [piece[i], piece[(i + 1) % 3], piece[(i + 2) % 3]];
    let middle = 0.5 * (a + b);
    parts.extend([[a, middle, c], [middle, b, c]]);
}

/// The input mesh, to ask whether triangles lie near it.
pub(crate) struct Input<'i> {
    pub(crate) bvh: &'i Bvh,
    /// The square of the distance asked for.
    pub(crate) limit_sq: f64,
}

impl Input<'_> {
    /// Looks whether a point lies within the distance of the input, and says how far it is if not; `start` is a face believed near, and
    /// becomes one that is.
    pub(crate) fn find_near(&self, p: DVec3, start: &mut Slot, workspace: &mut Workspace) -> Result<(), f64> {
        if self.bvh.distance_sq(p.to_array(), *start) <= self.limit_sq {
            return Ok(());
        }
        let found = self.bvh.nearest(p.to_array(), *start, workspace);
        *start = found.slot;
        if found.distance_sq <= self.limit_sq { Ok(()) } else { Err(found.distance_sq) }
    }

    /// Whether a triangle lies within the distance, as [`Input::is_near`], with faces that together are near all of it: each of its pieces
    /// lies near one of them.
    pub(crate) fn is_covered(
        &self,
        triangle: Triangle,
        most_pieces: usize,
        start: &mut Slot,
        workspace: &mut Workspace,
        used: &mut Vec<Slot>,
    ) -> bool {
        all_near(triangle, most_pieces, |piece| {
            let centre = centroid(piece);
            let points = [0, 1, 2].map(|k| [piece[0][k], piece[1][k], piece[2][k], centre[k]]);
            let [x, y, z, distance_sq] = self.bvh.four_distances_sq(&points, *start, workspace);
            if greater(x, greater(y, z)) <= self.limit_sq {
                used.push(*start);
                return Verdict::Near;
            }
            let known = Nearest { slot: *start, distance_sq };
            match self.bvh.cover(&points, self.limit_sq, known, workspace) {
                Cover::By { slot, .. } => {
                    *start = slot;
                    used.push(slot);
                    Verdict::Near
                }
                Cover::Nearest(found) | Cover::Neighbour(found) => {
                    *start = found.slot;
                    if found.distance_sq > self.limit_sq {
                        Verdict::Far
                    } else {
                        Verdict::Open(self.bvh.corners(found.slot).map(DVec3::from_array))
                    }
                }
            }
        })
    }

    /// Whether a triangle lies within the distance of the input, as far as so many pieces can tell; `start` is a face believed near,
    /// and becomes one that is.
    pub(crate) fn is_near(
        &self,
        triangle: Triangle,
        most_pieces: usize,
        start: &mut Slot,
        workspace: &mut Workspace,
    ) -> bool {
        all_near(triangle, most_pieces, |piece| {
            let centre = centroid(piece);
            let points = [0, 1, 2].map(|k| [piece[0][k], piece[1][k], piece[2][k], centre[k]]);
            // The face that served the piece before often serves this one, too.
            let [x, y, z, distance_sq] = self.bvh.four_distances_sq(&points, *start, workspace);
            if greater(x, greater(y, z)) <= self.limit_sq {
                return Verdict::Near;
            }
            let known = Nearest { slot: *start, distance_sq };
            let found = match self.bvh.cover(&points, self.limit_sq, known, workspace) {
                Cover::By { slot, .. } => {
                    *start = slot;
                    return Verdict::Near;
                }
                Cover::Nearest(found) | Cover::Neighbour(found) => found,
            };
            *start = found.slot;
            if found.distance_sq > self.limit_sq {
                return Verdict::Far;
            }
            let radius_sq = piece.iter().map(|p| p.distance_squared(centre)).fold(0.0, greater);
            let reach = found.distance_sq.sqrt() + radius_sq.sqrt();
            if reach * reach <= self.limit_sq {
                Verdict::Near
            } else {
                Verdict::Open(self.bvh.corners(found.slot).map(DVec3::from_array))
            }
        })
    }
}

/// Whether a triangle lies within the distance of the union of some others, as far as some cuts can tell. Marks those that serve, a bit
/// for each.
pub(crate) fn is_covered(triangle: &Triangle, by: &Candidates, limit_sq: f64, used: &mut u64) -> bool {
    all_near(*triangle, MOST_PIECES, |piece| {
        let [x, y, z] = by.near_each(&piece.map(|p| p.to_array()), limit_sq);
        let all = x & y & z;
        if all != 0 {
            *used |= all & all.wrapping_neg();
            return Verdict::Near;
        }
        if x == 0 || y == 0 || z == 0 {
            return Verdict::Far;
        }
        let (distance_sq, nearest) = by.nearest(centroid(piece).to_array());
        if distance_sq <= limit_sq { Verdict::Open(nearest) } else { Verdict::Far }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLAT: Triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];

    fn covered(triangle: &Triangle, by: &[Triangle], limit: f64) -> Option<u64> {
        let (mut candidates, mut used) = (Candidates::default(), 0);
        candidates.set(by.iter().copied());
        is_covered(triangle, &candidates, limit * limit, &mut used).then_some(used)
    }

    #[test]
    fn a_triangle_over_two_others_is_covered_by_both_together() {
        let [a, b, c] = FLAT;
        let middle = 0.5 * (b + c);
        let parts = [[a, b, middle], [a, middle, c]];
        let lifted = FLAT.map(|p| p + 0.1 * DVec3::Z);
        assert_eq!(covered(&lifted, &parts, 0.12), Some(0b11));
        assert_eq!(covered(&lifted, &parts, 0.09), None);
        assert_eq!(covered(&lifted, &parts[..1], 0.12), None);
    }

    #[test]
    fn coplanar_triangles_cover_each_other_within_any_distance() {
        let corner = |i: u32, j: u32| DVec3::new(f64::from(i), f64::from(j), 0.0) / 4.0;
        let mut parts = Vec::new();
        for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
            parts.push([corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)]);
            parts.push([corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)]);
        }
        let across = [DVec3::new(0.05, 0.9, 0.0), DVec3::new(0.1, 0.15, 0.0), DVec3::new(0.97, 0.33, 0.0)];
        assert!(covered(&across, &parts, 1e-12).is_some());
        parts.remove(9);
        assert_eq!(covered(&across, &parts, 1e-12), None);
    }
}
