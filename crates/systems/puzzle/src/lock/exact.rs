//! Checks in integers that multipliers prove a lock.

use super::contacts::{Contact, square};
use pompeiu_solve::{Cholesky, SparseMatrix};

/// The largest multiplier as an integer: its product with a row stays below 2^107, and sums of a million below 2^127.
const LARGEST: f64 = (1_u64 << 60) as f64;

/// Shifts of the diagonal that are tried, relative to the largest weight: powers of this.
const FACTOR: f64 = 0.125;
const SHIFTS: i32 = 16;

/// Whether positive weights of unit rows prove that no motion is possible.
///
/// # Definition
/// Let Λ be the weights divided by the lengths of the rows R, scaled and rounded to integers of at least 1. Their combination ρ = Σ
/// Λ R is computed in integers. It need not be 0: with H = Σ Λ |R| r rᵀ over the unit rows r, let H y = ρ. Then Σ Λ (1 − r·y) R = 0
/// exactly, and these multipliers are positive where r·y < 1. As r has two parts of length at most 1, that holds if √2 |ρ| < σ for
/// a lower bound σ > 0 of the eigenvalues of H. Such a bound also implies that the rows have full rank; so by Stiemke's lemma
/// nothing moves.
///
/// # Accuracy
/// σ comes from a Cholesky factor of H − cI that exists in double precision. Its backward error is at most γ tr H with γ = (n + 3)
/// u / (1 − (n + 3) u) for n unknowns and u = 2^-53 (`rump_verification_2006`). The error of the entries of H is at most 2 (m + 12)
/// u tr H for m contacts, by the sum of all absolute values. Twice both is subtracted from c.
pub(super) fn proves(contacts: &[Contact], weights: &[f64], columns: usize) -> bool {
    let over_lengths: Vec<f64> = contacts.iter().zip(weights).map(|(c, w)| w / c.length).collect();
    let largest = over_lengths.iter().copied().fold(0.0, f64::max);
    if !(largest > 0.0 && largest.is_finite()) {
        return false;
    }
    let multipliers: Vec<i128> =
        over_lengths.iter().map(|v| (v / largest * LARGEST).round() as i128).collect();
    if multipliers.iter().any(|m| *m < 1) {
        return false;
    }
    let mut combination = vec![0_i128; columns];
    for (contact, multiplier) in contacts.iter().zip(&multipliers) {
        for (cluster, sign) in contact.pair.into_iter().zip([1, -1]) {
            if cluster == 0 {
                continue;
            }
            for k in 0..3 {
                let entry = &mut combination[3 * (cluster - 1) + k];
                let Some(sum) = entry.checked_add(sign * multiplier * contact.exact[k]) else { return false };
                *entry = sum;
            }
        }
    }
    // One rounding error per operation: a thousandth more is enough.
    let rest = 1.001 * combination.iter().map(|v| (*v as f64) * (*v as f64)).sum::<f64>().sqrt();
    let own: Vec<f64> = contacts.iter().zip(&multipliers).map(|(c, m)| *m as f64 * c.length).collect();
    let trace: f64 = 2.0 * own.iter().sum::<f64>();
    let unit = 0.5 * f64::EPSILON;
    let error = 2.0 * unit * trace * ((columns + 4) as f64 + 2.0 * (contacts.len() + 12) as f64);
    let entries = square(contacts, &own);
    let most = own.iter().copied().fold(0.0, f64::max);
    for power in 1..=SHIFTS {
        let shift = most * FACTOR.powi(power);
        let bound = shift - error;
        if bound <= std::f64::consts::SQRT_2 * 1.001 * rest {
            return false;
        }
        let shifted: Vec<_> = entries.iter().copied().chain((0..columns).map(|k| (k, k, -shift))).collect();
        let matrix = SparseMatrix::from_triplets(columns, columns, &shifted);
        if matrix.is_ok_and(|matrix| Cholesky::new(&matrix).is_ok()) {
            return true;
        }
    }
    false
}
