//! Necks that have become too narrow for the mesh.

use super::moving::MovingSurface;
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// A neck: a loop around the surface that bounds no disc near it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Neck {
    /// A vertex on it.
    pub position: [f64; 3],
    /// Its length, within two edges.
    pub length: f64,
}

/// Necks shorter than this many mean edges count as pinched: a circle of one edge's radius.
const SHORTEST: f64 = 2.0 * PI;
/// Halvings when the length of a neck is measured.
const HALVINGS: usize = 6;

/// A ball in which necks are looked for holds some 80 vertices where edges are about equally long. Where one holds more than this many, the
/// mean edge says nothing of how near to each other vertices are, as on turned parts with long thin faces.
const MOST_IN_BALL: usize = 2048;

/// What is found in balls around vertices.
enum Found {
    /// A neck that is shorter than those before.
    Neck(Neck),
    /// A ball with more than [`MOST_IN_BALL`] vertices.
    Crowd,
}

/// The shortest neck found that is shorter than [`SHORTEST`] edges.
pub(crate) fn neck(surface: &MovingSurface, mean_edge: f64) -> Option<Neck> {
    let mut shortest = None;
    look_for_necks(surface, mean_edge, |found| {
        if let Found::Neck(neck) = found {
            shortest = Some(neck);
        }
        ControlFlow::Continue(())
    });
    shortest
}

/// Whether a neck that forms would show: there is none shorter than [`SHORTEST`] edges yet, and edges are alike enough to measure it by.
pub(crate) fn would_show(surface: &MovingSurface, mean_edge: f64) -> bool {
    let mut is_clear = true;
    look_for_necks(surface, mean_edge, |_| {
        is_clear = false;
        ControlFlow::Break(())
    });
    is_clear
}

/// Looks for necks shorter than [`SHORTEST`] edges until told to stop.
///
/// A neck shows in a ball around one of its vertices, by edge lengths, that is no disc although it would be with the holes of the mesh
/// filled. Balls around some vertices of the surface are tried first, so that every vertex is near one of them.
fn look_for_necks(surface: &MovingSurface, mean_edge: f64, mut give: impl FnMut(Found) -> ControlFlow<()>) {
    let half = 0.5 * SHORTEST * mean_edge;
    let mut balls = Balls::new(surface);
    let mut covered = vec![false; surface.positions().len()];
    let mut tried = covered.clone();
    let mut least = half;
    for seed in 0..covered.len() as u32 {
        if covered[seed as usize] || !surface.mesh.has_faces(seed) {
            continue;
        }
        balls.grow(seed, 1.5 * half);
        if balls.vertices.len() > MOST_IN_BALL && give(Found::Crowd).is_break() {
            return;
        }
        for &v in &balls.vertices {
            covered[v as usize] |= balls.found[v as usize].1 <= 0.5 * half;
        }
        if balls.is_disc() {
            continue;
        }
        let mut around = balls.vertices.clone();
        around.sort_unstable();
        around.retain(|&v| !std::mem::replace(&mut tried[v as usize], true));
        for v in around {
            let Some(radius) = balls.radius_of_neck(v, least) else { continue };
            let position = surface.positions()[v as usize].to_array();
            least = radius;
            if give(Found::Neck(Neck { position, length: 2.0 * radius })).is_break() {
                return;
            }
        }
    }
}

struct Balls<'s> {
    surface: &'s MovingSurface,
    /// The number of the ball that each vertex was last found in, and its distance from the centre there.
    found: Vec<(u32, f64)>,
    ball: u32,
    /// The vertices of the last ball.
    vertices: Vec<u32>,
    heap: BinaryHeap<Near>,
}

impl<'s> Balls<'s> {
    fn new(surface: &'s MovingSurface) -> Self {
        let found = vec![(0, 0.0); surface.positions().len()];
        Self { surface, found, ball: 0, vertices: Vec::new(), heap: BinaryHeap::new() }
    }

    fn holds(&self, v: u32) -> bool {
        self.found[v as usize].0 == self.ball
    }

    /// Makes the ball around a vertex, with the vertices that it surrounds.
    fn grow(&mut self, centre: u32, radius: f64) {
        let mesh = &self.surface.mesh;
        self.vertices.clear();
        self.heap.clear();
        self.ball += 1;
        self.heap.push(Near { distance: 0.0, vertex: centre });
        while let Some(Near { distance, vertex }) = self.heap.pop() {
            if self.found[vertex as usize].0 == self.ball {
                continue;
            }
            self.found[vertex as usize] = (self.ball, distance);
            self.vertices.push(vertex);
            let from: DVec3 = mesh.positions()[vertex as usize];
            for w in mesh.neighbours(vertex) {
                let there = distance + from.distance(mesh.positions()[w as usize]);
                if there <= radius && self.found[w as usize].0 != self.ball {
                    self.heap.push(Near { distance: there, vertex: w });
                }
            }
        }
        let beside = self.vertices.iter().flat_map(|&v| mesh.neighbours(v));
        let surrounded: Vec<u32> = beside
            .filter(|&w| !self.holds(w) && !mesh.is_boundary(w))
            .filter(|&w| mesh.neighbours(w).all(|x| self.holds(x)))
            .collect();
        for w in surrounded {
            if !self.holds(w) {
                self.found[w as usize] = (self.ball, radius);
                self.vertices.push(w);
            }
        }
    }

    /// Whether the faces of the ball form a disc or a sphere once the holes of the mesh in it are filled.
    fn is_disc(&self) -> bool {
        let mesh = &self.surface.mesh;
        let whole = |h: u32| mesh.corners(h / 3).iter().all(|&v| self.holds(v));
        let (mut vertices, mut halfedges, mut open, mut holes) = (0, 0, 0, 0);
        for &v in &self.vertices {
            let around = || mesh.halfedges_from(v).filter(|&h| whole(h));
            let faces = around().count();
            vertices += usize::from(faces > 0);
            halfedges += faces;
            // Edges on the rim of the ball, or of the mesh.
            open += around().filter(|&h| mesh.twin_of(h).is_none_or(|t| !whole(t))).count();
            if mesh.is_boundary(v) && self.starts_hole(v) {
                holes += 1;
            }
        }
        let edges = (halfedges - open) / 2 + open;
        vertices == 0 || vertices + halfedges / 3 + holes > edges
    }

    /// Whether the boundary loop at a vertex lies in the ball, and the vertex is the first of it by number.
    fn starts_hole(&self, v: u32) -> bool {
        let mut at = self.surface.mesh.next_on_boundary(v);
        while at > v && self.holds(at) {
            at = self.surface.mesh.next_on_boundary(at);
        }
        at == v
    }

    /// The radius at which the ball around a vertex ceases to be a disc, if that is below a bound.
    fn radius_of_neck(&mut self, v: u32, below: f64) -> Option<f64> {
        self.grow(v, below);
        if self.is_disc() {
            return None;
        }
        let (mut low, mut high) = (0.0, below);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            self.grow(v, middle);
            if self.is_disc() {
                low = middle;
            } else {
                high = middle;
            }
        }
        (high < below).then_some(high)
    }
}

/// A vertex to visit, the nearest first.
#[derive(PartialEq)]
struct Near {
    distance: f64,
    vertex: u32,
}

impl Eq for Near {}

impl Ord for Near {
    fn cmp(&self, other: &Self) -> Ordering {
        other.distance.total_cmp(&self.distance).then(other.vertex.cmp(&self.vertex))
    }
}

impl PartialOrd for Near {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
