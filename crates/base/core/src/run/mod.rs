//! Running computations: limits, cancelling, progress, and reasons to stop.
//!
//! A computation takes [`Limits`] among its options, makes a [`Control`] of them when it starts, and calls [`Control::is_stopped`]
//! at regular intervals from any of its threads. Its report carries a [`StopReason`]. What it returns is valid whatever the reason,
//! but less accurate if it ended early. Callers that start
//! several computations that belong together make one [`RunContext`] for all of them.
//!
//! # Example
//! ```
//! use pompeiu_core::run::{Control, Limits, StopReason};
//!
//! let limits = Limits { pieces: Some(1000), ..Limits::default() };
//! let control = Control::start(&limits);
//! let mut pieces = 1;
//! while !control.is_stopped() {
//!     pieces *= 2;
//!     control.check_pieces(pieces);
//! }
//! assert_eq!((pieces, control.reason()), (1024, Some(StopReason::Pieces)));
//! ```

#[cfg(feature = "serde")]
pub mod as_milliseconds;
mod cancel;
mod clock;
mod context;
mod control;
mod limits;
mod progress;
mod stop;
mod threads;
mod uninterruptible;

pub use cancel::CancelToken;
pub use clock::Instant;
#[cfg(all(target_family = "wasm", target_os = "unknown"))]
pub use clock::set_clock;
pub use context::RunContext;
pub use control::Control;
pub use limits::{LimitError, Limits};
pub use progress::{Progress, ProgressObserver};
pub use stop::StopReason;
pub use threads::on_threads;
pub use uninterruptible::unless_stopped;
