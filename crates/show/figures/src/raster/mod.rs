//! Rasterising meshes.
//!
//! A panel is divided into square tiles. In each tile, first the nearest face is found at every sample, several per pixel. Then
//! each sample gets the colour of the value interpolated there, marks are drawn over the samples, and a pixel is the mean of its
//! samples. Tiles are independent, so the picture is the same for any number of threads.

#![allow(clippy::cast_possible_wrap, reason = "pixels are counted to 2^14, places of the fine grid to 2^24")]

mod camera;
mod flow;
mod scene;
mod shade;
mod strokes;
#[cfg(test)]
mod tests;
mod triangles;

pub(crate) use camera::Camera;

use crate::image::Image;
use crate::theme::Colors;
use crate::{Panel, Rgb, Scale};
use flow::Flow;
use rayon::prelude::*;
use scene::Scene;
use shade::Light;
use strokes::Stroke;
use triangles::{Grid, NONE, PIXEL, Triangle, Visible};

/// Side of a tile in pixels: the samples of a tile fit into the second-level cache.
const TILE: u32 = 64;

/// Samples per pixel along each axis.
const SAMPLES: u32 = 3;

/// Draws a panel.
pub(crate) fn render(
    panel: &Panel,
    camera: &Camera,
    scale: Option<&Scale>,
    theme: &Colors,
    size: [u32; 2],
) -> Image {
    let seen = panel.mesh.positions().par_iter().map(|&position| camera.see(position)).collect();
    let scene = Scene { panel, camera, scale, theme, seen };
    let tiles = Tiles::new(size);
    let faces = tiles.faces(&scene);
    let flow = panel.vectors.map(|vectors| {
        let visible = tiles.visible(&scene, &faces);
        Flow::new(&scene, vectors, &visible, size.map(|side| side as usize))
    });
    let arrows = flow.iter().flat_map(|flow| flow.arrows.iter().copied());
    let marks = panel.marks.iter().flat_map(|mark| strokes::strokes(mark, camera, theme));
    let strokes: Vec<Stroke> = arrows.chain(marks).collect();
    let drawn: Vec<Vec<Rgb>> = (0..tiles.count())
        .into_par_iter()
        .map(|tile| draw_tile(&scene, flow.as_ref(), &strokes, &tiles.grid(tile, SAMPLES), &faces[tile]))
        .collect();
    let mut image = Image::filled(size[0], size[1], theme.background);
    for (tile, pixels) in drawn.iter().enumerate() {
        let grid = tiles.grid(tile, 1);
        for (index, &color) in pixels.iter().enumerate() {
            let [x, y] = grid.pixel([index % grid.size[0], index / grid.size[0]]);
            image.set(x as i64, y as i64, color);
        }
    }
    image
}

/// The tiles of a panel.
struct Tiles {
    size: [u32; 2],
    columns: u32,
    rows: u32,
}

impl Tiles {
    fn new(size: [u32; 2]) -> Self {
        Self { size, columns: size[0].div_ceil(TILE), rows: size[1].div_ceil(TILE) }
    }

    fn count(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// The samples of a tile.
    fn grid(&self, tile: usize, per_pixel: u32) -> Grid {
        let at = [tile as u32 % self.columns, tile as u32 / self.columns];
        let start = at.map(|tile| tile * TILE);
        let size = [0, 1].map(|axis| ((self.size[axis] - start[axis]).min(TILE) * per_pixel) as usize);
        Grid { start, size, per_pixel }
    }

    /// The face visible at the centre of each pixel of the panel.
    fn visible(&self, scene: &Scene, faces: &[Vec<u32>]) -> Visible {
        let tiles: Vec<(Grid, Visible)> = (0..self.count())
            .into_par_iter()
            .map(|tile| {
                let grid = self.grid(tile, 1);
                (grid, see(scene, &grid, &faces[tile]))
            })
            .collect();
        let width = self.size[0] as usize;
        let mut all = Visible::nothing(&Grid {
            start: [0; 2],
            size: self.size.map(|side| side as usize),
            per_pixel: 1,
        });
        for (grid, part) in tiles {
            for index in 0..part.face.len() {
                let [x, y] = grid.pixel([index % grid.size[0], index / grid.size[0]]);
                all.face[y * width + x] = part.face[index];
                all.near[y * width + x] = part.near[index];
            }
        }
        all
    }

    /// The faces that may be visible in each tile, in index order.
    fn faces(&self, scene: &Scene) -> Vec<Vec<u32>> {
        /// Faces sorted into tiles per task.
        const CHUNK: usize = 1 << 16;
        let faces = scene.panel.mesh.faces().len();
        let chunks: Vec<Vec<Vec<u32>>> = (0..faces.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let mut tiles = vec![Vec::new(); self.count()];
                for face in chunk * CHUNK..faces.min((chunk + 1) * CHUNK) {
                    let Some(triangle) = scene.triangle(face as u32) else { continue };
                    let [low, high] =
                        triangle.bounds().map(|corner| corner.map(|c| c.div_euclid(PIXEL * TILE as i32)));
                    for row in low[1].max(0)..=high[1].min(self.rows as i32 - 1) {
                        for column in low[0].max(0)..=high[0].min(self.columns as i32 - 1) {
                            tiles[row as usize * self.columns as usize + column as usize].push(face as u32);
                        }
                    }
                }
                tiles
            })
            .collect();
        (0..self.count())
            .map(|tile| chunks.iter().flat_map(|tiles| tiles[tile].iter().copied()).collect())
            .collect()
    }
}

/// The face visible at each sample, among a list of faces.
fn see(scene: &Scene, grid: &Grid, faces: &[u32]) -> Visible {
    let mut visible = Visible::nothing(grid);
    for &face in faces {
        if let Some(triangle) = scene.triangle(face) {
            visible.draw(grid, face, &triangle);
        }
    }
    visible
}

/// The pixels of a tile.
fn draw_tile(scene: &Scene, flow: Option<&Flow>, strokes: &[Stroke], grid: &Grid, faces: &[u32]) -> Vec<Rgb> {
    let visible = see(scene, grid, faces);
    let background = scene.theme.background.map(f64::from);
    let mut colors = vec![background; visible.face.len()];
    let mut faces = LitFaces::new(scene);
    for pixel in grid.pixels() {
        faces.next_pixel();
        for [column, row] in grid.samples(pixel) {
            let index = row * grid.size[0] + column;
            let (face, place) = (visible.face[index], grid.place(column, row));
            if face != NONE
                && let Some((triangle, light)) = faces.of(face, place)
            {
                let dim = flow.map_or(1.0, |flow| flow.light(grid.pixel([column, row])));
                colors[index] = shade::color(scene, face, triangle, place, *light, dim);
            }
        }
    }
    for stroke in strokes {
        lay_over(stroke, grid, &visible, &mut colors);
    }
    means(grid, &colors)
}

/// The faces seen in a pixel. A flat one has the same light at all its samples in a pixel, for only the direction to the eye differs.
struct LitFaces<'s> {
    scene: &'s Scene<'s>,
    is_constant: bool,
    here: Vec<(u32, Triangle, Light)>,
    /// Those of the pixel before.
    before: Vec<(u32, Triangle, Light)>,
}

impl<'s> LitFaces<'s> {
    fn new(scene: &'s Scene<'s>) -> Self {
        let is_constant = Light::is_constant_on_faces(scene);
        Self { scene, is_constant, here: Vec::new(), before: Vec::new() }
    }

    fn next_pixel(&mut self) {
        std::mem::swap(&mut self.here, &mut self.before);
        self.here.clear();
    }

    /// A face of which a place is seen in the pixel, and its light there; `None` if it has no area in the picture.
    fn of(&mut self, face: u32, place: [i32; 2]) -> Option<(&Triangle, &Light)> {
        let at = self.here.iter().position(|(known, ..)| *known == face);
        let at = if let Some(at) = at {
            if self.scene.panel.normals.is_some() {
                self.here[at].2 = Light::at(self.scene, face, &self.here[at].1, place);
            }
            at
        } else {
            self.here.push(self.lit(face, place)?);
            self.here.len() - 1
        };
        self.here.get(at).map(|(_, triangle, light)| (triangle, light))
    }

    fn lit(&self, face: u32, place: [i32; 2]) -> Option<(u32, Triangle, Light)> {
        let known = self.before.iter().find(|(known, ..)| *known == face).copied();
        if self.is_constant && known.is_some() {
            return known;
        }
        let triangle = known.map(|(_, triangle, _)| triangle).or_else(|| self.scene.triangle(face))?;
        Some((face, triangle, Light::at(self.scene, face, &triangle, place)))
    }
}

/// Draws a stroke over samples.
fn lay_over(stroke: &Stroke, grid: &Grid, visible: &Visible, colors: &mut [[f64; 3]]) {
    let [low, high] = stroke.bounds();
    let pixels = |axis: usize| {
        let first = f64::from(grid.start[axis]);
        let last = grid.size[axis] / grid.per_pixel as usize;
        let from = (low[axis] - first).floor().clamp(0.0, last as f64) as usize;
        let to = (high[axis] - first).ceil().clamp(0.0, last as f64) as usize;
        from * grid.per_pixel as usize..to * grid.per_pixel as usize
    };
    for row in pixels(1) {
        for column in pixels(0) {
            let index = row * grid.size[0] + column;
            let place = grid.place(column, row).map(|c| f64::from(c) / f64::from(PIXEL));
            if let Some((color, opacity)) = stroke.at(place, visible.near[index]) {
                let below = colors[index];
                colors[index] =
                    std::array::from_fn(|i| below[i] + opacity * (f64::from(color[i]) - below[i]));
            }
        }
    }
}

/// One pixel for the mean of its samples.
fn means(grid: &Grid, colors: &[[f64; 3]]) -> Vec<Rgb> {
    let side = grid.per_pixel as usize;
    let [columns, rows] = grid.size.map(|size| size / side);
    let share = 1.0 / (side * side) as f64;
    let mut pixels = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        for column in 0..columns {
            let mut sum = [0.0; 3];
            for sample in 0..side * side {
                let [x, y] = [column * side + sample % side, row * side + sample / side];
                let color = colors[y * grid.size[0] + x];
                sum = std::array::from_fn(|i| sum[i] + color[i]);
            }
            pixels.push(sum.map(|channel| (channel * share + 0.5) as u8));
        }
    }
    pixels
}
