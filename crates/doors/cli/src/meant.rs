//! What a command line without a command probably meant.

use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::path::Path;

/// What other programs call it, and the command for it.
const KNOWN_AS: [(&str, &str); 9] = [
    ("hausdorff", "distance"),
    ("compare", "deviation"),
    ("diff", "deviation"),
    ("icp", "align"),
    ("register", "align"),
    ("decimate", "simplify"),
    ("unwrap", "flatten"),
    ("parameterize", "flatten"),
    ("fix", "repair"),
];

/// A command for a word from elsewhere, or for the files that were given where a command was expected.
pub(crate) fn meant(error: &clap::Error) -> Option<String> {
    if error.kind() != ErrorKind::InvalidSubcommand {
        return None;
    }
    let Some(ContextValue::String(first)) = error.get(ContextKind::InvalidSubcommand) else { return None };
    if let Some((word, command)) = KNOWN_AS.iter().find(|(word, _)| word == first) {
        return Some(format!("{word} is called `pompeiu {command}` here"));
    }
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let files: Vec<&str> = words.iter().map(String::as_str).filter(|word| Path::new(word).exists()).collect();
    match files[..] {
        [one] if one == first => Some(format!("did you mean `pompeiu info {one}`?")),
        [a, b] if a == first => Some(format!("did you mean `pompeiu distance {a} {b}`?")),
        [first_file, ..] if first_file == first => {
            Some(format!("did you mean `pompeiu matrix {}`?", files.join(" ")))
        }
        _ => None,
    }
}
