//! Clusters by k-medoids: their centres are shapes of the set.

mod exact;
mod faster_pam;
mod quality;

pub use exact::optimal_medoids;
pub use faster_pam::faster_pam;
pub use quality::{adjusted_rand, matched_accuracy, silhouettes};

use crate::ComplexityError;
use exact::is_small;
use pompeiu_core::mesh::edit::Random;

/// Clusters around medoids.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Clusters {
    /// Number of clusters.
    pub count: usize,
    /// The features for distances, each standardised to mean 0 and standard deviation 1.
    pub features: Vec<String>,
    /// The medoid of each cluster, as an index into `shapes`.
    pub medoids: Vec<usize>,
    /// The cluster of each shape.
    pub labels: Vec<usize>,
    /// The sum of distances from the shapes to the medoids of their clusters.
    pub loss: f64,
    /// Whether no other choice of medoids has a smaller sum, proven by exhaustive search.
    pub is_optimal: bool,
    /// The silhouette of each shape, from −1 to 1: how much nearer it is to its own cluster than to the next one.
    pub silhouettes: Vec<f64>,
    /// Their mean.
    pub silhouette: f64,
}

/// Random starts in addition to the greedy one.
const STARTS: usize = 20;

/// Seed of the starts.
const SEED: u64 = 2021;

/// Clusters rows of features, each standardised to mean 0 and standard deviation 1.
///
/// # Definition
/// Medoids that minimise the sum of Euclidean distances: all choices are tried where they are few; otherwise the best result that
/// [`faster_pam`] reaches from the greedy start and from 20 random ones.
///
/// # Errors
/// [`ComplexityError::Clusters`] for zero clusters, or more than rows.
pub fn cluster(rows: &[Vec<f64>], features: &[String], count: usize) -> Result<Clusters, ComplexityError> {
    let n = rows.len();
    if count < 1 || count > n {
        return Err(ComplexityError::Clusters { clusters: count, shapes: n });
    }
    let distances = distances(&standardised(rows));
    let is_optimal = is_small(n, count);
    let (loss, medoids) = if is_optimal {
        optimal_medoids(&distances, count)
    } else {
        let mut random = Random::new(SEED);
        let mut starts = vec![faster_pam::greedy(&distances, count)];
        starts.extend((0..STARTS).map(|_| sample(&mut random, n, count)));
        let found = starts.into_iter().map(|start| faster_pam(&distances, start));
        found.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default()
    };
    let nearest =
        |i: usize| (0..count).min_by(|a, b| distances[i][medoids[*a]].total_cmp(&distances[i][medoids[*b]]));
    let mut labels: Vec<usize> = (0..n).map(|i| nearest(i).unwrap_or(0)).collect();
    // A medoid belongs to its own cluster, even if another one has the same position.
    for (label, medoid) in medoids.iter().enumerate() {
        labels[*medoid] = label;
    }
    let silhouettes = silhouettes(&distances, &labels, count);
    let silhouette = silhouettes.iter().sum::<f64>() / n as f64;
    Ok(Clusters {
        count,
        features: features.to_vec(),
        medoids,
        labels,
        loss,
        is_optimal,
        silhouettes,
        silhouette,
    })
}

/// Standardises each column to mean 0 and standard deviation 1; constant columns become 0.
fn standardised(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let n = rows.len() as f64;
    let columns = rows.first().map_or(0, Vec::len);
    let scale: Vec<(f64, f64)> = (0..columns)
        .map(|k| {
            let mean = rows.iter().map(|row| row[k]).sum::<f64>() / n;
            let deviation = (rows.iter().map(|row| (row[k] - mean).powi(2)).sum::<f64>() / n).sqrt();
            (mean, deviation)
        })
        .collect();
    let one =
        |x: f64, (mean, deviation): (f64, f64)| if deviation > 0.0 { (x - mean) / deviation } else { 0.0 };
    rows.iter().map(|row| row.iter().zip(&scale).map(|(x, s)| one(*x, *s)).collect()).collect()
}

fn distances(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let distance = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt();
    rows.iter().map(|a| rows.iter().map(|b| distance(a, b)).collect()).collect()
}

/// `count` distinct numbers below n.
fn sample(random: &mut Random, n: usize, count: usize) -> Vec<usize> {
    let mut all: Vec<usize> = (0..n).collect();
    for i in 0..count {
        all.swap(i, i + random.below((n - i) as u32) as usize);
    }
    all.truncate(count);
    all
}
