//! How the program was called, for reports.

/// The command as it was called, quoted where a shell needs it.
pub(crate) fn called() -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./,:=+%@".contains(c);
    let quoted = |word: String| {
        if !word.is_empty() && word.chars().all(plain) {
            word
        } else {
            format!("'{}'", word.replace('\'', "'\\''"))
        }
    };
    let words = std::env::args().skip(1).map(quoted);
    std::iter::once("pompeiu".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}
