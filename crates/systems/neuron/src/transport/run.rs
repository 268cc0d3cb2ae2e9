//! Steps in time.

use super::discretisation::Discretisation;
use super::error::TransportError;
use super::flow::{FlowField, potential_flow};
use super::problem::{Parameters, TransportOptions};
use super::viscous::FlowCells;
use crate::{Cap, NeuronMesh};
use pompeiu_core::run::{Control, Progress, StopReason};
use pompeiu_solve::{LinearSolver, Lu, SparseMatrix};
use std::ops::ControlFlow;

/// What became of the material.
#[derive(Clone, Debug)]
pub struct Transport {
    /// What is said of it.
    pub report: TransportReport,
    /// Why it ended: [`StopReason::Steps`] is all steps.
    pub stop: StopReason,
    /// For each step, the beginning included, and each flat end the mean concentrations n₀, n₊, n₋ over the face.
    pub ends: Vec<Vec<[f64; 3]>>,
    /// The whole field at some steps.
    pub frames: Vec<Frame>,
}

/// The field at a step.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The step, from 0 for the beginning.
    pub step: usize,
    /// The time in seconds.
    pub time: f64,
    /// n₀, n₊, n₋ of each cell.
    pub values: Vec<[f64; 3]>,
}

/// What is said of transport.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TransportReport {
    /// Number of steps done.
    pub steps: usize,
    /// The greatest error of the balance of a step: change of mass minus what came in through the ends, relative to all that is there or
    /// has gone through the ends so far.
    pub mass_balance: f64,
    /// The least concentration of any kind, cell and step.
    pub minimum: f64,
    /// The greatest.
    pub maximum: f64,
    /// The flat ends beside the inlet, after the last step.
    pub tips: Vec<TipReport>,
}

/// Concentrations at a flat end.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TipReport {
    /// The number of its sample in the file.
    pub sample: i64,
    /// Free material.
    pub free: f64,
    /// Material on motors away from the inlet.
    pub plus: f64,
    /// Material on motors towards the inlet.
    pub minus: f64,
}

/// Bytes that factors take for each cell, estimated from long branches of twenty cells to a section.
const BYTES_PER_CELL: usize = 24 << 10;

/// Bytes that are taken at most where no limit is given.
const MOST_BYTES: usize = 8 << 30;

/// Transports material through a mesh, and keeps the field at this many steps, the first and the last among them.
///
/// # Shapes and units
/// Micrometres, seconds; concentrations in the unit of the parameters.
/// # Definition
/// See [`Parameters`]. Motors follow the potential flow from the inlet to the tips, [`potential_flow`], at their own speeds. The wall is
/// closed. At the inlet and the tips material on motors leaves with the concentration of the last cell.
/// # Accuracy
/// Backward Euler and upwind: of first order in the step and in the length of cells. No concentration is negative but for the rounding
/// of one solve, and mass is conserved to that.
/// # Errors
/// [`TransportError`].
/// # Cost
/// One factorization of three unknowns a cell, then one solve a step.
pub fn transport(
    mesh: &NeuronMesh,
    parameters: &Parameters,
    frames: usize,
    options: &TransportOptions<'_>,
) -> Result<Transport, TransportError> {
    parameters.check()?;
    let inlet = inlet(mesh, parameters)?;
    check_memory(mesh.mesh.cells().len(), options)?;
    let control = Control::start(&options.limits);
    let volumes = Discretisation::new(&mesh.mesh, &mesh.faces, &mesh.labels);
    let flow = potential_flow(&volumes, inlet)?;
    let system = System { mesh: &volumes, flow: &flow, parameters, inlet };
    run(&system, &mesh.caps, frames, options, &control)
}

/// Transports material along a viscous flow, at the speeds of the parameters, and keeps the field at this many steps, the first and the
/// last among them. The inlet is that of the flow.
///
/// # Definition
/// That of [`transport`], with the velocity of the flow at a mean speed of one at the inlet times that of the motors.
/// # Errors
/// [`TransportError`].
/// # Cost
/// That of [`transport`].
pub fn transport_in_flow(
    cells: &FlowCells,
    parameters: &Parameters,
    frames: usize,
    options: &TransportOptions<'_>,
) -> Result<Transport, TransportError> {
    parameters.check()?;
    check_memory(cells.volumes.volumes.len(), options)?;
    let control = Control::start(&options.limits);
    let system = System { mesh: &cells.volumes, flow: &cells.field, parameters, inlet: cells.inlet };
    run(&system, &cells.caps, frames, options, &control)
}

fn check_memory(cells: usize, options: &TransportOptions<'_>) -> Result<(), TransportError> {
    let (needed, limit) = (cells.saturating_mul(BYTES_PER_CELL), options.limits.memory.unwrap_or(MOST_BYTES));
    if needed > limit {
        return Err(TransportError::Memory { cells, needed: needed.div_ceil(1 << 20), limit: limit >> 20 });
    }
    Ok(())
}

fn run(
    system: &System<'_>,
    caps: &[Cap],
    frames: usize,
    options: &TransportOptions<'_>,
    control: &Control,
) -> Result<Transport, TransportError> {
    let (parameters, inlet) = (system.parameters, system.inlet);
    let cells = system.mesh.volumes.len();
    let solver = Lu::new(&system.matrix()?)?;
    let mut values: Vec<f64> = parameters.initial.repeat(cells);
    let mut book = Book::new(system, &values);
    let mut result = Transport {
        report: TransportReport { steps: 0, mass_balance: 0.0, minimum: 0.0, maximum: 0.0, tips: Vec::new() },
        stop: StopReason::Steps,
        ends: vec![system.at_ends(&values, caps.len())],
        frames: vec![system.frame(0, &values)],
    };
    let keep = |step: usize| {
        frames > 1
            && (step * (frames - 1)) / parameters.steps > ((step - 1) * (frames - 1)) / parameters.steps
    };
    let source = system.source();
    for step in 1..=parameters.steps {
        if control.is_stopped() {
            break;
        }
        let mut next = system.right_hand_side(&values, &source);
        solver.solve_in_place(&mut next)?;
        values = next;
        book.enter(system, &values);
        result.report.steps = step;
        result.ends.push(system.at_ends(&values, caps.len()));
        if keep(step) {
            result.frames.push(system.frame(step, &values));
        }
        let share = Some(step as f64 / parameters.steps as f64);
        let told =
            options.progress.map(|observer| observer.progress(&Progress { doing: "transporting", share }));
        if told == Some(ControlFlow::Break(())) {
            control.stop(StopReason::Cancelled);
        }
    }
    result.stop = control.reason().unwrap_or(StopReason::Steps);
    if result.frames.last().is_some_and(|frame| frame.step < result.report.steps) {
        result.frames.push(system.frame(result.report.steps, &values));
    }
    result.report.mass_balance = book.error;
    (result.report.minimum, result.report.maximum) = (book.range[0], book.range[1]);
    let last = &result.ends[result.ends.len() - 1];
    let tips = caps.iter().zip(last).enumerate().filter(|(cap, _)| *cap as u32 != inlet);
    result.report.tips = tips
        .map(|(_, (cap, &[free, plus, minus]))| TipReport { sample: cap.sample, free, plus, minus })
        .collect();
    Ok(result)
}

fn inlet(mesh: &NeuronMesh, parameters: &Parameters) -> Result<u32, TransportError> {
    match parameters.inlet {
        None => Cap::of_root(&mesh.caps).ok_or(TransportError::NoInlet),
        Some(sample) => Cap::at(&mesh.caps, sample).map_err(|ends| TransportError::NotAnEnd { sample, ends }),
    }
}

/// The equations: unknown `3 i + s` is kind s in cell i.
struct System<'s> {
    mesh: &'s Discretisation,
    flow: &'s FlowField,
    parameters: &'s Parameters,
    inlet: u32,
}

impl System<'_> {
    /// Signed speeds of the two kinds on motors.
    fn speeds(&self) -> [(usize, f64); 2] {
        [(1, self.parameters.speed_plus), (2, -self.parameters.speed_minus)]
    }

    /// Free material at an end, and what comes in on motors.
    fn given(&self, cap: u32) -> (Option<f64>, [f64; 3]) {
        let p = self.parameters;
        if cap == self.inlet {
            (p.inlet_free, [0.0, p.inlet_plus, 0.0])
        } else {
            (p.tips_free, [0.0, 0.0, p.tips_minus])
        }
    }

    fn matrix(&self) -> Result<SparseMatrix, TransportError> {
        let p = self.parameters;
        let n = 3 * self.mesh.volumes.len();
        let mut entries = Vec::with_capacity(7 * self.mesh.volumes.len() + 12 * self.mesh.links.len());
        for (i, &volume) in self.mesh.volumes.iter().enumerate() {
            let at = 3 * i;
            entries.extend([
                (at, at, volume * (1.0 / p.step + p.attach_plus + p.attach_minus)),
                (at, at + 1, -volume * p.detach_plus),
                (at, at + 2, -volume * p.detach_minus),
                (at + 1, at + 1, volume * (1.0 / p.step + p.detach_plus)),
                (at + 1, at, -volume * p.attach_plus),
                (at + 2, at + 2, volume * (1.0 / p.step + p.detach_minus)),
                (at + 2, at, -volume * p.attach_minus),
            ]);
        }
        for (&([a, b], conductance), &through) in self.mesh.links.iter().zip(&self.flow.through) {
            let (a, b) = (3 * a as usize, 3 * b as usize);
            let d = p.diffusion * conductance;
            entries.extend([(a, a, d), (a, b, -d), (b, b, d), (b, a, -d)]);
            for (kind, speed) in self.speeds() {
                let q = speed * through;
                // From where it comes to where it goes.
                let (from, to) = if q > 0.0 { (a + kind, b + kind) } else { (b + kind, a + kind) };
                entries.extend([(from, from, q.abs()), (to, from, -q.abs())]);
            }
        }
        for (end, &out) in self.mesh.ends.iter().zip(&self.flow.out) {
            let at = 3 * end.cell as usize;
            if self.given(end.cap).0.is_some() {
                entries.push((at, at, p.diffusion * end.conductance));
            }
            for (kind, speed) in self.speeds() {
                entries.push((at + kind, at + kind, (speed * out).max(0.0)));
            }
        }
        Ok(SparseMatrix::from_triplets(n, n, &entries)?)
    }

    /// What comes in through the ends whatever is there.
    fn source(&self) -> Vec<f64> {
        let mut source = vec![0.0; 3 * self.mesh.volumes.len()];
        for (end, &out) in self.mesh.ends.iter().zip(&self.flow.out) {
            let at = 3 * end.cell as usize;
            let (free, carried) = self.given(end.cap);
            if let Some(free) = free {
                source[at] += self.parameters.diffusion * end.conductance * free;
            }
            for (kind, speed) in self.speeds() {
                source[at + kind] += (-speed * out).max(0.0) * carried[kind];
            }
        }
        source
    }

    fn right_hand_side(&self, values: &[f64], source: &[f64]) -> Vec<f64> {
        let step = self.parameters.step;
        values
            .iter()
            .zip(source)
            .enumerate()
            .map(|(k, (x, s))| self.mesh.volumes[k / 3] / step * x + s)
            .collect()
    }

    /// What comes in through all ends in a second, and what goes through them either way.
    fn inflow(&self, values: &[f64]) -> (f64, f64) {
        let (mut net, mut gross) = (0.0, 0.0);
        let mut add = |flux: f64| {
            net += flux;
            gross += flux.abs();
        };
        for (end, &out) in self.mesh.ends.iter().zip(&self.flow.out) {
            let at = 3 * end.cell as usize;
            let (free, carried) = self.given(end.cap);
            if let Some(free) = free {
                add(self.parameters.diffusion * end.conductance * (free - values[at]));
            }
            for (kind, speed) in self.speeds() {
                let q = speed * out;
                add(-q * if q > 0.0 { values[at + kind] } else { carried[kind] });
            }
        }
        (net, gross)
    }

    fn mass(&self, values: &[f64]) -> f64 {
        values.iter().enumerate().map(|(k, x)| self.mesh.volumes[k / 3] * x).sum()
    }

    fn at_ends(&self, values: &[f64], caps: usize) -> Vec<[f64; 3]> {
        let mut sums = vec![([0.0; 3], 0.0); caps];
        for end in &self.mesh.ends {
            let (sum, area) = &mut sums[end.cap as usize];
            *area += end.area;
            for (kind, sum) in sum.iter_mut().enumerate() {
                *sum += end.area * values[3 * end.cell as usize + kind];
            }
        }
        sums.into_iter().map(|(sum, area)| sum.map(|x| x / area)).collect()
    }

    fn frame(&self, step: usize, values: &[f64]) -> Frame {
        let values = values.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect();
        Frame { step, time: step as f64 * self.parameters.step, values }
    }
}

/// The balance of mass, step by step.
struct Book {
    mass: f64,
    turnover: f64,
    error: f64,
    range: [f64; 2],
}

impl Book {
    fn new(system: &System<'_>, values: &[f64]) -> Self {
        let mass = system.mass(values);
        let [low, high] = system
            .parameters
            .initial
            .iter()
            .fold([f64::INFINITY, 0.0], |[a, b]: [f64; 2], &x| [a.min(x), b.max(x)]);
        Self { mass, turnover: mass, error: 0.0, range: [low, high] }
    }

    fn enter(&mut self, system: &System<'_>, values: &[f64]) {
        let (mass, step) = (system.mass(values), system.parameters.step);
        let (net, gross) = system.inflow(values);
        let came = net * step;
        self.turnover += gross * step;
        let error = (mass - self.mass - came).abs() / self.turnover.max(mass).max(f64::MIN_POSITIVE);
        self.error = if error > self.error || error.is_nan() { error } else { self.error };
        self.mass = mass;
        for &x in values {
            self.range = [self.range[0].min(x), self.range[1].max(x)];
        }
    }
}
