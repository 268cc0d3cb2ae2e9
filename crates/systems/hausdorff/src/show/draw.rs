//! What of a surface is drawn: triangles with distances at their corners, as many as a page or a picture can show.
//!
//! Between the corners distances are drawn linear. They are sampled on edges and inside faces, and faces where they bend by more than a
//! tolerance are drawn in parts: this is for the eye, and proves nothing. A mesh with more faces than can be drawn is drawn by groups of
//! them, each with the enclosure of the largest distance of all its faces. Coordinates and distances are rounded to what can be seen, which
//! makes pages short.

use super::group::Groups;
use super::signs;
use super::snap::{Snap, rounded};
use super::triangles::{Triangles, Vertices};
use crate::PreparedPair;
use crate::deviation::DirectedDeviation;
use crate::deviation::frame_of;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::run::{Control, Limits};
use pompeiu_core::spatial::{Bvh, Slot, Workspace, morton_order};
use pompeiu_core::{FaceId, TriMesh};
use pompeiu_figures::page::Bounds;
use rayon::prelude::*;

/// What is drawn of a surface.
pub(super) struct Drawing {
    /// Triangles with the distances at their corners; their faces are numbers of groups where faces are drawn by groups.
    pub(super) triangles: Triangles,
    /// The group of each face; none where faces are drawn one by one.
    pub(super) groups: Option<Vec<u32>>,
    /// For each face or group, an enclosure of its largest distance.
    pub(super) bounds: Vec<Bounds>,
}

/// What a drawing is to be.
#[derive(Clone, Copy)]
pub(super) struct Style {
    /// By how much drawn distances may be off between corners, as far as samples tell.
    pub(super) tolerance: f64,
    /// Triangles at most.
    pub(super) most: usize,
}

/// Parts of an edge at most.
const MOST_PARTS: u32 = 64;
/// Faces of a task.
const TASK: usize = 512;
/// Edges of which the distance in the middle is kept, and an odd number that spreads them.
const EDGES: usize = 1024;
const SPREAD: u32 = 0x9e37_79b1;

impl Drawing {
    /// Draws what was measured of a pair in one direction. Limits end sampling: then faces are drawn whole.
    pub(super) fn new(
        found: &DirectedDeviation,
        pair: &PreparedPair<'_>,
        style: Style,
        limits: &Limits,
    ) -> Self {
        let mesh = pair.measured(found.direction);
        let snap = Snap::new(mesh, style.tolerance);
        if mesh.faces().len() > style.most {
            let groups = Groups::new(found, mesh, style.most);
            let (triangles, bounds) = groups.drawn(found, mesh, &snap);
            return Self { triangles, groups: Some(groups.of_faces), bounds };
        }
        let sampled = Sampler::sampled(found, pair, style, limits);
        let mut triangles = Triangles::with_capacity(mesh);
        let mut is_part = Vec::with_capacity(mesh.faces().len());
        let mut vertices = Vertices::of(mesh);
        for (face, parts) in mesh.face_ids().zip(sampled) {
            is_part.resize(triangles.len() + parts.as_ref().map_or(1, Grid::triangles), parts.is_some());
            if let Some(grid) = parts {
                grid.push(face, mesh.corners(face).map(|p| snap.position(p)), &snap, &mut triangles);
            } else {
                let at = mesh.faces()[face.index()];
                let corners = at.map(|v| vertices.place(v, &mut triangles, |p| snap.position(p)));
                triangles.push(face.0, corners, at.map(|v| snap.distance(found.vertices[v as usize])));
            }
        }
        if let Some(sides) = &found.sides {
            signs::give(&mut triangles, &is_part, (found, sides), pair, &snap);
        }
        let bounds = found.faces.iter().map(|face| rounded([face.max.lower(), face.max.upper()])).collect();
        Self { triangles, groups: None, bounds }
    }
}

/// Distances on a face at the points of a triangular grid, row by row from the first corner on.
struct Grid {
    parts: u32,
    distances: Vec<f64>,
}

impl Grid {
    fn triangles(&self) -> usize {
        (self.parts * self.parts) as usize
    }

    /// Weights of the second and the third corner at each point.
    fn weights(parts: u32) -> impl Iterator<Item = [f64; 2]> {
        let step = 1.0 / f64::from(parts);
        (0..=parts).flat_map(move |i| (0..=i).map(move |j| [f64::from(i - j) * step, f64::from(j) * step]))
    }

    /// The distance at a place of a grid with other parts, if it is a place of this one.
    fn at(&self, place: [u32; 2], parts: u32) -> Option<f64> {
        let [i, j] = place.map(|k| k * self.parts);
        if i % parts != 0 || j % parts != 0 {
            return None;
        }
        let (i, j) = (i / parts, j / parts);
        Some(self.distances[(i * (i + 1) / 2 + j) as usize])
    }

    /// Adds the triangles of the grid. Points are exact where the number of parts is a power of two and corners are rounded, so that they
    /// lie on the edges of neighbours.
    fn push(&self, face: FaceId, corners: [[f64; 3]; 3], snap: &Snap, triangles: &mut Triangles) {
        let first = triangles.positions.len() as u32;
        triangles.positions.extend(Self::weights(self.parts).map(|weights| between(corners, weights)));
        let distances: Vec<f64> = self.distances.iter().map(|distance| snap.distance(*distance)).collect();
        let place = |i: u32, j: u32| i * (i + 1) / 2 + j;
        let mut push = |places: [u32; 3]| {
            triangles.push(face.0, places.map(|at| first + at), places.map(|at| distances[at as usize]));
        };
        for i in 0..self.parts {
            for j in 0..=i {
                push([place(i, j), place(i + 1, j), place(i + 1, j + 1)]);
                if j < i {
                    push([place(i, j), place(i + 1, j + 1), place(i, j + 1)]);
                }
            }
        }
    }
}

/// The point of a triangle with these weights of the second and the third corner.
fn between([a, b, c]: [[f64; 3]; 3], [v, w]: [f64; 2]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] + v * (b[k] - a[k]) + w * (c[k] - a[k]))
}

/// Into how many parts the edges of a face are cut of which the distance bends by so much: halving the parts quarters the bend of a smooth
/// function.
fn parts(bend: f64, tolerance: f64, first: u32) -> u32 {
    if bend > tolerance {
        ((bend / tolerance).sqrt().ceil() as u32).clamp(first, MOST_PARTS).next_power_of_two()
    } else {
        1
    }
}

/// The tolerance, doubled until it takes no more triangles than there is room for: faces are drawn coarser everywhere, not some as wanted
/// and others whole. It is not so far below the largest bend that no parts would do.
fn within(tolerance: f64, room: usize, bends: &[f64], first: u32) -> f64 {
    let largest = bends.iter().copied().fold(0.0, f64::max);
    let mut tolerance = tolerance.max(largest / f64::from(MOST_PARTS * MOST_PARTS));
    let more = |tolerance| {
        bends.iter().map(|bend| parts(*bend, tolerance, first).pow(2) as usize - 1).sum::<usize>()
    };
    while more(tolerance) > room {
        tolerance *= 2.0;
    }
    tolerance
}

/// The value at the corner with these weights, if they are those of a corner.
fn at_corner(weights: [f64; 2], values: [f64; 3]) -> Option<f64> {
    let corner = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].iter().position(|corner| *corner == weights)?;
    Some(values[corner])
}

/// Measures distances at points of faces.
struct Sampler<'s> {
    found: &'s DirectedDeviation,
    mesh: &'s TriMesh,
    frame: Frame,
    bvh: &'s Bvh,
    control: &'s Control,
    tolerance: f64,
}

impl Sampler<'_> {
    /// For each face a grid of distances where the face is drawn in parts.
    fn sampled(
        found: &DirectedDeviation,
        pair: &PreparedPair<'_>,
        Style { tolerance, most }: Style,
        limits: &Limits,
    ) -> Vec<Option<Grid>> {
        let control = Control::start(limits);
        let (mesh, other) = (pair.measured(found.direction), pair.other(found.direction));
        let count = mesh.faces().len();
        let mut grids: Vec<Option<Grid>> = std::iter::repeat_with(|| None).take(count).collect();
        let (frame, ..) = frame_of(mesh, other);
        control.check_memory(crate::engine::bytes_to_start(mesh, other));
        let Some(target) = pair.target_unless_stopped(found.direction, frame, &control) else { return grids };
        let sampler = Sampler { found, mesh, frame, bvh: target.bvh(), control: &control, tolerance };
        let order = morton_order(mesh, &Aabb::of_faces(mesh));
        // Large faces are looked at in more places.
        let first = ((most / count) as f64).sqrt() as u32;
        let first = (1_u32 << (first.max(2).ilog2())).min(MOST_PARTS);
        let bends = sampler.each(&order, |face, near| Some((*face, sampler.bend(*face, first, near)?)));
        let bent: Vec<(u32, (f64, Grid))> = bends.into_iter().flatten().collect();
        let each: Vec<f64> = bent.iter().map(|(_, (bend, _))| *bend).collect();
        let tolerance = within(tolerance, most - count, &each, first);
        let chosen: Vec<(u32, u32, Grid)> = bent
            .into_iter()
            .map(|(face, (bend, grid))| (face, parts(bend, tolerance, first), grid))
            .filter(|(_, parts, _)| *parts > 1)
            .collect();
        let made =
            sampler.each(&chosen, |(face, parts, before), near| sampler.grid(*face, *parts, before, near));
        for ((face, ..), grid) in chosen.iter().zip(made) {
            grids[*face as usize] = grid;
        }
        grids
    }

    /// Does something for each face, in this order: neighbours should follow each other.
    fn each<F: Sync, R: Send>(&self, faces: &[F], look: impl Fn(&F, &mut Near) -> R + Sync) -> Vec<R> {
        let of_task = |task: &[F]| {
            let (workspace, hint) = (Workspace::default(), self.bvh.any_slot());
            let mut near = Near { workspace, hint, edges: vec![([u32::MAX; 2], 0.0); EDGES] };
            task.iter().map(|face| look(face, &mut near)).collect::<Vec<_>>()
        };
        faces.par_chunks(TASK).flat_map_iter(of_task).collect()
    }

    fn at_corners(&self, face: u32) -> [f64; 3] {
        self.mesh.faces()[face as usize].map(|v| self.found.vertices[v as usize])
    }

    /// Distances at the points of a grid, if they are farther from linear than the tolerance, and how far; none where they are known to be
    /// nearly constant.
    fn bend(&self, face: u32, parts: u32, near: &mut Near) -> Option<(f64, Grid)> {
        let bounds = &self.found.faces[face as usize];
        if bounds.max.upper() - bounds.min.lower() <= self.tolerance || self.control.is_stopped() {
            return None;
        }
        let at_corners @ [a, b, c] = self.at_corners(face);
        let corners = self.mesh.corners(FaceId(face));
        let distance = |weights: [f64; 2]| {
            at_corner(weights, at_corners).unwrap_or_else(|| {
                let point = between(corners, weights);
                if parts == 2 { self.amid(face, weights, point, near) } else { self.distance(point, near) }
            })
        };
        let distances: Vec<f64> = Grid::weights(parts).map(distance).collect();
        let off = |([v, w], distance): ([f64; 2], &f64)| (distance - (a + v * (b - a) + w * (c - a))).abs();
        let bend = Grid::weights(parts)
            .zip(&distances)
            .map(off)
            .fold(0.0, |most, off| if off > most { off } else { most });
        (bend > self.tolerance).then_some((bend, Grid { parts, distances }))
    }

    /// A grid with other parts; where it has the points of the one before, their distances are known.
    fn grid(&self, face: u32, parts: u32, before: &Grid, near: &mut Near) -> Option<Grid> {
        if self.control.is_stopped() {
            return None;
        }
        let corners = self.mesh.corners(FaceId(face));
        let places = (0..=parts).flat_map(|i| (0..=i).map(move |j| [i, j]));
        let distances = Grid::weights(parts).zip(places).map(|(weights, place)| {
            before.at(place, parts).unwrap_or_else(|| self.distance(between(corners, weights), near))
        });
        Some(Grid { parts, distances: distances.collect() })
    }

    /// The distance in the middle of an edge, which two faces ask for.
    fn amid(&self, face: u32, weights: [f64; 2], point: [f64; 3], near: &mut Near) -> f64 {
        let [a, b, c] = self.mesh.faces()[face as usize];
        let [v, w] = match weights {
            [_, 0.0] => [a, b],
            [0.0, _] => [a, c],
            _ => [b, c],
        };
        let edge = [v.min(w), v.max(w)];
        let place = edge[0].wrapping_mul(SPREAD).wrapping_add(edge[1]) as usize % EDGES;
        if near.edges[place].0 != edge {
            near.edges[place] = (edge, self.distance(point, near));
        }
        near.edges[place].1
    }

    fn distance(&self, point: [f64; 3], near: &mut Near) -> f64 {
        let nearest = self.bvh.nearest(self.frame.map(point), near.hint, &mut near.workspace);
        near.hint = nearest.slot;
        self.frame.length_out(nearest.distance_sq.sqrt())
    }
}

/// What is kept from face to face of a task.
struct Near {
    workspace: Workspace,
    hint: Slot,
    /// The distance in the middle of the last edge with each remainder.
    edges: Vec<([u32; 2], f64)>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DeviationOptions;
    use pompeiu_core::mesh::displace_at_random;
    use pompeiu_core::mesh::shapes::{cube, icosphere};

    fn drawn(a: &TriMesh, b: &TriMesh, tolerance: f64, most: usize) -> (Drawing, DirectedDeviation) {
        let pair = PreparedPair::new(a, b);
        let found = DeviationOptions::default().symmetric_of(&pair).unwrap().a_to_b;
        (Drawing::new(&found, &pair, Style { tolerance, most }, &Limits::default()), found)
    }

    fn area([a, b, c]: [[f64; 3]; 3]) -> f64 {
        let [a, b, c] = [a, b, c].map(glam::DVec3::from_array);
        0.5 * (b - a).cross(c - a).length()
    }

    /// Where there is room for few triangles only, all faces are drawn coarser; and a tolerance of zero ends.
    #[test]
    fn what_there_is_no_room_for_is_drawn_coarser_everywhere() {
        let bends = [1.0, 1.0, 0.9, 0.0];
        assert_eq!(within(0.01, 10_000, &bends, 2), 0.01);
        let coarser = within(0.01, 100, &bends, 2);
        assert_eq!(bends.map(|bend| parts(bend, coarser, 2)), [4, 4, 4, 1]);
        assert_eq!(within(0.0, 10_000_000, &bends, 2), 1.0 / 4096.0);
        assert!(within(0.0, 2, &bends, 2) >= 1.0);
    }

    #[test]
    fn bounds_are_rounded_outwards() {
        for x in [0.0, 1.0, 0.1, 1e-300, 123.456, f64::MIN_POSITIVE / 2.0] {
            let [low, high] = rounded([x, x]);
            assert!(low <= x && x <= high && high - low <= x * 3e-4 + 1e-300, "{x} {low} {high}");
        }
    }

    /// The drawing covers the surface, and shows distances within the tolerance at other points than those that were sampled.
    #[test]
    fn faces_are_cut_where_distances_bend() {
        let (a, b) = (cube(2.0, 1).unwrap(), icosphere(1.0, 3).unwrap());
        let (drawing, _) = drawn(&a, &b, 0.01, 20_000);
        let whole: f64 = drawing.triangles.iter().map(|(corners, _)| area(corners)).sum();
        assert!((whole - 24.0).abs() < 1e-3 && drawing.triangles.len() > 1000);
        assert!(drawing.triangles.len() <= 20_000);
        for (corners, distances) in drawing.triangles.iter() {
            let centre = [0, 1, 2].map(|k| corners.iter().map(|p| p[k] / 3.0).sum::<f64>());
            let shown = distances.iter().sum::<f64>() / 3.0;
            let d = b.face_ids().map(|f| {
                let [x, y, z] = b.corners(f);
                pompeiu_core::geom::point_triangle::distance_sq(centre, x, y, z).sqrt()
            });
            let d = d.fold(f64::INFINITY, f64::min);
            assert!((d - shown).abs() <= 0.015, "{d} {shown}");
        }
        // Nothing bends between two spheres with the same faces.
        let (drawing, _) = drawn(&icosphere(1.0, 2).unwrap(), &icosphere(2.0, 2).unwrap(), 0.5, 20_000);
        assert_eq!(drawing.triangles.len(), 320);
    }

    /// Without time faces stay whole, as far as vertices are known.
    #[test]
    fn limits_end_sampling() {
        let (a, b) = (cube(2.0, 1).unwrap(), icosphere(1.0, 3).unwrap());
        let pair = PreparedPair::new(&a, &b);
        let found = DeviationOptions::default().symmetric_of(&pair).unwrap().a_to_b;
        let limits = Limits { time: Some(std::time::Duration::ZERO), ..Limits::default() };
        let drawing = Drawing::new(&found, &pair, Style { tolerance: 0.01, most: 20_000 }, &limits);
        assert_eq!(drawing.triangles.len(), a.faces().len());
    }

    /// Groups are as few as asked, hold every face, and enclose the largest distance of each.
    #[test]
    fn many_faces_are_drawn_by_groups() {
        let b = icosphere(1.0, 4).unwrap();
        let a = displace_at_random(&icosphere(1.0, 5).unwrap(), 0.01, 7).unwrap();
        let (drawing, found) = drawn(&a, &b, 1e-4, 3000);
        assert!(drawing.triangles.len() <= 3000 && drawing.triangles.len() > 500);
        let groups = drawing.groups.unwrap();
        assert_eq!(groups.len(), a.faces().len());
        for (group, face) in groups.iter().zip(&found.faces) {
            let [lower, upper] = drawing.bounds[*group as usize];
            assert!(face.max.upper() <= upper && lower <= upper);
        }
        let most = drawing.bounds.iter().map(|bounds| bounds[0]).fold(0.0, f64::max);
        assert!(most >= found.distance.distance.lower() * (1.0 - 1e-3), "the worst place is drawn");
        assert!(drawing.triangles.faces.iter().all(|face| (*face as usize) < drawing.bounds.len()));
    }
}
