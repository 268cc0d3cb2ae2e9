//! Two meshes with what comparing them takes, made where it is first needed and kept for what follows.

use crate::deviation::{Part, VertexDistances};
use crate::report::Direction;
use crate::target::Target;
use pompeiu_core::geom::Frame;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::Leaves;
use pompeiu_core::{FaceId, TriMesh};
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A mesh that is borrowed, or shared with others.
#[derive(Clone, Debug)]
pub enum Held<'m> {
    /// Borrowed.
    Borrowed(&'m TriMesh),
    /// Shared.
    Shared(Arc<TriMesh>),
}

impl<'m> From<&'m TriMesh> for Held<'m> {
    fn from(mesh: &'m TriMesh) -> Self {
        Self::Borrowed(mesh)
    }
}

impl From<Arc<TriMesh>> for Held<'_> {
    fn from(mesh: Arc<TriMesh>) -> Self {
        Self::Shared(mesh)
    }
}

impl From<TriMesh> for Held<'_> {
    fn from(mesh: TriMesh) -> Self {
        Self::Shared(Arc::new(mesh))
    }
}

impl Held<'_> {
    fn mesh(&self) -> &TriMesh {
        match self {
            Self::Borrowed(mesh) => mesh,
            Self::Shared(mesh) => mesh,
        }
    }
}

/// Two meshes that are compared in several ways: their trees, the neighbours of their faces and the distances of their vertices are made
/// once, when they are first needed, and serve distance, deviation, tolerance bands and figures.
///
/// Parts of the meshes may be measured instead of the whole ones; distances are those from the other mesh as a whole.
///
/// # Cost
/// What was made is kept as long as the pair: about 97 bytes for each face of both meshes and 12 for each vertex.
///
/// # Example
/// ```
/// use pompeiu_core::mesh::shapes::icosphere;
/// use pompeiu_hausdorff::{DeviationOptions, HausdorffOptions, PreparedPair};
///
/// let (a, b) = (icosphere(1.0, 3)?, icosphere(1.1, 3)?);
/// let pair = PreparedPair::new(&a, &b);
/// let distance = HausdorffOptions::default().symmetric_of(&pair)?.distance;
/// let deviation = DeviationOptions::default().symmetric_of(&pair)?;
/// assert_eq!(distance, deviation.distance);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct PreparedPair<'m> {
    a: Held<'m>,
    b: Held<'m>,
    parts: Option<[Part; 2]>,
    /// Whether what was made for one direction is kept once that is done.
    keeps: bool,
    /// Those of its trees.
    leaves: Leaves,
    made: [Mutex<Made>; 2],
}

/// What was made for one direction.
#[derive(Debug, Default)]
struct Made {
    target: Option<Arc<Target>>,
    vertices: Option<Arc<VertexDistances>>,
}

impl Made {
    fn target_in(&self, frame: &Frame) -> Option<Arc<Target>> {
        self.target.as_ref().filter(|target| target.frame() == frame).map(Arc::clone)
    }

    fn is_kept(&self, target: &Target) -> bool {
        self.target.as_ref().is_some_and(|kept| std::ptr::eq(Arc::as_ptr(kept), target))
    }
}

impl<'m> PreparedPair<'m> {
    /// A pair of which nothing is made yet.
    pub fn new(a: impl Into<Held<'m>>, b: impl Into<Held<'m>>) -> Self {
        Self {
            a: a.into(),
            b: b.into(),
            parts: None,
            keeps: true,
            leaves: Leaves::Compact,
            made: Default::default(),
        }
    }

    /// The same, of which nothing is kept once a direction is done: for a single question.
    pub(crate) fn for_one_question(a: &'m TriMesh, b: &'m TriMesh) -> Self {
        Self { keeps: false, ..Self::new(a, b) }
    }

    /// The same for a single distance, whose search asks few questions of its trees.
    pub(crate) fn for_one_distance(a: &'m TriMesh, b: &'m TriMesh) -> Self {
        Self { leaves: Leaves::Consecutive, ..Self::for_one_question(a, b) }
    }

    /// The same pair; what was made for one direction is kept once that is done only if that is wanted. By default it is.
    #[must_use]
    pub fn keeping(self, keeps: bool) -> Self {
        Self { keeps, ..self }
    }

    /// The same pair, of which these parts of A and of B are measured; trees stay.
    #[must_use]
    pub fn with_parts(self, parts: [Part; 2]) -> Self {
        for made in &self.made {
            made.lock().unwrap_or_else(PoisonError::into_inner).vertices = None;
        }
        Self { parts: Some(parts), ..self }
    }

    /// The same A with another B; what was made of the pair goes.
    #[must_use]
    pub fn with_b(self, b: impl Into<Held<'m>>) -> Self {
        Self { keeps: self.keeps, leaves: self.leaves, ..Self::new(self.a, b) }
    }

    /// A.
    pub fn a(&self) -> &TriMesh {
        self.a.mesh()
    }

    /// B.
    pub fn b(&self) -> &TriMesh {
        self.b.mesh()
    }

    /// The parts that are measured; none where the whole meshes are.
    pub fn parts(&self) -> Option<&[Part; 2]> {
        self.parts.as_ref()
    }

    /// The mesh, or the part of it, whose points are measured in a direction.
    pub fn measured(&self, direction: Direction) -> &TriMesh {
        match (&self.parts, direction) {
            (Some([a, _]), Direction::AToB) => &a.mesh,
            (Some([_, b]), Direction::BToA) => &b.mesh,
            (None, Direction::AToB) => self.a(),
            (None, Direction::BToA) => self.b(),
        }
    }

    /// The mesh that points are measured to in a direction: always the whole one.
    pub fn other(&self, direction: Direction) -> &TriMesh {
        match direction {
            Direction::AToB => self.b(),
            Direction::BToA => self.a(),
        }
    }

    /// The whole mesh that is measured in a direction, or of which a part is.
    pub(crate) fn whole(&self, direction: Direction) -> &TriMesh {
        match direction {
            Direction::AToB => self.a(),
            Direction::BToA => self.b(),
        }
    }

    /// Which faces of what is measured in a direction are a face of the whole mesh: none if it is left out, several if it is in pieces.
    pub fn faces_of_measured(&self, direction: Direction, face: FaceId) -> Range<u32> {
        let Some([a, b]) = &self.parts else { return face.0..face.0 + 1 };
        let faces = match direction {
            Direction::AToB => &a.faces,
            Direction::BToA => &b.faces,
        };
        let [first, end] =
            [faces.partition_point(|other| *other < face), faces.partition_point(|other| *other <= face)];
        first as u32..end as u32
    }

    /// How far the points that are measured in a direction are at most, where the choice of the part has proven that.
    pub(crate) fn farthest(&self, direction: Direction) -> Option<f64> {
        let [a, b] = self.parts.as_ref()?;
        match direction {
            Direction::AToB => a.farthest,
            Direction::BToA => b.farthest,
        }
    }

    /// Bytes that are held beside the meshes.
    pub fn bytes(&self) -> usize {
        let of = |made: &Mutex<Made>| {
            let made = made.lock().unwrap_or_else(PoisonError::into_inner);
            made.target.as_ref().map_or(0, |target| target.bytes())
                + made.vertices.as_ref().map_or(0, |vertices| vertices.bytes())
        };
        self.made.iter().map(of).sum()
    }

    /// The tree that is measured to in a direction, in a frame.
    pub(crate) fn target(&self, direction: Direction, frame: Frame) -> Arc<Target> {
        let mut made = self.made(direction);
        let known = made.target_in(&frame);
        known.unwrap_or_else(|| {
            self.keep(&mut made, Target::in_frame(self.other(direction), frame, self.leaves))
        })
    }

    /// The same; none if it has to be built and building is stopped.
    pub(crate) fn target_unless_stopped(
        &self,
        direction: Direction,
        frame: Frame,
        control: &Control,
    ) -> Option<Arc<Target>> {
        let mut made = self.made(direction);
        if let Some(known) = made.target_in(&frame) {
            return Some(known);
        }
        let target = Target::unless_stopped(self.other(direction), frame, self.leaves, control)?;
        Some(self.keep(&mut made, target))
    }

    fn keep(&self, made: &mut Made, target: Target) -> Arc<Target> {
        let target = Arc::new(target);
        if self.keeps {
            // Distances of vertices are those in the frame of the tree.
            *made = Made { target: Some(Arc::clone(&target)), vertices: None };
        }
        target
    }

    /// The distances of the vertices of the mesh that is measured in a direction, from the mesh of a tree of [`Self::target`]; none if they
    /// have to be found and that is stopped. `order` is the order of the faces in which neighbours are close.
    pub(crate) fn vertices(
        &self,
        direction: Direction,
        order: &[u32],
        target: &Target,
        control: &Control,
    ) -> Option<Arc<VertexDistances>> {
        let mut made = self.made(direction);
        if let Some(known) = made.vertices.as_ref().filter(|_| made.is_kept(target)) {
            return Some(Arc::clone(known));
        }
        let (mesh, frame) = (self.measured(direction), target.frame());
        let vertices = Arc::new(VertexDistances::limited(mesh, frame, target.bvh(), order, control)?);
        if made.is_kept(target) {
            made.vertices = Some(Arc::clone(&vertices));
        }
        Some(vertices)
    }

    fn made(&self, direction: Direction) -> MutexGuard<'_, Made> {
        let place = match direction {
            Direction::AToB => 0,
            Direction::BToA => 1,
        };
        self.made[place].lock().unwrap_or_else(PoisonError::into_inner)
    }
}
