//! Moving the points of a curve along its normals to where it bends least.

use super::banded::solve;
use super::gates::{Gate, shortest};
use crate::Point;
use crate::outline::{cross, distance, dot, minus};

/// Points of the shortest curve nearer than this, in pixels, become one station.
const NEAR: f64 = 0.3;

/// Stations below which there is no smooth curve: the outline of a few pixels.
const FEWEST: usize = 8;

/// Curvature, per pixel, beyond which more of it costs little.
const CORNER: f64 = 0.15;

/// Newton's steps in a round, and the shift in pixels below which no more are taken.
const STEPS: usize = 12;
const SMALL: f64 = 1e-4;

/// How far a point may move at least and at most, in pixels, where a gate leaves less or more.
const ROOM: [f64; 2] = [0.01, 1.0];

/// The cost of the variation of curvature, in square pixels, relative to that of curvature.
const VARIATION: f64 = 100.0;

/// What costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cost {
    /// Curvature.
    Bending,
    /// Curvature, of which more costs little where it is large.
    Corners,
    /// How curvature changes along the curve; little where it is large.
    Variation,
}

/// A point of the curve.
#[derive(Clone, Debug)]
pub(super) struct Station {
    pub(super) at: Point,
    /// The gates that are crossed here.
    pub(super) gates: Vec<Gate>,
    /// Whether a turn costs nothing here, because a corner is beside it.
    pub(super) is_free: bool,
}

/// The points of the shortest curve through the gates; none where they are too few.
pub(super) fn stations(gates: &[Gate]) -> Option<Vec<Station>> {
    let mut found: Vec<Station> = Vec::new();
    for (gate, at) in gates.iter().zip(shortest(gates)) {
        match found.last_mut() {
            Some(last) if distance(last.at, at) < NEAR => last.gates.push(*gate),
            _ => found.push(Station { at, gates: vec![*gate], is_free: false }),
        }
    }
    let last = found.pop()?;
    match found.first_mut() {
        Some(first) if distance(first.at, last.at) < NEAR => first.gates.extend(last.gates),
        _ => found.push(last),
    }
    (found.len() >= FEWEST).then_some(found)
}

/// The curve as seen from its stations.
pub(super) struct Frame {
    /// Lengths to the next station.
    pub(super) lengths: Vec<f64>,
    /// Normals to the left.
    normals: Vec<Point>,
    /// Angles between the sides before and after.
    pub(super) turns: Vec<f64>,
}

impl Frame {
    pub(super) fn of(stations: &[Station]) -> Self {
        let n = stations.len();
        let side = |i: usize| minus(stations[(i + 1) % n].at, stations[i].at);
        // Sides of no length would have no direction.
        let lengths: Vec<f64> = (0..n).map(|i| dot(side(i), side(i)).sqrt().max(0.1 * NEAR)).collect();
        let (mut normals, mut turns) = (Vec::with_capacity(n), Vec::with_capacity(n));
        for i in 0..n {
            let before = (i + n - 1) % n;
            let (a, b) = (side(before), side(i));
            turns.push(libm::atan2(cross(a, b), dot(a, b)));
            let sum = [0, 1].map(|k| a[k] / lengths[before] + b[k] / lengths[i]);
            let length = dot(sum, sum).sqrt().max(f64::MIN_POSITIVE);
            normals.push([-sum[1] / length, sum[0] / length]);
        }
        Self { lengths, normals, turns }
    }

    /// The curvature at a station.
    pub(super) fn curvature(&self, i: usize) -> f64 {
        self.turns[i] / self.length_at(i)
    }

    /// Half the lengths of the sides before and after a station.
    fn length_at(&self, i: usize) -> f64 {
        0.5 * (self.lengths[(i + self.lengths.len() - 1) % self.lengths.len()] + self.lengths[i])
    }
}

/// Moves the stations along their normals by Newton's method, with a barrier of some weight at the ends of the gates. Curvature is taken as
/// linear in the shifts; the cost as the parabola that touches it from above, so that each step goes down.
pub(super) fn relax(stations: &mut [Station], weight: f64, cost: Cost) {
    let frame = Frame::of(stations);
    let limits: Vec<[f64; 2]> = stations.iter().zip(&frame.normals).map(|(s, n)| limits(s, *n)).collect();
    let mut shifts = vec![0.0; stations.len()];
    for _ in 0..STEPS {
        let step = match cost {
            Cost::Bending => step(bending(stations, &frame, &shifts, false), &shifts, &limits, weight),
            Cost::Corners => step(bending(stations, &frame, &shifts, true), &shifts, &limits, weight),
            Cost::Variation => step(variation(stations, &frame, &shifts), &shifts, &limits, weight),
        };
        let Some(step) = step else { break };
        // Nine tenths of the way to the first limit at most.
        let mut share: f64 = 1.0;
        for (i, [low, high]) in limits.iter().enumerate() {
            let room = if step[i] > 0.0 { high - shifts[i] } else { shifts[i] - low };
            if step[i].abs() * share > 0.9 * room {
                share = 0.9 * room / step[i].abs();
            }
        }
        let mut most: f64 = 0.0;
        for (shift, step) in shifts.iter_mut().zip(&step) {
            *shift += share * step;
            most = most.max((share * step).abs());
        }
        if most < SMALL {
            break;
        }
    }
    for ((station, shift), normal) in stations.iter_mut().zip(&shifts).zip(&frame.normals) {
        station.at = [0, 1].map(|k| station.at[k] + shift * normal[k]);
    }
}

/// Second derivatives of a cost by the shifts, each by its own, the next, and so on, and the downward gradient.
type Derivatives<const COUPLED: usize> = (Vec<[f64; COUPLED]>, Vec<f64>);

/// Newton's step for a cost with the barrier added; none where the system has no solution.
fn step<const COUPLED: usize>(
    (mut rows, mut step): Derivatives<COUPLED>,
    shifts: &[f64],
    limits: &[[f64; 2]],
    weight: f64,
) -> Option<Vec<f64>> {
    for (i, [low, high]) in limits.iter().enumerate() {
        let (below, above) = (shifts[i] - low, high - shifts[i]);
        step[i] += weight * (1.0 / below - 1.0 / above);
        rows[i][0] += weight * (1.0 / (below * below) + 1.0 / (above * above));
    }
    solve(&rows, &mut step).then_some(step)
}

/// How far a station may move along its normal.
fn limits(station: &Station, normal: Point) -> [f64; 2] {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for gate in &station.gates {
        let [a, b] = [gate.left, gate.right].map(|p| dot(minus(p, station.at), normal));
        low = low.max(a.min(b));
        high = high.min(a.max(b));
    }
    let [least, most] = ROOM;
    [low.clamp(-most, -least), high.clamp(least, most)]
}

/// The derivatives of the cost of bending.
fn bending(stations: &[Station], frame: &Frame, shifts: &[f64], keeps_corners: bool) -> Derivatives<3> {
    let n = stations.len();
    let (mut rows, mut gradient) = (vec![[0.0; 3]; n], vec![0.0; n]);
    for i in 0..n {
        let at = [(i + n - 1) % n, i, (i + 1) % n];
        let (before, after) = (frame.lengths[at[0]], frame.lengths[i]);
        let change = [1.0 / before, -1.0 / before - 1.0 / after, 1.0 / after];
        let turn = frame.turns[i] + (0..3).map(|j| change[j] * shifts[at[j]]).sum::<f64>();
        let length = frame.length_at(i);
        let relative = turn / (length * CORNER);
        let weight = match (stations[i].is_free, keeps_corners) {
            (true, _) => continue,
            (false, true) => 1.0 / (length * (1.0 + relative * relative)),
            (false, false) => 1.0 / length,
        };
        for j in 0..3 {
            gradient[at[j]] -= weight * turn * change[j];
            for m in j..3 {
                rows[at[j]][m - j] += weight * change[j] * change[m];
            }
        }
    }
    (rows, gradient)
}

/// The derivatives of the cost of variation.
fn variation(stations: &[Station], frame: &Frame, shifts: &[f64]) -> Derivatives<4> {
    let n = stations.len();
    let (mut rows, mut gradient) = (vec![[0.0; 4]; n], vec![0.0; n]);
    // How the curvature at a station changes with the shifts of the one before, its own, and the next.
    let change = |i: usize| {
        let (before, after) = (frame.lengths[(i + n - 1) % n], frame.lengths[i]);
        [1.0 / before, -1.0 / before - 1.0 / after, 1.0 / after].map(|x| x / frame.length_at(i))
    };
    let curvature = |i: usize| {
        let shift = |j: usize| shifts[(i + n + j - 1) % n];
        frame.curvature(i) + change(i).iter().enumerate().map(|(j, x)| x * shift(j)).sum::<f64>()
    };
    let curvatures: Vec<f64> = (0..n).map(curvature).collect();
    for i in 0..n {
        let next = (i + 1) % n;
        if stations[i].is_free || stations[next].is_free {
            continue;
        }
        let (a, b) = (change(i), change(next));
        let change = [-a[0], b[0] - a[1], b[1] - a[2], b[2]];
        let jump = curvatures[next] - curvatures[i];
        let relative = 0.5 * (curvatures[next].abs() + curvatures[i].abs()) / CORNER;
        let weight = VARIATION / (frame.lengths[i] * (1.0 + relative * relative));
        for j in 0..4 {
            let at = (i + n + j - 1) % n;
            gradient[at] -= weight * jump * change[j];
            for m in j..4 {
                rows[at][m - j] += weight * change[j] * change[m];
            }
        }
    }
    (rows, gradient)
}
