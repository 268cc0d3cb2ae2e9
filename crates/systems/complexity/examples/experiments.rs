//! The experiments of the first report on these measures, repeated on generated shapes: progressions, polylines, noisy circles, and
//! all of them together.
//!
//! ```sh
//! cargo run --release --package pompeiu-complexity --example experiments -- polylines noisy-circles
//! ```
//!
//! Without arguments it runs all of them: octopus, eight, polylines, noisy-circles, everything.

#![allow(clippy::print_stdout, reason = "an example prints")]

use pompeiu_complexity::generate::{PointOrder, noisy_circle, polyline};
use pompeiu_complexity::{
    ComplexityError, Measure, MeasureOptions, Measures, adjusted_rand, cluster, compare_rankings,
    matched_accuracy,
};
use pompeiu_planar::Outline;
use std::f64::consts::TAU;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// An experiment and its name.
type Part = (&'static str, fn() -> Outcome);

/// Classes of polylines: their numbers of points, and the number of polylines in each.
const CLASSES: [usize; 4] = [5, 10, 15, 25];
const OF_EACH: u64 = 42;

/// Draws of random sets.
const DRAWS: u64 = 100;

/// Runs the named experiments, or all.
fn main() -> Outcome {
    let named: Vec<String> = std::env::args().skip(1).collect();
    let parts: [Part; 5] = [
        ("octopus", octopus),
        ("eight", eight),
        ("polylines", polylines),
        ("noisy-circles", noisy_circles),
        ("everything", everything),
    ];
    for (name, part) in parts {
        if named.is_empty() || named.iter().any(|wanted| wanted == name) {
            part()?;
        }
    }
    Ok(())
}

fn measured(outline: &Outline, smoothing: f64) -> Result<Measures, ComplexityError> {
    Measures::of(outline, &MeasureOptions { smoothing })
}

/// A body with eight arms of given length and sharpness.
fn body(length: f64, sharpness: i32) -> Result<Outline, Box<dyn std::error::Error>> {
    let at = |i: usize| {
        let angle = TAU * i as f64 / 4000.0;
        let radius = 1.0 + length * (0.5 + 0.5 * (8.0 * angle).cos()).powi(sharpness);
        [radius * angle.cos(), radius * angle.sin()]
    };
    Ok(Outline::new((0..4000).map(at).collect())?)
}

/// Longer and thinner arms make a shape more complex.
fn octopus() -> Outcome {
    println!("arms             boundary  boundary-8  t18    neg5   peaks  total");
    for (name, length, sharpness) in [
        ("none", 0.0, 1),
        ("short", 0.5, 1),
        ("long", 1.5, 1),
        ("long, thin", 1.5, 3),
        ("longer, thin", 3.0, 6),
    ] {
        let m = measured(&body(length, sharpness)?, 0.004)?;
        let (b, c) = (m.boundary, m.curvature);
        println!(
            "{name:<16} {:.4}    {:.4}      {:.3}  {:.3}  {:>5}  {:.2}",
            b.mean, b.m8, c.one_minus_first_bin, c.neg5, c.peaks, c.total
        );
    }
    Ok(())
}

/// Eight shapes of growing complexity by construction, ranked by the two measures.
fn eight() -> Outcome {
    let shapes: [(&str, Outline); 8] = [
        ("ellipse", star(2, 0.3)?),
        ("triangle", star(3, 0.25)?),
        ("clover", star(4, 0.5)?),
        ("flower of 8", star(8, 0.35)?),
        ("flower of 16", star(16, 0.25)?),
        ("eight arms", body(1.5, 1)?),
        ("noise 3", noisy_circle(20, 3, 6, 1)?),
        ("noise 8", noisy_circle(20, 8, 6, 1)?),
    ];
    let intended: Vec<f64> = (1..=8).map(f64::from).collect();
    println!("\neight shapes  similarity  average distance  normalised  Kendall's τ");
    let all = shapes.iter().map(|(_, outline)| measured(outline, 0.0)).collect::<Result<Vec<_>, _>>()?;
    for name in ["boundary", "boundary-8", "t18", "neg5"] {
        let measure = Measure::named(name)?;
        let values: Vec<f64> = all.iter().map(|m| measure.complexity(m)).collect();
        let agreement = compare_rankings(&values, &intended)?;
        println!(
            "{name:<12}  {:<10.4}  {:<16.4}  {:<10.5}  {:.3}",
            agreement.similarity,
            agreement.average_distance,
            agreement.normalized_distance,
            agreement.kendall
        );
    }
    Ok(())
}

/// A circle whose radius oscillates `arms` times.
fn star(arms: i32, depth: f64) -> Result<Outline, Box<dyn std::error::Error>> {
    let at = |i: usize| {
        let angle = TAU * i as f64 / 4000.0;
        let radius = 1.0 + depth * (f64::from(arms) * angle).cos();
        [radius * angle.cos(), radius * angle.sin()]
    };
    Ok(Outline::new((0..4000).map(at).collect())?)
}

/// Mean measures by the number of points, and how well clusters separate the classes.
fn polylines() -> Outcome {
    println!("\npoints  boundary-50  boundary-100  neg5   t18    peaks  total (means of 200)");
    for points in CLASSES {
        let mut sums = [0.0; 6];
        for seed in 0..200 {
            let m = measured(&polyline(points, seed, PointOrder::Random)?, 0.0)?;
            let (b, c) = (m.boundary, m.curvature);
            let values = [b.m50, b.m100, c.neg5, c.one_minus_first_bin, c.peaks as f64, c.total];
            sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += value / 200.0);
        }
        let [b50, b100, neg5, t18, peaks, total] = sums;
        println!("{points:<7} {b50:.4}       {b100:.4}        {neg5:.3}  {t18:.3}  {peaks:>5.1}  {total:.2}");
    }
    println!(
        "\nfeatures                        order   smoothing  matched accuracy (mean of {DRAWS} draws, 95 %)  adjusted Rand"
    );
    for features in [["boundary-100", "sharp"], ["log:peaks", "log:total-curvature"]] {
        for order in [PointOrder::Random, PointOrder::Angle] {
            for smoothing in [0.0, 0.004] {
                accuracy(features, order, smoothing)?;
            }
        }
    }
    Ok(())
}

fn accuracy(features: [&str; 2], order: PointOrder, smoothing: f64) -> Outcome {
    let (mut found, mut rand) = (Vec::new(), 0.0);
    for draw in 0..DRAWS {
        let (mut rows, mut classes) = (Vec::new(), Vec::new());
        for (class, points) in CLASSES.into_iter().enumerate() {
            for k in 0..OF_EACH {
                let outline = polyline(points, 1_000_000 * draw + 1000 * class as u64 + k, order)?;
                let m = measured(&outline, smoothing)?;
                rows.push(features.iter().map(|name| value(name, &m)).collect::<Result<Vec<_>, _>>()?);
                classes.push(class);
            }
        }
        let clusters = cluster(&rows, &features.map(str::to_owned), CLASSES.len())?;
        found.extend(matched_accuracy(&clusters.labels, &classes));
        rand += adjusted_rand(&clusters.labels, &classes).unwrap_or(0.0) / DRAWS as f64;
    }
    let n = found.len() as f64;
    let mean = found.iter().sum::<f64>() / n;
    let deviation = (found.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
    let half = 1.96 * deviation / n.sqrt();
    println!(
        "{:<31} {:<7} {smoothing:<9}  {mean:.4} ± {half:.4}                                {rand:.3}",
        features.join(", "),
        format!("{order:?}").to_lowercase()
    );
    Ok(())
}

fn value(name: &str, measures: &Measures) -> Result<f64, ComplexityError> {
    match name.strip_prefix("log:") {
        Some(inner) => Ok(Measure::named(inner)?.value(measures).ln_1p()),
        None => Ok(Measure::named(name)?.value(measures)),
    }
}

/// Noise levels against ranks, for ten shapes in each of eight levels.
fn noisy_circles() -> Outcome {
    println!("\nmeasure       levels kept  mean distance of levels  Kendall's τ");
    let (mut all, mut levels) = (Vec::new(), Vec::new());
    for level in 1..=8 {
        for seed in 0..10 {
            all.push(measured(&noisy_circle(20, level, 6, 100 * u64::from(level) + seed)?, 0.0)?);
            levels.push(f64::from(level));
        }
    }
    for name in ["boundary-100", "boundary-25", "neg5", "t18", "total-curvature"] {
        let measure = Measure::named(name)?;
        let values: Vec<f64> = all.iter().map(|m| measure.complexity(m)).collect();
        let mut order: Vec<usize> = (0..values.len()).collect();
        order.sort_by(|i, j| values[*i].total_cmp(&values[*j]));
        let off: Vec<f64> =
            order.iter().enumerate().map(|(k, i)| ((k / 10 + 1) as f64 - levels[*i]).abs()).collect();
        let kept = off.iter().filter(|d| **d == 0.0).count() as f64 / off.len() as f64;
        let mean = off.iter().sum::<f64>() / off.len() as f64;
        let agreement = compare_rankings(&values, &levels)?;
        println!("{name:<13} {kept:<11.3}  {mean:<23.4}  {:.3}", agreement.kendall);
    }
    Ok(())
}

/// Polylines, noisy circles and a plain circle of pixels in eight clusters.
fn everything() -> Outcome {
    let (mut rows, mut names) = (Vec::new(), Vec::new());
    let mut push = |outline: &Outline, name: String| -> Result<(), ComplexityError> {
        let m = measured(outline, 0.0)?;
        rows.push(vec![m.boundary.m50, m.curvature.one_minus_first_bin]);
        names.push(name);
        Ok(())
    };
    for seed in 0..20 {
        for points in CLASSES {
            push(&polyline(points, seed, PointOrder::Random)?, format!("polyline {points}"))?;
        }
        for level in 1..=8 {
            push(&noisy_circle(20, level, 6, 1000 + seed)?, format!("noise {level}"))?;
        }
    }
    for radius in [20, 800] {
        push(&noisy_circle(radius, 0, 1, 0)?, format!("circle of pixels, radius {radius}"))?;
    }
    let clusters = cluster(&rows, &["boundary-50", "t18"].map(str::to_owned), 8)?;
    println!("\nclusters of everything by boundary-50 and t18");
    for label in 0..8 {
        let mut counts: Vec<(&str, usize)> = Vec::new();
        for name in
            names.iter().zip(&clusters.labels).filter(|(_, l)| **l == label).map(|(name, _)| name.as_str())
        {
            match counts.iter_mut().find(|(known, _)| *known == name) {
                Some((_, count)) => *count += 1,
                None => counts.push((name, 1)),
            }
        }
        counts.sort_unstable();
        let text: Vec<String> = counts.iter().map(|(name, count)| format!("{name}: {count}")).collect();
        println!("{}: {}", label + 1, text.join(", "));
    }
    Ok(())
}
