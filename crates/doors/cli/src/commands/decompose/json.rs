//! What the splitting found, as one JSON object.

use super::text::Report;
use crate::json::milliseconds;
use pompeiu::fields::OneKind;
use serde::Serialize;

impl Report {
    /// The report on one line.
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
