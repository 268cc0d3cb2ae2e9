//! Pieces of a given shape: their similarity, exact tiling, and the behaviour of Lloyd's method.

use pompeiu_core::run::Limits;
use pompeiu_planar::{Outline, first_crossing};
use pompeiu_puzzle::{
    Answer, Like, LikeOptions, Method, PieceName, PieceShape, PuzzleError, PuzzleOptions, Tab, Variant, lock,
    make_like, report_like,
};

pub(super) fn like(shape: PieceName, pieces: usize, tab: Tab, seed: u64) -> Like {
    let options = PuzzleOptions { pieces, tab, seed, ..PuzzleOptions::default() };
    make_like(&options, &LikeOptions { shape: PieceShape::Built(shape), ..LikeOptions::default() }).unwrap()
}

pub(super) fn mean_iou(like: &Like) -> f64 {
    let fits: Vec<f64> = like.fits.iter().flatten().map(|fit| fit.iou).collect();
    fits.iter().sum::<f64>() / fits.len() as f64
}

/// The similarity of each built-in shape, for people: `POMPEIU_SHAPES=bird,star cargo test -p pompeiu-puzzle -- table --ignored
/// --nocapture`.
#[test]
#[ignore = "a table, for people"]
fn table() {
    let wanted = std::env::var("POMPEIU_SHAPES").unwrap_or_default();
    for shape in PieceName::ALL.into_iter().filter(|s| wanted.is_empty() || wanted.contains(s.name())) {
        for seed in 0..1 {
            let started = std::time::Instant::now();
            let plain = like(shape, 24, Tab::None, seed);
            let took = started.elapsed().as_secs_f64();
            let held = like(shape, 24, Tab::Knob, seed);
            println!(
                "{:8} {seed}: {:.3} tabs {:.3} energy {:.4} pieces {} locked {} in {took:.1} s",
                shape.name(),
                mean_iou(&plain),
                mean_iou(&held),
                plain.energy.last().unwrap(),
                plain.puzzle.pieces(),
                lock(&held.puzzle).is_locked(),
            );
        }
    }
}

#[test]
fn narrower_necks_hold_what_no_wide_one_does_unless_a_width_is_asked_for() {
    let default = like(PieceName::Bird, 8, Tab::Knob, 0);
    assert!(lock(&default.puzzle).is_locked());
    let options = PuzzleOptions {
        pieces: 8,
        tab: Tab::Knob,
        neck: Some(0.15 * default.puzzle.unit()),
        ..PuzzleOptions::default()
    };
    let shape = LikeOptions { shape: PieceShape::Built(PieceName::Bird), ..LikeOptions::default() };
    assert!(!lock(&make_like(&options, &shape).unwrap().puzzle).is_locked());
}

#[test]
fn pieces_are_like_the_shape_and_tile_exactly() {
    let made = like(PieceName::Square, 6, Tab::Dovetail, 1);
    assert!(made.energy.windows(2).all(|pair| pair[1] < pair[0]), "the energy rises");
    assert_eq!(made.puzzle.pieces(), 6);
    let sum: f64 = (0..6).map(|piece| made.puzzle.area(piece)).sum();
    assert!((sum / 60_000.0 - 1.0).abs() < 1e-12, "{sum}");
    for piece in 0..6 {
        let outline = Outline::new(made.puzzle.outline(piece)).unwrap();
        assert_eq!(first_crossing(&outline), None);
    }
    assert!(lock(&made.puzzle).is_locked());
    assert!(mean_iou(&made) > 0.95, "{}", mean_iou(&made));
}

#[test]
fn a_motif_inside_a_free_outline_and_the_same_bits_at_any_number_of_threads() {
    let circle = (0..90).map(|i| f64::from(i) * std::f64::consts::TAU / 90.0);
    let outline = Outline::new(circle.map(|a| [a.cos(), a.sin()]).collect()).unwrap();
    let options = PuzzleOptions {
        outline: Some(outline),
        size: [200.0, 200.0],
        pieces: 7,
        seed: 4,
        ..PuzzleOptions::default()
    };
    let like = LikeOptions { shape: PieceShape::Built(PieceName::Hexagon), ..LikeOptions::default() };
    let one = pompeiu_core::run::on_threads(std::num::NonZeroUsize::new(1), || make_like(&options, &like));
    let (one, two) = (one.unwrap(), make_like(&options, &like).unwrap());
    assert!(one.puzzle == two.puzzle && one.energy == two.energy && one.fits == two.fits);
    let report = report_like(&one);
    assert!(report.area.is_exact && report.locked && one.puzzle.pieces() == 7);
    assert!(report.pieces.iter().all(|piece| piece.similarity.unwrap().iou > 0.75));
}

#[test]
fn lloyd_with_each_metric_tiles_and_rises_now_and_then() {
    let mut rises = 0;
    for (answer, variant, feedback) in [
        (Answer::Least, Variant::Edges, false),
        (Answer::Greatest, Variant::Points, true),
        (Answer::SignedDistance, Variant::Edges, true),
    ] {
        let options = PuzzleOptions { pieces: 9, tab: Tab::None, seed: 2, ..PuzzleOptions::default() };
        let like = LikeOptions {
            shape: PieceShape::Built(PieceName::Bird),
            method: Method::Lloyd { answer, variant, feedback },
            ..LikeOptions::default()
        };
        let made = make_like(&options, &like).unwrap();
        let sum: f64 = (0..made.puzzle.pieces()).map(|piece| made.puzzle.area(piece)).sum();
        assert!((sum / 60_000.0 - 1.0).abs() < 1e-12 && made.puzzle.pieces() == 9);
        rises += made.energy.windows(2).filter(|pair| pair[1] > pair[0]).count();
    }
    // The source expects convergence; the centroid does not minimise the metric.
    assert!(rises > 0);
}

#[test]
fn whole_copies_make_an_outline_of_their_own() {
    let options = PuzzleOptions { pieces: 8, seed: 1, ..PuzzleOptions::default() };
    let shape = PieceShape::Built(PieceName::Hexagon);
    let made =
        make_like(&options, &LikeOptions { shape, free_outline: true, ..LikeOptions::default() }).unwrap();
    let report = report_like(&made);
    assert!(report.area.is_exact && report.locked && made.puzzle.pieces() == 8);
    // Every piece has the shape: the outline cuts none. And the outline is close to the given one.
    assert!(report.pieces.iter().all(|piece| piece.similarity.unwrap().iou > 0.93), "{:?}", mean_iou(&made));
    assert!((report.area.outline / 60_000.0 - 1.0).abs() < 0.05);
    let outer = Outline::new(made.puzzle.outer()).unwrap();
    assert!(first_crossing(&outer).is_none() && outer.points().len() > 40);
    let memory = Limits { memory: Some(1000), ..Limits::default() };
    let few = make_like(&options, &LikeOptions { limits: memory, ..LikeOptions::default() });
    assert!(matches!(few, Err(PuzzleError::Memory { limit: 1000, .. })));
}
