//! Proven lower bounds on the scaled Jacobian over whole cells.
//!
//! The length of a polynomial vector is at most the polynomial whose Bernstein coefficients are the lengths of its own. So the product of the
//! lengths of the three derivatives is at most a polynomial of the degree of the determinant, and the least quotient of their coefficients is a
//! lower bound on the scaled Jacobian. Boxes of parameters are divided into eight where it is less than a value that is attained, by more than
//! [`SCALED_JACOBIAN_GAP`]; the difference falls with the square of their size.

use crate::bezier_jacobian::CubicBox;
use crate::jacobian::LinearBox;
use crate::parameter_box::ParameterBox;
use glam::DVec3;

/// Largest distance of a bound from a value that is attained, unless a limit on divisions is reached.
pub const SCALED_JACOBIAN_GAP: f64 = 1e-3;

/// Largest number of divisions along each axis.
pub(crate) const DEPTH: usize = 8;

/// Largest number of boxes of a cell.
const MOST_BOXES: usize = 2000;

/// Rounding of a quotient of two coefficients, relative to it.
///
/// # Accuracy
/// The divisor is a sum of at most 48 times 48 positive products of three lengths, in two sums that follow one another, with factors exact to 6 u
/// as in the determinant: less than 128 u. The lengths and the quotient have at most 12 u. The sum is doubled.
const RELATIVE: f64 = 280.0 * 1.110_223_024_625_156_5e-16;

/// A lower bound on the scaled Jacobian over a box; −1 if the determinant is not proven to be positive.
fn lower(part: &impl ParameterBox) -> f64 {
    let mut least = f64::INFINITY;
    part.coefficients(|determinant, size| {
        let is_proven = determinant > 0.0 && size.is_normal();
        let quotient = if is_proven { determinant / size * (1.0 - RELATIVE) } else { -1.0 };
        least = if quotient < least { quotient } else { least };
    });
    least
}

/// A lower bound on the scaled Jacobian over a cell, that is not improved beyond `attained`: a value that it has somewhere, in this cell or in
/// another one of the mesh.
fn bound<P: ParameterBox>(cell: P, attained: f64) -> f64 {
    let (mut upper, mut found) = (attained, f64::INFINITY);
    let (mut left, mut stack) = (MOST_BOXES, vec![(cell, 0)]);
    while let Some((part, depth)) = stack.pop() {
        let low = lower(&part);
        let at_corners = part.attained();
        if at_corners < upper {
            upper = at_corners;
        }
        left = left.saturating_sub(1);
        if low >= upper - SCALED_JACOBIAN_GAP || depth == DEPTH || left == 0 {
            found = if low < found { low } else { found };
        } else if found > low {
            stack.extend(part.divided().map(|part| (part, depth + 1)));
        }
    }
    found
}

/// A lower bound on the scaled Jacobian over the whole of a trilinear cell: the determinant over the product of the lengths of the three
/// derivatives. It is within [`SCALED_JACOBIAN_GAP`] of the lesser one of `attained` and the least value in the cell, unless the cell is nearly folded.
///
/// # Accuracy
/// Proven for the corners as stored, rounding included; −1 if nothing is.
/// # Cost
/// A few hundred divisions for a cell with the least value, one evaluation for most others.
pub fn scaled_jacobian_bound(corners: &[DVec3; 8], attained: f64) -> f64 {
    bound(LinearBox::new(corners), attained)
}

/// The same over the whole of a tricubic cell.
///
/// # Accuracy
/// Proven for the control points as stored, rounding included; −1 if nothing is.
pub fn scaled_jacobian_bound_bezier(points: &[DVec3; 64], attained: f64) -> f64 {
    bound(CubicBox::new(points), attained)
}
