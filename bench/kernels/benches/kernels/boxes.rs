//! Boxes: taking those of faces, and finding all triangles whose boxes reach a point.

use bench_kernels::{meshes, points};
use criterion::{Criterion, Throughput};
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::spatial::Bvh;
use std::hint::black_box;
use std::ops::ControlFlow;

const QUERIES: usize = 1000;

pub fn bench(criterion: &mut Criterion) {
    for meshes::Named { name, mesh } in meshes::timed() {
        let mut group = criterion.benchmark_group(format!("boxes/{name}"));
        group.throughput(Throughput::Elements(mesh.faces().len() as u64));
        group.bench_function("of_faces", |bencher| bencher.iter(|| Aabb::of_faces(black_box(&mesh))));

        let aabb = Aabb::of_faces(&mesh);
        let frame = Frame::of(&aabb);
        let bvh = Bvh::build(&mesh, &frame);
        let reach = frame.length_in(0.02 * aabb.diagonal());
        let points: Vec<_> = points::near(&mesh, QUERIES).into_iter().map(|p| frame.map(p)).collect();
        group.throughput(Throughput::Elements(QUERIES as u64));
        group.bench_function("walk", |bencher| {
            bencher.iter(|| {
                let (mut found, mut stack) = (0, Vec::new());
                for &p in &points {
                    let within = |aabb: &Aabb| aabb.distance_sq(p) <= reach * reach;
                    let all = bvh.walk(&mut stack, within, |_| {
                        found += 1;
                        ControlFlow::Continue(())
                    });
                    assert!(all.is_continue());
                }
                found
            });
        });
        group.finish();
    }
}
