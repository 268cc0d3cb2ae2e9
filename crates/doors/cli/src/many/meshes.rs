//! Meshes by their places, read when they are wanted and kept as long as there is room.

use crate::files;
use pompeiu::core::TriMesh;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Files that are read as meshes, once or again and again.
///
/// What was read stays in memory up to a limit, first come, first kept; the others are read again each time. The meshes
/// that threads are at work on come on top. A file that cannot be read is not tried again.
pub(crate) struct MeshFiles {
    paths: Vec<PathBuf>,
    limit: usize,
    kept: Mutex<Kept>,
}

struct Kept {
    bytes: usize,
    meshes: Vec<Option<Result<Arc<TriMesh>, String>>>,
    /// Vertices and faces of what was read.
    counts: Vec<Option<[usize; 2]>>,
}

impl MeshFiles {
    pub(crate) fn new(paths: Vec<PathBuf>, limit: usize) -> Self {
        let meshes = vec![None; paths.len()];
        Self { paths, limit, kept: Mutex::new(Kept { bytes: 0, counts: vec![None; meshes.len()], meshes }) }
    }

    pub(crate) fn paths(&self) -> &[PathBuf] {
        &self.paths
    }

    /// The mesh at a place.
    pub(crate) fn mesh(&self, index: usize) -> Result<Arc<TriMesh>, String> {
        if let Some(kept) = &self.kept().meshes[index] {
            return kept.clone();
        }
        let read = read(&self.paths[index]);
        let bytes = read.as_ref().map_or(0, |mesh| size_of_val(mesh.positions()) + size_of_val(mesh.faces()));
        let mut kept = self.kept();
        kept.counts[index] = read.as_ref().ok().map(|mesh| [mesh.positions().len(), mesh.faces().len()]);
        if kept.meshes[index].is_none() && bytes <= self.limit.saturating_sub(kept.bytes) {
            kept.bytes += bytes;
            kept.meshes[index] = Some(read.clone());
        }
        read
    }

    /// The files that were read, with their numbers of vertices and faces.
    pub(crate) fn into_read(self) -> impl Iterator<Item = (PathBuf, [usize; 2])> {
        let counts = self.kept().counts.clone();
        self.paths.into_iter().zip(counts).filter_map(|(path, counts)| Some((path, counts?)))
    }

    /// Bytes of the meshes that are kept.
    pub(crate) fn bytes(&self) -> usize {
        self.kept().bytes
    }

    /// Why a file could not be read, if that was tried.
    pub(crate) fn failure(&self, index: usize) -> Option<String> {
        self.kept().meshes[index].as_ref().and_then(|kept| kept.as_ref().err().cloned())
    }

    /// Makes room: keeps those that may still be wanted.
    pub(crate) fn keep_only(&self, wanted: impl Fn(usize) -> bool) {
        let mut kept = self.kept();
        let mut bytes = 0;
        for (index, mesh) in kept.meshes.iter_mut().enumerate() {
            match mesh {
                Some(Ok(_)) if !wanted(index) => *mesh = None,
                Some(Ok(mesh)) => bytes += size_of_val(mesh.positions()) + size_of_val(mesh.faces()),
                _ => (),
            }
        }
        kept.bytes = bytes;
    }

    fn kept(&self) -> MutexGuard<'_, Kept> {
        // No thread leaves it half changed.
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn read(path: &Path) -> Result<Arc<TriMesh>, String> {
    if path.exists() && !path.is_file() && !path.is_dir() {
        return Err(format!(
            "{}: may be read more than once, which a pipe cannot; save it to a file",
            path.display()
        ));
    }
    files::read(path).map(|read| Arc::new(read.mesh)).map_err(|error| format!("{error:#}"))
}
