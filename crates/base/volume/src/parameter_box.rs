//! Boxes of parameters of cells, on which scaled Jacobians are bounded.

use glam::DVec3;

/// A box of parameters of a cell.
pub(crate) trait ParameterBox: Sized {
    /// Calls an action with lower bounds on the coefficients of the determinant, and the coefficients of a polynomial that is at least the
    /// product of the lengths of the derivatives, but for rounding.
    fn coefficients(&self, act: impl FnMut(f64, f64));
    /// The least scaled Jacobian at its corners.
    fn attained(&self) -> f64;
    /// The eight parts.
    fn divided(&self) -> [Self; 8];
}

/// The least value; NaN if one is no number.
pub(crate) fn least(values: &[f64]) -> f64 {
    values.iter().fold(f64::INFINITY, |least, &x| if x >= least { least } else { x })
}

/// The greatest length; infinite if one is no number.
pub(crate) fn greatest(vectors: &[DVec3]) -> f64 {
    let lengths = vectors.iter().map(|v| v.length());
    lengths.fold(0.0, |most, length| {
        if length <= most {
            most
        } else if length.is_nan() {
            f64::INFINITY
        } else {
            length
        }
    })
}
