//! The outcome for people.

use super::args::Files;
use crate::door::AnswerOf;
use crate::numbers::{between, counted, few, grouped, time};
use crate::page::Page;
use pompeiu::neuron::{SkeletonReport, UnprovenCell, WallDistance};
use std::time::Duration;

/// Problems that are listed; JSON lists all.
const LISTED: usize = 12;

/// What is said of a skeleton.
fn add_skeleton(page: &mut Page, path: &str, skeleton: &SkeletonReport) {
    let number = |n: usize| grouped(n as u64);
    let problems = &skeleton.problems;
    page.row(
        "skeleton",
        &format!(
            "{path}: {}, {}, {}",
            counted(skeleton.samples, "sample"),
            counted(skeleton.branches, "branch"),
            counted(skeleton.tips, "tip")
        ),
    );
    for (i, repair) in skeleton.repairs.iter().flatten().enumerate() {
        page.row(if i == 0 { "repairs" } else { "" }, repair);
    }
    if let Some(moved) = skeleton.deviation {
        page.row(
            "moved",
            &format!(
                "at most {} µm from the axis (sample {}, branch {}), radii by at most {} µm",
                few(moved.position),
                moved.sample,
                moved.branch,
                few(moved.radius)
            ),
        );
    }
    for (i, problem) in problems.iter().take(LISTED).enumerate() {
        let name = if i == 0 { "problems" } else { "" };
        page.row(name, &format!("line {}: {}", problem.line, problem.message));
    }
    if problems.len() > LISTED {
        page.row("", &format!("and {} more, all in --json", number(problems.len() - LISTED)));
    }
}

/// The cells that are not proven valid, with their places.
fn add_unproven(page: &mut Page, unproven: &[UnprovenCell]) {
    for (i, place) in unproven.iter().take(LISTED).enumerate() {
        let [x, y, z] = place.centre.map(few);
        let cell = grouped(place.cell as u64);
        let what = if place.folded { "is folded" } else { "is not proven valid" };
        let quality = place.scaled_jacobian;
        let mut row = format!("cell {cell} at ({x}, {y}, {z}) µm {what}: scaled Jacobian {quality:.3}");
        if let (Some(line), Some(sample)) = (place.line, place.sample) {
            row = format!("line {line}: {row}, near sample {sample}");
        }
        page.row(if i == 0 { "unproven" } else { "" }, &row);
    }
    if unproven.len() > LISTED {
        page.row("", &format!("and {} more, all in --json", grouped((unproven.len() - LISTED) as u64)));
    }
}

/// The distance of the wall from the cones, both ways, and the samples where it is not tolerated.
fn add_wall(page: &mut Page, wall: &WallDistance) {
    let ways = [("from the cones", &wall.wall_to_cones), ("of the cones from it", &wall.cones_to_wall)];
    for (i, (way, distance)) in ways.into_iter().enumerate() {
        let length = between(distance.lower, distance.upper);
        let radii = between(distance.lower_radii, distance.upper_radii);
        let sample = distance.sample;
        let row = format!("{way}: {length} µm, {radii} radii at most, near sample {sample}");
        page.row(if i == 0 { "wall" } else { "" }, &row);
    }
    for (i, place) in wall.beyond.iter().take(LISTED).enumerate() {
        let (line, sample) = (place.line, place.sample);
        let row = format!(
            "line {line}: {} µm, {} radii off at sample {sample}",
            few(place.distance),
            few(place.radii)
        );
        page.row(if i == 0 { "beyond" } else { "" }, &row);
    }
    if wall.beyond.len() > LISTED {
        page.row("", &format!("and {} more, all in --json", grouped((wall.beyond.len() - LISTED) as u64)));
    }
}

/// Whether the wall is as near to the cones as is tolerated; `None` if it was not measured.
fn verdict_on_wall(wall: Option<&WallDistance>) -> Option<String> {
    let wall = wall?;
    Some(match wall.is_within() {
        Some(true) => format!("the wall is within {} radii of the cones", wall.within),
        Some(false) => format!(
            "the wall is not within {} radii of the cones (--within {} accepts it)",
            wall.within,
            wall.sufficient()
        ),
        None => format!("whether the wall is within {} radii of the cones is not decided", wall.within),
    })
}

/// The verdict first, then a row for each quantity.
pub(super) fn text(path: &str, answer: &AnswerOf<Files>) -> String {
    let report = &answer.report;
    let mut page = Page::new();
    let number = |n: usize| grouped(n as u64);
    let of_skeleton = report.skeleton.as_ref().map(|skeleton| match skeleton.problems.len() {
        // Only those of the file are known then.
        0 if report.is_check && report.meshable.is_none() => "the file has no defects".to_owned(),
        0 => "no problems".to_owned(),
        n => counted(n, "problem"),
    });
    let of_check = report.is_check.then(|| match report.meshable {
        Some(true) => "it can be meshed".to_owned(),
        Some(false) => "it cannot be meshed as asked".to_owned(),
        None => "whether it can be meshed is not decided".to_owned(),
    });
    let of_cells = report.mesh.as_ref().map(|mesh| match mesh.folded() {
        _ if mesh.certified => "every cell is proven valid".to_owned(),
        0 => "not every cell is proven valid".to_owned(),
        1 => "1 cell is folded".to_owned(),
        n => format!("{} cells are folded", number(n)),
    });
    let of_wall = verdict_on_wall(report.mesh.as_ref().and_then(|mesh| mesh.wall.as_ref()));
    let verdict = match (of_check.or(of_cells), of_skeleton) {
        (Some(check), Some(problems)) if report.is_check => format!("{check}; {problems}"),
        (Some(cells), Some(skeleton)) => [Some(cells), of_wall, Some(format!("the skeleton has {skeleton}"))]
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
            .join("; "),
        (cells, skeleton) => cells.or(skeleton).unwrap_or_default(),
    };
    page.row("result", &verdict);
    match &report.skeleton {
        Some(skeleton) => add_skeleton(&mut page, path, skeleton),
        None => page.row("from", path),
    }
    if let Some(mesh) = &report.mesh {
        page.row(
            "mesh",
            &format!("{}, {}", counted(mesh.vertices, "vertex"), counted(mesh.hexahedra, "hexahedron")),
        );
        page.row(
            "quality",
            &format!("scaled Jacobian at least {:.3}", rounded_down(mesh.min_scaled_jacobian)),
        );
        add_unproven(&mut page, &mesh.unproven);
        if let Some(wall) = &mesh.wall {
            add_wall(&mut page, wall);
        }
        for (i, branch) in mesh.left_out.iter().enumerate() {
            page.row(if i == 0 { "left out" } else { "" }, branch);
        }
        for (i, branch) in mesh.moved.iter().enumerate() {
            page.row(if i == 0 { "moved" } else { "" }, branch);
        }
    }
    if let Some(spline) = &report.spline {
        let off = spline.partition_of_unity_error;
        page.row("splines", &format!("{} functions, whose sum is 1 to {off:.1e}", number(spline.functions)));
        for (i, level) in spline.levels.iter().enumerate() {
            let line =
                format!("{}, {}", counted(level.elements, "element"), counted(level.functions, "function"));
            page.row(if i == 0 { "levels" } else { "" }, &line);
        }
    }
    if let Some(flow) = &report.flow {
        let steps = flow.newton.len().saturating_sub(1);
        let last = flow.newton.last().copied().unwrap_or(0.0);
        page.row(
            "flow",
            &format!("Reynolds number {}, pressure drop {} Pa", few(flow.reynolds), few(flow.pressure_drop)),
        );
        page.row("Newton", &format!("{} to {last:.1e} of the first residual", counted(steps, "step")));
        page.row(
            "fluxes",
            &format!(
                "through sections constant to {:.1e} of the inlet, in all {:.1e}, through the wall {:.1e}",
                flow.section_flux_drift, flow.imbalance, flow.wall_leak
            ),
        );
    }
    if let Some(transport) = &report.transport {
        page.row(
            "transport",
            &format!(
                "{}, concentrations between {} and {}",
                counted(transport.steps, "step"),
                few(transport.minimum),
                few(transport.maximum)
            ),
        );
        page.row("balance", &format!("mass is kept to {:.1e} in each step", transport.mass_balance));
        for (i, tip) in transport.tips.iter().take(LISTED).enumerate() {
            let line = format!(
                "sample {}: free {}, away {}, back {}",
                tip.sample,
                few(tip.free),
                few(tip.plus),
                few(tip.minus)
            );
            page.row(if i == 0 { "tips" } else { "" }, &line);
        }
        if transport.tips.len() > LISTED {
            page.row("", &format!("and {} more, all in --json", number(transport.tips.len() - LISTED)));
        }
    }
    if let Some(ended) = &report.ended {
        page.row("ended", ended);
    }
    let span = |milliseconds: f64| time(Duration::from_secs_f64(milliseconds / 1e3));
    let timing = &report.timing;
    let stages: String = [
        ("mesh", timing.mesh),
        ("splines", timing.spline),
        ("flow", timing.flow),
        ("transport", timing.transport),
    ]
    .into_iter()
    .filter_map(|(name, time)| Some(format!("{name} {}, ", span(time?))))
    .collect();
    let stages =
        if stages.is_empty() { stages } else { format!("skeleton {}, {stages}", span(timing.skeleton)) };
    page.row("time", &format!("{stages}total {}", time(answer.timing.total)));
    page.into_text()
}

/// A lower bound with three digits is one, too.
fn rounded_down(bound: f64) -> f64 {
    (bound * 1000.0).floor() / 1000.0
}
