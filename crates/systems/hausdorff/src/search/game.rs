//! The best weights of a mixture bound: a matrix game with three columns.
//!
//! With rows `D_i` (distances of the three corners of a piece from face i), `min over w of max_j sum_i w_i D_ij` is the
//! value of a zero-sum game. Any weights give a valid bound, so nothing here needs to be exact.
//!
//! # Source
//! That both players' best strategies meet in one value: `neumann_gesellschaftsspiele_1928`.

use multiversion::multiversion;

/// Rows that one game takes.
pub(crate) const MAX_ROWS: usize = 8;

/// Distances of the three corners of a piece from one face.
pub(crate) type Row = [f64; 3];

/// Nearly optimal strategies of both players.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Game {
    /// Weights of the rows: nonnegative, sum 1 up to rounding.
    pub(crate) weights: [f64; MAX_ROWS],
    /// Weights of the corners: the barycentric coordinates of the point where the bound is attained.
    pub(crate) corners: [f64; 3],
    /// `max_j sum_i w_i D_ij` for these very weights.
    pub(crate) value: f64,
}

/// Solves the game by the simplex method on three constraints.
#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
pub(crate) fn solve(rows: &[Row]) -> Game {
    let alone = single(rows);
    let low = rows.iter().flatten().fold(f64::INFINITY, |low, &d| if d < low { d } else { low });
    // A face much farther than the best one alone can have little weight, and would hide differences among the others.
    let high = low + MOST_SPREAD * (alone.value - low);
    let greatest = |row: &Row| row.iter().fold(0.0, |m, &d| if d > m { d } else { m });
    let mut taken = [0; MAX_ROWS];
    let mut count = 0;
    for (i, _) in rows.iter().enumerate().filter(|(_, row)| greatest(row) <= high) {
        taken[count] = i;
        count += 1;
    }
    let taken = &taken[..count];
    let high = taken.iter().fold(low, |high, &i| f64::max(high, greatest(&rows[i])));
    if count <= 1 || high <= low {
        return alone;
    }
    // Shifted and scaled entries in [1, 2]: the strategies stay the same, and the programme below is bounded. In
    // terms of w' = w / value it reads: maximise sum w', subject to sum_i w'_i M_ij <= 1 for each corner j.
    let scale = 1.0 / (high - low);
    let mut t = [[0.0; WIDTH]; 4];
    for (i, &from) in taken.iter().enumerate() {
        let row = &rows[from];
        for j in 0..3 {
            t[j][ROWS + i] = 1.0 + (row[j] - low) * scale;
        }
        t[3][ROWS + i] = -1.0;
    }
    for j in 0..3 {
        t[j][j] = 1.0;
        t[j][RIGHT] = 1.0;
    }
    let mut basis = [0, 1, 2];
    for _ in 0..MOST_PIVOTS {
        let (mut enter, mut steepest) = (RIGHT, -LEAST_DESCENT);
        for c in 0..ROWS + count {
            if c != RIGHT && t[3][c] < steepest {
                (enter, steepest) = (c, t[3][c]);
            }
        }
        if enter == RIGHT {
            break;
        }
        let (mut leave, mut least) = (3, f64::INFINITY);
        for j in 0..3 {
            if t[j][enter] > LEAST_PIVOT {
                let ratio = t[j][RIGHT] / t[j][enter];
                if ratio < least {
                    (leave, least) = (j, ratio);
                }
            }
        }
        if leave == 3 {
            break;
        }
        basis[leave] = enter;
        let inverse = 1.0 / t[leave][enter];
        let pivot = t[leave].map(|x| x * inverse);
        for row in &mut t {
            let factor = row[enter];
            for c in 0..WIDTH {
                row[c] -= factor * pivot[c];
            }
        }
        t[leave] = pivot;
    }
    let positive = |x: f64| if x > 0.0 { x } else { 0.0 };
    let mut weights = [0.0; MAX_ROWS];
    for j in 0..3 {
        if basis[j] >= ROWS {
            weights[taken[basis[j] - ROWS]] = positive(t[j][RIGHT]);
        }
    }
    let corners = [0, 1, 2].map(|j| positive(t[3][j]));
    let (total, corner_total) = (weights.iter().sum::<f64>(), corners.iter().sum::<f64>());
    if !(total.is_normal() && corner_total.is_normal()) {
        return alone;
    }
    let weights = weights.map(|w| w / total);
    Game { weights, corners: corners.map(|c| c / corner_total), value: value(rows, &weights) }
}

/// Columns of the tableau: three slacks, the right-hand side, and the rows of the game.
const RIGHT: usize = 3;
const ROWS: usize = 4;
const WIDTH: usize = ROWS + MAX_ROWS;
/// Entries of the tableau are about one; smaller ones than this may be rounding, and dividing by them would spread it.
const LEAST_PIVOT: f64 = 1e-8;
/// Reduced costs above this are rounding too.
const LEAST_DESCENT: f64 = 1e-14;
/// How many times farther than the best face alone another may be, both counted from the least distance, to have any weight.
const MOST_SPREAD: f64 = 1e4;
/// Far more than a game of this size takes, unless rounding makes it cycle.
const MOST_PIVOTS: usize = 4 * MAX_ROWS;

/// The bound that weights give.
pub(crate) fn value(rows: &[Row], weights: &[f64; MAX_ROWS]) -> f64 {
    let mut worst = 0.0;
    for j in 0..3 {
        let mean: f64 = rows.iter().zip(weights).map(|(row, w)| w * row[j]).sum();
        worst = if mean > worst { mean } else { worst };
    }
    worst
}

/// The best single row.
fn single(rows: &[Row]) -> Game {
    let mut best = Game { weights: [0.0; MAX_ROWS], corners: [0.0; 3], value: f64::INFINITY };
    for (i, row) in rows.iter().enumerate() {
        let worst = (0..3).fold(0, |w, j| if row[j] > row[w] { j } else { w });
        if row[worst] < best.value {
            best = Game { weights: [0.0; MAX_ROWS], corners: [0.0; 3], value: row[worst] };
            best.weights[i] = 1.0;
            best.corners[worst] = 1.0;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn check(rows: &[Row]) {
        let game = solve(rows);
        let least = rows
            .iter()
            .map(|r| (0..3).map(|j| r[j] * game.corners[j]).sum::<f64>())
            .fold(f64::INFINITY, f64::min);
        assert!((game.weights.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        assert!(game.weights.iter().chain(&game.corners).all(|&x| x >= 0.0));
        // Weak duality holds for any strategies; equality proves both optimal.
        let spread = rows.iter().flatten().fold(0.0_f64, |m, &x| m.max(x))
            - rows.iter().flatten().fold(f64::INFINITY, |m, &x| m.min(x));
        assert!((game.value - least).abs() <= 1e-10 * spread + 1e-15, "{rows:?} {game:?} {least}");
    }

    /// Entries equal but for rounding once made a pivot of it.
    #[test]
    fn rounding_is_no_pivot() {
        check(&[[1.000_002, 1.000_002, 1.000_002], [1.000_002, 1.000_001, 1.0], [1.0, 1.000_001, 1.000_002]]);
    }

    #[test]
    fn known_games() {
        check(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        let game = solve(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        assert!((game.value - 1.0 / 3.0).abs() < 1e-15);
        assert_eq!(solve(&[[0.5, 0.5, 0.5]]).value, 0.5);
        assert_eq!(solve(&[[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]).value, 0.0);
    }

    proptest! {
        #[test]
        fn both_strategies_are_optimal(rows in prop::collection::vec([0.0..1.0, 0.0..1.0, 0.0..1.0], 1..=MAX_ROWS)) {
            check(&rows);
        }

        #[test]
        fn nearly_constant_and_degenerate_games(
            rows in prop::collection::vec([0..3_i32, 0..3_i32, 0..3_i32], 1..=MAX_ROWS), scale in 0..10_i32
        ) {
            let step = 10_f64.powi(-scale);
            check(&rows.iter().map(|r| r.map(|x| 1.0 + step * f64::from(x))).collect::<Vec<_>>());
        }
    }
}
