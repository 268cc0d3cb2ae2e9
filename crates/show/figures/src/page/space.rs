//! Coordinates of the view: relative to the centre of a space, in single precision.

/// One of the axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Axis {
    /// The first.
    X,
    /// The second, up in most graphics formats.
    #[default]
    Y,
    /// The third, up in most engineering files.
    Z,
}

impl Axis {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        }
    }
}

/// A coordinate system with one camera, shared by scenes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Space {
    /// Three dimensions, with this axis up at first.
    Spatial(Axis),
    /// The plane of the first two coordinates, seen from the front: it can be panned and zoomed, but not rotated.
    #[default]
    Plane,
}

/// The map from the unit of the meshes to that of the view, in which the scene lies between -1 and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placement {
    pub(super) origin: [f64; 3],
    /// Unit of the view, a power of two.
    pub(super) scale: f64,
}

impl Placement {
    /// The placement of the bounding box of all points.
    pub(super) fn around(points: impl IntoIterator<Item = [f64; 3]>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for point in points {
            for k in 0..3 {
                if point[k] < low[k] {
                    low[k] = point[k];
                }
                if point[k] > high[k] {
                    high[k] = point[k];
                }
            }
        }
        if low[0] > high[0] {
            return Self { origin: [0.0; 3], scale: 1.0 };
        }
        let origin = [0, 1, 2].map(|k| low[k] / 2.0 + high[k] / 2.0);
        let half = (0..3).map(|k| high[k] / 2.0 - low[k] / 2.0).fold(0.0, |a, b| if b > a { b } else { a });
        let scale =
            if half > 0.0 { 2_f64.powi(half.log2().ceil().clamp(-1000.0, 1000.0) as i32) } else { 1.0 };
        Self { origin, scale }
    }

    pub(super) fn place(&self, point: [f64; 3]) -> [f32; 3] {
        [0, 1, 2].map(|k| ((point[k] - self.origin[k]) / self.scale) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_offsets_keep_their_digits() {
        let far = 1e9;
        let points = [[far, far, far], [far + 1.0, far, far], [far, far + 0.001, far]];
        let placement = Placement::around(points);
        let [a, b, c] = points.map(|p| placement.place(p).map(f64::from).map(|x| x * placement.scale));
        assert_eq!(b[0] - a[0], 1.0);
        assert!((c[1] - a[1] - 0.001).abs() < 1e-6, "{}", c[1] - a[1]);
    }

    #[test]
    fn very_large_very_small_and_flat_scenes_fit() {
        for size in [1e300, 1.0, 1e-300] {
            let points = [[-size, 0.0, 0.0], [size, size, 0.0]];
            let placement = Placement::around(points);
            let placed = points.map(|p| placement.place(p)[0]);
            assert!(
                placed[0] >= -1.0 && placed[1] <= 1.0 && placed[1] - placed[0] > 0.9,
                "{size} {placed:?}"
            );
        }
        assert_eq!(Placement::around([[3.0; 3]]), Placement { origin: [3.0; 3], scale: 1.0 });
    }
}
