//! How far apart fields are.

use crate::common::Field;
use pompeiu_surface::Surface;

pub(crate) fn norm(surface: &Surface, field: &[[f64; 2]]) -> f64 {
    pompeiu_operators::field_norm(surface, field)
}

/// `‖u − w‖`.
pub(crate) fn distance(surface: &Surface, u: &[[f64; 2]], w: &[[f64; 2]]) -> f64 {
    let difference: Field = u.iter().zip(w).map(|(a, b)| [a[0] - b[0], a[1] - b[1]]).collect();
    norm(surface, &difference)
}

pub(crate) fn sum(fields: &[&Field]) -> Field {
    (0..fields[0].len()).map(|f| [0, 1].map(|i| fields.iter().map(|u| u[f][i]).sum())).collect()
}
