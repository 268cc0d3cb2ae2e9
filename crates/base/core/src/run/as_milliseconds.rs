//! Spans of time as milliseconds in serialised reports: for `serde(with = …)`.

use serde::{Deserialize, Deserializer, Serializer};
use std::time::Duration;

/// Writes a span of time as milliseconds.
///
/// # Errors
/// Those of the serializer.
pub fn serialize<S: Serializer>(span: &Duration, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(span.as_nanos() as f64 / 1e6)
}

/// Reads a span of time written by [`serialize`], to the nanosecond.
///
/// # Errors
/// Those of the deserializer.
pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Duration, D::Error> {
    let milliseconds = f64::deserialize(deserializer)?;
    // Negative and infinite spans saturate; they are no part of any answer.
    Ok(Duration::from_nanos((milliseconds * 1e6).round() as u64))
}
