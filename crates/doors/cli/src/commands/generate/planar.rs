//! Outlines in the plane.

use crate::files;
use crate::printer::Printer;
use anyhow::bail;
use clap::{Args, ValueEnum};
use pompeiu::complexity::generate::{self, PointOrder};
use pompeiu::planar::svg::{Polyline as Curve, path_data};
use pompeiu::planar::{Outline, dxf};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// A curve through random points.
#[derive(Args)]
pub(crate) struct Polyline {
    /// Points that it passes through, from 3 to 1000
    #[arg(long, default_value_t = 5, value_name = "N")]
    points: usize,
    /// In which order it does
    #[arg(long, value_enum, default_value_t)]
    order: Order,
    /// Which random points
    #[arg(long, default_value_t = 0, value_name = "N")]
    seed: u64,
    /// The outline to write: .svg, .dxf or .txt
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,
}

#[derive(Clone, Copy, Default, ValueEnum)]
enum Order {
    /// As they were drawn: the curve may cross itself
    #[default]
    Random,
    /// By their direction from their mean
    Angle,
}

/// A circle of pixels with noise.
#[derive(Args)]
pub(crate) struct NoisyCircle {
    /// Of the circle, in pixels
    #[arg(long, default_value_t = 20, value_name = "PIXELS")]
    radius: u32,
    /// How often every pixel of the border takes a walk
    #[arg(long, default_value_t = 1, value_name = "N")]
    level: u32,
    /// The longest walk
    #[arg(long, default_value_t = 6, value_name = "PIXELS")]
    steps: u32,
    /// Which random walks
    #[arg(long, default_value_t = 0, value_name = "N")]
    seed: u64,
    /// The outline to write: .svg, .dxf or .txt
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,
}

impl Polyline {
    pub(super) fn write(&self, printer: &Printer) -> anyhow::Result<()> {
        let order = match self.order {
            Order::Random => PointOrder::Random,
            Order::Angle => PointOrder::Angle,
        };
        write(&self.output, || generate::polyline(self.points, self.seed, order), printer)
    }
}

impl NoisyCircle {
    pub(super) fn write(&self, printer: &Printer) -> anyhow::Result<()> {
        let made = || generate::noisy_circle(self.radius, self.level, self.steps, self.seed);
        write(&self.output, made, printer)
    }
}

/// Makes an outline and writes it in the format that the suffix names.
fn write<E: std::error::Error + Send + Sync + 'static>(
    path: &Path,
    make: impl FnOnce() -> Result<Outline, E>,
    printer: &Printer,
) -> anyhow::Result<()> {
    files::check_place(path, &[])?;
    let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_lowercase()).unwrap_or_default();
    if !["svg", "dxf", "txt"].contains(&suffix.as_str()) {
        bail!("{}: outlines are written as .svg, .dxf or .txt", path.display());
    }
    let points = make()?.into_points();
    let text = match suffix.as_str() {
        "svg" => svg(&points),
        "dxf" => dxf::write(&[Curve { id: "outline".to_owned(), points, is_closed: true }], false),
        _ => points.iter().fold(String::new(), |mut text, [x, y]| {
            let _ = writeln!(text, "{x} {y}");
            text
        }),
    };
    files::write_whole(path, text.as_bytes(), printer)
}

fn svg(points: &[[f64; 2]]) -> String {
    let bounds = |k: usize| {
        let at = || points.iter().map(|p| p[k]);
        (at().fold(f64::INFINITY, f64::min), at().fold(f64::NEG_INFINITY, f64::max))
    };
    let ([x, right], [y, bottom]) = (<[f64; 2]>::from(bounds(0)), <[f64; 2]>::from(bounds(1)));
    let margin = 0.02 * (right - x).max(bottom - y);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{} {} {} {}\">\n<path fill-rule=\"evenodd\" d=\"{}\"/>\n</svg>\n",
        x - margin,
        y - margin,
        right - x + 2.0 * margin,
        bottom - y + 2.0 * margin,
        path_data(points, true)
    )
}
