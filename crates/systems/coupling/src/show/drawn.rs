//! What is drawn of a problem: its fluid and its wall between two curves each.

use super::frames::stations;
use crate::channel::Channel;
use crate::scenario::Scenario;
use crate::{CouplingError, channel::ChannelOptions};
use std::f64::consts::PI;

/// Displacements below this part of the height are rounding, and are not drawn larger.
const ROUNDING: f64 = 1e-9;

/// Displacements are drawn larger where the largest is below this part of the height.
const SMALL: f64 = 0.1;

/// The part of the height that the largest displacement has at most where it is drawn larger.
const LARGE: f64 = 0.25;

/// Thickness of a wall that is drawn, in heights of the channel.
const WALL: f64 = 0.12;

/// Width of the column of fluid, in lengths of it at rest.
const COLUMN: f64 = 0.3;

/// A problem as it is drawn.
pub(super) struct Drawing {
    scenario: Scenario,
    /// Places of stations along the interface.
    places: Vec<f64>,
    /// Height of the channel, radius of the tube at rest, or length of the column of fluid at rest.
    size: f64,
    /// How many times as large displacements are drawn.
    pub(super) factor: f64,
}

/// Two curves with as many points.
pub(super) struct Strip {
    pub(super) low: Vec<[f64; 2]>,
    pub(super) high: Vec<[f64; 2]>,
}

impl Strip {
    /// A vertex for each point of both curves, the lower one first.
    pub(super) fn positions(&self) -> Vec<[f64; 3]> {
        self.low.iter().chain(&self.high).map(|[x, y]| [*x, *y, 0.0]).collect()
    }

    /// Two triangles between each pair of neighbours.
    pub(super) fn triangles(&self) -> Vec<[u32; 3]> {
        let count = self.low.len() as u32;
        (1..count).flat_map(|i| [[i - 1, i, count + i], [i - 1, count + i, count + i - 1]]).collect()
    }
}

impl Drawing {
    /// How to draw a problem in states with these interface data.
    pub(super) fn new<'x>(
        scenario: &Scenario,
        states: impl Iterator<Item = &'x [f64]>,
    ) -> Result<Self, CouplingError> {
        let (places, size) = match *scenario {
            Scenario::Channel(options) => {
                let ChannelOptions { height, cells: [nx, ny], .. } = options;
                let length = Channel::new(options)?.length();
                let spacing = height / ny as f64;
                // Values are those of the middles of cells, the first and the last drawn up to the ends.
                let mut places: Vec<f64> = stations(nx).map(|i| (i as f64 + 0.5) * spacing).collect();
                if let [first, .., last] = &mut places[..] {
                    (*first, *last) = (0.0, length);
                }
                (places, height)
            }
            Scenario::Tube(options) => {
                let spacing = options.length / options.segments as f64;
                let places = stations(options.segments + 1).map(|i| i as f64 * spacing).collect();
                (places, (1.0 / PI).sqrt())
            }
            Scenario::Piston(_) => (Vec::new(), 1.0),
        };
        let mut drawing = Self { scenario: *scenario, places, size, factor: 1.0 };
        let moved = states.flatten().map(|value| drawing.displacement(*value).abs());
        let largest = moved.fold(0.0, |m: f64, d| if d > m { d } else { m });
        match scenario {
            // There is no length to compare with: the column is twice as long as the piston moves.
            Scenario::Piston(_) if largest > 0.0 => drawing.size = 2.0 * largest,
            Scenario::Piston(_) => {}
            _ if largest > ROUNDING * size && largest < SMALL * size => {
                drawing.factor = below(LARGE * size / largest);
            }
            _ => {}
        }
        Ok(drawing)
    }

    /// How far the interface has moved from where it rests.
    pub(super) fn displacement(&self, value: f64) -> f64 {
        match self.scenario {
            Scenario::Tube(_) => (value.max(0.0) / PI).sqrt() - self.size,
            _ => value,
        }
    }

    /// The fluid, and where the pressure is painted if that is not the fluid.
    pub(super) fn strips(&self, x: &[f64]) -> (Strip, Option<Strip>) {
        if let Scenario::Piston(_) = self.scenario {
            let (end, half) = (x.iter().sum::<f64>(), 0.5 * COLUMN * self.size);
            let at = |y: f64| vec![[-self.size, y], [end, y]];
            return (Strip { low: at(-half), high: at(half) }, None);
        }
        let moved = x.iter().map(|value| self.size + self.factor * self.displacement(*value));
        let high: Vec<[f64; 2]> = self.places.iter().copied().zip(moved).map(|(x, y)| [x, y]).collect();
        if let Scenario::Tube(_) = self.scenario {
            return (Strip { low: high.iter().map(|[x, y]| [*x, -y]).collect(), high }, None);
        }
        let wall = high.iter().map(|[x, y]| [*x, y + WALL * self.size]).collect();
        let floor = high.iter().map(|[x, _]| [*x, 0.0]).collect();
        let fluid = Strip { low: floor, high: high.clone() };
        (fluid, Some(Strip { low: high, high: wall }))
    }

    /// Where the interface rests.
    pub(super) fn rest(&self) -> Vec<Vec<[f64; 3]>> {
        let along = |y: f64| self.places.iter().map(|x| [*x, y, 0.0]).collect();
        match self.scenario {
            Scenario::Channel(_) => vec![along(self.size)],
            Scenario::Tube(_) => vec![along(self.size), along(-self.size)],
            Scenario::Piston(_) => {
                let half = COLUMN * self.size;
                vec![vec![[0.0, -half, 0.0], [0.0, half, 0.0]]]
            }
        }
    }
}

/// The greatest of 1, 2, 5, 10, 20 and so on up to a number that is at least 1.
fn below(most: f64) -> f64 {
    let power = libm::exp10(libm::floor(libm::log10(most)));
    let step = [5.0, 2.0, 1.0].into_iter().find(|step| step * power <= most).unwrap_or(1.0);
    step * power
}
