//! Viewing direction and projection.

use crate::FigureError;

/// Perspective or orthographic projection.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projection {
    /// Nearer objects are larger.
    #[default]
    Perspective,
    /// Size does not depend on depth.
    Orthographic,
}

/// Viewing direction and projection, shared by all panels of a figure.
///
/// The position of the camera is derived from the meshes: all meshes and marks together fill the panel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct View {
    up: Option<[f64; 3]>,
    towards_eye: Option<[f64; 3]>,
    pub(crate) projection: Projection,
}

/// Default direction of the eye: 32 degrees to the side and 22 degrees up from the front; the tangents of half these angles.
const ROUND: f64 = 0.286_745_385_758_808;
const ELEVATION: f64 = 0.194_380_309_137_718;

impl View {
    /// Sets the up direction in the picture, by default `[0, 1, 0]`.
    #[must_use]
    pub fn with_up(mut self, up: [f64; 3]) -> Self {
        self.up = Some(up);
        self
    }

    /// Sets the direction from the meshes to the eye.
    ///
    /// The default is from the front (from greater z if y is up, from smaller y if z is up), slightly to the right and above.
    #[must_use]
    pub fn with_direction_to_eye(mut self, direction: [f64; 3]) -> Self {
        self.towards_eye = Some(direction);
        self
    }

    /// Sets the projection.
    #[must_use]
    pub fn with_projection(mut self, projection: Projection) -> Self {
        self.projection = projection;
        self
    }

    /// Unit vectors to the right, up, and to the eye.
    ///
    /// # Errors
    /// [`FigureError::Direction`] for a direction that is zero or not finite.
    pub fn frame(&self) -> Result<[[f64; 3]; 3], FigureError> {
        let direction =
            |given: [f64; 3], what| unit(given).ok_or(FigureError::Direction { what, direction: given });
        let up = self.up.map_or(Ok([0.0, 1.0, 0.0]), |up| direction(up, "up"))?;
        let eye = match self.towards_eye {
            Some(towards_eye) => direction(towards_eye, "to the eye")?,
            None => three_quarter(up),
        };
        // Seen from directly above, the default front is at the bottom of the picture.
        let right =
            unit(cross(up, eye)).or_else(|| unit(cross(front(up), up))).or_else(|| unit(perpendicular(eye)));
        let right = match right {
            Some(right) if dot(right, eye).abs() < 0.5 => right,
            _ => unit(perpendicular(eye)).unwrap_or([1.0, 0.0, 0.0]),
        };
        Ok([right, cross(eye, right), eye])
    }
}

/// The direction that objects face, for a given up direction: y up as in animation, z up as in surveying.
fn front(up: [f64; 3]) -> [f64; 3] {
    let front = if up[2].abs() > up[1].abs() { [0.0, -1.0, 0.0] } else { [0.0, 0.0, 1.0] };
    let along = dot(front, up);
    unit(std::array::from_fn(|i| front[i] - along * up[i])).unwrap_or([1.0, 0.0, 0.0])
}

/// From the front, slightly to the right and above.
fn three_quarter(up: [f64; 3]) -> [f64; 3] {
    let front = front(up);
    let right = cross(up, front);
    let circle = |half: f64| [(1.0 - half * half) / (1.0 + half * half), 2.0 * half / (1.0 + half * half)];
    let [ahead, aside] = circle(ROUND);
    let [level, above] = circle(ELEVATION);
    std::array::from_fn(|i| level * (ahead * front[i] + aside * right[i]) + above * up[i])
}

/// A vector perpendicular to a unit vector.
fn perpendicular(v: [f64; 3]) -> [f64; 3] {
    let least = (0..3).fold(0, |least, i| if v[i].abs() < v[least].abs() { i } else { least });
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    cross(v, axis)
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// The length of a vector; infinite or NaN if a coordinate is.
pub(crate) fn length(v: [f64; 3]) -> f64 {
    let largest = v.iter().fold(0.0, |largest: f64, x| if x.abs() <= largest { largest } else { x.abs() });
    if largest > 0.0 && largest.is_finite() {
        let scaled = v.map(|x| x / largest);
        largest * dot(scaled, scaled).sqrt()
    } else {
        v[0].abs() + v[1].abs() + v[2].abs()
    }
}

/// A vector scaled to unit length; `None` for zero, infinite and NaN.
pub(crate) fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let largest = v.iter().fold(0.0, |largest: f64, x| if x.abs() <= largest { largest } else { x.abs() });
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let scaled = v.map(|x| x / largest);
    let length = dot(scaled, scaled).sqrt();
    length.is_finite().then(|| scaled.map(|x| x / length))
}
