//! Tabs on borders.

use super::Tab;
use crate::Puzzle;
use crate::space::{Corner, Space};
use pompeiu_core::mesh::edit::Random;
use pompeiu_core::run::Control;
use pompeiu_planar::Point;

/// Heights of tabs to try, relative to the mean side of a piece.
const HEIGHTS: [f64; 7] = [0.30, 0.25, 0.20, 0.15, 0.11, 0.08, 0.06];

/// Half the width of the foot of a tab, relative to the height.
const FOOT: f64 = 0.30;

/// Half the width of the head, relative to that of the foot.
const HEAD: f64 = 1.6;

/// What a tab takes of a border on each side of its middle, relative to half the width of its foot.
const ROOM: f64 = 1.1;

/// The width of the neck of a knob, relative to that of its foot.
const KNOB_NECK: f64 = 0.8;

/// Least half width of the head of a knob, relative to that of its neck.
const KNOB_HEAD: f64 = 1.4;

/// Offset of a tab from the middle of its border, relative to the length of the border.
const SHIFTS: [f64; 7] = [0.0, -0.08, 0.08, -0.2, 0.2, -0.3, 0.3];

/// Number of corners of a round head.
const HEAD_CORNERS: usize = 14;

/// Gives every border between two pieces a tab where one fits that leaves no neck below a width in steps, until the control stops.
pub(super) fn add(puzzle: &mut Puzzle, tab: Tab, neck: f64, random: &mut Random, control: &Control) {
    let unit = puzzle.unit() / puzzle.step;
    let mut space = Space::new(puzzle.courses(), unit);
    for border in 0..puzzle.borders.len() {
        if control.is_stopped() {
            break;
        }
        let of = &puzzle.borders[border];
        if of.right.is_none_or(|right| [of.left, right].iter().any(|piece| puzzle.whimsies.contains(piece))) {
            continue;
        }
        let side = if random.below(2) == 0 { 1.0 } else { -1.0 };
        let shift = 0.05 * random.signed_unit();
        // On the longest segment.
        let corners = puzzle.borders[border].corners.clone();
        let length = |i: usize| {
            let [x, y] = [0, 1].map(|k| (corners[i + 1][k] - corners[i][k]) as f64);
            libm::hypot(x, y)
        };
        let at = (0..corners.len() - 1)
            .max_by(|i, j| length(*i).total_cmp(&length(*j)).then(j.cmp(i)))
            .unwrap_or(0);
        let ends = [corners[at], corners[at + 1]];
        let tries =
            HEIGHTS.iter().flat_map(|h| SHIFTS.iter().flat_map(move |s| [1.0, -1.0].map(|d| (*h, *s, d))));
        for (height, place, turn) in tries {
            let Some(path) = shape(tab, ends, [height * unit, neck], 0.5 + shift + place, side * turn) else {
                continue;
            };
            let path = [&corners[..at], &path, &corners[at + 2..]].concat();
            if space.is_free(border, &path) && puzzle.has_room(border, &path, neck) {
                space.replace(border, &corners, &path);
                puzzle.borders[border].corners = path;
                break;
            }
        }
    }
}

/// The border with a tab: from one end to the neck, around the head, to the other end. `None` if the border is too short.
fn shape(
    tab: Tab,
    [a, b]: [Corner; 2],
    [height, neck]: [f64; 2],
    place: f64,
    side: f64,
) -> Option<Vec<Corner>> {
    let u = [b[0] - a[0], b[1] - a[1]].map(|x| x as f64);
    let length = libm::hypot(u[0], u[1]);
    let (along, across) = ([u[0] / length, u[1] / length], [-u[1] / length * side, u[0] / length * side]);
    let foot = (FOOT * height).max(half_foot(tab, neck));
    let middle = place * length;
    if middle - ROOM * foot < 0.0 || middle + ROOM * foot > length {
        return None;
    }
    let at = |[x, y]: Point| [0, 1].map(|k| a[k] + (along[k] * (middle + x) + across[k] * y).round() as i64);
    let mut path = vec![a];
    path.extend(profile(tab, foot, HEAD * foot, height)?.into_iter().map(at));
    path.push(b);
    path.dedup();
    Some(path)
}

/// Half the width of the foot of a tab whose neck has a width, with room for rounding to the lattice.
pub(super) fn half_foot(tab: Tab, neck: f64) -> f64 {
    let share = if tab == Tab::Knob { KNOB_NECK } else { 1.0 };
    0.5 * (neck + 4.0) / share
}

/// A tab from (−foot, 0) to (foot, 0) with this height and half width of the head. `None` for [`Tab::None`].
pub(super) fn profile(tab: Tab, foot: f64, head: f64, height: f64) -> Option<Vec<Point>> {
    let mut path = vec![[-foot, 0.0]];
    match tab {
        Tab::None => return None,
        Tab::Dovetail => path.extend([[-head, height], [head, height]]),
        Tab::Knob => {
            // A circle whose widest part lies above the neck; an ellipse where that would be narrower than the neck.
            let radius = 0.5 * height * 0.85;
            let neck = KNOB_NECK * foot;
            let wide = radius.max(KNOB_HEAD * neck);
            let centre = height - radius;
            let from = libm::asin(neck / wide);
            let sweep = std::f64::consts::TAU - 2.0 * from;
            for i in 0..=HEAD_CORNERS {
                let (sine, cosine) = libm::sincos(from + sweep * i as f64 / HEAD_CORNERS as f64);
                path.push([-wide * sine, centre - radius * cosine]);
            }
        }
    }
    path.push([foot, 0.0]);
    Some(path)
}
