//! Scaling of fields by powers of two.

use pompeiu_operators::{FaceField, OperatorError};

/// The field scaled by the power of two that brings its largest component between 1 and 2, and the exponent of the inverse; a zero
/// field is unchanged.
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

/// The exponent of the greatest power of two that is at most `x`; 0 for 0.
fn exponent(x: f64) -> i32 {
    const BIAS: i32 = 1023;
    /// Scales the least subnormal number into the normal range.
    const SHIFT: i32 = 64;
    if x == 0.0 {
        0
    } else if x < f64::MIN_POSITIVE {
        exponent(times_power_of_two(x, SHIFT)) - SHIFT
    } else {
        ((x.to_bits() >> 52) & 0x7ff) as i32 - BIAS
    }
}

/// `x 2^exponent`, for exponents up to 2000 either way.
pub(crate) fn times_power_of_two(x: f64, exponent: i32) -> f64 {
    let power = |exponent: i32| f64::from_bits(((exponent + 1023) as u64) << 52);
    let half = exponent / 2;
    x * power(half) * power(exponent - half)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_size_is_brought_near_one_and_back() {
        for x in [1.0, 1.75, -3.0, 1e300, -1e-300, f64::MAX, f64::MIN_POSITIVE, 5e-324, 7e-320] {
            let field = FaceField::filled(2, [x, 0.25 * x]);
            let (near_one, exponent) = normalized(&field);
            let size = near_one[pompeiu_core::FaceId(0)][0].abs();
            assert!((1.0..2.0).contains(&size), "{x:e}: {size}");
            let mut values = near_one.as_flattened().to_vec();
            restore(&mut values, exponent, &field).unwrap();
            assert_eq!(values, field.as_flattened(), "{x:e}");
        }
        let (zero, exponent) = normalized(&FaceField::filled(1, [0.0; 2]));
        assert_eq!((zero.as_flattened(), exponent), (&[0.0; 2][..], 0));
        let field = FaceField::filled(1, [1e308, 0.0]);
        let error = restore(&mut [1.9], 1023, &field);
        assert!(error.is_ok());
        let error = restore(&mut [2.0], 1023, &field).unwrap_err();
        assert_eq!(error, OperatorError::FieldTooLarge { largest: 1e308 });
    }
}
