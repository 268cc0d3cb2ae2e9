//! What numbers a file can hold, and where that puts a vertex.

use super::{MeshError, TriMesh};
use crate::geom::Aabb;
use std::fmt;

/// The numbers in which coordinates are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Precision {
    /// 53 bits: every mesh in memory.
    #[default]
    Double,
    /// 24 bits: files such as STL and GLB.
    Single,
}

/// What coordinates a result is wanted in: options that the requests of several systems share.
///
/// Whoever writes a mesh to a file with fewer bits moves its vertices. What is said of the result must be true of the file, so a
/// system is told beforehand: it rounds, and proves afterwards.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Coordinates {
    /// Numbers in which the coordinates of the result are kept; single where the file that is written holds no others, as STL and GLB do.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub precision: Precision,
    /// Count the coordinates of the result from a point near the centre of the mesh, which is reported: far from zero this keeps digits
    /// for which single precision has no room.
    #[cfg_attr(feature = "clap", arg(long))]
    pub center: bool,
}

impl Coordinates {
    /// Where the points of a mesh with this bounding box can be.
    pub fn within(self, aabb: &Aabb) -> Grid {
        let mut grid = Grid { precision: self.precision, shift: [0.0; 3], step: 0.0 };
        if !self.center || aabb.is_empty() {
            return grid;
        }
        // Twice the largest coordinate leaves room for points beside the box.
        grid.step = power_of_two(2.0 * aabb.max_coordinate()) * f64::EPSILON;
        grid.step = if grid.step > 0.0 { grid.step } else { LEAST_STEP };
        let sides = (0..3).map(|k| aabb.upper[k] - aabb.lower[k]);
        let extent = sides.fold(0.0, |m: f64, x| if x > m { x } else { m });
        let unit = power_of_two(extent) * SHIFT_UNIT;
        let unit = if unit > grid.step { unit } else { grid.step };
        grid.shift = [0, 1, 2].map(|k| ((0.5 * aabb.lower[k] + 0.5 * aabb.upper[k]) / unit).round() * unit);
        grid
    }
}

/// The shift is a multiple of this share of the size of the mesh, so that it is a short number.
const SHIFT_UNIT: f64 = 0.25;

/// The share of a distance that may be allowed that rounding may take.
const LARGEST_SHARE: f64 = 0.99;

/// The share of the length of edges that rounding may take: beyond it faces turn over and intersect.
const LARGEST_SHARE_OF_EDGES: f64 = 0.125;

/// The least positive double.
const LEAST_STEP: f64 = f64::from_bits(1);

/// The largest power of two that is at most a positive number; 0 for 0.
fn power_of_two(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & 0x7ff0_0000_0000_0000)
}

/// The points that a file can hold, in the coordinates of the input.
///
/// # Definition
/// A point q such that q − shift has coordinates of the precision. The difference is computed exactly: with a shift, q and the shift are
/// multiples of one power of two, and so small that their difference is a double.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    precision: Precision,
    shift: [f64; 3],
    /// With a shift, all coordinates are multiples of this power of two.
    step: f64,
}

impl Grid {
    /// All points: nothing is rounded, nothing shifted.
    pub const ALL: Self = Self { precision: Precision::Double, shift: [0.0; 3], step: 0.0 };

    /// Whether every point is one of them.
    pub fn holds_all(&self) -> bool {
        self.precision == Precision::Double && self.step == 0.0
    }

    /// The numbers that files hold.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// What is taken from all coordinates when they are written.
    pub fn shift(&self) -> [f64; 3] {
        self.shift
    }

    /// The point of the grid near a point: at most half a unit in the last place of the precision away along each axis, and with a shift
    /// one in that of the largest coordinate of the input. Infinite where single precision is exceeded.
    #[inline]
    pub fn round(&self, p: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| {
            let mut x = p[k] - self.shift[k];
            if self.precision == Precision::Single {
                x = f64::from(x as f32);
            }
            if self.step > 0.0 {
                x = (x / self.step).round() * self.step;
            }
            x + self.shift[k]
        })
    }

    /// How far rounding moves any point of a box, at most; with a shift what that takes is left out.
    fn most_moved(&self, aabb: &Aabb) -> f64 {
        if self.precision == Precision::Double || aabb.is_empty() {
            return 0.0;
        }
        let half_units = [0, 1, 2].map(|k| {
            let most =
                (aabb.lower[k] - self.shift[k]).abs().max((aabb.upper[k] - self.shift[k]).abs()) as f32;
            0.5 * (f64::from(most.next_up()) - f64::from(most))
        });
        half_units.iter().map(|unit| unit * unit).sum::<f64>().sqrt()
    }

    /// Whether faces in a box can have edges about this long, as far as rounding goes.
    ///
    /// # Errors
    /// [`TooCoarse`] where rounding moves vertices by an eighth of that or more.
    pub fn check_edges(&self, aabb: &Aabb, length: f64) -> Result<(), TooCoarse> {
        let moved = self.most_moved(aabb);
        // Lengths of which squares vanish tell nothing.
        if moved == 0.0 || length == 0.0 || moved < LARGEST_SHARE_OF_EDGES * length {
            return Ok(());
        }
        Err(TooCoarse { moved, asked: Asked::Edges(length) })
    }

    /// A mesh with each vertex at its point of the grid.
    ///
    /// # Errors
    /// [`MeshError::NonFinite`] where a coordinate exceeds single precision.
    pub fn round_mesh(&self, mesh: &TriMesh) -> Result<TriMesh, MeshError> {
        TriMesh::new(mesh.positions().iter().map(|&p| self.round(p)).collect(), mesh.faces().to_vec())
    }

    /// What rounding does to the vertices of a mesh.
    pub fn rounding(&self, mesh: &TriMesh) -> Rounding {
        let moved = mesh.positions().iter().map(|&p| {
            let q = self.round(p);
            let [x, y, z] = [0, 1, 2].map(|k| (q[k] - p[k]).abs());
            // Scaled, so that squares do not vanish; the factor covers the rounding of what follows.
            let largest = if x > y { x } else { y };
            let largest = if largest > z { largest } else { z };
            if largest > 0.0 && largest < f64::INFINITY {
                let [x, y, z] = [x, y, z].map(|d| d / largest);
                largest * (x * x + y * y + z * z).sqrt() * (1.0 + 8.0 * f64::EPSILON)
            } else {
                largest
            }
        });
        let moved = moved.fold(0.0, |m: f64, d| if d > m { d } else { m });
        Rounding { precision: self.precision, shift: self.shift, moved }
    }
}

/// The effect on a mesh of rounding to the numbers of a file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Rounding {
    /// The numbers of the file.
    pub precision: Precision,
    /// The vector that is subtracted from all coordinates in the file.
    pub shift: [f64; 3],
    /// The largest distance by which rounding moves a vertex of the input.
    pub moved: f64,
}

impl Rounding {
    /// A mesh that was rounded as it is written: exactly, moved by the shift.
    ///
    /// # Errors
    /// [`MeshError`] if the mesh is another one, and leaves the supported range.
    pub fn written(&self, mesh: &TriMesh) -> Result<TriMesh, MeshError> {
        let moved = |p: &[f64; 3]| [0, 1, 2].map(|k| p[k] - self.shift[k]);
        TriMesh::new(mesh.positions().iter().map(moved).collect(), mesh.faces().to_vec())
    }

    /// Whether a result can be this near to the input, as far as rounding goes.
    ///
    /// # Errors
    /// [`TooCoarse`] where rounding alone moves vertices as far.
    pub fn check(&self, distance: f64) -> Result<(), TooCoarse> {
        // What is left must be more than the rounding of the proof.
        if self.moved < LARGEST_SHARE * distance {
            Ok(())
        } else {
            Err(TooCoarse { moved: self.moved, asked: Asked::Distance(distance) })
        }
    }
}

/// Rounding to the numbers of the file moves vertices too far for the result that was asked for.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "single precision moves vertices by up to {moved}, and {asked}; write a format with double precision such as PLY or OBJ, or count \
     coordinates from the centre of the mesh (--center)"
)]
pub struct TooCoarse {
    /// How far the vertex moves that moves farthest.
    pub moved: f64,
    /// What was asked for.
    pub asked: Asked,
}

/// A length that rounding must leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Asked {
    /// The result may be this far from the input.
    Distance(f64),
    /// Edges of the result are about this long.
    Edges(f64),
}

impl fmt::Display for Asked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Distance(length) => write!(f, "the result may be {length} away at most"),
            Self::Edges(length) => write!(f, "edges are to be about {length} long"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Affine, Random, displace_at_random, shapes, transform};

    fn coordinates(precision: Precision, center: bool) -> Coordinates {
        Coordinates { precision, center }
    }

    /// A sphere of a size somewhere, with all bits of its coordinates in use.
    fn sphere(radius: f64, at: [f64; 3], seed: u64) -> TriMesh {
        let sphere = shapes::icosphere(radius, 2).expect("a sphere");
        let moved = transform(&sphere, &Affine::translate(at)).expect("a moved sphere");
        displace_at_random(&moved, 1e-3 * radius, seed).expect("a rough sphere")
    }

    #[test]
    fn what_is_written_has_the_precision_and_is_exactly_the_point_said() {
        let mut random = Random::new(7);
        for seed in 0..200 {
            let radius = (10.0 * random.signed_unit()).exp();
            let at = [0, 1, 2].map(|_| random.signed_unit() * (15.0 * random.signed_unit()).exp());
            let mesh = sphere(radius, at, seed);
            let aabb = Aabb::of_faces(&mesh);
            for centered in [false, true] {
                let grid = coordinates(Precision::Single, centered).within(&aabb);
                let rounded = grid.round_mesh(&mesh).expect("in range");
                let written = grid.rounding(&mesh).written(&rounded).expect("in range");
                for (q, r) in rounded.positions().iter().zip(written.positions()) {
                    assert_eq!(grid.round(*q), *q, "a point of the grid stays");
                    for k in 0..3 {
                        assert_eq!(f64::from(r[k] as f32), r[k], "{radius} {at:?}");
                        // Exact: the error of the difference, by Knuth's sum without errors, is zero.
                        let (a, b) = (q[k], -grid.shift()[k]);
                        let part = r[k] - a;
                        assert_eq!((a - (r[k] - part)) + (b - part), 0.0, "{radius} {at:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn far_from_zero_centering_keeps_what_single_precision_loses() {
        let mesh = sphere(10.0, [1_234_560.0, -7_654_313.0, 0.0], 1);
        let aabb = Aabb::of_faces(&mesh);
        let moved = |centered| coordinates(Precision::Single, centered).within(&aabb).rounding(&mesh).moved;
        assert!(moved(false) > 0.1 && moved(true) < 1e-6, "{} {}", moved(false), moved(true));
        let rounding = coordinates(Precision::Single, false).within(&aabb).rounding(&mesh);
        assert!(rounding.check(0.05).is_err() && rounding.check(1.0).is_ok());
        assert_eq!(coordinates(Precision::Double, false).within(&aabb), Grid::ALL);
    }

    #[test]
    fn tiny_and_huge_meshes_do_not_become_nonsense() {
        for radius in [1e-300, 1e-30, 1e30, 1e290] {
            let mesh = sphere(radius, [3.0 * radius; 3], 2);
            let grid = coordinates(Precision::Double, true).within(&Aabb::of_faces(&mesh));
            assert!(grid.rounding(&mesh).moved < 1e-14 * radius, "{radius}");
            let single = coordinates(Precision::Single, true).within(&Aabb::of_faces(&mesh));
            match single.round_mesh(&mesh) {
                Ok(_) => assert!(radius < 1e38),
                Err(error) => assert!(radius > 1e38 && matches!(error, MeshError::NonFinite { .. })),
            }
        }
    }
}
