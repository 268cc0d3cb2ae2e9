//! A progress bar for those who wait longer than a second at a terminal.

use crate::printer::Printer;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use pompeiu::core::run::{Progress, ProgressObserver};
use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// How long nobody wants to see a progress bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// Steps of a share.
const THOUSAND: f64 = 1000.0;

/// How often the bar moves.
const TICK: Duration = Duration::from_millis(100);

/// A bar on stderr that appears after a second, and disappears with this value.
pub(crate) struct Wait {
    bar: ProgressBar,
    curtain: Option<(Sender<()>, JoinHandle<()>)>,
    /// The greatest share that was shown, in thousandths: a later stage that begins anew shows none until it has come as far.
    most: AtomicU64,
}

impl Wait {
    /// A bar if stderr is a terminal and messages are wanted, else nothing.
    pub(crate) fn new(printer: &Printer) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        let curtain = (std::io::stderr().is_terminal() && !printer.is_quiet()).then(|| {
            let (sender, receiver) = channel::<()>();
            let shown = bar.clone();
            let thread = std::thread::spawn(move || {
                if receiver.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                    shown.set_draw_target(ProgressDrawTarget::stderr());
                    shown.enable_steady_tick(TICK);
                }
            });
            (sender, thread)
        });
        Self { bar, curtain, most: AtomicU64::new(0) }
    }

    /// Nothing.
    pub(crate) fn hidden() -> Self {
        Self {
            bar: ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden()),
            curtain: None,
            most: AtomicU64::new(0),
        }
    }

    /// Tells what is being done, without knowing how long it takes.
    pub(crate) fn show(&self, message: String) {
        self.bar.set_style(style("{spinner} {msg} ({elapsed})"));
        self.bar.set_message(message);
    }

    /// Tells how much of how much is done.
    pub(crate) fn advance(&self, message: String, [done, all]: [u64; 2]) {
        self.bar.set_style(style("{spinner} [{bar:24}] {percent:>3}% ({elapsed}) {msg}"));
        self.bar.set_length(all);
        self.bar.set_position(done);
        self.bar.set_message(message);
    }

    /// Tells how far a computation has come. Percentages do not go back.
    pub(crate) fn progress(&self, progress: &Progress<'_>) {
        if self.curtain.is_none() {
            return;
        }
        let done = (progress.share.unwrap_or(0.0) * THOUSAND) as u64;
        if self.is_farther(done) {
            self.advance(progress.doing.to_owned(), [done, THOUSAND as u64]);
        } else {
            self.show(progress.doing.to_owned());
        }
    }

    /// Whether no greater share was shown before.
    fn is_farther(&self, done: u64) -> bool {
        self.most.fetch_max(done, Ordering::Relaxed) <= done
    }

    /// Tells how many of how many are done, and guesses how long the others take.
    pub(crate) fn count(&self, message: String, [done, all]: [u64; 2]) {
        if self.bar.length().is_none() {
            self.bar
                .set_style(style("{spinner} [{bar:24}] {pos} of {len} ({elapsed}, about {eta} left) {msg}"));
        }
        self.bar.set_length(all);
        self.bar.set_position(done);
        self.bar.set_message(message);
    }

    /// Begins to count anew.
    pub(crate) fn restart(&self) {
        self.bar.set_position(0);
        self.bar.reset_eta();
    }

    /// Lets something else be printed.
    pub(crate) fn suspend(&self, print: impl FnOnce()) {
        self.bar.suspend(print);
    }
}

/// Shows the progress, and ends the computation at Ctrl-C.
impl ProgressObserver for Wait {
    fn progress(&self, progress: &Progress<'_>) -> ControlFlow<()> {
        Self::progress(self, progress);
        crate::interrupt::flow()
    }

    fn reads_doing(&self) -> bool {
        self.curtain.is_some()
    }
}

impl Drop for Wait {
    fn drop(&mut self) {
        if let Some((sender, thread)) = self.curtain.take() {
            drop(sender);
            let _ = thread.join();
        }
        self.bar.finish_and_clear();
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_that_go_back_are_not_shown() {
        let wait = Wait::hidden();
        let shown = [10, 500, 200, 499, 500, 900].map(|done| wait.is_farther(done));
        assert_eq!(shown, [true, true, false, false, true, true]);
    }
}
