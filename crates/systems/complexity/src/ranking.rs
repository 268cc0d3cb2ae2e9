//! Rankings, and the agreement of two.

use crate::ComplexityError;
use pompeiu_core::mesh::edit::Random;

/// Ranks from the least value to the greatest, starting with 1; tied values share the mean of their ranks.
pub fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|i, j| values[*i].total_cmp(&values[*j]));
    let mut ranks = vec![0.0; values.len()];
    for tied in order.chunk_by(|i, j| values[*i] == values[*j]) {
        let first = tied[0];
        let place = values.iter().filter(|v| **v < values[first]).count();
        for i in tied {
            ranks[*i] = place as f64 + 0.5 * (tied.len() as f64 + 1.0);
        }
    }
    ranks
}

/// Agreement of two rankings of the same items.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Agreement {
    /// Number of items.
    pub count: usize,
    /// Share of items with the same rank in both.
    pub similarity: f64,
    /// Mean absolute difference of ranks.
    pub average_distance: f64,
    /// The average distance divided by the number of items.
    pub normalized_distance: f64,
    /// Kendall's rank correlation τ (b), from −1 to 1.
    pub kendall: f64,
    /// p-value of τ: the share of permutations of one ranking with at least the same |τ|.
    pub kendall_p: f64,
    /// Spearman's rank correlation ρ, from −1 to 1.
    pub spearman: f64,
    /// p-value of ρ: the share of permutations with at least the same |ρ|.
    pub spearman_p: f64,
    /// Number of permutations tried: all for at most 8 items, otherwise a seeded sample that includes the ranking itself.
    pub permutations: usize,
}

/// Up to this many items all permutations are tried.
const MOST_EXACT: usize = 8;

/// Number of sampled permutations.
const SAMPLE: usize = 9999;

/// Seed of the sample.
const SEED: u64 = 2021;

/// Differences of correlations below this are rounding errors.
const ROUNDING: f64 = 1e-12;

/// Compares two rankings, each a list of ranks or of any values that increase with rank.
///
/// # Definition
/// Ranks are those of [`ranks`]. Similarity and distances are defined as in the reports of shape rankings that use them; p-values
/// are two-sided permutation tests.
///
/// # Errors
/// [`ComplexityError::Lengths`] if the lengths differ or are below 2.
///
/// # Cost
/// 10,000 n log n.
pub fn compare_rankings(a: &[f64], b: &[f64]) -> Result<Agreement, ComplexityError> {
    if a.len() != b.len() || a.len() < 2 {
        return Err(ComplexityError::Lengths { a: a.len(), b: b.len() });
    }
    let (a, mut b) = (ranks(a), ranks(b));
    let n = a.len();
    let same = a.iter().zip(&b).filter(|(x, y)| x == y).count();
    let average_distance = a.iter().zip(&b).map(|(x, y)| (x - y).abs()).sum::<f64>() / n as f64;
    let (tau, rho) = (kendall_of_ranks(&a, &b), pearson(&a, &b));
    let (mut least, mut all) = ([0_usize; 2], 0_usize);
    let mut count = |b: &[f64]| {
        let [t, r] = [kendall_of_ranks(&a, b), pearson(&a, b)];
        least[0] += usize::from(t.abs() >= tau.abs() - ROUNDING);
        least[1] += usize::from(r.abs() >= rho.abs() - ROUNDING);
        all += 1;
    };
    if n <= MOST_EXACT {
        permutations(&mut b, &mut count);
    } else {
        count(&b);
        let mut random = Random::new(SEED);
        for _ in 0..SAMPLE {
            for i in (1..n).rev() {
                b.swap(i, random.below(i as u32 + 1) as usize);
            }
            count(&b);
        }
    }
    Ok(Agreement {
        count: n,
        similarity: same as f64 / n as f64,
        average_distance,
        normalized_distance: average_distance / n as f64,
        kendall: tau,
        kendall_p: least[0] as f64 / all as f64,
        spearman: rho,
        spearman_p: least[1] as f64 / all as f64,
        permutations: all,
    })
}

/// Visits every permutation (`heap_permutations_1963`), the list itself first.
fn permutations(list: &mut [f64], each: &mut impl FnMut(&[f64])) {
    each(list);
    let n = list.len();
    let mut counters = vec![0; n];
    let mut i = 1;
    while i < n {
        if counters[i] < i {
            list.swap(if i % 2 == 0 { 0 } else { counters[i] }, i);
            each(list);
            counters[i] += 1;
            i = 1;
        } else {
            counters[i] = 0;
            i += 1;
        }
    }
}

/// Spearman's rank correlation; 0 if all values of one side are tied.
pub fn spearman(a: &[f64], b: &[f64]) -> f64 {
    pearson(&ranks(a), &ranks(b))
}

/// Kendall's τ (b); 0 if all values of one side are tied.
pub fn kendall(a: &[f64], b: &[f64]) -> f64 {
    kendall_of_ranks(&ranks(a), &ranks(b))
}

fn pearson(a: &[f64], b: &[f64]) -> f64 {
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (ma, mb) = (mean(a), mean(b));
    let product = |v: &[f64], mv: f64, w: &[f64], mw: f64| -> f64 {
        v.iter().zip(w).map(|(x, y)| (x - mv) * (y - mw)).sum()
    };
    let scale = (product(a, ma, a, ma) * product(b, mb, b, mb)).sqrt();
    if scale > 0.0 { product(a, ma, b, mb) / scale } else { 0.0 }
}

/// Concordant minus discordant pairs, over the geometric mean of the numbers of pairs that are not tied, in n log n: counts the
/// ranks in `b` that precede each item in the order of `a`.
fn kendall_of_ranks(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|i, j| a[*i].total_cmp(&a[*j]));
    // Ranks are multiples of one half, so twice a rank is an index.
    let index = |x: f64| (2.0 * x) as usize;
    let mut tree = vec![0_i64; 2 * n + 2];
    let mut score = 0_i64;
    let mut before = 0_i64;
    for tied in order.chunk_by(|i, j| a[*i] == a[*j]) {
        for i in tied {
            let below = prefix(&tree, index(b[*i]) - 1);
            let up_to = prefix(&tree, index(b[*i]));
            score += below - (before - up_to);
        }
        for i in tied {
            let mut at = index(b[*i]);
            while at < tree.len() {
                tree[at] += 1;
                at += at & at.wrapping_neg();
            }
        }
        before += tied.len().cast_signed() as i64;
    }
    let untied = |v: &[f64]| {
        let mut sorted = v.to_vec();
        sorted.sort_by(f64::total_cmp);
        let pairs = |count: usize| (count * (count - 1) / 2) as f64;
        pairs(n) - sorted.chunk_by(|x, y| x == y).map(|group| pairs(group.len())).sum::<f64>()
    };
    let scale = (untied(a) * untied(b)).sqrt();
    if scale > 0.0 { score as f64 / scale } else { 0.0 }
}

fn prefix(tree: &[i64], mut at: usize) -> i64 {
    let mut sum = 0;
    while at > 0 {
        sum += tree[at];
        at -= at & at.wrapping_neg();
    }
    sum
}
