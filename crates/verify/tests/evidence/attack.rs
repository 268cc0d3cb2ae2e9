//! An adversary that is linked to the verifier under test: it cuts at random, asks the verifier's own kernels for the least claims that these
//! would accept, and writes a certificate of them. Whatever is then accepted is judged in exact arithmetic, cell by cell.

use pompeiu_core::TriMesh;
use pompeiu_testkit::certificate::is_true;
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::strategies::pair;
use pompeiu_verify::kernel::{Corner, End, Facet, part, whole};
use pompeiu_verify::{MAGIC, Pair, Soup, Waiting, Witness, verify};
use proptest::prelude::*;

/// Numbers that the adversary draws, again and again.
struct Draws<'d>(std::iter::Cycle<std::slice::Iter<'d, u64>>);

impl Draws<'_> {
    fn below(&mut self, n: usize) -> usize {
        (*self.0.next().unwrap() % n as u64) as usize
    }
}

struct Forger<'f> {
    pair: &'f Pair<'f>,
    faces: usize,
    draws: Draws<'f>,
    bytes: Vec<u8>,
    last: i64,
    /// What its leaves need.
    upper: f64,
}

impl Forger<'_> {
    fn number(&mut self, mut value: u64) {
        while value > 127 {
            self.bytes.push(value as u8 | 128);
            value >>= 7;
        }
        self.bytes.push(value as u8);
    }

    fn zigzag(&mut self, face: usize) -> u64 {
        let face = face.cast_signed() as i64;
        let step = face - self.last;
        self.last = face;
        (step << 1 ^ step >> 63).cast_unsigned()
    }

    /// The face that is nearest to all corners of a polygon, as the verifier sees it, and how near.
    fn best(&self, polygon: &[Corner], origin: [f64; 3]) -> (usize, f64) {
        let near = |f: usize| {
            let facet = Facet::new(self.pair.b.triangle(f), origin);
            (f, polygon.iter().map(|x| facet.at_most(x)).fold(0.0, f64::max))
        };
        (0..self.faces).map(near).min_by(|x, y| x.1.total_cmp(&y.1)).unwrap()
    }

    fn end(&mut self, side: usize) -> (End, u32) {
        let bytes = [0, 1, 2, 7][self.draws.below(4)];
        let value = self.draws.below(1 << (8 * bytes).min(52));
        let places = if bytes == 7 { 1_u64 << 52 } else { 1 << (8 * bytes) };
        (End { side, t: value as f64 / places as f64 }, bytes)
    }

    fn tree(&mut self, face: [[f64; 3]; 3]) {
        let mut waiting = Waiting::default();
        let mut polygon = whole(face).to_vec();
        let mut cuts = self.draws.below(5);
        let mut is_whole = true;
        loop {
            let n = polygon.len();
            let kind = if cuts > 0 && n > 2 && n < 40 { self.draws.below(3) } else { 2 };
            if kind == 0 {
                let i = self.draws.below(n - 1);
                let j = i + 1 + self.draws.below(n - 1 - i);
                let ((s, b), (t, c)) = (self.end(i), self.end(j));
                self.number(((((i * n + j) as u64) << 6 | u64::from(b) << 3 | u64::from(c)) << 2) | 1);
                for (end, count) in [(s, b), (t, c)] {
                    let places = if count == 7 { 1_u64 << 52 } else { 1 << (8 * count) };
                    let value = (end.t * places as f64) as u64;
                    self.bytes.extend_from_slice(&value.to_be_bytes()[8 - count as usize..]);
                }
                waiting.push(&polygon, t, s);
                waiting.push(&polygon, s, t);
                cuts -= 1;
            } else {
                let (mut f, _) = self.best(&polygon, face[0]);
                let mut sides = 0;
                if kind == 1 {
                    f = self.draws.below(self.faces);
                    let facet = Facet::new(self.pair.b.triangle(f), face[0]);
                    for side in 0..3 {
                        if let Some([out, back]) = facet.crossing(side, &polygon) {
                            waiting.push(&polygon, out, back);
                            let mut inner = Vec::new();
                            part(&polygon, back, out, &mut inner);
                            polygon = inner;
                            sides |= 1 << side;
                        }
                    }
                    cuts -= 1;
                }
                let facet = Facet::new(self.pair.b.triangle(f), face[0]);
                let need = polygon.iter().map(|x| facet.at_most(x)).fold(0.0, f64::max);
                self.upper = self.upper.max(need);
                let z = self.zigzag(f);
                self.number(if sides == 0 { z << 2 } else { (z << 3 | sides) << 2 | 2 });
                if is_whole && sides == 0 && z == 0 {
                    self.number(0);
                }
            }
            is_whole = false;
            if !waiting.pop(&mut polygon) {
                return;
            }
        }
    }
}

/// A certificate of h(A, B) that the linked verifier should just accept.
fn forge(a: &TriMesh, b: &TriMesh, draws: &[u64], weights: [f64; 3]) -> Vec<u8> {
    let [soup_a, soup_b] = [a, b].map(|mesh| Soup::new(mesh.positions(), mesh.faces()).unwrap());
    let pair = Pair::new(&soup_a, &soup_b);
    let draws = Draws(draws.iter().cycle());
    let faces = b.faces().len();
    let mut forger = Forger { pair: &pair, faces, draws, bytes: Vec::new(), last: 0, upper: 0.0 };
    for face in 0..a.faces().len() {
        forger.tree(pair.a.triangle(face));
    }
    let witness = Witness { face: forger.draws.below(a.faces().len()) as u32, weights };
    let (x, origin) = pair.witness(&witness).unwrap();
    let far = |f| Facet::new(pair.b.triangle(f), origin).at_least(&x, f64::INFINITY);
    let lower = (0..faces).map(far).fold(f64::INFINITY, f64::min).max(0.0);
    let mut bytes = MAGIC.to_vec();
    bytes.extend([soup_a.hash(), soup_b.hash()].concat());
    bytes.push(1);
    bytes.extend([lower, forger.upper].map(f64::to_le_bytes).concat());
    bytes.extend(witness.face.to_le_bytes());
    bytes.extend(weights.map(f64::to_le_bytes).concat());
    bytes.extend((forger.bytes.len() as u32).to_le_bytes());
    bytes.extend(forger.bytes);
    bytes
}

fn is_accepted(a: &TriMesh, b: &TriMesh, bytes: &[u8]) -> bool {
    let [a, b] = [a, b].map(|mesh| Soup::new(mesh.positions(), mesh.faces()).unwrap());
    verify(&a, &b, bytes, 1).is_ok()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(3000)))]

    #[test]
    fn the_least_claims_that_are_accepted_are_true(
        (a, b) in pair(),
        draws in prop::collection::vec(any::<u64>(), 1..40),
        weights in [0.0..1.0, 0.0..1.0, 1e-3..1.0_f64],
    ) {
        let bytes = forge(&a, &b, &draws, weights);
        prop_assert!(is_accepted(&a, &b, &bytes), "the verifier refuses what its own kernels accept");
        prop_assert!(is_true(&a, &b, &bytes));
    }

    #[test]
    fn what_is_accepted_after_damage_is_true(
        (a, b) in pair(),
        draws in prop::collection::vec(any::<u64>(), 1..40),
        weights in [0.0..1.0, 0.0..1.0, 1e-3..1.0_f64],
        damage in prop::collection::vec((any::<prop::sample::Index>(), 0..8_u32), 1..3),
    ) {
        let mut bytes = forge(&a, &b, &draws, weights);
        let length = bytes.len() - 73;
        for (at, bit) in damage {
            bytes[73 + at.index(length)] ^= 1 << bit;
        }
        let accepted = is_accepted(&a, &b, &bytes);
        prop_assert!(!accepted || is_true(&a, &b, &bytes));
        // One more byte is a spare one, or the one that damage made it lack.
        let longer = [&bytes[..], &[0]].concat();
        prop_assert!(!is_accepted(&a, &b, &longer) || !accepted && is_true(&a, &b, &longer), "a spare byte");
    }
}
