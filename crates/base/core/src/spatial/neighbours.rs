//! Which triangles of a tree share an edge.

use super::bvh::{Bvh, Slot};
use crate::mesh::{TriMesh, has_three_vertices};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};

/// A triangle across an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Neighbour {
    /// The triangle.
    pub slot: Slot,
    /// Its edge that is shared: edge `k` leads from corner `k` to the next.
    pub edge: usize,
    /// Whether both triangles run along the edge in the same direction, as where orientations disagree.
    pub same_direction: bool,
}

/// The neighbours of every triangle of a tree, edge by edge.
///
/// Edges are those of the mesh: two faces share one if they share its two vertices by index. There is no neighbour across an edge
/// with one face or more than two, nor across any edge of a face that repeats a vertex.
///
/// # Cost
/// 12 bytes per face; some 40 more per face while it is built in O(m) time (at bounded valence), on all threads of the current pool.
#[derive(Clone, Debug)]
pub struct Neighbours {
    /// Slot, direction and edge, packed; [`NONE`] where there is no neighbour.
    across: Vec<[u32; 3]>,
}

const NONE: u32 = u32::MAX;
/// Largest number of slots that fit beside the three bits for direction and edge.
const MOST_FACES: usize = (1 << 29) - 1;
/// Fewest faces per parallel part.
const PART: usize = 1 << 11;
/// So few threads take longer to sort edges by vertices than to meet all of them in each thread.
const FEW_THREADS: usize = 8;
/// Edges at a vertex that are compared one by one then.
const MOST_AT_VERTEX: usize = 64;
/// Up to this many uses at one vertex are compared pairwise; more are sorted.
const FEW: usize = 16;

impl Neighbours {
    /// Finds the neighbours among the triangles of a tree over a mesh; finds none in a mesh beyond 2^29 faces.
    pub fn new(mesh: &TriMesh, bvh: &Bvh) -> Self {
        let count = bvh.len();
        if count > MOST_FACES {
            return Self { across: Vec::new() };
        }
        let threads = rayon::current_num_threads();
        let across = if threads <= FEW_THREADS { as_they_come(mesh, bvh, threads) } else { None };
        if let Some(across) = across {
            return Self { across };
        }
        let (starts, uses) = uses_by_vertex(mesh, bvh);
        // Each edge is paired once, and each half of a pair written once.
        let across: Vec<[AtomicU32; 3]> =
            (0..count).into_par_iter().map(|_| [NONE; 3].map(AtomicU32::new)).collect();
        let write = |to: u32, from: u32, same: u32| {
            across[(to >> 3) as usize][(to & 3) as usize].store(from & !4 | same, Ordering::Relaxed);
        };
        starts.par_windows(2).with_min_len(PART).for_each_init(Vec::new, |group: &mut Vec<u64>, ends| {
            group.clear();
            let uses = &uses[ends[0] as usize..ends[1] as usize];
            group.extend(uses.iter().map(|used| used.load(Ordering::Relaxed)));
            pair(group, |p, q| {
                let same = u32::from((p ^ q) & 4 == 0) << 2;
                write(p, q, same);
                write(q, p, same);
            });
        });
        drop(uses);
        Self { across: across.into_par_iter().map(|edges| edges.map(AtomicU32::into_inner)).collect() }
    }

    /// The triangle across an edge of another, if there is exactly one.
    #[inline]
    pub fn across(&self, slot: Slot, edge: usize) -> Option<Neighbour> {
        let packed = self.across.get(slot.index())?[edge];
        (packed != NONE).then(|| Neighbour {
            slot: Slot::new(packed >> 3),
            edge: (packed & 3) as usize,
            same_direction: packed & 4 != 0,
        })
    }

    /// Bytes of memory held.
    pub fn bytes(&self) -> usize {
        self.across.capacity() * size_of::<[u32; 3]>()
    }
}

/// The edges of all triangles by lesser vertex, and where those of each vertex start. An edge is its greater vertex in the upper half,
/// and in the lower one its slot, whether it leads from the greater vertex to the lesser, and which edge of the triangle it is.
fn uses_by_vertex(mesh: &TriMesh, bvh: &Bvh) -> (Vec<u32>, Vec<AtomicU64>) {
    let uses_of = |slot: Slot| {
        let face = mesh.faces()[bvh.face(slot).index()];
        let valid = has_three_vertices(face);
        (0..3).filter(move |_| valid).map(move |k| {
            let (a, b) = (face[k], face[(k + 1) % 3]);
            let (lesser, greater, backward) = if a < b { (a, b, 0) } else { (b, a, 4) };
            (lesser as usize, u64::from(greater) << 32 | (slot.index() * 8 + backward + k) as u64)
        })
    };
    let slots: Vec<Slot> = bvh.slots().collect();
    let parts = (slots.len() / PART).clamp(1, rayon::current_num_threads());
    let parts: Vec<&[Slot]> = slots.chunks(slots.len().div_ceil(parts).max(1)).collect();
    // Counts the edges of each vertex in each part, then turns counts into the place of the next edge.
    let mut places: Vec<Vec<u32>> = parts
        .par_iter()
        .map(|slots| {
            let mut counts = vec![0; mesh.positions().len()];
            for (v, _) in slots.iter().flat_map(|slot| uses_of(*slot)) {
                counts[v] += 1;
            }
            counts
        })
        .collect();
    let mut total = 0;
    let mut starts = Vec::with_capacity(mesh.positions().len() + 1);
    for v in 0..mesh.positions().len() {
        starts.push(total);
        for places in &mut places {
            (places[v], total) = (total, total + places[v]);
        }
    }
    starts.push(total);
    let uses: Vec<AtomicU64> = (0..total).into_par_iter().map(|_| AtomicU64::new(0)).collect();
    parts.par_iter().zip(&mut places).for_each(|(slots, places)| {
        for (v, used) in slots.iter().flat_map(|slot| uses_of(*slot)) {
            uses[places[v] as usize].store(used, Ordering::Relaxed);
            places[v] += 1;
        }
    });
    (starts, uses)
}

/// An edge of a triangle, as it waits for the other triangle: its greater vertex, what [`Neighbours`] packs, and the edge before it at the same
/// lesser vertex.
#[derive(Clone, Copy)]
struct Waiting {
    greater: u32,
    packed: u32,
    before: u32,
}

/// The same, in one pass over all triangles in each thread, which pairs the edges of a range of lesser vertices; none where many edges
/// meet at a vertex.
fn as_they_come(mesh: &TriMesh, bvh: &Bvh, threads: usize) -> Option<Vec<[u32; 3]>> {
    let across: Vec<[AtomicU32; 3]> = bvh.slots().map(|_| [NONE; 3].map(AtomicU32::new)).collect();
    let count = mesh.positions().len();
    let parts = (bvh.len() / PART).clamp(1, threads);
    let all_paired = (0..parts)
        .into_par_iter()
        .with_max_len(1)
        .all(|part| pair_at(count * part / parts..count * (part + 1) / parts, mesh, bvh, &across));
    all_paired.then(|| across.into_iter().map(|edges| edges.map(AtomicU32::into_inner)).collect())
}

/// Pairs the edges whose lesser vertex is in a range. False where many edges meet at one of them.
fn pair_at(vertices: Range<usize>, mesh: &TriMesh, bvh: &Bvh, across: &[[AtomicU32; 3]]) -> bool {
    let mut last_at = vec![NONE; vertices.len()];
    // Of a closed surface half as many wait as there are edges of triangles.
    let mut waiting: Vec<Waiting> = Vec::with_capacity(3 * vertices.len() + 64);
    for slot in bvh.slots() {
        let face = mesh.faces()[bvh.face(slot).index()];
        if !has_three_vertices(face) {
            continue;
        }
        for (k, (a, b)) in
            [(face[0], face[1]), (face[1], face[2]), (face[2], face[0])].into_iter().enumerate()
        {
            let (lesser, greater, backward) = if a < b { (a, b, 0) } else { (b, a, 4) };
            // What is less than the start wraps around to a place beyond the end.
            let Some(last) = last_at.get_mut((lesser as usize).wrapping_sub(vertices.start)) else {
                continue;
            };
            let packed = (slot.index() * 8 + backward + k) as u32;
            let mut place = *last;
            let mut steps = 0;
            while place != NONE && waiting[place as usize].greater != greater {
                place = waiting[place as usize].before;
                steps += 1;
            }
            if steps > MOST_AT_VERTEX {
                return false;
            }
            if place == NONE {
                let before = std::mem::replace(last, waiting.len() as u32);
                waiting.push(Waiting { greater, packed, before });
                continue;
            }
            meet(&mut waiting[place as usize].packed, packed, across);
        }
    }
    true
}

/// Pairs the first use of an edge with another; where three meet none has a neighbour, and the first becomes [`NONE`].
fn meet(first: &mut u32, packed: u32, across: &[[AtomicU32; 3]]) {
    if *first == NONE {
        // More than three triangles at this edge.
        return;
    }
    let at = |packed: u32| &across[(packed >> 3) as usize][(packed & 3) as usize];
    let second = at(*first).load(Ordering::Relaxed);
    if second == NONE {
        let same = u32::from((*first ^ packed) & 4 == 0) << 2;
        at(*first).store(packed & !4 | same, Ordering::Relaxed);
        at(packed).store(*first & !4 | same, Ordering::Relaxed);
    } else {
        at(*first).store(NONE, Ordering::Relaxed);
        at(second).store(NONE, Ordering::Relaxed);
        *first = NONE;
    }
}

/// Reports each pair of uses of an edge that has exactly two.
fn pair(group: &mut [u64], mut tell: impl FnMut(u32, u32)) {
    let greater = |used: u64| used >> 32;
    if group.len() > FEW {
        group.sort_unstable();
        for edge in group.chunk_by(|p, q| greater(*p) == greater(*q)) {
            if let [p, q] = edge {
                tell(*p as u32, *q as u32);
            }
        }
        return;
    }
    for (i, p) in group.iter().enumerate() {
        let same = |q: &&u64| greater(**q) == greater(*p);
        let mut later = group[i + 1..].iter().filter(same);
        if let (Some(q), None) = (later.next(), later.next())
            && !group[..i].iter().any(|q| same(&q))
        {
            tell(*p as u32, *q as u32);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Aabb, Frame};
    use crate::mesh::shapes::{icosphere, torus};

    fn neighbours(mesh: &TriMesh) -> (Bvh, Neighbours) {
        let bvh = Bvh::build(mesh, &Frame::of(&Aabb::of_faces(mesh)));
        let neighbours = Neighbours::new(mesh, &bvh);
        (bvh, neighbours)
    }

    /// Compares with an exhaustive search over the edges of all faces.
    fn check(mesh: &TriMesh) -> usize {
        let (bvh, neighbours) = neighbours(mesh);
        let edge = |slot: Slot, k: usize| {
            let face = mesh.faces()[bvh.face(slot).index()];
            [face[k], face[(k + 1) % 3]]
        };
        let has_edges = |slot: Slot| (0..3).all(|k| edge(slot, k)[0] != edge(slot, k)[1]);
        let mut found = 0;
        for slot in bvh.slots() {
            for k in 0..3 {
                let [a, b] = edge(slot, k);
                let others: Vec<_> = bvh
                    .slots()
                    .filter(|s| *s != slot && has_edges(*s))
                    .flat_map(|s| (0..3).map(move |i| (s, i)))
                    .filter(|&(s, i)| edge(s, i) == [a, b] || edge(s, i) == [b, a])
                    .collect();
                let expected = match others[..] {
                    [(other, i)] if has_edges(slot) => {
                        Some(Neighbour { slot: other, edge: i, same_direction: edge(other, i) == [a, b] })
                    }
                    _ => None,
                };
                assert_eq!(neighbours.across(slot, k), expected, "{slot:?} {k}");
                found += usize::from(expected.is_some());
            }
        }
        found
    }

    /// Few threads and many find the same.
    #[test]
    fn one_pass_finds_what_many_threads_find() {
        let with = |threads: usize, mesh: &TriMesh| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| neighbours(mesh).1.across)
        };
        let fan = |count: u32| (0..count).map(|i| [0, 1 + i, 2 + i]).collect();
        let point = |i: u32| [f64::from(i).sin(), f64::from(i).cos(), f64::from(i % 7)];
        let mesh = |faces: Vec<[u32; 3]>| TriMesh::new((0..400).map(point).collect(), faces).unwrap();
        // Edges with one to five faces, in both directions, and faces that repeat a vertex; many faces at a vertex.
        let soup = (0..600_u32).map(|i| [i % 7, (i / 3) % 8, (i * i + 5) % 9]).collect();
        for mesh in [icosphere(1.0, 2).unwrap(), mesh(soup), mesh(fan(20)), mesh(fan(390))] {
            assert_eq!(with(1, &mesh), with(FEW_THREADS + 1, &mesh));
        }
    }

    #[test]
    fn closed_surfaces_have_three_neighbours_everywhere() {
        let sphere = icosphere(1.0, 2).unwrap();
        assert_eq!(check(&sphere), 3 * sphere.faces().len());
    }

    #[test]
    fn ends_fans_flips_and_degenerate_faces() {
        let points = (0..6).map(|i| [f64::from(i), f64::from(i * i), f64::from(i % 2)]).collect();
        let faces = vec![[0, 1, 2], [1, 2, 3], [3, 4, 2], [0, 1, 4], [1, 0, 5], [4, 4, 2], [5, 3, 4]];
        // 1-2, 2-3 and 3-4 are shared by two, the first in the same direction; 0-1 by three.
        assert_eq!(check(&TriMesh::new(points, faces).unwrap()), 6);
    }

    #[test]
    fn many_faces_around_a_vertex() {
        let points = (0..50).map(|i| [f64::from(i), f64::from(i * i), 1.0]).collect();
        let faces = (1..49).map(|i| [0, i, i + 1]).collect();
        assert_eq!(check(&TriMesh::new(points, faces).unwrap()), 2 * 47);
    }

    /// The number of parallel parts does not change the result.
    #[test]
    fn many_threads_find_the_same() {
        let mesh = torus(1.0, 0.25, 160, 80).unwrap();
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| neighbours(&mesh).1.across)
        };
        let one = with(1);
        for threads in [2, 5, FEW_THREADS, FEW_THREADS + 1] {
            assert_eq!(with(threads), one, "{threads}");
        }
    }
}
