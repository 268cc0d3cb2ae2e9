//! Pictures in PNG, JPEG, GIF or BMP format, as grey levels or in colour.

mod bmp;
mod decode;
mod grey;

use std::fmt;

/// A picture as grey levels from 0 (black) to 1 (white), row by row from the top.
///
/// Colours become luminance (Rec. 601 weights of the stored values), unless they differ far more in hue: then the level is where they lie
/// along the direction in which they vary most, as between red and a green of the same luminance. Transparent pixels are composited on white,
/// unless opacity has more contrast than colour: then the level is 1 − opacity. Samples of 16 bits keep all of them.
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
        let (width, height) = (found.width, found.height);
        let pixels = found.into_eight_bits().into_iter().map(on_white).collect();
        Ok(Self { width, height, pixels })
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

/// Red, green, blue and opacity of a pixel.
type Rgba<T> = [T; 4];

/// Pixels, each sample from 0 to the greatest number of its bits.
enum Samples {
    Eight(Vec<Rgba<u8>>),
    Sixteen(Vec<Rgba<u16>>),
}

/// What was decoded.
struct Pixels {
    width: usize,
    height: usize,
    samples: Samples,
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

    /// The pixels, if their number matches the size.
    fn of_size(width: usize, height: usize, samples: Samples, has_opacity: bool) -> Option<Self> {
        let count = match &samples {
            Samples::Eight(samples) => samples.len(),
            Samples::Sixteen(samples) => samples.len(),
        };
        let is_whole = width.checked_mul(height) == Some(count) && width > 0 && height > 0;
        is_whole.then_some(Self { width, height, samples, has_opacity })
    }

    fn levels(&self) -> Vec<f32> {
        match &self.samples {
            Samples::Eight(samples) => grey::levels(samples, f64::from(u8::MAX), self.has_opacity),
            Samples::Sixteen(samples) => grey::levels(samples, f64::from(u16::MAX), self.has_opacity),
        }
    }

    /// The pixels with 8 bits a sample.
    fn into_eight_bits(self) -> Vec<Rgba<u8>> {
        match self.samples {
            Samples::Eight(samples) => samples,
            Samples::Sixteen(samples) => {
                samples.into_iter().map(|pixel| pixel.map(|sample| (sample >> 8) as u8)).collect()
            }
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
