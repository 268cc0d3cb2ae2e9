//! The outcome for people.

use super::run::Outcome;
use crate::numbers::{grouped, shortest, time};
use crate::page::Page;

/// A row for each quantity.
pub(super) fn text(outcome: &Outcome) -> String {
    let number = |n: usize| grouped(n as u64);
    let mesh = outcome.opened.mesh();
    let mut page = Page::new();
    let parts = match mesh.components() {
        1 => "1 disk".to_owned(),
        n => format!("{} disks", number(n)),
    };
    page.row("result", &parts);
    page.row(
        "cut",
        &format!(
            "{} edges of length {} ({})",
            number(outcome.edges),
            shortest(outcome.length),
            outcome.strategy
        ),
    );
    let copies = mesh.vertices() - outcome.vertices;
    page.row(
        "mesh",
        &format!(
            "{}: {} vertices, {} of them copies, {} faces",
            outcome.path,
            number(mesh.vertices()),
            number(copies),
            number(mesh.faces())
        ),
    );
    page.row("time", &time(outcome.total));
    page.into_text()
}
