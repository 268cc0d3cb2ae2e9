//! How much randomised tests try, by the environment variable `POMPEIU_TEST_EFFORT`.

use std::env;

const VARIABLE: &str = "POMPEIU_TEST_EFFORT";
/// Fewer cases than these are never tried, unless a test has fewer of its own.
const LEAST: u32 = 16;

/// The number of random cases to try, given that of an ordinary run: an eighth with `short`, so many with `usual` or when the
/// variable is not set, twenty times as many with `long`.
///
/// # Panics
/// The variable has another value.
pub fn cases(usual: u32) -> u32 {
    let level = env::var_os(VARIABLE).unwrap_or_else(|| "usual".into());
    at_level(usual, &level.to_string_lossy())
}

fn at_level(usual: u32, level: &str) -> u32 {
    match level {
        "short" => (usual / 8).max(LEAST).min(usual),
        "usual" => usual,
        "long" => usual.saturating_mul(20),
        other => panic!("{VARIABLE} is {other:?}, which is none of short, usual and long"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_scale_the_number_of_cases() {
        assert_eq!(["short", "usual", "long"].map(|level| at_level(4000, level)), [500, 4000, 80_000]);
        assert_eq!([64, 10].map(|usual| at_level(usual, "short")), [16, 10]);
    }

    #[test]
    #[should_panic(expected = "is \"loud\"")]
    fn other_levels_are_refused() {
        at_level(100, "loud");
    }
}
