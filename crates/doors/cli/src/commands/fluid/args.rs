//! Files of the fluid command.

use crate::args::{Picture, suffix};
use clap::Args;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

#[derive(Args)]
#[command(after_help = include_str!("help.txt"))]
pub(crate) struct Files {
    /// The mesh file; none with --square
    #[arg(value_name = "MESH")]
    pub(super) mesh: Option<PathBuf>,
    /// A scene
    #[arg(value_name = "SCENE.toml")]
    pub(super) scene: Option<PathBuf>,
    /// Write every step as VTP, with a list of them for ParaView
    #[arg(long, short, value_name = "OUT.pvd")]
    pub(super) output: Option<PathBuf>,
    /// Write only every so many steps
    #[arg(long, default_value = "1", value_name = "N", requires = "output")]
    pub(super) every: NonZeroUsize,
    /// Write the state there at the end, when interrupted, and every minute
    #[arg(long, value_name = "FILE")]
    pub(super) checkpoint: Option<PathBuf>,
    /// Go on from a state that --checkpoint wrote, of the same mesh and scene; --steps counts from the beginning
    #[arg(long, value_name = "FILE")]
    pub(super) resume: Option<PathBuf>,
    /// Write moving pictures: a page that plays the flow (.html), .apng or .gif, or .mp4 or .webm where ffmpeg is installed
    #[arg(long, value_parser = suffix::film, value_name = "RUN.html")]
    pub(super) video: Option<PathBuf>,
    /// Write the frames of the page as pictures into a new folder
    #[arg(long, value_name = "FOLDER")]
    pub(super) frames: Option<PathBuf>,
    #[command(flatten)]
    pub(super) picture: Box<Picture>,
}

impl Files {
    pub(super) fn outputs(&self) -> impl Iterator<Item = &Path> {
        let files = self.output.iter().chain(&self.checkpoint).chain(&self.video);
        files.map(PathBuf::as_path).chain(self.picture.outputs())
    }

    /// Whether frames are shown.
    pub(super) fn shows(&self) -> bool {
        self.frames.is_some() || self.video.is_some() || self.picture.outputs().next().is_some()
    }
}
