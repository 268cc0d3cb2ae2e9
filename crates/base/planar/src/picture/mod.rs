//! Pictures in PNG, JPEG, GIF or BMP format, as grey levels or in colour.

mod bmp;
mod decode;

use std::fmt;

/// A picture as grey levels from 0 (black) to 1 (white), row by row from the top.
///
/// Colours become luminance (Rec. 601 weights of the stored values). Transparent pixels are composited on white, unless opacity has
/// more contrast than colour: then the level is 1 − opacity.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    width: usize,
    height: usize,
    levels: Vec<f32>,
}

/// A kind of picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// Portable Network Graphics.
    Png,
    /// JPEG.
    Jpeg,
    /// The first picture of a GIF.
    Gif,
    /// Windows bitmap, uncompressed.
    Bmp,
}

impl fmt::Display for PictureFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
            Self::Gif => "GIF",
            Self::Bmp => "BMP",
        })
    }
}

/// Why bytes cannot be read as a picture.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The format is not recognised.
    #[error("the content is no PNG, JPEG, GIF or BMP picture")]
    Unrecognised,
    /// There are too many pixels.
    #[error("the picture has {width} × {height} pixels; at most {most} in all are read", most = Picture::MAX_PIXELS)]
    Large {
        /// Pixels in a row.
        width: u64,
        /// Rows.
        height: u64,
    },
    /// There are no pixels.
    #[error("the picture has {width} × {height} pixels; at least one is needed")]
    Empty {
        /// Pixels in a row.
        width: u64,
        /// Rows.
        height: u64,
    },
    /// The picture is damaged, truncated, or of an unsupported kind.
    #[error("the {format} picture cannot be read: {why}")]
    Damaged {
        /// The recognised format.
        format: PictureFormat,
        /// What is wrong.
        why: String,
    },
}

impl Picture {
    /// The most pixels that are read: 64 million.
    pub const MAX_PIXELS: u64 = 1 << 26;

    /// A picture of these levels, row by row from the top; `None` if their number is not width times height, or is 0.
    pub fn new(width: usize, height: usize, levels: Vec<f32>) -> Option<Self> {
        (width.checked_mul(height) == Some(levels.len()) && !levels.is_empty()).then_some(Self {
            width,
            height,
            levels,
        })
    }

    /// Reads a file's content, whose format is recognised by its first bytes.
    ///
    /// # Errors
    /// [`PictureError`]. Nothing is allocated for a size in a header beyond [`Picture::MAX_PIXELS`].
    pub fn read(bytes: &[u8]) -> Result<Self, PictureError> {
        let found = Pixels::read(bytes)?;
        Ok(Self { width: found.width, height: found.height, levels: found.levels() })
    }

    /// Pixels in a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The levels, row by row from the top.
    pub fn levels(&self) -> &[f32] {
        &self.levels
    }
}

/// A picture in colour, row by row from the top, composited on white.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColourPicture {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 3]>,
}

impl ColourPicture {
    /// Reads a file's content, as [`Picture::read`] does.
    ///
    /// # Errors
    /// [`PictureError`].
    pub fn read(bytes: &[u8]) -> Result<Self, PictureError> {
        let found = Pixels::read(bytes)?;
        let on_white = |[red, green, blue, opacity]: [u8; 4]| {
            let opacity = u16::from(opacity);
            [red, green, blue].map(|c| ((u16::from(c) * opacity + 255 * (255 - opacity) + 127) / 255) as u8)
        };
        let pixels = found.rgba.into_iter().map(on_white).collect();
        Ok(Self { width: found.width, height: found.height, pixels })
    }

    /// Pixels in a row, and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The colour of the pixel at a place, in pixels from the upper left corner; outside the picture, that of the nearest pixel.
    pub fn at(&self, [x, y]: [f64; 2]) -> [u8; 3] {
        let index = |v: f64, count: usize| (v.max(0.0) as usize).min(count - 1);
        self.pixels[index(y, self.height) * self.width + index(x, self.width)]
    }
}

impl PictureFormat {
    /// The format whose first bytes these are.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        [
            (Self::Png, &b"\x89PNG\r\n\x1a\n"[..]),
            (Self::Jpeg, b"\xff\xd8\xff"),
            (Self::Gif, b"GIF87a"),
            (Self::Gif, b"GIF89a"),
            (Self::Bmp, b"BM"),
        ]
        .into_iter()
        .find_map(|(format, start)| bytes.starts_with(start).then_some(format))
    }
}

/// The number of pixels, if it is within the limit.
fn pixels(width: u64, height: u64) -> Result<usize, PictureError> {
    match width.checked_mul(height) {
        Some(0) => Err(PictureError::Empty { width, height }),
        Some(count) if count <= Picture::MAX_PIXELS => Ok(count as usize),
        _ => Err(PictureError::Large { width, height }),
    }
}

/// Pixels of red, green, blue and opacity, each from 0 to 255.
struct Pixels {
    width: usize,
    height: usize,
    rgba: Vec<[u8; 4]>,
    has_opacity: bool,
}

impl Pixels {
    fn read(bytes: &[u8]) -> Result<Self, PictureError> {
        match PictureFormat::of(bytes).ok_or(PictureError::Unrecognised)? {
            PictureFormat::Png => decode::png(bytes),
            PictureFormat::Jpeg => decode::jpeg(bytes),
            PictureFormat::Gif => decode::gif(bytes),
            PictureFormat::Bmp => bmp::read(bytes),
        }
    }

    fn with_capacity(count: usize) -> Self {
        Self { width: 0, height: 0, rgba: Vec::with_capacity(count), has_opacity: false }
    }

    fn push(&mut self, [red, green, blue]: [u8; 3]) {
        self.rgba.push([red, green, blue, 255]);
    }

    fn push_with_opacity(&mut self, pixel: [u8; 4]) {
        self.rgba.push(pixel);
        self.has_opacity = true;
    }

    /// The pixels, if their number matches the size.
    fn of_size(mut self, width: usize, height: usize) -> Option<Self> {
        (self.width, self.height) = (width, height);
        (width.checked_mul(height) == Some(self.rgba.len()) && width > 0 && height > 0).then_some(self)
    }

    /// Grey levels: the luminance on white, or the opacity if that has more contrast.
    fn levels(&self) -> Vec<f32> {
        let grey = |[red, green, blue, _]: [u8; 4]| {
            let sum = 0.299 * f64::from(red) + 0.587 * f64::from(green) + 0.114 * f64::from(blue);
            (sum / 255.0) as f32
        };
        if !self.has_opacity {
            return self.rgba.iter().map(|p| grey(*p)).collect();
        }
        let opacity: Vec<f32> = self.rgba.iter().map(|p| f32::from(p[3]) / 255.0).collect();
        let colour: Vec<f32> =
            self.rgba.iter().zip(&opacity).map(|(p, opacity)| opacity * grey(*p) + (1.0 - opacity)).collect();
        let spread = |values: &[f32]| {
            let mean = values.iter().map(|x| f64::from(*x)).sum::<f64>() / values.len() as f64;
            values.iter().map(|x| (f64::from(*x) - mean).powi(2)).sum::<f64>() / values.len() as f64
        };
        if spread(&opacity) > spread(&colour) {
            opacity.iter().map(|opacity| 1.0 - opacity).collect()
        } else {
            colour
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_lie_on_white_and_beside_the_picture_are_those_of_its_border() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
        encoder.set_color(png::ColorType::Rgba);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(&[200, 0, 100, 255, 0, 0, 0, 51]).unwrap();
        writer.finish().unwrap();
        let picture = ColourPicture::read(&bytes).unwrap();
        assert_eq!(picture.size(), [2, 1]);
        assert_eq!((picture.at([0.5, 0.5]), picture.at([1.5, 9.0])), ([200, 0, 100], [204; 3]));
        assert!(ColourPicture::read(b"GIF").is_err());
    }
}
