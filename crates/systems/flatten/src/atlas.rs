//! Charts: components, divided where they distort most.

use crate::chart::{Chart, flatten_component};
use crate::components::{Component, in_whole};
use crate::creases::seams_along_creases;
use crate::cut::{CutError, first_cut};
use crate::distortion::Distortion;
use crate::divide::divide;
use crate::opened::disks;
use crate::seams::{ShortSeams, seam_length};
use crate::watch::Watch;
use crate::{Charts, FlattenError, FlattenOptions};
use pompeiu_surface::{EdgeData, EmbeddedSurface, Surface};
use rayon::prelude::*;

/// Charts at most where their number is free.
const MOST_CHARTS: usize = 1024;

/// Faces of a surface at most for which short seams are looked for: each seam tried takes a linear system with an unknown for each vertex of
/// its chart.
const MOST_FACES: usize = 40_000;

/// Sets of seams that are mapped at most, and how many of them before seams grow by as much as the last map was too far off.
const ATTEMPTS: usize = 10;
const SMALL_STEPS: usize = 4;

/// The estimate has failed where a map exceeds the energy of an isometry by more than this many times what was estimated; where it is of
/// use, the map exceeds it by less than the estimate. More seams chosen by it would be mapped in vain.
const MISJUDGED: f64 = 4.0;

/// Times that seams along creases are closed, and the share of the distortion asked for that is estimated for the first of these: outlines
/// that would overlap are pushed apart, which no estimate tells.
const CLOSINGS: usize = 3;
const CLOSED_TO: f64 = 0.7;

/// Share of the time in which short seams are looked for: what is left is for charts without them, where none are found.
const TIME_FOR_SEAMS: f64 = 0.4;

/// Seams along creases are taken at once where they are no longer than this many times a cut that only makes a disk; and in place of parts
/// that are divided one after the other where there are more faces than these, for that takes long.
const SHORT: f64 = 1.25;
const FEW_FACES: usize = 2_000;

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

/// A surface that is divided into charts, with the seams between and within them.
pub(crate) struct Atlas {
    pub(crate) seams: EdgeData<bool>,
    pub(crate) parts: Vec<Component>,
    pub(crate) charts: Vec<Chart>,
    /// Whether the seams are those along creases, and not short for what else could be.
    is_of_creases: bool,
}

impl Atlas {
    /// Whether nothing else is tried on a surface of so many faces.
    pub(crate) fn is_taken(&self, faces: usize) -> bool {
        !self.is_of_creases || faces > FEW_FACES
    }

    /// Whether its seams are shorter than those of other charts, or these distort more than is asked for.
    pub(crate) fn is_better(
        &self,
        surface: &Surface,
        parts: &[Component],
        charts: &[Chart],
        cut: &EdgeData<bool>,
        options: &FlattenOptions<'_>,
    ) -> bool {
        let pieces: Vec<Piece> =
            parts.iter().zip(charts).map(|(part, chart)| Piece::new(part.clone(), chart.clone())).collect();
        seam_length(surface, &self.seams) < seam_length(surface, cut) || !is_enough(&pieces, options)
    }
}

/// A surface with its charts while seams are looked for.
struct Seamed<'s, 'o, 'w> {
    surface: &'s EmbeddedSurface,
    /// No more cuts are added to a chart.
    options: FlattenOptions<'o>,
    watch: &'s Watch<'w>,
    /// The mean energy beyond that of an isometry that is asked for.
    allowed: f64,
}

/// Seams with the charts between them.
type Found = (EdgeData<bool>, Vec<Piece>);

/// The charts between seams that are as short as possible for the distortion asked for; none where charts are not divided freely, or the
/// distortion is not reached with few maps.
pub(crate) fn with_short_seams(
    surface: &EmbeddedSurface,
    parts: &[Component],
    options: &FlattenOptions<'_>,
    watch: &Watch<'_>,
) -> Result<Option<Atlas>, FlattenError> {
    let (Charts::Auto, Some(enough)) = (options.charts, options.enough()) else { return Ok(None) };
    let whole = surface.surface();
    let watch = &watch.for_share(TIME_FOR_SEAMS);
    let mut seams = EdgeData::filled(whole.mesh().edges(), false);
    for part in parts {
        let first = first_cut(part, &part.options(&options.cut)).map_err(|error| in_whole(error, part))?;
        part.mark_in(whole.mesh(), &first, &mut seams);
    }
    let options = FlattenOptions { most_cuts: 0, ..options.clone() };
    let seamed = Seamed { surface, options, watch, allowed: enough - 4.0 };
    let creased = seamed.along_creases()?;
    let of_creases = creased.as_ref().map(|(seams, _)| seam_length(whole, seams));
    let is_short = of_creases.is_some_and(|of_creases| of_creases <= SHORT * seam_length(whole, &seams));
    let grown = if is_short || whole.mesh().faces() > MOST_FACES {
        None
    } else {
        seamed.grown(seams, of_creases.unwrap_or(f64::INFINITY))?
    };
    let grown =
        grown.filter(|(grown, _)| of_creases.is_none_or(|longest| seam_length(whole, grown) < longest));
    let is_of_creases = grown.is_none() && !is_short;
    Ok(grown.or(creased).map(|(seams, mut pieces)| {
        pieces.sort_by_key(|piece| piece.part.faces.first().copied());
        let (parts, charts) = pieces.into_iter().map(|piece| (piece.part, piece.chart)).unzip();
        Atlas { seams, parts, charts, is_of_creases }
    }))
}

impl Seamed<'_, '_, '_> {
    /// The charts between seams.
    fn mapped(&self, seams: &EdgeData<bool>) -> Result<Vec<Piece>, FlattenError> {
        let one = |part: Component| {
            let nothing_more = EdgeData::filled(part.surface.mesh().edges(), false);
            let chart = flatten_component(&part, Some(nothing_more), &self.options, self.watch)?;
            Ok(Piece::new(part, chart))
        };
        disks(self.surface, seams)?.into_par_iter().map(one).collect()
    }

    /// The same; none where one of the charts has faces that are too crowded on a circle, or one edge alone is a seam, which opens nothing.
    fn mapped_if_possible(&self, seams: &EdgeData<bool>) -> Result<Option<Vec<Piece>>, FlattenError> {
        match self.mapped(seams) {
            Ok(pieces) => Ok(Some(pieces)),
            Err(FlattenError::Crowded { .. } | FlattenError::Cut(CutError::SingleEdge { .. })) => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// Seams along creases, those closed that are worth least; none if the distortion is too great with all of them.
    fn along_creases(&self) -> Result<Option<Found>, FlattenError> {
        let whole = self.surface.surface();
        let Some(seams) = seams_along_creases(self.surface, &self.options.cut)? else { return Ok(None) };
        let Some(pieces) = self.mapped_if_possible(&seams)? else { return Ok(None) };
        if mean_excess(&pieces) > self.allowed {
            return Ok(None);
        }
        let all = Some((seams, pieces));
        let mut aim = CLOSED_TO * self.allowed;
        for _ in 0..CLOSINGS {
            if self.watch.is_stopped() {
                break;
            }
            let Some((seams, _)) = &all else { break };
            let mut closing = ShortSeams::new(whole, seams)?;
            let seams = closing.shrink(aim, self.watch)?;
            aim *= 0.5;
            let Some(pieces) = self.mapped_if_possible(&seams)? else { continue };
            let reached = mean_excess(&pieces);
            if reached <= self.allowed {
                return Ok(Some((seams, pieces)));
            }
            let as_found = 0.5 * closing.estimate() * self.allowed / reached;
            aim = if as_found < aim { as_found } else { aim };
        }
        Ok(all)
    }

    /// Seams that grow from given ones until the distortion is reached; none if it is not with few maps, or seams become longer than
    /// `longest`.
    fn grown(&self, seams: EdgeData<bool>, longest: f64) -> Result<Option<Found>, FlattenError> {
        let (allowed, watch) = (self.allowed, self.watch);
        let whole = self.surface.surface();
        let mut growing = ShortSeams::new(whole, &seams)?;
        // Seams with which the distortion is still too great, and its excess.
        let mut before: Option<(EdgeData<bool>, f64)> = None;
        let mut best: Option<Found> = None;
        let mut next = Some(seams);
        for attempt in 0..ATTEMPTS {
            let Some(seams) = next.filter(|seams| seam_length(whole, seams) < longest) else { break };
            if watch.is_stopped() {
                break;
            }
            let Some(pieces) = self.mapped_if_possible(&seams)? else { break };
            let reached = mean_excess(&pieces);
            if reached <= allowed {
                best = Some((seams, pieces));
                break;
            }
            // The outline of a first cut may be in its own way, which the estimate does not tell.
            if attempt > 0 && reached > MISJUDGED * growing.estimate() {
                break;
            }
            let aim =
                if attempt < SMALL_STEPS { f64::INFINITY } else { growing.estimate() * allowed / reached };
            before = Some((seams, reached));
            next = growing.grow(allowed, aim, watch)?;
        }
        // The last seam may be longer than is needed.
        if let (Some((seams, reached)), Some((found, _))) = (&before, &best)
            && !watch.is_stopped()
        {
            for seams in growing.completed(seams, *reached, allowed, seam_length(whole, found), watch)? {
                if watch.is_stopped() {
                    break;
                }
                let Some(pieces) = self.mapped_if_possible(&seams)? else { continue };
                if mean_excess(&pieces) <= allowed {
                    best = Some((seams, pieces));
                    break;
                }
            }
        }
        Ok(best)
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
        if watch.is_stopped() {
            break;
        }
        let flattened = |part: Component| {
            let chart = flatten_component(&part, None, options, watch)?;
            Ok(Piece::new(part, chart))
        };
        let new: Vec<Piece> = parts.into_par_iter().map(flattened).collect::<Result<_, FlattenError>>()?;
        // Maps that time did not suffice for may distort more than what they would replace.
        let is_less = new.iter().map(Piece::excess).sum::<f64>() < pieces[worst].excess();
        if watch.is_stopped() && !is_less {
            break;
        }
        pieces.swap_remove(worst);
        pieces.extend(new);
    }
    pieces.sort_by_key(|piece| piece.part.faces.first().copied());
    Ok(pieces.into_iter().map(|piece| (piece.part, piece.chart)).unzip())
}

/// Whether the mean energy over all parts is low enough.
fn is_enough(pieces: &[Piece], options: &FlattenOptions<'_>) -> bool {
    options.enough().is_some_and(|enough| 4.0 + mean_excess(pieces) <= enough)
}

/// The mean energy over all parts beyond that of an isometry.
fn mean_excess(pieces: &[Piece]) -> f64 {
    let area: f64 = pieces.iter().map(|piece| piece.area).sum();
    pieces.iter().map(Piece::excess).sum::<f64>() / area
}
