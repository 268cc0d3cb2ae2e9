use super::*;
use crate::Target;
use crate::rounding::Rounding;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::point_triangle::distance_sq;
use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::{Diagonal, grid};
use pompeiu_testkit::effort::cases;
use proptest::prelude::*;

/// A rough sheet over the unit square with some of its faces missing.
pub(crate) fn sheet(cells: u32, roughness: f64, seed: u64, missing: &[usize]) -> TriMesh {
    let flat = grid([1.0, 1.0], [cells, cells], Diagonal::Alternating).unwrap();
    let rough = displace_at_random(&flat, roughness, seed).unwrap();
    let mut faces = rough.faces().to_vec();
    for &f in missing {
        if faces.len() > 1 {
            faces.swap_remove(f % faces.len());
        }
    }
    TriMesh::new(rough.positions().to_vec(), faces).unwrap()
}

fn run(t: &[[f64; 3]; 3], sheet: &TriMesh, limit_sq: f64, keep_all: bool) -> (Overlaid, Overlay, Target) {
    let target = Target::new(sheet);
    let mut overlay = Overlay::new(keep_all);
    let mut workspace = Workspace::default();
    let t = t.map(|p| target.frame().map(p));
    let centre = [0, 1, 2].map(|k| (t[0][k] + t[1][k] + t[2][k]) / 3.0);
    let neighbours = target.neighbours().unwrap();
    let below = Below { bvh: target.bvh(), neighbours, limit_sq };
    let near = target.bvh().nearest(centre, target.bvh().any_slot(), &mut workspace).slot;
    let overlaid = View::new(&t)
        .map_or(Overlaid::None, |view| overlay.run(&view, &below, near, MOST_FACES, &mut workspace));
    (overlaid, overlay, target)
}

/// Points to an edge of a triangle, less one.
const STEPS: i32 = 12;

/// Points of a triangle, its corners and sides included.
pub(crate) fn lattice(t: &[[f64; 3]; 3]) -> impl Iterator<Item = [f64; 3]> {
    (0..=STEPS)
        .flat_map(|i| (0..=STEPS - i).map(move |j| [i, j].map(|x| f64::from(x) / f64::from(STEPS))))
        .map(|[v, w]| [0, 1, 2].map(|k| t[0][k] + v * (t[1][k] - t[0][k]) + w * (t[2][k] - t[0][k])))
}

/// Whether the cells cover a triangle, as far as a lattice of its points tells; and whether corners are as near to the
/// face of their cell as is said, up to the rounding of a distance to a face.
fn check(t: &[[f64; 3]; 3], overlay: &Overlay, target: &Target) {
    let rounding = Rounding::new(1.0).bound(0);
    let t = t.map(|p| target.frame().map(p));
    let triangles: Vec<_> =
        overlay.cells.iter().flat_map(|cell| cell.triangles().map(move |t| (t, cell))).collect();
    for (corners, cell) in &triangles {
        for corner in corners {
            let far = target.bvh().distance_sq(*corner, cell.slot).sqrt();
            let bound = cell.distance_sq.sqrt();
            assert!(far <= bound + rounding, "{far} {bound}");
            assert!(distance_sq(*corner, t[0], t[1], t[2]) < 1e-28);
        }
    }
    for x in lattice(&t) {
        let holds = |c: &[[f64; 3]; 3]| distance_sq(x, c[0], c[1], c[2]) < 1e-26;
        assert!(triangles.iter().any(|(c, _)| holds(c)), "{x:?} is in no cell");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(512)))]

    /// Over folds, ends and the corners of the sheet: whatever is called an overlay covers the triangle.
    #[test]
    fn cells_cover_the_triangle(
        corners in [[0.0..1.0_f64, 0.0..1.0, -0.05..0.05], [0.0..1.0, 0.0..1.0, -0.05..0.05], [0.0..1.0, 0.0..1.0, -0.05..0.05]],
        cells in 1..5_u32, roughness in prop_oneof![Just(0.0), 0.0..0.3_f64], seed in 0..50_u64,
        missing in prop::collection::vec(0..50_usize, 0..4), quarters in any::<bool>(),
    ) {
        // Corners on vertices and edges of the sheet too.
        let round = |x: f64| if quarters { (4.0 * x).round() / 4.0 } else { x };
        let t = corners.map(|[x, y, z]| [round(x) - 0.5, round(y) - 0.5, z]);
        let (overlaid, overlay, target) = run(&t, &sheet(cells, roughness, seed, &missing), 0.0, true);
        if matches!(overlaid, Overlaid::Beyond(_) | Overlaid::Covered(_)) {
            check(&t, &overlay, &target);
        }
    }
}

#[test]
fn a_triangle_over_a_flat_sheet_is_covered_at_its_height() {
    let flat = sheet(6, 0.0, 0, &[]);
    let t = [[-0.4, -0.3, 0.01], [0.35, -0.2, 0.01], [0.1, 0.4, 0.01]];
    let (overlaid, overlay, target) = run(&t, &flat, 1.0, true);
    let Overlaid::Covered(distance_sq) = overlaid else { panic!("no overlay") };
    assert!((target.frame().length_out(distance_sq.sqrt()) - 0.01).abs() < 1e-15);
    assert!(overlay.cells.len() > 10);
    check(&t, &overlay, &target);
}

#[test]
fn only_cells_beyond_the_limit_are_left() {
    let flat = sheet(6, 0.0, 0, &[]);
    let t = [[-0.4, -0.3, 0.0], [0.35, -0.2, 0.0], [0.1, 0.4, 0.08]];
    let limit = Target::new(&flat).frame().length_in(0.06);
    let (overlaid, all, _) = run(&t, &flat, limit * limit, true);
    assert!(matches!(overlaid, Overlaid::Beyond(_)) && !all.is_mostly_beyond());
    let (_, left, target) = run(&t, &flat, limit * limit, false);
    assert!(!left.cells.is_empty() && left.cells.len() < all.cells.len() / 2);
    let (worst, slot, distance_sq) = left.worst.unwrap();
    assert_eq!(worst, t.map(|p| target.frame().map(p))[2]);
    assert_eq!(distance_sq, target.bvh().distance_sq(worst, slot));
}

#[test]
fn too_many_faces_and_views_from_the_side() {
    let fine = sheet(30, 0.0, 0, &[]);
    let t = [[-0.4, -0.3, 0.0], [0.35, -0.2, 0.0], [0.1, 0.4, 0.0]];
    assert!(matches!(run(&t, &fine, 1.0, false).0, Overlaid::Many));
    let upright = [[-0.4, 0.0, 0.0], [0.35, 0.0, 0.0], [0.1, 0.01, 0.4]];
    assert!(matches!(run(&upright, &fine, 1.0, false).0, Overlaid::None));
}
