//! Collapsing edges in order of their quadric error, several at a time.

mod by_error;

use super::connectivity::NONE;
use super::cover::{Cover, Covering};
use super::crossing::{Crossings, are_apart};
use super::marked::Marked;
use super::places::Places;
use super::quadric::Quadric;
use super::queue::{Entry, Queue};
use super::simplify_options::Refusals;
use super::star::Star;
use super::trial::{Accepted, Refused, Scratch, Trial, place_in_queue};
use super::triangle::area_vector;
use super::within::Input;
use pompeiu_core::run::{Control, Progress, ProgressObserver, StopReason};
use pompeiu_core::spatial::bvh::Bvh;
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// Passes over all edges: an edge that could not be collapsed may be when others were.
const MOST_PASSES: usize = 4;

/// Edges tried at a time, at most, and faces for each of them: those that change the same faces must be tried again.
const MOST_TRIED: usize = 16;
const FACES_PER_TRIED: usize = 32;

/// Edges whose errors are computed by one task.
const PUSHED_TASK: usize = 64;

/// Weight of the planes that hold a boundary edge in its place, relative to the plane of its face.
const BOUNDARY_WEIGHT: f64 = 4.0;

/// What became of a try.
enum Outcome {
    /// Nothing has changed around the edge since the last one.
    Same,
    /// No position passed all tests, with what was around the edge and the least distance that may do.
    Failed(u64, f64),
    /// It costs more than it was queued for.
    Costs(f64),
    Accepted(Accepted),
}

pub(super) struct Collapses<'i> {
    pub(super) surface: Marked,
    quadrics: Vec<Quadric>,
    /// Counts the changes of each vertex.
    versions: Vec<u32>,
    /// What was around each halfedge, by [`Collapses::surroundings`], when it was last tried in vain, and the least distance that may do.
    failed: Vec<Option<(u64, f64)>>,
    /// The batch in which each face was changed last.
    changed: Vec<u32>,
    batch: u32,
    queue: Queue,
    places: Places,
    limit: f64,
    /// Which faces of the input each face covers, and the input; none where no distance was asked for.
    cover: Option<(Cover, Input<'i>)>,
    /// Where faces are, if those must not intersect that do not now.
    crossings: Option<Crossings>,
    /// The faces that this batch changed.
    moved: Vec<u32>,
    least_faces: usize,
    most_passes: usize,
    pub(super) count: usize,
    /// One for each thread.
    scratch: Vec<Mutex<Scratch>>,
}

/// What planes count for in quadrics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PlaneWeight {
    /// The area of their face.
    Area,
    /// One, as much as any other.
    One,
}

/// A surface on its way, to go on from.
#[derive(Clone)]
pub(super) struct Snapshot {
    pub(super) surface: Marked,
    quadrics: Vec<Quadric>,
    count: usize,
}

impl<'i> Collapses<'i> {
    /// Collapses edges of a surface in order of their quadric error alone.
    pub(super) fn by_error(surface: Marked, places: Places) -> Self {
        let quadrics = vertex_quadrics(&surface, PlaneWeight::One);
        Self::on(Snapshot { surface, quadrics, count: 0 }, None, places)
    }

    /// Collapses edges of the input while it stays within a distance of itself.
    pub(super) fn within(surface: Marked, bvh: &'i Bvh, places: Places) -> Self {
        let cover = Cover::new(&surface.mesh, bvh);
        let quadrics = vertex_quadrics(&surface, PlaneWeight::Area);
        Self::on(Snapshot { surface, quadrics, count: 0 }, Some((cover, bvh)), places)
    }

    /// Goes on from a surface, which covers the input where a distance is asked for.
    pub(super) fn on(from: Snapshot, cover: Option<(Cover, &'i Bvh)>, places: Places) -> Self {
        let Snapshot { surface, quadrics, count } = from;
        let mesh = &surface.mesh;
        Self {
            quadrics,
            versions: vec![0; mesh.positions.len()],
            failed: vec![None; mesh.origin.len()],
            changed: vec![0; mesh.origin.len() / 3],
            batch: 0,
            queue: Queue::new(),
            places,
            limit: f64::INFINITY,
            cover: cover.map(|(cover, bvh)| (cover, Input { bvh, limit_sq: f64::INFINITY })),
            crossings: None,
            moved: Vec::new(),
            least_faces: 1,
            most_passes: MOST_PASSES,
            count,
            scratch: (0..=rayon::current_num_threads()).map(|_| Mutex::default()).collect(),
            surface,
        }
    }

    /// The same, without collapses after which faces intersect that did not.
    pub(super) fn keeping_apart(mut self) -> Self {
        self.crossings = Some(Crossings::new(&self.surface.mesh));
        self
    }

    /// Whether faces that do not intersect are kept apart.
    pub(super) fn keeps_apart(&self) -> bool {
        self.crossings.is_some()
    }

    /// The surface as it is.
    pub(super) fn snapshot(&self) -> Snapshot {
        Snapshot { surface: self.surface.clone(), quadrics: self.quadrics.clone(), count: self.count }
    }

    /// From now on the surface stays within this distance, which is not less than before.
    pub(super) fn come_within(&mut self, limit: f64) {
        self.set_limit(limit);
        self.failed.fill(None);
    }

    /// As [`Collapses::come_within`], for one of many distances that hardly grow: edges are gone through once, and those that were seen to
    /// need a greater distance are passed over.
    pub(super) fn grow_to(&mut self, limit: f64) {
        self.set_limit(limit);
        self.most_passes = 1;
    }

    fn set_limit(&mut self, limit: f64) {
        self.limit = limit;
        if let Some((_, input)) = &mut self.cover {
            input.limit_sq = limit * limit;
        }
    }

    /// From now on there may be as few faces as this.
    pub(super) fn leave_faces(&mut self, count: usize) {
        self.least_faces = count;
    }

    /// Collapses edges until none can be, or the computation is told to stop: the surface stays within the distance all the time.
    pub(super) fn run(&mut self, control: &Control, progress: Option<&dyn ProgressObserver>) {
        if self.cover.is_none() && self.crossings.is_none() {
            self.run_by_error(control, progress);
            return;
        }
        let all = self.surface.mesh.face_count() as f64;
        for _ in 0..self.most_passes {
            let before = self.count;
            let edges: Vec<u32> = self.surface.mesh.edges().collect();
            self.push(&edges);
            loop {
                let tried = self.next_batch();
                if tried.is_empty() {
                    break;
                }
                if self.surface.mesh.face_count() <= self.least_faces || control.is_stopped() {
                    self.queue.clear();
                    return;
                }
                self.report(all, control, progress);
                self.collapse_each(&tried);
            }
            if self.count == before {
                return;
            }
        }
    }

    /// The next edges.
    fn next_batch(&mut self) -> Vec<Entry> {
        let most = (self.surface.mesh.face_count() / FACES_PER_TRIED).clamp(1, MOST_TRIED);
        let mut tried = Vec::with_capacity(most);
        while tried.len() < most
            && let Some(entry) = self.queue.pop()
        {
            let is_new = tried.iter().all(|other: &Entry| other.halfedge != entry.halfedge);
            let exists = self.surface.mesh.names_edge(entry.halfedge);
            if is_new && exists && self.versions_of(entry.halfedge) == entry.versions {
                tried.push(entry);
            }
        }
        tried
    }

    /// Tries edges, all on the surface as it is, and collapses those that can be, one after the other. What another collapse came in
    /// the way of is put into the queue again.
    fn collapse_each(&mut self, tried: &[Entry]) {
        let outcomes: Vec<Outcome> = tried.par_iter().map(|entry| self.outcome(entry)).collect();
        self.batch += 1;
        self.moved.clear();
        let mut again = Vec::new();
        for (&entry, outcome) in tried.iter().zip(outcomes) {
            let h = entry.halfedge;
            match outcome {
                Outcome::Same => {}
                Outcome::Failed(around, least) => self.failed[h as usize] = Some((around, least)),
                Outcome::Costs(error) => self.queue.push(Entry { error, ..entry }),
                Outcome::Accepted(_) if self.surface.mesh.face_count() <= self.least_faces => break,
                Outcome::Accepted(accepted) if self.stands(&accepted) => self.collapse(&accepted, &mut again),
                Outcome::Accepted(_) => again.push(h),
            }
        }
        self.push(&again);
    }

    fn outcome(&self, entry: &Entry) -> Outcome {
        let h = entry.halfedge;
        let around = self.surroundings(h);
        if self.failed[h as usize].is_some_and(|(then, least)| then == around && self.limit <= least) {
            return Outcome::Same;
        }
        match self.tried(h, entry.error) {
            Ok(accepted) => Outcome::Accepted(accepted),
            Err(Refused::Costs(error)) => Outcome::Costs(error),
            // The same limit fails again.
            Err(Refused::Below(least)) => {
                Outcome::Failed(around, if least > self.limit { least } else { self.limit })
            }
            // With a greater limit other positions are tried.
            Err(Refused::Intersections) => Outcome::Failed(around, self.limit),
            Err(_) => Outcome::Failed(around, f64::INFINITY),
        }
    }

    /// Tries an edge that may cost as much as this.
    fn tried(&self, h: u32, error: f64) -> Result<Accepted, Refused> {
        let trial = Trial {
            surface: &self.surface,
            quadrics: &self.quadrics,
            places: &self.places,
            limit: self.limit,
            cover: self.cover.as_ref().map(|(cover, input)| (cover, input)),
            crossings: self.crossings.as_ref(),
        };
        let thread = rayon::current_thread_index().map_or(0, |i| i + 1) % self.scratch.len();
        let mut scratch = self.scratch[thread].lock().unwrap_or_else(PoisonError::into_inner);
        trial.of(h, error, &mut scratch)
    }

    /// What keeps each edge from being collapsed.
    pub(super) fn refusals(&self) -> Refusals {
        let edges: Vec<u32> = self.surface.mesh.edges().collect();
        let refused = |h: &u32| self.tried(*h, f64::INFINITY).err();
        let all: Vec<Option<Refused>> = edges.par_iter().map(refused).collect();
        let mut found = Refusals { edges: edges.len(), ..Refusals::default() };
        for refused in all.into_iter().flatten() {
            match refused {
                Refused::Topology => found.topology += 1,
                Refused::Features => found.features += 1,
                Refused::Normals => found.normals += 1,
                Refused::Intersections => found.intersections += 1,
                Refused::Below(_) | Refused::Costs(_) => {}
            }
        }
        found
    }

    /// Whether what a collapse was tested against is as it was.
    fn stands(&self, accepted: &Accepted) -> bool {
        let relies_on = accepted.covering.iter().flat_map(Covering::relies_on);
        accepted.gone.iter().chain(relies_on).all(|f| self.changed[*f as usize] < self.batch)
            && self.surface.mesh.check_collapse(accepted.collapse.halfedge).is_ok()
            && self.is_apart_from_moved(accepted)
    }

    /// Whether a collapse makes no face intersect one that this batch changed.
    fn is_apart_from_moved(&self, accepted: &Accepted) -> bool {
        if self.crossings.is_none() || self.moved.is_empty() {
            return true;
        }
        let star = Star::new(&self.surface, accepted.collapse.halfedge);
        let mut faces = Vec::with_capacity(star.kept.len());
        star.moved(&self.surface, accepted.collapse.position, &mut faces);
        are_apart(&self.surface, &star, &faces, self.moved.iter().copied())
    }

    /// Collapses an edge, and adds those around to a list.
    fn collapse(&mut self, accepted: &Accepted, around: &mut Vec<u32>) {
        let h = accepted.collapse.halfedge;
        let u = self.surface.mesh.from(h) as usize;
        let Some(v) = self.surface.collapse(&accepted.collapse) else { return };
        if let (Some((cover, _)), Some(covering)) = (&mut self.cover, &accepted.covering) {
            cover.replace(&accepted.gone, covering);
        }
        for &f in &accepted.gone {
            self.changed[f as usize] = self.batch;
        }
        if let Some(crossings) = &mut self.crossings {
            let mesh = &self.surface.mesh;
            let kept = accepted.gone.iter().copied().filter(|&f| mesh.exists(3 * f));
            self.moved.extend(kept.clone());
            crossings.changed(&self.surface, kept);
        }
        self.surface.near[v as usize] = accepted.near;
        self.merge(u, v as usize);
        around.extend(self.surface.mesh.edges_at(v));
    }

    /// Counts a collapse of one vertex into another, and adds up their quadrics.
    fn merge(&mut self, u: usize, v: usize) {
        self.count += 1;
        self.quadrics[v] = self.quadrics[v].plus(&self.quadrics[u]);
        self.versions[v] += 1;
        self.versions[u] += 1;
    }

    /// Puts those of some edges that exist into the queue.
    fn push(&mut self, edges: &[u32]) {
        let Self { surface, quadrics, versions, queue, .. } = self;
        let mesh = &surface.mesh;
        let entry = |&h: &u32| {
            let h = mesh.name_of(h);
            let [u, v] = [mesh.from(h), mesh.to(h)].map(|x| x as usize);
            let quadric = quadrics[u].plus(&quadrics[v]);
            let [p, q] = [u, v].map(|x| mesh.positions[x]);
            let error = place_in_queue(&quadric, quadric.optimum(0.5 * (p + q)), [p, q]);
            Entry { halfedge: h, error, versions: [versions[u], versions[v]] }
        };
        let exist = edges.par_iter().with_min_len(PUSHED_TASK).filter(|h| mesh.exists(**h));
        let entries: Vec<Entry> = exist.map(entry).collect();
        for entry in entries {
            queue.push(entry);
        }
    }

    /// The share that is done follows the logarithm of the number of faces, for the last faces take the longest.
    fn report(&self, all: f64, control: &Control, progress: Option<&dyn ProgressObserver>) {
        let faces = self.surface.mesh.face_count() as f64;
        let share = (all / faces).ln() / (all / self.least_faces.max(4) as f64).ln();
        let share = Some(if share < 1.0 { share } else { 1.0 });
        let shown = Progress { doing: "collapsing edges", share };
        if progress.is_some_and(|observer| observer.progress(&shown).is_break()) {
            control.stop(StopReason::Cancelled);
        }
    }

    fn versions_of(&self, h: u32) -> [u32; 2] {
        [self.surface.mesh.from(h), self.surface.mesh.to(h)].map(|v| self.versions[v as usize])
    }

    /// A number that changes when a vertex beside an edge or a neighbour of one does: until then the edge need not be tried again.
    fn surroundings(&self, h: u32) -> u64 {
        let mesh = &self.surface.mesh;
        let around = [mesh.from(h), mesh.to(h)].into_iter().flat_map(|v| mesh.neighbours(v));
        around.fold(0, |sum: u64, v| {
            let one = (u64::from(v) << 32) | u64::from(self.versions[v as usize]);
            // An odd number close to 2^64 divided by the golden ratio spreads the bits.
            sum.rotate_left(5).wrapping_add(one.wrapping_mul(0x9e37_79b9_7f4a_7c15))
        })
    }
}

/// For each vertex the planes of its faces, and at boundary edges planes that stand upright on them.
fn vertex_quadrics(surface: &Marked, weight: PlaneWeight) -> Vec<Quadric> {
    let mesh = &surface.mesh;
    let mut quadrics = vec![Quadric::default(); mesh.positions.len()];
    for h in 0..mesh.halfedge_slots() {
        let normal = area_vector(surface.triangle(h / 3));
        let area = 0.5 * normal.length();
        let Some(normal) = normal.try_normalize() else { continue };
        let (u, v) = (mesh.from(h), mesh.to(h));
        let p = mesh.positions[u as usize];
        let weight = if weight == PlaneWeight::Area { area } else { 1.0 };
        let face = Quadric::of_plane(normal, p, weight / 3.0);
        quadrics[u as usize] = quadrics[u as usize].plus(&face);
        if mesh.twin[h as usize] == NONE
            && let Some(upright) = normal.cross(mesh.positions[v as usize] - p).try_normalize()
        {
            let edge = Quadric::of_plane(upright, p, BOUNDARY_WEIGHT * weight);
            for end in [u, v] {
                quadrics[end as usize] = quadrics[end as usize].plus(&edge);
            }
        }
    }
    quadrics
}
