//! Charts: components, divided where they distort most.

use crate::chart::{Chart, flatten_component};
use crate::components::Component;
use crate::distortion::Distortion;
use crate::divide::divide;
use crate::watch::Watch;
use crate::{Charts, FlattenError, FlattenOptions};
use rayon::prelude::*;

/// Charts at most where their number is free.
const MOST_CHARTS: usize = 1024;

/// A part of the surface with its map.
struct Piece {
    part: Component,
    chart: Chart,
    area: f64,
    /// The mean symmetric Dirichlet energy at the best scale.
    energy: f64,
    is_divisible: bool,
}

impl Piece {
    fn new(part: Component, chart: Chart) -> Self {
        let area = part.surface.surface().area();
        let energy = Distortion::of(&chart.values(&part)).symmetric_dirichlet.mean;
        Self { part, chart, area, energy, is_divisible: true }
    }

    /// What it adds to the energy of the whole map beyond that of an isometry.
    fn excess(&self) -> f64 {
        self.area * (self.energy - 4.0)
    }
}

/// Divides the part that adds most to the distortion, again and again, until there are as many as asked for or the distortion is low enough.
/// Parts are in the order of their first faces.
pub(crate) fn divided(
    parts: Vec<Component>,
    charts: Vec<Chart>,
    options: &FlattenOptions<'_>,
    watch: &Watch<'_>,
) -> Result<(Vec<Component>, Vec<Chart>), FlattenError> {
    let most = match options.charts {
        Charts::Components => return Ok((parts, charts)),
        Charts::Count(count) => count.get(),
        Charts::Auto => MOST_CHARTS,
    };
    let mut pieces: Vec<Piece> =
        parts.into_iter().zip(charts).map(|(part, chart)| Piece::new(part, chart)).collect();
    while pieces.len() < most && !watch.is_stopped() && !is_enough(&pieces, options) {
        let open = (0..pieces.len()).filter(|&i| pieces[i].is_divisible);
        let Some(worst) = open.max_by(|&i, &j| pieces[i].excess().total_cmp(&pieces[j].excess())) else {
            break;
        };
        let Some(parts) = divide(&pieces[worst].part)? else {
            pieces[worst].is_divisible = false;
            continue;
        };
        let flattened = |part: Component| {
            let chart = flatten_component(&part, None, options, watch)?;
            Ok(Piece::new(part, chart))
        };
        let new: Vec<Piece> = parts.into_par_iter().map(flattened).collect::<Result<_, FlattenError>>()?;
        pieces.swap_remove(worst);
        pieces.extend(new);
    }
    pieces.sort_by_key(|piece| piece.part.faces.first().copied());
    Ok(pieces.into_iter().map(|piece| (piece.part, piece.chart)).unzip())
}

/// Whether the mean energy over all parts is low enough.
fn is_enough(pieces: &[Piece], options: &FlattenOptions<'_>) -> bool {
    let area: f64 = pieces.iter().map(|piece| piece.area).sum();
    let excess: f64 = pieces.iter().map(Piece::excess).sum();
    options.enough().is_some_and(|enough| 4.0 + excess / area <= enough)
}
