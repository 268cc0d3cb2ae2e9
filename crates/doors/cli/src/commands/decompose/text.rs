//! The answer for people.

use super::Files;
use crate::door::AnswerOf;
use crate::numbers::{grouped, plain, time};
use crate::printer::LABEL;
use pompeiu::fields::Quality;
use std::fmt::Write;
use std::path::Path;

/// What is counted, then what is measured where there is a field.
pub(super) fn text(mesh: &Path, answer: &AnswerOf<Files>) -> String {
    let report = &answer.report;
    let number = |n: usize| grouped(n as u64);
    let mut text = String::new();
    let mut row = |label: &str, value: &str| {
        let _ = writeln!(text, "{LABEL}{label:<22}{LABEL:#}{value}");
    };
    row("mesh", &mesh.display().to_string());
    row("faces", &number(report.faces));
    row("components", &number(report.components));
    row("genus", &number(report.genus));
    row("boundary loops", &number(report.boundary_loops));
    row("harmonic fields", &number(report.degrees_of_freedom.harmonic));
    row("degrees of freedom", &number(report.degrees_of_freedom.total));
    for (label, ranks) in [
        ("  mixed", report.degrees_of_freedom.mixed),
        ("  conforming only", report.degrees_of_freedom.conforming),
        ("  nonconforming only", report.degrees_of_freedom.nonconforming),
    ] {
        let meaning = match ranks.residual_dimension {
            n if n < 0 => ": the spaces overlap".to_owned(),
            0 => String::new(),
            n if n == report.degrees_of_freedom.harmonic.cast_signed() => ": the harmonic fields".to_owned(),
            _ => format!(", {} of them harmonic", number(report.degrees_of_freedom.harmonic)),
        };
        let sign = if ranks.residual_dimension < 0 { "−" } else { "" };
        let residual = number(ranks.residual_dimension.unsigned_abs());
        let [gradient, rotated] = [ranks.gradient, ranks.rotated].map(number);
        row(
            label,
            &format!(
                "{gradient} gradients + {rotated} rotated, residual dimension {sign}{residual}{meaning}"
            ),
        );
    }
    let Some(split) = &report.decomposition else { return text };
    let Quality { residual, inner_products, norms, part_error } = split.quality;
    let timing = split.timing;
    let share = |norm: f64| {
        let part = if norms.field > 0.0 { norm / norms.field } else { 0.0 };
        format!("{} ({:.3} % of the energy)", short(norm), 100.0 * part * part)
    };
    row("norm of the field", &short(norms.field));
    row("  gradient", &share(norms.gradient));
    row("  rotated gradient", &share(norms.rotated));
    row("  harmonic", &share(norms.harmonic));
    row("residual", &format!("{residual:.1e} of the norm"));
    let products =
        [inner_products.gradient_rotated, inner_products.gradient_harmonic, inner_products.rotated_harmonic];
    let largest = products.into_iter().fold(0.0, |m, x: f64| if x.abs() > m { x.abs() } else { m });
    row("inner products", &format!("at most {largest:.1e} of the squared norm"));
    row("error of each part", &format!("at most {part_error:.1e} of the norm"));
    row(
        "time",
        &format!(
            "factors {}, harmonic fields {}, solve {}",
            time(timing.factor),
            time(timing.basis),
            time(timing.solve)
        ),
    );
    text
}

/// Six digits: what a person compares.
fn short(x: f64) -> String {
    plain(format!("{x:.5e}").parse().unwrap_or(x))
}
