//! Optimal medoids by exhaustive search.

/// Largest number of distance evaluations for an exhaustive search.
const MOST_WORK: f64 = 2e7;

/// Whether all choices of medoids can be tried.
pub(super) fn is_small(n: usize, count: usize) -> bool {
    let mut work = (n * count) as f64;
    for i in 0..count {
        work *= (n - i) as f64 / (i + 1) as f64;
        if work > MOST_WORK {
            return false;
        }
    }
    true
}

/// The smallest sum of distances to the nearest of `count` medoids, and the lexicographically first choice that attains it. Tries
/// all choices.
///
/// # Shapes and units
/// A square matrix of distances. Without points, or with more medoids than points, the sum is 0 and there are no medoids.
pub fn optimal_medoids(distances: &[Vec<f64>], count: usize) -> (f64, Vec<usize>) {
    let n = distances.len();
    if count == 0 || count > n {
        return (0.0, Vec::new());
    }
    let mut choice: Vec<usize> = (0..count).collect();
    let mut best = (f64::INFINITY, Vec::new());
    loop {
        let nearest = |row: &Vec<f64>| choice.iter().map(|m| row[*m]).fold(f64::INFINITY, f64::min);
        let sum: f64 = distances.iter().map(nearest).sum();
        if sum < best.0 {
            best = (sum, choice.clone());
        }
        // The next combination in lexicographic order.
        let Some(i) = (0..count).rev().find(|i| choice[*i] < n - count + i) else { return best };
        choice[i] += 1;
        for j in i + 1..count {
            choice[j] = choice[j - 1] + 1;
        }
    }
}
