//! What the exit code says.

use pompeiu::core::request::{Conclusion, Report};
use pompeiu::core::run::StopReason;
use std::process::ExitCode;
use std::time::Duration;

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

impl Exit {
    /// What follows from a report.
    pub(crate) fn of(report: &impl Report) -> Self {
        match report.conclusion() {
            Conclusion::AsAsked => Self::Done,
            Conclusion::Refuted => Self::Above,
            Conclusion::Incomplete => Self::Undecided,
        }
    }
}

/// The time limit was over before the files were read.
#[derive(Debug)]
pub(crate) struct OutOfTime(pub(crate) Duration);

impl std::error::Error for OutOfTime {}

impl std::fmt::Display for OutOfTime {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "the time limit of {:?} was over before the files were read; allow more time", self.0)
    }
}

/// What ended a computation before it reached what was asked, in the words of a sentence.
pub(crate) fn stopped_by(reason: StopReason) -> &'static str {
    match reason {
        StopReason::Time => "the time limit",
        StopReason::Memory => "the memory limit",
        StopReason::Pieces => "the limit on pieces",
        StopReason::Steps => "the limit on steps",
        StopReason::Rounding => "double precision",
        StopReason::Stalled => "lack of progress",
        _ => "request",
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(match exit {
            Exit::Done => Conclusion::AsAsked.exit_code(),
            Exit::Above => Conclusion::Refuted.exit_code(),
            Exit::Unusable => Conclusion::UNUSABLE,
            Exit::Undecided => Conclusion::Incomplete.exit_code(),
        })
    }
}
