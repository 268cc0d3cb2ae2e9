//! Numbers with units, in micrometres and seconds.

/// A kind of quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Diffusivity,
    Speed,
    Rate,
    Time,
    Concentration,
    /// In Pa s.
    Viscosity,
    /// In kg/m³.
    Density,
    /// In Pa.
    Pressure,
}

/// Units of length in micrometres.
const LENGTHS: [(&str, f64); 6] =
    [("nm", 1e-3), ("um", 1.0), ("µm", 1.0), ("μm", 1.0), ("mm", 1e3), ("m", 1e6)];

/// Units of time in seconds.
const TIMES: [(&str, f64); 5] = [("ms", 1e-3), ("s", 1.0), ("min", 60.0), ("h", 3600.0), ("d", 86_400.0)];

/// Units of concentration in those of the results, millimoles per litre.
const CONCENTRATIONS: [(&str, f64); 4] = [("nM", 1e-6), ("uM", 1e-3), ("µM", 1e-3), ("mM", 1.0)];

/// Units of viscosity in Pa s, without blanks.
const VISCOSITIES: [(&str, f64); 5] =
    [("Pas", 1.0), ("mPas", 1e-3), ("Pa*s", 1.0), ("mPa*s", 1e-3), ("cP", 1e-3)];

/// Units of density in kg/m³.
const DENSITIES: [(&str, f64); 4] = [("kg/m^3", 1.0), ("kg/m³", 1.0), ("g/cm^3", 1e3), ("g/ml", 1e3)];

/// Units of pressure in Pa.
const PRESSURES: [(&str, f64); 4] = [("mPa", 1e-3), ("Pa", 1.0), ("kPa", 1e3), ("mmHg", 133.322)];

impl Kind {
    pub(super) const fn expected(self) -> &'static str {
        match self {
            Self::Diffusivity => "a diffusivity such as \"1 um^2/s\"",
            Self::Speed => "a speed such as \"0.5 um/s\"",
            Self::Rate => "a rate such as \"0.1 /s\"",
            Self::Time => "a time such as \"0.1 s\"",
            Self::Concentration => "a concentration such as 1.0 or \"1 mM\"",
            Self::Viscosity => "a viscosity such as \"1 mPa s\"",
            Self::Density => "a density such as \"1000 kg/m^3\"",
            Self::Pressure => "a pressure such as \"10 Pa\"",
        }
    }

    /// The factor of a unit; `None` if it is no unit of the kind.
    fn factor(self, unit: &str) -> Option<f64> {
        let find = |list: &[(&str, f64)], name: &str| list.iter().find(|(n, _)| *n == name).map(|(_, f)| *f);
        let length = |name: &str| find(&LENGTHS, name);
        let time = |name: &str| find(&TIMES, name);
        match self {
            Self::Diffusivity => {
                let (area, per) = unit.split_once('/')?;
                let area = area.strip_suffix("^2").or_else(|| area.strip_suffix('²'))?;
                Some(length(area)?.powi(2) / time(per)?)
            }
            Self::Speed => {
                let (way, per) = unit.split_once('/')?;
                Some(length(way)? / time(per)?)
            }
            Self::Rate => match unit.split_once('/') {
                Some(("" | "1", per)) => Some(1.0 / time(per)?),
                _ => Some(1.0 / time(unit.strip_suffix("^-1")?)?),
            },
            Self::Time => time(unit),
            Self::Concentration => find(&CONCENTRATIONS, unit),
            Self::Viscosity => find(&VISCOSITIES, unit),
            Self::Density => find(&DENSITIES, unit),
            Self::Pressure => find(&PRESSURES, unit),
        }
    }

    /// A number with a unit of this kind.
    pub(super) fn parse(self, text: &str) -> Option<f64> {
        let text = text.trim();
        let end = text
            .char_indices()
            .find(|&(i, c)| !(c.is_ascii_digit() || "+-.".contains(c) || is_exponent(text, i, c)))
            .map_or(text.len(), |(i, _)| i);
        let number: f64 = text[..end].parse().ok()?;
        let unit: String = text[end..].chars().filter(|c| !c.is_whitespace()).collect();
        let factor = if unit.is_empty() && self == Self::Concentration { 1.0 } else { self.factor(&unit)? };
        Some(number * factor)
    }
}

/// Whether an e is part of a number.
fn is_exponent(text: &str, at: usize, c: char) -> bool {
    let after = text[at..].chars().nth(1);
    matches!(c, 'e' | 'E') && at > 0 && after.is_some_and(|c| c.is_ascii_digit() || "+-".contains(c))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_those_of_the_kind() {
        assert_eq!(Kind::Speed.parse("1.5 mm/h"), Some(1500.0 / 3600.0));
        assert_eq!(Kind::Speed.parse("-1e-1um/s"), Some(-0.1));
        assert_eq!(Kind::Diffusivity.parse("2 µm²/ms"), Some(2000.0));
        assert_eq!(Kind::Diffusivity.parse("1e-12 m^2/s"), Some(1e-12 * 1e12));
        assert_eq!(
            [Kind::Rate.parse("6 /min"), Kind::Rate.parse("3 1/s"), Kind::Rate.parse("3 s^-1")],
            [Some(0.1), Some(3.0), Some(3.0)]
        );
        assert_eq!(
            [Kind::Time.parse("2 min"), Kind::Concentration.parse("2"), Kind::Concentration.parse("2 uM")],
            [Some(120.0), Some(2.0), Some(2e-3)]
        );
        assert_eq!(
            [Kind::Viscosity.parse("1 mPa s"), Kind::Density.parse("1 g/cm^3"), Kind::Pressure.parse("2kPa")],
            [Some(1e-3), Some(1e3), Some(2e3)]
        );
        for (kind, text) in [
            (Kind::Viscosity, "1 Pa"),
            (Kind::Pressure, "1 mPa s"),
            (Kind::Density, "1"),
            (Kind::Speed, "1 um"),
            (Kind::Speed, "1"),
            (Kind::Time, "1 um"),
            (Kind::Rate, "1 s"),
            (Kind::Diffusivity, "1 um/s"),
            (Kind::Time, "x s"),
            (Kind::Time, ""),
        ] {
            assert_eq!(kind.parse(text), None, "{text}");
        }
    }
}
