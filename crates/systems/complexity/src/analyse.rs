//! The analysis of many shapes: measures, ranking and clusters.

use crate::measures::Measure;
use crate::measures::names::feature;
use crate::report::{ComplexityReport, RankedShape, ShapeReport, Timing};
use crate::{ComplexityError, MeasureOptions, Measures, cluster, compare_rankings, ranks};
use pompeiu_core::run::Instant;
use pompeiu_core::run::{Control, Limits, Progress, ProgressObserver, StopReason, on_threads};
use pompeiu_planar::Outline;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// A shape with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Its file or another name.
    pub file: String,
    /// Its outline.
    pub outline: Outline,
}

/// Options of an analysis.
#[derive(Clone)]
pub struct AnalyseOptions<'o> {
    /// Options of the measures.
    pub measure: MeasureOptions,
    /// The name of the measure to rank by: see [`Measure::ALL`].
    pub rank_by: String,
    /// Another ranking to compare with: names, with or without suffix, and ranks or values that increase with complexity.
    pub against: Option<Vec<(String, f64)>>,
    /// Number of clusters; `None` for no clustering.
    pub clusters: Option<usize>,
    /// The features for distances between shapes: names of measures, or `log:` and a name for ln(1 + value).
    pub features: Vec<String>,
    /// Limits on time and threads. Shapes that are not measured in time are omitted; then there are no clusters.
    pub limits: Limits,
    /// Receives the share of shapes measured so far.
    pub progress: Option<&'o dyn ProgressObserver>,
}

/// What tells classes of shapes apart: how a shape spreads out, how much of simple shapes around it it fills, how its width varies, and how
/// it bends at the largest and at the smallest scale. None of them has a few values far beyond all others, and none counts details
/// one by one, as the number of peaks does.
const FEATURES: [&str; 8] =
    ["log:spread", "convexity", "hull", "circle", "rectangle", "skeleton-variation", "boundary-8", "log:t18"];

impl Default for AnalyseOptions<'_> {
    fn default() -> Self {
        Self {
            measure: MeasureOptions::default(),
            rank_by: "total-curvature".to_owned(),
            against: None,
            clusters: None,
            features: FEATURES.map(str::to_owned).to_vec(),
            limits: Limits::default(),
            progress: None,
        }
    }
}

/// Measures shapes, ranks them, compares the ranking with another one, and clusters them.
///
/// # Errors
/// [`ComplexityError`] if there are no shapes, a measure is unknown, there are more clusters than shapes, or the other ranking
/// lacks a shape.
pub fn analyse(shapes: &[Shape], options: &AnalyseOptions<'_>) -> Result<ComplexityReport, ComplexityError> {
    if shapes.is_empty() {
        return Err(ComplexityError::Empty);
    }
    let measure = Measure::named(&options.rank_by)?;
    let features = options.features.iter().map(|name| feature(name)).collect::<Result<Vec<_>, _>>()?;
    if let Some(clusters) = options.clusters
        && (clusters < 1 || clusters > shapes.len())
    {
        return Err(ComplexityError::Clusters { clusters, shapes: shapes.len() });
    }
    let control = Control::start(&options.limits);
    let started = Instant::now();
    let measured = on_threads(options.limits.threads, || measured(shapes, options, &control))?;
    let mut timing = Timing { measures: started.elapsed(), ..Timing::default() };
    let stop = control.reason().unwrap_or(StopReason::Tolerance);
    if measured.is_empty() {
        return Ok(ComplexityReport { timing, ..ComplexityReport::empty(&options.rank_by, stop) });
    }

    let started = Instant::now();
    let complexity: Vec<f64> =
        measured.iter().map(|shape| without_rounding(measure.complexity(&shape.measures))).collect();
    let places = ranks(&complexity);
    let against = options.against.as_ref().map(|list| other_places(&measured, list)).transpose()?;
    let agreement = match &against {
        // Fewer than two shapes measured in time have no agreement.
        Some(other) if !stop.is_early() || measured.len() > 1 => Some(compare_rankings(&complexity, other)?),
        _ => None,
    };
    let against = against.map(|other| ranks(&other));
    let mut order: Vec<usize> = (0..measured.len()).collect();
    order.sort_by(|i, j| complexity[*i].total_cmp(&complexity[*j]));
    let ranking = order.into_iter().map(|i| RankedShape {
        file: measured[i].file.clone(),
        rank: places[i],
        value: measure.value(&measured[i].measures),
        against: against.as_ref().map(|other| other[i]),
    });
    let ranking = ranking.collect();
    timing.ranking = started.elapsed();

    let started = Instant::now();
    let row = |shape: &ShapeReport| features.iter().map(|value| value(&shape.measures)).collect();
    let rows: Vec<Vec<f64>> = measured.iter().map(row).collect();
    let count = options.clusters.filter(|_| !stop.is_early());
    let clusters = count.map(|count| cluster(&rows, &options.features, count)).transpose()?;
    timing.clusters = started.elapsed();
    Ok(ComplexityReport {
        shapes: measured,
        ranked_by: options.rank_by.clone(),
        ranking,
        agreement,
        clusters,
        failed: Vec::new(),
        left_out: Vec::new(),
        stop,
        timing,
    })
}

/// The value rounded to ten digits, so that values that are equal up to rounding are ties.
fn without_rounding(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}

/// The measures of all shapes; shapes that are not measured in time are omitted.
fn measured(
    shapes: &[Shape],
    options: &AnalyseOptions<'_>,
    control: &Control,
) -> Result<Vec<ShapeReport>, ComplexityError> {
    let done = AtomicUsize::new(0);
    let observer = options.progress.map(Mutex::new);
    let one = |shape: &Shape| {
        if control.is_stopped() {
            return Ok(None);
        }
        let measures = Measures::of(&shape.outline, &options.measure)?;
        let done = 1 + done.fetch_add(1, Ordering::Relaxed);
        if let Some(observer) = &observer {
            let share = done as f64 / shapes.len() as f64;
            let observer = observer.lock().unwrap_or_else(PoisonError::into_inner);
            if observer.progress(&Progress { doing: "measuring", share: Some(share) }).is_break() {
                control.stop(StopReason::Cancelled);
            }
        }
        Ok(Some(ShapeReport {
            file: shape.file.clone(),
            outline_points: shape.outline.points().len(),
            length: shape.outline.length(),
            area: shape.outline.area(),
            measures,
        }))
    };
    let all: Result<Vec<_>, ComplexityError> = shapes.par_iter().map(one).collect();
    Ok(all?.into_iter().flatten().collect())
}

/// The values of another ranking, in the order of the shapes.
fn other_places(shapes: &[ShapeReport], list: &[(String, f64)]) -> Result<Vec<f64>, ComplexityError> {
    let bare = |name: &str| {
        let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
        let Some((stem, suffix)) = name.rsplit_once('.') else { return name.to_owned() };
        // One of several shapes in a drawing keeps its own name.
        suffix.split_once('#').map_or_else(|| stem.to_owned(), |(_, own)| format!("{stem}#{own}"))
    };
    let place = |shape: &ShapeReport| {
        let exact = list.iter().find(|(name, _)| *name == shape.file);
        let found = exact.or_else(|| list.iter().find(|(name, _)| bare(name) == bare(&shape.file)));
        found.map(|(_, value)| *value).ok_or_else(|| ComplexityError::Unranked(shape.file.clone()))
    };
    shapes.iter().map(place).collect()
}
