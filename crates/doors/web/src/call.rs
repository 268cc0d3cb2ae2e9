//! The calls that an engine answers, as they are in JSON.

use pompeiu::options::Options;
use serde::{Deserialize, Serialize};

/// A call. Bytes that belong to it stand beside it.
#[derive(Debug, Deserialize)]
#[serde(tag = "call", rename_all = "kebab-case", deny_unknown_fields)]
pub(crate) enum Call {
    /// Reads a mesh from the bytes of a file.
    Read {
        /// The name of the file.
        name: String,
    },
    /// Makes a mesh of positions (doubles) and faces (32-bit indices), both little endian.
    Mesh {
        /// What it is called.
        #[serde(default)]
        name: String,
    },
    /// Asks a system.
    Ask(Ask),
    /// A page to explore of what was found last: bytes of HTML.
    Page {
        /// The command that makes the page again, as it is shown in it.
        #[serde(default)]
        command_line: Option<String>,
    },
    /// A document for printing of the deviation that was found last: bytes of PDF.
    Document {
        /// The command that makes it again.
        #[serde(default)]
        command_line: Option<String>,
    },
    /// A mesh as the bytes of a file.
    Write {
        /// The mesh.
        mesh: u32,
        /// The suffix of the format.
        format: String,
    },
    /// The drawing of the map that was found last: bytes of SVG.
    Drawing,
    /// Positions and faces of a mesh, little endian.
    Arrays {
        /// The mesh.
        mesh: u32,
    },
    /// Forgets a mesh.
    Forget {
        /// The mesh.
        mesh: u32,
    },
    /// The commands that can be asked, with the defaults of their options.
    Commands,
}

/// A request of a system.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Ask {
    /// The name of the command.
    pub(crate) command: String,
    /// The meshes.
    pub(crate) meshes: Vec<u32>,
    /// The options; defaults for all others.
    #[serde(default)]
    pub(crate) options: Options,
    /// The options as the text of a `--config` file, before those of `options`.
    #[serde(default)]
    pub(crate) config: String,
    /// Seconds and bytes.
    #[serde(default)]
    pub(crate) limits: Limited,
}

/// Limits, as they are in JSON.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Limited {
    pub(crate) threads: Option<usize>,
    pub(crate) time_limit: Option<f64>,
    pub(crate) memory_limit: Option<usize>,
}

/// What an array of bytes beside a reply holds.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct ArrayOf {
    /// Its place among the arrays of the reply.
    pub(crate) index: usize,
    /// The type of its entries: `f64`, `u32` or `u8`.
    pub(crate) entries: &'static str,
    /// How many of them make a row.
    pub(crate) columns: usize,
}
