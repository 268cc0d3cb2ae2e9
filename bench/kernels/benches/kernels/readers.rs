//! Parsing files that are in memory already: bytes per second, on one thread.

use bench_kernels::{files, meshes};
use criterion::{Criterion, Throughput};

pub fn bench(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("read");
    for file in files::of_mesh(&meshes::noisy_sphere(6)) {
        group.throughput(Throughput::Bytes(file.bytes.len() as u64));
        group.bench_function(file.name, |bencher| {
            bencher.iter(|| pompeiu_io::read_bytes(&file.bytes, Some(file.format)).expect("a mesh"));
        });
    }
    group.finish();
}
