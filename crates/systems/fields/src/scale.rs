//! Scaling of fields by powers of two.

use pompeiu_operators::{FaceField, OperatorError};

/// The field scaled by the power of two that brings its largest component between 1 and 2, and the exponent of the inverse; a zero
/// field is unchanged, one of subnormal numbers is brought between 2^-51 and 1.
///
/// Squared lengths of the result neither overflow nor underflow, whatever the magnitude of the field. Only components below
/// `2^-1022` of the largest are rounded.
pub(crate) fn normalized(field: &FaceField) -> (FaceField, i32) {
    let exponent = exponent(largest(field));
    (field.map(|&u| u.map(|x| times_power_of_two(x, -exponent))), exponent)
}

/// Undoes [`normalized`] on a result that is linear in the field.
///
/// # Errors
/// [`OperatorError::FieldTooLarge`] if a result exceeds the range of doubles.
pub(crate) fn restore(values: &mut [f64], exponent: i32, field: &FaceField) -> Result<(), OperatorError> {
    for value in &mut *values {
        *value = times_power_of_two(*value, exponent);
    }
    if values.iter().all(|x| x.is_finite()) {
        Ok(())
    } else {
        Err(OperatorError::FieldTooLarge { largest: largest(field) })
    }
}

fn largest(field: &FaceField) -> f64 {
    field.as_flattened().iter().fold(0.0, |m, x| if x.abs() > m { x.abs() } else { m })
}

/// The exponent of the greatest power of two that is at most `x`; 0 for 0, and −1023 for subnormal numbers.
fn exponent(x: f64) -> i32 {
    const BIAS: i32 = 1023;
    if x == 0.0 { 0 } else { ((x.to_bits() >> 52) & 0x7ff) as i32 - BIAS }
}

/// `x 2^exponent`, for exponents up to 2000 either way.
pub(crate) fn times_power_of_two(x: f64, exponent: i32) -> f64 {
    let power = |exponent: i32| f64::from_bits(((exponent + 1023) as u64) << 52);
    let half = exponent / 2;
    x * power(half) * power(exponent - half)
}
