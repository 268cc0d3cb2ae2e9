//! Corners of a smooth curve: sharp bends between straight sides, which smoothing has rounded.

use super::gates::Gate;
use super::relax::{Frame, Station};
use crate::Point;
use crate::distance::distance_between_segments;
use crate::outline::{cross, distance, dot, minus};
use std::f64::consts::PI;

/// Curvature, per pixel, from which on a bend is sharp.
const SHARP: f64 = 0.045;

/// How many times more sharply than its ends a bend is asked to turn between them in order to be divided, each time, the curvature, per pixel, from
/// which on that ends, and the least length of what is divided, in pixels.
const SHARPER: f64 = 1.5;
const SHARPEST: f64 = 0.4;
const LEAST_DIVIDED: f64 = 2.0;

/// The least turn of a corner, 20°.
const LEAST_TURN: f64 = 0.35;

/// What the steps of pixels add to the length of a bend.
const SLACK: f64 = 2.0;

/// How far from a bend its flanks begin, in pixels.
const FLANK: f64 = 1.0;

/// How much of the bend's turn a flank may turn the same way, and the other way, which it does where a corner has been rounded.
const SAME_WAY: f64 = 0.3;
const OTHER_WAY: f64 = 0.6;

/// The least length on both sides that is extended, in pixels.
const LEAST_EXTENDED: f64 = 1.5;

/// Lengths on both sides of a bend, in pixels.
struct Lengths {
    /// From where the flank begins to where it need not be straight any more.
    flank: f64,
    /// Where stations are taken out.
    clear: f64,
    /// What is extended to where both sides meet.
    extended: f64,
}

impl Lengths {
    /// Where the outline may lie anywhere between two pixels, the steps of a straight side bend it for some pixels.
    const BETWEEN_PIXELS: Self = Self { flank: 6.0, clear: 1.6, extended: 4.0 };

    /// Where crossings are known, a corner changes levels no farther away than the next pixel, and sides of a few pixels are straight.
    const AT_CROSSINGS: Self = Self { flank: 3.0, clear: 0.2, extended: 2.5 };

    /// Those for an outline that may lie `room` pixels to both sides of where it is.
    fn of(room: f64) -> Self {
        if room < KNOWN { Self::AT_CROSSINGS } else { Self::BETWEEN_PIXELS }
    }
}

/// The room, in pixels, below which all crossings are known.
const KNOWN: f64 = 0.25;

/// How far, in pixels, the corner may lie from what was taken out, times the sine of half the angle inside: the width of the gates for blunt
/// corners, less for tips, which may as well be round.
const REACH: [f64; 2] = [0.75, 1.0];

/// How far it may lie from that at most, in pixels: a longer tip is more likely to be the round end of a thin part.
const FARTHEST: f64 = 4.0;

/// How far outside its gate a side may pass beside a corner, in pixels: a corner covers less than half of a pixel whose centre lies in it.
const OUTSIDE: f64 = 0.35;

/// Bends of a curve that may be corners.
pub(super) struct Bends {
    /// The straightest station, so that no bend goes round the end of the list.
    start: usize,
    /// The first and last station of each that is taken out, counted from there.
    spans: Vec<(usize, usize)>,
}

impl Bends {
    /// The bends of a curve that may lie `room` pixels to both sides of where it is.
    pub(super) fn of(stations: &[Station], room: f64) -> Self {
        let frame = Frame::of(stations);
        let by_curvature =
            |i: &usize, j: &usize| frame.curvature(*i).abs().total_cmp(&frame.curvature(*j).abs());
        let start = (0..stations.len()).min_by(by_curvature).unwrap_or(0);
        Self { start, spans: spans(&frame, start, room) }
    }

    /// Whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }

    /// Keeps those for which `is_kept` has true in its place.
    pub(super) fn retain(&mut self, is_kept: &[bool]) {
        let mut is_kept = is_kept.iter();
        self.spans.retain(|_| is_kept.next().copied().unwrap_or(false));
    }
}

/// A corner that was taken out of the curve.
pub(super) struct Corner {
    /// The station before it.
    after: usize,
    /// The stations that were there.
    old: Vec<Station>,
}

/// Takes the stations at bends out of the curve; the stations beside them become free.
pub(super) fn open(stations: &[Station], bends: &Bends) -> (Vec<Station>, Vec<Corner>) {
    let n = stations.len();
    let start = bends.start;
    let mut spans = bends.spans.iter().copied().peekable();
    let mut kept: Vec<Station> = Vec::with_capacity(n);
    let mut corners = Vec::new();
    let (mut k, mut is_after) = (0, false);
    while k < n {
        if let (Some((_, to)), Some(last)) = (spans.next_if(|(from, _)| *from == k), kept.last_mut()) {
            last.is_free = true;
            let old = (k..=to).map(|q| stations[(start + q) % n].clone()).collect();
            corners.push(Corner { after: kept.len() - 1, old });
            is_after = true;
            k = to + 1;
        } else {
            let mut station = stations[(start + k) % n].clone();
            station.is_free |= std::mem::take(&mut is_after);
            kept.push(station);
            k += 1;
        }
    }
    (kept, corners)
}

/// The first and last station of each corner, counted from a start, with those taken out on both sides.
fn spans(frame: &Frame, start: usize, room: f64) -> Vec<(usize, usize)> {
    let n = frame.turns.len();
    let clear = Lengths::of(room).clear;
    let at = |k: usize| (start + k) % n;
    let mut spans: Vec<(usize, usize)> = Vec::new();
    for (mut low, mut high) in bends(frame, (0, n), SHARP, room, &at) {
        let mut length = [0.0; 2];
        while low > 0 && length[0] < clear {
            low -= 1;
            length[0] += frame.lengths[at(low)];
        }
        while high + 1 < n && length[1] < clear {
            length[1] += frame.lengths[at(high)];
            high += 1;
        }
        let is_apart = spans.last().is_none_or(|(_, last)| last + 2 < low);
        if is_apart && low > 1 && high + 2 < n {
            spans.push((low, high));
        }
    }
    spans
}

/// The first and last station of each bend from `first` up to `end` that turns one way more sharply than `sharp` and may be a corner. Two
/// corners only some pixels from each other can become one bend that turns more sharply at both ends; where crossings are known, such a bend
/// is divided.
fn bends(
    frame: &Frame,
    (first, end): (usize, usize),
    sharp: f64,
    room: f64,
    at: &impl Fn(usize) -> usize,
) -> Vec<(usize, usize)> {
    let is_sharp = |k: usize, sign: f64| sign * frame.curvature(at(k)) > sharp;
    let mut found = Vec::new();
    let mut k = first;
    while k < end {
        let sign = frame.curvature(at(k)).signum();
        let from = k;
        while k < end && is_sharp(k, sign) {
            k += 1;
        }
        if k == from {
            k += 1;
            continue;
        }
        let bend = (from, k - 1);
        if is_corner(frame, bend, room, at) {
            found.push(bend);
        } else if room < KNOWN && sharp < SHARPEST {
            let length: f64 = (from..k - 1).map(|k| frame.lengths[at(k)]).sum();
            if length > LEAST_DIVIDED {
                found.extend(bends(frame, (from, k), SHARPER * sharp, room, at));
            }
        }
    }
    found
}

/// Whether a bend is what a corner between straight sides becomes: no longer than smoothing makes it, and its flanks straight.
fn is_corner(frame: &Frame, (from, to): (usize, usize), room: f64, at: impl Fn(usize) -> usize) -> bool {
    let n = frame.turns.len();
    let turn: f64 = (from..=to).map(|k| frame.turns[at(k)]).sum();
    let length: f64 = (from..to).map(|k| frame.lengths[at(k)]).sum();
    if turn.abs() < LEAST_TURN {
        return false;
    }
    // A blunt corner can be rounded by an arc that touches both sides moved outwards by the room and passes through their corner moved inwards
    // by it. Less is allowed at tips, which may as well be round.
    let cosine = libm::cos((0.5 * turn.abs()).min(0.5 * PI));
    let radius = room * (1.0 + cosine) / (1.0 - cosine);
    let until = FLANK + Lengths::of(room).flank;
    let flank = |end: usize, is_forward: bool| {
        let (mut k, mut length, mut turned) = (end, 0.0, 0.0);
        while length < until {
            if is_forward {
                length += frame.lengths[k];
                k = (k + 1) % n;
            } else {
                k = (k + n - 1) % n;
                length += frame.lengths[k];
            }
            if length > FLANK {
                turned += frame.turns[k];
            }
        }
        turned / turn
    };
    let is_straight = |share: f64| share < SAME_WAY && share > -OTHER_WAY;
    length < turn.abs() * radius + SLACK
        && is_straight(flank(at(from), false))
        && is_straight(flank(at(to), true))
}

/// The points of the curve, with those at corners, as [`meeting`] finds them; where it finds none, those that were there.
pub(super) fn with_corners(stations: &[Station], corners: &[Corner], places: &[Option<Point>]) -> Vec<Point> {
    let mut points = Vec::with_capacity(stations.len() + corners.len());
    let mut corners = corners.iter().zip(places).peekable();
    for (i, station) in stations.iter().enumerate() {
        points.push(station.at);
        if let Some((corner, place)) = corners.next_if(|(corner, _)| corner.after == i) {
            match place {
                Some(place) => points.push(*place),
                None => points.extend(corner.old.iter().map(|station| station.at)),
            }
        }
    }
    points
}

/// Where the sides before and after a corner meet, for a curve that may lie `room` pixels to both sides of where it is.
pub(super) fn meeting(stations: &[Station], corner: &Corner, room: f64) -> Option<Point> {
    let n = stations.len();
    let extended = Lengths::of(room).extended;
    let (before, after) = (corner.after, (corner.after + 1) % n);
    let back = |from: usize, step: usize| {
        let (mut k, mut length) = (from, 0.0);
        while length < extended && !stations[(k + step) % n].is_free {
            let next = (k + step) % n;
            length += distance(stations[next].at, stations[k].at);
            k = next;
        }
        minus(stations[from].at, stations[k].at)
    };
    let (a, b) = (stations[before].at, stations[after].at);
    let (u, v) = (back(before, n - 1), back(after, 1).map(|x| -x));
    if dot(u, u).min(dot(v, v)) < LEAST_EXTENDED * LEAST_EXTENDED {
        return None;
    }
    let scale = cross(u, v);
    let turn = libm::atan2(scale, dot(u, v)).abs();
    let [forwards, backwards] = [cross(minus(b, a), v) / scale, cross(minus(b, a), u) / scale];
    if turn < 0.5 * LEAST_TURN || !(forwards > 0.0 && backwards < 0.0) {
        return None;
    }
    let place = [0, 1].map(|k| a[k] + forwards * u[k]);
    let off = corner.old.iter().map(|station| distance(station.at, place)).fold(f64::INFINITY, f64::min);
    let sine = libm::sin(0.5 * (PI - turn));
    let [of_tip, of_blunt] = REACH;
    let is_near = off <= FARTHEST && off * sine <= of_tip + (of_blunt - of_tip) * sine;
    let sides = [[a, place], [place, b]];
    let is_beside = |gate: &Gate| {
        sides.iter().any(|side| distance_between_segments([gate.left, gate.right], *side) <= OUTSIDE)
    };
    let is_within = || corner.old.iter().flat_map(|station| &station.gates).all(is_beside);
    (is_near && is_within()).then_some(place)
}
