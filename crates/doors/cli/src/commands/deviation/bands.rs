//! Signed tolerance bands in answers for people.

use super::full::percentage;
use super::verdict::{Answer, Verdict, answer};
use crate::numbers::{between, brief, briefly_agreed, shortest};
use pompeiu::hausdorff::Enclosure;
use pompeiu::hausdorff::deviation::{BandReport, DirectedBands, Extreme};

/// With nothing allowed, the least and the greatest deviation decide; else the shares outside of all bands.
pub(super) fn verdict(report: &BandReport, allowed: f64) -> Verdict {
    let [least, greatest] = ends(report);
    let both = [&report.a_to_b, &report.b_to_a].map(|found| {
        if allowed > 0.0 {
            return outside(found).map_or(Answer::Within, |share| answer(share, allowed));
        }
        let DirectedBands { lowest, highest, .. } = found;
        if lowest.lower >= least && highest.upper <= greatest {
            Answer::Within
        } else if lowest.upper < least || highest.lower > greatest {
            Answer::Out
        } else {
            Answer::Undecided
        }
    });
    Verdict { answer: Answer::of_both(both), allowed }
}

fn ends(report: &BandReport) -> [f64; 2] {
    [0, report.edges.len() - 1].map(|i| report.edges[i])
}

/// The share of the area that is too low or too high.
fn outside(found: &DirectedBands) -> Option<Enclosure> {
    let shares = found.shares.as_ref()?;
    let (first, last) = (shares.first()?, shares.last()?);
    let (low, high) = (first.lower() + last.lower(), first.upper() + last.upper());
    Enclosure::new(low.next_down().max(0.0), if high < 1.0 { high.next_up() } else { 1.0 })
}

/// The sentence that a person acts on, after its head.
pub(super) fn sentence(
    report: &BandReport,
    [a, b]: [&str; 2],
    length: &dyn Fn(String) -> String,
    is_within: bool,
) -> String {
    let [least, greatest] = ends(report).map(shortest);
    let band = length(format!("{least}..{greatest}"));
    let found = [&report.a_to_b, &report.b_to_a];
    let lowest = extreme(least_of(found.map(|found| found.lowest)));
    let highest = extreme(greatest_of(found.map(|found| found.highest)));
    let worst = format!("least {}, greatest {}", length(lowest), length(highest));
    if is_within {
        return format!("{band}: nothing is outside of it; {worst}");
    }
    let of = |class: fn(&DirectedBands) -> Option<Enclosure>| {
        let [left, right] = found
            .map(|found| class(found).map_or_else(|| "none".to_owned(), percentage))
            .map(|share| if share == "0 %" { "nothing".to_owned() } else { share });
        format!("{left} of {a}'s area, {right} of {b}'s")
    };
    format!(
        "{band}: too low {}; too high {}; {worst}",
        of(|found| found.shares.as_ref()?.first().copied()),
        of(|found| found.shares.as_ref()?.last().copied())
    )
}

fn least_of([x, y]: [Extreme; 2]) -> Extreme {
    Extreme { lower: x.lower.min(y.lower), upper: x.upper.min(y.upper) }
}

fn greatest_of([x, y]: [Extreme; 2]) -> Extreme {
    Extreme { lower: x.lower.max(y.lower), upper: x.upper.max(y.upper) }
}

/// A signed number in no more digits than are certain.
pub(super) fn extreme(found: Extreme) -> String {
    let Extreme { lower, upper } = found;
    if lower >= 0.0 {
        return brief(lower, upper);
    }
    if upper <= 0.0 {
        return match briefly_agreed(-upper, -lower) {
            Some(size) => format!("-{size}"),
            None => format!("minus {}", between(-upper, -lower)),
        };
    }
    let end = |x: f64| between(x, x).split(" to ").last().unwrap_or_default().to_owned();
    format!("-{} to {}", end(-lower), end(upper))
}

/// What the classes are called, from the lowest.
pub(super) fn names(edges: &[f64]) -> Vec<String> {
    let all: Vec<String> = edges.iter().copied().map(shortest).collect();
    let inner = all.windows(2).map(|ends| format!("{}..{}", ends[0], ends[1]));
    let (first, last) = (all.first().cloned().unwrap_or_default(), all.last().cloned().unwrap_or_default());
    std::iter::once(format!("below {first}")).chain(inner).chain([format!("above {last}")]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signed_numbers_keep_their_sign_and_their_doubt() {
        let shown = |lower, upper| extreme(Extreme { lower, upper });
        assert_eq!(shown(0.1, 0.1), "0.1");
        assert_eq!(shown(-0.100_000_01, -0.1), "-0.1");
        assert_eq!(shown(-0.2, -0.1), "minus 0.1 to 0.2");
        assert_eq!(shown(-0.123_44, 0.2), "-0.1235 to 0.2");
    }

    #[test]
    fn classes_are_named_by_their_ends() {
        assert_eq!(names(&[-0.1, 0.0, 0.2]), ["below -0.1", "-0.1..0", "0..0.2", "above 0.2"]);
    }
}
