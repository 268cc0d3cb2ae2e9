//! Time of the kernels, one by one; see README.md.

mod boxes;
mod build;
mod cover;
mod nearest;
mod point_triangle;
mod readers;
mod search;

use criterion::Criterion;
use std::time::Duration;

fn main() {
    bench_kernels::stay_on_this_thread();
    let mut criterion = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .configure_from_args();
    point_triangle::bench(&mut criterion);
    boxes::bench(&mut criterion);
    build::bench(&mut criterion);
    nearest::bench(&mut criterion);
    cover::bench(&mut criterion);
    search::bench(&mut criterion);
    readers::bench(&mut criterion);
    criterion.final_summary();
}
