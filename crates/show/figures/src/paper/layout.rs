//! Layout of the pages of a document.

use super::metrics::{width, wrapped};
use super::{Block, Document};

/// Lengths are in points, relative to the lower left corner of the page.
const MARGIN: f64 = 54.0;
const TITLE: f64 = 18.0;
const STATEMENT: f64 = 12.0;
const HEADING: f64 = 11.0;
const BODY: f64 = 9.0;
/// Distance of lines, as a multiple of the font size.
const LEADING: f64 = 1.35;
/// Space above a heading, and below a block.
const GAP: f64 = 8.0;
/// Space between the cells of a table.
const GUTTER: f64 = 6.0;
/// A picture leaves at least this share of the text height to other blocks.
const MOST_PICTURE: f64 = 0.55;

/// An item on a page.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Mark {
    Text {
        at: [f64; 2],
        size: f64,
        bold: bool,
        text: String,
    },
    /// A thin line from left to right.
    Rule {
        at: [f64; 2],
        length: f64,
    },
    /// The picture of a block, placed by its lower left corner.
    Picture {
        block: usize,
        at: [f64; 2],
        size: [f64; 2],
    },
}

/// The marks of each page.
pub(super) fn pages(document: &Document) -> Vec<Vec<Mark>> {
    let mut layout = Layout::new(document.paper.size());
    layout.lines(&document.title, TITLE, true);
    layout.skip(GAP);
    for (index, block) in document.blocks.iter().enumerate() {
        match block {
            Block::Heading(text) => {
                layout.skip(GAP);
                // With at least one line of the next block.
                layout.need(3.0 * HEADING * LEADING);
                layout.lines(text, HEADING, true);
                layout.skip(GAP / 4.0);
            }
            Block::Statement(text) => {
                layout.lines(text, STATEMENT, true);
                layout.skip(GAP);
            }
            Block::Paragraph(text) => {
                layout.lines(text, BODY, false);
                layout.skip(GAP / 2.0);
            }
            Block::Table { columns, rows } => layout.table(columns, rows),
            Block::Picture { image, caption } => {
                layout.picture(index, [image.width(), image.height()].map(f64::from), caption);
            }
        }
    }
    layout.finish(&document.footer)
}

struct Layout {
    pages: Vec<Vec<Mark>>,
    paper: [f64; 2],
    /// The upper end of the next block.
    y: f64,
}

impl Layout {
    fn new(paper: [f64; 2]) -> Self {
        Self { pages: vec![Vec::new()], paper, y: paper[1] - MARGIN }
    }

    fn space(&self) -> f64 {
        self.paper[0] - 2.0 * MARGIN
    }

    /// The lowest position of text; the footer is below.
    fn floor() -> f64 {
        MARGIN + 2.0 * BODY
    }

    fn put(&mut self, mark: Mark) {
        if let Some(page) = self.pages.last_mut() {
            page.push(mark);
        }
    }

    fn skip(&mut self, height: f64) {
        self.y -= height;
    }

    /// Starts a new page if less than this height is left.
    fn need(&mut self, height: f64) {
        if self.y - height < Self::floor() {
            self.pages.push(Vec::new());
            self.y = self.paper[1] - MARGIN;
        }
    }

    fn line(&mut self, x: f64, text: String, size: f64, bold: bool) {
        let at = [x, self.y - size];
        self.put(Mark::Text { at, size, bold, text });
    }

    fn lines(&mut self, text: &str, size: f64, bold: bool) {
        for line in wrapped(text, size, bold, self.space()) {
            self.need(size * LEADING);
            self.line(MARGIN, line, size, bold);
            self.skip(size * LEADING);
        }
    }

    fn table(&mut self, columns: &[(String, f64)], rows: &[Vec<String>]) {
        let whole: f64 = columns.iter().map(|(_, share)| share).sum();
        let widths: Vec<f64> = columns.iter().map(|(_, share)| self.space() * share / whole).collect();
        let titles: Vec<String> = columns.iter().map(|(title, _)| title.clone()).collect();
        let has_titles = titles.iter().any(|title| !title.is_empty());
        if has_titles {
            self.row(&titles, &widths, true);
        }
        for cells in rows {
            let page = self.pages.len();
            self.row(cells, &widths, false);
            // The headings are repeated where the table continues.
            if has_titles && self.pages.len() > page {
                let (row, top) = (self.pages.pop().unwrap_or_default(), self.paper[1] - MARGIN);
                self.pages.push(Vec::new());
                let used = top - self.y;
                self.y = top;
                self.row(&titles, &widths, true);
                let shift = top - self.y;
                for mark in row {
                    self.put(mark.lowered(shift));
                }
                self.skip(used);
            }
        }
        self.skip(GAP);
    }

    fn row(&mut self, cells: &[String], widths: &[f64], bold: bool) {
        let wrapped: Vec<Vec<String>> =
            cells.iter().zip(widths).map(|(cell, width)| wrapped(cell, BODY, bold, width - GUTTER)).collect();
        let height = wrapped.iter().map(Vec::len).max().unwrap_or(1) as f64 * BODY * LEADING;
        self.need(height + 2.0);
        let top = self.y;
        let mut x = MARGIN;
        for (lines, width) in wrapped.into_iter().zip(widths) {
            self.y = top;
            for line in lines {
                self.line(x, line, BODY, bold);
                self.skip(BODY * LEADING);
            }
            x += width;
        }
        self.y = top - height - 2.0;
        let at = [MARGIN, self.y + 1.0];
        self.put(Mark::Rule { at, length: self.space() });
    }

    fn picture(&mut self, block: usize, pixels: [f64; 2], caption: &str) {
        let most = MOST_PICTURE * (self.paper[1] - 2.0 * MARGIN);
        let scale = (self.space() / pixels[0]).min(most / pixels[1]);
        let size = pixels.map(|length| scale * length);
        let lines = wrapped(caption, BODY, false, self.space()).len() as f64;
        self.need(size[1] + GAP + lines * BODY * LEADING);
        self.skip(size[1]);
        let at = [MARGIN + 0.5 * (self.space() - size[0]), self.y];
        self.put(Mark::Picture { block, at, size });
        self.skip(GAP / 2.0);
        self.lines(caption, BODY, false);
        self.skip(GAP);
    }

    fn finish(mut self, footer: &str) -> Vec<Vec<Mark>> {
        let count = self.pages.len();
        let space = self.space();
        for (i, page) in self.pages.iter_mut().enumerate() {
            let number = format!("{} of {count}", i + 1);
            let room = space - width(&number, BODY, false) - GUTTER;
            let text = wrapped(footer, BODY, false, room).swap_remove(0);
            page.push(Mark::Text { at: [MARGIN, MARGIN - BODY], size: BODY, bold: false, text });
            let x = MARGIN + space - width(&number, BODY, false);
            page.push(Mark::Text { at: [x, MARGIN - BODY], size: BODY, bold: false, text: number });
        }
        self.pages
    }
}

impl Mark {
    fn lowered(self, by: f64) -> Self {
        let lower = |[x, y]: [f64; 2]| [x, y - by];
        match self {
            Self::Text { at, size, bold, text } => Self::Text { at: lower(at), size, bold, text },
            Self::Rule { at, length } => Self::Rule { at: lower(at), length },
            Self::Picture { block, at, size } => Self::Picture { block, at: lower(at), size },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Paper;
    use super::*;
    use crate::Image;

    fn document(rows: usize) -> Document {
        let image = Image::checkerboard(4, 50, [[0, 0, 0], [255, 255, 255]]);
        let row = |i: usize| {
            vec![format!("row {i}"), "a cell of several words that needs more than a line".repeat(2)]
        };
        Document {
            title: "Title".to_owned(),
            blocks: vec![
                Block::Statement("verdict ".repeat(30)),
                Block::Picture { image, caption: "what it shows".to_owned() },
                Block::Heading("Numbers".to_owned()),
                Block::Table {
                    columns: vec![("name".to_owned(), 1.0), ("meaning".to_owned(), 2.0)],
                    rows: (0..rows).map(row).collect(),
                },
                Block::Paragraph("the end".to_owned()),
            ],
            footer: "footer ".repeat(40),
            paper: Paper::A4,
        }
    }

    /// Everything lies within the margins, every row occurs once, and every page of the table has the headings.
    #[test]
    fn pages_hold_everything_within_margins() {
        let document = document(120);
        let pages = pages(&document);
        assert!(pages.len() > 2);
        let [paper_width, paper_height] = Paper::A4.size();
        let mut rows = 0;
        for page in &pages {
            let texts: Vec<&String> = page
                .iter()
                .filter_map(|m| if let Mark::Text { text, .. } = m { Some(text) } else { None })
                .collect();
            let here = texts.iter().filter(|text| text.starts_with("row ")).count();
            assert_eq!(texts.iter().filter(|text| **text == "meaning").count(), usize::from(here > 0));
            rows += here;
            for mark in page {
                let (at, size) = match mark {
                    Mark::Text { at, size, bold, text } => (at, [width(text, *size, *bold), *size]),
                    Mark::Rule { at, length } => (at, [*length, 0.0]),
                    Mark::Picture { at, size, .. } => (at, *size),
                };
                assert!(at[0] >= MARGIN - 1e-9 && at[0] + size[0] <= paper_width - MARGIN + 1e-9, "{mark:?}");
                assert!(
                    at[1] >= MARGIN - BODY - 1e-9 && at[1] + size[1] <= paper_height - MARGIN + 1e-9,
                    "{mark:?}"
                );
            }
        }
        assert_eq!(rows, 120);
    }

    #[test]
    fn a_short_document_has_one_page() {
        assert_eq!(pages(&document(2)).len(), 1);
    }
}
