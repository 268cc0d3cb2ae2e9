//! Cells and faces in parts for parallel threads: a partition with few faces between parts.

use pompeiu_volume::{Faces, partition};
use rayon::prelude::*;

/// Approximate number of cells of a part.
const CELLS: usize = 512;

/// Largest number of parts.
const MOST_PARTS: usize = 8;

/// The part of each cell, if each cell is to be subdivided into `cut`. The number of parts depends on these numbers alone.
pub(super) fn deal(cells: usize, cut: usize, faces: &Faces) -> Vec<u32> {
    partition(cells, faces, (cells * cut / CELLS).clamp(1, MOST_PARTS))
}

/// The items of each part, each list in order.
pub(super) fn lists(of: impl Iterator<Item = u32>) -> Vec<Vec<u32>> {
    let mut lists = Vec::new();
    for (k, part) in of.enumerate() {
        if lists.len() <= part as usize {
            lists.resize(part as usize + 1, Vec::new());
        }
        lists[part as usize].push(k as u32);
    }
    lists
}

/// A value for each item: parts are processed in parallel, with the same bits as sequentially.
pub(super) fn by_parts<T: Send>(of: impl Iterator<Item = u32>, value: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let lists = lists(of);
    let found: Vec<Vec<(u32, T)>> =
        lists.par_iter().map(|list| list.iter().map(|&k| (k, value(k as usize))).collect()).collect();
    let mut all: Vec<(u32, T)> = found.into_iter().flatten().collect();
    all.sort_unstable_by_key(|(k, _)| *k);
    all.into_iter().map(|(_, value)| value).collect()
}

/// The labels of boundary faces of subdivided cells, from those of the cells.
pub(crate) fn labels_of_parts(faces: &Faces, labels: &[u32], fine: &Faces, parts: usize) -> Vec<u32> {
    let of: std::collections::HashMap<(u32, u8), u32> =
        faces.boundary().iter().zip(labels).map(|(face, &label)| ((face.cell, face.place), label)).collect();
    let per_cell = parts.pow(3) as u32;
    let label = |cell: u32, place: u8| of.get(&(cell / per_cell, place)).copied().unwrap_or(0);
    fine.boundary().iter().map(|face| label(face.cell, face.place)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::flow::potential_flow;
    use super::super::system::System;
    use crate::{Discretisation, Parameters};
    use pompeiu_core::run::{Control, on_threads};
    use pompeiu_volume::{Faces, HexMesh, partition};
    use std::num::NonZeroUsize;

    #[test]
    fn any_parts_and_threads_give_the_same_bits() {
        let mesh = HexMesh::grid([20, 3, 4], [7.0, 1.0, 0.9]);
        let faces = Faces::new(&mesh).unwrap();
        let label = |vertices: [u32; 4]| match vertices.map(|v| mesh.positions()[v as usize].x) {
            x if x.iter().all(|x| *x < 0.01) => 1,
            x if x.iter().all(|x| *x > 6.99) => 2,
            _ => 0,
        };
        let labels: Vec<u32> = faces.boundary().iter().map(|face| label(face.vertices)).collect();
        let parameters = Parameters { speed_minus: 0.3, attach_minus: 0.2, ..Parameters::default() };
        let of = |parts: usize, threads: usize| {
            on_threads(NonZeroUsize::new(threads), || {
                let dealt = partition(mesh.cells().len(), &faces, parts);
                let volumes = Discretisation::dealt(&mesh, &faces, &labels, dealt);
                let flow = potential_flow(&volumes, 0, &Control::default()).unwrap();
                let system = System { mesh: &volumes, flow: &flow, parameters: &parameters, inlet: 0 };
                let entries: Vec<(usize, usize, u64)> =
                    system.matrix(3.0).unwrap().iter().map(|(i, j, x)| (i, j, x.to_bits())).collect();
                let numbers: Vec<u64> = volumes
                    .volumes
                    .iter()
                    .chain(volumes.links.iter().map(|(_, conductance)| conductance))
                    .map(|x| x.to_bits())
                    .collect();
                (entries, numbers)
            })
        };
        let one = of(1, 1);
        for (parts, threads) in [(1, 4), (2, 2), (7, 1), (7, 3), (32, 4)] {
            assert!(of(parts, threads) == one, "{parts} parts on {threads} threads");
        }
    }
}
