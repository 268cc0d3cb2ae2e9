//! The coordinates of a file that is written.

use crate::numbers::{few, point};
use crate::printer::Printer;
use clap::Args;
use pompeiu::core::mesh::{Coordinates, Precision, Rounding};
use pompeiu::io::OutputFormat;
use std::path::Path;

#[derive(Args)]
pub(crate) struct Centered {
    /// Count the coordinates of the output from a point near the centre of the mesh, which is said: far from zero this keeps digits that
    /// STL and GLB have no room for
    #[arg(long)]
    pub(crate) center: bool,
}

impl Centered {
    /// What the file can hold.
    pub(crate) fn coordinates(&self, output: &Path) -> Coordinates {
        let precision = OutputFormat::from_path(output).map_or(Precision::Double, OutputFormat::precision);
        Coordinates { precision, centered: self.center }
    }
}

/// Says what rounding and shifting did.
pub(crate) fn tell(output: &Path, rounding: &Rounding, printer: &Printer) {
    let shown = output.display();
    if rounding.shift != [0.0; 3] {
        printer.note(format_args!("{shown}: {} was taken from all coordinates", point(rounding.shift)));
    }
    if rounding.precision == Precision::Single && rounding.moved > 0.0 {
        printer.warning(format_args!(
            "{shown}: single precision moved vertices by up to {}, before anything was measured; PLY and OBJ keep every bit",
            few(rounding.moved)
        ));
    }
}
