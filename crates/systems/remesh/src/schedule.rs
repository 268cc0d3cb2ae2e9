//! The least distance at a given number of faces: a distance that grows until the number is reached.

use super::collapses::{Collapses, Snapshot};
use super::cover::Cover;
use super::marked::Marked;
use super::simplify_options::{Simplified, SimplifyError, SimplifyTarget, SimplifyTiming};
use super::simplify_run::{Run, Verdict};
use pompeiu_core::geom::Aabb;
use pompeiu_core::run::Instant;
use pompeiu_core::spatial::bvh::Bvh;
use pompeiu_hausdorff::{HausdorffOptions, Tolerance};

/// By how much the distance grows from one pass over the edges to the next.
const GROWTH: f64 = 1.1;

/// The schedule starts from a surface of so many times the faces asked for that quadric errors made, the coarsest that is near enough.
const SEEDS: [usize; 3] = [16, 8, 4];

/// What the first distance of the schedule is at least, in that of the surface it starts from.
const ABOVE_SEED: f64 = 1.1;

/// The first distance of the schedule in that of quadric errors at the number of faces: the largest, and the least, of each attempt. The
/// next attempt is made where the one before reached the number of faces in its first pass.
const ATTEMPTS: [(f64, f64); 3] = [(0.3, 0.2), (0.1, 0.07), (0.03, 0.02)];

/// Below this share of the diagonal quadric errors are exact, but for rounding.
const EXACT: f64 = 1e-9;

/// How exactly the distance of a seed is measured.
const SEED_TOLERANCE: Tolerance = Tolerance::RelativeToDistance(0.05);

/// A surface to start from, with its distance once that is measured.
type Seed = (Snapshot, Option<f64>);

/// Surfaces to start from, and a result for each target.
type ByError = (Vec<Seed>, Vec<Simplified>);

/// A result for each target, none where it was not reached, and in how many passes the first was.
type Grown = (Vec<Option<Simplified>>, usize);

/// For each number of faces, the finest first, the better of two results: by quadric errors alone, and by a schedule of distances.
pub(super) fn levels(
    run: &Run<'_>,
    bvh: &Bvh,
    surface: impl Fn() -> Result<Marked, SimplifyError>,
    targets: &[SimplifyTarget],
    started: Instant,
) -> Result<Vec<Simplified>, SimplifyError> {
    let input = surface()?;
    let start = || Ok(Collapses::by_error(input.clone(), run.places));
    let found = by_error(run, start()?, targets, started)?;
    let keeps_apart = found.is_none();
    let (seeds, by_error) = if let Some(found) = found {
        found
    } else {
        by_error(run, run.kept_apart(start, targets)?, targets, started)?.unwrap_or_default()
    };
    let exact = EXACT * Aabb::of_faces(run.mesh).diagonal();
    let is_exact = by_error.iter().all(|found| upper(found) <= exact);
    let mut by_distance = Vec::new();
    if !is_exact && !run.control.is_stopped() {
        by_distance = Schedule { run, bvh, input, seeds, targets, by_error: &by_error, keeps_apart }.run()?;
    }
    by_distance.resize_with(by_error.len(), || None);
    by_error.into_iter().zip(by_distance).map(|(one, other)| better(run, one, other)).collect()
}

/// Simplifies by quadric errors alone; keeps surfaces to start from, the coarsest first. None where faces of a result intersect that can be
/// kept apart.
fn by_error(
    run: &Run<'_>,
    mut work: Collapses<'_>,
    targets: &[SimplifyTarget],
    mut started: Instant,
) -> Result<Option<ByError>, SimplifyError> {
    let all = work.surface.mesh.face_count();
    let finest = targets.first().map_or(1, faces_of);
    let mut seeds = Vec::new();
    for faces in SEEDS.map(|times| finest.saturating_mul(times)).into_iter().filter(|n| *n < all) {
        work.leave_faces(faces);
        work.run(&run.control, run.options.progress);
        seeds.insert(0, (work.snapshot(), None));
    }
    let mut found = Vec::with_capacity(targets.len());
    for &target in targets {
        work.leave_faces(faces_of(&target));
        work.run(&run.control, run.options.progress);
        let Verdict::May(intersections) = run.judge(&work)? else { return Ok(None) };
        found.push(Simplified { intersections, ..run.measured(&work, target, started)? });
        started = Instant::now();
    }
    Ok(Some((seeds, found)))
}

fn faces_of(target: &SimplifyTarget) -> usize {
    match *target {
        SimplifyTarget::Faces(n) => n,
        SimplifyTarget::Within(_) => usize::MAX,
    }
}

fn upper(found: &Simplified) -> f64 {
    found.distance.distance.upper()
}

/// The result that is nearer to the input and has no faces that are to be refused.
fn better(run: &Run<'_>, one: Simplified, other: Option<Simplified>) -> Result<Simplified, SimplifyError> {
    let Some(other) = other else { return run.guarded(one) };
    let distance = one.timing.distance + other.timing.distance;
    let collapse = one.timing.collapse + other.timing.collapse;
    let falls_short = one.mesh.faces().len() > faces_of(&one.target);
    let (first, second) =
        if falls_short || upper(&other) < upper(&one) { (other, one) } else { (one, other) };
    let found = run.guarded(first).or_else(|refused| run.guarded(second).map_err(|_| refused))?;
    let stop = run.control.reason().unwrap_or(found.stop);
    Ok(Simplified { stop, timing: SimplifyTiming { collapse, distance }, ..found })
}

/// What the schedule is made from.
struct Schedule<'s> {
    run: &'s Run<'s>,
    bvh: &'s Bvh,
    input: Marked,
    /// Surfaces to start from, the coarsest first, with their distances once measured; the last resort is the input.
    seeds: Vec<Seed>,
    targets: &'s [SimplifyTarget],
    by_error: &'s [Simplified],
    /// Whether faces that do not intersect are kept apart all the time.
    keeps_apart: bool,
}

impl<'s> Schedule<'s> {
    /// A result for each target; none where quadric errors alone do as well, or time ran out.
    fn run(mut self) -> Result<Vec<Option<Simplified>>, SimplifyError> {
        let to_beat = self.by_error.first().map_or(0.0, upper);
        let mut found = Vec::new();
        for (most, least) in ATTEMPTS {
            let mut of_attempt = self.attempt(most * to_beat, least * to_beat)?;
            if of_attempt.is_none() {
                self.keep_apart()?;
                of_attempt = self.attempt(most * to_beat, least * to_beat)?;
            }
            let Some((results, passes)) = of_attempt else { break };
            found = results;
            if passes > 1 || self.run.control.is_stopped() {
                break;
            }
        }
        Ok(found)
    }

    /// From now on faces that do not intersect are kept apart, and only surfaces without such faces are started from.
    fn keep_apart(&mut self) -> Result<(), SimplifyError> {
        self.keeps_apart = true;
        let mut apart = Vec::with_capacity(self.seeds.len());
        for seed in std::mem::take(&mut self.seeds) {
            if !self.run.intersects(&seed.0.surface)? {
                apart.push(seed);
            }
        }
        self.seeds = apart;
        Ok(())
    }

    /// Results with a first distance between two lengths; none where faces of one intersect that can be kept apart.
    fn attempt(&mut self, most: f64, least: f64) -> Result<Option<Grown>, SimplifyError> {
        let (work, distance) = self.start(most, least)?;
        let mut work = if self.keeps_apart { work.keeping_apart() } else { work };
        self.grow(&mut work, distance)
    }

    /// The coarsest surface that is near enough to the input, and the first distance.
    fn start(&mut self, most: f64, least: f64) -> Result<(Collapses<'s>, f64), SimplifyError> {
        let (Run { mesh, places, .. }, bvh) = (self.run, self.bvh);
        while let Some((seed, known)) = self.seeds.first_mut() {
            let own = if let Some(distance) = *known {
                distance
            } else {
                let measuring = self.run.measuring(self.run.options.target);
                let options = HausdorffOptions { tolerance: SEED_TOLERANCE, ..measuring };
                let seed = self.run.mesh_of(&seed.surface)?;
                // The tolerance makes sense, so the options do.
                options.symmetric(mesh, &seed).map_or(f64::INFINITY, |found| found.distance.upper())
            };
            *known = Some(own);
            if ABOVE_SEED * own <= most {
                let distance = if ABOVE_SEED * own > least { ABOVE_SEED * own } else { least };
                let limit = places.frame.length_in(distance);
                if let Some(cover) = Cover::of(&seed.surface.mesh, &self.input.mesh, bvh, limit)? {
                    return Ok((Collapses::on(seed.clone(), Some((cover, bvh)), *places), distance));
                }
            }
            // Nor is it near enough for a lesser distance.
            self.seeds.remove(0);
        }
        Ok((Collapses::within(self.input.clone(), bvh, *places), least))
    }

    /// Collapses edges within a distance that grows until each number of faces is reached; the results, and in how many passes the first
    /// was reached. None where faces of one intersect that can be kept apart.
    fn grow(&self, work: &mut Collapses<'_>, mut distance: f64) -> Result<Option<Grown>, SimplifyError> {
        let mut started = Instant::now();
        let (mut found, mut passes, mut in_first) = (Vec::new(), 0, usize::MAX);
        for (&target, by_error) in self.targets.iter().zip(self.by_error) {
            let faces = faces_of(&target);
            work.leave_faces(faces);
            while work.surface.mesh.face_count() > faces
                && distance <= upper(by_error)
                && !self.run.control.is_stopped()
            {
                work.grow_to(self.run.places.frame.length_in(distance));
                work.run(&self.run.control, self.run.options.progress);
                passes += 1;
                distance *= GROWTH;
            }
            let reached = work.surface.mesh.face_count() <= faces;
            if reached {
                let Verdict::May(intersections) = self.run.judge(work)? else { return Ok(None) };
                in_first = in_first.min(passes);
                let result = self.run.measured(work, target, started)?;
                found.push(Some(Simplified { intersections, ..result }));
            } else {
                found.push(None);
            }
            started = Instant::now();
        }
        Ok(Some((found, in_first)))
    }
}
