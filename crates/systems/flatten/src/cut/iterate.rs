//! Successive cuts, each to the vertex farthest from the existing cut.

use super::costs::Costs;
use super::farthest::distance;
use super::farthest::farthest_pair;
use super::largest;
use super::tree::GrowingCut;
use pompeiu_core::VertexId;
use pompeiu_surface::{EdgeDistances, EmbeddedSurface, Surface};

/// The distance that is maximised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Metric {
    /// Euclidean distance in space.
    Straight,
    /// Distance along the edges of the surface.
    Surface,
}

/// Joins the farthest pair of vertices, then repeatedly the vertex farthest from the cut, until the number of cuts is reached, or
/// the spread of distances from the cut is as small as requested.
pub(super) fn iterate(
    surface: &EmbeddedSurface,
    costs: &Costs,
    cut: &mut GrowingCut<'_>,
    metric: Metric,
    cuts: usize,
    spread: Option<f64>,
) {
    let mut left = cuts;
    if cut.is_empty() {
        let pair = match metric {
            Metric::Straight => pair_in_space(surface, costs),
            Metric::Surface => pair_along(surface.surface(), costs),
        };
        let Some(pair) = pair else { return };
        cut.join(&pair);
        left = left.saturating_sub(1);
    }
    while left > 0 {
        let reached = cut.reached();
        let along = EdgeDistances::from(surface.surface(), &reached).distances;
        if spread.is_some_and(|most| deviation(surface.surface(), &along) <= most) {
            break;
        }
        let from = match metric {
            Metric::Straight => from_in_space(surface, &reached),
            Metric::Surface => along.into_vec(),
        };
        let allowed = |v: VertexId| if costs.forbid(v) { 0.0 } else { from[v.index()] };
        let far: Vec<f64> = surface.mesh().vertex_ids().map(allowed).collect();
        let farthest = VertexId(largest(&far) as u32);
        if far[farthest.index()] <= 0.0 || !cut.join(&[farthest]).is_empty() {
            break;
        }
        left -= 1;
    }
}

fn pair_in_space(surface: &EmbeddedSurface, costs: &Costs) -> Option<[VertexId; 2]> {
    let allowed: Vec<VertexId> = surface.mesh().vertex_ids().filter(|&v| !costs.forbid(v)).collect();
    let points: Vec<[f64; 3]> = allowed.iter().map(|&v| surface.positions()[v]).collect();
    farthest_pair(&points).map(|pair| pair.map(|i| allowed[i]))
}

/// The vertex farthest from an arbitrary one, and the vertex farthest from that.
fn pair_along(surface: &Surface, costs: &Costs) -> Option<[VertexId; 2]> {
    let first = surface.mesh().vertex_ids().find(|&v| !costs.forbid(v))?;
    let farthest = |from: VertexId| {
        let distances = EdgeDistances::from(surface, &[from]).distances;
        let far = |v: VertexId| if costs.forbid(v) { 0.0 } else { distances[v] };
        VertexId(largest(&surface.mesh().vertex_ids().map(far).collect::<Vec<_>>()) as u32)
    };
    let one = farthest(first);
    let other = farthest(one);
    (one != other).then_some([one, other])
}

fn from_in_space(surface: &EmbeddedSurface, reached: &[VertexId]) -> Vec<f64> {
    let place = |v: VertexId| surface.positions()[v];
    let nearest = |v: VertexId| {
        reached
            .iter()
            .map(|&w| distance(place(v), place(w)))
            .fold(f64::INFINITY, |a, b| if b < a { b } else { a })
    };
    surface.mesh().vertex_ids().map(nearest).collect()
}

/// The standard deviation of distances over the area, relative to the square root of the area.
fn deviation(surface: &Surface, distances: &[f64]) -> f64 {
    let (areas, total) = (surface.vertex_areas(), surface.area());
    let mean_of = |power: i32| {
        let terms = distances.iter().zip(areas.iter()).map(|(d, area)| area * d.powi(power));
        terms.fold(0.0, |sum, x| sum + x) / total
    };
    let mean = mean_of(1);
    let variance = mean_of(2) - mean * mean;
    if variance > 0.0 { variance.sqrt() / total.sqrt() } else { 0.0 }
}
