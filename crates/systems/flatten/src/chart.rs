//! One component: cut into a disk and flattened.

use crate::components::Component;
use crate::cut::{Costs, CutStrategy, GrowingCut, Opened, first_cut, largest, open, tips};
use crate::distortion::{all_singular_values, best_scale, symmetric_dirichlet};
use crate::map::{ConvexBoundary, Descent, Minimization, Start, Weights, minimize, start_map};
use crate::report::Timing;
use crate::watch::Watch;
use crate::{CutOptions, FlattenError, FlattenOptions, Method};
use pompeiu_core::mesh::VertexData;
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_surface::plane::{Vec2, scale};
use pompeiu_surface::{EdgeData, EdgeDistances, EmbeddedSurface, SurfaceError};
use std::time::Instant;

/// Newton steps of a map that only says where to cut next.
const STEPS_BETWEEN_CUTS: usize = 12;

/// The decrease that a Newton step promises, over the distortion: between cuts, and at the end.
const ROUGH: f64 = 2e-2;
const FINE: f64 = 1e-3;

/// Distance from the cut, over the square root of the area, within which a tip is left alone.
const NEAR: f64 = 0.2;

/// Rounds in which distortion is averaged over neighbours before its greatest place is looked for.
const SMOOTHINGS: usize = 5;

/// A component as a flat disk.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    /// Edges of the component that were cut.
    pub(crate) cut: EdgeData<bool>,
    pub(crate) opened: Opened,
    /// The place of each vertex of the opened component.
    pub(crate) uv: Vec<Vec2>,
    pub(crate) weights: Weights,
    pub(crate) rounds: usize,
    pub(crate) steps: usize,
    pub(crate) timing: Timing,
}

/// A component opened, with its geometry.
struct Disk {
    opened: Opened,
    surface: EmbeddedSurface,
}

impl Disk {
    fn new(component: &Component, cut: &EdgeData<bool>) -> Result<Self, FlattenError> {
        let opened = open(component.surface.mesh(), cut)?;
        opened.check_disks()?;
        let positions = opened.spread(component.surface.positions());
        let mesh = TriMesh::new(positions, opened.faces().to_vec()).map_err(|_| SurfaceError::NoFaces);
        let surface = EmbeddedSurface::new(&mesh.map_err(crate::CutError::from)?)?;
        Ok(Self { opened, surface })
    }
}

/// Flattens a component; `requested` are the edges to cut if the caller gave them.
pub(crate) fn flatten_component(
    component: &Component,
    requested: Option<EdgeData<bool>>,
    options: &FlattenOptions<'_>,
    watch: &Watch<'_>,
) -> Result<Chart, FlattenError> {
    let began = Instant::now();
    let of_component = component.options(&options.cut);
    let mut cut = match requested {
        Some(cut) => cut,
        None => first_cut(&component.surface, &of_component).map_err(|error| in_whole(error, component))?,
    };
    let mut disk = Disk::new(component, &cut).map_err(|error| error_in_whole(error, component))?;
    let mut timing = Timing { cut: began.elapsed(), ..Timing::default() };
    let steps_at_the_end = match &options.method {
        Method::Convex { boundary, weights } => {
            let start = start(&disk, boundary, *weights, false, component, &mut timing)?;
            let Start { uv, weights, rounds, .. } = start;
            return Ok(Chart {
                cut,
                opened: disk.opened,
                uv: uv.into_vec(),
                weights,
                rounds,
                steps: 0,
                timing,
            });
        }
        Method::Free { steps } => *steps,
    };
    let adds_cuts = options.cut.strategy == CutStrategy::Auto;
    let most_cuts = if adds_cuts { options.most_cuts } else { 0 };
    let (mut rounds, mut steps, mut cuts) = (0, 0, 0);
    let whole = component.surface.mesh();
    let is_sphere = whole.genus() == 0 && whole.boundary_loops().is_empty();
    loop {
        let begin = start(&disk, &ConvexBoundary::Circle, Weights::MeanValue, true, component, &mut timing)?;
        rounds += begin.rounds;
        let mut uv = begin.uv.into_vec();
        let goes_on = cuts < most_cuts && !watch.is_stopped();
        if goes_on {
            let rough = Descent { steps: STEPS_BETWEEN_CUTS, tolerance: ROUGH, enough: options.target };
            let found = descend(&disk, uv, &rough, watch, &mut timing)?;
            steps += found.steps;
            uv = found.uv;
            if found.energy > options.target {
                let began = Instant::now();
                let longer =
                    if cuts == 0 && !is_sphere { with_tips(component, &cut, &of_component) } else { None };
                let longer = longer.or_else(|| lengthened(component, &disk, &cut, &uv, &of_component));
                if let Some(longer) = longer {
                    cut = longer;
                    disk = Disk::new(component, &cut)?;
                    cuts += 1;
                    timing.cut += began.elapsed();
                    continue;
                }
            }
        }
        let fine = Descent { steps: steps_at_the_end, tolerance: FINE, enough: 0.0 };
        let found = descend(&disk, uv, &fine, watch, &mut timing)?;
        steps += found.steps;
        return Ok(Chart {
            cut,
            opened: disk.opened,
            uv: found.uv,
            weights: begin.weights,
            rounds,
            steps,
            timing,
        });
    }
}

/// Maps a disk to a convex boundary, at the scale of least symmetric Dirichlet energy if it is to descend from there.
fn start(
    disk: &Disk,
    boundary: &ConvexBoundary,
    weights: Weights,
    goes_on: bool,
    component: &Component,
    timing: &mut Timing,
) -> Result<Start, FlattenError> {
    let found = start_map(&disk.surface, disk.opened.faces(), boundary, weights, goes_on);
    let mut found = found.map_err(|error| error_in_whole(error, component))?;
    timing.factor += found.factor;
    timing.solve += found.solve;
    timing.check += found.check;
    if goes_on {
        let areas = disk.surface.surface().face_areas();
        let values: Vec<_> =
            all_singular_values(disk.surface.surface(), &found.uv).into_iter().zip(areas).collect();
        let factor = best_scale(&values);
        found.uv.iter_mut().for_each(|p| *p = scale(factor, *p));
    }
    Ok(found)
}

fn descend(
    disk: &Disk,
    uv: Vec<Vec2>,
    descent: &Descent,
    watch: &Watch<'_>,
    timing: &mut Timing,
) -> Result<Minimization, FlattenError> {
    let began = Instant::now();
    let found = minimize(&disk.surface, uv, descent, watch)?;
    timing.factor += found.factor;
    timing.solve += began.elapsed().saturating_sub(found.factor);
    Ok(found)
}

/// The cut joined with the tips of the surface; `None` if they are on it.
fn with_tips(component: &Component, cut: &EdgeData<bool>, options: &CutOptions) -> Option<EdgeData<bool>> {
    let surface = component.surface.surface();
    let costs = Costs::new(surface, &options.forbidden);
    let mut growing = GrowingCut::new(surface, &costs, cut.clone());
    let distances = EdgeDistances::from(surface, &growing.reached()).distances;
    let near = NEAR * surface.area().sqrt();
    let mut ends = tips(surface);
    ends.retain(|&v| !costs.forbid(v) && distances[v] > near);
    growing.join(&ends);
    (growing.edges != *cut).then_some(growing.edges)
}

/// The cut with a shortest path more, to where faces are distorted and far from it; `None` if no path leads there.
fn lengthened(
    component: &Component,
    disk: &Disk,
    cut: &EdgeData<bool>,
    uv: &[Vec2],
    options: &CutOptions,
) -> Option<EdgeData<bool>> {
    let surface = component.surface.surface();
    let mesh = surface.mesh();
    let places = VertexData::from_fn(uv.len(), |v: VertexId| uv[v.index()]);
    let values = all_singular_values(disk.surface.surface(), &places);
    let mut density = vec![0.0; mesh.vertices()];
    let areas = surface.vertex_areas();
    for face in mesh.face_ids() {
        let share = surface.face_area(face) / 3.0 * symmetric_dirichlet(values[face]);
        for v in mesh.face(face) {
            density[v.index()] += share / areas[v];
        }
    }
    for _ in 0..SMOOTHINGS {
        let mean = |v: VertexId| {
            let around = mesh
                .outgoing(v)
                .flat_map(|h| [density[mesh.head(h).index()], density[mesh.tail(h.previous()).index()]]);
            let (sum, count) = around.fold((0.0, 0.0), |(sum, count), x| (sum + x, count + 1.0));
            0.5 * density[v.index()] + 0.5 * sum / count
        };
        density = mesh.vertex_ids().map(mean).collect();
    }
    let costs = Costs::new(surface, &options.forbidden);
    let mut growing = GrowingCut::new(surface, &costs, cut.clone());
    let distances = EdgeDistances::from(surface, &growing.reached()).distances;
    let gain: Vec<f64> = mesh
        .vertex_ids()
        .map(|v| if costs.forbid(v) { 0.0 } else { (density[v.index()] - 4.0) * distances[v] })
        .collect();
    let far = VertexId(largest(&gain) as u32);
    let is_joined = gain[far.index()] > 0.0 && growing.join(&[far]).is_empty();
    is_joined.then_some(growing.edges)
}

/// An error of a component with the numbers of the whole surface.
fn in_whole(error: crate::CutError, component: &Component) -> crate::CutError {
    use crate::CutError::{Forbidden, NoDisk, SingleEdge};
    match error {
        NoDisk { face, euler_characteristic, boundary_loops } => {
            NoDisk { face: component.faces[face.index()], euler_characteristic, boundary_loops }
        }
        Forbidden { face } => Forbidden { face: component.faces[face.index()] },
        SingleEdge { ends } => SingleEdge { ends: ends.map(|v| component.vertices[v.index()]) },
        other => other,
    }
}

fn error_in_whole(error: FlattenError, component: &Component) -> FlattenError {
    match error {
        FlattenError::Cut(error) => FlattenError::Cut(in_whole(error, component)),
        FlattenError::Crowded { faces, ratio } => FlattenError::Crowded {
            faces: faces.into_iter().map(|face| component.faces[face.index()]).collect(),
            ratio,
        },
        other => other,
    }
}
