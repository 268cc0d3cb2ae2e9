//! Joint motions of several clusters by least squares, for few clusters.

use super::contacts::rows;
use crate::Puzzle;

/// Relative size below which a combination of unit rows counts as 0, and above which it does not. Between them nothing is claimed.
const ZERO: f64 = 1e-9;
const NOT_ZERO: f64 = 1e-6;

/// A motion from min |Aᵀλ| over λ ≥ 1, where A has the rows of all contacts in the twists of all clusters but the first. `None` if
/// rounding leaves it undecided or nothing moves.
///
/// By Stiemke's lemma either some λ > 0 has Aᵀλ = 0, and then A x ≥ 0 implies A x = 0; or x = Aᵀλ at the minimum has A x ≥ 0 and is
/// nonzero: a motion that opens a contact. If all motions keep all contacts, the rank decides whether there is one.
pub(super) fn motion(puzzle: &Puzzle, clusters: &[usize], count: usize) -> Option<Vec<[f64; 3]>> {
    let columns = 3 * (count - 1);
    let matrix = matrix(puzzle, clusters, columns);
    let combination = least_combination(&matrix, columns)?;
    let size = norm(&combination) / (matrix.len() as f64).sqrt();
    let twists = |x: &[f64]| -> Vec<[f64; 3]> {
        let largest = x.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let (center, unit) = (centre(puzzle), scale(puzzle));
        (0..count)
            .map(|cluster| {
                if cluster == 0 {
                    return [0.0; 3];
                }
                let [vx, vy, w] = [0, 1, 2].map(|k| x[3 * (cluster - 1) + k] / largest);
                let w = w / unit;
                [vx + w * center[1], vy - w * center[0], w]
            })
            .collect()
    };
    if size > NOT_ZERO {
        let least = matrix.iter().map(|row| dot(row, &combination)).fold(f64::INFINITY, f64::min);
        return (least >= -ZERO * norm(&combination)).then(|| twists(&combination));
    }
    if size > ZERO {
        return None;
    }
    null_vector(&matrix, columns).map(|x| twists(&x))
}

fn centre(puzzle: &Puzzle) -> [f64; 2] {
    puzzle.size().map(|side| 0.5 * side)
}

/// The length that makes rotations and translations comparable.
fn scale(puzzle: &Puzzle) -> f64 {
    puzzle.unit()
}

/// Unit rows in the twists about the centre of the puzzle, with lengths relative to the mean side of a piece.
fn matrix(puzzle: &Puzzle, clusters: &[usize], columns: usize) -> Vec<Vec<f64>> {
    let origin = puzzle.size.map(|x| x / 2);
    let unit = scale(puzzle) / puzzle.step;
    let mut matrix: Vec<Vec<f64>> = Vec::new();
    for (i, border) in puzzle.borders.iter().enumerate() {
        let Some(right) = border.right else { continue };
        let [a, b] = [clusters[border.left], clusters[right]];
        if a == b {
            continue;
        }
        for row in rows(puzzle, i, origin) {
            let [x, y, w] = [row[0] as f64, row[1] as f64, row[2] as f64 / unit];
            let length = (x * x + y * y + w * w).sqrt();
            let mut full = vec![0.0; columns];
            for (cluster, sign) in [(a, 1.0), (b, -1.0)] {
                if cluster > 0 {
                    for (k, v) in [x, y, w].into_iter().enumerate() {
                        full[3 * (cluster - 1) + k] += sign * v / length;
                    }
                }
            }
            matrix.push(full);
        }
    }
    matrix
}

/// The shortest Aᵀλ over λ ≥ 1: with λ = 1 + μ a nonnegative least-squares problem (`lawson_solving_1974`, chapter 23).
fn least_combination(rows: &[Vec<f64>], columns: usize) -> Option<Vec<f64>> {
    let mut start = vec![0.0; columns];
    for row in rows {
        add(&mut start, row, 1.0);
    }
    let mut multipliers = vec![0.0; rows.len()];
    let mut passive: Vec<usize> = Vec::new();
    let tolerance = 1e-12 * rows.len() as f64;
    for _ in 0..20 * (columns + 10) {
        let mut combination = start.clone();
        for i in &passive {
            add(&mut combination, &rows[*i], multipliers[*i]);
        }
        // The row along which the combination shortens fastest.
        let free = (0..rows.len()).filter(|i| !passive.contains(i));
        let best = free.map(|i| (dot(&rows[i], &combination), i)).min_by(|a, b| a.0.total_cmp(&b.0));
        match best {
            Some((slope, i)) if slope < -tolerance => passive.push(i),
            _ => return Some(combination),
        }
        loop {
            let Some(target) = least_squares(rows, &passive, &start) else {
                // The new row is linearly dependent on the others.
                let dropped = passive.pop()?;
                multipliers[dropped] = 0.0;
                let mut combination = start.clone();
                for i in &passive {
                    add(&mut combination, &rows[*i], multipliers[*i]);
                }
                return Some(combination);
            };
            if target.iter().all(|m| *m > 0.0) {
                for (i, m) in passive.iter().zip(target) {
                    multipliers[*i] = m;
                }
                break;
            }
            // As far towards the target as all multipliers stay nonnegative.
            let steps = passive.iter().zip(&target).filter(|(_, m)| **m <= 0.0);
            let step = steps.map(|(i, m)| multipliers[*i] / (multipliers[*i] - m)).fold(1.0, f64::min);
            for (i, m) in passive.iter().zip(&target) {
                multipliers[*i] += step * (m - multipliers[*i]);
            }
            let out: Vec<usize> = passive
                .iter()
                .zip(&target)
                .filter(|(i, m)| **m <= 0.0 && multipliers[**i] <= 1e-12)
                .map(|(i, _)| *i)
                .collect();
            if out.is_empty() {
                return None;
            }
            for i in &out {
                multipliers[*i] = 0.0;
            }
            passive.retain(|i| !out.contains(i));
        }
    }
    None
}

/// The multipliers of some rows that minimise the length of their sum with a start, by orthogonalising twice; `None` if the rows
/// are dependent.
fn least_squares(rows: &[Vec<f64>], which: &[usize], start: &[f64]) -> Option<Vec<f64>> {
    let n = which.len();
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(n);
    let mut upper = vec![vec![0.0; n]; n];
    for (j, i) in which.iter().enumerate() {
        let mut v = rows[*i].clone();
        let before = norm(&v);
        for _ in 0..2 {
            for (k, q) in basis.iter().enumerate() {
                let part = dot(q, &v);
                upper[k][j] += part;
                add(&mut v, q, -part);
            }
        }
        let left = norm(&v);
        if left <= 1e-10 * before {
            return None;
        }
        upper[j][j] = left;
        basis.push(v.iter().map(|x| x / left).collect());
    }
    let mut found: Vec<f64> = basis.iter().map(|q| -dot(q, start)).collect();
    for j in (0..n).rev() {
        for k in j + 1..n {
            found[j] -= upper[j][k] * found[k];
        }
        found[j] /= upper[j][j];
    }
    Some(found)
}

/// A vector orthogonal to all rows; `None` if they span the space.
fn null_vector(rows: &[Vec<f64>], columns: usize) -> Option<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for row in rows {
        let left = remainder(&basis, row);
        if norm(&left) > NOT_ZERO {
            let length = norm(&left);
            basis.push(left.iter().map(|x| x / length).collect());
            if basis.len() == columns {
                return None;
            }
        }
    }
    let units = (0..columns).map(|k| {
        let mut unit = vec![0.0; columns];
        unit[k] = 1.0;
        remainder(&basis, &unit)
    });
    units.max_by(|a, b| norm(a).total_cmp(&norm(b)))
}

fn remainder(basis: &[Vec<f64>], v: &[f64]) -> Vec<f64> {
    let mut left = v.to_vec();
    for _ in 0..2 {
        for q in basis {
            let part = dot(q, &left);
            add(&mut left, q, -part);
        }
    }
    left
}

fn add(to: &mut [f64], v: &[f64], factor: f64) {
    for (x, y) in to.iter_mut().zip(v) {
        *x += factor * y;
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn norm(v: &[f64]) -> f64 {
    dot(v, v).sqrt()
}
