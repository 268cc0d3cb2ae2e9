//! How many threads work.

use anyhow::Context;

/// Lets everything that runs in parallel use this many threads.
pub(crate) fn use_threads(threads: u16) -> anyhow::Result<()> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.into())
        .build_global()
        .with_context(|| format!("--threads {threads}: the system refuses that many; ask for fewer"))
}
