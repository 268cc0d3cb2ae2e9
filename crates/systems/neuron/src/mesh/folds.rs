//! Where branches turn too sharply to be one tube: they are divided there, so that the samples are nodes.

use super::path::{ROOM, deviation, half_tangent, is_alone, is_beyond_mitres, relax, thinned};
use glam::DVec3;

/// Distance of the axis from the samples beyond which a branch is divided rather than moved, over the radius.
const MOST_MOVED: f64 = 0.2;

/// Least length of the two segments at a sample at which a branch is divided, in radii.
const DIVIDED_ROOM: f64 = 1.0;

/// The samples at which a branch is divided, so that they are nodes: where it turns too sharply for a mitre, or for one that
/// has no room to share the turn, though it is long on both sides, and where its mitre has no room beside that of another turn, or beside a tip.
fn folds(points: &[(DVec3, f64)], are_tips: [bool; 2]) -> Vec<usize> {
    let mut relaxed = points.to_vec();
    relax(&mut relaxed);
    let is_moved = deviation(&relaxed, points) > MOST_MOVED;
    let corner = |triple: &[usize]| {
        let [a, b, c] = [points[triple[0]], points[triple[1]], points[triple[2]]];
        let (before, after) = (b.0 - a.0, c.0 - b.0);
        let cosine = before.normalize_or_zero().dot(after.normalize_or_zero());
        let room = before.length().min(after.length()) / b.1;
        let is_fold = (is_beyond_mitres(cosine) || is_alone(cosine, room)) && room >= DIVIDED_ROOM;
        Corner {
            at: triple[1],
            is_fold,
            is_sharp: cosine < libm::cos(HOOK_FROM.to_radians()),
            reach: b.1 * half_tangent(cosine),
        }
    };
    let mut corners: Vec<Corner> = thinned(points).windows(3).map(corner).collect();
    let ends = [0, points.len() - 1].into_iter().zip(are_tips).filter(|(_, is_tip)| *is_tip);
    corners.extend(ends.map(|(at, _)| Corner { at, is_fold: false, is_sharp: false, reach: 0.0 }));
    corners.sort_unstable_by_key(|corner| corner.at);
    let is_fold = |corner: &&Corner| is_moved && corner.is_fold;
    let mut found: Vec<usize> = corners.iter().filter(is_fold).map(|corner| corner.at).collect();
    let is_end = |corner: &Corner| corner.at == 0 || corner.at + 1 == points.len();
    for pair in corners.windows(2) {
        let [a, b] = [&pair[0], &pair[1]];
        // A hook at a tip is within the tolerance, but no section is between.
        let is_hook = (is_end(a) && b.is_sharp) || (is_end(b) && a.is_sharp);
        let has_room = a.reach + b.reach <= ROOM * points[a.at].0.distance(points[b.at].0);
        let is_divided = found.contains(&a.at) || found.contains(&b.at);
        if !has_room && !is_divided && (is_moved || is_hook) {
            found.push(if a.reach >= b.reach { a.at } else { b.at });
        }
    }
    found.retain(|at| *at > 0 && at + 1 < points.len());
    found.sort_unstable();
    found
}

/// Whether branches are divided at their folds.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Division {
    AtFolds,
    None,
}

/// A sample at which a branch turns, or a tip.
struct Corner {
    at: usize,
    /// Whether the turn is too sharp for its mitre, and long on both sides.
    is_fold: bool,
    is_sharp: bool,
    /// The length that its mitre takes on each side.
    reach: f64,
}

/// Turn, in degrees, from which on a tip without room for the mitre before it is a hook.
const HOOK_FROM: f64 = 42.0;

/// A path and its balls.
pub(super) type Part = (Vec<usize>, Vec<(DVec3, f64)>);

/// The parts of a path between its folds, without balls at the place of the one before.
pub(super) fn divided(
    path: &[usize],
    balls: &[(DVec3, f64)],
    (division, are_tips): (Division, [bool; 2]),
) -> Vec<Part> {
    let mut kept: Vec<usize> = (0..path.len()).collect();
    kept.dedup_by(|b, a| balls[*a].0 == balls[*b].0);
    let points: Vec<(DVec3, f64)> = kept.iter().map(|k| balls[*k]).collect();
    if points.len() < 2 {
        return vec![(path.to_vec(), vec![points[0]; 2])];
    }
    let mut ends = vec![0];
    if division == Division::AtFolds {
        ends.extend(folds(&points, are_tips));
    }
    ends.push(points.len() - 1);
    let part = |pair: &[usize]| {
        let [a, b] = [pair[0], pair[1]];
        let last = if b + 1 == points.len() { path.len() - 1 } else { kept[b] };
        (path[kept[a]..=last].to_vec(), points[a..=b].to_vec())
    };
    ends.windows(2).map(part).collect()
}
