//! How well clusters tell classes of silhouettes apart, by features: limbs that move, profiles, blobs, polygons, with notches and ragged outlines.
//!
//! The classes are drawn at random from a seed, as are their members. Prints the adjusted Rand index of the default features and of others;
//! with a file, writes all measures of all members there.
//!
//! ```sh
//! cargo run --release --package pompeiu-complexity --example classes -- 1 measures.csv
//! ```

#![allow(clippy::print_stdout, reason = "an example prints")]

use pompeiu_complexity::{AnalyseOptions, Measure, Shape, adjusted_rand, analyse};
use pompeiu_core::mesh::edit::Random;
use pompeiu_planar::contour::contours;
use pompeiu_planar::{Outline, Point};
use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Classes of each kind, and members of each class.
const OF_EACH_KIND: usize = 14;
const MEMBERS: usize = 20;

/// Pixels across that the silhouettes are drawn in.
const PIXELS: usize = 200;

fn main() -> Outcome<()> {
    let mut arguments = std::env::args().skip(1);
    let seed = arguments.next().map_or(Ok(1), |text| text.parse())?;
    let mut random = Random::new(seed);
    let kinds: [fn(&mut Random) -> Class; 5] = [limbs, profile, blob, polygon, star];
    let (mut shapes, mut classes) = (Vec::new(), Vec::new());
    for kind in 0..kinds.len() * OF_EACH_KIND {
        let class = kinds[kind % kinds.len()](&mut random);
        for member in 0..MEMBERS {
            let outline = class.member(&mut random)?;
            shapes.push(Shape { file: format!("{kind}-{member}"), outline });
            classes.push(kind);
        }
    }
    let defaults = AnalyseOptions::default().features;
    let lists = [defaults, vec!["log:peaks".to_owned(), "log:total-curvature".to_owned()]];
    for features in lists {
        let options = AnalyseOptions {
            clusters: Some(kinds.len() * OF_EACH_KIND),
            features: features.clone(),
            ..AnalyseOptions::default()
        };
        let report = analyse(&shapes, &options)?;
        let found = report.clusters.and_then(|clusters| adjusted_rand(&clusters.labels, &classes));
        println!("{:.3}  {}", found.unwrap_or(0.0), features.join(", "));
        if let Some(path) = arguments.next() {
            let mut text =
                format!("class,{}\n", Measure::ALL.iter().map(|m| m.name).collect::<Vec<_>>().join(","));
            for (shape, class) in report.shapes.iter().zip(&classes) {
                write!(text, "{class}")?;
                Measure::ALL.iter().try_for_each(|m| write!(text, ",{}", m.value(&shape.measures)))?;
                text.push('\n');
            }
            std::fs::write(path, text)?;
        }
    }
    Ok(())
}

/// A class of silhouettes.
enum Class {
    /// Segments from a joint of an earlier one on: that one, share along it, angle from it, length, widths at both ends.
    Limbs(Vec<(usize, f64, f64, f64, [f64; 2])>),
    /// A closed curve.
    Curve(Vec<Point>),
}

fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * 0.5 * (1.0 + random.signed_unit())
}

fn limbs(random: &mut Random) -> Class {
    let body = [between(random, 0.15, 0.4), between(random, 0.15, 0.4)];
    let mut all = vec![(0, 0.0, 0.0, 1.0, body)];
    for _ in 0..3 + random.below(5) {
        let of = if random.below(3) == 0 { random.below(all.len() as u32) as usize } else { 0 };
        let wide = between(random, 0.05, 0.16);
        let share = between(random, 0.0, 1.0);
        let angle = between(random, 0.35 * PI, 0.75 * PI) * if random.below(2) == 0 { 1.0 } else { -1.0 };
        all.push((of, share, angle, between(random, 0.4, 1.1), [wide, wide * between(random, 0.3, 1.2)]));
    }
    Class::Limbs(all)
}

/// Symmetric to an axis, like bottles, glasses and keys.
fn profile(random: &mut Random) -> Class {
    let steps = 3 + random.below(4) as usize;
    let widths: Vec<f64> = (0..steps).map(|_| between(random, 0.12, 0.8)).collect();
    let is_sharp = random.below(2) == 0;
    let length = between(random, 1.0, 3.0);
    let at = |t: f64| {
        let x = t * steps as f64;
        let (i, s) = ((x as usize).min(steps - 1), x.fract());
        let next = widths[(i + 1).min(steps - 1)];
        if is_sharp { widths[i] } else { widths[i] + (next - widths[i]) * s * s * (3.0 - 2.0 * s) }
    };
    let side = |sign: f64| (0..400).map(move |i| (f64::from(i) / 400.0, sign)).collect::<Vec<_>>();
    let mut points: Vec<Point> = side(1.0).iter().map(|(t, _)| [length * t, at(*t)]).collect();
    points.extend(side(-1.0).iter().rev().map(|(t, _)| [length * t, -at(*t)]));
    Class::Curve(points)
}

fn polar(radius: impl Fn(f64) -> f64) -> Class {
    let at = |i: i32| {
        let a = TAU * f64::from(i) / 720.0;
        [radius(a) * a.cos(), radius(a) * a.sin()]
    };
    Class::Curve((0..720).map(at).collect())
}

fn blob(random: &mut Random) -> Class {
    let terms: Vec<[f64; 2]> =
        (1..=5).map(|k| [random.signed_unit() * 0.6 / f64::from(k), PI * random.signed_unit()]).collect();
    polar(|a| {
        let sum: f64 = terms.iter().enumerate().map(|(k, [r, p])| r * ((k + 1) as f64 * a + p).cos()).sum();
        libm::exp(sum)
    })
}

fn polygon(random: &mut Random) -> Class {
    let n = 3 + random.below(7) as usize;
    let corners: Vec<Point> = (0..n)
        .map(|i| {
            let a = TAU * (i as f64 + 0.6 * (random.signed_unit() * 0.5)) / n as f64;
            let r = between(random, 0.35, 1.2);
            [r * a.cos(), r * a.sin()]
        })
        .collect();
    Class::Curve(corners)
}

fn star(random: &mut Random) -> Class {
    let arms = f64::from(3 + random.below(9));
    let (depth, sharp) = (between(random, 0.1, 0.6), random.below(2) == 0);
    let flat = between(random, 0.5, 1.0);
    let Class::Curve(points) = polar(|a| {
        let wave = (arms * a).cos();
        1.0 + depth * if sharp { 2.0 * wave.acos() / PI - 1.0 } else { wave }
    }) else {
        unreachable!("polar makes curves")
    };
    Class::Curve(points.into_iter().map(|[x, y]| [x, flat * y]).collect())
}

impl Class {
    /// A member: limbs moved, bent as a whole, notched, ragged, turned and scaled, drawn in pixels.
    fn member(&self, random: &mut Random) -> Outcome<Outline> {
        for _ in 0..20 {
            let field = match self {
                Self::Limbs(limbs) => Some(drawn_limbs(limbs, random)),
                Self::Curve(points) => drawn_curve(points, random),
            };
            let Some(mut values) = field else { continue };
            ragged(&mut values, random);
            let found = contours(&values, PIXELS, 0.0).into_iter().filter(|c| c.is_closed);
            let outlines = found.filter_map(|c| Outline::new(c.points).ok());
            if let Some(outline) = outlines.max_by(|a, b| a.area().total_cmp(&b.area())) {
                return Ok(outline);
            }
        }
        Err("no member".into())
    }
}

/// Depths of pixels: positive inside.
fn field(low: Point, high: Point, turn: f64, depth: impl Fn(Point) -> f64) -> Vec<f32> {
    let middle = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
    let reach = 0.56 * libm::hypot(high[0] - low[0], high[1] - low[1]);
    let (s, c) = turn.sin_cos();
    let at = |i: usize| reach * (2.0 * i as f64 / (PIXELS - 1) as f64 - 1.0);
    (0..PIXELS * PIXELS)
        .map(|i| {
            let [x, y] = [at(i % PIXELS), at(i / PIXELS)];
            (depth([middle[0] + c * x - s * y, middle[1] + s * x + c * y]) / reach) as f32
        })
        .collect()
}

fn bounds(points: &[Point]) -> [Point; 2] {
    let fold = |f: fn(f64, f64) -> f64, from| [0, 1].map(|k| points.iter().map(|p| p[k]).fold(from, f));
    [fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY)]
}

fn drawn_limbs(limbs: &[(usize, f64, f64, f64, [f64; 2])], random: &mut Random) -> Vec<f32> {
    let mut placed: Vec<(Point, f64, f64, [f64; 2])> = Vec::new();
    for (i, &(of, share, angle, length, widths)) in limbs.iter().enumerate() {
        let (from, way) = if i == 0 {
            ([0.0; 2], 0.0)
        } else {
            let (p, way, long, _) = placed[of];
            ([p[0] + share * long * way.cos(), p[1] + share * long * way.sin()], way)
        };
        let angle = angle + 0.35 * random.signed_unit() * f64::from(u8::from(i > 0));
        let length = length * (1.0 + 0.12 * random.signed_unit());
        let widths = widths.map(|w| w * (1.0 + 0.12 * random.signed_unit()));
        placed.push((from, way + angle, length, widths));
    }
    let ends: Vec<Point> =
        placed.iter().flat_map(|(p, a, l, _)| [*p, [p[0] + l * a.cos(), p[1] + l * a.sin()]]).collect();
    let [low, high] = bounds(&ends);
    let room = 0.4;
    let depth = |p: Point| {
        placed
            .iter()
            .map(|(from, way, long, [w0, w1])| {
                let v = [p[0] - from[0], p[1] - from[1]];
                let t = ((v[0] * way.cos() + v[1] * way.sin()) / long).clamp(0.0, 1.0);
                let off = libm::hypot(v[0] - t * long * way.cos(), v[1] - t * long * way.sin());
                w0 + (w1 - w0) * t - off
            })
            .fold(f64::NEG_INFINITY, f64::max)
    };
    field(low.map(|x| x - room), high.map(|x| x + room), PI * random.signed_unit(), depth)
}

fn drawn_curve(points: &[Point], random: &mut Random) -> Option<Vec<f32>> {
    let [low, high] = bounds(points);
    let unit = 0.5 * (high[0] - low[0]).max(high[1] - low[1]);
    let bends: Vec<[f64; 4]> = (0..3)
        .map(|_| {
            let at = [0, 1].map(|k| between(random, low[k], high[k]));
            [at[0], at[1], 0.16 * unit * random.signed_unit(), 0.16 * unit * random.signed_unit()]
        })
        .collect();
    let squeeze = 1.0 + 0.12 * random.signed_unit();
    let bent = |p: &Point| {
        let mut q = *p;
        for [x, y, dx, dy] in &bends {
            let away = ((p[0] - x).powi(2) + (p[1] - y).powi(2)) / (unit * unit);
            let weight = libm::exp(-2.0 * away);
            q = [q[0] + weight * dx, q[1] + weight * dy];
        }
        [squeeze * q[0], q[1]]
    };
    let sides = Outline::new(points.to_vec()).ok()?;
    let outline = Outline::new(pompeiu_planar::resample(&sides, 300, 0).iter().map(bent).collect()).ok()?;
    let [low, high] = outline.bounds();
    // A notch in one of three.
    let notch = (random.below(3) == 0).then(|| {
        let p = outline.points()[random.below(300) as usize];
        (p, 0.12 * unit * (1.0 + 0.5 * random.signed_unit()))
    });
    let depth = |p: Point| {
        let away = pompeiu_planar::distance_to_outline(p, &outline);
        let depth = if outline.contains(p) { away } else { -away };
        notch.map_or(depth, |(q, r)| depth.min(libm::hypot(p[0] - q[0], p[1] - q[1]) - r))
    };
    Some(field(low, high, PI * random.signed_unit(), depth))
}

/// Adds noise of some wave length, as of photographs and drawings.
fn ragged(values: &mut [f32], random: &mut Random) {
    let (strength, cell) = (0.012 * random.signed_unit().abs(), 3 + random.below(8) as usize);
    let across = PIXELS / cell + 2;
    let knots: Vec<f64> = (0..across * across).map(|_| random.signed_unit()).collect();
    for (i, value) in values.iter_mut().enumerate() {
        let [x, y] = [i % PIXELS, i / PIXELS].map(|k| k as f64 / cell as f64);
        let (c, r, s, t) = (x as usize, y as usize, x.fract(), y.fract());
        let k = r * across + c;
        let rows = [k, k + across].map(|k| knots[k] + s * (knots[k + 1] - knots[k]));
        *value += (strength * (rows[0] + t * (rows[1] - rows[0]))) as f32;
    }
}
