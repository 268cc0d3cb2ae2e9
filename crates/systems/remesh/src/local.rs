//! Changes of a remeshed surface at one place after the other: what those that raise angles and those that lower distances share.

use super::marked::{Collapse, Marked};
use super::reference::Reference;
use super::star::Star;
use super::triangle::{Triangle, area_vector, keeps_normal};
use glam::DVec3;
use pompeiu_core::geom::point_triangle::distance_sq;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::bvh::{Slot, Workspace};

/// Directions in which a vertex is moved.
const DIRECTIONS: u32 = 8;

/// Times that a step in vain is halved.
const HALVINGS: usize = 5;

/// Cosine between the normals of both faces of an edge after a flip, at least.
const LEAST_COSINE: f64 = 0.5;

/// Longest edge that a collapse may make, in target lengths.
const LONGEST: f64 = 1.6;

/// A surface that is changed near the input.
pub(super) struct Local<'s> {
    pub(super) surface: &'s mut Marked,
    pub(super) reference: &'s Reference<'s>,
    control: &'s Control,
    workspace: Workspace,
}

/// The faces around a vertex, with the corner that it is.
pub(super) struct Fan {
    pub(super) faces: Vec<Triangle>,
    corners: Vec<usize>,
}

impl Fan {
    pub(super) fn new(surface: &Marked, v: u32) -> Self {
        let (faces, corners) =
            surface.mesh.halfedges_from(v).map(|h| (surface.triangle(h / 3), (h % 3) as usize)).unzip();
        Self { faces, corners }
    }

    /// The faces with the vertex at a position.
    pub(super) fn with(&self, position: DVec3) -> Self {
        let mut faces = self.faces.clone();
        for (face, &corner) in faces.iter_mut().zip(&self.corners) {
            face[corner] = position;
        }
        Self { faces, corners: self.corners.clone() }
    }

    /// Whether no face turned over.
    pub(super) fn keeps_normals(&self, before: &Self) -> bool {
        before.faces.iter().zip(&self.faces).all(|(old, new)| keeps_normal(*old, *new))
    }

    /// The middle of each face, and that of the edge to its next corner.
    pub(super) fn middles(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.faces
            .iter()
            .zip(&self.corners)
            .flat_map(|(face, &corner)| [middle(face), 0.5 * (face[corner] + face[(corner + 1) % 3])])
    }
}

/// A collapse that is possible, with the faces around the edge as they are.
pub(super) struct Collapsible {
    pub(super) way: Collapse,
    /// The vertex that stays.
    pub(super) vertex: u32,
    pub(super) ends: [DVec3; 2],
    pub(super) star: Star,
    /// All faces around the edge, and those of them that stay.
    pub(super) old: Vec<Triangle>,
    kept: Vec<Triangle>,
}

impl Collapsible {
    pub(super) fn new(surface: &Marked, h: u32) -> Option<Self> {
        let way = surface.collapse_of(h)?;
        let [from, vertex] = [surface.mesh.from(way.halfedge), surface.mesh.to(way.halfedge)];
        let ends = [from, vertex].map(|v| surface.mesh.positions[v as usize]);
        let star = Star::new(surface, way.halfedge);
        let triangles = |faces: &[u32]| faces.iter().map(|f| surface.triangle(*f)).collect();
        let (old, kept) = (triangles(&star.gone), triangles(&star.kept));
        Some(Self { way, vertex, ends, star, old, kept })
    }

    /// Makes `new` the faces that stay with both ends at a position. False where one of them turns over, or an edge there is too long.
    pub(super) fn place(&self, surface: &Marked, position: DVec3, new: &mut Vec<Triangle>) -> bool {
        let longest = LONGEST * surface.length[self.vertex as usize];
        self.star.moved(surface, position, new);
        self.kept.iter().zip(&*new).all(|(old, new)| keeps_normal(*old, *new))
            && new.iter().flatten().all(|p| p.distance_squared(position) <= longest * longest)
    }
}

impl<'s> Local<'s> {
    pub(super) fn new(surface: &'s mut Marked, reference: &'s Reference<'s>, control: &'s Control) -> Self {
        Self { surface, reference, control, workspace: Workspace::default() }
    }

    /// Whether to leave the surface as it is, which is valid after each change.
    pub(super) fn is_stopped(&self) -> bool {
        self.control.is_stopped()
    }

    /// The point of the input nearest to another one, with its face, searched from a face believed near.
    pub(super) fn project(&mut self, p: DVec3, near: Slot) -> (DVec3, Slot) {
        let found = self.reference.project(p, near, &mut self.workspace);
        (found.position, found.slot)
    }

    /// The greatest distance of points from the input; ends with one that is at least `enough`.
    pub(super) fn farthest(&mut self, points: impl Iterator<Item = DVec3>, near: Slot, enough: f64) -> f64 {
        let mut most = 0.0;
        for p in points {
            let distance = self.project(p, near).0.distance(p);
            most = if distance > most { distance } else { most };
            if most >= enough {
                break;
            }
        }
        most
    }

    /// Searches the input around a vertex for where a measure is least, if it is less than some value anywhere.
    ///
    /// The measure takes the faces around the vertex, a face of the input near it, and the least value so far, which it need not
    /// tell from any greater one.
    pub(super) fn search(
        &mut self,
        v: u32,
        fan: &Fan,
        step: f64,
        mut least: f64,
        mut measure: impl FnMut(&mut Self, &Fan, Slot, f64) -> f64,
    ) -> Option<(DVec3, Slot)> {
        let length = self.surface.length[v as usize];
        let normal = fan.faces.iter().map(|face| area_vector(*face)).sum::<DVec3>().try_normalize()?;
        let (x, y) = normal.any_orthonormal_pair();
        let (mut at, mut near) = (self.surface.mesh.positions[v as usize], self.surface.near[v as usize]);
        let mut found = None;
        let mut step = step * length;
        for _ in 0..=HALVINGS {
            let mut is_better = false;
            for k in 0..DIRECTIONS {
                let angle = std::f64::consts::TAU * f64::from(k) / f64::from(DIRECTIONS);
                let p = at + step * (libm::cos(angle) * x + libm::sin(angle) * y);
                let (position, slot) = self.project(p, near);
                if position.distance_squared(p) > length * length {
                    continue;
                }
                let value = measure(self, &fan.with(position), slot, least);
                if value < least {
                    (least, at, near, is_better) = (value, position, slot, true);
                    found = Some((at, near));
                }
            }
            if !is_better {
                step *= 0.5;
            }
        }
        found
    }
}

pub(super) fn middle(face: &Triangle) -> DVec3 {
    (face[0] + face[1] + face[2]) / 3.0
}

/// The distance of a point from the nearest of some faces.
pub(super) fn distance_from(p: DVec3, faces: &[Triangle]) -> f64 {
    let squares = faces.iter().map(|face| {
        let [a, b, c] = face.map(|q| q.to_array());
        distance_sq(p.to_array(), a, b, c)
    });
    squares.fold(f64::INFINITY, |least, x| if x < least { x } else { least }).sqrt()
}

/// The sine of the least angle of a triangle.
pub(super) fn sine(face: &Triangle) -> f64 {
    let [a, b, c] = *face;
    let mut squares = [a.distance_squared(b), b.distance_squared(c), c.distance_squared(a)];
    squares.sort_by(f64::total_cmp);
    // The least angle lies between the two longer sides.
    let product = (squares[1] * squares[2]).sqrt();
    if product > 0.0 { area_vector(*face).length() / product } else { 0.0 }
}

/// The sine of the least angle of some faces.
pub(super) fn least_sine(faces: &[Triangle]) -> f64 {
    faces.iter().map(sine).fold(1.0, |least, x| if x < least { x } else { least })
}

/// The faces on both sides of an edge with these corners, before and after a flip; none if they would be folded then.
pub(super) fn flipped([u, v, a, b]: [DVec3; 4]) -> Option<[[Triangle; 2]; 2]> {
    let (old, new) = ([[u, v, a], [v, u, b]], [[a, u, b], [b, v, a]]);
    let [n, m] = new.map(area_vector);
    let all = area_vector(old[0]) + area_vector(old[1]);
    let is_smooth =
        n.dot(m) >= LEAST_COSINE * n.length() * m.length() && n.dot(all) > 0.0 && m.dot(all) > 0.0;
    is_smooth.then_some([old, new])
}

#[cfg(test)]
mod tests {
    use super::super::connectivity::DynamicMesh;
    use super::super::features::Curves;
    use super::super::reference::identity;
    use super::super::samples::samples;
    use super::super::sizing::Lengths;
    use super::*;
    use pompeiu_core::mesh::{displace_at_random, shapes};
    use pompeiu_core::run::StopReason;

    /// Nothing is changed after a limit, also within what raises angles and lowers distances.
    #[test]
    fn a_limit_leaves_the_surface_as_it_is() {
        // Faces have small angles, and are far away.
        let mesh = displace_at_random(&shapes::icosphere(1.0, 3).unwrap(), 0.1, 5).unwrap();
        let mesh = DynamicMesh::new(mesh.positions(), mesh.faces()).unwrap();
        let curves = Curves::none(&mesh);
        let length = vec![0.15; mesh.positions.len()];
        let lengths = Lengths::AtVertices(length.clone());
        let mut input =
            Marked { curve: curves.of_halfedge, hold: curves.hold, length, near: Vec::new(), mesh };
        let reference = Reference::new(&input, identity(), lengths).unwrap();
        input.near = reference.slots_at_vertices(input.mesh.positions.len());
        let samples = samples(&input);
        let mut coarse = input.clone();
        coarse.mesh.positions.iter_mut().for_each(|p| *p *= 1.05);
        let changed = |control: &Control, change: &dyn Fn(&mut Local<'_>)| {
            let mut surface = coarse.clone();
            change(&mut Local::new(&mut surface, &reference, control));
            surface.mesh != coarse.mesh
        };
        let changes: [&dyn Fn(&mut Local<'_>); 2] =
            [&|local| local.raise_angles(40.0, 0.25), &|local| local.lower_distance(&samples).unwrap()];
        let stopped = Control::default();
        stopped.stop(StopReason::Time);
        for (i, change) in changes.into_iter().enumerate() {
            assert!(changed(&Control::default(), change), "{i}");
            assert!(!changed(&stopped, change), "{i}");
        }
    }
}
