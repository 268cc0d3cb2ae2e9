//! Matrices of elements and of blocks against those of triplets.

use pompeiu_solve::{
    Cholesky, ElementPattern, FIXED, LinearSolver, SolveError, SparseMatrix, SymmetricBlocks,
};

#[test]
fn elements_make_the_same_matrix_as_triplets() {
    let elements = [[0, 2, 1], [2, FIXED, 3], [3, 0, FIXED]];
    let element = |m: usize| [0, 1, 2].map(|i| [0, 1, 2].map(|j| (1 + m * 9 + i * 3 + j) as f64));
    let diagonal = [1.0, 2.0, 3.0, 4.0];
    let matrix = ElementPattern::new(4, &elements).unwrap().assemble(&diagonal, element).unwrap();
    let mut triplets: Vec<_> = diagonal.iter().enumerate().map(|(i, &d)| (i, i, d)).collect();
    for (m, e) in elements.iter().enumerate() {
        let entries = element(m);
        for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
            if e[i] != FIXED && e[j] != FIXED {
                triplets.push((e[i] as usize, e[j] as usize, entries[i][j]));
            }
        }
    }
    assert_eq!(matrix, SparseMatrix::from_triplets(4, 4, &triplets).unwrap());
}

#[test]
fn doubled_as_if_made_for_twice_the_unknowns() {
    let elements = [[0, 2, 1], [2, FIXED, 3], [3, 0, FIXED]];
    let both = |i: u32| if i == FIXED { [FIXED; 2] } else { [2 * i, 2 * i + 1] };
    let twice = elements.map(|[a, b, c]| {
        let [[a, d], [b, e], [c, f]] = [a, b, c].map(both);
        [a, d, b, e, c, f]
    });
    let doubled = ElementPattern::new(4, &elements).unwrap().doubled();
    let expected = ElementPattern::new(8, &twice).unwrap();
    let element = |m: usize| {
        let mut entries = [[0.0; 6]; 6];
        entries.iter_mut().flatten().enumerate().for_each(|(k, x)| *x = (1 + m * 36 + k) as f64);
        entries
    };
    assert_eq!(doubled.assemble(&[2.0; 8], element).unwrap(), expected.assemble(&[2.0; 8], element).unwrap());
}

#[test]
fn unknowns_exist_and_lengths_agree() {
    let error = ElementPattern::new(2, &[[0, 2]]).unwrap_err();
    assert!(matches!(error, SolveError::OutOfRange { row: 2, .. }), "{error}");
    let pattern = ElementPattern::new(2, &[[0, 1]]).unwrap();
    assert!(matches!(pattern.assemble(&[0.0], |_| [[0.0; 2]; 2]), Err(SolveError::Length { .. })));
    assert!(matches!(pattern.assemble(&[0.0; 2], |_| [[f64::NAN; 2]; 2]), Err(SolveError::NonFinite { .. })));
}

fn entry(seed: u32, a: usize, b: usize) -> f64 {
    f64::from(seed) + 0.25 * a as f64 - 0.125 * b as f64
}

/// Blocks at places, each added twice, and the same entries as triplets.
fn filled(matrix: &mut SymmetricBlocks, places: &[(u32, u32)]) -> Vec<(usize, usize, f64)> {
    let mut triplets = Vec::new();
    for (seed, &(i, j)) in places.iter().chain(places).enumerate() {
        let large = if i == j { 50.0 } else { 0.0 };
        let of = |a: usize, b: usize| entry(seed as u32, a, b) + if a == b { large } else { 0.0 };
        matrix.add(i, j, of);
        for (a, b) in (0..9).map(|k| (k / 3, k % 3)) {
            let (r, c) = (3 * i as usize + a, 3 * j as usize + b);
            if i != j || r >= c {
                triplets.push((r.max(c), r.min(c), of(a, b)));
            }
        }
    }
    triplets
}

#[test]
fn blocks_make_the_same_matrix_as_triplets_and_zeros_where_earlier_ones_had_blocks() {
    let all = [(0, 0), (1, 1), (2, 2), (3, 3), (3, 0), (1, 3), (2, 1)];
    let mut matrix = SymmetricBlocks::default();
    for places in [&all[..], &all[..5]] {
        matrix.clear(4, places).unwrap();
        let mut triplets = filled(&mut matrix, places);
        for &(i, j) in &all {
            for (a, b) in (0..9).map(|k| (k / 3, k % 3)) {
                let (r, c) = (3 * i as usize + a, 3 * j as usize + b);
                if i != j || r >= c {
                    triplets.push((r.max(c), r.min(c), 0.0));
                }
            }
        }
        assert_eq!(matrix.matrix().unwrap(), SparseMatrix::from_triplets(12, 12, &triplets).unwrap());
        let right: Vec<f64> = (0..12).map(f64::from).collect();
        let mut found = right.clone();
        matrix.factor().unwrap().solve_in_place(&mut found).unwrap();
        let mut expected = right;
        Cholesky::new(&matrix.matrix().unwrap()).unwrap().solve_in_place(&mut expected).unwrap();
        assert!(found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?} {expected:?}");
    }
}

#[test]
fn a_place_outside_of_the_matrix_is_refused() {
    let error = SymmetricBlocks::default().clear(2, &[(0, 2)]).unwrap_err();
    assert!(matches!(error, SolveError::OutOfRange { column: 2, .. }), "{error}");
}
