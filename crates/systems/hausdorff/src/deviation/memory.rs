//! How much memory is left for entries.

use super::bounds::FaceBounds;
use super::report::FaceDeviation;
use crate::target::Target;
use pompeiu_core::TriMesh;

/// Bytes of a process that has read two files and done nothing yet, and what each thread remembers of faces of B.
const PROCESS: usize = 20 << 20;
const PER_THREAD: usize = 4 << 20;
/// Bytes for each face and each vertex of A: what is known about it, and its place in orders and sets while regions are told apart.
const PER_FACE: usize = size_of::<FaceBounds>() + size_of::<FaceDeviation>() + 48;
const PER_VERTEX: usize = 48;

/// Bytes that a direction takes beside its entries.
fn beside_entries(from: &TriMesh, to: &TriMesh) -> usize {
    let of_mesh = |mesh: &TriMesh| size_of_val(mesh.positions()) + size_of_val(mesh.faces());
    PROCESS
        + PER_THREAD * rayon::current_num_threads()
        + of_mesh(from)
        + of_mesh(to)
        + Target::bytes_to_prepare(to.faces().len())
        + PER_FACE * from.faces().len()
        + PER_VERTEX * from.positions().len()
}

/// Bytes that a memory limit leaves for the entries of a direction.
pub(super) fn room(limit: usize, from: &TriMesh, to: &TriMesh, held: usize) -> usize {
    limit.saturating_sub(beside_entries(from, to) + held)
}

/// Bytes that the report of a direction takes.
pub(super) fn of_report(from: &TriMesh) -> usize {
    size_of::<FaceDeviation>() * from.faces().len() + size_of::<f64>() * from.positions().len()
}
