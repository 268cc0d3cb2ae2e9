//! Paths and trees along the edges between balls.

use crate::ball::{Ball, distance};
use crate::balls::Medial;
use pompeiu_core::mesh::UnionFind;

impl Medial {
    /// The balls at the ends of the longest of all shortest paths along edges; of several paths, the first. The same ball twice if there
    /// is only one.
    ///
    /// # Cost
    /// O(n³).
    pub fn longest_path(&self) -> [usize; 2] {
        longest_path(&self.balls, &self.edges)
    }

    /// The edges of the minimum spanning tree of all balls, shortest first.
    pub fn spanning_tree(&self) -> Vec<[u32; 2]> {
        spanning_tree(&self.balls, &self.edges)
    }
}

fn longest_path(balls: &[Ball], edges: &[[u32; 2]]) -> [usize; 2] {
    let n = balls.len();
    let mut lengths = vec![f64::INFINITY; n * n];
    for i in 0..n {
        lengths[i * n + i] = 0.0;
    }
    for edge in edges {
        let [a, b] = edge.map(|i| i as usize);
        let length = distance(balls[a].centre, balls[b].centre);
        lengths[a * n + b] = length;
        lengths[b * n + a] = length;
    }
    for k in 0..n {
        for i in 0..n {
            for j in 0..n {
                let through = lengths[i * n + k] + lengths[k * n + j];
                if through < lengths[i * n + j] {
                    lengths[i * n + j] = through;
                }
            }
        }
    }
    let mut best = (-1.0, [0, 0]);
    for i in 0..n {
        for j in i..n {
            let length = lengths[i * n + j];
            if length.is_finite() && length > best.0 {
                best = (length, [i, j]);
            }
        }
    }
    best.1
}

fn spanning_tree(balls: &[Ball], edges: &[[u32; 2]]) -> Vec<[u32; 2]> {
    let length = |edge: &[u32; 2]| distance(balls[edge[0] as usize].centre, balls[edge[1] as usize].centre);
    let mut order = edges.to_vec();
    order.sort_by(|a, b| length(a).total_cmp(&length(b)).then(a.cmp(b)));
    let mut joined = UnionFind::new(balls.len());
    order.retain(|&[a, b]| joined.union(a as usize, b as usize));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_with_a_tail() {
        let at = |x: f64, y: f64| Ball { centre: [x, y, 0.0], radius: 1.0 };
        let balls = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.1), at(0.0, 1.1), at(-3.0, 1.1)];
        let edges = [[0, 1], [1, 2], [2, 3], [0, 3], [3, 4]];
        assert_eq!(longest_path(&balls, &edges), [1, 4]);
        assert_eq!(spanning_tree(&balls, &edges), [[0, 1], [2, 3], [0, 3], [3, 4]]);
        assert_eq!(longest_path(&balls[..1], &[]), [0, 0]);
    }
}
