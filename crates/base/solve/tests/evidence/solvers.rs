//! Solvers against known solutions, and their errors when there is none.

use pompeiu_solve::{
    Analysis, Banded, Cholesky, DenseCholesky, Ldlt, LinearSolver, Lu, Ordering, SemidefiniteCholesky,
    SolveError, SparseMatrix, gmres,
};

/// The Laplacian of a grid of points, n by n by layers, plus `shift` on the diagonal.
fn grid_laplacian(n: usize, layers: usize, shift: f64) -> SparseMatrix {
    let at = |i: usize, j: usize, k: usize| (k * n + j) * n + i;
    let count = n * n * layers;
    let mut entries = Vec::new();
    let mut link = |p: usize, q: usize| {
        entries.extend([(p, q, -1.0), (q, p, -1.0), (p, p, 1.0), (q, q, 1.0)]);
    };
    for k in 0..layers {
        for j in 0..n {
            for i in 0..n {
                if i + 1 < n {
                    link(at(i, j, k), at(i + 1, j, k));
                }
                if j + 1 < n {
                    link(at(i, j, k), at(i, j + 1, k));
                }
                if k + 1 < layers {
                    link(at(i, j, k), at(i, j, k + 1));
                }
            }
        }
    }
    entries.extend((0..count).map(|p| (p, p, shift)));
    SparseMatrix::from_triplets(count, count, &entries).unwrap()
}

fn waves(count: usize) -> Vec<f64> {
    (0..count).map(|i| ((i * i) as f64 * 0.37).sin()).collect()
}

fn largest_difference(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| (x - y).abs()).fold(0.0, |m, d| if d > m { d } else { m })
}

#[test]
fn all_solvers_find_the_solution_for_small_and_large_factors() {
    // The second has enough fill-in to be factored in blocks.
    for matrix in [grid_laplacian(7, 1, 0.5), grid_laplacian(14, 14, 0.5)] {
        let x = waves(matrix.rows());
        let b = matrix.multiply(&x);
        let solvers: [Box<dyn LinearSolver>; 3] = [
            Box::new(Cholesky::new(&matrix).unwrap()),
            Box::new(Ldlt::new(&matrix).unwrap()),
            Box::new(Lu::new(&matrix).unwrap()),
        ];
        for solver in solvers {
            assert_eq!(solver.unknowns(), x.len());
            assert!(largest_difference(&solver.solve(&b).unwrap(), &x) < 1e-12);
            let mut many = [b.clone(), matrix.multiply(&b), b.clone()].concat();
            solver.solve_in_place(&mut many).unwrap();
            assert!(largest_difference(&many[b.len()..2 * b.len()], &b) < 1e-11);
            assert!(largest_difference(&many[2 * b.len()..], &x) < 1e-12);
        }
    }
}

#[test]
fn any_order_gives_the_same_solution_and_its_own_fill() {
    let matrix = grid_laplacian(20, 1, 1.0);
    let x = waves(matrix.rows());
    let b = matrix.multiply(&x);
    let backwards = Ordering::Given((0..matrix.rows()).rev().collect());
    let mut fill = Vec::new();
    for ordering in [Ordering::MinimumDegree, Ordering::Natural, backwards] {
        let analysis = Analysis::new(&matrix, &ordering).unwrap();
        fill.push(analysis.factor_nonzeros());
        let solver = Cholesky::with(&analysis, &matrix).unwrap();
        assert!(largest_difference(&solver.solve(&b).unwrap(), &x) < 1e-12);
    }
    assert!(fill[0] < fill[1], "{fill:?}");
    let wrong =
        [Ordering::Given(vec![0; 400]), Ordering::Given(vec![0, 1]), Ordering::Given((1..=400).collect())];
    for ordering in wrong {
        assert!(Analysis::new(&matrix, &ordering).is_err(), "{ordering:?}");
    }
}

#[test]
fn an_analysis_serves_all_matrices_of_its_pattern() {
    let first = grid_laplacian(9, 2, 0.1);
    let analysis = Analysis::new(&first, &Ordering::MinimumDegree).unwrap();
    let second = grid_laplacian(9, 2, 3.0);
    let x = waves(second.rows());
    let solver = Cholesky::with(&analysis, &second).unwrap();
    assert!(largest_difference(&solver.solve(&second.multiply(&x)).unwrap(), &x) < 1e-13);
    let other = Cholesky::with(&analysis, &grid_laplacian(9, 1, 1.0));
    assert_eq!(other.unwrap_err(), SolveError::OtherPattern);
}

#[test]
fn singular_matrices_are_refused_by_lu_and_badly_scaled_ones_are_not() {
    let dense = |rows: &[&[f64]]| {
        let entries = rows.iter().enumerate();
        let entries: Vec<_> =
            entries.flat_map(|(i, row)| row.iter().enumerate().map(move |(j, &x)| (i, j, x))).collect();
        SparseMatrix::from_triplets(rows.len(), rows.len(), &entries).unwrap()
    };
    let singular = [
        dense(&[&[1.0, 2.0], &[2.0, 4.0]]),
        dense(&[&[0.1, 0.3], &[0.2, 0.6]]),
        dense(&[&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0], &[7.0, 8.0, 9.0]]),
        dense(&[&[1.0, 2e150, 3e-150], &[4.0, 5e150, 6e-150], &[7.0, 8e150, 9e-150]]),
        dense(&[&[0.0, 0.0], &[0.0, 0.0]]),
        grid_laplacian(6, 1, 0.0),
        grid_laplacian(14, 14, 0.0),
    ];
    for matrix in singular {
        let error = Lu::new(&matrix).unwrap_err();
        assert!(matches!(error, SolveError::Singular { .. }), "{error}");
    }
    let scaled = [
        dense(&[&[1.0, 0.0], &[0.0, 1e-200]]),
        dense(&[&[1.0, 1e20], &[1.0, -1e20]]),
        dense(&[&[1.0, 1.0], &[0.0, 1e-20]]),
        dense(&[&[1e-9, 2e-9, 3e-9], &[4e9, 5e9, 6e9], &[7.0, 8.0, 10.0]]),
    ];
    for matrix in scaled {
        let x = [3.0, -2.0, 5.0];
        let x = &x[..matrix.rows()];
        let found = Lu::new(&matrix).unwrap().solve(&matrix.multiply(x)).unwrap();
        // The remaining error is the rounding of the smaller unknowns.
        let residual = largest_difference(&matrix.multiply(&found), &matrix.multiply(x));
        assert!(residual <= 1e-14 * matrix.multiply(x).iter().fold(0.0, |m, b| f64::max(m, b.abs())));
    }
}

#[test]
fn dense_factors_solve_for_any_number_of_columns_alike() {
    let n = 37;
    let root: Vec<f64> = waves(n * n).iter().map(|x| x * 0.3).collect();
    // Lower triangular, with a large diagonal.
    let lower = |i: usize, j: usize| match i.cmp(&j) {
        std::cmp::Ordering::Less => 0.0,
        std::cmp::Ordering::Equal => 3.0 + root[i],
        std::cmp::Ordering::Greater => root[j * n + i],
    };
    let product = |i: usize, j: usize| (0..n).map(|k| lower(i, k) * lower(j, k)).sum::<f64>();
    let entries: Vec<f64> = (0..n * n).map(|at| product(at % n, at / n)).collect();
    let factor = DenseCholesky::new(n, entries.clone()).unwrap();
    let x = waves(700 * n);
    let image = |column: &[f64]| {
        (0..n).map(|i| (0..n).map(|j| lower(i, j) * column[j]).sum::<f64>()).collect::<Vec<_>>()
    };
    let images: Vec<f64> = x.chunks_exact(n).flat_map(image).collect();
    let solved = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut columns = images.clone();
        pool.install(|| factor.solve_lower_in_place(&mut columns)).unwrap();
        columns
    };
    let one = solved(1);
    assert!(largest_difference(&one, &x) < 1e-12);
    assert_eq!(one, solved(2));
    let mut indefinite = entries;
    indefinite[5 * n + 5] = -1.0;
    let error = DenseCholesky::new(n, indefinite).unwrap_err();
    assert_eq!(error, SolveError::NotPositiveDefinite { index: 5 });
    assert!(matches!(DenseCholesky::new(3, vec![0.0; 8]), Err(SolveError::Length { expected: 9, .. })));
    assert!(matches!(factor.solve_lower_in_place(&mut [0.0; 36]), Err(SolveError::Length { .. })));
}

#[test]
fn the_failing_pivot_is_named() {
    for (n, layers) in [(6, 1), (14, 14)] {
        let good = grid_laplacian(n, layers, 1.0);
        let wrong = good.rows() / 3;
        let spoil = SparseMatrix::from_triplets(good.rows(), good.rows(), &[(wrong, wrong, -9.0)]).unwrap();
        let matrix = good.combined(1.0, &spoil, 1.0).unwrap();
        // Last in the order, so that it is the only negative pivot.
        let mut order: Vec<usize> = (0..good.rows()).filter(|&i| i != wrong).collect();
        order.push(wrong);
        let analysis = Analysis::new(&matrix, &Ordering::Given(order)).unwrap();
        let error = Cholesky::with(&analysis, &matrix).unwrap_err();
        assert_eq!(error, SolveError::NotPositiveDefinite { index: wrong });
        // Indefinite, and no pivot is zero.
        let x = waves(matrix.rows());
        let solver = Ldlt::with(&analysis, &matrix).unwrap();
        assert!(largest_difference(&solver.solve(&matrix.multiply(&x)).unwrap(), &x) < 1e-10);
    }
}

#[test]
fn what_needs_pivoting_is_said_and_lu_does_it() {
    let matrix = SparseMatrix::from_triplets(2, 2, &[(0, 1, 2.0), (1, 0, 2.0)]).unwrap();
    assert!(matches!(Ldlt::new(&matrix), Err(SolveError::ZeroPivot { .. })));
    assert_eq!(Lu::new(&matrix).unwrap().solve(&[2.0, 6.0]).unwrap(), [3.0, 1.0]);
    let unsymmetric = SparseMatrix::from_triplets(2, 2, &[(0, 0, 1.0), (0, 1, 3.0), (1, 1, 2.0)]).unwrap();
    assert_eq!(Lu::new(&unsymmetric).unwrap().solve(&[7.0, 4.0]).unwrap(), [1.0, 2.0]);
}

#[test]
fn singular_matrices_have_no_solution() {
    let empty_column = SparseMatrix::from_triplets(2, 2, &[(0, 0, 1.0), (1, 0, 1.0)]).unwrap();
    let twice = SparseMatrix::from_triplets(2, 2, &[(0, 0, 1.0), (1, 0, 2.0), (0, 1, 2.0), (1, 1, 4.0)]);
    for matrix in [empty_column, twice.unwrap()] {
        let solved = Lu::new(&matrix).and_then(|lu| lu.solve(&[1.0, 0.0]));
        assert!(matches!(solved, Err(SolveError::Singular { .. })), "{solved:?}");
    }
}

#[test]
fn right_hand_sides_are_checked() {
    let solver = Cholesky::new(&grid_laplacian(2, 1, 1.0)).unwrap();
    let error = solver.solve(&[1.0, 2.0]).unwrap_err();
    assert_eq!(error.to_string(), "found 2 values of the right-hand side, expected 4");
    let error = solver.solve(&[1.0, f64::NAN, 0.0, 0.0]).unwrap_err();
    assert_eq!(error.to_string(), "value 1 of the right-hand side is NaN, expected a finite number");
    assert!(matches!(solver.solve_in_place(&mut [0.0; 6]), Err(SolveError::Length { .. })));
    let wide = SparseMatrix::from_triplets(1, 2, &[]).unwrap();
    assert_eq!(Cholesky::new(&wide).unwrap_err(), SolveError::NotSquare { rows: 1, columns: 2 });
}

#[test]
fn constants_in_the_kernel_are_projected_away() {
    // Two grids that do not meet, and a third whose first unknown is fixed.
    let n = 25;
    let block = grid_laplacian(5, 1, 0.0);
    let entries: Vec<_> = (0..3)
        .flat_map(|k| {
            block.iter().map(move |(i, j, value)| (k * n + i, k * n + j, value)).collect::<Vec<_>>()
        })
        .collect();
    let matrix = SparseMatrix::from_triplets(3 * n, 3 * n, &entries).unwrap();
    let mut fixed = vec![false; 3 * n];
    fixed[2 * n] = true;
    let group: Vec<Option<u32>> = (0..3 * n).map(|i| [Some(0), Some(1), None][i / n]).collect();
    let solver = SemidefiniteCholesky::new(matrix.clone(), &fixed, &group).unwrap();

    let mut x = waves(3 * n);
    solver.project(&mut x);
    assert!(x[2 * n] == 0.0 && x[..n].iter().sum::<f64>().abs() < 1e-14);
    let b = matrix.multiply(&x);
    assert!(largest_difference(&solver.solve(&b).unwrap(), &x) < 1e-13);
    // Components outside the range are ignored.
    let lifted: Vec<f64> = b
        .iter()
        .enumerate()
        .map(|(i, b)| b + [3.0, -5.0, 0.0][i / n] + if i == 2 * n { 7.0 } else { 0.0 })
        .collect();
    assert!(largest_difference(&solver.solve(&lifted).unwrap(), &x) < 1e-12);
    // A kernel that is larger than stated is detected.
    let all: Vec<Option<u32>> = vec![Some(0); 3 * n];
    let one_group = SemidefiniteCholesky::new(matrix.clone(), &vec![false; 3 * n], &all);
    assert!(matches!(one_group, Err(SolveError::NotPositiveDefinite { .. })), "{one_group:?}");
    let short = SemidefiniteCholesky::new(matrix, &[false], &all).unwrap_err();
    assert_eq!(short.to_string(), "found 1 marks of fixed unknowns, expected 75");
}

#[test]
fn nothing_to_solve_is_solved() {
    let matrix = grid_laplacian(1, 1, 0.0);
    let solver = SemidefiniteCholesky::new(matrix, &[false], &[Some(0)]).unwrap();
    assert_eq!(solver.solve(&[4.0]).unwrap(), [0.0]);
    let empty = SparseMatrix::from_triplets(0, 0, &[]).unwrap();
    assert!(SemidefiniteCholesky::new(empty, &[], &[]).unwrap().solve(&[]).unwrap().is_empty());
}

#[test]
fn a_matrix_that_needs_interchanges_is_solved() {
    // Zeros on the diagonal: without interchanges there is no pivot.
    let n = 9;
    let mut matrix = Banded::zeros(n, 2, 1);
    let mut dense = vec![vec![0.0; n]; n];
    let mut put = |row: usize, column: usize, value: f64| {
        matrix.add(row, column, value);
        dense[row][column] += value;
    };
    for row in 0..n {
        for column in row.saturating_sub(2)..(row + 2).min(n) {
            if row != column || row + 1 == n {
                put(row, column, 1.0 + (3 * row + 5 * column) as f64 % 7.0);
            }
        }
    }
    let x: Vec<f64> = (0..n).map(|i| 1.0 - i as f64).collect();
    let mut b: Vec<f64> = dense.iter().map(|row| row.iter().zip(&x).map(|(a, x)| a * x).sum()).collect();
    matrix.solve_in_place(&mut b).expect("a regular matrix");
    for (found, expected) in b.iter().zip(&x) {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
    assert!(matches!(
        Banded::zeros(3, 1, 1).solve_in_place(&mut [1.0; 3]),
        Err(SolveError::Singular { index: 0 })
    ));
}

#[test]
fn an_unsymmetric_system_near_a_symmetric_one() {
    let n = 200;
    let link = |i: usize, tilt: f64| [(i, i + 1, -1.0 - tilt), (i + 1, i, -1.0 + tilt)];
    let matrix = |tilt: f64| {
        let mut entries: Vec<_> = (0..n).map(|i| (i, i, 2.1)).collect();
        entries.extend((0..n - 1).flat_map(|i| link(i, tilt * (i as f64).sin())));
        SparseMatrix::from_triplets(n, n, &entries).unwrap()
    };
    let (symmetric, tilted) = (matrix(0.0), matrix(0.3));
    let expected: Vec<f64> = (0..n).map(|i| (0.1 * i as f64).cos()).collect();
    let b = tilted.multiply(&expected);
    let solver = Cholesky::new(&symmetric).unwrap();
    for restart in [5, 40] {
        let x = gmres(|x| tilted.multiply(x), &solver, &b, 1e-15, restart, 1000).unwrap();
        let error = x.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(error < 1e-13, "{error:e}");
    }
    // With zero steps the result is the solution of the preconditioner's system.
    let x = gmres(|x| tilted.multiply(x), &solver, &b, 1e-15, 5, 0).unwrap();
    assert_eq!(x, solver.solve(&b).unwrap());
}
