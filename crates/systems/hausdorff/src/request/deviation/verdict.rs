//! Whether two meshes are within a tolerance.

use super::report::{DeviationReport, Verdict, VerdictAnswer};
use crate::Enclosure;
use crate::deviation::{BandReport, Deviation, DirectedBands, DirectedDeviation, Extreme};
use crate::digits::{between, brief, briefly_agreed, percentage, shortest};

impl DeviationReport {
    /// Answers the question, if there is one. `allowed` is the share of each area that may be outside.
    pub(super) fn judge(&mut self, allowed: f64, unit: &str) {
        let answer = match (&self.bands, self.threshold) {
            (Some(bands), _) => of_bands(bands, allowed),
            (None, Some(threshold)) => of_threshold(&self.deviation, threshold, allowed),
            (None, None) => return,
        };
        self.verdict = Some(Verdict { answer, allowed, sentence: String::new() });
        let sentence = self.sentence(["A", "B"], unit).unwrap_or_default();
        self.verdict = Some(Verdict { answer, allowed, sentence });
    }

    /// The verdict in a sentence that a person acts on, with other names of the two meshes; none without a verdict.
    pub fn sentence(&self, names: [&str; 2], unit: &str) -> Option<String> {
        let Verdict { answer, allowed, .. } = *self.verdict.as_ref()?;
        let head = match answer {
            VerdictAnswer::Within => "WITHIN TOLERANCE",
            VerdictAnswer::Out => "OUT OF TOLERANCE",
            VerdictAnswer::Undecided => "UNDECIDED AT TOLERANCE",
        };
        let length = |text: String| if unit.is_empty() { text } else { format!("{text} {unit}") };
        let may_be = match allowed {
            0.0 => String::new(),
            share => format!(" ({} % of each area may be)", percent(share)),
        };
        let is_within = answer == VerdictAnswer::Within;
        let rest = if let Some(bands) = &self.bands {
            beyond_bands(bands, names, &length, is_within && allowed == 0.0) + &may_be
        } else {
            let threshold = self.threshold.unwrap_or(0.0);
            beyond(&self.deviation, threshold, names, &length, (is_within, &may_be))
        };
        Some(format!("{head} {rest}"))
    }
}

/// A share in percent, without what rounding left over.
fn percent(share: f64) -> f64 {
    (share * 1e12).round() / 1e10
}

/// With nothing allowed, the largest distance decides; else the shares of the areas that are farther. A surface without area has
/// no share that is farther.
fn of_threshold(deviation: &Deviation, threshold: f64, allowed: f64) -> VerdictAnswer {
    if allowed == 0.0 {
        return VerdictAnswer::of(deviation.distance, threshold);
    }
    VerdictAnswer::of_both([&deviation.a_to_b, &deviation.b_to_a].map(|directed| {
        share(directed).map_or(VerdictAnswer::Within, |share| VerdictAnswer::of(share, allowed))
    }))
}

/// With nothing allowed, the least and the greatest deviation decide; else the shares outside of all bands.
fn of_bands(report: &BandReport, allowed: f64) -> VerdictAnswer {
    let [least, greatest] = ends(report);
    VerdictAnswer::of_both([&report.a_to_b, &report.b_to_a].map(|found| {
        if allowed > 0.0 {
            return outside(found).map_or(VerdictAnswer::Within, |share| VerdictAnswer::of(share, allowed));
        }
        let DirectedBands { lowest, highest, .. } = found;
        if lowest.lower >= least && highest.upper <= greatest {
            VerdictAnswer::Within
        } else if lowest.upper < least || highest.lower > greatest {
            VerdictAnswer::Out
        } else {
            VerdictAnswer::Undecided
        }
    }))
}

fn share(directed: &DirectedDeviation) -> Option<Enclosure> {
    directed.statistics.as_ref()?.above.as_ref().map(|above| above.share)
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

fn shown(share: Enclosure) -> String {
    percentage(share.lower(), share.upper())
}

/// What is farther than the threshold.
fn beyond(
    deviation: &Deviation,
    threshold: f64,
    names: [&str; 2],
    length: &dyn Fn(String) -> String,
    (is_within, may_be): (bool, &str),
) -> String {
    let of = |name: &str, directed: &DirectedDeviation| match share(directed) {
        Some(share) => format!("{} of {name}'s area", shown(share)),
        None => format!("{name} has no area"),
    };
    let is_free = |directed: &DirectedDeviation| share(directed).is_none_or(|share| share.upper() == 0.0);
    let worst = length(brief(deviation.distance.lower(), deviation.distance.upper()));
    let threshold = length(shortest(threshold));
    let (a, b) = (&deviation.a_to_b, &deviation.b_to_a);
    if is_within && is_free(a) && is_free(b) {
        return format!("{threshold}: nothing is beyond it; worst {worst}");
    }
    let [left, right] = [of(names[0], a), of(names[1], b)];
    format!("{threshold}: beyond it {left}, {right}{may_be}; worst {worst}")
}

/// What is outside of the bands.
fn beyond_bands(
    report: &BandReport,
    [a, b]: [&str; 2],
    length: &dyn Fn(String) -> String,
    is_within: bool,
) -> String {
    let [least, greatest] = ends(report).map(shortest);
    let band = length(format!("{least}..{greatest}"));
    let found = [&report.a_to_b, &report.b_to_a];
    let lowest = least_of(found.map(|found| found.lowest)).shown();
    let highest = greatest_of(found.map(|found| found.highest)).shown();
    let worst = format!("least {}, greatest {}", length(lowest), length(highest));
    if is_within {
        return format!("{band}: nothing is outside of it; {worst}");
    }
    let of = |class: fn(&DirectedBands) -> Option<Enclosure>| {
        let [left, right] = found
            .map(|found| class(found).map_or_else(|| "none".to_owned(), shown))
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

impl Extreme {
    /// A signed number in no more digits than are certain.
    pub fn shown(&self) -> String {
        let Self { lower, upper } = *self;
        if lower >= 0.0 {
            return brief(lower, upper);
        }
        if upper <= 0.0 {
            return match briefly_agreed(-upper, -lower) {
                Some(size) => format!("-{size}"),
                None => negated(&between(-upper, -lower)),
            };
        }
        let end = |x: f64| between(x, x).split(" to ").last().unwrap_or_default().to_owned();
        format!("-{} to {}", end(-lower), end(upper))
    }
}

/// An interval of negative numbers, for that of their sizes.
fn negated(sizes: &str) -> String {
    match (sizes.split_once(" to "), sizes.strip_prefix("at most ")) {
        (Some((least, greatest)), _) => format!("-{greatest} to -{least}"),
        (None, Some(greatest)) => format!("-{greatest} to 0"),
        (None, None) => format!("-{sizes}"),
    }
}

impl BandReport {
    /// What the classes are called, from the lowest.
    pub fn class_names(&self) -> Vec<String> {
        class_names(&self.edges)
    }
}

fn class_names(edges: &[f64]) -> Vec<String> {
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
        let shown = |lower, upper| Extreme { lower, upper }.shown();
        assert_eq!(shown(0.1, 0.1), "0.1");
        assert_eq!(shown(-0.100_000_01, -0.1), "-0.1");
        assert_eq!(shown(-0.2, -0.1), "-0.2 to -0.1");
        assert_eq!(shown(-0.2, 0.0), "-0.2 to 0");
        assert_eq!(shown(-0.123_44, 0.2), "-0.1235 to 0.2");
    }

    #[test]
    fn classes_are_named_by_their_ends() {
        assert_eq!(class_names(&[-0.1, 0.0, 0.2]), ["below -0.1", "-0.1..0", "0..0.2", "above 0.2"]);
    }
}
