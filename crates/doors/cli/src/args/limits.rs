//! Options of what a search may take.

use crate::exit::OutOfTime;
use crate::interrupt;
use crate::numbers::{duration, memory};
use crate::threads::use_threads;
use clap::{ArgMatches, Args, Command};
use pompeiu::core::request::Limit;
use pompeiu::core::run::{self, Control, unless_stopped};
use std::time::{Duration, Instant};

/// What is read within this time is read even if the time limit is shorter: then there is an answer.
const READING: Duration = Duration::from_secs(1);

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
    /// Adds the options of those limits that a command obeys.
    pub(crate) fn augment_offered(command: Command, offered: &[Limit]) -> Command {
        let all = Self::augment_args(Command::new(""));
        let is_offered = |arg: &&clap::Arg| offered.iter().any(|limit| arg.get_id() == limit.name());
        command.args(all.get_arguments().filter(is_offered).cloned())
    }

    /// The limits among the options that were offered.
    pub(crate) fn from_offered(matches: &ArgMatches) -> Self {
        fn of<T: Clone + Send + Sync + 'static>(matches: &ArgMatches, limit: Limit) -> Option<T> {
            matches.try_get_one(limit.name()).ok().flatten().cloned()
        }
        Self {
            threads: of(matches, Limit::Threads),
            time_limit: of(matches, Limit::Time),
            memory_limit: of(matches, Limit::Memory),
        }
    }

    /// Lets everything that runs in parallel use as many threads as asked.
    pub(crate) fn apply_threads(&self) -> anyhow::Result<()> {
        self.threads.map_or(Ok(()), use_threads)
    }

    /// The limits of a computation that begins when some time has passed.
    pub(crate) fn after(&self, passed: Duration) -> run::Limits {
        run::Limits {
            time: self.time_after(passed),
            memory: self.memory_limit,
            cancel: Some(interrupt::token()),
            ..run::Limits::default()
        }
    }

    /// Reads what cannot be answered without, on a thread of its own, which is left alone when the time limit is over.
    ///
    /// # Errors
    /// [`OutOfTime`].
    pub(crate) fn while_reading<R: Send + 'static>(
        &self,
        started: Instant,
        read: impl FnOnce() -> R + Send + 'static,
    ) -> Result<R, OutOfTime> {
        let Some(limit) = self.time_limit else { return Ok(read()) };
        let left = limit.max(READING).saturating_sub(started.elapsed());
        let of_reading = run::Limits { time: Some(left), ..run::Limits::default() };
        unless_stopped(&Control::start(&of_reading), read).ok_or(OutOfTime(limit))
    }

    /// What is left of the time after some has passed.
    pub(crate) fn time_after(&self, passed: Duration) -> Option<Duration> {
        self.time_limit.map(|limit| limit.saturating_sub(passed))
    }
}
