//! Remeshing while the edges of the input stay at which it bends too much for a distance: where the operations that keep it begin.

use super::connectivity::{DynamicMesh, NONE};
use super::features::{Curves, Features, creases_to};
use super::marked::{Hold, Marked};
use glam::DVec3;
use pompeiu_core::VertexId;
use std::collections::HashMap;

/// Part of the distance that a chord may stand off an edge that is not held.
const HELD: f64 = 0.1;

/// Share of the vertices at edges with higher chords than the distance from which remeshing without these edges is in vain.
const ROUGH: f64 = 0.5;

/// Share of the distance from which edges are held that chords stand off, where some are too far away.
pub(super) const RISKY: f64 = 0.5;

/// Edges whose faces meet at more than this angle between their normals, in degrees, are kept where the result is too far from the input:
/// without them it cuts off what lies beside them, however short its edges are.
const CREASE: f64 = 30.0;

/// Rings of neighbours of what was held that are near it.
const RINGS: usize = 2;

/// The height over an edge of the chord that a face of the target length across it makes, at most.
fn height(surface: &Marked, h: u32) -> f64 {
    let mesh = &surface.mesh;
    let Some(t) = mesh.twin_of(h) else { return 0.0 };
    let normal = |f: u32| {
        let [a, b, c] = surface.triangle(f);
        (b - a).cross(c - a).normalize_or_zero()
    };
    let (n, m) = (normal(h / 3), normal(t / 3));
    if n == DVec3::ZERO || m == DVec3::ZERO {
        return 0.0;
    }
    let [p, q] = [mesh.from(h), mesh.to(h)].map(|v| surface.length[v as usize]);
    // Half of the length of the difference of the normals is the sine of half of their angle.
    0.25 * (n - m).length() * if p < q { p } else { q }
}

/// The height over a vertex of a curve of the chord that an edge of the target length past it makes, at most.
fn turn(surface: &Marked, v: u32) -> f64 {
    let mesh = &surface.mesh;
    let at = |v: u32| mesh.positions[v as usize];
    let directions =
        mesh.neighbours(v).filter(|&w| surface.is_on_curve([v, w]) || surface.is_on_curve([w, v]));
    // Both ways along a straight curve cancel out.
    let sum: DVec3 = directions.map(|w| (at(w) - at(v)).normalize_or_zero()).sum();
    0.25 * sum.length() * surface.length[v as usize]
}

/// Marks the vertices at an edge from which the faces that would replace it stand off by more than a distance.
pub(super) fn mark_rough(surface: &Marked, distance: f64, marked: &mut [bool]) {
    let mesh = &surface.mesh;
    let is_high = |h: &u32| surface.curve[*h as usize] == NONE && height(surface, *h) > distance;
    for h in mesh.edges().filter(is_high) {
        for v in [mesh.from(h), mesh.to(h)] {
            marked[v as usize] = true;
        }
    }
}

/// Whether most vertices of a surface are such.
pub(super) fn is_rough(surface: &Marked, distance: f64) -> bool {
    let mut rough = vec![false; surface.mesh.positions.len()];
    mark_rough(surface, distance, &mut rough);
    rough.iter().filter(|is| **is).count() as f64 > ROUGH * rough.len() as f64
}

/// Marks the neighbours of marked vertices, too.
pub(super) fn spread(mesh: &DynamicMesh, marked: &mut [bool]) {
    let seeds: Vec<u32> = (0..marked.len() as u32).filter(|&v| marked[v as usize]).collect();
    for w in seeds.into_iter().flat_map(|v| mesh.neighbours(v)) {
        marked[w as usize] = true;
    }
}

/// Makes curves of the creases of the input that lead to marked vertices; whether there are any that were none before. Vertices and edges that
/// were selected must not have been split yet.
pub(super) fn keep_creases(copy: &mut Marked, features: &Features<'_>, marked: &[bool]) -> bool {
    let mut edges = creases_to(&copy.mesh, CREASE, marked);
    edges.retain(|ends| !copy.is_on_curve(ends.map(|v| v.0)));
    if edges.is_empty() {
        return false;
    }
    edges.extend(copy.on_curves());
    let curves = Curves::find(&copy.mesh, &Features { edges: &edges, ..*features });
    (copy.curve, copy.hold) = (curves.of_halfedge, curves.hold);
    true
}

/// A surface whose edges are curves where it bends, with what its own curves were.
pub(super) struct Held {
    pub(super) surface: Marked,
    /// The curve of the surface for each curve, [`NONE`] for an edge that is held only now.
    curves: Vec<u32>,
    /// What held each corner before. A corner keeps its position, but not its number: a collapse at the boundary can start at it.
    corners: HashMap<[u64; 3], Hold>,
}

fn key(position: DVec3) -> [u64; 3] {
    position.to_array().map(f64::to_bits)
}

impl Held {
    /// Holds the edges at marked vertices, or at all, with chords that stand off by more than part of a distance.
    pub(super) fn new(surface: &Marked, distance: f64, marked: Option<&[bool]>) -> Self {
        let mesh = &surface.mesh;
        let is_marked =
            |h: u32| marked.is_none_or(|marked| marked[mesh.from(h) as usize] || marked[mesh.to(h) as usize]);
        let is_high = |h: &u32| {
            surface.curve[*h as usize] != NONE || is_marked(*h) && height(surface, *h) > HELD * distance
        };
        let ends = |h: u32| [mesh.from(h), mesh.to(h)].map(VertexId);
        let edges: Vec<[VertexId; 2]> = mesh.edges().filter(is_high).map(ends).collect();
        let is_corner = |&v: &u32| match surface.hold[v as usize] {
            Hold::Corner => true,
            Hold::Free => false,
            Hold::Curve(_) => {
                marked.is_none_or(|marked| marked[v as usize]) && turn(surface, v) > HELD * distance
            }
        };
        let corners = (0..surface.hold.len() as u32).filter(is_corner);
        let vertices: Vec<VertexId> = corners.map(VertexId).collect();
        let found = Curves::find(mesh, &Features { angle: None, edges: &edges, vertices: &vertices });
        // A curve runs along held edges only, or along those of one curve: where one of each meet, there are three, and so a corner.
        let mut curves = Vec::new();
        for h in mesh.edges() {
            let curve = found.of_halfedge[h as usize];
            if curve != NONE {
                if curves.len() <= curve as usize {
                    curves.resize(curve as usize + 1, NONE);
                }
                curves[curve as usize] = surface.curve[h as usize];
            }
        }
        let mut corners = HashMap::new();
        for (v, _) in found.hold.iter().enumerate().filter(|(_, hold)| **hold == Hold::Corner) {
            let before = corners.entry(key(mesh.positions[v])).or_insert(surface.hold[v]);
            if surface.hold[v] == Hold::Corner {
                *before = Hold::Corner;
            }
        }
        let held = Marked { curve: found.of_halfedge, hold: found.hold, ..surface.clone() };
        Self { surface: held, curves, corners }
    }

    /// The surface with its own curves again, and which vertices are near what was held.
    pub(super) fn release(self) -> (Marked, Vec<bool>) {
        let Self { mut surface, curves, corners } = self;
        for curve in surface.curve.iter_mut().filter(|curve| **curve != NONE) {
            *curve = curves[*curve as usize];
        }
        let mut open = vec![false; surface.hold.len()];
        for (v, now) in surface.hold.iter_mut().enumerate() {
            let own = match *now {
                Hold::Free => Hold::Free,
                Hold::Corner => corners.get(&key(surface.mesh.positions[v])).copied().unwrap_or(Hold::Corner),
                Hold::Curve(curve) => match curves[curve as usize] {
                    NONE => Hold::Free,
                    own => Hold::Curve(own),
                },
            };
            open[v] = own != *now && surface.mesh.has_faces(v as u32);
            *now = own;
        }
        for _ in 0..RINGS {
            spread(&surface.mesh, &mut open);
        }
        (surface, open)
    }
}

#[cfg(test)]
mod tests {
    use super::super::isotropic::iterate;
    use super::super::reference::{Reference, identity};
    use super::super::sizing::Lengths;
    use super::*;
    use pompeiu_core::mesh::shapes;
    use pompeiu_core::run::{Control, Limits};
    use pompeiu_core::spatial::bvh::Bvh;

    #[test]
    fn what_was_held_is_free_again_and_own_curves_are_as_before() {
        let shape = shapes::cylinder(1.0, 2.0, 12, 3, shapes::Ends::Open).expect("a cylinder");
        let mesh = DynamicMesh::new(shape.positions(), shape.faces()).expect("a manifold");
        let curves = Curves::find(&mesh, &Features::default());
        let slot = Bvh::build(&shape, &identity()).any_slot();
        let count = mesh.positions.len();
        let own = Marked {
            mesh,
            curve: curves.of_halfedge,
            hold: curves.hold,
            length: vec![0.2; count],
            near: vec![slot; count],
        };
        assert!(is_rough(&own, 0.005) && !is_rough(&own, 0.1));
        let mut held = Held::new(&own, 0.005, None);
        let lines = held.surface.hold.iter().filter(|hold| **hold == Hold::Corner).count();
        assert!(lines >= 24, "the lines end at the boundary: {lines}");
        let reference =
            Reference::new(&held.surface, identity(), Lengths::Uniform(0.2)).expect("a reference");
        for _ in 0..3 {
            let done =
                iterate(&mut held.surface, Some(&reference), 100_000, &Control::start(&Limits::default()));
            assert!(done.is_ok() && held.surface.mesh.face_count() > 500);
        }
        let on_facets = |p: &DVec3| {
            let angle =
                libm::atan2(p.y, p.x).rem_euclid(std::f64::consts::PI / 6.0) - std::f64::consts::PI / 12.0;
            (p.x.hypot(p.y) * angle.cos() - (std::f64::consts::PI / 12.0).cos()).abs() < 1e-12
        };
        let used = (0..held.surface.hold.len()).filter(|&v| held.surface.mesh.has_faces(v as u32));
        assert!(used.map(|v| held.surface.mesh.positions[v]).all(|p| on_facets(&p)), "no facet is left");
        let (surface, open) = held.release();
        surface.assert_valid();
        let inner = |v: &usize| surface.hold[*v] == Hold::Free && open[*v];
        assert!((0..open.len()).filter(inner).count() > 100);
        assert!(surface.hold.iter().all(|hold| *hold != Hold::Corner), "circles have no corners");
    }
}
