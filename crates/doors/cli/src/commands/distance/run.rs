//! Runs the command.

use super::args::{Direction, Distance, Method};
use super::outcome::{Outcome, Times};
use super::watch::Watch;
use super::{json, text};
use crate::args::ToleranceKind;
use crate::exit::Exit;
use crate::interrupt;
use crate::numbers::shortest;
use crate::pair::{self, File};
use crate::printer::Printer;
use crate::wait::Wait;
use pompeiu::core::TriMesh;
use pompeiu::core::geom::Aabb;
use pompeiu::hausdorff::{self, HausdorffOptions, StopReason};
use std::time::{Duration, Instant};

/// The tolerances of a trace, fractions of the joint diagonal.
pub(super) const TRACE: [f64; 14] =
    [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14];

pub(crate) fn run(args: &Distance, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let paths = args.meshes.paths();
    pair::check(paths[0], paths[1], printer)?;
    args.limits.apply_threads()?;
    let wait = Wait::new(printer);
    let (a, mut b) = pair::read(paths[0], paths[1], (&args.limits, started), &wait, printer)?;
    let read = started.elapsed();
    interrupt::listen();
    let mut alignment = None;
    if let Some(before) = args.align {
        let (moved, found) = before.align(paths, [&a, &b], &args.limits.after(read), &wait, printer)?;
        (b, alignment) = (moved, Some(found));
    }
    let outcome = Outcome { alignment, ..measure(args, (&a, &b), &wait, (started, read))? };
    drop(wait);

    if outcome.reports().any(|report| report.stop == StopReason::Rounding) {
        printer.warning(format_args!(
            "the interval is wider than the tolerance {}: that is what double precision tells apart here",
            shortest(outcome.tolerance())
        ));
    }
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    Ok(outcome.exit())
}

fn measure(
    args: &Distance,
    (a, b): (&TriMesh, &TriMesh),
    wait: &Wait,
    (started, read): (Instant, Duration),
) -> anyhow::Result<Outcome> {
    let diagonal = Aabb::of_faces(a).union(Aabb::of_faces(b)).diagonal();
    let stages = stages(args, diagonal);
    let watch = Watch::new(wait, args.direction, stages.len());
    let options = HausdorffOptions {
        stages: stages.to_vec(),
        observer: Some(&watch),
        ..options(args, started.elapsed())
    };
    wait.show("building trees".to_owned());
    let (a_to_b, b_to_a) = match args.direction {
        Direction::Both => {
            let report = options.symmetric(a, b)?;
            (Some(report.a_to_b), Some(report.b_to_a))
        }
        Direction::AToB => (Some(options.directed(a, b)?), None),
        Direction::BToA => (None, Some(options.directed(b, a)?)),
    };
    let ends = [(hausdorff::Direction::AToB, a_to_b.as_ref()), (hausdorff::Direction::BToA, b_to_a.as_ref())];
    Ok(Outcome {
        trace: args.trace.then(|| watch.into_rows(ends, diagonal)),
        names: args.meshes.names(),
        a: File::new(args.meshes.paths()[0], a),
        b: File::new(args.meshes.paths()[1], b),
        alignment: None,
        requested: args.tolerance.tolerance,
        kind: args.tolerance.tolerance_kind,
        a_to_b,
        b_to_a,
        threshold: args.assert_below,
        times: Times { read, total: started.elapsed() },
    })
}

fn options(args: &Distance, spent: Duration) -> HausdorffOptions<'static> {
    HausdorffOptions {
        tolerance: args.tolerance.get(),
        threshold: args.assert_below,
        method: match args.method {
            Method::Fast => hausdorff::Method::Fast,
            Method::Classic => hausdorff::Method::Classic,
        },
        limits: args.limits.after(spent),
        ..HausdorffOptions::default()
    }
}

/// The tolerances of the trace that are coarser than the one asked for; the last row is that of the answer.
fn stages(args: &Distance, diagonal: f64) -> &'static [f64] {
    if !args.trace {
        return &[];
    }
    let tolerance = args.tolerance.tolerance;
    let finest = match args.tolerance.tolerance_kind {
        ToleranceKind::Diagonal => tolerance,
        ToleranceKind::Absolute => tolerance / diagonal,
        ToleranceKind::Relative => 0.0,
    };
    let is_coarser = |stage: &f64| *stage > 1.001 * finest;
    &TRACE[..TRACE.partition_point(is_coarser)]
}
