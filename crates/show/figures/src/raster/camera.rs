//! Projection from space to the picture.

use crate::view::{Projection, View, dot, minus, unit};
use crate::{FigureError, Panel, panel::MarkShape};

/// Distance of the eye from the centre, in units of the largest half extent. All geometry lies within the square root of 3, so
/// nothing comes near the eye, and no clipping is needed.
const EYE: f64 = 6.0;

/// Share of a panel that stays empty on each side.
const MARGIN: f64 = 0.035;

/// A point in camera coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Seen {
    /// Right, up and towards the eye, in units of the largest half extent.
    pub(crate) local: [f64; 3],
    /// Pixels from the left and from the top.
    pub(crate) at: [f64; 2],
    /// Increases towards the eye; linear over the picture on every plane.
    pub(crate) near: f64,
}

/// Position and scale of the camera.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    frame: [[f64; 3]; 3],
    projection: Projection,
    centre: [f64; 3],
    extent: f64,
    /// Bounds of the projected geometry on the picture plane.
    bounds: [[f64; 2]; 2],
    /// Pixels per unit of the plane.
    pub(crate) scale: f64,
    /// The pixel of the centre of the projected geometry.
    middle: [f64; 2],
}

/// Extends bounds to a point, ignoring NaN coordinates.
fn widen<const N: usize>(bounds: &mut [[f64; N]; 2], point: [f64; N]) {
    for i in 0..N {
        if point[i] < bounds[0][i] {
            bounds[0][i] = point[i];
        }
        if point[i] > bounds[1][i] {
            bounds[1][i] = point[i];
        }
    }
}

/// Calls `visit` with every point shown by a panel.
fn for_each_point(panel: &Panel, mut visit: impl FnMut([f64; 3])) {
    let positions = panel.mesh.positions();
    let mut used = vec![false; positions.len()];
    for &vertex in panel.mesh.faces().as_flattened() {
        used[vertex as usize] = true;
    }
    positions.iter().zip(&used).filter(|(_, used)| **used).for_each(|(&position, _)| visit(position));
    for mark in &panel.marks {
        match mark.shape {
            MarkShape::Point(at) => visit_if_drawn(&[at], &mut visit),
            MarkShape::Segment(ends) | MarkShape::Arrow(ends) => visit_if_drawn(&ends, &mut visit),
        }
    }
}

fn visit_if_drawn(points: &[[f64; 3]], visit: &mut impl FnMut([f64; 3])) {
    if points.iter().all(|&point| is_drawn(point)) {
        for &point in points {
            visit(point);
        }
    }
}

/// Whether a mark can be drawn at a point: in the range of vertex positions.
pub(crate) fn is_drawn(point: [f64; 3]) -> bool {
    point.iter().all(|x| x.abs() <= pompeiu_core::TriMesh::MAX_COORDINATE)
}

impl Camera {
    /// A camera that sees all panels' meshes and marks.
    pub(crate) fn new(view: &View, panels: &[Panel]) -> Result<Self, FigureError> {
        let mut space = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for panel in panels {
            for_each_point(panel, |point| widen(&mut space, point));
        }
        if panels.is_empty() {
            space = [[0.0; 3]; 2];
        }
        let centre = std::array::from_fn(|i| 0.5 * space[0][i] + 0.5 * space[1][i]);
        let half = space
            .map(|end| minus(end, centre))
            .into_iter()
            .flatten()
            .fold(0.0, |half: f64, x| if x.abs() > half { x.abs() } else { half });
        let extent = if half > 0.0 { half } else { 1.0 };
        let mut camera = Self {
            frame: view.frame()?,
            projection: view.projection,
            centre,
            extent,
            bounds: [[0.0; 2]; 2],
            scale: 1.0,
            middle: [0.0; 2],
        };
        let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for panel in panels {
            for_each_point(panel, |point| widen(&mut bounds, camera.plane(camera.local(point)).0));
        }
        if !panels.is_empty() {
            camera.bounds = bounds;
        }
        Ok(camera)
    }

    /// Pixels per unit of the plane for a panel of this size.
    pub(crate) fn scale_for(&self, size: [f64; 2]) -> f64 {
        let [width, height] = [0, 1].map(|i| {
            let seen = self.bounds[1][i] - self.bounds[0][i];
            if seen > 0.0 { size[i] * (1.0 - 2.0 * MARGIN) / seen } else { f64::INFINITY }
        });
        let scale = if width < height { width } else { height };
        // A single point has no extent: any scale will do.
        if scale.is_finite() { scale } else { 1.0 }
    }

    /// The camera for panels of this size in pixels.
    pub(crate) fn fitted(mut self, size: [u32; 2]) -> Self {
        let size = size.map(f64::from);
        self.scale = self.scale_for(size);
        self.middle = size.map(|side| 0.5 * side);
        self
    }

    fn local(&self, position: [f64; 3]) -> [f64; 3] {
        let offset = minus(position, self.centre).map(|x| x / self.extent);
        self.frame.map(|axis| dot(axis, offset))
    }

    /// Position on the picture plane, and nearness.
    fn plane(&self, [x, y, z]: [f64; 3]) -> ([f64; 2], f64) {
        match self.projection {
            Projection::Perspective => {
                let near = EYE / (EYE - z);
                ([x * near, y * near], near)
            }
            Projection::Orthographic => ([x, y], z),
        }
    }

    /// A position in camera coordinates.
    pub(crate) fn see(&self, position: [f64; 3]) -> Seen {
        let local = self.local(position);
        let ([x, y], near) = self.plane(local);
        let [left, top] = [0, 1].map(|i| 0.5 * self.bounds[0][i] + 0.5 * self.bounds[1][i]);
        let at = [self.middle[0] + self.scale * (x - left), self.middle[1] - self.scale * (y - top)];
        Seen { local, at, near }
    }

    /// Weight of a corner when values are interpolated with perspective correction.
    pub(crate) fn weight(&self, near: f64) -> f64 {
        match self.projection {
            Projection::Perspective => near,
            Projection::Orthographic => 1.0,
        }
    }

    /// Whether the eye is in the same direction from everywhere.
    pub(crate) fn is_orthographic(&self) -> bool {
        self.projection == Projection::Orthographic
    }

    /// Change of nearness over a depth near the centre.
    pub(crate) fn nearness(&self, depth: f64) -> f64 {
        match self.projection {
            Projection::Perspective => depth / EYE,
            Projection::Orthographic => depth,
        }
    }

    /// A direction in camera coordinates.
    pub(crate) fn turn(&self, direction: [f64; 3]) -> [f64; 3] {
        self.frame.map(|axis| dot(axis, direction))
    }

    /// The projection of a unit vector along a direction at a point: right and down, foreshortened; zero for an invalid direction.
    pub(crate) fn direction(&self, local: [f64; 3], direction: [f64; 3]) -> [f64; 2] {
        let Some(direction) = unit(direction) else { return [0.0; 2] };
        let [right, up, eye] = self.turn(direction);
        match self.projection {
            Projection::Perspective => {
                let near = EYE / (EYE - local[2]);
                let grows = near * near / EYE * eye;
                [right * near + local[0] * grows, -(up * near + local[1] * grows)]
            }
            Projection::Orthographic => [right, -up],
        }
    }

    /// The vector from a point to the eye, in camera coordinates.
    pub(crate) fn eye_from(&self, local: [f64; 3]) -> [f64; 3] {
        match self.projection {
            Projection::Perspective => [-local[0], -local[1], EYE - local[2]],
            Projection::Orthographic => [0.0, 0.0, 1.0],
        }
    }
}
