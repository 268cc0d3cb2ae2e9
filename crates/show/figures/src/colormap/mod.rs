//! Colour maps and scales.
//!
//! The maps are perceptually uniform and stay ordered with red–green colour blindness; rainbow maps have neither property.

mod scale;
mod tables;

pub use scale::{Scale, ScaleError};

/// A colour: red, green and blue in sRGB.
pub type Rgb = [u8; 3];

/// A colour map.
///
/// # Source
/// Why these and no rainbow: `crameri_misuse_2020`. Viridis is by Stéfan van der Walt, Nathaniel Smith and Eric Firing (CC0);
/// Batlow and Vik are from `crameri_scientific_2018` (MIT licence, beside the tables).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColorMap {
    /// From dark violet through teal to yellow, for values that start at a natural end, such as distances.
    Viridis,
    /// From dark blue through green and ochre to pink: as [`ColorMap::Viridis`], with more hues.
    Batlow,
    /// From dark blue through near-white to dark red, for values on both sides of a natural middle, such as signed
    /// distances.
    Vik,
}

impl ColorMap {
    /// All maps.
    pub const ALL: [Self; 3] = [Self::Viridis, Self::Batlow, Self::Vik];

    /// The colours at 256 equally spaced positions, both ends included.
    pub fn table(self) -> &'static [Rgb; 256] {
        match self {
            Self::Viridis => &tables::VIRIDIS,
            Self::Batlow => &tables::BATLOW,
            Self::Vik => &tables::VIK,
        }
    }

    /// The usual name, in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Viridis => "viridis",
            Self::Batlow => "batlow",
            Self::Vik => "vik",
        }
    }

    /// The map of that name, in any case.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|map| map.name().eq_ignore_ascii_case(name))
    }

    /// Whether the map is diverging: ranges should then be symmetric about its middle.
    pub fn is_diverging(self) -> bool {
        self == Self::Vik
    }

    /// A colour that differs clearly from all colours of the map, for values out of tolerance.
    ///
    /// # Accuracy
    /// At least 20 away in CIELAB from all colours of the map, with normal vision and with red–green colour blindness
    /// (`machado_model_2009`).
    pub fn contrast(self) -> Rgb {
        match self {
            Self::Viridis => [220, 30, 30],
            Self::Batlow => [225, 30, 255],
            Self::Vik => [255, 225, 0],
        }
    }

    /// The colour at a position from 0 to 1; outside, that of the nearer end.
    ///
    /// # Limits
    /// NaN gets the first colour. [`Scale::color`] has a separate colour for missing values.
    pub fn color(self, place: f64) -> Rgb {
        let table = self.table();
        let last = (table.len() - 1) as f64;
        let at = place.clamp(0.0, 1.0) * last;
        let entry = (at as usize).min(table.len() - 2);
        let part = at - entry as f64;
        if part.is_nan() {
            return table[0];
        }
        std::array::from_fn(|channel| {
            let [low, high] = [table[entry], table[entry + 1]].map(|color| f64::from(color[channel]));
            (low + part * (high - low) + 0.5) as u8
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Linear intensity of an sRGB channel.
    fn linear(channel: u8) -> f64 {
        let s = f64::from(channel) / 255.0;
        if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) }
    }

    fn product(matrix: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    }

    /// CIELAB under daylight (D65), from linear RGB.
    fn lab(light: [f64; 3]) -> [f64; 3] {
        const TO_XYZ: [[f64; 3]; 3] = [
            [0.412_456_4, 0.357_576_1, 0.180_437_5],
            [0.212_672_9, 0.715_152_2, 0.072_175_0],
            [0.019_333_9, 0.119_192_0, 0.950_304_1],
        ];
        let [x, y, z] = product(TO_XYZ, light);
        let [x, y, z] = [x / 0.950_47, y, z / 1.088_83]
            .map(|t| if t > 216.0 / 24_389.0 { t.cbrt() } else { (24_389.0 / 27.0 * t + 16.0) / 116.0 });
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    fn lightness(color: Rgb) -> f64 {
        lab(color.map(linear))[0]
    }

    /// A colour in CIELAB with normal vision, without red cones, and without green cones.
    ///
    /// Matrices of `machado_model_2009` for complete loss.
    fn views(color: Rgb) -> [[f64; 3]; 3] {
        const PROTAN: [[f64; 3]; 3] = [
            [0.152_286, 1.052_583, -0.204_868],
            [0.114_503, 0.786_281, 0.099_216],
            [-0.003_882, -0.048_116, 1.051_998],
        ];
        const DEUTAN: [[f64; 3]; 3] = [
            [0.367_322, 0.860_646, -0.227_968],
            [0.280_085, 0.672_501, 0.047_413],
            [-0.011_820, 0.042_940, 0.968_881],
        ];
        let light = color.map(linear);
        let in_range = |light: [f64; 3]| light.map(|x| x.clamp(0.0, 1.0));
        [lab(light), lab(in_range(product(PROTAN, light))), lab(in_range(product(DEUTAN, light)))]
    }

    fn difference(a: [f64; 3], b: [f64; 3]) -> f64 {
        (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
    }

    /// Lightness may decrease by this much between entries, because channels are rounded to bytes.
    const ROUNDING: f64 = 0.05;

    #[test]
    fn lightness_rises_along_sequential_maps() {
        for map in [ColorMap::Viridis, ColorMap::Batlow] {
            let lightness = map.table().map(lightness);
            assert!(lightness.windows(2).all(|pair| pair[1] > pair[0] - ROUNDING), "{map:?}");
            assert!(lightness[0] < 16.0 && lightness[255] > 87.0, "{map:?}: {lightness:?}");
        }
    }

    #[test]
    fn lightness_rises_to_the_middle_of_a_diverging_map_and_falls_after_it() {
        let lightness = ColorMap::Vik.table().map(lightness);
        let middle = (0..256).max_by(|&a, &b| lightness[a].total_cmp(&lightness[b])).unwrap();
        assert!((124..=131).contains(&middle), "{middle}");
        assert!(lightness[..=middle].windows(2).all(|pair| pair[1] > pair[0] - ROUNDING));
        assert!(lightness[middle..].windows(2).all(|pair| pair[1] < pair[0] + ROUNDING));
        assert!(lightness[0] < 17.0 && lightness[middle] > 90.0 && lightness[255] < 17.0);
    }

    #[test]
    fn steps_are_of_a_like_size_to_all_eyes() {
        for map in ColorMap::ALL {
            for eyes in 0..3 {
                let seen = map.table().map(|color| views(color)[eyes]);
                let steps: Vec<f64> =
                    (16..256).step_by(16).map(|i| difference(seen[i - 16], seen[i])).collect();
                assert!(
                    steps.iter().all(|step| (3.0..22.0).contains(step)),
                    "{map:?}, eyes {eyes}: {steps:.1?}"
                );
            }
        }
    }

    #[test]
    fn the_contrast_colour_is_unlike_all_others_to_all_eyes() {
        for map in ColorMap::ALL {
            let contrast = views(map.contrast());
            for (entry, color) in map.table().iter().enumerate() {
                for (seen, other) in contrast.iter().zip(views(*color)) {
                    assert!(difference(*seen, other) > 20.0, "{map:?}, entry {entry}");
                }
            }
        }
    }

    #[test]
    fn ends_and_entries_are_those_of_the_published_maps() {
        let ends = |map: ColorMap| [map.color(0.0), map.color(1.0)];
        assert_eq!(ends(ColorMap::Viridis), [[68, 1, 84], [253, 231, 37]]);
        assert_eq!(ends(ColorMap::Batlow), [[1, 25, 89], [250, 204, 250]]);
        assert_eq!(ends(ColorMap::Vik), [[0, 18, 97], [89, 0, 8]]);
        for map in ColorMap::ALL {
            for (entry, &color) in map.table().iter().enumerate() {
                assert_eq!(map.color(entry as f64 / 255.0), color, "{map:?}, entry {entry}");
            }
            assert_eq!([map.color(-7.0), map.color(f64::INFINITY)], ends(map));
            assert_eq!(map.color(f64::NAN), map.table()[0]);
            assert_eq!(ColorMap::from_name(&map.name().to_uppercase()), Some(map));
        }
        assert_eq!(ColorMap::from_name("jet"), None);
    }
}
