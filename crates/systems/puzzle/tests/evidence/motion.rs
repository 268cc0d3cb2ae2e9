//! Finite motions against the first-order test, cuts of some width, and drawings of both.

use pompeiu_core::mesh::edit::Random;
use pompeiu_core::run::{Control, Limits};
use pompeiu_planar::{Outline, Point, distance_to_outline, intersection_area, svg};
use pompeiu_puzzle::{
    Layout, PieceDrawing, Print, Puzzle, PuzzleError, PuzzleOptions, Tab, cuts_svg, kerf, lock, make,
    motion_png, motion_svg, pack, page, pieces_png, pieces_svg, report, shake, take_apart,
};

/// A random puzzle of 4 to 9 pieces in which some borders are straight and some have a tab that comes out one way.
fn random_puzzle(seed: u64) -> Puzzle {
    let mut random = Random::new(seed);
    let tab = if seed.is_multiple_of(2) { Tab::Knob } else { Tab::Dovetail };
    let layout = [Layout::Grid, Layout::Voronoi, Layout::Voronoi][seed as usize % 3];
    let pieces = 4 + random.below(6) as usize;
    let mut puzzle = make(&PuzzleOptions { pieces, tab, layout, seed, ..PuzzleOptions::default() }).unwrap();
    for border in
        (0..puzzle.borders().len()).filter(|i| puzzle.borders()[*i].right.is_some()).collect::<Vec<_>>()
    {
        let mut course = puzzle.border_points(border);
        let n = course.len();
        match random.below(3) {
            0 => course = vec![course[0], course[n - 1]],
            1 if n > 5 => {
                course.remove(2);
            }
            _ => continue,
        }
        puzzle = puzzle.with_border(border, &course).unwrap_or(puzzle);
    }
    puzzle
}

#[test]
fn shaken_puzzles_move_where_directions_say_so() {
    let mut free = 0;
    for seed in 0..14 {
        let puzzle = random_puzzle(seed);
        let is_locked = lock(&puzzle).is_locked();
        free += usize::from(!is_locked);
        assert_eq!(shake(&puzzle, 12, seed).is_none(), is_locked, "seed {seed}");
    }
    assert!((3..=11).contains(&free), "{free}");
}

#[test]
fn a_free_puzzle_is_taken_apart_without_pieces_going_into_each_other() {
    let options = PuzzleOptions {
        layout: Layout::Voronoi,
        tab: Tab::None,
        pieces: 12,
        seed: 3,
        ..PuzzleOptions::default()
    };
    let puzzle = make(&options).unwrap();
    let found = lock(&puzzle);
    let motion = take_apart(&puzzle, &found, &Control::default()).unwrap();
    assert!(motion.is_apart && motion.frames.len() > 10);
    let depth = 0.002 * puzzle.unit();
    for frame in (0..motion.frames.len()).step_by(5) {
        let outlines: Vec<Outline> =
            (0..12).map(|piece| Outline::new(motion.outline(&puzzle, piece, frame)).unwrap()).collect();
        for (i, piece) in outlines.iter().enumerate() {
            for (_, other) in outlines.iter().enumerate().filter(|(k, _)| *k != i) {
                let is_deep = |p: &Point| other.contains(*p) && distance_to_outline(*p, other) > depth;
                assert!(!piece.points().iter().any(is_deep), "frame {frame}: piece {i}");
            }
        }
    }
    let drawing = motion_svg(&puzzle, &motion);
    assert!(drawing.contains("animateTransform") && svg::read(&drawing).is_ok());
    assert!(motion_png(&puzzle, &motion).unwrap().starts_with(b"\x89PNG"));
    assert!(page(&puzzle, &report(&puzzle), Some(&motion), None, "free").contains("\"frames\":[["));
    let locked = make(&PuzzleOptions { pieces: 6, ..options.clone() }).unwrap();
    let tabbed = make(&PuzzleOptions { pieces: 6, tab: Tab::Knob, ..options }).unwrap();
    assert!(
        take_apart(&locked, &lock(&locked), &Control::default()).is_some()
            && take_apart(&tabbed, &lock(&tabbed), &Control::default()).is_none()
    );
    // Squares touch along their whole sides, and the motion of the lock rotates.
    for pieces in [4, 6, 12] {
        let plain = make(&PuzzleOptions { pieces, tab: Tab::None, ..PuzzleOptions::default() }).unwrap();
        assert!(
            take_apart(&plain, &lock(&plain), &Control::default()).is_some_and(|motion| motion.is_apart),
            "{pieces} squares"
        );
    }
}

#[test]
fn paths_lie_half_the_cut_outside_and_do_not_meet() {
    let puzzle = make(&PuzzleOptions { pieces: 6, ..PuzzleOptions::default() }).unwrap();
    let drawing = PieceDrawing { kerf: 0.4, pull: 0.01, ..PieceDrawing::default() };
    let paths = svg::read(&pieces_svg(&puzzle, &drawing)).unwrap();
    let laid: Vec<Outline> = paths.into_iter().map(|path| Outline::new(path.points).unwrap()).collect();
    for (piece, path) in laid.iter().enumerate() {
        let drawn = Outline::new(puzzle.outline(piece)).unwrap();
        let (grown, plain) = (path.area(), drawn.area() + 0.2 * drawn.length());
        assert!(
            (grown - plain).abs() < 0.3 * 0.2 * drawn.length() && grown > drawn.area(),
            "{grown} {plain}"
        );
        for other in laid.iter().enumerate().filter(|(k, _)| *k != piece).map(|(_, other)| other) {
            assert!(!path.points().iter().any(|p| other.contains(*p)));
        }
    }
    // Without a cut they do not meet, either.
    let pulled = PieceDrawing { kerf: 0.0, ..drawing };
    let paths = svg::read(&pieces_svg(&puzzle, &pulled)).unwrap();
    let apart: Vec<Outline> = paths.into_iter().map(|path| Outline::new(path.points).unwrap()).collect();
    for (piece, path) in apart.iter().enumerate() {
        let others = apart.iter().enumerate().filter(|(k, _)| *k != piece).map(|(_, other)| other);
        assert!(others.into_iter().all(|other| intersection_area(path, other) < 1e-9), "piece {piece}");
    }
    // In place they are those of the pieces.
    let in_place = PieceDrawing { pull: 0.0, ..drawing };
    assert_eq!(pieces_svg(&puzzle, &in_place), pieces_svg(&puzzle, &PieceDrawing::default()));
    // On a sheet the same paths lie elsewhere.
    let packing = pack(&puzzle, [520.0, 300.0], 0.4, &Control::default()).unwrap();
    let on_sheet = PieceDrawing { packing: Some(&packing), ..in_place };
    let paths = svg::read(&pieces_svg(&puzzle, &on_sheet)).unwrap();
    for (found, path) in paths.into_iter().zip(&laid) {
        let found = Outline::new(found.points).unwrap();
        let [low, high] = found.bounds();
        assert!((found.area() - path.area()).abs() < 1e-6 && low[0] >= 0.2 && high[0] <= 519.8, "{found:?}");
        assert!(low[1] >= 0.2 && high[1] <= 299.8);
    }
    // Only the outline is compensated where borders are cut once.
    let cuts = svg::read(&cuts_svg(&puzzle, 0.4)).unwrap();
    let around = cuts.last().unwrap();
    assert!(around.is_closed && around.id == "outline");
    let grown = Outline::new(around.points.clone()).unwrap();
    assert!((grown.area() - (60_000.0 + 0.2 * 1000.0)).abs() < 0.2, "{}", grown.area());
    assert!(kerf(&puzzle, 0.4, &Control::start(&Limits::default())).holds);
}

#[test]
fn a_picture_lies_on_the_pieces() {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 60, 60);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().unwrap();
    let pixels: Vec<u8> =
        (0..3600).flat_map(|i| if i % 60 < 30 { [250, 10, 10] } else { [10, 10, 250] }).collect();
    writer.write_image_data(&pixels).unwrap();
    writer.finish().unwrap();
    let print = Print::read(&bytes).unwrap();
    let puzzle = make(&PuzzleOptions { pieces: 6, ..PuzzleOptions::default() }).unwrap();
    let picture = pieces_png(&puzzle, Some(&print)).unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(picture)).read_info().unwrap();
    let mut found = vec![0; reader.output_buffer_size().unwrap()];
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    reader.next_frame(&mut found).unwrap();
    let at = |x: usize, y: usize| &found[3 * (y * width + x)..][..3];
    assert_eq!(
        (at(width / 4, height / 4), at(3 * width / 4, height / 4)),
        (&[250, 10, 10][..], &[10, 10, 250][..])
    );
    assert_eq!(at(0, 0), [255; 3]);
    let drawing = pieces_svg(&puzzle, &PieceDrawing { print: Some(&print), ..PieceDrawing::default() });
    assert!(drawing.contains("data:image/png;base64,") && drawing.contains("url(#print)"));
    assert!(Print::read(b"no picture").is_err());
}

#[test]
fn a_border_takes_no_course_through_another_one() {
    let puzzle = make(&PuzzleOptions { pieces: 6, tab: Tab::None, ..PuzzleOptions::default() }).unwrap();
    let border = puzzle.borders().iter().position(|border| border.right.is_some()).unwrap();
    let ends = puzzle.border_points(border);
    let (a, b) = (ends[0], ends[ends.len() - 1]);
    let bent =
        puzzle.with_border(border, &[a, [0.5 * (a[0] + b[0]) + 5.0, 0.5 * (a[1] + b[1]) + 5.0], b]).unwrap();
    assert!(report(&bent).area.is_exact && bent != puzzle);
    for course in [vec![a, [-50.0, 30.0], b], vec![a, b, a], vec![b, a], vec![]] {
        assert!(matches!(puzzle.with_border(border, &course), Err(PuzzleError::Border { .. })), "{course:?}");
    }
}
