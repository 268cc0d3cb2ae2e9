//! The worst rounding errors of kernels on adversarial inputs, measured in exact arithmetic, beside the bounds that are derived.
//!
//! `cargo run -p pompeiu-verify --example rounding -- 1000000` prints comma-separated values: the kernel, the number of cases, the bound, and the
//! worst that was seen, in units of `2^-53 M` with M the largest coordinate that the kernel computes with.
#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a measurement prints, and stops at what it does not expect"
)]

use dashu_int::IBig;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::point_triangle::distance_sq;
use pompeiu_testkit::exact::{Lattice, Point, point_triangle_sq};
use pompeiu_verify::kernel::{Corner, Facet, between, whole};

type Triangle = [[f64; 3]; 3];

/// A generator of numbers that are random enough (xorshift), the same in every run.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, n: u64) -> u64 {
        (self.bits() >> 11) % n
    }

    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn point(&mut self) -> [f64; 3] {
        [0; 3].map(|_| {
            if self.below(4) == 0 { self.below(9) as f64 * 0.25 - 1.0 } else { 2.0 * self.unit() - 1.0 }
        })
    }

    /// A needle, a cap, a short side, a segment or a plain triangle.
    fn triangle(&mut self) -> Triangle {
        let [p, q, r] = [0; 3].map(|_| self.point());
        let width = 10_f64.powi(-(self.below(18) as i32));
        let t = self.unit();
        let on = [0, 1, 2].map(|k| p[k] + t * (q[k] - p[k]));
        let beside = |s: [f64; 3]| [0, 1, 2].map(|k| s[k] + width * (r[k] - s[k]));
        match self.below(5) {
            0 => [p, q, r],
            1 => [p, q, beside(q)],
            2 => [p, q, beside(on)],
            3 => [p, beside(p), r],
            _ => [p, q, on],
        }
    }

    /// Two triangles; the second near the first, or both away from the origin, or neither.
    fn pair(&mut self) -> (Triangle, Triangle) {
        let (a, b) = (self.triangle(), self.triangle());
        let width = 10_f64.powi(-(self.below(17) as i32));
        let away = [0.0, 0.0, 0.0, 1000.0][self.below(4) as usize];
        let near = self.below(2) == 0;
        let b = [0, 1, 2].map(|i| [0, 1, 2].map(|k| if near { a[i][k] + width * b[i][k] } else { b[i][k] }));
        (a.map(|p| p.map(|x| x + away)), b.map(|p| p.map(|x| x + away)))
    }
}

fn size<'p>(points: impl Iterator<Item = &'p [f64; 3]>) -> f64 {
    points.flatten().fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// A corner after some cuts, and its exact weights.
fn cut(random: &mut Random, a: Triangle, cuts: usize) -> (Corner, [IBig; 3]) {
    let one = IBig::from(1_u64 << 52);
    let mut corners = whole(a);
    let mut weights = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|w| w.map(IBig::from));
    let mut last = random.below(3) as usize;
    for _ in 0..cuts {
        let other = (last + 1 + random.below(2) as usize) % 3;
        let t = random.bits() >> 12;
        corners[last] = between(&corners[last], &corners[other], t as f64 / (1_u64 << 52) as f64);
        let sum = |w: &[IBig; 3]| &w[0] + &w[1] + &w[2];
        let (p, q, t) = (weights[last].clone(), weights[other].clone(), IBig::from(t));
        weights[last] = [0, 1, 2].map(|i| (&one - &t) * &p[i] * sum(&q) + &t * &q[i] * sum(&p));
        last = other;
    }
    (corners[last], weights[last].clone())
}

/// What was seen of one kernel.
struct Row {
    kernel: &'static str,
    bound: &'static str,
    worst: f64,
}

fn main() {
    let cases: u64 = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(100_000);
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let row = |kernel, bound| Row { kernel, bound, worst: f64::NEG_INFINITY };
    let mut rows = [
        row("verifier: distance computed, below the exact one (1 rounding per corner)", "13 sqrt(3) = 22.5"),
        row("verifier: at_most above the exact distance", "none: costs tightness"),
        row("verifier: at_most below the exact distance", "0"),
        row("verifier: at_least above the exact distance", "0"),
        row("verifier: at_least below the exact distance", "none: costs tightness"),
        row("verifier: after 8 cuts, at_most below the exact distance", "0"),
        row("engine: distance computed, below the exact one", "43"),
        row("engine: distance computed, above the exact one", "43"),
    ];
    let unit = f64::EPSILON / 2.0;
    for _ in 0..cases {
        let (a, b) = random.pair();
        let positions = [a, b].concat();
        let lattice = Lattice::of(&[&TriMesh::new(positions, vec![[0, 1, 2], [3, 4, 5]]).unwrap()]);
        let (exact_a, exact_b) = (lattice.triangle(a), lattice.triangle(b));
        let local = size(
            [a, b].concat().iter().map(|p| [0, 1, 2].map(|k| p[k] - a[0][k])).collect::<Vec<_>>().iter(),
        );
        if local == 0.0 {
            continue;
        }
        let mut see = |i: usize, error: f64, size: f64| {
            let worst = error / (unit * size);
            if worst > rows[i].worst {
                rows[i].worst = worst;
            }
        };
        let root = |x: &Point| lattice.length(&point_triangle_sq(x, &exact_b));
        let facet = Facet::new(b, a[0]);
        let length = |d: [f64; 3]| (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
        let (x, weights) = cut(&mut random, a, 0);
        let exact = root(&Lattice::integer_mean(&exact_a, &weights));
        see(0, exact - length(facet.to(x.offset)), local);
        see(1, facet.at_most(&x) - exact, local);
        see(2, exact - facet.at_most(&x), local);
        let low = facet.at_least(&x, f64::INFINITY).max(0.0);
        see(3, low - exact, local);
        see(4, exact - low, local);
        let (x, weights) = cut(&mut random, a, 8);
        see(5, root(&Lattice::integer_mean(&exact_a, &weights)) - facet.at_most(&x), local);
        let plain = root(&lattice.point(a[0]));
        let computed = distance_sq(a[0], b[0], b[1], b[2]).sqrt();
        let largest = size([a, b].concat().iter());
        see(6, plain - computed, largest);
        see(7, computed - plain, largest);
    }
    println!("kernel,cases,bound,worst");
    for row in &rows {
        println!("\"{}\",{cases},{},{:.2}", row.kernel, row.bound, row.worst);
    }
}
