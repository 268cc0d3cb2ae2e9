//! Distances between fields.

use crate::common::Field;
use pompeiu_surface::Surface;

pub(crate) fn norm(surface: &Surface, field: &Field) -> f64 {
    pompeiu_operators::field_norm(surface, field)
}

/// `‖u − w‖`.
pub(crate) fn distance(surface: &Surface, u: &Field, w: &Field) -> f64 {
    norm(surface, &Field::from_fn(u.len(), |f| [u[f][0] - w[f][0], u[f][1] - w[f][1]]))
}

pub(crate) fn sum(fields: &[&Field]) -> Field {
    Field::from_fn(fields[0].len(), |f| [0, 1].map(|i| fields.iter().map(|u| u[f][i]).sum()))
}
