//! Documents for printing: text, tables and pictures on pages of A4 or Letter, as PDF.

mod layout;
mod metrics;
mod pdf;

use crate::Image;

/// A size of paper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Paper {
    /// 210 mm × 297 mm.
    #[default]
    A4,
    /// 8.5 in × 11 in.
    Letter,
}

impl Paper {
    /// Width and height in points, 1/72 inch.
    fn size(self) -> [f64; 2] {
        match self {
            Self::A4 => [595.28, 841.89],
            Self::Letter => [612.0, 792.0],
        }
    }
}

/// A block of a document, from margin to margin.
#[derive(Clone, Debug)]
pub enum Block {
    /// A heading.
    Heading(String),
    /// A prominent sentence, such as a verdict.
    Statement(String),
    /// A paragraph.
    Paragraph(String),
    /// A table with a row of column headings, which is omitted if all are empty.
    Table {
        /// The heading of each column, and its share of the width.
        columns: Vec<(String, f64)>,
        /// As many cells in each row as there are columns.
        rows: Vec<Vec<String>>,
    },
    /// A picture as wide as the text.
    Picture {
        /// Its pixels.
        image: Image,
        /// The caption.
        caption: String,
    },
}

/// A document for printing.
///
/// Text is set in Helvetica, which every PDF reader has; characters outside of Western European alphabets are shown as question
/// marks.
///
/// # Example
/// ```
/// use pompeiu_figures::paper::{Block, Document, Paper};
/// let document = Document {
///     title: "A verdict".to_owned(),
///     blocks: vec![Block::Statement("WITHIN TOLERANCE 0.1 mm".to_owned())],
///     footer: "pompeiu".to_owned(),
///     paper: Paper::Letter,
/// };
/// assert!(document.pdf().starts_with(b"%PDF-1"));
/// ```
#[derive(Clone, Debug)]
pub struct Document {
    /// The title, on the first page and in the properties of the file.
    pub title: String,
    /// The blocks, in order. A block that does not fit moves to the next page; a table continues there.
    pub blocks: Vec<Block>,
    /// Text at the foot of each page, before its number.
    pub footer: String,
    /// The size of all pages.
    pub paper: Paper,
}

impl Document {
    /// The bytes of a PDF file: the same for the same document.
    pub fn pdf(&self) -> Vec<u8> {
        pdf::write(self, &layout::pages(self))
    }
}
