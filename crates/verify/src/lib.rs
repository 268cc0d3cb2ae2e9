//! Checks a certificate of the Pompeiu–Hausdorff distance: that `lower <= h(A, B) <= upper`, from the certificate and the two
//! meshes alone.
//!
//! # Definition
//! A and B are lists of triangles, of any shape, with corners that are doubles; the sets are the unions of the triangles.
//! `h(A, B)` is the largest distance of a point of A from B. All numbers are exact reals; a claim is two doubles.
//!
//! # Theorem
//! If [`verify`] accepts a certificate, each of its claims holds for the two lists of triangles that it was given.
//!
//! # Proof
//! *Upper end.* Let `phi` be the affine map of a triangle in the plane onto a face T of A; T may have no area. A tree starts with
//! the polygon that is this triangle. A chord between points of two sides of a convex polygon parts it into two convex polygons
//! whose union it is ([`kernel::part`]), wherever on the sides the points lie; the ends are `(1 - t) p + t q` with `t` in [0, 1)
//! *by definition*, so that nothing is rounded. By induction the leaves' polygons have the triangle as their union, and their
//! images T. On a leaf with face F of B, `x -> d(x, F)` is convex, and a convex function on a polygon is greatest at a corner. Each
//! corner is shown to be within `upper` of F ([`kernel::Facet::at_most`]): the distance from F is at most that from any point of
//! it. As d(x, B) is at most d(x, F), every point of T is within `upper` of B. A tree is read for each face of A.
//!
//! A carving names a face F of B and some of its sides. Its chords are where the polygon's corners change the side of a plane, by
//! arithmetic that may be as wrong as it likes: *some* `t` in [0, 1) comes out, the same on every machine, and a chord is a chord.
//!
//! *Lower end.* The witness x is a convex combination of the corners of a face of A. For every face of B a plane or a box is found
//! that keeps it at least `lower` away ([`kernel::Facet::at_least`]).
//!
//! *Arithmetic.* Assumed is only that `+ - * / sqrt` of doubles are rounded correctly, to nearest. Each corner carries a bound on
//! its error, each test adds its own rounding, counted beside the code. Comparisons are written so that what is not a number fails.
//!
//! *What is trusted.* This crate, the compiler, the processor. Not the program that wrote the certificate. Hashes are no part of the
//! proof: the claims hold for the triangles at hand, whatever the hashes are; they tell that other meshes are meant. Nor how the crate `flate2` unpacks: whatever comes out is checked. The command
//! `pompeiu-verify` trusts its own readers ([`mesh`]), too, and SHA-256 of the crate `sha2` for that message.

pub mod kernel;
pub mod mesh;
mod tree;

pub use tree::{MOST_WAITING, Waiting};

use flate2::read::GzDecoder;
use kernel::{Corner, Facet, Point, mean};
use sha2::{Digest, Sha256};
use std::borrow::Cow;
use std::io::{BufRead, BufReader, Read};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, AtomicU64, AtomicUsize, Ordering};
use std::thread;

/// How a certificate begins: its name and version.
pub const MAGIC: &[u8; 8] = b"PHCERT1\n";
/// How a packed file begins.
const GZIP: &[u8] = &[0x1f, 0x8b];
/// Faces of A whose trees are in one block.
pub const BLOCK: usize = 4096;

/// Triangles: indices into positions, all in range, all positions finite.
#[derive(Clone, Debug)]
pub struct Soup<'m> {
    positions: Cow<'m, [Point]>,
    faces: &'m [[u32; 3]],
}

impl<'m> Soup<'m> {
    /// Takes arrays; none if a position is not finite, an index out of range, or there are 2^32 faces or more.
    pub fn new(positions: &'m [Point], faces: &'m [[u32; 3]]) -> Option<Self> {
        let is_finite = positions.iter().flatten().all(|x| x.is_finite());
        let in_range = faces.iter().flatten().all(|&i| (i as usize) < positions.len());
        let fits = !faces.is_empty() && u32::try_from(faces.len()).is_ok();
        (is_finite && in_range && fits).then_some(Self { positions: Cow::Borrowed(positions), faces })
    }

    /// The corners of a face.
    pub fn triangle(&self, face: usize) -> [Point; 3] {
        self.faces[face].map(|i| self.positions[i as usize])
    }

    fn len(&self) -> usize {
        self.faces.len()
    }

    /// SHA-256 of the nine doubles of each face in order, little-endian, with 0 for -0.
    pub fn hash(&self) -> [u8; 32] {
        let mut hash = Sha256::new();
        let mut bytes = Vec::with_capacity(BLOCK * 72);
        for faces in self.faces.chunks(BLOCK) {
            bytes.clear();
            for x in faces.iter().flatten().flat_map(|&i| self.positions[i as usize]) {
                bytes.extend_from_slice(&(x + 0.0).to_le_bytes());
            }
            hash.update(&bytes);
        }
        hash.finalize().into()
    }
}

/// A and B of one direction in a common unit, in which no coordinate is beyond 2^200.
#[derive(Clone, Debug)]
pub struct Pair<'m> {
    /// The faces that distances are measured from.
    pub a: Soup<'m>,
    /// The faces that they are measured to.
    pub b: Soup<'m>,
    /// Powers of two whose product is the new unit over the old.
    scale: [f64; 2],
}

impl<'m> Pair<'m> {
    /// Scales both by a power of two if their largest coordinate is not between 2^-200 and 2^200. What underflows moves by at
    /// most 2^-1074, which [`kernel`] accounts for.
    pub fn new(a: &Soup<'m>, b: &Soup<'m>) -> Self {
        let largest = |soup: &Soup| soup.positions.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        let largest = largest(a).max(largest(b));
        let power = |exponent: i32| f64::from_bits(((1023 + exponent) as u64) << 52);
        // By the bits of the exponent, which are 0 for subnormal numbers: then by the largest power there is.
        let exponent = (largest.to_bits() >> 52).cast_signed() as i32 - 1023;
        if exponent.abs() < 200 || largest == 0.0 {
            return Self { a: a.clone(), b: b.clone(), scale: [1.0; 2] };
        }
        let scale = [power(-(exponent / 2)), power(-(exponent - exponent / 2))];
        let scaled = |soup: &Soup<'m>| Soup {
            positions: soup.positions.iter().map(|p| p.map(|x| x * scale[0] * scale[1])).collect(),
            faces: soup.faces,
        };
        Self { a: scaled(a), b: scaled(b), scale }
    }

    /// A length in this unit; not a number if that is not exact.
    pub fn length(&self, length: f64) -> f64 {
        let scaled = length * self.scale[0] * self.scale[1];
        if scaled / self.scale[1] / self.scale[0] == length { scaled } else { f64::NAN }
    }

    /// A length of this unit in that of the meshes.
    pub fn unscaled(&self, length: f64) -> f64 {
        length / self.scale[1] / self.scale[0]
    }

    /// Where a point of A is, seen from the first corner of its face, and that corner; none if there is no such point.
    pub fn witness(&self, witness: &Witness) -> Option<(Corner, Point)> {
        let face = (witness.face as usize) < self.a.len();
        let face = face.then(|| self.a.triangle(witness.face as usize))?;
        Some((mean(face, witness.weights)?, face[0]))
    }
}

/// A point of A: the exact mean of the corners of a face, with weights that are not negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Witness {
    /// The face of A.
    pub face: u32,
    /// The weights of its corners.
    pub weights: Point,
}

/// What is proven of one direction: `lower <= h <= upper`, in the unit of the meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Claim {
    /// Not above the distance.
    pub lower: f64,
    /// Not below the distance.
    pub upper: f64,
    /// Convex polygons that A was cut into.
    pub cells: u64,
}

/// A certificate that holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verified {
    /// Of h(A, B) and of h(B, A), where the certificate is about them.
    pub claims: [Option<Claim>; 2],
    /// SHA-256 of the triangles of A and of B.
    pub hashes: [[u8; 32]; 2],
}

/// Why a certificate is not accepted: the first statement that fails.
#[derive(Debug)]
pub enum Rejected {
    /// The certificate is about other triangles: 0 for A, 1 for B.
    Hash(usize),
    /// The ends of a claim are not finite lengths.
    Claim(f64, f64),
    /// It was not shown that the witness is at least `lower` from this face of B.
    Witness(Witness, u32),
    /// It was not shown that this cell of a face of A is within `upper` of this face of B.
    Cell {
        /// The face of A.
        face: u32,
        /// Cells of it before this one.
        cell: u64,
        /// The face of B.
        of_b: u32,
    },
    /// Any of these, in the direction from B to A: A and B change their roles.
    Reversed(Box<Rejected>),
    /// No certificate, or one of another version.
    Malformed {
        /// The report.
        found: &'static str,
        /// Bytes from the start of the block, or of the certificate.
        byte: u64,
    },
    /// The certificate could not be read.
    Io(std::io::Error),
}

impl std::fmt::Display for Rejected {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Hash(which) => write!(f, "mesh {} is not the one that was certified", ["A", "B"][*which]),
            Self::Claim(lower, upper) => write!(f, "[{lower}, {upper}] is no interval of lengths"),
            Self::Witness(witness, of_b) => {
                let face = witness.face;
                write!(f, "the witness on face {face} of A is not shown to be as far from face {of_b} of B")
            }
            Self::Cell { face, cell, of_b } => {
                write!(f, "cell {cell} of face {face} of A is not shown to be as near to face {of_b} of B")
            }
            Self::Reversed(inner) => write!(f, "from B to A, with A and B exchanged: {inner}"),
            Self::Malformed { found, byte } => write!(f, "the certificate has {found}, at byte {byte}"),
            Self::Io(error) => write!(f, "the certificate cannot be read: {error}"),
        }
    }
}

impl std::error::Error for Rejected {}

impl From<std::io::Error> for Rejected {
    fn from(error: std::io::Error) -> Self {
        Self::Io(error)
    }
}

impl Rejected {
    /// Whether the certificate cannot be read at all, rather than states what is not shown.
    pub fn is_unreadable(&self) -> bool {
        match self {
            Self::Malformed { .. } | Self::Io(_) => true,
            Self::Reversed(inner) => inner.is_unreadable(),
            _ => false,
        }
    }
}

/// Checks a certificate, packed as gzip or not. Memory: the meshes, and one block of the certificate for each thread.
///
/// # Errors
/// The first statement that fails, in the order of the certificate; the same for any number of threads.
pub fn verify(a: &Soup, b: &Soup, from: impl Read + Send, threads: usize) -> Result<Verified, Rejected> {
    let mut from = BufReader::new(from);
    if from.fill_buf()?.starts_with(GZIP) {
        unpacked(a, b, GzDecoder::new(from), threads)
    } else {
        unpacked(a, b, from, threads)
    }
}

fn unpacked(a: &Soup, b: &Soup, mut from: impl Read + Send, threads: usize) -> Result<Verified, Rejected> {
    let header: [u8; 73] = array(&mut from)?;
    let malformed = |found, byte| Err(Rejected::Malformed { found, byte });
    if !header.starts_with(MAGIC) {
        return malformed("another beginning than that of a certificate of version 1", 0);
    }
    let directions = header[72];
    if !(1..=3).contains(&directions) {
        return malformed("no direction", 72);
    }
    let hashes = thread::scope(|scope| {
        let other = (threads > 1).then(|| scope.spawn(|| b.hash()));
        let first = a.hash();
        [first, other.and_then(|thread| thread.join().ok()).unwrap_or_else(|| b.hash())]
    });
    if let Some(other) = (0..2).find(|&i| header[8 + 32 * i..40 + 32 * i] != hashes[i]) {
        return Err(Rejected::Hash(other));
    }
    let mut claims = [None; 2];
    for (direction, claim) in claims.iter_mut().enumerate() {
        if directions >> direction & 1 == 1 {
            let (from_mesh, to) = if direction == 0 { (a, b) } else { (b, a) };
            let pair = Pair::new(from_mesh, to);
            let reversed = |error| if direction == 0 { error } else { Rejected::Reversed(Box::new(error)) };
            *claim = Some(directed(&pair, &mut from, threads).map_err(reversed)?);
        }
    }
    if from.read(&mut [0])? != 0 {
        return malformed("bytes after its end", 0);
    }
    Ok(Verified { claims, hashes })
}

fn directed(pair: &Pair, mut from: impl Read + Send, threads: usize) -> Result<Claim, Rejected> {
    let [lower, upper] = [array(&mut from)?, array(&mut from)?].map(f64::from_le_bytes);
    let face = u32::from_le_bytes(array(&mut from)?);
    let weights = [array(&mut from)?, array(&mut from)?, array(&mut from)?].map(f64::from_le_bytes);
    let witness = Witness { face, weights };
    let is_length = |x: f64| x >= 0.0 && pair.length(x).is_finite();
    if !(is_length(lower) && is_length(upper)) {
        return Err(Rejected::Claim(lower, upper));
    }
    if lower > 0.0 {
        far_from_all(pair, &witness, pair.length(lower), threads)?;
    }
    let (next, cells) = (AtomicUsize::new(0), AtomicU64::new(0));
    let source = Mutex::new(from);
    let failure = Mutex::new(None::<(usize, Rejected)>);
    let blocks = pair.a.len().div_ceil(BLOCK);
    let worker = || {
        let mut bytes = Vec::new();
        loop {
            // Blocks are read in order, so that all before a failure are being checked when it is found.
            let taken = {
                let Ok(mut source) = source.lock() else { return };
                let block = next.fetch_add(1, Ordering::Relaxed);
                if block >= blocks || failure.lock().is_ok_and(|failure| failure.is_some()) {
                    return;
                }
                read_block(&mut *source, &mut bytes).map(|()| block).map_err(|error| (block, error))
            };
            let checked = taken.and_then(|block| {
                let faces = block * BLOCK..pair.a.len().min((block + 1) * BLOCK);
                let trees = tree::Trees::new(pair, pair.length(upper), &bytes);
                trees.check(faces).map_err(|error| (block, error))
            });
            match checked {
                Ok(count) => {
                    cells.fetch_add(count, Ordering::Relaxed);
                }
                Err((block, error)) => {
                    let Ok(mut failure) = failure.lock() else { return };
                    if failure.as_ref().is_none_or(|(first, _)| block < *first) {
                        *failure = Some((block, error));
                    }
                }
            }
        }
    };
    on_threads(threads, worker);
    match failure.into_inner() {
        Ok(None) => Ok(Claim { lower, upper, cells: cells.into_inner() }),
        Ok(Some((_, error))) => Err(error),
        Err(_) => Err(Rejected::Malformed { found: "a block on which the verifier failed", byte: 0 }),
    }
}

/// Shows that the witness is at least `lower` from every face of B.
fn far_from_all(pair: &Pair, witness: &Witness, lower: f64, threads: usize) -> Result<(), Rejected> {
    let (x, origin) = pair.witness(witness).ok_or(Rejected::Witness(*witness, 0))?;
    let (next, first) = (AtomicUsize::new(0), AtomicU32::new(u32::MAX));
    on_threads(threads, || {
        loop {
            let start = next.fetch_add(BLOCK, Ordering::Relaxed);
            if start >= pair.b.len() {
                return;
            }
            for f in start..pair.b.len().min(start + BLOCK) {
                let facet = Facet::new(pair.b.triangle(f), origin);
                let is_far = facet.at_least(&x, lower) >= lower;
                if !is_far {
                    first.fetch_min(f as u32, Ordering::Relaxed);
                    break;
                }
            }
        }
    });
    // The last face there can be is 2^32 - 2.
    let first = first.into_inner();
    if first == u32::MAX { Ok(()) } else { Err(Rejected::Witness(*witness, first)) }
}

/// Runs a worker on this thread and on so many more; returns when all are done. A worker that panics ends all.
fn on_threads(threads: usize, worker: impl Fn() + Sync) {
    thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(&worker);
        }
        worker();
    });
}

fn array<const N: usize>(from: &mut impl Read) -> Result<[u8; N], Rejected> {
    let mut bytes = [0; N];
    from.read_exact(&mut bytes).map_err(|error| match error.kind() {
        std::io::ErrorKind::UnexpectedEof => Rejected::Malformed { found: "an early end", byte: 0 },
        _ => error.into(),
    })?;
    Ok(bytes)
}

/// Reads a block behind its length; memory grows with the bytes that are there, not with the length.
fn read_block(from: &mut impl Read, bytes: &mut Vec<u8>) -> Result<(), Rejected> {
    let length = u32::from_le_bytes(array(from)?);
    bytes.clear();
    let read = from.take(u64::from(length)).read_to_end(bytes)?;
    let is_whole = read == length as usize;
    if is_whole { Ok(()) } else { Err(Rejected::Malformed { found: "an early end", byte: 0 }) }
}
