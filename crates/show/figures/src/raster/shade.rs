//! Colours of points on faces.

use super::camera::Seen;
use super::scene::Scene;
use super::triangles::Triangle;
use crate::Rgb;
use crate::panel::Values;
use crate::view::{cross, dot, length, minus, unit};

/// Weights of ambient light, light from the eye, and light from the upper left.
const AMBIENT: f64 = 0.30;
const HEAD: f64 = 0.36;
const KEY: f64 = 0.38;

/// Unit direction to the light at the upper left: right, up, towards the eye.
const KEY_DIRECTION: [f64; 3] = [-0.36, 0.48, 0.8];

/// Strength of highlights, and their exponent as a power of two.
const HIGHLIGHT: f64 = 0.10;
const SHARPNESS: u32 = 5;

/// Edges are sharp if the cosine of the angle between normals is below this.
const SHARP: f64 = 0.5;

/// Half the width of an edge in pixels, and its opacity.
const EDGE_HALF_WIDTH: f64 = 0.5;
const EDGE_OPACITY: f64 = 0.55;

/// Edges of faces below the first height in pixels are not drawn, and those above the second are drawn with full opacity.
const EDGE_FADE: [f64; 2] = [4.0, 10.0];

/// How light falls on a place of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Light {
    /// What the colour is multiplied by.
    shade: f64,
    /// What is added to each channel.
    highlight: f64,
}

impl Light {
    /// Whether all places of a face have the same light: where the eye is in one direction from all of them.
    pub(super) fn is_constant_on_faces(scene: &Scene) -> bool {
        scene.panel.normals.is_none() && scene.camera.is_orthographic()
    }

    /// The light at a place of a face.
    pub(super) fn at(scene: &Scene, face: u32, triangle: &Triangle, [x, y]: [i32; 2]) -> Self {
        let (corners, seen) = corners(scene, face);
        let weights = in_space(triangle.weights(x, y), seen.map(|seen| scene.camera.weight(seen.near)));
        let local = mix(weights, seen.map(|seen| seen.local));
        let eye = unit(scene.camera.eye_from(local)).unwrap_or([0.0, 0.0, 1.0]);
        let normal = normal(scene, corners, seen.map(|seen| seen.local), weights, eye);
        let towards = |direction| if dot(normal, direction) > 0.0 { dot(normal, direction) } else { 0.0 };
        let shade = AMBIENT + HEAD * towards(eye) + KEY * towards(KEY_DIRECTION);
        let half = unit(std::array::from_fn(|i| eye[i] + KEY_DIRECTION[i])).unwrap_or(eye);
        let mut highlight = towards(half);
        for _ in 0..SHARPNESS {
            highlight *= highlight;
        }
        Self { shade, highlight: 255.0 * HIGHLIGHT * highlight }
    }
}

/// The colour of a place of a face under some light, each channel from 0 to 255. `dim` is a factor of all of it.
pub(super) fn color(
    scene: &Scene,
    face: u32,
    triangle: &Triangle,
    [x, y]: [i32; 2],
    light: Light,
    dim: f64,
) -> [f64; 3] {
    let (corners, seen) = corners(scene, face);
    let flat = triangle.weights(x, y);
    let weights = in_space(flat, seen.map(|seen| scene.camera.weight(seen.near)));
    let base = base(scene, face, corners, weights).map(f64::from);
    let mut color = base.map(|channel| (channel * light.shade + light.highlight) * dim);
    if scene.panel.edges {
        let opacity = edge_opacity(triangle, flat);
        let edge = scene.theme.edge.map(f64::from);
        color = std::array::from_fn(|i| color[i] + opacity * (edge[i] - color[i]));
    }
    color.map(|channel| channel.clamp(0.0, 255.0))
}

/// The vertices of a face, and where they are seen.
fn corners(scene: &Scene, face: u32) -> ([usize; 3], [Seen; 3]) {
    let corners = scene.panel.mesh.faces()[face as usize].map(|vertex| vertex as usize);
    (corners, corners.map(|vertex| scene.seen[vertex]))
}

/// Barycentric coordinates on the face in space, from those in the picture.
fn in_space(flat: [f64; 3], near: [f64; 3]) -> [f64; 3] {
    let weights: [f64; 3] = std::array::from_fn(|i| flat[i] * near[i]);
    let per_sum = 1.0 / (weights[0] + weights[1] + weights[2]);
    weights.map(|weight| weight * per_sum)
}

fn mix(weights: [f64; 3], vectors: [[f64; 3]; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        weights[0] * vectors[0][i] + weights[1] * vectors[1][i] + weights[2] * vectors[2][i]
    })
}

/// The colour before lighting.
fn base(scene: &Scene, face: u32, corners: [usize; 3], weights: [f64; 3]) -> Rgb {
    let Some(scale) = scene.scale else { return scene.theme.mesh };
    let value = match (scene.panel.values, scene.panel.vectors) {
        (Some(Values::Faces(values)), _) => values[face as usize],
        (Some(Values::Vertices(values)), _) => dot(weights, corners.map(|vertex| values[vertex])),
        (Some(Values::Corners(values)), _) => dot(weights, values[face as usize]),
        (None, Some(vectors)) => length(vectors[face as usize]),
        (None, None) => return scene.theme.mesh,
    };
    scale.color(value)
}

/// The unit normal that points towards the eye.
fn normal(
    scene: &Scene,
    corners: [usize; 3],
    local: [[f64; 3]; 3],
    weights: [f64; 3],
    eye: [f64; 3],
) -> [f64; 3] {
    let flat = unit(cross(minus(local[1], local[0]), minus(local[2], local[0]))).unwrap_or(eye);
    let smooth = scene.panel.normals.and_then(|normals| {
        let normals = corners.map(|vertex| {
            let normal = unit(normals[vertex]).map(|normal| scene.camera.turn(normal));
            normal.filter(|&normal| dot(normal, flat) > SHARP).unwrap_or(flat)
        });
        unit(mix(weights, normals))
    });
    let normal = smooth.unwrap_or(flat);
    if dot(flat, eye) < 0.0 { normal.map(|x| -x) } else { normal }
}

/// Opacity of the edge at a point of a face.
fn edge_opacity(triangle: &Triangle, weights: [f64; 3]) -> f64 {
    let heights = triangle.heights();
    let least = |values: [f64; 3]| {
        values.into_iter().fold(f64::INFINITY, |least, x| if x < least { x } else { least })
    };
    let distance = least(std::array::from_fn(|i| weights[i] * heights[i]));
    if distance > EDGE_HALF_WIDTH {
        return 0.0;
    }
    EDGE_OPACITY * ((least(heights) - EDGE_FADE[0]) / (EDGE_FADE[1] - EDGE_FADE[0])).clamp(0.0, 1.0)
}
