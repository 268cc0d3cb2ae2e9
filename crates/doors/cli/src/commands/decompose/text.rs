//! What the splitting found, for people.

use crate::numbers::{grouped, plain, time};
use crate::printer::LABEL;
use pompeiu::fields::{DegreesOfFreedom, Quality};
use pompeiu::surface::SurfaceMesh;
use std::fmt::Write;
use std::time::Duration;

/// A field that was split.
pub(super) struct Split {
    pub(super) quality: Quality,
    pub(super) factor: Duration,
    pub(super) basis: Duration,
    pub(super) solve: Duration,
    pub(super) total: Duration,
}

pub(super) struct Report {
    pub(super) path: String,
    pub(super) faces: usize,
    pub(super) genus: usize,
    pub(super) boundary_loops: usize,
    pub(super) components: usize,
    pub(super) degrees_of_freedom: DegreesOfFreedom,
    pub(super) split: Option<Split>,
}

impl Report {
    pub(super) fn new(
        path: String,
        mesh: &SurfaceMesh,
        degrees_of_freedom: DegreesOfFreedom,
        split: Option<Split>,
    ) -> Self {
        Self {
            path,
            faces: mesh.faces(),
            genus: mesh.genus(),
            boundary_loops: mesh.boundary_loops().len(),
            components: mesh.components(),
            degrees_of_freedom,
            split,
        }
    }

    pub(super) fn text(&self) -> String {
        let number = |n: usize| grouped(n as u64);
        let mut text = String::new();
        let mut row = |label: &str, value: &str| {
            let _ = writeln!(text, "{LABEL}{label:<22}{LABEL:#}{value}");
        };
        row("mesh", &self.path);
        row("faces", &number(self.faces));
        row("components", &number(self.components));
        row("genus", &number(self.genus));
        row("boundary loops", &number(self.boundary_loops));
        row("harmonic fields", &number(self.degrees_of_freedom.harmonic));
        row("degrees of freedom", &number(self.degrees_of_freedom.total));
        for (label, ranks) in [
            ("  mixed", self.degrees_of_freedom.mixed),
            ("  conforming only", self.degrees_of_freedom.conforming),
            ("  nonconforming only", self.degrees_of_freedom.nonconforming),
        ] {
            let meaning = match ranks.residual_dimension {
                n if n < 0 => ": the spaces overlap".to_owned(),
                0 => String::new(),
                n if n == self.degrees_of_freedom.harmonic.cast_signed() => {
                    ": the harmonic fields".to_owned()
                }
                _ => format!(", {} of them harmonic", number(self.degrees_of_freedom.harmonic)),
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
        let Some(split) = &self.split else { return text };
        let Quality { residual, inner_products, norms, part_error } = split.quality;
        let share = |norm: f64| {
            let part = if norms.field > 0.0 { norm / norms.field } else { 0.0 };
            format!("{} ({:.3} % of the energy)", short(norm), 100.0 * part * part)
        };
        row("norm of the field", &short(norms.field));
        row("  gradient", &share(norms.gradient));
        row("  rotated gradient", &share(norms.rotated));
        row("  harmonic", &share(norms.harmonic));
        row("residual", &format!("{residual:.1e} of the norm"));
        let products = [
            inner_products.gradient_rotated,
            inner_products.gradient_harmonic,
            inner_products.rotated_harmonic,
        ];
        let largest = products.into_iter().fold(0.0, |m, x: f64| if x.abs() > m { x.abs() } else { m });
        row("inner products", &format!("at most {largest:.1e} of the squared norm"));
        row("error of each part", &format!("at most {part_error:.1e} of the norm"));
        row(
            "time",
            &format!(
                "factors {}, harmonic fields {}, solve {}",
                time(split.factor),
                time(split.basis),
                time(split.solve)
            ),
        );
        text
    }
}

/// Six digits: what a person compares.
fn short(x: f64) -> String {
    plain(format!("{x:.5e}").parse().unwrap_or(x))
}
