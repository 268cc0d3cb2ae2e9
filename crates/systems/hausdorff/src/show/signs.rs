//! Signs of drawn distances.

use super::snap::Snap;
use super::triangles::Triangles;
use crate::PreparedPair;
use crate::deviation::{DirectedDeviation, Sides};
use glam::DVec3;

/// Places of a face that are remembered, at most.
const REMEMBERED: usize = 48;

/// Makes distances inside the other mesh negative: at the vertices of a face drawn whole, elsewhere on a part of a face as a whole.
/// `is_part` says of each triangle whether it is a part.
pub(super) fn give(
    triangles: &mut Triangles,
    is_part: &[bool],
    (found, sides): (&DirectedDeviation, &Sides),
    pair: &PreparedPair<'_>,
    snap: &Snap,
) {
    let (mesh, other) = (pair.measured(found.direction), pair.other(found.direction));
    let inside = |v: u32| sides.is_inside(sides.vertex_winding[v as usize]);
    let mut of_parts = Parts::new(is_part.contains(&true) && Sides::are_constant_beside(other));
    let mut face_before = None;
    for (((corners, distances), face), _) in
        triangles.iter().zip(&triangles.faces).zip(is_part).filter(|(_, is_part)| **is_part)
    {
        if face_before != Some(*face) {
            let corners = mesh.faces()[*face as usize];
            let corner = |v: u32| {
                let radius = found.vertices[v as usize] - snap.doubt();
                let at = DVec3::from_array(mesh.positions()[v as usize]);
                Free { at, radius, answer: Answer::Known(inside(v)) }
            };
            of_parts.start(corners.map(corner));
            face_before = Some(*face);
        }
        let corners = corners.map(DVec3::from_array);
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let free = |k: usize| distances[k].abs() - snap.doubt() - corners[k].distance(centre);
        of_parts.add(centre, (0..3).map(free).fold(0.0, f64::max));
    }
    let mut of_parts = of_parts.answers(|points| Sides::of_points(points, other)).into_iter();
    let faces = triangles.faces.iter().zip(is_part);
    for (distances, (face, is_part)) in triangles.distances.iter_mut().zip(faces) {
        let inside = if *is_part {
            [of_parts.next().unwrap_or(false); 3]
        } else {
            mesh.faces()[*face as usize].map(inside)
        };
        for (distance, inside) in distances.iter_mut().zip(inside) {
            if inside {
                *distance = -*distance;
            }
        }
    }
}

/// A place about which nothing of the other surface is within a radius, about.
#[derive(Clone, Copy)]
struct Free {
    at: DVec3,
    radius: f64,
    answer: Answer,
}

/// On which side a place is.
#[derive(Clone, Copy)]
enum Answer {
    Known(bool),
    /// On the side of a place that is asked for.
    As(usize),
}

/// The parts of faces that are drawn, and the few of which it must be asked on which side they are.
struct Parts {
    /// Whether sides change only across the other surface.
    are_shared: bool,
    answers: Vec<Answer>,
    asked: Vec<[f64; 3]>,
    known: Vec<Free>,
}

impl Parts {
    fn new(are_shared: bool) -> Self {
        Self { are_shared, answers: Vec::new(), asked: Vec::new(), known: Vec::new() }
    }

    /// Begins with a face, whose corners are known.
    fn start(&mut self, corners: [Free; 3]) {
        self.known.clear();
        self.known.extend(corners);
    }

    /// Adds a part of the face: one of two places is in the ball about the other where they are on the same side for certain.
    fn add(&mut self, centre: DVec3, radius: f64) {
        let reaches = |known: &&Free| known.at.distance(centre) < known.radius.max(radius);
        let known = self.known.iter().rev().take(REMEMBERED).find(reaches).filter(|_| self.are_shared);
        let answer = known.map_or(Answer::As(self.asked.len()), |known| known.answer);
        if known.is_none() {
            self.asked.push(centre.to_array());
        }
        self.known.push(Free { at: centre, radius, answer });
        self.answers.push(answer);
    }

    /// Whether each part is inside, in the order in which they were added.
    fn answers(&self, ask: impl Fn(&[[f64; 3]]) -> Vec<bool>) -> Vec<bool> {
        let asked = ask(&self.asked);
        let of = |answer: &Answer| match answer {
            Answer::Known(inside) => *inside,
            Answer::As(place) => asked[*place],
        };
        self.answers.iter().map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn free(x: f64, radius: f64, inside: bool) -> Free {
        Free { at: DVec3::new(x, 0.0, 0.0), radius, answer: Answer::Known(inside) }
    }

    #[test]
    fn places_that_reach_each_other_are_on_one_side() {
        for (are_shared, asked) in [(true, 1), (false, 4)] {
            let mut parts = Parts::new(are_shared);
            parts.start([free(0.0, 1.0, true), free(4.0, 0.5, false), free(9.0, 0.0, false)]);
            // In the ball about a corner; a ball about it reaches that one; neither; in the ball about the one before.
            for (x, radius) in [(0.9, 0.0), (3.0, 1.1), (6.0, 0.7), (6.5, 0.0)] {
                parts.add(DVec3::new(x, 0.0, 0.0), radius);
            }
            let answers = parts.answers(|points| {
                assert_eq!(points.len(), asked);
                points.iter().map(|p| p[0] == 6.0 || !are_shared).collect()
            });
            assert_eq!(answers, [true, !are_shared, true, true]);
        }
    }
}
