//! Frames of a run for display.

/// Largest number of frames in a page.
const MOST_FRAMES: usize = 120;

/// Largest number of stations along an interface in a page.
const MOST_STATIONS: usize = 400;

/// The interface after a window, for display.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CoupleFrame {
    /// Number of the window, from 1.
    pub window: usize,
    /// What the first solver gets, at stations along the interface: displacements, cross-sections, the position of the piston.
    pub x: Vec<f64>,
    /// What the first solver gives there: pressures.
    pub y: Vec<f64>,
    /// The greatest absolute value of all pressures, also between stations.
    pub greatest_pressure: f64,
}

/// The indices that are shown of so many values along an interface: all, or evenly spaced ones with both ends.
pub(super) fn stations(count: usize) -> impl Iterator<Item = usize> {
    let shown = if count < MOST_STATIONS { count } else { MOST_STATIONS };
    (0..shown).map(move |k| if shown < 2 { k } else { k * (count - 1) / (shown - 1) })
}

/// Frames of a run, never more than 120, evenly spaced but for the last.
#[derive(Clone, Debug, PartialEq)]
pub struct CoupleFrames {
    frames: Vec<CoupleFrame>,
    /// Windows from one frame to the next.
    stride: usize,
}

impl Default for CoupleFrames {
    fn default() -> Self {
        Self { frames: Vec::new(), stride: 1 }
    }
}

impl CoupleFrames {
    /// Takes over what both solvers agree on in a window, and what the first one gave for it.
    pub fn add(&mut self, window: usize, x: &[f64], y: &[f64]) {
        if self.frames.last().is_some_and(|last| !self.is_kept(last)) {
            self.frames.pop();
        }
        if self.frames.len() >= MOST_FRAMES {
            self.stride *= 2;
            let stride = self.stride;
            self.frames.retain(|frame| (frame.window - 1).is_multiple_of(stride));
        }
        let at = |values: &[f64]| stations(values.len()).map(|i| values[i]).collect();
        let greatest_pressure = y.iter().fold(0.0, |m, p| if p.abs() > m { p.abs() } else { m });
        self.frames.push(CoupleFrame { window, x: at(x), y: at(y), greatest_pressure });
    }

    fn is_kept(&self, frame: &CoupleFrame) -> bool {
        (frame.window - 1).is_multiple_of(self.stride)
    }

    /// The frames, in order; the last window is always the last one.
    pub fn frames(&self) -> &[CoupleFrame] {
        &self.frames
    }
}
