//! Rankings against published values, brute force and published tables.

use pompeiu_complexity::{ComplexityError, compare_rankings, kendall, ranks, spearman};
use pompeiu_core::mesh::edit::Random;

/// A ranking, and the same one with blocks of ranks rotated and the rest in place.
fn rankings(n: usize, blocks: &[(usize, usize)]) -> [Vec<f64>; 2] {
    let a: Vec<f64> = (1..=n).map(|i| i as f64).collect();
    let mut b = a.clone();
    let mut from = 0;
    for &(length, turn) in blocks {
        b[from..from + length].rotate_left(turn);
        from += length;
    }
    [a, b]
}

#[test]
fn the_arithmetic_of_published_tables() {
    // Eight figures: 3 and 2 of them in place, sums of differences 8 and 6. Thirty-eight: 0 and 1, sums 392 and 330.
    for (n, blocks, printed) in [
        (8, &[(5, 1)][..], [0.375, 1.0, 0.125]),
        (8, &[(2, 1), (2, 1), (2, 1)], [0.25, 0.75, 0.09375]),
        (38, &[(28, 9), (10, 5)], [0.0, 10.31578, 0.27146]),
        (38, &[(27, 7), (10, 5)], [0.02631, 8.68421, 0.22853]),
    ] {
        let [a, b] = rankings(n, blocks);
        let found = compare_rankings(&a, &b).unwrap();
        let values = [found.similarity, found.average_distance, found.normalized_distance];
        for (value, printed) in values.iter().zip(printed) {
            // Published digits are truncated, not rounded.
            assert!(*value >= printed && *value < printed + 1e-5, "{n}: {value} {printed}");
        }
    }
}

#[test]
fn correlations_agree_with_their_definitions_under_ties() {
    let mut random = Random::new(5);
    for n in [2, 3, 7, 30] {
        for _ in 0..50 {
            let mut list = || (0..n).map(|_| f64::from(random.below(6))).collect::<Vec<_>>();
            let (a, b) = (list(), list());
            let (mut score, mut free) = (0.0, [0.0; 2]);
            for i in 0..n {
                for j in 0..i {
                    let sign =
                        |v: &[f64]| (v[i] - v[j]).partial_cmp(&0.0).map_or(0.0, |o| f64::from(o as i8));
                    score += sign(&a) * sign(&b);
                    free[0] += sign(&a).abs();
                    free[1] += sign(&b).abs();
                }
            }
            let expected = if free[0] * free[1] > 0.0 { score / (free[0] * free[1]).sqrt() } else { 0.0 };
            assert!((kendall(&a, &b) - expected).abs() < 1e-12);
            assert!((spearman(&a, &b) - spearman(&b, &a)).abs() < 1e-12);
        }
    }
    assert_eq!(ranks(&[3.0, 1.0, 3.0, 2.0]), [3.5, 1.0, 3.5, 2.0]);
    // Without ties ρ = 1 − 6 Σd² / n(n² − 1).
    let rho = spearman(&[1.0, 2.0, 3.0, 4.0, 5.0], &[2.0, 1.0, 4.0, 3.0, 5.0]);
    assert!((rho - 0.8).abs() < 1e-14);
}

#[test]
fn p_values_are_shares_of_permutations() {
    // Of the 24 orders of four things, two have |τ| = 1.
    let order = [1.0, 2.0, 3.0, 4.0];
    let found = compare_rankings(&order, &order).unwrap();
    assert_eq!((found.permutations, found.kendall, found.kendall_p), (24, 1.0, 2.0 / 24.0));
    assert_eq!(found.spearman_p, 2.0 / 24.0);
    // Swapping a pair of neighbours: τ = 4/6, reached by 1 + 3 orders and their reverses.
    let found = compare_rankings(&order, &[2.0, 1.0, 3.0, 4.0]).unwrap();
    assert_eq!(found.kendall_p, 8.0 / 24.0);
    let many: Vec<f64> = (0..20).map(f64::from).collect();
    let found = compare_rankings(&many, &many).unwrap();
    assert_eq!((found.permutations, found.kendall_p), (10_000, 1.0 / 10_000.0));
    assert!(matches!(compare_rankings(&many, &order), Err(ComplexityError::Lengths { a: 20, b: 4 })));
}
