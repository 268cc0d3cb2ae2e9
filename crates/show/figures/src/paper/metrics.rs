//! Helvetica: widths of text, and its encoding.
//!
//! # Source
//! Adobe, *Core 14 AFM files*: the widths of Helvetica in thousandths of its size.

/// Widths of the characters from the space to the tilde.
const WIDTHS: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556, 556, 556,
    556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278,
    500, 667, 556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469,
    556, 333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556, 556, 556, 333, 500,
    278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584,
];
/// Of all other characters, which are mostly letters with accents and signs.
const OTHER: u16 = 600;
/// The bold face is at most this much wider.
const BOLD: f64 = 1.12;

/// The width of a line at a font size, in its unit; an upper bound for bold text.
pub(super) fn width(text: &str, size: f64, bold: bool) -> f64 {
    let of = |c: char| {
        let index = (c as usize).checked_sub(32);
        f64::from(index.and_then(|i| WIDTHS.get(i)).copied().unwrap_or(OTHER))
    };
    text.chars().map(of).sum::<f64>() * size / 1000.0 * if bold { BOLD } else { 1.0 }
}

/// Lines no wider than `space`, broken between words, and within words that are too long.
pub(super) fn wrapped(text: &str, size: f64, bold: bool, space: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let mut rest = word;
        loop {
            let Some(line) = lines.last_mut() else { return lines };
            let gap = if line.is_empty() { "" } else { " " };
            if width(&format!("{line}{gap}{rest}"), size, bold) <= space {
                line.push_str(gap);
                line.push_str(rest);
                break;
            }
            if !line.is_empty() {
                lines.push(String::new());
                continue;
            }
            let fits = |end: &usize| width(&rest[..*end], size, bold) <= space;
            let ends = rest.char_indices().map(|(i, c)| i + c.len_utf8());
            // At least one character, so that the loop ends.
            let first = ends.clone().next().unwrap_or(rest.len());
            let end = ends.take_while(fits).last().unwrap_or(first);
            line.push_str(&rest[..end]);
            rest = &rest[end..];
            if rest.is_empty() {
                break;
            }
            lines.push(String::new());
        }
    }
    lines
}

/// The bytes of a text in PDF's encoding `WinAnsi`.
pub(super) fn encoded(text: &str) -> Vec<u8> {
    let byte = |c: char| match c {
        ' '..='~' | '\u{a0}'..='\u{ff}' => c as u32 as u8,
        '–' => 0x96,
        '—' => 0x97,
        '‘' => 0x91,
        '’' => 0x92,
        '“' => 0x93,
        '”' => 0x94,
        '…' => 0x85,
        '€' => 0x80,
        '•' => 0x95,
        _ => b'?',
    };
    text.chars().map(byte).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_fit_and_nothing_is_lost() {
        let text =
            "The largest distance is 0.25 mm, at averyveryveryverylongnamewithoutanyspace.obj of the folder";
        for space in [12.0, 30.0, 55.0, 1000.0] {
            let lines = wrapped(text, 10.0, false, space);
            assert!(lines.iter().all(|line| width(line, 10.0, false) <= space), "{lines:?}");
            let letters = |text: &str| text.chars().filter(|c| *c != ' ').collect::<String>();
            assert_eq!(letters(&lines.concat()), letters(text));
        }
        assert_eq!(wrapped(text, 10.0, false, 1000.0), [text]);
    }

    #[test]
    fn widths_are_those_of_the_face() {
        assert_eq!(width("Hi 2~", 1000.0, false), 722.0 + 222.0 + 278.0 + 556.0 + 584.0);
    }

    #[test]
    fn characters_have_their_code_or_a_question_mark() {
        assert_eq!(encoded("aé–²µ字"), [b'a', 0xe9, 0x96, 0xb2, 0xb5, b'?']);
    }
}
