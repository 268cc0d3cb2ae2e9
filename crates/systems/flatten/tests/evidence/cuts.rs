//! Cuts: numbers of copies, gluing restores the input, and the farthest pair agrees with an exhaustive search.

use super::{real_mesh, surface, zoo};
use pompeiu_core::mesh::{Random, displace_at_random, merge, shapes};
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_flatten::{CutError, CutOptions, CutStrategy, choose_cut, farthest_pair, open};
use pompeiu_surface::{EdgeData, EdgeDistances, EmbeddedSurface, SurfaceMesh};
use pompeiu_testkit::effort::cases;

/// A random tree of edges on a surface, grown from a random vertex.
fn random_tree(mesh: &SurfaceMesh, edges: usize, random: &mut Random) -> EdgeData<bool> {
    let mut cut = EdgeData::filled(mesh.edges(), false);
    let mut reached = vec![VertexId(random.below(mesh.vertices() as u32))];
    let mut count = 0;
    while count < edges {
        let from = reached[random.below(reached.len() as u32) as usize];
        let out: Vec<_> = mesh.outgoing(from).collect();
        let h = out[random.below(out.len() as u32) as usize];
        if !reached.contains(&mesh.head(h)) {
            reached.push(mesh.head(h));
            cut[mesh.edge(h)] = true;
            count += 1;
        }
    }
    cut
}

#[test]
fn trees_open_a_sphere_into_a_disk_and_glue_back() {
    let mesh = shapes::icosphere(1.0, 1).unwrap();
    let sphere = SurfaceMesh::new(&mesh).unwrap();
    let mut random = Random::new(1);
    for _ in 0..cases(10_000) {
        let edges = 2 + random.below(40) as usize;
        let cut = random_tree(&sphere, edges, &mut random);
        let opened = open(&sphere, &cut).unwrap();
        opened.check_disks().unwrap();
        let after = opened.mesh();
        assert_eq!(after.vertices(), sphere.vertices() + edges - 1);
        assert_eq!(after.boundary_loop(after.boundary_loops()[0]).count(), 2 * edges);
        assert_eq!(opened.glued_faces(), mesh.faces());
        assert!(opened.vertex_map().iter().take(sphere.vertices()).copied().eq(sphere.vertex_ids()));
        let mut copies = vec![0; sphere.vertices()];
        opened.vertex_map().iter().for_each(|v| copies[v.index()] += 1);
        for v in sphere.vertex_ids() {
            let cut_edges = sphere.outgoing(v).filter(|&h| cut[sphere.edge(h)]).count();
            assert_eq!(copies[v.index()], cut_edges.max(1), "vertex {v}");
        }
    }
}

#[test]
fn on_the_boundary_each_cut_edge_makes_one_copy_more() {
    let disk = SurfaceMesh::new(&shapes::disk(1.0, 12, 4).unwrap()).unwrap();
    let mut random = Random::new(2);
    for _ in 0..100 {
        let cut = EdgeData::from_fn(disk.edges(), |_| random.below(4) == 0);
        let opened = match open(&disk, &cut) {
            Ok(opened) => opened,
            Err(error) => {
                assert!(matches!(error, CutError::SingleEdge { .. }), "{error}");
                continue;
            }
        };
        let mut copies = vec![0; disk.vertices()];
        opened.vertex_map().iter().for_each(|v| copies[v.index()] += 1);
        for v in disk.vertex_ids() {
            let is_cut = |&h: &_| cut[disk.edge(h)] && !disk.is_boundary_edge(disk.edge(h));
            // The last edge of a fan at the boundary is a boundary edge, and no outgoing half-edge.
            let cut_edges = disk.outgoing(v).filter(is_cut).count();
            let expected = if disk.is_boundary_vertex(v) { cut_edges + 1 } else { cut_edges.max(1) };
            assert_eq!(copies[v.index()], expected, "vertex {v}");
        }
    }
}

#[test]
fn every_genus_and_any_number_of_loops_become_one_disk() {
    for genus in [0, 1, 2, 5] {
        for loops in [0, 1, 2, 4] {
            let mesh = zoo(genus, loops);
            let surface = surface(&mesh);
            assert_eq!(
                (surface.mesh().genus(), surface.mesh().boundary_loops().len()),
                (genus as usize, loops)
            );
            for strategy in [CutStrategy::Auto, CutStrategy::Tips, CutStrategy::Euclidean { cuts: 3 }] {
                let options = CutOptions { strategy, ..CutOptions::default() };
                let cut = choose_cut(&surface, &options).unwrap();
                let opened = open(surface.mesh(), &cut).unwrap();
                assert_eq!(opened.glued_faces(), mesh.faces());
            }
        }
    }
}

#[test]
fn a_disk_needs_no_cut_and_a_sphere_has_none_by_genus() {
    let genus = CutOptions { strategy: CutStrategy::Genus, ..CutOptions::default() };
    let disk = surface(&shapes::disk(1.0, 12, 4).unwrap());
    assert!(!choose_cut(&disk, &genus).unwrap().contains(&true));
    let sphere = surface(&shapes::icosphere(1.0, 1).unwrap());
    let error = choose_cut(&sphere, &genus).unwrap_err();
    assert!(matches!(error, CutError::NoDisk { euler_characteristic: 2, boundary_loops: 0, .. }), "{error}");
}

#[test]
fn the_smallest_surfaces_open() {
    let tetrahedron = surface(&shapes::tetrahedron(1.0).unwrap());
    let cut = choose_cut(&tetrahedron, &CutOptions::default()).unwrap();
    assert!(cut.iter().filter(|is_cut| **is_cut).count() >= 2);
    let edge = CutOptions {
        strategy: CutStrategy::Along(vec![vec![VertexId(0), VertexId(1)]]),
        ..CutOptions::default()
    };
    let error = choose_cut(&tetrahedron, &edge).unwrap_err();
    assert_eq!(error, CutError::SingleEdge { ends: [VertexId(0), VertexId(1)] });
}

#[test]
fn several_components_are_cut_each() {
    let torus = shapes::torus(2.0, 0.7, 12, 9).unwrap();
    let both =
        merge(&[&torus, &shapes::icosphere(1.0, 2).unwrap(), &shapes::disk(1.0, 9, 3).unwrap()]).unwrap();
    let surface = surface(&both);
    let cut = choose_cut(&surface, &CutOptions::default()).unwrap();
    let opened = open(surface.mesh(), &cut).unwrap();
    assert_eq!((opened.mesh().components(), opened.mesh().boundary_loops().len()), (3, 3));
    assert_eq!(opened.glued_faces(), both.faces());
}

#[test]
fn named_vertices_and_paths_are_on_the_cut_and_forbidden_ones_are_not() {
    let surface = surface(&shapes::icosphere(1.0, 3).unwrap());
    let mesh = surface.mesh();
    let on_cut = |cut: &EdgeData<bool>, v: u32| {
        mesh.edge_ids().any(|edge| cut[edge] && mesh.ends(edge).contains(&VertexId(v)))
    };
    let mut random = Random::new(3);
    for _ in 0..20 {
        let through: Vec<VertexId> = (0..5).map(|_| VertexId(random.below(642))).collect();
        let forbidden: Vec<VertexId> =
            (0..60).map(|_| VertexId(random.below(642))).filter(|v| !through.contains(v)).collect();
        let options = CutOptions {
            strategy: CutStrategy::Through(through.clone()),
            forbidden: forbidden.clone(),
            ..CutOptions::default()
        };
        let cut = choose_cut(&surface, &options).unwrap();
        assert!(through.iter().all(|v| on_cut(&cut, v.0)) && !forbidden.iter().any(|v| on_cut(&cut, v.0)));
    }
    // A fence around a vertex.
    let around = mesh.outgoing(VertexId(0)).map(|h| mesh.head(h)).collect();
    let options = CutOptions {
        strategy: CutStrategy::Through(vec![VertexId(0), VertexId(400)]),
        forbidden: around,
        ..CutOptions::default()
    };
    assert!(matches!(choose_cut(&surface, &options), Err(CutError::Forbidden { .. })));
    let far = CutOptions { strategy: CutStrategy::Along(vec![vec![VertexId(0), VertexId(400)]]), ..options };
    let error = choose_cut(&surface, &far).unwrap_err();
    assert_eq!(error.to_string(), "no edge joins vertices 0 and 400");
}

/// The least length of a tree that joins some vertices (Steiner tree), by dynamic programming over their subsets.
fn steiner(surface: &EmbeddedSurface, terminals: &[VertexId]) -> f64 {
    let mesh = surface.mesh();
    let from: Vec<_> =
        mesh.vertex_ids().map(|v| EdgeDistances::from(surface.surface(), &[v]).distances).collect();
    let (n, k) = (mesh.vertices(), terminals.len());
    let mut best = vec![vec![f64::INFINITY; n]; 1 << k];
    for (t, terminal) in terminals.iter().enumerate() {
        best[1 << t] = from[terminal.index()].to_vec();
    }
    for set in 1..1_usize << k {
        if set.is_power_of_two() {
            continue;
        }
        let mut part = (set - 1) & set;
        while part > 0 {
            for v in 0..n {
                best[set][v] = best[set][v].min(best[part][v] + best[set ^ part][v]);
            }
            part = (part - 1) & set;
        }
        let met = best[set].clone();
        for v in 0..n {
            best[set][v] = (0..n).map(|w| met[w] + from[w][VertexId(v as u32)]).fold(f64::INFINITY, f64::min);
        }
    }
    best[(1 << k) - 1][0..n].iter().copied().fold(f64::INFINITY, f64::min)
}

#[test]
fn joining_vertices_costs_less_than_twice_the_least() {
    let surface = surface(&displace_at_random(&shapes::icosphere(1.0, 2).unwrap(), 0.1, 5).unwrap());
    let mut random = Random::new(4);
    for _ in 0..cases(24) {
        let mut terminals: Vec<VertexId> = (0..5).map(|_| VertexId(random.below(162))).collect();
        terminals.sort_unstable();
        terminals.dedup();
        let options =
            CutOptions { strategy: CutStrategy::Through(terminals.clone()), ..CutOptions::default() };
        let Ok(cut) = choose_cut(&surface, &options) else { continue };
        let edges = cut.entries().filter(|(_, is_cut)| **is_cut);
        let length: f64 = edges.map(|(edge, _)| surface.surface().edge_length(edge)).sum();
        let least = steiner(&surface, &terminals);
        assert!(least * (1.0 - 1e-12) <= length && length < 2.0 * least, "{length} {least}");
    }
}

#[test]
fn the_farthest_pair_is_that_of_all_pairs() {
    let mut random = Random::new(6);
    let distance_sq =
        |p: [f64; 3], q: [f64; 3]| -> f64 { (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum() };
    for case in 0..100 {
        let n = 2 + random.below(200) as usize;
        let points: Vec<[f64; 3]> = (0..n)
            .map(|_| match case % 3 {
                0 => [random.signed_unit(), random.signed_unit(), random.signed_unit()],
                1 => random.direction(),
                _ => [f64::from(random.below(3)), f64::from(random.below(3)), 0.0],
            })
            .collect();
        let [i, j] = farthest_pair(&points).unwrap();
        let pairs = (0..n).flat_map(|i| (0..i).map(move |j| (i, j)));
        let greatest = pairs.map(|(i, j)| distance_sq(points[i], points[j])).fold(0.0, f64::max);
        assert!(i != j);
        assert_eq!(distance_sq(points[i], points[j]), greatest, "case {case}");
    }
    assert_eq!(farthest_pair(&[[0.0; 3]]), None);
}

#[test]
fn real_meshes_open_into_disks() {
    for name in ["spot.obj", "3holes.off", "fertility.off", "bunny.off"] {
        let Some(mesh) = real_mesh(name) else { continue };
        let surface = surface(&mesh);
        let cut = choose_cut(&surface, &CutOptions::default()).unwrap();
        let opened = open(surface.mesh(), &cut).unwrap();
        assert_eq!(opened.glued_faces(), mesh.faces());
        let length: f64 =
            surface.mesh().edge_ids().filter(|&e| cut[e]).map(|e| surface.surface().edge_length(e)).sum();
        let relative = length / surface.surface().area().sqrt();
        println!("{name}: seam {relative:.2}");
        assert!(relative <= 5.0, "{name}: {relative}");
    }
}

#[test]
fn what_is_no_surface_is_refused() {
    let fan = TriMesh::new(vec![[0.0; 3]; 5], vec![[0, 1, 2], [1, 0, 3], [0, 1, 4]]).unwrap();
    assert!(EmbeddedSurface::new(&fan).is_err());
    let sphere = surface(&shapes::icosphere(1.0, 1).unwrap());
    let options = CutOptions { forbidden: vec![VertexId(42)], ..CutOptions::default() };
    let error = choose_cut(&sphere, &options).unwrap_err();
    assert_eq!(error.to_string(), "there is no vertex 42; there are 42 (the first is 0)");
}

fn follows(strategy: CutStrategy) -> CutOptions {
    CutOptions { strategy, ..CutOptions::default() }
}

#[test]
fn cuts_that_follow_balls_open_surfaces_into_disks() {
    let balls = std::num::NonZeroUsize::new(8).unwrap();
    let strategies = [
        CutStrategy::Medial { balls },
        CutStrategy::MedialTree { balls },
        CutStrategy::Bones { balls, sections: false },
        CutStrategy::Bones { balls, sections: true },
    ];
    for genus in [0, 2] {
        let surface = surface(&zoo(genus, 0));
        for strategy in &strategies {
            let cut = choose_cut(&surface, &follows(strategy.clone())).unwrap();
            let opened = open(surface.mesh(), &cut).unwrap();
            opened.check_disks().unwrap();
            assert_eq!((opened.mesh().components(), opened.mesh().boundary_loops().len()), (1, 1));
        }
    }
    let error = choose_cut(&surface(&zoo(0, 1)), &follows(CutStrategy::Medial { balls })).unwrap_err();
    assert!(matches!(error, CutError::Medial(_)), "{error}");
}

#[test]
fn the_medial_cut_of_a_long_body_runs_from_end_to_end() {
    let balls = std::num::NonZeroUsize::new(6).unwrap();
    let mesh = shapes::uv_sphere(1.0, 24, 32).unwrap();
    let long = TriMesh::new(
        mesh.positions().iter().map(|&[x, y, z]| [x, y, 5.0 * z]).collect(),
        mesh.faces().to_vec(),
    )
    .unwrap();
    let surface = surface(&long);
    let reach = |strategy: CutStrategy| {
        let cut = choose_cut(&surface, &follows(strategy)).unwrap();
        let edges = surface.mesh().edge_ids().filter(|&edge| cut[edge]);
        let heights = edges.flat_map(|edge| surface.mesh().ends(edge)).map(|v| surface.positions()[v][2]);
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
        high - low
    };
    assert!(reach(CutStrategy::Medial { balls }) > 9.0);
    // Bones end at the centres of the last balls.
    let bones = reach(CutStrategy::Bones { balls, sections: false });
    assert!(bones > 6.0 && bones < 9.9, "{bones}");
}

#[test]
fn curvature_is_avoided_and_forbidden_edges_and_faces_are_not_entered() {
    let cube = surface(&shapes::cube(1.0, 8).unwrap());
    let mesh = cube.mesh();
    let [low, high] =
        [f64::min, f64::max].map(|least| cube.positions().iter().flatten().copied().reduce(least).unwrap());
    let extremes = |v: VertexId| cube.positions()[v].iter().filter(|x| [low, high].contains(*x)).count();
    let on_ridge = |v: VertexId| extremes(v) >= 2;
    let at_corner = |v: VertexId| extremes(v) == 3;
    // Two vertices of one ridge, neither a corner of the cube.
    let ridge: Vec<VertexId> = mesh.vertex_ids().filter(|&v| on_ridge(v)).collect();
    let far = |v: VertexId, w: VertexId| {
        let (p, q) = (cube.positions()[v], cube.positions()[w]);
        let same = (0..3).filter(|&k| p[k] == q[k]).count();
        let d = (0..3).map(|k| (p[k] - q[k]).abs()).sum::<f64>();
        same == 2 && (d - 0.5).abs() < 1e-12 && !at_corner(v) && !at_corner(w)
    };
    let pair =
        ridge.iter().flat_map(|&v| ridge.iter().map(move |&w| [v, w])).find(|[v, w]| far(*v, *w)).unwrap();
    let options = |curvature: f64| CutOptions {
        strategy: CutStrategy::Through(pair.to_vec()),
        curvature,
        ..CutOptions::default()
    };
    let touched = |cut: &EdgeData<bool>| {
        let edges = mesh.edge_ids().filter(|&edge| cut[edge]);
        let mut ends: Vec<VertexId> = edges.flat_map(|edge| mesh.ends(edge)).collect();
        ends.sort_unstable();
        ends.dedup();
        ends
    };
    let straight = choose_cut(&cube, &options(0.0)).unwrap();
    assert!(touched(&straight).into_iter().all(on_ridge));
    let bent = choose_cut(&cube, &options(1.0)).unwrap();
    assert_eq!(touched(&bent).into_iter().filter(|&v| on_ridge(v)).count(), 2);
    // One edge of the straight cut closed, and then all faces around its middle.
    let edge = mesh.edge_ids().find(|&edge| straight[edge]).unwrap();
    let around = CutOptions { forbidden_edges: vec![mesh.ends(edge)], ..options(0.0) };
    assert!(!choose_cut(&cube, &around).unwrap()[edge]);
    let inner = mesh.ends(edge).into_iter().find(|v| !pair.contains(v)).unwrap();
    let faces = mesh.outgoing(inner).map(pompeiu_surface::HalfedgeId::face).collect();
    let closed = CutOptions { forbidden_faces: faces, ..options(0.0) };
    assert!(!touched(&choose_cut(&cube, &closed).unwrap()).contains(&inner));
    let wrong = CutOptions { forbidden_edges: vec![[VertexId(0), VertexId(0)]], ..options(0.0) };
    assert!(matches!(choose_cut(&cube, &wrong), Err(CutError::NoEdge { .. })));
    assert!(matches!(choose_cut(&cube, &options(f64::NAN)), Err(CutError::Curvature { .. })));
}
