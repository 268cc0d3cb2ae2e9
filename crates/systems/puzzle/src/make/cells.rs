//! Voronoi cells of sites in a rectangle, with corners rounded to the lattice.

use crate::space::Corner;
use crate::{Border, Puzzle, PuzzleError};
use pompeiu_planar::Point;
use spade::{DelaunayTriangulation, Point2, Triangulation};
use std::collections::BTreeMap;

/// Corners of cells closer than this many steps are merged: for four cocircular sites they differ by rounding only.
const ONE_CORNER: i64 = 16;

/// The cells of sites, as a puzzle without tabs.
///
/// The rectangle's sides are the borders between the cells of sites and of their mirror images in the four sides.
pub(super) fn partition(sites: &[Point], size: [f64; 2], step: f64) -> Result<Puzzle, PuzzleError> {
    let mut triangulation: DelaunayTriangulation<Point2<f64>> = DelaunayTriangulation::new();
    let [width, height] = size;
    // The site itself, and its mirror images in the four sides.
    let image = |[x, y]: Point, k: usize| match k {
        0 => [x, y],
        1 => [-x, y],
        2 => [2.0 * width - x, y],
        3 => [x, -y],
        _ => [x, 2.0 * height - y],
    };
    // The site of each vertex; `None` for a mirror image.
    let mut owner: Vec<Option<usize>> = Vec::new();
    for k in 0..5 {
        for (site, p) in sites.iter().enumerate() {
            let [x, y] = image(*p, k);
            let found = triangulation.insert(Point2::new(x, y));
            match found {
                Ok(vertex) if vertex.index() == owner.len() => owner.push((k == 0).then_some(site)),
                _ if k == 0 => return Err(PuzzleError::Narrow { piece: site }),
                _ => (),
            }
        }
    }
    let limits = size.map(|side| side as i64);
    let snap = |x: f64, limit: i64| {
        let x = x.round().clamp(0.0, limit as f64) as i64;
        if x <= ONE_CORNER {
            0
        } else if x >= limit - ONE_CORNER {
            limit
        } else {
            x
        }
    };
    let mut merged = Merged::default();
    let mut loops: Vec<Vec<(usize, bool)>> = vec![Vec::new(); sites.len()];
    let mut borders: Vec<Border> = Vec::new();
    let mut known: BTreeMap<usize, Option<usize>> = BTreeMap::new();
    for vertex in triangulation.vertices() {
        let Some(site) = owner[vertex.fix().index()] else { continue };
        let mut around: Vec<(usize, bool)> = Vec::new();
        // Counter-clockwise, so that borders are consecutive.
        for edge in vertex.out_edges() {
            let other = owner[edge.to().fix().index()];
            let name = edge.as_undirected().fix().index();
            if let Some(found) = known.get(&name) {
                around.extend(found.map(|border| (border, true)));
                continue;
            }
            let mut corner = |face: spade::handles::FaceHandle<
                '_,
                spade::handles::PossiblyOuterTag,
                _,
                _,
                _,
                _,
            >|
             -> Option<Corner> {
                let centre = face.as_inner()?.circumcenter();
                Some(merged.corner([snap(centre.x, limits[0]), snap(centre.y, limits[1])]))
            };
            let ends = [corner(edge.rev().face()), corner(edge.face())];
            let border = match ends {
                [Some(from), Some(to)] if from != to => {
                    borders.push(Border { corners: vec![from, to], left: site, right: other });
                    Some(borders.len() - 1)
                }
                _ => None,
            };
            known.insert(name, border);
            around.extend(border.map(|border| (border, false)));
        }
        loops[site] = around;
    }
    let doubled_outline = 2 * i128::from(limits[0]) * i128::from(limits[1]);
    let puzzle = Puzzle { borders, loops, step, size: limits, doubled_outline, whimsies: Vec::new() };
    match (0..puzzle.pieces()).find(|piece| puzzle.doubled_area(*piece) <= 0) {
        Some(piece) => Err(PuzzleError::Narrow { piece }),
        None => Ok(puzzle),
    }
}

/// Corners, with nearby ones merged.
#[derive(Default)]
struct Merged {
    cells: BTreeMap<[i64; 2], Vec<Corner>>,
}

impl Merged {
    /// An existing nearby corner, or a new one.
    fn corner(&mut self, at: Corner) -> Corner {
        let cell = at.map(|x| x.div_euclid(ONE_CORNER));
        for dx in -1..=1 {
            for dy in -1..=1 {
                let near = self.cells.get(&[cell[0] + dx, cell[1] + dy]).into_iter().flatten();
                let is_one = |c: &&Corner| (0..2).all(|k| (c[k] - at[k]).abs() <= ONE_CORNER);
                if let Some(found) = near.copied().collect::<Vec<_>>().iter().find(is_one) {
                    return *found;
                }
            }
        }
        self.cells.entry(cell).or_default().push(at);
        at
    }
}

impl Puzzle {
    /// The centroids of the pieces, in lattice steps.
    pub(super) fn centroids(&self) -> Vec<Point> {
        (0..self.pieces())
            .map(|piece| {
                let corners = self.corners(piece);
                let origin = corners[0];
                let at = |c: Corner| [(c[0] - origin[0]) as f64, (c[1] - origin[1]) as f64];
                let (mut doubled, mut sum) = (0.0, [0.0; 2]);
                for pair in corners.windows(2) {
                    let [a, b] = [at(pair[0]), at(pair[1])];
                    let w = a[0] * b[1] - a[1] * b[0];
                    doubled += w;
                    sum = [sum[0] + w * (a[0] + b[0]), sum[1] + w * (a[1] + b[1])];
                }
                [0, 1].map(|k| origin[k] as f64 + sum[k] / (3.0 * doubled))
            })
            .collect()
    }
}
