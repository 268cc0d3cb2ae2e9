//! Pictures: PNG, JPEG, GIF and BMP as grey levels.

mod bmp;
mod decode;

use std::fmt;

/// A picture as grey levels from 0 (black) to 1 (white), row by row from the top.
///
/// Colours become luminance (Rec. 601 weights of the stored values). What is transparent lies on white, unless the picture says more by
/// what is transparent than by colours: then the level is 1 − opacity.
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

/// Why bytes are no picture that can be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// None of the formats.
    #[error("the content is no PNG, JPEG, GIF or BMP picture")]
    Unrecognised,
    /// Too many pixels.
    #[error("the picture has {width} × {height} pixels; at most {most} in all are read", most = Picture::MAX_PIXELS)]
    Large {
        /// Pixels in a row.
        width: u64,
        /// Rows.
        height: u64,
    },
    /// No pixel.
    #[error("the picture has {width} × {height} pixels; at least one is needed")]
    Empty {
        /// Pixels in a row.
        width: u64,
        /// Rows.
        height: u64,
    },
    /// Damaged, cut off, or of a kind that is not read.
    #[error("the {format} picture cannot be read: {why}")]
    Damaged {
        /// What it seems to be.
        format: PictureFormat,
        /// What is wrong.
        why: String,
    },
}

impl Picture {
    /// The most pixels that are read: 64 million.
    pub const MAX_PIXELS: u64 = 1 << 26;

    /// A picture of these levels, row by row from the top; none where their number is not width times height, or 0.
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
        match PictureFormat::of(bytes).ok_or(PictureError::Unrecognised)? {
            PictureFormat::Png => decode::png(bytes),
            PictureFormat::Jpeg => decode::jpeg(bytes),
            PictureFormat::Gif => decode::gif(bytes),
            PictureFormat::Bmp => bmp::read(bytes),
        }
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

/// The number of pixels, if it is one that is read.
fn pixels(width: u64, height: u64) -> Result<usize, PictureError> {
    match width.checked_mul(height) {
        Some(0) => Err(PictureError::Empty { width, height }),
        Some(count) if count <= Picture::MAX_PIXELS => Ok(count as usize),
        _ => Err(PictureError::Large { width, height }),
    }
}

/// Levels of pixels of red, green, blue and opacity, each from 0 to 255.
struct Levels {
    colour: Vec<f32>,
    opacity: Vec<f32>,
}

impl Levels {
    fn with_capacity(count: usize) -> Self {
        Self { colour: Vec::with_capacity(count), opacity: Vec::new() }
    }

    fn push(&mut self, [red, green, blue]: [u8; 3]) {
        let sum = 0.299 * f64::from(red) + 0.587 * f64::from(green) + 0.114 * f64::from(blue);
        self.colour.push((sum / 255.0) as f32);
    }

    fn push_with_opacity(&mut self, [red, green, blue, opacity]: [u8; 4]) {
        self.push([red, green, blue]);
        self.opacity.push(f32::from(opacity) / 255.0);
    }

    /// The picture; of colours on white, or of what is opaque where that spreads more.
    fn picture(mut self, width: usize, height: usize) -> Option<Picture> {
        let spread = |values: &[f32]| {
            let mean = values.iter().map(|x| f64::from(*x)).sum::<f64>() / values.len() as f64;
            values.iter().map(|x| (f64::from(*x) - mean).powi(2)).sum::<f64>() / values.len() as f64
        };
        if !self.opacity.is_empty() {
            for (level, opacity) in self.colour.iter_mut().zip(&self.opacity) {
                *level = opacity * *level + (1.0 - opacity);
            }
            if spread(&self.opacity) > spread(&self.colour) {
                self.colour = self.opacity.iter().map(|opacity| 1.0 - opacity).collect();
            }
        }
        Picture::new(width, height, self.colour)
    }
}
