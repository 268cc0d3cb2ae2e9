//! Pairs of meshes whose distances are known in closed form, or from the test suite of CGAL 6.0.

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{Diagonal, ShapeError, cube, grid, point_lattice, tent};
use pompeiu_core::mesh::{Affine, MeshError, merge, transform, unweld};
use std::f64::consts::SQRT_2;

/// Two meshes and the distances between them.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its kind.
    pub name: String,
    /// The first mesh.
    pub a: TriMesh,
    /// The second mesh.
    pub b: TriMesh,
    /// `h(A, B)`.
    pub a_to_b: f64,
    /// `h(B, A)`, where it is known.
    pub b_to_a: Option<f64>,
    /// How far the values above may be from the distances between the meshes as stored, as a length.
    ///
    /// Evaluating a formula costs a few roundings of its value: [`FORMULA`] times it. Where the coordinates that the
    /// formula is about are not doubles (thirds, roots), each vertex of either mesh is stored up to `sqrt(3) u M` away,
    /// with `u = 2^-53` and coordinates up to M: [`COORDINATES`] times M covers both meshes.
    pub rounding: f64,
}

/// Relative error of a closed form evaluated in doubles: eight roundings.
pub const FORMULA: f64 = 4.0 * f64::EPSILON;
/// Displacement of two meshes by the rounding of their coordinates, relative to the largest coordinate.
pub const COORDINATES: f64 = 2.0 * f64::EPSILON;

impl Case {
    fn new(name: impl Into<String>, a: TriMesh, b: TriMesh, a_to_b: f64, b_to_a: Option<f64>) -> Self {
        let value = b_to_a.map_or(a_to_b, |h| if h > a_to_b { h } else { a_to_b });
        Self { name: name.into(), a, b, a_to_b, b_to_a, rounding: FORMULA * value }
    }

    fn with_rounded_coordinates(mut self, largest: f64) -> Self {
        self.rounding += COORDINATES * largest;
        self
    }

    /// The same in units that are `2^exponent` times smaller.
    ///
    /// # Panics
    /// If a coordinate leaves the supported range.
    #[must_use]
    pub fn scaled(&self, exponent: i32) -> Self {
        let by = |x: f64| x * 2.0_f64.powi(exponent / 2) * 2.0_f64.powi(exponent - exponent / 2);
        let mesh = |m: &TriMesh| {
            TriMesh::new(m.positions().iter().map(|p| p.map(by)).collect(), m.faces().to_vec())
                .expect("scaled coordinates are in range")
        };
        Self {
            name: format!("{} times 2^{exponent}", self.name),
            a: mesh(&self.a),
            b: mesh(&self.b),
            a_to_b: by(self.a_to_b),
            b_to_a: self.b_to_a.map(by),
            rounding: by(self.rounding) + f64::from_bits(2),
        }
    }

    /// Both meshes moved by the same vector. Coordinates are rounded where the vector is large: each by half a unit in the
    /// last place, so up to `sqrt(3) u` of the largest in space, for each mesh.
    ///
    /// # Panics
    /// If a coordinate leaves the supported range.
    #[must_use]
    pub fn translated(&self, by: [f64; 3]) -> Self {
        let mesh =
            |m: &TriMesh| transform(m, &Affine::translate(by)).expect("moved coordinates are in range");
        let (a, b) = (mesh(&self.a), mesh(&self.b));
        let coordinates = a.positions().iter().chain(b.positions()).flatten();
        let largest = coordinates.fold(0.0, |m: f64, x| if x.abs() > m { x.abs() } else { m });
        let case = Self { name: format!("{} moved by {by:?}", self.name), a, b, ..self.clone() };
        case.with_rounded_coordinates(largest)
    }
}

/// All cases of all families below.
///
/// # Panics
/// Never: their parameters are valid.
pub fn all() -> Vec<Case> {
    let made = || -> Result<Vec<Case>, ShapeError> {
        let mut cases = cgal()?;
        cases.push(interior_maximum()?);
        for [w, depth] in [[1.0, 1.0], [0.5, 2.0], [2.0, 0.125], [1.0, 1e-6]] {
            cases.push(notch(w, depth, 4.0)?);
        }
        for height in [0.01, 0.5, 1.0, 7.0] {
            cases.push(tent_over_square(height)?);
        }
        for size in [1.0, 0.25, 3.0] {
            cases.push(skew_quad(size)?);
        }
        for (inner, outer, cells) in
            [(1.0, 2.0, [1, 1]), (1.0, 1.25, [3, 2]), (0.5, 0.5, [2, 5]), (1.0, 9.0, [2, 1])]
        {
            cases.push(concentric_cubes(inner, outer, cells)?);
        }
        for n in [1, 2, 3, 7, 16] {
            cases.push(square_over_lattice(n)?);
        }
        for side in [1.0, 2.0, 0.3] {
            cases.push(triangle_over_corners(side)?);
        }
        for height in [0.0, 0.5, 1e-9] {
            cases.push(parallel_squares(2, 3, height)?);
            cases.push(parallel_squares(5, 4, height)?);
        }
        for by in [[0.25, -0.5, 1.0], [0.0, 0.0, 4.0], [1.0 / 1024.0, 0.0, 0.0]] {
            cases.push(moved_cube(by)?);
        }
        cases.extend(degenerate()?);
        Ok(cases)
    };
    made().expect("the parameters are valid")
}

fn mesh(positions: &[[f64; 3]], faces: &[[u32; 3]]) -> Result<TriMesh, MeshError> {
    TriMesh::new(positions.to_vec(), faces.to_vec())
}

/// One triangle against another.
fn cgal() -> Result<Vec<Case>, ShapeError> {
    let t = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    let root = |x: f64| x.sqrt();
    let others = [
        ([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 0.0, 1.0]], 1.0, 1.0),
        ([[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [1.0, 0.0, 2.0]], SQRT_2, 2.0),
        ([[0.0, 1.0, 1.0], [2.0, 1.0, 1.0], [1.0, 1.0, 0.0]], root(1.5), root(1.5)),
        ([[0.0, 1.0, 2.0], [2.0, 1.0, 2.0], [1.0, 1.0, 1.0]], root(3.0), root(4.5)),
    ];
    others
        .into_iter()
        .map(|(other, to, from)| {
            let (a, b) = (mesh(&t, &[[0, 1, 2]])?, mesh(&other, &[[0, 1, 2]])?);
            Ok(Case::new(format!("triangle against {other:?}"), a, b, to, Some(from)))
        })
        .collect()
}

/// The maximum lies inside a face of A, where three faces of B are equally far.
fn interior_maximum() -> Result<Case, ShapeError> {
    let a = mesh(&[[-1.0, 1.0, 1.0], [0.0, -1.0, 1.0], [1.0, 1.0, 1.0]], &[[0, 1, 2]])?;
    let b = mesh(
        &[
            [-1.0, 1.0, 0.0],
            [0.0, -1.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, -1.0],
            [-0.5, 0.0, -1.0],
            [0.5, 0.0, -1.0],
        ],
        &[[3, 4, 5], [0, 4, 3], [1, 5, 4], [2, 3, 5]],
    )?;
    // Published as 1.591686239 and further digits.
    let mut case = Case::new("interior maximum", a, b, 1.591_686_239_5, None);
    case.rounding = 5e-10;
    Ok(case)
}

/// A lid over a V-shaped notch of half-width w.
fn notch(w: f64, depth: f64, length: f64) -> Result<Case, ShapeError> {
    let lid =
        mesh(&[[-w, 0.0, 0.0], [w, 0.0, 0.0], [w, length, 0.0], [-w, length, 0.0]], &[[0, 1, 2], [0, 2, 3]])?;
    let walls = mesh(
        &[
            [-w, 0.0, 0.0],
            [w, 0.0, 0.0],
            [w, length, 0.0],
            [-w, length, 0.0],
            [0.0, 0.0, -depth],
            [0.0, length, -depth],
        ],
        &[[0, 4, 5], [0, 5, 3], [1, 2, 5], [1, 5, 4]],
    )?;
    let h = w * depth / (w * w + depth * depth).sqrt();
    Ok(Case::new(format!("lid over a notch of half-width {w}, depth {depth}"), lid, walls, h, Some(depth)))
}

fn tent_over_square(height: f64) -> Result<Case, ShapeError> {
    let flat = grid([2.0, 2.0], [1, 1], Diagonal::Rising)?;
    let h = height / (1.0 + height * height).sqrt();
    Ok(Case::new(
        format!("square under a tent of height {height}"),
        flat,
        tent(2.0, height)?,
        h,
        Some(height),
    ))
}

/// All vertices coincide.
fn skew_quad(size: f64) -> Result<Case, ShapeError> {
    let corners = [[0.0, 0.0, 0.0], [size, 0.0, size], [size, size, 0.0], [0.0, size, size]];
    let (a, b) = (mesh(&corners, &[[0, 1, 2], [0, 2, 3]])?, mesh(&corners, &[[0, 1, 3], [1, 2, 3]])?);
    let h = size / 3.0_f64.sqrt();
    Ok(Case::new(format!("skew quadrilateral of size {size} with its two diagonals"), a, b, h, Some(h)))
}

fn concentric_cubes(inner: f64, outer: f64, cells: [u32; 2]) -> Result<Case, ShapeError> {
    let (a, b) = (cube(inner, cells[0])?, cube(outer, cells[1])?);
    let h = (outer - inner) / 2.0;
    let name = format!("cube of side {inner} in {cells:?} cells inside one of side {outer}");
    Ok(Case::new(name, a, b, h, Some(3.0_f64.sqrt() * h)).with_rounded_coordinates(outer))
}

/// Triangles that are points: many places are equally far.
fn square_over_lattice(n: u32) -> Result<Case, ShapeError> {
    let h = SQRT_2 / (2.0 * f64::from(n));
    let square = grid([1.0, 1.0], [1, 1], Diagonal::Rising)?;
    let case = Case::new(
        format!("square over the corners of {n} x {n} cells"),
        square,
        point_lattice(1.0, n)?,
        h,
        Some(0.0),
    );
    Ok(case.with_rounded_coordinates(0.5))
}

fn triangle_over_corners(side: f64) -> Result<Case, ShapeError> {
    let corners = [[0.0, 0.0, 0.0], [side, 0.0, 0.0], [0.5 * side, 0.5 * 3.0_f64.sqrt() * side, 0.0]];
    let (a, b) = (mesh(&corners, &[[0, 1, 2]])?, mesh(&corners, &[[0, 0, 0], [1, 1, 1], [2, 2, 2]])?);
    let case = Case::new(
        format!("equilateral triangle of side {side} over its corners"),
        a,
        b,
        side / 3.0_f64.sqrt(),
        Some(0.0),
    );
    Ok(case.with_rounded_coordinates(side))
}

/// The same square in n x n and m x m cells, a height apart.
fn parallel_squares(n: u32, m: u32, height: f64) -> Result<Case, ShapeError> {
    let a = grid([2.0, 2.0], [n, n], Diagonal::Rising)?;
    let b = transform(&grid([2.0, 2.0], [m, m], Diagonal::Falling)?, &Affine::translate([0.0, 0.0, height]))?;
    // The rounded vertices stay in their planes and on the sides of the square: nothing moves.
    Ok(Case::new(format!("squares of {n} and {m} cells a height {height} apart"), a, b, height, Some(height)))
}

fn moved_cube(by: [f64; 3]) -> Result<Case, ShapeError> {
    let a = cube(1.0, 2)?;
    let b = transform(&a, &Affine::translate(by))?;
    let h = by.iter().map(|x| x * x).sum::<f64>().sqrt();
    Ok(Case::new(format!("cube moved by {by:?}"), a, b, h, Some(h)))
}

/// Meshes that trip programs which take triangles for granted.
fn degenerate() -> Result<Vec<Case>, ShapeError> {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let two = [[0, 1, 2], [0, 2, 3]];
    let raised = square.map(|[x, y, _]| [x, y, 1.0]);
    let with_far_vertex = [raised.as_slice(), &[[100.0, 0.0, 0.0]]].concat();
    let flat = mesh(&square, &two)?;
    let cube = cube(1.0, 2)?;
    let segments = mesh(&[[0.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 2.0, 0.0]], &[[0, 1, 2], [0, 2, 0]])?;
    let points = mesh(&[[0.0, 0.0, 0.0], [3.0, 4.0, 0.0]], &[[0, 0, 0], [1, 1, 1]])?;
    let origin = mesh(&[[0.0; 3]], &[[0, 0, 0]])?;
    let twice = merge(&[&flat, &flat])?;
    let cases = vec![
        Case::new(
            "an unreferenced vertex far away",
            flat.clone(),
            mesh(&with_far_vertex, &two)?,
            1.0,
            Some(1.0),
        ),
        Case::new("a mesh and its unwelded faces", cube.clone(), unweld(&cube)?, 0.0, Some(0.0)),
        Case::new("a mesh and itself", cube.clone(), cube, 0.0, Some(0.0)),
        Case::new(
            "square against its diagonal as a segment",
            flat.clone(),
            mesh(&square, &[[0, 2, 0]])?,
            SQRT_2 / 2.0,
            Some(0.0),
        ),
        Case::new("a segment and a point", segments.clone(), origin.clone(), 4.0, Some(0.0)),
        // (0, 25/8) is equally far from both points.
        Case::new("a segment and two points", segments, points.clone(), 3.125, Some(3.0)),
        Case::new("two points and one", points.clone(), origin.clone(), 5.0, Some(0.0)),
        Case::new("one point", origin.clone(), origin, 0.0, Some(0.0)),
        Case::new("points against themselves", points.clone(), points, 0.0, Some(0.0)),
        Case::new("duplicate faces", twice, mesh(&raised, &two)?, 1.0, Some(1.0)),
        Case::new(
            "one face and the square it is half of",
            mesh(&square, &two[..1])?,
            flat,
            0.0,
            Some(SQRT_2 / 2.0),
        ),
    ];
    Ok(cases)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::sample;

    /// The values are right: samples do not exceed them, and come as near as their covering radius.
    #[test]
    fn samples_bracket_the_values() {
        for case in all().into_iter().filter(|c| c.a.faces().len() * c.b.faces().len() < 3000) {
            let directions = [(&case.a, &case.b, Some(case.a_to_b)), (&case.b, &case.a, case.b_to_a)];
            for (a, b, h) in directions.into_iter().filter_map(|(a, b, h)| Some((a, b, h?))) {
                let s = sample(a, b, 12);
                let slack = case.rounding + 1e-14 * (h + s.covering_radius);
                assert!(
                    s.largest <= h + slack && h <= s.largest + s.covering_radius + slack,
                    "{} {h} {s:?}",
                    case.name
                );
            }
        }
    }

    #[test]
    fn scaling_and_moving_keep_what_a_case_says() {
        let case = all().into_iter().find(|c| c.name.contains("tent of height 0.5")).unwrap();
        let small = case.scaled(-1000);
        assert_eq!(small.a.positions()[3][0], 2.0_f64.powi(-1000));
        assert_eq!(small.a_to_b, case.a_to_b * 2.0_f64.powi(-1000));
        let far = case.translated([1e9, 0.0, -1e9]);
        assert_eq!(far.a.positions()[3], [1e9 + 1.0, 1.0, -1e9]);
        assert!(far.rounding > case.rounding + 4e-7 && far.rounding < 1e-6);
    }
}
