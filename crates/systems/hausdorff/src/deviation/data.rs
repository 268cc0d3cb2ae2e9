//! Reports as data for other programs, where these are not written as they are kept.

use super::regions::Region;
use super::report::{DeviationWork, DirectedDeviation, Sides};
use super::statistics::{SignedStatistics, Statistics};
use crate::report::{Enclosure, PointPair, StopReason, SurfacePoint, Timing, WorkCount};
use pompeiu_core::FaceId;
use serde::{Serialize, Serializer};
use std::time::Duration;

/// Serialises one type as another one that is made of a reference to it.
macro_rules! serialise_as {
    ($Type:ty, $Data:ident) => {
        impl Serialize for $Type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $Data::from(self).serialize(serializer)
            }
        }

        #[cfg(feature = "schema")]
        impl schemars::JsonSchema for $Type {
            fn schema_name() -> std::borrow::Cow<'static, str> {
                $Data::schema_name()
            }

            fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
                $Data::json_schema(generator)
            }
        }
    };
}

/// The deviation of a mesh from another one.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "DirectedDeviation"))]
struct Directed<'d> {
    /// The largest distance of all points of the mesh.
    distance: Enclosure,
    /// The two points that prove its lower end.
    witness: PointPair,
    /// The work to find these.
    search: Search,
    /// Over the area of the mesh; null if it has no area.
    statistics: &'d Option<Statistics>,
    /// Of the signed distance, negative inside the other mesh; absent unless sides are known and the other mesh is closed and oriented.
    #[serde(skip_serializing_if = "Option::is_none")]
    signed: Option<SignedStatistics>,
    /// Number of vertices inside the other mesh, if that was asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    vertices_inside: Option<usize>,
    /// The worst regions, the worst first.
    regions: &'d [Region],
    /// The parts of the surface that are farther than the threshold, the worst first; absent if there are none.
    #[serde(skip_serializing_if = "<[Region]>::is_empty")]
    beyond_threshold: &'d [Region],
    /// The reason for which the work ended: `tolerance` where enclosures are as narrow as requested, otherwise the reason for which they may be
    /// wider. They hold in every case.
    stop: StopReason,
    /// Widths of lengths below this always suffice: 1e-9 of the diagonal of both meshes, and what rounding adds.
    floor: f64,
    /// The work that was done.
    work: DeviationWork,
    /// Time spent, in milliseconds.
    timing_ms: Times,
}

/// The search for the largest distance.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "DeviationSearch"))]
struct Search {
    /// The reason for which it ended; the distance is enclosed in every case.
    stop: StopReason,
    /// The width that was asked for, as a length.
    tolerance: f64,
    /// The work that was done.
    work: WorkCount,
    /// Time spent, in milliseconds.
    timing_ms: Timing,
}

/// Time spent on a direction, in milliseconds.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "DeviationTiming"))]
struct Times {
    /// Building the tree over the other mesh.
    #[serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize")]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    build: Duration,
    /// Finding the largest distance.
    #[serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize")]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    search: Duration,
    /// Everything else.
    #[serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize")]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    refine: Duration,
}

impl<'d> From<&'d DirectedDeviation> for Directed<'d> {
    fn from(deviation: &'d DirectedDeviation) -> Self {
        Self {
            distance: deviation.distance.distance,
            witness: deviation.distance.witness.by_mesh(deviation.direction),
            search: Search {
                stop: deviation.distance.stop,
                tolerance: deviation.distance.tolerance,
                work: deviation.distance.work,
                timing_ms: deviation.distance.timing,
            },
            statistics: &deviation.statistics,
            signed: deviation.signed,
            vertices_inside: deviation.sides.as_ref().map(Sides::vertices_inside),
            regions: &deviation.regions,
            beyond_threshold: &deviation.beyond_threshold,
            stop: deviation.stop,
            floor: deviation.floor,
            work: deviation.work,
            timing_ms: Times {
                build: deviation.work.build,
                search: deviation.work.search,
                refine: deviation.work.refine,
            },
        }
    }
}

serialise_as!(DirectedDeviation, Directed);

/// A part of a surface that is far from the other one.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "Region"))]
struct Place<'r> {
    /// The greatest distance of its points.
    peak: Enclosure,
    /// The point with the greatest distance met.
    at: SurfacePoint,
    /// A point of the other mesh nearest to that.
    nearest: SurfacePoint,
    /// The distance that its faces reach: a part of the peak, or the threshold.
    level: f64,
    /// Area of its faces, rounded; null beyond the range of double precision.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    area: f64,
    /// Mean of its points, by area.
    centre: [f64; 3],
    /// Least coordinates of its faces.
    lowest: [f64; 3],
    /// Greatest coordinates of its faces.
    highest: [f64; 3],
    /// Its faces, in ascending order, counted from 0.
    faces: &'r [FaceId],
}

impl<'r> From<&'r Region> for Place<'r> {
    fn from(region: &'r Region) -> Self {
        Self {
            peak: region.peak,
            at: region.witness.from,
            nearest: region.witness.to,
            level: region.level,
            area: region.area,
            centre: region.centre,
            lowest: region.aabb.lower,
            highest: region.aabb.upper,
            faces: &region.faces,
        }
    }
}

serialise_as!(Region, Place);
