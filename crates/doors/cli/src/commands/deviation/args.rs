//! Options of the deviation command.

use super::parts::Parts;
use crate::aligned::Before;
use crate::args::{Limits, Meshes, Picture};
use crate::lengths::{Band, Length, band, length};
use crate::numbers::{magnitude, share};
use clap::{ArgGroup, Args, ValueEnum};
use std::path::PathBuf;

/// Show how far two meshes deviate: where, on which side, over how much of the area
#[derive(Args)]
#[command(group(ArgGroup::new("tolerance").args(["threshold", "band"])))]
#[command(after_help = "\
With A as it should be and B as it is: what of A is far from B is missing in B (A to B), what of B is far from
A was invented by it (B to A). Percentiles, mean and root mean square weigh by area; every number is an interval
that is proven to hold the value for all points of all faces, not for samples of them.

Meshes written with -a and -b carry the distance of each vertex, and for each face what is proven of its largest
and its mean distance, where the format has a place for them: PLY, VTP and VTU. GLB, OBJ and OFF hold colours.

Exit codes:
  0  done; with --threshold or --band: proven to be within tolerance
  1  with --threshold or --band: proven to be out of tolerance
  2  a file or an argument cannot be used
  3  the time or memory limit ran out first, or the tolerance is undecided; what is printed holds, but is wider than asked

Examples:
  pompeiu deviation model.obj scan.ply
  pompeiu deviation --model part.stl --scan part.ply --align rigid --threshold 0.05 --report scan.html
  pompeiu deviation model.obj scan.ply --threshold 0.1mm --unit mm --allow 1%
  pompeiu deviation model.obj scan.ply --unit mm --band -0.05..0.1 --band -0.2..0.3
  pompeiu deviation model.obj partial-scan.ply --only-overlap --ignore-components 0.1% --threshold 0.05
  pompeiu deviation model.obj scan.ply --signed -a model.vtp -b scan.vtp
  pompeiu deviation model.obj scan.ply --json")]
pub(crate) struct Deviation {
    #[command(flatten)]
    pub(crate) meshes: Meshes,
    /// Move B onto A first, from any start; parts of either may have no counterpart
    #[arg(long, value_enum, value_name = "HOW")]
    pub(crate) align: Option<Before>,
    /// Say whether both are within this length of each other, such as 0.1 or, with --unit, 0.1mm; enclose the share of the
    /// area that is farther, and list the regions beyond it
    #[arg(long, value_parser = length, allow_negative_numbers = true, value_name = "LENGTH")]
    pub(crate) threshold: Option<Length>,
    /// Say whether B deviates from A by no less and no more than this, such as -0.05..0.1: negative where B lacks something,
    /// positive where it has more. Several bands make classes; what is in none is too low or too high
    #[arg(long, value_parser = band, allow_hyphen_values = true, value_name = "LOW..HIGH")]
    pub(crate) band: Vec<Band>,
    /// The share of each area that may be farther than the threshold, or outside of all bands, such as 0.01 or 1%
    #[arg(long, value_parser = share, requires = "tolerance", value_name = "SHARE")]
    pub(crate) allow: Option<f64>,
    /// Tell inside from outside, by generalised winding numbers: distances inside the other mesh are shown negative
    #[arg(long)]
    pub(crate) signed: bool,
    /// Largest width of the intervals of mean, root mean square and percentiles, relative to their values; widths below 1e-9 of
    /// the diagonal of both meshes always suffice
    #[arg(long, value_parser = magnitude, allow_negative_numbers = true, default_value = "0.01", value_name = "X")]
    pub(crate) accuracy: f64,
    /// Percentiles to enclose, in percent of the area
    #[arg(long, value_parser = percentiles, default_value = "50,90,95,99", value_name = "LIST")]
    pub(crate) percentiles: Percentiles,
    /// How many of the worst regions to list
    #[arg(long, default_value_t = 5, value_name = "K")]
    pub(crate) regions: usize,
    /// The unit of the coordinates, such as mm; files have none. Shown with numbers in verdicts, reports and pictures
    #[arg(long, default_value = "", value_name = "NAME")]
    pub(crate) unit: String,
    #[command(flatten)]
    pub(crate) parts: Parts,
    #[command(flatten)]
    pub(crate) picture: Picture,
    /// Write the verdict, the picture, the numbers and what was measured for printing
    #[arg(long, value_name = "FILE.pdf")]
    pub(crate) pdf: Option<PathBuf>,
    /// The size of the paper
    #[arg(long, value_enum, default_value_t, requires = "pdf")]
    pub(crate) paper: Paper,
    /// Write A, coloured by its distance from B
    #[arg(long, short = 'a', value_name = "FILE")]
    pub(crate) output_a: Option<PathBuf>,
    /// Write B, coloured by its distance from A
    #[arg(long, short = 'b', value_name = "FILE")]
    pub(crate) output_b: Option<PathBuf>,
    /// Write the statistics as comma-separated values
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) limits: Limits,
    /// Print everything: all percentiles of both directions taken together, all regions, all digits that are certain
    #[arg(long)]
    pub(crate) full: bool,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Paper {
    #[default]
    A4,
    Letter,
}

/// Shares of the area, between 0 and 1.
#[derive(Clone)]
pub(crate) struct Percentiles(pub(crate) Vec<f64>);

/// Parses percentages, separated by commas.
fn percentiles(text: &str) -> Result<Percentiles, String> {
    let share = |part: &str| match part.trim().parse::<f64>() {
        Ok(percent) if percent > 0.0 && percent < 100.0 => Ok(percent / 100.0),
        _ => Err(format!("`{part}` is not a percentage above 0 and below 100")),
    };
    text.split(',').map(share).collect::<Result<_, _>>().map(Percentiles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentages_lie_between_0_and_100() {
        assert_eq!(percentiles("50, 99.5").unwrap().0, [0.5, 0.995]);
        for wrong in ["0", "100", "nan", "", "50,,90", "-1"] {
            assert!(percentiles(wrong).is_err(), "{wrong}");
        }
    }
}
