//! Points, edges and faces of all surfaces, and which of them may meet.

use crate::boxes::{Box3, BoxTree};
use crate::distance::Kind;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// The sine of the angle between two faces from which on their edge counts as one: eleven degrees.
const BENT: f64 = 0.2;

/// How much an edge between faces in one plane counts.
const LEAST_WEIGHT: f64 = 1e-3;

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

/// Pairs that may come close: of points and faces, and of edges, in order.
#[derive(Debug, Default)]
pub(crate) struct Candidates {
    /// Vertex and face.
    pub(crate) point_face: Vec<(u32, u32)>,
    /// Two edges, the lesser index first.
    pub(crate) edge_edge: Vec<(u32, u32)>,
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
        let bounds = |vertices: &[u32]| {
            let from = vertices.iter().map(|&v| x[v as usize]);
            let to = vertices.iter().filter_map(|&v| p.map(|p| x[v as usize] + p[v as usize]));
            Box3::of(from.chain(to)).grown(0.5 * distance)
        };
        let is_fixed = |vertices: &[u32]| vertices.iter().all(|&v| self.is_fixed[v as usize]);
        let faces = BoxTree::new(self.faces.par_iter().map(|face| bounds(face)).collect());
        let edge_boxes: Vec<Box3> = self.edges.par_iter().map(|edge| bounds(edge)).collect();
        let edges = BoxTree::new(edge_boxes.clone());
        let gather = |found: &mut Vec<(u32, u32)>, mut of_one: Vec<(u32, u32)>| {
            of_one.sort_unstable();
            found.append(&mut of_one);
        };
        let lists: Vec<Vec<(u32, u32)>> = self
            .points
            .par_iter()
            .map(|&v| {
                let mut found = Vec::new();
                let alone = is_fixed(&[v]);
                faces.query(&bounds(&[v]), |face| {
                    let corners = &self.faces[face as usize];
                    let is_still = alone && is_fixed(corners);
                    if !is_still && !corners.contains(&v) {
                        found.push((v, face));
                    }
                });
                found
            })
            .collect();
        let mut candidates = Candidates::default();
        for list in lists {
            gather(&mut candidates.point_face, list);
        }
        let lists: Vec<Vec<(u32, u32)>> = (0..self.edges.len() as u32)
            .into_par_iter()
            .map(|edge| {
                let mut found = Vec::new();
                let [a, b] = self.edges[edge as usize];
                let alone = is_fixed(&[a, b]);
                edges.query(&edge_boxes[edge as usize], |other| {
                    let ends = &self.edges[other as usize];
                    let is_still = alone && is_fixed(ends);
                    if other > edge && !is_still && !ends.contains(&a) && !ends.contains(&b) {
                        found.push((edge, other));
                    }
                });
                found
            })
            .collect();
        for list in lists {
            gather(&mut candidates.edge_edge, list);
        }
        candidates
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
