//! What the exit code says.

use std::process::ExitCode;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exit {
    /// The question was answered; with a threshold: the distance is proven to be at most that.
    Done,
    /// The distance is proven to exceed the threshold.
    Above,
    /// A file or an argument cannot be used.
    Unusable,
    /// The budget, or double precision, ran out before the answer.
    Undecided,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(match exit {
            Exit::Done => 0,
            Exit::Above => 1,
            Exit::Unusable => 2,
            Exit::Undecided => 3,
        })
    }
}
