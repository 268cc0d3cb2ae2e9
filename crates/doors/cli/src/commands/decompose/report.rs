//! What the splitting found, for people and for programs.

use crate::numbers::{grouped, plain, time};
use crate::printer::LABEL;
use pompeiu::fields::Audit;
use pompeiu::fields::{OneKind, Quality};
use pompeiu::surface::SurfaceMesh;
use serde::Serialize;
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
    path: String,
    faces: usize,
    genus: usize,
    boundary_loops: usize,
    components: usize,
    audit: Audit,
    split: Option<Split>,
}

impl Report {
    pub(super) fn new(path: String, mesh: &SurfaceMesh, audit: Audit, split: Option<Split>) -> Self {
        Self {
            path,
            faces: mesh.faces(),
            genus: mesh.genus(),
            boundary_loops: mesh.boundary_loops().len(),
            components: mesh.components(),
            audit,
            split,
        }
    }

    pub(super) fn json(&self) -> serde_json::Result<String> {
        let quality = self.split.as_ref().map(|split| split.quality);
        let json = Json {
            path: &self.path,
            faces: self.faces,
            genus: self.genus,
            boundary_loops: self.boundary_loops,
            components: self.components,
            harmonic_dimension: self.audit.harmonic,
            degrees_of_freedom: Freedom {
                total: self.audit.degrees_of_freedom,
                mixed: self.audit.mixed.into(),
                conforming: self.audit.conforming.into(),
                nonconforming: self.audit.nonconforming.into(),
            },
            residual: quality.map(|q| q.residual),
            part_error: quality.map(|q| q.part_error),
            inner_products: quality.map(|q| InnerProducts {
                gradient_rotated: q.inner_products.gradient_rotated,
                gradient_harmonic: q.inner_products.gradient_harmonic,
                rotated_harmonic: q.inner_products.rotated_harmonic,
            }),
            norms: quality.map(|q| Norms {
                field: q.norms.field,
                gradient: q.norms.gradient,
                rotated: q.norms.rotated,
                harmonic: q.norms.harmonic,
            }),
            timing_ms: self.split.as_ref().map(|split| Timing {
                factor: milliseconds(split.factor),
                solve: milliseconds(split.solve),
                basis: milliseconds(split.basis),
                total: milliseconds(split.total),
            }),
        };
        Ok(serde_json::to_string(&json)? + "\n")
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
        row("harmonic fields", &number(self.audit.harmonic));
        row("degrees of freedom", &number(self.audit.degrees_of_freedom));
        for (label, kind) in [
            ("  mixed", self.audit.mixed),
            ("  conforming only", self.audit.conforming),
            ("  nonconforming only", self.audit.nonconforming),
        ] {
            let left = match kind.left_over {
                n if n < 0 => format!("{} too many", number(n.unsigned_abs())),
                0 => "none left".to_owned(),
                n if n == self.audit.harmonic.cast_signed() => {
                    format!("{} left: the harmonic fields", number(n.unsigned_abs()))
                }
                n => format!(
                    "{} left, {} of them harmonic",
                    number(n.unsigned_abs()),
                    number(self.audit.harmonic)
                ),
            };
            let ranks =
                format!("{} gradients + {} rotated, {left}", number(kind.gradient), number(kind.rotated));
            row(label, &ranks);
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

fn milliseconds(span: Duration) -> f64 {
    span.as_secs_f64() * 1e3
}

#[derive(Serialize)]
struct Json<'r> {
    path: &'r str,
    faces: usize,
    genus: usize,
    boundary_loops: usize,
    components: usize,
    harmonic_dimension: usize,
    degrees_of_freedom: Freedom,
    #[serde(skip_serializing_if = "Option::is_none")]
    residual: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    part_error: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    inner_products: Option<InnerProducts>,
    #[serde(skip_serializing_if = "Option::is_none")]
    norms: Option<Norms>,
    #[serde(skip_serializing_if = "Option::is_none")]
    timing_ms: Option<Timing>,
}

#[derive(Serialize)]
struct Freedom {
    total: usize,
    mixed: Kind,
    conforming: Kind,
    nonconforming: Kind,
}

#[derive(Serialize)]
struct Kind {
    gradient: usize,
    rotated: usize,
    left_over: isize,
}

impl From<OneKind> for Kind {
    fn from(kind: OneKind) -> Self {
        Self { gradient: kind.gradient, rotated: kind.rotated, left_over: kind.left_over }
    }
}

#[derive(Serialize)]
struct InnerProducts {
    gradient_rotated: f64,
    gradient_harmonic: f64,
    rotated_harmonic: f64,
}

#[derive(Serialize)]
struct Norms {
    field: f64,
    gradient: f64,
    rotated: f64,
    harmonic: f64,
}

#[derive(Serialize)]
struct Timing {
    factor: f64,
    solve: f64,
    basis: f64,
    total: f64,
}
