//! Interactive pages: one HTML file each, which holds all it needs and asks no network for anything.
//!
//! A page is plain data, given by the caller; [`DeviationPage::html`] and [`FieldsPage::html`] check them and return the file. Arrays travel as
//! compressed little-endian numbers, coordinates in single precision relative to the middle of the scene, values and
//! bounds in double precision: what the page shows of them is what was given, to the last bit.
//!
//! The part that runs in the browser is in `web/`, and bundled in `web/dist` so that nobody needs node to build this crate.

mod deviation;
mod encode;
mod error;
mod fields;
mod scene;
mod surface_data;

pub use deviation::{
    Axis, Bounds, Deviation, DeviationPage, DisplayTriangles, Exceedance, Histogram, PageSurface, PointPair,
    Region, SearchStage, Statistic,
};
pub use error::PageError;
pub use fields::{FieldsPage, PageField, PageTable};

use serde_json::Value;

const SCRIPT: &str = include_str!("../../web/dist/report.js");
const STYLE: &str = include_str!("../../web/dist/report.css");

/// A browser that respects this loads nothing from anywhere.
const POLICY: &str =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:";

/// The file: what to show without scripts, the data, and the program that shows them.
fn file(title: &str, summary: &str, data: &Value) -> String {
    // Inside a script element only `<` could end it, or begin a comment.
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

/// Text as HTML shows it.
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
