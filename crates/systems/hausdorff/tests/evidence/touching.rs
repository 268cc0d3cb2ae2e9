//! Small surfaces that touch, cross or coincide in part: deviations reach their accuracy with few pieces, or say that they do not.
//!
//! Where surfaces touch, the function above a piece is zero at a corner and the one below may be far less. Widths that were cut off at zero
//! by corners called such pieces narrow, refined everything else in vain, and took millions of looks.

use crate::deviation;
use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::merge;
use pompeiu_hausdorff::{DeviationOptions, DirectedDeviation, Enclosure, HausdorffOptions, StopReason};
use pompeiu_testkit::data;
use pompeiu_testkit::effort::cases;
use proptest::prelude::*;
use std::f64::consts::TAU;

pub(crate) type Triangle = [[f64; 3]; 3];

/// Pieces looked at: of 9,000 random pairs the worst took a quarter, for a percentile at a jump of the distribution.
const MOST_LOOKS: u64 = 100_000;

pub(crate) fn soup(triangles: &[Triangle]) -> TriMesh {
    let faces = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    TriMesh::new(triangles.concat(), faces).unwrap()
}

fn check(a: &TriMesh, b: &TriMesh) -> DirectedDeviation {
    let options = DeviationOptions::default();
    let found = options.directed(a, b).unwrap();
    assert!(found.work.looks <= MOST_LOOKS, "{:?}", found.work);
    let Some(statistics) = &found.statistics else { return found };
    // Percentiles may lie at a gap of the distribution, means may not.
    let allowed = |ends: &Enclosure| options.accuracy * ends.lower() + found.floor;
    let means = [statistics.mean, statistics.rms];
    assert!(means.iter().all(|ends| ends.gap() <= allowed(ends)), "{means:?} {:?}", found.stop);
    let percentiles = statistics.percentiles.iter().map(|p| &p.distance);
    let is_narrow = percentiles.chain(&means).all(|ends| ends.gap() <= allowed(ends));
    let expected = if is_narrow { StopReason::Tolerance } else { StopReason::Stalled };
    assert_eq!(found.stop, expected, "{:?}", statistics.percentiles);
    found
}

fn anywhere() -> BoxedStrategy<[f64; 3]> {
    prop::array::uniform3(-2.0..2.0_f64).boxed()
}

pub(crate) fn on_lattice() -> BoxedStrategy<[f64; 3]> {
    prop::array::uniform3((-2..3_i32).prop_map(f64::from)).boxed()
}

pub(crate) fn triangles(
    corner: BoxedStrategy<[f64; 3]>,
    most: usize,
) -> impl Strategy<Value = Vec<Triangle>> {
    prop::collection::vec(prop::array::uniform3(corner), 1..=most)
}

/// Corners of A that lie on faces of B, on their edges and at their corners, or anywhere.
pub(crate) fn touching() -> impl Strategy<Value = (Vec<Triangle>, Vec<Triangle>)> {
    triangles(anywhere(), 4).prop_flat_map(|b| {
        let on = (prop::sample::select(b.clone()), 0..5_u8, 0..5_u8).prop_map(|(t, v, w)| {
            let [v, w] = if v + w > 4 { [4 - v, 4 - w] } else { [v, w] }.map(|x| 0.25 * f64::from(x));
            [0, 1, 2].map(|k| t[0][k] + v * (t[1][k] - t[0][k]) + w * (t[2][k] - t[0][k]))
        });
        let corner = prop_oneof![2 => on, 1 => anywhere()].boxed();
        (triangles(corner, 3), Just(b))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(200)))]

    #[test]
    fn lattice_pairs_end(a in triangles(on_lattice(), 3), b in triangles(on_lattice(), 4)) {
        check(&soup(&a), &soup(&b));
    }

    #[test]
    fn crossing_pairs_end(a in triangles(anywhere(), 3), b in triangles(anywhere(), 4)) {
        check(&soup(&a), &soup(&b));
    }

    #[test]
    fn touching_pairs_end((a, b) in touching()) {
        check(&soup(&a), &soup(&b));
        check(&soup(&b), &soup(&a));
    }
}

/// A face on the other surface, and one far away whose corners are in line but for rounding: as an area that may be as great as rounding it made the
/// root of the mean square some 1e-8.
#[test]
fn a_face_without_area_far_away_does_not_matter() {
    let b = [[-1.3, -1.1, 0.3], [1.7, -0.9, -0.2], [0.1, 1.9, 0.6]];
    let at = |v: f64, w: f64| [0, 1, 2].map(|k| b[0][k] + v * (b[1][k] - b[0][k]) + w * (b[2][k] - b[0][k]));
    let (far, further) = ([1.9, 1.1, 1.7], [-1.9, 1.3, 1.6]);
    let between = [0, 1, 2].map(|k: usize| far[k] + 0.3 * (further[k] - far[k]));
    let a = soup(&[[at(0.25, 0.0), at(0.5, 0.5), at(0.0, 0.75)], [far, between, further]]);
    let found = check(&a, &soup(&[b]));
    assert_eq!(found.stop, StopReason::Tolerance);
}

/// A face in the plane of another, where the function below is zero at two corners and far less at the third: widths are stored in single precision,
/// whose rounding of the third was more than what suffices.
#[test]
#[expect(clippy::unreadable_literal, reason = "digits as they were found")]
fn a_width_in_single_precision_does_not_raise_what_is_almost_zero() {
    let b_corner = [0.5361661942411957, -1.3829429251458147, -0.322009905821471];
    let line = [-0.6767381821566142, -0.2885689827977589, 0.21682214015134005];
    let a = soup(&[
        [line, line, b_corner],
        [
            [0.575397444184526, -1.0531192872946462, -0.6456232395482804],
            b_corner,
            [-0.6389419493423008, -1.2607656125390492, 0.03674669457150648],
        ],
    ]);
    let b = soup(&[
        [
            b_corner,
            [0.6930911940145166, -0.06364837374114084, -1.6164632407287083],
            [-1.8140500929257974, -1.1385882999322836, 0.39550329496448394],
        ],
        [
            [-1.0164916019369148, 0.9588199388730669, 0.5767061518857421],
            [-1.821642126914564, 1.9038183475832604, -1.845759450853697],
            [-0.3369847623763136, -1.535957904468585, -0.1430718615830621],
        ],
    ]);
    assert_eq!(check(&a, &b).stop, StopReason::Tolerance);
}

/// One face with a corner on one of two faces: the mean was 42 % wide after millions of looks.
#[test]
fn a_corner_on_the_other_surface() {
    let a = soup(&[[[2.0, 1.0, 1.0], [-1.0, 2.0, 1.0], [-1.0, -2.0, 1.0]]]);
    let shared = [2.0, 1.0, 1.0];
    let b = soup(&[
        [shared, [0.0, -1.0, -2.0], [-2.0, -1.0, 0.0]],
        [[-2.0, -2.0, 0.0], shared, [2.0, -2.0, -2.0]],
    ]);
    for found in [check(&a, &b), check(&b, &a)] {
        assert_eq!(found.stop, StopReason::Tolerance);
        assert!(found.work.looks < 2_000, "{:?}", found.work);
    }
}

/// A gap in the distribution: half of the area is at distance 1, half at 2, and the median is anything between.
#[test]
fn what_stays_wide_says_so() {
    let plate = |x: f64, z: f64| {
        let at = |u: f64, v: f64| [x + u, v, z];
        [[at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0)], [at(0.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]]
    };
    let a = soup(&[plate(0.0, 1.0), plate(3.0, 2.0)].concat());
    let b = soup(&[plate(0.0, 0.0), plate(3.0, 0.0)].concat());
    let found = check(&a, &b);
    assert_eq!((found.stop, found.stop.is_early()), (StopReason::Stalled, true));
    let percentiles = found.statistics.unwrap().percentiles;
    assert!(percentiles[0].distance.contains(1.0) && percentiles[0].distance.contains(2.0));
}

/// Small inputs that took seconds and hundreds of megabytes, when they are present.
#[test]
fn hard_pairs_end() {
    for name in ["touch1x2", "near6x6", "overlap160"] {
        let load = |side: &str| {
            data::file(&format!("hard/{name}_{side}.obj")).map(|path| pompeiu_io::read_mesh(path).unwrap())
        };
        let Some((a, b)) = load("a").zip(load("b")) else { continue };
        for found in [check(&a, &b), check(&b, &a)] {
            assert_eq!(found.stop, StopReason::Tolerance, "{name}");
            assert!(found.work.looks < 5_000, "{name}: {:?}", found.work);
        }
    }
}

/// A disc as a fan of thin faces about its first vertex, in a plane that is tilted.
fn disc(count: u32) -> TriMesh {
    let at = |i: u32| {
        let (y, x) = (std::f64::consts::TAU * (f64::from(i) + 0.3) / f64::from(count)).sin_cos();
        [x, 0.7 * y, 0.6 * y]
    };
    TriMesh::new((0..count).map(at).collect(), (1..count - 1).map(|i| [0, i, i + 1]).collect()).unwrap()
}

/// Two discs of thin faces in one plane, about vertices in different places, so that each face of one crosses hundreds of the other: these are
/// overlaid once. Parts of a face would cross as many, and took 42 million distances.
#[test]
fn thin_faces_in_one_plane_take_few_distances() {
    let (coarse, fine) = (disc(128), disc(512));
    let found = HausdorffOptions::default().directed(&coarse, &fine).unwrap();
    // How far the corners of one rim lie outside of the other.
    assert!(found.distance.upper() < 1e-5, "{:?}", found.distance);
    assert_eq!(found.stop, StopReason::Tolerance);
    assert!(found.work.distances < 1_000_000, "{:?}", found.work);
}

/// Two open tubes that cross, of n sides each.
fn crossing_tubes(n: u32) -> TriMesh {
    let tube = |along: [f64; 3], centre: [f64; 3]| {
        let along = DVec3::from_array(along).normalize();
        let aside = along.any_orthonormal_vector();
        let corner = move |i: u32, end: f64| {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(n)).sin_cos();
            (DVec3::from_array(centre) + end * along + 0.1 * (cos * aside + sin * along.cross(aside)))
                .to_array()
        };
        let positions = (0..n).flat_map(|i| [corner(i, -1.0), corner(i, 1.0)]).collect();
        let sides = (0..n).map(|i| (2 * i, 2 * ((i + 1) % n)));
        TriMesh::new(positions, sides.flat_map(|(i, j)| [[i, i + 1, j + 1], [i, j + 1, j]]).collect())
            .unwrap()
    };
    let one = tube([1.0, 2.0, -0.3], [0.0; 3]);
    merge(&[&one, &tube([-0.4, 1.0, 2.0], [0.03, 0.05, 0.02])]).unwrap()
}

/// Beside the line where a surface crosses another one both are as near, and beyond it the first is the nearest again. Faces were halved towards the
/// line, and each half was compared with dozens of faces that pass beside it: 34,000 pieces with 12 million distances, and 3 million pieces
/// where faces share no vertices.
#[test]
fn what_another_surface_crosses_is_cut_on_both_sides_of_it() {
    let (a, b) = (crossing_tubes(60), crossing_tubes(75));
    let apart = |mesh: &TriMesh| soup(&mesh.face_ids().map(|face| mesh.corners(face)).collect::<Vec<_>>());
    for (a, b) in [(&a, &b), (&b, &a), (&apart(&a), &apart(&b))] {
        let threshold = 1e-4;
        let options = DeviationOptions { threshold: Some(threshold), ..DeviationOptions::default() };
        let found = options.directed(a, b).unwrap();
        assert_eq!(found.stop, StopReason::Tolerance);
        deviation::check(a, b, &found, threshold, 6);
        assert!(found.work.pieces < 20_000 && found.work.distances < 1_000_000, "{:?}", found.work);
    }
}
