//! Elimination by groups of elements against sparse elimination.

use pompeiu_solve::{FIXED, FrontalPlan, LinearSolver, Lu, SolveError, SparseMatrix};

/// A tree of elements with saddle points: sparse LU and elimination by groups agree.
#[test]
fn elimination_by_groups_agrees_with_sparse_elimination() {
    // Unknowns along a fork: element e has 2 of its own and 2 shared with each neighbour.
    let neighbours: [&[u32]; 5] = [&[0, 1], &[2, 3], &[0, 1, 4, 5], &[2, 3, 4, 5, 6, 7], &[6, 7, FIXED]];
    let elements: Vec<Vec<u32>> = neighbours
        .iter()
        .enumerate()
        .map(|(e, shared)| shared.iter().copied().chain([8 + 2 * e as u32, 9 + 2 * e as u32]).collect())
        .collect();
    let entry = |e: usize, i: usize, j: usize| {
        let x = f64::from((7 * e + 3 * i + 11 * j) as u32).sin();
        if i == j { x + if i.is_multiple_of(2) { 6.0 } else { 0.0 } } else { x }
    };
    let n = 18;
    let mut triplets = Vec::new();
    for (e, list) in elements.iter().enumerate() {
        for (i, &row) in list.iter().enumerate().filter(|(_, u)| **u != FIXED) {
            for (j, &column) in list.iter().enumerate().filter(|(_, u)| **u != FIXED) {
                triplets.push((row as usize, column as usize, entry(e, i, j)));
            }
        }
    }
    let matrix = SparseMatrix::from_triplets(n, n, &triplets).unwrap();
    let right: Vec<f64> = (0..n).map(|k| (k as f64).cos()).collect();
    let expected = Lu::new(&matrix).unwrap().solve(&right).unwrap();
    // Other groups, and unknowns whose elimination is delayed.
    for (group_of, groups, stay) in [
        (vec![0, 1, 2, 3, 4], 5, vec![]),
        (vec![0, 0, 1, 1, 1], 2, vec![(8, 1)]),
        (vec![1, 0, 2, 3, 3], 4, vec![(0, 3), (9, 2), (11, 3)]),
    ] {
        let plan = FrontalPlan::new(n, &elements, &group_of, groups, &stay).unwrap();
        let fill = |e: usize, values: &mut [f64]| {
            let k = elements[e].len();
            for (at, value) in values.iter_mut().enumerate() {
                *value = entry(e, at / k, at % k);
            }
        };
        let found = plan.factor(fill).unwrap().solve(&right).unwrap();
        for (a, b) in found.iter().zip(&expected) {
            assert!((a - b).abs() < 1e-11 * (1.0 + b.abs()), "{a} {b}");
        }
        assert!(plan.bytes() > 0);
        assert!(matches!(plan.factor(|_, _| ()), Err(SolveError::Singular { .. })));
    }
    assert!(matches!(
        FrontalPlan::new(n + 1, &elements, &[0; 5], 1, &[]),
        Err(SolveError::Singular { index: 18 })
    ));
    assert!(matches!(FrontalPlan::new(n, &elements, &[1; 5], 1, &[]), Err(SolveError::OutOfRange { .. })));
    assert!(matches!(FrontalPlan::new(n, &elements, &[0; 4], 1, &[]), Err(SolveError::Length { .. })));
}
