//! Moving pictures, read back by other programs' libraries.

use pompeiu_figures::{FilmFormat, Image, Rgb, write_film};
use std::io::{self, Cursor, ErrorKind};
use std::time::Duration;

const SIZE: [u32; 2] = [24, 18];

/// A picture of few colours (below 3) or of more than a GIF has.
fn picture(number: u32) -> Image {
    let [width, height] = SIZE;
    let of = |i: u32| -> Rgb {
        let (x, y) = (i % width, i / width);
        if number < 3 {
            [(x / 8 * 60) as u8, number as u8, 9]
        } else {
            [(10 * x) as u8, (14 * y) as u8, number as u8]
        }
    };
    Image::new(width, height, (0..width * height).map(of).collect()).unwrap()
}

fn film(format: FilmFormat, pictures: u32) -> Vec<u8> {
    let mut file = Vec::new();
    write_film(&mut file, format, Duration::from_millis(80), pictures, |i| Ok(picture(i))).unwrap();
    file
}

#[test]
fn animated_png_has_every_pixel() {
    let file = film(FilmFormat::Apng, 5);
    let mut reader = png::Decoder::new(Cursor::new(file)).read_info().unwrap();
    assert_eq!(reader.info().animation_control().unwrap().num_frames, 5);
    for number in 0..5 {
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels, picture(number).pixels().as_flattened(), "picture {number}");
        let control = reader.info().frame_control().unwrap();
        assert_eq!((control.delay_num, control.delay_den), (80, 1000));
    }
}

#[test]
fn gif_has_few_colours_exactly_and_many_nearly() {
    let file = film(FilmFormat::Gif, 5);
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut reader = options.read_info(Cursor::new(file)).unwrap();
    for number in 0..5 {
        let frame = reader.read_next_frame().unwrap().unwrap();
        assert_eq!(frame.delay, 8);
        let expected = picture(number);
        let most = if number < 3 { 0 } else { 24 };
        for (found, pixel) in frame.buffer.chunks(4).zip(expected.pixels()) {
            assert!((0..3).all(|i| found[i].abs_diff(pixel[i]) <= most), "{number}: {found:?} {pixel:?}");
        }
    }
    assert!(reader.read_next_frame().unwrap().is_none());
}

#[test]
fn what_is_no_film_is_refused() {
    let mut file = Vec::new();
    for format in [FilmFormat::Apng, FilmFormat::Gif] {
        let none = write_film(&mut file, format, Duration::ZERO, 0, |i| Ok(picture(i)));
        assert_eq!(none.unwrap_err().kind(), ErrorKind::InvalidInput);
        let sizes = |i: u32| Ok(Image::new(1 + i, 1, vec![[0; 3]; 1 + i as usize]).unwrap());
        let different = write_film(&mut file, format, Duration::ZERO, 2, sizes);
        assert_eq!(different.unwrap_err().to_string(), "pictures differ in size");
        let failing =
            write_film(&mut file, format, Duration::ZERO, 2, |_| Err(io::Error::other("no picture")));
        assert_eq!(failing.unwrap_err().to_string(), "no picture");
    }
    let wide = |_| Ok(Image::new(1 << 16, 1, vec![[0; 3]; 1 << 16]).unwrap());
    let error = write_film(&mut file, FilmFormat::Gif, Duration::ZERO, 1, wide).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::InvalidInput);
}
