//! A pixel canvas for filled outlines and lines.

use crate::Puzzle;
use pompeiu_planar::{Outline, Point, fill};

/// Margin, relative to the longer side.
const MARGIN: f64 = 0.02;

/// A white picture of a region of the plane, y downwards.
pub(super) struct Canvas {
    width: usize,
    height: usize,
    low: Point,
    /// Pixels per unit.
    scale: f64,
    pixels: Vec<[u8; 3]>,
}

impl Canvas {
    /// A canvas for a box, with a resolution of `side` pixels along the longer side of the puzzle.
    pub(super) fn new(puzzle: &Puzzle, [low, high]: [Point; 2], side: f64) -> Self {
        let longer = puzzle.size().into_iter().fold(0.0, f64::max);
        let scale = side / longer;
        let margin = MARGIN * longer;
        let count = [0, 1].map(|k| ((high[k] - low[k] + 2.0 * margin) * scale).ceil().max(1.0) as usize);
        let [width, height] = count;
        let low = low.map(|x| x - margin);
        Self { width, height, low, scale, pixels: vec![[255; 3]; width * height] }
    }

    /// A position in pixels; the centre of the upper left pixel is 0, 0.
    fn to_pixels(&self, p: Point) -> Point {
        [0, 1].map(|k| (p[k] - self.low[k]) * self.scale - 0.5)
    }

    fn blend(&mut self, x: usize, y: usize, colour: [u8; 3], share: f64) {
        let pixel = &mut self.pixels[y * self.width + x];
        *pixel = [0, 1, 2].map(|k| {
            (f64::from(pixel[k]) + share * (f64::from(colour[k]) - f64::from(pixel[k]))).round() as u8
        });
    }

    /// The columns and rows that overlap a box in pixels.
    fn window(&self, [low, high]: [Point; 2], room: f64) -> [[usize; 2]; 2] {
        let most = [self.width, self.height];
        [0, 1].map(|k| {
            let at = |x: f64| (x.max(0.0) as usize).min(most[k]);
            [at(low[k] - room), at(high[k] + room + 2.0)]
        })
    }

    /// Fills an outline with a colour for each position.
    pub(super) fn fill(&mut self, points: &[Point], colour: impl Fn(Point) -> [u8; 3]) {
        let Ok(outline) = Outline::new(points.iter().map(|p| self.to_pixels(*p)).collect()) else { return };
        let [[left, right], [top, bottom]] = self.window(outline.bounds(), 1.0);
        let Ok(inside) = outline.map(|p| [p[0] - left as f64, p[1] - top as f64]) else { return };
        let (width, height) = (right - left, bottom - top);
        for (i, share) in
            fill([&inside], width, height).into_iter().enumerate().filter(|(_, share)| *share > 0.0)
        {
            let (x, y) = (left + i % width, top + i / width);
            let place =
                [(x, self.low[0]), (y, self.low[1])].map(|(i, low)| low + (i as f64 + 0.5) / self.scale);
            self.blend(x, y, colour(place), f64::from(share).min(1.0));
        }
    }

    /// Draws a line, `width` pixels wide.
    pub(super) fn stroke(&mut self, points: &[Point], width: f64, colour: [u8; 3]) {
        for pair in points.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|p| self.to_pixels(p));
            let low = [0, 1].map(|k| a[k].min(b[k]));
            let high = [0, 1].map(|k| a[k].max(b[k]));
            let [[left, right], [top, bottom]] = self.window([low, high], width);
            let u = [b[0] - a[0], b[1] - a[1]];
            let norm_sq = u[0] * u[0] + u[1] * u[1];
            for y in top..bottom {
                for x in left..right {
                    let v = [x as f64 - a[0], y as f64 - a[1]];
                    let t = if norm_sq > 0.0 {
                        ((u[0] * v[0] + u[1] * v[1]) / norm_sq).clamp(0.0, 1.0)
                    } else {
                        0.0
                    };
                    let away = libm::hypot(v[0] - t * u[0], v[1] - t * u[1]);
                    let share = (0.5 * width + 0.5 - away).clamp(0.0, 1.0);
                    if share > 0.0 {
                        self.blend(x, y, colour, share);
                    }
                }
            }
        }
    }

    /// The picture as a PNG file.
    pub(super) fn png(&self) -> Result<Vec<u8>, String> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header().map_err(|error| error.to_string())?;
        writer.write_image_data(self.pixels.as_flattened()).map_err(|error| error.to_string())?;
        writer.finish().map_err(|error| error.to_string())?;
        Ok(bytes)
    }
}
