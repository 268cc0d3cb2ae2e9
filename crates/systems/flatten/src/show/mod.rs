//! A flat map as a page, a picture, a drawing and a texture.

mod page;
mod svg;

pub use page::FlattenPage;
pub use svg::layout_svg;

use pompeiu_figures::Image;

/// Squares along each side of the checkerboard texture, and the size of each in pixels.
const SQUARES: u32 = 32;
const PIXELS: u32 = 16;

/// A checkerboard as PNG: a texture that shows the distortion of a map.
///
/// # Errors
/// Those of the encoder.
pub fn checker_png() -> std::io::Result<Vec<u8>> {
    let mut png = Vec::new();
    Image::checkerboard(SQUARES, PIXELS, [[236, 236, 232], [62, 96, 140]]).write_png(&mut png)?;
    Ok(png)
}
