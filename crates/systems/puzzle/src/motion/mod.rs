//! Finite motions: disassembly of a free puzzle, and random shaking.

mod bodies;

use crate::{Lock, Proof, Puzzle};
use bodies::{Bodies, Place, TOUCH};
use pompeiu_core::mesh::edit::Random;
use pompeiu_core::run::Control;
use pompeiu_planar::Point;

/// Step length, relative to the mean side of a piece: longer steps would jump over details of tabs.
const STEP: f64 = 0.004;

/// Number of steps of a disassembly, and steps per frame.
const STEPS: usize = 480;
const FRAME: usize = 8;

/// Rounds of separating overlapping pieces after a step.
const ROUNDS: usize = 40;

/// A motion is stuck if its steps become shorter than this share of their nominal length.
const STUCK: f64 = 0.1;

/// A motion that takes a puzzle apart, as far as it was followed.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// For each frame and piece the displacement of its centroid and its rotation, in radians; the first frame is the assembled
    /// puzzle.
    pub frames: Vec<Vec<[f64; 3]>>,
    /// The centroids of the pieces in the assembled puzzle.
    pub centres: Vec<[f64; 2]>,
    /// Whether the moving pieces have left the others: their bounding boxes no longer overlap.
    pub is_apart: bool,
}

impl Motion {
    /// The moving pieces.
    pub fn moving(&self) -> impl Iterator<Item = usize> + '_ {
        let last = self.frames.last().map_or(&[][..], Vec::as_slice);
        last.iter().enumerate().filter(|(_, place)| **place != [0.0; 3]).map(|(piece, _)| piece)
    }

    /// The outline of a piece in a frame.
    pub fn outline(&self, puzzle: &Puzzle, piece: usize, frame: usize) -> Vec<Point> {
        let ([dx, dy, turn], [x, y]) = (self.frames[frame][piece], self.centres[piece]);
        let (sine, cosine) = libm::sincos(turn);
        let place = |p: Point| {
            let (u, v) = (p[0] - x, p[1] - y);
            [x + dx + cosine * u - sine * v, y + dy + sine * u + cosine * v]
        };
        puzzle.outline(piece).into_iter().map(place).collect()
    }

    /// The path of the centroid of a piece.
    pub(crate) fn way(&self, piece: usize) -> Vec<Point> {
        let [x, y] = self.centres[piece];
        self.frames.iter().map(|frame| [x + frame[piece][0], y + frame[piece][1]]).collect()
    }
}

/// Directions in which a cluster is pulled if its first motion gets stuck.
const DIRECTIONS: usize = 16;

/// Follows a motion by which a puzzle comes apart, in steps of 0.004 of a piece's side; after each step overlapping pieces are
/// separated. `None` if no motion is known, or all that were tried get stuck.
///
/// First it tries the motion of the lock. That motion may lie on the boundary of the possible ones and lead into other pieces at
/// once, so a single moving cluster is also pulled in 16 directions. The first motion that separates the pieces is returned,
/// otherwise the one that goes farthest. Once the control stops, no motion is followed further.
///
/// # Accuracy
/// Pieces may overlap by up to 0.001 of a piece's side on their way. The motion is an illustration; the proof is that of
/// [`crate::lock`].
pub fn take_apart(puzzle: &Puzzle, lock: &Lock, control: &Control) -> Option<Motion> {
    let twists = &lock.escape.as_ref()?.twists;
    let bodies = Bodies::new(puzzle)?;
    let is_fixed: Vec<bool> = twists.iter().map(|twist| *twist == [0.0; 3]).collect();
    let of_lock = (0..twists.len()).map(|i| {
        let ([vx, vy, w], [x, y]) = (twists[i], bodies.centre(i));
        [vx - w * y, vy + w * x, w]
    });
    let of_lock: Vec<Place> = of_lock.collect();
    let directions = (0..DIRECTIONS).filter(|_| lock.proof == Proof::OneMoves).map(|k| {
        let (sine, cosine) = libm::sincos(std::f64::consts::TAU * k as f64 / DIRECTIONS as f64);
        is_fixed.iter().map(|fixed| if *fixed { [0.0; 3] } else { [cosine, sine, 0.0] }).collect()
    });
    let mut farthest: Option<Motion> = None;
    for velocity in std::iter::once(of_lock).chain(directions) {
        let motion = follow(&bodies, &is_fixed, velocity, control);
        if motion.is_apart {
            return Some(motion);
        }
        if farthest.as_ref().is_none_or(|known| known.frames.len() < motion.frames.len()) {
            farthest = Some(motion);
        }
        if control.is_stopped() {
            break;
        }
    }
    farthest.filter(|motion| motion.frames.len() > 2)
}

/// Continues in the direction in which pieces went after they were separated, until they are apart or stuck.
fn follow(bodies: &Bodies, is_fixed: &[bool], mut velocity: Vec<Place>, control: &Control) -> Motion {
    let n = is_fixed.len();
    let mut places = vec![[0.0; 3]; n];
    let mut frames = vec![places.clone()];
    let mut is_apart = false;
    for step in 1..=STEPS {
        let speed = largest(bodies, &velocity);
        if speed == 0.0 || control.is_stopped() {
            break;
        }
        let before = places.clone();
        for (place, v) in places.iter_mut().zip(&velocity) {
            (0..3).for_each(|k| place[k] += STEP * bodies.unit * v[k] / speed);
        }
        let depth = bodies.relax(&mut places, is_fixed, ROUNDS);
        if depth > 10.0 * TOUCH * bodies.unit {
            places = before;
            break;
        }
        velocity = difference(&places, &before);
        if largest(bodies, &velocity) < STUCK * STEP * bodies.unit {
            break;
        }
        if step % FRAME == 0 {
            frames.push(places.clone());
            is_apart = is_fixed.contains(&true) && has_left(bodies, &places, is_fixed);
            if is_apart {
                break;
            }
        }
    }
    if frames.last() != Some(&places) {
        frames.push(places);
    }
    Motion { frames, centres: (0..n).map(|i| bodies.centre(i)).collect(), is_apart }
}

/// Whether the bounding box of no moving piece overlaps that of a stationary one.
fn has_left(bodies: &Bodies, places: &[Place], is_fixed: &[bool]) -> bool {
    let (stay, leave): (Vec<usize>, Vec<usize>) = (0..is_fixed.len()).partition(|i| is_fixed[*i]);
    leave.iter().all(|i| stay.iter().all(|j| !bodies.meet(places, [*i, *j])))
}

/// Steps of shaking; a puzzle has moved if it went the second number as a share of them.
const SHAKES: usize = 6;
const MOVED: f64 = 0.4;

/// Rounds of separating overlapping pieces after a random displacement.
const KICK_ROUNDS: usize = 200;

/// Whether pieces move when shaken. Each try displaces all of them, or one, by 0.004 of a piece's side in random directions,
/// separates overlapping pieces, and continues in the resulting direction. Returns the final poses relative to the first piece;
/// `None` if pieces always return.
///
/// It uses no contacts or directions, only point-in-polygon tests: an independent check of [`crate::lock`].
///
/// # Limits
/// Locks of less than about 0.001 of a piece's side are not detected, and a motion that few displacements start may be missed.
pub fn shake(puzzle: &Puzzle, tries: usize, seed: u64) -> Option<Vec<[f64; 3]>> {
    let bodies = Bodies::new(puzzle)?;
    let n = puzzle.pieces();
    let mut random = Random::new(seed);
    let mut is_fixed = vec![false; n];
    is_fixed[0] = true;
    (0..tries).find_map(|kick| {
        let only = (kick % 2 == 1).then(|| random.below(n as u32) as usize);
        let mut velocity: Vec<Place> = (0..n)
            .map(|i| {
                let of =
                    [random.signed_unit(), random.signed_unit(), random.signed_unit() / bodies.gyration(i)];
                // The first piece is fixed by moving all others instead.
                let is_kicked = only.is_none_or(|one| one == i || (one == 0 && i > 0));
                if i > 0 && is_kicked { of } else { [0.0; 3] }
            })
            .collect();
        if only == Some(0) {
            let all = velocity[n - 1];
            for (i, v) in velocity.iter_mut().enumerate().skip(1) {
                let [x, y] = [0, 1].map(|k| bodies.centre(i)[k] - bodies.centre(0)[k]);
                *v = [all[0] - all[2] * y, all[1] + all[2] * x, all[2]];
            }
        }
        let mut places = vec![[0.0; 3]; n];
        for _ in 0..SHAKES {
            let speed = largest(&bodies, &velocity);
            if speed == 0.0 {
                return None;
            }
            let before = places.clone();
            for (place, v) in places.iter_mut().zip(&velocity) {
                (0..3).for_each(|k| place[k] += STEP * bodies.unit * v[k] / speed);
            }
            if bodies.relax(&mut places, &is_fixed, KICK_ROUNDS) > 2.0 * TOUCH * bodies.unit {
                return None;
            }
            velocity = difference(&places, &before);
            if largest(&bodies, &velocity) < STUCK * STEP * bodies.unit {
                return None;
            }
        }
        (largest(&bodies, &places) >= MOVED * SHAKES as f64 * STEP * bodies.unit).then_some(places)
    })
}

/// The greatest length of a change of poses, with rotations scaled by the radius of gyration.
fn largest(bodies: &Bodies, change: &[Place]) -> f64 {
    let length = |(i, [x, y, w]): (usize, &Place)| libm::hypot(libm::hypot(*x, *y), w * bodies.gyration(i));
    change.iter().enumerate().map(length).fold(0.0, f64::max)
}

fn difference(now: &[Place], then: &[Place]) -> Vec<Place> {
    now.iter().zip(then).map(|(a, b)| [a[0] - b[0], a[1] - b[1], a[2] - b[2]]).collect()
}
