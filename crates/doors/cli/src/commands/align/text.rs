//! The answer for people.

use super::{Files, rows};
use crate::aligned::{percent, verdict};
use crate::door::AnswerOf;
use crate::exit::stopped_by;
use crate::numbers::{few, plain, point, rounded, shortest, time};
use crate::page::{Page, brief, described};
use pompeiu::matching::align::{Alternative, FreeMotion};
use std::fmt::Write;

/// A motion that is less than this share of the other kind is left out.
const NEGLIGIBLE: f64 = 1e-3;

pub(super) fn text(answer: &AnswerOf<Files>) -> String {
    let report = &answer.report;
    let found = &report.registration;
    let mut page = Page::new();
    page.row("verdict", &verdict(found));
    page.gap();
    for (name, input) in ["moving", "fixed"].into_iter().zip(&answer.inputs) {
        page.row(name, &described(input));
    }
    page.gap();
    page.row(
        "matched",
        &format!("{} of the moved surface, within {}", percent(found.matched), few(found.reach)),
    );
    page.row("", &format!("root mean square distance {} of what the fit rests on", few(found.rms)));
    page.row("turned by", &format!("{:.4}°", found.turn_degrees));
    if let Some(deviation) = found.scale_deviation {
        page.row("scaled by", &scaled(found.scale, deviation));
    }
    for (i, row) in rows(found).lines().enumerate() {
        page.row(if i == 0 { "matrix" } else { "" }, row);
    }
    let settings = found.transform_settings();
    page.row("ParaView", &format!("Translate {}", triple(settings.translate)));
    page.row("", &format!("Rotate {}, Scale {}", triple(settings.rotate), triple(settings.scale)));
    for (i, other) in found.alternatives.iter().enumerate() {
        let line = format!("{} matched, after {}", percent(other.matched), turned(other));
        page.row(if i == 0 { "or else" } else { "" }, &line);
    }
    for (i, motion) in found.free_motions.iter().enumerate() {
        page.row(if i == 0 { "free" } else { "" }, &free(motion));
    }
    if found.stop.is_early() {
        page.row("", &format!("stopped by {}", stopped_by(found.stop)));
    }
    page.gap();
    if let (Some(there), Some(back)) = (&report.moved_to_fixed, &report.fixed_to_moved) {
        page.row(
            "distance",
            &format!("{}   how far the moved mesh is from the fixed one: proven", brief(there.distance)),
        );
        page.row(
            "",
            &format!("{}   how far the fixed mesh is from the moved one: proven", brief(back.distance)),
        );
    }
    let spans = [answer.timing.read, report.timing.align, report.timing.distance, answer.timing.total];
    let [read, align, distance, total] = spans.map(time);
    page.row("time", &format!("read {read}, align {align}, distance {distance}, total {total}"));
    page.into_text()
}

/// The numbers as the fields of a filter take them.
fn triple(v: [f64; 3]) -> String {
    v.map(shortest).join(" ")
}

/// What factors between units are called.
const UNITS: [(f64, &str); 6] = [
    (10.0, "millimetres to a centimetre"),
    (12.0, "inches to a foot"),
    (25.4, "millimetres to an inch"),
    (100.0, "centimetres to a metre"),
    (304.8, "millimetres to a foot"),
    (1000.0, "millimetres to a metre"),
];

/// How far a scale may be from a factor between units to be called one, beside three standard deviations.
const UNIT_TOLERANCE: f64 = 1e-3;

/// A factor with its doubt, and what it may stand for.
fn scaled(scale: f64, deviation: f64) -> String {
    let mut text =
        format!("{} ± {} (one standard deviation)", plain(rounded_to(scale, deviation)), few(deviation));
    let near = |factor: f64| (scale / factor - 1.0).abs() <= UNIT_TOLERANCE + 3.0 * deviation / scale;
    for (factor, name) in UNITS {
        if near(factor) || near(1.0 / factor) {
            let _ = write!(text, "; there are {factor} {name}");
        }
    }
    text
}

/// As many digits as are known to a tenth of a deviation, at least four.
fn rounded_to(x: f64, deviation: f64) -> f64 {
    let digits = if deviation > 0.0 { (x / deviation).log10().ceil().clamp(3.0, 14.0) as usize } else { 14 };
    format!("{x:.digits$e}").parse().unwrap_or(x)
}

/// Turns that symmetric shapes allow: their angles in degrees, and what they are called.
const TURNS: [(f64, &str); 5] = [
    (180.0, "a half turn"),
    (120.0, "a third of a turn"),
    (90.0, "a quarter turn"),
    (72.0, "a fifth of a turn"),
    (60.0, "a sixth of a turn"),
];

/// Angles nearer than this, in degrees, are called by their names.
const ABOUT: f64 = 0.5;

/// What leads from the best place to another, in words.
fn turned(other: &Alternative) -> String {
    if other.axis == [0.0; 3] {
        return format!("a slide by {}", few(other.slide));
    }
    let name = TURNS.iter().find(|(angle, _)| (angle - other.apart_degrees).abs() < ABOUT);
    let turn =
        name.map_or_else(|| format!("a turn of {:.1}°", other.apart_degrees), |(_, name)| (*name).to_owned());
    let [axis, through] = [point(clean(other.axis, 1.0)), point(clean(other.point, length(other.point)))];
    let slide = if other.slide.abs() <= NEGLIGIBLE * length(other.point).max(1.0) {
        String::new()
    } else {
        format!(", sliding {} along it", few(other.slide))
    };
    format!("{turn} about {axis} through {through}{slide}")
}

/// Four digits of coordinates, and zero for those that are rounding beside the greatest of a size of at least one.
fn clean(v: [f64; 3], size: f64) -> [f64; 3] {
    let least = NEGLIGIBLE * NEGLIGIBLE * NEGLIGIBLE * size.max(1.0);
    v.map(|x| if x.abs() < least { 0.0 } else { rounded(x) })
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The motion in words.
fn free(motion: &FreeMotion) -> String {
    let [turn, shift] = [motion.turn, motion.shift].map(length);
    let direction = |v: [f64; 3]| point(clean(v.map(|x| x / length(v)), 1.0));
    let slide = || format!("slides along {}", direction(motion.shift));
    if turn <= NEGLIGIBLE {
        return slide();
    }
    let turns = format!(
        "turns about {} through {}",
        direction(motion.turn),
        point(clean(motion.point, length(motion.point)))
    );
    if shift <= NEGLIGIBLE * turn { turns } else { format!("{turns} as it {}", slide()) }
}
