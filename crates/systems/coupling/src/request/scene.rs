//! The scene: what is coupled, and how, in TOML.

use crate::channel::{ChannelOptions, Drive};
use crate::piston::{PistonOptions, TimeRule};
use crate::scenario::Scenario;
use crate::tube::{Inlet, TubeOptions};
use crate::wall::{Ends, WallOptions};
use crate::{Closed, CouplingError, CouplingOptions, Scheme};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// What is coupled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A column of fluid and a piston on a spring.
    Piston,
    /// An elastic tube.
    Tube,
    /// A channel below an elastic wall.
    Channel,
    /// A box below an elastic wall, with an enclosed fluid.
    Box,
}

impl Kind {
    /// Its name in scenes.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Piston => "piston",
            Self::Tube => "tube",
            Self::Channel => "channel",
            Self::Box => "box",
        }
    }
}

/// A scene: the keys of its file.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Scene {
    kind: Option<Kind>,
    /// Number of windows.
    pub(super) windows: Option<usize>,
    time_step: Option<f64>,
    piston: Option<PistonTable>,
    tube: Option<TubeTable>,
    channel: Option<ChannelTable>,
    r#box: Option<ChannelTable>,
    wall: Option<WallTable>,
    coupling: Option<CouplingTable>,
}

#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
struct PistonTable {
    mass: Option<f64>,
    stiffness: Option<f64>,
    fluid_mass: Option<f64>,
    start: Option<f64>,
    rule: Option<TimeRule>,
}

#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
struct TubeTable {
    length: Option<f64>,
    segments: Option<usize>,
    modulus: Option<f64>,
    mean: Option<f64>,
    amplitude: Option<f64>,
    frequency: Option<f64>,
}

#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
struct ChannelTable {
    height: Option<f64>,
    cells: Option<[usize; 2]>,
    density: Option<f64>,
    rule: Option<TimeRule>,
    advect: Option<YesNo>,
    pressure: Option<f64>,
    volume: Option<f64>,
    duration: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum YesNo {
    Yes,
    No,
}

#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
struct WallTable {
    mass: Option<f64>,
    stiffness: Option<f64>,
    tension: Option<f64>,
    damping: Option<f64>,
    ends: Option<Ends>,
}

#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
struct CouplingTable {
    scheme: Option<Scheme>,
    tolerance: Option<f64>,
    most_solves: Option<usize>,
    reuse: Option<usize>,
    filter: Option<f64>,
    extrapolate: Option<usize>,
    closed: Option<Closed>,
}

/// Why a scene or a pair of solvers cannot be run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file cannot be read.
    #[error("{}: {error}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: std::io::Error,
    },
    /// It is too large.
    #[error("{}: {found} bytes are too many for a scene, expected at most {most}", path.display())]
    Large {
        /// The file.
        path: PathBuf,
        /// Its bytes.
        found: u64,
        /// Most bytes.
        most: u64,
    },
    /// It is no scene.
    #[error("{}: {message}", path.display())]
    Syntax {
        /// The file.
        path: PathBuf,
        /// What is wrong, with the place.
        message: String,
    },
    /// It does not say what is coupled.
    #[error(
        "the scene does not say what is coupled; give kind = \"piston\", \"tube\", \"channel\" or \"box\""
    )]
    NoKind,
    /// A table of another kind.
    #[error("[{table}] is not for a scene of the kind {kind}; leave it out")]
    Table {
        /// The table.
        table: &'static str,
        /// The kind.
        kind: &'static str,
    },
    /// A key of a channel in a box, or the other way round.
    #[error("`{key}` is not for a scene of the kind {kind}; leave it out")]
    Key {
        /// The key.
        key: &'static str,
        /// The kind.
        kind: &'static str,
    },
    /// Given solvers cannot be started again.
    #[error("compare runs a scene once with each scheme; solvers that are given can run once only")]
    Compare,
    /// Numbers make no sense.
    #[error(transparent)]
    Coupling(#[from] CouplingError),
}

/// Largest size of a scene, in bytes.
const MOST_BYTES: u64 = 1 << 20;

/// Replaces a number where the scene has one.
macro_rules! set {
    ($options:ident, $table:ident: $($key:ident),*) => {
        $($options.$key = $table.$key.unwrap_or($options.$key);)*
    };
}

impl Scene {
    /// Reads the file of a scene.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        let unusable = |error| SceneError::File { path: path.to_owned(), error };
        let found = std::fs::metadata(path).map_err(unusable)?.len();
        if found > MOST_BYTES {
            return Err(SceneError::Large { path: path.to_owned(), found, most: MOST_BYTES });
        }
        let text = std::fs::read_to_string(path).map_err(unusable)?;
        let scene: Self = toml::from_str(&text).map_err(|error| {
            let message = error.to_string().trim_end().to_owned() + &hint(error.message());
            SceneError::Syntax { path: path.to_owned(), message }
        })?;
        scene.check()?;
        Ok(scene)
    }

    /// What is coupled.
    ///
    /// # Errors
    /// [`SceneError::NoKind`].
    pub fn kind(&self) -> Result<Kind, SceneError> {
        self.kind.ok_or(SceneError::NoKind)
    }

    fn check(&self) -> Result<(), SceneError> {
        let kind = self.kind()?;
        let has_wall = matches!(kind, Kind::Channel | Kind::Box);
        for (table, is_given, is_used) in [
            ("piston", self.piston.is_some(), kind == Kind::Piston),
            ("tube", self.tube.is_some(), kind == Kind::Tube),
            ("channel", self.channel.is_some(), kind == Kind::Channel),
            ("box", self.r#box.is_some(), kind == Kind::Box),
            ("wall", self.wall.is_some(), has_wall),
        ] {
            if is_given && !is_used {
                return Err(SceneError::Table { table, kind: kind.name() });
            }
        }
        let key = |key| Err(SceneError::Key { key, kind: kind.name() });
        match (&self.channel, &self.r#box) {
            (Some(table), _) if table.volume.is_some() => key("volume"),
            (_, Some(table)) if table.pressure.is_some() => key("pressure"),
            _ => Ok(()),
        }
    }

    /// The problem with its numbers, which are checked when it runs.
    ///
    /// # Errors
    /// [`SceneError::NoKind`].
    pub fn scenario(&self) -> Result<Scenario, SceneError> {
        Ok(match self.kind()? {
            Kind::Piston => Scenario::Piston(self.piston()),
            Kind::Tube => Scenario::Tube(self.tube()),
            kind => Scenario::Channel(self.channel(kind == Kind::Box)),
        })
    }

    fn piston(&self) -> PistonOptions {
        let mut options = PistonOptions::default();
        options.time_step = self.time_step.unwrap_or(options.time_step);
        if let Some(table) = &self.piston {
            set!(options, table: mass, stiffness, fluid_mass, start, rule);
        }
        options
    }

    fn tube(&self) -> TubeOptions {
        let mut options = TubeOptions::default();
        options.time_step = self.time_step.unwrap_or(options.time_step);
        let Some(table) = &self.tube else { return options };
        set!(options, table: length, segments, modulus);
        options.inlet = Inlet::Periodic {
            mean: table.mean.unwrap_or(10.0),
            amplitude: table.amplitude.unwrap_or(3.0),
            frequency: table.frequency.unwrap_or(10.0),
        };
        options
    }

    fn channel(&self, is_box: bool) -> ChannelOptions {
        let mut options = ChannelOptions::default();
        if is_box {
            options.cells = [32, 32];
            options.wall =
                WallOptions { mass: 0.5, stiffness: 20.0, tension: 1.0, damping: 4.0, ends: Ends::Free };
        }
        options.time_step = self.time_step.unwrap_or(options.time_step);
        let table = if is_box { &self.r#box } else { &self.channel };
        let table = table.clone().unwrap_or_default();
        set!(options, table: height, cells, density, rule);
        options.advect = table.advect.map_or(options.advect, |advect| advect == YesNo::Yes);
        options.drive = if is_box {
            Drive::Injection { volume: table.volume.unwrap_or(0.04), duration: table.duration.unwrap_or(0.5) }
        } else {
            Drive::Pulse { pressure: table.pressure.unwrap_or(1.0), duration: table.duration.unwrap_or(0.4) }
        };
        if let Some(table) = &self.wall {
            let wall = &mut options.wall;
            set!(wall, table: mass, stiffness, tension, damping, ends);
        }
        options
    }

    pub(super) fn options(&self) -> CouplingOptions {
        let mut options = CouplingOptions::default();
        if let Some(table) = &self.coupling {
            set!(options, table: scheme, tolerance, most_solves, reuse, filter, closed);
            options.extrapolation = table.extrapolate.unwrap_or(options.extrapolation);
        }
        options
    }
}

/// The known key that is most like an unknown one.
fn hint(message: &str) -> String {
    let names: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    match names[..] {
        [unknown, ref known @ ..] if message.starts_with("unknown field") => {
            let likeness = |name: &&&str| strsim::normalized_damerau_levenshtein(unknown, name);
            let nearest = known.iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
            nearest.map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
        }
        _ => String::new(),
    }
}
