//! The outcome for people.

use super::run::Outcome;
use crate::exit::stopped_by;
use crate::numbers::{few, grouped, time};
use crate::page::Page;

/// The end first, then a row for each quantity.
pub(super) fn text(outcome: &Outcome) -> String {
    let mut page = Page::new();
    let (Some(first), Some(last)) = (outcome.steps.first(), outcome.steps.last()) else {
        return page.into_text();
    };
    let count = outcome.steps.len() - 1;
    let steps = if count == 1 { "1 step".to_owned() } else { format!("{} steps", grouped(count as u64)) };
    page.row("result", &format!("time {} after {steps}", few(last.time)));
    if outcome.stop.is_early() && count < outcome.asked {
        page.row("", &format!("stopped early by {}", stopped_by(outcome.stop)));
    }
    let scheme = &outcome.scheme;
    page.row("scheme", &format!("{}, {}", scheme.name, viscosity(outcome)));
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
        page.row("", &format!("viscosity would have added energy in {guarded} steps: velocity scaled down"));
    }
    let timing = outcome.timing;
    page.row(
        "time",
        &format!(
            "factors {}, diffusion {}, advection {}, projection {}, total {}",
            time(timing.factor),
            time(timing.diffuse),
            time(timing.advect),
            time(timing.project),
            time(outcome.total)
        ),
    );
    page.into_text()
}

fn viscosity(outcome: &Outcome) -> String {
    let scheme = &outcome.scheme;
    if scheme.viscosity > 0.0 {
        format!("viscosity {} ({})", few(scheme.viscosity), scheme.viscosity_model.name())
    } else {
        "without viscosity".to_owned()
    }
}
