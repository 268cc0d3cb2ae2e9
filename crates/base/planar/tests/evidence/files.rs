//! Pictures and drawings as files: every format shows the same shape, and damage is reported.

use pompeiu_planar::picture::{Picture, PictureError};
use pompeiu_planar::silhouette::{Foreground, SilhouetteError, SilhouetteOptions, silhouette};
use pompeiu_planar::svg::Missing;
use pompeiu_planar::{FileError, LeftOut, read_outlines, read_region, read_shapes};
use std::path::PathBuf;

const WIDTH: usize = 40;
const HEIGHT: usize = 30;

/// A black frame on white: 24 by 18 pixels with a hole of 8 by 6.
fn is_dark(column: usize, row: usize) -> bool {
    let within = |at: usize, from: usize, count: usize| at >= from && at < from + count;
    within(column, 5, 24) && within(row, 6, 18) && !(within(column, 10, 8) && within(row, 10, 6))
}

fn grey() -> Vec<u8> {
    (0..WIDTH * HEIGHT).map(|i| if is_dark(i % WIDTH, i / WIDTH) { 0 } else { 255 }).collect()
}

fn png(data: &[u8], colour: png::ColorType) -> Vec<u8> {
    png_of_depth(data, colour, png::BitDepth::Eight)
}

fn png_of_depth(data: &[u8], colour: png::ColorType, depth: png::BitDepth) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, WIDTH as u32, HEIGHT as u32);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(data).unwrap();
    writer.finish().unwrap();
    bytes
}

fn gif() -> Vec<u8> {
    let mut bytes = Vec::new();
    let indices: Vec<u8> = grey().iter().map(|g| g & 1).collect();
    let palette = [0, 0, 0, 255, 255, 255];
    let mut encoder = gif::Encoder::new(&mut bytes, WIDTH as u16, HEIGHT as u16, &palette).unwrap();
    let frame = gif::Frame {
        width: WIDTH as u16,
        height: HEIGHT as u16,
        buffer: indices.into(),
        ..gif::Frame::default()
    };
    encoder.write_frame(&frame).unwrap();
    drop(encoder);
    bytes
}

fn bmp(bits: u16) -> Vec<u8> {
    let stride = (WIDTH * usize::from(bits)).div_ceil(32) * 4;
    let table: &[u8] = if bits <= 8 { &[0, 0, 0, 0, 255, 255, 255, 0] } else { &[] };
    let start = 54 + table.len();
    let mut bytes = b"BM".to_vec();
    for number in [(start + stride * HEIGHT) as u32, 0, start as u32, 40, WIDTH as u32, HEIGHT as u32] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(1_u16.to_le_bytes());
    bytes.extend(bits.to_le_bytes());
    for number in [0_u32, 0, 0, 0, (table.len() / 4) as u32, 0] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(table);
    for row in (0..HEIGHT).rev() {
        let mut line = vec![0_u8; stride];
        for column in 0..WIDTH {
            let light = !is_dark(column, row);
            match bits {
                1 => line[column / 8] |= u8::from(light) << (7 - column % 8),
                4 => line[column / 2] |= u8::from(light) << (4 * (1 - column % 2)),
                8 => line[column] = u8::from(light),
                _ => {
                    let size = usize::from(bits) / 8;
                    line[column * size..column * size + 3].fill(if light { 255 } else { 0 });
                }
            }
        }
        bytes.extend(line);
    }
    bytes
}

fn staircase() -> SilhouetteOptions {
    SilhouetteOptions { staircase: true, ..SilhouetteOptions::default() }
}

#[test]
fn every_format_shows_the_same_shape() {
    let transparent: Vec<u8> = grey().iter().flat_map(|g| [0, 0, 0, 255 - g]).collect();
    let colours: Vec<u8> = grey().iter().flat_map(|g| [*g; 3]).collect();
    let mut files = vec![
        ("grey", png(&grey(), png::ColorType::Grayscale)),
        ("colours", png(&colours, png::ColorType::Rgb)),
        ("transparent", png(&transparent, png::ColorType::Rgba)),
        ("gif", gif()),
    ];
    files.extend([1, 4, 8, 24, 32].map(|bits| ("bmp", bmp(bits))));
    // Masks of labels, and colours of one luminance.
    let mask = |label: u16| -> Vec<u8> {
        grey().iter().flat_map(|g| if *g == 0 { label } else { 0 }.to_be_bytes()).collect()
    };
    let sixteen = |label| png_of_depth(&mask(label), png::ColorType::Grayscale, png::BitDepth::Sixteen);
    files.extend([1, 255, 4095, 65535].map(|label| ("16 bits", sixteen(label))));
    let red_on_green: Vec<u8> =
        grey().iter().flat_map(|g| if *g == 0 { [255, 0, 0] } else { [0, 130, 0] }).collect();
    files.push(("red on green", png(&red_on_green, png::ColorType::Rgb)));
    for (name, bytes) in files {
        let picture = Picture::read(&bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!((picture.width(), picture.height()), (WIDTH, HEIGHT));
        let region = silhouette(&picture, &staircase()).unwrap();
        assert_eq!(region.outer.bounds(), [[4.5, 5.5], [28.5, 23.5]], "{name}");
        assert_eq!((region.outer.area(), region.holes.len(), region.area()), (432.0, 1, 384.0), "{name}");
        // The smooth outline has the sides and the corners of the rectangle.
        let smooth = silhouette(&picture, &SilhouetteOptions::default()).unwrap();
        assert!((smooth.outer.area() - 432.0).abs() < 0.5, "{name}: {}", smooth.outer.area());
        // The hole is too small for straight sides: its corners are round.
        let found = [smooth.outer.length(), smooth.holes[0].area()];
        assert!((found[0] - 84.0).abs() < 0.5 && (found[1] - 48.0).abs() < 4.0, "{name}: {found:?}");
    }
}

#[test]
fn cut_off_and_huge_pictures_are_refused() {
    for bytes in [png(&grey(), png::ColorType::Grayscale), gif(), bmp(8), bmp(24)] {
        for length in [8, 20, 30, bytes.len() / 2, bytes.len() - bytes.len() / 4] {
            assert!(
                Picture::read(&bytes[..length.min(bytes.len() - 1)]).is_err(),
                "{length} of {}",
                bytes.len()
            );
        }
    }
    let mut huge = png(&grey(), png::ColorType::Grayscale);
    huge[16..20].copy_from_slice(&100_000_u32.to_be_bytes());
    huge[20..24].copy_from_slice(&100_000_u32.to_be_bytes());
    let crc = crc32(&huge[12..29]);
    huge[29..33].copy_from_slice(&crc.to_be_bytes());
    assert_eq!(Picture::read(&huge), Err(PictureError::Large { width: 100_000, height: 100_000 }));
    let mut huge = bmp(8);
    huge[18..22].copy_from_slice(&100_000_u32.to_le_bytes());
    huge[22..26].copy_from_slice(&100_000_u32.to_le_bytes());
    assert_eq!(Picture::read(&huge), Err(PictureError::Large { width: 100_000, height: 100_000 }));
    assert_eq!(Picture::read(b"hello"), Err(PictureError::Unrecognised));
    // Damage anywhere gives an error or a picture, never a panic.
    let whole = [png(&grey(), png::ColorType::Grayscale), gif(), bmp(4)];
    for bytes in whole {
        for at in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[at] ^= 0x5a;
            let _ = Picture::read(&damaged);
        }
    }
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
    })
}

#[test]
fn a_picture_without_a_shape_is_told() {
    let plain = Picture::new(3, 2, vec![0.5; 6]).unwrap();
    assert!(matches!(
        silhouette(&plain, &SilhouetteOptions::default()),
        Err(SilhouetteError::Plain { width: 3, height: 2, .. })
    ));
    let picture = Picture::read(&bmp(8)).unwrap();
    let light = SilhouetteOptions { foreground: Foreground::Light, ..staircase() };
    assert_eq!(silhouette(&picture, &light).unwrap().outer.area(), (WIDTH * HEIGHT) as f64);
}

fn file(name: &str, content: &[u8]) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("pompeiu-planar-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    std::fs::write(&path, content).unwrap();
    path
}

#[test]
fn files_are_told_apart_and_open_curves_refused() {
    let options = SilhouetteOptions::default();
    for (how, holes) in [("", 0), ("fill-rule='evenodd'", 1), ("style='fill:none;stroke:black'", 1)] {
        let text = format!("<svg><path {how} d='M0 0H9V9H0Z M3 3H6V6H3Z'/></svg>");
        let (region, _) = read_region(&file("ring.svg", text.as_bytes()), &options).unwrap();
        assert_eq!((region.outer.area(), region.holes.len()), (81.0, holes), "{how}");
    }
    let points = file("points.csv", b"x,y\n0,0\n4,0\n4,3\n");
    assert_eq!(read_outlines(&points, &options).unwrap().0[0].area(), 6.0);
    let gif_named_otherwise = file("shape.txt", &gif());
    assert!(read_region(&gif_named_otherwise, &options).is_ok());
    let open = file("open.svg", b"<svg><path fill='none' d='M0 0H9V9'/></svg>");
    assert!(matches!(read_outlines(&open, &options), Err(FileError::Open { index: 0, .. })));
    let several = b"<svg><path id='a' d='M0 0H9V9Z M20 0h1v1z'/><rect id='b' width='2' height='1'/><path id='c' fill='none' d='M0 0H9V9'/></svg>";
    let (shapes, _) = read_shapes(&file("several.svg", several), &options).unwrap();
    let names: Vec<_> = shapes.iter().map(|shape| (shape.name.as_deref(), shape.region.is_ok())).collect();
    assert_eq!(names, [(Some("1"), true), (Some("2"), true), (Some("b"), true), (Some("c"), false)]);
    assert!(matches!(shapes[3].region, Err(FileError::Open { index: 3, .. })));
    let empty = file("empty.svg", b"<svg/>");
    assert!(matches!(read_outlines(&empty, &options), Err(FileError::Empty)));
    let words = file("words.txt", b"0 0\nhello there\n");
    assert!(matches!(read_outlines(&words, &options), Err(FileError::Line { line: 2, .. })));
    let noise = file("noise.dat", &[0xff, 0x80, 0x00]);
    assert!(matches!(read_outlines(&noise, &options), Err(FileError::Unrecognised)));
}

#[test]
fn what_a_drawing_does_not_have_is_left_out_and_said() {
    let options = SilhouetteOptions::default();
    let text = b"<svg><use href='#none'/><rect width='2' height='1'/>\n<use href='other.svg#a'/></svg>";
    let some = file("some.svg", text);
    let (region, left_out) = read_region(&some, &options).unwrap();
    let (outlines, missing) = read_outlines(&some, &options).unwrap();
    assert_eq!((region.outer.area(), missing.len(), outlines.len()), (2.0, 2, 1));
    assert_eq!(left_out, missing.into_iter().map(LeftOut::Missing).collect::<Vec<_>>());
    let (shapes, _) = read_shapes(&some, &options).unwrap();
    assert!(shapes.iter().all(|shape| shape.name.is_none()));
    assert!(
        matches!(&shapes[2].region, Err(FileError::Missing(missing)) if matches!(missing, Missing::Use { line: 2, href } if href == "other.svg#a"))
    );
    let none = file("nothing.svg", b"<svg><use href='#none'/></svg>");
    let error = read_region(&none, &options).unwrap_err().to_string();
    assert!(error.starts_with("there is no curve in the drawing: line 1: <use> draws nothing"), "{error}");
}

#[test]
fn shapes_beside_the_largest_one_are_left_out_and_said() {
    let options = SilhouetteOptions::default();
    let text = "<svg><rect x='9' width='1' height='1'/><path fill-rule='evenodd' d='M0 0H4V4H0Z M1 1H2V2H1Z M20 0h2v2h-2z M20.5 .5h1v1h-1z'/></svg>";
    let (region, left_out) = read_region(&file("beside.svg", text.as_bytes()), &options).unwrap();
    assert_eq!((region.area(), region.holes.len()), (15.0, 1));
    assert_eq!(left_out, [LeftOut::Shapes { others: 2, share: 5.0 / 16.0 }]);
    assert!(
        left_out[0]
            .to_string()
            .starts_with("only the largest of 3 shapes is used; the others have 31.2 % of")
    );
    let (_, none) =
        read_region(&file("one.svg", b"<svg><rect width='2' height='1'/></svg>"), &options).unwrap();
    assert_eq!(none, []);
}

#[test]
fn parts_beside_the_largest_one_of_a_picture_are_left_out_and_said() {
    // 40 × 40 pixels: a square of 34, two of 3, and a speck of less than a thousandth; in a BMP of 24 bits.
    let (n, squares) = (40_usize, [(1, 1, 34), (36, 36, 3), (36, 20, 3), (37, 2, 1)]);
    let is_dark = |x: usize, y: usize| {
        squares.iter().any(|&(a, b, size)| (a..a + size).contains(&x) && (b..b + size).contains(&y))
    };
    let levels = (0..n * n).flat_map(|i| [if is_dark(i % n, i / n) { 0_u8 } else { 255 }; 3]);
    let mut bytes = b"BM".to_vec();
    let pixels = 54 + (3 * n * n) as u32;
    bytes.extend(
        [pixels, 0, 54, 40, n as u32, n as u32, 1 | (24 << 16)].into_iter().flat_map(u32::to_le_bytes),
    );
    bytes.extend([0; 24]);
    bytes.extend(levels);
    let (region, left_out) = read_region(&file("parts.bmp", &bytes), &staircase()).unwrap();
    assert_eq!(
        (region.area(), left_out),
        (1156.0, vec![LeftOut::Shapes { others: 2, share: 2.0 * (9.0 / 1156.0) }])
    );
}

#[test]
fn a_bow_is_refused_with_its_crossing() {
    let options = SilhouetteOptions::default();
    let drawn = file("bow.svg", b"<svg><path d='M0 0L4 4L4 0L0 4Z'/></svg>");
    let listed = file("bow.txt", b"0 0\n4 4\n4 0\n0 4\n0 0\n");
    for path in [drawn, listed] {
        match read_region(&path, &options) {
            Err(FileError::Bow { sides: [0, 2], place: [2.0, 2.0] }) => (),
            found => panic!("{found:?}"),
        }
    }
    let flat = file("flat.txt", b"0 0\n1 1\n3 3\n2 2\n");
    let error = read_region(&flat, &options).unwrap_err();
    assert!(matches!(error, FileError::Outline(_)), "{error}");
}

#[test]
fn the_ends_of_filled_curves_are_joined() {
    let options = SilhouetteOptions::default();
    for drawing in ["<path d='M0 0H9V9H0'/>", "<polyline points='0,0 9,0 9,9 0,9'/>"] {
        let path = file("filled.svg", format!("<svg>{drawing}</svg>").as_bytes());
        assert_eq!(read_outlines(&path, &options).unwrap().0[0].area(), 81.0, "{drawing}");
    }
    let styled =
        file("styled.svg", b"<svg><style>.a{fill:none}</style><path class='a' d='M0 0H9V9H0'/></svg>");
    assert!(matches!(read_outlines(&styled, &options), Err(FileError::Open { .. })));
}

#[test]
fn text_is_read_as_other_programs_write_it() {
    let options = SilhouetteOptions::default();
    let square = "x,y\n0,0\n2,0\n2,1\n0,1\n";
    let drawing = "<svg><rect id='für' width='2' height='1'/></svg>";
    let utf16 = |text: &str| {
        [b"\xff\xfe".to_vec(), text.encode_utf16().flat_map(u16::to_le_bytes).collect()].concat()
    };
    let latin1: Vec<u8> = drawing.chars().map(|c| c as u8).collect();
    let cases: [(&str, Vec<u8>); 9] = [
        ("mark.csv", format!("\u{feff}{square}").into_bytes()),
        ("mark.svg", format!("\u{feff}{drawing}").into_bytes()),
        ("wide.csv", utf16(square)),
        ("wide.svg", utf16(drawing)),
        ("latin1.svg", latin1),
        ("returns.csv", square.replace('\n', "\r").into_bytes()),
        ("crlf.csv", square.replace('\n', "\r\n").into_bytes()),
        ("quoted.csv", b"\"x\",\"y\"\n\"0\",\"0\"\n2,0\n2,1\n0,1\n".to_vec()),
        ("remark.csv", format!("# of a scan\n\n{square}").into_bytes()),
    ];
    for (name, bytes) in cases {
        let found = read_outlines(&file(name, &bytes), &options);
        let (found, _) = found.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(found[0].area(), 2.0, "{name}");
    }
    let wrong = file("wrong.csv", b"0,0\r\n2,0\r\nx,y\r\n");
    assert!(matches!(read_outlines(&wrong, &options), Err(FileError::Line { line: 3, .. })));
}
