//! Why a scene cannot be simulated as asked.

use super::CheckpointError;
use crate::ContactError;
use pompeiu_core::MeshError;
use std::path::PathBuf;

/// Why a scene cannot be simulated as asked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ContactRequestError {
    /// The file of the scene cannot be read.
    #[error("{}: {error}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: std::io::Error,
    },
    /// The file of the scene is too large.
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
    #[error("{place}: {message}")]
    Syntax {
        /// The file, or what was given instead.
        place: String,
        /// What is wrong, with the place.
        message: String,
    },
    /// There is neither a file nor an example of this name.
    #[error("there is no scene `{name}`: expected a file or one of {}", super::Example::names())]
    NoScene {
        /// What was given.
        name: String,
    },
    /// A key that does not belong to the scene.
    #[error("`{key}` is not for {scene}; leave it out")]
    Key {
        /// The key.
        key: &'static str,
        /// The scene.
        scene: String,
    },
    /// A key whose number makes no sense.
    #[error("`{key}` is {value}; expected {expected}")]
    Value {
        /// The key.
        key: &'static str,
        /// Its value.
        value: f64,
        /// What it should be.
        expected: &'static str,
    },
    /// A scene of examples takes no meshes.
    #[error("the scene {scene} has bodies of its own; leave the meshes out, or write a scene with [[body]]")]
    TakesNoMesh {
        /// The scene.
        scene: &'static str,
    },
    /// A scene without bodies.
    #[error(
        "the scene has no bodies; add [[body]] with a mesh, name meshes, or choose kind = one of {}",
        super::Example::names()
    )]
    NoBodies,
    /// A body without a mesh.
    #[error("body {body} has no mesh; give its key `mesh`, or name another mesh")]
    NoMesh {
        /// Number of the body, from 1.
        body: usize,
    },
    /// A surface cannot be a solid.
    #[error(
        "body {body} is a solid, and its mesh is a surface: fill it with tetrahedra first, for example with fTetWild or Gmsh, \
         and name the file of tetrahedra (.vtk or .vtu)"
    )]
    NotFilled {
        /// Number of the body, from 1.
        body: usize,
    },
    /// Tetrahedra cannot be a shell.
    #[error(
        "body {body} is a shell, and its mesh has tetrahedra; name the mesh of its surface, or make it a solid"
    )]
    NotThin {
        /// Number of the body, from 1.
        body: usize,
    },
    /// A body is in error.
    #[error("body {body}: {error}")]
    Body {
        /// Number of the body, from 1.
        body: usize,
        /// What is wrong.
        error: ContactError,
    },
    /// An obstacle cannot be used.
    #[error("obstacle {obstacle}: {error}")]
    InObstacle {
        /// Number of the obstacle, from 1.
        obstacle: usize,
        /// What is wrong.
        error: ContactError,
    },
    /// An obstacle is none of a mesh, a half-space and a ball.
    #[error(
        "obstacle {obstacle} needs either `mesh`, or `normal` and `through`, or `centre` and `radius`; `scale`, `move`, `velocity`, `about` and \
         `turns` are for a mesh"
    )]
    Obstacle {
        /// Number of the obstacle, from 1.
        obstacle: usize,
    },
    /// A handle holds nothing.
    #[error("handle {handle}: body {body} has no vertex in its box; move the box")]
    NothingHeld {
        /// Number of the handle, from 1.
        handle: usize,
        /// Number of the body, from 1.
        body: usize,
    },
    /// A handle of no body.
    #[error("handle {handle} is of body {body}, but there are {count}")]
    HandleOf {
        /// Number of the handle, from 1.
        handle: usize,
        /// Number of the body, from 1.
        body: usize,
        /// How many bodies there are.
        count: usize,
    },
    /// Bodies intersect at the start.
    #[error("the start intersects: {pairs}; move the bodies apart")]
    StartIntersects {
        /// The pairs, in words.
        pairs: String,
    },
    /// The simulation refuses its bodies or options.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The surfaces make no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The state cannot be resumed.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// More steps are done than were asked for.
    #[error("{done} steps are done already and --steps is {asked}; it counts from the beginning")]
    TooFewSteps {
        /// Steps that are done.
        done: usize,
        /// Steps that were asked for.
        asked: usize,
    },
}
