//! Additional cuts that reduce distortion.

use crate::CutOptions;
use crate::components::Component;
use crate::cut::{Costs, GrowingCut, largest, tips};
use crate::distortion::{all_singular_values, symmetric_dirichlet};
use crate::opened::Disk;
use crate::symmetry::SymmetricCut;
use pompeiu_core::VertexId;
use pompeiu_core::mesh::VertexData;
use pompeiu_surface::plane::Vec2;
use pompeiu_surface::{EdgeData, EdgeDistances};

/// Tips closer than this to the cut, relative to the square root of the area, are ignored.
const NEAR: f64 = 0.2;

/// Smoothing rounds for distortion before its maximum is determined.
const SMOOTHINGS: usize = 5;

/// The cut joined with the tips of the surface; `None` if they are all on it.
pub(crate) fn with_tips(
    component: &Component,
    cut: &EdgeData<bool>,
    options: &CutOptions,
) -> Option<EdgeData<bool>> {
    let surface = component.surface.surface();
    let costs = Costs::new(&component.surface, options);
    let mut growing = Growth::new(component, &costs, cut.clone());
    let distances = EdgeDistances::from(surface, &growing.reached()).distances;
    let near = NEAR * surface.area().sqrt();
    let mut ends = tips(surface);
    ends.retain(|&v| !costs.forbid(v) && distances[v] > near);
    growing.join(&ends);
    Some(growing.into_edges()).filter(|edges| edges != cut)
}

/// The cut with `count` more shortest paths, each to where distortion is high and far from the cut; `None` if no path reaches such
/// a place.
pub(crate) fn lengthened(
    component: &Component,
    disk: &Disk,
    cut: &EdgeData<bool>,
    uv: &[Vec2],
    options: &CutOptions,
    count: usize,
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
    let lengths = surface.edge_lengths();
    let costs = Costs::new(&component.surface, options);
    let mut growing = Growth::new(component, &costs, cut.clone());
    for _ in 0..count {
        let distances = EdgeDistances::along(surface, &growing.reached(), |edge| lengths[edge]).distances;
        let gain: Vec<f64> = mesh
            .vertex_ids()
            .map(|v| if costs.forbid(v) { 0.0 } else { (density[v.index()] - 4.0) * distances[v] })
            .collect();
        let far = VertexId(largest(&gain) as u32);
        if !(gain[far.index()] > 0.0 && growing.join(&[far]).is_empty()) {
            break;
        }
    }
    Some(growing.into_edges()).filter(|edges| edges != cut)
}

/// A growing cut, symmetric if a plane of symmetry is given.
enum Growth<'s> {
    Anywhere(GrowingCut<'s>),
    Symmetric(SymmetricCut<'s>),
}

impl<'s> Growth<'s> {
    fn new(component: &'s Component, costs: &'s Costs, edges: EdgeData<bool>) -> Self {
        match &component.images {
            Some(images) => Self::Symmetric(SymmetricCut::new(&component.surface, images, costs, edges)),
            None => Self::Anywhere(GrowingCut::new(component.surface.surface(), costs, edges)),
        }
    }

    fn reached(&self) -> Vec<VertexId> {
        match self {
            Self::Anywhere(cut) => cut.reached(),
            Self::Symmetric(cut) => cut.reached(),
        }
    }

    fn join(&mut self, terminals: &[VertexId]) -> Vec<VertexId> {
        match self {
            Self::Anywhere(cut) => cut.join(terminals),
            Self::Symmetric(cut) => cut.join(terminals),
        }
    }

    fn into_edges(self) -> EdgeData<bool> {
        match self {
            Self::Anywhere(cut) => cut.edges,
            Self::Symmetric(cut) => cut.edges,
        }
    }
}
