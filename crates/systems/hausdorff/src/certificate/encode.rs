//! The bytes of a block of cut trees.

use pompeiu_verify::kernel::{End, PLACES};

/// A block that is being written.
#[derive(Debug, Default)]
pub(super) struct Block {
    bytes: Vec<u8>,
    last: i64,
    /// Whole faces with the leaf of the one before them, whose number is not written yet.
    run: Option<u64>,
    pub(super) cells: u64,
}

impl Block {
    /// A face of A that is one cell.
    pub(super) fn whole(&mut self, face: u32) {
        self.cells += 1;
        if i64::from(face) == self.last {
            if let Some(run) = &mut self.run {
                *run += 1;
            } else {
                self.number(0);
                self.run = Some(0);
            }
        } else {
            self.end_run();
            let z = self.go_to(face);
            self.number(z << 2);
        }
    }

    /// A cell that is part of a face.
    pub(super) fn leaf(&mut self, face: u32) {
        self.cells += 1;
        let z = self.go_to(face);
        self.number(z << 2);
    }

    /// A cell that is left when the polygon is cut along some sides of a face.
    pub(super) fn carve(&mut self, face: u32, sides: u64) {
        self.end_run();
        self.cells += 1;
        let z = self.go_to(face);
        self.number((z << 3 | sides) << 2 | 2);
    }

    /// A cut of a polygon with `n` corners between two ends, that of the lesser side first, with so many bytes each.
    pub(super) fn chord(&mut self, n: usize, ends: [(End, u32); 2]) {
        self.end_run();
        let [(i, b), (j, c)] = ends;
        let sides = (i.side * n + j.side) as u64;
        self.number((sides << 6 | u64::from(b) << 3 | u64::from(c)) << 2 | 1);
        for (end, count) in ends {
            let value = (end.t * if count == 7 { PLACES } else { (1_u64 << (8 * count)) as f64 }) as u64;
            self.bytes.extend_from_slice(&value.to_be_bytes()[8 - count as usize..]);
        }
    }

    /// The bytes of the block, behind their number.
    pub(super) fn finish(mut self) -> (Vec<u8>, u64) {
        self.end_run();
        (self.bytes, self.cells)
    }

    pub(super) fn end_run(&mut self) {
        if let Some(run) = self.run.take() {
            self.number(run);
        }
    }

    fn go_to(&mut self, face: u32) -> u64 {
        let step = i64::from(face) - self.last;
        self.last = i64::from(face);
        (step << 1 ^ step >> 63).cast_unsigned()
    }

    fn number(&mut self, mut value: u64) {
        while value > 127 {
            self.bytes.push(value as u8 | 128);
            value >>= 7;
        }
        self.bytes.push(value as u8);
    }
}
