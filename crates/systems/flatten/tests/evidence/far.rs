//! Successive cuts to the farthest vertex: each is the farthest, and the stopping rule applies.

use super::surface;
use pompeiu_core::VertexId;
use pompeiu_core::mesh::{displace_at_random, shapes};
use pompeiu_flatten::{CutError, CutOptions, CutStrategy, choose_cut};
use pompeiu_surface::{EdgeData, EdgeDistances, EmbeddedSurface};

fn chosen(surface: &EmbeddedSurface, strategy: CutStrategy, spread: Option<f64>) -> EdgeData<bool> {
    choose_cut(surface, &CutOptions { strategy, spread, ..CutOptions::default() }).unwrap()
}

fn touched(surface: &EmbeddedSurface, cut: &EdgeData<bool>) -> Vec<VertexId> {
    let mesh = surface.mesh();
    let edges = mesh.edge_ids().filter(|&edge| cut[edge]);
    let mut ends: Vec<VertexId> = edges.flat_map(|edge| mesh.ends(edge)).collect();
    ends.sort_unstable();
    ends.dedup();
    ends
}

#[test]
fn each_cut_reaches_the_vertex_that_was_farthest() {
    let surface = surface(&displace_at_random(&shapes::torus(2.0, 0.7, 20, 12).unwrap(), 0.03, 7).unwrap());
    let place = |v: VertexId| glam::DVec3::from_array(surface.positions()[v]);
    for cuts in 1..6 {
        for strategy in [|cuts| CutStrategy::Euclidean { cuts }, |cuts| CutStrategy::Geodesic { cuts }] {
            // The first cuts make a disk; the next goes to the farthest vertex.
            let before = touched(&surface, &chosen(&surface, strategy(cuts), None));
            let after = touched(&surface, &chosen(&surface, strategy(cuts + 1), None));
            let distances: Vec<f64> = if strategy(1).name() == "geodesic" {
                EdgeDistances::from(surface.surface(), &before).distances.into_vec()
            } else {
                let near =
                    |v| before.iter().map(|&w| place(v).distance(place(w))).fold(f64::INFINITY, f64::min);
                surface.mesh().vertex_ids().map(near).collect()
            };
            let most = distances.iter().copied().fold(0.0, f64::max);
            assert!(after.iter().any(|v| distances[v.index()] == most), "{} {cuts}", strategy(1).name());
        }
    }
}

#[test]
fn cuts_go_on_until_distances_spread_no_more_than_asked() {
    let surface = surface(&shapes::icosphere(1.0, 3).unwrap());
    let spread = |cut: &EdgeData<bool>| {
        let distances = EdgeDistances::from(surface.surface(), &touched(&surface, cut)).distances;
        let (areas, total) = (surface.surface().vertex_areas(), surface.surface().area());
        let mean = distances.iter().zip(areas.iter()).map(|(d, a)| d * a).sum::<f64>() / total;
        let terms = distances.iter().zip(areas.iter()).map(|(d, a)| (d - mean) * (d - mean) * a);
        (terms.sum::<f64>() / total / total).sqrt()
    };
    for strategy in [|cuts| CutStrategy::Euclidean { cuts }, |cuts| CutStrategy::Geodesic { cuts }] {
        let spreads: Vec<f64> = (1..9).map(|cuts| spread(&chosen(&surface, strategy(cuts), None))).collect();
        let asked = spreads[5] * 1.0001;
        let first = spreads.iter().position(|s| *s <= asked).unwrap();
        assert!(first > 1 && spreads[0] > 1.5 * asked, "{spreads:?}");
        let cut = chosen(&surface, strategy(100), Some(asked));
        assert!(cut == chosen(&surface, strategy(first + 1), None), "{spreads:?}");
        // The given number is a maximum.
        assert!(chosen(&surface, strategy(1), Some(asked)) == chosen(&surface, strategy(1), None));
    }
    for spread in [0.0, f64::NAN, f64::INFINITY] {
        let options = CutOptions {
            strategy: CutStrategy::Geodesic { cuts: 9 },
            spread: Some(spread),
            ..CutOptions::default()
        };
        assert!(matches!(choose_cut(&surface, &options), Err(CutError::Spread { .. })), "{spread}");
    }
}
