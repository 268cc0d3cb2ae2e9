//! Options of what people look at: pages and pictures.

use super::suffix;
use crate::files;
use crate::numbers::tuple;
use crate::printer::Printer;
use clap::{Args, ValueEnum};
use pompeiu::figures;
use std::path::{Path, PathBuf};

#[derive(Args)]
pub(crate) struct Picture {
    /// Write a page to explore in a browser, one file that needs no network
    #[arg(long, value_parser = suffix::page, value_name = "FILE.html")]
    pub(crate) report: Option<PathBuf>,
    /// Write a picture, drawn without a graphics card: the same pixels on every machine
    #[arg(long, value_parser = suffix::picture, value_name = "FILE.png")]
    pub(crate) image: Option<PathBuf>,
    /// Size of the picture in pixels
    #[arg(long, value_parser = size, default_value = "1600x900", value_name = "WIDTHxHEIGHT")]
    pub(crate) image_size: (u32, u32),
    /// Which way is up
    #[arg(long, value_enum, default_value_t)]
    pub(crate) up: Up,
    /// The direction from the meshes to the eye, three numbers
    #[arg(long, value_parser = tuple::<3>, allow_hyphen_values = true, value_name = "X,Y,Z")]
    pub(crate) from: Option<[f64; 3]>,
    /// Background of the picture
    #[arg(long, value_enum, default_value_t)]
    pub(crate) theme: Theme,
}

/// Draws a picture of so many pixels in a row and rows.
pub(crate) trait Draw:
    FnOnce(u32, u32, figures::Theme, figures::View) -> Result<figures::Image, figures::FigureError>
{
}

impl<F> Draw for F where
    F: FnOnce(u32, u32, figures::Theme, figures::View) -> Result<figures::Image, figures::FigureError>
{
}

impl Picture {
    /// The files to write.
    pub(crate) fn outputs(&self) -> impl Iterator<Item = &Path> {
        [&self.report, &self.image].into_iter().flatten().map(PathBuf::as_path)
    }

    /// Writes what was asked for.
    pub(crate) fn write(
        &self,
        page: impl FnOnce() -> Result<String, figures::page::PageError>,
        image: impl Draw,
        printer: &Printer,
    ) -> anyhow::Result<()> {
        if let Some(path) = &self.report {
            files::write_whole(path, page()?.as_bytes(), printer)?;
        }
        match &self.image {
            Some(path) => self.write_image(path, image, printer),
            None => Ok(()),
        }
    }

    /// Writes a picture of the size that was asked for.
    pub(crate) fn write_image(&self, path: &Path, image: impl Draw, printer: &Printer) -> anyhow::Result<()> {
        files::write_whole(path, &self.png(image)?, printer)
    }

    /// A picture of the size that was asked for, as a file.
    pub(crate) fn png(&self, image: impl Draw) -> anyhow::Result<Vec<u8>> {
        let (width, height) = self.image_size;
        let mut png = Vec::new();
        image(width, height, self.theme.into(), self.view())?.write_png(&mut png)?;
        Ok(png)
    }

    /// Where it is looked from.
    pub(crate) fn view(&self) -> figures::View {
        let view = figures::View::default().with_up(self.up.axis());
        self.from.map_or(view, |direction| view.with_direction_to_eye(direction))
    }
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Up {
    X,
    #[default]
    Y,
    Z,
}

impl Up {
    pub(crate) fn axis(self) -> [f64; 3] {
        match self {
            Self::X => [1.0, 0.0, 0.0],
            Self::Y => [0.0, 1.0, 0.0],
            Self::Z => [0.0, 0.0, 1.0],
        }
    }
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Theme {
    #[default]
    Light,
    Dark,
}

impl From<Theme> for figures::Theme {
    fn from(theme: Theme) -> Self {
        match theme {
            Theme::Light => Self::Light,
            Theme::Dark => Self::Dark,
        }
    }
}

/// Parses a width and a height.
fn size(text: &str) -> Result<(u32, u32), String> {
    let parse = |part: &str| part.trim().parse::<u32>().ok().filter(|n| *n > 0);
    text.split_once(['x', '×', ','])
        .and_then(|(width, height)| parse(width).zip(parse(height)))
        .ok_or_else(|| "expected a width and a height in pixels, such as 1600x900".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_two_sides() {
        assert_eq!([size("1600x900"), size("1600, 900")], [Ok((1600, 900)), Ok((1600, 900))]);
        for wrong in ["1600", "0x10", "ax10", "10x", "-1x5"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }
}
