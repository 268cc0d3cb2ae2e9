//! Reports, tasks and results pass as JSON, in which every double comes back to the last bit.

use crate::errors::{InternalError, Raise};
use pyo3::PyResult;
use serde::Serialize;
use serde::de::DeserializeOwned;

pub(crate) fn parsed<T: DeserializeOwned>(text: &str) -> PyResult<T> {
    serde_json::from_str(text).map_err(|error| InternalError::Parse(error).raise())
}

pub(crate) fn written<T: Serialize>(value: &T) -> PyResult<String> {
    serde_json::to_string(value).map_err(|error| InternalError::Parse(error).raise())
}
