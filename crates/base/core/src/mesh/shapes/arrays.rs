//! Helpers for building shapes: checked parameters, counted arrays, points on a circle.

use super::ShapeError;
use crate::mesh::TriMesh;

/// The value, if it is a usable length.
pub(super) fn length(what: &'static str, value: f64) -> Result<f64, ShapeError> {
    if value.is_finite() && value > 0.0 { Ok(value) } else { Err(ShapeError::Size { what, value }) }
}

/// The count, if it is at least `least`, in a type in which products of three counts do not overflow.
pub(super) fn count(what: &'static str, count: u32, least: u32) -> Result<u128, ShapeError> {
    if count >= least { Ok(count.into()) } else { Err(ShapeError::TooFew { what, count, least }) }
}

/// Positions and faces of a shape under construction, with room for exactly the announced numbers.
pub(super) struct Arrays {
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) faces: Vec<[u32; 3]>,
}

impl Arrays {
    /// Empty arrays for these numbers of elements.
    pub(super) fn with_capacity(vertices: u128, faces: u128) -> Result<Self, ShapeError> {
        for (what, count) in [("vertices", vertices), ("faces", faces)] {
            if count > u32::MAX.into() {
                return Err(ShapeError::TooMany { what, count: u64::try_from(count).unwrap_or(u64::MAX) });
            }
        }
        let (vertices, faces) = (vertices as u64, faces as u64);
        let mut arrays = Self { positions: Vec::new(), faces: Vec::new() };
        let room = arrays
            .positions
            .try_reserve_exact(vertices as usize)
            .and_then(|()| arrays.faces.try_reserve_exact(faces as usize));
        room.map_err(|_| ShapeError::NoMemory { vertices, faces })?;
        Ok(arrays)
    }

    /// Two faces for the quadrilateral a, b, c, d, split along a–c.
    pub(super) fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.faces.extend([[a, b, c], [a, c, d]]);
    }

    /// Faces between circles of vertices, every other one rotated by half a step, from the first vertex on.
    pub(super) fn staggered(&mut self, segments: u32, rows: u32) {
        let vertex = |row: u32, segment: u32| row * segments + segment % segments;
        for row in 0..rows {
            // A rotated circle starts half a step later: its vertex s lies between s and s + 1 of its neighbours.
            let (below, above) = if row % 2 == 0 { (1, 0) } else { (0, 1) };
            for s in 0..segments {
                self.faces.push([vertex(row, s), vertex(row, s + 1), vertex(row + 1, s + above)]);
                self.faces.push([vertex(row, s + below), vertex(row + 1, s + 1), vertex(row + 1, s)]);
            }
        }
    }

    /// The finished mesh.
    pub(super) fn into_mesh(self) -> Result<TriMesh, ShapeError> {
        Ok(TriMesh::new(self.positions, self.faces)?)
    }
}

/// Cosine and sine of `step/steps` of a full turn, exactly mirrored in every octant (so exact at quarter turns).
pub(super) fn turn(step: u64, steps: u64) -> [f64; 2] {
    let (step, steps) = (u128::from(step % steps), u128::from(steps));
    let (quarter, rest) = (4 * step / steps, 4 * step % steps);
    let angle = |part: u128| part as f64 / steps as f64 * std::f64::consts::FRAC_PI_2;
    let (cos, sin) = if 2 * rest <= steps {
        (libm::cos(angle(rest)), libm::sin(angle(rest)))
    } else {
        (libm::sin(angle(steps - rest)), libm::cos(angle(steps - rest)))
    };
    match quarter {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

/// A coordinate on the line from `-size/2` to `size/2` at `step/steps`, exactly mirrored about zero.
pub(super) fn centred(size: f64, step: u32, steps: u32) -> f64 {
    let (step, steps) = (i64::from(step), i64::from(steps));
    size * ((2 * step - steps) as f64 / (2 * steps) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_exact_at_quarters_and_mirrored_elsewhere() {
        assert_eq!([0, 1, 2, 3].map(|k| turn(k, 4)), [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]);
        for (step, steps) in [(1, 7), (3, 7), (5, 12), (100, 1001), (999, 1000)] {
            let [c, s] = turn(step, steps);
            let angle = step as f64 / steps as f64 * std::f64::consts::TAU;
            assert!((c - angle.cos()).abs() < 1e-15 && (s - angle.sin()).abs() < 1e-15);
            assert_eq!(turn(steps - step, steps), [c, -s]);
        }
    }

    #[test]
    fn promises_beyond_32_bits_are_refused_before_anything_is_allocated() {
        let error = Arrays::with_capacity(3, 1 << 40).err();
        assert_eq!(error, Some(ShapeError::TooMany { what: "faces", count: 1 << 40 }));
        let error = Arrays::with_capacity(u128::MAX, 1).err();
        assert_eq!(error, Some(ShapeError::TooMany { what: "vertices", count: u64::MAX }));
    }
}
