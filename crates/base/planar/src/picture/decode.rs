//! Decoding PNG, JPEG and GIF with libraries.

use super::{PictureError, PictureFormat, Pixels, Rgba, Samples, pixels};
use png::{BitDepth, ColorType, Transformations};
use std::io::Cursor;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

fn damaged(format: PictureFormat) -> impl Fn(String) -> PictureError {
    move |why| PictureError::Damaged { format, why }
}

pub(super) fn png(bytes: &[u8]) -> Result<Pixels, PictureError> {
    let wrong = damaged(PictureFormat::Png);
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(|error| wrong(error.to_string()))?;
    let (width, height) = (reader.info().width, reader.info().height);
    let count = pixels(width.into(), height.into())?;
    let size = reader.output_buffer_size().ok_or_else(|| wrong("it is too large".to_owned()))?;
    let mut buffer = vec![0; size];
    let frame = reader.next_frame(&mut buffer).map_err(|error| wrong(error.to_string()))?;
    let data = &buffer[..frame.buffer_size()];
    if frame.color_type == ColorType::Indexed {
        return Err(wrong("its colours are not expanded".to_owned()));
    }
    let samples = match frame.bit_depth {
        BitDepth::Eight => Samples::Eight(rgba(data.iter().copied(), frame.color_type, u8::MAX, count)),
        BitDepth::Sixteen => {
            let samples = data.chunks_exact(2).map(|sample| u16::from_be_bytes([sample[0], sample[1]]));
            Samples::Sixteen(rgba(samples, frame.color_type, u16::MAX, count))
        }
        _ => return Err(wrong("its samples are not of 8 or 16 bits after expansion".to_owned())),
    };
    let has_opacity = matches!(frame.color_type, ColorType::GrayscaleAlpha | ColorType::Rgba);
    Pixels::of_size(width as usize, height as usize, samples, has_opacity)
        .ok_or_else(|| wrong("it has fewer pixels than its header says".to_owned()))
}

/// Pixels from their samples, opaque where they have no opacity; `count` of them are expected.
fn rgba<T: Copy>(
    mut samples: impl Iterator<Item = T>,
    of: ColorType,
    opaque: T,
    count: usize,
) -> Vec<Rgba<T>> {
    let is_grey = matches!(of, ColorType::Grayscale | ColorType::GrayscaleAlpha);
    let has_opacity = matches!(of, ColorType::GrayscaleAlpha | ColorType::Rgba);
    let pixel = || {
        let red = samples.next()?;
        let [green, blue] = if is_grey { [red; 2] } else { [samples.next()?, samples.next()?] };
        Some([red, green, blue, if has_opacity { samples.next()? } else { opaque }])
    };
    let mut found = Vec::with_capacity(count);
    found.extend(std::iter::from_fn(pixel));
    found
}

pub(super) fn jpeg(bytes: &[u8]) -> Result<Pixels, PictureError> {
    let wrong = damaged(PictureFormat::Jpeg);
    let options = DecoderOptions::default()
        .set_strict_mode(true)
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX))
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|error| wrong(error.to_string()))?;
    let (width, height) = decoder.dimensions().ok_or_else(|| wrong("it has no size".to_owned()))?;
    let count = pixels(width as u64, height as u64)?;
    let data = decoder.decode().map_err(|error| wrong(error.to_string()))?;
    let samples = Samples::Eight(rgba(data.into_iter(), ColorType::Rgb, u8::MAX, count));
    Pixels::of_size(width, height, samples, false)
        .ok_or_else(|| wrong("it has fewer pixels than its header says".to_owned()))
}

pub(super) fn gif(bytes: &[u8]) -> Result<Pixels, PictureError> {
    let wrong = damaged(PictureFormat::Gif);
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    options.check_frame_consistency(true);
    let mut decoder = options.read_info(Cursor::new(bytes)).map_err(|error| wrong(error.to_string()))?;
    let (width, height) = (decoder.width(), decoder.height());
    let count = pixels(width.into(), height.into())?;
    let frame = decoder.read_next_frame().map_err(|error| wrong(error.to_string()))?;
    let frame = frame.ok_or_else(|| wrong("it has no picture".to_owned()))?;
    // Pixels outside the frame are transparent.
    let mut canvas = vec![[0_u8; 4]; count];
    let (left, top, across) = (usize::from(frame.left), usize::from(frame.top), usize::from(frame.width));
    for (row, line) in frame.buffer.chunks_exact(4 * across.max(1)).enumerate() {
        let start = (top + row) * usize::from(width) + left;
        if let Some(places) = canvas.get_mut(start..start + across) {
            places.iter_mut().zip(line.chunks_exact(4)).for_each(|(to, p)| *to = [p[0], p[1], p[2], p[3]]);
        }
    }
    let has_opacity = canvas.iter().any(|p| p[3] != u8::MAX);
    Pixels::of_size(width.into(), height.into(), Samples::Eight(canvas), has_opacity)
        .ok_or_else(|| wrong("it has fewer pixels than its header says".to_owned()))
}
