//! One component: cut into a disk and flattened.

use crate::check::flipped_faces;
use crate::components::{Component, error_in_whole, in_whole};
use crate::cut::{CutStrategy, Opened, first_cut};
use crate::distortion::{all_singular_values, best_scale, singular_values};
use crate::lengthen::{lengthened, with_tips};
use crate::map::{
    Descender, Descent, Start, StartOptions, Weights, as_rigid_as_possible, conformal, start_map,
};
use crate::opened::Disk;
use crate::report::Timing;
use crate::watch::Watch;
use crate::{Charts, FlattenError, FlattenOptions, Method};
use pompeiu_core::FaceId;
use pompeiu_core::run::Instant;
use pompeiu_surface::EdgeData;
use pompeiu_surface::plane::{Vec2, scale};

/// Newton steps for a map that only decides where to cut next.
const STEPS_BETWEEN_CUTS: usize = 12;

/// Share of the time left in which cuts are added, and share of the rest for a map that may cross itself: what is left is for one that may
/// not.
const TIME_FOR_CUTS: f64 = 0.5;
const TIME_UNGUARDED: f64 = 0.4;

/// Tolerances of the predicted decrease of a Newton step, relative to the distortion: between cuts, and at the end.
const ROUGH: f64 = 2e-2;
const FINE: f64 = 4e-3;

/// A component as a flat disk.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    /// Edges of the component that were cut.
    pub(crate) cut: EdgeData<bool>,
    pub(crate) opened: Opened,
    /// The position of each vertex of the opened component.
    pub(crate) uv: Vec<Vec2>,
    pub(crate) weights: Weights,
    pub(crate) rounds: usize,
    pub(crate) steps: usize,
    /// Whether the energy asked for was not reached with all cuts.
    pub(crate) misses_target: bool,
    pub(crate) timing: Timing,
}

impl Chart {
    /// The singular values of the map on each face of its component, with the area of the face.
    pub(crate) fn values(&self, component: &Component) -> Vec<([f64; 2], f64)> {
        let surface = component.surface.surface();
        let value = |(face, corners): (FaceId, &[u32; 3])| {
            (singular_values(surface, face, corners.map(|v| self.uv[v as usize])), surface.face_area(face))
        };
        surface.mesh().face_ids().zip(self.opened.faces()).map(value).collect()
    }
}

/// Flattens a component; `requested` are the edges to cut, if the caller gave them.
pub(crate) fn flatten_component(
    component: &Component,
    requested: Option<EdgeData<bool>>,
    options: &FlattenOptions<'_>,
    watch: &Watch<'_>,
) -> Result<Chart, FlattenError> {
    let began = Instant::now();
    let cut = match requested {
        Some(cut) => cut,
        None => first_cut(component, &component.options(&options.cut))
            .map_err(|error| in_whole(error, component))?,
    };
    let disk = Disk::new(component, &cut).map_err(|error| error_in_whole(error, component))?;
    let timing = Timing { cut: began.elapsed(), ..Timing::default() };
    // From here a map takes at least one linear system: a run whose time is over makes the least that is valid, and says so.
    watch.is_stopped();
    match &options.method {
        Method::Convex { boundary, weights, around } => {
            let mut timing = timing;
            let (weights, around) = (*weights, around.as_ref());
            let partners = disk.partners.as_deref();
            let options = StartOptions { boundary, weights, around, partners, lessens_distortion: false };
            let start = start(&disk, options, component, watch, &mut timing)?;
            let Start { uv, weights, rounds, .. } = start;
            let uv = disk.symmetrized_on(boundary, uv.into_vec())?;
            Ok(Chart {
                cut,
                opened: disk.opened,
                uv,
                weights,
                rounds,
                steps: 0,
                misses_target: false,
                timing,
            })
        }
        Method::Conformal(kind) => {
            let began = Instant::now();
            let uv = disk.symmetrized(conformal(&disk.surface, *kind)?);
            let timing = Timing { solve: began.elapsed(), ..timing };
            let weights = Weights::Cotangent;
            Ok(Chart {
                cut,
                opened: disk.opened,
                uv,
                weights,
                rounds: 0,
                steps: 0,
                misses_target: false,
                timing,
            })
        }
        Method::Rigid { steps } => {
            let mut timing = timing;
            let start = start(&disk, StartOptions::CIRCLE, component, watch, &mut timing)?;
            let began = Instant::now();
            let (uv, steps) = as_rigid_as_possible(disk.surface.surface(), &start.uv, *steps, watch)?;
            let uv = disk.symmetrized(uv);
            timing.solve += began.elapsed();
            let (weights, rounds) = (Weights::Cotangent, start.rounds);
            Ok(Chart { cut, opened: disk.opened, uv, weights, rounds, steps, misses_target: false, timing })
        }
        Method::Free { steps } => {
            let search =
                Search { component, options, watch, cut, cuts: 0, disk, rounds: 0, steps: 0, timing };
            search.run(*steps)
        }
    }
}

/// Searches for maps with a free boundary, and for the cuts that they need.
struct Search<'s, 'o, 'w> {
    component: &'s Component,
    options: &'s FlattenOptions<'o>,
    watch: &'s Watch<'w>,
    cut: EdgeData<bool>,
    cuts: usize,
    disk: Disk,
    rounds: usize,
    steps: usize,
    timing: Timing,
}

impl Search<'_, '_, '_> {
    /// Adds cuts while the energy is above the target, then minimises the energy without letting the outline cross itself.
    ///
    /// While cuts are added, outlines may cross themselves, because only distortion matters. Each map starts from the previous one.
    fn run(mut self, most_steps: usize) -> Result<Chart, FlattenError> {
        let adds_cuts = self.options.cut.strategy == CutStrategy::Auto;
        let most_cuts = if adds_cuts { self.options.most_cuts } else { 0 };
        let target = self.options.chart_target();
        let cutting = self.watch.for_share(TIME_FOR_CUTS);
        let mut descender = self.descender()?;
        let mut begin = Some(self.start()?);
        let mut uv = begin.as_ref().map_or_else(Vec::new, |begin| begin.uv.to_vec());
        loop {
            if most_cuts > 0 {
                let gives_up = self.cuts < most_cuts;
                let rough = Descent {
                    steps: STEPS_BETWEEN_CUTS,
                    tolerance: ROUGH,
                    enough: target,
                    gives_up,
                    is_guarded: false,
                };
                let energy;
                (energy, uv) = self.descend(&descender, uv, &rough, &cutting)?;
                if energy > target && self.add_cuts(most_cuts, &mut uv, &cutting)? {
                    (descender, begin) = (self.descender()?, None);
                    continue;
                }
            }
            let fine = Descent {
                steps: most_steps,
                tolerance: FINE,
                enough: 0.0,
                gives_up: false,
                is_guarded: false,
            };
            let mut found = None;
            if most_cuts > 0 && descender.is_simple(&uv) {
                let unguarded = self.watch.for_share(TIME_UNGUARDED);
                found = Some(self.descend(&descender, uv, &fine, &unguarded)?)
                    .filter(|(_, uv)| descender.is_clear(uv));
            }
            let found = if let Some(found) = found {
                found
            } else {
                let begin = begin.take().map_or_else(|| self.start(), Ok)?;
                let guarded = Descent { is_guarded: true, ..fine };
                self.descend(&descender, begin.uv.into_vec(), &guarded, self.watch)?
            };
            let energy;
            (energy, uv) = found;
            let before = self.settled(&descender, uv.clone())?;
            if energy <= target || !self.add_cuts(most_cuts, &mut uv, &cutting)? {
                let Self { cut, disk, rounds, steps, timing, .. } = self;
                let weights = Weights::MeanValue;
                let misses_target = adds_cuts && energy > target;
                let (opened, uv) = (disk.opened, before);
                return Ok(Chart { cut, opened, uv, weights, rounds, steps, misses_target, timing });
            }
            (descender, begin) = (self.descender()?, None);
        }
    }

    /// The map itself. If a plane of symmetry is given, the mean of it and its mirror image or, if that is not one-to-one, the map
    /// to a circle.
    fn settled(&mut self, descender: &Descender, uv: Vec<Vec2>) -> Result<Vec<Vec2>, FlattenError> {
        if self.disk.partners.is_none() {
            return Ok(uv);
        }
        let mean = self.disk.symmetrized(uv);
        if flipped_faces(self.disk.opened.faces(), &mean).is_empty() && descender.is_simple(&mean) {
            return Ok(mean);
        }
        let start = self.start()?;
        Ok(self.disk.symmetrized(start.uv.into_vec()))
    }

    /// Doubles the number of cuts, up to `most`, or adds one where charts are divided. Returns whether any was added.
    fn add_cuts(&mut self, most: usize, uv: &mut Vec<Vec2>, watch: &Watch<'_>) -> Result<bool, FlattenError> {
        let began = Instant::now();
        // Where charts are divided as well, seams are to be short: one cut at a time.
        let growth = if self.options.charts == Charts::Components { self.cuts } else { 1 };
        let count = most.saturating_sub(self.cuts).min(growth.max(1));
        if count == 0 || watch.is_stopped() {
            return Ok(false);
        }
        let of_component = self.component.options(&self.options.cut);
        let mesh = self.component.surface.mesh();
        let is_sphere = mesh.genus() == 0 && mesh.boundary_loops().is_empty();
        let with_tips =
            (self.cuts == 0 && !is_sphere).then(|| with_tips(self.component, &self.cut, &of_component));
        let longer = with_tips
            .flatten()
            .or_else(|| lengthened(self.component, &self.disk, &self.cut, uv, &of_component, count));
        let Some(longer) = longer else { return Ok(false) };
        let disk = Disk::new(self.component, &longer)?;
        *uv = disk.carried(&self.disk, uv);
        (self.cut, self.disk) = (longer, disk);
        self.cuts += count;
        self.timing.cut += began.elapsed();
        Ok(true)
    }

    fn descender(&mut self) -> Result<Descender, FlattenError> {
        let began = Instant::now();
        let descender = Descender::new(&self.disk.surface)?;
        self.timing.factor += began.elapsed();
        Ok(descender)
    }

    /// A map of the disk to a circle, one-to-one.
    fn start(&mut self) -> Result<Start, FlattenError> {
        let circle = StartOptions::CIRCLE;
        let found = start(&self.disk, circle, self.component, self.watch, &mut self.timing)?;
        self.rounds += found.rounds;
        Ok(found)
    }

    fn descend(
        &mut self,
        descender: &Descender,
        uv: Vec<Vec2>,
        descent: &Descent,
        watch: &Watch<'_>,
    ) -> Result<(f64, Vec<Vec2>), FlattenError> {
        let began = Instant::now();
        let found = descender.descend(uv, descent, watch)?;
        self.steps += found.steps;
        self.timing.factor += found.factor;
        self.timing.solve += began.elapsed().saturating_sub(found.factor);
        Ok((found.energy, found.uv))
    }
}

/// Maps a disk to a convex boundary; if this is the start of a minimisation, at the scale of least symmetric Dirichlet energy.
fn start(
    disk: &Disk,
    options: StartOptions<'_>,
    component: &Component,
    watch: &Watch<'_>,
    timing: &mut Timing,
) -> Result<Start, FlattenError> {
    let found = start_map(&disk.surface, disk.opened.faces(), options, watch);
    let mut found = found.map_err(|error| error_in_whole(error, component))?;
    timing.factor += found.factor;
    timing.solve += found.solve;
    timing.check += found.check;
    if options.lessens_distortion {
        let areas = disk.surface.surface().face_areas();
        let values: Vec<_> =
            all_singular_values(disk.surface.surface(), &found.uv).into_iter().zip(areas).collect();
        let factor = best_scale(&values);
        found.uv.iter_mut().for_each(|p| *p = scale(factor, *p));
    }
    Ok(found)
}
