//! Cuts along medial balls.

use super::costs::Costs;
use super::disk::prune;
use super::edges::joined_edges;
use super::farthest::distance;
use super::{CutError, GrowingCut, farthest_pair};
use pompeiu_core::VertexId;
use pompeiu_medial::{Ball, Medial, MedialOptions, medial_balls};
use pompeiu_surface::{EdgeData, EdgeDistances, EmbeddedSurface};
use std::num::NonZeroUsize;

/// A ball touches a vertex if the distance between them is at most this, relative to its radius.
const TOUCHING: f64 = 0.1;

/// Additional cost of an edge off a section, per squared distance from it relative to the radius.
const OFF_SECTION: f64 = 100.0;

/// The tolerance of the deviation, which is not used here.
const ANY: f64 = 1.0;

/// A surface with its medial balls.
pub(super) struct Skeleton<'s> {
    surface: &'s EmbeddedSurface,
    costs: &'s Costs,
    medial: Medial,
}

impl<'s> Skeleton<'s> {
    pub(super) fn new(
        surface: &'s EmbeddedSurface,
        costs: &'s Costs,
        balls: NonZeroUsize,
    ) -> Result<Self, CutError> {
        let medial =
            medial_balls(surface, &MedialOptions { balls, tolerance: ANY, ..MedialOptions::default() })?;
        Ok(Self { surface, costs, medial })
    }

    /// Two vertices farthest apart, each touched by one of the two balls at the ends of the longest path between balls.
    pub(super) fn ends(&self) -> Vec<VertexId> {
        let ends = self.medial.longest_path();
        let [first, second] = ends.map(|i| self.touched(&self.medial.balls[i]));
        let place = |v: VertexId| self.surface.positions()[v];
        if ends[0] == ends[1] {
            let points: Vec<[f64; 3]> = first.iter().map(|&v| place(v)).collect();
            return farthest_pair(&points).map_or(first.clone(), |pair| pair.map(|i| first[i]).to_vec());
        }
        let mut best = (-1.0, Vec::new());
        for &v in &first {
            for &w in &second {
                let apart = distance(place(v), place(w));
                if apart > best.0 && v != w {
                    best = (apart, vec![v, w]);
                }
            }
        }
        best.1
    }

    /// The vertices that a ball touches: the nearest one, and others at nearly the same distance.
    fn touched(&self, ball: &Ball) -> Vec<VertexId> {
        let off = |v: VertexId| (distance(self.surface.positions()[v], ball.centre) - ball.radius).abs();
        let near = |v: &VertexId| !self.costs.forbid(*v) && off(*v) <= TOUCHING * ball.radius;
        let mut touched: Vec<VertexId> = self.surface.mesh().vertex_ids().filter(near).collect();
        if touched.is_empty() {
            touched.extend(self.nearest(ball.centre));
        }
        touched
    }

    /// The vertex nearest to a point, among those where cuts are allowed.
    fn nearest(&self, place: [f64; 3]) -> Option<VertexId> {
        let away = |v: VertexId| distance(self.surface.positions()[v], place);
        let allowed = self.surface.mesh().vertex_ids().filter(|&v| !self.costs.forbid(v));
        allowed.map(|v| (away(v), v)).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, v)| v)
    }

    /// The vertices nearest to the centres of all balls.
    pub(super) fn joints(&self) -> Vec<Option<VertexId>> {
        self.medial.balls.iter().map(|ball| self.nearest(ball.centre)).collect()
    }

    /// A cut with a path along each bone, that is each edge of the minimum spanning tree of the balls. Edges that would close a
    /// loop are omitted, and dangling ends away from joints are removed.
    pub(super) fn bones(&self, base: &EdgeData<bool>) -> EdgeData<bool> {
        let (surface, mesh) = (self.surface.surface(), self.surface.mesh());
        let joints = self.joints();
        let mut edges = Vec::new();
        for bone in self.medial.spanning_tree() {
            let [Some(from), Some(to)] = bone.map(|i| joints[i as usize]) else { continue };
            let paths = EdgeDistances::along(surface, &[from], |edge| self.costs.of(edge));
            edges.extend(paths.path_to(surface, to));
        }
        let mut cut = joined_edges(mesh, base, &edges);
        let is_joint = |v: VertexId| joints.contains(&Some(v));
        prune(surface, &mut cut, is_joint);
        if base.contains(&true) || !mesh.boundary_loops().is_empty() {
            // Connects the cut that leaves a disk with the tree of bones.
            let tree: Vec<VertexId> = joints.iter().flatten().copied().collect();
            let rest = GrowingCut::new(surface, self.costs, base.clone()).reached();
            let from = EdgeDistances::along(surface, &rest, |edge| self.costs.of(edge));
            let near = tree.into_iter().min_by(|a, b| from.distances[*a].total_cmp(&from.distances[*b]));
            if let Some(near) = near {
                let bridge = from.path_to(surface, near);
                cut = joined_edges(mesh, &cut, &bridge);
                prune(surface, &mut cut, is_joint);
            }
        }
        cut
    }

    /// Adds arcs around the surface at the start of bones: in the plane through the ball's centre perpendicular to the bone, to the
    /// far side and half of the way back.
    pub(super) fn with_sections(&self, cut: EdgeData<bool>) -> EdgeData<bool> {
        let (surface, mesh) = (self.surface.surface(), self.surface.mesh());
        let balls = &self.medial.balls;
        let joints = self.joints();
        let mut cut = cut;
        for [i, j] in self.medial.spanning_tree().into_iter().map(|bone| bone.map(|i| i as usize)) {
            let Some(joint) = joints[i] else { continue };
            let (centre, radius) = (glam::DVec3::from_array(balls[i].centre), balls[i].radius);
            let Some(along) = (glam::DVec3::from_array(balls[j].centre) - centre).try_normalize() else {
                continue;
            };
            let place = |v: VertexId| glam::DVec3::from_array(self.surface.positions()[v]);
            let out = place(joint) - centre;
            let out = out - out.dot(along) * along;
            let height = |v: VertexId| (place(v) - centre).dot(along) / radius;
            let costs = self.costs.changed(|edge, cost| {
                let [a, b] = mesh.ends(edge).map(height);
                cost * (1.0 + OFF_SECTION * 0.5 * (a * a + b * b))
            });
            let mut growing = GrowingCut::new(surface, &costs, cut);
            let aside = along.cross(out);
            for direction in [-out, aside, -aside] {
                // The path to the far side runs along one side; no path closes a loop.
                if let Some(end) = self.nearest((centre + direction).to_array()) {
                    growing.join(&[end]);
                }
            }
            cut = growing.edges;
        }
        cut
    }
}
