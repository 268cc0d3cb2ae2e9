//! Pixels, and PNG.

use crate::Rgb;
use std::io::{self, Write};

/// A picture: rows of pixels from the top, each from the left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<Rgb>,
}

impl Image {
    /// A picture of these pixels, row by row from the top; `None` if their number is not width times height.
    pub fn new(width: u32, height: u32, pixels: Vec<Rgb>) -> Option<Self> {
        (pixels.len() as u64 == u64::from(width) * u64::from(height)).then_some(Self {
            width,
            height,
            pixels,
        })
    }

    /// A picture of one colour.
    pub(crate) fn filled(width: u32, height: u32, color: Rgb) -> Self {
        Self { width, height, pixels: vec![color; width as usize * height as usize] }
    }

    /// A checkerboard: `squares` along each side, each `pixels` wide. As a texture it shows the distortion of a map.
    pub fn checkerboard(squares: u32, pixels: u32, colors: [Rgb; 2]) -> Self {
        let side = squares * pixels;
        let mut image = Self::filled(side, side, colors[0]);
        for (index, color) in image.pixels.iter_mut().enumerate() {
            let (x, y) = (index as u32 % side / pixels, index as u32 / side / pixels);
            *color = colors[((x + y) % 2) as usize];
        }
        image
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, row by row from the top.
    pub fn pixels(&self) -> &[Rgb] {
        &self.pixels
    }

    /// The colour at a place, if it is in the picture.
    pub fn pixel(&self, x: u32, y: u32) -> Option<Rgb> {
        self.index(i64::from(x), i64::from(y)).map(|index| self.pixels[index])
    }

    /// Writes the picture as PNG, with eight bits per channel.
    ///
    /// # Errors
    /// Those of `out`.
    ///
    /// # Example
    /// ```
    /// # use pompeiu_figures::{Figure, FigureError};
    /// let image = Figure::new(64, 48).draw()?;
    /// let mut png = Vec::new();
    /// image.write_png(&mut png)?;
    /// assert_eq!(&png[1..4], b"PNG");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write_png(&self, out: impl Write) -> io::Result<()> {
        let mut encoder = png::Encoder::new(out, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Balanced);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.pixels.as_flattened())?;
        Ok(writer.finish()?)
    }

    fn index(&self, x: i64, y: i64) -> Option<usize> {
        let inside = 0 <= x && x < i64::from(self.width) && 0 <= y && y < i64::from(self.height);
        inside.then(|| y as usize * self.width as usize + x as usize)
    }

    /// Sets a pixel; ignored outside the picture.
    pub(crate) fn set(&mut self, x: i64, y: i64, color: Rgb) {
        if let Some(index) = self.index(x, y) {
            self.pixels[index] = color;
        }
    }

    /// Blends a colour over a pixel with an opacity; ignored outside the picture.
    pub(crate) fn blend(&mut self, x: i64, y: i64, color: Rgb, opacity: f64) {
        if let Some(index) = self.index(x, y) {
            let below = self.pixels[index];
            self.pixels[index] = std::array::from_fn(|channel| {
                let [below, above] = [below[channel], color[channel]].map(f64::from);
                (below + opacity * (above - below) + 0.5) as u8
            });
        }
    }

    /// Pictures beside and below one another, in rows from left to right, on this background.
    pub fn tiled(pictures: &[Self], columns: usize, background: Rgb) -> Self {
        let most = |side: fn(&Self) -> u32| pictures.iter().map(side).max().unwrap_or(0);
        let [width, height] = [most(Self::width), most(Self::height)];
        let columns = columns.clamp(1, pictures.len().max(1));
        let rows = pictures.len().div_ceil(columns);
        let mut whole = Self::filled(width * columns as u32, height * rows as u32, background);
        for (i, picture) in pictures.iter().enumerate() {
            let at = [(i % columns) as u32 * width, (i / columns) as u32 * height];
            whole.paste(picture, at.map(f64::from));
        }
        whole
    }

    /// Copies another picture to a place; the part outside this one is cut off.
    pub(crate) fn paste(&mut self, other: &Self, at: [f64; 2]) {
        let [left, top] = at.map(|c| (c + 0.5).floor() as i64);
        for y in 0..other.height {
            for x in 0..other.width {
                if let Some(color) = other.pixel(x, y) {
                    self.set(left + i64::from(x), top + i64::from(y), color);
                }
            }
        }
    }

    /// Fills a rectangle between two corners.
    pub(crate) fn fill(&mut self, from: [f64; 2], to: [f64; 2], color: Rgb) {
        let [[left, top], [right, bottom]] =
            [from, to].map(|corner| corner.map(|c| (c + 0.5).floor() as i64));
        for y in top..bottom {
            for x in left..right {
                self.set(x, y, color);
            }
        }
    }
}
