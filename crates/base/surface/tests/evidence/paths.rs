//! Distances along edges, and the paths that have them.

use pompeiu_core::VertexId;
use pompeiu_core::mesh::merge;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_surface::{EdgeData, EdgeDistances, EmbeddedSurface, Surface, SurfaceMesh, flat_torus};

#[test]
fn on_the_flat_torus_steps_are_counted() {
    let torus = flat_torus([5.0, 4.0], [5, 4]).unwrap();
    let from = EdgeDistances::from(&torus, &[VertexId(0)]);
    // Two to the right; around the back; one diagonal; against it; two around both backs.
    for (vertex, expected, edges) in
        [(2, 2.0, 2), (4, 1.0, 1), (6, 2.0_f64.sqrt(), 1), (9, 2.0, 2), (13, 2.0 * 2.0_f64.sqrt(), 2)]
    {
        assert!(
            (from.distances[VertexId(vertex)] - expected).abs() < 1e-14,
            "{vertex}: {}",
            from.distances[VertexId(vertex)]
        );
        assert_eq!(from.path_to(&torus, VertexId(vertex)).len(), edges);
    }
}

#[test]
fn the_boundary_is_walked_both_ways() {
    let mesh = SurfaceMesh::from_faces(3, &[[0, 1, 2]]).unwrap();
    let triangle = Surface::from_edge_lengths(mesh, &EdgeData::new(3, vec![3.0, 4.0, 5.0]).unwrap()).unwrap();
    for (source, expected) in [(0, [0.0, 3.0, 5.0]), (1, [3.0, 0.0, 4.0]), (2, [5.0, 4.0, 0.0])] {
        let from = EdgeDistances::from(&triangle, &[VertexId(source)]);
        assert!(from.distances.iter().zip(expected).all(|(d, e)| (d - e).abs() < 1e-14));
        assert_eq!(from.path_to(&triangle, VertexId((source + 1) % 3)).len(), 1);
    }
}

#[test]
fn paths_add_up_and_lead_from_the_nearest_source() {
    let sphere = icosphere(1.0, 2).unwrap();
    let two = merge(&[&sphere, &sphere]).unwrap();
    let embedded = EmbeddedSurface::new(&two).unwrap();
    let surface = embedded.surface();
    let sources = [VertexId(0), VertexId(50)];
    let from = EdgeDistances::from(surface, &sources);
    for v in surface.mesh().vertex_ids() {
        let path = from.path_to(surface, v);
        if surface.mesh().component(v) == 1 {
            assert!(from.distances[v] == f64::INFINITY && path.is_empty());
            continue;
        }
        let length: f64 = path.iter().map(|&edge| surface.edge_length(edge)).sum();
        assert!((length - from.distances[v]).abs() < 1e-14);
        assert!(sources.contains(&v) == path.is_empty());
        // No edge is a short cut.
        for h in surface.mesh().outgoing(v) {
            let length = surface.edge_length(surface.mesh().edge(h));
            let there = from.distances[surface.mesh().head(h)];
            assert!(there <= from.distances[v] + length + 1e-14);
        }
    }
}
