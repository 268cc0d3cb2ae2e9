//! What follows from the requests of systems and is checked in: JSON schemas, signatures and docstrings in Python, tables of options in
//! the guide. `GENERATED_UPDATE=1 cargo test -p pompeiu-cli generated` writes it anew.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod example;
mod guide;
mod options;
mod python;
mod schema;

use crate::door::System;

use std::path::{Path, PathBuf};

/// Visits the systems that have commands.
pub(crate) trait Visitor {
    fn system<S: System>(&mut self);
}

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..")
}

/// Compares a file with what it should be, or writes it.
#[track_caller]
fn compare(path: &Path, expected: &str) {
    if std::env::var_os("GENERATED_UPDATE").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, expected).unwrap();
    }
    let found = std::fs::read_to_string(path).unwrap_or_default();
    assert!(found == expected, "{}: out of date; GENERATED_UPDATE=1 writes it anew", path.display());
}
