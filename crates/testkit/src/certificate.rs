//! What a certificate of a distance states, judged in exact arithmetic: a reader of the format that shares no code with the verifier, for
//! certificates that a verifier has accepted.

use crate::exact::{Lattice, point_triangle_sq};
use dashu_int::IBig;
use pompeiu_core::{FaceId, TriMesh};

/// Reads trees as the guide describes them, with corners as exact weights, and asks of every leaf whether its corners are near.
struct Judge<'j> {
    lattice: Lattice,
    a: &'j TriMesh,
    b: &'j TriMesh,
    bytes: &'j [u8],
}

/// A corner: integer weights of the corners of the face, and the offset that the format computes from the first of them.
#[derive(Clone, Debug)]
struct Exact {
    weights: [IBig; 3],
    offset: [f64; 3],
}

fn minus(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| p[k] - q[k])
}

fn cross(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

impl Exact {
    fn between(p: &Self, q: &Self, t: f64) -> Self {
        const PLACES: f64 = (1_u64 << 52) as f64;
        let (one, part) = (IBig::from(1_u64 << 52), IBig::from((t * PLACES) as u64));
        assert!(t * PLACES == (t * PLACES).trunc());
        // Both with weights of the same sum first.
        let sum = |x: &Self| &x.weights[0] + &x.weights[1] + &x.weights[2];
        let (sp, sq) = (sum(p), sum(q));
        let weights = [0, 1, 2].map(|i| (&one - &part) * &p.weights[i] * &sq + &part * &q.weights[i] * &sp);
        Self { weights, offset: [0, 1, 2].map(|k| (1.0 - t) * p.offset[k] + t * q.offset[k]) }
    }
}

impl Judge<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let (head, rest) = self.bytes.split_at(N);
        self.bytes = rest;
        head.try_into().expect("a certificate that a verifier accepts")
    }

    fn number(&mut self) -> u64 {
        let byte = u64::from(self.take::<1>()[0]);
        if byte < 128 { byte } else { byte - 128 + 128 * self.number() }
    }

    fn place(&mut self, count: u64) -> f64 {
        let value = (0..count).fold(0, |value, _| 256 * value + u64::from(self.take::<1>()[0]));
        value as f64 / if count == 7 { (1_u64 << 52) as f64 } else { (1_u64 << (8 * count)) as f64 }
    }

    /// Whether the witness is as far from every face of B as it is said to be.
    fn is_far(&mut self, lower: f64) -> bool {
        let face = u32::from_le_bytes(self.take());
        let weights = [self.take(), self.take(), self.take()].map(f64::from_le_bytes);
        if lower == 0.0 {
            return true;
        }
        let x = self.lattice.mean(&self.lattice.triangle(self.a.corners(FaceId(face))), weights);
        let limit = self.lattice.length_sq(lower);
        let triangle = |f| self.lattice.triangle(self.b.corners(f));
        self.b.face_ids().all(|f| point_triangle_sq(&x, &triangle(f)) >= limit)
    }

    /// Whether each cell of one direction is near its face.
    fn direction(&mut self) -> bool {
        let [lower, upper] = [self.take::<8>(), self.take::<8>()].map(f64::from_le_bytes);
        let is_far = self.is_far(lower);
        let limit = self.lattice.length_sq(upper);
        let count = self.a.faces().len();
        let mut is_near = is_far;
        let (mut last, mut run) = (0_i64, 0);
        for face in 0..count {
            if face % 4096 == 0 {
                self.take::<4>();
                last = 0;
            }
            let corners = self.a.corners(FaceId(face as u32));
            let triangle = self.lattice.triangle(corners);
            let weights = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|w| w.map(IBig::from));
            let whole = [0, 1, 2]
                .map(|i| Exact { weights: weights[i].clone(), offset: minus(corners[i], corners[0]) });
            let mut waiting = vec![whole.to_vec()];
            let mut first = true;
            while let Some(mut polygon) = waiting.pop() {
                if run > 0 {
                    run -= 1;
                } else {
                    let code = self.number();
                    let n = polygon.len();
                    if code % 4 == 1 {
                        let sides = (code / 256) as usize;
                        let (i, j) = (sides / n, sides % n);
                        let (s, t) = (self.place(code / 32 % 8), self.place(code / 4 % 8));
                        waiting.push(part(&polygon, (j, t), (i, s)));
                        waiting.push(part(&polygon, (i, s), (j, t)));
                        first = false;
                        continue;
                    }
                    let z = if code % 4 == 2 { code / 32 } else { code / 4 };
                    let size = z.div_ceil(2).cast_signed();
                    last += if z % 2 == 0 { size } else { -size };
                    if code % 4 == 2 {
                        let to = self.b.corners(FaceId(last as u32)).map(|p| minus(p, corners[0]));
                        for side in (0..3).filter(|side| (code / 4) >> side & 1 == 1) {
                            let edge = minus(to[(side + 1) % 3], to[side]);
                            let inward = cross(cross(minus(to[1], to[0]), minus(to[2], to[0])), edge);
                            let [out, back] = crossing(inward, to[side], &polygon);
                            waiting.push(part(&polygon, out, back));
                            polygon = part(&polygon, back, out);
                        }
                    }
                    run = if first && code == 0 { self.number() } else { 0 };
                }
                first = false;
                let near = self.lattice.triangle(self.b.corners(FaceId(last as u32)));
                is_near &= polygon.iter().all(|x| {
                    point_triangle_sq(&Lattice::integer_mean(&triangle, &x.weights), &near) <= limit
                });
            }
        }
        is_near
    }
}

fn crossing(inward: [f64; 3], from: [f64; 3], polygon: &[Exact]) -> [(usize, f64); 2] {
    let heights: Vec<f64> = polygon
        .iter()
        .map(|x| {
            let d = minus(x.offset, from);
            inward[0] * d[0] + inward[1] * d[1] + inward[2] * d[2]
        })
        .collect();
    let n = polygon.len();
    [false, true].map(|back| {
        let i = (0..n)
            .find(|&i| (heights[i] >= 0.0) != back && (heights[(i + 1) % n] >= 0.0) == back)
            .expect("a certificate that a verifier accepts");
        let t = heights[i] / (heights[i] - heights[(i + 1) % n]);
        let places = (1_u64 << 52) as f64;
        let t = (t * places).floor() / places;
        if t < 1.0 { (i, t) } else { ((i + 1) % n, 0.0) }
    })
}

fn part(polygon: &[Exact], (i, s): (usize, f64), (j, t): (usize, f64)) -> Vec<Exact> {
    let n = polygon.len();
    let end = |i: usize, t: f64| {
        if t == 0.0 { polygon[i].clone() } else { Exact::between(&polygon[i], &polygon[(i + 1) % n], t) }
    };
    let mut corners = vec![end(i, s)];
    let count = (j + n - i) % n;
    corners.extend((1..=count).map(|step| polygon[(i + step) % n].clone()));
    corners.extend((t != 0.0).then(|| end(j, t)));
    corners
}

/// Whether what a certificate says of each cell is true, in exact arithmetic.
pub fn is_true(a: &TriMesh, b: &TriMesh, bytes: &[u8]) -> bool {
    let directions = bytes[72];
    let lattice = Lattice::of(&[a, b]);
    let mut judge = Judge { lattice, a, b, bytes: &bytes[73..] };
    let mut is_true = true;
    for direction in 0..2 {
        (judge.a, judge.b) = if direction == 0 { (a, b) } else { (b, a) };
        is_true &= directions >> direction & 1 == 0 || judge.direction();
    }
    assert!(judge.bytes.is_empty());
    is_true
}
