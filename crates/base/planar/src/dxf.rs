//! Outlines in DXF drawings: polylines with bulges, circles, and polylines in the format of release 12.

use crate::Point;
use crate::svg::Polyline;
use std::fmt::Write;

/// Why a drawing cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DxfError {
    /// Lines are not pairs of a group code and a value.
    #[error("line {line}: `{found}` is no group code")]
    Code {
        /// Its number.
        line: usize,
        /// What stands there.
        found: String,
    },
    /// A coordinate is not a number.
    #[error("line {line}: `{found}` is not a number")]
    Number {
        /// Its number.
        line: usize,
        /// What stands there.
        found: String,
    },
}

/// Chords of a full circle.
const CIRCLE: usize = 128;

/// The polylines and circles of a drawing, in its order; arcs become chords. `id` is the layer.
///
/// # Limits
/// LINE, ARC, SPLINE and blocks are ignored; units are those of the drawing, y upwards.
///
/// # Errors
/// [`DxfError`] with the line.
pub fn read(text: &str) -> Result<Vec<Polyline>, DxfError> {
    let mut found = Vec::new();
    let mut entity = Entity::default();
    let mut lines = text.lines().enumerate();
    while let (Some((at, code)), Some((_, value))) = (lines.next(), lines.next()) {
        let code: i32 = code
            .trim()
            .parse()
            .map_err(|_| DxfError::Code { line: at + 1, found: code.trim().chars().take(20).collect() })?;
        let value = value.trim();
        let number = || -> Result<f64, DxfError> {
            let wrong = || DxfError::Number { line: at + 2, found: value.chars().take(20).collect() };
            value.parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(wrong)
        };
        match code {
            0 if value == "VERTEX" && entity.kind == "POLYLINE" => entity.is_vertex = true,
            0 => {
                found.extend(std::mem::take(&mut entity).polyline());
                value.clone_into(&mut entity.kind);
            }
            8 if !entity.is_vertex => value.clone_into(&mut entity.layer),
            70 if !entity.is_vertex => entity.is_closed = number()? as i64 & 1 == 1,
            10 if entity.has_corners() => entity.corners.push(([number()?, 0.0], 0.0)),
            20 if entity.has_corners() => {
                if let Some(last) = entity.corners.last_mut() {
                    last.0[1] = number()?;
                }
            }
            42 if entity.has_corners() => {
                if let Some(last) = entity.corners.last_mut() {
                    last.1 = number()?;
                }
            }
            10 if entity.kind == "CIRCLE" => entity.centre[0] = number()?,
            20 if entity.kind == "CIRCLE" => entity.centre[1] = number()?,
            40 if entity.kind == "CIRCLE" => entity.radius = number()?,
            _ => (),
        }
    }
    found.extend(entity.polyline());
    Ok(found)
}

#[derive(Default)]
struct Entity {
    kind: String,
    layer: String,
    is_closed: bool,
    is_vertex: bool,
    corners: Vec<(Point, f64)>,
    centre: Point,
    radius: f64,
}

impl Entity {
    fn has_corners(&self) -> bool {
        self.kind == "LWPOLYLINE" || self.is_vertex
    }

    fn polyline(self) -> Option<Polyline> {
        if self.kind == "CIRCLE" && self.radius > 0.0 {
            let place = |i: usize| {
                let angle = std::f64::consts::TAU * i as f64 / CIRCLE as f64;
                [
                    self.centre[0] + self.radius * libm::cos(angle),
                    self.centre[1] + self.radius * libm::sin(angle),
                ]
            };
            return Some(Polyline {
                id: self.layer,
                points: (0..CIRCLE).map(place).collect(),
                is_closed: true,
            });
        }
        if self.corners.is_empty() {
            return None;
        }
        let n = self.corners.len();
        let mut points = Vec::new();
        for (i, (p, bulge)) in self.corners.iter().enumerate() {
            points.push(*p);
            if *bulge != 0.0 && (self.is_closed || i + 1 < n) {
                points.extend(arc(*p, self.corners[(i + 1) % n].0, *bulge));
            }
        }
        Some(Polyline { id: self.layer, points, is_closed: self.is_closed })
    }
}

/// The points between the ends of an arc. Its bulge is the tangent of a quarter of its angle, positive counter-clockwise.
fn arc(from: Point, to: Point, bulge: f64) -> Vec<Point> {
    let angle = 4.0 * libm::atan(bulge);
    let chords = ((angle.abs() / std::f64::consts::TAU * CIRCLE as f64).ceil() as usize).max(2);
    let chord = [to[0] - from[0], to[1] - from[1]];
    // The centre lies to the left of the chord, at half the chord divided by the tangent of half the angle.
    let h = 0.5 * (1.0 - bulge * bulge) / (2.0 * bulge);
    let centre = [0.5 * (from[0] + to[0]) - h * chord[1], 0.5 * (from[1] + to[1]) + h * chord[0]];
    (1..chords)
        .map(|i| {
            let a = angle * i as f64 / chords as f64;
            let (s, c) = (libm::sin(a), libm::cos(a));
            let v = [from[0] - centre[0], from[1] - centre[1]];
            [centre[0] + c * v[0] - s * v[1], centre[1] + s * v[0] + c * v[1]]
        })
        .collect()
}

/// A drawing of polylines, each on the layer named by its `id` ("0" if empty), with y reversed on request.
pub fn write(polylines: &[Polyline], flip: bool) -> String {
    let mut text = String::from("0\nSECTION\n2\nENTITIES\n");
    for polyline in polylines {
        let layer: String =
            polyline.id.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        let layer = if layer.is_empty() { "0" } else { &layer };
        let _ = write!(text, "0\nPOLYLINE\n8\n{layer}\n66\n1\n70\n{}\n", u8::from(polyline.is_closed));
        for [x, y] in &polyline.points {
            let y = if flip { -y } else { *y };
            let _ = write!(text, "0\nVERTEX\n8\n{layer}\n10\n{x}\n20\n{y}\n30\n0\n");
        }
        let _ = write!(text, "0\nSEQEND\n8\n{layer}\n");
    }
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_reads_back() {
        let square = Polyline {
            id: "piece_1".into(),
            points: vec![[0.1, 0.0], [1.0, 0.5], [1.0, 1.0 / 3.0]],
            is_closed: true,
        };
        let line = Polyline { id: "cut".into(), points: vec![[5.0, 6.0], [7.0, 8.0]], is_closed: false };
        let all = vec![square, line];
        assert_eq!(read(&write(&all, false)).unwrap(), all);
    }

    #[test]
    fn bulges_and_circles_are_round() {
        let text = "0\nLWPOLYLINE\n8\nA\n90\n2\n70\n1\n10\n1\n20\n0\n42\n1\n10\n-1\n20\n0\n42\n1\n0\nCIRCLE\n10\n5\n20\n0\n40\n2\n0\nEOF\n";
        let found = read(text).unwrap();
        assert_eq!(found.len(), 2);
        assert!(found[0].points.iter().all(|[x, y]| ((x * x + y * y).sqrt() - 1.0).abs() < 1e-12));
        assert!(found[0].points.iter().any(|p| p[1] < -0.9) && found[0].points.iter().any(|p| p[1] > 0.9));
        assert_eq!(found[1].points.len(), CIRCLE);
        assert!(matches!(read("0\nLWPOLYLINE\n10\nx\n"), Err(DxfError::Number { line: 4, .. })));
        assert!(matches!(read("hello\nworld\n"), Err(DxfError::Code { line: 1, .. })));
    }
}
