//! Closest-point queries, near the surface and far from it: queries per second, on one thread.
//!
//! Each starts from nothing, in no order: neither side may learn from the query before.

use bench_kernels::{meshes, points};
use criterion::{BenchmarkGroup, Criterion, Throughput, measurement::WallTime};
use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::spatial::{Bvh, Workspace};

const QUERIES: usize = 2000;

pub fn bench(criterion: &mut Criterion) {
    for meshes::Named { name, mesh } in meshes::timed() {
        let frame = Frame::of(&Aabb::of_faces(&mesh));
        let bvh = Bvh::build(&mesh, &frame);
        let peer = parry(&mesh);
        for (place, points) in [("near", points::near(&mesh, QUERIES)), ("far", points::far(&mesh, QUERIES))]
        {
            let mut group = criterion.benchmark_group(format!("nearest/{name}/{place}"));
            group.throughput(Throughput::Elements(QUERIES as u64));
            ours(&mut group, &bvh, &frame, &points);
            theirs(&mut group, &peer, &points);
            agree(&bvh, &frame, &peer, &points);
            group.finish();
        }
    }
}

fn ours(group: &mut BenchmarkGroup<WallTime>, bvh: &Bvh, frame: &Frame, points: &[[f64; 3]]) {
    let mut workspace = Workspace::default();
    group.bench_function("pompeiu", |bencher| {
        bencher.iter(|| {
            let query = |p: &[f64; 3]| bvh.nearest(frame.map(*p), bvh.any_slot(), &mut workspace).distance_sq;
            points.iter().map(query).sum::<f64>()
        });
    });
}

fn theirs(group: &mut BenchmarkGroup<WallTime>, peer: &shape::TriMesh, points: &[[f64; 3]]) {
    group.bench_function("parry3d-f64", |bencher| {
        bencher.iter(|| points.iter().map(|p| parry_distance(peer, *p)).sum::<f64>());
    });
}

/// A time counts only for the right answer.
fn agree(bvh: &Bvh, frame: &Frame, peer: &shape::TriMesh, points: &[[f64; 3]]) {
    let mut workspace = Workspace::default();
    for &p in points {
        let found = bvh.nearest(frame.map(p), bvh.any_slot(), &mut workspace).distance_sq.sqrt();
        let (ours, theirs) = (frame.length_out(found), parry_distance(peer, p));
        assert!((ours - theirs).abs() <= 1e-9 * (1.0 + theirs), "{ours} and {theirs} at {p:?}");
    }
}

fn parry_distance(peer: &shape::TriMesh, p: [f64; 3]) -> f64 {
    peer.distance_to_local_point(Vector::from_array(p), false)
}

/// The peer's mesh with its tree.
pub fn parry(mesh: &TriMesh) -> shape::TriMesh {
    let positions = mesh.positions().iter().map(|p| Vector::from_array(*p)).collect();
    shape::TriMesh::new(positions, mesh.faces().to_vec()).expect("faces")
}
