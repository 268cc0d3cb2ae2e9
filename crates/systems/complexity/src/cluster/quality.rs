//! Quality of clusters: silhouettes, and agreement with known classes.

/// The silhouette (b − a) / max(a, b) of each point, where a is its mean distance to the others of its cluster and b the least mean
/// distance to another cluster; 0 for a point alone in its cluster, and if there is only one cluster.
///
/// # Source
/// `rousseeuw_silhouettes_1987`.
pub fn silhouettes(distances: &[Vec<f64>], labels: &[usize], count: usize) -> Vec<f64> {
    let mut sizes = vec![0_usize; count];
    for label in labels {
        sizes[*label] += 1;
    }
    labels
        .iter()
        .enumerate()
        .map(|(i, own)| {
            let mut sums = vec![0.0; count];
            for (j, label) in labels.iter().enumerate() {
                sums[*label] += distances[i][j];
            }
            if sizes[*own] < 2 {
                return 0.0;
            }
            let a = sums[*own] / (sizes[*own] - 1) as f64;
            let others = (0..count).filter(|c| c != own && sizes[*c] > 0);
            let b = others.map(|c| sums[c] / sizes[c] as f64).fold(f64::INFINITY, f64::min);
            let most = a.max(b);
            if b.is_finite() && most > 0.0 { (b - a) / most } else { 0.0 }
        })
        .collect()
}

/// Largest number of classes for matching with clusters.
const MOST_CLASSES: usize = 8;

/// The share of points whose cluster is matched with their class, under the best one-to-one matching of clusters with classes;
/// `None` for lists of different lengths and for more than 8 classes.
pub fn matched_accuracy(labels: &[usize], classes: &[usize]) -> Option<f64> {
    let table = contingency(labels, classes)?;
    let k = table.len();
    if k > MOST_CLASSES {
        return None;
    }
    // The best sum for each set of classes used so far, cluster by cluster.
    let mut best = vec![0_usize; 1 << k];
    for taken in 1..1_usize << k {
        let row = taken.count_ones() as usize - 1;
        let columns = (0..k).filter(|c| taken >> c & 1 == 1);
        best[taken] = columns.map(|c| best[taken & !(1 << c)] + table[row][c]).max().unwrap_or(0);
    }
    Some(best[(1 << k) - 1] as f64 / labels.len() as f64)
}

/// The Rand index of two partitions, adjusted for chance: 1 where they agree, about 0 where they are unrelated.
///
/// # Source
/// `hubert_comparing_1985`.
pub fn adjusted_rand(labels: &[usize], classes: &[usize]) -> Option<f64> {
    let table = contingency(labels, classes)?;
    let pairs = |n: usize| (n * n.saturating_sub(1) / 2) as f64;
    let cells: f64 = table.iter().flatten().map(|n| pairs(*n)).sum();
    let rows: f64 = table.iter().map(|row| pairs(row.iter().sum())).sum();
    let columns: f64 = (0..table.len()).map(|c| pairs(table.iter().map(|row| row[c]).sum())).sum();
    let expected = rows * columns / pairs(labels.len());
    let most = 0.5 * (rows + columns);
    Some(if most > expected { (cells - expected) / (most - expected) } else { 1.0 })
}

/// The number of points with each label and class, as a square table.
fn contingency(labels: &[usize], classes: &[usize]) -> Option<Vec<Vec<usize>>> {
    if labels.len() != classes.len() || labels.len() < 2 {
        return None;
    }
    let k = 1 + *labels.iter().chain(classes).max()?;
    let mut table = vec![vec![0; k]; k];
    for (label, class) in labels.iter().zip(classes) {
        table[*label][*class] += 1;
    }
    Some(table)
}
