//! Between which ends the distances of faces lie, from a few points: what there is still time for where limits do not leave any for the distances of
//! all vertices.
//!
//! # What is proven
//! The distance from B changes by no more than the way, so on faces that reach no farther than `r` from a point it differs from the distance of that
//! point by no more than `r`. Also, the distance from one face of B is convex: no point of a face is farther from it than one of its corners.

use super::area;
use super::entry::{Entry, LESS, MORE, Moments};
use super::linear::{greater, lesser};
use super::packed::Entries;
use super::portion::Portion;
use crate::rounding::Rounding;
use pompeiu_core::geom::Frame;
use pompeiu_core::spatial::{Bvh, Slot, Workspace};
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;
use std::time::Duration;

/// Faces about one point: with fewer, points take as long as the vertices.
const FACES: usize = 16;
/// The faces about one point reach no farther from it than this many times the longest edge of one of them; else they are two clusters.
const COMPACT: f64 = 2.5;
/// Points of a task.
const TASK: usize = 64;

/// What is known of the faces of a mesh.
pub(super) struct Clusters {
    /// An entry for the faces about each point.
    pub(super) portions: Vec<Portion>,
    /// Between which ends the distances of each face lie, in the frame.
    pub(super) faces: Vec<(f64, f64)>,
    /// No distance is greater.
    pub(super) largest: f64,
}

impl Clusters {
    /// How long they take for each face, about: on two threads, with some to spare.
    pub(super) const TIME_OF_FACE: Duration = Duration::from_nanos(150);

    /// Of a mesh whose faces are given in an order in which neighbours are close. No distance is greater than `largest`.
    pub(super) fn new(
        mesh: &TriMesh,
        frame: &Frame,
        (bvh, rounding): (&Bvh, Rounding),
        order: &[u32],
        largest: f64,
    ) -> Self {
        let of_task = |order: &[u32]| {
            let looking = Looking {
                mesh,
                frame,
                bvh,
                margin: 2.0 * rounding.bound(0),
                largest,
                near: bvh.any_slot(),
                workspace: Workspace::default(),
                found: Vec::with_capacity(order.len()),
            };
            looking.task(order)
        };
        let tasks: Vec<Task> = order.par_chunks(FACES * TASK).map(of_task).collect();
        let mut faces = vec![(0.0, largest); mesh.faces().len()];
        for (order, task) in order.chunks(FACES * TASK).zip(&tasks) {
            for (face, ends) in order.iter().zip(&task.faces) {
                faces[*face as usize] = *ends;
            }
        }
        let farthest = faces.iter().fold(0.0, |farthest, (_, high)| greater(farthest, *high));
        Self { portions: tasks.into_iter().map(|task| task.portion).collect(), faces, largest: farthest }
    }
}

/// What is known of the faces of a task, in their order.
struct Task {
    portion: Portion,
    faces: Vec<(f64, f64)>,
}

/// Looks at the faces of a task, one cluster after the other.
struct Looking<'l> {
    mesh: &'l TriMesh,
    frame: &'l Frame,
    bvh: &'l Bvh,
    /// What distances and mapped corners may be off by.
    margin: f64,
    largest: f64,
    /// A face of B near the last cluster.
    near: Slot,
    workspace: Workspace,
    /// Between which ends the distances of the faces lie.
    found: Vec<(f64, f64)>,
}

impl Looking<'_> {
    fn task(mut self, order: &[u32]) -> Task {
        let (mut entries, mut starts) = (Vec::new(), vec![0]);
        for cluster in order.chunks(FACES) {
            let corners = |face: &u32| self.mesh.corners(FaceId(*face)).map(|p| self.frame.map(p));
            let corners: Vec<[[f64; 3]; 3]> = cluster.iter().map(corners).collect();
            let known = self.found.len();
            self.look(&corners);
            let (mut ends, mut size) = ((self.largest, 0.0), (0.0, 0.0));
            for (face, (low, high)) in cluster.iter().zip(&self.found[known..]) {
                ends = (lesser(ends.0, *low), greater(ends.1, *high));
                let area = area::of_face(self.mesh, self.frame, *face);
                size = (size.0 + area.0, size.1 + area.1);
            }
            entries.push(Entry::constant((size.0 / MORE_OF_SUM, size.1 * MORE_OF_SUM), ends));
            starts.push(entries.len() as u32);
        }
        let moments = Moments::of(entries.iter().copied());
        Task { portion: Portion { entries: Entries::Full(entries), starts, moments }, faces: self.found }
    }

    /// Adds between which ends the distances of faces with these corners lie.
    fn look(&mut self, faces: &[[[f64; 3]; 3]]) {
        let points = faces.as_flattened();
        let centre = [0, 1, 2].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64);
        let reach_of =
            |face: &[[f64; 3]; 3]| face.iter().fold(0.0, |reach, p| greater(reach, way(*p, centre)));
        let reach = faces.iter().map(reach_of).fold(0.0, greater);
        let longest = faces.iter().map(|[a, b, c]| greater(way(*a, *b), way(*a, *c))).fold(0.0, greater);
        // Where an order leads from one end of the mesh to another.
        if reach > COMPACT * longest && faces.len() > 1 {
            let (first, second) = faces.split_at(faces.len() / 2);
            self.look(first);
            self.look(second);
            return;
        }
        let nearest = self.bvh.nearest(centre, self.near, &mut self.workspace);
        self.near = nearest.slot;
        let distance = nearest.distance_sq.sqrt();
        for face in faces {
            let of_corner = |p: &[f64; 3]| self.bvh.distance_sq(*p, self.near).sqrt() + self.margin;
            let above = face.iter().map(of_corner).fold(0.0, greater);
            let reach = reach_of(face) + 2.0 * self.margin;
            let high = lesser(lesser(above, (distance + reach) * MORE), self.largest);
            let low = lesser(greater((distance - reach) * LESS, 0.0), high);
            self.found.push((low, high));
        }
    }
}

/// No less than how far apart two points are.
fn way(p: [f64; 3], q: [f64; 3]) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|k| p[k] - q[k]);
    (x * x + y * y + z * z).sqrt() * MORE
}

/// Outweighs the rounding of a sum of [`FACES`] numbers that are not negative.
const MORE_OF_SUM: f64 = 1.0 + 2.0 * FACES as f64 * f64::EPSILON;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Ordered;
    use pompeiu_core::geom::Aabb;
    use pompeiu_core::mesh::shapes::icosphere;
    use pompeiu_core::mesh::{Affine, displace_at_random, merge, transform};
    use pompeiu_testkit::plain::point_triangles;

    /// A ball in two parts, in whose order there are steps from one to the other, beside a rough one: at points of all faces the distance lies
    /// between the ends, and no farther than the largest.
    #[test]
    fn distances_lie_between_the_ends() {
        let ball = icosphere(1.0, 3).unwrap();
        let beside = transform(&ball, &Affine::translate([2.5, 0.3, 0.0])).unwrap();
        let (a, b) = (merge(&[&ball, &beside]).unwrap(), displace_at_random(&ball, 0.05, 3).unwrap());
        let joint = Aabb::of_faces(&a).union(Aabb::of_faces(&b));
        let frame = Frame::of(&joint);
        let bvh = Bvh::build(&b, &frame);
        let rounding = Rounding::in_frame(&frame, &joint);
        let order = Ordered::new(&a).order;
        let clusters = Clusters::new(&a, &frame, (&bvh, rounding), &order, 10.0);
        let triangles: Vec<[[f64; 3]; 3]> = bvh.slots().map(|slot| bvh.corners(slot)).collect();
        let (mut width, mut distances) = (0.0, 0.0);
        for (face, (low, high)) in clusters.faces.iter().enumerate() {
            let corners = a.corners(FaceId(face as u32)).map(|p| frame.map(p));
            for weights in [[1.0, 0.0, 0.0], [0.0, 0.5, 0.5], [0.25, 0.5, 0.25]] {
                let x = [0, 1, 2].map(|k| (0..3).map(|i| weights[i] * corners[i][k]).sum());
                let distance = point_triangles(x, &triangles);
                assert!((*low..=*high).contains(&distance), "{face}: {distance} {low} {high}");
                assert!(distance <= clusters.largest);
                (width, distances) = (width + high - low, distances + distance);
            }
        }
        assert!(
            width < 0.5 * distances && clusters.largest < 4.0,
            "{width} {distances} {}",
            clusters.largest
        );
        let entries: usize = clusters.portions.iter().map(|portion| portion.entries.len()).sum();
        assert_eq!(entries, a.faces().len().div_ceil(FACES));
    }
}
