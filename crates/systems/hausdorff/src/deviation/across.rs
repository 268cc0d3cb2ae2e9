//! Which faces of a mesh are neighbours across an edge, whether its vertices are welded or not.

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::first_at_position;
use rayon::prelude::*;
use std::ops::Range;

/// Fewest faces that are worth another thread, and the most threads: each looks at all faces.
const PART: usize = 1 << 12;
const MOST_PARTS: usize = 8;

/// Pairs of neighbours across edges; none unless the surface is closed and oriented: each edge is passed as often one way as the other.
pub(super) fn neighbours(mesh: &TriMesh) -> Option<Vec<[u32; 2]>> {
    let (pairs, is_closed) = pairs(mesh, &first_at_position(mesh.positions()));
    is_closed.then_some(pairs)
}

/// Pairs of neighbours across edges of two faces that pass them in opposite directions, by vertices, and whether the surface is closed and
/// oriented. `place` is that of each vertex ([`first_at_position`]).
pub(super) fn pairs(mesh: &TriMesh, place: &[u32]) -> (Vec<[u32; 2]>, bool) {
    let count = place.len();
    let parts = (mesh.faces().len() / PART).clamp(1, MOST_PARTS.min(rayon::current_num_threads()));
    let of_part = |part: usize| pairs_at(count * part / parts..count * (part + 1) / parts, mesh, place);
    let found: Vec<(Vec<[u32; 2]>, bool)> = (0..parts).into_par_iter().with_max_len(1).map(of_part).collect();
    let is_closed = found.iter().all(|(_, is_closed)| *is_closed);
    (found.into_iter().flat_map(|(pairs, _)| pairs).collect(), is_closed)
}

/// An edge of a face, which leads to its greater vertex or from it.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Half {
    greater: u32,
    face: u32,
    leads_up: bool,
}

/// The same of edges whose lesser vertex is in a range.
fn pairs_at(vertices: Range<usize>, mesh: &TriMesh, place: &[u32]) -> (Vec<[u32; 2]>, bool) {
    let first = vertices.start as u32;
    let is_here = |lesser: u32| vertices.contains(&(lesser as usize));
    let halves = || {
        mesh.faces().iter().zip(0..).flat_map(|(corners, face)| {
            let [a, b, c] = corners.map(|v| place[v as usize]);
            [(a, b), (b, c), (c, a)].into_iter().filter(|(from, to)| from != to).map(move |(from, to)| {
                (from.min(to), Half { greater: from.max(to), face, leads_up: from < to })
            })
        })
    };
    // Where the edges of each vertex begin, once they have been counted; while they are filled in, where the next one goes.
    let mut starts = vec![0_usize; vertices.len() + 1];
    for (lesser, _) in halves().filter(|(lesser, _)| is_here(*lesser)) {
        starts[(lesser - first) as usize + 1] += 1;
    }
    for v in 1..starts.len() {
        starts[v] += starts[v - 1];
    }
    let mut uses = vec![Half::default(); starts.last().copied().unwrap_or(0)];
    for (lesser, half) in halves().filter(|(lesser, _)| is_here(*lesser)) {
        let next = &mut starts[(lesser - first) as usize];
        uses[*next] = half;
        *next += 1;
    }
    let mut pairs = Vec::with_capacity(uses.len() / 2);
    let mut is_closed = true;
    let mut start = 0;
    for end in starts.into_iter().take(vertices.len()) {
        let at_vertex = &mut uses[start..end];
        start = end;
        at_vertex.sort_unstable();
        for edge in at_vertex.chunk_by(|x, y| x.greater == y.greater) {
            let is_balanced = 2 * edge.iter().filter(|half| half.leads_up).count() == edge.len();
            is_closed &= is_balanced;
            if let ([one, two], true) = (edge, is_balanced) {
                pairs.push([one.face, two.face]);
            }
        }
    }
    (pairs, is_closed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::{icosphere, torus};
    use pompeiu_core::mesh::unweld;

    /// By a table of all edges.
    fn plainly(mesh: &TriMesh) -> (Vec<[u32; 2]>, bool) {
        let place = first_at_position(mesh.positions());
        let mut edges = std::collections::BTreeMap::<[u32; 2], Vec<(u32, bool)>>::new();
        for (face, corners) in (0..).zip(mesh.faces()) {
            for k in 0..3 {
                let (from, to) = (place[corners[k] as usize], place[corners[(k + 1) % 3] as usize]);
                if from != to {
                    edges.entry([from.min(to), from.max(to)]).or_default().push((face, from < to));
                }
            }
        }
        let is_balanced =
            |uses: &&Vec<(u32, bool)>| 2 * uses.iter().filter(|(_, up)| *up).count() == uses.len();
        let pairs = edges.values().filter(|uses| uses.len() == 2).filter(is_balanced);
        (pairs.map(|uses| [uses[0].0, uses[1].0]).collect(), edges.values().all(|uses| is_balanced(&uses)))
    }

    /// Closed or not, welded or not, with faces turned, edges of four faces and faces that repeat a vertex; at any number of threads.
    #[test]
    fn pairs_are_those_of_a_table_of_edges() {
        let ball = icosphere(1.0, 5).unwrap();
        let with = |faces: Vec<[u32; 3]>| TriMesh::new(ball.positions().to_vec(), faces).unwrap();
        let faces = ball.faces().to_vec();
        let turned =
            faces.iter().zip(0..).map(|([a, b, c], i)| if i % 97 == 0 { [*b, *a, *c] } else { [*a, *b, *c] });
        let doubled = [&faces[..], &faces[..50]].concat();
        let thin = [&faces[..], &[[3, 3, 7], [5, 5, 5]]].concat();
        let meshes = [
            (ball.clone(), true),
            (unweld(&ball).unwrap(), true),
            (torus(1.0, 0.3, 160, 80).unwrap(), true),
            (with(turned.collect()), false),
            (with(faces[1..].to_vec()), false),
            (with(doubled), false),
            (with(thin), true),
        ];
        for (mesh, is_closed) in meshes {
            let expected = plainly(&mesh);
            assert_eq!(expected.1, is_closed);
            for threads in [1, 3] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let found = pool.install(|| pairs(&mesh, &first_at_position(mesh.positions())));
                assert!(found == expected, "{} faces, {threads} threads", mesh.faces().len());
            }
        }
    }
}
