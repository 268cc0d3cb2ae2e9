//! A triangulation around a flat disk that keeps its outline from crossing itself.

use crate::pack::bounds;
use pompeiu_surface::plane::{Vec2, cross, sub};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Size of the box around the disk, relative to the bounding box of the disk.
const BOX: f64 = 1.5;

/// Smallest area of a scaffold triangle, relative to the box.
const LEAST_AREA: f64 = 1e-14;

/// Points on each side of the box.
const PER_SIDE: usize = 6;

/// The triangulation between an outline and a box around it.
#[derive(Clone, Debug)]
pub(crate) struct Scaffold {
    /// Triangles; vertices from `first` on are those on the box.
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) on_box: Vec<Vec2>,
}

impl Scaffold {
    /// Triangulates the region between an outline and a box, without inner vertices. All outline segments are edges; vertices on
    /// the box are numbered after the given positions. `None` unless the outline is simple.
    ///
    /// # Source
    /// `jiang_simplicial_2017`; the constrained Delaunay triangulation is that of the crate `spade`.
    pub(crate) fn around(outline: &[[u32; 2]], places: &[Vec2]) -> Option<Self> {
        let vertices: Vec<u32> = outline.iter().map(|&[v, _]| v).collect();
        let on_outline: Vec<Vec2> = vertices.iter().map(|&v| places[v as usize]).collect();
        let [lower, upper] = bounds(&on_outline);
        let middle = [0, 1].map(|k| 0.5 * (lower[k] + upper[k]));
        let half = [0, 1].map(|k| 0.5 * BOX * (upper[k] - lower[k]));
        // The margin also applies along the shorter side.
        let longer = half[0].max(half[1]);
        let half = half.map(|x| x.max(longer / 3.0));
        let on_box = box_points(middle, half);
        let mut numbers = vertices.clone();
        numbers.extend((0..on_box.len()).map(|k| (places.len() + k) as u32));
        let mut local = std::collections::BTreeMap::new();
        for (i, &v) in vertices.iter().enumerate() {
            local.insert(v, i);
        }
        let points = on_outline.iter().chain(&on_box);
        let points: Vec<Point2<f64>> = points.map(|&[x, y]| Point2::new(x, y)).collect();
        let sides =
            outline.iter().map(|&[a, b]| Some([*local.get(&a)?, *local.get(&b)?])).collect::<Option<_>>()?;
        let mut conflicts = 0;
        let cdt = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(points, sides, |_| {
            conflicts += 1;
        });
        let cdt = cdt.ok().filter(|cdt| conflicts == 0 && cdt.num_vertices() == numbers.len())?;
        // Flood fill from the box inwards, up to the outline.
        let mut seen = vec![false; cdt.num_all_faces()];
        let mut open = Vec::new();
        for face in cdt.inner_faces() {
            if face.vertices().iter().any(|v| v.index() >= vertices.len()) {
                seen[face.index()] = true;
                open.push(face);
            }
        }
        let mut triangles = Vec::with_capacity(cdt.num_inner_faces());
        while let Some(face) = open.pop() {
            triangles.push(face.vertices().map(|v| numbers[v.index()]));
            for edge in face.adjacent_edges() {
                if cdt.is_constraint_edge(edge.as_undirected().fix()) {
                    continue;
                }
                if let Some(next) = edge.rev().face().as_inner()
                    && !std::mem::replace(&mut seen[next.index()], true)
                {
                    open.push(next);
                }
            }
        }
        // Triangles without area in double precision cannot be measured; the outline is checked independently of the scaffold.
        let place =
            |v: u32| places.get(v as usize).copied().unwrap_or_else(|| on_box[v as usize - places.len()]);
        let least = LEAST_AREA * 4.0 * half[0] * half[1];
        triangles.retain(|t| {
            let [a, b, c] = t.map(place);
            cross(sub(b, a), sub(c, a)) > least
        });
        triangles.sort_unstable();
        Some(Self { triangles, on_box })
    }
}

fn box_points(middle: Vec2, half: Vec2) -> Vec<Vec2> {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let mut points = Vec::with_capacity(4 * PER_SIDE);
    for i in 0..4 {
        let (a, b): (Vec2, Vec2) = (corners[i], corners[(i + 1) % 4]);
        for k in 0..PER_SIDE {
            let t = k as f64 / PER_SIDE as f64;
            points.push([0, 1].map(|j| middle[j] + half[j] * ((1.0 - t) * a[j] + t * b[j])));
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scaffold_fills_the_box_around_the_outline() {
        // A horseshoe.
        let places: Vec<Vec2> = vec![
            [0.0, 0.0],
            [3.0, 0.0],
            [3.0, 3.0],
            [2.0, 3.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [0.0, 3.0],
            [9.0, 9.0],
        ];
        let outline: Vec<[u32; 2]> = (0..8).map(|i| [i, (i + 1) % 8]).collect();
        let scaffold = Scaffold::around(&outline, &places).unwrap();
        let mut all = places.clone();
        all.extend(&scaffold.on_box);
        let areas = scaffold.triangles.iter().map(|t| {
            let [a, b, c] = t.map(|v| all[v as usize]);
            0.5 * cross(sub(b, a), sub(c, a))
        });
        assert!(areas.clone().all(|area| area > 0.0));
        assert!((areas.sum::<f64>() - (4.5 * 4.5 - 7.0)).abs() < 1e-12);
        for side in &outline {
            let has = |t: &[u32; 3]| (0..3).any(|i| [t[(i + 1) % 3], t[i]] == *side);
            assert_eq!(scaffold.triangles.iter().filter(|t| has(t)).count(), 1);
        }
        // An outline that crosses itself.
        let crossed = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        let outline: Vec<[u32; 2]> = (0..4).map(|i| [i, (i + 1) % 4]).collect();
        assert!(Scaffold::around(&outline, &crossed).is_none());
    }
}
