//! Curved sides of least variation of curvature.
//!
//! The curve of least bending is as straight as its gates allow: dents get shallower, and beside a corner an arc becomes a line. Where a side
//! has to bend, the curve whose curvature changes least goes on as an arc instead.

use super::relax::{Cost, Frame, Station, relax};

/// The sum of turns one way, in radians, from which on they are a bend, not an uneven line.
const SLIGHT: f64 = 0.02;

/// Weights of the barrier in turn.
const ROUNDS: [f64; 2] = [1e-6, 1e-8];

/// The curve with the least variation of curvature on each side between corners that bends, unless that side bends more often then, as straight
/// sides do beside corners that were not found.
pub(super) fn varied(mut stations: Vec<Station>) -> Vec<Station> {
    let n = stations.len();
    let before = Frame::of(&stations).turns;
    let turns = |turns: &[f64], (from, count): (usize, usize)| -> Vec<f64> {
        (from..from + count).map(|i| turns[i % n]).collect()
    };
    // Beside a corner a station turns as the corner does: that is no bend of the side.
    let own: Vec<f64> =
        stations.iter().zip(&before).map(|(s, turn)| if s.is_free { 0.0 } else { *turn }).collect();
    let mut sides = sides(&stations);
    sides.retain(|side| bends(&turns(&own, *side)) > 0);
    if sides.is_empty() {
        return stations;
    }
    let mut other = stations.clone();
    for weight in ROUNDS {
        relax(&mut other, weight, Cost::Variation);
    }
    let after = Frame::of(&other).turns;
    for side in sides {
        if bends(&turns(&after, side)) <= bends(&turns(&before, side)) {
            (side.0..side.0 + side.1).for_each(|i| stations[i % n].at = other[i % n].at);
        }
    }
    stations
}

/// The first station of each side, which follows a corner, and the number of its stations; all of them where there are no corners.
fn sides(stations: &[Station]) -> Vec<(usize, usize)> {
    let n = stations.len();
    let follows = |i: &usize| stations[*i].is_free && stations[(i + n - 1) % n].is_free;
    let begins: Vec<usize> = (0..n).filter(follows).collect();
    if begins.is_empty() {
        return vec![(0, n)];
    }
    let next = begins.iter().cycle().skip(1);
    begins.iter().zip(next).map(|(a, b)| (*a, if b > a { b - a } else { b + n - a })).collect()
}

/// How often turns change from one way to the other, and once more; runs of less than [`SLIGHT`] do not count.
fn bends(turns: &[f64]) -> usize {
    let (mut count, mut sum, mut is_counted) = (0, 0.0, false);
    for &turn in turns {
        if turn * sum < 0.0 {
            (sum, is_counted) = (0.0, false);
        }
        sum += turn;
        if !is_counted && f64::abs(sum) >= SLIGHT {
            count += 1;
            is_counted = true;
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bends_are_runs_of_turns_one_way() {
        assert_eq!(bends(&[0.01, 0.01, 0.01, -0.015, 0.03, 0.0, 0.01, -0.05]), 3);
        assert_eq!(bends(&[0.01, -0.01]), 0);
    }
}
