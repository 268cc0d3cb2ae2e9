//! Tables: of numbers, of text, of pictures.

use super::error::{check_bounds, check_finite, check_length};
use super::{PageError, PlaceId, Text};
use crate::Image;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

/// A table. A row can link to a place in a scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Table {
    /// Identifier for scripts and tests; may be empty.
    pub key: String,
    /// A description for screen readers.
    pub caption: String,
    /// Column headings.
    pub columns: Vec<String>,
    /// The rows; the first cell is the heading of the row.
    pub rows: Vec<Row>,
    /// Whether a click on a column heading sorts the rows.
    pub sortable: bool,
}

/// A row of a table.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    /// One per column.
    pub cells: Vec<Cell>,
    /// The place shown on a click.
    pub place: Option<PlaceId>,
}

/// A cell of a table.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "camelCase")]
pub enum Cell {
    /// Text; sorted as text.
    Text {
        /// The text.
        text: Text,
    },
    /// A number with this many significant digits.
    Number {
        /// The number.
        value: f64,
        /// Digits.
        digits: u8,
    },
    /// An enclosure, its ends rounded outwards; sorted by its upper end.
    Enclosure {
        /// The ends.
        ends: [f64; 2],
    },
    /// The lower end of an enclosure, rounded down.
    Lower {
        /// The ends.
        ends: [f64; 2],
    },
    /// The upper end of an enclosure, rounded up.
    Upper {
        /// The ends.
        ends: [f64; 2],
    },
    /// A bar of length proportional to the number, relative to the other bars of the table.
    Bar {
        /// The number.
        value: f64,
    },
    /// A small picture.
    #[serde(rename_all = "camelCase")]
    Picture {
        /// The PNG file in base64; see [`Cell::picture`].
        png: String,
        /// The alternative text.
        alt: String,
    },
    /// An empty cell.
    Empty,
}

impl Cell {
    /// Text.
    pub fn text(text: impl Into<Text>) -> Self {
        Self::Text { text: text.into() }
    }

    /// A picture.
    pub fn picture(image: &Image, alt: impl Into<String>) -> Self {
        let mut png = vec![];
        let written = image.write_png(&mut png);
        debug_assert!(written.is_ok(), "writing to memory does not fail");
        Self::Picture { png: STANDARD.encode(png), alt: alt.into() }
    }

    fn check(&self) -> Result<(), PageError> {
        match self {
            Self::Text { text } => check_finite("a cell of a table", text.numbers()),
            Self::Number { value, .. } | Self::Bar { value } => check_finite("a cell of a table", [value]),
            Self::Enclosure { ends } | Self::Lower { ends } | Self::Upper { ends } => {
                check_bounds("a cell of a table", [ends])
            }
            Self::Picture { .. } | Self::Empty => Ok(()),
        }
    }
}

impl Table {
    pub(super) fn check(&self) -> Result<(), PageError> {
        for row in &self.rows {
            check_length("a row of a table", row.cells.len(), self.columns.len())?;
            row.cells.iter().try_for_each(Cell::check)?;
        }
        Ok(())
    }
}
