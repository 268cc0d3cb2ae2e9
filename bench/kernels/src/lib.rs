//! What the benchmarks of the kernels work on: see README.md.

pub mod files;
pub mod meshes;
pub mod points;
pub mod sweep;

/// Everything runs on the calling thread, so that times are those of one core and counts repeat.
///
/// # Panics
/// When called twice.
pub fn stay_on_this_thread() {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .use_current_thread()
        .build_global()
        .expect("called once, before any work");
}
