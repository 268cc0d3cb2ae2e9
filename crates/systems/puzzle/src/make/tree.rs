//! Tabs on the fewest borders that hold a puzzle together.

use super::Tab;
use super::tabs::{half_foot, profile};
use crate::Puzzle;
use crate::lock::{holds, lock_until};
use crate::space::{Corner, Space};
use pompeiu_core::run::Control;
use pompeiu_planar::Point;

/// Heights of tabs, relative to the mean side of a piece, in the order in which they are tried.
const HEIGHTS: [f64; 6] = [0.085, 0.11, 0.07, 0.15, 0.2, 0.055];

/// Half the width of the foot, relative to the height, and that of the head, relative to the foot.
const FOOT: [f64; 2] = [0.33, 0.42];
const HEAD: [f64; 2] = [1.45, 1.5];

/// Distance of candidate positions along a border, relative to the mean side of a piece.
const SPACING: f64 = 0.08;

/// A border that locks without details of this size, relative to the mean side of a piece, needs no tab.
const DEPTH: f64 = 0.02;

/// Sample points across and along a tab, for the area it covers.
const ACROSS: usize = 5;

/// A candidate position of a tab.
struct Candidate {
    border: usize,
    along: f64,
    side: f64,
    gain: f64,
}

/// Adds tabs until no piece can move: a spanning tree of clusters, with each tab where it costs least of the desired shapes of the
/// two pieces.
///
/// `is_in` tells whether a point, in the unit of the outline, lies in the desired shape of a piece.
///
/// Once the control stops, no further tab is added. A tab is used only if it alone holds its two pieces together, decided in integers,
/// and leaves no neck below a width in steps: the first of `necks`, and where clusters are left the next ones. If none does, the border stays
/// unchanged.
pub(crate) fn lock_by_tabs(
    puzzle: &mut Puzzle,
    (tab, necks): (Tab, &[f64]),
    control: &Control,
    is_in: &(dyn Fn(usize, Point) -> bool + Sync),
) {
    if tab == Tab::None {
        return;
    }
    let unit = puzzle.unit() / puzzle.step;
    let mut clusters = lock_until(&puzzle.simplified(DEPTH * puzzle.unit()), control).clusters;
    let mut space = Space::new(puzzle.courses(), unit);
    let mut is_tabbed = vec![false; puzzle.borders.len()];
    for (neck, height) in necks.iter().flat_map(|neck| HEIGHTS.map(|height| (*neck, height * unit))) {
        if control.is_stopped() {
            return;
        }
        let mut candidates = candidates(puzzle, &clusters, &is_tabbed, tab, [height, neck], is_in);
        candidates.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        for Candidate { border, along, side, .. } in candidates {
            if control.is_stopped() {
                return;
            }
            let of = &puzzle.borders[border];
            let Some(right) = of.right else { continue };
            let [a, b] = [clusters[of.left], clusters[right]];
            if a == b || is_tabbed[border] {
                continue;
            }
            let old = of.corners.clone();
            let Some((path, _)) = with_tab(&old, tab, along, side, [height, neck]) else { continue };
            if space.is_free(border, &path) && holds(&path) && puzzle.has_room(border, &path, neck) {
                space.replace(border, &old, &path);
                puzzle.borders[border].corners = path;
                is_tabbed[border] = true;
                clusters.iter_mut().filter(|c| **c == b).for_each(|c| *c = a);
            }
        }
        if clusters.iter().all(|c| *c == clusters[0]) {
            break;
        }
    }
}

fn candidates(
    puzzle: &Puzzle,
    clusters: &[usize],
    is_tabbed: &[bool],
    tab: Tab,
    [height, neck]: [f64; 2],
    is_in: &(dyn Fn(usize, Point) -> bool + Sync),
) -> Vec<Candidate> {
    let mut found = Vec::new();
    for (border, of) in puzzle.borders.iter().enumerate() {
        let Some(right) = of.right else { continue };
        if clusters[of.left] == clusters[right] || is_tabbed[border] {
            continue;
        }
        let length = length(&of.corners);
        let count = (length / (SPACING * puzzle.unit() / puzzle.step)).ceil().max(2.0) as usize;
        for i in 1..count {
            let along = length * i as f64 / count as f64;
            for side in [1.0, -1.0] {
                let Some((_, covered)) = with_tab(&of.corners, tab, along, side, [height, neck]) else {
                    continue;
                };
                // With side 1 the tab extends to the left.
                let (from, to) = if side > 0.0 { (of.left, right) } else { (right, of.left) };
                let points = covered.len() as f64;
                let share = |piece: usize| {
                    covered.iter().filter(|p| is_in(piece, p.map(|x| x * puzzle.step))).count() as f64
                        / points
                };
                found.push(Candidate { border, along, side, gain: share(to) - share(from) });
            }
        }
    }
    found
}

/// A border with a tab at a given arc length, and points that the tab covers. `None` if the border is too short.
fn with_tab(
    corners: &[Corner],
    tab: Tab,
    along: f64,
    side: f64,
    [height, neck]: [f64; 2],
) -> Option<(Vec<Corner>, Vec<Point>)> {
    let kind = usize::from(tab == Tab::Dovetail);
    let foot = (FOOT[kind] * height).max(half_foot(tab, neck));
    let head = HEAD[kind] * foot;
    let (first, a) = at(corners, along - foot)?;
    let (last, b) = at(corners, along + foot)?;
    let u = [b[0] - a[0], b[1] - a[1]];
    let chord = libm::hypot(u[0], u[1]);
    // A border that turns back here has no room for a neck.
    if chord < 1.4 * foot {
        return None;
    }
    let along = u.map(|x| x / chord);
    let across = [-along[1] * side, along[0] * side];
    let middle = [0, 1].map(|k| 0.5 * (a[k] + b[k]));
    let place = |[x, y]: Point| [0, 1].map(|k| middle[k] + along[k] * x + across[k] * y);
    let shape = profile(tab, 0.5 * chord, head * 0.5 * chord / foot, height)?;
    let mut path = corners[..=first].to_vec();
    path.extend(shape.iter().map(|p| place(*p).map(|x| x.round() as i64)));
    path.extend(&corners[last + 1..]);
    path.dedup();
    let grid = |i: usize| (i as f64 + 0.5) / ACROSS as f64;
    let covered = (0..ACROSS * ACROSS).map(|i| {
        let (s, t) = (grid(i % ACROSS), grid(i / ACROSS));
        place([(2.0 * s - 1.0) * head, t * height])
    });
    Some((path, covered.collect()))
}

/// The point at a given arc length of a border, and the corner before it. `None` beyond its ends.
fn at(corners: &[Corner], along: f64) -> Option<(usize, Point)> {
    if along <= 0.0 {
        return None;
    }
    let mut left = along;
    for i in 0..corners.len() - 1 {
        let u = [0, 1].map(|k| (corners[i + 1][k] - corners[i][k]) as f64);
        let length = libm::hypot(u[0], u[1]);
        if left < length {
            return Some((i, [0, 1].map(|k| corners[i][k] as f64 + left / length * u[k])));
        }
        left -= length;
    }
    None
}

fn length(corners: &[Corner]) -> f64 {
    let side = |pair: &[Corner]| {
        let [x, y] = [0, 1].map(|k| (pair[1][k] - pair[0][k]) as f64);
        libm::hypot(x, y)
    };
    corners.windows(2).map(side).sum()
}
