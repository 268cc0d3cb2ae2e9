//! The outcome for people.

use super::Files;
use crate::door::AnswerOf;
use crate::numbers::{counted, pairs_that_intersect, point, shortest, time, vertices_and_faces};
use crate::page::Page;
use pompeiu::flow::{Flow, FlowStop};

/// The verdict first, then a row for each quantity.
pub(super) fn text(answer: &AnswerOf<Files>) -> String {
    let flow = &answer.report;
    let mut page = Page::new();
    page.row("result", &verdict(flow));
    let fall = 100.0 * (1.0 - flow.area.r#final / flow.area.initial);
    page.row(
        "area",
        &format!("{}, was {} ({fall:.3} % less)", shortest(flow.area.r#final), shortest(flow.area.initial)),
    );
    if let Some(volume) = &flow.volume {
        page.row("volume", &format!("{}, was {}", shortest(volume.r#final), shortest(volume.initial)));
    }
    page.row(
        "gradient",
        &format!(
            "at most {:.1e} along vertex normals, {:.1e} across them",
            flow.gradient.normal, flow.gradient.tangential
        ),
    );
    if let Some(pressure) = flow.pressure {
        page.row("pressure", &format!("{}: the area changes by this with the volume", shortest(pressure)));
    }
    if let Some(stability) = &flow.stability {
        let value =
            format!("least eigenvalue {:.6}, within {:.1e}", stability.least_eigenvalue, stability.residual);
        page.row("stability", &value);
    }
    if let Some(discs) = &flow.discs {
        let beside = if discs.less {
            "less than this surface: it is no global minimum"
        } else {
            "more than this surface"
        };
        page.row("two discs", &format!("have the area {}, {beside}", shortest(discs.area)));
    }
    if flow.cone.is_some() {
        page.row(
            "existence",
            "no connected minimal surface spans both boundary loops: a cone separates them",
        );
    }
    if let Some(neck) = &flow.neck {
        page.row(
            "neck",
            &format!("of length {:.4} near {}", neck.length, crate::numbers::point(neck.position)),
        );
    }
    if let Some(count) = flow.intersections {
        page.row("intersect", &pairs_that_intersect(count));
    }
    page.row("mesh", &vertices_and_faces(flow.mesh.positions().len(), flow.mesh.faces().len()));
    let timing = flow.timing;
    page.row(
        "time",
        &format!(
            "steps {}, remeshing {}, verdict {}, total {}",
            time(timing.steps),
            time(timing.remesh),
            time(timing.verdict),
            time(answer.timing.total)
        ),
    );
    page.into_text()
}

fn verdict(flow: &Flow) -> String {
    let steps = counted(flow.steps, "step");
    match flow.stop {
        FlowStop::Stationary => match flow.stability.and_then(|s| s.is_minimum()) {
            Some(true) => format!("stationary after {steps}: a local minimum of the area"),
            Some(false) => format!("stationary after {steps}: a saddle, not a minimum"),
            None => format!("stationary after {steps}"),
        },
        FlowStop::Time => format!("the time was reached after {steps}"),
        FlowStop::Steps => steps,
        FlowStop::Pinched => {
            format!("pinched after {steps}: a neck became too narrow for the mesh, or the surface vanished")
        }
        FlowStop::Limit => format!("stopped after {steps}: the time limit was reached"),
        FlowStop::Cancelled => format!("stopped after {steps}, as asked"),
        FlowStop::Degenerate => format!(
            "degenerate after {steps}: triangles{} became too thin to go on; remesh on the way (--remesh)",
            near(flow)
        ),
        _ => {
            format!("stalled after {steps}: the area hardly falls, and the gradient is largest{}", near(flow))
        }
    }
}

/// Where the flow could not go on.
fn near(flow: &Flow) -> String {
    flow.place.map(|place| format!(" near {}", point(place))).unwrap_or_default()
}
