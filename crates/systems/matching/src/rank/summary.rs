//! The summary of a mesh that stays when the mesh is dropped: its bounding box and support function in some directions.

use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Number of lines through the origin along which the support function is stored: 13 along integer vectors with entries up to 1,
/// and 36 with entries up to 2, one for each pair of opposite directions.
pub(super) const LINES: usize = 49;

/// Primitive integer vectors with entries of at most 2 in magnitude, whose first nonzero entry is positive.
pub(super) fn lines() -> [[i32; 3]; LINES] {
    let mut lines = [[0; 3]; LINES];
    let mut count = 0;
    for largest in 1..=2_i32 {
        for x in 0..=largest {
            for y in -largest..=largest {
                for z in -largest..=largest {
                    let line = [x, y, z];
                    let leading = line.into_iter().find(|&entry| entry != 0).unwrap_or(0);
                    let reaches = line.into_iter().any(|entry| entry.abs() == largest);
                    let primitive = line.into_iter().any(|entry| entry % 2 != 0);
                    if leading > 0 && reaches && primitive && count < LINES {
                        lines[count] = line;
                        count += 1;
                    }
                }
            }
        }
    }
    lines
}

/// The bounding box of a mesh, and its support function along fixed lines.
///
/// # Definition
/// For each line with integer vector d, the least and the greatest `d·x` over the points x of the mesh, rounded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Number of vertices, unreferenced ones included.
    pub vertices: usize,
    /// Number of faces.
    pub faces: usize,
    /// Least coordinates.
    pub lower: [f64; 3],
    /// Greatest coordinates.
    pub upper: [f64; 3],
    /// For each line the least and the greatest product, rounded.
    reaches: Vec<[f64; 2]>,
}

impl Summary {
    /// Computes the summary of a mesh: one pass over the corners of all faces for each line.
    ///
    /// # Cost
    /// O(n + m) on the threads of the current pool; the same bits for any number of them, because comparisons do not round.
    pub fn new(mesh: &TriMesh) -> Self {
        const CHUNK: usize = 1 << 12;
        let mut used = vec![false; mesh.positions().len()];
        for &vertex in mesh.faces().iter().flatten() {
            used[vertex as usize] = true;
        }
        let lines = lines().map(|line| line.map(f64::from));
        let reach_of = |(positions, used): (&[[f64; 3]], &[bool])| {
            let mut reaches = [[f64::INFINITY, f64::NEG_INFINITY]; LINES];
            for (p, _) in positions.iter().zip(used).filter(|(_, used)| **used) {
                for (reach, d) in reaches.iter_mut().zip(&lines) {
                    let along = d[0] * p[0] + d[1] * p[1] + d[2] * p[2];
                    reach[0] = if along < reach[0] { along } else { reach[0] };
                    reach[1] = if along > reach[1] { along } else { reach[1] };
                }
            }
            reaches
        };
        let reaches = mesh.positions().par_chunks(CHUNK).zip(used.par_chunks(CHUNK)).map(reach_of).reduce(
            || [[f64::INFINITY, f64::NEG_INFINITY]; LINES],
            |mut one, other| {
                for (reach, other) in one.iter_mut().zip(other) {
                    reach[0] = if other[0] < reach[0] { other[0] } else { reach[0] };
                    reach[1] = if other[1] > reach[1] { other[1] } else { reach[1] };
                }
                one
            },
        );
        let aabb = Aabb::of_faces(mesh);
        let [vertices, faces] = [mesh.positions().len(), mesh.faces().len()];
        Self { vertices, faces, lower: aabb.lower, upper: aabb.upper, reaches: reaches.to_vec() }
    }

    /// The box.
    pub fn aabb(&self) -> Aabb {
        Aabb { lower: self.lower, upper: self.upper }
    }

    /// For each line the least and the greatest product, with an error of at most [`Summary::rounding`].
    pub(super) fn reaches(&self) -> &[[f64; 2]] {
        &self.reaches
    }

    /// Bound on the error of the products.
    ///
    /// Products with 0, 1 and 2 are exact, and each of the two sums errs by at most `u = 2^-53` times a sum of at most `5 M`, where
    /// M is the largest coordinate: together less than `10 u M`; `16 u M` leaves a margin.
    pub(super) fn rounding(&self) -> f64 {
        8.0 * f64::EPSILON * self.aabb().max_coordinate()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::cube;

    #[test]
    fn lines_are_primitive_and_no_two_the_same() {
        let lines = lines();
        for (i, line) in lines.iter().enumerate() {
            assert!(line.iter().any(|entry| entry % 2 != 0) && line.iter().all(|entry| entry.abs() <= 2));
            let opposite = line.map(|entry| -entry);
            assert!(lines[..i].iter().all(|other| other != line && *other != opposite));
        }
        assert!(lines[..13].iter().flatten().all(|entry| entry.abs() <= 1));
    }

    #[test]
    fn unreferenced_vertices_do_not_reach_anywhere() {
        let (mut positions, faces) = cube(2.0, 1).unwrap().into_parts();
        let before = Summary::new(&TriMesh::new(positions.clone(), faces.clone()).unwrap());
        positions.push([100.0; 3]);
        let after = Summary::new(&TriMesh::new(positions, faces).unwrap());
        assert_eq!((before.reaches(), before.aabb()), (after.reaches(), after.aabb()));
        assert_eq!(after.vertices, before.vertices + 1);
    }
}
