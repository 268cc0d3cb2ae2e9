//! Paths along which a chart may be cut.

use super::layout::{Layout, Patch};
use pompeiu_core::VertexId;
use pompeiu_core::mesh::VertexData;
use pompeiu_surface::{EdgeDistances, EdgeId};

/// Powers of the potential by which edges cost less: shortest paths, and paths along ridges.
const POWERS: [i32; 3] = [0, 1, 2];

/// What is added to the potential relative to its greatest value, so that costs are bounded.
const FLOOR: f64 = 0.1;

/// Least distance between the ends of a path through a chart, relative to its length.
const STRAIGHT: f64 = 0.7;

/// Routes of a chart that are tried: those that promise most.
const MOST_ROUTES: usize = 12;

/// Least costs of paths within a chart, from some of its vertices; they end on its outline.
fn paths(
    layout: &Layout<'_>,
    chart: u32,
    sources: &[VertexId],
    cost: impl Fn(EdgeId) -> f64,
) -> EdgeDistances {
    let mesh = layout.mesh();
    let is_inside =
        |edge| !layout.is_side(edge) && layout.chart_of[mesh.edge_halfedge(edge).face().index()] == chart;
    let cost = |edge| if is_inside(edge) { cost(edge) } else { f64::INFINITY };
    EdgeDistances::through(layout.surface, sources, cost, |v| !layout.is_fixed(v))
}

/// The potential of a chart at vertices, without its sign; zero elsewhere.
struct Heights {
    values: VertexData<f64>,
    greatest: f64,
}

impl Heights {
    fn new(layout: &Layout<'_>, patch: &Patch) -> Self {
        let mut values = VertexData::filled(layout.mesh().vertices(), 0.0);
        let mut greatest: f64 = 0.0;
        for &(v, u) in &patch.potential.values {
            values[v] = u.abs();
            greatest = if u.abs() > greatest { u.abs() } else { greatest };
        }
        Self { values, greatest }
    }

    /// What an edge costs that is the cheaper the higher it lies, by a power.
    fn cost(&self, layout: &Layout<'_>, edge: EdgeId, power: i32) -> f64 {
        let [a, b] = layout.mesh().ends(edge).map(|v| self.values[v]);
        let relative = if self.greatest > 0.0 { 0.5 * (a + b) / self.greatest } else { 0.0 };
        layout.lengths[edge] * (relative + FLOOR).powi(-power)
    }
}

/// The vertex with the least or the greatest finite value.
fn best(
    vertices: &[VertexId],
    sign: f64,
    value: impl Fn(VertexId) -> f64,
    is_meant: impl Fn(VertexId) -> bool,
) -> Option<VertexId> {
    let mut best: Option<(f64, VertexId)> = None;
    for &v in vertices {
        let at = sign * value(v);
        if at.is_finite() && best.is_none_or(|(least, _)| at < least) && is_meant(v) {
            best = Some((at, v));
        }
    }
    best.map(|(_, v)| v)
}

/// Sets of edges along which a chart may be cut: from places where the potential is great to the outline, the near one and the far one, on
/// one side and on both.
pub(super) fn routes(layout: &Layout<'_>, chart: u32) -> Vec<Vec<EdgeId>> {
    let Some(patch) = layout.chart(chart) else { return Vec::new() };
    let heights = Heights::new(layout, patch);
    if heights.greatest == 0.0 {
        return Vec::new();
    }
    let potential = &heights.values;
    let mesh = layout.mesh();
    let vertices: Vec<VertexId> = patch.potential.values.iter().map(|(v, _)| *v).collect();
    let (outline, inner): (Vec<_>, Vec<_>) = vertices.into_iter().partition(|&v| layout.is_fixed(v));
    let length = |edge: EdgeId| layout.lengths[edge];
    let depth = paths(layout, chart, &outline, length).distances;
    let mut seeds: Vec<VertexId> = [
        best(&inner, -1.0, |v| potential[v], |_| true),
        best(&inner, -1.0, |v| depth[v], |_| true),
        best(&inner, -1.0, |v| potential[v] * depth[v], |_| true),
    ]
    .into_iter()
    .flatten()
    .collect();
    seeds.sort_unstable();
    seeds.dedup();
    let mut routes: Vec<Vec<EdgeId>> = Vec::new();
    for seed in seeds {
        let plain = paths(layout, chart, &[seed], length).distances;
        // The far end, and the end opposite to it.
        let opposite = |end: VertexId, sign: f64, costs: &VertexData<f64>| {
            let from = paths(layout, chart, &[end], length).distances;
            let is_opposite = |v: VertexId| from[v] >= STRAIGHT * (plain[end] + plain[v]);
            best(&outline, sign, |v| costs[v], is_opposite)
        };
        let far = best(&outline, -1.0, |v| plain[v], |_| true);
        let far_opposite = far.and_then(|end| opposite(end, -1.0, &plain));
        for power in POWERS {
            let paths = paths(layout, chart, &[seed], |edge| heights.cost(layout, edge, power));
            let costs = &paths.distances;
            let near = best(&outline, 1.0, |v| costs[v], |_| true);
            let near_opposite = near.and_then(|end| opposite(end, 1.0, costs));
            let to = |end: Option<VertexId>| end.map(|end| paths.path_to(layout.surface, end));
            let [near, near_opposite, far, far_opposite] = [near, near_opposite, far, far_opposite].map(to);
            for ends in [
                [&near, &None],
                [&far, &None],
                [&near, &near_opposite],
                [&far, &far_opposite],
                [&near, &far],
                [&near, &far_opposite],
            ] {
                let mut route: Vec<EdgeId> = ends.into_iter().flatten().flatten().copied().collect();
                route.sort_unstable();
                route.dedup();
                if !route.is_empty() {
                    routes.push(route);
                }
            }
        }
    }
    routes.sort_unstable();
    routes.dedup();
    // Along a cut the potential vanishes, and beside it about as far as it is from the outline.
    let gain = |route: &[EdgeId]| {
        let of_edge = |&edge: &EdgeId| {
            let [u, d] = [potential, &depth].map(|values| {
                let [a, b] = mesh.ends(edge).map(|v| values[v]);
                0.5 * (a + b)
            });
            length(edge) * u * u * d
        };
        route.iter().map(of_edge).sum::<f64>() / route.iter().map(|&edge| length(edge)).sum::<f64>()
    };
    let mut ranked: Vec<(f64, Vec<EdgeId>)> = routes.into_iter().map(|route| (gain(&route), route)).collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
    // Routes to one side and routes through the chart are different in kind.
    let mut left = [MOST_ROUTES, MOST_ROUTES / 2];
    let mut is_kept = |route: &[EdgeId]| {
        let ends = route.iter().flat_map(|&edge| mesh.ends(edge)).filter(|&v| layout.is_fixed(v)).count();
        let kind = &mut left[usize::from(ends < 2)];
        *kind = kind.saturating_sub(1);
        *kind > 0
    };
    ranked.into_iter().map(|(_, route)| route).filter(|route| is_kept(route)).collect()
}

/// Paths within a chart between two vertices of its outline.
pub(super) fn between(layout: &Layout<'_>, chart: u32, ends: [VertexId; 2]) -> Vec<Vec<EdgeId>> {
    let Some(patch) = layout.chart(chart) else { return Vec::new() };
    let heights = Heights::new(layout, patch);
    let path = |power: i32| {
        let from = paths(layout, chart, &[ends[0]], |edge| heights.cost(layout, edge, power));
        let mut path = from.path_to(layout.surface, ends[1]);
        path.sort_unstable();
        path
    };
    let mut routes: Vec<Vec<EdgeId>> = POWERS.into_iter().map(path).filter(|path| !path.is_empty()).collect();
    routes.dedup();
    routes
}
