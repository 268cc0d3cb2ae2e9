//! Reordering.

use super::random::Random;
use crate::mesh::TriMesh;

/// Puts the faces in a random order and starts each at a random corner; the surface and its orientation stay.
pub fn shuffle(mesh: &TriMesh, seed: u64) -> TriMesh {
    let mut random = Random::new(seed);
    let mut faces = mesh.faces().to_vec();
    for i in (1..faces.len()).rev() {
        faces.swap(i, random.below(i as u32 + 1) as usize);
    }
    for face in &mut faces {
        face.rotate_left(random.below(3) as usize);
    }
    TriMesh::from_valid(mesh.positions().to_vec(), faces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::icosphere;

    #[test]
    fn the_faces_are_the_same_up_to_order_and_first_corner() {
        let mesh = icosphere(1.0, 2).unwrap();
        let shuffled = shuffle(&mesh, 3);
        let vertices = |face: &[u32; 3]| face.iter().copied().collect::<std::collections::BTreeSet<_>>();
        let stayed =
            mesh.faces().iter().zip(shuffled.faces()).filter(|(a, b)| vertices(a) == vertices(b)).count();
        assert!(stayed < 10, "{stayed} of 320 faces stayed");
        let sorted = |mesh: &TriMesh| {
            let mut faces = mesh.faces().to_vec();
            for face in &mut faces {
                let least = (0..3).min_by_key(|&i| face[i]).unwrap();
                face.rotate_left(least);
            }
            faces.sort_unstable();
            faces
        };
        assert_eq!(sorted(&shuffled), sorted(&mesh));
        assert_eq!(shuffled, shuffle(&mesh, 3));
        assert_ne!(shuffled, shuffle(&mesh, 4));
    }
}
