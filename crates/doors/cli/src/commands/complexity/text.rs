//! The outcome for people.

use super::Files;
use crate::door::AnswerOf;
use crate::exit::stopped_by;
use crate::numbers::{few, grouped, time};
use crate::page::Page;
use pompeiu::complexity::{Clusters, Direction, Measure};
use std::fmt::Write;

/// A line for each shape, from the simplest to the most complex, and what is said of all of them.
pub(super) fn text(answer: &AnswerOf<Files>) -> String {
    let report = &answer.report;
    let mut text = String::new();
    let widest = report.ranking.iter().map(|ranked| ranked.file.chars().count()).max().unwrap_or(0).max(4);
    let has_other = report.agreement.is_some();
    let against = |place: Option<f64>| match (has_other, place) {
        (true, Some(place)) => format!("  {place:>7}"),
        (true, None) => format!("  {:>7}", ""),
        (false, _) => String::new(),
    };
    let head = if has_other { "  against" } else { "" };
    let cluster_head = if report.clusters.is_some() { "  cluster" } else { "" };
    let _ = writeln!(text, "{:>6}{head}  {:<widest$}  {}{cluster_head}", "rank", "file", report.ranked_by);
    for ranked in &report.ranking {
        let cluster = report.clusters.as_ref().and_then(|clusters| {
            let index = report.shapes.iter().position(|shape| shape.file == ranked.file)?;
            Some(clusters.labels[index] + 1)
        });
        let value = few(ranked.value);
        let column = report.ranked_by.len();
        let cluster = cluster.map_or(String::new(), |label| format!("  {label:>7}"));
        let _ = writeln!(
            text,
            "{:>6}{}  {:<widest$}  {value:<column$}{cluster}",
            ranked.rank,
            against(ranked.against),
            ranked.file
        );
    }
    // Cells are padded, lines are not.
    let text = text.lines().map(|line| line.trim_end().to_owned() + "\n").collect::<String>();
    text + "\n" + &summary(answer)
}

fn summary(answer: &AnswerOf<Files>) -> String {
    let report = &answer.report;
    let mut page = Page::new();
    let direction = Measure::named(&report.ranked_by).map(|measure| measure.direction);
    let grows = if direction == Ok(Direction::Down) { "falls" } else { "grows" };
    page.row(
        "shapes",
        &format!(
            "{}, simplest first; {} {grows} with complexity",
            grouped(report.shapes.len() as u64),
            report.ranked_by
        ),
    );
    if report.stop.is_early() {
        page.row("", &format!("stopped early by {}", stopped_by(report.stop)));
    }
    if let Some(agreement) = &report.agreement {
        page.row(
            "agreement",
            &format!(
                "Kendall's τ {} (p = {}), Spearman's ρ {} (p = {})",
                few(agreement.kendall),
                few(agreement.kendall_p),
                few(agreement.spearman),
                few(agreement.spearman_p)
            ),
        );
        page.row(
            "",
            &format!(
                "{} in the same place, average distance {}, normalised {}",
                few(agreement.similarity),
                few(agreement.average_distance),
                few(agreement.normalized_distance)
            ),
        );
    }
    if let Some(clusters) = &report.clusters {
        describe(&mut page, clusters, |i| &report.shapes[i].file);
    }
    page.row("time", &time(answer.timing.total));
    page.into_text()
}

fn describe<'f>(page: &mut Page, clusters: &Clusters, file: impl Fn(usize) -> &'f str) {
    let sure = if clusters.is_optimal { ", proven least" } else { "" };
    page.row(
        "clusters",
        &format!(
            "{} by {}: sum of distances {}{sure}, mean silhouette {}",
            clusters.count,
            clusters.features.join(", "),
            few(clusters.loss),
            few(clusters.silhouette)
        ),
    );
    for (label, medoid) in clusters.medoids.iter().enumerate() {
        let size = clusters.labels.iter().filter(|other| **other == label).count();
        let number = label + 1;
        page.row("", &format!("{number}: {} around {}", grouped(size as u64), file(*medoid)));
    }
}
