//! Pictures of tangent fields: streaks along the field, and arrows for its direction.
//!
//! All computation is in image space: the vector of the face visible at a pixel is projected, noise is convolved along the
//! projected field, and the streaks modulate the brightness of the mesh. Streaks end at the edge of the surface, and fade where the
//! field is weak.
//!
//! # Source
//! Line integral convolution of noise: `cabral_imaging_1993`; in image space, stopping at depth discontinuities:
//! `laramee_image_2003`. Noise is a hash of the position; contrast is derived from the length of a streak.

use super::scene::Scene;
use super::strokes::{Stroke, arrow};
use super::triangles::{NONE, Visible};
use crate::Rgb;
use crate::view::{length, unit};
use rayon::prelude::*;

/// The effect of a field on the pixels of a panel.
pub(super) struct Flow {
    size: [usize; 2],
    /// Brightness factors.
    light: Vec<f64>,
    /// Arrows.
    pub(super) arrows: Vec<Stroke>,
}

/// The field at the pixels of a panel.
struct Field<'a> {
    size: [usize; 2],
    visible: &'a Visible,
    /// Unit vectors along the projected field; zero where there is no field.
    direction: Vec<[f64; 2]>,
    /// The projected length of a unit vector, at most about 1.
    foreshortening: Vec<f64>,
    /// Difference in nearness between neighbouring pixels beyond which the surface ends.
    jump: f64,
    /// Pixels per grain of noise.
    grain: f64,
    noise: Noise,
}

/// Grains of noise across a square panel, and on each side of a pixel along a streak.
const GRAINS: f64 = 420.0;
const STREAK: f64 = 13.0;

/// Steps along a streak for each grain.
const STEPS: f64 = 2.0;

/// Contrast of streaks, and the largest relative change of brightness.
const CONTRAST: f64 = 1.5;
const DEPTH: f64 = 0.34;

/// Share of the largest magnitude below which streaks and arrows fade.
const WEAK: f64 = 0.04;

/// Largest difference in depth, in pixels, between neighbouring pixels of one surface.
const STEEP: f64 = 10.0;

/// Distance of arrows in grains; the length of the longest and the shortest arrow relative to it.
const ARROWS: f64 = 25.0;
const LONGEST: f64 = 0.8;
const SHORTEST: f64 = 0.35;

/// Width of an arrow in grains; its colour, and that of its outline.
const ARROW: f64 = 0.9;
const ARROW_COLOR: Rgb = [255, 255, 255];
const RIM_COLOR: Rgb = [24, 24, 28];

impl Flow {
    /// The flow of one vector per face over the visible surface.
    pub(super) fn new(scene: &Scene, vectors: &[[f64; 3]], visible: &Visible, size: [usize; 2]) -> Self {
        let largest = match scene.scale {
            Some(scale) => scale.range().1,
            None => {
                vectors.iter().map(|&v| length(v)).fold(0.0, |most: f64, x| if x > most { x } else { most })
            }
        };
        let strength = |face: u32| {
            let strength = length(vectors[face as usize]) / largest;
            if strength > 0.0 { strength.clamp(0.0, 1.0) } else { 0.0 }
        };
        let seen_direction = |index: usize| match visible.face[index] {
            NONE => [0.0; 2],
            face => {
                let [p, q, r] =
                    scene.panel.mesh.faces()[face as usize].map(|vertex| scene.seen[vertex as usize].local);
                let middle = std::array::from_fn(|i| (p[i] + q[i] + r[i]) / 3.0);
                scene.camera.direction(middle, vectors[face as usize])
            }
        };
        let grain = ((size[0] * size[1]) as f64).sqrt() / GRAINS;
        let projected: Vec<[f64; 2]> = (0..visible.face.len()).into_par_iter().map(seen_direction).collect();
        let along = |[x, y]: [f64; 2]| unit([x, y, 0.0]).map_or([0.0; 2], |[x, y, _]| [x, y]);
        let grain = if grain > 1.0 { grain } else { 1.0 };
        let field = Field {
            size,
            visible,
            direction: projected.par_iter().map(|&vector| along(vector)).collect(),
            foreshortening: projected.par_iter().map(|&[x, y]| length([x, y, 0.0])).collect(),
            jump: scene.camera.nearness(STEEP / scene.camera.scale),
            grain,
            noise: Noise::new(size, grain),
        };
        let light = |index: usize| match visible.face[index] {
            NONE => 1.0,
            face => {
                let strong = (strength(face) / WEAK).clamp(0.0, 1.0);
                1.0 + DEPTH * strong * (2.0 * field.streak(index) - 1.0)
            }
        };
        let light = (0..visible.face.len()).into_par_iter().map(light).collect();
        Self { size, light, arrows: field.arrows(strength) }
    }

    /// The brightness of a pixel relative to a picture without a field.
    pub(super) fn light(&self, [x, y]: [usize; 2]) -> f64 {
        self.light[y * self.size[0] + x]
    }
}

impl Field<'_> {
    /// Mean of the noise along the streamline through a pixel, stretched to the range from 0 to 1.
    fn streak(&self, index: usize) -> f64 {
        let start = [index % self.size[0], index / self.size[0]].map(|c| c as f64 + 0.5);
        let [mut sum, mut weights, mut squares] = [self.noise.at(start), 1.0, 1.0];
        let steps = (STREAK * STEPS) as usize;
        for sense in [1.0, -1.0] {
            let (mut at, mut pixel, mut along) = (start, index, self.direction[index].map(|c| sense * c));
            for step in 1..=steps {
                let Some(next) = self.step(at, pixel, along) else { break };
                (at, pixel, along) = next;
                let part = step as f64 / (steps + 1) as f64;
                // A smooth window from 1 to 0, so that streaks have no visible ends.
                let weight = (1.0 - part * part) * (1.0 - part * part);
                sum += weight * self.noise.at(at);
                weights += weight;
                squares += weight * weight;
            }
        }
        // The standard deviation of the mean of n numbers is smaller by the square root of n.
        let grains = weights * weights / squares / STEPS;
        let grains = if grains > 1.0 { grains } else { 1.0 };
        (0.5 + CONTRAST * grains.sqrt() * (sum / weights - 0.5)).clamp(0.0, 1.0)
    }

    /// One step along the streamline: the new position, its pixel and the direction there.
    fn step(&self, at: [f64; 2], pixel: usize, along: [f64; 2]) -> Option<([f64; 2], usize, [f64; 2])> {
        let reach = self.grain / STEPS;
        let half =
            self.on_surface([at[0] + 0.5 * reach * along[0], at[1] + 0.5 * reach * along[1]], pixel)?;
        let [x, y] = self.turned(half, along);
        let next = [at[0] + reach * x, at[1] + reach * y];
        let pixel = self.on_surface(next, half)?;
        let turned = self.turned(pixel, along);
        (turned != [0.0; 2]).then_some((next, pixel, turned))
    }

    /// The direction at a pixel, consistent with the previous direction.
    fn turned(&self, pixel: usize, along: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.direction[pixel];
        if x * along[0] + y * along[1] < 0.0 { [-x, -y] } else { [x, y] }
    }

    /// The pixel at a place, if it is in the panel.
    fn pixel(&self, place: [f64; 2]) -> Option<usize> {
        let inside = (0..2).all(|axis| 0.0 <= place[axis] && place[axis] < self.size[axis] as f64);
        inside.then(|| place[1] as u32 as usize * self.size[0] + place[0] as u32 as usize)
    }

    fn face_at(&self, place: [f64; 2]) -> u32 {
        self.pixel(place).map_or(NONE, |pixel| self.visible.face[pixel])
    }

    /// The pixel at a position, if the surface continues there.
    fn on_surface(&self, place: [f64; 2], from: usize) -> Option<usize> {
        let near = &self.visible.near;
        self.pixel(place)
            .filter(|&pixel| self.visible.face[pixel] != NONE && (near[pixel] - near[from]).abs() < self.jump)
    }

    /// Arrows at the points of a grid that lie on the surface; their length grows with the field strength.
    fn arrows(&self, strength: impl Fn(u32) -> f64) -> Vec<Stroke> {
        let spacing = ARROWS * self.grain;
        let [columns, rows] = self.size.map(|side| (side as f64 / spacing) as usize);
        let mut arrows = Vec::new();
        for row in 0..rows {
            for column in 0..columns {
                // Every other row is shifted, so that arrows do not line up.
                let shift = if row % 2 == 0 { 0.25 } else { 0.75 };
                let [x, y] = [column as f64 + shift, row as f64 + 0.5].map(|c| (c * spacing) as usize);
                let pixel = y * self.size[0] + x;
                let face = self.visible.face[pixel];
                if x >= self.size[0] || y >= self.size[1] || face == NONE || strength(face) < WEAK {
                    continue;
                }
                let seen = SHORTEST + (1.0 - SHORTEST) * strength(face) * self.foreshortening[pixel];
                let middle = [x, y].map(|c| c as f64 + 0.5);
                let [across, down] = self.direction[pixel].map(|c| 0.5 * LONGEST * spacing * seen * c);
                let ends = [[middle[0] - across, middle[1] - down], [middle[0] + across, middle[1] + down]];
                if ends.iter().any(|&end| self.face_at(end) == NONE) || ends[0] == ends[1] {
                    continue;
                }
                let near = self.visible.near[pixel] + 2.0 * self.jump;
                arrows.extend(arrow(ends, [near; 2], ARROW * self.grain, [ARROW_COLOR, RIM_COLOR], 0.0));
            }
        }
        arrows
    }
}

/// Numbers between 0 and 1 that vary smoothly over a grain.
struct Noise {
    /// Grains per pixel.
    per_pixel: f64,
    columns: usize,
    values: Vec<f64>,
}

impl Noise {
    fn new(size: [usize; 2], grain: f64) -> Self {
        let [columns, rows] = size.map(|side| (side as f64 / grain) as usize + 2);
        let values = (0..columns * rows).map(|i| hash((i % columns) as u32, (i / columns) as u32)).collect();
        Self { per_pixel: 1.0 / grain, columns, values }
    }

    /// The number at a position in the panel.
    fn at(&self, place: [f64; 2]) -> f64 {
        let [x, y] = place.map(|c| c * self.per_pixel);
        // Positions are nonnegative, so the cast rounds down; calling `floor` is slower.
        let [column, row] = [x, y].map(|c| c as u32);
        let upper = row as usize * self.columns + column as usize;
        let lower = upper + self.columns;
        let [right, down] = [x - f64::from(column), y - f64::from(row)];
        let mix = |a: f64, b: f64, part: f64| a + part * (b - a);
        let upper = mix(self.values[upper], self.values[upper + 1], right);
        let lower = mix(self.values[lower], self.values[lower + 1], right);
        mix(upper, lower, down)
    }
}

/// A pseudorandom number between 0 and 1, the same on every machine.
///
/// The constants are odd numbers with well-mixed bits, about half of them ones; others would do.
fn hash(x: u32, y: u32) -> f64 {
    let mut bits = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77).rotate_left(13);
    for _ in 0..2 {
        bits ^= bits >> 15;
        bits = bits.wrapping_mul(0x2c1b_3c6d);
        bits ^= bits >> 13;
        bits = bits.wrapping_mul(0x297a_2d39);
    }
    f64::from(bits ^ (bits >> 16)) / f64::from(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::super::{Camera, Tiles};
    use super::*;
    use crate::{Panel, Projection, Theme, View};
    use pompeiu_core::TriMesh;

    const SIDE: u32 = 160;

    /// The flow of one vector over a square seen from the front.
    fn over_square(vector: [f64; 3]) -> Flow {
        over_halves([vector; 2])
    }

    /// The flow of two vectors over the halves of a square seen from the front.
    fn over_halves(vectors: [[f64; 3]; 2]) -> Flow {
        let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let mesh = TriMesh::new(positions, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        let view =
            View::default().with_direction_to_eye([0.0, 0.0, 1.0]).with_projection(Projection::Orthographic);
        let panels = [Panel::new(&mesh)];
        let camera = Camera::new(&view, &panels).unwrap().fitted([SIDE; 2]);
        let seen = mesh.positions().iter().map(|&position| camera.see(position)).collect();
        let theme = &Theme::Light.colors();
        let scene = Scene { panel: &panels[0], camera: &camera, scale: None, theme, seen };
        let tiles = Tiles::new([SIDE; 2]);
        let visible = tiles.visible(&scene, &tiles.faces(&scene));
        Flow::new(&scene, &vectors, &visible, [SIDE as usize; 2])
    }

    /// Mean change of brightness over two pixels, in both directions, away from the border.
    fn changes(flow: &Flow) -> [f64; 2] {
        let inner = 10..SIDE as usize - 12;
        let pixels: Vec<[usize; 2]> =
            inner.clone().flat_map(|y| inner.clone().map(move |x| [x, y])).collect();
        [[2, 0], [0, 2]].map(|[dx, dy]| {
            let change = |&[x, y]: &[usize; 2]| (flow.light([x + dx, y + dy]) - flow.light([x, y])).abs();
            pixels.iter().map(change).sum::<f64>() / pixels.len() as f64
        })
    }

    #[test]
    fn streaks_run_along_the_field() {
        let [along, across] = changes(&over_square([2.0, 0.0, 0.0]));
        assert!(across > 0.1 && along < 0.25 * across, "{along} {across}");
        let [across, along] = changes(&over_square([0.0, 1e-200, 0.0]));
        assert!(across > 0.1 && along < 0.25 * across, "{along} {across}");
    }

    #[test]
    fn streaks_tell_no_sense_but_arrows_do() {
        let [there, back] = [1.0, -1.0].map(|sense| over_square([0.6 * sense, 0.8 * sense, 0.0]));
        let difference = |(a, b): (&f64, &f64)| (a - b).abs();
        assert!(there.light.iter().zip(&back.light).map(difference).all(|d| d < 1e-9));
        assert!(there.arrows.len() >= 4 * 4 && there.arrows.len() == back.arrows.len());
        assert!(there.arrows.iter().zip(&back.arrows).all(|(a, b)| a != b));
    }

    #[test]
    fn where_a_field_is_weak_streaks_fade_and_arrows_are_left_out() {
        let strong = over_square([1.0, 0.0, 0.0]);
        let weak = over_halves([[1.0, 0.0, 0.0], [0.01, 0.0, 0.0]]);
        assert!(weak.arrows.len() < strong.arrows.len() * 2 / 3, "{}", weak.arrows.len());
        assert!(!weak.arrows.is_empty());
        // The second half is the one at the upper left.
        let spread = |flow: &Flow| (20..60).map(|y| (flow.light([25, y]) - 1.0).abs()).sum::<f64>();
        assert!(spread(&weak) < 0.3 * spread(&strong) && spread(&weak) > 0.0);
    }

    #[test]
    fn where_there_is_no_field_nothing_is_drawn() {
        for nothing in [[0.0; 3], [f64::NAN; 3], [0.0, f64::INFINITY, 0.0], [0.0, 0.0, 1.0]] {
            let flow = over_square(nothing);
            assert!(flow.arrows.is_empty(), "{nothing:?}");
            assert!(flow.light.iter().all(|light| light.is_finite()), "{nothing:?}");
        }
        assert!(over_square([0.0; 3]).light.iter().all(|&light| light == 1.0));
    }
}
