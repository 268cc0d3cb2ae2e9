//! The HTML file around the data of a page.

use serde_json::Value;

const SCRIPT: &str = include_str!("../../web/dist/page.js");
const STYLE: &str = include_str!("../../web/dist/page.css");

/// A browser that enforces this policy makes no network requests.
const POLICY: &str =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:";

/// The file: the text shown without scripts, the data, and the script.
pub(super) fn file(title: &str, summary: &str, data: &Value) -> String {
    // Inside a script element only `<` could end the element or begin a comment.
    let data = data.to_string().replace('<', "\\u003c");
    let (title, summary) = (escaped(title), escaped(summary));
    let mut page = String::with_capacity(data.len() + SCRIPT.len() + STYLE.len() + 4096);
    for part in [
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"",
        POLICY,
        "\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<link rel=\"icon\" href=\"data:,\">\n<title>",
        &title,
        "</title>\n<style>\n",
        STYLE,
        "</style>\n</head>\n<body>\n<p class=\"loading\">",
        &summary,
        "</p>\n<noscript><p class=\"loading\">The interactive view needs JavaScript.</p></noscript>\n",
        "<script type=\"application/json\" id=\"data\">",
        &data,
        "</script>\n<script>\n",
        SCRIPT,
        "</script>\n</body>\n</html>\n",
    ] {
        page += part;
    }
    page
}

/// Text with HTML characters escaped.
fn escaped(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => shown += "&amp;",
            '<' => shown += "&lt;",
            '>' => shown += "&gt;",
            '"' => shown += "&quot;",
            '\'' => shown += "&#39;",
            c => shown.push(c),
        }
    }
    shown
}
