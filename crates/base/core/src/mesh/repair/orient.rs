//! Consistent orientation of faces that share edges.

use super::Change;
use super::parts::Parts;

/// Reverses the fewest faces of each component so that the two faces of every edge run along it in opposite directions; no edge may
/// have more than two faces. Returns the faces that were reversed, and the components that are not orientable, which stay
/// unchanged.
pub(super) fn orient(parts: &mut Parts) -> (Change, Change) {
    let runs_up = |face: usize, ends: [u32; 2]| {
        let [a, b, c] = parts.faces[face];
        [[a, b], [b, c], [c, a]].contains(&ends)
    };
    // The neighbours of each face, and whether exactly one of the pair must be reversed.
    let mut neighbours: Vec<[Option<(usize, bool)>; 3]> = vec![[None; 3]; parts.faces.len()];
    for edge in parts.edges().iter() {
        let mut faces = edge.faces();
        if let (Some(f), Some(g)) = (faces.next(), faces.next()) {
            let disagree = runs_up(f, edge.ends) == runs_up(g, edge.ends);
            for (of, neighbour) in [(f, g), (g, f)] {
                if let Some(free) = neighbours[of].iter_mut().find(|place| place.is_none()) {
                    *free = Some((neighbour, disagree));
                }
            }
        }
    }
    let mut turned: Vec<Option<bool>> = vec![None; parts.faces.len()];
    let mut non_orientable = Change::default();
    let mut component = Vec::new();
    for seed in 0..parts.faces.len() {
        if turned[seed].is_some() {
            continue;
        }
        turned[seed] = Some(false);
        component.clear();
        component.push(seed);
        let (mut next, mut agree) = (0, true);
        while let Some(&face) = component.get(next) {
            next += 1;
            for (neighbour, disagree) in neighbours[face].into_iter().flatten() {
                let wanted = turned[face].map(|turn| turn != disagree);
                if turned[neighbour].is_none() {
                    turned[neighbour] = wanted;
                    component.push(neighbour);
                }
                agree &= turned[neighbour] == wanted;
            }
        }
        let turns = component.iter().filter(|&&face| turned[face] == Some(true)).count();
        if !agree {
            non_orientable.add(parts.place(seed));
        }
        for &face in &component {
            turned[face] = turned[face].map(|turn| agree && turn != (2 * turns > component.len()));
        }
    }
    let places = (0..turned.len()).filter(|&f| turned[f] == Some(true)).map(|f| parts.place(f));
    let change = Change::of(places);
    for (face, _) in parts.faces.iter_mut().zip(&turned).filter(|(_, turn)| **turn == Some(true)) {
        face.swap(1, 2);
    }
    (change, non_orientable)
}
