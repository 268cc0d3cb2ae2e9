//! The coordinates of a file that is written.

use crate::numbers::{few, point};
use crate::printer::Printer;
use pompeiu::core::mesh::{Coordinates, Precision, Rounding};
use pompeiu::io::OutputFormat;
use std::path::Path;

/// Lets a result have the coordinates that a file can hold.
pub(crate) fn hold_in(output: &Path, coordinates: &mut Coordinates) {
    if OutputFormat::from_path(output).is_some_and(|format| format.precision() == Precision::Single) {
        coordinates.precision = Precision::Single;
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
