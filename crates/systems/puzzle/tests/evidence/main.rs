//! Evidence that does not come from the code: exact areas, known locks, an independent test of what can move.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod like;
mod motion;

use pompeiu_planar::svg;
use pompeiu_planar::{Outline, Point, first_crossing, offset};
use pompeiu_puzzle::{
    Layout, PieceDrawing, PieceName, Proof, Puzzle, PuzzleError, PuzzleOptions, Tab, cuts_dxf, cuts_svg,
    lock, make, pieces_svg, report,
};
use std::collections::BTreeMap;

fn puzzle(layout: Layout, tab: Tab, pieces: usize, seed: u64) -> Puzzle {
    make(&PuzzleOptions { layout, tab, pieces, seed, ..PuzzleOptions::default() }).unwrap()
}

const LAYOUTS: [Layout; 3] = [Layout::Grid, Layout::Hexagons, Layout::Voronoi];

#[test]
fn pieces_are_simple_and_tile_exactly() {
    for layout in LAYOUTS {
        for tab in [Tab::None, Tab::Knob, Tab::Dovetail] {
            for (pieces, seed) in [(2, 1), (37, 2)] {
                let puzzle = puzzle(layout, tab, pieces, seed);
                let found = report(&puzzle);
                assert!(found.area.is_exact, "{layout:?} {tab:?} {pieces}");
                assert!((found.area.sum - found.area.outline).abs() <= 1e-12 * found.area.outline);
                for piece in 0..puzzle.pieces() {
                    let outline = Outline::new(puzzle.outline(piece)).unwrap();
                    assert_eq!(first_crossing(&outline), None, "{layout:?} {tab:?} {pieces}: piece {piece}");
                }
            }
        }
    }
}

#[test]
fn each_segment_belongs_to_two_pieces_bit_by_bit_or_to_the_outline() {
    for layout in LAYOUTS {
        let puzzle = puzzle(layout, Tab::Knob, 40, 5);
        let mut seen: BTreeMap<[[u64; 2]; 2], i32> = BTreeMap::new();
        for line in
            pieces_svg(&puzzle, &PieceDrawing::default()).lines().filter(|line| line.starts_with("<path"))
        {
            let found = svg::read(&format!("<svg>{line}</svg>")).unwrap();
            let points = &found[0].points;
            for (p, q) in points.iter().zip(points.iter().cycle().skip(1)) {
                let [a, b] = [*p, *q].map(|p: Point| p.map(f64::to_bits));
                let (key, way) = if a < b { ([a, b], 1) } else { ([b, a], -1) };
                *seen.entry(key).or_default() += way;
            }
        }
        let [width, height] = puzzle.size();
        for (ends, count) in seen.iter().filter(|(_, count)| **count != 0) {
            let [p, q] = ends.map(|p| p.map(f64::from_bits));
            let on_side = |k: usize, at: f64| p[k] == at && q[k] == at;
            let is_outside = on_side(0, 0.0) || on_side(0, width) || on_side(1, 0.0) || on_side(1, height);
            assert!(count.abs() == 1 && is_outside, "{p:?} {q:?}");
        }
    }
}

/// A bar with thin teeth, which cells cut into many parts, also lengthwise; and strips that are much longer than two regular hexagons.
#[test]
fn about_as_many_pieces_as_asked_for_whatever_the_shape() {
    let mut points = vec![[0.0, 0.0], [240.0, 0.0]];
    for tooth in (0..12).rev() {
        let x = 20.0 * f64::from(tooth);
        points.extend([[x + 12.0, 30.0], [x + 12.0, 160.0], [x + 6.0, 160.0], [x + 6.0, 30.0]]);
    }
    points[2][0] = 240.0;
    points.extend([[0.0, 30.0]]);
    points.insert(2, [240.0, 30.0]);
    points[3][0] = 232.0;
    let comb = Outline::new(points).unwrap();
    for layout in LAYOUTS {
        for pieces in [12, 40] {
            let options = PuzzleOptions {
                layout,
                pieces,
                tab: Tab::None,
                outline: Some(comb.clone()),
                size: [240.0, 160.0],
                ..PuzzleOptions::default()
            };
            let found = make(&options).unwrap().pieces();
            assert!(10 * found.abs_diff(pieces) <= 2 * pieces, "{layout:?}: {found} of {pieces}");
        }
    }
    // More teeth than pieces. There were 2, 2 and 45 of 12, and with Voronoi cells more and more, without an end.
    let mut points = vec![[0.0, 0.0], [236.0, 0.0]];
    for x in (0..40).rev().map(|tooth| 6.0 * f64::from(tooth)) {
        points.extend([[x + 2.0, 10.0], [x + 2.0, 160.0], [x, 160.0], [x, 10.0]]);
    }
    let comb = Outline::new(points).unwrap();
    for layout in LAYOUTS {
        for pieces in [12, 24, 60] {
            let options = PuzzleOptions {
                layout,
                pieces,
                tab: Tab::None,
                outline: Some(comb.clone()),
                size: [236.0, 160.0],
                ..PuzzleOptions::default()
            };
            let puzzle = make(&options).unwrap();
            let found = puzzle.pieces();
            assert!(10 * found.abs_diff(pieces) <= pieces, "{layout:?}: {found} of {pieces}");
            // Borders that run along a tooth left parts that hang by a 30th of its width.
            let necks = (0..found).filter_map(|piece| puzzle.neck(piece));
            let least = necks.map(|neck| neck.width).fold(f64::INFINITY, f64::min);
            assert!(least > 1.0, "{layout:?} {pieces}: a neck of {least} where teeth are 2 wide");
            let sum: f64 = (0..found).map(|piece| puzzle.area(piece)).sum();
            assert!((sum / (2360.0 + 40.0 * 300.0) - 1.0).abs() < 1e-6, "{layout:?} {pieces}: {sum}");
            for piece in 0..found {
                let outline = Outline::new(puzzle.outline(piece)).unwrap();
                assert_eq!(first_crossing(&outline), None, "{layout:?} {pieces}: piece {piece}");
            }
        }
    }
    for size in [[10.0, 150.0], [150.0, 10.0], [10.0, 40.0]] {
        for pieces in [2, 3, 7] {
            let options =
                PuzzleOptions { layout: Layout::Hexagons, pieces, size, ..PuzzleOptions::default() };
            let found = make(&options).unwrap().pieces();
            assert!(found.abs_diff(pieces) <= 1, "{size:?}: {found} of {pieces}");
        }
    }
}

#[test]
fn puzzles_without_tabs_are_free_and_those_with_tabs_locked() {
    for layout in LAYOUTS {
        let plain = lock(&puzzle(layout, Tab::None, 24, 7));
        assert!(!plain.is_locked() && plain.proof == Proof::OneMoves, "{layout:?}: {:?}", plain.proof);
        for tab in [Tab::Knob, Tab::Dovetail] {
            let held = lock(&puzzle(layout, tab, 24, 7));
            assert!(
                held.is_locked() && held.count == 1 && held.proof == Proof::Merging,
                "{layout:?} {tab:?}"
            );
        }
    }
    let deep = report(&puzzle(Layout::Grid, Tab::Dovetail, 24, 1));
    assert!(deep.locked && deep.depth.unwrap() >= 0.02, "{:?}", deep.depth);
}

#[test]
fn a_motion_that_is_reported_enters_no_piece() {
    let puzzle = puzzle(Layout::Voronoi, Tab::None, 30, 11);
    let escape = lock(&puzzle).escape.unwrap();
    assert!(escape.twists.iter().any(|twist| *twist != [0.0; 3]));
    let velocity = |[vx, vy, w]: [f64; 3], p: Point| [vx - w * p[1], vy + w * p[0]];
    for (i, border) in puzzle.borders().iter().enumerate() {
        let Some(right) = border.right else { continue };
        for pair in puzzle.border_points(i).windows(2) {
            let normal = [pair[0][1] - pair[1][1], pair[1][0] - pair[0][0]];
            for p in pair {
                let (a, b) = (velocity(escape.twists[border.left], *p), velocity(escape.twists[right], *p));
                let apart = normal[0] * (a[0] - b[0]) + normal[1] * (a[1] - b[1]);
                assert!(apart >= -1e-9 * (normal[0].abs() + normal[1].abs()), "{apart}");
            }
        }
    }
}

#[test]
fn many_pieces_are_locked_and_the_same_at_any_number_of_threads() {
    let options = PuzzleOptions { layout: Layout::Voronoi, pieces: 400, seed: 3, ..PuzzleOptions::default() };
    // A neck of 15 % of a side: wider ones leave fewer borders room for a tab.
    let neck = Some(0.15 * (300.0_f64 * 200.0 / 400.0).sqrt());
    let puzzle = make(&PuzzleOptions { neck, ..options }).unwrap();
    let straight = report(&puzzle).without_tab.len();
    let inner = puzzle.borders().iter().filter(|border| border.right.is_some()).count();
    assert!(straight * 20 < inner, "{straight} of {inner} borders without a tab");
    let one = pompeiu_core::run::on_threads(std::num::NonZeroUsize::new(1), || lock(&puzzle));
    assert_eq!(one, lock(&puzzle));
    assert!(one.count <= 3, "{}", one.count);
}

/// A star with this many points and this inner radius.
fn star(points: usize, hollow: f64) -> Outline {
    let at = |i: usize| {
        let angle = std::f64::consts::TAU * i as f64 / (2 * points) as f64 + 0.1;
        let radius = if i.is_multiple_of(2) { 1.0 } else { hollow };
        [radius * angle.cos(), radius * angle.sin()]
    };
    Outline::new((0..2 * points).map(at).collect()).unwrap()
}

#[test]
fn outlines_are_filled_exactly() {
    for layout in LAYOUTS {
        for (points, hollow, pieces) in [(5, 0.45, 30), (12, 0.6, 60), (100, 0.95, 20)] {
            let outline = star(points, hollow);
            let options = PuzzleOptions {
                outline: Some(outline.clone()),
                size: [200.0, 200.0],
                pieces,
                layout,
                seed: 3,
                ..PuzzleOptions::default()
            };
            let puzzle = make(&options).unwrap_or_else(|error| panic!("{layout:?} {points}: {error}"));
            let found = report(&puzzle);
            assert!(found.area.is_exact, "{layout:?} {points}");
            let [low, high] = outline.bounds();
            let scale = 200.0 / (high[0] - low[0]).max(high[1] - low[1]);
            assert!((found.area.outline / (scale * scale * outline.area()) - 1.0).abs() < 1e-5);
            assert!(
                2 * puzzle.pieces() > pieces && puzzle.pieces() < 2 * pieces,
                "{} of {pieces}",
                puzzle.pieces()
            );
            for piece in 0..puzzle.pieces() {
                let shape = Outline::new(puzzle.outline(piece)).unwrap();
                assert_eq!(first_crossing(&shape), None, "{layout:?} {points}: piece {piece}");
                assert!(!puzzle.neighbours(piece).is_empty());
            }
        }
    }
    let bow = Outline::new(vec![[0.0, 0.0], [4.0, 0.0], [0.5, 3.0], [4.0, 5.0]]).unwrap();
    let crossed = make(&PuzzleOptions { outline: Some(bow), ..PuzzleOptions::default() });
    assert!(matches!(crossed, Err(PuzzleError::Crossing { sides: [1, 3], .. })));
}

#[test]
fn rectangular_outlines_have_the_pieces_of_the_rectangle() {
    // With a corner in the middle of a side.
    let corners = vec![[7.0, 1.0], [8.0, 1.0], [9.0, 1.0], [9.0, 3.0], [7.0, 3.0]];
    for layout in LAYOUTS {
        let within = PuzzleOptions { pieces: 30, layout, ..PuzzleOptions::default() };
        let plain = PuzzleOptions { size: [200.0, 200.0], ..within.clone() };
        let outline = Some(Outline::new(corners.clone()).unwrap());
        let [puzzle, plain] = [PuzzleOptions { outline, ..within }, plain].map(|o| make(&o).unwrap());
        assert_eq!(puzzle.size(), [200.0, 200.0]);
        assert_eq!(puzzle.pieces(), plain.pieces(), "{layout:?}");
        assert!((0..puzzle.pieces()).all(|i| puzzle.outline(i) == plain.outline(i)), "{layout:?}");
    }
}

#[test]
fn cuts_are_each_border_once_with_the_outline_last() {
    let puzzle = puzzle(Layout::Hexagons, Tab::Knob, 20, 4);
    let text = cuts_svg(&puzzle, 0.0);
    let ids: Vec<&str> =
        text.lines().filter_map(|line| line.split('"').nth(1)).filter(|id| id.contains('-')).collect();
    assert_eq!(ids.len(), puzzle.borders().len());
    let first_outline = ids.iter().position(|id| id.starts_with("outline")).unwrap();
    assert!(ids[first_outline..].iter().all(|id| id.starts_with("outline")));
    let read = pompeiu_planar::dxf::read(&cuts_dxf(&puzzle, 0.0)).unwrap();
    assert_eq!(read.len(), ids.len());
}

#[test]
fn what_makes_no_sense_is_refused() {
    let with = |pieces, size| make(&PuzzleOptions { pieces, size, ..PuzzleOptions::default() });
    assert!(matches!(with(1, [3.0, 2.0]), Err(PuzzleError::Pieces { found: 1, .. })));
    assert!(matches!(with(1_000_000, [3.0, 2.0]), Err(PuzzleError::Pieces { .. })));
    for size in [[0.0, 1.0], [f64::NAN, 1.0], [1.0, f64::INFINITY], [1.0, 1000.0]] {
        assert!(matches!(with(9, size), Err(PuzzleError::Option { .. })), "{size:?}");
    }
    let same =
        |seed| make(&PuzzleOptions { layout: Layout::Voronoi, seed, ..PuzzleOptions::default() }).unwrap();
    assert_eq!(same(4), same(4));
    assert_ne!(same(4), same(5));
}

#[test]
fn whimsies_keep_their_outlines_and_are_held() {
    let whimsies = vec![star(5, 0.5), PieceName::Fish.outline().unwrap()];
    let around = [None, Some(star(60, 0.9))];
    for (outline, layout) in around.into_iter().zip([Layout::Grid, Layout::Voronoi]) {
        let options = PuzzleOptions {
            outline,
            whimsies: whimsies.clone(),
            pieces: 40,
            layout,
            seed: 5,
            ..PuzzleOptions::default()
        };
        let puzzle = make(&options).unwrap();
        let found = report(&puzzle);
        assert!(found.area.is_exact && found.locked, "{layout:?}: {:?}", found.proof);
        assert_eq!(puzzle.whimsies().len(), 2);
        for piece in 0..puzzle.pieces() {
            let shape = Outline::new(puzzle.outline(piece)).unwrap();
            assert_eq!(first_crossing(&shape), None, "{layout:?}: piece {piece}");
        }
        for (piece, given) in puzzle.whimsies().iter().zip(&whimsies) {
            let shape = Outline::new(puzzle.outline(*piece)).unwrap();
            let roundness = |outline: &Outline| outline.area() / outline.length().powi(2);
            assert!((roundness(&shape) / roundness(given) - 1.0).abs() < 0.25, "{layout:?}");
            assert!((shape.area() / (2.0 * puzzle.outline_area() / 40.0) - 1.0).abs() < 0.1);
        }
    }
    let many = make(&PuzzleOptions { whimsies: vec![star(5, 0.5); 30], ..PuzzleOptions::default() });
    assert!(matches!(many, Err(PuzzleError::Whimsy { .. })));
}

/// Pieces that a disc of a radius cannot leave, by offsets, which know nothing of necks: what the offset of a piece leaves is one
/// part, beside parts that are too small to count.
#[test]
fn no_piece_falls_apart_when_it_is_thinned_by_its_least_neck() {
    let flower: Vec<Point> = (0..240)
        .map(|i| {
            let angle = std::f64::consts::TAU * (f64::from(i) + 0.3) / 240.0;
            let radius = 1.0 + 0.8 * libm::cos(5.0 * angle);
            [radius * libm::cos(angle), radius * libm::sin(angle)]
        })
        .collect();
    let flower = Outline::new(flower).unwrap();
    let mut narrowest = f64::INFINITY;
    for (outline, layout, tab, seed) in [
        (None, Layout::Voronoi, Tab::Knob, 1),
        (None, Layout::Voronoi, Tab::Dovetail, 2),
        (None, Layout::Hexagons, Tab::Knob, 3),
        (Some(flower), Layout::Grid, Tab::Knob, 4),
    ] {
        let options = PuzzleOptions { outline, layout, tab, seed, pieces: 40, ..PuzzleOptions::default() };
        let puzzle = make(&options).unwrap();
        let found = report(&puzzle);
        let least = 0.15 * found.unit();
        for piece in &found.pieces {
            narrowest = piece.neck.map_or(narrowest, |neck| neck.width.min(narrowest));
            let outline = Outline::new(puzzle.outline(piece.id)).unwrap();
            let parts = offset(&outline, -0.495 * least);
            // What is left of a part that does not count has less area than the part.
            let counts = |part: &&Outline| part.area() > 0.005 * found.unit().powi(2);
            assert!(parts.iter().filter(counts).count() <= 1, "piece {}: {:?}", piece.id, piece.neck);
        }
        assert_eq!(found.clusters.len(), 1, "{layout:?} {tab:?}");
        let (_, neck) = found.narrowest().unwrap();
        assert!(neck.width >= least, "{layout:?} {tab:?}: {neck:?}, {least}");
    }
    assert!(narrowest < 10.0, "no piece has a neck");
    // Without a least width, tabs leave hairs.
    let hairs = PuzzleOptions {
        neck: Some(0.0),
        layout: Layout::Voronoi,
        pieces: 400,
        seed: 3,
        ..PuzzleOptions::default()
    };
    let (_, neck) = report(&make(&hairs).unwrap()).narrowest().unwrap();
    assert!(neck.width < 0.1, "{neck:?}");
}
