//! Triangles for boundary loops.

use super::Change;
use super::parts::Parts;
use crate::mesh::topology::is_degenerate;

/// What was done about holes.
#[derive(Default)]
pub(super) struct Holes {
    pub(super) filled: Change,
    /// Loops below the size limit that have no valid triangulation.
    pub(super) left: Change,
    pub(super) faces_added: usize,
}

/// Fills boundary loops of at most this many edges with the triangulation of least area among those without degenerate faces and
/// without edges that exist already. Afterwards no edge has more than two faces, and no vertex more than one fan.
///
/// # Source
/// `barequet_filling_1995`, section 3.
pub(super) fn fill(parts: &mut Parts, most_edges: usize) -> Holes {
    let mut filled = Holes::default();
    if most_edges < 3 {
        return filled;
    }
    // Existing edges, and the direction that a new face must take along each: opposite to the face at the boundary edge.
    let mut taken: Vec<[u32; 2]> = Vec::new();
    let mut next: Vec<Vec<u32>> = vec![Vec::new(); parts.positions.len()];
    for edge in parts.edges().iter() {
        taken.push(edge.ends);
        let mut faces = edge.faces();
        if let (Some(face), None) = (faces.next(), faces.next()) {
            let [low, high] = edge.ends;
            let [from, to] = if parts.runs(face, edge.ends) { [high, low] } else { [low, high] };
            next[from as usize].push(to);
        }
    }
    let mut walked = vec![false; next.len()];
    for start in 0..next.len() {
        if walked[start] || next[start].is_empty() {
            continue;
        }
        let Some(hole) = walk(start as u32, &next, &mut walked, most_edges) else { continue };
        let place = parts.positions[start];
        match least_area(parts, &hole, &taken) {
            Some(triangles) => {
                filled.filled.add(place);
                filled.faces_added += triangles.len();
                let inner = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
                taken.extend(inner.map(|[a, b]| [a.min(b), a.max(b)]));
                taken.sort_unstable();
                taken.dedup();
                parts.faces.extend(triangles);
            }
            None => filled.left.add(place),
        }
    }
    filled
}

/// The vertices of a boundary loop; `None` if the loop branches, or has too many edges.
fn walk(start: u32, next: &[Vec<u32>], walked: &mut [bool], most: usize) -> Option<Vec<u32>> {
    let mut hole = vec![start];
    let mut is_simple = true;
    loop {
        let at = hole[hole.len() - 1];
        walked[at as usize] = true;
        // In a component with one side only, boundary edges may have opposite directions.
        let &[to] = &next[at as usize][..] else { return None };
        if to == start {
            break;
        }
        if walked[to as usize] {
            is_simple = false;
            break;
        }
        hole.push(to);
    }
    (is_simple && (3..=most).contains(&hole.len())).then_some(hole)
}

/// The triangulation of a loop with the least area: dynamic programming over stretches of the loop and their third corner.
fn least_area(parts: &Parts, hole: &[u32], taken: &[[u32; 2]]) -> Option<Vec<[u32; 3]>> {
    let n = hole.len();
    let position = |i: usize| parts.positions[hole[i] as usize];
    // Coordinates in units of the loop's size, so that squares neither overflow nor underflow.
    let size = (1..n).flat_map(|i| [0, 1, 2].map(|k| (position(i)[k] - position(0)[k]).abs()));
    let size = size.fold(0.0, |m: f64, x| if x > m { x } else { m });
    let scaled: Vec<[f64; 3]> =
        (0..n).map(|i| [0, 1, 2].map(|k| (position(i)[k] - position(0)[k]) / size)).collect();
    let is_free = |i: usize, j: usize| {
        let ends = [hole[i].min(hole[j]), hole[i].max(hole[j])];
        j == i + 1 || (i == 0 && j == n - 1) || taken.binary_search(&ends).is_err()
    };
    // For i < j: the least area of a triangulation between the loop from i to j and the edge that closes it, with the third corner
    // at that edge.
    let mut best = vec![(f64::INFINITY, 0); n * n];
    for i in 0..n - 1 {
        best[i * n + i + 1] = (0.0, 0);
    }
    for length in 2..n {
        for i in 0..n - length {
            let j = i + length;
            if !is_free(i, j) {
                continue;
            }
            for k in i + 1..j {
                let parts_area = best[i * n + k].0 + best[k * n + j].0;
                if parts_area >= best[i * n + j].0 || is_degenerate([position(i), position(k), position(j)]) {
                    continue;
                }
                let area = parts_area + doubled_area([scaled[i], scaled[k], scaled[j]]);
                if area < best[i * n + j].0 {
                    best[i * n + j] = (area, k);
                }
            }
        }
    }
    // The boundary of an isolated face is the face itself: filling it would duplicate it.
    let is_face = n == 3 && parts.faces.iter().any(|face| hole.iter().all(|v| face.contains(v)));
    if is_face || !best[n - 1].0.is_finite() {
        return None;
    }
    let mut triangles = Vec::with_capacity(n - 2);
    let mut open = vec![[0, n - 1]];
    while let Some([i, j]) = open.pop() {
        if j > i + 1 {
            let k = best[i * n + j].1;
            triangles.push([hole[i], hole[k], hole[j]]);
            open.extend([[i, k], [k, j]]);
        }
    }
    Some(triangles)
}

fn doubled_area([a, b, c]: [[f64; 3]; 3]) -> f64 {
    let u = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    let v = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt()
}
