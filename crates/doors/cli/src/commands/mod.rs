//! One file per command.

pub(crate) mod completions;
pub(crate) mod convert;
pub(crate) mod decompose;
pub(crate) mod deviation;
pub(crate) mod distance;
pub(crate) mod generate;
pub(crate) mod info;
pub(crate) mod man;
pub(crate) mod matrix;
pub(crate) mod rank;
