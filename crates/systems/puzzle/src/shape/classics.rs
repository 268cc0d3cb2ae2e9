//! Built-in piece shapes.

use pompeiu_planar::{Outline, Point, catmull_rom};

/// A built-in piece shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PieceName {
    /// A square.
    Square,
    /// A regular hexagon.
    Hexagon,
    /// A square with knobs on two opposite sides and slots in the other two.
    Classic,
    /// A square with knobs on two adjacent sides and slots in the other two.
    Corner,
    /// A fish.
    Fish,
    /// A bird.
    Bird,
    /// A star with five points.
    Star,
}

impl PieceName {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Square, Self::Hexagon, Self::Classic, Self::Corner, Self::Fish, Self::Bird, Self::Star];

    /// The name in the command and in Python.
    pub fn name(self) -> &'static str {
        match self {
            Self::Square => "square",
            Self::Hexagon => "hexagon",
            Self::Classic => "classic",
            Self::Corner => "corner",
            Self::Fish => "fish",
            Self::Bird => "bird",
            Self::Star => "star",
        }
    }

    /// The shape with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|shape| shape.name() == name)
    }

    /// The corners, counter-clockwise with y upwards, in arbitrary units.
    pub(crate) fn points(self) -> Vec<Point> {
        match self {
            Self::Square => vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            Self::Hexagon => ring(6, |_| 1.0),
            Self::Star => ring(10, |i| if i % 2 == 0 { 1.0 } else { 0.5 }),
            Self::Classic => tabbed([1.0, -1.0, 1.0, -1.0]),
            Self::Corner => tabbed([1.0, 1.0, -1.0, -1.0]),
            Self::Fish => catmull_rom(&FISH, 6),
            Self::Bird => catmull_rom(&BIRD, 6),
        }
    }

    /// The shape as an outline.
    pub fn outline(self) -> Option<Outline> {
        Outline::new(self.points()).ok()
    }
}

fn ring(count: usize, radius: impl Fn(usize) -> f64) -> Vec<Point> {
    let at = |i: usize| {
        let (sine, cosine) = libm::sincos(std::f64::consts::TAU * i as f64 / count as f64);
        [radius(i) * cosine, radius(i) * sine]
    };
    (0..count).map(at).collect()
}

/// Points around the head of a knob.
const HEAD: usize = 16;

/// A unit square with a knob (1) or a slot (−1) on each side, starting with the lower side.
fn tabbed(sides: [f64; 4]) -> Vec<Point> {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let (neck, radius, centre) = (0.07, 0.115, 0.16);
    let from = libm::asin(neck / radius);
    let mut points = Vec::new();
    for (k, out) in sides.into_iter().enumerate() {
        let (a, b) = (corners[k], corners[(k + 1) % 4]);
        let along = [b[0] - a[0], b[1] - a[1]];
        let outward = [along[1] * out, -along[0] * out];
        let at = |x: f64, y: f64| [0, 1].map(|i| a[i] + along[i] * x + outward[i] * y);
        points.extend([a, at(0.5 - neck, 0.0)]);
        for i in 0..=HEAD {
            let angle = from + (std::f64::consts::TAU - 2.0 * from) * i as f64 / HEAD as f64;
            let (sine, cosine) = libm::sincos(angle);
            points.push(at(0.5 - radius * sine, centre - radius * cosine));
        }
        points.push(at(0.5 + neck, 0.0));
    }
    points
}

const FISH: [Point; 16] = [
    [2.1, 0.05],
    [1.75, 0.42],
    [1.2, 0.68],
    [0.5, 0.75],
    [-0.2, 0.6],
    [-0.8, 0.3],
    [-1.3, 0.62],
    [-1.6, 0.7],
    [-1.42, 0.05],
    [-1.6, -0.6],
    [-1.3, -0.52],
    [-0.8, -0.22],
    [-0.2, -0.5],
    [0.5, -0.65],
    [1.2, -0.58],
    [1.75, -0.34],
];

const BIRD: [Point; 20] = [
    [2.0, 0.62],
    [1.62, 0.82],
    [1.25, 0.72],
    [0.9, 0.5],
    [0.55, 0.62],
    [0.2, 1.15],
    [-0.25, 1.5],
    [-0.35, 1.05],
    [-0.3, 0.55],
    [-0.8, 0.3],
    [-1.7, 0.35],
    [-1.75, 0.0],
    [-1.1, -0.2],
    [-0.5, -0.35],
    [-0.15, -0.85],
    [0.2, -0.75],
    [0.35, -0.4],
    [0.9, -0.25],
    [1.3, 0.05],
    [1.55, 0.4],
];

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_planar::first_crossing;

    #[test]
    fn built_in_shapes_are_simple_and_have_names() {
        for shape in PieceName::ALL {
            let outline = shape.outline().unwrap();
            assert_eq!(first_crossing(&outline), None, "{}", shape.name());
            assert_eq!(PieceName::named(shape.name()), Some(shape));
        }
        // Knobs and slots have equal areas.
        for shape in [PieceName::Classic, PieceName::Corner] {
            assert!((shape.outline().unwrap().area() - 1.0).abs() < 1e-12);
        }
    }
}
