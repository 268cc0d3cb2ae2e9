//! Assigning tubes to the quads of a core, and rotating the core.

use super::core::Core;
use glam::{DMat3, DQuat, DVec3};

/// A rotated core, and the quad of each tube.
#[derive(Clone, Debug)]
pub(super) struct Assignment {
    pub(super) rotation: DMat3,
    pub(super) quads: Vec<usize>,
    /// Mean angle in radians between tubes and quads, plus half the greatest one.
    pub(super) score: f64,
}

/// Number of initial rotations.
const TRIALS: usize = 120;

/// Rounds of assigning and rotating.
const ROUNDS: usize = 6;

/// The best distinct assignments, best first.
///
/// From many initial rotations, tubes are assigned to quads by least squared angles (Hungarian method), and the core is rotated to
/// the best fit (Kabsch), alternately.
pub(super) fn assignments(core: &Core, directions: &[DVec3], most: usize) -> Vec<Assignment> {
    let normals: Vec<DVec3> = (0..core.quads.len()).map(|q| core.centre(q).normalize_or_zero()).collect();
    let mut found: Vec<Assignment> = Vec::new();
    for trial in 0..TRIALS {
        let mut rotation = DMat3::from_quat(spread(trial));
        let mut quads = Vec::new();
        for _ in 0..ROUNDS {
            let cost: Vec<Vec<f64>> = directions
                .iter()
                .map(|d| normals.iter().map(|&n| angle(*d, rotation * n).powi(2)).collect())
                .collect();
            let next = hungarian(&cost);
            if next == quads {
                break;
            }
            quads = next;
            let from: Vec<DVec3> = quads.iter().map(|&q| normals[q]).collect();
            rotation = kabsch(&from, directions, rotation);
        }
        let angles: Vec<f64> =
            directions.iter().zip(&quads).map(|(d, &q)| angle(*d, rotation * normals[q])).collect();
        let mean = angles.iter().sum::<f64>() / angles.len() as f64;
        let score = mean + 0.5 * angles.iter().fold(0.0, |a: f64, &b| a.max(b));
        // Assignments that differ by a symmetry of the core have equal scores.
        if found.iter().all(|other| (other.score - score).abs() > 1e-6) {
            found.push(Assignment { rotation, quads, score });
        }
    }
    found.sort_by(|a, b| a.score.total_cmp(&b.score));
    found.truncate(most);
    found
}

pub(super) fn angle(a: DVec3, b: DVec3) -> f64 {
    libm::atan2(a.cross(b).length(), a.dot(b))
}

/// Rotations distributed evenly, the same on every machine (Shoemake, with a low-discrepancy sequence).
fn spread(trial: usize) -> DQuat {
    let at = |generator: f64| (0.5 + trial as f64 * generator).fract();
    let (a, b, c) = (at(0.819_172_513_396_164), at(0.671_043_606_703_789), at(0.549_700_477_901_97));
    let (p, q) = ((1.0 - a).sqrt(), a.sqrt());
    let (s, t) = (std::f64::consts::TAU * b, std::f64::consts::TAU * c);
    DQuat::from_xyzw(p * libm::sin(s), p * libm::cos(s), q * libm::sin(t), q * libm::cos(t)).normalize()
}

/// The rotation that maps vectors closest to others, near an initial guess: Gauss–Newton on the rotation, which only needs 3 × 3
/// solves and never becomes a reflection.
fn kabsch(from: &[DVec3], to: &[DVec3], mut rotation: DMat3) -> DMat3 {
    for _ in 0..30 {
        let mut matrix = DMat3::ZERO;
        let mut torque = DVec3::ZERO;
        for (f, t) in from.iter().zip(to) {
            let r = rotation * *f;
            torque += r.cross(*t);
            // Minus the square of the cross-product matrix.
            matrix += DMat3::from_diagonal(DVec3::splat(r.dot(*t).max(0.2)))
                - outer(r, *t) * 0.5
                - outer(*t, r) * 0.5;
        }
        matrix += DMat3::from_diagonal(DVec3::splat(1e-6 + 0.05 * from.len() as f64));
        let step = matrix.inverse() * torque;
        let size = step.length();
        if !size.is_finite() || size < 1e-12 {
            break;
        }
        // Sines from our own library, for the same bits on every machine.
        let half = 0.5 * size.min(0.5);
        let axis = step / size * libm::sin(half);
        let turn = DQuat::from_xyzw(axis.x, axis.y, axis.z, libm::cos(half));
        rotation = DMat3::from_quat(turn) * rotation;
    }
    rotation
}

fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// The assignment of least cost: the column of each row; there must not be more rows than columns.
///
/// # Source
/// The Hungarian method by shortest augmenting paths, `crouse_assignment_2016`.
pub(super) fn hungarian(cost: &[Vec<f64>]) -> Vec<usize> {
    let (n, m) = (cost.len(), cost[0].len());
    // Row and column 0 are sentinels.
    let (mut u, mut v) = (vec![0.0; n + 1], vec![0.0; m + 1]);
    let mut row_of = vec![0; m + 1];
    let mut way = vec![0; m + 1];
    for i in 1..=n {
        row_of[0] = i;
        let mut column = 0;
        let mut least = vec![f64::INFINITY; m + 1];
        let mut used = vec![false; m + 1];
        loop {
            used[column] = true;
            let row = row_of[column];
            let (mut delta, mut next) = (f64::INFINITY, 0);
            for j in 1..=m {
                if used[j] {
                    continue;
                }
                let reduced = cost[row - 1][j - 1] - u[row] - v[j];
                if reduced < least[j] {
                    (least[j], way[j]) = (reduced, column);
                }
                if least[j] < delta {
                    (delta, next) = (least[j], j);
                }
            }
            for j in 0..=m {
                if used[j] {
                    u[row_of[j]] += delta;
                    v[j] -= delta;
                } else {
                    least[j] -= delta;
                }
            }
            column = next;
            if row_of[column] == 0 {
                break;
            }
        }
        while column != 0 {
            row_of[column] = row_of[way[column]];
            column = way[column];
        }
    }
    let mut result = vec![0; n];
    for j in 1..=m {
        if row_of[j] > 0 {
            result[row_of[j] - 1] = j - 1;
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::core::library;

    #[test]
    fn assignments_are_the_cheapest() {
        let mut state = 11_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64
        };
        for _ in 0..50 {
            let cost: Vec<Vec<f64>> = (0..3).map(|_| (0..5).map(|_| random()).collect()).collect();
            let found = hungarian(&cost);
            let price =
                |columns: [usize; 3]| columns.iter().enumerate().map(|(i, &j)| cost[i][j]).sum::<f64>();
            let mut best = f64::INFINITY;
            for a in 0..5 {
                for b in 0..5 {
                    for c in 0..5 {
                        if a != b && b != c && a != c {
                            best = best.min(price([a, b, c]));
                        }
                    }
                }
            }
            assert!((price([found[0], found[1], found[2]]) - best).abs() < 1e-9);
        }
    }

    #[test]
    fn a_turned_core_is_found_again() {
        let core = &library(3)[0];
        let turn = DMat3::from_quat(spread(17));
        let directions = [turn * DVec3::X, turn * DVec3::Y, turn * -DVec3::Z];
        let best = &assignments(core, &directions, 1)[0];
        assert!(best.score < 1e-6, "{}", best.score);
    }
}
