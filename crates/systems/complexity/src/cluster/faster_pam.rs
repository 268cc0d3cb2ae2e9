//! Local search by swaps of a medoid with another point.

/// The two nearest medoids of a point, as positions in the list, with their distances.
#[derive(Clone, Copy, Debug, Default)]
struct Near {
    first: (usize, f64),
    second: (usize, f64),
}

/// Swaps medoids with other points while that reduces the sum of distances to the nearest medoid. Returns the sum and the medoids.
///
/// # Shapes and units
/// A square matrix of distances, and distinct indices of the initial medoids.
///
/// # Definition
/// Points are tried repeatedly in their order; the best swap with the current point is made at once if it reduces the sum. The
/// search ends when no swap of one medoid reduces the sum.
///
/// # Cost
/// n² for each round over all points, whatever the number of medoids.
///
/// # Source
/// `schubert_fast_2021`, algorithm 3.
pub fn faster_pam(distances: &[Vec<f64>], start: Vec<usize>) -> (f64, Vec<usize>) {
    let n = distances.len();
    let mut medoids = start;
    let k = medoids.len();
    if k <= 1 {
        let sum = |i: usize| -> f64 { distances.iter().map(|row| row[i]).sum() };
        let best = (0..n).min_by(|a, b| sum(*a).total_cmp(&sum(*b)));
        return best.map_or((0.0, medoids), |best| (sum(best), vec![best]));
    }
    let mut near: Vec<Near> = (0..n).map(|o| nearest(distances, &medoids, o)).collect();
    let mut losses = removal(&near, k);
    let (mut last, mut at) = (n, 0);
    let mut tried = 0;
    while tried < n {
        let candidate = at;
        at = (at + 1) % n;
        tried += 1;
        if candidate == last {
            break;
        }
        if medoids.contains(&candidate) {
            continue;
        }
        let mut change = losses.clone();
        let mut gain = 0.0;
        for (o, n) in near.iter().enumerate() {
            let d = distances[o][candidate];
            if d < n.first.1 {
                gain += d - n.first.1;
                change[n.first.0] += n.first.1 - n.second.1;
            } else if d < n.second.1 {
                change[n.first.0] += d - n.second.1;
            }
        }
        let best = (0..k).min_by(|a, b| change[*a].total_cmp(&change[*b])).unwrap_or(0);
        let scale = near.iter().map(|n| n.first.1).sum::<f64>();
        if change[best] + gain < -ROUNDING * scale {
            medoids[best] = candidate;
            near = (0..n).map(|o| nearest(distances, &medoids, o)).collect();
            losses = removal(&near, k);
            last = candidate;
            tried = 0;
        }
    }
    (near.iter().map(|n| n.first.1).sum(), medoids)
}

/// Reductions of the sum below this share are rounding errors, and could repeat forever.
const ROUNDING: f64 = 1e-14;

fn nearest(distances: &[Vec<f64>], medoids: &[usize], o: usize) -> Near {
    let mut near = Near { first: (0, f64::INFINITY), second: (0, f64::INFINITY) };
    for (i, m) in medoids.iter().enumerate() {
        // A medoid belongs to its own cluster, even if another one has the same position.
        let d = if *m == o { -1.0 } else { distances[o][*m] };
        if d < near.first.1 {
            near.second = near.first;
            near.first = (i, d);
        } else if d < near.second.1 {
            near.second = (i, d);
        }
    }
    near.first.1 = near.first.1.max(0.0);
    near
}

/// The increase of the sum when each medoid is removed.
fn removal(near: &[Near], k: usize) -> Vec<f64> {
    let mut losses = vec![0.0; k];
    for n in near {
        losses[n.first.0] += n.second.1 - n.first.1;
    }
    losses
}

/// Medoids chosen greedily, each the one that reduces the sum most.
pub(super) fn greedy(distances: &[Vec<f64>], count: usize) -> Vec<usize> {
    let n = distances.len();
    let mut medoids: Vec<usize> = Vec::with_capacity(count);
    let mut nearest = vec![f64::INFINITY; n];
    while medoids.len() < count {
        let sum = |c: usize| -> f64 { (0..n).map(|o| nearest[o].min(distances[o][c])).sum() };
        let free = (0..n).filter(|c| !medoids.contains(c));
        let Some((_, best)) = free.map(|c| (sum(c), c)).min_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        medoids.push(best);
        for o in 0..n {
            nearest[o] = nearest[o].min(distances[o][best]);
        }
    }
    medoids
}
