//! The files of splines for other solvers, written cell by cell.

use crate::text_rows::TextRows;
use crate::unstructured::Around;
use crate::{CellSplines, Faces, HexMesh, HierarchicalSplines};
use glam::DVec3;
use rayon::prelude::*;
use std::io::{self, Write};

/// Where the files of `NeuronTransportIGA` about splines go. The coefficients take hundreds of bytes for each function of each cell, so that
/// they are computed and written for some cells at a time.
pub struct ExtractionFiles<W> {
    /// The functions of each cell, numbered from 1: `bzmeshinfo.txt`.
    pub bzmeshinfo: W,
    /// The Bézier points of each cell: `bzpt.txt`.
    pub bzpt: W,
    /// The functions of each cell and their coefficients: `cmat.txt`.
    pub cmat: W,
}

/// Cells whose text is made by one thread, and how many such blocks are made before they are written.
const CELLS: usize = 8;
const BLOCKS: usize = 8;

/// Text of some cells for each of the files.
#[derive(Default)]
struct Block {
    bzmeshinfo: TextRows,
    bzpt: TextRows,
    cmat: TextRows,
}

impl Block {
    fn clear(&mut self) {
        self.bzmeshinfo.clear();
        self.bzpt.clear();
        self.cmat.clear();
    }

    fn push(&mut self, index: usize, cell: &CellSplines, places: &[DVec3]) {
        self.bzmeshinfo.functions(cell);
        self.bzpt.points(&cell.bezier_points(places));
        self.cmat.coefficients(index, cell);
    }
}

impl<W: Write> ExtractionFiles<W> {
    /// Writes [`UnstructuredSplines`](crate::UnstructuredSplines) over a conforming mesh, whose vertices have these positions.
    ///
    /// # Errors
    /// Those of the files.
    /// # Panics
    /// If a vertex has no position.
    pub fn write_unstructured(&mut self, mesh: &HexMesh, faces: &Faces, places: &[DVec3]) -> io::Result<()> {
        let around = Around::new(mesh, faces);
        let of = |numbers: &mut _, cell| around.splines_of(cell, numbers);
        self.write(mesh.cells().len(), places, || around.numbers(), of)
    }

    /// Writes hierarchical splines, whose functions have these positions.
    ///
    /// # Errors
    /// Those of the files.
    /// # Panics
    /// If a function has no position.
    pub fn write_hierarchical(&mut self, splines: &HierarchicalSplines, places: &[DVec3]) -> io::Result<()> {
        self.write(splines.elements().len(), places, || (), |(), element| splines.splines_of(element))
    }

    /// Writes the splines of so many cells. `of` may change what `with` makes for each thread.
    fn write<S: Send>(
        &mut self,
        cells: usize,
        places: &[DVec3],
        with: impl Fn() -> S,
        of: impl Fn(&mut S, usize) -> CellSplines + Sync,
    ) -> io::Result<()> {
        writeln!(self.bzmeshinfo, "{cells}")?;
        writeln!(self.bzpt, "{}", 64 * cells)?;
        writeln!(self.cmat, "{cells}")?;
        let mut blocks: Vec<(Block, S)> = (0..BLOCKS).map(|_| (Block::default(), with())).collect();
        for first in (0..cells).step_by(BLOCKS * CELLS) {
            blocks.par_iter_mut().enumerate().for_each(|(k, (block, with))| {
                block.clear();
                let [from, to] = [k, k + 1].map(|k| (first + k * CELLS).min(cells));
                (from..to).for_each(|cell| block.push(cell, &of(with, cell), places));
            });
            for (block, _) in &blocks {
                self.bzmeshinfo.write_all(block.bzmeshinfo.bytes())?;
                self.bzpt.write_all(block.bzpt.bytes())?;
                self.cmat.write_all(block.cmat.bytes())?;
            }
        }
        Ok(())
    }
}
