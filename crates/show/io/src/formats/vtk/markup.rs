//! Limits on XML tags, checked before the document is parsed.
//!
//! The parser compares every attribute of an element with all others, and every namespace with all in scope, which takes minutes
//! for 100,000 of them.

use crate::error::{FormatError, Location};
use crate::text::line_of;
use memchr::{memchr, memchr3, memmem};

/// The most attributes of an element; the format uses a dozen.
const MOST_ATTRIBUTES: usize = 256;

/// The most namespaces that a document may declare; the format uses none.
const MOST_NAMESPACES: usize = 64;

/// Refuses documents with too many attributes in an element, or too many namespaces.
pub(super) fn check(xml: &str) -> Result<(), FormatError> {
    let bytes = xml.as_bytes();
    let namespaces = memmem::find_iter(bytes, b"xmlns").take(MOST_NAMESPACES + 1);
    if let Some(one_more) = namespaces.enumerate().find_map(|(i, at)| (i == MOST_NAMESPACES).then_some(at)) {
        return Err(too_many(bytes, one_more, MOST_NAMESPACES, "namespaces in the document"));
    }
    let mut at = 0;
    while let Some(start) = memchr(b'<', &bytes[at..]).map(|length| at + length) {
        let after = |mark: &[u8]| {
            memmem::find(&bytes[start..], mark).map_or(bytes.len(), |length| start + length + mark.len())
        };
        at = match &bytes[start + 1..] {
            [b'!', b'-', b'-', ..] => after(b"-->"),
            [b'!', b'[', ..] => after(b"]]>"),
            [b'?', ..] => after(b"?>"),
            _ => end_of_tag(bytes, start)?,
        };
    }
    Ok(())
}

/// The end of the tag that begins at `start`, after its quoted attributes.
fn end_of_tag(bytes: &[u8], start: usize) -> Result<usize, FormatError> {
    let (mut at, mut attributes) = (start, 0);
    while let Some(mark) = memchr3(b'>', b'"', b'\'', &bytes[at..]).map(|length| at + length) {
        if bytes[mark] == b'>' {
            return Ok(mark + 1);
        }
        attributes += 1;
        if attributes > MOST_ATTRIBUTES {
            return Err(too_many(bytes, start, MOST_ATTRIBUTES, "attributes in one element"));
        }
        let Some(length) = memchr(bytes[mark], &bytes[mark + 1..]) else { break };
        at = mark + length + 2;
    }
    Ok(bytes.len())
}

fn too_many(bytes: &[u8], at: usize, most: usize, what: &str) -> FormatError {
    let problem = format!("found more than {most} {what}, expected at most {most}");
    FormatError::new(Location::Line(line_of(bytes, at)), problem)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The text of parts 0, 1, …, concatenated.
    fn repeated(count: usize, part: impl Fn(usize) -> String) -> String {
        (0..count).map(part).collect::<Vec<_>>().concat()
    }

    fn element(attributes: usize) -> String {
        let attributes = repeated(attributes, |i| format!(" a{i}='>'"));
        format!("<!-- \" ' --><?x '?>\n<a{attributes}><![CDATA[\"<']]>\n<b c=\"1\"/>it's</a>")
    }

    #[test]
    fn attributes_are_counted_in_each_element() {
        assert_eq!(check(&element(MOST_ATTRIBUTES)), Ok(()));
        assert_eq!(check(&element(2).repeat(MOST_ATTRIBUTES)), Ok(()));
        let error = check(&element(MOST_ATTRIBUTES + 1)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "line 2: found more than 256 attributes in one element, expected at most 256"
        );
    }

    #[test]
    fn namespaces_are_counted_in_the_document() {
        let nested = |depth| {
            repeated(depth, |i| {
                format!(
                    "<a xmlns:n{i}=\"{i}\">
"
                )
            })
        };
        assert_eq!(check(&nested(MOST_NAMESPACES)), Ok(()));
        let error = check(&nested(MOST_NAMESPACES + 1)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "line 65: found more than 64 namespaces in the document, expected at most 64"
        );
    }

    #[test]
    fn whatever_ends_early_is_left_to_the_parser() {
        for text in ["", "<", "<a", "<a b='", "<a b='c'", "<!--", "<![CDATA[", "<?", "<!"] {
            assert_eq!(check(text), Ok(()), "{text}");
        }
    }
}
