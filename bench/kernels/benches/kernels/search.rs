//! Whole directed distances of small pairs: trees, sweep, games, cuts and proof together, on one thread.
//!
//! Games are not open to callers of the library: `curved` is mostly games.

use bench_kernels::meshes;
use criterion::{Criterion, Throughput};
use pompeiu_hausdorff::directed_hausdorff;

pub fn bench(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("search");
    for meshes::Pair { name, a, b } in meshes::pairs() {
        group.throughput(Throughput::Elements((a.faces().len() + b.faces().len()) as u64));
        group.bench_function(name, |bencher| bencher.iter(|| directed_hausdorff(&a, &b)));
    }
    group.finish();
}
