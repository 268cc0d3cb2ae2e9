//! Distances from points to triangles, in the three shapes of the kernel: distances per second.

use bench_kernels::{meshes, points};
use criterion::{Criterion, Throughput};
use multiversion::multiversion;
use pompeiu_core::geom::point_triangle::{
    LANES, TriangleBlock, block_distances_sq, closest_barycentric, distance_sq, four_points_distances_sq,
};
use std::hint::black_box;

/// Triangles of a batch: 72 KiB of corners, so that the kernel is measured and not the memory.
const TRIANGLES: usize = 1024;

pub fn bench(criterion: &mut Criterion) {
    let sphere = meshes::noisy_sphere(3);
    let triangles: Vec<[[f64; 3]; 3]> = sphere
        .faces()
        .iter()
        .map(|face| face.map(|v| sphere.positions()[v as usize]))
        .take(TRIANGLES)
        .collect();
    let blocks: Vec<TriangleBlock> = triangles.chunks_exact(LANES).map(block).collect();
    let near = points::near(&sphere, TRIANGLES);
    let fours: Vec<[[f64; 4]; 3]> =
        near.chunks_exact(4).map(|four| [0, 1, 2].map(|k| [0, 1, 2, 3].map(|l| four[l][k]))).collect();

    let mut group = criterion.benchmark_group("point_triangle");
    group.throughput(Throughput::Elements(TRIANGLES as u64));
    group.bench_function("one_by_one", |bencher| {
        bencher.iter(|| {
            near.iter().zip(&triangles).map(|(p, [a, b, c])| distance_sq(*p, *a, *b, *c)).sum::<f64>()
        });
    });
    group.bench_function("eight_triangles", |bencher| {
        bencher.iter(|| eight_triangles(black_box(near[0]), &blocks));
    });
    group.bench_function("four_points", |bencher| {
        bencher.iter(|| four_points(&fours, &triangles));
    });
    group.bench_function("barycentric", |bencher| {
        bencher
            .iter(|| near.iter().zip(&triangles).map(|(p, t)| closest_barycentric(*p, *t)[0]).sum::<f64>());
    });
    group.finish();
}

fn block(triangles: &[[[f64; 3]; 3]]) -> TriangleBlock {
    [0, 1, 2].map(|corner| [0, 1, 2].map(|k| std::array::from_fn(|lane| triangles[lane][corner][k])))
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn eight_triangles(p: [f64; 3], blocks: &[TriangleBlock]) -> f64 {
    let mut least = f64::INFINITY;
    for block in blocks {
        for d in block_distances_sq(p, block) {
            least = if d < least { d } else { least };
        }
    }
    least
}

/// As many distances as the others: every four points with one triangle, which changes each time.
#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn four_points(fours: &[[[f64; 4]; 3]], triangles: &[[[f64; 3]; 3]]) -> f64 {
    let mut sum = 0.0;
    for (four, triangle) in fours.iter().zip(triangles) {
        let d = four_points_distances_sq(four, *triangle);
        sum += d[0] + d[1] + d[2] + d[3];
    }
    sum
}
