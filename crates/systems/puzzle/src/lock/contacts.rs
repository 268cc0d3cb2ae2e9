//! Contacts of pieces: what the motion of one relative to another must fulfil along a border, exactly and in double precision.

use super::cone::Row;
use crate::Puzzle;

/// The rows of a border for the motion of the piece on its left relative to the one on its right, about an origin: neither end of a
/// segment from p to q may move into the right side.
pub(super) fn rows(puzzle: &Puzzle, border: usize, origin: [i64; 2]) -> impl Iterator<Item = Row> + '_ {
    rows_of(&puzzle.borders[border].corners, origin)
}

pub(super) fn rows_of(corners: &[[i64; 2]], origin: [i64; 2]) -> impl Iterator<Item = Row> + '_ {
    let at = move |c: [i64; 2]| [0, 1].map(|k| i128::from(c[k] - origin[k]));
    corners.windows(2).flat_map(move |pair| {
        let (p, q) = (at(pair[0]), at(pair[1]));
        let e = [q[0] - p[0], q[1] - p[1]];
        [p, q].map(|c| [-e[1], e[0], e[0] * c[0] + e[1] * c[1]])
    })
}

/// A condition on the twist of one cluster relative to another: exact, and scaled to length 1.
pub(super) struct Contact {
    pub(super) pair: [usize; 2],
    pub(super) exact: [i128; 3],
    pub(super) length: f64,
    pub(super) unit: [f64; 3],
}

/// The rows of all contacts: twists about the centre of the puzzle, with angular velocity scaled by the mean side of a piece.
pub(super) fn contacts(puzzle: &Puzzle, clusters: &[usize]) -> Vec<Contact> {
    let origin = puzzle.size.map(|x| x / 2);
    let unit = side(puzzle);
    let mut found = Vec::new();
    for (i, border) in puzzle.borders.iter().enumerate() {
        let Some(right) = border.right else { continue };
        let pair = [clusters[border.left], clusters[right]];
        if pair[0] == pair[1] {
            continue;
        }
        for [x, y, turn] in rows(puzzle, i, origin) {
            let exact = [x * unit, y * unit, turn];
            let [a, b, c] = exact.map(|v| v as f64);
            let length = (a * a + b * b + c * c).sqrt();
            if length > 0.0 {
                found.push(Contact { pair, exact, length, unit: [a / length, b / length, c / length] });
            }
        }
    }
    found
}

/// The mean side of a piece in steps, at least 1.
pub(super) fn side(puzzle: &Puzzle) -> i128 {
    (puzzle.unit() / puzzle.step).round().max(1.0) as i128
}

/// The product of a row with the twists: the opening velocity.
pub(super) fn opening(contact: &Contact, x: &[f64]) -> f64 {
    let part = |cluster: usize| {
        if cluster == 0 {
            return 0.0;
        }
        let at = 3 * (cluster - 1);
        let u = &contact.unit;
        u[0] * x[at] + u[1] * x[at + 1] + u[2] * x[at + 2]
    };
    part(contact.pair[0]) - part(contact.pair[1])
}

/// Adds a multiple of a row.
pub(super) fn add(contact: &Contact, factor: f64, to: &mut [f64]) {
    for (cluster, sign) in contact.pair.into_iter().zip([factor, -factor]) {
        if cluster > 0 {
            let at = 3 * (cluster - 1);
            (0..3).for_each(|k| to[at + k] += sign * contact.unit[k]);
        }
    }
}

/// The weighted sum of the outer products of rows, as entries of both triangles; consecutive contacts of a pair are summed first.
pub(super) fn square(contacts: &[Contact], weights: &[f64]) -> Vec<(usize, usize, f64)> {
    let mut entries = Vec::new();
    let mut first = 0;
    for group in contacts.chunk_by(|a, b| a.pair == b.pair) {
        let mut sum = [[0.0; 3]; 3];
        for (contact, weight) in group.iter().zip(&weights[first..]) {
            for (i, row) in sum.iter_mut().enumerate() {
                for (value, u) in row.iter_mut().zip(contact.unit) {
                    *value += weight * contact.unit[i] * u;
                }
            }
        }
        first += group.len();
        for (a, left) in group[0].pair.into_iter().zip([1.0, -1.0]) {
            for (b, right) in group[0].pair.into_iter().zip([1.0, -1.0]) {
                if a == 0 || b == 0 {
                    continue;
                }
                let block = sum
                    .iter()
                    .enumerate()
                    .flat_map(|(i, row)| row.iter().enumerate().map(move |(k, v)| (i, k, v)));
                entries.extend(block.map(|(i, k, v)| (3 * (a - 1) + i, 3 * (b - 1) + k, left * right * v)));
            }
        }
    }
    entries
}
