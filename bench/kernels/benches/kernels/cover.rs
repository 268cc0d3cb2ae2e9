//! Covering the faces of one mesh by those of another, as the sweep of the engine does: faces per second.

use bench_kernels::meshes;
use bench_kernels::sweep::Sweep;
use criterion::{Criterion, Throughput};

pub fn bench(criterion: &mut Criterion) {
    for meshes::Named { name, mesh } in meshes::timed() {
        let mut sweep = Sweep::new(&mesh, 1e-3);
        let mut group = criterion.benchmark_group(format!("cover/{name}"));
        group.throughput(Throughput::Elements(sweep.len() as u64));
        group.bench_function("from_the_last", |bencher| bencher.iter(|| sweep.run()));
        group.finish();
    }
}
