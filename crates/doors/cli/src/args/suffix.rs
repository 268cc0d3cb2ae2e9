//! Names of files to write, whose suffix has to be that of what is written.

use std::path::PathBuf;

/// Parses the name of a page.
pub(crate) fn page(text: &str) -> Result<PathBuf, String> {
    suffixed(text, "pages are HTML", &["html", "htm"])
}

/// Parses the name of moving pictures.
pub(crate) fn film(text: &str) -> Result<PathBuf, String> {
    suffixed(
        text,
        "moving pictures are pages (.html), animated PNG (.apng), GIF (.gif) or, by ffmpeg, films (.mp4, .webm)",
        &["html", "htm", "apng", "gif", "mp4", "webm"],
    )
}

/// Parses the name of a document.
pub(crate) fn document(text: &str) -> Result<PathBuf, String> {
    suffixed(text, "documents are PDF", &["pdf"])
}

/// Parses the name of a picture.
pub(crate) fn picture(text: &str) -> Result<PathBuf, String> {
    suffixed(text, "pictures are PNG", &["png"])
}

/// Parses the name of a table.
pub(crate) fn table(text: &str) -> Result<PathBuf, String> {
    suffixed(text, "tables are comma-separated values", &["csv"])
}

/// Parses the name of a matrix.
pub(crate) fn matrix(text: &str) -> Result<PathBuf, String> {
    suffixed(text, "matrices are text", &["txt", "mat", "dat"])
}

/// Parses the name of a certificate.
pub(crate) fn certificate(text: &str) -> Result<PathBuf, String> {
    suffixed(text, "certificates have a format of their own", &["phc"])
}

/// The path, if its suffix is one of these, or if it is no file but a folder, which is refused later, or a device.
fn suffixed(text: &str, what: &str, suffixes: &[&str]) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_ascii_lowercase());
    let fits = suffix.is_some_and(|suffix| suffixes.contains(&suffix.as_str()));
    if fits || path.metadata().is_ok_and(|found| !found.is_file()) {
        Ok(path)
    } else {
        Err(format!("{what}; give the name the suffix .{}", suffixes[0]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_fitting_suffixes_are_taken() {
        for (parse, good) in
            [(page as fn(&str) -> _, "a.html"), (page, "a.HTM"), (document, "x/a.b.pdf"), (picture, "a.png")]
        {
            assert_eq!(parse(good), Ok(PathBuf::from(good)));
        }
        for (parse, wrong) in [
            (page as fn(&str) -> Result<_, _>, "a.pdf"),
            (document, "a.html"),
            (film, "a.avi"),
            (film, "a"),
            (table, "a"),
            (matrix, "a.html"),
            (certificate, "a.pdf"),
        ] {
            assert!(parse(wrong).unwrap_err().contains("give the name the suffix ."), "{wrong}");
        }
        assert!(table("/dev/null").is_ok() || !std::path::Path::new("/dev/null").exists());
    }
}
