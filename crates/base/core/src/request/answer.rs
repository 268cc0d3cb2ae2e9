//! What is said of a computation, wherever it was asked for.

use crate::TriMesh;
use crate::run::StopReason;
use std::time::Duration;

/// What follows from an answer, as an exit code says it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Conclusion {
    /// The computation reached what was asked.
    AsAsked,
    /// What was asserted is refuted.
    Refuted,
    /// The answer is valid, but falls short of what was asked: a limit ended the computation, or double precision did.
    Incomplete,
}

impl Conclusion {
    /// The exit code of an input or an option that cannot be used: then there is no answer.
    pub const UNUSABLE: u8 = 2;

    /// The exit code of a command.
    pub const fn exit_code(self) -> u8 {
        match self {
            Self::AsAsked => 0,
            Self::Refuted => 1,
            Self::Incomplete => 3,
        }
    }
}

/// What a computation found.
pub trait Report {
    /// The reason for which the computation ended.
    fn stop(&self) -> StopReason;

    /// What follows; where nothing is asserted, that depends on the reason to stop alone.
    fn conclusion(&self) -> Conclusion {
        if self.stop().is_early() { Conclusion::Incomplete } else { Conclusion::AsAsked }
    }
}

/// An input of a computation.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Input {
    /// The path as it was given; null for a mesh that is in no file.
    pub path: Option<String>,
    /// Number of vertices.
    pub vertices: usize,
    /// Number of faces.
    pub faces: usize,
    /// The SHA-256 sum of the file in hexadecimal digits; null where there is no file that can be read twice.
    pub sha256: Option<String>,
}

impl Input {
    /// A mesh that is in no file.
    pub fn of_mesh(mesh: &TriMesh) -> Self {
        Self { vertices: mesh.positions().len(), faces: mesh.faces().len(), ..Self::default() }
    }
}

/// Time by the clock; milliseconds in JSON.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Timing {
    /// Reading inputs.
    #[cfg_attr(feature = "serde", serde(with = "crate::run::as_milliseconds"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub read: Duration,
    /// From the start to the answer: reading, the computation, writing results.
    #[cfg_attr(feature = "serde", serde(with = "crate::run::as_milliseconds"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub total: Duration,
}

/// A request and what was found, as it is serialised: for the command's `--json`, Python and pages.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Answer<Q, R> {
    /// The version of pompeiu.
    pub version: String,
    /// The name of the command.
    pub command: String,
    /// The inputs, in the order of the arguments.
    pub inputs: Vec<Input>,
    /// The options as they were used, defaults included.
    pub request: Q,
    /// The report.
    pub report: R,
    /// The reason for which the computation ended.
    pub stop: StopReason,
    /// Time spent.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: Timing,
}

impl<Q: super::Request<Report = R>, R: Report> Answer<Q, R> {
    /// The answer to a request.
    pub fn new(inputs: Vec<Input>, request: Q, report: R, timing: Timing) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            command: Q::NAME.to_owned(),
            inputs,
            request,
            stop: report.stop(),
            report,
            timing,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Stopped(StopReason);

    impl Report for Stopped {
        fn stop(&self) -> StopReason {
            self.0
        }
    }

    #[test]
    fn exit_codes_follow_from_the_reason_to_stop() {
        for reason in StopReason::ALL {
            let expected = if reason.is_early() { 3 } else { 0 };
            assert_eq!(Stopped(reason).conclusion().exit_code(), expected, "{reason:?}");
        }
        assert_eq!((Conclusion::Refuted.exit_code(), Conclusion::UNUSABLE), (1, 2));
    }
}
