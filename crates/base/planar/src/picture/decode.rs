//! Decoding PNG, JPEG and GIF with libraries.

use super::{PictureError, PictureFormat, Pixels, pixels};
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
    decoder.set_transformations(Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|error| wrong(error.to_string()))?;
    let (width, height) = (reader.info().width, reader.info().height);
    let count = pixels(width.into(), height.into())?;
    let size = reader.output_buffer_size().ok_or_else(|| wrong("it is too large".to_owned()))?;
    let mut buffer = vec![0; size];
    let frame = reader.next_frame(&mut buffer).map_err(|error| wrong(error.to_string()))?;
    let data = &buffer[..frame.buffer_size()];
    if frame.bit_depth != BitDepth::Eight {
        return Err(wrong("its samples are not of 8 bits after normalising".to_owned()));
    }
    let mut found = Pixels::with_capacity(count);
    match frame.color_type {
        ColorType::Grayscale => data.iter().for_each(|g| found.push([*g; 3])),
        ColorType::GrayscaleAlpha => {
            data.chunks_exact(2).for_each(|p| found.push_with_opacity([p[0], p[0], p[0], p[1]]));
        }
        ColorType::Rgb => data.chunks_exact(3).for_each(|p| found.push([p[0], p[1], p[2]])),
        ColorType::Rgba => {
            data.chunks_exact(4).for_each(|p| found.push_with_opacity([p[0], p[1], p[2], p[3]]));
        }
        ColorType::Indexed => return Err(wrong("its colours are not expanded".to_owned())),
    }
    found
        .of_size(width as usize, height as usize)
        .ok_or_else(|| wrong("it has fewer pixels than its header says".to_owned()))
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
    let mut found = Pixels::with_capacity(count);
    data.chunks_exact(3).for_each(|p| found.push([p[0], p[1], p[2]]));
    found.of_size(width, height).ok_or_else(|| wrong("it has fewer pixels than its header says".to_owned()))
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
    let mut found = Pixels::with_capacity(count);
    let is_opaque = canvas.iter().all(|p| p[3] == 255);
    for p in canvas {
        if is_opaque {
            found.push([p[0], p[1], p[2]]);
        } else {
            found.push_with_opacity(p);
        }
    }
    found
        .of_size(width.into(), height.into())
        .ok_or_else(|| wrong("it has fewer pixels than its header says".to_owned()))
}
