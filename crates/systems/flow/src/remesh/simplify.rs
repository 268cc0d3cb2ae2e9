//! Simplification: collapsing edges in order of their quadric error, while the surface stays within a distance.

use super::connectivity::{DynamicMesh, NONE, previous};
use super::cover::Cover;
use super::options::{Simplified, SimplifyError, SimplifyOptions, SimplifyTarget, SimplifyTiming};
use super::quadric::Quadric;
use super::within::{Input, Triangle};
use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::run::{Control, Progress, ProgressObserver, StopReason, on_threads};
use pompeiu_core::spatial::bvh::{Bvh, Workspace};
use pompeiu_hausdorff::symmetric_hausdorff;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::time::Instant;

/// Share of the distance that the local tests may use; the rest covers their rounding.
const LOCAL_SHARE: f64 = 0.9999;

/// Passes over all edges: an edge that could not be collapsed may be when others were.
const MOST_PASSES: usize = 4;

/// Pieces of a new face that are looked at before it is rejected: so many, and more for each face of the input near its star.
const LEAST_PIECES: usize = 256;
const PIECES_PER_FACE: usize = 4;

/// Edges between two reports of progress.
const PROGRESS_EVERY: u64 = 512;

/// Cosine between the normals of a face before and after a collapse: below it the face is counted as turned over.
const LEAST_COSINE: f64 = 0.2;

/// Positions nearer to each other than the root of this share of the edge's length are tried once.
const SAME_POSITION: f64 = 1e-6;

/// Weight of the planes that hold a boundary edge in its place, relative to the area of its face.
const BOUNDARY_WEIGHT: f64 = 4.0;

/// Simplifies a mesh by quadric-error edge collapses.
///
/// # Shapes and units
/// An oriented manifold mesh, with or without boundary, of any number of components; lengths in its unit.
/// # Accuracy
/// With [`SimplifyTarget::Within`] every collapse is tested on both sides: each new face lies near the input, and each face of the
/// input near the new faces. These tests steer only. What is returned was measured by
/// [`symmetric_hausdorff`], and its upper end is at most the distance asked for, rounding included.
/// # Limits
/// The number of faces is not the least possible one: collapses are chosen greedily. The distance between boundary *curves* is
/// not bounded: a thin spike in the plane of a sheet can be cut off where the rest of the sheet is near it.
/// # Errors
/// [`SimplifyError`].
/// # Cost
/// O(m log m) collapses for m faces; the tests of one collapse grow with the faces of the input that it affects. Some 400 bytes
/// for each face of the input.
/// # Source
/// Quadric errors of `garland_surface_1997`; the two-sided test of faces against faces is ours.
/// # Example
/// ```
/// use pompeiu_core::mesh::shapes::icosphere;
/// use pompeiu_flow::remesh::{SimplifyOptions, SimplifyTarget, simplify};
///
/// let sphere = icosphere(1.0, 4)?;
/// let found = simplify(&sphere, &SimplifyOptions::new(SimplifyTarget::Within(0.01)))?;
/// assert!(found.distance.distance.upper() <= 0.01);
/// assert!(found.mesh.faces().len() < sphere.faces().len() / 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn simplify(mesh: &TriMesh, options: &SimplifyOptions<'_>) -> Result<Simplified, SimplifyError> {
    let mut levels = simplify_levels(mesh, options, 1)?;
    levels.pop().ok_or(SimplifyError::NoLevels)
}

/// Simplifies a mesh step by step: levels of detail, the finest first, the last one as [`simplify`] is asked for.
///
/// Each level has half the distance of the next one, or twice as many faces, and its own proof. Every level goes on where the one before
/// ended, so all of them together take little longer than the last.
///
/// # Errors
/// Those of [`simplify`]; [`SimplifyError::NoLevels`] if none is asked for.
pub fn simplify_levels(
    mesh: &TriMesh,
    options: &SimplifyOptions<'_>,
    levels: usize,
) -> Result<Vec<Simplified>, SimplifyError> {
    on_threads(options.limits.threads, || simplify_here(mesh, options, levels))
}

fn simplify_here(
    mesh: &TriMesh,
    options: &SimplifyOptions<'_>,
    levels: usize,
) -> Result<Vec<Simplified>, SimplifyError> {
    let mut started = Instant::now();
    let aabb = Aabb::of_faces(mesh);
    let targets = options.targets(aabb.diagonal(), levels)?;
    let frame = Frame::of(&aabb);
    let mut dynamic = DynamicMesh::new(mesh.positions(), mesh.faces())?;
    dynamic.map_positions(|p| frame.map(p));
    let bvh = Bvh::build(mesh, &frame);
    let control = Control::start(&options.limits);
    let mut work = Simplifier::new(dynamic, &bvh, matches!(options.target, SimplifyTarget::Within(_)));
    let mut found = Vec::with_capacity(levels);
    for target in targets {
        match target {
            SimplifyTarget::Within(d) => work.come_within(LOCAL_SHARE * frame.length_in(d)),
            SimplifyTarget::Faces(n) => work.least_faces = n,
        }
        work.run(&control, options.progress);
        let mut result = work.mesh.clone();
        result.map_positions(|p| frame.unmap(p));
        let stop = control.reason().unwrap_or(StopReason::Tolerance);
        found.push(measured(mesh, result.to_mesh()?, target, work.collapses, stop, started)?);
        started = Instant::now();
    }
    Ok(found)
}

/// Measures how far a result is from the input, and checks that it is as near as asked.
fn measured(
    input: &TriMesh,
    mesh: TriMesh,
    target: SimplifyTarget,
    collapses: usize,
    stop: StopReason,
    started: Instant,
) -> Result<Simplified, SimplifyError> {
    let collapse = started.elapsed();
    let distance = symmetric_hausdorff(input, &mesh);
    if let SimplifyTarget::Within(d) = target
        && distance.distance.upper() > d
    {
        return Err(SimplifyError::NotWithin { distance: d, upper: distance.distance.upper() });
    }
    let timing = SimplifyTiming { collapse, distance: started.elapsed().saturating_sub(collapse) };
    Ok(Simplified { mesh, target, distance, collapses, stop, timing })
}

/// An edge in the queue: its error, its halfedge, and the versions of its ends when the error was computed.
type Entry = Reverse<(u64, u32, [u32; 2])>;

struct Simplifier<'i> {
    mesh: DynamicMesh,
    quadrics: Vec<Quadric>,
    /// Counts the changes of each vertex.
    versions: Vec<u32>,
    /// What was around each halfedge, by [`Simplifier::surroundings`], when it was last tried in vain.
    failed: Vec<Option<u64>>,
    queue: BinaryHeap<Entry>,
    input: Input<'i>,
    limit: f64,
    /// Which faces of the input each face covers; none where no distance was asked for.
    cover: Option<Cover>,
    least_faces: usize,
    collapses: usize,
    workspace: Workspace,
}

/// What a collapse would make of the faces around an edge.
struct Star {
    /// Faces that stay, with the corner that moves.
    kept: Vec<(u32, usize)>,
    /// Faces that go.
    removed: Vec<u32>,
}

impl<'i> Simplifier<'i> {
    fn new(mesh: DynamicMesh, bvh: &'i Bvh, within: bool) -> Self {
        let quadrics = vertex_quadrics(&mesh);
        let cover = within.then(|| Cover::new(&mesh, bvh));
        let versions = vec![0; mesh.positions.len()];
        let input = Input { bvh, limit_sq: f64::INFINITY };
        Self {
            failed: vec![None; mesh.origin.len()],
            mesh,
            quadrics,
            versions,
            queue: BinaryHeap::new(),
            input,
            limit: f64::INFINITY,
            cover,
            least_faces: 1,
            collapses: 0,
            workspace: Workspace::default(),
        }
    }

    /// From now on the surface stays within this distance, which is not less than before.
    fn come_within(&mut self, limit: f64) {
        self.limit = limit;
        self.input.limit_sq = limit * limit;
        self.failed.fill(None);
    }

    /// Collapses edges until none can be, or the computation is told to stop: the surface stays within the distance all the time.
    fn run(&mut self, control: &Control, progress: Option<&dyn ProgressObserver>) {
        let (mut looked_at, all) = (0_u64, self.mesh.face_count() as f64);
        for _ in 0..MOST_PASSES {
            let before = self.collapses;
            for h in 0..self.mesh.halfedge_slots() {
                if self.mesh.names_edge(h) {
                    self.push(h);
                }
            }
            while let Some(Reverse((_, h, versions))) = self.queue.pop() {
                if self.mesh.face_count() <= self.least_faces || control.is_stopped() {
                    self.queue.clear();
                    return;
                }
                looked_at += 1;
                if looked_at.is_multiple_of(PROGRESS_EVERY) {
                    self.report(all, control, progress);
                }
                if !self.mesh.exists(h) || self.versions_of(h) != versions {
                    continue;
                }
                let around = Some(self.surroundings(h));
                if self.failed[h as usize] == around {
                    continue;
                }
                if self.try_collapse(h) {
                    self.collapses += 1;
                } else {
                    self.failed[h as usize] = around;
                }
            }
            if self.collapses == before {
                return;
            }
        }
    }

    /// The share that is done follows the logarithm of the number of faces, for the last faces take the longest.
    fn report(&self, all: f64, control: &Control, progress: Option<&dyn ProgressObserver>) {
        let faces = self.mesh.face_count() as f64;
        let share = (all / faces).ln() / (all / self.least_faces.max(4) as f64).ln();
        let share = Some(if share < 1.0 { share } else { 1.0 });
        let shown = Progress { doing: "collapsing edges", share };
        if progress.is_some_and(|observer| observer.progress(&shown).is_break()) {
            control.stop(StopReason::Cancelled);
        }
    }

    fn versions_of(&self, h: u32) -> [u32; 2] {
        [self.mesh.from(h), self.mesh.to(h)].map(|v| self.versions[v as usize])
    }

    /// A number that changes when a vertex beside an edge or a neighbour of one does: until then the edge need not be tried again.
    fn surroundings(&self, h: u32) -> u64 {
        let ends = [self.mesh.from(h), self.mesh.to(h)];
        let around = ends.into_iter().flat_map(|v| self.mesh.neighbours(v));
        around.fold(0, |sum: u64, v| {
            let one = (u64::from(v) << 32) | u64::from(self.versions[v as usize]);
            // An odd number close to 2^64 divided by the golden ratio spreads the bits.
            sum.rotate_left(5).wrapping_add(one.wrapping_mul(0x9e37_79b9_7f4a_7c15))
        })
    }

    fn push(&mut self, h: u32) {
        let (u, v) = (self.mesh.from(h), self.mesh.to(h));
        let quadric = self.quadrics[u as usize].plus(&self.quadrics[v as usize]);
        let middle = 0.5 * (self.mesh.positions[u as usize] + self.mesh.positions[v as usize]);
        let error = quadric.at(quadric.optimum(middle));
        // The bits of numbers that are not negative are ordered as the numbers are.
        self.queue.push(Reverse((error.to_bits(), h, self.versions_of(h))));
    }

    /// Collapses an edge if some position passes all tests.
    fn try_collapse(&mut self, h: u32) -> bool {
        // The end that lies on the boundary stays.
        let h = match self.mesh.twin_of(h) {
            Some(t)
                if self.mesh.is_boundary(self.mesh.from(h)) && !self.mesh.is_boundary(self.mesh.to(h)) =>
            {
                t
            }
            _ => h,
        };
        if self.mesh.check_collapse(h).is_err() {
            return false;
        }
        let star = self.star(h);
        for position in self.positions(h, &star) {
            let faces: Vec<Triangle> = star.kept.iter().map(|&(f, i)| self.moved(f, i, position)).collect();
            if !self.keeps_normals(&star, &faces) || !self.is_near(&star, position, &faces) {
                continue;
            }
            if let Some(cover) = &mut self.cover {
                let kept: Vec<u32> = star.kept.iter().map(|k| k.0).collect();
                let gone: Vec<u32> = star.removed.iter().chain(&kept).copied().collect();
                match cover.cover_anew(&self.mesh, &gone, &kept, &faces, self.input.limit_sq) {
                    Some(covering) => cover.replace(&gone, covering),
                    None => continue,
                }
            }
            let (u, v) = (self.mesh.from(h), self.mesh.to(h));
            self.mesh.collapse(h, position).expect("the collapse was checked");
            self.quadrics[v as usize] = self.quadrics[v as usize].plus(&self.quadrics[u as usize]);
            self.versions[v as usize] += 1;
            self.versions[u as usize] += 1;
            self.push_around(v);
            return true;
        }
        false
    }

    fn push_around(&mut self, v: u32) {
        let spokes: Vec<u32> = self.mesh.halfedges_from(v).collect();
        for h in spokes {
            self.push(h);
            // At the boundary the last edge has a halfedge towards the vertex only.
            let last = previous(h);
            if self.mesh.twin_of(last).is_none() {
                self.push(last);
            }
        }
    }

    fn star(&self, h: u32) -> Star {
        let (u, v) = (self.mesh.from(h), self.mesh.to(h));
        let removed: Vec<u32> =
            [Some(h), self.mesh.twin_of(h)].into_iter().flatten().map(|x| x / 3).collect();
        let around = self.mesh.halfedges_from(u).chain(self.mesh.halfedges_from(v));
        let kept = around.map(|x| (x / 3, (x % 3) as usize)).filter(|(f, _)| !removed.contains(f)).collect();
        Star { kept, removed }
    }

    fn triangle(&self, f: u32) -> Triangle {
        self.mesh.corners(f).map(|v| self.mesh.positions[v as usize])
    }

    fn moved(&self, f: u32, corner: usize, position: DVec3) -> Triangle {
        let mut triangle = self.triangle(f);
        triangle[corner] = position;
        triangle
    }

    /// Positions to try, the one of least error first.
    fn positions(&self, h: u32, star: &Star) -> Vec<DVec3> {
        let [u, v] = [self.mesh.from(h), self.mesh.to(h)];
        let [p, q] = [u, v].map(|x| self.mesh.positions[x as usize]);
        if self.mesh.is_boundary(v) && !self.mesh.is_boundary(u) {
            return vec![q];
        }
        let middle = 0.5 * (p + q);
        let quadric = self.quadrics[u as usize].plus(&self.quadrics[v as usize]);
        let best = quadric.optimum(middle);
        let mut all = vec![best, middle, q, p, 0.5 * (best + middle), 0.5 * (best + p), 0.5 * (best + q)];
        if self.limit.is_finite() {
            let normal: DVec3 = star.kept.iter().map(|(f, _)| area_vector(&self.triangle(*f))).sum();
            let normal = normal.normalize_or_zero();
            let offsets = [0.25, -0.25, 0.5, -0.5].map(|s| best + s * self.limit * normal);
            all.extend(offsets);
        }
        // In flat places several are one.
        let apart = SAME_POSITION * p.distance_squared(q);
        let mut different: Vec<DVec3> = Vec::with_capacity(all.len());
        for position in all {
            if different.iter().all(|x| x.distance_squared(position) > apart) {
                different.push(position);
            }
        }
        different
    }

    fn keeps_normals(&self, star: &Star, faces: &[Triangle]) -> bool {
        star.kept.iter().zip(faces).all(|((f, _), new)| {
            let (old, new) = (area_vector(&self.triangle(*f)), area_vector(new));
            let sizes = old.length() * new.length();
            // A face without area has no normal to keep, but must not become another one.
            if old == DVec3::ZERO { new != DVec3::ZERO } else { old.dot(new) > LEAST_COSINE * sizes }
        })
    }

    fn is_near(&mut self, star: &Star, position: DVec3, faces: &[Triangle]) -> bool {
        let (Some(cover), Some((first, _))) = (&self.cover, star.kept.first()) else { return true };
        let mut start = cover.start_near(*first);
        // The moved corner first: it may be too far by itself.
        let found = self.input.bvh.nearest(position.to_array(), start, &mut self.workspace);
        if found.distance_sq > self.input.limit_sq {
            return false;
        }
        // A face over many faces of the input takes as many pieces.
        let over: usize = star.kept.iter().map(|(f, _)| cover.covered_by(*f)).sum();
        let most_pieces = LEAST_PIECES + PIECES_PER_FACE * over;
        faces.iter().all(|t| self.input.is_near(*t, most_pieces, &mut start, &mut self.workspace))
    }
}

/// Twice the area of a triangle, along its normal.
fn area_vector([a, b, c]: &Triangle) -> DVec3 {
    (*b - *a).cross(*c - *a)
}

/// For each vertex the planes of its faces, and at boundary edges planes that stand upright on them.
fn vertex_quadrics(mesh: &DynamicMesh) -> Vec<Quadric> {
    let mut quadrics = vec![Quadric::default(); mesh.positions.len()];
    for h in 0..mesh.halfedge_slots() {
        let triangle = mesh.corners(h / 3).map(|v| mesh.positions[v as usize]);
        let normal = area_vector(&triangle);
        let area = 0.5 * normal.length();
        let Some(normal) = normal.try_normalize() else { continue };
        let (u, v) = (mesh.from(h), mesh.to(h));
        let p = mesh.positions[u as usize];
        let face = Quadric::of_plane(normal, p, area / 3.0);
        quadrics[u as usize] = quadrics[u as usize].plus(&face);
        if mesh.twin[h as usize] == NONE
            && let Some(upright) = normal.cross(mesh.positions[v as usize] - p).try_normalize()
        {
            let edge = Quadric::of_plane(upright, p, BOUNDARY_WEIGHT * area);
            for end in [u, v] {
                quadrics[end as usize] = quadrics[end as usize].plus(&edge);
            }
        }
    }
    quadrics
}
