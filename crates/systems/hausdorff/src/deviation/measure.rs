//! Areas of meshes and distances of vertices: what is known of a mesh before its faces are cut.

use pompeiu_core::TriMesh;
use pompeiu_core::geom::Frame;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::{Bvh, Slot, Workspace};
use rayon::prelude::*;

/// The area of all faces, and the sum of areas times mean distances of corners; rounded.
pub(super) fn area_and_moment(mesh: &TriMesh, frame: &Frame, vertices: &VertexDistances) -> (f64, f64) {
    const CHUNK: usize = 1 << 12;
    let of_face = |(sum, moment): (f64, f64), corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|v| glam::DVec3::from_array(frame.map(mesh.positions()[v as usize])));
        let area = 0.5 * (b - a).cross(c - a).length();
        let distances = corners.map(|v| vertices.distances[v as usize]);
        (sum + area, moment + area * (distances[0] + distances[1] + distances[2]) * (1.0 / 3.0))
    };
    let chunks: Vec<(f64, f64)> =
        mesh.faces().par_chunks(CHUNK).map(|faces| faces.iter().fold((0.0, 0.0), of_face)).collect();
    chunks.into_iter().fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1))
}

/// Faces at whose centroids the distance is measured for a mean, at most.
const SAMPLES: usize = 1024;
/// What the centroid of a triangle counts in the rule for means that is exact for quadratic functions; the corners count the rest.
const OF_CENTROID: f64 = 0.75;

/// About the mean distance over the area, or over the faces if they have none: from the corners of all faces and the centroids of some.
/// Corners alone do not do where all of them lie on the other mesh. `moment` is that of [`area_and_moment`].
pub(super) fn mean_distance(
    mesh: &TriMesh,
    frame: &Frame,
    vertices: &VertexDistances,
    bvh: &Bvh,
    order: &[u32],
    (total, moment): (f64, f64),
) -> f64 {
    let mut workspace = Workspace::default();
    let (mut area, mut of_centroids, mut of_faces, mut count) = (0.0, 0.0, 0.0, 0.0);
    for face in sampled(order) {
        let corners = mesh.faces()[*face as usize];
        let (centroid, weight, _) = face_in(mesh, frame, corners);
        let near = vertices.near[corners[0] as usize];
        let distance = bvh.nearest(centroid, near, &mut workspace).distance_sq.sqrt();
        area += weight;
        of_centroids += weight * distance;
        let at_corners = corners.iter().map(|v| vertices.distances[*v as usize]).sum::<f64>() * (1.0 / 3.0);
        of_faces += OF_CENTROID * distance + (1.0 - OF_CENTROID) * at_corners;
        count += 1.0;
    }
    if area > 0.0 && total > 0.0 {
        OF_CENTROID * of_centroids / area + (1.0 - OF_CENTROID) * moment / total
    } else {
        of_faces / count
    }
}

/// About the mean distance over the area, from the centroids and corners of some faces alone: what can be said before the distances of all vertices
/// are known. None where these faces have no area.
pub(super) fn sampled_mean(mesh: &TriMesh, frame: &Frame, bvh: &Bvh, order: &[u32]) -> Option<f64> {
    const TASK: usize = 64;
    let faces: Vec<u32> = sampled(order).copied().collect();
    let of_task = |faces: &[u32]| -> (f64, f64) {
        let mut workspace = Workspace::default();
        let mut near = bvh.any_slot();
        let mut distance = |p: [f64; 3]| {
            let nearest = bvh.nearest(p, near, &mut workspace);
            near = nearest.slot;
            nearest.distance_sq.sqrt()
        };
        let of_face = |(area, moment): (f64, f64), face: &u32| {
            let (centroid, weight, corners) = face_in(mesh, frame, mesh.faces()[*face as usize]);
            let at_corners = corners.map(&mut distance).iter().sum::<f64>() * (1.0 / 3.0);
            let mean = OF_CENTROID * distance(centroid) + (1.0 - OF_CENTROID) * at_corners;
            (area + weight, moment + weight * mean)
        };
        faces.iter().fold((0.0, 0.0), of_face)
    };
    let tasks: Vec<(f64, f64)> = faces.par_chunks(TASK).map(of_task).collect();
    let (area, moment) = tasks.into_iter().fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
    (area > 0.0).then(|| moment / area)
}

/// Some faces of an order in which neighbours are close, evenly spread over it.
fn sampled(order: &[u32]) -> impl Iterator<Item = &u32> {
    order.iter().step_by(order.len().div_ceil(SAMPLES).max(1))
}

/// The centroid, the area and the corners of a face in a frame, rounded.
pub(super) fn face_in(mesh: &TriMesh, frame: &Frame, corners: [u32; 3]) -> ([f64; 3], f64, [[f64; 3]; 3]) {
    let corners = corners.map(|v| frame.map(mesh.positions()[v as usize]));
    let [a, b, c] = corners.map(glam::DVec3::from_array);
    (((a + b + c) * (1.0 / 3.0)).to_array(), 0.5 * (b - a).cross(c - a).length(), corners)
}

/// Distances of vertices in a frame, each with a nearest face of the other mesh.
#[derive(Debug)]
pub(crate) struct VertexDistances {
    /// NaN for vertices that belong to no face.
    pub(super) distances: Vec<f64>,
    pub(super) near: Vec<Slot>,
}

impl VertexDistances {
    /// The distances of all vertices of faces; none if it was told to stop before all were known.
    pub(crate) fn limited(
        mesh: &TriMesh,
        frame: &Frame,
        bvh: &Bvh,
        order: &[u32],
        control: &Control,
    ) -> Option<Self> {
        let (referenced, found) = Self::found(mesh, frame, bvh, order, control);
        (!control.is_stopped()).then(|| Self::by_vertex(mesh, bvh, &referenced, found))
    }

    /// The vertices of faces, and for each task of them what was found.
    fn found(
        mesh: &TriMesh,
        frame: &Frame,
        bvh: &Bvh,
        order: &[u32],
        control: &Control,
    ) -> (Vec<u32>, Vec<Vec<(f64, Slot)>>) {
        const TASK: usize = 256;
        // Each vertex with the first of its faces in the order, in which neighbours are close.
        let mut seen = vec![false; mesh.positions().len()];
        let mut referenced = Vec::new();
        for &f in order {
            for v in mesh.faces()[f as usize] {
                if !std::mem::replace(&mut seen[v as usize], true) {
                    referenced.push(v);
                }
            }
        }
        let of_task = |vertices: &[u32]| -> Vec<(f64, Slot)> {
            if control.is_stopped() {
                return Vec::new();
            }
            let mut workspace = Workspace::default();
            let mut hint = bvh.any_slot();
            let of_vertex = |v: &u32| {
                let nearest = bvh.nearest(frame.map(mesh.positions()[*v as usize]), hint, &mut workspace);
                hint = nearest.slot;
                (nearest.distance_sq.sqrt(), nearest.slot)
            };
            vertices.iter().map(of_vertex).collect()
        };
        let found = referenced.par_chunks(TASK).map(of_task).collect();
        (referenced, found)
    }

    fn by_vertex(mesh: &TriMesh, bvh: &Bvh, referenced: &[u32], found: Vec<Vec<(f64, Slot)>>) -> Self {
        let mut distances = vec![f64::NAN; mesh.positions().len()];
        let mut near = vec![bvh.any_slot(); mesh.positions().len()];
        for (v, (distance, slot)) in referenced.iter().zip(found.into_iter().flatten()) {
            (distances[*v as usize], near[*v as usize]) = (distance, slot);
        }
        Self { distances, near }
    }

    /// The distances of the corners of a face, each with a nearest face of the other mesh.
    pub(super) fn of_corners(&self, corners: [u32; 3]) -> [(f64, Slot); 3] {
        corners.map(|v| (self.distances[v as usize], self.near[v as usize]))
    }

    /// Bytes that they take.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.distances[..]) + size_of_val(&self.near[..])
    }

    /// The distance that this part of the vertices does not exceed; zero if no vertex belongs to a face.
    pub(super) fn quantile(&self, part: f64) -> f64 {
        let mut known: Vec<f64> =
            self.distances.iter().copied().filter(|distance| !distance.is_nan()).collect();
        let place = (part * known.len() as f64) as usize;
        if place >= known.len() {
            return 0.0;
        }
        *known.select_nth_unstable_by(place, f64::total_cmp).1
    }
}
