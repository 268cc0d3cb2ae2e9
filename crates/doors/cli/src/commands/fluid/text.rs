//! The outcome for people.

use crate::exit::stopped_by;
use crate::numbers::{counted, few, time};
use crate::page::Page;
use pompeiu::core::request::Answer;
use pompeiu::fluid::SchemeReport;
use pompeiu::fluid::request::{FluidReport, FluidRequest};
use std::time::Duration;

/// The end first, then a row for each quantity.
pub(super) fn text(answer: &Answer<FluidRequest, FluidReport>) -> String {
    let mut page = Page::new();
    let outcome = &answer.report;
    let (Some(first), Some(last)) = (outcome.steps.first(), outcome.steps.last()) else {
        return page.into_text();
    };
    let count = outcome.steps.len() - 1;
    let steps = counted(count, "step");
    page.row("result", &format!("time {} after {steps}", few(last.time)));
    if outcome.stop.is_early() && count < outcome.asked {
        page.row("", &format!("stopped early by {}", stopped_by(outcome.stop)));
    }
    let scheme = &outcome.scheme;
    page.row("scheme", &format!("{}, {}", scheme.name, viscosity(scheme)));
    page.row("energy", &format!("{}, was {}", few(last.energy), few(first.energy)));
    page.row("enstrophy", &format!("{}, was {}", few(last.enstrophy), few(first.enstrophy)));
    page.row("speed", &format!("at most {}", few(last.max_speed)));
    for (i, name) in scheme.densities.iter().enumerate() {
        let [least, most] = last.range[i];
        page.row(
            name,
            &format!(
                "mass {}, was {}; between {} and {}",
                few(last.mass[i]),
                few(first.mass[i]),
                few(least),
                few(most)
            ),
        );
    }
    if !last.harmonic.is_empty() {
        let coefficients: Vec<String> = last.harmonic.iter().map(|c| format!("{c:.6}")).collect();
        page.row("harmonic", &coefficients.join(", "));
    }
    page.row(
        "checks",
        &format!("divergence {:.1e}, total vorticity {:.1e}", last.divergence, last.total_vorticity),
    );
    let guarded = outcome.steps.iter().filter(|step| step.energy_guarded).count();
    if guarded > 0 {
        let steps = counted(guarded, "step");
        page.row("", &format!("viscosity would have added energy in {steps}: velocity scaled down"));
    }
    let milliseconds = |ms: f64| time(Duration::from_secs_f64(ms.max(0.0) / 1e3));
    let (timing, steps) = (&outcome.timing, count.max(1) as f64);
    let [diffuse, advect, project] =
        [timing.per_step.diffuse, timing.per_step.advect, timing.per_step.project]
            .map(|each| milliseconds(each * steps));
    page.row(
        "time",
        &format!(
            "factors {}, diffusion {diffuse}, advection {advect}, projection {project}, total {}",
            milliseconds(timing.factor),
            time(answer.timing.total)
        ),
    );
    page.into_text()
}

fn viscosity(scheme: &SchemeReport) -> String {
    if scheme.viscosity > 0.0 {
        let model = format!("viscosity {} ({})", few(scheme.viscosity), scheme.viscosity_model.name());
        match scheme.curvature_limit {
            Some(limit) => format!("{model} with limited curvature (angle defects up to {} rad)", few(limit)),
            None => model,
        }
    } else {
        "without viscosity".to_owned()
    }
}
