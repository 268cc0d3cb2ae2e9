//! What of a part lies in a box.

use super::{Measured, Part};
use pompeiu_core::{FaceId, TriMesh};
use std::collections::HashMap;

/// A side of a box: an axis, where it is, and whether what is below it is outside.
#[derive(Clone, Copy)]
struct Side {
    axis: usize,
    at: f64,
    is_least: bool,
}

impl Side {
    /// How far inside a point is: only the sign counts.
    fn depth(self, p: [f64; 3]) -> f64 {
        if self.is_least { p[self.axis] - self.at } else { self.at - p[self.axis] }
    }
}

/// A point of an edge, at this part of it, rounded: between both ends along each axis.
pub(super) fn on_edge(p: [f64; 3], q: [f64; 3], t: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| {
        let at = p[k] + t * (q[k] - p[k]);
        let (low, high) = if p[k] < q[k] { (p[k], q[k]) } else { (q[k], p[k]) };
        if at < low {
            low
        } else if at > high {
            high
        } else {
            at
        }
    })
}

/// Where edges cross the sides of a box.
struct Clipping {
    positions: Vec<[f64; 3]>,
    crossings: HashMap<[u32; 3], u32>,
}

impl Clipping {
    /// The part of a convex polygon on the inner side of a plane.
    fn clip(&mut self, polygon: &[u32], side: Side, number: u32) -> Vec<u32> {
        let mut inside = Vec::with_capacity(polygon.len() + 1);
        for (i, &from) in polygon.iter().enumerate() {
            let to = polygon[(i + 1) % polygon.len()];
            let [depth, next] = [from, to].map(|v| side.depth(self.positions[v as usize]));
            if depth >= 0.0 {
                inside.push(from);
            }
            // What only touches the plane leaves no polygon.
            if (depth > 0.0 && next < 0.0) || (depth < 0.0 && next > 0.0) {
                inside.push(self.crossing(from, to, side, number));
            }
        }
        inside
    }

    /// Where an edge crosses a plane: the same bits whichever way it is seen, exactly on the plane, and between both ends along each axis.
    fn crossing(&mut self, from: u32, to: u32, side: Side, number: u32) -> u32 {
        let key = if from < to { [from, to, number] } else { [to, from, number] };
        if let Some(known) = self.crossings.get(&key) {
            return *known;
        }
        let [mut p, mut q] = [from, to].map(|v| self.positions[v as usize]);
        // Vertices that are not welded may come in another order.
        if p.iter().map(|x| x.to_bits()).gt(q.iter().map(|x| x.to_bits())) {
            std::mem::swap(&mut p, &mut q);
        }
        let t = (side.at - p[side.axis]) / (q[side.axis] - p[side.axis]);
        let mut at = on_edge(p, q, t);
        at[side.axis] = side.at;
        self.positions.push(at);
        let crossing = (self.positions.len() - 1) as u32;
        self.crossings.insert(key, crossing);
        crossing
    }
}

impl Part {
    /// The points of it in a box, given by its least and its greatest coordinates; none if there is none.
    #[must_use]
    pub fn in_box(&self, whole: &TriMesh, bounds: [f64; 6]) -> Option<Self> {
        let side = |k: usize| Side { axis: k % 3, at: bounds[k], is_least: k < 3 };
        let sides: [Side; 6] = std::array::from_fn(side);
        let mut clipping = Clipping { positions: self.mesh.positions().to_vec(), crossings: HashMap::new() };
        let mut measured = vec![Measured::Nothing; whole.faces().len()];
        let (mut corners, mut faces): (Vec<[u32; 3]>, Vec<FaceId>) = (Vec::new(), Vec::new());
        for (face, triangle) in self.faces.iter().zip(self.mesh.faces()) {
            let mut polygon = triangle.to_vec();
            for (number, side) in (0..).zip(sides) {
                polygon = clipping.clip(&polygon, side, number);
            }
            if polygon.len() > 2 {
                let was_whole = self.measured[face.index()] == Measured::Whole;
                let is_whole = was_whole && polygon == *triangle;
                measured[face.index()] = if is_whole { Measured::Whole } else { Measured::Pieces };
            }
            for last in 2..polygon.len() {
                corners.push([polygon[0], polygon[last - 1], polygon[last]]);
                faces.push(*face);
            }
        }
        Self::on_used(whole, &clipping.positions, (corners, faces), measured)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::geom::Aabb;
    use pompeiu_core::mesh::shapes::cube;

    #[test]
    fn faces_are_cut_at_the_sides_of_a_box() {
        let mesh = cube(2.0, 1).unwrap();
        let all = Part::of(&mesh, |_| true).unwrap();
        let Aabb { lower, upper } = Aabb::of_faces(&mesh);
        // The lower third, exactly at its end.
        let end = lower[2] + 2.0 / 3.0;
        let part = all.in_box(&mesh, [-9.0, -9.0, -9.0, 9.0, 9.0, end]).unwrap();
        assert_eq!((part.left_out.faces, part.left_out.cut), (2, 8));
        assert!(part.left_out.share.contains(1.0 - (4.0 + 4.0 * 4.0 / 3.0) / 24.0));
        assert!(part.left_out.share.gap() < 1e-12);
        assert_eq!(Aabb::of_faces(&part.mesh).upper, [upper[0], upper[1], end]);
        assert!(part.faces.is_sorted());
        let whole = all.in_box(&mesh, [-9.0, -9.0, -9.0, 9.0, 9.0, 9.0]).unwrap();
        assert_eq!((whole.faces.len(), whole.left_out.share.upper()), (12, 0.0));
        // Faces that a side only touches are outside.
        let touched =
            all.in_box(&mesh, [lower[0], lower[1], lower[2], lower[0], upper[1], upper[2]]).unwrap();
        assert_eq!((touched.faces.len(), touched.left_out.cut), (2, 0));
        assert!(all.in_box(&mesh, [5.0, 5.0, 5.0, 6.0, 6.0, 6.0]).is_none());
    }
}
