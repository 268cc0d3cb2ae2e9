//! Global registration: aligning a mesh to another from any start, also if they overlap only partially.
//!
//! Initial poses come from principal axes and from [pairs of points with normals](pairs); each is [refined](refine) by iterated
//! closest points with weights that ignore points without a counterpart. Other poses that fit nearly as well, and [free
//! motions](freedom), are reported.

mod freedom;
mod grid;
mod oriented;
mod pairs;
mod placement;
mod refine;
mod report;
mod screw;
mod settings;

pub use report::{Alternative, FreeMotion, Registration};
pub use settings::TransformSettings;

use super::moments::Moments;
use super::pose::axis_rotations;
use super::samples::samples;
use super::{AlignError, Fixed, Matrix, matrix};
use freedom::free_motions;
use glam::DVec3;
use oriented::{Oriented, oriented};
use pairs::{Pairs, voted};
use placement::Placement;
use pompeiu_core::TriMesh;
use pompeiu_core::run::{Control, Limits, Progress, ProgressObserver, StopReason, on_threads};
use rayon::prelude::*;
use refine::Refinement;
use screw::Screw;

/// Spacing of sample points, relative to the diagonal of the smaller surface.
const SPACING: f64 = 0.04;
/// Number of points of a surface above which the spacing is increased.
const MOST_POINTS: f64 = 1600.0;
/// Number of initial poses by voting.
const VOTED: usize = 40;
/// Sample points that distinguish initial poses.
const FEW_POINTS: usize = 300;
/// Number of poses that are refined to convergence.
const FOLLOWED: usize = 20;
/// Sample points for the last refinement and the reported figures.
const LAST_POINTS: usize = 4000;
/// Width of the score that distinguishes initial poses, and the smallest reach, relative to the diagonal of the smaller surface.
const WIDTH: f64 = 0.03;
const LEAST_REACH: f64 = 0.01;
/// Criteria for a fit: the smallest matched share of the area, the greatest spread of its distances, and the greatest reach
/// relative to the diagonal of the smaller surface. Different shapes laid on each other have a reach of 7 to 10 %.
const LEAST_MATCHED: f64 = 0.2;
const MOST_SPREAD: f64 = 0.4;
const MOST_REACH: f64 = 0.05;
/// Poses whose score is at least this share of the best count as equally good.
const AS_GOOD: f64 = 0.97;
/// Poses closer than this angle, in radians, and this share of the diagonal, count as equal.
const SAME_ANGLE: f64 = 0.17;
const SAME_PLACE: f64 = 0.05;
/// Largest number of reported alternatives.
const MOST_ALTERNATIVES: usize = 8;
/// Largest factor between the final scale and the initial estimate: at much smaller scales, any shape fits into a corner of any
/// other.
const MOST_GROWTH: f64 = 1.5;
/// If the best score is below this, the moving mesh is also tried with reversed orientation.
const POOR: f64 = 0.3;

/// Options of a registration.
#[derive(Clone, Default)]
pub struct RegistrationOptions<'o> {
    /// Whether to estimate a uniform scale. The initial estimate equates the root-mean-square distances from the centroids, so the
    /// surfaces must overlap almost completely; the result differs from it by at most a factor of 1.5.
    pub scale: bool,
    /// The share of the area of the moving mesh that has a counterpart, above 0 and at most 1: the last refinement uses the nearest
    /// share of the points. By default it is estimated from the spread of the distances.
    pub overlap: Option<f64>,
    /// Limits on time and threads. When time runs out, the best pose so far is returned.
    pub limits: Limits,
    /// Receives progress.
    pub progress: Option<&'o dyn ProgressObserver>,
}

/// Finds the rotation and translation, or the similarity, that brings `moving` onto the fixed mesh.
///
/// # Definition
/// Of all poses tried, the one at which most of the moving surface is near the fixed one with the same orientation: it maximises
/// the mean of `1 − (d/w)²` over distances d below w, where w is 1 % of the diagonal of the smaller mesh or four standard
/// deviations of the distances. At this pose the squared distances of the matched points are locally minimal.
/// # Accuracy
/// Rounded, and deterministic at any number of threads. Nothing is proven about it.
/// # Limits
/// The matched parts are determined from the shapes alone: a flat part fits anywhere on a larger flat one, which the free motions
/// show. Surfaces must have the same orientation, or one must be reversed throughout. Mirror images are not matched.
/// # Errors
/// [`AlignError`] if a mesh has no area, the sizes differ too much, or the overlap is not a valid share.
/// # Cost
/// O(m log m) for the tree of the fixed mesh; then about a million votes and closest-point queries, whatever the size.
/// # Source
/// Initial poses: `drost_model_2010`. Weights of decreasing width: `black_unification_1996`. Point-to-plane distances:
/// `chen_object_1992`.
/// # Example
/// ```
/// use pompeiu_core::mesh::{Affine, shapes, transform};
/// use pompeiu_matching::align::{Fixed, RegistrationOptions, register};
///
/// let part = shapes::torus(1.0, 0.4, 40, 20)?;
/// let fixed = Fixed::new(&part)?;
/// let moved = transform(&part, &Affine::rotate([1.0, 2.0, 0.5], 100.0).unwrap())?;
/// let found = register(&moved, &fixed, &RegistrationOptions::default())?;
/// assert!(found.matched > 0.99 && found.free_motions.len() == 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn register(
    moving: &TriMesh,
    fixed: &Fixed,
    options: &RegistrationOptions<'_>,
) -> Result<Registration, AlignError> {
    if let Some(overlap) = options.overlap
        && !(overlap > 0.0 && overlap <= 1.0)
    {
        return Err(AlignError::Overlap(overlap));
    }
    on_threads(options.limits.threads, || Search::new(moving, fixed, options)?.run())
}

/// One registration. Coordinates are in the frame of the fixed mesh; points of the moving one are in its unit.
struct Search<'s> {
    moving: &'s TriMesh,
    fixed: &'s Fixed,
    options: &'s RegistrationOptions<'s>,
    control: Control,
    moments: Moments,
    /// The length of a unit of the moving mesh's frame in that of the fixed one: a power of two, so exact.
    unit: f64,
    centre: DVec3,
    /// The initial scale.
    scale: f64,
    /// Diagonal of the smaller surface.
    size: f64,
}

/// A pose with its score.
#[derive(Clone, Copy)]
struct Scored {
    placement: Placement,
    score: f64,
}

impl<'s> Search<'s> {
    fn new(
        moving: &'s TriMesh,
        fixed: &'s Fixed,
        options: &'s RegistrationOptions<'s>,
    ) -> Result<Self, AlignError> {
        let moments = Moments::of(moving)?;
        let unit = fixed.unit_of(&moments)?;
        let scale = if options.scale { fixed.moments.radius() / moments.radius() } else { 1.0 };
        if !(scale > 0.0 && scale.is_finite()) {
            return Err(AlignError::Sizes);
        }
        let size = (moments.diagonal * unit * scale).min(fixed.moments.diagonal);
        let control = Control::start(&options.limits);
        Ok(Self {
            moving,
            fixed,
            options,
            control,
            unit,
            centre: moments.centroid * unit,
            moments,
            scale,
            size,
        })
    }

    fn run(&self) -> Result<Registration, AlignError> {
        self.tell("placing points", 0.0);
        let area = [self.fixed.moments.area, self.moments.area * (self.unit * self.scale).powi(2)];
        let spacing = (SPACING * self.size).max((area[0].max(area[1]) / MOST_POINTS).sqrt());
        let own = spacing / self.scale;
        let its_frame = &self.fixed.moments.frame;
        let on_fixed = oriented(self.fixed.mesh(), its_frame, 1.0, area[0], spacing);
        let mut points =
            oriented(self.moving, &self.moments.frame, self.unit, area[1] / self.scale.powi(2), own);
        let pairs = Pairs::new(&on_fixed, spacing);
        let mut best = self.placed(&pairs, &points);
        let mut is_inside_out = false;
        if best.first().is_none_or(|best| best.score < POOR) && !self.control.is_stopped() {
            let inside_out: Vec<Oriented> =
                points.iter().map(|p| Oriented { normal: -p.normal, ..*p }).collect();
            let turned = self.placed(&pairs, &inside_out);
            let score = |found: &[Scored]| found.first().map_or(0.0, |found| found.score);
            if score(&turned) > score(&best) {
                (best, points, is_inside_out) = (turned, inside_out, true);
            }
        }
        self.tell("measuring", 0.95);
        self.report(&best, &points, is_inside_out)
    }

    /// The poses that fit, best first, without duplicates.
    fn placed(&self, pairs: &Pairs<'_>, moving: &[Oriented]) -> Vec<Scored> {
        let starts = self.starts(pairs, moving);
        self.tell("comparing starts", 0.3);
        let every = moving.len().div_ceil(FEW_POINTS).max(1);
        let few: Vec<Oriented> = moving.iter().step_by(every).copied().collect();
        let rough = starts.par_iter().map(|start| {
            let mut refinement = self.refinement(&few);
            let placement = refinement.rough(*start);
            refinement.look(&placement);
            Scored { placement, score: refinement.score(WIDTH * self.size) }
        });
        let rough = self.distinct(rough.collect(), FOLLOWED);
        self.tell("following the best", 0.6);
        let fine = rough.par_iter().map(|start| {
            if self.control.is_stopped() {
                return *start;
            }
            let mut refinement = self.refinement(moving);
            let placement = refinement.fine(start.placement);
            refinement.look(&placement);
            Scored { placement, score: refinement.score(LEAST_REACH * self.size) }
        });
        self.distinct(fine.collect(), 1 + MOST_ALTERNATIVES)
    }

    fn starts(&self, pairs: &Pairs<'_>, moving: &[Oriented]) -> Vec<Placement> {
        let centroids = [self.fixed.moments.centroid, self.centre];
        let axes = [self.fixed.moments.axes(), self.moments.axes()];
        let origins = self.fixed.origins(&self.moments);
        let mut starts = vec![Placement::centred(
            glam::DMat3::IDENTITY,
            self.scale,
            [origins[1] * self.unit * self.scale - origins[0], DVec3::ZERO],
        )];
        let turned = axis_rotations().map(|r| axes[0] * r * axes[1].transpose());
        let turned = std::iter::once(glam::DMat3::IDENTITY).chain(turned);
        starts.extend(turned.map(|rotation| Placement::centred(rotation, self.scale, centroids)));
        if !self.control.is_stopped() {
            self.tell("comparing pairs of points", 0.1);
            let scaled: Vec<Oriented> =
                moving.iter().map(|p| Oriented { point: p.point * self.scale, ..*p }).collect();
            let voted = voted(pairs, &scaled, self.centre * self.scale, VOTED);
            starts.extend(voted.into_iter().map(|found| Placement { scale: self.scale, ..found }));
        }
        starts
    }

    fn refinement<'p>(&'p self, points: &'p [Oriented]) -> Refinement<'p> {
        let scales = if self.options.scale {
            [self.scale / MOST_GROWTH, self.scale * MOST_GROWTH]
        } else {
            [self.scale; 2]
        };
        Refinement::new(self.fixed.surface(), points, self.centre, scales, self.size)
    }

    /// The best pose of each group of equal ones, in the order of their scores.
    fn distinct(&self, mut found: Vec<Scored>, count: usize) -> Vec<Scored> {
        // Stable, so that equal scores stay in the order of the starts.
        found.sort_by(|a, b| b.score.total_cmp(&a.score));
        let mut kept: Vec<Scored> = Vec::new();
        for scored in found {
            if kept.iter().all(|other| !self.is_same(&scored.placement, &other.placement)) {
                kept.push(scored);
            }
        }
        kept.truncate(count);
        kept
    }

    fn is_same(&self, a: &Placement, b: &Placement) -> bool {
        let apart = a.apply(self.centre).distance(b.apply(self.centre));
        a.angle(b) < SAME_ANGLE && apart < SAME_PLACE * self.size
    }

    fn report(
        &self,
        found: &[Scored],
        points: &[Oriented],
        is_inside_out: bool,
    ) -> Result<Registration, AlignError> {
        let even: Vec<Oriented> = samples(self.moving, &self.moments.frame, LAST_POINTS)
            .into_iter()
            .map(|sample| Oriented::of(sample, self.unit, is_inside_out))
            .collect();
        let mut refinement = self.refinement(&even);
        let Some(best) = found.first() else { return Err(AlignError::Sizes) };
        let as_good = found.iter().filter(|other| other.score >= AS_GOOD * best.score);
        let places: Vec<(Placement, f64)> =
            as_good.map(|other| refinement.last(other.placement, self.options.overlap)).collect();
        let (best, _) = places[0];
        refinement.look(&best);
        let reach = refinement.reach(WIDTH * self.size).max(LEAST_REACH * self.size);
        let scale_deviation = refinement.scale_deviation(&best, places[0].1);
        let spread = refinement.spread(reach);
        // The matched share, and the root mean square distance of the points that determine the fit.
        let mut fit = |(placement, within): &(Placement, f64)| {
            refinement.look(placement);
            let distances = || refinement.matches().iter().map(|found| found.distance);
            let matched = distances().filter(|d| *d <= reach).count() as f64 / even.len() as f64;
            let used = distances().filter(|d| d <= within);
            let (count, sum) = used.fold((0_usize, 0.0), |(count, sum), d| (count + 1, sum + d * d));
            (matched, self.fixed.moments.frame.length_out((sum / count.max(1) as f64).sqrt()))
        };
        let (matched, rms) = fit(&places[0]);
        let mut alternatives = Vec::new();
        for place in &places[1..] {
            let (other, _) = place;
            if !self.is_same(other, &best) {
                let (matched, rms) = fit(place);
                let frame = &self.fixed.moments.frame;
                let screw = Screw::between(&best, other, best.apply(self.centre));
                alternatives.push(Alternative {
                    matrix: self.matrix(other)?,
                    apart_degrees: other.angle(&best).to_degrees(),
                    axis: screw.axis.to_array(),
                    point: frame.unmap(screw.point.to_array()),
                    slide: frame.length_out(screw.slide),
                    matched,
                    rms,
                });
            }
        }
        let none = Placement::centred(glam::DMat3::IDENTITY, 1.0, [DVec3::ZERO; 2]);
        Ok(Registration {
            matrix: self.matrix(&best)?,
            scale: best.scale,
            scale_deviation,
            turn_degrees: best.angle(&none).to_degrees(),
            reach: self.fixed.moments.frame.length_out(reach),
            matched,
            spread,
            fits: matched >= LEAST_MATCHED && spread <= MOST_SPREAD && reach <= MOST_REACH * self.size,
            rms,
            alternatives,
            free_motions: self.free_motions(&best, points, reach),
            stop: self.control.reason().unwrap_or(StopReason::Tolerance),
        })
    }

    fn free_motions(&self, best: &Placement, points: &[Oriented], reach: f64) -> Vec<FreeMotion> {
        let mut refinement = self.refinement(points);
        refinement.look(best);
        let matched: Vec<(DVec3, DVec3)> = points
            .iter()
            .zip(refinement.matches())
            .filter(|(_, found)| found.distance <= reach)
            .map(|(point, _)| (best.apply(point.point), best.pose.rotation * point.normal))
            .collect();
        let about = matched.iter().map(|(p, _)| *p).sum::<DVec3>() / matched.len().max(1) as f64;
        let spread = matched.iter().map(|(p, _)| p.distance_squared(about)).sum::<f64>();
        let radius = (spread / matched.len().max(1) as f64).sqrt();
        if radius.is_nan() || radius <= 0.0 {
            return Vec::new();
        }
        let frame = &self.fixed.moments.frame;
        let free = free_motions(matched.into_iter(), about, radius).into_iter();
        free.map(|motion| FreeMotion {
            point: frame.unmap(about.to_array()),
            turn: motion.turn.to_array(),
            shift: (motion.shift * frame.length_out(radius)).to_array(),
        })
        .collect()
    }

    /// The map in the unit of the meshes.
    fn matrix(&self, placement: &Placement) -> Result<Matrix, AlignError> {
        Ok(matrix(&self.fixed.map_of(&placement.pose, placement.scale, &self.moments, self.unit)?))
    }

    fn tell(&self, doing: &str, share: f64) {
        if let Some(observer) = self.options.progress
            && observer.progress(&Progress { doing, share: Some(share) }).is_break()
        {
            self.control.stop(StopReason::Cancelled);
        }
    }
}
