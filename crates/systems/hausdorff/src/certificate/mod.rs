//! Certificates: files from which `pompeiu-verify` proves a distance anew, from nothing but the meshes.
//!
//! Nothing of the search is recorded. Given `upper`, a second pass over A finds for every face a tree of cuts whose leaves a face of B
//! is near, each leaf by the verifier's own test, so that a certificate that is written is accepted on any machine. So the
//! answer of any method is certified, whatever limits ended it, and any length that is shown some other way to be an upper bound.
//! The witness of the lower end is taken from the report, and its distance from each face of B measured again.
//!
//! What is written is described byte by byte in the guide, and checked by [`pompeiu_verify`].

mod answer;
mod chord;
mod encode;
mod face;
mod few;
mod of_request;

pub use answer::{AttachedProof, CertificateAnswer};

use crate::engine::bytes_to_start;
use crate::report::{DirectedReport, SymmetricReport};
use crate::tolerance::OptionError;
use face::{Scene, Trees, Unfinished};
use flate2::Compression;
use flate2::write::GzEncoder;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::request::hexadecimal;
use pompeiu_core::run::{Control, Limits, StopReason, on_threads};
use pompeiu_core::spatial::{Bvh, Leaves, Neighbours, Slot, Workspace};
use pompeiu_verify::kernel::Facet;
use pompeiu_verify::{BLOCK, MAGIC, Pair, Soup, Witness};
use rayon::prelude::*;
use std::io::{self, Write};
use std::ops::Range;

/// What a certificate is to prove of one direction, in the unit of the meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// The upper end.
    pub upper: f64,
    /// A point of the mesh that distances are measured from, by its face and weights, and how far it is at least; without one, the
    /// lower end is 0.
    pub witness: Option<(u32, [f64; 3], f64)>,
}

impl Goal {
    /// The slack that decides nearly every pair, as a fraction of the joint diagonal: with none, rounding hides now and then that the upper
    /// end of a report holds.
    pub const SLACK: f64 = 1e-12;

    /// That no point is farther than this.
    pub const fn within(upper: f64) -> Self {
        Self { upper, witness: None }
    }

    /// Both ends of a report, the upper one raised by `slack`: the more, the shorter the certificate.
    pub fn of(report: &DirectedReport, slack: f64) -> Self {
        let from = &report.witness.from;
        let upper = if slack > 0.0 { report.distance.upper() + slack } else { report.distance.upper() };
        Self { upper, witness: Some((from.face.0, from.barycentric, report.distance.lower())) }
    }

    /// The goals of both directions.
    pub fn of_both(report: &SymmetricReport, slack: f64) -> [Option<Self>; 2] {
        [Some(Self::of(&report.a_to_b, slack)), Some(Self::of(&report.b_to_a, slack))]
    }
}

/// How much a certificate may take.
#[derive(Clone, Debug, Default)]
pub struct CertificateOptions {
    /// Time, threads, memory and cancelling. The limit on pieces is that on the cells of one face.
    pub limits: Limits,
}

impl CertificateOptions {
    /// Cells of one face, where there is no other limit: far more than honest claims need, soon reached by others.
    fn most_cells(&self, faces: usize) -> u64 {
        const LEAST: u64 = 1 << 12;
        const FOR_EACH: u64 = 64;
        self.limits.pieces.map_or(LEAST + FOR_EACH * faces as u64, |most| most as u64)
    }
}

/// The bound that a certificate proves of one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Certified {
    /// The lower end: below that of the report by the rounding of the verifier.
    pub lower: f64,
    /// The upper end.
    pub upper: f64,
    /// Convex polygons that the mesh was cut into.
    pub cells: u64,
}

/// A certificate that was written.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Certificate {
    /// The bound that it proves of h(A, B).
    pub a_to_b: Option<Certified>,
    /// The bound that it proves of h(B, A).
    pub b_to_a: Option<Certified>,
    /// Its bytes.
    pub bytes: u64,
    /// SHA-256 of the triangles of A and of B, in hexadecimal digits.
    pub sha256: [String; 2],
}

/// Why no certificate was written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CertificateError {
    /// The file could not be written.
    #[error("the certificate cannot be written: {0}")]
    Io(#[from] io::Error),
    /// A face could not be shown to be within the upper end.
    #[error(
        "face {face} {} is not shown to be within {upper} of the other mesh: some point of it is farther, or rounding hides that none is; \
         a little more slack decides it",
        if *.is_reversed { "of B" } else { "of A" }
    )]
    Far {
        /// The face.
        face: usize,
        /// Whether it is a face of B, whose distances from A are meant.
        is_reversed: bool,
        /// The upper end.
        upper: f64,
    },
    /// A face needs more cells than allowed.
    #[error("face {face} {} needs more than {most} cells; a little more slack makes them fewer", if *.is_reversed { "of B" } else { "of A" })]
    Cells {
        /// The face.
        face: usize,
        /// Whether it is a face of B.
        is_reversed: bool,
        /// Cells of one face, at most.
        most: u64,
    },
    /// The upper end is not a finite length, or too small beside the meshes to be computed with.
    #[error("no certificate can be made for an upper end of {0}")]
    Upper(f64),
    /// Faces of a mesh were left out of the answer.
    #[error(
        "a certificate is about all triangles of both meshes, but some were left out; write what is to be measured as a mesh of its own"
    )]
    Parts,
    /// An option that cannot be used.
    #[error(transparent)]
    Option(#[from] OptionError),
    /// A limit was reached.
    #[error("the certificate was given up, for the limit on {} was reached", .0.name())]
    Stopped(StopReason),
}

/// Writes a certificate of what is asked of h(A, B) and of h(B, A), piece by piece.
///
/// # Errors
/// [`CertificateError`]; what was written by then is no certificate.
///
/// # Cost
/// A tree over each mesh, and a walk over the faces of the other. Memory: the trees, four bytes for each vertex, and some blocks
/// of the certificate for each thread.
pub fn write_certificate(
    a: &TriMesh,
    b: &TriMesh,
    goals: [Option<Goal>; 2],
    options: &CertificateOptions,
    into: &mut (dyn Write + Send),
) -> Result<Certificate, CertificateError> {
    let control = Control::start(&options.limits);
    let [soup_a, soup_b] = [a, b].map(|mesh| Soup::new(mesh.positions(), mesh.faces()));
    let Some(soups) = soup_a.zip(soup_b).map(|(a, b)| [a, b]) else {
        return Err(CertificateError::Upper(f64::NAN));
    };
    on_threads(options.limits.threads, || {
        let (hash_a, hash_b) = rayon::join(|| soups[0].hash(), || soups[1].hash());
        let mut into = Counting { into, bytes: 0 };
        into.write_all(MAGIC)?;
        into.write_all(&hash_a)?;
        into.write_all(&hash_b)?;
        into.write_all(&[u8::from(goals[0].is_some()) + 2 * u8::from(goals[1].is_some())])?;
        let mut certified = [None; 2];
        for (direction, goal) in goals.into_iter().enumerate() {
            let Some(goal) = goal else { continue };
            let (from, to) = if direction == 0 { (0, 1) } else { (1, 0) };
            let meshes = [[a, b][from], [a, b][to]];
            let needed = bytes_to_start(meshes[0], meshes[1]);
            let writer = Writer {
                meshes,
                pair: Pair::new(&soups[from], &soups[to]),
                control: &control,
                has_room: options.limits.memory.is_none_or(|most| needed <= most),
                most_cells: options.most_cells([a, b][to].faces().len()),
                is_reversed: direction == 1,
            };
            certified[direction] = Some(writer.write(goal, &mut into)?);
        }
        Ok(Certificate {
            a_to_b: certified[0],
            b_to_a: certified[1],
            bytes: into.bytes,
            sha256: [hexadecimal(&hash_a), hexadecimal(&hash_b)],
        })
    })
}

/// Packs what is written as gzip: regular meshes have certificates of which much repeats. The bytes are those of the packed file.
///
/// # Errors
/// Those of `fill`, and of what is written to.
pub fn write_packed(
    into: &mut (dyn Write + Send),
    fill: impl FnOnce(&mut (dyn Write + Send)) -> Result<Certificate, CertificateError>,
) -> Result<Certificate, CertificateError> {
    let mut packed = GzEncoder::new(Counting { into, bytes: 0 }, Compression::default());
    let made = fill(&mut packed)?;
    let bytes = packed.finish()?.bytes;
    Ok(Certificate { bytes, ..made })
}

/// Counts the bytes that pass.
struct Counting<'w> {
    into: &'w mut (dyn Write + Send),
    bytes: u64,
}

impl Write for Counting<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.into.write(bytes)?;
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.into.flush()
    }
}

/// One direction.
struct Writer<'w> {
    meshes: [&'w TriMesh; 2],
    pair: Pair<'w>,
    control: &'w Control,
    /// Whether the memory limit leaves room for trees.
    has_room: bool,
    most_cells: u64,
    is_reversed: bool,
}

/// Vertices whose nearest faces are found by one task.
const TASK: usize = 1 << 11;
/// Blocks for each thread that are made before they are written.
const WAVE: usize = 4;
/// Faces of B are known by their neighbours where `upper` is smaller than this part of the mean side of a face.
const FINE: f64 = 0.1;

impl Writer<'_> {
    fn write(&self, goal: Goal, into: &mut Counting<'_>) -> Result<Certified, CertificateError> {
        let upper = self.pair.length(goal.upper);
        if !(0.0..f64::INFINITY).contains(&upper) {
            return Err(CertificateError::Upper(goal.upper));
        }
        let (face, weights, lower) = goal.witness.unwrap_or((0, [1.0, 0.0, 0.0], 0.0));
        let lower = self.lower(Witness { face, weights }, lower);
        for number in [lower, goal.upper] {
            into.write_all(&number.to_le_bytes())?;
        }
        into.write_all(&face.to_le_bytes())?;
        for weight in weights {
            into.write_all(&weight.to_le_bytes())?;
        }

        let cells =
            if self.has_room { self.with_trees(upper, goal.upper, into)? } else { self.by_few(upper, into)? };
        Ok(Certified { lower, upper: goal.upper, cells })
    }

    /// Writes the blocks by trees over B; the number of cells. `asked` is the upper end in the unit of the meshes.
    fn with_trees(&self, upper: f64, asked: f64, into: &mut Counting<'_>) -> Result<u64, CertificateError> {
        let [a, b] = self.meshes;
        let b_box = Aabb::of_faces(b);
        let frame = Frame::of(&Aabb::of_faces(a).union(b_box));
        if self.control.is_stopped() {
            return Err(self.stopped());
        }
        let bvh = Bvh::build_unless_stopped(b, &b_box, &frame, Leaves::Compact, self.control)
            .ok_or_else(|| self.stopped())?;
        let near = nearest(a, &bvh, &frame);
        let neighbours = (upper < FINE * mean_side(a)).then(|| Neighbours::new(b, &bvh));
        let scene = Scene {
            pair: &self.pair,
            frame: &frame,
            bvh: &bvh,
            neighbours: neighbours.as_ref(),
            faces: a.faces(),
            near: &near,
            upper,
            most_cells: self.most_cells,
        };
        let failure = |unfinished| self.failure(unfinished, asked);
        self.blocks(|faces| Trees::new(scene).block(faces).map_err(failure), into)
    }

    /// Writes the blocks by the faces of B that the coarse method looks at.
    fn by_few(&self, upper: f64, into: &mut Counting<'_>) -> Result<u64, CertificateError> {
        let few: Vec<u32> = crate::coarse::few_of(self.meshes[1]).map(|face| face as u32).collect();
        let failure = |_| CertificateError::Stopped(StopReason::Memory);
        self.blocks(|faces| few::block(&self.pair, &few, upper, faces).map_err(failure), into)
    }

    /// Makes blocks and writes them in order; the number of cells.
    fn blocks(
        &self,
        make: impl Fn(Range<usize>) -> Result<(Vec<u8>, u64), CertificateError> + Sync,
        into: &mut Counting<'_>,
    ) -> Result<u64, CertificateError> {
        let count = self.meshes[0].faces().len();
        let blocks: Vec<usize> = (0..count).step_by(BLOCK).collect();
        let mut cells = 0;
        for wave in blocks.chunks(WAVE * rayon::current_num_threads()) {
            if self.control.is_stopped() {
                return Err(self.stopped());
            }
            let made: Vec<_> = wave.par_iter().map(|&first| make(first..count.min(first + BLOCK))).collect();
            for block in made {
                let (bytes, more) = block?;
                let length =
                    u32::try_from(bytes.len()).map_err(|_| io::Error::from(io::ErrorKind::FileTooLarge))?;
                into.write_all(&length.to_le_bytes())?;
                into.write_all(&bytes)?;
                cells += more;
            }
        }
        Ok(cells)
    }

    fn stopped(&self) -> CertificateError {
        CertificateError::Stopped(self.control.reason().unwrap_or(StopReason::Cancelled))
    }

    fn failure(&self, unfinished: Unfinished, upper: f64) -> CertificateError {
        let (is_reversed, most) = (self.is_reversed, self.most_cells);
        match unfinished {
            Unfinished::Far(face) => CertificateError::Far { face, is_reversed, upper },
            Unfinished::Cells(face) => CertificateError::Cells { face, is_reversed, most },
        }
    }

    /// The greatest lower end up to `claimed` that the verifier's test shows from this witness.
    fn lower(&self, witness: Witness, claimed: f64) -> f64 {
        let enough = self.pair.length(claimed);
        let Some((x, origin)) = self.pair.witness(&witness).filter(|_| enough > 0.0) else { return 0.0 };
        let bound = |f: usize| Facet::new(self.pair.b.triangle(f), origin).at_least(&x, enough);
        let lesser = |x: f64, y: f64| if y < x { y } else { x };
        let faces = (0..self.meshes[1].faces().len()).into_par_iter().with_min_len(BLOCK);
        let shown = faces.map(bound).reduce(|| enough, lesser);
        let lower = self.pair.unscaled(shown);
        // Between powers of two that leave the range of doubles a length may not be exact.
        if shown > 0.0 && self.pair.length(lower) <= shown { lower } else { 0.0 }
    }
}

/// A face of B that is nearest to each vertex of A.
fn nearest(a: &TriMesh, bvh: &Bvh, frame: &Frame) -> Vec<Slot> {
    let mut near = vec![bvh.any_slot(); a.positions().len()];
    near.par_chunks_mut(TASK).zip(a.positions().par_chunks(TASK)).for_each(|(near, positions)| {
        let (mut workspace, mut last) = (Workspace::default(), bvh.any_slot());
        for (slot, p) in near.iter_mut().zip(positions) {
            last = bvh.nearest(frame.map(*p), last, &mut workspace).slot;
            *slot = last;
        }
    });
    near
}

/// The mean length of the first sides of some faces.
fn mean_side(a: &TriMesh) -> f64 {
    const SOME: usize = 1000;
    let faces = a.face_ids().step_by(a.faces().len().div_ceil(SOME));
    let count = faces.len() as f64;
    faces
        .map(|f| {
            let [p, q, _] = a.corners(f);
            ((p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2) + (p[2] - q[2]).powi(2)).sqrt() / count
        })
        .sum()
}
