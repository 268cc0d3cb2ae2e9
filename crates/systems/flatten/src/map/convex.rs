//! Convex combination maps: each inner vertex is a weighted mean of its neighbours.

use super::weights::Link;
use crate::FlattenError;
use pompeiu_core::VertexId;
use pompeiu_core::mesh::VertexData;
use pompeiu_core::run::Instant;
use pompeiu_solve::{Analysis, Cholesky, ElementPattern, FIXED, LinearSolver, Ordering, gmres};
use pompeiu_surface::SurfaceMesh;
use pompeiu_surface::plane::Vec2;
use std::time::Duration;

/// Residual at which a system with asymmetric weights counts as solved, relative to the rounding of a position times the sum of the
/// weights around it. Smaller residuals cannot be reached.
const RESIDUAL: f64 = 2.0 * f64::EPSILON;

/// Steps of GMRES between restarts, and in all.
const RESTART: usize = 40;
const MOST_STEPS: usize = 400;

/// The linear systems of a disk with a fixed boundary: one pattern, analysed once, for any weights of the same edges.
pub(crate) struct ConvexSystem {
    /// The unknown of each vertex.
    unknowns: Vec<u32>,
    inside: Vec<VertexId>,
    ends: Vec<[u32; 2]>,
    pattern: ElementPattern<2>,
    analysis: Option<Analysis>,
    /// Time spent in factorizations, and in solves.
    pub(crate) factor: Duration,
    pub(crate) solve: Duration,
}

impl ConvexSystem {
    /// The system of a disk with these edges.
    pub(crate) fn new(mesh: &SurfaceMesh, links: &[Link]) -> Result<Self, FlattenError> {
        let mut unknowns = vec![FIXED; mesh.vertices()];
        let inside: Vec<VertexId> = mesh.vertex_ids().filter(|&v| !mesh.is_boundary_vertex(v)).collect();
        for (i, v) in inside.iter().enumerate() {
            unknowns[v.index()] = i as u32;
        }
        let ends: Vec<[u32; 2]> = links.iter().map(|link| link.ends).collect();
        let elements: Vec<[u32; 2]> = ends.iter().map(|ends| ends.map(|v| unknowns[v as usize])).collect();
        let pattern = ElementPattern::new(inside.len(), &elements)?;
        Ok(Self {
            unknowns,
            inside,
            ends,
            pattern,
            analysis: None,
            factor: Duration::ZERO,
            solve: Duration::ZERO,
        })
    }

    fn factor(&mut self, weights: &[f64]) -> Result<Cholesky, FlattenError> {
        let start = Instant::now();
        let matrix = self.pattern.assemble(&vec![0.0; self.inside.len()], |m| {
            let w = weights[m];
            [[w, -w], [-w, w]]
        })?;
        let analysis = match &self.analysis {
            Some(analysis) => analysis,
            None => self.analysis.insert(Analysis::new(&matrix, &Ordering::MinimumDegree)?),
        };
        let factor = Cholesky::with(analysis, &matrix)?;
        self.factor += start.elapsed();
        Ok(factor)
    }

    /// Solves for the inner vertices with symmetric weights.
    pub(crate) fn balance(&mut self, weights: &[f64], uv: &mut VertexData<Vec2>) -> Result<(), FlattenError> {
        let n = self.inside.len();
        if n == 0 {
            return Ok(());
        }
        let factor = self.factor(weights)?;
        let start = Instant::now();
        let mut columns = vec![0.0; 2 * n];
        for (&[a, b], &w) in self.ends.iter().zip(weights) {
            for (inside, fixed) in [(a, b), (b, a)] {
                let (i, j) = (self.unknowns[inside as usize], self.unknowns[fixed as usize]);
                if i != FIXED && j == FIXED {
                    for k in 0..2 {
                        columns[k * n + i as usize] += w * uv[VertexId(fixed)][k];
                    }
                }
            }
        }
        factor.solve_in_place(&mut columns)?;
        for (i, &v) in self.inside.iter().enumerate() {
            uv[v] = [columns[i], columns[n + i]];
        }
        self.solve += start.elapsed();
        Ok(())
    }

    /// Solves for the inner vertices with asymmetric weights.
    ///
    /// GMRES, preconditioned by the factor for the symmetric means of the weights.
    pub(crate) fn balance_unsymmetric(
        &mut self,
        links: &[Link],
        uv: &mut VertexData<Vec2>,
    ) -> Result<(), FlattenError> {
        let n = self.inside.len();
        if n == 0 {
            return Ok(());
        }
        let symmetric: Vec<f64> = links.iter().map(Link::symmetric).collect();
        let factor = self.factor(&symmetric)?;
        let start = Instant::now();
        let mut sums = vec![0.0; n];
        // The weights around each unknown, row by row, and the contribution of fixed neighbours.
        let mut right = [vec![0.0; n], vec![0.0; n]];
        let mut counts = vec![0_usize; n + 1];
        let sides = || {
            links.iter().flat_map(|link| {
                let ([a, b], [ab, ba]) = (link.ends, link.weights);
                [(a, b, ab), (b, a, ba)]
            })
        };
        for (v, w, weight) in sides() {
            let (i, j) = (self.unknowns[v as usize], self.unknowns[w as usize]);
            if i == FIXED {
                continue;
            }
            sums[i as usize] += weight;
            if j == FIXED {
                for k in 0..2 {
                    right[k][i as usize] += weight * uv[VertexId(w)][k];
                }
            } else {
                counts[i as usize + 1] += 1;
            }
        }
        for i in 0..n {
            counts[i + 1] += counts[i];
        }
        let mut next = counts.clone();
        let mut entries = vec![(0_u32, 0.0); counts[n]];
        for (v, w, weight) in sides() {
            let (i, j) = (self.unknowns[v as usize], self.unknowns[w as usize]);
            if i != FIXED && j != FIXED {
                entries[next[i as usize]] = (j, weight);
                next[i as usize] += 1;
            }
        }
        let apply = |x: &[f64]| -> Vec<f64> {
            (0..n)
                .map(|i| {
                    let around = entries[counts[i]..counts[i + 1]].iter();
                    sums[i] * x[i] - around.map(|&(j, weight)| weight * x[j as usize]).sum::<f64>()
                })
                .collect()
        };
        let mut columns = Vec::with_capacity(2);
        let norm = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
        for (k, side) in right.iter().enumerate() {
            // What fixed neighbours contribute may cancel exactly; no tolerance is relative to that.
            if norm(side) == 0.0 {
                columns.push(vec![0.0; n]);
                continue;
            }
            // Means lie between the fixed positions.
            let farthest = uv.iter().map(|p| p[k].abs()).fold(0.0, |most, x| if x > most { x } else { most });
            let tolerance = RESIDUAL * farthest * norm(&sums) / norm(side);
            columns.push(gmres(apply, &factor, side, tolerance, RESTART, MOST_STEPS)?);
        }
        for (i, &v) in self.inside.iter().enumerate() {
            uv[v] = [columns[0][i], columns[1][i]];
        }
        self.solve += start.elapsed();
        Ok(())
    }
}
