//! Radii along a tube: those of its balls, and those of its sections.

/// The radii of the balls of a tube by the length along it: linear between samples.
pub(super) struct Profile {
    /// Lengths from the first sample to each of them, and their radii.
    samples: Vec<(f64, f64)>,
    /// What the radii of the balls were multiplied by, so that polygons have the area of their circles.
    factor: f64,
    greatest: f64,
}

/// Change of the slope of the radius at a sample from which on there is a corner.
const CORNER: f64 = 0.1;

/// Distance of a chord from the surface, over the radius, from which on there is a section at its middle.
const KINK: f64 = 0.1;

/// Half the length of this chord, over the radius.
const HALF_CHORD: f64 = 0.5;

/// Steps per radius in which the middle of the chord that is farthest off is sought.
const STEPS: i32 = 16;

impl Profile {
    /// The profile with these lengths and radii.
    pub(super) fn new(samples: Vec<(f64, f64)>, factor: f64) -> Self {
        let greatest = samples.iter().map(|(_, radius)| *radius).fold(0.0, f64::max);
        Self { samples, factor, greatest }
    }

    /// The radius of the ball at a length.
    pub(super) fn ball(&self, l: f64) -> f64 {
        let samples = &self.samples;
        let k = samples.partition_point(|(at, _)| *at <= l).clamp(1, samples.len() - 1);
        let [(a, from), (b, to)] = [samples[k - 1], samples[k]];
        let share = if b > a { ((l - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 };
        from + (to - from) * share
    }

    /// The radius of the section of the union of the balls by a plane across the tube.
    ///
    /// # Definition
    /// `√(r(s)² − (l − s)²)`, the greatest one over the places `s` of the balls. Where the radius has the slope `k` over a sufficient length, that is
    /// `r(l) / √(1 − k²)`. Radii are those before the multiplication, so that the section is multiplied as well, but not the slope.
    pub(super) fn section(&self, l: f64) -> f64 {
        let radius = |s: f64| self.ball(s) / self.factor;
        let reach = self.greatest / self.factor;
        let square = |s: f64| {
            let (r, away) = (radius(s), l - s);
            r * r - away * away
        };
        let mut most = square(l);
        let from = self.samples.partition_point(|(at, _)| *at < l - reach).saturating_sub(1);
        for pair in self.samples[from..].windows(2) {
            let [(a, ra), (b, rb)] = [pair[0], pair[1]].map(|(at, r)| (at, r / self.factor));
            if a > l + reach {
                break;
            }
            let slope = (rb - ra) / (b - a);
            // The square is concave along the axis where the balls do not contain one another.
            let best = if slope.abs() < 1.0 {
                ((l + slope * (ra - slope * a)) / (1.0 - slope * slope)).clamp(a, b)
            } else if slope > 0.0 {
                b
            } else {
                a
            };
            most = most.max(square(best));
        }
        most.sqrt() * self.factor
    }

    /// The lengths of samples at which the radius of the balls has a corner.
    pub(super) fn corners(&self) -> Vec<f64> {
        let slope = |[a, b]: [(f64, f64); 2]| (b.1 - a.1) / (b.0 - a.0);
        let is_corner = |triple: &&[(f64, f64)]| {
            (slope([triple[1], triple[2]]) - slope([triple[0], triple[1]])).abs() > CORNER * self.factor
        };
        self.samples.windows(3).filter(is_corner).map(|triple| triple[1].0).collect()
    }

    /// The lengths near corners at which a chord is off the surface, increasing. The crease between two cones is not where their common ball is.
    pub(super) fn kinks(&self) -> Vec<f64> {
        let off = |l: f64| {
            let [here, half] = [self.section(l), HALF_CHORD * self.ball(l)];
            (0.5 * (self.section(l - half) + self.section(l + half)) - here).abs() / here
        };
        let last = self.samples[self.samples.len() - 1].0;
        let near = |corner: f64| {
            let step = self.ball(corner) / f64::from(STEPS);
            let places = (-STEPS..=STEPS).map(|k| corner + f64::from(k) * step);
            let inside = places.filter(|l| *l > 0.0 && *l < last).map(|l| (off(l), l));
            inside.filter(|(off, _)| *off > KINK).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, l)| l)
        };
        let mut found: Vec<f64> = self.corners().into_iter().filter_map(near).collect();
        found.sort_by(f64::total_cmp);
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_contain_the_densest_balls() {
        let profile = Profile::new(vec![(0.0, 1.0), (1.3, 0.2), (2.0, 0.3), (2.1, 0.25), (6.0, 0.2)], 1.0);
        for step in 0..=60 {
            let l = 0.1 * f64::from(step);
            let balls = (0..=60_000).map(|k| 1e-4 * f64::from(k));
            let most = balls.map(|s| profile.ball(s).powi(2) - (l - s).powi(2)).fold(0.0, f64::max).sqrt();
            assert!((profile.section(l) - most).abs() < 1e-6, "{l} {most} {}", profile.section(l));
        }
    }

    #[test]
    fn kinks_are_where_chords_are_off() {
        let of = |samples: &[(f64, f64)]| Profile::new(samples.to_vec(), 1.0).kinks();
        // The cone from the first ball has the radius of the cylinder here.
        let (slope, cosine) = (0.8 / 1.3, (1.0_f64 - (0.8_f64 / 1.3).powi(2)).sqrt());
        let crease = (1.0 - 0.2 * cosine) / slope;
        let found = of(&[(0.0, 1.0), (1.3, 0.2), (2.6, 0.2), (4.0, 0.21)]);
        assert!(found.len() == 1 && (found[0] - crease).abs() < 0.2 / 16.0, "{found:?} {crease}");
        assert!(of(&[(0.0, 1.0), (6.0, 0.9), (12.0, 1.0), (18.0, 0.8)]).is_empty());
    }
}
