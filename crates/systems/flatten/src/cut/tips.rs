//! Tips of a surface: local maxima of the average distance from the rest of the surface.

use super::largest;
use pompeiu_core::VertexId;
use pompeiu_surface::{EdgeDistances, Surface};

/// Number of distant vertices that represent the whole surface.
const SOURCES: usize = 24;

/// Smallest distance between two tips, relative to the square root of the area.
const APART: f64 = 0.25;

/// Smallest average distance of a tip, relative to the minimum over the surface.
const PROMINENCE: f64 = 1.15;

/// The local maxima of the average distance to all points, along edges; most prominent first.
///
/// # Definition
/// The average is over 24 vertices, each the farthest from those before, weighted by the area that is nearest to it. A local maximum
/// counts if it exceeds 1.15 times the least average, and lies at least a quarter of the square root of the area from those before.
///
/// # Source
/// `zhang_feature_2005` for the average geodesic distance.
pub(crate) fn tips(surface: &Surface) -> Vec<VertexId> {
    let mesh = surface.mesh();
    let areas = surface.vertex_areas();
    let n = mesh.vertices();
    let lengths = surface.edge_lengths();
    let distances = |v: VertexId| EdgeDistances::along(surface, &[v], |edge| lengths[edge]).distances;
    let mut nearest = vec![f64::INFINITY; n];
    let mut owner = vec![0_usize; n];
    let mut fields = Vec::with_capacity(SOURCES);
    // The first one only determines the second.
    let mut source = VertexId(largest(&distances(VertexId(0))) as u32);
    for k in 0..SOURCES.min(n) {
        let from = distances(source);
        for v in 0..n {
            if from[VertexId(v as u32)] < nearest[v] {
                nearest[v] = from[VertexId(v as u32)];
                owner[v] = k;
            }
        }
        fields.push(from);
        source = VertexId(largest(&nearest) as u32);
    }
    let mut weights = vec![0.0; fields.len()];
    for v in mesh.vertex_ids() {
        weights[owner[v.index()]] += areas[v];
    }
    let mut average = vec![0.0; n];
    for (field, weight) in fields.iter().zip(&weights) {
        for (sum, distance) in average.iter_mut().zip(field) {
            *sum += weight * distance;
        }
    }
    let least = average.iter().copied().fold(f64::INFINITY, f64::min);
    let is_maximum = |v: VertexId| {
        let around = mesh.outgoing(v).flat_map(|h| [mesh.head(h), mesh.tail(h.previous())]);
        average[v.index()] > PROMINENCE * least
            && around.into_iter().all(|w| average[w.index()] <= average[v.index()])
    };
    let mut candidates: Vec<VertexId> = mesh.vertex_ids().filter(|&v| is_maximum(v)).collect();
    candidates.sort_by(|a, b| average[b.index()].total_cmp(&average[a.index()]));
    let apart = APART * surface.area().sqrt();
    let mut tips = Vec::new();
    let mut covered = vec![false; n];
    for v in candidates {
        if covered[v.index()] {
            continue;
        }
        tips.push(v);
        for (covered, distance) in covered.iter_mut().zip(&distances(v)) {
            *covered |= *distance < apart;
        }
    }
    tips
}
