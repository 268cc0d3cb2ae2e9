//! Surfaces spanned on closed polygons.

use super::ShapeError;
use super::arrays::{Arrays, count};
use crate::mesh::TriMesh;
use glam::DVec3;

/// Sample points on each loop for choosing the start and direction of the second.
const COMPARED: usize = 64;

/// A surface spanned on closed polygons: a disc on one, an annulus on two.
///
/// # Shapes and units
/// Each polygon is one loop of the boundary, its points in their order. `rows ≥ 1` bands of faces lie between the polygon and the
/// middle of its points, or between both polygons: points at even shares of their lengths, on straight lines. The second polygon is
/// turned and started so that such points are nearest to those of the first.
/// # Errors
/// [`ShapeError::Loops`] unless there are one or two; [`ShapeError::TooFew`] for fewer than three points or no row;
/// [`ShapeError::Size`] for a polygon without length; [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
/// # Limits
/// The surface may intersect itself where polygons are far from plane or wind about each other.
pub fn span(loops: &[Vec<[f64; 3]>], rows: u32) -> Result<TriMesh, ShapeError> {
    let m = count("rows", rows, 1)?;
    let wires: Vec<Wire> = loops.iter().map(|points| Wire::new(points)).collect::<Result<_, _>>()?;
    match &wires[..] {
        [wire] => disc(wire, rows, m),
        [first, second] => annulus(first, &second.facing(first), rows, m),
        _ => Err(ShapeError::Loops { count: wires.len() }),
    }
}

/// A closed polygon, with the share of its length up to each point.
struct Wire {
    points: Vec<DVec3>,
    shares: Vec<f64>,
}

impl Wire {
    fn new(points: &[[f64; 3]]) -> Result<Self, ShapeError> {
        let number = u32::try_from(points.len()).unwrap_or(u32::MAX);
        count("points of a polygon", number, 3)?;
        Self::of(points.iter().map(|p| DVec3::from_array(*p)).collect())
    }

    fn of(points: Vec<DVec3>) -> Result<Self, ShapeError> {
        let mut shares = Vec::with_capacity(points.len());
        let mut length = 0.0;
        for (i, p) in points.iter().enumerate() {
            shares.push(length);
            length += p.distance(points[(i + 1) % points.len()]);
        }
        if !(length > 0.0 && length.is_finite()) {
            return Err(ShapeError::Size { what: "length of a polygon", value: length });
        }
        for share in &mut shares {
            *share /= length;
        }
        Ok(Self { points, shares })
    }

    /// The point at a share of the length from 0 to 1.
    fn at(&self, share: f64) -> DVec3 {
        let i = self.shares.partition_point(|s| *s <= share).saturating_sub(1);
        let end = self.shares.get(i + 1).copied().unwrap_or(1.0);
        let part = (share - self.shares[i]) / (end - self.shares[i]);
        let (p, q) = (self.points[i], self.points[(i + 1) % self.points.len()]);
        if part > 0.0 { p + (q - p) * part } else { p }
    }

    /// The same polygon with the start and direction that bring it closest to another one.
    fn facing(&self, other: &Self) -> Self {
        let there: Vec<DVec3> = (0..COMPARED).map(|i| other.at(i as f64 / COMPARED as f64)).collect();
        let mut best = (f64::INFINITY, 0, false);
        for backwards in [false, true] {
            for start in 0..self.points.len() {
                let apart = |(i, p): (usize, &DVec3)| {
                    let step = i as f64 / COMPARED as f64;
                    let share = self.shares[start] + if backwards { 1.0 - step } else { step };
                    self.at(share.fract()).distance_squared(*p)
                };
                let sum: f64 = there.iter().enumerate().map(apart).sum();
                if sum < best.0 {
                    best = (sum, start, backwards);
                }
            }
        }
        let (_, start, backwards) = best;
        let n = self.points.len();
        let place = |i: usize| if backwards { (start + n - i) % n } else { (start + i) % n };
        let points = (0..n).map(|i| self.points[place(i)]).collect();
        // Computed in another order, the length is the same up to rounding.
        Self::of(points).unwrap_or(Self { points: self.points.clone(), shares: self.shares.clone() })
    }
}

fn disc(wire: &Wire, rows: u32, m: u128) -> Result<TriMesh, ShapeError> {
    let n = wire.points.len() as u32;
    let mut arrays = Arrays::with_capacity(u128::from(n) * m + 1, u128::from(n) * (2 * m - 1))?;
    let middle = wire.points.iter().sum::<DVec3>() / f64::from(n);
    for row in 0..rows {
        let share = f64::from(row) / f64::from(rows);
        let inwards = |p: &DVec3| if row == 0 { *p } else { *p + share * (middle - *p) };
        arrays.positions.extend(wire.points.iter().map(|p| inwards(p).to_array()));
    }
    arrays.positions.push(middle.to_array());
    for (row, i) in (0..rows).flat_map(|row| (0..n).map(move |i| (row, i))) {
        let [a, b] = [i, (i + 1) % n].map(|i| row * n + i);
        if row + 1 == rows {
            arrays.faces.push([a, b, n * rows]);
        } else {
            arrays.quad([a, b, b + n, a + n]);
        }
    }
    arrays.into_mesh()
}

fn annulus(first: &Wire, second: &Wire, rows: u32, m: u128) -> Result<TriMesh, ShapeError> {
    // Rows in between have as many points as the finer polygon, at even shares of both lengths.
    let n = first.points.len().max(second.points.len());
    let ends = (first.points.len() + second.points.len()) as u128;
    let mut arrays =
        Arrays::with_capacity(ends + n as u128 * (m - 1), ends.max(2 * n as u128) + 2 * n as u128 * m)?;
    let even: Vec<f64> = (0..n).map(|i| i as f64 / n as f64).collect();
    let mut row_before: Option<(u32, &[f64])> = None;
    for row in 0..=rows {
        let start = arrays.positions.len() as u32;
        let shares: &[f64] = if row == 0 {
            arrays.positions.extend(first.points.iter().map(DVec3::to_array));
            &first.shares
        } else if row == rows {
            arrays.positions.extend(second.points.iter().map(DVec3::to_array));
            &second.shares
        } else {
            let part = f64::from(row) / f64::from(rows);
            let between = |share: &f64| first.at(*share).lerp(second.at(*share), part).to_array();
            arrays.positions.extend(even.iter().map(between));
            &even
        };
        if let Some(before) = row_before {
            band(&mut arrays, before, (start, shares));
        }
        row_before = Some((start, shares));
    }
    arrays.into_mesh()
}

/// Faces between two closed rows of vertices; each step advances on the row whose next vertex comes first by share of length.
fn band(arrays: &mut Arrays, (a, of_a): (u32, &[f64]), (b, of_b): (u32, &[f64])) {
    let (n, m) = (of_a.len(), of_b.len());
    let share = |shares: &[f64], i: usize| shares.get(i).copied().unwrap_or(1.0);
    let (mut i, mut j) = (0, 0);
    while i < n || j < m {
        let [p, q] = [a + (i % n) as u32, b + (j % m) as u32];
        if j == m || i < n && share(of_a, i + 1) <= share(of_b, j + 1) {
            i += 1;
            arrays.faces.push([p, a + (i % n) as u32, q]);
        } else {
            j += 1;
            arrays.faces.push([p, b + (j % m) as u32, q]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::measure::{area, edges};
    use super::*;

    fn circle(points: u32, radius: f64, z: f64) -> Vec<[f64; 3]> {
        let at = |i: u32| super::super::arrays::turn(i.into(), points.into());
        (0..points).map(at).map(|[x, y]| [radius * x, radius * y, z]).collect()
    }

    #[test]
    fn a_disc_has_the_area_of_its_polygon() {
        let mesh = span(&[circle(7, 2.0, 1.0)], 5).expect("a disc");
        let expected = 0.5 * 7.0 * 4.0 * (std::f64::consts::TAU / 7.0).sin();
        assert!((area(&mesh) - expected).abs() < 1e-12);
        assert_eq!((mesh.positions().len(), mesh.faces().len()), (7 * 5 + 1, 7 * 9));
        assert_eq!(mesh.positions()[..7], circle(7, 2.0, 1.0));
        assert_eq!(edges(&mesh).1, 7);
    }

    #[test]
    fn an_annulus_joins_polygons_whatever_their_direction_and_start() {
        for (n, m) in [(12, 12), (12, 40), (31, 12)] {
            let mut second = circle(m, 1.0, 2.0);
            second.reverse();
            second.rotate_left(3);
            for rows in [1, 4] {
                let mesh = span(&[circle(n, 1.0, 0.0), second.clone()], rows).expect("an annulus");
                let (_, boundary, consistent) = edges(&mesh);
                assert!(consistent && boundary == (n + m) as usize);
                let exact = 2.0 * std::f64::consts::TAU;
                assert!((area(&mesh) / exact - 1.0).abs() < 0.05, "{n}, {m}, {rows}: {}", area(&mesh));
            }
        }
    }

    #[test]
    fn what_spans_nothing() {
        let square = circle(4, 1.0, 0.0);
        assert_eq!(span(&[], 3), Err(ShapeError::Loops { count: 0 }));
        assert_eq!(span(&vec![square.clone(); 3], 3), Err(ShapeError::Loops { count: 3 }));
        assert!(matches!(span(&[square[..2].to_vec()], 3), Err(ShapeError::TooFew { count: 2, .. })));
        assert!(matches!(span(&[square], 0), Err(ShapeError::TooFew { what: "rows", .. })));
        assert!(matches!(span(&[vec![[1.0; 3]; 5]], 3), Err(ShapeError::Size { .. })));
        assert!(matches!(span(&[vec![[0.0; 3], [1e300; 3], [-1e300; 3]]], 2), Err(ShapeError::Size { .. })));
    }
}
