//! What a deviation analysis answers.

#[cfg(feature = "figures")]
#[cfg(feature = "figures")]
use super::across;
use super::boundary::Boundary;
#[cfg(feature = "figures")]
use super::inside;
use super::inside::Scratch;
use super::measure::VertexDistances;
use super::patches::Patches;
use super::regions::Region;
use super::statistics::{Percentile, SignedStatistics, Statistics};
use crate::report::{DirectedReport, Direction, Enclosure, StopReason};
use crate::rounding::Rounding;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Frame;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::{Bvh, Slot, Winding, WindingNumber};
use rayon::prelude::*;
use std::time::Duration;

/// How far two meshes deviate from each other, both ways.
///
/// The two directions answer different questions and are never mixed unasked. With A as it should be and B as it is: what
/// of A is far from B is *missing* on B; what of B is far from A is in *excess*.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Deviation {
    /// Encloses the Pompeiu–Hausdorff distance, the greater of both directed ones.
    pub distance: Enclosure,
    /// The distance of A from B: material that is missing on B.
    pub a_to_b: DirectedDeviation,
    /// The distance of B from A: material that B has in excess.
    pub b_to_a: DirectedDeviation,
    /// For each share asked for the greater of the two directions' percentiles: both surfaces are within this distance of the
    /// other one, but for at most the rest of the area of each. None if one of them has no area.
    pub greater_percentiles: Option<Vec<Percentile>>,
    /// Statistics over the areas of both together. None if neither has any.
    pub pooled: Option<Statistics>,
}

/// The deviation of a mesh from another one.
///
/// Serialised without the values of each face and vertex, with its witness by meshes and the number of vertices inside.
#[derive(Clone, Debug)]
pub struct DirectedDeviation {
    /// Which way.
    pub direction: Direction,
    /// The largest distance of all, and the two points that prove it.
    pub distance: DirectedReport,
    /// Over the area of the mesh. None if it has no area: all its faces are segments or points, or too thin for double precision
    /// to tell them from such.
    pub statistics: Option<Statistics>,
    /// Of the signed distance over the same area, where sides are known and the other mesh is closed and oriented.
    pub signed: Option<SignedStatistics>,
    /// By face.
    pub faces: Vec<FaceDeviation>,
    /// Distances of the vertices. NaN for those that belong to no face.
    pub vertices: Vec<f64>,
    /// The exact distance of each vertex differs by at most this from the one given.
    pub vertex_error: f64,
    /// On which side of the other mesh vertices and faces lie, if that was asked and limits left room for it.
    pub sides: Option<Sides>,
    /// The worst regions, the worst first. None where limits ended the work before faces were looked at.
    pub regions: Vec<Region>,
    /// The parts of the surface that are farther than the threshold, the worst first, if one was given.
    pub beyond_threshold: Vec<Region>,
    /// Widths of statistics below this length always suffice: [`DeviationOptions::FLOOR`](super::DeviationOptions::FLOOR) of the diagonal
    /// of both meshes, and what rounding adds.
    pub floor: f64,
    /// Why the work ended. [`StopReason::Tolerance`]: all statistics are as narrow as asked. [`StopReason::Stalled`]: what is
    /// wider did not become narrower, as a percentile where the distribution has a gap, or a share above a threshold at which much
    /// of the area lies. The median of two equal squares at distances 0 and 1 is enclosed by 0 and 1: rounded sums do not tell which of the two
    /// areas is larger. The enclosures are valid in every case.
    pub stop: StopReason,
    /// The work that was done.
    pub work: DeviationWork,
}

/// How far one face is from the other mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceDeviation {
    /// Encloses the distance of its farthest point.
    pub max: Enclosure,
    /// Encloses the distance of its nearest point.
    pub min: Enclosure,
    /// Encloses the mean distance over its area; of a face without area, the mean over its corners' weights.
    pub mean: Enclosure,
}

/// On which side of the other mesh vertices and faces lie, by generalised winding numbers.
///
/// # Definition
/// Inside is where the winding number of the other mesh has a magnitude above one half, so that turning all of its faces changes
/// nothing. A sheet ([`Winding::is_sheet`]) encloses nothing: inside is behind its faces, where the number is positive. Signed distances are
/// negative inside and positive outside.
/// # Limits
/// About a closed mesh winding numbers are whole, and the side is certain but for points so close to a face that rounding of
/// coordinates decides. Beside holes and in soups they change gradually; then the side is on which side of one half
/// the number lies, which is decided by a bound on its error ([`WindingNumber`](pompeiu_core::spatial::WindingNumber)), but
/// what it means is a choice. Far from a sheet numbers are near to zero, and the side says little.
#[derive(Clone, Debug, PartialEq)]
pub struct Sides {
    /// Winding numbers of the other mesh about the vertices; NaN for those that belong to no face.
    pub vertex_winding: Vec<f64>,
    /// Winding numbers about the centroids of the faces.
    pub face_winding: Vec<f64>,
    /// Whether the other mesh is a sheet.
    pub of_sheet: bool,
}

impl Sides {
    /// Whether a winding number is that of a point inside; NaN is not.
    pub fn is_inside(&self, winding: f64) -> bool {
        WindingNumber { value: winding, error: 0.0, of_sheet: self.of_sheet }.is_inside()
    }

    /// Number of vertices inside.
    pub fn vertices_inside(&self) -> usize {
        self.vertex_winding.iter().filter(|winding| self.is_inside(**winding)).count()
    }

    /// Whether a mesh is closed and oriented: then all points that can be joined without crossing it are on one side.
    #[cfg(feature = "figures")]
    pub(crate) fn are_constant_beside(mesh: &TriMesh) -> bool {
        across::neighbours(mesh).is_some()
    }

    /// Whether points are inside a mesh, in the unit of the mesh: by the faces nearest to them where it is closed and oriented, else by winding
    /// numbers.
    #[cfg(feature = "figures")]
    pub(crate) fn of_points(points: &[[f64; 3]], mesh: &TriMesh) -> Vec<bool> {
        if points.is_empty() {
            return Vec::new();
        }
        let by_winding = |points: &[[f64; 3]]| -> Vec<bool> {
            Winding::new(mesh).about_all(points).iter().map(WindingNumber::is_inside).collect()
        };
        let Some(found) = inside::of_points(points, mesh) else { return by_winding(points) };
        let unknown: Vec<[f64; 3]> =
            points.iter().zip(&found).filter(|(_, inside)| inside.is_none()).map(|(p, _)| *p).collect();
        let mut rest = if unknown.is_empty() { Vec::new() } else { by_winding(&unknown) }.into_iter();
        found.into_iter().map(|inside| inside.or_else(|| rest.next()).unwrap_or(false)).collect()
    }

    /// Of a mesh that need not be closed: by the faces nearest to points where these decide, else by winding numbers.
    pub(super) fn of(
        (from, to): (&TriMesh, &TriMesh),
        (bvh, frame): (&Bvh, &Frame),
        vertices: &VertexDistances,
        rounding: Rounding,
        control: &Control,
    ) -> Self {
        let (winding, boundary) = (Winding::new(to), Boundary::new(to, frame));
        let patches = Patches::new(to, (&winding, &boundary), (bvh, frame), rounding, control);
        let about = |scratch: &mut Scratch, (p, near): ([f64; 3], Slot)| {
            let by_faces =
                patches.as_ref().and_then(|patches| patches.about(&boundary, frame.map(p), near, scratch));
            by_faces.unwrap_or_else(|| winding.about(p)).value
        };
        let mut vertex_winding: Vec<f64> = (from.positions().par_iter().zip(&vertices.near))
            .map_init(Scratch::default, |scratch, (p, near)| about(scratch, (*p, *near)))
            .collect();
        for v in unreferenced(from) {
            vertex_winding[v] = f64::NAN;
        }
        // Halved first, so that the sum of coordinates cannot overflow.
        let centroid = |corners: &[u32; 3]| {
            let [p, q, r] = corners.map(|v| from.positions()[v as usize]);
            let centroid = [0, 1, 2].map(|k| (0.5 * p[k] + 0.5 * q[k] + 0.5 * r[k]) * (2.0 / 3.0));
            (centroid, vertices.near[corners[0] as usize])
        };
        let face_winding = (from.faces().par_iter())
            .map_init(Scratch::default, |scratch, corners| about(scratch, centroid(corners)))
            .collect();
        Self { vertex_winding, face_winding, of_sheet: winding.is_sheet() }
    }
}

impl DirectedDeviation {
    /// Distances of the vertices, negative inside the other mesh; none unless sides were asked for.
    pub fn signed_vertices(&self) -> Option<Vec<f64>> {
        let sides = self.sides.as_ref()?;
        let signed = |(d, w): (&f64, &f64)| if sides.is_inside(*w) { -d } else { *d };
        Some(self.vertices.iter().zip(&sides.vertex_winding).map(signed).collect())
    }

    /// Number of pieces that the faces were cut into.
    pub fn pieces(&self) -> usize {
        self.work.pieces as usize
    }
}

/// Vertices that belong to no face.
pub(super) fn unreferenced(mesh: &TriMesh) -> impl Iterator<Item = usize> {
    let mut used = vec![false; mesh.positions().len()];
    for v in mesh.faces().iter().flatten() {
        used[*v as usize] = true;
    }
    used.into_iter().enumerate().filter(|(_, used)| !used).map(|(v, _)| v)
}

/// The work that was done, in counts that do not depend on the machine, and its time. Times are not serialised.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DeviationWork {
    /// Pieces at the end.
    pub pieces: u64,
    /// Pieces looked at.
    pub looks: u64,
    /// Point–triangle distances evaluated.
    pub distances: u64,
    /// Rounds of refinement.
    pub rounds: u32,
    /// Time to build the tree over the other mesh.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub build: Duration,
    /// Time to find the largest distance.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub search: Duration,
    /// Time for everything else.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub refine: Duration,
}
