//! Files of the contact command.

use crate::args::suffix;
use clap::Args;
use std::num::NonZeroUsize;
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = include_str!("help.txt"))]
pub(crate) struct Files {
    /// The scene: a file, or the name of an example
    #[arg(value_name = "SCENE.toml")]
    pub(super) scene: PathBuf,
    /// Meshes of bodies that name none in the scene
    #[arg(value_name = "MESH")]
    pub(super) meshes: Vec<PathBuf>,
    /// Write the surfaces after every step as VTP, with a list of them for ParaView
    #[arg(long, short, value_name = "OUT.pvd")]
    pub(super) output: Option<PathBuf>,
    /// Write only every so many steps
    #[arg(long, default_value = "1", value_name = "N", requires = "output")]
    pub(super) every: NonZeroUsize,
    /// Write the state there at the end, when interrupted, and every minute
    #[arg(long, value_name = "FILE")]
    pub(super) checkpoint: Option<PathBuf>,
    /// Go on from a state that --checkpoint wrote, of the same scene and meshes; --steps counts from the beginning
    #[arg(long, value_name = "FILE")]
    pub(super) resume: Option<PathBuf>,
    /// Write moving pictures: a page that plays the run (.html), .apng or .gif, or .mp4 or .webm where ffmpeg is installed
    #[arg(long, value_parser = suffix::film, value_name = "RUN.html")]
    pub(super) video: Option<PathBuf>,
    /// Write a page to explore in a browser, one file that needs no network
    #[arg(long, value_parser = suffix::page, value_name = "FILE.html")]
    pub(super) report: Option<PathBuf>,
}
