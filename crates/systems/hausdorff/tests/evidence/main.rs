//! What the engine promises, held against evidence that does not come from it.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "helpers of tests, too, fail and report")]

mod analytic;
mod bands;
mod certificate;
mod classic;
mod determinism;
mod deviation;
mod discards;
mod fans;
mod first_answer;
mod hard;
mod limits;
mod observer;
mod options;
mod oracle;
#[cfg(feature = "figures")]
mod page;
mod pairs;
mod properties;
mod regions;
mod regressions;
mod sampling;
mod scales;
mod signed;
mod statistics;
mod support;
mod touching;
