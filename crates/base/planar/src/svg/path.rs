//! Path data: lines, quadratic and cubic Bézier curves, elliptic arcs.

use super::numbers::Scanner;
use super::transform::Transform;
use crate::Point;
use crate::outline::dot;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Largest number of chords per Bézier curve.
const MOST_CHORDS: f64 = 1000.0;

/// A curve of lines and cubic Bézier curves.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curve {
    start: Point,
    pieces: Vec<Piece>,
    pub(super) is_closed: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Piece {
    Line(Point),
    Cubic([Point; 3]),
}

impl Curve {
    fn from(start: Point) -> Self {
        Self { start, pieces: Vec::new(), is_closed: false }
    }

    pub(super) fn through(points: &[Point], is_closed: bool) -> Option<Self> {
        let (&start, rest) = points.split_first()?;
        Some(Self { start, pieces: rest.iter().map(|p| Piece::Line(*p)).collect(), is_closed })
    }

    pub(super) fn ellipse([x, y]: Point, [rx, ry]: [f64; 2]) -> Self {
        let mut curve = Self { start: [x + rx, y], pieces: Vec::new(), is_closed: true };
        curve.arc_about([x, y], [rx, ry], 0.0, 0.0, TAU);
        curve
    }

    /// A rectangle whose corners are quarters of an ellipse with these radii, or sharp where one is 0.
    pub(super) fn rectangle([x, y]: Point, [w, h]: [f64; 2], [rx, ry]: [f64; 2]) -> Self {
        let (right, bottom) = (x + w, y + h);
        if rx == 0.0 || ry == 0.0 {
            let rest = [[right, y], [right, bottom], [x, bottom]].map(Piece::Line);
            return Self { start: [x, y], pieces: rest.to_vec(), is_closed: true };
        }
        let mut curve = Self { start: [x + rx, y], pieces: Vec::new(), is_closed: true };
        let quarters = [
            ([right - rx, y], [right - rx, y + ry]),
            ([right, bottom - ry], [right - rx, bottom - ry]),
            ([x + rx, bottom], [x + rx, bottom - ry]),
            ([x, y + ry], [x + rx, y + ry]),
        ];
        for (i, (side, centre)) in quarters.into_iter().enumerate() {
            curve.pieces.push(Piece::Line(side));
            curve.arc_about(centre, [rx, ry], 0.0, (i as f64 - 1.0) * FRAC_PI_2, FRAC_PI_2);
        }
        curve
    }

    pub(super) fn transform(&mut self, t: &Transform) {
        self.start = t.apply(self.start);
        for piece in &mut self.pieces {
            *piece = match *piece {
                Piece::Line(p) => Piece::Line(t.apply(p)),
                Piece::Cubic(points) => Piece::Cubic(points.map(|p| t.apply(p))),
            };
        }
    }

    /// The number of its lines and Bézier curves.
    pub(super) fn pieces(&self) -> usize {
        self.pieces.len()
    }

    pub(super) fn controls(&self) -> Vec<Point> {
        let pieces = self.pieces.iter().flat_map(|piece| match piece {
            Piece::Line(p) => vec![*p],
            Piece::Cubic(points) => points.to_vec(),
        });
        [self.start].into_iter().chain(pieces).collect()
    }

    /// The end points of chords that lie within the tolerance of the curve.
    pub(super) fn flatten(&self, tolerance: f64) -> Vec<Point> {
        let mut points = vec![self.start];
        let mut at = self.start;
        for piece in &self.pieces {
            match *piece {
                Piece::Line(p) => {
                    points.push(p);
                    at = p;
                }
                Piece::Cubic([b, c, d]) => {
                    // A chord over a span h of the parameter lies within h² max |B''| / 8 of the curve.
                    let bend = |p: Point, q: Point, r: Point| {
                        let v = [0, 1].map(|k| p[k] - 2.0 * q[k] + r[k]);
                        dot(v, v).sqrt()
                    };
                    let second = 6.0 * bend(at, b, c).max(bend(b, c, d));
                    let chords = (second / (8.0 * tolerance)).sqrt().ceil().clamp(1.0, MOST_CHORDS);
                    for i in 1..chords as usize {
                        let t = i as f64 / chords;
                        let s = 1.0 - t;
                        points.push([0, 1].map(|k| {
                            s * s * s * at[k] + 3.0 * s * t * (s * b[k] + t * c[k]) + t * t * t * d[k]
                        }));
                    }
                    points.push(d);
                    at = d;
                }
            }
        }
        points
    }

    /// An arc of an ellipse rotated by `phi`, from angle `from` and over the angle `over`.
    fn arc_about(&mut self, centre: Point, [rx, ry]: [f64; 2], phi: f64, from: f64, over: f64) {
        let count = (over.abs() / FRAC_PI_2 - 1e-9).ceil().max(1.0);
        let step = over / count;
        let handle = 4.0 / 3.0 * libm::tan(0.25 * step);
        let (sin, cos) = (libm::sin(phi), libm::cos(phi));
        let place = |x: f64, y: f64| {
            [centre[0] + cos * rx * x - sin * ry * y, centre[1] + sin * rx * x + cos * ry * y]
        };
        for i in 0..count as usize {
            let (a, b) = (from + i as f64 * step, from + (i as f64 + 1.0) * step);
            let ((sa, ca), (sb, cb)) = ((libm::sin(a), libm::cos(a)), (libm::sin(b), libm::cos(b)));
            self.pieces.push(Piece::Cubic([
                place(ca - handle * sa, sa + handle * ca),
                place(cb + handle * sb, sb - handle * cb),
                place(cb, sb),
            ]));
        }
    }

    /// An arc between two end points, in the parametrisation of path data.
    fn arc_to(
        &mut self,
        from: Point,
        [rx, ry]: [f64; 2],
        degrees: f64,
        [large, sweep]: [bool; 2],
        to: Point,
    ) {
        let (mut rx, mut ry) = (rx.abs(), ry.abs());
        if from == to {
            return;
        }
        if rx == 0.0 || ry == 0.0 {
            self.pieces.push(Piece::Line(to));
            return;
        }
        let phi = degrees.to_radians();
        let (sin, cos) = (libm::sin(phi), libm::cos(phi));
        let half = [0.5 * (from[0] - to[0]), 0.5 * (from[1] - to[1])];
        let [x, y] = [cos * half[0] + sin * half[1], cos * half[1] - sin * half[0]];
        let lambda = (x / rx).powi(2) + (y / ry).powi(2);
        if lambda > 1.0 {
            rx *= lambda.sqrt();
            ry *= lambda.sqrt();
        }
        let rest = (1.0 / lambda.min(1.0) - 1.0).max(0.0).sqrt();
        let sign = if large == sweep { -rest } else { rest };
        let centre = [sign * rx * y / ry, -sign * ry * x / rx];
        let angle = |p: Point| libm::atan2((p[1] - centre[1]) / ry, (p[0] - centre[0]) / rx);
        let (a, b) = (angle([x, y]), angle([-x, -y]));
        let mut over = b - a;
        if sweep && over < 0.0 {
            over += TAU;
        } else if !sweep && over > 0.0 {
            over -= TAU;
        }
        let middle = [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])];
        let place =
            [middle[0] + cos * centre[0] - sin * centre[1], middle[1] + sin * centre[0] + cos * centre[1]];
        self.arc_about(place, [rx, ry], phi, a, over);
        // Ends exactly at the point given in the file.
        if let Some(Piece::Cubic([.., end])) = self.pieces.last_mut() {
            *end = to;
        }
    }
}

/// The curves of a path.
pub(super) fn parse(text: &str) -> Result<Vec<Curve>, String> {
    let mut scanner = Scanner::new(text);
    let mut curves: Vec<Curve> = Vec::new();
    let (mut at, mut start) = ([0.0, 0.0], [0.0, 0.0]);
    let mut command = None;
    let mut reflect: Option<(char, Point)> = None;
    let mut current: Option<Curve> = None;
    loop {
        let letter = match scanner.letter() {
            Some(letter) => letter,
            None if scanner.is_done() => break,
            None => match command {
                Some('M') => 'L',
                Some('m') => 'l',
                Some(letter) if !matches!(letter, 'Z' | 'z') => letter,
                _ => return Err(scanner.unexpected()),
            },
        };
        command = Some(letter);
        let upper = letter.to_ascii_uppercase();
        let origin = if letter.is_ascii_lowercase() { at } else { [0.0; 2] };
        if current.is_none() && !matches!(upper, 'M' | 'Z') {
            if curves.is_empty() {
                return Err(format!("it starts with {letter}; expected M"));
            }
            current = Some(Curve::from(start));
        }
        let mut last = None;
        match upper {
            'M' => {
                curves.extend(current.take().filter(|curve| !curve.pieces.is_empty()));
                at = scanner.point(origin)?;
                start = at;
                current = Some(Curve::from(at));
            }
            'Z' => {
                if let Some(mut curve) = current.take().filter(|curve| !curve.pieces.is_empty()) {
                    curve.is_closed = true;
                    curves.push(curve);
                }
                at = start;
            }
            _ => {
                let Some(curve) = current.as_mut() else { return Err(scanner.unexpected()) };
                let mirrored = |kind: char| match reflect {
                    Some((k, c)) if k == kind => [2.0 * at[0] - c[0], 2.0 * at[1] - c[1]],
                    _ => at,
                };
                match upper {
                    'L' => at = scanner.point(origin)?,
                    'H' => at = [origin[0] + scanner.number()?, at[1]],
                    'V' => at = [at[0], origin[1] + scanner.number()?],
                    'C' | 'S' => {
                        let b = if upper == 'C' { scanner.point(origin)? } else { mirrored('C') };
                        let c = scanner.point(origin)?;
                        at = scanner.point(origin)?;
                        curve.pieces.push(Piece::Cubic([b, c, at]));
                        last = Some(('C', c));
                    }
                    'Q' | 'T' => {
                        let c = if upper == 'Q' { scanner.point(origin)? } else { mirrored('Q') };
                        let end = scanner.point(origin)?;
                        let toward = |p: Point| [0, 1].map(|k| p[k] + 2.0 / 3.0 * (c[k] - p[k]));
                        curve.pieces.push(Piece::Cubic([toward(at), toward(end), end]));
                        at = end;
                        last = Some(('Q', c));
                    }
                    'A' => {
                        let radii = [scanner.number()?, scanner.number()?];
                        let degrees = scanner.number()?;
                        let flags = [scanner.flag()?, scanner.flag()?];
                        let end = scanner.point(origin)?;
                        curve.arc_to(at, radii, degrees, flags, end);
                        at = end;
                    }
                    _ => return Err(format!("there is no command {letter}")),
                }
                if matches!(upper, 'L' | 'H' | 'V') {
                    curve.pieces.push(Piece::Line(at));
                }
            }
        }
        reflect = last;
    }
    curves.extend(current.filter(|curve| !curve.pieces.is_empty()));
    Ok(curves)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::{cross, minus};

    fn flat(text: &str) -> Vec<Point> {
        parse(text).unwrap()[0].flatten(1e-6)
    }

    #[test]
    fn relative_and_joined_commands() {
        let same = [[1.0, 2.0], [4.0, 2.0], [4.0, 5.0], [3.0, 4.0]];
        for text in ["M1 2L4 2 4 5 3 4z", "m1,2 3 0 0,3-1-1Z", "M1 2H4V5l-1-1z", "M1 2h3v3L3 4"] {
            assert_eq!(flat(text), same, "{text}");
        }
        let two = parse("M0 0h1v1zm5 5h1v1z").unwrap();
        assert_eq!((two.len(), two[1].start), (2, [5.0, 5.0]));
    }

    #[test]
    fn arcs_are_circles_on_the_side_that_is_asked() {
        for (flags, centre) in
            [("0 1", [0.0, 0.0]), ("1 1", [1.0, 1.0]), ("0 0", [1.0, 1.0]), ("1 0", [0.0, 0.0])]
        {
            let points = flat(&format!("M1 0A1 1 0 {flags} 0 1"));
            let off = |p: &Point| (dot(minus(*p, centre), minus(*p, centre)).sqrt() - 1.0).abs();
            assert!(points.iter().all(|p| off(p) < 3e-4), "{flags}: {points:?}");
            assert!(points.len() > 20);
            let left = cross(minus(points[1], points[0]), minus(points[2], points[1])) > 0.0;
            assert_eq!(left, flags.ends_with('1'));
        }
    }

    #[test]
    fn curves_end_where_they_should_and_follow_the_formula() {
        let points = flat("M0 0Q1 2 2 0T4 0");
        assert_eq!(points.last(), Some(&[4.0, 0.0]));
        let off = points.iter().filter(|p| p[0] <= 2.0).map(|[x, y]| (y - x * (2.0 - x)).abs());
        assert!(off.fold(0.0, f64::max) < 1e-12);
        let below = points.iter().filter(|p| p[0] > 2.0).map(|[x, y]| (y + (x - 2.0) * (4.0 - x)).abs());
        assert!(below.fold(0.0, f64::max) < 1e-12, "T continues the curve on the other side");
    }

    #[test]
    fn what_is_no_path_is_refused() {
        for wrong in ["M", "M1", "M1 2L", "M1 2A1 1 0 2 0 3 3", "L1 2", "M1 2W3"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
