//! Requests over shapes, files and drawings: what is measured, what is left out and why.

use pompeiu_complexity::{ComplexityRequest, ComplexityRequestError, FailedShape, NamedShape, RankingSource};
use pompeiu_core::request::{Conclusion, Report};
use pompeiu_core::run::{Limits, RunContext, StopReason};
use pompeiu_planar::ShapeSource;
use std::time::Duration;

fn square(side: f64) -> NamedShape {
    let corners = vec![[0.0, 0.0], [side, 0.0], [side, 1.0], [0.0, 1.0]];
    NamedShape { name: side.to_string(), source: ShapeSource::Corners(corners) }
}

#[test]
fn limits_leave_shapes_out() {
    let limits = Limits { time: Some(Duration::ZERO), ..Limits::default() };
    let request = ComplexityRequest { clusters: Some(2), ..ComplexityRequest::default() };
    let found = request.run(&[square(1.0), square(2.0)], &RunContext::start(limits)).unwrap();
    assert_eq!((found.report.stop, found.report.shapes.len()), (StopReason::Time, 0));
    assert_eq!(found.report.conclusion(), Conclusion::Incomplete);
}

#[test]
fn files_that_cannot_be_used_are_reported_and_corners_refused() {
    let missing = NamedShape::file("missing.svg".into());
    let run = |shapes: &[NamedShape]| ComplexityRequest::default().run(shapes, &RunContext::default());
    let found = run(&[missing.clone(), square(1.0)]).unwrap();
    assert_eq!((found.report.shapes.len(), found.report.failed[0].path.as_str()), (1, "missing.svg"));
    assert_eq!(found.report.conclusion(), Conclusion::Incomplete);
    let none = run(&[missing]).unwrap_err().to_string();
    assert!(none.starts_with("there are no shapes to measure: missing.svg: it cannot be read"), "{none}");
    assert!(matches!(run(&[square(0.0)]), Err(ComplexityRequestError::Shape(_))));
}

#[test]
fn each_shape_of_a_drawing_is_measured_or_reported() {
    let path = std::env::temp_dir().join(format!("pompeiu-several-{}.svg", std::process::id()));
    let drawing = "<svg><circle id='disc' r='9'/><rect x='20' width='4' height='4'/><path fill='none' d='M0 0h1v1' id='open'/><use href='#gone'/></svg>";
    std::fs::write(&path, drawing).unwrap();
    let named = |own: &str| format!("{}#{own}", path.display());
    let mine = [(named("disc"), 1.0), (named("2").rsplit('/').next().unwrap().to_owned(), 2.0)];
    let request = ComplexityRequest {
        rank_by: "boundary-25".to_owned(),
        against: Some(RankingSource::Places(mine.into())),
        ..ComplexityRequest::default()
    };
    let report = request.run(&[NamedShape::file(path.clone())], &RunContext::default()).unwrap().report;
    std::fs::remove_file(&path).unwrap();
    let ranking: Vec<_> = report.ranking.iter().map(|shape| (shape.file.clone(), shape.against)).collect();
    assert_eq!(ranking, [(named("disc"), Some(1.0)), (named("2"), Some(2.0))]);
    assert_eq!((report.failed.len(), report.failed[0].path.clone()), (2, named("open")));
    let message = "line 1: <use> draws nothing, for no element has the id `gone`";
    assert_eq!(
        report.failed[1],
        FailedShape { path: path.display().to_string(), message: message.to_owned() }
    );
}

/// A picture of dark squares on white, three bytes a pixel.
fn bmp(squares: &[(usize, usize, usize)]) -> Vec<u8> {
    const SIDE: usize = 40;
    let mut bytes = b"BM".to_vec();
    for number in [54 + 3 * SIDE * SIDE, 0, 54, 40, SIDE, SIDE] {
        bytes.extend(u32::try_from(number).unwrap().to_le_bytes());
    }
    bytes.extend([1, 0, 24, 0]);
    bytes.extend([0; 24]);
    for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
        let is_dark = |&(left, top, side): &(usize, usize, usize)| {
            (left..left + side).contains(&x) && (top..top + side).contains(&y)
        };
        bytes.extend([if squares.iter().any(is_dark) { 0 } else { 255 }; 3]);
    }
    bytes
}

#[test]
fn parts_of_a_picture_beside_the_largest_are_said() {
    let run = |name: &str, squares: &[(usize, usize, usize)]| {
        let path = std::env::temp_dir().join(format!("pompeiu-{name}-{}.bmp", std::process::id()));
        std::fs::write(&path, bmp(squares)).unwrap();
        let found =
            ComplexityRequest::default().run(&[NamedShape::file(path.clone())], &RunContext::default());
        std::fs::remove_file(&path).unwrap();
        found.unwrap().report
    };
    assert!(run("one", &[(4, 4, 20)]).left_out.is_empty());
    let report = run("three", &[(4, 4, 20), (30, 4, 8), (4, 28, 10)]);
    assert_eq!((report.shapes.len(), report.conclusion()), (1, Conclusion::AsAsked));
    let [said] = &report.left_out[..] else { panic!("{:?}", report.left_out) };
    assert!(
        said.contains(".bmp: only the largest of 3 shapes is used; the others have 41.0 % of its area"),
        "{said}"
    );
}
