//! The outcome for people.

use super::Files;
use crate::door::AnswerOf;
use crate::numbers::{few, grouped, pairs_that_intersect, shortest, time};
use crate::page::{brief, proven};
use crate::printer::LABEL;
use pompeiu::remesh::{Quality, RemeshReport};
use std::fmt::Write;
use std::path::Path;

/// That a result is far from the input, and what can be done: creases that are kept already are not advised.
pub(super) fn far(found: &RemeshReport, keeps_creases: bool) -> String {
    let mut facts = Vec::new();
    if let Some(report) = &found.distance {
        let of_edges = match found.edge_length {
            Some(length) => {
                format!(" ({} of the edge length asked for)", few(report.distance.upper() / length))
            }
            None => String::new(),
        };
        facts.push(format!("is about {}{of_edges} away from the input", few(report.distance.upper())));
    }
    if let Some(share) = found.volume_share {
        facts.push(format!("encloses {:.1} % of its volume", 100.0 * share));
    }
    let advice = if keeps_creases {
        "ask for shorter edges or for a distance (--within)"
    } else {
        "ask for shorter edges, for a distance (--within), or keep sharp edges (--features 40)"
    };
    format!(
        "the result {}: parts of the input are narrower than edges are long, or bend within that length; {advice}",
        facts.join(" and ")
    )
}

/// That triangles are not as asked for, and what can be done.
pub(super) fn uneven(found: &RemeshReport) -> String {
    let mut facts = Vec::new();
    if let Some(share) = found.after.near_target {
        facts.push(format!("{:.0} % of the edges are between 4/5 and 4/3 of their target", 100.0 * share));
    }
    let angle = found.after.least_angle;
    facts.push(format!("the least angle is {:.2}° ({:.1}° in the mean of faces)", angle.least, angle.mean));
    let cure = match (found.within, found.intersections) {
        (Some(_), _) => {
            "edges of the input stay where the distance asks for it; ask for a greater distance, or for shorter edges"
        }
        (None, Some(_)) => {
            "edges of the input stay where sheets are nearer to each other than edges are long; ask for shorter edges, or let faces intersect \
             (--intersections report)"
        }
        (None, None) => "ask for shorter edges",
    };
    format!("the triangles are uneven: {}; {cure}", facts.join(", "))
}

/// A row for each quantity, before and after, and the distance.
pub(super) fn text(certificate: Option<&Path>, answer: &AnswerOf<Files>) -> String {
    let mut text = String::new();
    let mut row = |label: &str, value: String| {
        let _ = writeln!(text, "{LABEL}{label:<13}{LABEL:#}{value}");
    };
    let found = &answer.report;
    let both =
        |of: &dyn Fn(&Quality) -> String| format!("{}, before {}", of(&found.after), of(&found.before));
    let count = |n: usize| grouped(n as u64);
    row("vertices", both(&|q| count(q.vertices)));
    row("faces", both(&|q| count(q.faces)));
    row("edge length", both(&|q| format!("{} in the mean", few(q.edge_length.mean))));
    if let Some(share) = found.after.near_target {
        row("", format!("{:.1} % between 4/5 and 4/3 of the target", 100.0 * share));
    }
    row(
        "least angle",
        both(&|q| format!("{:.1}° ({:.1}° in the mean)", q.least_angle.least, q.least_angle.mean)),
    );
    row("valence", both(&|q| format!("{:.1} % regular", 100.0 * q.regular)));
    if let Some(report) = &found.distance {
        let bound = match found.within {
            Some(within) => format!(", proven to be at most {}", shortest(within)),
            None => String::new(),
        };
        row("H(A, B)", brief(report.distance) + &bound);
        row("", proven(report.distance));
    }
    if let (Some(height), Some(report)) = (found.chord_height, &found.distance)
        && report.distance.lower() > height
    {
        row(
            "chord",
            format!(
                "farther than the height of {} asked for, which is estimated; require --within",
                shortest(height)
            ),
        );
    }
    if let Some(share) = found.volume_share {
        row("volume", format!("{:.1} % of that of the input", 100.0 * share));
    }
    if let Some(count) = found.intersections {
        row("intersect", pairs_that_intersect(count));
    }
    if found.stop.is_early() {
        let rest = if found.distance.is_some() {
            ""
        } else {
            "; neither its distance nor intersections were looked at"
        };
        row("stopped", format!("early ({}): the mesh is valid, but unfinished{rest}", found.stop.name()));
    }
    let timing = found.timing;
    row(
        "time",
        format!(
            "remesh {}, distance {}, total {}",
            time(timing.remesh),
            time(timing.distance),
            time(answer.timing.total)
        ),
    );
    if let Some((path, answer)) = certificate.zip(found.certificate.as_ref()) {
        text += &crate::certificate::text(path, answer);
    }
    text
}
