//! Encoding pages as a PDF file.

use super::layout::Mark;
use super::metrics::encoded;
use super::{Block, Document};
use crate::Image;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};
use std::io::Write;

const REGULAR: Name<'_> = Name(b"Regular");
const BOLD: Name<'_> = Name(b"Bold");
/// Width of rules, in points.
const LINE_WIDTH: f64 = 0.4;
/// Grey level of rules, from black to white.
const LINE_GRAY: f32 = 0.75;

pub(super) fn write(document: &Document, pages: &[Vec<Mark>]) -> Vec<u8> {
    let mut next = 0;
    let mut new = || {
        next += 1;
        Ref::new(next)
    };
    let [catalog, tree, info, regular, bold] = std::array::from_fn(|_| new());
    let pictures: Vec<(usize, &Image, Ref)> = document
        .blocks
        .iter()
        .enumerate()
        .filter_map(
            |(i, block)| {
                if let Block::Picture { image, .. } = block { Some((i, image, new())) } else { None }
            },
        )
        .collect();
    let places: Vec<[Ref; 2]> = pages.iter().map(|_| [new(), new()]).collect();

    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(tree);
    pdf.document_info(info).title(TextStr(&document.title)).creator(TextStr("pompeiu"));
    pdf.pages(tree)
        .kids(places.iter().map(|[page, _]| *page))
        .count(i32::try_from(places.len()).unwrap_or(i32::MAX));
    for (font, face) in [(regular, "Helvetica"), (bold, "Helvetica-Bold")] {
        pdf.type1_font(font).base_font(Name(face.as_bytes())).encoding_predefined(Name(b"WinAnsiEncoding"));
    }
    for (_, image, id) in &pictures {
        picture(&mut pdf, *id, image);
    }
    let [width, height] = document.paper.size().map(|length| length as f32);
    for (marks, [page, content]) in pages.iter().zip(&places) {
        let mut written = pdf.page(*page);
        written.media_box(Rect::new(0.0, 0.0, width, height)).parent(tree).contents(*content);
        let mut resources = written.resources();
        resources.fonts().pair(REGULAR, regular).pair(BOLD, bold);
        let mut images = resources.x_objects();
        for (block, _, id) in &pictures {
            images.pair(Name(name(*block).as_bytes()), *id);
        }
        images.finish();
        resources.finish();
        written.finish();
        let bytes = compressed(&draw(marks));
        pdf.stream(*content, &bytes).filter(Filter::FlateDecode);
    }
    pdf.finish()
}

/// The name of the picture of a block.
fn name(block: usize) -> String {
    format!("Picture{block}")
}

fn picture(pdf: &mut Pdf, id: Ref, image: &Image) {
    let bytes = compressed(image.pixels().as_flattened());
    let mut written = pdf.image_xobject(id, &bytes);
    written.filter(Filter::FlateDecode);
    written.width(image.width().cast_signed()).height(image.height().cast_signed());
    written.color_space().device_rgb();
    written.bits_per_component(8);
}

fn draw(marks: &[Mark]) -> Vec<u8> {
    let mut content = Content::new();
    for mark in marks {
        match mark {
            Mark::Text { at: [x, y], size, bold, text } => {
                content.begin_text();
                content.set_font(if *bold { BOLD } else { REGULAR }, *size as f32);
                content.next_line(*x as f32, *y as f32);
                content.show(Str(&encoded(text)));
                content.end_text();
            }
            Mark::Rule { at: [x, y], length } => {
                content.save_state();
                content.set_line_width(LINE_WIDTH as f32).set_stroke_gray(LINE_GRAY);
                content.move_to(*x as f32, *y as f32).line_to((x + length) as f32, *y as f32).stroke();
                content.restore_state();
            }
            Mark::Picture { block, at: [x, y], size: [width, height] } => {
                content.save_state();
                content.transform([*width as f32, 0.0, 0.0, *height as f32, *x as f32, *y as f32]);
                content.x_object(Name(name(*block).as_bytes()));
                content.restore_state();
            }
        }
    }
    content.finish().to_vec()
}

fn compressed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    // Writing to memory cannot fail.
    let _ = encoder.write_all(bytes);
    encoder.finish().unwrap_or_default()
}
