//! The number of faces that a surface of some topology needs.

use super::connectivity::DynamicMesh;

/// A number of faces below which no manifold has the components of a surface, each with its genus.
///
/// # Definition
/// The sum over components. With `v` vertices a closed surface of Euler characteristic `x` has `2 (v - x)` faces, and no more than
/// `v (v - 1) / 2` edges, hence at least `(7 + sqrt(49 - 24 x)) / 2` vertices. A component with boundary counts for one face.
/// # Source
/// `heawood_map_1890`: the inequality between vertices and the Euler characteristic.
pub(super) fn least_faces(mesh: &DynamicMesh) -> usize {
    let mut seen: Vec<bool> = (0..mesh.positions.len() as u32).map(|v| !mesh.has_faces(v)).collect();
    let mut least = 0;
    for first in 0..seen.len() as u32 {
        if seen[first as usize] {
            continue;
        }
        seen[first as usize] = true;
        let (mut open, mut is_closed) = (vec![first], true);
        let (mut vertices, mut halfedges) = (0, 0);
        while let Some(v) = open.pop() {
            vertices += 1;
            halfedges += mesh.halfedges_from(v).count();
            is_closed &= !mesh.is_boundary(v);
            open.extend(mesh.neighbours(v).filter(|&w| !std::mem::replace(&mut seen[w as usize], true)));
        }
        least += if is_closed { of_closed(vertices, halfedges / 3) } else { 1 };
    }
    least
}

/// The least number of faces for the topology of a closed surface with these vertices and faces.
fn of_closed(vertices: usize, faces: usize) -> usize {
    // The characteristic `vertices - faces / 2` stays: with so many vertices fewer there are twice as many faces fewer.
    let with = |v: usize| faces - 2 * (vertices - v);
    let fits = |v: &usize| v * (v - 1) >= 3 * with(*v);
    (4..vertices).find(fits).map_or(faces, with)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::merge;
    use pompeiu_core::mesh::shapes::{Diagonal, grid, icosphere, torus};

    #[test]
    fn the_least_triangulations_that_are_known() {
        // Ringel, and Jungerman and Ringel: the bound is attained but for genus 2, where it is one vertex less.
        let known = [(2, 4), (0, 14), (-2, 22), (-4, 28), (-10, 44)];
        for (characteristic, faces) in known {
            let vertices = 1000;
            let many = usize::try_from(2 * (1000 - characteristic)).expect("not negative");
            assert_eq!(of_closed(vertices, many), faces, "{characteristic}");
        }
        let parts = [
            icosphere(1.0, 1).expect("a sphere"),
            torus(2.0, 0.5, 9, 7).expect("a torus"),
            grid([1.0, 1.0], [3, 3], Diagonal::Rising).expect("a grid"),
        ];
        let all = merge(&parts.iter().collect::<Vec<_>>()).expect("a mesh");
        let mesh = DynamicMesh::new(all.positions(), all.faces()).expect("a manifold");
        assert_eq!(least_faces(&mesh), 4 + 14 + 1);
    }
}
