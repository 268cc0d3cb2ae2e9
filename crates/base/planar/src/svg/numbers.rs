//! Numbers in path data and attributes.

use crate::Point;

/// Numbers separated by white space and commas.
pub(super) fn numbers(text: &str) -> Result<Vec<f64>, String> {
    let mut scanner = Scanner::new(text);
    let mut found = Vec::new();
    while !scanner.is_done() {
        found.push(scanner.number()?);
    }
    Ok(found)
}

pub(super) struct Scanner<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Scanner<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self { text, at: 0 }
    }

    fn skip(&mut self) {
        let bytes = self.text.as_bytes();
        while bytes.get(self.at).is_some_and(|b| b.is_ascii_whitespace() || *b == b',') {
            self.at += 1;
        }
    }

    pub(super) fn is_done(&mut self) -> bool {
        self.skip();
        self.at >= self.text.len()
    }

    pub(super) fn letter(&mut self) -> Option<char> {
        self.skip();
        let byte = *self.text.as_bytes().get(self.at)?;
        (byte.is_ascii_alphabetic()).then(|| {
            self.at += 1;
            char::from(byte)
        })
    }

    pub(super) fn flag(&mut self) -> Result<bool, String> {
        self.skip();
        let found = match self.text.as_bytes().get(self.at) {
            Some(b'0') => false,
            Some(b'1') => true,
            _ => return Err(format!("expected 0 or 1, {}", self.unexpected())),
        };
        self.at += 1;
        Ok(found)
    }

    pub(super) fn point(&mut self, origin: Point) -> Result<Point, String> {
        Ok([origin[0] + self.number()?, origin[1] + self.number()?])
    }

    /// Numbers need no separator if the next character cannot continue them: `1.5.5-3` holds three.
    pub(super) fn number(&mut self) -> Result<f64, String> {
        self.skip();
        let rest = &self.text.as_bytes()[self.at.min(self.text.len())..];
        let (mut end, mut has_point, mut has_exponent) = (0, false, false);
        while let Some(byte) = rest.get(end) {
            match byte {
                b'0'..=b'9' => (),
                b'+' | b'-' if end == 0 || matches!(rest[end - 1], b'e' | b'E') => (),
                b'.' if !has_point && !has_exponent => has_point = true,
                b'e' | b'E' if !has_exponent && end > 0 => has_exponent = true,
                _ => break,
            }
            end += 1;
        }
        let text = &self.text[self.at..self.at + end];
        match text.parse::<f64>() {
            Ok(x) if x.is_finite() => {
                self.at += end;
                Ok(x)
            }
            _ => Err(format!("expected a number, {}", self.unexpected())),
        }
    }

    pub(super) fn unexpected(&self) -> String {
        let rest: String = self.text.get(self.at..).unwrap_or_default().chars().take(12).collect();
        if rest.is_empty() { "found the end".to_owned() } else { format!("found `{rest}`") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_run_into_each_other() {
        assert_eq!(numbers("1.5.5-3e-2,7").unwrap(), [1.5, 0.5, -0.03, 7.0]);
    }
}
