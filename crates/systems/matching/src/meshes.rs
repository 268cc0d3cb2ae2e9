//! Where the meshes of a ranking or a matrix come from: memory, files, or elsewhere.

use crate::tasks::bytes_of;
use pompeiu_core::TriMesh;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::borrow::Borrow;

/// Provides the meshes of a ranking or a matrix, and may remember results.
pub trait Meshes: Sync {
    /// A mesh while it is in use.
    type Mesh: Borrow<TriMesh> + Sync;

    /// The number of meshes.
    fn count(&self) -> usize;

    /// The name of a mesh; its index, with as many digits as the count has, unless there is a better one.
    fn name(&self, index: usize) -> String {
        let digits = self.count().to_string().len();
        format!("{index:0digits$}")
    }

    /// The mesh with an index.
    ///
    /// # Errors
    /// A sentence that says why it cannot be used.
    fn mesh(&self, index: usize) -> Result<Self::Mesh, String>;

    /// Why a mesh cannot be used, if that is known; the mesh is not read for this.
    fn failure(&self, index: usize) -> Option<String> {
        let _ = index;
        None
    }

    /// Bytes of memory that the meshes take when none is in use.
    fn bytes(&self) -> usize;

    /// The same without the mesh with an index.
    fn bytes_beside(&self, index: usize) -> usize {
        let _ = index;
        self.bytes()
    }

    /// Called when only these may be asked for again.
    fn keep_only(&self, wanted: &dyn Fn(usize) -> bool) {
        let _ = wanted;
    }

    /// The answer to a question about some of the meshes, if it is known.
    fn known<R: DeserializeOwned>(&self, question: &impl Serialize, meshes: &[usize]) -> Option<R> {
        let _ = (question, meshes);
        None
    }

    /// Called with each complete answer to such a question, by any thread.
    fn found<R: Serialize>(&self, question: &impl Serialize, meshes: &[usize], result: &R) {
        let _ = (question, meshes, result);
    }
}

/// Meshes in memory.
impl<'m> Meshes for &[&'m TriMesh] {
    type Mesh = &'m TriMesh;

    fn count(&self) -> usize {
        self.len()
    }

    fn mesh(&self, index: usize) -> Result<&'m TriMesh, String> {
        self.get(index).copied().ok_or_else(|| format!("there is no mesh {index} among {}", self.len()))
    }

    fn bytes(&self) -> usize {
        self.iter().map(|mesh| bytes_of(mesh)).sum()
    }

    fn bytes_beside(&self, index: usize) -> usize {
        self.bytes() - self.get(index).map_or(0, |mesh| bytes_of(mesh))
    }
}

/// A mesh that cannot be used, and why.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Unusable {
    /// Its name: the path if it is a file, or the argument as given.
    pub path: String,
    /// One sentence.
    pub message: String,
}
