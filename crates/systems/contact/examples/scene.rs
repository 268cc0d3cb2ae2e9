//! Runs a scene with a name, for its time in the comparison with another program (`bench/contact`).
//!
//! Argument: the name. The wall-clock seconds in all and those of collision detection are printed, then the steps and Newton iterations.

#![allow(clippy::print_stdout, reason = "its output is read by the comparison")]

use pompeiu_contact::{ContactRequest, Scene};
use pompeiu_core::run::RunContext;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = std::env::args().nth(1).ok_or("expected the name of a scene")?;
    let scene = Scene::named(Path::new(&name))?;
    let started = Instant::now();
    let context = RunContext::default();
    let run =
        ContactRequest::default().run(&scene, &[], None, &context, &mut |_, _| ControlFlow::Continue(()))?;
    if let Some(failure) = run.report.failure {
        return Err(failure.into());
    }
    let (seconds, timing) = (started.elapsed().as_secs_f64(), run.report.timing);
    let iterations: usize = run.report.steps.iter().map(|step| step.iterations).sum();
    println!("{seconds} {} {} {iterations}", timing.collision_detection / 1e3, run.report.steps.len());
    Ok(())
}
