//! Consistent orientation of faces that share edges.

use super::Change;
use super::parts::Parts;

/// Reverses faces of each component so that the two faces of every edge run along it in opposite directions; no edge may have more than
/// two faces. Reverses these or all others, what is fewer. Returns the faces that were reversed, and the components with one side only. In
/// these, neighbours still disagree where a breadth-first search met itself, or where they did before, if these are not more edges.
pub(super) fn orient(parts: &mut Parts) -> (Change, Change) {
    // The neighbours of each face, and whether exactly one of the pair must be reversed.
    let mut neighbours: Vec<[Option<(usize, bool)>; 3]> = vec![[None; 3]; parts.faces.len()];
    for edge in parts.edges().iter() {
        let mut faces = edge.faces();
        if let (Some(f), Some(g)) = (faces.next(), faces.next()) {
            let disagree = parts.run_alike(edge.ends, f, g);
            for (of, neighbour) in [(f, g), (g, f)] {
                if let Some(free) = neighbours[of].iter_mut().find(|place| place.is_none()) {
                    *free = Some((neighbour, disagree));
                }
            }
        }
    }
    let mut turned: Vec<Option<bool>> = vec![None; parts.faces.len()];
    let mut one_sided = Change::default();
    let mut component = Vec::new();
    for seed in 0..parts.faces.len() {
        if turned[seed].is_some() {
            continue;
        }
        turned[seed] = Some(false);
        component.clear();
        component.push(seed);
        let mut next = 0;
        while let Some(&face) = component.get(next) {
            next += 1;
            for (neighbour, disagree) in neighbours[face].into_iter().flatten() {
                if turned[neighbour].is_none() {
                    turned[neighbour] = turned[face].map(|turn| turn != disagree);
                    component.push(neighbour);
                }
            }
        }
        // Neighbours that disagree as they are, and once faces are turned.
        let (mut before, mut after) = (0, 0);
        for &face in &component {
            for (neighbour, disagree) in neighbours[face].into_iter().flatten() {
                before += usize::from(disagree);
                after += usize::from((turned[face] != turned[neighbour]) != disagree);
            }
        }
        if after > 0 {
            one_sided.add(parts.place(seed));
        }
        let turns = component.iter().filter(|&&face| turned[face] == Some(true)).count();
        let others = 2 * turns > component.len();
        for &face in &component {
            turned[face] = turned[face].map(|turn| before > after && turn != others);
        }
    }
    let places = (0..turned.len()).filter(|&f| turned[f] == Some(true)).map(|f| parts.place(f));
    let change = Change::of(places);
    for (face, _) in parts.faces.iter_mut().zip(&turned).filter(|(_, turn)| **turn == Some(true)) {
        face.swap(1, 2);
    }
    (change, one_sided)
}
