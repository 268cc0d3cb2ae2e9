//! Text that contains numbers, which the page formats.

use serde::Serialize;

/// Text with embedded numbers: the page formats them uniformly, and rounds the ends of enclosures outwards.
///
/// # Example
/// ```
/// use pompeiu_figures::page::Text;
///
/// let text = Text::from("At ").number(0.003, 3).text(" mm: ").count(1200, "piece").text(" left");
/// # assert_eq!(text, text.clone());
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Text(Vec<Part>);

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
enum Part {
    Text(String),
    Number { number: f64, digits: u8 },
    Count { count: u64, of: String },
    Enclosure { enclosure: [f64; 2] },
}

impl Text {
    /// Appends text.
    #[must_use]
    pub fn text(self, text: impl Into<String>) -> Self {
        self.with(Part::Text(text.into()))
    }

    /// Appends a number with at most this many significant digits, from 1 to 17.
    #[must_use]
    pub fn number(self, number: f64, digits: u8) -> Self {
        self.with(Part::Number { number, digits: digits.clamp(1, 17) })
    }

    /// Appends a count: "1 face", "2 faces". The noun is given in the singular and may be empty.
    #[must_use]
    pub fn count(self, count: usize, of: &str) -> Self {
        self.with(Part::Count { count: count as u64, of: of.to_owned() })
    }

    /// Appends an interval.
    #[must_use]
    pub fn enclosure(self, enclosure: [f64; 2]) -> Self {
        self.with(Part::Enclosure { enclosure })
    }

    fn with(mut self, part: Part) -> Self {
        self.0.push(part);
        self
    }

    /// The numbers in the text, for checks.
    pub(super) fn numbers(&self) -> impl Iterator<Item = &f64> {
        self.0.iter().flat_map(|part| match part {
            Part::Number { number, .. } => std::slice::from_ref(number),
            Part::Enclosure { enclosure } => enclosure.as_slice(),
            Part::Text(_) | Part::Count { .. } => &[],
        })
    }
}

impl From<&str> for Text {
    fn from(text: &str) -> Self {
        Self::from(text.to_owned())
    }
}

impl From<String> for Text {
    fn from(text: String) -> Self {
        Self(if text.is_empty() { vec![] } else { vec![Part::Text(text)] })
    }
}
