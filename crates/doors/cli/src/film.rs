//! Moving pictures: by the program itself, or by ffmpeg where that is installed.

use crate::files;
use crate::interrupt::while_writing;
use crate::numbers::counted;
use crate::printer::Printer;
use anyhow::{Context, bail};
use pompeiu::figures::page::PageError;
use pompeiu::figures::{FigureError, FilmFormat, Image, write_film};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// From one picture to the next: that of the pages.
const INTERVAL: Duration = Duration::from_millis(80);

/// The program that makes films.
const ENCODER: &str = "ffmpeg";

/// What a file of moving pictures is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Page,
    Pictures(FilmFormat),
    Film,
}

fn kind(path: &Path) -> Kind {
    let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_ascii_lowercase());
    match suffix.as_deref() {
        Some("apng") => Kind::Pictures(FilmFormat::Apng),
        Some("gif") => Kind::Pictures(FilmFormat::Gif),
        Some("mp4" | "webm") => Kind::Film,
        _ => Kind::Page,
    }
}

/// Refuses, before any work is done, a film that no program here can make.
pub(crate) fn check(path: &Path) -> anyhow::Result<()> {
    let is_there = || {
        let mut command = Command::new(ENCODER);
        let command =
            command.arg("-version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        command.status().is_ok_and(|status| status.success())
    };
    if kind(path) == Kind::Film && !is_there() {
        bail!(
            "{}: films are made by {ENCODER}, which is not installed; install it, or write .apng, .gif or .html, which need no other program (`{ENCODER} -i RUN.apng RUN.mp4` makes a film of the pictures elsewhere)",
            path.display()
        );
    }
    Ok(())
}

/// Writes moving pictures: `page` where the suffix is that of a page, else `picture` of each number below `pictures`.
pub(crate) fn write(
    path: &Path,
    page: impl FnOnce() -> Result<String, PageError>,
    pictures: usize,
    picture: impl FnMut(usize) -> Result<Image, FigureError>,
    printer: &Printer,
) -> anyhow::Result<()> {
    let mut picture = picture;
    let mut next = |i: u32| picture(i as usize).map_err(io::Error::other);
    let pictures = u32::try_from(pictures).unwrap_or(u32::MAX);
    match kind(path) {
        Kind::Page => return files::write_whole(path, page()?.as_bytes(), printer),
        Kind::Pictures(format) => while_writing(|| {
            pompeiu::io::write_stream(path, |out| write_film(out, format, INTERVAL, pictures, next))
        })
        .with_context(|| path.display().to_string())?,
        Kind::Film => encode(path, pictures, &mut next)?,
    }
    printer.note(format_args!("{}: {}", path.display(), counted(pictures as usize, "picture")));
    Ok(())
}

/// Gives the pictures to the encoder, whose file takes the place of one that existed before once it is whole.
fn encode(path: &Path, pictures: u32, next: &mut impl FnMut(u32) -> io::Result<Image>) -> anyhow::Result<()> {
    let partial = partial(path);
    let made = encode_to(&partial, pictures, next).with_context(|| path.display().to_string());
    let placed = made.and_then(|()| Ok(std::fs::rename(&partial, path)?));
    if placed.is_err() {
        // It may not have been begun.
        let _ = std::fs::remove_file(&partial);
    }
    placed
}

/// A name beside a file, with its suffix, by which the encoder knows the format.
fn partial(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{}.{name}", std::process::id()))
}

fn encode_to(
    path: &Path,
    pictures: u32,
    next: &mut impl FnMut(u32) -> io::Result<Image>,
) -> anyhow::Result<()> {
    let first = next(0)?;
    let mut encoder = start(path, &first)?;
    let mut input = encoder.stdin.take().context("the encoder takes no pictures")?;
    let mut given = || -> io::Result<()> {
        input.write_all(first.pixels().as_flattened())?;
        for i in 1..pictures {
            input.write_all(next(i)?.pixels().as_flattened())?;
        }
        Ok(())
    };
    let given = given();
    drop(input);
    let output = encoder.wait_with_output()?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        let last = said.trim().lines().last().unwrap_or("no reason is given").to_owned();
        bail!("{ENCODER} failed ({}): {last}; write .apng or .gif instead", output.status);
    }
    Ok(given?)
}

fn start(path: &Path, first: &Image) -> anyhow::Result<Child> {
    let size = format!("{}x{}", first.width(), first.height());
    let rate = (1.0 / INTERVAL.as_secs_f64()).to_string();
    Command::new(ENCODER)
        .args(["-loglevel", "error", "-y", "-f", "rawvideo", "-pixel_format", "rgb24"])
        .args(["-video_size", &size, "-framerate", &rate, "-i", "pipe:0"])
        // Most players need halved colours, and these an even number of pixels on each side.
        .args(["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"])
        .arg(std::path::absolute(path)?)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .with_context(|| format!("{ENCODER} does not start"))
}
