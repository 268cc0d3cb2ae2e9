//! A deviation analysis as a page and as a picture.

use super::content::{
    self, DeviationContent, DisplayTriangles, Exceedance, Histogram, MeasuredSurface, SearchStage,
    SurfaceDeviation,
};
use super::draw::{Drawing, Style};
use super::spread;
use crate::certificate::AttachedProof;
use crate::deviation::{BandReport, Deviation, DirectedDeviation, Region, Statistics};
use crate::{Direction, Enclosure, PreparedPair, Stage, StopReason, VerdictAnswer, Witness};
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::run::Limits;
use pompeiu_core::{FaceId, TriMesh};
use pompeiu_figures::names::{axis, name};
use pompeiu_figures::page::{Banner, BannerKind, Bounds, PageError, PointPair};
use pompeiu_figures::{ColorMap, Figure, FigureError, Image, Mark, Panel, Scale, Theme, Values, View};
use std::fmt::{self, Write};

/// A deviation analysis to be shown: its [`figures`](Self::figures) are a page to explore, pictures and documents.
///
/// # Example
/// ```
/// use pompeiu_core::mesh::shapes::{icosphere, torus};
/// use pompeiu_hausdorff::show::{DeviationPage, search_stages};
/// use pompeiu_hausdorff::{DeviationOptions, PreparedPair};
///
/// let pair = PreparedPair::new(icosphere(1.0, 2)?, torus(0.75, 0.25, 32, 16)?);
/// let limits = Default::default();
/// let found = DeviationPage {
///     pair: &pair,
///     paths: ["sphere.obj", "torus.obj"],
///     names: ["model", "scan"],
///     deviation: &DeviationOptions::default().symmetric_of(&pair)?,
///     stages: &search_stages(&pair, &limits),
///     unit: "mm",
///     up: [0.0, 0.0, 1.0],
///     threshold: Some(0.25),
///     bands: None,
///     verdict: None,
///     proof: None,
///     command: None,
/// };
/// let figures = found.figures(&limits);
/// assert!(figures.html()?.contains("torus.obj"));
/// assert_eq!(figures.image(640, 360, Default::default(), Default::default())?.width(), 640);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct DeviationPage<'r> {
    /// The surface as it should be, and the surface as it is.
    pub pair: &'r PreparedPair<'r>,
    /// Their files, or whatever else tells one from the other.
    pub paths: [&'r str; 2],
    /// What the two are called: A and B, or what they are.
    pub names: [&'r str; 2],
    /// What was found of this very pair. Where it has parts, regions name faces of the whole meshes
    /// ([`DirectedDeviation::renumber`]).
    pub deviation: &'r Deviation,
    /// What the search had left at coarser tolerances, both directions; may be empty.
    pub stages: &'r [Stage],
    /// The unit of length; empty where nobody knows.
    pub unit: &'r str,
    /// Which way is up.
    pub up: [f64; 3],
    /// What counts as out of tolerance.
    pub threshold: Option<f64>,
    /// How much lies in which tolerance band. Sides must have been asked for with the analysis.
    pub bands: Option<&'r BandReport>,
    /// The answer that a person acts on, above everything else, and its sentence
    /// ([`DeviationReport::sentence`](crate::DeviationReport::sentence)).
    pub verdict: Option<(VerdictAnswer, &'r str)>,
    /// A certificate of the same answer, if there is one.
    pub proof: Option<&'r AttachedProof>,
    /// The command that makes the page again.
    pub command: Option<&'r str>,
}

/// Pixels of the picture for browsers that cannot draw the surfaces.
const STILL: [u32; 2] = [560, 260];

/// The part of the colour scale that a drawn distance may be off by.
const COLOR_TOLERANCE: f64 = 1.0 / 256.0;

/// Triangles drawn of each mesh at most: pages stay below 5 MiB.
const MOST_TRIANGLES: usize = 90_000;

/// Triangles drawn of each mesh at most for each of its faces: pages cost a part of the analysis, which grows with the faces.
const MOST_PER_FACE: usize = 4;

/// Triangles that may always be drawn of a mesh: on few large faces distances bend, too.
const MOST_OF_FEW: usize = 10_000;

/// What of the area colours are told apart for, unless more is asked: few points that are far would leave all others in one colour.
const COVERED: f64 = 0.99;

/// The part of the colours of a picture that a drawn distance may be off by where few points are far beyond it.
const COVERED_TOLERANCE: f64 = 1.0 / 32.0;

/// Columns of the histograms beside the colours of a picture.
const COLUMNS: usize = 48;

/// One direction: the surface that is measured, and what was found on it.
pub(super) struct Side<'r> {
    path: &'r str,
    mesh: &'r TriMesh,
    found: &'r DirectedDeviation,
    pub(super) drawing: Drawing,
}

/// A deviation analysis with what is drawn of it: a page, pictures and documents of the same triangles.
pub struct DeviationFigures<'r> {
    pub(super) of: DeviationPage<'r>,
    pub(super) sides: [Side<'r>; 2],
}

impl fmt::Debug for DeviationFigures<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("DeviationFigures").field("of", &self.of).finish_non_exhaustive()
    }
}

impl<'r> DeviationPage<'r> {
    /// Cuts faces into triangles on which distances are drawn, once for all figures. Limits end that with coarser drawings.
    ///
    /// # Cost
    /// Some microseconds for each face, more for those on which distances bend.
    pub fn figures(&self, limits: &Limits) -> DeviationFigures<'r> {
        DeviationFigures { of: *self, sides: self.sides(limits) }
    }

    fn sides(&self, limits: &Limits) -> [Side<'r>; 2] {
        let whole = COLOR_TOLERANCE * self.deviation.distance.upper();
        let tolerance = whole.min(COVERED_TOLERANCE * self.extent());
        let side = |(path, found): (&'r str, &'r DirectedDeviation)| {
            let mesh = self.pair.measured(found.direction);
            let most = mesh.faces().len().saturating_mul(MOST_PER_FACE).clamp(MOST_OF_FEW, MOST_TRIANGLES);
            let mut drawing = Drawing::new(found, self.pair, Style { tolerance, most }, limits);
            // Where B has more, points of A are inside of it.
            if found.sides.is_some() && self.bands.is_some() && found.direction == Direction::AToB {
                for distance in drawing.triangles.distances.as_flattened_mut() {
                    *distance = -*distance;
                }
            }
            Side { path, mesh, found, drawing }
        };
        let Deviation { a_to_b, b_to_a, .. } = self.deviation;
        rayon::join(|| side((self.paths[0], a_to_b)), || side((self.paths[1], b_to_a))).into()
    }

    /// What the two are called, or the names of their files where they are called A and B.
    pub(super) fn shown_names(&self) -> [&'r str; 2] {
        if self.names == ["A", "B"] { self.paths.map(name) } else { self.names }
    }

    fn is_signed(&self) -> bool {
        self.deviation.a_to_b.sides.is_some()
    }

    /// The distance up to which colours are told apart: the threshold, or that of 99 % of the area.
    fn extent(&self) -> f64 {
        let largest = self.deviation.distance.upper();
        let both = [&self.deviation.a_to_b, &self.deviation.b_to_a];
        let covering = both.into_iter().map(|found| {
            let within = found.statistics.as_ref().map(exceedance);
            within.and_then(|found| found.covering(1.0 - COVERED)).unwrap_or(largest)
        });
        // Colours end at a tolerance that is asked for; what is farther has one of its own.
        match self.threshold.filter(|threshold| *threshold > 0.0) {
            Some(threshold) => threshold,
            None => largest.min(covering.fold(0.0, f64::max)),
        }
    }

    fn surface(&self, side: &Side<'_>) -> MeasuredSurface {
        let Side { path, mesh, found, drawing } = side;
        let Drawing { triangles, groups, bounds: face_bounds } = drawing;
        let direction = found.direction;
        let stages = self.stages.iter().filter(|stage| stage.direction == direction);
        MeasuredSurface {
            name: name(path).to_owned(),
            path: (*path).to_owned(),
            vertices: mesh.positions().len(),
            faces: mesh.faces().len(),
            triangles: DisplayTriangles {
                positions: triangles.positions.clone(),
                corners: triangles.corners.clone(),
                faces: triangles.faces.clone(),
                groups: groups.as_ref().map(|_| face_bounds.len()),
            },
            deviation: Some(SurfaceDeviation {
                values: triangles.distances.clone(),
                face_bounds: face_bounds.clone(),
                distance: bounds(found.distance.distance),
                stop: stop(found).to_owned(),
                witness: pair(&found.distance.witness),
                statistics: found.statistics.as_ref().map(|all| statistics(all, found)).unwrap_or_default(),
                bands: self.shares(found.direction),
                histogram: found.statistics.as_ref().map(histogram).unwrap_or_default(),
                exceedance: found.statistics.as_ref().map(exceedance).unwrap_or_default(),
                regions: found
                    .regions
                    .iter()
                    .map(|found| self.region(found, direction, groups.as_deref()))
                    .collect(),
                stages: stages.map(search_stage).collect(),
            }),
        }
    }

    /// How the distances of one surface are spread over its area, along a colour bar: over tolerance bands as proven, else as drawn.
    fn spread(&self, side: &Side<'_>, scale: &Scale) -> Vec<f64> {
        if !scale.classes().is_empty() {
            return self.shares(side.found.direction).iter().map(|[low, high]| 0.5 * (low + high)).collect();
        }
        let frame = Frame::of(&Aabb::of_faces(side.mesh));
        spread::shares(&side.drawing.triangles, &frame, scale.range(), COLUMNS)
    }

    /// Shares of the area in the tolerance bands.
    pub(super) fn shares(&self, direction: Direction) -> Vec<Bounds> {
        let found = self.bands.and_then(|bands| match direction {
            Direction::AToB => bands.a_to_b.shares.as_ref(),
            Direction::BToA => bands.b_to_a.shares.as_ref(),
        });
        found.map(|shares| shares.iter().copied().map(bounds).collect()).unwrap_or_default()
    }

    fn region(&self, found: &Region, direction: Direction, groups: Option<&[u32]>) -> content::Region {
        let measured = |face: &FaceId| self.pair.faces_of_measured(direction, *face);
        let drawn = |face: u32| groups.map_or(face, |groups| groups[face as usize]);
        let mut faces: Vec<u32> = found.faces.iter().flat_map(measured).map(drawn).collect();
        faces.sort_unstable();
        faces.dedup();
        content::Region {
            center: found.centre,
            extent: found.aabb.diagonal(),
            area: found.area,
            peak: bounds(found.peak),
            pair: pair(&found.witness),
            faces,
        }
    }

    fn facts(&self) -> Vec<[String; 2]> {
        let mut facts = Vec::new();
        if let Some(greater) = &self.deviation.greater_percentiles {
            for percentile in greater {
                facts.push([
                    format!("{} %, greater of both directions", percent(percentile.share)),
                    shown(percentile.distance),
                ]);
            }
        }
        if let Some(pooled) = &self.deviation.pooled {
            facts.push(["mean, over both surfaces".to_owned(), shown(pooled.mean)]);
            facts.push(["root mean square, over both surfaces".to_owned(), shown(pooled.rms)]);
        }
        let work = [&self.deviation.a_to_b.work, &self.deviation.b_to_a.work];
        facts.push(["pieces".to_owned(), work.map(|w| w.pieces).iter().sum::<u64>().to_string()]);
        facts
    }

    /// The verdict, with the place where the distance is greatest.
    fn banner(&self) -> Option<Banner> {
        let (answer, sentence) = self.verdict?;
        let (kind, head) = match answer {
            VerdictAnswer::Within => (BannerKind::Good, "WITHIN TOLERANCE"),
            VerdictAnswer::Out => (BannerKind::Bad, "OUT OF TOLERANCE"),
            VerdictAnswer::Undecided => (BannerKind::Open, "UNDECIDED"),
        };
        let [there, back] = [&self.deviation.a_to_b, &self.deviation.b_to_a];
        let is_back = back.distance.distance.upper() > there.distance.distance.upper();
        let (name, worst) = if is_back { (self.names[1], back) } else { (self.names[0], there) };
        let [x, y, z] = worst.distance.witness.from.position.map(four_digits);
        let rest = sentence.trim_start_matches(|c: char| c.is_uppercase() || c == ' ');
        let text = format!("{rest}, at ({x}, {y}, {z}) on {name}");
        Some(Banner { kind, head: head.to_owned(), text })
    }

    /// What colours of a picture mean.
    pub(super) fn scale(&self) -> Result<(Scale, String), FigureError> {
        let extent = self.extent();
        let scale = if self.is_signed() {
            Scale::symmetric(ColorMap::Vik, extent)?
        } else {
            Scale::new(ColorMap::Viridis, 0.0, extent)?
        };
        let mut label = if self.bands.is_some() { "deviation of B" } else { "distance" }.to_owned();
        if !self.unit.is_empty() {
            let _ = write!(label, " ({})", self.unit);
        }
        if let Some(bands) = self.bands {
            return Ok((scale.with_classes(&bands.edges)?, label));
        }
        if extent < self.deviation.distance.upper() {
            label.push_str(if self.threshold.is_some() {
                ", and more"
            } else {
                ", 99 % of the area and more"
            });
        }
        Ok((self.threshold.map_or(scale, |threshold| scale.with_limit(threshold)), label))
    }
}

impl DeviationFigures<'_> {
    /// The page as a file.
    ///
    /// # Errors
    /// [`PageError`] where a threshold is not finite, or the analysis is of other meshes.
    pub fn html(&self) -> Result<String, PageError> {
        Ok(self.content().page()?.html())
    }

    /// What the page shows.
    fn content(&self) -> DeviationContent {
        let of = &self.of;
        let view = View::default().with_up(of.up);
        let bands = of.bands.filter(|_| of.is_signed());
        let [width, height] = STILL;
        let (still, surfaces) = rayon::join(
            || self.image(width, height, Theme::Light, view).ok(),
            || self.sides.each_ref().map(|side| of.surface(side)),
        );
        DeviationContent {
            title: format!("{} and {}", name(of.paths[0]), name(of.paths[1])),
            unit: of.unit.to_owned(),
            up: axis(of.up),
            signed: of.is_signed(),
            threshold: of.threshold,
            bands: bands.map(|bands| bands.edges.clone()).unwrap_or_default(),
            labels: of.names.map(str::to_owned),
            verdict: of.banner(),
            still,
            distance: Some(bounds(of.deviation.distance)),
            surfaces,
            proof: proof(),
            attached: of.proof.map(AttachedProof::rows).unwrap_or_default(),
            facts: of.facts(),
            command: of.command.map(str::to_owned),
            version: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }

    /// A picture with one panel for each direction, of the given size in pixels, with the verdict above. Colours are told apart up to the
    /// threshold, or the distance that 99 % of the area is within; tolerance bands have one colour each, as on the page. Beside them, a histogram for each direction.
    ///
    /// # Errors
    /// [`FigureError`] for a size that is none.
    pub fn image(&self, width: u32, height: u32, theme: Theme, view: View) -> Result<Image, FigureError> {
        self.drawn_as(&self.of, width, height, theme, view)
    }

    pub(super) fn drawn_as(
        &self,
        of: &DeviationPage<'_>,
        width: u32,
        height: u32,
        theme: Theme,
        view: View,
    ) -> Result<Image, FigureError> {
        let sides = &self.sides;
        let (scale, label) = of.scale()?;
        let prepared = |side: &Side<'_>| (side.drawing.triangles.mesh(), of.spread(side, &scale));
        let prepared: [_; 2] = rayon::join(|| prepared(&sides[0]), || prepared(&sides[1])).into();
        let mut figure =
            Figure::new(width, height).with_theme(theme).with_view(view).with_scale(scale, label);
        if let Some((_, sentence)) = of.verdict {
            figure = figure.with_title(sentence);
        }
        for (side, (mesh, spread)) in sides.iter().zip(&prepared) {
            // Without anything to draw there is no panel.
            let Ok(mesh) = mesh else { continue };
            let names = of.shown_names();
            let (meaning, [from, to]) = match side.found.direction {
                Direction::AToB => ("missing", names),
                Direction::BToA => ("excess", [names[1], names[0]]),
            };
            figure = figure.with_histogram(meaning, spread.clone());
            let distance = rounded(side.found.distance.distance);
            let title = format!("{meaning}: {from} to {to}, {distance} {}", of.unit);
            let PointPair { from, to } = pair(&side.found.distance.witness);
            figure = figure.with_panel(
                Panel::new(mesh)
                    .with_values(Values::Corners(&side.drawing.triangles.distances))
                    .with_title(title)
                    .with_mark(Mark::segment(from, to))
                    .with_mark(Mark::point(from)),
            );
        }
        figure.draw()
    }
}

fn bounds(enclosure: Enclosure) -> Bounds {
    [enclosure.lower(), enclosure.upper()]
}

fn shown(enclosure: Enclosure) -> String {
    format!("{enclosure:.4}")
}

/// Five digits of the middle: for titles, beside which the legend stands.
fn rounded(enclosure: Enclosure) -> String {
    let middle: f64 = format!("{:.4e}", 0.5 * (enclosure.lower() + enclosure.upper())).parse().unwrap_or(0.0);
    middle.to_string()
}

pub(super) fn percent(share: f64) -> f64 {
    (share * 1e12).round() / 1e10
}

fn pair(witness: &Witness) -> PointPair {
    PointPair { from: witness.from.position, to: witness.to.position }
}

fn statistics(found: &Statistics, of: &DirectedDeviation) -> Vec<(String, Bounds)> {
    let statistic = |label: String, value| (label, bounds(value));
    let mut all =
        vec![statistic("mean".to_owned(), found.mean), statistic("root mean square".to_owned(), found.rms)];
    all.extend(found.percentiles.iter().map(|p| {
        let label =
            if p.share == 0.5 { "median".to_owned() } else { format!("{} % of the area", percent(p.share)) };
        statistic(label, p.distance)
    }));
    if let Some(signed) = &of.signed {
        all.push(("signed mean".to_owned(), [signed.mean.lower, signed.mean.upper]));
        all.push(statistic("standard deviation".to_owned(), signed.standard_deviation));
        all.push(("most inside".to_owned(), [signed.lowest.lower, signed.lowest.upper]));
        all.push(("most outside".to_owned(), [signed.highest.lower, signed.highest.upper]));
    }
    all
}

/// Whether the ends of bins can be told apart: not where all distances are zero.
fn has_width(histogram: &crate::deviation::Histogram) -> bool {
    histogram.edges.is_sorted_by(|a, b| a < b)
}

fn histogram(found: &Statistics) -> Histogram {
    let histogram = &found.histogram;
    if !has_width(histogram) {
        return Histogram::default();
    }
    Histogram {
        edges: histogram.edges.clone(),
        fractions: histogram.bins.iter().map(|bin| bounds(*bin)).collect(),
    }
}

/// The share beyond each end of a bin: what is not up to it.
fn exceedance(found: &Statistics) -> Exceedance {
    let histogram = &found.histogram;
    let beyond = |up_to: &Enclosure| {
        let ends = [(1.0 - up_to.upper()).next_down(), (1.0 - up_to.lower()).next_up()];
        ends.map(|x| x.clamp(0.0, 1.0))
    };
    if !has_width(histogram) {
        return Exceedance::default();
    }
    let mut distances = histogram.edges.clone();
    let mut fractions: Vec<Bounds> = histogram.cumulative.iter().map(beyond).collect();
    // At the threshold that was asked for, the share is known better than between two bins.
    if let Some(above) = &found.above {
        let place = distances.partition_point(|distance| *distance < above.threshold);
        if distances.get(place) == Some(&above.threshold) {
            fractions[place] = bounds(above.share);
        } else if place < distances.len() {
            distances.insert(place, above.threshold);
            fractions.insert(place, bounds(above.share));
        }
    }
    // So is what percentiles leave over.
    for percentile in &found.percentiles {
        let distance = percentile.distance.upper();
        let place = distances.partition_point(|at| *at < distance);
        if place == 0 || distances.get(place).is_none_or(|at| *at == distance) {
            continue;
        }
        // Exact from a half on, by the lemma of Sterbenz.
        let beyond =
            if percentile.share < 0.5 { (1.0 - percentile.share).next_up() } else { 1.0 - percentile.share };
        let [least, most] = [fractions[place][0], fractions[place - 1][1]];
        distances.insert(place, distance);
        fractions.insert(place, [least, beyond.min(most).max(least)]);
    }
    Exceedance { distances, fractions }
}

fn search_stage(stage: &Stage) -> SearchStage {
    SearchStage {
        tolerance: stage.tolerance,
        distance: [stage.lower, stage.upper],
        remaining: stage.remaining.iter().map(|piece| piece.corners).collect(),
    }
}

fn stop(found: &DirectedDeviation) -> &'static str {
    match found.distance.stop {
        StopReason::Tolerance => "as narrow as asked",
        StopReason::Threshold => "the threshold was decided",
        StopReason::Time => "the time limit ran out",
        StopReason::Memory => "the memory limit was reached",
        StopReason::Rounding => "double precision ends here",
        _ => "stopped on request",
    }
}

fn proof() -> Vec<String> {
    [
        "Upper end: every part of the surface was discarded with a bound on its distance from the other one. The distance from one \
         face, or a weighted mean of distances from several, is a convex function, so on a triangle it is greatest at a corner.",
        "Lower end: the first of the two points lies on the surface, and planes were found that separate it from every \
         face of the other one by at least this distance, evaluated in interval arithmetic.",
        "Mean, percentiles and shares of the area: each face was cut into pieces on which the distance lies between two linear \
         functions, whose integrals are known; sums are rounded outwards.",
    ]
    .map(str::to_owned)
    .to_vec()
}

/// Four digits of what is not claimed to be exact.
pub(super) fn four_digits(x: f64) -> String {
    let rounded: f64 = format!("{x:.3e}").parse().unwrap_or(x);
    // A coordinate that is zero but for rounding would have twenty zeros.
    if rounded != 0.0 && rounded.abs() < 1e-4 { format!("{rounded:e}") } else { rounded.to_string() }
}
