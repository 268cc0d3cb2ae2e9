//! Remeshing from the input to the report.

mod apart;
mod staying;

use super::anchors::Anchors;
use super::connectivity::DynamicMesh;
use super::features::Curves;
use super::held::{RISKY, is_rough, keep_creases};
use super::isotropic::{finish, iterate};
use super::lengths::NotWithin;
use super::local::Local;
use super::marked::Marked;
use super::places::Places;
use super::quality::Quality;
use super::reference::Reference;
use super::remesh_options::{RemeshError, RemeshOptions, RemeshTiming, Remeshed};
use super::samples::{Avoided, samples};
use super::sizing::{self, Lengths};
use super::triangle::area_vector;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::mesh::Rounding;
use pompeiu_core::run::Instant;
use pompeiu_core::run::{Control, Limits, Progress, StopReason, on_threads};
use pompeiu_hausdorff::HausdorffOptions;

/// Share of the distance that tests of single faces may use; the rest covers their rounding.
const LOCAL_SHARE: f64 = 0.9999;

/// A distance that asks for more than this many times the faces of the input and of the result without it is smaller than what the
/// input's own creases and folds stand out: shorter edges would only follow these.
const MOST_GROWTH: f64 = 2.0;

/// Iterations after which vertices are held where the surface does not reach the input, and how many must follow: each loses a ring of
/// vertices at a tip at most.
const ANCHORED: [usize; 4] = [0, 1, 3, 6];
const AFTER_ANCHORS: usize = 3;

/// In the end angles below the first of these, in degrees, are raised where the surface moves by at most the first share of the target
/// length, then those that are still below the second.
const RAISED: [f64; 2] = [40.0, 28.0];
const MOVED: [f64; 2] = [0.25, 0.5];

/// Times that both what is poor and what intersects is changed in the end: the one may make the other.
const LAST_ROUNDS: usize = 2;

/// Creases at which a distance asks for edges shorter than this many times their target are kept from the start.
const MUCH_SHORTER: f64 = 0.5;

/// Gives a surface new triangles: nearly equilateral, with edges of a wanted length.
///
/// # Shapes and units
/// An oriented manifold mesh, with or without boundary, of any number of components; lengths in its unit.
/// # Definition
/// Each iteration splits edges longer than 4/3 of their target (those of long thin faces first, with flips between), collapses those
/// shorter than 4/5, flips edges towards valence 6, and moves vertices towards the middle of their neighbours in their tangent plane, then
/// to the nearest point of the input. Where the surface folds back, as at the rim of a thin plate, vertices move along the fold only, and
/// collapses leave them where they are. After some iterations vertices are put, and held, where the surface does not reach the input, as at
/// tips that are narrower than edges are long. The last rounds flip and move only. In the end small angles are raised, great distances
/// lowered and faces that intersect parted, at one place after the other. Topology does not change. Boundaries, creases and selected edges stay curves on the curves of
/// the input; their corners and selected vertices stay where they are.
/// # Accuracy
/// What the report says of the distance was measured by [`symmetric_hausdorff`](pompeiu_hausdorff::symmetric_hausdorff), rounding included. With
/// [`within`](RemeshOptions::within) its upper end is at most that length, or there is no result: where faces are farther away,
/// edges of the input are held, and then given up by operations that each keep the distance, with less regular faces.
/// # Limits
/// Lengths are targets. No least angle is promised: at corners of features there may be none, and at the tip of a slender cone it is
/// what the cone allows. Where two sheets are nearer to each
/// other than edges are long they may intersect; see [`self_intersections`](pompeiu_core::spatial::self_intersections).
/// # Errors
/// [`RemeshError`].
/// # Cost
/// O(m log m) for each iteration over m faces of input and result; some 250 bytes per face of the larger one.
/// # Source
/// The loop and its bounds: `botsch_remeshing_2004`. Lengths from a chord height: `dunyach_adaptive_2013`.
/// # Example
/// ```
/// use pompeiu_core::mesh::shapes::icosphere;
/// use pompeiu_remesh::{RemeshOptions, Sizing, remesh};
///
/// let sphere = icosphere(1.0, 3)?;
/// let found = remesh(&sphere, &RemeshOptions::new(Sizing::Length(0.1)))?;
/// assert!(found.after.least_angle.least > 35.0);
/// assert!(found.distance.is_some_and(|d| d.distance.upper() < 0.01));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn remesh(mesh: &TriMesh, options: &RemeshOptions<'_>) -> Result<Remeshed, RemeshError> {
    on_threads(options.limits.threads, || Work::new(mesh, options)?.run())
}

struct Work<'w> {
    input: &'w TriMesh,
    options: &'w RemeshOptions<'w>,
    control: Control,
    started: Instant,
    frame: Frame,
    places: Places,
    rounding: Rounding,
    before: Quality,
    /// The input, cut finer where lengths vary within its faces.
    copy: Marked,
    reference: Reference<'w>,
    surface: Marked,
    /// The input with the lengths that were asked for, where a distance is kept.
    first: Option<Marked>,
    /// Whether that distance asks for shorter edges than the faces of the input have.
    is_rough: bool,
    /// Where faces of a result intersected.
    avoided: Avoided,
    /// The surface before its angles were raised and its distance was lowered.
    unimproved: Option<Marked>,
    iterations: usize,
}

impl<'w> Work<'w> {
    fn new(mesh: &'w TriMesh, options: &'w RemeshOptions<'w>) -> Result<Self, RemeshError> {
        let started = Instant::now();
        let aabb = Aabb::of_faces(mesh);
        options.check(aabb.diagonal(), mesh.positions().len())?;
        let frame = Frame::of(&aabb);
        let places = Places { frame, grid: options.coordinates.within(&aabb) };
        let rounding = places.grid.rounding(mesh);
        if let Some(within) = options.within {
            rounding.check(within)?;
        }
        let mut dynamic = DynamicMesh::new(mesh.positions(), mesh.faces())?;
        dynamic.map_positions(|p| frame.map(p));
        let before = Quality::in_frame(&dynamic, &frame, None);
        let curves = Curves::find(&dynamic, &options.features);
        let (curve, hold) = (curves.of_halfedge, curves.hold);
        let mut copy = Marked { curve, hold, length: Vec::new(), near: Vec::new(), mesh: dynamic };
        let mut lengths = Lengths::new(&options.sizing, &copy, &frame);
        let mut at_vertices = lengths.at_vertices(&copy.mesh.positions, &frame);
        if let Some(v) = at_vertices.iter().position(|x| !(*x > 0.0 && *x < f64::INFINITY)) {
            let (length, position) = (frame.length_out(at_vertices[v]), mesh.positions()[v]);
            return Err(RemeshError::Field { length, position });
        }
        let mut first = None;
        if let Some(within) = options.within {
            first = Some(Marked { length: at_vertices.clone(), ..copy.clone() });
            let chords = |lengths: &[f64], copy: &Marked| {
                sizing::no_longer_than_chords(lengths.to_vec(), frame.length_in(within), copy)
            };
            let mut short = chords(&at_vertices, &copy);
            // Creases that would need much shorter edges are kept instead.
            let is_short: Vec<bool> = short
                .iter()
                .zip(&at_vertices)
                .map(|(chord, wanted)| *chord < MUCH_SHORTER * wanted)
                .collect();
            if options.features.angle.is_none() && keep_creases(&mut copy, &options.features, &is_short) {
                short = chords(&at_vertices, &copy);
            }
            at_vertices = short;
            lengths = Lengths::AtVertices(at_vertices.clone());
        }
        let asked = first.as_ref().map_or(&at_vertices, |first| &first.length);
        let mean = frame.length_out(asked.iter().sum::<f64>() / asked.len() as f64);
        places.grid.check_edges(&aabb, mean)?;
        let faces = expected_faces(&copy.mesh, asked);
        if faces > options.most_faces as f64 {
            return Err(RemeshError::TooManyFaces { faces, most: options.most_faces });
        }
        let enough = MOST_GROWTH * (faces + mesh.faces().len() as f64);
        let is_rough = first.as_ref().is_some_and(|first| {
            let within = options.within.map_or(f64::INFINITY, |within| frame.length_in(within));
            expected_faces(&copy.mesh, &at_vertices) > enough || is_rough(first, RISKY * within)
        });
        copy.length = at_vertices;
        let reference = Reference::new(&copy, frame, lengths)?;
        copy.near = reference.slots_at_vertices(copy.mesh.positions.len());
        let surface = copy.clone();
        let control = Control::start(&options.limits);
        Ok(Self {
            input: mesh,
            options,
            control,
            started,
            frame,
            places,
            rounding,
            before,
            copy,
            reference,
            surface,
            first,
            is_rough,
            avoided: Avoided::default(),
            unimproved: None,
            iterations: 0,
        })
    }

    fn run(mut self) -> Result<Remeshed, RemeshError> {
        match self.options.within {
            None => self.iterate(self.options.iterations)?,
            Some(within) => self.come_within(LOCAL_SHARE * self.frame.length_in(within))?,
        }
        let (mesh, intersections) = self.result()?;
        let stop = self.control.reason().unwrap_or(StopReason::Tolerance);
        let shares: Vec<f64> = self.surface.mesh.edges().map(|h| self.surface.share_sq(h).sqrt()).collect();
        let after = Quality::in_frame(&self.surface.mesh, &self.frame, Some(&shares));
        let [volume_before, volume_after] = [&self.copy, &self.surface].map(|of| of.mesh.volume());
        let volume_share = volume_before.zip(volume_after).map(|(before, after)| after / before);
        let kept = self.surface.kept();
        let remeshing = self.started.elapsed();
        // What is to be proven is, whatever the time; what is only told ends with the time.
        let is_told = self.options.measure && self.control.reason().is_none();
        let wanted = is_told || self.options.within.is_some();
        let time = self.options.limits.time.filter(|_| self.options.within.is_none());
        let limits = Limits {
            time: time.map(|time| time.saturating_sub(self.started.elapsed())),
            ..Limits::default()
        };
        let measuring = HausdorffOptions { limits, ..HausdorffOptions::default() };
        let distance = if wanted { measuring.symmetric(self.input, &mesh).ok() } else { None };
        if let (Some(asked), Some(found)) = (self.options.within, &distance) {
            NotWithin::check(asked, found)?;
        }
        let timing =
            RemeshTiming { remesh: remeshing, distance: self.started.elapsed().saturating_sub(remeshing) };
        Ok(Remeshed {
            mesh,
            kept,
            before: self.before,
            after,
            distance,
            volume_share: volume_share.filter(|share| share.is_finite()),
            rounding: self.rounding,
            intersections,
            iterations: self.iterations,
            stop,
            timing,
        })
    }

    /// Some iterations, and the last rounds.
    fn iterate(&mut self, count: usize) -> Result<(), RemeshError> {
        let reference = self.options.project.then_some(&self.reference);
        let mut samples = if reference.is_some() { samples(&self.copy) } else { Vec::new() };
        samples.retain(|sample| !self.avoided.is_near(sample));
        let mut anchors = Anchors::new(&samples);
        for i in 0..count {
            self.report("remeshing", i as f64 / count as f64);
            if self.control.is_stopped() {
                break;
            }
            iterate(&mut self.surface, reference, self.options.most_faces, &self.control)
                .map_err(|_| self.too_many())?;
            self.iterations += 1;
            if reference.is_some() && ANCHORED.contains(&i) && i + AFTER_ANCHORS < count {
                anchors.hold_far(&mut self.surface)?;
            }
        }
        if !self.control.is_stopped() {
            finish(&mut self.surface, reference);
        }
        anchors.release(&mut self.surface);
        if let Some(reference) = reference.filter(|_| !self.control.is_stopped()) {
            let mut before = self.surface.clone();
            let mut local = Local::new(&mut self.surface, reference, &self.control);
            local.raise_angles(RAISED[0], MOVED[0]);
            local.lower_distance(&samples)?;
            for _ in 0..LAST_ROUNDS {
                local.raise_angles(RAISED[1], MOVED[1]);
                local.untangle()?;
            }
            self.places.settle(&mut before.mesh);
            self.unimproved = Some(before);
        }
        self.places.settle(&mut self.surface.mesh);
        Ok(())
    }

    fn too_many(&self) -> RemeshError {
        let most = self.options.most_faces;
        match self.options.within {
            Some(distance) => RemeshError::TooManyFacesWithin { distance, most },
            None => RemeshError::TooManyFaces { faces: most as f64, most },
        }
    }

    fn report(&self, doing: &str, share: f64) {
        let shown = Progress { doing, share: Some(share) };
        if self.options.progress.is_some_and(|observer| observer.progress(&shown).is_break()) {
            self.control.stop(StopReason::Cancelled);
        }
    }
}

/// Number of equilateral faces with edges of the target length that have the area of the surface.
fn expected_faces(mesh: &DynamicMesh, lengths: &[f64]) -> f64 {
    let of_face = |f: u32| {
        let corners = mesh.corners(f);
        let area = 0.5 * area_vector(corners.map(|v| mesh.positions[v as usize])).length();
        let density: f64 = corners.iter().map(|&v| lengths[v as usize].powi(-2)).sum();
        area * density / 3.0
    };
    (0..mesh.face_count() as u32).map(of_face).sum::<f64>() * 4.0 / 3.0_f64.sqrt()
}
