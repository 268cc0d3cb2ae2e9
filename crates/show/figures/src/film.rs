//! Pictures one after the other in one file: animated PNG, and GIF.

use crate::palette::Palette;
use crate::{Image, Rgb};
use std::io::{self, Write};
use std::time::Duration;

/// A file of moving pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FilmFormat {
    /// Animated PNG: every pixel as it is. Programs that do not know it show the first picture.
    Apng,
    /// GIF: at most 256 colours in each picture, chosen by median cuts where there are more.
    Gif,
}

/// Pictures of one size that are written one after the other and play again and again.
///
/// # Errors
/// Those of `out` and `picture`, whose argument counts from 0; of kind `InvalidInput` for no pictures, pictures of different sizes, and
/// sizes that the format does not have (GIF: at most 65,535).
///
/// # Example
/// ```
/// use pompeiu_figures::{Figure, FilmFormat, write_film};
/// use std::time::Duration;
///
/// let picture = |_| Figure::new(64, 48).draw().map_err(std::io::Error::other);
/// let mut file = Vec::new();
/// write_film(&mut file, FilmFormat::Gif, Duration::from_millis(80), 3, picture)?;
/// assert!(file.starts_with(b"GIF89a"));
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn write_film(
    out: impl Write,
    format: FilmFormat,
    interval: Duration,
    pictures: u32,
    mut picture: impl FnMut(u32) -> io::Result<Image>,
) -> io::Result<()> {
    if pictures == 0 {
        return Err(invalid("there is no picture"));
    }
    let first = picture(0)?;
    let size = [first.width(), first.height()];
    let mut first = Some(first);
    let next = |i: u32| {
        let image = first.take().map_or_else(|| picture(i), Ok)?;
        if [image.width(), image.height()] == size {
            Ok(image)
        } else {
            Err(invalid("pictures differ in size"))
        }
    };
    match format {
        FilmFormat::Apng => write_apng(out, size, interval, pictures, next),
        FilmFormat::Gif => write_gif(out, size, interval, pictures, next),
    }
}

fn invalid(problem: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, problem)
}

fn write_apng(
    out: impl Write,
    [width, height]: [u32; 2],
    interval: Duration,
    pictures: u32,
    mut next: impl FnMut(u32) -> io::Result<Image>,
) -> io::Result<()> {
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    encoder.set_animated(pictures, 0)?;
    let milliseconds = u16::try_from(interval.as_millis()).unwrap_or(u16::MAX);
    encoder.set_frame_delay(milliseconds, 1000)?;
    let mut writer = encoder.write_header()?;
    for i in 0..pictures {
        writer.write_image_data(next(i)?.pixels().as_flattened())?;
    }
    Ok(writer.finish()?)
}

fn write_gif(
    out: impl Write,
    size: [u32; 2],
    interval: Duration,
    pictures: u32,
    mut next: impl FnMut(u32) -> io::Result<Image>,
) -> io::Result<()> {
    let (Ok(width), Ok(height)) = (u16::try_from(size[0]), u16::try_from(size[1])) else {
        return Err(invalid("GIF has at most 65535 pixels in a row and rows"));
    };
    let mut encoder = gif::Encoder::new(out, width, height, &[]).map_err(io::Error::other)?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(io::Error::other)?;
    for i in 0..pictures {
        let image = next(i)?;
        let palette = Palette::of(image.pixels());
        let indices: Vec<u8> = image.pixels().iter().map(|color: &Rgb| palette.index(*color)).collect();
        let mut frame =
            gif::Frame::from_palette_pixels(width, height, indices, palette.colors().as_flattened(), None);
        // In hundredths of a second.
        frame.delay = u16::try_from(interval.as_millis() / 10).unwrap_or(u16::MAX);
        encoder.write_frame(&frame).map_err(io::Error::other)?;
    }
    // It writes the end of the file.
    encoder.into_inner().map_err(io::Error::other)?.flush()
}
