//! Points, edges and faces of all surfaces, and which of them may meet.

use crate::boxes::{Box3, BoxFrame, BoxTree};
use crate::distance::Kind;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// The sine of the angle between two faces from which on their edge counts as one: eleven degrees.
const BENT: f64 = 0.2;

/// How much an edge between faces in one plane counts.
const LEAST_WEIGHT: f64 = 1e-3;

/// Points or edges that are looked at by one task.
const SHARE: usize = 512;

/// What all surfaces are made of.
#[derive(Debug)]
pub(crate) struct Surface {
    pub(crate) faces: Vec<[u32; 3]>,
    pub(crate) edges: Vec<[u32; 2]>,
    /// Vertices of faces.
    pub(crate) points: Vec<u32>,
    pub(crate) is_fixed: Vec<bool>,
    pub(crate) face_edges: Vec<[u32; 3]>,
    pub(crate) edge_faces: Vec<Vec<u32>>,
    pub(crate) vertex_faces: Vec<Vec<u32>>,
    pub(crate) vertex_edges: Vec<Vec<u32>>,
}

/// Pairs that may come close: of points and faces, point by point, and of edges; in an order that does not depend on threads.
#[derive(Debug, Default)]
pub(crate) struct Candidates {
    /// Vertex and face.
    pub(crate) point_face: Vec<(u32, u32)>,
    /// Two edges, the lesser index first.
    pub(crate) edge_edge: Vec<(u32, u32)>,
}

/// Lists one after the other.
fn joined(lists: Vec<Vec<(u32, u32)>>) -> Vec<(u32, u32)> {
    let mut all = Vec::with_capacity(lists.iter().map(Vec::len).sum());
    for list in lists {
        all.extend(list);
    }
    all
}

impl Surface {
    pub(crate) fn new(faces: &[[u32; 3]], is_fixed: &[bool]) -> Self {
        let mut index: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        let mut edges = Vec::new();
        let mut edge_faces: Vec<Vec<u32>> = Vec::new();
        let mut vertex_faces = vec![Vec::new(); is_fixed.len()];
        let mut vertex_edges = vec![Vec::new(); is_fixed.len()];
        let mut face_edges = Vec::with_capacity(faces.len());
        for (number, face) in faces.iter().enumerate() {
            let mut of_face = [0; 3];
            for k in 0..3 {
                let (a, b) = (face[k], face[(k + 1) % 3]);
                let key = [a.min(b), a.max(b)];
                let next = edges.len() as u32;
                let edge = *index.entry(key).or_insert(next);
                if edge == next {
                    edges.push(key);
                    edge_faces.push(Vec::new());
                    vertex_edges[key[0] as usize].push(edge);
                    vertex_edges[key[1] as usize].push(edge);
                }
                edge_faces[edge as usize].push(number as u32);
                of_face[k] = edge;
                vertex_faces[a as usize].push(number as u32);
            }
            face_edges.push(of_face);
        }
        let points = (0..is_fixed.len() as u32).filter(|&v| !vertex_faces[v as usize].is_empty()).collect();
        Self {
            faces: faces.to_vec(),
            edges,
            points,
            is_fixed: is_fixed.to_vec(),
            face_edges,
            edge_faces,
            vertex_faces,
            vertex_edges,
        }
    }

    /// Pairs whose boxes meet on the way from x to x + p, grown by a distance. Without p: as they are.
    pub(crate) fn candidates(&self, x: &[DVec3], p: Option<&[DVec3]>, distance: f64) -> Candidates {
        let frame = BoxFrame::of(x);
        let bounds = |vertices: &[u32]| {
            let from = vertices.iter().map(|&v| x[v as usize]);
            let to = vertices.iter().filter_map(|&v| p.map(|p| x[v as usize] + p[v as usize]));
            frame.around(from.chain(to), 0.5 * distance)
        };
        Candidates { point_face: self.points_and_faces(bounds), edge_edge: self.edges_and_edges(bounds) }
    }

    fn is_still(&self, vertices: &[u32]) -> bool {
        vertices.iter().all(|&v| self.is_fixed[v as usize])
    }

    fn points_and_faces(&self, bounds: impl Fn(&[u32]) -> Box3 + Sync) -> Vec<(u32, u32)> {
        let boxes: Vec<Box3> = self.faces.par_iter().map(|face| bounds(face)).collect();
        let tree = BoxTree::new(&boxes);
        let of_some = |points: &[u32]| {
            let mut found = Vec::new();
            for &v in points {
                let is_still = self.is_still(&[v]);
                tree.query(&bounds(&[v]), |face| {
                    let corners = &self.faces[face as usize];
                    let stays = is_still && self.is_still(corners);
                    if !stays && !corners.contains(&v) {
                        found.push((v, face));
                    }
                });
            }
            found
        };
        joined(self.points.par_chunks(SHARE).map(of_some).collect())
    }

    fn edges_and_edges(&self, bounds: impl Fn(&[u32]) -> Box3 + Sync) -> Vec<(u32, u32)> {
        let boxes: Vec<Box3> = self.edges.par_iter().map(|edge| bounds(edge)).collect();
        let tree = BoxTree::new(&boxes);
        let of_some = |share: usize| {
            let mut found = Vec::new();
            for place in share * SHARE..((share + 1) * SHARE).min(tree.len()) {
                tree.pairs_of(place, |e, f| {
                    let (ends, [a, b]) = (&self.edges[e as usize], self.edges[f as usize]);
                    let is_apart = !ends.contains(&a) && !ends.contains(&b);
                    if is_apart && !(self.is_still(ends) && self.is_still(&[a, b])) {
                        found.push((e.min(f), e.max(f)));
                    }
                });
            }
            found
        };
        joined((0..tree.len().div_ceil(SHARE)).into_par_iter().map(of_some).collect())
    }

    /// How much each edge counts among pairs of edges: as much as its faces are bent at it, up to one.
    ///
    /// An edge in a flat part of a surface is no feature of it: where another edge passes over it, points and faces push already, and
    /// beside it, its own barrier would push sideways. It keeps a small part, so that nothing passes between.
    pub(crate) fn edge_weights(&self, x: &[DVec3]) -> Vec<f64> {
        let normal = |face: u32| {
            let [a, b, c] = self.faces[face as usize].map(|v| x[v as usize]);
            (b - a).cross(c - a).normalize_or_zero()
        };
        let weight = |faces: &Vec<u32>| match faces[..] {
            [first, second] => {
                // Neighbours may be oriented against each other: the bend is that of their planes.
                let sine = normal(first).cross(normal(second)).length();
                let folded = normal(first).dot(normal(second)) < 0.0;
                let ratio = if folded { 1.0 } else { sine / BENT };
                (ratio * ratio).clamp(LEAST_WEIGHT, 1.0)
            }
            _ => 1.0,
        };
        self.edge_faces.par_iter().map(weight).collect()
    }

    pub(crate) fn point_face(&self, (v, face): (u32, u32)) -> (Kind, [u32; 4]) {
        let [a, b, c] = self.faces[face as usize];
        (Kind::PointTriangle, [v, a, b, c])
    }

    pub(crate) fn edge_edge(&self, (e, f): (u32, u32)) -> (Kind, [u32; 4]) {
        let ([a, b], [c, d]) = (self.edges[e as usize], self.edges[f as usize]);
        (Kind::EdgeEdge, [a, b, c, d])
    }
}
