//! Answers for people: rows of a name and a line each.

use crate::numbers::{self, agreed, between, shortest};
use crate::printer::LABEL;
use pompeiu::core::request::Input;
use pompeiu::hausdorff::deviation::LeftOut;
use pompeiu::hausdorff::{BothLeftOut, DeviationReport, Enclosure, digits};
use std::fmt::Write;

/// Width of the column of names.
const NAMES: usize = 10;
/// Width of the first of two columns.
const COLUMN: usize = 32;

/// Rows of a name and a line each.
pub(crate) struct Page(String);

impl Page {
    pub(crate) fn new() -> Self {
        Self(String::new())
    }

    pub(crate) fn into_text(self) -> String {
        self.0
    }

    pub(crate) fn row(&mut self, name: &str, line: &str) {
        let padding = NAMES.saturating_sub(name.chars().count());
        let _ = match name {
            "" => writeln!(self.0, "{:padding$}{line}", ""),
            _ => writeln!(self.0, "{LABEL}{name}{LABEL:#}{:padding$}{line}", ""),
        };
    }

    /// A name, and the same of two things beside each other.
    pub(crate) fn columns(&mut self, name: &str, [left, right]: [&str; 2]) {
        self.row(name, format!("{left:COLUMN$}{right}").trim_end());
    }

    pub(crate) fn gap(&mut self) {
        self.0.push('\n');
    }
}

/// The path and the counts of an input.
pub(crate) fn described(input: &Input) -> String {
    let path = input.path.as_deref().unwrap_or_default();
    if input.faces == 0 {
        format!("{path}: {}", numbers::counted(input.vertices, "point"))
    } else {
        format!("{path}: {}", numbers::vertices_and_faces(input.vertices, input.faces))
    }
}

/// What an enclosed value is, in no more digits than tell it from others.
pub(crate) fn brief(distance: Enclosure) -> String {
    numbers::brief(distance.lower(), distance.upper())
}

/// What an enclosed value is, in the digits that are certain.
pub(crate) fn value(distance: Enclosure) -> String {
    let (lower, upper) = (distance.lower(), distance.upper());
    agreed(lower, upper).unwrap_or_else(|| between(lower, upper))
}

/// What is proven of an enclosed value, in all digits.
pub(crate) fn proven(distance: Enclosure) -> String {
    let [lower, upper] = [distance.lower(), distance.upper()].map(shortest);
    if lower == upper {
        return "proven, with no gap".to_owned();
    }
    format!("proven to lie between {lower} and {upper} (gap {:.1e})", distance.gap())
}

/// The verdict of a deviation, what was compared, and what was left out of it.
pub(crate) fn compared(
    page: &mut Page,
    names: [&str; 2],
    inputs: &[Input],
    report: &DeviationReport,
    unit: &str,
) {
    if let Some(sentence) = report.sentence(names, unit) {
        page.row("verdict", &sentence);
        page.gap();
    }
    for (name, input) in names.into_iter().zip(inputs) {
        page.row(name, &described(input));
    }
    for (i, sentence) in left_out(names, report.left_out.as_ref()).iter().enumerate() {
        page.row(if i == 0 { "left out" } else { "" }, sentence);
    }
}

/// What was left out of each mesh, if something was to be.
pub(crate) fn left_out([a, b]: [&str; 2], both: Option<&BothLeftOut>) -> Vec<String> {
    both.map_or_else(Vec::new, |both| vec![left_out_of(a, &both.a), left_out_of(b, &both.b)])
}

fn left_out_of(name: &str, left_out: &LeftOut) -> String {
    let count = |faces: usize| numbers::counted(faces, "face");
    let faces = match (left_out.faces, left_out.cut) {
        (0, 0) => return format!("nothing of {name}"),
        (faces, 0) => count(faces),
        (0, cut) => format!("parts of {}", count(cut)),
        (faces, cut) => format!("{} and parts of {}", count(faces), count(cut)),
    };
    let parts = match left_out.components {
        1 => "1 connected part".to_owned(),
        n => format!("{} connected parts", numbers::grouped(n as u64)),
    };
    let share = digits::percentage(left_out.share.lower(), left_out.share.upper());
    format!("{share} of {name}'s area, {faces} in {parts}")
}
