//! Symmetric positive definite systems of unknowns on a closed curve, each coupled with up to three on both sides.

/// Half the width of the widest band, once the unknowns are numbered from both ends of the list.
const WIDEST: usize = 6;

/// Solves the system in place by Cholesky's method; false where a pivot is not positive.
///
/// `rows[i]` couples unknown i with i, i + 1 and so on, at most i + 3, cyclically. Numbered 0, n − 1, 1, n − 2, …, unknowns that are coupled are at
/// most twice as many places apart, so that the matrix is a band.
pub(super) fn solve<const COUPLED: usize>(rows: &[[f64; COUPLED]], values: &mut [f64]) -> bool {
    const { assert!(COUPLED > 0 && 2 * (COUPLED - 1) <= WIDEST) };
    let reach = 2 * (COUPLED - 1);
    let n = rows.len();
    let place = |i: usize| if 2 * i < n { 2 * i } else { 2 * (n - 1 - i) + 1 };
    let mut band = vec![[0.0; WIDEST + 1]; n];
    let mut load = vec![0.0; n];
    for (i, row) in rows.iter().enumerate() {
        load[place(i)] = values[i];
        for (k, x) in row.iter().enumerate() {
            let (a, b) = (place(i), place((i + k) % n));
            band[a.max(b)][a.abs_diff(b)] += x;
        }
    }
    // band[i][k] is the entry in row i and column i − k, and that of the factor afterwards.
    for i in 0..n {
        for k in (0..=reach.min(i)).rev() {
            let j = i - k;
            let shared = (1..=reach - k).filter(|m| *m <= j);
            let sum: f64 = shared.map(|m| band[i][k + m] * band[j][m]).sum();
            let rest = band[i][k] - sum;
            if k > 0 {
                band[i][k] = rest / band[j][0];
            } else if rest > 0.0 {
                band[i][0] = rest.sqrt();
            } else {
                return false;
            }
        }
        let sum: f64 = (1..=reach.min(i)).map(|k| band[i][k] * load[i - k]).sum();
        load[i] = (load[i] - sum) / band[i][0];
    }
    for i in (0..n).rev() {
        let sum: f64 = (1..=reach.min(n - 1 - i)).map(|k| band[i + k][k] * load[i + k]).sum();
        load[i] = (load[i] - sum) / band[i][0];
    }
    for (i, value) in values.iter_mut().enumerate() {
        *value = load[place(i)];
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solutions_satisfy_their_systems() {
        for n in [8, 9, 30] {
            let rows: Vec<[f64; 4]> =
                (0..n).map(|i| [9.0 + (i % 3) as f64, -2.0 - (i % 2) as f64, 1.0, 0.5]).collect();
            let expected: Vec<f64> = (0..n).map(|i| ((7 * i) % 11) as f64 - 4.0).collect();
            let mut values = vec![0.0; n];
            for (i, row) in rows.iter().enumerate() {
                values[i] += row[0] * expected[i];
                for k in 1..4 {
                    values[i] += row[k] * expected[(i + k) % n];
                    values[(i + k) % n] += row[k] * expected[i];
                }
            }
            assert!(solve(&rows, &mut values));
            assert!(values.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-12), "{values:?}");
        }
        assert!(!solve(&[[-1.0, 0.0, 0.0, 0.0]; 8], &mut [0.0; 8]));
    }
}
