//! Sparse matrices against dense arithmetic.

use pompeiu_solve::{SolveError, SparseMatrix};

fn example() -> SparseMatrix {
    let entries = [(2, 1, 5.0), (0, 0, 1.0), (2, 1, -2.0), (1, 0, 4.0), (0, 2, 7.0)];
    SparseMatrix::from_triplets(3, 3, &entries).unwrap()
}

#[test]
fn entries_are_sorted_and_added() {
    let matrix = example();
    let entries: Vec<_> = matrix.iter().collect();
    assert_eq!(entries, [(0, 0, 1.0), (1, 0, 4.0), (2, 1, 3.0), (0, 2, 7.0)]);
    assert_eq!((matrix.get(2, 1), matrix.get(1, 1), matrix.get(0, 9)), (3.0, 0.0, 0.0));
}

#[test]
fn products_are_those_of_the_dense_matrix() {
    let matrix = example();
    assert_eq!(matrix.multiply(&[1.0, 2.0, 3.0]), [22.0, 4.0, 6.0]);
    assert_eq!(matrix.multiply_transposed(&[1.0, 2.0, 3.0]), [9.0, 9.0, 7.0]);
    let transposed = matrix.transposed();
    assert_eq!(transposed.multiply(&[1.0, 2.0, 3.0]), [9.0, 9.0, 7.0]);
    assert_eq!(transposed.transposed(), matrix);
}

#[test]
fn sums_and_parts() {
    let matrix = example();
    let identity = SparseMatrix::diagonal(&[1.0; 3]).unwrap();
    let sum = matrix.combined(2.0, &identity, -1.0).unwrap();
    assert_eq!(sum.multiply(&[1.0, 1.0, 1.0]), [15.0, 7.0, 5.0]);
    let part = matrix.principal(&[2, 0]).unwrap();
    assert_eq!(part.iter().collect::<Vec<_>>(), [(1, 0, 7.0), (1, 1, 1.0)]);
}

#[test]
fn links_make_a_quadratic_form() {
    let links = [(0, 1, 2.0), (2, 1, 0.5), (1, 0, 1.0), (2, 2, 9.0)];
    let matrix = SparseMatrix::from_links(4, &links).unwrap();
    let x: [f64; 4] = [1.0, 3.0, -2.0, 8.0];
    let expected = 3.0 * 4.0 + 0.5 * 25.0;
    let found: f64 = x.iter().zip(matrix.multiply(&x)).map(|(x, y)| x * y).sum();
    assert_eq!(found, expected);
    assert_eq!(matrix.multiply(&[1.0; 4]), [0.0; 4]);
    assert_eq!(matrix.transposed(), matrix);
    assert_eq!((matrix.get(0, 1), matrix.get(1, 1), matrix.get(3, 3)), (-3.0, 3.5, 0.0));
    assert!(matrix.column(1).map(|entry| entry.0).is_sorted());
    assert!(matches!(SparseMatrix::from_links(2, &[(0, 2, 1.0)]), Err(SolveError::OutOfRange { .. })));
    let part = matrix.principal(&[0, 2]).unwrap();
    assert_eq!(part.iter().collect::<Vec<_>>(), [(0, 0, 3.0), (1, 1, 0.5)]);
}

#[test]
fn wrong_entries_are_named() {
    let error = SparseMatrix::from_triplets(2, 2, &[(0, 2, 1.0)]).unwrap_err();
    assert_eq!(error.to_string(), "entry (0, 2) lies outside a matrix of 2 rows and 2 columns");
    let error = SparseMatrix::from_triplets(2, 2, &[(0, 1, f64::NAN)]).unwrap_err();
    assert_eq!(error.to_string(), "entry (0, 1) of the matrix is NaN, expected a finite number");
    let overflow = SparseMatrix::from_triplets(1, 1, &[(0, 0, f64::MAX), (0, 0, f64::MAX)]);
    assert!(matches!(overflow, Err(SolveError::NonFinite { .. })));
    assert!(matches!(example().principal(&[3]), Err(SolveError::OutOfRange { row: 3, .. })));
}
