//! What JSON answers have in common. Doubles are written as the shortest decimals that read back to them.

use serde::Serialize;
use std::time::Duration;

/// An answer on one line.
pub(crate) fn line(answer: &impl Serialize) -> serde_json::Result<String> {
    Ok(serde_json::to_string(answer)? + "\n")
}

pub(crate) fn milliseconds(span: Duration) -> f64 {
    span.as_nanos() as f64 / 1e6
}
