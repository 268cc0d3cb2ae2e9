//! Where things are on the screen: coordinates relative to the middle, in single precision, and shared corners.

use std::collections::HashMap;

/// The map from the unit of the meshes to that of the view, whose scene lies between -1 and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placement {
    pub(super) origin: [f64; 3],
    /// Unit of the view, a power of two.
    pub(super) scale: f64,
}

impl Placement {
    /// Around all these points.
    pub(super) fn around<'a>(points: impl IntoIterator<Item = &'a [f64; 3]>) -> Self {
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

/// Triangles with shared corners, and corners with shared positions.
pub(super) struct Indexed {
    pub(super) positions: Vec<[f32; 3]>,
    /// The position of each corner; every one is used first in order.
    pub(super) places: Vec<u32>,
    /// One for each corner; empty where there are no values.
    pub(super) values: Vec<f64>,
    /// Three for each triangle; every corner is used first in order.
    pub(super) indices: Vec<u32>,
}

impl Indexed {
    /// Makes corners one where both their place on the screen and their value agree, bit for bit.
    pub(super) fn new(placement: Placement, corners: &[[[f64; 3]; 3]], values: Option<&[[f64; 3]]>) -> Self {
        let mut known: HashMap<(u32, u64), u32> = HashMap::with_capacity(corners.len());
        let mut known_positions: HashMap<[u32; 3], u32> = HashMap::with_capacity(corners.len() / 2);
        let indices = Vec::with_capacity(3 * corners.len());
        let mut indexed = Self { positions: vec![], places: vec![], values: vec![], indices };
        for (triangle, points) in corners.iter().enumerate() {
            for (corner, &point) in points.iter().enumerate() {
                let position = placement.place(point);
                let value = values.map(|values| values[triangle][corner]);
                let place = *known_positions.entry(position.map(f32::to_bits)).or_insert_with(|| {
                    indexed.positions.push(position);
                    indexed.positions.len() as u32 - 1
                });
                let index = *known.entry((place, value.map_or(0, f64::to_bits))).or_insert_with(|| {
                    indexed.places.push(place);
                    indexed.values.extend(value);
                    indexed.places.len() as u32 - 1
                });
                indexed.indices.push(index);
            }
        }
        indexed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_offsets_keep_their_digits() {
        let far = 1e9;
        let points = [[far, far, far], [far + 1.0, far, far], [far, far + 0.001, far]];
        let placement = Placement::around(&points);
        let [a, b, c] = points.map(|p| placement.place(p).map(f64::from).map(|x| x * placement.scale));
        assert_eq!(b[0] - a[0], 1.0);
        assert!((c[1] - a[1] - 0.001).abs() < 1e-6, "{}", c[1] - a[1]);
    }

    #[test]
    fn very_large_very_small_and_flat_scenes_fit() {
        for size in [1e300, 1.0, 1e-300] {
            let points = [[-size, 0.0, 0.0], [size, size, 0.0]];
            let placement = Placement::around(&points);
            let placed = points.map(|p| placement.place(p)[0]);
            assert!(
                placed[0] >= -1.0 && placed[1] <= 1.0 && placed[1] - placed[0] > 0.9,
                "{size} {placed:?}"
            );
        }
        assert_eq!(Placement::around(&[[3.0; 3]]), Placement { origin: [3.0; 3], scale: 1.0 });
    }

    #[test]
    fn corners_are_shared_where_place_and_value_agree() {
        let [a, b, c, d] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        let corners = [[a, b, c], [b, d, c]];
        let placement = Placement::around(corners.as_flattened());
        assert_eq!(Indexed::new(placement, &corners, None).indices, [0, 1, 2, 1, 3, 2]);
        let jump = Indexed::new(placement, &corners, Some(&[[0.0, 1.0, 2.0], [1.5, 3.0, 2.0]]));
        assert_eq!(jump.indices, [0, 1, 2, 3, 4, 2]);
        assert_eq!(jump.values, [0.0, 1.0, 2.0, 1.5, 3.0]);
        assert_eq!((jump.positions.len(), jump.places), (4, vec![0, 1, 2, 1, 3]));
    }
}
