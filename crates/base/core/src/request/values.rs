//! Values of options from the text that a person writes. Errors say what is expected.

/// Numbers separated by commas.
///
/// # Errors
/// If there are not so many, or one of them is no number.
pub fn tuple<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let numbers: Vec<f64> = text
        .split(',')
        .map(|part| part.trim().parse::<f64>().map_err(|_| format!("`{part}` is not a number")))
        .collect::<Result<_, _>>()?;
    let found = numbers.len();
    numbers.try_into().map_err(|_| format!("expected {N} numbers separated by commas, found {found}"))
}

/// A direction: a coordinate, or three finite numbers that are not all zero.
///
/// # Errors
/// If it is neither.
pub fn direction(text: &str) -> Result<[f64; 3], String> {
    match text {
        "x" => Ok([1.0, 0.0, 0.0]),
        "y" => Ok([0.0, 1.0, 0.0]),
        "z" => Ok([0.0, 0.0, 1.0]),
        _ => {
            let direction = tuple::<3>(text).ok();
            let usable = direction.filter(|d| d.iter().all(|x| x.is_finite()) && *d != [0.0; 3]);
            usable.ok_or_else(|| "expected x, y, z or three numbers separated by commas".to_owned())
        }
    }
}

/// A count, or two separated by a comma.
///
/// # Errors
/// If it is neither.
pub fn counts(text: &str) -> Result<[u32; 2], String> {
    let parse = |part: &str| part.trim().parse().map_err(|_| format!("`{part}` is not a count"));
    match text.split(',').collect::<Vec<_>>()[..] {
        [both] => parse(both).map(|n| [n, n]),
        [n, m] => Ok([parse(n)?, parse(m)?]),
        ref parts => Err(format!("expected one count, or two separated by a comma, found {}", parts.len())),
    }
}

/// A length or a fraction: a finite number that is not negative.
///
/// # Errors
/// If it is not.
pub fn magnitude(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() && x >= 0.0 => Ok(x),
        _ => Err("expected a finite number that is not negative".to_owned()),
    }
}

/// A fraction that is not negative, also in percent.
///
/// # Errors
/// If it is not.
pub fn fraction(text: &str) -> Result<f64, String> {
    let (number, whole) = text.trim().strip_suffix('%').map_or((text, 1.0), |percent| (percent, 100.0));
    match number.trim().parse::<f64>() {
        Ok(x) if x.is_finite() && x >= 0.0 => Ok(x / whole),
        _ => Err("expected a finite number that is not negative, such as 0.01 or 1%".to_owned()),
    }
}

/// A share above 0 and at most 1, also in percent.
///
/// # Errors
/// If it is not.
pub fn share(text: &str) -> Result<f64, String> {
    let (number, whole) = text.trim().strip_suffix('%').map_or((text, 1.0), |percent| (percent, 100.0));
    match number.trim().parse::<f64>() {
        Ok(share) if share > 0.0 && share <= whole => Ok(share / whole),
        _ => Err("expected a share above 0 and at most 1, such as 0.5 or 50%".to_owned()),
    }
}

/// Indices of vertices, edges or faces separated by commas, at least so many.
///
/// # Errors
/// If there are fewer, or one of them is no index.
pub fn indices(text: &str, least: usize) -> Result<Vec<u32>, String> {
    let index =
        |part: &str| part.trim().parse().map_err(|_| format!("`{part}` is no index; they count from 0"));
    let found: Vec<u32> = text.split(',').map(index).collect::<Result<_, _>>()?;
    if found.len() >= least { Ok(found) } else { Err(format!("expected at least {least} indices")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_parsed_or_explained() {
        assert_eq!(tuple::<3>("1, -2e3,0.5"), Ok([1.0, -2000.0, 0.5]));
        assert_eq!(tuple::<3>("1,2").unwrap_err(), "expected 3 numbers separated by commas, found 2");
        assert_eq!(tuple::<2>("1,x").unwrap_err(), "`x` is not a number");
        assert_eq!((counts("3"), counts("3,4")), (Ok([3, 3]), Ok([3, 4])));
        assert!(counts("1,2,3").is_err() && counts("-1").is_err() && counts("").is_err());
        assert_eq!(indices("3,4, 5", 2), Ok(vec![3, 4, 5]));
        assert!(["", "3", "3,x", "3,-1"].iter().all(|wrong| indices(wrong, 2).is_err()));
    }

    #[test]
    fn directions_are_coordinates_or_numbers() {
        assert_eq!((direction("y"), direction("0,-1,2")), (Ok([0.0, 1.0, 0.0]), Ok([0.0, -1.0, 2.0])));
        assert!(["w", "0,0,0", "1,inf,0", "1,2", ""].iter().all(|t| direction(t).is_err()));
    }

    #[test]
    fn magnitudes_and_shares_have_a_range() {
        assert_eq!(magnitude("1e-12"), Ok(1e-12));
        assert!(["-1", "nan", "inf", "1m", ""].iter().all(|t| magnitude(t).is_err()));
        assert_eq!((fraction("1e-3"), fraction("0.1%"), fraction("250 %")), (Ok(1e-3), Ok(1e-3), Ok(2.5)));
        assert!(["-1%", "nan", "%", "", "1mm"].iter().all(|t| fraction(t).is_err()));
        assert_eq!(["0.3", "30 %", "100%", "1"].map(share), [Ok(0.3), Ok(0.3), Ok(1.0), Ok(1.0)]);
        assert!(["0", "1.5", "-1", "nan", "", "%", "101%"].iter().all(|text| share(text).is_err()));
    }
}
