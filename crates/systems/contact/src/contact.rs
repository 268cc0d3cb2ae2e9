//! Barriers of pairs: energies, gradients, positive semi-definite second derivatives, lagged friction.

use crate::barrier::{MOLLIFIED, barrier, cross_squared, friction, mollifier};
use crate::curvature::{Curvature, Parts};
use crate::distance::{Closest, Kind, distance_sq};
use crate::surface::{Candidates, Surface};
use crate::{Obstacle, Projection};
use glam::DVec3;
use rayon::prelude::*;

/// A pair that pushes, with its weight in the sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// What its parts are.
    pub kind: Kind,
    /// The vertices of its points; those that are not used repeat the first.
    pub vertices: [u32; 4],
    /// Its weight: 1, or less than 0 where it was counted before.
    pub weight: f64,
    /// For edges, the `|e₁ × e₂|²` below which it is mollified.
    pub mollified: f64,
}

impl Contact {
    fn points(&self, x: &[DVec3]) -> [DVec3; 4] {
        self.vertices.map(|v| x[v as usize])
    }

    /// The mollifier with its derivatives by `|u × v|²`, and the gradient of that.
    fn mollifier(&self, x: &[DVec3; 4]) -> ([f64; 3], [DVec3; 4]) {
        if self.mollified > 0.0 {
            let (c, gradient) = cross_squared(x);
            (mollifier(c, self.mollified), gradient)
        } else {
            ([1.0, 0.0, 0.0], [DVec3::ZERO; 4])
        }
    }

    /// The distance.
    pub fn distance(&self, x: &[DVec3]) -> f64 {
        Closest::of(self.kind, &self.points(x)).distance_sq().sqrt()
    }

    /// `w m b(d²)`, without κ.
    pub fn energy(&self, x: &[DVec3], d_hat: f64) -> f64 {
        let x = self.points(x);
        let [b, ..] = barrier(distance_sq(self.kind, &x), d_hat * d_hat);
        let ([m, ..], _) = self.mollifier(&x);
        self.weight * m * b
    }

    /// Its gradient by the four points, and a positive semi-definite part of its second derivatives.
    ///
    /// [`Projection::Normal`] leaves the mollifier of nearly parallel edges out of the second derivatives.
    pub fn derivatives(&self, x: &[DVec3], d_hat: f64, projection: Projection) -> ([DVec3; 4], Curvature) {
        let x = self.points(x);
        let closest = Closest::of(self.kind, &x);
        let s = closest.distance_sq();
        let barrier @ [b, first, second] = barrier(s, d_hat * d_hat);
        let (mollifier @ [m, slope, _], by) = self.mollifier(&x);
        let of_distance = closest.gradient();
        let weight = self.weight;
        let gradient = std::array::from_fn(|i| (of_distance[i] * (m * first) + by[i] * (slope * b)) * weight);
        let curvature = match projection {
            Projection::Normal => {
                let normal = std::array::from_fn(|i| of_distance[i / 3][i % 3]);
                let factor = weight * m * (second + first / (2.0 * s));
                Curvature::Rank1(if factor > 0.0 { factor } else { 0.0 }, normal)
            }
            Projection::Exact => {
                let scaled = |values: [f64; 3]| values.map(|value| value * weight);
                let parts = Parts { closest: &closest, x: &x, barrier: scaled(barrier), mollifier };
                Curvature::Full(Box::new(parts.positive()))
            }
        };
        (gradient, curvature)
    }

    /// All its second derivatives by the four points, which may have negative eigenvalues.
    pub fn second_derivatives(&self, x: &[DVec3], d_hat: f64) -> [[f64; 12]; 12] {
        let x = self.points(x);
        let closest = Closest::of(self.kind, &x);
        let barrier = barrier(closest.distance_sq(), d_hat * d_hat).map(|value| value * self.weight);
        Parts { closest: &closest, x: &x, barrier, mollifier: self.mollifier(&x).0 }.full()
    }
}

/// The pairs of candidates that are closer than `d_hat`: with weights of edges, by inclusion and exclusion; all without.
pub(crate) fn active(
    surface: &Surface,
    candidates: &Candidates,
    x: &[DVec3],
    rest: &[DVec3],
    d_hat: f64,
    edge_weights: Option<&[f64]>,
) -> Vec<Contact> {
    let is_close =
        |kind: Kind, vertices: &[u32; 4]| distance_sq(kind, &vertices.map(|v| x[v as usize])) < d_hat * d_hat;
    let faces: Vec<Contact> = candidates
        .point_face
        .par_iter()
        .filter_map(|&pair| {
            let (kind, vertices) = surface.point_face(pair);
            is_close(kind, &vertices).then_some(Contact { kind, vertices, weight: 1.0, mollified: 0.0 })
        })
        .collect();
    let edges: Vec<Contact> = candidates
        .edge_edge
        .par_iter()
        .filter_map(|&pair| {
            let (kind, vertices) = surface.edge_edge(pair);
            if !is_close(kind, &vertices) {
                return None;
            }
            let [a, b, c, d] = vertices.map(|v| rest[v as usize]);
            let mollified = MOLLIFIED * (b - a).length_squared() * (d - c).length_squared();
            let weight = edge_weights.map_or(1.0, |w| w[pair.0 as usize] * w[pair.1 as usize]);
            Some(Contact { kind, vertices, weight, mollified })
        })
        .collect();
    let mut contacts = faces;
    contacts.extend(edges);
    if edge_weights.is_some() {
        let more = exclusions_of_points(surface, &candidates.point_face);
        contacts.par_extend(more.into_par_iter().filter(|c| is_close(c.kind, &c.vertices)));
    }
    contacts
}

/// Inner edges, less, and inner vertices, more, near each point: so that a point near a flat surface is pushed once.
fn exclusions_of_points(surface: &Surface, pairs: &[(u32, u32)]) -> Vec<Contact> {
    let mut contacts = Vec::new();
    for group in pairs.chunk_by(|a, b| a.0 == b.0) {
        let point = group[0].0;
        let apart = |face: &u32| !surface.faces[*face as usize].contains(&point);
        let weight_of_edge = |edge: u32| {
            let around = surface.edge_faces[edge as usize].iter().filter(|face| apart(face)).count();
            around.saturating_sub(1)
        };
        let mut edges: Vec<u32> =
            group.iter().flat_map(|(_, face)| surface.face_edges[*face as usize]).collect();
        edges.sort_unstable();
        edges.dedup();
        let mut vertices: Vec<u32> =
            group.iter().flat_map(|(_, face)| surface.faces[*face as usize]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        for edge in edges {
            let [a, b] = surface.edges[edge as usize];
            let weight = weight_of_edge(edge);
            if weight > 0 {
                let (kind, vertices) = (Kind::PointEdge, [point, a, b, point]);
                contacts.push(Contact { kind, vertices, weight: -(weight as f64), mollified: 0.0 });
            }
        }
        for vertex in vertices {
            let faces = surface.vertex_faces[vertex as usize].iter().filter(|face| apart(face)).count();
            let around = surface.vertex_edges[vertex as usize].iter();
            let apart = around.filter(|&&edge| !surface.edges[edge as usize].contains(&point));
            let edges: usize = apart.map(|&edge| weight_of_edge(edge)).sum();
            let weight = 1.0 - faces as f64 + edges as f64;
            if weight != 0.0 && faces > 0 {
                let (kind, vertices) = (Kind::PointPoint, [point, vertex, point, point]);
                contacts.push(Contact { kind, vertices, weight, mollified: 0.0 });
            }
        }
    }
    contacts
}

/// A vertex near an obstacle with a formula.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Support {
    pub(crate) vertex: u32,
    pub(crate) obstacle: Obstacle,
}

impl Support {
    pub(crate) fn energy(&self, x: &[DVec3], d_hat: f64) -> f64 {
        let (d, _) = self.obstacle.distance(x[self.vertex as usize]);
        if d <= 0.0 { f64::INFINITY } else { barrier(d * d, d_hat * d_hat)[0] }
    }

    /// Gradient, normal and second derivative along it.
    pub(crate) fn derivatives(&self, x: &[DVec3], d_hat: f64) -> (DVec3, DVec3, f64) {
        let (d, n) = self.obstacle.distance(x[self.vertex as usize]);
        let [_, first, second] = barrier(d * d, d_hat * d_hat);
        let along = 4.0 * d * d * second + 2.0 * first;
        (n * (2.0 * d * first), n, if along > 0.0 { along } else { 0.0 })
    }
}

/// Friction of a pair, with normal force and directions as they were when the step began.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slide {
    vertices: [u32; 4],
    weights: [f64; 4],
    tangents: [DVec3; 2],
    /// The coefficient times the normal force.
    force: f64,
}

impl Slide {
    pub(crate) fn of_contact(
        contact: &Contact,
        x: &[DVec3],
        d_hat: f64,
        stiffness: f64,
        coefficient: f64,
    ) -> Option<Self> {
        let points = contact.points(x);
        let closest = Closest::of(contact.kind, &points);
        let d = closest.distance_sq().sqrt();
        let ([m, ..], _) = contact.mollifier(&points);
        let normal = -2.0 * d * barrier(d * d, d_hat * d_hat)[1] * stiffness * m * contact.weight;
        Self::new(contact.vertices, closest.weights, closest.vector / d, coefficient * normal)
    }

    pub(crate) fn of_support(
        support: &Support,
        x: &[DVec3],
        d_hat: f64,
        stiffness: f64,
        coefficient: f64,
    ) -> Option<Self> {
        let (d, n) = support.obstacle.distance(x[support.vertex as usize]);
        let normal = -2.0 * d * barrier(d * d, d_hat * d_hat)[1] * stiffness;
        Self::new([support.vertex; 4], [1.0, 0.0, 0.0, 0.0], n, coefficient * normal)
    }

    fn new(vertices: [u32; 4], weights: [f64; 4], n: DVec3, force: f64) -> Option<Self> {
        let n = n.try_normalize()?;
        let (a, b) = n.any_orthonormal_pair();
        (force != 0.0).then_some(Self { vertices, weights, tangents: [a, b], force })
    }

    pub(crate) fn vertices(&self) -> [u32; 4] {
        self.vertices
    }

    fn sliding(&self, moved: &[DVec3]) -> [f64; 2] {
        let u: DVec3 = (0..4).map(|i| moved[self.vertices[i] as usize] * self.weights[i]).sum();
        self.tangents.map(|t| t.dot(u))
    }

    /// For displacements since the step began.
    pub(crate) fn energy(&self, moved: &[DVec3], epsilon: f64) -> f64 {
        let [a, b] = self.sliding(moved);
        self.force * friction(a.hypot(b), epsilon)[0]
    }

    /// Gradient by the four points, and the second derivatives.
    pub(crate) fn derivatives(&self, moved: &[DVec3], epsilon: f64) -> ([DVec3; 4], [[f64; 12]; 12]) {
        let [a, b] = self.sliding(moved);
        let y = a.hypot(b);
        let [_, ratio, second] = friction(y, epsilon);
        let u = self.tangents[0] * a + self.tangents[1] * b;
        let gradient = self.weights.map(|w| u * (self.force * ratio * w));
        // Across the direction of sliding the second derivative is f₀' / y, along it f₀''.
        let (along, across) = if y > 0.0 {
            let along = u / y;
            (along, (self.tangents[0] * (-b / y) + self.tangents[1] * (a / y)))
        } else {
            (self.tangents[0], self.tangents[1])
        };
        let second = if y > 0.0 { second } else { ratio };
        let force = if self.force > 0.0 { self.force } else { 0.0 };
        let hessian = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let weight = self.weights[i / 3] * self.weights[j / 3] * force;
                let (p, q) = (i % 3, j % 3);
                weight * (second * along[p] * along[q] + ratio * across[p] * across[q])
            })
        });
        (gradient, hessian)
    }
}
