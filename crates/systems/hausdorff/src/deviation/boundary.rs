//! How much the winding number of a surface that is not closed can vary.
//!
//! The gradient of the solid angle under which an oriented surface is seen is an integral along its boundary (Biot and Savart):
//! `∇Ω(q) = ∮ (x - q) × dx / |x - q|^3`. So along a way that does not meet the surface the winding number changes by at most the
//! length of the way, times the lengths of boundary edges divided by the squares of their distances, over 4π. Of a closed surface
//! nothing is left of the boundary, and the number is constant.

use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Frame;
use pompeiu_core::mesh::first_at_position;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Edges of a block.
const BLOCK: usize = 32;
/// A block this many times its diagonal away is taken as a whole.
const FAR: f64 = 2.0;
/// Outweighs the rounding of a bound, as a part of it; sums have far fewer than 1e6 terms that count.
const ROUNDING: f64 = 1e-9;

/// The edges where faces do not cancel each other, in a frame.
pub(super) struct Boundary {
    edges: Vec<Edge>,
    blocks: Vec<Block>,
}

struct Edge {
    ends: [DVec3; 2],
    /// Its length, times how often it is left over.
    weight: f64,
}

struct Block {
    lower: DVec3,
    upper: DVec3,
    weight: f64,
}

impl Boundary {
    pub(super) fn new(mesh: &TriMesh, frame: &Frame) -> Self {
        let place = first_at_position(mesh.positions());
        let mut halves: Vec<(u32, u32, i32)> = mesh
            .faces()
            .iter()
            .flat_map(|face| {
                let [a, b, c] = face.map(|v| place[v as usize]);
                [(a, b), (b, c), (c, a)]
            })
            .filter(|(from, to)| from != to)
            .map(|(from, to)| if from < to { (from, to, 1) } else { (to, from, -1) })
            .collect();
        halves.par_sort_unstable();
        let at = |v: u32| DVec3::from_array(frame.map(mesh.positions()[v as usize]));
        let edges: Vec<Edge> = halves
            .chunk_by(|x, y| (x.0, x.1) == (y.0, y.1))
            .filter_map(|group| {
                let left: i32 = group.iter().map(|half| half.2).sum();
                let ends = [at(group[0].0), at(group[0].1)];
                let weight = f64::from(left.unsigned_abs()) * ends[0].distance(ends[1]);
                (left != 0).then_some(Edge { ends, weight })
            })
            .collect();
        let block = |edges: &[Edge]| Block {
            lower: edges.iter().flat_map(|edge| edge.ends).fold(DVec3::INFINITY, DVec3::min),
            upper: edges.iter().flat_map(|edge| edge.ends).fold(DVec3::NEG_INFINITY, DVec3::max),
            weight: edges.iter().map(|edge| edge.weight).sum(),
        };
        let blocks = edges.chunks(BLOCK).map(block).collect();
        Self { edges, blocks }
    }

    /// Whether the surface is closed: every edge is left as often as it is entered.
    pub(super) fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }

    /// The number of its edges.
    pub(super) fn len(&self) -> usize {
        self.edges.len()
    }

    /// The winding number differs by at most this between a point and those up to a radius away, on ways that do not meet the surface.
    pub(super) fn variation(&self, centre: DVec3, radius: f64) -> f64 {
        let mut sum = 0.0;
        for (block, edges) in self.blocks.iter().zip(self.edges.chunks(BLOCK)) {
            let away = centre.distance(centre.clamp(block.lower, block.upper)) - radius;
            if away > FAR * block.lower.distance(block.upper) {
                sum += block.weight / (away * away);
                continue;
            }
            for edge in edges {
                let away = distance(centre, edge.ends) - radius;
                // So close that nothing is known.
                if away <= 0.0 {
                    return f64::INFINITY;
                }
                sum += edge.weight / (away * away);
            }
        }
        radius / (4.0 * PI) * sum * (1.0 + ROUNDING)
    }
}

/// The distance of a point from a segment, at most.
fn distance(point: DVec3, [from, to]: [DVec3; 2]) -> f64 {
    let way = to - from;
    let length = way.length_squared();
    let part = if length > 0.0 { ((point - from).dot(way) / length).clamp(0.0, 1.0) } else { 0.0 };
    point.distance(from + part * way) * (1.0 - ROUNDING) - ROUNDING * ROUNDING
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::geom::Aabb;
    use pompeiu_core::mesh::shapes::{Diagonal, cube, grid};
    use pompeiu_core::spatial::Winding;

    #[test]
    fn a_cube_is_closed_and_a_plate_is_not() {
        let cube = cube(1.0, 3).unwrap();
        assert!(Boundary::new(&cube, &Frame::of(&Aabb::of_faces(&cube))).is_empty());
        let plate = grid([1.0, 1.0], [4, 4], Diagonal::Rising).unwrap();
        assert_eq!(Boundary::new(&plate, &Frame::of(&Aabb::of_faces(&plate))).edges.len(), 16);
    }

    #[test]
    fn winding_numbers_vary_no_more_than_said() {
        let plate = grid([1.0, 1.0], [6, 6], Diagonal::Rising).unwrap();
        let frame = Frame::of(&Aabb::of_faces(&plate));
        let (boundary, winding) = (Boundary::new(&plate, &frame), Winding::new(&plate));
        let middle = plate.positions().iter().fold([0.0; 3], |m, p| [0, 1, 2].map(|k| m[k] + p[k] / 49.0));
        for (height, radius) in [(0.3, 0.1), (0.05, 0.02), (1.0, 0.5)] {
            let centre = [middle[0] + 0.2, middle[1], middle[2] + height];
            let bound = boundary.variation(DVec3::from_array(frame.map(centre)), frame.length_in(radius));
            let at = |p: [f64; 3]| winding.about(p).value;
            let mut most = 0.0_f64;
            for k in 0..3 {
                for step in [-radius, radius] {
                    let mut p = centre;
                    p[k] += 0.999 * step;
                    most = most.max((at(p) - at(centre)).abs());
                }
            }
            assert!(most <= bound && bound < 40.0 * most, "{height}: {most} {bound}");
        }
    }
}
