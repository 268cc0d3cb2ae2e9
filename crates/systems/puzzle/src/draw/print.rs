//! A picture printed on the pieces.

use crate::Puzzle;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use pompeiu_planar::Point;
use pompeiu_planar::picture::{ColourPicture, PictureError, PictureFormat};

/// A picture printed on the pieces: centred on the puzzle, and just large enough to cover it.
#[derive(Clone, Debug)]
pub struct Print {
    /// The file as a data URI.
    link: String,
    colours: ColourPicture,
}

/// The smallest and largest length of the longer side of a written picture, in pixels.
const LEAST_SIDE: f64 = 800.0;
const MOST_SIDE: f64 = 4096.0;

impl Print {
    /// A picture from a file's content.
    ///
    /// # Errors
    /// [`PictureError`].
    pub fn read(bytes: &[u8]) -> Result<Self, PictureError> {
        let colours = ColourPicture::read(bytes)?;
        let kind = match PictureFormat::of(bytes).ok_or(PictureError::Unrecognised)? {
            PictureFormat::Png => "png",
            PictureFormat::Jpeg => "jpeg",
            PictureFormat::Gif => "gif",
            PictureFormat::Bmp => "bmp",
        };
        Ok(Self { link: format!("data:image/{kind};base64,{}", STANDARD.encode(bytes)), colours })
    }

    /// Pixels of the picture, along and down.
    pub fn size(&self) -> [usize; 2] {
        self.colours.size()
    }

    /// The share of the picture that lies beside the box around a puzzle, because its proportions are others.
    pub fn beside(&self, puzzle: &Puzzle) -> f64 {
        let (size, pixels, scale) = (puzzle.size(), self.colours.size(), self.scale(puzzle));
        let [width, height] = [0, 1].map(|k| scale * size[k] / pixels[k] as f64);
        (1.0 - width * height).clamp(0.0, 1.0)
    }

    /// An SVG pattern named `print` that covers the puzzle.
    pub(super) fn pattern(&self, puzzle: &Puzzle) -> String {
        let [width, height] = puzzle.size();
        format!(
            "<defs><pattern id=\"print\" patternUnits=\"userSpaceOnUse\" width=\"{width}\" height=\"{height}\"><image href=\"{}\" \
             width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"xMidYMid slice\"/></pattern></defs>\n",
            self.link
        )
    }

    /// Pixels of the picture per unit of the puzzle.
    fn scale(&self, puzzle: &Puzzle) -> f64 {
        let (size, pixels) = (puzzle.size(), self.colours.size());
        (0..2).map(|k| pixels[k] as f64 / size[k]).fold(f64::INFINITY, f64::min)
    }

    /// Pixels of the picture along the longer side of the puzzle.
    pub(super) fn pixels(&self, puzzle: &Puzzle) -> f64 {
        let [width, height] = puzzle.size();
        (self.scale(puzzle) * width.max(height)).clamp(LEAST_SIDE, MOST_SIDE)
    }

    /// The colour at a position of the puzzle.
    pub(super) fn at(&self, puzzle: &Puzzle, p: Point) -> [u8; 3] {
        let (size, pixels, scale) = (puzzle.size(), self.colours.size(), self.scale(puzzle));
        self.colours.at([0, 1].map(|k| 0.5 * pixels[k] as f64 + scale * (p[k] - 0.5 * size[k])))
    }
}
