//! Configuration files: TOML with units, and the parameter files of `NeuronTransportIGA`.

use super::error::TransportError;
use super::problem::{Parameters, TimeScheme};
use super::units::Kind;
use crate::{Drive, FlowParameters, Side};
use toml_edit::{Document, Item, TableLike, Value};

/// Reads a configuration: TOML, or the name–value pairs of `NeuronTransportIGA`, with lengths in micrometres and times in seconds.
///
/// # Errors
/// [`TransportError`] with the line: invalid TOML, unknown keys, missing or wrong units, values out of range.
pub fn read_transport_config(text: &str) -> Result<Parameters, TransportError> {
    let first =
        text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#')).unwrap_or("");
    let is_pairs = !first.starts_with('[') && !first.contains('=') && first.split_whitespace().count() == 2;
    let parameters = if is_pairs { read_pairs(text)? } else { read_toml(text)? };
    parameters.check()?;
    Ok(parameters)
}

/// Reads a configuration in TOML; missing keys have their defaults.
fn read_toml(text: &str) -> Result<Parameters, TransportError> {
    let document = Document::parse(text)
        .map_err(|error| TransportError::Syntax(error.to_string().trim_end().to_owned()))?;
    let mut parameters = Parameters::default();
    let reader = Reader { text };
    for (table, item) in document.as_table() {
        let Some(entries) = item.as_table_like() else {
            return Err(reader.unknown("the file", table, item, TABLES));
        };
        match table {
            "transport" => reader.transport(entries, &mut parameters)?,
            "inlet" | "tips" | "initial" => reader.place(table, entries, &mut parameters)?,
            "flow" => reader.flow(entries, &mut parameters.flow)?,
            _ => return Err(reader.unknown("the file", table, item, TABLES)),
        }
    }
    parameters.flow.inlet = parameters.inlet;
    let has_inlet = document.get("inlet").and_then(|table| table.get("side")).is_some();
    if let Some(item) = document.get("tips").and_then(|table| table.get("sides")).filter(|_| !has_inlet) {
        return Err(reader.wrong("sides", item, "the side of the inlet, too: [inlet] side = \"-x\""));
    }
    Ok(parameters)
}

const TABLES: &str = "transport, inlet, tips, initial, flow";

/// A configuration being read.
struct Reader<'t> {
    text: &'t str,
}

impl Reader<'_> {
    fn line(&self, item: &Item) -> usize {
        let at = item.span().map_or(0, |span| span.start).min(self.text.len());
        self.text.as_bytes()[..at].split(|byte| *byte == b'\n').count()
    }

    fn unknown(&self, table: &str, key: &str, item: &Item, expected: &str) -> TransportError {
        TransportError::UnknownKey {
            line: self.line(item),
            table: table.to_owned(),
            key: key.to_owned(),
            expected: expected.to_owned(),
        }
    }

    fn wrong(&self, key: &str, item: &Item, expected: &str) -> TransportError {
        let text = item.span().and_then(|span| self.text.get(span)).unwrap_or("");
        let found = text.trim().chars().take(40).collect();
        TransportError::Value {
            line: self.line(item),
            key: key.to_owned(),
            found,
            expected: expected.to_owned(),
        }
    }

    fn quantity(&self, key: &str, item: &Item, kind: Kind) -> Result<f64, TransportError> {
        let number = match item.as_value() {
            Some(Value::String(text)) => kind.parse(text.value()),
            // Only concentrations may omit the unit.
            Some(Value::Float(x)) if kind == Kind::Concentration => Some(*x.value()),
            Some(Value::Integer(x)) if kind == Kind::Concentration => Some(*x.value() as f64),
            _ => None,
        };
        number.filter(|x| x.is_finite()).ok_or_else(|| self.wrong(key, item, kind.expected()))
    }

    fn transport(&self, entries: &dyn TableLike, p: &mut Parameters) -> Result<(), TransportError> {
        for (key, item) in entries.iter() {
            let target = match key {
                "diffusion" => (&mut p.diffusion, Kind::Diffusivity),
                "speed_plus" => (&mut p.speed_plus, Kind::Speed),
                "speed_minus" => (&mut p.speed_minus, Kind::Speed),
                "attach_plus" => (&mut p.attach_plus, Kind::Rate),
                "attach_minus" => (&mut p.attach_minus, Kind::Rate),
                "detach_plus" => (&mut p.detach_plus, Kind::Rate),
                "detach_minus" => (&mut p.detach_minus, Kind::Rate),
                "step" => (&mut p.step, Kind::Time),
                "steps" => {
                    let count = item.as_integer().and_then(|n| usize::try_from(n).ok());
                    p.steps = count.ok_or_else(|| self.wrong(key, item, "a whole number above 0"))?;
                    continue;
                }
                "order" => {
                    p.scheme = match item.as_integer() {
                        Some(1) => TimeScheme::First,
                        Some(2) => TimeScheme::Second,
                        _ => return Err(self.wrong(key, item, "1 or 2")),
                    };
                    continue;
                }
                _ => {
                    let expected = "diffusion, speed_plus, speed_minus, attach_plus, attach_minus, detach_plus, detach_minus, step, steps, order";
                    return Err(self.unknown("transport", key, item, expected));
                }
            };
            *target.0 = self.quantity(key, item, target.1)?;
        }
        Ok(())
    }

    fn flow(&self, entries: &dyn TableLike, p: &mut FlowParameters) -> Result<(), TransportError> {
        let mut is_driven = false;
        for (key, item) in entries.iter() {
            let value = |kind| self.quantity(key, item, kind);
            match key {
                "viscosity" => p.viscosity = value(Kind::Viscosity)?,
                "density" => p.density = value(Kind::Density)?,
                "speed" | "pressure" if is_driven => {
                    return Err(self.wrong(key, item, "either a speed or a pressure, not both"));
                }
                "speed" => p.drive = Drive::Speed(value(Kind::Speed)?),
                "pressure" => p.drive = Drive::Pressure(value(Kind::Pressure)?),
                "pressures" => {
                    let Some(list) = item.as_table_like() else {
                        return Err(self.wrong(key, item, "a table of samples and pressures"));
                    };
                    for (sample, item) in list.iter() {
                        let number = sample
                            .parse()
                            .map_err(|_| self.wrong(sample, item, "the number of a sample as key"))?;
                        p.pressures.push((number, self.quantity(sample, item, Kind::Pressure)?));
                    }
                }
                _ => {
                    return Err(self.unknown(
                        "flow",
                        key,
                        item,
                        "viscosity, density, speed, pressure, pressures",
                    ));
                }
            }
            is_driven |= matches!(key, "speed" | "pressure");
        }
        Ok(())
    }

    fn side(&self, key: &str, name: Option<&str>, item: &Item) -> Result<Side, TransportError> {
        let side = name.and_then(Side::from_name);
        side.ok_or_else(|| {
            self.wrong(key, item, "a side of the box around the mesh: -x, +x, -y, +y, -z or +z")
        })
    }

    fn place(&self, table: &str, entries: &dyn TableLike, p: &mut Parameters) -> Result<(), TransportError> {
        for (key, item) in entries.iter() {
            let is_closed = item.as_str() == Some("closed");
            let value = || self.quantity(key, item, Kind::Concentration);
            match (table, key) {
                ("inlet", "free") => p.inlet_free = if is_closed { None } else { Some(value()?) },
                ("tips", "free") => p.tips_free = if is_closed { None } else { Some(value()?) },
                ("inlet", "plus") => p.inlet_plus = value()?,
                ("inlet", "sample") => {
                    let sample = item.as_integer();
                    p.inlet = Some(sample.ok_or_else(|| self.wrong(key, item, "the number of a sample"))?);
                }
                // The inlet comes first.
                ("inlet", "side") => p.sides.insert(0, self.side(key, item.as_str(), item)?),
                ("tips", "sides") => {
                    let Some(list) = item.as_array() else {
                        return Err(self.wrong(key, item, "a list of sides such as [\"+x\"]"));
                    };
                    for name in list {
                        p.sides.push(self.side(key, name.as_str(), item)?);
                    }
                }
                ("tips", "minus") => p.tips_minus = value()?,
                ("initial", "free") => p.initial[0] = value()?,
                ("initial", "plus") => p.initial[1] = value()?,
                ("initial", "minus") => p.initial[2] = value()?,
                ("inlet", _) => return Err(self.unknown(table, key, item, "free, plus, sample, side")),
                ("tips", _) => return Err(self.unknown(table, key, item, "free, minus, sides")),
                _ => return Err(self.unknown(table, key, item, "free, plus, minus")),
            }
        }
        Ok(())
    }
}

/// Reads name–value pairs, in any order.
fn read_pairs(text: &str) -> Result<Parameters, TransportError> {
    const NAMES: &str =
        "D, vplus, vminus, kplus, kminus, k'plus, k'minus, dt, nstep, N0bc, Nplusbc, Nminusbc";
    let mut p = Parameters::default();
    for (index, content) in text.lines().enumerate() {
        let line = index + 1;
        let words: Vec<&str> = content.split_whitespace().collect();
        let [name, value] = words[..] else {
            if words.is_empty() {
                continue;
            }
            let found = content.trim().chars().take(40).collect();
            return Err(TransportError::Value {
                line,
                key: "the line".to_owned(),
                found,
                expected: "a name and a value".to_owned(),
            });
        };
        let wrong = |expected: &str| TransportError::Value {
            line,
            key: name.to_owned(),
            found: value.chars().take(40).collect(),
            expected: expected.to_owned(),
        };
        let number: f64 = value.parse().map_err(|_| wrong("a number"))?;
        match name {
            "D" => p.diffusion = number,
            "vplus" => p.speed_plus = number,
            // There, speeds towards the inlet are negative.
            "vminus" if number <= 0.0 => p.speed_minus = -number,
            "vminus" => return Err(wrong("a number of at most 0")),
            "kplus" => p.attach_plus = number,
            "kminus" => p.attach_minus = number,
            "k'plus" => p.detach_plus = number,
            "k'minus" => p.detach_minus = number,
            "dt" => p.step = number,
            "nstep" if number >= 1.0 && number.fract() == 0.0 => p.steps = number as usize,
            "nstep" => return Err(wrong("a whole number above 0")),
            "N0bc" => p.inlet_free = Some(number),
            "Nplusbc" => p.inlet_plus = number,
            "Nminusbc" => p.tips_minus = number,
            _ => {
                let (table, key) = ("parameters".to_owned(), name.to_owned());
                return Err(TransportError::UnknownKey { line, table, key, expected: NAMES.to_owned() });
            }
        }
    }
    Ok(p)
}
