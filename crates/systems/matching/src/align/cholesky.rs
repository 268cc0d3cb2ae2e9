//! Small dense systems.

/// Solves a symmetric positive definite system, given its lower triangle; `None` if a pivot is not positive or a number overflows.
///
/// # Source
/// The Cholesky factorization row by row, `golub_matrix_2013`, section 4.2.
pub(super) fn solve<const N: usize>(matrix: &[[f64; N]; N], right: &[f64; N]) -> Option<[f64; N]> {
    let mut factor = *matrix;
    for i in 0..N {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            let rest = factor[i][j] - known;
            if i > j {
                factor[i][j] = rest / factor[j][j];
            } else if rest > 0.0 {
                factor[i][i] = rest.sqrt();
            } else {
                return None;
            }
        }
    }
    let mut x = *right;
    for i in 0..N {
        let known: f64 = (0..i).map(|k| factor[i][k] * x[k]).sum();
        x[i] = (x[i] - known) / factor[i][i];
    }
    for i in (0..N).rev() {
        let known: f64 = (i + 1..N).map(|k| factor[k][i] * x[k]).sum();
        x[i] = (x[i] - known) / factor[i][i];
    }
    x.iter().all(|x| x.is_finite()).then_some(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::Random;

    #[test]
    fn random_systems_are_solved() {
        let mut random = Random::new(5);
        for _ in 0..500 {
            let root: [[f64; 6]; 6] = std::array::from_fn(|_| std::array::from_fn(|_| random.signed_unit()));
            let product = |i: usize, j: usize| (0..6).map(|k| root[i][k] * root[j][k]).sum::<f64>();
            let shift = |i: usize, j: usize| if i == j { 0.01 } else { 0.0 };
            let matrix: [[f64; 6]; 6] =
                std::array::from_fn(|i| std::array::from_fn(|j| product(i, j) + shift(i, j)));
            let expected: [f64; 6] = std::array::from_fn(|_| random.signed_unit());
            let right = matrix.map(|row| row.iter().zip(&expected).map(|(a, x)| a * x).sum());
            // The upper triangle is ignored.
            let lower =
                std::array::from_fn(|i| std::array::from_fn(|j| if j > i { f64::NAN } else { matrix[i][j] }));
            let found = solve(&lower, &right).unwrap();
            assert!(
                found.iter().zip(&expected).all(|(x, y)| (x - y).abs() < 1e-10),
                "{found:?} {expected:?}"
            );
        }
    }

    #[test]
    fn what_is_not_definite_is_not_solved() {
        assert_eq!(solve(&[[1.0, 0.0], [1.0, 1.0]], &[1.0, 1.0]), None);
        assert_eq!(solve(&[[-1.0]], &[1.0]), None);
        assert_eq!(solve(&[[f64::NAN]], &[1.0]), None);
        assert_eq!(solve(&[[1e-300]], &[1e300]), None);
    }
}
