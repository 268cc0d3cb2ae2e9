//! Symmetric cuts.

use super::{Images, SymmetryError};
use crate::components::Component;
use crate::cut::{Costs, CutError, CutOptions, CutStrategy, disk_cut, farthest_pair, open, tips};
use pompeiu_core::mesh::{UnionFind, VertexData};
use pompeiu_core::{FaceId, TriMesh, VertexId};
use pompeiu_surface::{EdgeData, EdgeId, EmbeddedSurface, GeometryError, SurfaceMesh};
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// A cut that grows by shortest paths on one side of the plane of symmetry, and by their mirror images on the other.
///
/// Paths reach the plane only along edges in it. So a path and its mirror image meet only where the path begins, and close no loop:
/// a disk stays a disk.
pub(crate) struct SymmetricCut<'s> {
    surface: &'s EmbeddedSurface,
    images: &'s Images,
    costs: &'s Costs,
    pub(crate) edges: EdgeData<bool>,
    reached: VertexData<bool>,
}

impl<'s> SymmetricCut<'s> {
    pub(crate) fn new(
        surface: &'s EmbeddedSurface,
        images: &'s Images,
        costs: &'s Costs,
        edges: EdgeData<bool>,
    ) -> Self {
        let mesh = surface.mesh();
        let mut reached = VertexData::from_fn(mesh.vertices(), |v| mesh.is_boundary_vertex(v));
        for v in mesh.edge_ids().filter(|&edge| edges[edge]).flat_map(|edge| mesh.ends(edge)) {
            reached[v] = true;
        }
        Self { surface, images, costs, edges, reached }
    }

    pub(crate) fn reached(&self) -> Vec<VertexId> {
        self.surface.mesh().vertex_ids().filter(|&v| self.reached[v]).collect()
    }

    /// The cost of cutting an edge and its mirror image.
    fn cost(&self, edge: EdgeId) -> f64 {
        match self.images.of_edge(edge) {
            Some(image) => self.costs.of(edge).max(self.costs.of(image)),
            None => f64::INFINITY,
        }
    }

    /// Joins all these vertices and their mirror images, nearest first; returns those that no path reaches.
    pub(crate) fn join(&mut self, terminals: &[VertexId]) -> Vec<VertexId> {
        let mut left: Vec<VertexId> = terminals.iter().map(|&v| self.images.on_first_side(v)).collect();
        loop {
            left.retain(|&v| !self.reached[v]);
            let (distances, before) = self.distances();
            let near = left.iter().copied().min_by(|a, b| distances[*a].total_cmp(&distances[*b]));
            let Some(near) = near.filter(|v| distances[*v].is_finite()) else { return left };
            let mut at = near;
            while let Some((edge, previous)) = before[at] {
                self.add(edge);
                at = previous;
            }
        }
    }

    fn add(&mut self, edge: EdgeId) {
        for edge in [Some(edge), self.images.of_edge(edge)].into_iter().flatten() {
            self.edges[edge] = true;
            for v in self.surface.mesh().ends(edge) {
                self.reached[v] = true;
            }
        }
    }

    /// The least costs from the existing cut, on the side of the normal and on the plane, and the step before each vertex.
    fn distances(&self) -> (VertexData<f64>, VertexData<Option<(EdgeId, VertexId)>>) {
        let mesh = self.surface.mesh();
        let mut distances = VertexData::filled(mesh.vertices(), f64::INFINITY);
        let mut before = VertexData::filled(mesh.vertices(), None);
        let mut open = BinaryHeap::new();
        for v in self.reached().into_iter().filter(|&v| self.images.side(v) != Ordering::Less) {
            distances[v] = 0.0;
            open.push(Reverse((0_u64, v.0)));
        }
        while let Some(Reverse((bits, v))) = open.pop() {
            let (v, distance) = (VertexId(v), f64::from_bits(bits));
            if distance > distances[v] {
                continue;
            }
            for out in mesh.outgoing(v) {
                for (h, w) in [(out, mesh.head(out)), (out.previous(), mesh.tail(out.previous()))] {
                    let enters_plane =
                        self.images.side(w) == Ordering::Equal && self.images.side(v) != Ordering::Equal;
                    let through = distance + self.cost(mesh.edge(h));
                    if self.images.side(w) != Ordering::Less && !enters_plane && through < distances[w] {
                        distances[w] = through;
                        before[w] = Some((mesh.edge(h), v));
                        open.push(Reverse((through.to_bits(), w.0)));
                    }
                }
            }
        }
        (distances, before)
    }
}

/// The symmetric cut of a connected surface, before cuts are added to reduce distortion.
///
/// # Definition
/// For a sphere or a disk: a tree that grows from the boundary, or from a vertex on the plane. Otherwise one half is cut into a
/// disk, the other one symmetrically, and both are joined along the longest part of the plane that no cut meets.
pub(crate) fn first_cut(
    surface: &EmbeddedSurface,
    images: &Images,
    options: &CutOptions,
) -> Result<EdgeData<bool>, CutError> {
    let mesh = surface.mesh();
    let costs = Costs::new(surface, options);
    let nothing = EdgeData::filled(mesh.edges(), false);
    let loops = mesh.boundary_loops().len();
    let is_sphere = mesh.genus() == 0 && loops == 0;
    let base = if mesh.genus() == 0 && loops < 2 { nothing } else { halves(surface, images, &costs)? };
    let mut cut = SymmetricCut::new(surface, images, &costs, base);
    let ends = match &options.strategy {
        CutStrategy::Genus => Vec::new(),
        CutStrategy::Auto if !is_sphere => Vec::new(),
        CutStrategy::Auto | CutStrategy::Tips => {
            let mut ends = tips(surface.surface());
            ends.retain(|&v| !costs.forbid(v) && !costs.forbid(images.of(v)));
            ends
        }
        CutStrategy::Through(vertices) => vertices.clone(),
        other => return Err(SymmetryError::Strategy { strategy: other.name() }.into()),
    };
    let nowhere = || CutError::Forbidden { face: FaceId(0) };
    let begins_on_plane = is_sphere && options.strategy != CutStrategy::Genus;
    // The farthest pair on the plane: the tree starts at one, and goes to the other if there are no other vertices to join.
    let mut other = None;
    if begins_on_plane {
        let on_plane = |v: &VertexId| images.side(*v) == Ordering::Equal && !costs.forbid(*v);
        let plane: Vec<VertexId> = mesh.vertex_ids().filter(on_plane).collect();
        let points: Vec<[f64; 3]> = plane.iter().map(|&v| surface.positions()[v]).collect();
        let [from, to] = farthest_pair(&points).ok_or_else(nowhere)?;
        let from = ends.iter().copied().find(on_plane).unwrap_or(plane[from]);
        cut.reached[from] = true;
        other = Some(plane[to]);
    }
    if !cut.join(&ends).is_empty() && matches!(options.strategy, CutStrategy::Through(_)) {
        return Err(nowhere());
    }
    if let Some(other) = other.filter(|_| cut.edges.iter().filter(|is_cut| **is_cut).count() < 2) {
        cut.join(&[other]);
    }
    if !costs.total(&cut.edges).is_finite() {
        return Err(nowhere());
    }
    open(mesh, &cut.edges)?.check_disks()?;
    Ok(cut.edges)
}

/// The half of a surface on the side of the normal.
fn half(surface: &EmbeddedSurface, images: &Images) -> Result<Component, GeometryError> {
    let mesh = surface.mesh();
    let faces: Vec<FaceId> =
        mesh.face_ids().filter(|&face| images.side_of(mesh.face(face)) == Ordering::Greater).collect();
    let mut vertices: Vec<VertexId> = faces.iter().flat_map(|&face| mesh.face(face)).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let local = |v: VertexId| vertices.binary_search(&v).unwrap_or(0) as u32;
    let positions = vertices.iter().map(|&v| surface.positions()[v]).collect();
    let triples = faces.iter().map(|&face| mesh.face(face).map(local)).collect();
    let half = TriMesh::new(positions, triples).map_err(|_| pompeiu_surface::SurfaceError::NoFaces)?;
    Ok(Component { surface: EmbeddedSurface::new(&half)?, faces, vertices, images: None })
}

/// The cut that makes each half a disk, and both together.
fn halves(surface: &EmbeddedSurface, images: &Images, costs: &Costs) -> Result<EdgeData<bool>, CutError> {
    let mesh = surface.mesh();
    let half = half(surface, images)?;
    let of_half = half.surface.mesh();
    let both = |edge: EdgeId| {
        let edge = half.edge_in(mesh, edge);
        images.of_edge(edge).map_or(f64::INFINITY, |image| costs.of(edge).max(costs.of(image)))
    };
    let costs = costs.elsewhere(of_half, both, |v| half.vertices[v.index()]);
    let of_half = disk_cut(half.surface.surface(), &costs);
    let mut cut = EdgeData::filled(mesh.edges(), false);
    half.mark_in(mesh, &of_half, &mut cut);
    let joined = longest_free(surface, images, &cut);
    let first: Vec<EdgeId> = mesh.edge_ids().filter(|&edge| cut[edge]).collect();
    for edge in first {
        let Some(image) = images.of_edge(edge) else {
            return Err(SymmetryError::NoCut { face: mesh.edge_halfedge(edge).face() }.into());
        };
        cut[image] = true;
    }
    for edge in mesh.edge_ids() {
        cut[edge] |= images.is_on_plane(mesh, edge) && !mesh.is_boundary_edge(edge);
        cut[edge] &= !joined[edge];
    }
    Ok(cut)
}

/// The longest chain of edges on the plane whose inner vertices no cut of a half meets.
fn longest_free(surface: &EmbeddedSurface, images: &Images, cut: &EdgeData<bool>) -> EdgeData<bool> {
    let mesh: &SurfaceMesh = surface.mesh();
    let mut is_met = VertexData::from_fn(mesh.vertices(), |v| mesh.is_boundary_vertex(v));
    for v in mesh.edge_ids().filter(|&edge| cut[edge]).flat_map(|edge| mesh.ends(edge)) {
        is_met[v] = true;
    }
    let on_plane: Vec<EdgeId> = mesh
        .edge_ids()
        .filter(|&edge| images.is_on_plane(mesh, edge) && !mesh.is_boundary_edge(edge) && !cut[edge])
        .collect();
    let mut chains = UnionFind::new(mesh.edges());
    let mut last: VertexData<Option<EdgeId>> = VertexData::filled(mesh.vertices(), None);
    for &edge in &on_plane {
        for v in mesh.ends(edge).into_iter().filter(|&v| !is_met[v]) {
            if let Some(other) = last[v].replace(edge) {
                chains.union(other.index(), edge.index());
            }
        }
    }
    let mut lengths = vec![0.0; mesh.edges()];
    for &edge in &on_plane {
        lengths[chains.find(edge.index())] += surface.surface().edge_length(edge);
    }
    let longest = crate::cut::largest(&lengths);
    let mut chain = EdgeData::filled(mesh.edges(), false);
    for edge in on_plane {
        chain[edge] = chains.find(edge.index()) == longest;
    }
    chain
}
