//! Building a tree, and the order in which the engine sweeps: faces per second, on one thread.

use bench_kernels::meshes;
use criterion::{Criterion, Throughput};
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::spatial::{Bvh, morton_order};

use crate::nearest::parry;

pub fn bench(criterion: &mut Criterion) {
    for meshes::Named { name, mesh } in meshes::timed() {
        let mut group = criterion.benchmark_group(format!("build/{name}"));
        group.throughput(Throughput::Elements(mesh.faces().len() as u64));
        let aabb = Aabb::of_faces(&mesh);
        let frame = Frame::of(&aabb);
        group.bench_function("pompeiu", |bencher| bencher.iter(|| Bvh::build(&mesh, &frame)));
        group.bench_function("parry3d-f64", |bencher| bencher.iter(|| parry(&mesh)));
        group.bench_function("morton_order", |bencher| bencher.iter(|| morton_order(&mesh, &aabb)));
        group.finish();
    }
}
