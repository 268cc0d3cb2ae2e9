//! Options of what a search may take.

use crate::numbers::{duration, memory};
use crate::threads::use_threads;
use clap::Args;
use std::time::Duration;

#[derive(Args)]
pub(crate) struct Limits {
    /// Threads to use; all processors by default
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024), value_name = "N")]
    pub(crate) threads: Option<u16>,
    /// Stop searching this long after the start, such as 10s, with wider intervals
    #[arg(long, value_parser = duration, value_name = "TIME")]
    pub(crate) time_limit: Option<Duration>,
    /// Stop searching before memory exceeds this, such as 2GiB, with wider intervals
    #[arg(long, value_parser = memory, value_name = "SIZE")]
    pub(crate) memory_limit: Option<usize>,
}

impl Limits {
    /// Lets everything that runs in parallel use as many threads as asked.
    pub(crate) fn apply_threads(&self) -> anyhow::Result<()> {
        self.threads.map_or(Ok(()), use_threads)
    }

    /// The limits of a computation that begins when some time has passed.
    pub(crate) fn after(&self, passed: Duration) -> pompeiu::core::run::Limits {
        pompeiu::core::run::Limits {
            time: self.time_after(passed),
            memory: self.memory_limit,
            ..pompeiu::core::run::Limits::default()
        }
    }

    /// What is left of the time after some has passed.
    pub(crate) fn time_after(&self, passed: Duration) -> Option<Duration> {
        self.time_limit.map(|limit| limit.saturating_sub(passed))
    }
}
