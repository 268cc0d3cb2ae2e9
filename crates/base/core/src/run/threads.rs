//! Choosing the number of threads.

use std::num::NonZeroUsize;

/// Runs `work` on this many threads, or on the current pool if `None`. If the operating system refuses new threads, the current
/// pool is used.
pub fn on_threads<R: Send>(threads: Option<NonZeroUsize>, work: impl FnOnce() -> R + Send) -> R {
    let Some(threads) = threads else { return work() };
    match rayon::ThreadPoolBuilder::new().num_threads(threads.get()).build() {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_as_asked() {
        for count in 1..4 {
            assert_eq!(on_threads(NonZeroUsize::new(count), rayon::current_num_threads), count);
        }
        assert_eq!(on_threads(None, rayon::current_num_threads), rayon::current_num_threads());
    }
}
