//! From a surface to a flat map and its report.

use crate::atlas::{divided, with_short_seams};
use crate::chart::{Chart, flatten_component};
use crate::check::{flipped_faces, outline, outline_crossings, overlapping_faces};
use crate::components::{Component, split};
use crate::cut::{Opened, open, requested_edges};
use crate::distortion::{Distortion, best_scale, singular_values, symmetric_dirichlet};
use crate::opened::disks;
use crate::pack::{bounds, pack, turn};
use crate::report::{CutReport, FlattenReport, PartReport, Timing};
use crate::seams::seam_length;
use crate::watch::Watch;
use crate::{Charts, FlattenError, FlattenOptions, Method};
use pompeiu_core::FaceId;
use pompeiu_core::mesh::{FaceData, Precision, VertexData};
use pompeiu_core::run::Instant;
use pompeiu_core::run::{Control, StopReason, on_threads};
use pompeiu_solve::SolveError;
use pompeiu_surface::plane::{Vec2, scale};
use pompeiu_surface::{EdgeData, EdgeId, EmbeddedSurface, SurfaceMesh};
use rayon::prelude::*;

/// A surface, opened and flattened.
#[derive(Clone, Debug)]
pub struct Flattening {
    /// The cut edges.
    pub cut: EdgeData<bool>,
    /// The surface after the cut.
    pub opened: Opened,
    /// The position of each vertex of the opened surface.
    pub uv: VertexData<Vec2>,
    /// The faces that are flipped, in order.
    pub flipped: Vec<FaceId>,
    /// The faces that overlap others, in order.
    pub overlapping: Vec<FaceId>,
    /// The singular values of the map on each face, at the scale of least symmetric Dirichlet energy.
    pub singular_values: FaceData<[f64; 2]>,
    /// The report.
    pub report: FlattenReport,
}

impl Flattening {
    /// The position of each corner of each face.
    pub fn corner_uv(&self) -> Vec<[Vec2; 3]> {
        self.opened.faces().iter().map(|face| face.map(|v| self.uv.as_slice()[v as usize])).collect()
    }

    /// The symmetric Dirichlet energy of each face; infinite where it is flipped.
    pub fn face_distortion(&self) -> FaceData<f64> {
        self.singular_values.map(|&values| symmetric_dirichlet(values))
    }

    /// The segments of the outlines, by vertices of the opened surface.
    pub fn outline(&self) -> Vec<[u32; 2]> {
        outline(self.opened.mesh())
    }
}

/// Cuts a surface open and maps it to the plane: each component becomes one disk, or several with [`Charts`], and all are packed into the
/// unit square.
///
/// # Definition
/// With a free boundary, a disk is first mapped to a circle by a convex combination map, whose weights are changed until no face is
/// nearly degenerate; from there the symmetric Dirichlet energy is minimised (see [`Method`]). With the strategy `Auto`, cuts are
/// added where distortion is high, far from the cut, until the energy is at most [`FlattenOptions::target`]. With
/// [`FlattenOptions::charts`], the chart that adds most to the distortion is divided along a short seam, and each of its parts cut and
/// flattened anew, until there are enough charts or the energy of the whole map is low enough.
///
/// # Accuracy
/// Whether the map is one-to-one is decided on the coordinates as stored, by exact predicates: all faces are counter-clockwise,
/// outlines neither cross nor touch, and bounding boxes of charts are disjoint. A disk that satisfies the first two is mapped
/// one-to-one, because the number of faces over a point is the winding number of the outline.
///
/// # Errors
/// [`FlattenError`]: the surface cannot be cut as requested, or faces stay nearly degenerate with all weights.
///
/// # Cost
/// Sparse factorizations with one unknown for each vertex, and with two for each Newton step.
///
/// # Source
/// `floater_mean_2003`, `smith_bijective_2015`, `jiang_simplicial_2017`; the changes of weights and the choice of cuts are ours.
pub fn flatten(surface: &EmbeddedSurface, options: &FlattenOptions<'_>) -> Result<Flattening, FlattenError> {
    flatten_along(surface, options, None)
}

/// Flattens a surface; where the cut is given, along that, which is symmetric if a plane of symmetry is given.
pub(crate) fn flatten_along(
    surface: &EmbeddedSurface,
    options: &FlattenOptions<'_>,
    cut: Option<EdgeData<bool>>,
) -> Result<Flattening, FlattenError> {
    options.check()?;
    let control = Control::start(&options.limits);
    on_threads(options.limits.threads, || run(surface, options, &control, cut))
}

fn run(
    surface: &EmbeddedSurface,
    options: &FlattenOptions<'_>,
    control: &Control,
    given: Option<EdgeData<bool>>,
) -> Result<Flattening, FlattenError> {
    let began = Instant::now();
    let mesh = surface.mesh();
    let chosen = requested_edges(mesh, &options.cut)?;
    let mut requested = given.or(chosen);
    let plane = options.cut.symmetry.as_ref();
    // A given cut may divide one component into several disks.
    let parts = match &requested {
        Some(cut) if plane.is_none() => disks(surface, cut)?,
        _ => split(surface, plane)?,
    };
    let watch =
        Watch::new(control, options.progress, parts.len()).within(&options.limits, began, mesh.faces());
    let one = |part: &Component| {
        let edges = requested.as_ref().map(|cut| match plane {
            Some(_) => part.restricted(mesh, cut),
            // It is open along them already.
            None => EdgeData::filled(part.surface.mesh().edges(), false),
        });
        let chart = flatten_component(part, edges, options, &watch);
        watch.finish_one();
        chart
    };
    // Where no short seams are found, parts are divided one after the other.
    let short = unless_out_of_memory(with_short_seams(surface, &parts, options, &watch))?;
    let (parts, charts) = match short {
        Some(found) if found.is_taken(mesh.faces()) => {
            requested = Some(found.seams);
            (found.parts, found.charts)
        }
        found => {
            let charts: Vec<Chart> = parts.par_iter().map(one).collect::<Result<_, _>>()?;
            let (parts, charts) = divided(parts, charts, options, &watch)?;
            let of_divided = requested.is_none().then(|| cut_of(mesh, &parts, &charts));
            match found.zip(of_divided) {
                Some((found, cut)) if found.is_better(surface.surface(), &parts, &charts, &cut, options) => {
                    requested = Some(found.seams);
                    (found.parts, found.charts)
                }
                _ => (parts, charts),
            }
        }
    };
    let mut timing = Timing::default();
    for chart in &charts {
        timing.add(&chart.timing);
    }
    let start = Instant::now();
    let cut = requested.unwrap_or_else(|| cut_of(mesh, &parts, &charts));
    let opened = open(mesh, &cut)?;
    timing.cut += start.elapsed();
    let mut places = arrange(&parts, &charts, options);
    if options.precision == Precision::Single {
        places.iter_mut().flatten().for_each(|p| *p = single(*p));
    }
    let mut uv = VertexData::filled(opened.mesh().vertices(), [0.0; 2]);
    for ((part, chart), places) in parts.iter().zip(&charts).zip(&places) {
        for (face, corners) in part.faces.iter().zip(chart.opened.faces()) {
            for (whole, here) in opened.mesh().face(*face).into_iter().zip(corners) {
                uv[whole] = places[*here as usize];
            }
        }
    }
    let mut result = judge(surface, options, cut, opened, uv, &places);
    timing.check += result.report.timing.check;
    timing.total = began.elapsed();
    result.report.timing = timing;
    result.report.reweightings = charts.iter().map(|chart| chart.rounds).sum();
    result.report.steps = charts.iter().map(|chart| chart.steps).sum();
    result.report.stop = control.reason().unwrap_or(
        // The target is a bound on the energy that all cuts and charts allowed did not reach.
        if misses_target(options, &charts, &result.report) {
            if watch.was_cut_short() { StopReason::Time } else { StopReason::Steps }
        } else {
            StopReason::Tolerance
        },
    );
    result.report.weights = charts.first().map_or("", |chart| chart.weights.name());
    let of_parts =
        parts.par_iter().zip(&charts).map(|(part, chart)| part_report(surface, part, chart, &result));
    result.report.parts = of_parts.collect();
    Ok(result)
}

/// What was found, and nothing where the search failed; without memory the rest would fail, too.
fn unless_out_of_memory<T>(found: Result<Option<T>, FlattenError>) -> Result<Option<T>, FlattenError> {
    match found {
        Err(FlattenError::Solve(SolveError::NoMemory { .. })) => found,
        found => Ok(found.ok().flatten()),
    }
}

/// Whether the energy asked for was not reached.
fn misses_target(options: &FlattenOptions<'_>, charts: &[Chart], report: &FlattenReport) -> bool {
    match options.enough() {
        Some(enough) if options.charts == Charts::Auto => {
            let mean = report.distortion.symmetric_dirichlet.mean;
            mean.is_nan() || mean > enough
        }
        _ => charts.iter().any(|chart| chart.misses_target),
    }
}

/// The edges that charts are cut along, and those between them.
fn cut_of(mesh: &SurfaceMesh, parts: &[Component], charts: &[Chart]) -> EdgeData<bool> {
    let mut cut = EdgeData::filled(mesh.edges(), false);
    for (part, chart) in parts.iter().zip(charts) {
        part.mark_in(mesh, &chart.cut, &mut cut);
    }
    mark_seams(mesh, parts, &mut cut);
    cut
}

/// Marks the edges between different parts.
fn mark_seams(mesh: &SurfaceMesh, parts: &[Component], cut: &mut EdgeData<bool>) {
    let mut part_of = FaceData::filled(mesh.faces(), 0);
    for (i, part) in parts.iter().enumerate() {
        part.faces.iter().for_each(|&face| part_of[face] = i);
    }
    for edge in mesh.edge_ids() {
        let h = mesh.edge_halfedge(edge);
        cut[edge] |= mesh.twin(h).is_some_and(|t| part_of[h.face()] != part_of[t.face()]);
    }
}

/// The point that a file with texture coordinates in single precision holds: u, and 1 − v, which formats count from above.
fn single([u, v]: Vec2) -> Vec2 {
    [f64::from(u as f32), 1.0 - f64::from((1.0 - v) as f32)]
}

/// The report of one chart.
fn part_report(surface: &EmbeddedSurface, part: &Component, chart: &Chart, whole: &Flattening) -> PartReport {
    let mesh = surface.mesh();
    let among = |faces: &[FaceId]| part.faces.iter().filter(|face| faces.binary_search(face).is_ok()).count();
    let sides = part.faces.iter().flat_map(|&face| SurfaceMesh::face_halfedges(face)).map(|h| mesh.edge(h));
    let mut edges: Vec<EdgeId> = sides.filter(|&edge| whole.cut[edge]).collect();
    edges.sort_unstable_by_key(|edge| edge.index());
    edges.dedup();
    let values = |&face: &FaceId| (whole.singular_values[face], surface.surface().face_area(face));
    PartReport {
        first_face: part.faces.first().map_or(0, |face| face.0),
        faces: part.faces.len(),
        flipped: among(&whole.flipped),
        overlapping: among(&whole.overlapping),
        cut_edges: edges.len(),
        cut_length: edges.iter().fold(0.0, |sum, &edge| sum + surface.surface().edge_length(edge)),
        weights: chart.weights.name(),
        reweightings: chart.rounds,
        steps: chart.steps,
        distortion: Distortion::of(&part.faces.iter().map(values).collect::<Vec<_>>()),
    }
}

/// The positions of all vertices of all charts: on one scale, side by side.
fn arrange(parts: &[Component], charts: &[Chart], options: &FlattenOptions<'_>) -> Vec<Vec<Vec2>> {
    let mut places: Vec<Vec<Vec2>> = charts.iter().map(|chart| chart.uv.clone()).collect();
    if !options.pack && places.len() == 1 {
        return places;
    }
    for ((part, chart), places) in parts.iter().zip(charts).zip(&mut places) {
        let factor = best_scale(&chart.values(part));
        for p in places.iter_mut() {
            *p = scale(factor, *p);
        }
        if !matches!(options.method, Method::Convex { .. }) && options.cut.symmetry.is_none() {
            turn(places);
        }
    }
    pack(&mut places);
    places
}

/// Checks and measures a map.
fn judge(
    surface: &EmbeddedSurface,
    options: &FlattenOptions<'_>,
    cut: EdgeData<bool>,
    opened: Opened,
    uv: VertexData<Vec2>,
    charts: &[Vec<Vec2>],
) -> Flattening {
    let start = Instant::now();
    let flipped = flipped_faces(opened.faces(), &uv);
    let mesh = opened.mesh();
    let crossings = outline_crossings(&outline(mesh), &uv);
    let is_proven = flipped.is_empty() && crossings.is_empty() && are_apart(charts);
    let overlapping = if is_proven { Vec::new() } else { overlapping_faces(opened.faces(), &uv) };
    let at = |face: FaceId| singular_values(surface.surface(), face, opened.mesh().face(face).map(|v| uv[v]));
    let values: Vec<([f64; 2], f64)> =
        surface.mesh().face_ids().map(|face| (at(face), surface.surface().face_area(face))).collect();
    let distortion = Distortion::of(&values);
    let length = seam_length(surface.surface(), &cut);
    let report = FlattenReport {
        charts: charts.len(),
        flipped: flipped.len(),
        overlapping: overlapping.len(),
        outline_crossings: crossings.len(),
        boundary_loops: mesh.boundary_loops().len(),
        cut: CutReport {
            edges: cut.iter().filter(|is_cut| **is_cut).count(),
            length,
            relative_length: length / surface.surface().area().sqrt(),
            strategy: options.cut.strategy.name(),
        },
        method: options.method.name(),
        weights: "",
        reweightings: 0,
        steps: 0,
        stop: StopReason::Tolerance,
        distortion,
        parts: Vec::new(),
        timing: Timing { check: start.elapsed(), ..Timing::default() },
    };
    let singular_values =
        FaceData::from_fn(values.len(), |face: FaceId| values[face.index()].0.map(|s| distortion.scale * s));
    Flattening { cut, opened, uv, flipped, overlapping, singular_values, report }
}

/// Whether the bounding boxes of charts are disjoint.
fn are_apart(charts: &[Vec<Vec2>]) -> bool {
    let mut boxes: Vec<[Vec2; 2]> = charts.iter().map(|chart| bounds(chart)).collect();
    boxes.sort_by(|a, b| a[0][0].total_cmp(&b[0][0]));
    boxes.iter().enumerate().all(|(i, p)| {
        let beside = boxes[i + 1..].iter().take_while(|q| q[0][0] <= p[1][0]);
        beside.into_iter().all(|q| q[1][1] < p[0][1] || p[1][1] < q[0][1])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A search that fails is given up; one without memory ends the run.
    #[test]
    fn only_memory_ends_a_run_that_has_another_way() {
        let none = SolveError::NoMemory { unknowns: 1, nonzeros: 1 };
        assert_eq!(unless_out_of_memory::<()>(Err(none.into())), Err(none.into()));
        assert_eq!(unless_out_of_memory::<()>(Err(SolveError::Singular { index: 0 }.into())), Ok(None));
        assert_eq!(unless_out_of_memory(Ok(Some(1))), Ok(Some(1)));
    }
}
